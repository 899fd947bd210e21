/* Order of a build: removes derived parts, then each pass builds its part again. */
#include "sbfmt/build.h"

#include <float.h>
#include <string.h>

#include "build/body_levels.h"
#include "build/build_settings.h"
#include "build/build_state.h"
#include "build/embed/embed.h"
#include "build/geometry/topology.h"
#include "build/new_positions.h"
#include "build/render/render_levels.h"
#include "build/sections/section_frame.h"
#include "build/sections/section_hulls.h"
#include "build/sections/section_joints.h"
#include "build/sections/sections.h"
#include "build/source_reading.h"
#include "build/source_view.h"
#include "sbfmt/mechanics.h"

#define TEXT_OF(x) TEXT_OF_ARGUMENT(x)
#define TEXT_OF_ARGUMENT(x) #x
static const char default_tool[] =
    "sbfmt " TEXT_OF(SBF_VERSION_MAJOR) "." TEXT_OF(SBF_VERSION_MINOR) "." TEXT_OF(SBF_VERSION_PATCH);

/* Overlap of sections at a cut, in radii of the limb. */
static const double USUAL_OVERLAP = 0.5;

static sbf_build_options options_of(const sbf_build_options *given) {
  sbf_build_options options = {0};
  size_t size = given && given->struct_size && given->struct_size < sizeof options ? given->struct_size
                                                                                   : sizeof options;
  if (given) memcpy(&options, given, size);
  if (!options.tool) options.tool = default_tool;
  return options;
}

static const char *settings_of(const sbfi_build *b) {
  char text[SBFI_BUILD_SETTINGS_SIZE];
  sbfi_build_settings_write(&b->options, text);
  return sbf_asset_copy_text(b->asset, text);
}

/* Copies the source parts, so that they can be changed. */
static sbf_status copy_source(sbfi_build *b) {
  sbf_asset view;
  if (!sbfi_source_view(b->from, &b->scratch, &view)) return sbfi_build_no_memory(b);
  b->asset = sbf_asset_clone(&view, &b->scratch.allocator);
  if (!b->asset) return sbfi_build_no_memory(b);
  return SBF_OK;
}

static sbf_status record_derivation(sbfi_build *b) {
  sbf_derivation *made = sbf_asset_allocate(b->asset, 1, sizeof *made);
  if (!made || !sbfi_ids_add_collections(&b->ids, b->asset)) return sbfi_build_no_memory(b);
  sbf_derivation_init(made);
  made->id = sbfi_unique_id(&b->ids, "", "build", SBFI_BUILD_DERIVATION, b->asset);
  made->tool = sbf_asset_copy_text(b->asset, b->options.tool);
  made->settings = settings_of(b);
  if (!made->id || !made->tool || !made->settings) return sbfi_build_no_memory(b);
  b->derivation = made;
  b->asset->derivations = (sbf_derivation_list){made, 1};
  return SBF_OK;
}

static sbf_status make_sections(sbfi_build *b) {
  double overlap = b->options.overlap_m > 0 ? b->options.overlap_m : -USUAL_OVERLAP;
  if (b->options.sections == SBF_BUILD_SECTIONS_AUTOMATIC &&
      !sbfi_sections_make(&b->sections, b->asset, overlap, SBFI_BUILD_DERIVATION, &b->ids, &b->reporter,
          sbfi_build_stretch(b, "sections", 0.06, 0.1), &b->scratch))
    return sbfi_build_no_memory(b);
  b->report.sections = b->sections.count;
  return SBF_OK;
}

/* Lists all bodies in writable memory, with the sections after the source's. */
static sbf_status line_up_bodies(sbfi_build *b) {
  uint32_t source = b->asset->soft_bodies.count, count = source + b->sections.count;
  b->bodies = sbf_asset_allocate(b->asset, count, sizeof *b->bodies);
  b->maps = sbfi_arena_allocate(&b->scratch, (size_t)count + 1, sizeof *b->maps);
  b->made = sbfi_arena_allocate(&b->scratch, (size_t)count + 1, sizeof *b->made);
  b->frames = sbfi_arena_allocate(&b->scratch, (size_t)count + 1, sizeof *b->frames);
  if ((count && !b->bodies) || !b->maps || !b->made || !b->frames) return sbfi_build_no_memory(b);
  if (source) memcpy(b->bodies, b->asset->soft_bodies.at, source * sizeof *b->bodies);
  if (b->sections.count)
    memcpy(b->bodies + source, b->sections.bodies, b->sections.count * sizeof *b->bodies);
  b->bodies_count = count;
  b->asset->soft_bodies = (sbf_soft_body_list){b->bodies, count};
  memset(b->frames, 0xff, count * sizeof *b->frames);
  return SBF_OK;
}

