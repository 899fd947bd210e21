#include "section_budget.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

#include "chart/watched_motion.h"
#include "render/fault.h"
#include "sbfmt/mechanics.h"
#include "sbrun/detail.h"
#include "tune/yardstick.h"

/* Coarsest first; the finest that all are measured against. */
static const uint32_t sizes[] = {40, 80, 160};
enum { SIZE_COUNT = sizeof sizes / sizeof *sizes, FINEST = 640 };
static const double NEAR_FRACTION = 0.01, MIN_VOLUME = 0.9, MAX_STRAIN = 0.5;
static const double ALIKE = 1.15;    /* ratio of volumes of left and right */
static const double SKIN_VISITS = 2; /* that the skin takes for a vertex, with its normal: 8 to 14 ns */

typedef struct candidate {
  sbf_asset *asset; /* NULL: it could not be built */
  double visits;
  tune_error is;
} candidate;

static bool is_soft(const sbf_section_recipe *recipe) {
  return !recipe->rigid;
}

bool section_budget_applies(const sbf_asset *source, const sbf_build_options *build) {
  uint32_t soft = 0;
  bool sized = build->elements || build->cell_m > 0 || build->error_m > 0 || build->levels > 1;
  for (uint32_t i = 0; i < source->section_recipes.count; i++)
    soft += is_soft(&source->section_recipes.at[i]);
  return soft && !sized && !source->soft_bodies.count && build->interior == SBF_BUILD_INTERIOR_AUTOMATIC &&
         build->sections == SBF_BUILD_SECTIONS_AUTOMATIC;
}

/* Of a tick of the whole character, with its skin; NAN where the runtime refuses it. */
static double visits_of(const sbf_asset *asset) {
  sbr_model *model = NULL;
  sbf_diagnostic why;
  sbr_detail_level detail_level;
  double skin = 0;
  if (sbr_model_create(asset, &(sbr_model_options){.level = 0}, &model, &why) != SBF_OK) return NAN;
  sbr_model_get_detail_levels(model, &detail_level, 1);
  sbr_model_destroy(model);
  for (uint32_t i = 0; i < asset->render_meshes.count; i++)
    skin += SKIN_VISITS * asset->render_meshes.at[i].mesh.positions.count;
  return (double)detail_level.visits + skin;
}

static sbf_status build_one(const sbf_asset *source, const sbf_build_options *build, uint32_t elements,
    sbf_asset **asset, sbf_diagnostic *error) {
  sbf_build_options options = *build;
  options.elements = elements;
  options.report = NULL;
  options.progress = NULL;
  return sbf_build(source, &options, asset, NULL, error);
}

static bool is_near(const candidate *c, double size_m) {
  return c->is.sound && c->is.off.p99_m <= NEAR_FRACTION * size_m && c->is.min_volume >= MIN_VOLUME &&
         c->is.max_strain <= MAX_STRAIN;
}

static void take(section_budget *choice, const candidate *c, uint32_t elements, double size_m) {
  choice->elements = elements;
  choice->visits = c->visits;
  choice->p99_fraction = c->is.off.p99_m / size_m;
  choice->near = is_near(c, size_m);
}

/* The cheapest that is near, else the nearest, of what the budget allows; false: it allows none. */
static bool choose(const candidate *all, const tune_yardstick *yard, section_budget *choice) {
  int best = -1;
  for (int i = 0; i < SIZE_COUNT; i++) {
    const candidate *c = &all[i];
    if (!c->asset || !c->is.sound || !(c->visits <= choice->max_visits)) continue;
    if (is_near(c, yard->size_m)) {
      best = i;
      break;
    }
    if (best < 0 || c->is.off.p99_m < all[best].is.off.p99_m) best = i;
  }
  if (best >= 0) take(choice, &all[best], sizes[best], yard->size_m);
  return best >= 0;
}

static sbf_status measure(
    const sbf_asset *finest, candidate *all, section_budget *choice, bool *chosen, sbf_diagnostic *error) {
  tune_yardstick yard;
  const tune_measure measure = {.by = TUNE_BY_P99, .may_be_empty = true};
  sbf_status status = tune_yardstick_make(&yard, finest, &measure, error);
  for (int i = 0; status == SBF_OK && i < SIZE_COUNT; i++)
    if (all[i].asset)
      status =
          tune_yardstick_hold(&yard, all[i].asset, &(chart_setting){.level = 0}, NULL, &all[i].is, error);
  *chosen = status == SBF_OK && choose(all, &yard, choice);
  tune_yardstick_free(&yard);
  return status;
}

