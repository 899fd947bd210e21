/* The ground: in asset space a character stands on y = 0 at the origin, wherever its file has it. */
#include <math.h>

#include "import/convert/conversion.h"
#include "import/gait/locomotion.h"

/* Share of the height within which a character is taken to stand on y = 0 as it is. */
static const double STANDS = 0.05;
/* Of the height: beyond it the middle is aside of x = 0, which parts left from right. */
static const double SIDE = 0.02;
/* Of the height: so near are the middles of bones and skin to each other. */
static const double ALIKE = 0.01;

typedef struct span {
  double low, high;
} span;

static void see(span *s, const sbf_vec3_list points) {
  for (uint32_t i = 0; i < points.count; i++) {
    s->low = fmin(s->low, (double)points.at[i].y);
    s->high = fmax(s->high, (double)points.at[i].y);
  }
}

static span span_of(const sbf_asset *a) {
  span s = {INFINITY, -INFINITY};
  for (uint32_t i = 0; i < a->soft_bodies.count; i++) see(&s, a->soft_bodies.at[i].surface.positions);
  for (uint32_t i = 0; i < a->render_meshes.count; i++) see(&s, a->render_meshes.at[i].mesh.positions);
  if (s.low <= s.high) return s;
  for (uint32_t i = 0; i < a->bones.count; i++) see(&s, (sbf_vec3_list){&a->bones.at[i].head, 1});
  return s;
}

static void move(const sbf_vec3_list points, const double by[3]) {
  sbf_vec3 *at = (sbf_vec3 *)(uintptr_t)points.at; /* the asset is ours until it is handed out */
  for (uint32_t i = 0; i < points.count; i++)
    at[i] = (sbf_vec3){
        (float)((double)at[i].x + by[0]), (float)((double)at[i].y + by[1]), (float)((double)at[i].z + by[2])};
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

/* What the passes to come put into asset space is moved too. */
static void move_matrix(sbfi_matrix *m, const double by[3]) {
  for (int k = 0; k < 3; k++) m->at[k][3] += by[k];
}

static double along(const sbf_bone *bone, int axis) {
  return axis ? (double)bone->head.z : (double)bone->head.x;
}

/* The middle along x or z, where that of the bones is that of the skin and a bone lies in it; NAN where not,
 * as in what holds a spear. */
static double middle_of(const sbf_asset *a, const sbfi_rig_points *points, int axis) {
  double low = INFINITY, high = -INFINITY, near = ALIKE * (points->high[1] - points->low[1]);
  bool has_spine = false;
  for (uint32_t i = 0; i < a->bones.count; i++) {
    low = fmin(low, along(&a->bones.at[i], axis));
    high = fmax(high, along(&a->bones.at[i], axis));
  }
  double skin = (points->low[axis] + points->high[axis]) / 2, bones = (low + high) / 2;
  for (uint32_t i = 0; i < a->bones.count; i++)
    has_spine |= fabs(along(&a->bones.at[i], axis) - bones) < near;
  return has_spine && fabs(skin - bones) < near ? bones : NAN;
}

sbf_status sbfi_stand_at_origin(sbfi_conversion *c) {
  const sbf_asset *a = c->asset;
  sbfi_rig_points points;
  if (a->bones.count == 0 || a->gaits.count || a->chains.count || a->ik_chains.count) return SBF_OK;
  if (!sbfi_gather_points(a, 0, &c->scratch, &points)) return sbfi_convert_no_memory(c);
  double x = middle_of(a, &points, 0), z = middle_of(a, &points, 2);
  bool aside = fabs(x) > SIDE * (points.high[1] - points.low[1]);
  bool away = fabs(z) > (points.high[2] - points.low[2]) / 2;
  const double by[3] = {aside ? -x : 0, 0, away ? -z : 0};
  if (!aside && !away) return SBF_OK;
  move_asset(a, by);
  move_matrix(&c->to_asset, by);
  move_matrix(&c->rig_to_asset, by);
  sbfi_convert_warn(c, SBF_CODE_IMPORT_GROUND,
      "the character stands at x = %.3g m, z = %.3g m and not at the origin: all of it was moved there",
      aside ? x : 0, away ? z : 0);
  return SBF_OK;
}

sbf_status sbfi_stand_on_ground(sbfi_conversion *c) {
  if (c->asset->gaits.count == 0) return SBF_OK; /* nothing says that it stands at all */
  span s = span_of(c->asset);
  double height = s.high - s.low;
  if (!(fabs(s.low) > STANDS * height)) return SBF_OK;
  move_asset(c->asset, (double[3]){0, -s.low, 0});
  c->lift_m = -s.low;
  sbfi_convert_warn(c, SBF_CODE_IMPORT_GROUND,
      "the character's %s at y = %.3g m and not at 0, where the ground is: all of it was moved by %.3g m",
      c->asset->gaits.at[0].legs.count ? "feet are" : "lowest point is", s.low, -s.low);
  return SBF_OK;
}
