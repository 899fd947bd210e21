#include "sbfmt/build.h"

#include <float.h>
#include <math.h>
#include <stdio.h>
#include <string.h>

#include "build/build_settings.h"
#include "build/embed/embed.h"
#include "build/geometry/topology.h"
#include "build/lattice/lattice_level.h"
#include "build/lattice/region_level.h"
#include "build/levels/ladder.h"
#include "build/new_places.h"
#include "build/render/render_levels.h"
#include "build/sections/level_pins.h"
#include "build/sections/section_frame.h"
#include "build/sections/section_hulls.h"
#include "build/sections/section_joints.h"
#include "build/sections/section_level.h"
#include "build/sections/sections.h"
#include "build/source_reading.h"
#include "build/source_view.h"
#include "sbfmt/mechanics.h"

#define TEXT_OF(x) TEXT_OF_ARGUMENT(x)
#define TEXT_OF_ARGUMENT(x) #x
static const char default_tool[] =
    "sbfmt " TEXT_OF(SBF_VERSION_MAJOR) "." TEXT_OF(SBF_VERSION_MINOR) "." TEXT_OF(SBF_VERSION_PATCH);

enum { MOST_BRUTE_POINTS = 4096, MOST_CALIBRATED_POINTS = 20000, LEAST_SHARE = 100 };
/* How far sections reach over a cut, by the limb's radius. */
static const double USUAL_OVERLAP = 0.5;
enum { DERIVATION = 0 }; /* a build has one entry in `derivations` */

typedef struct build {
  sbf_build_options options;
  const sbf_asset *from;
  sbf_asset *asset; /* under construction */
  sbf_derivation *derivation;
  sbf_soft_body *bodies;
  sbfi_interior_map *maps; /* (bodies) of the levels made */
  bool *made;              /* (bodies) the level is made here, the body's only one */
  uint32_t *frames;        /* (bodies) first frame point of the level made; SBFI_NO_INDEX: none */
  sbfi_sections sections;  /* cut here: the last of the bodies */
  uint32_t usual_elements; /* the most tetrahedra of a body that nobody sizes */
  sbfi_arena scratch;
  sbfi_ids ids;
  sbfi_reporter reporter;
  sbf_build_report report;
  sbf_diagnostic *error;
  const char *pass; /* that `tell` tells of */
  bool cancelled;
} build;

/* Where memory ran out, or what `progress` was told ended the work: `error` then says so already. */
static sbf_status no_memory(build *b) {
  if (b->cancelled) return SBF_FAILED;
  return sbfi_diagnose(b->error, SBF_CODE_OUT_OF_MEMORY, "no memory left to build in");
}

static sbf_status progress(build *b, const char *pass, double done) {
  if (!b->options.progress || b->options.progress(b->options.user, pass, done)) return SBF_OK;
  b->cancelled = true;
  return sbfi_diagnose(b->error, SBF_CODE_CANCELLED, "cancelled while making %s", pass);
}

static bool tell(void *user, double done) {
  build *b = user;
  return progress(b, b->pass, done) == SBF_OK;
}

/* For a pass that takes the stretch from `from` to `to` of the whole. */
static sbfi_progress stretch(build *b, const char *pass, double from, double to) {
  b->pass = pass;
  return (sbfi_progress){tell, b, from, to};
}

/* For a part of the work on one body's levels. */
static sbfi_progress stretch_of_body(build *b, uint32_t number) {
  uint32_t count = b->asset->soft_bodies.count;
  return stretch(b, "levels", 0.2 + 0.4 * number / count, 0.2 + 0.4 * (number + 1) / count);
}

static sbf_build_options options_of(const sbf_build_options *given) {
  sbf_build_options options = {0};
  size_t size = given && given->struct_size && given->struct_size < sizeof options ? given->struct_size
                                                                                   : sizeof options;
  if (given) memcpy(&options, given, size);
  if (!options.tool) options.tool = default_tool;
  return options;
}

static const char *settings_of(const build *b) {
  char text[SBFI_BUILD_SETTINGS_SIZE];
  sbfi_build_settings_write(&b->options, text);
  return sbf_asset_copy_text(b->asset, text);
}

