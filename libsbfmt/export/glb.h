/* Binary glTF 2.0 under construction: JSON arrays that grow in parallel, and the bytes that they refer to.
 *
 * base/text.h prints the JSON, as for all formats: shortest digits, no locale, out of memory is reported. No
 * other feature of a JSON library is needed.
 *
 * Nodes: one per bone, in order; one per written mesh, in order; if there are bones, their root; ends of
 * swinging bones; and those of rigid bodies and joints. */
#ifndef SBFI_GLB_H
#define SBFI_GLB_H

#include "base/memory.h"
#include "export/exporting.h"

typedef enum sbfi_glb_part {
  SBFI_GLB_VIEWS,
  SBFI_GLB_ACCESSORS,
  SBFI_GLB_IMAGES,
  SBFI_GLB_TEXTURES,
  SBFI_GLB_MATERIALS,
  SBFI_GLB_MESHES,
  SBFI_GLB_SKINS,
  SBFI_GLB_NODES,
  SBFI_GLB_ANIMATIONS,
  SBFI_GLB_PARTS
} sbfi_glb_part;

typedef struct sbfi_glb_array {
  sbfi_text text;
  uint32_t count;
} sbfi_glb_array;

/* Position and rotation of a bone, in asset or world space. */
typedef struct sbfi_glb_transform {
  sbf_vec3 position;
  sbf_quat rotation;
} sbfi_glb_transform;

/* m is applied first, then t is added. */
typedef struct sbfi_glb_affine {
  double m[3][3], t[3];
} sbfi_glb_affine;

/* A render mesh during the export: its written polygons, and its skin or bone. */
typedef struct sbfi_glb_mesh {
  const sbf_render_mesh *full;   /* of the asset */
  const sbf_render_mesh *shown;  /* the same, or one of its render levels */
  const uint32_t *full_of_shown; /* (points of shown) index in full; NULL: the same */
  const sbf_skin *skin;          /* of full's points; NULL: it follows `bone`, or nothing */
  int32_t bone;                  /* SBF_NONE with a skin */
  uint32_t node;                 /* UINT32_MAX: it has no polygons and is not written */
  uint32_t target_count;         /* morph targets: shape keys, then frames of the motion */
  uint32_t first_point;          /* index of full's first point in a frame of the motion */
} sbfi_glb_mesh;

typedef struct sbfi_glb {
  sbfi_export *e;
  sbfi_arena arena;
  sbfi_text bytes; /* binary chunk */
  sbfi_glb_array parts[SBFI_GLB_PARTS];
  const int32_t *texture_indices;   /* by texture of the asset: index among the written ones, or SBF_NONE */
  sbfi_glb_mesh *meshes;            /* by render mesh */
  sbfi_glb_affine *bone_motions;    /* (bones) memory for sbfi_glb_compute_offsets; NULL without a motion */
  size_t frame_points;              /* of all render meshes */
  uint32_t root_node;               /* parent of the bones */
  struct sbfi_glb_springs *springs; /* export/glb_springs.h; NULL: nothing swings */
  struct sbfi_glb_rigid *rigid;     /* export/glb_rigid.h; NULL: no rigid bodies */
  bool root_is_joint;               /* it is also the joint of points without a bone */
  bool emissive_strength, texture_transform, texture_webp; /* used extensions */
  bool failed;                                             /* memory ran out */
  uint32_t omitted_images, omitted_tracks;
  double worst_m; /* largest error of the written motion, where a joint blend is singular */
} sbfi_glb;

typedef enum sbfi_glb_type {
  SBFI_GLB_FLOAT,
  SBFI_GLB_VEC2,
  SBFI_GLB_VEC3,
  SBFI_GLB_VEC4,
  SBFI_GLB_MAT4,
  SBFI_GLB_UINT,
  SBFI_GLB_USHORT,
  SBFI_GLB_USHORT4,
  SBFI_GLB_UBYTE4
} sbfi_glb_type;

enum { SBFI_GLB_NO_TARGET = 0, SBFI_GLB_VERTICES = 34962, SBFI_GLB_INDICES = 34963 };

/* Appends `count` items and returns the accessor's index. Floats and vec3 include their bounds. */
uint32_t sbfi_glb_accessor(
    sbfi_glb *g, const void *items, uint32_t count, sbfi_glb_type type, uint32_t target);
/* Appends bytes as a separate view and returns its index. */
uint32_t sbfi_glb_view(sbfi_glb *g, const void *bytes, size_t size);

/* Begins a new item of a part: returns its text to append to, after a comma if needed. */
sbfi_text *sbfi_glb_item(sbfi_glb *g, sbfi_glb_part part, uint32_t *number);
void sbfi_glb_write_string(sbfi_text *text, const char *string);                    /* quoted and escaped */
void sbfi_glb_write_numbers(sbfi_text *text, const float *numbers, uint32_t count); /* [a,b,...] */

/* Zeroed memory until the end; NULL, with `failed` set, if it runs out; also for a count of 0. */
void *sbfi_glb_allocate(sbfi_glb *g, size_t count, size_t size);

sbfi_glb_transform sbfi_glb_rest(const sbf_asset *asset, uint32_t bone);
/* Transform relative to its parent; NULL: unchanged. The rotation has unit length. */
void sbfi_glb_compute_local(
    sbfi_glb_transform own, const sbfi_glb_transform *parent, float translation[3], float rotation[4]);

/* Sections written by each file of the writer. */
void sbfi_glb_write_materials(sbfi_glb *g);
void sbfi_glb_choose_meshes(sbfi_glb *g); /* fills g->meshes; before nodes and meshes */
void sbfi_glb_write_meshes(sbfi_glb *g);
void sbfi_glb_write_nodes(sbfi_glb *g); /* and the skin */
void sbfi_glb_write_clips(sbfi_glb *g);
/* Whether a track of a clip becomes a channel: glTF has rules for keys. */
bool sbfi_glb_writes_track(const sbf_clip *clip, uint32_t index);
/* Appends the value of the extension SBF_soft_body. `json` is the file without it; the extension adds buffer
 * views. */
void sbfi_glb_write_soft_body(sbfi_glb *g, const sbfi_text *json, sbfi_text *extension);
/* The motion's channels; after the meshes. */
void sbfi_glb_write_motion(sbfi_glb *g);
/* State for normals of morph targets; NULL if the mesh has none, or memory runs out. */
typedef struct sbfi_glb_normals sbfi_glb_normals;
sbfi_glb_normals *sbfi_glb_normals_begin(sbfi_glb *g, const sbfi_glb_mesh *mesh);
/* Moves the points of `mesh->shown` by these offsets. */
void sbfi_glb_normals_move(sbfi_glb_normals *normals, const sbf_vec3 *offsets);
/* Change of a corner's normal; `normal` has unit length. */
sbf_vec3 sbfi_glb_normals_offset(const sbfi_glb_normals *normals, uint32_t corner, sbf_vec3 normal);
uint32_t sbfi_glb_normal_of(const sbf_render_mesh *m, uint32_t corner); /* index of a corner's normal */
/* Offset of each point of `mesh->shown` in that frame, before its joints are applied. */
void sbfi_glb_compute_offsets(sbfi_glb *g, const sbfi_glb_mesh *mesh, uint32_t frame, sbf_vec3 *offsets);

#endif
