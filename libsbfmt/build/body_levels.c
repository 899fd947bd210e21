#include "build/body_levels.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

#include "build/body_interior.h"
#include "build/embed/embedder.h"
#include "build/equal_bodies.h"
#include "build/lattice/lattice_level.h"
#include "build/lattice/region_level.h"
#include "build/level_findings.h"
#include "build/sections/level_pins.h"
#include "build/sections/section_level.h"

enum { MAX_BRUTE_POINTS = 4096, MIN_FRACTION = 100, MAX_REFINED = 3 };
static const double MAX_EMBEDDING_ERROR =
    1e-3; /* fraction of a body's size: maximum error of an embedded point */
static const double MAX_ELEMENTS = 1 << 24,
                    ELEMENTS_OF_CELL = 12; /* for all bodies; for a cube of one cell */

/* Progress of a part of the work on one body's levels. */
static sbfi_progress stretch_of_body(sbfi_build *b, uint32_t number) {
  uint32_t count = b->asset->soft_bodies.count;
  return sbfi_build_stretch(b, "levels", 0.2 + 0.4 * number / count, 0.2 + 0.4 * (number + 1) / count);
}

static void warn_of_attachments(sbfi_build *b, uint32_t body) {
  for (uint32_t i = 0; i < b->bodies[body].attachments.count; i++) {
    const sbf_attachment *rule = &b->bodies[body].attachments.at[i];
    if (rule->rule != SBF_ATTACHMENT_RULE_INSIDE_HULL || b->asset->rigid_bodies.at[rule->rigid_body].hull)
      continue;
    sbf_diagnostic diagnostic;
    sbfi_diagnose(&diagnostic, SBF_CODE_ATTACHMENT_NO_HULL,
        "rigid body \"%s\" has no hull, so no point is inside it",
        b->asset->rigid_bodies.at[rule->rigid_body].name);
    snprintf(diagnostic.path, sizeof diagnostic.path, "/sbf/soft_body[%u]/attachments/attachment[%u]",
        body + 1, i + 1);
    sbfi_report(&b->reporter, &diagnostic);
  }
}

static void set_only_level(sbfi_build *b, uint32_t number, const sbf_level *level, uint32_t pins) {
  b->bodies[number].levels = (sbf_level_list){level, 1};
  b->made[number] = true;
  b->report.bodies++;
  b->report.pins += pins;
}

static bool make_springs(sbfi_build *b, uint32_t number, sbf_build_interior interior, sbfi_arena *scratch) {
  sbf_soft_body *body = &b->bodies[number];
  static const sbfi_spring_interior interiors[] = {[SBF_BUILD_INTERIOR_CENTROID] = SBFI_INTERIOR_CENTROID,
      [SBF_BUILD_INTERIOR_NONE] = SBFI_INTERIOR_NONE,
      [SBF_BUILD_INTERIOR_LATTICE] = SBFI_INTERIOR_LATTICE,
      [SBF_BUILD_INTERIOR_BRUTE] = SBFI_INTERIOR_BRUTE};
  sbfi_spring_recipe recipe = {interiors[interior], b->options.cell_m, !b->options.without_flexion,
      SBFI_BUILD_DERIVATION, stretch_of_body(b, number)};
  sbfi_spring_counts counts;
  sbf_level *level = sbf_asset_allocate(b->asset, 1, sizeof *level);
  sbfi_interior_map *map = &b->maps[number];
  if (!level || !sbfi_spring_level_make(level, body, &recipe, b->asset, map, &counts, scratch)) return false;
  if (map->polygon_points) {
    map->polygon_points = sbfi_arena_copy(
        &b->scratch, map->polygon_points, body->surface.polygon_sizes.count, sizeof *map->polygon_points);
    if (!map->polygon_points) return false;
  }
  set_only_level(b, number, level, counts.pins);
  b->report.interior_points += counts.interior_points;
  b->report.inert_springs += counts.inert;
  for (int kind = 0; kind < SBF_SPRING_KIND_COUNT; kind++) b->report.springs[kind] += counts.springs[kind];
  return true;
}

static void add_quality(sbf_build_lattices *all, const sbf_lattice_measures *of) {
  bool first = all->max_dihedral_deg == 0;
  if (first || of->min_dihedral_deg < all->min_dihedral_deg) all->min_dihedral_deg = of->min_dihedral_deg;
  if (of->max_dihedral_deg > all->max_dihedral_deg) all->max_dihedral_deg = of->max_dihedral_deg;
  for (int i = 0; i < SBF_DIHEDRAL_BINS; i++) all->dihedrals[i] += of->dihedrals[i];
  all->volume += of->volume;
}