/* The source parts, as a copy that may be written to. */
static sbf_status copy_source(build *b) {
  sbf_asset view;
  if (!sbfi_source_view(b->from, &b->scratch, &view)) return no_memory(b);
  b->asset = sbf_asset_clone(&view, &b->scratch.allocator);
  if (!b->asset) return no_memory(b);
  return SBF_OK;
}

static sbf_status record_derivation(build *b) {
  sbf_derivation *made = sbf_asset_allocate(b->asset, 1, sizeof *made);
  if (!made || !sbfi_ids_add_collections(&b->ids, b->asset)) return no_memory(b);
  sbf_derivation_init(made);
  made->id = sbfi_unique_id(&b->ids, "", "build", DERIVATION, b->asset);
  made->tool = sbf_asset_copy_text(b->asset, b->options.tool);
  made->settings = settings_of(b);
  if (!made->id || !made->tool || !made->settings) return no_memory(b);
  b->derivation = made;
  b->asset->derivations = (sbf_derivation_list){made, 1};
  return SBF_OK;
}

static sbf_status make_sections(build *b) {
  double overlap = b->options.overlap_m > 0 ? b->options.overlap_m : -USUAL_OVERLAP;
  if (b->options.sections == SBF_BUILD_SECTIONS_AUTOMATIC &&
      !sbfi_sections_make(&b->sections, b->asset, overlap, DERIVATION, &b->ids, &b->reporter,
          stretch(b, "sections", 0.06, 0.1), &b->scratch))
    return no_memory(b);
  b->report.sections = b->sections.count;
  return SBF_OK;
}

/* All bodies in memory that may be written to, the sections behind the source's. */
static sbf_status line_up_bodies(build *b) {
  uint32_t source = b->asset->soft_bodies.count, count = source + b->sections.count;
  b->bodies = sbf_asset_allocate(b->asset, count, sizeof *b->bodies);
  b->maps = sbfi_arena_allocate(&b->scratch, (size_t)count + 1, sizeof *b->maps);
  b->made = sbfi_arena_allocate(&b->scratch, (size_t)count + 1, sizeof *b->made);
  b->frames = sbfi_arena_allocate(&b->scratch, (size_t)count + 1, sizeof *b->frames);
  if ((count && !b->bodies) || !b->maps || !b->made || !b->frames) return no_memory(b);
  if (source) memcpy(b->bodies, b->asset->soft_bodies.at, source * sizeof *b->bodies);
  if (b->sections.count)
    memcpy(b->bodies + source, b->sections.bodies, b->sections.count * sizeof *b->bodies);
  b->asset->soft_bodies = (sbf_soft_body_list){b->bodies, count};
  memset(b->frames, 0xff, count * sizeof *b->frames);
  return SBF_OK;
}

/* What sections carry beyond their surfaces. */
static sbf_status make_frames(build *b) {
  uint32_t source = b->asset->soft_bodies.count - b->sections.count;
  for (uint32_t i = 0; i < b->sections.count && !b->options.without_embeddings; i++) {
    uint32_t number = source + i;
    if (!b->made[number]) continue;
    /* The level is the asset's, made here. */
    sbf_level *level = (sbf_level *)(uintptr_t)b->bodies[number].levels.at;
    uint32_t before = level->positions.count;
    if (!sbfi_section_frame_add(
            level, &b->sections, i, DERIVATION, b->asset, &b->frames[number], &b->scratch))
      return no_memory(b);
    b->report.pins += level->positions.count - before;
  }
  return SBF_OK;
}

static sbf_status make_hulls(build *b) {
  if (b->options.without_hulls) return SBF_OK;
  if (!sbfi_section_hulls_make(b->asset, DERIVATION, &b->ids, &b->reporter, &b->report.hulls,
          stretch(b, "hulls", 0.11, 0.15), &b->scratch))
    return no_memory(b);
  return SBF_OK;
}

/* Authored parts name others by their places, which have moved where derived ones stood between. */
static sbf_status renumber(build *b) {
  sbfi_lost_reference lost;
  switch (sbfi_new_places_take(b->asset, b->from, &b->ids, &lost, &b->scratch)) {
  case SBFI_PLACES_NO_MEMORY:
    return no_memory(b);
  case SBFI_PLACES_TAKEN:
    return SBF_OK;
  case SBFI_PLACES_LOST:
    break;
  }
  sbf_status status = sbfi_diagnose(b->error, SBF_CODE_DERIVED_LOST,
      "refers to one of the %s that an earlier build made and this one does not: let it name an authored one",
      lost.collection);
  if (b->error) memcpy(b->error->path, lost.path, sizeof b->error->path);
  return status;
}

