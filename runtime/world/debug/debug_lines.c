#include "world/debug/debug_lines.h"

#include "math/trig.h"

static const float TURN = 6.28318530718f;
enum { ARC_STEPS = 24 }; /* steps per full turn */

static sbr_double3 in_world(const sbri_debug_lines *to, sbf_vec3 x) {
  double s = (double)to->scale;
  return (sbr_double3){
      to->origin.x + s * (double)x.x, to->origin.y + s * (double)x.y, to->origin.z + s * (double)x.z};
}

void sbri_draw_line(const sbri_debug_lines *to, sbf_vec3 a, sbf_vec3 b, uint32_t color) {
  if (to->draw->line) to->draw->line(to->draw->user, in_world(to, a), in_world(to, b), color);
}

void sbri_draw_point(const sbri_debug_lines *to, sbf_vec3 at, float size_pixels, uint32_t color) {
  if (to->draw->point) to->draw->point(to->draw->user, in_world(to, at), size_pixels, color);
}

static sbf_vec3 posed(const sbr_transform *pose, sbf_vec3 x) {
  return sbri_add(pose->position, sbri_rotate(pose->rotation, x));
}

void sbri_draw_box(
    const sbri_debug_lines *to, const sbri_box *box, const sbr_transform *pose, uint32_t color) {
  sbf_vec3 at[8];
  for (int i = 0; i < 8; i++)
    at[i] = posed(pose, sbri_vec3(i & 1 ? box->high.x : box->low.x, i & 2 ? box->high.y : box->low.y,
                            i & 4 ? box->high.z : box->low.z));
  for (int i = 0; i < 8; i++)
    for (int bit = 1; bit < 8; bit *= 2)
      if (!(i & bit)) sbri_draw_line(to, at[i], at[i | bit], color);
}

void sbri_draw_arc(const sbri_debug_lines *to, sbf_vec3 center, sbf_vec3 x, sbf_vec3 y, float from_rad,
    float to_rad, uint32_t color) {
  int steps = (int)ceilf(ARC_STEPS * (to_rad - from_rad) / TURN);
  sbf_vec3 last = center;
  for (int i = 0; i <= steps; i++) {
    float angle = steps ? from_rad + (to_rad - from_rad) * (float)i / (float)steps : from_rad;
    float sine, cosine;
    sbri_sincos(angle, &sine, &cosine);
    sbf_vec3 at = sbri_add_scaled(sbri_add_scaled(center, x, cosine), y, sine);
    if (i) sbri_draw_line(to, last, at, color);
    last = at;
  }
}

void sbri_draw_hull(
    const sbri_debug_lines *to, const sbri_hull *hull, const sbr_transform *pose, uint32_t color) {
  for (uint32_t e = 0; e < hull->edge_count; e++) {
    const uint32_t *ends = hull->edges[e].ends;
    sbri_draw_line(to, posed(pose, hull->vertices[ends[0]]), posed(pose, hull->vertices[ends[1]]), color);
  }
}

void sbri_draw_contact(const sbri_debug_lines *to, sbf_vec3 at, sbf_vec3 normal, float impulse) {
  float length = sbri_clamp(impulse * to->draw->impulse_m, 0, 1) / to->scale;
  sbri_draw_point(to, at, SBRI_POINT_PIXELS, impulse > 0 ? SBRI_DRAW_RED : SBRI_DRAW_BLUE);
  if (length > 0) sbri_draw_line(to, at, sbri_add_scaled(at, normal, length), SBRI_DRAW_RED);
}