static sbf_status outcome_status(sbfi_build *b, uint32_t number, sbfi_lattice_outcome outcome) {
  switch (outcome) {
  case SBFI_LATTICE_NO_MEMORY:
    return sbfi_build_no_memory(b);
  case SBFI_LATTICE_CANCELLED:
    return sbfi_build_no_memory(b);
  case SBFI_LATTICE_TOO_FINE:
    return sbfi_build_report_of_body(b, number, SBF_CODE_LATTICE_TOO_FINE,
        "a lattice with this cell size in soft body \"%s\" would have more than 2^28 nodes: use a larger "
        "cell",
        b->bodies[number].name);
  case SBFI_LATTICE_MADE:
    break;
  }
  return SBF_OK;
}

static void record_calibration(sbf_build_calibration *of, const sbfi_calibration *c) {
  if (of->count == 0 || c->min < of->min_factor) of->min_factor = c->min;
  if (c->max > of->max_factor) of->max_factor = c->max;
  if (c->residual > of->max_residual) of->max_residual = c->residual;
  of->count++;
}

static void record_lattice_calibration(sbf_build_calibration *of, const sbfi_calibration *c) {
  record_calibration(of, c);
  if (fabs(c->period_error) > of->max_period_error) of->max_period_error = fabs(c->period_error);
}

/* Builds the coarser levels of a body whose finest is complete, and assesses them. */
static sbf_status make_level_set(
    sbfi_build *b, uint32_t number, sbfi_level_set *set, sbfi_level_findings *findings) {
  sbf_soft_body *body = &b->bodies[number];
  const sbfi_interior_map *map = &b->maps[number];
  bool of_springs = body->levels.at[0].model == SBF_ELASTIC_MODEL_SPRINGS;
  sbf_status status = outcome_status(
      b, number, sbfi_level_set_make(set, body->levels.at, of_springs ? map : NULL, &b->scratch));
  if (status != SBF_OK) return status;
  findings->can_rotate = set->has_reference && set->reference.statics.can_rotate;
  findings->poor_count = set->poor_count;
  memcpy(findings->poor, set->poor, sizeof findings->poor);
  body->levels = (sbf_level_list){set->levels, set->level_count};
  b->report.levels += set->level_count - 1;
  for (uint32_t l = 0; l < set->level_count; l++) {
    if (!set->levels[l].calibration) continue;
    if (set->levels[l].model == SBF_ELASTIC_MODEL_TETRAHEDRA)
      record_lattice_calibration(&b->report.lattice_calibration, &set->calibrations[l]);
    else
      record_calibration(&b->report.spring_calibration, &set->calibrations[l]);
  }
  return SBF_OK;
}

/* Finds points of polygons that valid weights do not embed at their position: a coarse lattice misses spikes,
 * which would then be drawn elsewhere. */
static bool find_missed(bool *missed, const sbf_soft_body *body, const sbf_level *level, sbfi_build *b) {
  const sbf_u32_list *corners = &body->surface.polygon_points;
  sbfi_embedder embedder;
  sbfi_arena own;
  *missed = false;
  sbfi_arena_init(&own, &b->scratch.allocator, 0);
  bool good = sbfi_embedder_make(&embedder, SBFI_EMBEDS_VERTICES, body, level, NULL, UINT32_MAX, &own);
  for (uint32_t i = 0; good && !*missed && i < corners->count; i++)
    *missed = (double)embedder.in_lattice[corners->at[i]].error > MAX_EMBEDDING_ERROR * embedder.size;
  sbfi_arena_free(&own);
  return good;
}

/* Refines if the size is automatic and the lattice would miss a part of the surface. */
static sbf_status make_lattice(sbfi_build *b, uint32_t number, sbfi_lattice_recipe recipe, sbf_level *level,
    sbfi_lattice_counts *counts, sbfi_level_set *set, sbfi_arena *scratch) {
  bool sized = recipe.cell > 0 || recipe.elements > 0;
  for (int round = 0;; round++) {
    bool missed = false;
    sbf_status status = outcome_status(b, number,
        sbfi_lattice_level_make(
            level, &b->bodies[number], &recipe, b->asset, counts, set->progress, scratch));
    if (status != SBF_OK || sized || round == MAX_REFINED || counts->tetrahedra == 0) return status;
    if (!find_missed(&missed, &b->bodies[number], level, b)) return sbfi_build_no_memory(b);
    if (!missed) return SBF_OK;
    recipe.elements = 4 * counts->tetrahedra;
  }
}

