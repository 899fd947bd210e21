/* Content of another program's file as plain data: importers fill a scene, the converter reads it.
 *
 * A scene contains the file's data without interpretation: numbers in the file's unit and axes, original
 * weights, both rest pose and bind pose. Guarantees of a loaded scene: indices in range, finite numbers,
 * valid UTF-8, nodes in a tree with parents first.
 *
 * The scene's arena owns all memory; sbfi_scene_free releases it. A loaded scene is read-only, so several
 * threads may read it. */
#ifndef SBFI_SCENE_H
#define SBFI_SCENE_H

#include "base/text.h"
#include "sbfmt/base.h"
#include "sbfmt/codes.h"

/* p' = M p: at[row][column], translation in the last column, last row 0 0 0 1. */
typedef struct sbfi_matrix {
  double at[4][4];
} sbfi_matrix;

/* Limits of a joint at a node, rad from the rest pose, about the bone's own axes: twist about +Y, swing_y
 * about +Z, swing_z about +X (in a joint frame the twist axis is +X). */
enum { SBFI_LIMIT_TWIST, SBFI_LIMIT_SWING_Y, SBFI_LIMIT_SWING_Z, SBFI_LIMITS };

typedef struct sbfi_scene_limit {
  bool stated;
  float min, max; /* min <= max */
} sbfi_scene_limit;

typedef struct sbfi_scene_node {
  const char *name;  /* need not be unique: lizart.glb has a bone and a section of the same name */
  int32_t parent;    /* index of a node before this one, or SBF_NONE */
  sbfi_matrix local; /* rest transform, node to parent */
  sbfi_matrix world; /* node to scene: world of the parent times local */
  int32_t number;    /* of the node in a glTF file, or SBF_NONE */
  bool is_bone;      /* a joint of a skin, or declared as a bone by the file */
  bool is_end;       /* a leaf that only marks the tip of its parent: "…_end" bones, BVH end sites */
  sbfi_scene_limit limits[SBFI_LIMITS]; /* of the joint between the node and its parent */
} sbfi_scene_node;

typedef struct sbfi_scene_image {
  const char *name;     /* "" if it has none */
  const char *path;     /* as in the file, with '/' as separator; NULL if embedded */
  const uint8_t *bytes; /* the embedded file (PNG, JPEG, ...), NULL otherwise (byte_count) */
  uint32_t byte_count;
  const char *extension; /* of an embedded file, as "png"; "" if unknown */
} sbfi_scene_image;

typedef enum sbfi_alpha_mode { SBFI_ALPHA_OPAQUE, SBFI_ALPHA_MASK, SBFI_ALPHA_BLEND } sbfi_alpha_mode;

/* Transform of texture coordinates, as in KHR_texture_transform. */
typedef struct sbfi_scene_uv_transform {
  uint32_t uv_set;
  float offset[2], rotation, scale[2];
} sbfi_scene_uv_transform;

typedef struct sbfi_scene_material {
  const char *name;
  float base_color[4]; /* red, green, blue, opacity, 0 to 1 */
  float emissive[3];
  float metallic, roughness; /* 0 to 1 */
  sbfi_alpha_mode alpha_mode;
  float alpha_cutoff; /* of SBFI_ALPHA_MASK */
  bool double_sided;
  int32_t base_color_image, metallic_roughness_image, normal_image; /* index or SBF_NONE */
  sbfi_scene_uv_transform base_color_uv, metallic_roughness_uv, normal_uv;
} sbfi_scene_material;

/* Texture coordinates as a list with indices: corners share an entry if they do in the file. */
typedef struct sbfi_scene_uvs {
  const char *name; /* "" if it has none */
  uint32_t count;
  const sbf_vec2 *at;    /* (count), v upwards as in OBJ */
  const int32_t *corner; /* (corner_count) index into `at`, SBF_NONE if the corner has none */
} sbfi_scene_uvs;

typedef struct sbfi_scene_joint {
  int32_t node;
  sbfi_matrix bind; /* mesh space to joint space, when the skin was bound */
} sbfi_scene_joint;

