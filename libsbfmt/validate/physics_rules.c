/* What would move wrongly: no mass, a ratio that springs cannot show, too few substeps, a unit that looks
 * wrong. */
#include <math.h>

#include "sbfmt/mechanics.h"
#include "validate/validation.h"

static const double TALLEST_M = 30, SMALLEST_M = 0.005;

static void check_size(sbfi_validation *v) {
  double low = INFINITY, high = -INFINITY;
  for (uint32_t b = 0; b < v->asset->soft_bodies.count; b++) {
    const sbf_vec3_list points = v->asset->soft_bodies.at[b].surface.positions;
    for (uint32_t i = 0; i < points.count; i++) {
      low = fmin(low, fmin((double)points.at[i].x, fmin((double)points.at[i].y, (double)points.at[i].z)));
      high = fmax(high, fmax((double)points.at[i].x, fmax((double)points.at[i].y, (double)points.at[i].z)));
    }
  }
  if (high - low > TALLEST_M || high - low < SMALLEST_M)
    sbfi_found(v, SBF_CODE_UNIT_LOOKS_WRONG, "/sbf", -1,
        "everything together measures %.4g m: was the source in another unit? convert it with --unit",
        high - low);
}

/* Substeps of a control tick below which an explicit scheme gains energy: n > tick * w / 2. */
static void check_substeps(
    sbfi_validation *v, const sbf_soft_body *body, const sbf_level *level, const char *path) {
  uint32_t points = level->positions.count;
  size_t springs = 0, at = 0;
  for (uint32_t s = 0; s < level->springs.count; s++) springs += level->springs.at[s].ends.count;
  if (springs == 0 || level->simulation.substeps == 0 || level->simulation.scheme != SBF_SCHEME_SYMPLECTIC)
    return;
  uint8_t *held = sbfi_arena_allocate(&v->scratch, points, 1);
  float *masses = sbfi_arena_allocate(&v->scratch, points, sizeof *masses);
  float *volumes = sbfi_arena_allocate(&v->scratch, points, sizeof *volumes);
  double *sums = sbfi_arena_allocate(&v->scratch, points, 2 * sizeof *sums);
  float *stiffness = sbfi_arena_allocate(&v->scratch, springs, sizeof *stiffness);
  sbf_uint2 *ends = sbfi_arena_allocate(&v->scratch, springs, sizeof *ends);
  if (!held || !masses || !volumes || !sums || !stiffness || !ends) {
    v->out_of_memory = true;
    return;
  }
  for (uint32_t s = 0; s < level->springs.count; s++)
    for (uint32_t i = 0; i < level->springs.at[s].ends.count; i++)
      ends[at++] = level->springs.at[s].ends.at[i];
  sbf_level_held_points(level, held);
  sbf_level_masses(body, level, held, masses);
  sbf_level_stiffness(body, level, volumes, sums, stiffness);
  sbf_spring_network network = {
      points, (uint32_t)springs, level->positions.at, masses, NULL, ends, stiffness};
  double bound = sbf_network_highest_bound(&network, sums);
  uint32_t needed = (uint32_t)ceil(0.5 * bound * (double)v->asset->environment.control_tick);
  if (level->simulation.substeps < needed)
    sbfi_found(v, SBF_CODE_SUBSTEPS_TOO_FEW, path, -1,
        "%u substeps are asked for and the stiffness of '%s' needs %u", level->simulation.substeps,
        body->name, needed);
}

static void check_body(sbfi_validation *v, const sbf_soft_body *body, uint32_t place) {
  sbfi_path path = sbfi_path_of("/sbf/soft_body[%u]", place + 1);
  sbf_body_measures measures;
  sbf_body_measure(body, &measures);
  if (body->surface.polygon_sizes.count && !(measures.mass > 0))
    sbfi_found(v, SBF_CODE_BODY_NO_MASS, path.text, -1,
        "'%s' has no mass: it encloses nothing and states neither mass nor area density", body->name);
  for (uint32_t l = 0; l < body->levels.count && !v->out_of_memory; l++) {
    sbfi_path level = sbfi_path_of("/sbf/soft_body[%u]/level[%u]", place + 1, l + 1);
    if (body->levels.at[l].model == SBF_ELASTIC_MODEL_SPRINGS && !measures.sheet &&
        fabsf(body->attributes.poisson_ratio - 0.25f) > 0.2f)
      sbfi_found(v, SBF_CODE_POISSON_UNSHOWN, level.text, -1,
          "'%s' asks for a Poisson ratio of %.3g, and central springs show a quarter", body->name,
          (double)body->attributes.poisson_ratio);
    check_substeps(v, body, &body->levels.at[l], level.text);
  }
}

void sbfi_check_physics(sbfi_validation *v) {
  if (v->asset->soft_bodies.count) check_size(v);
  for (uint32_t b = 0; b < v->asset->soft_bodies.count && !v->out_of_memory; b++)
    check_body(v, &v->asset->soft_bodies.at[b], b);
}
