#include "section_budget.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "base/fault.h"
#include "chart/watched_motion.h"
#include "sbfmt/mechanics.h"
#include "sbrun/detail.h"
#include "tune/comparison.h"
#include "tune/decimated_skin.h"

/* Coarsest first; the last is the reference of all. */
static const uint32_t sizes[] = {40, 80, 160};
enum { SIZE_COUNT = sizeof sizes / sizeof *sizes, FINEST = 640 };
/* Maximum error as a fraction of the size; stiffened parts keep the margin that sbfmt tune promises. */
static const double NEAR_FRACTION = 0.01, STIFFENED_FRACTION = 0.008;
static const double MIN_VOLUME = 0.9, MAX_STRAIN = 0.5;
static const double ALIKE = 1.15; /* maximum ratio of volumes of left and right */
/* Factors on the proposed moduli, in turn. */
static const double firmer[] = {1, 1.5, 2, 3};
enum { FIRMER_COUNT = sizeof firmer / sizeof *firmer };
static const double SKIN_VISITS = 2; /* element visits per skin vertex with its normal: 8 to 14 ns */
/* minimum fraction of the budget for soft parts, whatever the skin costs */
static const double SOFT_FRACTION = 0.25;
/* Skins with more vertices are decimated for the trials, so that only the final build costs more. */
enum { DENSE = 32768, DECIMATED = 16384 };

typedef struct candidate {
  uint32_t elements;
  double visits;
  tune_error is;
} candidate;

static bool is_soft(const sbf_section_recipe *recipe) {
  return !recipe->rigid;
}

bool section_budget_applies(const sbf_asset *source, const sbf_build_options *build) {
  uint32_t soft = 0, authored = 0;
  bool sized = build->elements || build->cell_m > 0 || build->error_m > 0 || build->levels > 1;
  for (uint32_t i = 0; i < source->section_recipes.count; i++)
    soft += is_soft(&source->section_recipes.at[i]);
  for (uint32_t i = 0; i < source->soft_bodies.count; i++)
    authored += source->soft_bodies.at[i].derived == SBF_NONE;
  return soft && !sized && !authored && build->interior == SBF_BUILD_INTERIOR_AUTOMATIC &&
         build->sections == SBF_BUILD_SECTIONS_AUTOMATIC;
}

/* Cost of the skin with its normals. */
static double skin_visits_of(const sbf_asset *asset) {
  double skin = 0;
  for (uint32_t i = 0; i < asset->render_meshes.count; i++)
    skin += SKIN_VISITS * asset->render_meshes.at[i].mesh.positions.count;
  return skin;
}

/* Cost of a tick of the whole character with a skin; NAN if the runtime does not support it. */
static double visits_of(const sbf_asset *asset, double skin_visits) {
  sbr_model *model = NULL;
  sbf_diagnostic why;
  sbr_detail_level detail_level;
  if (sbr_model_create(asset, NULL, &model, &why) != SBF_OK) return NAN;
  sbr_model_get_detail_levels(model, &detail_level, 1);
  sbr_model_destroy(model);
  return (double)detail_level.visits + skin_visits;
}

static sbf_status build_one(const sbf_asset *source, const sbf_build_options *build, uint32_t elements,
    sbf_asset **asset, sbf_diagnostic *error) {
  sbf_build_options options = *build;
  options.elements = elements;
  options.report = NULL;
  options.progress = NULL;
  return sbf_build(source, &options, asset, NULL, error);
}

static bool is_firm(const candidate *c) {
  return c->is.min_volume >= MIN_VOLUME && c->is.max_strain <= MAX_STRAIN;
}

static bool is_near(const candidate *c, double size_m, bool is_stiffened) {
  double bound = is_stiffened ? STIFFENED_FRACTION : NEAR_FRACTION;
  return is_firm(c) && c->is.off.p99_m <= bound * size_m;
}

/* Valid shapes take precedence over accuracy. */
static bool is_better(const candidate *c, const candidate *than) {
  if (!than->elements || !than->is.sound) return true;
  if (!c->is.sound || is_firm(c) != is_firm(than)) return c->is.sound && is_firm(c);
  return c->is.off.p99_m < than->is.off.p99_m;
}

static void take(section_budget *choice, const candidate *c, double size_m) {
  choice->elements = c->elements;
  choice->visits = c->visits;
  if (c->is.sound) choice->p99_fraction = c->is.off.p99_m / size_m;
  choice->near = c->is.sound && is_near(c, size_m, choice->firmer > 1);
}