static sbf_status make_tetrahedra(
    sbfi_build *b, uint32_t number, sbfi_level_set *set, sbfi_level_findings *findings, sbfi_arena *scratch) {
  const sbf_soft_body *body = &b->bodies[number];
  sbfi_lattice_recipe recipe = {.cell = b->options.cell_m,
      .elements = b->options.elements,
      .max = b->usual_elements,
      .derivation = SBFI_BUILD_DERIVATION};
  sbfi_lattice_counts counts;
  sbf_level *level = sbf_asset_allocate(b->asset, 1, sizeof *level);
  if (!level) return sbfi_build_no_memory(b);
  if (b->options.error_m > 0) {
    bool reached;
    recipe.cell = 0;
    sbf_status status = outcome_status(b, number, sbfi_level_set_pick(set, &recipe.elements, &reached));
    if (status != SBF_OK) return status;
    if (!reached) findings->missed_elements = recipe.elements;
  }
  sbf_status status = make_lattice(b, number, recipe, level, &counts, set, scratch);
  if (status != SBF_OK) return status;
  if (counts.tetrahedra == 0) {
    sbfi_build_report_of_body(b, number, SBF_CODE_LATTICE_EMPTY,
        "soft body \"%s\" encloses no volume that a lattice with cells of %.4g m could fill: springs over "
        "its surface are built instead",
        body->name, (double)level->cell);
    return make_springs(b, number, SBF_BUILD_INTERIOR_NONE, scratch) ? SBF_OK : sbfi_build_no_memory(b);
  }
  findings->thinness = counts.thinness;
  findings->cell = (double)level->cell;
  set_only_level(b, number, level, counts.pins);
  b->report.lattices.tetrahedra += counts.tetrahedra;
  b->report.lattices.thickened_points += counts.thickened;
  add_quality(&b->report.lattices, &counts.quality);
  return SBF_OK;
}

/* A lattice as for tetrahedra, then regions of its points in place of them. */
static sbf_status make_regions(
    sbfi_build *b, uint32_t number, sbfi_level_set *set, sbfi_level_findings *findings, sbfi_arena *scratch) {
  sbf_status status = make_tetrahedra(b, number, set, findings, scratch);
  const sbf_soft_body *body = &b->bodies[number];
  if (status != SBF_OK || !b->made[number] || body->levels.at[0].model != SBF_ELASTIC_MODEL_TETRAHEDRA)
    return status;
  /* The level belongs to the asset and was created here. */
  sbf_level *level = (sbf_level *)(uintptr_t)body->levels.at;
  return sbfi_region_level_make(level, body, b->asset, scratch) ? SBF_OK : sbfi_build_no_memory(b);
}

/* Number set by the options, else by the recipe of a section; 0: neither. */
static uint32_t elements_of(const sbfi_build *b, const sbf_soft_body *body) {
  bool is_cut = body->derived != SBF_NONE && b->options.interior == SBF_BUILD_INTERIOR_AUTOMATIC;
  if (b->options.elements || !is_cut) return b->options.elements;
  const sbf_section_recipe *recipe = sbfi_section_recipe_find(b->asset, body->bone);
  return recipe ? recipe->elements : 0;
}

/* A section that was cut here. If it encloses no volume, as a sheet, springs to its centre support it. */
static sbf_status make_section(sbfi_build *b, uint32_t number, sbfi_arena *scratch) {
  const sbf_soft_body *body = &b->bodies[number];
  const sbfi_section_recipe recipe = {b->options.cell_m, elements_of(b, body), SBFI_BUILD_DERIVATION};
  sbfi_section_counts counts;
  sbf_level *level = sbf_asset_allocate(b->asset, 1, sizeof *level);
  if (!level) return sbfi_build_no_memory(b);
  sbf_status status = outcome_status(b, number,
      sbfi_section_level_make(level, body, &recipe, b->asset, &counts, stretch_of_body(b, number), scratch));
  if (status != SBF_OK) return status;
  if (counts.points == 0)
    return make_springs(b, number, SBF_BUILD_INTERIOR_CENTROID, scratch) ? SBF_OK : sbfi_build_no_memory(b);
  set_only_level(b, number, level, counts.pins);
  b->report.interior_points += counts.points;
  b->report.springs[SBF_SPRING_KIND_INTERNAL] += counts.springs;
  b->report.inert_springs += counts.inert;
  return SBF_OK;
}

