/* Moves a character to the origin and onto y = 0 in asset space. */
#include <math.h>

#include "import/convert/conversion.h"
#include "import/gait/gait_draft.h"

/* Fraction of the height; a character whose lowest point is this close to y = 0 is not moved. */
static const double STANDS = 0.05;
/* Fraction of the bones' greatest extent: distance of the origin before or behind them. */
static const double AWAY = 0.25;

typedef struct span {
  double low, high;
} span;

static void extend(span *s, const sbf_vec3_list points) {
  for (uint32_t i = 0; i < points.count; i++) {
    s->low = fmin(s->low, (double)points.at[i].y);
    s->high = fmax(s->high, (double)points.at[i].y);
  }
}

static span span_of(const sbf_asset *a) {
  span s = {INFINITY, -INFINITY};
  for (uint32_t i = 0; i < a->soft_bodies.count; i++) extend(&s, a->soft_bodies.at[i].surface.positions);
  for (uint32_t i = 0; i < a->render_meshes.count; i++) extend(&s, a->render_meshes.at[i].mesh.positions);
  if (s.low <= s.high) return s;
  for (uint32_t i = 0; i < a->bones.count; i++) extend(&s, (sbf_vec3_list){&a->bones.at[i].head, 1});
  return s;
}

static void move(const sbf_vec3_list points, const double by[3]) {
  sbf_vec3 *at = (sbf_vec3 *)(uintptr_t)points.at; /* the conversion owns the asset */
  for (uint32_t i = 0; i < points.count; i++) {
    if (by[0] != 0) at[i].x = (float)((double)at[i].x + by[0]); /* keeps the sign of zeros */
    if (by[1] != 0) at[i].y = (float)((double)at[i].y + by[1]);
    if (by[2] != 0) at[i].z = (float)((double)at[i].z + by[2]);
  }
}

static void move_one(const sbf_vec3 *point, const double by[3]) {
  move((sbf_vec3_list){point, 1}, by);
}

static void move_asset(const sbf_asset *a, const double by[3]) {
  for (uint32_t i = 0; i < a->bones.count; i++) move_one(&a->bones.at[i].head, by);
  for (uint32_t i = 0; i < a->soft_bodies.count; i++) move(a->soft_bodies.at[i].surface.positions, by);
  for (uint32_t i = 0; i < a->render_meshes.count; i++)
    if (!sbfi_is_of_section(a, a->render_meshes.at[i].mesh.positions))
      move(a->render_meshes.at[i].mesh.positions, by);
  for (uint32_t i = 0; i < a->ik_chains.count; i++)
    if (a->ik_chains.at[i].has_pole) move_one(&a->ik_chains.at[i].pole, by);
  for (uint32_t g = 0; g < a->gaits.count; g++)
    for (uint32_t l = 0; l < a->gaits.at[g].legs.count; l++) move_one(&a->gaits.at[g].legs.at[l].home, by);
}

/* Middle of the bones along z if the origin, about which a character turns, is far before or behind them;
 * else 0. */
static double middle_ahead(const sbf_asset *a) {
  double low[3] = {INFINITY, INFINITY, INFINITY}, high[3] = {-INFINITY, -INFINITY, -INFINITY}, size = 0;
  for (uint32_t i = 0; i < a->bones.count; i++) {
    const sbf_vec3 head = a->bones.at[i].head;
    const double at[3] = {(double)head.x, (double)head.y, (double)head.z};
    for (int k = 0; k < 3; k++) {
      low[k] = fmin(low[k], at[k]);
      high[k] = fmax(high[k], at[k]);
      size = fmax(size, high[k] - low[k]);
    }
  }
  double middle = 0.5 * (low[2] + high[2]);
  return fabs(middle) > 0.5 * (high[2] - low[2]) + AWAY * size ? middle : 0;
}

/* Walks are mirrored in the plane x = 0, and characters turn about the origin. */
static sbf_status stand_at_origin(sbfi_conversion *c) {
  sbf_vec3 center;
  if (!sbfi_rig_center(c->asset, &c->scratch, &center)) return sbfi_convert_no_memory(c);
  double x = (double)center.x, z = middle_ahead(c->asset);
  const double by[3] = {-x, 0, -z};
  if (x == 0 && z == 0) return SBF_OK;
  move_asset(c->asset, by);
  c->moved_m = fmax(fabs(x), fabs(z));
  for (int k = 0; k < 3; k++) { /* later passes use these matrices */
    c->to_asset.at[k][3] += by[k];
    c->rig_to_asset.at[k][3] += by[k];
  }
  sbfi_convert_warn(c, SBF_CODE_IMPORT_GROUND,
      "the character was at x = %.3g m, z = %.3g m and was moved to the origin", x, z);
  return SBF_OK;
}

sbf_status sbfi_stand_on_ground(sbfi_conversion *c) {
  if (c->asset->gaits.count == 0) return SBF_OK; /* without a gait the character may not stand at all */
  sbf_status status = stand_at_origin(c);
  if (status != SBF_OK) return status;
  span s = span_of(c->asset);
  double height = s.high - s.low;
  if (!(fabs(s.low) > STANDS * height)) return SBF_OK;
  move_asset(c->asset, (const double[3]){0, -s.low, 0});
  c->lift_m = -s.low;
  c->moved_m = fmax(c->moved_m, fabs(s.low));
  sbfi_convert_warn(c, SBF_CODE_IMPORT_GROUND,
      "the character's %s at y = %.3g m and not at 0, where the ground is: all of it was moved by %.3g m",
      c->asset->gaits.at[0].legs.count ? "feet are" : "lowest point is", s.low, -s.low);
  return SBF_OK;
}
