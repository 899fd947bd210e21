/* Contact of a point with a triangle of a soft surface within a tick: whether it approaches or crosses it,
 * and the side to which it belongs.
 *
 * A point of a closed surface belongs outside if it is at most `inner` deep; deeper points have entered by
 * another face, by which they leave (after a method in Blender's soft bodies). A point of a sheet belongs to
 * the side that it is on. */
#ifndef SBRI_SURFACE_QUERY_H
#define SBRI_SURFACE_QUERY_H

#include "shapes/triangle.h"

/* If a point is nearest to the rim of a face, and behind the face by at most this fraction of the distance,
 * it is beside the face and in front of another one. */
#define SBRI_BESIDE 0.3f
/* A point behind a face is outside if it is in front of another face at less than this fraction of the
 * distance. */
#define SBRI_OUTSIDE 0.99f

typedef struct sbri_surface_rule {
  /* m: search distance outside (contact margin plus the displacement that gravity and springs may add within
   * the tick) and inside. */
  float outer, inner;
  bool two_sided; /* a sheet, or an open surface */
} sbri_surface_rule;

/* Corners of a triangle and their displacements in the tick. */
typedef struct sbri_surface_face {
  sbf_vec3 at[3], directions[3];
} sbri_surface_face;

/* The most urgent hit so far; begins as sbri_surface_nothing. */
typedef struct sbri_surface_hit {
  uint32_t face;
  float weights[3]; /* of the corners, for the contact point */
  sbf_vec3 normal;  /* towards the side of the point */
  float urgency;    /* lower is more urgent: fraction of the tick until it crosses, or 1 plus the distance for
                       proximity */
  bool behind;      /* the point is behind the face */
  float before;     /* m to the nearest face that the point is in front of */
} sbri_surface_hit;

static inline sbri_surface_hit sbri_surface_nothing(void) {
  return (sbri_surface_hit){.urgency = INFINITY, .before = INFINITY};
}

/* Whether a face was found. A point behind one face but nearer in front of another is outside, and has none.
 */
static inline bool sbri_surface_found(const sbri_surface_hit *f) {
  return f->urgency != INFINITY && !(f->behind && f->before < SBRI_OUTSIDE * (f->urgency - 1));
}

/* Whether a point is too far from a face to touch it within the tick, or to be inside. `displacement` is
 * relative. */
static inline bool sbri_surface_is_far(
    const sbri_surface_rule *rule, sbf_vec3 offset, sbf_vec3 displacement) {
  float square = sbri_dot(offset, offset),
        max = rule->outer + 2 * (fabsf(displacement.x) + fabsf(displacement.y) + fabsf(displacement.z));
  return square > 1.0001f * max * max && (rule->two_sided || square > rule->inner * rule->inner);
}

static inline void sbri_surface_query(const sbri_surface_rule *rule, sbf_vec3 x, sbf_vec3 own_displacement,
    const sbri_surface_face *face, uint32_t number, sbri_surface_hit *best) {
  const sbf_vec3 *p = face->at;
  sbri_surface_hit f = {.face = number, .before = best->before};
  sbri_triangle_find_nearest(x, p[0], p[1], p[2], f.weights);
  sbf_vec3 offset = sbri_sub(x, sbri_triangle_point(f.weights, p[0], p[1], p[2]));
  sbf_vec3 displacement = sbri_sub(own_displacement,
      sbri_triangle_point(f.weights, face->directions[0], face->directions[1], face->directions[2]));
  if (sbri_surface_is_far(rule, offset, displacement)) return;
  sbf_vec3 normal = sbri_normalize(sbri_cross(sbri_sub(p[1], p[0]), sbri_sub(p[2], p[0])), offset);
  float distance = sbri_length(offset), height = sbri_dot(offset, normal);
  bool behind = !rule->two_sided && height < 0;
  bool at_rim = f.weights[0] == 0 || f.weights[1] == 0 || f.weights[2] == 0;
  if (behind && (distance > rule->inner || (at_rim && -height < SBRI_BESIDE * distance))) return;
  sbf_vec3 facing_normal = rule->two_sided && height < 0 ? sbri_scale(normal, -1) : normal;
  if (height >= 0 && distance < f.before) f.before = best->before = distance;
  f.behind = behind;
  f.normal = behind || distance < 1e-6f ? normal : sbri_scale(offset, 1 / distance);
  if (behind) f.normal = sbri_scale(sbri_normalize(offset, normal), distance < 1e-6f ? 1 : -1);
  f.urgency = 1 + distance;
  float closing = -sbri_dot(displacement, f.normal);
  bool is_near = behind || distance - (closing > 0 ? 2 * closing : 0) < rule->outer;
  float crossing = behind ? -1 : sbri_triangle_cross(x, displacement, p[0], p[1], p[2]);
  if (crossing >= 0 && crossing < best->urgency) { /* at the crossing */
    sbf_vec3 position = sbri_add_scaled(x, displacement, crossing);
    sbri_triangle_find_nearest(position, p[0], p[1], p[2], f.weights);
    f.normal = facing_normal, f.urgency = crossing;
  } else if (!is_near || f.urgency >= best->urgency) {
    return;
  }
  *best = f;
}

/* Signed distance of a point from a triangle; negative behind a face of a closed surface, up to the rule's
 * depth. */
static inline float sbri_surface_gap(const sbri_surface_rule *rule, sbf_vec3 x, const sbf_vec3 p[3]) {
  float weights[3];
  sbri_triangle_find_nearest(x, p[0], p[1], p[2], weights);
  sbf_vec3 offset = sbri_sub(x, sbri_triangle_point(weights, p[0], p[1], p[2]));
  sbf_vec3 normal = sbri_cross(sbri_sub(p[1], p[0]), sbri_sub(p[2], p[0]));
  float distance = sbri_length(offset);
  return !rule->two_sided && sbri_dot(offset, normal) < 0 && distance < rule->inner ? -distance : distance;
}

#endif
