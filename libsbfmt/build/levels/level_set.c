#include "build/levels/level_set.h"

#include <float.h>
#include <math.h>
#include <stdio.h>

#include "build/levels/jiggle_level.h"
#include "build/springs/lattice_springs_level.h"

enum { COARSEST_ELEMENTS = 60, FEWEST_ELEMENTS = 12 };
/* Bodies with a smaller budget are so numerous that they use a rough reference. */
enum { ROUGH_ELEMENTS = 128 };

/* Number of tetrahedra of the reference lattice. */
static uint32_t reference_elements(const sbfi_level_set *l) {
  uint32_t portion = l->recipe->part;
  return portion > 0 && portion < SBFI_REFERENCE_ELEMENTS / 8 ? 8 * portion : SBFI_REFERENCE_ELEMENTS;
}

/* A lattice from this number on is not compared: it is about as fine as the reference. */
static uint32_t fine_elements(const sbfi_level_set *l) {
  return reference_elements(l) / 2;
}

uint32_t sbfi_level_set_lattices(uint32_t levels) {
  return levels >= 4 ? levels - 2 : levels >= 3 ? levels - 1 : levels;
}

void sbfi_level_set_init(sbfi_level_set *set, const sbf_soft_body *body, const sbfi_level_set_recipe *recipe,
    sbf_asset *asset, sbfi_progress progress, const sbf_allocator *allocator) {
  *set = (sbfi_level_set){
      .body = body, .recipe = recipe, .asset = asset, .progress = progress, .allocator = allocator};
}

void sbfi_level_set_free(sbfi_level_set *set) {
  if (set->has_reference) sbfi_reference_free(&set->reference);
}

static bool has_gravity_displacements(const sbfi_level_set *l) {
  return l->recipe->error > 0 || l->recipe->levels > 1;
}

static sbfi_reference_use use_of(const sbfi_level_set *l) {
  bool lattice = l->level_count > 0 && l->levels[0].model == SBF_ELASTIC_MODEL_TETRAHEDRA;
  bool calibrates = l->recipe->calibrate && (lattice || l->recipe->error > 0);
  /* Levels of springs, from the fourth on, are always fitted by pushes. */
  bool pushes =
      !sbfi_surface_is_sparse(l->body) || sbfi_level_set_lattices(l->recipe->levels) + 1 < l->recipe->levels;
  return (sbfi_reference_use){.gravity_displacements = has_gravity_displacements(l),
      .twists = calibrates,
      .pushes = calibrates && pushes,
      .progress = l->progress};
}

static sbfi_lattice_outcome make_reference(sbfi_level_set *l, uint32_t elements) {
  if (l->has_reference) return SBFI_LATTICE_MADE;
  l->has_reference = true;
  const sbfi_reference_use use = use_of(l);
  bool is_rough = elements == 8 * l->recipe->part && l->recipe->part < ROUGH_ELEMENTS;
  return sbfi_reference_make(&l->reference, l->body, elements, is_rough, l->asset, &use, l->allocator);
}

/* Compares the last level with the reference, if any, and removes it if it does not converge or its error
 * is too large, unless it is the finest. */
static sbfi_lattice_outcome measure(
    sbfi_level_set *l, sbf_level *level, const sbfi_interior_map *interior, sbfi_calibration *calibration) {
  if (!sbfi_progress_report(l->progress, 1)) return SBFI_LATTICE_CANCELLED;
  if (!sbfi_level_calibrate(level, l->body, interior, &l->reference, l->recipe->calibrate, l->recipe->tick,
          l->asset, calibration, sbfi_progress_part(l->progress, 0.9, 1), l->allocator))
    return SBFI_LATTICE_NO_MEMORY;
  double load_error = calibration->unsettled ? 0 : sbfi_calibration_max_error(calibration);
  if (!calibration->unsettled && !(load_error > SBFI_MAX_LOAD_ERROR)) return SBFI_LATTICE_MADE;
  uint32_t elements = level->lattice.tetrahedra.count;
  bool is_finest = level == l->levels;
  l->poor[l->poor_count++] = (sbfi_poor_level){elements, load_error, is_finest};
  if (!is_finest) l->level_count--;
  return SBFI_LATTICE_MADE;
}

