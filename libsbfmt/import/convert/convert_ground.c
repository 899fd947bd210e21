/* Moves a character onto y = 0 in asset space, whatever the origin of its file. */
#include <math.h>

#include "import/convert/conversion.h"

/* Fraction of the height; a character whose lowest point is this close to y = 0 is not moved. */
static const double STANDS = 0.05;

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

static void lift(const sbf_vec3_list points, double by) {
  sbf_vec3 *at = (sbf_vec3 *)(uintptr_t)points.at; /* the conversion owns the asset */
  for (uint32_t i = 0; i < points.count; i++) at[i].y = (float)((double)at[i].y + by);
}

static void lift_one(const sbf_vec3 *point, double by) {
  lift((sbf_vec3_list){point, 1}, by);
}

static void lift_asset(const sbf_asset *a, double by) {
  for (uint32_t i = 0; i < a->bones.count; i++) lift_one(&a->bones.at[i].head, by);
  for (uint32_t i = 0; i < a->soft_bodies.count; i++) lift(a->soft_bodies.at[i].surface.positions, by);
  for (uint32_t i = 0; i < a->render_meshes.count; i++)
    if (!sbfi_is_of_section(a, a->render_meshes.at[i].mesh.positions))
      lift(a->render_meshes.at[i].mesh.positions, by);
  for (uint32_t i = 0; i < a->ik_chains.count; i++)
    if (a->ik_chains.at[i].has_pole) lift_one(&a->ik_chains.at[i].pole, by);
  for (uint32_t g = 0; g < a->gaits.count; g++)
    for (uint32_t l = 0; l < a->gaits.at[g].legs.count; l++) lift_one(&a->gaits.at[g].legs.at[l].home, by);
}

sbf_status sbfi_stand_on_ground(sbfi_conversion *c) {
  if (c->asset->gaits.count == 0) return SBF_OK; /* without a gait the character may not stand at all */
  span s = span_of(c->asset);
  double height = s.high - s.low;
  if (!(fabs(s.low) > STANDS * height)) return SBF_OK;
  lift_asset(c->asset, -s.low);
  c->lift_m = -s.low;
  sbfi_convert_warn(c, SBF_CODE_IMPORT_GROUND,
      "the character's %s at y = %.3g m and not at 0, where the ground is: all of it was moved by %.3g m",
      c->asset->gaits.at[0].legs.count ? "feet are" : "lowest point is", s.low, -s.low);
  return SBF_OK;
}
