/* The detail levels of a model except its first: coarser levels, jiggle, bones only, offscreen. */
#include "base/diagnostic.h"
#include "prepare/prepare.h"
#include "soft/solvers/scheme.h"

/* Error of a level without a stated one, as a fraction of the body's size: about that of an oscillating body.
 */
static const float UNSTATED_FRACTION = 0.02f;

/* Other costs of a tick in visits of tetrahedra, each of which takes 6 ns: a visit of a spring, or of a point
 * by a region; a substep of an island in addition to those; a gait and its pose; a follower; a character that
 * moves without a pose. Measured: 1.9 ns, 1 us, 5 us, 50 ns and 0.5 us. */
static const float SPRING_VISITS = 0.33f, SUBSTEP_VISITS = 150;
static const float GAIT_VISITS = 800, FOLLOWER_VISITS = 8, AWAY_VISITS = 80;

enum { MAX_DETAIL_LEVELS = 16 };

static sbf_status no_memory(sbf_diagnostic *error) {
  return sbfi_diagnose(error, SBF_CODE_OUT_OF_MEMORY, "no memory for the model's levels of detail");
}

/* ---- Selection of levels ---- */

static bool any_jiggle(const sbr_model *model) {
  for (uint32_t b = 0; b < model->asset->soft_bodies.count; b++)
    if (sbri_jiggle_of(model, b)) return true;
  return false;
}

static bool any_stepped(const sbf_asset *asset, uint32_t level) {
  for (uint32_t b = 0; b < asset->soft_bodies.count; b++) {
    const sbf_level_list *levels = &asset->soft_bodies.at[b].levels;
    if (level < levels->count && sbri_level_is_stepped(&levels->at[level])) return true;
  }
  return false;
}

static uint32_t max_levels(const sbf_asset *asset) {
  uint32_t max = 0;
  for (uint32_t b = 0; b < asset->soft_bodies.count; b++) {
    uint32_t count = asset->soft_bodies.at[b].levels.count;
    max = count > max ? count : max;
  }
  return max;
}

/* A body that yields or tears has a shape that no other level has, and relaxation has no velocities. */
static bool has_single_level(const sbr_model *model) {
  for (uint32_t i = 0; i < model->island_count; i++) {
    const sbri_island *island = &model->islands[i];
    if (island->links.flows || island->tetrahedra.flow || island->splits || island->scheme->forceless)
      return true;
  }
  return false;
}

static bool is_point_pinned(const sbr_model *model) {
  for (uint32_t b = 0; b < model->asset->soft_bodies.count; b++)
    if (model->bodies[b].level && !model->bodies[b].is_pinned) return false;
  return true;
}

/* ---- Errors and costs ---- */

/* The error measured in motion if the file states it, else the error under gravity. */
static float stated_error(const sbf_level *level) {
  if (!level) return 0;
  return level->simulation.motion_error > 0 ? level->simulation.motion_error : level->simulation.error;
}

/* Visits of each tetrahedron and of each spring in a substep: block descent makes four sweeps, over every
 * point of an element. */
static float visits_per_substep(const sbri_island *island, bool solid) {
  if (island->scheme->kind == SBF_SCHEME_HEUN) return 2;
  if (island->scheme->kind == SBF_SCHEME_BLOCK_DESCENT) return solid ? 16 : 8;
  return 1;
}

static float error_of(const sbri_body *body, const sbf_level *level, bool is_finest) {
  float stated = stated_error(level);
  if (stated > 0 && !sbri_level_has_failed(level, body->rest_size_m)) return stated;
  return is_finest ? 0 : UNSTATED_FRACTION * body->rest_size_m;
}

static void rate(const sbr_model *model, sbr_detail_level *detail_level) {
  const sbr_model *base = model->detail.base;
  detail_level->error_m = 0;
  detail_level->visits = detail_level->kind == SBR_DETAIL_OFFSCREEN ? AWAY_VISITS : GAIT_VISITS;
  if (detail_level->kind == SBR_DETAIL_JIGGLE)
    detail_level->visits += FOLLOWER_VISITS * (float)model->jiggle_count;
  for (uint32_t b = 0; b < model->asset->soft_bodies.count; b++) {
    const sbri_body *body = &base->bodies[b];
    if (!body->level) continue;
    const sbf_level *level =
        detail_level->kind == SBR_DETAIL_SOFT ? model->bodies[b].level : sbri_jiggle_of(model, b);
    float error = error_of(body, level, level == body->level);
    detail_level->error_m = error > detail_level->error_m ? error : detail_level->error_m;
  }
  for (uint32_t i = 0; detail_level->kind == SBR_DETAIL_SOFT && i < model->island_count; i++) {
    const sbri_island *island = &model->islands[i];
    uint32_t members = 0;
    for (uint32_t k = 0; k < island->regions.block_count; k++)
      members += SBRI_BLOCK * island->regions.blocks[k].member_count;
    float visits =
        visits_per_substep(island, true) * (float)island->tetrahedra.count +
        visits_per_substep(island, false) * SPRING_VISITS * (float)(island->springs.count + members) +
        SUBSTEP_VISITS;
    detail_level->visits +=
        visits * (float)sbri_scheme_substeps(island, 1.0 / 60, island->springs.rest_stretch);
  }
}