/* Builds a lattice, without points if there is nothing to fill. */
static sbfi_lattice_outcome make_lattice(
    sbfi_level_set *l, double cell, uint32_t elements, sbf_asset *asset, sbf_level *level) {
  const sbfi_lattice_recipe recipe = {
      .cell = cell, .elements = elements, .derivation = l->recipe->derivation};
  sbfi_lattice_counts counts;
  sbfi_arena scratch;
  sbfi_arena_init(&scratch, l->allocator, 0);
  sbfi_lattice_outcome outcome =
      sbfi_lattice_level_make(level, l->body, &recipe, asset, &counts, l->progress, &scratch);
  sbfi_arena_free(&scratch);
  return outcome;
}

sbfi_lattice_outcome sbfi_level_set_pick(sbfi_level_set *set, uint32_t *elements, bool *reached) {
  sbfi_lattice_outcome outcome = make_reference(set, reference_elements(set));
  *reached = false;
  *elements = reference_elements(set);
  if (outcome != SBFI_LATTICE_MADE || !set->reference.is_valid) return outcome;
  for (uint32_t tried = COARSEST_ELEMENTS; tried < fine_elements(set) && outcome == SBFI_LATTICE_MADE;
       tried *= 4) {
    sbf_level level;
    sbfi_calibration calibration = {.factor = 1};
    /* Trials must not allocate from the asset. */
    sbf_asset *memory = sbf_asset_create(set->allocator);
    if (!memory) return SBFI_LATTICE_NO_MEMORY;
    memory->bones = set->asset->bones;
    memory->rigid_bodies = set->asset->rigid_bodies;
    outcome = make_lattice(set, 0, tried, memory, &level);
    bool some = outcome == SBFI_LATTICE_MADE && level.lattice.tetrahedra.count >= FEWEST_ELEMENTS;
    if (some && !sbfi_level_calibrate(&level, set->body, NULL, &set->reference, false, set->recipe->tick,
                    memory, &calibration, set->progress, set->allocator))
      outcome = SBFI_LATTICE_NO_MEMORY;
    sbf_asset_free(memory);
    if (!some || outcome != SBFI_LATTICE_MADE || calibration.error > set->recipe->error) continue;
    if (!*reached) *elements = tried;
    *reached = true;
    if (sbfi_calibration_max_error(&calibration) > SBFI_MAX_LOAD_ERROR) continue;
    *elements = tried;
    break;
  }
  return outcome;
}

/* Handles the finest level: calibrates it, or makes it the reference. */
static sbfi_lattice_outcome handle_finest(sbfi_level_set *l, const sbfi_interior_map *interior) {
  sbf_level *level = &l->levels[l->level_count++];
  bool lattice = level->model == SBF_ELASTIC_MODEL_TETRAHEDRA;
  bool coarse = lattice && level->lattice.tetrahedra.count < fine_elements(l);
  if (lattice ? coarse && (l->recipe->calibrate || has_gravity_displacements(l)) : l->recipe->calibrate) {
    sbfi_lattice_outcome outcome =
        make_reference(l, lattice ? reference_elements(l) : SBFI_SPRING_REFERENCE_ELEMENTS);
    if (outcome != SBFI_LATTICE_MADE || !l->reference.is_valid || !l->recipe->calibrate) return outcome;
    return measure(l, level, interior, &l->calibrations[0]);
  }
  if (l->recipe->levels < 2 || l->has_reference) return SBFI_LATTICE_MADE;
  l->has_reference = true;
  const sbfi_reference_use use = use_of(l);
  sbfi_lattice_outcome outcome =
      sbfi_reference_from_level(&l->reference, l->body, level, interior, l->asset, &use, l->allocator);
  if (outcome == SBFI_LATTICE_MADE)
    level->simulation.cost =
        (float)fmin(sbfi_level_cost(&l->reference.statics, l->recipe->tick, &l->reference.arena), FLT_MAX);
  return outcome;
}