/* Evaluates one number of elements; `*best` is the better of the two. */
static sbf_status try_one(const sbf_asset *built, double visits, uint32_t elements,
    const tune_comparison *comparison, candidate *best, sbf_diagnostic *error) {
  candidate c = {.elements = elements, .visits = visits};
  sbf_status status =
      tune_comparison_measure(comparison, built, &(chart_setting){.level = 0}, NULL, &c.is, error);
  if (status == SBF_OK && is_better(&c, best)) *best = c;
  return status;
}

/* Selects the cheapest from `min_elements` within the budget that is close to the finest, else the best;
 * elements stay 0 if none is within. */
static sbf_status choose_size(const sbf_asset *source, const sbf_build_options *build, uint32_t min_elements,
    section_budget *choice, candidate *chosen, sbf_diagnostic *error) {
  sbf_asset *finest = NULL;
  tune_comparison comparison = {.rest = NULL};
  candidate best = {.elements = 0};
  const tune_measure measure = {.by = TUNE_BY_P99, .may_be_empty = true, .once = true};
  sbf_status status = SBF_OK;
  for (int i = 0; status == SBF_OK && i < SIZE_COUNT && !choice->near; i++) {
    sbf_asset *built = NULL;
    if (sizes[i] < min_elements) continue;
    status = build_one(source, build, sizes[i], &built, error);
    if (status != SBF_OK) break;
    double visits = visits_of(built, choice->skin_visits);
    bool may = visits <= choice->max_visits && built->soft_bodies.count;
    if (may && !finest) {
      status = build_one(source, build, FINEST, &finest, error);
      if (status == SBF_OK) status = tune_comparison_create(&comparison, finest, &measure, error);
    }
    if (status == SBF_OK && may) status = try_one(built, visits, sizes[i], &comparison, &best, error);
    if (status == SBF_OK && best.elements) take(choice, &best, comparison.size_m);
    sbf_asset_free(built);
    if (!may) break; /* finer ones cost more */
  }
  tune_comparison_free(&comparison);
  sbf_asset_free(finest);
  *chosen = best;
  return status;
}

static sbf_section_recipe *recipe_at(sbf_asset *source, uint32_t index) {
  return (sbf_section_recipe *)(uintptr_t)&source->section_recipes.at[index]; /* owned by the caller */
}

/* Two digits, as the conversion proposes moduli. */
static float rounded(double pascals) {
  double unit = pow(10, floor(log10(pascals)) - 1);
  return (float)(round(pascals / unit) * unit);
}

/* Multiplies the moduli that the conversion proposed; requested parts keep theirs. */
static void stiffen(sbf_asset *source, const float *proposed_pa, double factor) {
  for (uint32_t i = 0; i < source->section_recipes.count; i++) {
    sbf_section_recipe *recipe = recipe_at(source, i);
    if (recipe->proposed)
      recipe->attributes.young_modulus =
          factor > 1 ? rounded(factor * (double)proposed_pa[i]) : proposed_pa[i];
  }
}

/* 0: it loses its shape; 1: it keeps it; 2: it is also close to the finest, with or without the margin. */
static int rank_of(const candidate *c, const section_budget *choice) {
  if (!c->is.sound || !is_firm(c)) return 0;
  return choice->p99_fraction <= NEAR_FRACTION ? 2 : 1;
}

/* Where no size is close to the finest, stiffens what was proposed until one is. If that does not help, the
 * first of the best rank remains. */
static sbf_status choose(sbf_asset *source, const sbf_build_options *build, bool may_stiffen,
    section_budget *choice, sbf_diagnostic *error) {
  const section_budget none = *choice;
  section_budget first = none;
  uint32_t count = source->section_recipes.count;
  int rank = -1;
  float *proposed_pa = calloc((size_t)count + 1, sizeof *proposed_pa);
  if (!proposed_pa) return fault_set(error, SBF_CODE_OUT_OF_MEMORY, "memory ran out for moduli");
  for (uint32_t i = 0; i < count; i++)
    proposed_pa[i] = source->section_recipes.at[i].attributes.young_modulus;
  sbf_status status = SBF_OK;
  for (int i = 0; status == SBF_OK && i < (may_stiffen ? FIRMER_COUNT : 1) && !choice->near; i++) {
    candidate chosen;
    *choice = none;
    choice->firmer = firmer[i];
    stiffen(source, proposed_pa, firmer[i]);
    status = choose_size(source, build, first.elements, choice, &chosen, error);
    if (!choice->elements) break; /* nothing is within the budget */
    if (rank_of(&chosen, choice) > rank) first = *choice, rank = rank_of(&chosen, choice);
  }
  if (status == SBF_OK && !choice->near) {
    *choice = first;
    stiffen(source, proposed_pa, first.firmer);
  }
  free(proposed_pa);
  return status;
}

