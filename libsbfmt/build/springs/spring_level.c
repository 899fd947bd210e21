#include "build/springs/spring_level.h"

#include <string.h>

#include "build/geometry/triangle_tree.h"
#include "build/sections/level_pins.h"
#include "build/springs/springs.h"
#include "build/springs/springs_matched.h"
#include "mechanics/level_points.h"
#include "mechanics/polygon.h"
#include "sbfmt/mechanics.h"

/* State of building one body's level. */
typedef struct work {
  const sbf_soft_body *body;
  const sbfi_spring_recipe *recipe;
  sbf_asset *asset;
  sbfi_arena *scratch;
  sbf_level *level;
  sbf_body_measures measures;
  sbfi_surface_springs surface;
  sbfi_centroid_interior interior; /* or a lattice's points and springs, without points for polygons */
  double cell;                     /* of a lattice; 0: none */
  uint32_t deep_count;             /* interior points that are pinned to a bone */
  bool one_network;
  float *damping;            /* (point_count) factors on stiffness_damping; NULL: none stated */
  sbfi_spring_list internal; /* those of the interior, then those of authored points */
  uint32_t surface_count, source_count, point_count;
  uint8_t *pinned; /* (point_count) */
} work;

static bool set_points(work *w) {
  const sbf_vec3_list *surface = &w->body->surface.positions, *authored = &w->body->interior;
  size_t count = (size_t)surface->count + authored->count + w->interior.point_count;
  if (count >= UINT32_MAX) return false;
  sbf_vec3 *positions = sbf_asset_allocate(w->asset, count, sizeof *positions);
  if (!positions) return false;
  memcpy(positions, surface->at, surface->count * sizeof *positions);
  if (authored->count) memcpy(positions + surface->count, authored->at, authored->count * sizeof *positions);
  w->source_count = surface->count + authored->count;
  w->point_count = (uint32_t)count;
  if (w->interior.point_count)
    memcpy(positions + w->source_count, w->interior.points, w->interior.point_count * sizeof *positions);
  w->level->positions = (sbf_vec3_list){positions, w->point_count};
  return true;
}

/* An authored interior point is connected to the corners of the nearest polygon, and to the centre. */
static bool join_authored(work *w) {
  const sbf_polygon_mesh *mesh = &w->body->surface;
  uint32_t authored = w->body->interior.count;
  w->internal = w->interior.internal;
  if (authored == 0) return true;
  sbfi_triangle_tree tree;
  if (!sbfi_triangle_tree_build(&tree, mesh, w->scratch)) return false;
  sbfi_array springs;
  sbfi_array_init(&springs, &w->scratch->allocator, sizeof(sbf_uint2));
  bool good = sbfi_array_append(&springs, w->internal.at, w->internal.count);
  for (uint32_t i = 0; good && i < authored; i++) {
    double min = INFINITY;
    uint32_t point = w->surface_count + i;
    uint32_t triangle = sbfi_triangle_tree_nearest(&tree, w->body->interior.at[i], &min);
    for (int k = 0; good && k < 3 && triangle != UINT32_MAX; k++)
      good = sbfi_array_append(&springs, &(sbf_uint2){{point, tree.triangles[triangle].points[k]}}, 1);
    if (good && w->interior.polygon_points)
      good = sbfi_array_append(&springs, &(sbf_uint2){{w->source_count, point}}, 1);
  }
  if (good) {
    w->internal.count = (uint32_t)springs.count;
    w->internal.at = sbfi_arena_copy(w->scratch, springs.at, springs.count, sizeof(sbf_uint2));
    good = springs.count == 0 || w->internal.at;
  }
  sbfi_array_free(&springs);
  return good;
}

static bool is_core_pinned(const work *w) {
  return w->body->bone != SBF_NONE && w->interior.point_count > 0;
}

/* Volume fractions of all points of a body with a free interior; see spring_level.h. Points in no polygon
 * count as the mean of the polygons' corners. */
