/* What a point has to do with a triangle of a soft surface within a tick: whether it comes near to it or goes
 * through, and on which side of it it belongs.
 *
 * That is, of a surface that encloses matter the outer one, up to `inner` deep (what is deeper has come in by
 * another face, which lets it out; seed of the method: Blender's soft bodies); of a sheet the one that it is
 * on. */
#ifndef SBRI_SURFACE_QUERY_H
#define SBRI_SURFACE_QUERY_H

#include "collide/triangle.h"

/* A point nearest to a face's rim, and behind the face by at most this fraction of the distance, lies beside
 * it and in front of another face. */
#define SBRI_BESIDE 0.3f
/* Fraction of the distance to the face that it lies behind: nearer than that in front of another, it is
 * outside.
 */
#define SBRI_OUTSIDE 0.99f

typedef struct sbri_surface_rule {
  /* m: search distance outside (contact margin plus the displacement that gravity and springs may add within
   * the tick) and inside. */
  float outer, inner;
  bool two_sided; /* a sheet, or open */
} sbri_surface_rule;

/* A triangle: its corners, and how far they go in the tick. */
typedef struct sbri_surface_face {
  sbf_vec3 at[3], directions[3];
} sbri_surface_face;

/* The most urgent that has been found; begins as sbri_surface_nothing. */
typedef struct sbri_surface_hit {
  uint32_t face;
  float weights[3]; /* of the corners: the place on it */
  sbf_vec3 normal;  /* towards where the point belongs */
  float urgency;    /* the least counts: fraction of the tick until it crosses, or 1 and more for proximity */
  bool behind;      /* it is behind the face */
  float before;     /* m to the nearest face that it is in front of */
} sbri_surface_hit;

static inline sbri_surface_hit sbri_surface_nothing(void) {
  return (sbri_surface_hit){.urgency = INFINITY, .before = INFINITY};
}

/* Whether a face was found. None for a point behind one face but nearer in front of another: it is outside.
 */
static inline bool sbri_surface_found(const sbri_surface_hit *f) {
  return f->urgency != INFINITY && !(f->behind && f->before < SBRI_OUTSIDE * (f->urgency - 1));
}

/* Whether what goes so against a face is too far off to touch it within the tick, or to lie inside. */
static inline bool sbri_surface_is_far(const sbri_surface_rule *rule, sbf_vec3 off, sbf_vec3 displacement) {
  float square = sbri_dot(off, off),
        max = rule->outer + 2 * (fabsf(displacement.x) + fabsf(displacement.y) + fabsf(displacement.z));
  return square > 1.0001f * max * max && (rule->two_sided || square > rule->inner * rule->inner);
}

static inline void sbri_surface_query(const sbri_surface_rule *rule, sbf_vec3 x, sbf_vec3 own_displacement,
    const sbri_surface_face *face, uint32_t number, sbri_surface_hit *best) {
  const sbf_vec3 *p = face->at;
  sbri_surface_hit f = {.face = number, .before = best->before};
  sbri_triangle_find_nearest(x, p[0], p[1], p[2], f.weights);
  sbf_vec3 off = sbri_sub(x, sbri_triangle_point(f.weights, p[0], p[1], p[2]));
  sbf_vec3 displacement = sbri_sub(own_displacement,
      sbri_triangle_point(f.weights, face->directions[0], face->directions[1], face->directions[2]));
  if (sbri_surface_is_far(rule, off, displacement)) return;
  sbf_vec3 up = sbri_normalize(sbri_cross(sbri_sub(p[1], p[0]), sbri_sub(p[2], p[0])), off);
  float distance = sbri_length(off), height = sbri_dot(off, up);
  bool behind = !rule->two_sided && height < 0;
  bool at_rim = f.weights[0] == 0 || f.weights[1] == 0 || f.weights[2] == 0;
  if (behind && (distance > rule->inner || (at_rim && -height < SBRI_BESIDE * distance))) return;
  sbf_vec3 side = rule->two_sided && height < 0 ? sbri_scale(up, -1) : up;
  if (height >= 0 && distance < f.before) f.before = best->before = distance;
  f.behind = behind;
  f.normal = behind || distance < 1e-6f ? up : sbri_scale(off, 1 / distance);
  if (behind) f.normal = sbri_scale(sbri_normalize(off, up), distance < 1e-6f ? 1 : -1);
  f.urgency = 1 + distance;
  float closing = -sbri_dot(displacement, f.normal);
  bool near = behind || distance - (closing > 0 ? 2 * closing : 0) < rule->outer;
  float through = behind ? -1 : sbri_triangle_cross(x, displacement, p[0], p[1], p[2]);
  if (through >= 0 && through < best->urgency) { /* by what it is then over */
    sbf_vec3 hit = sbri_add_scaled(x, displacement, through);
    sbri_triangle_find_nearest(hit, p[0], p[1], p[2], f.weights);
    f.normal = side, f.urgency = through;
  } else if (!near || f.urgency >= best->urgency) {
    return;
  }
  *best = f;
}

/* Signed distance of a point from a triangle, negative behind one of a surface that encloses matter up to the
 * rule's depth. */
static inline float sbri_surface_gap(const sbri_surface_rule *rule, sbf_vec3 x, const sbf_vec3 p[3]) {
  float weights[3];
  sbri_triangle_find_nearest(x, p[0], p[1], p[2], weights);
  sbf_vec3 off = sbri_sub(x, sbri_triangle_point(weights, p[0], p[1], p[2]));
  sbf_vec3 up = sbri_cross(sbri_sub(p[1], p[0]), sbri_sub(p[2], p[0]));
  float distance = sbri_length(off);
  return !rule->two_sided && sbri_dot(off, up) < 0 && distance < rule->inner ? -distance : distance;
}

#endif