static sbfi_lattice_outcome add_lattices(sbfi_level_set *l) {
  double cell = l->levels[0].cell;
  uint32_t last = l->levels[0].lattice.tetrahedra.count;
  for (uint32_t n = 2; n <= sbfi_level_set_lattices(l->recipe->levels); n++) {
    sbf_level *level = &l->levels[l->level_count];
    char name[24];
    cell *= 2;
    sbfi_lattice_outcome outcome = make_lattice(l, cell, 0, l->asset, level);
    if (outcome != SBFI_LATTICE_MADE) return outcome;
    uint32_t count = level->lattice.tetrahedra.count;
    if (count < FEWEST_ELEMENTS || count >= last) continue;
    last = count;
    snprintf(name, sizeof name, "lattice %u", n);
    level->name = sbf_asset_copy_text(l->asset, name);
    if (!level->name) return SBFI_LATTICE_NO_MEMORY;
    l->level_count++;
    if (!l->reference.is_valid || !l->recipe->calibrate) continue;
    outcome = measure(l, level, NULL, &l->calibrations[l->level_count - 1]);
    if (outcome != SBFI_LATTICE_MADE) return outcome;
  }
  return SBFI_LATTICE_MADE;
}

/* Adds springs along the edges of a lattice with twice the coarsest one's cell, or if that becomes too
 * small with the same cell. They must be cheaper than the previous level. */
static sbfi_lattice_outcome add_springs(sbfi_level_set *l, sbfi_arena *arena) {
  const sbf_level *coarsest = &l->levels[l->level_count - 1];
  sbf_level *level = &l->levels[l->level_count];
  uint32_t inert;
  sbfi_lattice_outcome outcome = make_lattice(l, 2 * (double)coarsest->cell, 0, l->asset, level);
  if (outcome == SBFI_LATTICE_MADE && level->lattice.tetrahedra.count < COARSEST_ELEMENTS)
    outcome = make_lattice(l, coarsest->cell, 0, l->asset, level);
  if (outcome != SBFI_LATTICE_MADE) return outcome;
  if (!sbfi_lattice_springs_level_make(level, l->body, l->recipe->derivation, l->asset, &inert,
          sbfi_progress_part(l->progress, 0.9, 1), arena))
    return SBFI_LATTICE_NO_MEMORY;
  l->level_count++;
  if (!l->reference.is_valid) return SBFI_LATTICE_MADE;
  return measure(l, level, NULL, &l->calibrations[l->level_count - 1]);
}

static sbfi_lattice_outcome add_jiggle(sbfi_level_set *l) {
  const double turn = 6.283185307179586;
  sbf_level *level = &l->levels[l->level_count];
  double frequency = l->reference.is_valid ? sbfi_reference_frequency(&l->reference) / turn : 0;
  if (!sbfi_jiggle_level_make(level, l->body, frequency, l->recipe->derivation, l->asset))
    return SBFI_LATTICE_NO_MEMORY;
  l->level_count++;
  if (!l->reference.is_valid) return SBFI_LATTICE_MADE;
  return measure(l, level, NULL, &l->calibrations[l->level_count - 1]);
}

sbfi_lattice_outcome sbfi_level_set_make(
    sbfi_level_set *set, const sbf_level *finest, const sbfi_interior_map *interior, sbfi_arena *arena) {
  uint32_t levels = set->recipe->levels;
  set->levels = sbf_asset_allocate(set->asset, levels, sizeof *set->levels);
  if (!set->levels) return SBFI_LATTICE_NO_MEMORY;
  set->levels[0] = *finest;
  sbfi_lattice_outcome outcome = handle_finest(set, interior);
  bool lattice = finest->model == SBF_ELASTIC_MODEL_TETRAHEDRA;
  if (outcome == SBFI_LATTICE_MADE && lattice) outcome = add_lattices(set);
  if (outcome == SBFI_LATTICE_MADE && lattice && levels >= 4) outcome = add_springs(set, arena);
  if (outcome == SBFI_LATTICE_MADE && levels >= (lattice ? 3 : 2)) outcome = add_jiggle(set);
  return outcome;
}