/* Only parts that the conversion proposed: requested parts stay soft. */
static bool may_leave_out(const sbf_asset *source, int32_t bone) {
  for (uint32_t i = source->section_recipes.count; i-- > 0;)
    if (source->section_recipes.at[i].bone == bone)
      return source->section_recipes.at[i].proposed && is_soft(&source->section_recipes.at[i]);
  return false;
}

/* Adds its name to the report. */
static void leave_out(sbf_asset *source, int32_t bone, section_budget *choice) {
  for (uint32_t i = 0; i < source->section_recipes.count; i++)
    if (recipe_at(source, i)->bone == bone) recipe_at(source, i)->rigid = true;
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

/* Makes the smallest section rigid, with those of similar size such as left and right; false if there is
 * none. */
static bool leave_out_smallest(sbf_asset *source, const sbf_asset *built, section_budget *choice) {
  double min = INFINITY;
  uint32_t before = choice->left_out;
  for (uint32_t i = 0; i < built->soft_bodies.count; i++)
    if (may_leave_out(source, built->soft_bodies.at[i].bone))
      min = fmin(min, volume_of(&built->soft_bodies.at[i]));
  for (uint32_t i = 0; i < built->soft_bodies.count; i++) {
    const sbf_soft_body *body = &built->soft_bodies.at[i];
    if (may_leave_out(source, body->bone) && volume_of(body) <= ALIKE * min)
      leave_out(source, body->bone, choice);
  }
  return choice->left_out > before;
}

/* Makes parts rigid until the coarsest choice fits. */
static sbf_status fit(
    sbf_asset *source, const sbf_build_options *build, section_budget *choice, sbf_diagnostic *error) {
  choice->elements = sizes[0];
  for (;;) {
    sbf_asset *built = NULL;
    sbf_status status = build_one(source, build, choice->elements, &built, error);
    if (status != SBF_OK) return status;
    choice->visits = visits_of(built, choice->skin_visits);
    const uint32_t soft = built->soft_bodies.count;
    bool done = choice->visits <= choice->max_visits || !leave_out_smallest(source, built, choice);
    sbf_asset_free(built);
    if (!soft && !choice->left_out) choice->elements = 0; /* nothing is cut */
    if (done) return SBF_OK;
  }
}

sbf_status section_budget_choose(sbf_asset *source, const sbf_build_options *build, double budget_us,
    bool may_stiffen, section_budget *choice, sbf_diagnostic *error) {
  const double budget = 1e3 * budget_us / SECTION_BUDGET_NS_PER_VISIT, skin = skin_visits_of(source);
  *choice = (section_budget){.skin_visits = skin,
      .max_visits = fmax(budget, skin + SOFT_FRACTION * budget),
      .exceeds = skin + SOFT_FRACTION * budget > budget,
      .finest = FINEST,
      .firmer = 1,
      .p99_fraction = NAN};
  sbf_asset *coarse = tune_count_vertices(source) > DENSE ? tune_decimate_skins(source, DECIMATED) : source;
  if (!coarse) return fault_set(error, SBF_CODE_OUT_OF_MEMORY, "memory ran out for a coarser skin");
  /* It shares the recipes with the source. */
  sbf_status status = choose(coarse, build, may_stiffen, choice, error);
  if (status == SBF_OK && !choice->elements) status = fit(coarse, build, choice, error);
  if (coarse != source) sbf_asset_free(coarse);
  for (uint32_t i = 0; status == SBF_OK && i < source->section_recipes.count; i++) {
    bool soft = is_soft(recipe_at(source, i));
    recipe_at(source, i)->elements = soft ? choice->elements : 0;
    choice->soft += soft;
  }
  return status;
}

static bool is_chosen(const sbf_asset *asset) {
  for (uint32_t i = 0; i < asset->section_recipes.count; i++)
    if (asset->section_recipes.at[i].elements) return true;
  return false;
}

void section_budget_state_costs(sbf_asset *built) {
  sbr_model *model = NULL;
  sbf_diagnostic why;
  const chart_setting setting = {.level = 0};
  if (!is_chosen(built) || sbr_model_create(built, NULL, &model, &why) != SBF_OK) return;
  for (uint32_t i = 0; i < built->soft_bodies.count; i++) {
    const sbf_soft_body *body = &built->soft_bodies.at[i];
    double cost = chart_body_visits(model, built, i, &setting);
    sbf_level *level = (sbf_level *)(uintptr_t)body->levels.at; /* owned by the build */
    if (body->derived != SBF_NONE && body->levels.count && isfinite(cost))
      level->simulation.cost = (float)cost;
  }
  sbr_model_destroy(model);
}