/* ---- Build ---- */

static sbf_status make_detail_level(
    sbr_model *base, const sbr_model_options *options, sbr_detail_level detail_level, sbf_diagnostic *error) {
  sbf_allocator allocator = base->arena.allocator;
  sbr_model *made = sbfi_allocate(&allocator, sizeof *made);
  if (!made) return no_memory(error);
  *made = (sbr_model){
      .asset = base->asset, .kernels = base->kernels, .detail.kind = detail_level.kind, .detail.base = base};
  sbfi_arena_init(&made->arena, &allocator, 0);
  base->detail.levels[base->detail.level_count] = made;
  base->detail.definitions[base->detail.level_count++] = detail_level;
  sbr_model_options own = *options;
  own.level = detail_level.level;
  return sbri_model_prepare(made, &own, error);
}

/* Drops soft levels that cost as much as the one before. */
static void drop_last(sbr_model *base) {
  sbr_model *last = base->detail.levels[--base->detail.level_count];
  sbf_allocator allocator = last->arena.allocator;
  sbfi_arena_free(&last->arena);
  sbfi_free(&allocator, last, sizeof *last);
}

static sbf_status make_coarser(sbr_model *base, const sbr_model_options *options, sbf_diagnostic *error) {
  sbf_status status = SBF_OK;
  for (uint32_t level = options->level + 1; status == SBF_OK && level < max_levels(base->asset) &&
                                            base->detail.level_count < MAX_DETAIL_LEVELS - 3;
       level++) {
    if (!any_stepped(base->asset, level)) continue;
    status =
        make_detail_level(base, options, (sbr_detail_level){.kind = SBR_DETAIL_SOFT, .level = level}, error);
    if (status != SBF_OK) return status;
    uint32_t last = base->detail.level_count - 1;
    if (has_single_level(base->detail.levels[last]) ||
        is_point_pinned(base->detail.levels[last]) != is_point_pinned(base)) {
      drop_last(base);
      continue;
    }
    rate(base->detail.levels[last], &base->detail.definitions[last]);
    if (base->detail.definitions[last].visits >= base->detail.definitions[last - 1].visits) drop_last(base);
  }
  return status;
}

static sbf_status make_levels_without_soft(
    sbr_model *base, const sbr_model_options *options, sbf_diagnostic *error) {
  sbf_status status = SBF_OK;
  if (!is_point_pinned(base)) return status;
  if (any_jiggle(base))
    status = make_detail_level(base, options, (sbr_detail_level){.kind = SBR_DETAIL_JIGGLE}, error);
  if (status == SBF_OK)
    status = make_detail_level(base, options, (sbr_detail_level){.kind = SBR_DETAIL_BONES}, error);
  if (status != SBF_OK) return status;
  base->detail.levels[base->detail.level_count] = base->detail.levels[base->detail.level_count - 1];
  base->detail.definitions[base->detail.level_count++] = (sbr_detail_level){.kind = SBR_DETAIL_OFFSCREEN};
  for (uint32_t r = 1; r < base->detail.level_count; r++)
    if (base->detail.definitions[r].kind != SBR_DETAIL_SOFT)
      rate(base->detail.levels[r], &base->detail.definitions[r]);
  return SBF_OK;
}

static bool number_vertices(sbr_model *base) {
  uint32_t meshes = base->asset->render_meshes.count;
  uint32_t *first = sbfi_arena_allocate(&base->arena, (size_t)meshes + 1, sizeof *first);
  for (uint32_t i = 0; first && i < meshes; i++)
    first[i + 1] = first[i] + base->asset->render_meshes.at[i].mesh.positions.count;
  base->detail.first_vertices = first;
  return first != NULL;
}

/* ---- Oscillation of bodies ---- */

/* Frequency of a body without a jiggle. */
static const float SWINGS_HZ = 8;
static const float TWO_PI = 6.2831853f;

