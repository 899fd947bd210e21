/* Similarity transforms: a rotation, possibly a mirror, a uniform scale, and an offset. */
#ifndef SBFI_SIMILARITY_H
#define SBFI_SIMILARITY_H

#include "import/scene/scene.h"
#include "mechanics/vector.h"

/* The 48 rotations that map axes to axes: 0 is the identity, the first 24 do not mirror. */
enum { SBFI_AXIS_ROTATIONS = 48 };
sbfi_matrix sbfi_axis_rotation(uint32_t number);

/* Directions spread evenly over the unit sphere, along a spiral. */
void sbfi_spread_directions(sbfi_d3 *directions, uint32_t count);

/* A rotation (quaternion x, y, z, w) about a point. */
sbfi_matrix sbfi_rotation_about(const double rotation[4], sbfi_d3 about);
sbfi_d3 sbfi_similarity_apply(const sbfi_matrix *m, sbfi_d3 p);
/* Replaces the scale, or the offset. */
sbfi_matrix sbfi_similarity_scaled(const sbfi_matrix *rotation, double scale, sbfi_d3 offset);
double sbfi_similarity_scale(const sbfi_matrix *m);

/* The transform that maps a triangle to a similar one; there are two, one of them mirrored. False if a
 * triangle has no area. */
bool sbfi_similarity_of_triangle(
    const sbfi_d3 from[3], const sbfi_d3 to[3], bool mirrored, sbfi_matrix *matrix);

/* Least squares over `count` pairs (Horn 1987), mirrored or not; keeps a `scale` above 0. False if all
 * points coincide. */
bool sbfi_similarity_fit(
    const sbfi_d3 *from, const sbfi_d3 *to, uint32_t count, bool mirrored, double scale, sbfi_matrix *matrix);

/* Snaps to a usual transform: axes to axes, a usual unit, no offset. `size` is that of the transformed
 * points; `relative` is the tolerance, such as 1e-4. */
sbfi_matrix sbfi_similarity_snapped(const sbfi_matrix *m, double size, double relative);

/* Usual units of files, m: `name` is NULL if there is no suitable word for a message. */
typedef struct sbfi_usual_unit {
  double unit_m;
  const char *name;
} sbfi_usual_unit;
enum { SBFI_USUAL_UNITS = 12 };
extern const sbfi_usual_unit sbfi_usual_units[SBFI_USUAL_UNITS];

/* Description of a transform for a message: "scaled by 0.01 (centimetres), rotated by -90 degrees about x".
 */
typedef struct sbfi_similarity_text {
  char at[256];
} sbfi_similarity_text;
sbfi_similarity_text sbfi_similarity_describe(const sbfi_matrix *m, double size);

#endif
