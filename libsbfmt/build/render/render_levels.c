#include "build/render/render_levels.h"

#include <math.h>
#include <meshoptimizer.h>
#include <string.h>

#include "build/geometry/surface_distance.h"
#include "build/render/wedges.h"

enum { FEWEST_TRIANGLES = 32, RULE_COUNT = 3 };
/* Accepted ratio of a level's triangles to the target. */
static const double NEAR_ENOUGH = 1.15, MIN_STEP = 0.8;

/* Rules from most to least preserved features. */
static const sbfi_wedge_rule rules[RULE_COUNT] = {{true, true}, {false, true}, {false, false}};

typedef struct simplified {
  const sbfi_wedges *wedges;
  uint32_t *triangles; /* (3 * triangle_count) wedges */
  uint32_t triangle_count;
} simplified;

typedef struct level_maker {
  const sbf_render_mesh *mesh;
  sbf_asset *asset;
  sbfi_arena *scratch;
  sbfi_wedges wedges[RULE_COUNT]; /* by rule; without triangles: not yet made */
  sbfi_triangle_tree full;
} level_maker;

/* The simplifier throws if memory runs out, which C cannot catch: so this checks in advance whether enough
 * memory is available. */
static bool has_memory_for(const sbfi_wedges *wedges, const sbf_allocator *allocator) {
  size_t bytes = 192 * (size_t)wedges->count + 96 * (size_t)wedges->triangle_count + 4096;
  void *buffer = sbfi_allocate(allocator, bytes);
  sbfi_free(allocator, buffer, bytes);
  return buffer != NULL;
}

static bool simplify(level_maker *l, int rule, uint32_t target, simplified *made) {
  sbfi_wedges *wedges = &l->wedges[rule];
  if (!wedges->of_corner && !sbfi_wedges_make(wedges, l->mesh, rules[rule], l->scratch)) return false;
  size_t corner_count = 3 * (size_t)wedges->triangle_count;
  *made = (simplified){wedges, sbfi_arena_allocate(l->scratch, corner_count + 1, sizeof(uint32_t)), 0};
  if (!made->triangles || !has_memory_for(wedges, &l->scratch->allocator)) return false;
  size_t count = meshopt_simplify(made->triangles, wedges->triangles, corner_count, &wedges->positions[0].x,
      wedges->count, sizeof *wedges->positions, 3 * (size_t)target, 1e6f, 0, NULL);
  meshopt_optimizeVertexCache(made->triangles, made->triangles, count, wedges->count);
  made->triangle_count = (uint32_t)(count / 3);
  return true;
}

/* Uses the first rule that reaches the target, otherwise the one that comes closest. */
static bool simplify_by_rules(level_maker *l, uint32_t target, simplified *best) {
  for (int rule = 0; rule < RULE_COUNT; rule++) {
    simplified made;
    if (!simplify(l, rule, target, &made)) return false;
    if (rule == 0 || made.triangle_count < best->triangle_count) *best = made;
    if (best->triangle_count <= NEAR_ENOUGH * target) break;
  }
  return true;
}

static uint32_t *new_list(level_maker *l, size_t count) {
  return sbf_asset_allocate(l->asset, count, sizeof(uint32_t));
}

static bool fill_level(level_maker *l, const simplified *made, sbf_render_level *level) {
  const sbf_render_mesh *mesh = l->mesh;
  uint32_t count = made->triangle_count, corner_count = 3 * count;
  bool attributes = mesh->normals.count || mesh->uv_sets.count;
  uint32_t *sizes = new_list(l, count), *points = new_list(l, corner_count);
  uint32_t *corners = attributes ? new_list(l, corner_count) : NULL;
  uint32_t *slots = mesh->polygon_materials.count ? new_list(l, count) : NULL;
  if (!sizes || !points || (attributes && !corners) || (mesh->polygon_materials.count && !slots))
    return false;
  for (uint32_t t = 0; t < count; t++) {
    sizes[t] = 3;
    if (slots) slots[t] = made->wedges->slots[made->triangles[3 * t]];
    for (uint32_t k = 3 * t; k < 3 * t + 3; k++) {
      uint32_t corner = made->wedges->corners[made->triangles[k]];
      points[k] = mesh->mesh.polygon_points.at[corner];
      if (corners) corners[k] = corner;
    }
  }
  level->polygon_sizes = (sbf_u32_list){sizes, count};
  level->polygon_points = (sbf_u32_list){points, corner_count};
  if (slots) level->polygon_materials = (sbf_u32_list){slots, count};
  if (corners) level->corners = (sbf_u32_list){corners, corner_count};
  return true;
}

