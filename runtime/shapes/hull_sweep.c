/* Conservative advancement (B. Mirtich, Timewarp Rigid Body Simulation, 1996): the separation along an axis
 * is a lower bound of the distance, so the hulls can advance by it. If an axis separates them by less than
 * `near` without a contact point, they advance by `near`. */
#include "shapes/hull_sweep.h"

#include <math.h>

#include "math/vec3.h"

enum { MAX_STEPS = 256 };

sbri_placed_hull sbri_hull_interpolate(
    const sbri_placed_hull *from, const sbri_placed_hull *to, float fraction) {
  sbri_placed_hull at = *from;
  at.at = sbri_lerp(from->at, to->at, fraction);
  at.rotation = sbri_quat_blend(from->rotation, to->rotation, fraction);
  return at;
}

/* Maximum displacement of a corner by rotation, m. The chord of the quaternions of half a turn is at most 2,
 * and its arc is at most pi/2 times as long. */
static float rotation_travel(const sbri_placed_hull *from, const sbri_placed_hull *to) {
  float cosine = from->rotation.x * to->rotation.x + from->rotation.y * to->rotation.y +
                 from->rotation.z * to->rotation.z + from->rotation.w * to->rotation.w;
  float fraction = 1 - cosine * cosine, radius = 0;
  for (uint32_t i = 0; i < from->hull->vertex_count; i++) {
    float square = sbri_dot(from->hull->vertices[i], from->hull->vertices[i]);
    radius = square > radius ? square : radius;
  }
  return fraction > 0 ? 3.15f * from->scale * sqrtf(radius * fraction) : 0;
}

float sbri_hulls_sweep(const sbri_placed_hull from[2], const sbri_placed_hull to[2], float near) {
  sbf_vec3 directions[2] = {sbri_sub(to[0].at, from[0].at), sbri_sub(to[1].at, from[1].at)};
  float travel = sbri_length(sbri_sub(directions[0], directions[1])) + rotation_travel(&from[0], &to[0]) +
                 rotation_travel(&from[1], &to[1]);
  float fraction = 0;
  for (int step = 0; step < MAX_STEPS && fraction <= 1; step++) {
    sbri_placed_hull a = sbri_hull_interpolate(&from[0], &to[0], fraction),
                     b = sbri_hull_interpolate(&from[1], &to[1], fraction);
    sbri_hull_pair pair = {.gap = INFINITY};
    bool has_points = sbri_collide_hulls(&a, &b, near + (1 - fraction) * travel, &pair);
    if (pair.gap == INFINITY) return 2; /* farther apart than their displacement */
    if (pair.gap <= near && has_points) {
      for (uint32_t i = 0; i < pair.count; i++)
        if (pair.gaps[i] <= near) return fraction;
    }
    fraction += (pair.gap > near ? pair.gap : near) / travel;
  }
  return fraction;
}