static void distribute_by_pyramids(const work *w, float *fractions) {
  const sbf_polygon_mesh *mesh = &w->body->surface;
  const uint32_t *corners = mesh->polygon_points.at;
  uint32_t used = 0;
  double sum = 0, at_corners = 0;
  memset(fractions, 0, w->point_count * sizeof *fractions);
  for (uint32_t p = 0; p < mesh->polygon_sizes.count; corners += mesh->polygon_sizes.at[p++]) {
    uint32_t size = mesh->polygon_sizes.at[p], own = w->interior.polygon_points[p];
    sbfi_d3 middle = sbfi_polygon_middle(mesh->positions.at, corners, size);
    double area = sbfi_d3_length(sbfi_polygon_area(mesh->positions.at, corners, size, middle));
    if (own != SBFI_NO_INDEX) fractions[w->source_count + own] += (float)(0.25 * area);
    fractions[w->source_count] += (float)((own != SBFI_NO_INDEX ? 0.2 : 0.25) * area);
    float corner = (float)((own != SBFI_NO_INDEX ? 0.55 : 0.75) * area / size);
    for (uint32_t k = 0; k < size; k++) fractions[corners[k]] += corner;
  }
  for (uint32_t i = 0; i < w->surface_count; i++) {
    at_corners += fractions[i];
    used += fractions[i] > 0;
  }
  float mean = used ? (float)(at_corners / used) : 1;
  for (uint32_t i = 0; i < w->point_count; i++) {
    if (!(fractions[i] > 0)) fractions[i] = mean;
    sum += fractions[i];
  }
  for (uint32_t i = 0; i < w->point_count; i++) fractions[i] = (float)(fractions[i] / sum);
}

/* Volume fractions of all points of a body with a lattice inside; see spring_level.h. Nodes have at most four
 * fifths of it. */
static void distribute_by_lattice(const work *w, float *fractions) {
  sbf_level surface;
  sbf_level_init(&surface);
  surface.positions = w->body->surface.positions;
  double node = w->cell * w->cell * w->cell / 2, volume = w->measures.volume,
         max = 0.97 / w->interior.point_count;
  double fraction = volume > 0 && node / volume < max ? node / volume : max;
  sbf_level_mass_fractions(w->body, &surface, NULL, fractions);
  for (uint32_t i = w->surface_count; i < w->source_count; i++) fractions[i] = 1.0f / (float)w->source_count;
  for (uint32_t i = 0; i < w->source_count; i++)
    fractions[i] *= (float)(1 - fraction * w->interior.point_count);
  for (uint32_t i = w->source_count; i < w->point_count; i++) fractions[i] = (float)fraction;
}

static float *make_volumes(const work *w, bool pyramids) {
  float *volumes = sbfi_arena_allocate(w->scratch, w->point_count, sizeof *volumes);
  if (!volumes) return NULL;
  if (w->cell > 0) {
    distribute_by_lattice(w, volumes);
  } else if (pyramids) {
    distribute_by_pyramids(w, volumes);
  } else {
    sbf_level surface;
    sbf_level_init(&surface);
    surface.positions = w->body->surface.positions;
    sbf_level_mass_fractions(w->body, &surface, NULL, volumes);
    /* Authored interior points have no area either, and count as the mean too. */
    for (uint32_t i = w->surface_count; i < w->source_count; i++) volumes[i] = 1.0f / (float)w->surface_count;
  }
  for (uint32_t i = 0; i < w->point_count; i++) volumes[i] *= (float)w->measures.volume;
  sbfi_level_weigh(w->body, w->level, SBF_WEIGHT_PROPERTY_YOUNG_MODULUS, volumes);
  return volumes;
}

static bool make_network(const work *w, double modulus, const float *volumes, const sbf_uint2 *ends,
    uint32_t count, float *stiffness) {
  double *sums = sbfi_arena_allocate(w->scratch, w->point_count, 2 * sizeof *sums);
  if (sums)
    sbf_stiffness_of_network(
        modulus, w->level->positions.at, w->point_count, volumes, ends, count, sums, stiffness);
  return sums != NULL;
}

