/* Meshes of tubes, and bones in them, to compute skin weights for. */
#ifndef TEST_RIGGED_TUBES_H
#define TEST_RIGGED_TUBES_H

#include "build/weights/weights.h"
#include "mechanics/vector.h"

enum { TUBE_POINTS = 20000, TUBE_BONES = 16 };

typedef struct rigged_tubes {
  sbf_vec3 points[TUBE_POINTS];
  uint32_t triangles[TUBE_POINTS][3];
  sbf_bone bones[TUBE_BONES];
  uint32_t point_count, triangle_count, bone_count;
} rigged_tubes;

/* Adds a tube around a path, closed at the ends by a point each unless it is open; `rings` along each
 * stretch. Returns its first point. */
uint32_t tubes_add(
    rigged_tubes *to, const sbfi_d3 *path, uint32_t path_count, double radius, uint32_t rings, bool open);
/* Adds a ball of that many rings. */
uint32_t tubes_add_ball(rigged_tubes *to, sbfi_d3 middle, double radius, uint32_t rings);
/* Adds a bone from `head` towards `tail`; without `length` where the mesh is to end it. Returns its number.
 */
uint32_t tubes_add_bone(rigged_tubes *to, const char *name, int32_t parent, sbfi_d3 head, sbfi_d3 tail);

sbfi_weights_input tubes_input(const rigged_tubes *of);
/* Weight of a bone on a point. */
double tubes_weight(const sbfi_weights *weights, uint32_t point, uint32_t bone);
/* Asserts that each point has weights in order that sum to one. */
void tubes_check_sums(const sbfi_weights *weights);

#endif