static sbf_status make_level(sbfi_build *b, uint32_t number, sbfi_level_findings *findings) {
  sbfi_arena scratch;
  sbf_build_interior interior = sbfi_body_interior(&b->options, &b->bodies[number]);
  sbfi_arena_init(&scratch, &b->scratch.allocator, 0);
  sbf_status status = SBF_OK;
  const sbf_build_options *o = &b->options;
  bool is_sized = o->cell_m > 0 || o->error_m > 0 || elements_of(b, &b->bodies[number]) > 0;
  const sbfi_level_set_recipe recipe = {.levels = o->levels > 1 ? o->levels : 1,
      .error = o->error_m,
      .calibrate = !o->without_calibration && sbfi_body_is_calibrated(&b->bodies[number], interior),
      .tick = (double)b->asset->environment.control_tick,
      .part = is_sized ? 0 : b->usual_elements,
      .derivation = SBFI_BUILD_DERIVATION};
  sbfi_level_set set;
  sbfi_level_set_init(
      &set, &b->bodies[number], &recipe, b->asset, stretch_of_body(b, number), &b->scratch.allocator);
  if (interior == SBF_BUILD_INTERIOR_BRUTE && b->bodies[number].surface.positions.count > MAX_BRUTE_POINTS)
    status = sbfi_build_report_of_body(b, number, SBF_CODE_INTERIOR_TOO_MANY,
        "soft body \"%s\" has more than %d points, too many for springs between all of them: use another "
        "method",
        b->bodies[number].name, MAX_BRUTE_POINTS);
  else if (interior == SBF_BUILD_INTERIOR_TETRAHEDRA)
    status = make_tetrahedra(b, number, &set, findings, &scratch);
  else if (interior == SBF_BUILD_INTERIOR_SHAPE_MATCHING)
    status = make_regions(b, number, &set, findings, &scratch);
  else if (interior == SBF_BUILD_INTERIOR_AUTOMATIC)
    status = make_section(b, number, &scratch);
  else if (!make_springs(b, number, interior, &scratch))
    status = sbfi_build_no_memory(b);
  bool alone = b->bodies[number].levels.count &&
               b->bodies[number].levels.at[0].model == SBF_ELASTIC_MODEL_SHAPE_MATCHING;
  if (status == SBF_OK && b->made[number] && !alone) status = make_level_set(b, number, &set, findings);
  if (status == SBF_OK) sbfi_level_findings_report(b, number, findings);
  sbfi_level_set_free(&set);
  sbfi_arena_free(&scratch);
  return status;
}

/* Levels of bodies that others may equal. */
typedef struct made_levels {
  sbf_build_report before, after;
  sbfi_level_findings findings;
} made_levels;

/* A body that equals an earlier one gets that one's levels, translated. */
static sbf_status make_or_repeat(
    sbfi_build *b, uint32_t number, sbfi_equal_bodies *all, const made_levels **made) {
  sbf_soft_body *body = &b->bodies[number];
  sbfi_d3 offset;
  uint32_t other = sbfi_equal_bodies_find(all, number, &offset);
  if (other != UINT32_MAX) {
    if (!sbfi_levels_moved(&body->levels, &b->bodies[other].levels, offset, b->asset))
      return sbfi_build_no_memory(b);
    b->made[number] = true;
    sbfi_level_counts_repeat(&b->report, &made[other]->before, &made[other]->after);
    sbfi_level_findings_report(b, number, &made[other]->findings);
    return SBF_OK;
  }
  made_levels *own = sbfi_arena_allocate(&b->scratch, 1, sizeof *own);
  if (!own) return sbfi_build_no_memory(b);
  own->before = b->report;
  sbf_status status = make_level(b, number, &own->findings);
  own->after = b->report;
  made[number] = own;
  /* A level of springs has a map too, but for positions. */
  bool is_lattice = b->made[number] && body->levels.at[0].model == SBF_ELASTIC_MODEL_TETRAHEDRA;
  if (status == SBF_OK && is_lattice) sbfi_equal_bodies_add(all, number);
  return status;
}

/* Authored levels stay; they get the pins of the body. */
static bool pin_authored_levels(sbfi_build *b, uint32_t number) {
  sbf_soft_body *body = &b->bodies[number];
  sbf_level *levels = sbf_asset_allocate(b->asset, body->levels.count, sizeof *levels);
  if (!levels) return false;
  memcpy(levels, body->levels.at, body->levels.count * sizeof *levels);
  body->levels.at = levels;
  for (uint32_t l = 0; l < body->levels.count; l++) {
    uint32_t before = levels[l].pins.count;
    if (!sbfi_level_pins_make(&levels[l], body, SBFI_BUILD_DERIVATION, b->asset, NULL, 0, &b->scratch))
      return false;
    for (uint32_t p = before; l == 0 && p < levels[l].pins.count; p++)
      b->report.pins += levels[l].pins.at[p].points.count;
  }
  return true;
}