/* Anchored springs by the pyramids; authored ones between two free points as a separate network. */
static bool make_internal_of_pinned_core(const work *w, const float *volumes, float *stiffness) {
  uint32_t count = w->internal.count, free_count = 0;
  double modulus = w->body->attributes.young_modulus;
  double *sums = sbfi_arena_allocate(w->scratch, w->point_count, 9 * sizeof *sums);
  sbf_uint2 *free_ends = sbfi_arena_allocate(w->scratch, count, sizeof *free_ends);
  float *free_stiffness = sbfi_arena_allocate(w->scratch, count, sizeof *free_stiffness);
  sbf_vec3 *normals = sbfi_arena_allocate(w->scratch, w->point_count, sizeof *normals);
  if (!sums || !free_ends || !free_stiffness || !normals) return false;
  sbf_surface_point_normals(&w->body->surface, normals);
  sbf_stiffness_of_anchors(modulus, w->measures.depth, normals, w->level->positions.at, w->point_count,
      volumes, w->pinned, w->internal.at, count, sums, stiffness);
  for (uint32_t s = 0; s < count; s++)
    if (!w->pinned[w->internal.at[s].at[0]] && !w->pinned[w->internal.at[s].at[1]])
      free_ends[free_count++] = w->internal.at[s];
  if (!make_network(w, SBF_STIFFNESS_ANCHOR * modulus, volumes, free_ends, free_count, free_stiffness))
    return false;
  for (uint32_t s = 0, next = 0; s < count; s++)
    if (!w->pinned[w->internal.at[s].at[0]] && !w->pinned[w->internal.at[s].at[1]])
      stiffness[s] = free_stiffness[next++];
  return true;
}

/* All springs as one network. */
static bool make_stiffness_of_all(const work *w, float *stiffness) {
  const sbfi_spring_list lists[] = {w->surface.structural, w->surface.shear, w->surface.flexion, w->internal};
  size_t total = 1;
  uint32_t next = 0;
  for (int i = 0; i < 4; i++) total += lists[i].count;
  sbf_uint2 *ends = sbfi_arena_allocate(w->scratch, total, sizeof *ends);
  float *volumes = make_volumes(w, false);
  if (!ends || !volumes) return false;
  for (int i = 0; i < 4; i++)
    for (uint32_t s = 0; s < lists[i].count; s++) ends[next++] = lists[i].at[s];
  double modulus = w->body->attributes.young_modulus;
  if (w->measures.sheet)
    return make_network(w, SBF_STIFFNESS_SHEET * modulus, volumes, ends, next, stiffness);
  return sbfi_springs_matched(modulus, w->level->positions.at, w->point_count, volumes, ends, next, stiffness,
      sbfi_progress_part(w->recipe->progress, 0.5, 1), w->scratch);
}

/* `stiffness` receives structural, shear, flexion and internal springs, one after the other. */
static bool make_stiffness(const work *w, float *stiffness) {
  if (w->one_network) return make_stiffness_of_all(w, stiffness);
  const sbfi_surface_springs *on = &w->surface;
  uint32_t count = on->structural.count + on->shear.count + on->flexion.count;
  double modulus = w->body->attributes.young_modulus;
  sbf_uint2 *ends = sbfi_arena_allocate(w->scratch, (size_t)count + 1, sizeof *ends);
  float *volumes = make_volumes(w, false);
  if (!ends || !volumes) return false;
  memcpy(ends, on->structural.at, on->structural.count * sizeof *ends);
  memcpy(ends + on->structural.count, on->shear.at, on->shear.count * sizeof *ends);
  memcpy(ends + count - on->flexion.count, on->flexion.at, on->flexion.count * sizeof *ends);
  double constant = w->interior.point_count ? SBF_STIFFNESS_MEMBRANE : SBF_STIFFNESS_VOLUME;
  if (w->measures.sheet) constant = SBF_STIFFNESS_SHEET;
  if (!make_network(w, constant * modulus, volumes, ends, count, stiffness)) return false;
  if (w->internal.count == 0) return true;
  if (is_core_pinned(w)) return make_internal_of_pinned_core(w, volumes, stiffness + count);
  if (w->interior.point_count) volumes = make_volumes(w, true);
  return volumes && make_network(w, SBF_STIFFNESS_ANCHOR * modulus, volumes, w->internal.at,
                        w->internal.count, stiffness + count);
}

static bool is_inert(const work *w, sbf_uint2 ends) {
  return w->pinned[ends.at[0]] && w->pinned[ends.at[1]];
}

/* Springs between two points at the same position cannot be stretched; no format or scheme uses them. */
static bool is_nothing(const work *w, sbf_uint2 ends) {
  sbf_vec3 a = w->level->positions.at[ends.at[0]], b = w->level->positions.at[ends.at[1]];
  return a.x == b.x && a.y == b.y && a.z == b.z;
}

/* Writes the set of one kind without springs between pinned points and those without length; nothing if it
 * would be empty. */
