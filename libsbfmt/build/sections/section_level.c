#include "build/sections/section_level.h"

#include <math.h>
#include <string.h>

#include "build/geometry/triangle_tree.h"
#include "build/lattice/lattice_pins.h"
#include "build/sections/level_pins.h"
#include "build/springs/springs_sides.h"
#include "mechanics/vector.h"
#include "sbfmt/mechanics.h"

enum { USUAL_ELEMENTS = 160 };
/* Fraction of the area to the power of 3/2: a limb ten thousand times as long as thick is still above it. */
static const double MIN_VOLUME = 0.002;
/* Stiffness of a goal relative to the sum of the point's springs. */
static const double GOAL_FRACTION = 1.0 / 12;

typedef struct work {
  sbf_level *level;
  const sbf_soft_body *body;
  const sbfi_section_recipe *recipe;
  sbf_asset *asset;
  sbfi_arena *scratch;
  sbfi_section_counts *counts;
  sbfi_lattice lattice;
  uint32_t point_count;
  sbfi_spring_list springs;
  float *volumes;    /* (point_count) a quarter of the volume of each adjacent tetrahedron */
  double volume;     /* total volume */
  uint8_t *pinned;   /* (point_count) rigidly pinned, by the bone's core or by the author */
  uint8_t *is_taken; /* (point_count) pinned by the author */
} work;

static double volume_of(const work *w, sbf_uint4 at) {
  sbfi_d3 p[4];
  for (int k = 0; k < 4; k++) p[k] = sbfi_d3_of(w->lattice.made.positions[at.at[k]]);
  return sbfi_d3_dot(
             sbfi_d3_sub(p[1], p[0]), sbfi_d3_cross(sbfi_d3_sub(p[2], p[0]), sbfi_d3_sub(p[3], p[0]))) /
         6;
}

static bool fill(work *w) {
  const sbfi_tetrahedra *made = &w->lattice.made;
  uint32_t sources = w->body->surface.positions.count;
  sbf_vec3 *positions = sbf_asset_allocate(w->asset, made->point_count, sizeof *positions);
  sbf_uint4 *tetrahedra = sbf_asset_allocate(w->asset, made->count, sizeof *tetrahedra);
  uint32_t *new_from_old = sbf_asset_allocate(w->asset, sources, sizeof *new_from_old);
  w->volumes = sbfi_arena_allocate(w->scratch, made->point_count, sizeof *w->volumes);
  if (!positions || !tetrahedra || !new_from_old || !w->volumes) return false;
  memcpy(positions, made->positions, made->point_count * sizeof *positions);
  memcpy(tetrahedra, made->at, made->count * sizeof *tetrahedra);
  memset(new_from_old, 0xff, sources * sizeof *new_from_old);
  for (uint32_t t = 0; t < made->count; t++) {
    double volume = volume_of(w, made->at[t]);
    w->volume += volume;
    for (int k = 0; k < 4; k++) w->volumes[made->at[t].at[k]] += (float)(volume / 4);
  }
  w->point_count = made->point_count;
  w->level->positions = (sbf_vec3_list){positions, made->point_count};
  w->level->new_from_old = (sbf_u32_list){new_from_old, sources};
  w->level->lattice.target = SBF_VOLUME_TARGET_VOLUME;
  w->level->lattice.tetrahedra = (sbf_uint4_list){tetrahedra, made->count};
  return true;
}

/* Computes the maximum over each point and its neighbours. */
static void spread_greatest(const work *w, const double *from, double *to) {
  memcpy(to, from, w->point_count * sizeof *to);
  for (uint32_t s = 0; s < w->springs.count; s++) {
    uint32_t a = w->springs.at[s].at[0], b = w->springs.at[s].at[1];
    to[a] = fmax(to[a], from[b]);
    to[b] = fmax(to[b], from[a]);
  }
}

/* Pins points that are deep relative to their surroundings, so that long sections are pinned along their
 * whole length. */
