/* A scene from sbfmt-import: validated, not yet assembled. Numbers point into the stream. */
#ifndef SBFI_RAW_SCENE_H
#define SBFI_RAW_SCENE_H

#include "import/scene/scene.h"
#include "import/scene/stream_format.h"

typedef struct sbfi_raw_node {
  sbfi_span name;
  int32_t parent; /* index below that of the node, or SBF_NONE */
  sbfi_stream_kind kind;
  int32_t number; /* in a glTF file, or SBF_NONE */
  sbfi_matrix local;
  sbfi_scene_limit limits[SBFI_LIMITS]; /* minimum and maximum may be swapped */
  uint32_t mesh_count;
  const uint32_t *meshes; /* (mesh_count) */
} sbfi_raw_node;

typedef struct sbfi_raw_bone {
  sbfi_span name; /* of a node */
  sbfi_matrix bind;
  uint32_t weight_count;
  const uint32_t *vertices; /* (weight_count) */
  const float *weights;     /* (weight_count) */
} sbfi_raw_bone;

typedef struct sbfi_raw_shape {
  sbfi_span name;
  float weight;
  const sbf_vec3 *positions; /* (vertex_count) */
} sbfi_raw_shape;

/* Vertices are split at every difference of an attribute, or at every corner; polygons may have less than
 * three corners. */
typedef struct sbfi_raw_mesh {
  sbfi_span name;
  int32_t material; /* SBF_NONE if the scene has no such material */
  uint32_t vertex_count, uv_set_count, polygon_count, corner_count, bone_count, shape_count;
  const sbf_vec3 *positions;     /* (vertex_count) */
  const sbf_vec3 *normals;       /* (vertex_count), or NULL */
  const sbf_vec4 *colors;        /* (vertex_count), or NULL */
  const sbf_vec2 *const *uvs;    /* (uv_set_count)(vertex_count) */
  const uint32_t *polygon_sizes; /* (polygon_count) */
  const uint32_t *corners;       /* (corner_count) */
  const sbfi_raw_bone *bones;
  const sbfi_raw_shape *shapes;
} sbfi_raw_mesh;

enum { SBFI_RAW_BASE_COLOR, SBFI_RAW_METALLIC_ROUGHNESS, SBFI_RAW_NORMAL, SBFI_RAW_MAPS };

typedef struct sbfi_raw_material {
  sbfi_scene_material values; /* without name and images */
  sbfi_span name, images[SBFI_RAW_MAPS];
} sbfi_raw_material;

typedef struct sbfi_raw_image {
  sbfi_span name, extension;
  uint32_t byte_count; /* 0: no image file */
  const uint8_t *bytes;
} sbfi_raw_image;

/* Times are in ticks. The stream stores keys as f64 time and f32 values, so they are read one by one. */
typedef struct sbfi_raw_keys {
  uint32_t count;
  const uint8_t *at;
} sbfi_raw_keys;

enum { SBFI_RAW_POSITION, SBFI_RAW_ROTATION, SBFI_RAW_SCALE, SBFI_RAW_TRACKS };

typedef struct sbfi_raw_channel {
  sbfi_span node_name;
  sbfi_raw_keys keys[SBFI_RAW_TRACKS];
} sbfi_raw_channel;

typedef struct sbfi_raw_clip {
  sbfi_span name;
  double duration_ticks, ticks_per_second;
  uint32_t channel_count;
  const sbfi_raw_channel *channels;
} sbfi_raw_clip;

typedef struct sbfi_raw_scene {
  sbfi_span generator;
  double unit_scale_factor;
  int32_t axes[6];
  bool incomplete;
  uint32_t node_count, mesh_count, material_count, image_count, clip_count;
  sbfi_raw_node *nodes;
  sbfi_raw_mesh *meshes;
  const sbfi_raw_material *materials;
  const sbfi_raw_image *images;
  const sbfi_raw_clip *clips;
} sbfi_raw_scene;

/* Reads a stream that must outlive the scene; `bytes` is aligned to 4. Allocates lists from `scratch`.
 * Guarantees indices in range, finite numbers, and parents before children. */
sbf_status sbfi_raw_scene_read(
    sbfi_raw_scene *scene, const uint8_t *bytes, size_t size, sbfi_arena *scratch, sbf_diagnostic *error);

/* Time and 3 or 4 values of key `index` of a track. */
double sbfi_raw_key(const sbfi_raw_keys *keys, uint32_t width, uint32_t index, float *values);

#endif
