#include "build/springs/lattice_springs_level.h"

#include <math.h>

#include "build/materials/point_factors.h"
#include "build/springs/springs_matched.h"
#include "build/springs/springs_sides.h"
#include "mechanics/vector.h"
#include "sbfmt/mechanics.h"

typedef struct work {
  sbf_level *level;
  const sbf_soft_body *body;
  sbf_asset *asset;
  sbfi_arena *scratch;
  uint8_t *pinned;  /* (points) */
  float *energies;  /* (points) J, a quarter of modulus times volume of each tetrahedron */
  float *stiffness; /* (edges) N/m */
  float *damping;   /* (points) factors on the body's damping; NULL: none stated */
  sbfi_spring_list sides;
} work;

static bool find_energies(work *w) {
  const sbf_level *level = w->level;
  const sbf_uint4_list *at = &level->lattice.tetrahedra;
  float *factors = sbfi_arena_allocate(w->scratch, level->positions.count, sizeof *factors);
  float *moduli = sbfi_arena_allocate(w->scratch, at->count, sizeof *moduli);
  w->energies = sbfi_arena_allocate(w->scratch, level->positions.count, sizeof *w->energies);
  if (!factors || !moduli || !w->energies) return false;
  sbf_level_moduli(w->body, level, factors, moduli);
  for (uint32_t t = 0; t < at->count; t++) {
    sbfi_d3 p[4];
    for (int k = 0; k < 4; k++) p[k] = sbfi_d3_of(level->positions.at[at->at[t].at[k]]);
    double volume = fabs(sbfi_d3_dot(sbfi_d3_sub(p[1], p[0]),
                        sbfi_d3_cross(sbfi_d3_sub(p[2], p[0]), sbfi_d3_sub(p[3], p[0])))) /
                    6;
    for (int k = 0; k < 4; k++) w->energies[at->at[t].at[k]] += (float)(volume / 4 * (double)moduli[t]);
  }
  return true;
}

static bool state_masses(const work *w) {
  uint32_t count = w->level->positions.count;
  float *masses = sbf_asset_allocate(w->asset, count, sizeof *masses);
  if (!masses) return false;
  sbf_level_masses(w->body, w->level, w->pinned, masses);
  w->level->masses = (sbf_f32_list){masses, count};
  return true;
}

static bool add_set(const work *w, int32_t derivation, uint32_t *inert) {
  uint32_t count = w->sides.count, kept = 0;
  const float damping_s = w->body->attributes.stiffness_damping;
  sbf_spring_set *set = sbf_asset_allocate(w->asset, 1, sizeof *set);
  sbf_uint2 *ends = sbf_asset_allocate(w->asset, count, sizeof *ends);
  float *stiffness = sbf_asset_allocate(w->asset, count, sizeof *stiffness);
  float *damping = w->damping ? sbf_asset_allocate(w->asset, count, sizeof *damping) : NULL;
  if (!set || !ends || !stiffness || (w->damping && !damping)) return false;
  for (uint32_t s = 0; s < count; s++) {
    const uint32_t *at = w->sides.at[s].at;
    if (w->pinned[at[0]] && w->pinned[at[1]]) continue;
    ends[kept] = w->sides.at[s];
    if (damping) damping[kept] = damping_s * w->stiffness[s] * (w->damping[at[0]] + w->damping[at[1]]) / 2;
    stiffness[kept++] = w->stiffness[s];
  }
  sbf_spring_set_init(set);
  set->kind = SBF_SPRING_KIND_INTERNAL;
  set->derived = derivation;
  set->inert_count = *inert = count - kept;
  set->ends = (sbf_uint2_list){kept ? ends : NULL, kept};
  set->stiffness = (sbf_f32_list){kept ? stiffness : NULL, kept};
  set->damping = (sbf_f32_list){damping, damping ? kept : 0};
  w->level->springs = (sbf_spring_set_list){set, 1};
  return true;
}

bool sbfi_lattice_springs_level_make(sbf_level *level, const sbf_soft_body *body, int32_t derivation,
    sbf_asset *asset, uint32_t *inert, sbfi_progress progress, sbfi_arena *scratch) {
  work w = {.level = level, .body = body, .asset = asset, .scratch = scratch};
  sbf_tetrahedron_mesh *lattice = &level->lattice;
  w.pinned = sbfi_arena_allocate(scratch, (size_t)level->positions.count + 1, 1);
  if (!w.pinned || !sbfi_springs_sides(&w.sides, lattice->tetrahedra.at, lattice->tetrahedra.count, scratch))
    return false;
  sbf_level_pinned_points(level, w.pinned);
  w.stiffness = sbfi_arena_allocate(scratch, (size_t)w.sides.count + 1, sizeof *w.stiffness);
  if (!w.stiffness || !find_energies(&w) || !state_masses(&w)) return false;
  if (body->attributes.stiffness_damping > 0 &&
      !sbfi_point_factors(body, level, SBF_WEIGHT_PROPERTY_STIFFNESS_DAMPING, scratch, &w.damping))
    return false;
  if (!sbfi_springs_matched(1, level->positions.at, level->positions.count, w.energies, w.sides.at,
          w.sides.count, w.stiffness, progress, scratch) ||
      !add_set(&w, derivation, inert))
    return false;
  level->model = SBF_ELASTIC_MODEL_SPRINGS;
  level->name = sbf_asset_copy_text(asset, "springs");
  sbf_uint4_list tetrahedra = lattice->tetrahedra;
  sbf_tetrahedron_mesh_init(lattice);
  lattice->target = SBF_VOLUME_TARGET_VOLUME;
  lattice->tetrahedra = tetrahedra;
  return level->name != NULL;
}