/* Weights under a name that is not a node: a vertex group without effect on skinning. */
typedef struct sbfi_scene_group {
  const char *name;
  const float *weights; /* (point_count), 0 to 1 */
} sbfi_scene_group;

/* A morph target. Deltas are added to points at weight 1. */
typedef struct sbfi_scene_shape {
  const char *name;
  float weight;          /* value at rest in the file */
  const sbf_vec3 *delta; /* (point_count) */
} sbfi_scene_shape;

/* Normals of a mesh. */
typedef struct sbfi_scene_normals {
  uint32_t count;
  const sbf_vec3 *at;          /* (count), as stored: not always of unit length */
  const int32_t *corner_index; /* (corner_count) index or SBF_NONE; NULL if the mesh has no normals */
} sbfi_scene_normals;

/* Vertex colours of a mesh. */
typedef struct sbfi_scene_colors {
  uint32_t count;
  const sbf_vec4 *at;          /* (count), as stored: not always in [0, 1] */
  const int32_t *corner_index; /* (corner_count) index or SBF_NONE; NULL if the mesh has no colours */
} sbfi_scene_colors;

/* Skin weights of the points of a mesh. */
typedef struct sbfi_scene_skin {
  uint32_t joint_count;           /* 0: no skin */
  const sbfi_scene_joint *joints; /* (joint_count) */
  const uint32_t *starts;         /* (point_count + 1) first influence of each point */
  const uint32_t *joint_index;    /* (starts[point_count]) index into joints, ascending within a point */
  const float *weights;           /* as stored, above 0; their sum over a point need not be 1 */
} sbfi_scene_skin;

/* A surface under one node. Points are the original ones, shared by corners; positions are in the space of
 * `node`. Polygons keep their sizes and file order; a polygon may contain a point twice (a bridged hole).
 *
 * "Source vertex": in an OBJ the file's v-lines from 0; otherwise the vertices that the file stores for
 * rendering, counted over the parts of the mesh in order. */
typedef struct sbfi_scene_mesh {
  const char *name; /* of the data block; the node's name is the object's. In an OBJ both are the same. */
  int32_t node;

  uint32_t point_count;
  const sbf_vec3 *points;        /* (point_count) */
  const uint32_t *point_sources; /* (point_count) the first source vertex at each point, ascending for OBJ */

  uint32_t polygon_count, corner_count;
  const uint32_t *polygon_starts;   /* (polygon_count + 1) first corner of each; the last is corner_count */
  const int32_t *polygon_materials; /* (polygon_count) index or SBF_NONE */
  const uint32_t *corner_points;    /* (corner_count) */

  sbfi_scene_normals normals;
  sbfi_scene_colors colors;
  uint32_t uv_set_count;
  const sbfi_scene_uvs *uv_sets; /* (uv_set_count) */

  uint32_t vertex_count; /* source vertices of this mesh; 0 for OBJ, whose v-lines are shared by all meshes */
  const uint32_t *vertex_points;   /* (vertex_count) source vertex to point */
  const uint32_t *corner_vertices; /* (corner_count) source vertex of each corner; NULL for OBJ */

  sbfi_scene_skin skin;
  uint32_t shape_count;
  const sbfi_scene_shape *shapes; /* (shape_count) */
  uint32_t group_count;
  const sbfi_scene_group *groups; /* (group_count) unique names */
} sbfi_scene_mesh;

/* Keys of one node, times in seconds from the clip's start, ascending. Linear between keys, clamped
 * outside. Tracks without keys keep the node's rest value. */
typedef struct sbfi_scene_channel {
  int32_t node;
  uint32_t position_count, rotation_count, scale_count;
  const float *position_times;
  const sbf_vec3 *positions;
  const float *rotation_times;
  const sbf_quat *rotations; /* unit length */
  const float *scale_times;
  const sbf_vec3 *scales;
} sbfi_scene_channel;

typedef struct sbfi_scene_clip {
  const char *name;
  float duration_s;
  uint32_t channel_count;
  const sbfi_scene_channel *channels; /* at most one per node */
} sbfi_scene_clip;

