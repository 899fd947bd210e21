/* Checks physical plausibility: missing mass, impossible materials, Poisson ratios that springs cannot
 * represent, bodies that collapse under their own weight, too few substeps, implausible units. */
#include <stdio.h>

#include "build/geometry/topology.h"
#include "mechanics/plausible_size.h"
#include "sbfmt/mechanics.h"
#include "validate/rules/pose.h"
#include "validate/rules/strain_order.h"
#include "validate/validation.h"

static const double MIN_DENSITY = 0.9, MAX_DENSITY = 30000; /* kg/m^3: air, and above osmium */
static const double MAX_SAG = 10; /* strain under its own weight beyond which a body collapses */

static void check_size(sbfi_validation *v) {
  double size = sbfi_asset_extent(v->asset), scale = sbfi_plausible_scale(size);
  if (scale != 1)
    sbfi_found(v, SBF_CODE_UNIT_LOOKS_WRONG, "/sbf", -1,
        "the whole asset measures %.4g m; scaled by %.4g it would measure %.4g m", size, scale, size * scale);
}

/* The bound on a spring network's angular frequencies needs flat arrays of all sets. */
static void check_substeps(
    sbfi_validation *v, const sbf_soft_body *body, const sbf_level *level, const char *path) {
  uint32_t points = level->positions.count;
  size_t springs = 0, at = 0;
  for (uint32_t s = 0; s < level->springs.count; s++) springs += level->springs.at[s].ends.count;
  if (springs == 0 || level->simulation.substeps == 0 || level->simulation.scheme != SBF_SCHEME_SYMPLECTIC)
    return;
  uint8_t *pinned = sbfi_scratch(v, points, 1);
  float *masses = sbfi_scratch(v, points, sizeof *masses);
  float *volumes = sbfi_scratch(v, points, sizeof *volumes);
  double *sums = sbfi_scratch(v, points, 2 * sizeof *sums);
  float *stiffness = sbfi_scratch(v, springs, sizeof *stiffness);
  sbf_uint2 *ends = sbfi_scratch(v, springs, sizeof *ends);
  if (v->out_of_memory) return;
  for (uint32_t s = 0; s < level->springs.count; s++)
    for (uint32_t i = 0; i < level->springs.at[s].ends.count; i++)
      ends[at++] = level->springs.at[s].ends.at[i];
  sbf_level_pinned_points(level, pinned);
  sbf_level_masses(body, level, pinned, masses);
  sbf_level_stiffness(body, level, volumes, sums, stiffness);
  sbf_spring_network network = {.point_count = points,
      .spring_count = (uint32_t)springs,
      .positions = level->positions.at,
      .masses = masses,
      .ends = ends,
      .stiffness = stiffness};
  double bound = sbf_network_highest_bound(&network, sums);
  /* half a tick times the angular frequency */
  double needed = ceil(0.5 * bound * (double)v->asset->environment.control_tick - 1e-3);
  if ((double)level->simulation.substeps < needed)
    sbfi_found(v, SBF_CODE_SUBSTEPS_TOO_FEW, path, -1,
        "%u substep%s requested, but the stiffness of '%s' needs %.0f", level->simulation.substeps,
        level->simulation.substeps == 1 ? " is" : "s are", sbfi_label(body->name, body->id), needed);
}

static bool is_no_matter(double density) {
  return density < MIN_DENSITY || density > MAX_DENSITY;
}

/* Under gravity a column of height h and density d has a strain of d g h / E at its base. */
static void check_weight(
    sbfi_validation *v, const sbf_soft_body *body, const sbf_body_measures *is, const char *path) {
  sbf_vec3 g = v->asset->environment.gravity;
  double gravity = sqrt((double)g.x * g.x + (double)g.y * g.y + (double)g.z * g.z);
  double height = sbfi_extent(body->surface.positions);
  if (is->sheet || !(is->volume > 0)) return;
  double stress = is->mass / is->volume * gravity * fabs((double)body->attributes.gravity_scale) * height;
  if (stress > MAX_SAG * (double)body->attributes.young_modulus)
    sbfi_found(v, SBF_CODE_BODY_COLLAPSES, path, -1,
        "the weight of '%s' causes a pressure of %.3g Pa, but its Young's modulus is %.3g Pa",
        sbfi_label(body->name, body->id), stress, (double)body->attributes.young_modulus);
}