/* After the references: what is made names the new places. */
static sbf_status make_joints(build *b) {
  bool wanted = b->sections.count > 0 && !b->options.without_hulls;
  if (wanted && !sbfi_section_joints_make(b->asset, DERIVATION, &b->ids, &b->scratch)) return no_memory(b);
  return SBF_OK;
}

/* Automatic: of a section that was cut here (section_level.h). */
static sbf_build_interior interior_of(const build *b, const sbf_soft_body *body) {
  sbf_body_measures measures;
  sbf_body_measure(body, &measures);
  sbf_build_interior wanted = b->options.interior;
  if (wanted == SBF_BUILD_INTERIOR_AUTOMATIC && body->derived != SBF_NONE) return wanted;
  /* A section hangs on its bone by its centroid; what no bone runs through is filled, or a sheet. */
  if (wanted == SBF_BUILD_INTERIOR_AUTOMATIC)
    wanted = body->bone != SBF_NONE ? SBF_BUILD_INTERIOR_CENTROID
             : measures.sheet       ? SBF_BUILD_INTERIOR_NONE
                                    : SBF_BUILD_INTERIOR_TETRAHEDRA;
  if (wanted == SBF_BUILD_INTERIOR_CENTROID || wanted == SBF_BUILD_INTERIOR_BRUTE) return wanted;
  return measures.sheet ? SBF_BUILD_INTERIOR_NONE : wanted;
}

static void warn_of_attachments(build *b, uint32_t body) {
  for (uint32_t i = 0; i < b->bodies[body].attachments.count; i++) {
    const sbf_attachment *rule = &b->bodies[body].attachments.at[i];
    if (rule->rule != SBF_ATTACHMENT_RULE_INSIDE_HULL || b->asset->rigid_bodies.at[rule->rigid_body].hull)
      continue;
    sbf_diagnostic finding;
    sbfi_diagnose(&finding, SBF_CODE_ATTACHMENT_NO_HULL,
        "rigid body \"%s\" has no hull that points could be inside of",
        b->asset->rigid_bodies.at[rule->rigid_body].name);
    snprintf(
        finding.path, sizeof finding.path, "/sbf/soft_body[%u]/attachments/attachment[%u]", body + 1, i + 1);
    sbfi_report(&b->reporter, &finding);
  }
}

static sbf_status report_of_body(build *b, uint32_t number, sbf_code code, const char *format, ...)
    __attribute__((format(printf, 4, 5)));
static sbf_status report_of_body(build *b, uint32_t number, sbf_code code, const char *format, ...) {
  sbf_diagnostic finding;
  va_list arguments;
  va_start(arguments, format);
  sbf_status status = sbfi_diagnose_v(&finding, code, format, arguments);
  va_end(arguments);
  snprintf(finding.path, sizeof finding.path, "/sbf/soft_body[%u]", number + 1);
  if (status == SBF_OK)
    sbfi_report(&b->reporter, &finding);
  else if (b->error)
    *b->error = finding;
  return status;
}

static void take_level(build *b, uint32_t number, const sbf_level *level, uint32_t pins) {
  b->bodies[number].levels = (sbf_level_list){level, 1};
  b->made[number] = true;
  b->report.bodies++;
  b->report.pins += pins;
}