/* Its name goes to what is reported. */
static void leave_out(sbf_asset *source, int32_t bone, section_budget *choice) {
  for (uint32_t i = 0; i < source->section_recipes.count; i++) {
    sbf_section_recipe *recipe =
        (sbf_section_recipe *)(uintptr_t)&source->section_recipes.at[i]; /* the caller's */
    if (recipe->bone == bone) recipe->rigid = true;
  }
  size_t length = strlen(choice->names);
  snprintf(choice->names + length, sizeof choice->names - length, "%s%.40s", length ? ", " : "",
      source->bones.at[bone].name);
  choice->left_out++;
}

static double volume_of(const sbf_soft_body *body) {
  sbf_body_measures is;
  sbf_body_measure(body, &is);
  return fabs(is.volume);
}

/* The smallest section becomes rigid, and those of about its size, as left and right; false: there is none.
 */
static bool leave_out_smallest(sbf_asset *source, const sbf_asset *built, section_budget *choice) {
  double min = INFINITY;
  for (uint32_t i = 0; i < built->soft_bodies.count; i++)
    min = fmin(min, volume_of(&built->soft_bodies.at[i]));
  for (uint32_t i = 0; i < built->soft_bodies.count; i++)
    if (volume_of(&built->soft_bodies.at[i]) <= ALIKE * min)
      leave_out(source, built->soft_bodies.at[i].bone, choice);
  return built->soft_bodies.count > 0;
}

/* The finest within the budget; where none is, parts become rigid until the coarsest of all fits. */
static sbf_status fit(sbf_asset *source, const sbf_build_options *build, const candidate *all,
    section_budget *choice, sbf_diagnostic *error) {
  for (int i = SIZE_COUNT; i-- > 0;)
    if (all[i].visits <= choice->max_visits) {
      choice->elements = sizes[i], choice->visits = all[i].visits;
      return SBF_OK;
    }
  choice->elements = sizes[0];
  for (;;) {
    sbf_asset *built = NULL;
    sbf_status status = build_one(source, build, choice->elements, &built, error);
    if (status != SBF_OK) return status;
    choice->visits = visits_of(built);
    bool done = choice->visits <= choice->max_visits || !leave_out_smallest(source, built, choice);
    sbf_asset_free(built);
    if (done) return SBF_OK;
  }
}

sbf_status section_budget_choose(sbf_asset *source, const sbf_build_options *build, double budget_us,
    section_budget *choice, sbf_diagnostic *error) {
  candidate all[SIZE_COUNT] = {{.asset = NULL}};
  sbf_asset *finest = NULL;
  bool chosen = false;
  *choice = (section_budget){
      .max_visits = 1e3 * budget_us / SECTION_BUDGET_NS_PER_VISIT, .finest = FINEST, .p99_fraction = NAN};
  sbf_status status = build_one(source, build, FINEST, &finest, error);
  for (int i = 0; status == SBF_OK && i < SIZE_COUNT; i++) {
    status = build_one(source, build, sizes[i], &all[i].asset, error);
    if (status == SBF_OK) all[i].visits = visits_of(all[i].asset);
  }
  if (status == SBF_OK && finest->soft_bodies.count) status = measure(finest, all, choice, &chosen, error);
  if (status == SBF_OK && !chosen) status = fit(source, build, all, choice, error);
  for (int i = 0; i < SIZE_COUNT; i++) sbf_asset_free(all[i].asset);
  sbf_asset_free(finest);
  return status;
}

void section_budget_state_costs(sbf_asset *built) {
  sbr_model *model = NULL;
  sbf_diagnostic why;
  const chart_setting setting = {.level = 0};
  if (sbr_model_create(built, &(sbr_model_options){.level = 0}, &model, &why) != SBF_OK) return;
  for (uint32_t i = 0; i < built->soft_bodies.count; i++) {
    double cost = chart_body_visits(model, built, i, &setting);
    sbf_level *level = (sbf_level *)(uintptr_t)built->soft_bodies.at[i].levels.at; /* the build's own */
    if (built->soft_bodies.at[i].levels.count && isfinite(cost)) level->simulation.cost = (float)cost;
  }
  sbr_model_destroy(model);
}