static bool mark_core(work *w) {
  sbfi_triangle_tree surface;
  double *depths2 = sbfi_arena_allocate(w->scratch, w->point_count, sizeof *depths2);
  double *near = sbfi_arena_allocate(w->scratch, w->point_count, sizeof *near);
  double *around = sbfi_arena_allocate(w->scratch, w->point_count, sizeof *around);
  if (!depths2 || !near || !around) return false;
  if (!sbfi_triangle_tree_build(&surface, &w->body->surface, w->scratch)) return false;
  for (uint32_t i = 0; i < w->point_count; i++) {
    depths2[i] = INFINITY;
    sbfi_triangle_tree_nearest(&surface, w->level->positions.at[i], &depths2[i]);
  }
  spread_greatest(w, depths2, near);
  spread_greatest(w, near, around);
  for (uint32_t i = 0; i < w->point_count; i++)
    w->pinned[i] = w->pinned[i] || (!w->is_taken[i] && depths2[i] >= around[i] / 4);
  return true;
}

/* Authored pins take precedence. */
static bool mark_painted(work *w) {
  w->pinned = sbfi_arena_allocate(w->scratch, w->point_count, 1);
  w->is_taken = sbfi_arena_allocate(w->scratch, w->point_count, 1);
  if (!w->pinned || !w->is_taken) return false;
  if (!sbfi_lattice_pins_map(w->level, w->body, w->is_taken, w->recipe->derivation, w->asset, w->scratch))
    return false;
  if (w->level->pins.count) sbf_level_pinned_points(w->level, w->pinned);
  for (uint32_t i = 0; i < w->level->pins.count; i++) w->counts->pins += w->level->pins.at[i].points.count;
  return true;
}

static bool pin_core(work *w, sbf_pin_set *set) {
  uint32_t *core = sbfi_arena_allocate(w->scratch, w->point_count, sizeof *core), count = 0;
  if (!core) return false;
  for (uint32_t i = 0; i < w->point_count; i++)
    if (w->pinned[i] && !w->is_taken[i]) core[count++] = i;
  if (!sbfi_bone_pins_make(set, "interior", w->level, w->body->bone, core, count, w->asset)) return false;
  w->counts->pins += count;
  return true;
}

/* Springs have no preferred orientation: goals that move with the bone restore a section that a hit has
 * inverted. */
static bool pin_shape(work *w, sbf_pin_set *set, const float *stiffness) {
  uint32_t *points = sbfi_arena_allocate(w->scratch, w->point_count, sizeof *points), count = 0;
  double *sums = sbfi_arena_allocate(w->scratch, w->point_count, sizeof *sums), greatest = 0;
  if (!points || !sums) return false;
  for (uint32_t s = 0; s < w->springs.count; s++)
    for (int end = 0; end < 2; end++) sums[w->springs.at[s].at[end]] += (double)stiffness[s];
  for (uint32_t i = 0; i < w->point_count; i++) {
    if (w->pinned[i] || w->is_taken[i]) continue;
    points[count++] = i;
    greatest = fmax(greatest, sums[i]);
  }
  float *weights = sbf_asset_allocate(w->asset, (size_t)count + 1, sizeof *weights);
  if (!weights || !sbfi_bone_pins_make(set, "shape", w->level, w->body->bone, points, count, w->asset))
    return false;
  /* A weight of 1 would be rigid: the maximum is a half. */
  for (uint32_t i = 0; i < count; i++) weights[i] = (float)(0.5 * sums[points[i]] / greatest);
  set->weights = (sbf_f32_list){count ? weights : NULL, count};
  set->stiffness = (float)(2 * GOAL_FRACTION * greatest);
  w->counts->pins += count;
  return true;
}

static bool add_pins(work *w, const float *stiffness) {
  uint32_t count = w->level->pins.count, free_count = 0, core_count = 0;
  sbf_pin_set *sets = sbf_asset_allocate(w->asset, (size_t)count + 2, sizeof *sets);
  if (!sets) return false;
  if (count) memcpy(sets, w->level->pins.at, count * sizeof *sets);
  for (uint32_t i = 0; i < w->point_count; i++) {
    core_count += w->pinned[i] && !w->is_taken[i];
    free_count += !w->pinned[i] && !w->is_taken[i];
  }
  if (core_count && !pin_core(w, &sets[count++])) return false;
  if (free_count && !pin_shape(w, &sets[count++], stiffness)) return false;
  w->level->pins = (sbf_pin_set_list){count ? sets : NULL, count};
  for (uint32_t i = 0; i < count; i++) sets[i].derived = w->recipe->derivation;
  return true;
}

/* A lattice has slightly less volume than the surface, or more for thin limbs: uses the surface's if it is
 * closed. */