static bool make_springs(build *b, uint32_t number, sbf_build_interior interior, sbfi_arena *scratch) {
  sbf_soft_body *body = &b->bodies[number];
  static const sbfi_spring_interior interiors[] = {[SBF_BUILD_INTERIOR_CENTROID] = SBFI_INTERIOR_CENTROID,
      [SBF_BUILD_INTERIOR_NONE] = SBFI_INTERIOR_NONE,
      [SBF_BUILD_INTERIOR_LATTICE] = SBFI_INTERIOR_LATTICE,
      [SBF_BUILD_INTERIOR_BRUTE] = SBFI_INTERIOR_BRUTE};
  sbfi_spring_recipe recipe = {interiors[interior], b->options.cell_m, !b->options.without_flexion,
      DERIVATION, stretch_of_body(b, number)};
  sbfi_spring_counts counts;
  sbf_level *level = sbf_asset_allocate(b->asset, 1, sizeof *level);
  sbfi_interior_map *map = &b->maps[number];
  if (!level || !sbfi_spring_level_make(level, body, &recipe, b->asset, map, &counts, scratch)) return false;
  if (map->polygon_points) {
    map->polygon_points = sbfi_arena_copy(
        &b->scratch, map->polygon_points, body->surface.polygon_sizes.count, sizeof *map->polygon_points);
    if (!map->polygon_points) return false;
  }
  take_level(b, number, level, counts.pins);
  b->report.interior_points += counts.interior_points;
  b->report.inert_springs += counts.inert;
  for (int kind = 0; kind < SBF_SPRING_KIND_COUNT; kind++) b->report.springs[kind] += counts.springs[kind];
  return true;
}

static void add_quality(sbf_build_report *report, const sbf_lattice_measures *of) {
  bool first = report->most_dihedral_deg == 0;
  if (first || of->least_dihedral_deg < report->least_dihedral_deg)
    report->least_dihedral_deg = of->least_dihedral_deg;
  if (of->most_dihedral_deg > report->most_dihedral_deg) report->most_dihedral_deg = of->most_dihedral_deg;
  for (int i = 0; i < SBF_DIHEDRAL_BINS; i++) report->dihedrals[i] += of->dihedrals[i];
  report->lattice_volume += of->volume;
}

static sbf_status outcome_status(build *b, uint32_t number, sbfi_lattice_outcome outcome) {
  switch (outcome) {
  case SBFI_LATTICE_NO_MEMORY:
    return no_memory(b);
  case SBFI_LATTICE_CANCELLED:
    return no_memory(b);
  case SBFI_LATTICE_TOO_FINE:
    return report_of_body(b, number, SBF_CODE_LATTICE_TOO_FINE,
        "a lattice of this cell in soft body \"%s\" would have more than 2^28 nodes: give a larger cell",
        b->bodies[number].name);
  case SBFI_LATTICE_MADE:
    break;
  }
  return SBF_OK;
}

static void note_calibration(build *b, const sbfi_calibration *c) {
  sbf_build_report *r = &b->report;
  if (r->calibrated == 0 || c->least < r->least_factor) r->least_factor = c->least;
  if (c->most > r->most_factor) r->most_factor = c->most;
  if (c->residual > r->most_residual) r->most_residual = c->residual;
  if (fabs(c->period_error) > r->most_period_error) r->most_period_error = fabs(c->period_error);
  r->calibrated++;
}

static void note_spring_calibration(build *b, const sbfi_calibration *c) {
  sbf_build_report *r = &b->report;
  if (r->calibrated_springs == 0 || c->least < r->least_spring_factor) r->least_spring_factor = c->least;
  if (c->most > r->most_spring_factor) r->most_spring_factor = c->most;
  if (c->residual > r->most_spring_residual) r->most_spring_residual = c->residual;
  r->calibrated_springs++;
}

/* The rest of the levels of a body whose finest has been made, and what they are worth. */
static sbf_status make_ladder(build *b, uint32_t number, sbfi_ladder *ladder) {
  sbf_soft_body *body = &b->bodies[number];
  const sbfi_interior_map *map = &b->maps[number];
  bool of_springs = body->levels.at[0].model == SBF_ELASTIC_MODEL_SPRINGS;
  sbf_status status = outcome_status(
      b, number, sbfi_ladder_make(ladder, body->levels.at, of_springs ? map : NULL, &b->scratch));
  if (status != SBF_OK) return status;
  body->levels = (sbf_level_list){ladder->levels, ladder->level_count};
  b->report.levels += ladder->level_count - 1;
  for (uint32_t l = 0; l < ladder->level_count; l++) {
    if (!ladder->levels[l].calibration) continue;
    if (ladder->levels[l].model == SBF_ELASTIC_MODEL_TETRAHEDRA)
      note_calibration(b, &ladder->calibrations[l]);
    else
      note_spring_calibration(b, &ladder->calibrations[l]);
  }
  return SBF_OK;
}

