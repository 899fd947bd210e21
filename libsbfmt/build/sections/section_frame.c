#include "build/sections/section_frame.h"

#include <string.h>

#include "build/sections/level_pins.h"

sbfi_d3 sbfi_points_middle(const sbf_vec3_list *points) {
  sbfi_d3 sum = {0, 0, 0};
  for (uint32_t i = 0; i < points->count; i++) sum = sbfi_d3_add(sum, sbfi_d3_of(points->at[i]));
  return points->count ? sbfi_d3_scale(sum, 1.0 / points->count) : sum;
}

sbfi_d3 sbfi_section_middle(const sbf_soft_body *body) {
  return sbfi_points_middle(&body->surface.positions);
}

typedef struct work {
  sbf_level *level;
  sbf_asset *asset;
  sbfi_sections *sections;
  uint32_t section, old_count, new_count;
  uint32_t *bones; /* (new_count) of each new point */
} work;

static uint32_t count_mix_points(const work *w) {
  uint32_t count = 0;
  for (uint32_t i = 0; i < w->sections->mix_count; i++)
    if (w->sections->mixes[i].section == w->section) count += w->sections->mixes[i].count;
  return count;
}

/* Places corners of a regular tetrahedron, so that positions within `reach` of the centre have weights
 * from -0.5 to 1. */
static void position_corners(sbf_vec3 positions[SBFI_FRAME_POINTS], sbfi_d3 middle, double reach) {
  static const double corners[SBFI_FRAME_POINTS][3] = {{1, 1, 1}, {1, -1, -1}, {-1, 1, -1}, {-1, -1, 1}};
  static const double root_of_three = 1.7320508075688772;
  for (int k = 0; k < SBFI_FRAME_POINTS; k++) {
    sbfi_d3 direction = {corners[k][0], corners[k][1], corners[k][2]};
    positions[k] = sbfi_d3_rounded(sbfi_d3_add(middle, sbfi_d3_scale(direction, reach / root_of_three)));
  }
}

static void set_mixes(work *w, sbf_vec3 *positions) {
  uint32_t next = SBFI_FRAME_POINTS;
  for (uint32_t i = 0; i < w->sections->mix_count; i++) {
    sbfi_mix *mix = &w->sections->mixes[i];
    if (mix->section != w->section) continue;
    for (uint32_t k = 0; k < mix->count; k++) {
      positions[next] = mix->position;
      w->bones[next] = mix->bones[k];
      mix->points[k] = w->old_count + next++;
    }
    for (uint32_t k = mix->count; k < 4; k++) mix->points[k] = mix->points[0];
  }
}

/* Extends the level's points in writable memory; NULL if memory runs out. */
static sbf_vec3 *append_points(sbf_level *level, uint32_t count, sbf_asset *asset) {
  uint32_t old = level->positions.count;
  sbf_vec3 *positions = sbf_asset_allocate(asset, (size_t)old + count, sizeof *positions);
  if (!positions) return NULL;
  if (old) memcpy(positions, level->positions.at, old * sizeof *positions);
  if (level->masses.count) {
    float *masses = sbf_asset_allocate(asset, (size_t)old + count, sizeof *masses);
    if (!masses) return NULL;
    memcpy(masses, level->masses.at, old * sizeof *masses);
    level->masses = (sbf_f32_list){masses, old + count};
  }
  level->positions = (sbf_vec3_list){positions, old + count};
  return positions + old;
}

static bool add_points(work *w) {
  const sbf_soft_body *body = &w->sections->bodies[w->section];
  sbf_vec3 *added = append_points(w->level, w->new_count, w->asset);
  if (!added) return false;
  position_corners(added, sbfi_section_middle(body), w->sections->reaches_m[w->section]);
  for (int k = 0; k < SBFI_FRAME_POINTS; k++) w->bones[k] = (uint32_t)body->bone;
  set_mixes(w, added);
  return true;
}

/* Adds one set per bone, in the order of the bones. */
static bool add_pins(work *w, int32_t derivation, sbfi_arena *scratch) {
  uint32_t bone_count = w->asset->bones.count, sets_count = w->level->pins.count;
  uint32_t *counts = sbfi_arena_allocate(scratch, (size_t)bone_count + 1, sizeof *counts);
  uint32_t *indices = sbfi_arena_allocate(scratch, w->new_count, sizeof *indices);
  if (!counts || !indices) return false;
  for (uint32_t i = 0; i < w->new_count; i++) counts[w->bones[i]]++;
  for (uint32_t b = 0; b < bone_count; b++) sets_count += counts[b] > 0;
  sbf_pin_set *sets = sbf_asset_allocate(w->asset, sets_count, sizeof *sets);
  if (!sets) return false;
  uint32_t next = w->level->pins.count;
  if (next) memcpy(sets, w->level->pins.at, next * sizeof *sets);
  for (uint32_t b = 0; b < bone_count; b++) {
    uint32_t count = 0;
    for (uint32_t i = 0; counts[b] && i < w->new_count; i++)
      if (w->bones[i] == b) indices[count++] = w->old_count + i;
    if (count == 0) continue;
    if (!sbfi_bone_pins_make(&sets[next], "frame", w->level, (int32_t)b, indices, count, w->asset))
      return false;
    sets[next++].derived = derivation;
  }
  w->level->pins = (sbf_pin_set_list){sets, sets_count};
  return true;
}

bool sbfi_section_frame_add(sbf_level *level, sbfi_sections *sections, uint32_t section, int32_t derivation,
    sbf_asset *asset, uint32_t *first, sbfi_arena *scratch) {
  work w = {level, asset, sections, section, level->positions.count, 0, NULL};
  w.new_count = SBFI_FRAME_POINTS + count_mix_points(&w);
  w.bones = sbfi_arena_allocate(scratch, w.new_count, sizeof *w.bones);
  if (!w.bones || !add_points(&w) || !add_pins(&w, derivation, scratch)) return false;
  *first = w.old_count;
  return true;
}

bool sbfi_bone_frame_add(sbf_level *level, int32_t bone, sbfi_d3 middle, double reach, int32_t derivation,
    sbf_asset *asset, uint32_t *first) {
  uint32_t points[SBFI_FRAME_POINTS], sets_count = level->pins.count;
  *first = level->positions.count;
  sbf_vec3 *added = append_points(level, SBFI_FRAME_POINTS, asset);
  if (!added) return false;
  position_corners(added, middle, reach);
  if (level->model == SBF_ELASTIC_MODEL_JIGGLE) return true; /* its points move rigidly */
  sbf_pin_set *sets = sbf_asset_allocate(asset, (size_t)sets_count + 1, sizeof *sets);
  if (!sets) return false;
  if (sets_count) memcpy(sets, level->pins.at, sets_count * sizeof *sets);
  for (uint32_t k = 0; k < SBFI_FRAME_POINTS; k++) points[k] = *first + k;
  if (!sbfi_bone_pins_make(&sets[sets_count], "frame", level, bone, points, SBFI_FRAME_POINTS, asset))
    return false;
  sets[sets_count].derived = derivation;
  level->pins = (sbf_pin_set_list){sets, sets_count + 1};
  return true;
}