/* Parts attached to sections outside their surfaces. */
static sbf_status make_frames(sbfi_build *b) {
  uint32_t source = b->asset->soft_bodies.count - b->sections.count;
  for (uint32_t i = 0; i < b->sections.count && !b->options.without_embeddings; i++) {
    uint32_t number = source + i;
    if (!b->made[number]) continue;
    /* The level belongs to the asset and was created here. */
    sbf_level *level = (sbf_level *)(uintptr_t)b->bodies[number].levels.at;
    uint32_t before = level->positions.count;
    if (!sbfi_section_frame_add(
            level, &b->sections, i, SBFI_BUILD_DERIVATION, b->asset, &b->frames[number], &b->scratch))
      return sbfi_build_no_memory(b);
    b->report.pins += level->positions.count - before;
  }
  return SBF_OK;
}

/* Appends rigid parts of skins to the bodies, or removes them if `with` is false. */
static sbf_status list_rigid_parts(sbfi_build *b, bool with) {
  uint32_t bodies = b->bodies_count, more = with ? b->sections.rigid_count : 0;
  sbf_soft_body *all = b->bodies;
  if (more) {
    all = sbfi_arena_allocate(&b->scratch, (size_t)bodies + more, sizeof *all);
    if (!all) return sbfi_build_no_memory(b);
    if (bodies) memcpy(all, b->bodies, bodies * sizeof *all);
    memcpy(all + bodies, b->sections.rigid_parts, more * sizeof *all);
  }
  b->asset->soft_bodies = (sbf_soft_body_list){bodies + more ? all : NULL, bodies + more};
  return SBF_OK;
}

static sbf_status make_hulls(sbfi_build *b) {
  if (b->options.without_hulls) return SBF_OK;
  sbf_status status = list_rigid_parts(b, true);
  if (status != SBF_OK) return status;
  if (!sbfi_section_hulls_make(b->asset, SBFI_BUILD_DERIVATION, &b->ids, &b->reporter, &b->report.hulls,
          sbfi_build_stretch(b, "hulls", 0.11, 0.15), &b->scratch))
    return sbfi_build_no_memory(b);
  return list_rigid_parts(b, false);
}

/* References of authored parts are indices, which change if derived parts were in between. */
static sbf_status renumber(sbfi_build *b) {
  sbfi_lost_reference lost;
  switch (sbfi_new_positions_apply(b->asset, b->from, &b->ids, &lost, &b->scratch)) {
  case SBFI_POSITIONS_NO_MEMORY:
    return sbfi_build_no_memory(b);
  case SBFI_POSITIONS_APPLIED:
    return SBF_OK;
  case SBFI_POSITIONS_LOST:
    break;
  }
  sbf_status status = sbfi_diagnose(b->error, SBF_CODE_DERIVED_LOST,
      "refers to one of the %s that an earlier build made and this build did not: refer to an authored one",
      lost.collection);
  if (b->error) memcpy(b->error->path, lost.path, sizeof b->error->path);
  return status;
}

/* After the references: new parts use the new indices. */
static sbf_status make_joints(sbfi_build *b) {
  bool wanted = b->sections.count + b->sections.rigid_count > 0 && !b->options.without_hulls;
  sbf_status status = list_rigid_parts(b, wanted);
  if (status != SBF_OK) return status;
  if (wanted && !sbfi_section_joints_make(b->asset, SBFI_BUILD_DERIVATION, &b->ids, &b->scratch))
    return sbfi_build_no_memory(b);
  return list_rigid_parts(b, false);
}

/* Map of the level of springs, if one was built. */
static const sbfi_interior_map *map_of(const sbfi_build *b, uint32_t body, uint32_t level) {
  bool springs = b->bodies[body].levels.at[level].model == SBF_ELASTIC_MODEL_SPRINGS;
  return b->made[body] && springs && level == 0 ? &b->maps[body] : NULL;
}

/* The first of four points around the body that define its rigid motion. */
static uint32_t frame_of(const sbfi_build *b, uint32_t body, uint32_t level) {
  const sbf_level *of = &b->bodies[body].levels.at[level];
  if (of->model == SBF_ELASTIC_MODEL_JIGGLE && b->made[body]) return 0;
  return level == 0 ? b->frames[body] : SBFI_NO_INDEX;
}

static sbf_status embed(sbfi_build *b) {
  size_t count = 0, next = 0;
  if (b->options.without_embeddings) return SBF_OK;
  for (uint32_t i = 0; i < b->asset->soft_bodies.count; i++) count += b->bodies[i].levels.count;
  sbfi_embed_target *targets = sbfi_arena_allocate(&b->scratch, count + 1, sizeof *targets);
  if (!targets) return sbfi_build_no_memory(b);
  for (uint32_t i = 0; i < b->asset->soft_bodies.count; i++)
    for (uint32_t l = 0; l < b->bodies[i].levels.count; l++)
      /* The levels belong to the asset and were copied into writable memory. */
      targets[next++] = (sbfi_embed_target){
          i, (sbf_level *)(uintptr_t)&b->bodies[i].levels.at[l], map_of(b, i, l), frame_of(b, i, l)};
  sbfi_embed_report report;
  if (!sbfi_embed(b->asset, targets, (uint32_t)count, &b->sections, SBFI_BUILD_DERIVATION, &b->reporter,
          &report, sbfi_build_stretch(b, "embeddings", 0.6, 0.8), &b->scratch))
    return sbfi_build_no_memory(b);
  b->report.embedded_vertices = report.vertices;
  b->report.lattices.farthest_m = report.farthest;
  return SBF_OK;
}