static sbf_status make_tetrahedra(build *b, uint32_t number, sbfi_ladder *ladder, sbfi_arena *scratch) {
  const sbf_soft_body *body = &b->bodies[number];
  sbfi_lattice_recipe recipe = {b->options.cell_m, b->options.elements, b->usual_elements, DERIVATION};
  sbfi_lattice_counts counts;
  sbf_level *level = sbf_asset_allocate(b->asset, 1, sizeof *level);
  if (!level) return no_memory(b);
  if (b->options.error_m > 0) {
    bool met;
    recipe.cell = 0;
    sbf_status status = outcome_status(b, number, sbfi_ladder_pick(ladder, &recipe.elements, &met));
    if (status != SBF_OK) return status;
    if (!met)
      report_of_body(b, number, SBF_CODE_LEVEL_ERROR_MISSED,
          "no lattice of soft body \"%s\" coarser than %u tetrahedra comes within %.4g m: it gets so many",
          body->name, (unsigned)recipe.elements, b->options.error_m);
  }
  sbf_status status = outcome_status(
      b, number, sbfi_lattice_level_make(level, body, &recipe, b->asset, &counts, ladder->progress, scratch));
  if (status != SBF_OK) return status;
  if (counts.tetrahedra == 0) {
    report_of_body(b, number, SBF_CODE_LATTICE_EMPTY,
        "soft body \"%s\" encloses nothing that a lattice of %.4g m could fill: it gets springs over its "
        "surface",
        body->name, (double)level->cell);
    return make_springs(b, number, SBF_BUILD_INTERIOR_NONE, scratch) ? SBF_OK : no_memory(b);
  }
  /* Tips and rims are thin everywhere: a few such points are no thin limb. */
  if (counts.thinness.thin_count > counts.thinness.sample_count / 50)
    report_of_body(b, number, SBF_CODE_LATTICE_THIN,
        "%u of %u points looked at on soft body \"%s\" stand on matter thinner than two elements, the "
        "thinnest %.4g m at a cell of %.4g m: a smaller cell (--cell, --elements) gives it more",
        (unsigned)counts.thinness.thin_count, (unsigned)counts.thinness.sample_count, body->name,
        counts.thinness.least, (double)level->cell);
  take_level(b, number, level, counts.pins);
  b->report.tetrahedra += counts.tetrahedra;
  b->report.thickened_points += counts.thickened;
  add_quality(&b->report, &counts.quality);
  return SBF_OK;
}

/* A lattice as for tetrahedra, then regions of its points in their stead. */
static sbf_status make_regions(build *b, uint32_t number, sbfi_ladder *ladder, sbfi_arena *scratch) {
  sbf_status status = make_tetrahedra(b, number, ladder, scratch);
  const sbf_soft_body *body = &b->bodies[number];
  if (status != SBF_OK || !b->made[number] || body->levels.at[0].model != SBF_ELASTIC_MODEL_TETRAHEDRA)
    return status;
  /* The level is the asset's, made here. */
  sbf_level *level = (sbf_level *)(uintptr_t)body->levels.at;
  return sbfi_region_level_make(level, body, b->asset, scratch) ? SBF_OK : no_memory(b);
}

/* A section that was cut here; where it encloses nothing, as a sheet does, springs to its centre hold it. */
static sbf_status make_section(build *b, uint32_t number, sbfi_arena *scratch) {
  const sbf_soft_body *body = &b->bodies[number];
  const sbfi_section_recipe recipe = {b->options.cell_m, b->options.elements, DERIVATION};
  sbfi_section_counts counts;
  sbf_level *level = sbf_asset_allocate(b->asset, 1, sizeof *level);
  if (!level) return no_memory(b);
  sbf_status status = outcome_status(b, number,
      sbfi_section_level_make(level, body, &recipe, b->asset, &counts, stretch_of_body(b, number), scratch));
  if (status != SBF_OK) return status;
  if (counts.points == 0)
    return make_springs(b, number, SBF_BUILD_INTERIOR_CENTROID, scratch) ? SBF_OK : no_memory(b);
  take_level(b, number, level, counts.pins);
  b->report.interior_points += counts.points;
  b->report.springs[SBF_SPRING_KIND_INTERNAL] += counts.springs;
  b->report.inert_springs += counts.inert;
  return SBF_OK;
}