static void note_embedding(const sbr_model *base, uint32_t body, uint32_t *with, float *fractions) {
  const sbf_embedding_list *all = &base->bodies[body].level->embeddings;
  for (uint32_t e = 0; e < all->count; e++) {
    const sbf_embedding *one = &all->at[e];
    uint32_t mesh = (uint32_t)one->render_mesh;
    if (one->render_mesh < 0) continue;
    uint32_t first = base->detail.first_vertices[mesh], count = base->detail.first_vertices[mesh + 1] - first;
    for (uint32_t i = 0; i < one->points.count; i++) {
      uint32_t vertex = one->vertices.count ? one->vertices.at[i] : i;
      float blend = one->blends.count ? one->blends.at[i] : 1;
      if (vertex >= count || !(blend > fractions[first + vertex])) continue;
      fractions[first + vertex] = blend, with[first + vertex] = body;
    }
  }
}

/* The body with the largest weight in each vertex, and its frequency. */
static bool store_swings(sbr_model *base) {
  uint32_t bodies = base->asset->soft_bodies.count;
  size_t vertices = base->detail.first_vertices[base->asset->render_meshes.count];
  uint32_t *with = sbfi_arena_allocate(&base->arena, vertices + 1, sizeof *with);
  float *rad_s = sbfi_arena_allocate(&base->arena, (size_t)bodies + 1, sizeof *rad_s);
  float *fractions = sbfi_allocate(&base->arena.allocator, (vertices + 1) * sizeof *fractions);
  if (!with || !rad_s || !fractions) {
    sbfi_free(&base->arena.allocator, fractions, (vertices + 1) * sizeof *fractions);
    return false;
  }
  for (size_t v = 0; v < vertices; v++) with[v] = bodies, fractions[v] = 0;
  for (uint32_t b = 0; b <= bodies; b++) {
    const sbf_level *level = b < bodies ? sbri_jiggle_of(base, b) : NULL;
    rad_s[b] = TWO_PI * (level && level->jiggle->frequency > 0 ? level->jiggle->frequency : SWINGS_HZ);
    if (b < bodies && base->bodies[b].level) note_embedding(base, b, with, fractions);
  }
  sbfi_free(&base->arena.allocator, fractions, (vertices + 1) * sizeof *fractions);
  base->detail.swings_with = with, base->detail.swing_rad_s = rad_s;
  return true;
}

/* ---- Sources of changes ---- */

static bool make_sources(sbr_model *base) {
  for (uint32_t to = 0; to < base->detail.level_count; to++) {
    sbr_model *model = base->detail.levels[to];
    if (base->detail.definitions[to].kind != SBR_DETAIL_SOFT) continue;
    model->detail.sources =
        sbfi_arena_allocate(&model->arena, base->detail.level_count, sizeof *model->detail.sources);
    if (!model->detail.sources) return false;
    for (uint32_t from = 0; from < base->detail.level_count; from++)
      if (from != to && base->detail.definitions[from].kind == SBR_DETAIL_SOFT &&
          !sbri_sources_make(model, base->detail.levels[from], &model->detail.sources[from]))
        return false;
  }
  return true;
}

sbf_status sbri_detail_levels_make(
    sbr_model *model, const sbr_model_options *options, sbf_diagnostic *error) {
  model->detail.levels = sbfi_arena_allocate(&model->arena, MAX_DETAIL_LEVELS, sizeof(sbr_model *));
  model->detail.definitions =
      sbfi_arena_allocate(&model->arena, MAX_DETAIL_LEVELS, sizeof *model->detail.definitions);
  if (!model->detail.levels || !model->detail.definitions) return no_memory(error);
  model->detail.levels[0] = model;
  model->detail.definitions[0] = (sbr_detail_level){.kind = SBR_DETAIL_SOFT, .level = options->level};
  model->detail.level_count = 1;
  rate(model, &model->detail.definitions[0]);
  if (options->detail_levels && !has_single_level(model)) {
    sbf_status status = make_coarser(model, options, error);
    if (status == SBF_OK) status = make_levels_without_soft(model, options, error);
    if (status != SBF_OK) return status;
    if (!number_vertices(model) || !store_swings(model) || !make_sources(model)) return no_memory(error);
  }
  for (uint32_t r = 0; r < model->detail.level_count; r++) {
    uint32_t islands = model->detail.levels[r]->island_count;
    model->detail.max_islands = islands > model->detail.max_islands ? islands : model->detail.max_islands;
    if (r > 0 && model->detail.definitions[r].error_m < model->detail.definitions[r - 1].error_m)
      model->detail.definitions[r].error_m = model->detail.definitions[r - 1].error_m;
  }
  return SBF_OK;
}

void sbri_detail_levels_free(sbr_model *model) {
  for (uint32_t r = model->detail.level_count; r-- > 1;) {
    sbr_model *one = model->detail.levels[r];
    if (one == model->detail.levels[r - 1]) continue; /* offscreen */
    sbf_allocator allocator = one->arena.allocator;
    sbfi_arena_free(&one->arena);
    sbfi_free(&allocator, one, sizeof *one);
  }
}
