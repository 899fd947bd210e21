/* Shared by the readers of the two versions of VRM. */
#ifndef SBFI_VRM_READER_H
#define SBFI_VRM_READER_H

#include "gltf/json.h"
#include "import/vrm/vrm.h"

typedef struct sbfi_vrm_reader {
  sbfi_scene *scene;
  sbfi_vrm *vrm; /* in the scene's arena */
  sbfi_arena scratch;
  const sbfi_json *root; /* of the document */
  uint32_t number_count;
  int32_t *node_of_number; /* (number_count) scene node of each glTF node, or SBF_NONE */
  int32_t *spring_of_node; /* (scene nodes) spring whose joint it is, or SBF_NONE */
  sbfi_vrm_spring *springs;
  uint32_t spring_capacity;
  bool no_memory;
} sbfi_vrm_reader;

/* Allocate from the scene's arena; NULL, with no_memory set, if it runs out. */
void *sbfi_vrm_allocate(sbfi_vrm_reader *r, size_t count, size_t size);
/* Warns that a part is malformed. */
void sbfi_vrm_warn(sbfi_vrm_reader *r, const char *format, ...) __attribute__((format(printf, 2, 3)));

/* Number of items of a list; 0 if it is absent or no list. */
uint32_t sbfi_vrm_count(const sbfi_json *list);
/* Scene node of a glTF node; SBF_NONE if there is none. */
int32_t sbfi_vrm_node(const sbfi_vrm_reader *r, const sbfi_json *number);
/* A number within bounds. If it is absent, `fallback`; if it is no number, `fallback` with a warning; outside
 * the bounds, the nearer one with a warning. `what` names the part that has it. */
float sbfi_vrm_number(sbfi_vrm_reader *r, const sbfi_json *object, const char *name, const char *what,
    float fallback, float low, float high);
/* Three numbers: a list, or the members x, y and z. The same fallback. */
sbf_vec3 sbfi_vrm_vector(
    sbfi_vrm_reader *r, const sbfi_json *object, const char *name, const char *what, sbf_vec3 fallback);
/* The text of a string in the scene's arena; "" for another value. */
const char *sbfi_vrm_text(sbfi_vrm_reader *r, const sbfi_json *value);

/* Appends indices of a list that are below `count`, each once, in order; warns of others. `flags`: count
 * zeros. */
typedef struct sbfi_vrm_indices {
  uint32_t *at, count;
} sbfi_vrm_indices;
void sbfi_vrm_add_indices(sbfi_vrm_reader *r, const sbfi_json *list, uint32_t count, uint8_t *flags,
    const char *what, sbfi_vrm_indices *to);

/* Adds a spring and marks its joints. */
void sbfi_vrm_add_spring(sbfi_vrm_reader *r, const sbfi_vrm_spring *spring);

/* Springs and colliders of the extensions VRMC_springBone and VRM. */
void sbfi_vrm_read_springs(sbfi_vrm_reader *r, const sbfi_json *extension);
void sbfi_vrm_read_old_springs(sbfi_vrm_reader *r, const sbfi_json *extension);

#endif