/* Tetrahedra that embeddings went by and that move nothing. */
static sbf_status clear_lattices(build *b) {
  for (uint32_t i = 0; i < b->asset->soft_bodies.count; i++)
    for (uint32_t l = 0; b->made[i] && l < b->bodies[i].levels.count; l++) {
      /* The level is the asset's, made here. */
      sbf_level *level = (sbf_level *)(uintptr_t)&b->bodies[i].levels.at[l];
      if (level->model != SBF_ELASTIC_MODEL_SPRINGS) continue;
      level->lattice.tetrahedra = (sbf_uint4_list){NULL, 0};
    }
  return SBF_OK;
}

/* Lattices and springs by centroid, which hold as much of a section as their few springs happen to. */
static bool is_calibrated(const build *b, uint32_t number, sbf_build_interior interior) {
  const sbf_soft_body *body = &b->bodies[number];
  sbf_body_measures measures;
  if (interior == SBF_BUILD_INTERIOR_TETRAHEDRA) return true;
  if (interior != SBF_BUILD_INTERIOR_CENTROID || body->surface.positions.count > MOST_CALIBRATED_POINTS)
    return false;
  sbf_body_measure(body, &measures);
  return !measures.sheet && body->surface.polygon_sizes.count > 0;
}

static sbf_status make_level(build *b, uint32_t number) {
  sbfi_arena scratch;
  sbf_build_interior interior = interior_of(b, &b->bodies[number]);
  sbfi_arena_init(&scratch, &b->scratch.allocator, 0);
  sbf_status status = SBF_OK;
  const sbf_build_options *o = &b->options;
  bool is_sized = o->cell_m > 0 || o->elements > 0 || o->error_m > 0;
  const sbfi_ladder_recipe recipe = {.levels = o->levels > 1 ? o->levels : 1,
      .error = o->error_m,
      .calibrate = !o->without_calibration && is_calibrated(b, number, interior),
      .tick = (double)b->asset->environment.control_tick,
      .share = is_sized ? 0 : b->usual_elements,
      .derivation = DERIVATION};
  sbfi_ladder ladder;
  sbfi_ladder_init(
      &ladder, &b->bodies[number], &recipe, b->asset, stretch_of_body(b, number), &b->scratch.allocator);
  if (interior == SBF_BUILD_INTERIOR_BRUTE && b->bodies[number].surface.positions.count > MOST_BRUTE_POINTS)
    status = report_of_body(b, number, SBF_CODE_INTERIOR_TOO_MANY,
        "soft body \"%s\" has more than %d points: springs between all of them are for comparing small "
        "bodies",
        b->bodies[number].name, MOST_BRUTE_POINTS);
  else if (interior == SBF_BUILD_INTERIOR_TETRAHEDRA)
    status = make_tetrahedra(b, number, &ladder, &scratch);
  else if (interior == SBF_BUILD_INTERIOR_SHAPE_MATCHING)
    status = make_regions(b, number, &ladder, &scratch);
  else if (interior == SBF_BUILD_INTERIOR_AUTOMATIC)
    status = make_section(b, number, &scratch);
  else if (!make_springs(b, number, interior, &scratch))
    status = no_memory(b);
  bool alone = b->bodies[number].levels.count &&
               b->bodies[number].levels.at[0].model == SBF_ELASTIC_MODEL_SHAPE_MATCHING;
  if (status == SBF_OK && b->made[number] && !alone) status = make_ladder(b, number, &ladder);
  sbfi_ladder_free(&ladder);
  sbfi_arena_free(&scratch);
  return status;
}

/* Authored levels stay; the pins that the body's own stand for are put on them. */
static bool pin_authored_levels(build *b, uint32_t number) {
  sbf_soft_body *body = &b->bodies[number];
  sbf_level *levels = sbf_asset_allocate(b->asset, body->levels.count, sizeof *levels);
  if (!levels) return false;
  memcpy(levels, body->levels.at, body->levels.count * sizeof *levels);
  body->levels.at = levels;
  for (uint32_t l = 0; l < body->levels.count; l++) {
    uint32_t before = levels[l].pins.count;
    if (!sbfi_level_pins_make(&levels[l], body, DERIVATION, b->asset, NULL, 0, &b->scratch)) return false;
    for (uint32_t p = before; l == 0 && p < levels[l].pins.count; p++)
      b->report.pins += levels[l].pins.at[p].points.count;
  }
  return true;
}