static void check_pressure(
    sbfi_validation *v, const sbf_soft_body *body, const sbf_body_measures *is, const char *path) {
  sbfi_topology t;
  if (body->attributes.pressure_mode == SBF_PRESSURE_MODE_NONE || body->surface.polygon_sizes.count == 0)
    return;
  if (!sbfi_topology_build(&t, &body->surface, &v->scratch)) {
    v->out_of_memory = true;
    return;
  }
  if (is->sheet || t.boundary_edge_count)
    sbfi_found(v, SBF_CODE_PRESSURE_OPEN, path, -1,
        "the pressure mode of '%s' is %s, but its surface is open", sbfi_label(body->name, body->id),
        sbf_pressure_mode_name(body->attributes.pressure_mode));
}

static void check_attributes(
    sbfi_validation *v, const sbf_soft_body *body, const sbf_body_measures *is, const char *path) {
  const sbf_attributes *a = &body->attributes;
  const char *name = sbfi_label(body->name, body->id);
  sbfi_path attributes = sbfi_path_of("%s/attributes", path);
  if (body->surface.polygon_sizes.count && !(is->mass > 0))
    sbfi_found(v, SBF_CODE_BODY_NO_MASS, path, -1,
        "'%s' encloses no volume and has neither a mass nor an area density", name);
  if (is_no_matter((double)a->density))
    sbfi_found(v, SBF_CODE_DENSITY_LOOKS_WRONG, attributes.text, -1, "the density of '%s' is %.4g kg/m^3",
        name, (double)a->density);
  sbfi_check_strain_order(
      v, &(sbfi_strains){a->strain_min, a->strain_max, a->yield_strain, a->tear_strain}, attributes.text);
  check_weight(v, body, is, path);
  check_pressure(v, body, is, attributes.text);
}

static void check_body(sbfi_validation *v, uint32_t number) {
  const sbf_soft_body *body = &v->asset->soft_bodies.at[number];
  sbfi_path path = sbfi_path_of("/sbf/soft_body[%u]", number + 1);
  sbf_body_measures measures;
  sbf_body_measure(body, &measures);
  check_attributes(v, body, &measures, path.text);
  for (uint32_t l = 0; l < body->levels.count && !v->out_of_memory; l++) {
    const sbf_level *level = &body->levels.at[l];
    sbfi_path there = sbfi_path_of("%s/level[%u]", path.text, l + 1);
    check_substeps(v, body, level, there.text);
  }
}

/* First spring level, from 1, of a body with a Poisson ratio that springs cannot represent; 0: none. */
static uint32_t unshown_level(const sbf_soft_body *body) {
  sbf_body_measures measures;
  if (!(fabsf(body->attributes.poisson_ratio - 0.25f) > 0.2f)) return 0;
  sbf_body_measure(body, &measures);
  for (uint32_t l = 0; l < body->levels.count && !measures.sheet; l++)
    if (body->levels.at[l].model == SBF_ELASTIC_MODEL_SPRINGS) return l + 1;
  return 0;
}

/* Reports only the first body, because a character's sections mostly share one material. */
static void check_poisson(sbfi_validation *v) {
  const sbf_soft_body *first = NULL;
  sbfi_path path = {""};
  char others[40] = "";
  uint32_t count = 0;
  for (uint32_t b = 0; b < v->asset->soft_bodies.count; b++) {
    const sbf_soft_body *body = &v->asset->soft_bodies.at[b];
    uint32_t level = unshown_level(body);
    if (level == 0) continue;
    if (count++ > 0) continue;
    first = body;
    path = sbfi_path_of("/sbf/soft_body[%u]/level[%u]", b + 1, level);
  }
  if (count == 0) return;
  if (count > 1) snprintf(others, sizeof others, " (as do %u more)", count - 1);
  sbfi_found(v, SBF_CODE_POISSON_UNSHOWN, path.text, -1,
      "'%s' has the Poisson ratio %.3g%s, but springs have 0.25", sbfi_label(first->name, first->id),
      (double)first->attributes.poisson_ratio, others);
}

void sbfi_check_physics(sbfi_validation *v) {
  check_size(v);
  check_poisson(v);
  for (uint32_t b = 0; b < v->asset->soft_bodies.count && !v->out_of_memory; b++) check_body(v, b);
  for (uint32_t r = 0; r < v->asset->rigid_bodies.count; r++) {
    const sbf_rigid_body *body = &v->asset->rigid_bodies.at[r];
    if (is_no_matter((double)body->density))
      sbfi_found(v, SBF_CODE_DENSITY_LOOKS_WRONG,
          sbfi_path_of("/sbf/rigid_bodies/rigid_body[%u]", r + 1).text, -1,
          "the density of '%s' is %.4g kg/m^3", sbfi_label(body->name, body->id), (double)body->density);
  }
}
