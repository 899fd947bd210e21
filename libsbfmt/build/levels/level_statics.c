#include "build/levels/level_statics.h"

#include <math.h>
#include <string.h>

#include "build/levels/loose_pieces.h"
#include "mechanics/vector.h"

/* Fraction of the squared lowest frequency: weak tethers on a free body keep the equations solvable. They
 * move nothing, because loads are balanced. */
static const double tether = 1e-3;

static double component(sbf_vec3 v, int axis) {
  return axis == 0 ? v.x : axis == 1 ? v.y : v.z;
}

/* ---- The network ---- */

static bool acts(const sbf_level *level, const sbf_spring_set *set) {
  return set->extra || level->model == SBF_ELASTIC_MODEL_SPRINGS;
}

static bool add_springs(sbfi_level_statics *s, sbfi_arena *arena) {
  const sbf_level *level = s->level;
  size_t all = 0, used = 0, at = 0;
  for (uint32_t i = 0; i < level->springs.count; i++) {
    all += level->springs.at[i].ends.count;
    if (acts(level, &level->springs.at[i])) used += level->springs.at[i].ends.count;
  }
  if (used == 0) return true;
  uint32_t points = level->positions.count;
  float *every = sbfi_arena_allocate(arena, all, sizeof *every);
  float *stiffness = sbfi_arena_allocate(arena, used, sizeof *stiffness);
  sbf_uint2 *ends = sbfi_arena_allocate(arena, used, sizeof *ends);
  float *volumes = sbfi_arena_allocate(arena, points, sizeof *volumes);
  double *work = sbfi_arena_allocate(arena, points, 2 * sizeof *work);
  if (!every || !stiffness || !ends || !volumes || !work) return false;
  sbf_level_stiffness(s->body, level, volumes, work, every);
  for (uint32_t i = 0; i < level->springs.count; every += level->springs.at[i++].ends.count) {
    const sbf_spring_set *set = &level->springs.at[i];
    if (!acts(level, set)) continue;
    memcpy(ends + at, set->ends.at, set->ends.count * sizeof *ends);
    memcpy(stiffness + at, every, set->ends.count * sizeof *stiffness);
    at += set->ends.count;
  }
  s->network.ends = ends;
  s->network.stiffness = s->stiffness = stiffness;
  s->network.spring_count = (uint32_t)used;
  return true;
}

static bool add_tetrahedra(sbfi_level_statics *s, sbfi_arena *arena) {
  const sbf_uint4_list *at = &s->level->lattice.tetrahedra;
  if (s->level->model != SBF_ELASTIC_MODEL_TETRAHEDRA || at->count == 0) return true;
  float *factors = sbfi_arena_allocate(arena, s->level->positions.count, sizeof *factors);
  float *moduli = sbfi_arena_allocate(arena, at->count, sizeof *moduli);
  float *ratios = sbfi_arena_allocate(arena, at->count, sizeof *ratios);
  if (!factors || !moduli || !ratios) return false;
  sbf_level_moduli(s->body, s->level, factors, moduli);
  for (uint32_t t = 0; t < at->count; t++) ratios[t] = s->body->attributes.poisson_ratio;
  s->network.tetrahedra = at->at;
  s->network.tetrahedron_count = at->count;
  s->network.young_modulus = s->moduli = moduli;
  s->network.poisson_ratios = ratios;
  return true;
}

static float weight_of(const sbf_pin_set *set, uint32_t i) {
  float w = set->weights.count == 0 ? 1 : set->weights.at[set->weights.count == 1 ? 0 : i];
  return fminf(fmaxf(w, set->minimum), set->maximum);
}

/* Newton's method from above: the same bits on every machine. */
static double cube_root(double x) {
  double root = x > 1 ? x : 1, before = 0;
  for (int i = 0; i < 2000 && x > 0 && root != before; i++) {
    before = root;
    root = fmin(root, (2 * root + x / (root * root)) / 3);
  }
  return x > 0 ? root : 0;
}

/* Adds goal springs. */
static bool add_anchors(sbfi_level_statics *s, const float *masses, sbfi_arena *arena) {
  const sbf_attributes *matter = &s->body->attributes;
  float *anchors = sbfi_arena_allocate(arena, s->level->positions.count, sizeof *anchors);
  bool any = false;
  if (!anchors) return false;
  for (uint32_t p = 0; p < s->level->pins.count; p++) {
    const sbf_pin_set *set = &s->level->pins.at[p];
    for (uint32_t i = 0; i < set->points.count; i++) {
      uint32_t point = set->points.at[i];
      float w = weight_of(set, i), k = set->stiffness;
      if (!(w > 0) || w >= 1 || !(masses[point] > 0)) continue;
      if (!(k > 0)) k = matter->young_modulus * (float)cube_root(masses[point] / (double)matter->density);
      anchors[point] += w * k;
      any = true;
    }
  }
  s->network.anchors = any ? anchors : NULL;
  s->is_pinned |= any;
  return true;
}