/* Bodies that nobody sizes share what one would get, so that a scene of many is not many times as dear. */
static void share_elements(build *b) {
  uint32_t sharing = 0;
  for (uint32_t i = 0; i < b->asset->soft_bodies.count; i++)
    sharing +=
        b->bodies[i].levels.count == 0 && interior_of(b, &b->bodies[i]) >= SBF_BUILD_INTERIOR_TETRAHEDRA;
  uint32_t share = SBFI_LATTICE_SHARED_ELEMENTS / (sharing ? sharing : 1);
  b->usual_elements = share > LEAST_SHARE ? share : LEAST_SHARE;
}

static sbf_status make_levels(build *b) {
  uint32_t count = b->asset->soft_bodies.count;
  share_elements(b);
  for (uint32_t i = 0; i < count; i++) {
    sbf_status status = progress(b, "levels", 0.2 + 0.4 * i / count);
    if (status != SBF_OK) return status;
    warn_of_attachments(b, i);
    if (b->bodies[i].levels.count > 0) {
      if (!pin_authored_levels(b, i)) return no_memory(b);
    } else if (b->bodies[i].surface.positions.count > 0) {
      status = make_level(b, i);
      if (status != SBF_OK) return status;
    } else {
      report_of_body(b, i, SBF_CODE_BODY_WITHOUT_POINTS,
          "soft body \"%s\" has no surface points to build a level on", b->bodies[i].name);
    }
  }
  return SBF_OK;
}

/* Of the level of springs, where one was made. */
static const sbfi_interior_map *map_of(const build *b, uint32_t body, uint32_t level) {
  bool springs = b->bodies[body].levels.at[level].model == SBF_ELASTIC_MODEL_SPRINGS;
  return b->made[body] && springs && level == 0 ? &b->maps[body] : NULL;
}

/* The first of four points around the body, from which all places follow where it moves as one piece. */
static uint32_t frame_of(const build *b, uint32_t body, uint32_t level) {
  const sbf_level *of = &b->bodies[body].levels.at[level];
  if (of->model == SBF_ELASTIC_MODEL_JIGGLE && b->made[body]) return 0;
  return level == 0 ? b->frames[body] : SBFI_NO_INDEX;
}

static sbf_status embed(build *b) {
  size_t count = 0, next = 0;
  if (b->options.without_embeddings) return SBF_OK;
  for (uint32_t i = 0; i < b->asset->soft_bodies.count; i++) count += b->bodies[i].levels.count;
  sbfi_embed_target *targets = sbfi_arena_allocate(&b->scratch, count + 1, sizeof *targets);
  if (!targets) return no_memory(b);
  for (uint32_t i = 0; i < b->asset->soft_bodies.count; i++)
    for (uint32_t l = 0; l < b->bodies[i].levels.count; l++)
      /* The levels are the asset's, copied into memory that may be written to. */
      targets[next++] = (sbfi_embed_target){
          i, (sbf_level *)(uintptr_t)&b->bodies[i].levels.at[l], map_of(b, i, l), frame_of(b, i, l)};
  sbfi_embed_report report;
  if (!sbfi_embed(b->asset, targets, (uint32_t)count, &b->sections, DERIVATION, &b->reporter, &report,
          stretch(b, "embeddings", 0.6, 0.8), &b->scratch))
    return no_memory(b);
  b->report.embedded_vertices = report.vertices;
  b->report.farthest_m = report.farthest;
  return SBF_OK;
}

static sbf_status make_render_levels(build *b) {
  const sbf_build_options *o = &b->options;
  uint32_t levels = o->render_levels || !(o->render_error_m > 0) ? o->render_levels : SBFI_MOST_RENDER_LEVELS;
  const sbfi_render_recipe recipe = {levels, o->render_error_m, DERIVATION};
  bool good = sbfi_render_levels_make(
      b->asset, &recipe, &b->report.render_levels, stretch(b, "render levels", 0.8, 0.89), &b->scratch);
  return good ? SBF_OK : no_memory(b);
}