typedef struct sbfi_scene {
  sbfi_arena arena;
  const char *file;      /* file name from the caller, sanitized for messages and assets */
  const char *path;      /* the same without changes */
  const char *format;    /* "obj", or assimp's lower case name of the format, as "fbx", "glb", "bvh" */
  const char *generator; /* program that wrote the file, "" if unknown */

  double unit_m; /* metres per unit of the file; 1 if not stated */
  bool unit_known;
  sbfi_matrix axes; /* file axes to +Y up, +Z forward; identity if not stated */
  bool axes_known;  /* scene to asset space is axes, times unit_m */

  uint32_t node_count, mesh_count, material_count, image_count, clip_count, warning_count;
  const sbfi_scene_node *nodes; /* parents before children */
  /* (node_count) node to scene in the saved pose of the file; NULL if that is the rest pose. */
  const sbfi_matrix *saved_worlds;
  const sbfi_scene_mesh *meshes;
  const sbfi_scene_material *materials;
  const sbfi_scene_image *images;
  const sbfi_scene_clip *clips;
  const struct sbfi_vrm *vrm; /* avatar data of a VRM file; NULL if there is none */
  sbf_diagnostic *warnings;   /* in the order found; warnings beyond SBFI_SCENE_WARNINGS are only counted */
  uint32_t warnings_left_out;
} sbfi_scene;

enum { SBFI_SCENE_WARNINGS = 64 };

typedef struct sbfi_scene_options {
  const sbf_allocator *allocator;   /* NULL: malloc */
  size_t input_limit_bytes;         /* largest file read; 0: 4 GiB */
  size_t memory_limit_bytes;        /* for the scene, and for the helper's output; 0: 8 GiB */
  const char *helper_path;          /* program sbfmt-import; NULL: environment, then default paths */
  double helper_time_limit_s;       /* 0: 20 s plus 10 s per megabyte, up to 120 s */
  size_t helper_memory_limit_bytes; /* 0: 8 GiB */
} sbfi_scene_options;

/* Reads a file of a supported format: .obj by our own reader, others by assimp. On failure the scene is
 * empty and `*error` (may be NULL) has the reason. `options` may be NULL. */
sbf_status sbfi_scene_read(
    sbfi_scene *scene, const char *path, const sbfi_scene_options *options, sbf_diagnostic *error);

/* Safe on a zeroed scene. */
void sbfi_scene_free(sbfi_scene *scene);

/* Number of bones in the tree; 0 for a scene without a rig. */
uint32_t sbfi_scene_bone_count(const sbfi_scene *scene);

/* --- For importers ---------------------------------------------------------------------------------- */

/* Creates an empty scene with its arena, unit 1 and identity axes. False if memory runs out. */
bool sbfi_scene_init(
    sbfi_scene *scene, const sbf_allocator *allocator, size_t memory_limit_bytes, const char *file);

/* Adds a warning about line `line` (0: none) with printf formatting; false if memory runs out. */
bool sbfi_scene_warn(sbfi_scene *scene, sbf_code code, uint32_t line, const char *format, ...)
    __attribute__((format(printf, 4, 5)));

/* Copies text to the arena, NUL-terminated. Invalid UTF-8 and control characters become U+FFFD. NULL if
 * memory runs out. */
const char *sbfi_scene_string(sbfi_scene *scene, sbfi_span text);

/* Matrix from mesh to scene at rest: the world matrix of its node. A skinned mesh ignores its node: uses
 * the first joint's world matrix times its bind matrix. */
sbfi_matrix sbfi_scene_mesh_world(const sbfi_scene *scene, const sbfi_scene_mesh *mesh);

/* Computes world matrices from local ones; parents must come first. */
void sbfi_scene_set_worlds(sbfi_scene_node *nodes, uint32_t node_count);

/* Frees the scene, adds the file name to `*error` and returns `status`. */
sbf_status sbfi_scene_fail(sbfi_scene *scene, sbf_diagnostic *error, sbf_status status);

sbfi_matrix sbfi_matrix_identity(void);
sbfi_matrix sbfi_matrix_multiply(const sbfi_matrix *a, const sbfi_matrix *b);
/* False if the matrix is singular; assumes a last row of 0 0 0 1. `to` may be `matrix`. */
bool sbfi_matrix_invert(const sbfi_matrix *matrix, sbfi_matrix *to);

#endif