/* Bodies with automatic size divide the elements of one, so that a scene of many is not many times as
 * expensive. */
static void distribute_elements(sbfi_build *b) {
  uint32_t sharing = 0;
  for (uint32_t i = 0; i < b->asset->soft_bodies.count; i++)
    sharing += b->bodies[i].levels.count == 0 &&
               sbfi_body_interior(&b->options, &b->bodies[i]) >= SBF_BUILD_INTERIOR_TETRAHEDRA;
  uint32_t portion = SBFI_LATTICE_SHARED_ELEMENTS / (sharing ? sharing : 1);
  b->usual_elements = portion > MIN_FRACTION ? portion : MIN_FRACTION;
}

/* Number of tetrahedra that the options request for the body; 0: automatic. */
static double requested_elements(const sbfi_build *b, const sbf_soft_body *body) {
  sbf_build_interior interior = sbfi_body_interior(&b->options, body);
  bool filled = interior == SBF_BUILD_INTERIOR_AUTOMATIC || interior == SBF_BUILD_INTERIOR_LATTICE ||
                interior >= SBF_BUILD_INTERIOR_TETRAHEDRA;
  if (!filled || body->levels.count > 0) return 0;
  double cell = b->options.cell_m;
  if (!(cell > 0)) return elements_of(b, body);
  sbf_body_measures measures;
  sbf_body_measure(body, &measures);
  return measures.sheet ? 0 : ELEMENTS_OF_CELL * fabs(measures.volume) / (cell * cell * cell);
}

/* Refuses more elements than memory allows before any are created. */
static sbf_status check_elements(sbfi_build *b) {
  double sum = 0, max = 0;
  uint32_t largest = 0;
  for (uint32_t i = 0; i < b->asset->soft_bodies.count; i++) {
    double of = requested_elements(b, &b->bodies[i]);
    sum += of;
    if (of > max) max = of, largest = i;
  }
  if (!(sum > MAX_ELEMENTS)) return SBF_OK;
  return sbfi_build_report_of_body(b, largest, SBF_CODE_LATTICE_TOO_FINE,
      "the bodies would have about %.2g tetrahedra, %.2g of them in soft body \"%s\", and the limit for all "
      "bodies is %.0f: use a larger cell (--cell) or fewer elements (--elements, or `elements` of a section "
      "recipe)",
      sum, max, b->bodies[largest].name, MAX_ELEMENTS);
}

sbf_status sbfi_body_levels_make(sbfi_build *b) {
  uint32_t count = b->asset->soft_bodies.count;
  distribute_elements(b);
  sbf_status refused = check_elements(b);
  if (refused != SBF_OK) return refused;
  sbfi_equal_bodies all;
  const made_levels **made = sbfi_arena_allocate(&b->scratch, (size_t)count + 1, sizeof *made);
  if (!made || !sbfi_equal_bodies_make(&all, b->bodies, count, &b->scratch)) return sbfi_build_no_memory(b);
  for (uint32_t i = 0; i < count; i++) {
    sbf_status status = sbfi_build_report_progress(b, "levels", 0.2 + 0.4 * i / count);
    if (status != SBF_OK) return status;
    warn_of_attachments(b, i);
    if (b->bodies[i].levels.count > 0) {
      if (!pin_authored_levels(b, i)) return sbfi_build_no_memory(b);
    } else if (b->bodies[i].surface.positions.count > 0) {
      status = make_or_repeat(b, i, &all, made);
      if (status != SBF_OK) return status;
    } else {
      sbfi_build_report_of_body(b, i, SBF_CODE_BODY_WITHOUT_POINTS,
          "soft body \"%s\" has no surface points, so no level can be built: add a surface",
          b->bodies[i].name);
    }
  }
  return SBF_OK;
}

sbf_status sbfi_body_lattices_clear(sbfi_build *b) {
  for (uint32_t i = 0; i < b->asset->soft_bodies.count; i++)
    for (uint32_t l = 0; b->made[i] && l < b->bodies[i].levels.count; l++) {
      /* The level belongs to the asset and was created here. */
      sbf_level *level = (sbf_level *)(uintptr_t)&b->bodies[i].levels.at[l];
      if (level->model != SBF_ELASTIC_MODEL_SPRINGS) continue;
      level->lattice.tetrahedra = (sbf_uint4_list){NULL, 0};
    }
  return SBF_OK;
}