static bool add_set(work *w, sbf_spring_kind kind, sbfi_spring_list list, const float *stiffness,
    sbf_spring_set *sets, sbfi_spring_counts *counts) {
  uint32_t kept = 0, inert = 0;
  for (uint32_t s = 0; s < list.count; s++) {
    inert += is_inert(w, list.at[s]);
    kept += !is_inert(w, list.at[s]) && !is_nothing(w, list.at[s]);
  }
  if (kept + inert == 0) return true;
  sbf_uint2 *ends = kept ? sbf_asset_allocate(w->asset, kept, sizeof *ends) : NULL;
  float *values = kept ? sbf_asset_allocate(w->asset, kept, sizeof *values) : NULL;
  float *damping = kept && w->damping ? sbf_asset_allocate(w->asset, kept, sizeof *damping) : NULL;
  if (kept && (!ends || !values || (w->damping && !damping))) return false;
  sbf_spring_set *set = &sets[w->level->springs.count++];
  sbf_spring_set_init(set);
  set->kind = kind;
  set->derived = w->recipe->derivation;
  set->inert_count = inert;
  set->ends = (sbf_uint2_list){ends, kept};
  set->stiffness = (sbf_f32_list){values, kept};
  set->damping = (sbf_f32_list){damping, damping ? kept : 0};
  for (uint32_t s = 0, next = 0; s < list.count; s++) {
    if (is_inert(w, list.at[s]) || is_nothing(w, list.at[s])) continue;
    ends[next] = list.at[s];
    if (damping)
      damping[next] = w->body->attributes.stiffness_damping * stiffness[s] *
                      (w->damping[list.at[s].at[0]] + w->damping[list.at[s].at[1]]) / 2;
    values[next++] = stiffness[s];
  }
  counts->springs[kind] += kept;
  counts->inert += inert;
  return true;
}

/* Factors of the weight map, if there is one and damping to scale. */
static bool weigh_damping(work *w) {
  bool mapped = false;
  for (uint32_t m = 0; m < w->body->weight_maps.count; m++)
    mapped |= w->body->weight_maps.at[m].property == SBF_WEIGHT_PROPERTY_STIFFNESS_DAMPING;
  if (!mapped || !(w->body->attributes.stiffness_damping > 0)) return true;
  w->damping = sbfi_arena_allocate(w->scratch, w->point_count, sizeof *w->damping);
  if (!w->damping) return false;
  for (uint32_t i = 0; i < w->point_count; i++) w->damping[i] = 1;
  sbfi_level_weigh(w->body, w->level, SBF_WEIGHT_PROPERTY_STIFFNESS_DAMPING, w->damping);
  return true;
}

static bool add_springs(work *w, sbfi_spring_counts *counts) {
  const sbfi_spring_list lists[] = {w->surface.structural, w->surface.shear, w->surface.flexion, w->internal};
  const sbf_spring_kind kinds[] = {
      SBF_SPRING_KIND_STRUCTURAL, SBF_SPRING_KIND_SHEAR, SBF_SPRING_KIND_FLEXION, SBF_SPRING_KIND_INTERNAL};
  size_t total = 1;
  for (int i = 0; i < 4; i++) total += lists[i].count;
  sbf_spring_set *sets = sbf_asset_allocate(w->asset, 4, sizeof *sets);
  float *stiffness = sbfi_arena_allocate(w->scratch, total, sizeof *stiffness);
  if (!sets || !stiffness || !make_stiffness(w, stiffness) || !weigh_damping(w)) return false;
  w->level->springs = (sbf_spring_set_list){sets, 0};
  for (int i = 0; i < 4; i++) {
    if (!add_set(w, kinds[i], lists[i], stiffness, sets, counts)) return false;
    stiffness += lists[i].count;
  }
  if (w->level->springs.count == 0) w->level->springs.at = NULL;
  return true;
}

/* Masses of a body with a free interior; sbf_level_masses would assign interior points too little mass. */
static bool state_masses(work *w) {
  float *masses = sbf_asset_allocate(w->asset, w->point_count, sizeof *masses);
  if (!masses) return false;
  double sum = 0;
  if (w->cell > 0)
    distribute_by_lattice(w, masses);
  else
    distribute_by_pyramids(w, masses);
  for (uint32_t i = 0; i < w->point_count; i++) sum += masses[i] = w->pinned[i] ? 0 : masses[i];
  for (uint32_t i = 0; i < w->point_count && sum > 0; i++)
    masses[i] = (float)(masses[i] / sum * w->measures.mass);
  sbfi_level_weigh(w->body, w->level, SBF_WEIGHT_PROPERTY_DENSITY, masses);
  w->level->masses = (sbf_f32_list){masses, w->point_count};
  return true;
}

