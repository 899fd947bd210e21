/* A rigged character as one surface, its weights as its artist painted them, and poses to compare skins in.
 */
#ifndef BENCH_RIGGED_MODEL_H
#define BENCH_RIGGED_MODEL_H

#include "base/memory.h"
#include "build/weights/weights.h"
#include "motion/retargeting.h"

typedef struct rigged_model {
  sbf_asset *asset;
  sbfi_arena arena;
  uint32_t point_count, triangle_count;
  sbf_vec3 *points; /* of all skinned meshes, one after another */
  uint32_t (*triangles)[3];
  uint32_t *influence_begins; /* (point_count + 1) */
  uint32_t *joints;
  float *weights;
  sbf_bone *bones; /* the asset's, without lengths: those come from the skin where a bone ends in nothing */
  int8_t *sides;
  double size; /* longest side of the points' bounding box, m */
} rigged_model;

/* False where the file has no skin. Ends the program where it cannot be read. */
bool rigged_model_load(rigged_model *model, const char *path);
void rigged_model_free(rigged_model *model);

sbfi_weights_input rigged_model_input(const rigged_model *model);

/* Eight poses for each clip that walks, runs, swims, flies, attacks or idles; without such, eight with limbs
 * turned by 40 degrees and the middle by 15. `frames` (bones) receives one. False behind the last. */
bool rigged_model_pose(rigged_model *model, uint32_t number, sbfi_bone_frame *frames);

enum { RIGGED_POSES = 8 };

#endif