/* What a report says of the whole without reading the geometry. Beyond all measure: nothing is said. */
static sbf_status record_figures(build *b) {
  sbf_asset_measures measures;
  sbf_asset_measure(b->asset, &measures);
  if (!(measures.mass <= FLT_MAX)) return SBF_OK;
  b->derivation->mass = (float)measures.mass;
  b->derivation->low = measures.low;
  b->derivation->high = measures.high;
  /* Those that a conversion stated for want of a derivation are of the asset before. */
  b->asset->info.mass = 0;
  b->asset->info.low = b->asset->info.high = (sbf_vec3){0, 0, 0};
  return SBF_OK;
}

/* Of the asset as it now is: what is derived does not count. */
static sbf_status hash_source(build *b) {
  char text[SBFI_SHA256_TEXT_SIZE];
  sbf_status status = sbfi_build_source_hash(b->asset, text, b->error);
  if (status != SBF_OK) return status;
  const char *hash = sbf_asset_copy_text(b->asset, text);
  if (!hash) return no_memory(b);
  b->derivation->source_hash = hash;
  return SBF_OK;
}

static void take_finding(void *user, const sbf_diagnostic *finding) {
  *(sbf_diagnostic *)user = *finding;
}

/* Sizes and moduli beyond all measure can make numbers that no file may hold. */
static sbf_status check_made(build *b) {
  sbf_diagnostic finding;
  if (sbf_asset_check(b->asset, take_finding, &finding, 1) == 0) return SBF_OK;
  if (finding.code == SBF_CODE_OUT_OF_MEMORY) return no_memory(b);
  sbf_status status = sbfi_diagnose(b->error, SBF_CODE_VALUE_NOT_FINITE,
      "what the build makes here is no sound number (%.200s): look at the source's sizes and attributes",
      finding.message);
  if (b->error) memcpy(b->error->path, finding.path, sizeof b->error->path);
  return status;
}

static sbf_status run(build *b) {
  static const struct {
    const char *name;
    double done; /* before it */
    sbf_status (*run)(build *);
  } passes[] = {{"a copy of the source", 0, copy_source}, {"the derivation", 0.05, record_derivation},
      {"sections", 0.06, make_sections}, {"the list of bodies", 0.1, line_up_bodies},
      {"hulls", 0.11, make_hulls}, {"references", 0.15, renumber}, {"joints", 0.18, make_joints},
      {"levels", 0.2, make_levels}, {"frames of sections", 0.59, make_frames}, {"embeddings", 0.6, embed},
      {"render levels", 0.8, make_render_levels}, {"lattices no longer needed", 0.89, clear_lattices},
      {"figures of the whole", 0.9, record_figures}, {"the check of what was made", 0.92, check_made},
      {"the hash of the source", 0.95, hash_source}};
  for (size_t i = 0; i < sizeof passes / sizeof *passes; i++) {
    sbf_status status = progress(b, passes[i].name, passes[i].done);
    if (status == SBF_OK) status = passes[i].run(b);
    if (status != SBF_OK) return status;
  }
  return progress(b, "the last of it", 1);
}

sbf_status sbf_build(const sbf_asset *asset, const sbf_build_options *options, sbf_asset **built,
    sbf_build_report *report, sbf_diagnostic *error) {
  *built = NULL;
  build b = {.options = options_of(options), .from = asset, .error = error};
  sbf_status status = sbfi_build_settings_check(&b.options, error);
  if (status != SBF_OK) return status;
  b.reporter = (sbfi_reporter){.report = b.options.report, .user = b.options.user};
  sbfi_arena_init(&b.scratch, b.options.allocator, 0);
  sbfi_ids_init(&b.ids, b.options.allocator);
  status = run(&b);
  sbfi_ids_free(&b.ids);
  sbfi_arena_free(&b.scratch);
  b.report.warnings = b.reporter.warnings;
  if (report) *report = b.report;
  if (status == SBF_OK)
    *built = b.asset;
  else
    sbf_asset_free(b.asset);
  return status;
}