static sbf_status make_render_levels(sbfi_build *b) {
  const sbf_build_options *o = &b->options;
  uint32_t levels = o->render_levels || !(o->render_error_m > 0) ? o->render_levels : SBFI_MAX_RENDER_LEVELS;
  const sbfi_render_recipe recipe = {levels, o->render_error_m, SBFI_BUILD_DERIVATION};
  bool good = sbfi_render_levels_make(b->asset, &recipe, &b->report.render_levels,
      sbfi_build_stretch(b, "render levels", 0.8, 0.89), &b->scratch);
  return good ? SBF_OK : sbfi_build_no_memory(b);
}

/* Totals for reports without reading the geometry. Omitted if they are out of range. */
static sbf_status record_figures(sbfi_build *b) {
  sbf_asset_measures measures;
  sbf_asset_measure(b->asset, &measures);
  if (!(measures.mass <= FLT_MAX)) return SBF_OK;
  b->derivation->mass = (float)measures.mass;
  b->derivation->low = measures.low;
  b->derivation->high = measures.high;
  /* Totals that a conversion stated without a derivation belong to the old asset. */
  b->asset->info.mass = 0;
  b->asset->info.low = b->asset->info.high = (sbf_vec3){0, 0, 0};
  return SBF_OK;
}

/* Hash of the asset's current source parts. */
static sbf_status hash_source(sbfi_build *b) {
  char text[SBFI_SHA256_TEXT_SIZE];
  sbf_status status = sbfi_build_source_hash(b->asset, text, b->error);
  if (status != SBF_OK) return status;
  const char *hash = sbf_asset_copy_text(b->asset, text);
  if (!hash) return sbfi_build_no_memory(b);
  b->derivation->source_hash = hash;
  return SBF_OK;
}

static void store_finding(void *user, const sbf_diagnostic *diagnostic) {
  *(sbf_diagnostic *)user = *diagnostic;
}

/* Extreme sizes and moduli can give numbers that no file may contain. */
static sbf_status check_made(sbfi_build *b) {
  sbf_diagnostic diagnostic;
  if (sbf_asset_check(b->asset, store_finding, &diagnostic, 1) == 0) return SBF_OK;
  if (diagnostic.code == SBF_CODE_OUT_OF_MEMORY) return sbfi_build_no_memory(b);
  sbf_status status = sbfi_diagnose(b->error, SBF_CODE_VALUE_NOT_FINITE,
      "the build computed an invalid number here (%.200s): check the sizes and attributes of the source",
      diagnostic.message);
  if (b->error) memcpy(b->error->path, diagnostic.path, sizeof b->error->path);
  return status;
}

static sbf_status run(sbfi_build *b) {
  static const struct {
    const char *name;
    double done; /* progress before it */
    sbf_status (*run)(sbfi_build *);
  } passes[] = {{"a copy of the source", 0, copy_source}, {"the derivation", 0.05, record_derivation},
      {"sections", 0.06, make_sections}, {"the list of bodies", 0.1, line_up_bodies},
      {"hulls", 0.11, make_hulls}, {"references", 0.15, renumber}, {"joints", 0.18, make_joints},
      {"levels", 0.2, sbfi_body_levels_make}, {"frames of sections", 0.59, make_frames},
      {"embeddings", 0.6, embed}, {"render levels", 0.8, make_render_levels},
      {"unused lattices", 0.89, sbfi_body_lattices_clear}, {"the bounds and the mass", 0.9, record_figures},
      {"the check of the result", 0.92, check_made}, {"the hash of the source", 0.95, hash_source}};
  for (size_t i = 0; i < sizeof passes / sizeof *passes; i++) {
    sbf_status status = sbfi_build_report_progress(b, passes[i].name, passes[i].done);
    if (status == SBF_OK) status = passes[i].run(b);
    if (status != SBF_OK) return status;
  }
  return sbfi_build_report_progress(b, "the last part", 1);
}

sbf_status sbf_build(const sbf_asset *asset, const sbf_build_options *options, sbf_asset **built,
    sbf_build_report *report, sbf_diagnostic *error) {
  *built = NULL;
  sbfi_build b = {.options = options_of(options), .from = asset, .error = error};
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

sbf_status sbf_build_cuts_sections(const sbf_asset *asset, bool *cuts) {
  sbfi_arena scratch;
  sbf_asset view;
  sbfi_arena_init(&scratch, NULL, 0);
  *cuts = false;
  bool good = sbfi_source_view(asset, &scratch, &view) && sbfi_sections_are_wanted(&view, cuts, &scratch);
  sbfi_arena_free(&scratch);
  return good ? SBF_OK : SBF_FAILED;
}