/* Rounds up, so that a stored error is never below the measured one. */
static float no_less(double value) {
  float near = (float)value;
  return (double)near < value ? nextafterf(near, INFINITY) : near;
}

static bool measure(level_maker *l, sbf_render_level *level, sbfi_progress progress) {
  sbf_polygon_mesh coarse = l->mesh->mesh;
  coarse.polygon_sizes = level->polygon_sizes;
  coarse.polygon_points = level->polygon_points;
  sbfi_triangle_tree tree;
  double distance;
  if (!sbfi_triangle_tree_build(&tree, &coarse, l->scratch)) return false;
  if (!sbfi_surface_distance(&distance, &l->full, &tree, progress)) return false;
  level->error = no_less(distance);
  return true;
}

static bool make_levels(level_maker *l, sbf_render_mesh *mesh, const sbfi_render_recipe *recipe,
    sbf_render_level *levels, sbfi_progress progress) {
  uint32_t level_count = 0;
  uint32_t full = mesh->mesh.polygon_points.count - 2 * mesh->mesh.polygon_sizes.count, before = full;
  for (uint32_t n = 0; n < recipe->levels; n++) {
    sbfi_progress part = sbfi_progress_part(progress, (double)n / recipe->levels, (n + 1.0) / recipe->levels);
    sbf_render_level *level = &levels[level_count];
    uint32_t target = full >> (n + 1);
    simplified made;
    if (target < FEWEST_TRIANGLES) break;
    if (!sbfi_progress_report(part, 0)) return false;
    if (!simplify_by_rules(l, target, &made)) return false;
    if (made.triangle_count < FEWEST_TRIANGLES || made.triangle_count > MIN_STEP * before) break;
    sbf_render_level_init(level);
    level->derived = recipe->derivation;
    if (!fill_level(l, &made, level)) return false;
    if (!measure(l, level, sbfi_progress_part(part, 0.3, 1))) return false;
    if (recipe->error > 0 && (double)level->error > recipe->error) break;
    before = made.triangle_count;
    mesh->levels = (sbf_render_level_list){levels, ++level_count};
  }
  return true;
}

static bool level_mesh(sbf_render_mesh *mesh, const sbfi_render_recipe *recipe, sbf_asset *asset,
    sbfi_progress progress, const sbf_allocator *allocator) {
  sbfi_arena arena;
  sbfi_arena_init(&arena, allocator, 0);
  level_maker l = {.mesh = mesh, .asset = asset, .scratch = &arena};
  sbf_render_level *levels = sbf_asset_allocate(asset, recipe->levels, sizeof *levels);
  bool good = levels && sbfi_triangle_tree_build(&l.full, &mesh->mesh, &arena) &&
              make_levels(&l, mesh, recipe, levels, progress);
  sbfi_arena_free(&arena);
  return good;
}

bool sbfi_render_levels_make(sbf_asset *asset, const sbfi_render_recipe *recipe, uint32_t *made,
    sbfi_progress progress, sbfi_arena *scratch) {
  bool good = true;
  uint32_t count = asset->render_meshes.count;
  for (uint32_t i = 0; i < count && recipe->levels && good; i++) {
    /* The caller guarantees that the asset's structs are writable. */
    sbf_render_mesh *mesh = (sbf_render_mesh *)(uintptr_t)&asset->render_meshes.at[i];
    if (mesh->levels.count || mesh->mesh.polygon_sizes.count == 0) continue;
    good = level_mesh(mesh, recipe, asset, sbfi_progress_part(progress, (double)i / count, (i + 1.0) / count),
        &scratch->allocator);
    *made += mesh->levels.count;
  }
  return good;
}