static bool map_interior(const work *w, sbfi_interior_map *map) {
  uint32_t polygons = w->body->surface.polygon_sizes.count;
  *map = (sbfi_interior_map){.centre = w->interior.polygon_points ? w->source_count : SBFI_NO_INDEX};
  if (!w->interior.polygon_points || polygons == 0) return true;
  map->polygon_points = sbfi_arena_allocate(w->scratch, polygons, sizeof *map->polygon_points);
  for (uint32_t p = 0; map->polygon_points && p < polygons; p++) {
    uint32_t own = w->interior.polygon_points[p];
    map->polygon_points[p] = own == SBFI_NO_INDEX ? own : w->source_count + own;
  }
  return map->polygon_points != NULL;
}

static bool make_interior(work *w) {
  const sbf_soft_body *body = w->body;
  sbfi_lattice_interior lattice;
  switch (w->recipe->interior) {
  case SBFI_INTERIOR_NONE:
    break;
  case SBFI_INTERIOR_CENTROID:
    if (!sbfi_springs_centroid(&w->interior, &body->surface, body->interior.count, w->scratch)) return false;
    w->deep_count = w->interior.point_count;
    break;
  case SBFI_INTERIOR_LATTICE:
    if (!sbfi_springs_lattice(&lattice, &body->surface, body->interior.count, w->recipe->cell,
            sbfi_progress_part(w->recipe->progress, 0, 0.5), w->scratch))
      return false;
    if (lattice.point_count == 0) break;
    w->interior = (sbfi_centroid_interior){lattice.points, lattice.point_count, NULL, lattice.internal};
    w->cell = lattice.cell;
    w->deep_count = lattice.deep_count;
    w->level->cell = (float)lattice.cell;
    break;
  case SBFI_INTERIOR_BRUTE:
    if (!sbfi_springs_brute(&w->interior.internal, w->surface_count, &w->surface, w->scratch)) return false;
    break;
  }
  w->one_network = w->cell > 0 || w->recipe->interior == SBFI_INTERIOR_BRUTE;
  return true;
}

bool sbfi_spring_level_make(sbf_level *level, const sbf_soft_body *body, const sbfi_spring_recipe *recipe,
    sbf_asset *asset, sbfi_interior_map *map, sbfi_spring_counts *counts, sbfi_arena *scratch) {
  work w = {.body = body,
      .recipe = recipe,
      .asset = asset,
      .scratch = scratch,
      .level = level,
      .surface_count = body->surface.positions.count};
  sbfi_topology topology;
  sbf_level_init(level);
  *counts = (sbfi_spring_counts){0};
  level->derived = recipe->derivation;
  level->name = sbf_asset_copy_text(asset, "springs");
  sbf_body_measure(body, &w.measures);
  if (!level->name || !sbfi_topology_build(&topology, &body->surface, scratch)) return false;
  if (!sbfi_springs_surface(&w.surface, &body->surface, &topology, recipe->flexion, scratch)) return false;
  if (!make_interior(&w) || !set_points(&w) || !join_authored(&w) || !map_interior(&w, map)) return false;
  uint32_t to_bone = is_core_pinned(&w) ? w.deep_count : 0;
  uint32_t *core = sbfi_arena_allocate(scratch, (size_t)to_bone + 1, sizeof *core);
  if (!core) return false;
  for (uint32_t i = 0; i < to_bone; i++) core[i] = w.source_count + i;
  if (!sbfi_level_pins_make(level, body, recipe->derivation, asset, core, to_bone, scratch)) return false;
  w.pinned = sbfi_arena_allocate(scratch, w.point_count, 1);
  if (!w.pinned) return false;
  sbf_level_pinned_points(level, w.pinned);
  if (w.interior.point_count && (!to_bone || w.cell > 0) && w.measures.mass > 0 && !state_masses(&w))
    return false;
  counts->interior_points = w.interior.point_count;
  for (uint32_t i = 0; i < level->pins.count; i++) counts->pins += level->pins.at[i].points.count;
  return add_springs(&w, counts);
}