static bool add_tethers(sbfi_level_statics *s, sbfi_arena *arena) {
  uint32_t count = s->network.point_count;
  float *anchors = sbfi_arena_allocate(arena, (size_t)count + 1, sizeof *anchors);
  if (!anchors) return false;
  double lowest = sbfi_level_lowest(s, arena);
  for (uint32_t i = 0; i < count; i++) anchors[i] = (float)(tether * lowest * lowest * s->network.masses[i]);
  s->network.anchors = anchors;
  return true;
}

/* ---- The surface ---- */

static bool embed_surface(sbfi_level_statics *s, const sbfi_interior_map *interior, sbfi_arena *arena) {
  const sbf_vec3_list *points = &s->body->surface.positions;
  uint32_t frame = s->level->model == SBF_ELASTIC_MODEL_JIGGLE ? 0 : UINT32_MAX;
  s->embedded = sbfi_arena_allocate(arena, (size_t)points->count + 1, sizeof *s->embedded);
  s->areas = sbfi_arena_allocate(arena, (size_t)points->count + 1, sizeof *s->areas);
  if (!s->embedded || !s->areas ||
      !sbfi_embedder_make(&s->embedder, SBFI_EMBEDS_LOADS, s->body, s->level, interior, frame, arena))
    return false;
  sbf_surface_point_areas(&s->body->surface, s->areas);
  for (int k = 0; k < 3; k++) s->low[k] = INFINITY, s->high[k] = -INFINITY;
  for (uint32_t i = 0; i < points->count; i++) {
    s->embedded[i] = sbfi_embedder_embed(&s->embedder, points->at[i], i);
    for (int k = 0; k < 3; k++) {
      s->low[k] = fmin(s->low[k], component(points->at[i], k));
      s->high[k] = fmax(s->high[k], component(points->at[i], k));
    }
  }
  for (int k = 0; k < 3; k++) s->size += (s->high[k] - s->low[k]) * (s->high[k] - s->low[k]);
  s->size = sqrt(s->size);
  return true;
}

bool sbfi_level_statics_make(sbfi_level_statics *statics, const sbf_soft_body *body, const sbf_level *level,
    const sbfi_interior_map *interior, sbfi_arena *arena) {
  uint32_t count = level->positions.count;
  *statics = (sbfi_level_statics){
      .body = body, .level = level, .network = {.point_count = count, .positions = level->positions.at}};
  uint8_t *pinned = sbfi_arena_allocate(arena, (size_t)count + 1, 1);
  float *masses = sbfi_arena_allocate(arena, (size_t)count + 1, sizeof *masses);
  if (!pinned || !masses) return false;
  statics->is_pinned = sbf_level_pinned_points(level, pinned) > 0;
  statics->mass = sbf_level_masses(body, level, pinned, masses);
  statics->network.masses = masses;
  if (!add_springs(statics, arena) || !add_tetrahedra(statics, arena) ||
      !add_anchors(statics, masses, arena) || !embed_surface(statics, interior, arena))
    return false;
  double loose_kg;
  if (!sbfi_loose_pieces_pin(&statics->network, statics->is_pinned, masses, &loose_kg, arena) ||
      !sbfi_pieces_can_rotate(&statics->network, statics->size, &statics->can_rotate, arena))
    return false;
  statics->mass -= loose_kg;
  if (!statics->is_pinned && !add_tethers(statics, arena)) return false;
  statics->load_count = statics->is_pinned ? SBFI_PINNED_LOADS : SBFI_FREE_LOADS;
  return true;
}

double sbfi_level_lowest(const sbfi_level_statics *s, sbfi_arena *scratch) {
  double *work = sbfi_arena_allocate(scratch, s->network.point_count, 16 * sizeof *work);
  return work ? sbf_network_lowest(&s->network, false, work) : 0;
}

double sbfi_level_cost(const sbfi_level_statics *s, double tick, sbfi_arena *scratch) {
  double *work = sbfi_arena_allocate(scratch, s->network.point_count, 6 * sizeof *work);
  if (!work) return 0;
  double highest = sbf_network_highest(&s->network, 20, work);
  double substeps = fmax(1, ceil(1.1 * tick * highest / 2));
  return substeps * ((double)s->network.spring_count + s->network.tetrahedron_count);
}