static bool weigh(work *w) {
  sbf_body_measures measures;
  float *masses = sbf_asset_allocate(w->asset, w->point_count, sizeof *masses);
  if (!masses) return false;
  sbf_body_measure(w->body, &measures);
  double ratio = measures.volume / w->volume, density = w->body->attributes.density;
  if (measures.sheet || !(ratio > 0.5 && ratio < 2)) ratio = 1;
  for (uint32_t i = 0; i < w->point_count; i++)
    masses[i] = w->pinned[i] ? 0 : (float)(density * ratio * (double)w->volumes[i]);
  w->level->masses = (sbf_f32_list){masses, w->point_count};
  return true;
}

static bool add_springs(work *w) {
  uint32_t kept = 0;
  double *sums = sbfi_arena_allocate(w->scratch, w->point_count, 2 * sizeof *sums);
  float *all = sbfi_arena_allocate(w->scratch, w->springs.count, sizeof *all);
  sbf_uint2 *ends = sbf_asset_allocate(w->asset, w->springs.count, sizeof *ends);
  float *stiffness = sbf_asset_allocate(w->asset, w->springs.count, sizeof *stiffness);
  sbf_spring_set *set = sbf_asset_allocate(w->asset, 1, sizeof *set);
  if (!sums || !all || !ends || !stiffness || !set) return false;
  sbf_stiffness_of_network(SBF_STIFFNESS_VOLUME * (double)w->body->attributes.young_modulus,
      w->level->positions.at, w->point_count, w->volumes, w->springs.at, w->springs.count, sums, all);
  for (uint32_t s = 0; s < w->springs.count; s++) {
    if (w->pinned[w->springs.at[s].at[0]] && w->pinned[w->springs.at[s].at[1]]) continue;
    ends[kept] = w->springs.at[s];
    stiffness[kept++] = all[s];
  }
  sbf_spring_set_init(set);
  set->kind = SBF_SPRING_KIND_INTERNAL;
  set->derived = w->recipe->derivation;
  set->inert_count = w->springs.count - kept;
  set->ends = (sbf_uint2_list){kept ? ends : NULL, kept};
  set->stiffness = (sbf_f32_list){kept ? stiffness : NULL, kept};
  w->level->springs = (sbf_spring_set_list){set, 1};
  w->counts->points = w->point_count;
  w->counts->springs = kept;
  w->counts->inert = w->springs.count - kept;
  return add_pins(w, all);
}

sbfi_lattice_outcome sbfi_section_level_make(sbf_level *level, const sbf_soft_body *body,
    const sbfi_section_recipe *recipe, sbf_asset *asset, sbfi_section_counts *counts, sbfi_progress progress,
    sbfi_arena *scratch) {
  work w = {
      .level = level, .body = body, .recipe = recipe, .asset = asset, .scratch = scratch, .counts = counts};
  sbfi_soup soup;
  sbfi_winding winding;
  sbf_surface_measures surface;
  sbf_level_init(level);
  *counts = (sbfi_section_counts){0};
  sbf_surface_measure(&body->surface, NULL, &surface);
  if (!(surface.volume > MIN_VOLUME * surface.area * sqrt(surface.area))) return SBFI_LATTICE_MADE;
  if (!sbfi_soup_make(&soup, &body->surface, scratch) || !sbfi_winding_make(&winding, &soup, scratch))
    return SBFI_LATTICE_NO_MEMORY;
  sbfi_lattice_outcome outcome =
      recipe->cell > 0 ? sbfi_lattice_make(&w.lattice, &winding, recipe->cell, progress, scratch)
                       : sbfi_lattice_make_count(&w.lattice, &winding,
                             recipe->elements ? recipe->elements : USUAL_ELEMENTS, SBFI_LATTICE_TOLERANCE,
                             progress, scratch);
  if (outcome != SBFI_LATTICE_MADE || w.lattice.made.count == 0) return outcome;
  level->derived = recipe->derivation;
  level->cell = (float)w.lattice.cell;
  level->name = sbf_asset_copy_text(asset, "springs");
  bool good = level->name && fill(&w) &&
              sbfi_springs_sides(&w.springs, w.lattice.made.at, w.lattice.made.count, scratch) &&
              mark_painted(&w) && mark_core(&w) && weigh(&w) && add_springs(&w);
  return good ? SBFI_LATTICE_MADE : SBFI_LATTICE_NO_MEMORY;
}
