#include "build/sections/section_frame.h"

#include <string.h>

#include "build/sections/level_pins.h"

sbfi_d3 sbfi_section_middle(const sbf_soft_body *body) {
  const sbf_vec3_list *at = &body->surface.positions;
  sbfi_d3 sum = {0, 0, 0};
  for (uint32_t i = 0; i < at->count; i++) sum = sbfi_d3_add(sum, sbfi_d3_of(at->at[i]));
  return at->count ? sbfi_d3_scale(sum, 1.0 / at->count) : sum;
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

static void place_corners(work *w, sbf_vec3 *positions) {
  static const double corners[SBFI_FRAME_POINTS][3] = {{1, 1, 1}, {1, -1, -1}, {-1, 1, -1}, {-1, -1, 1}};
  static const double root_of_three = 1.7320508075688772;
  const sbf_soft_body *body = &w->sections->bodies[w->section];
  double size = w->sections->reaches_m[w->section] / root_of_three;
  for (int k = 0; k < SBFI_FRAME_POINTS; k++) {
    sbfi_d3 way = {corners[k][0], corners[k][1], corners[k][2]};
    positions[k] = sbfi_d3_rounded(sbfi_d3_add(sbfi_section_middle(body), sbfi_d3_scale(way, size)));
    w->bones[k] = (uint32_t)body->bone;
  }
}

static void place_mixes(work *w, sbf_vec3 *positions) {
  uint32_t next = SBFI_FRAME_POINTS;
  for (uint32_t i = 0; i < w->sections->mix_count; i++) {
    sbfi_mix *mix = &w->sections->mixes[i];
    if (mix->section != w->section) continue;
    for (uint32_t k = 0; k < mix->count; k++) {
      positions[next] = mix->place;
      w->bones[next] = mix->bones[k];
      mix->points[k] = w->old_count + next++;
    }
    for (uint32_t k = mix->count; k < 4; k++) mix->points[k] = mix->points[0];
  }
}

static bool add_points(work *w) {
  sbf_vec3 *positions = sbf_asset_allocate(w->asset, (size_t)w->old_count + w->new_count, sizeof *positions);
  if (!positions) return false;
  if (w->old_count) memcpy(positions, w->level->positions.at, w->old_count * sizeof *positions);
  place_corners(w, positions + w->old_count);
  place_mixes(w, positions + w->old_count);
  if (w->level->masses.count) {
    float *masses = sbf_asset_allocate(w->asset, (size_t)w->old_count + w->new_count, sizeof *masses);
    if (!masses) return false;
    memcpy(masses, w->level->masses.at, w->old_count * sizeof *masses);
    w->level->masses = (sbf_f32_list){masses, w->old_count + w->new_count};
  }
  w->level->positions = (sbf_vec3_list){positions, w->old_count + w->new_count};
  return true;
}

/* A set for each bone, in the order of the bones. */
static bool add_pins(work *w, int32_t derivation, sbfi_arena *scratch) {
  uint32_t bone_count = w->asset->bones.count, sets_count = w->level->pins.count;
  uint32_t *counts = sbfi_arena_allocate(scratch, (size_t)bone_count + 1, sizeof *counts);
  uint32_t *places = sbfi_arena_allocate(scratch, w->new_count, sizeof *places);
  if (!counts || !places) return false;
  for (uint32_t i = 0; i < w->new_count; i++) counts[w->bones[i]]++;
  for (uint32_t b = 0; b < bone_count; b++) sets_count += counts[b] > 0;
  sbf_pin_set *sets = sbf_asset_allocate(w->asset, sets_count, sizeof *sets);
  if (!sets) return false;
  uint32_t next = w->level->pins.count;
  if (next) memcpy(sets, w->level->pins.at, next * sizeof *sets);
  for (uint32_t b = 0; b < bone_count; b++) {
    uint32_t count = 0;
    for (uint32_t i = 0; counts[b] && i < w->new_count; i++)
      if (w->bones[i] == b) places[count++] = w->old_count + i;
    if (count == 0) continue;
    if (!sbfi_bone_pins_make(&sets[next], "frame", w->level, (int32_t)b, places, count, w->asset))
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
