#include "build/sections/level_pins.h"

#include <string.h>

#include "build/geometry/hulls.h"
#include "mechanics/level_points.h"
#include "sbfmt/mechanics.h"

/* Rotates `v` by the conjugate of `q`, in double precision. */
static sbf_vec3 rotate_inverse(sbf_quat q, const double v[3]) {
  double x = -q.x, y = -q.y, z = -q.z, w = q.w;
  double tx = 2 * (y * v[2] - z * v[1]), ty = 2 * (z * v[0] - x * v[2]), tz = 2 * (x * v[1] - y * v[0]);
  return (sbf_vec3){(float)(v[0] + w * tx + y * tz - z * ty), (float)(v[1] + w * ty + z * tx - x * tz),
      (float)(v[2] + w * tz + x * ty - y * tx)};
}

/* Maps a set of the body to the level's points; skips points that the level does not have. */
static bool copy_set(sbf_pin_set *to, const sbf_pin_set *from, const sbf_level *level, sbf_asset *asset) {
  uint32_t count = from->points.count, kept = 0;
  bool with_offsets = from->offsets.count > 0, with_weights = from->weights.count > 1;
  *to = *from;
  if (count == 0) return true;
  uint32_t *points = sbf_asset_allocate(asset, count, sizeof *points);
  sbf_vec3 *offsets = with_offsets ? sbf_asset_allocate(asset, count, sizeof *offsets) : NULL;
  float *weights = with_weights ? sbf_asset_allocate(asset, count, sizeof *weights) : NULL;
  if (!points || (with_offsets && !offsets) || (with_weights && !weights)) return false;
  for (uint32_t i = 0; i < count; i++) {
    points[kept] = sbfi_level_point(level, from->points.at[i]);
    if (points[kept] == UINT32_MAX) continue;
    if (offsets) offsets[kept] = from->offsets.at[i];
    if (weights) weights[kept] = from->weights.at[i];
    kept++;
  }
  to->points = (sbf_u32_list){kept ? points : NULL, kept};
  if (with_offsets) to->offsets = (sbf_vec3_list){kept ? offsets : NULL, kept};
  if (with_weights) to->weights = (sbf_f32_list){kept ? weights : NULL, kept};
  return true;
}

static bool expand_attachment(sbf_pin_set *to, const sbf_attachment *from, const sbf_level *level,
    const uint8_t *pinned, sbf_asset *asset, sbfi_arena *scratch) {
  const sbf_polygon_mesh *hull = asset->rigid_bodies.at[from->rigid_body].hull;
  uint32_t max = from->rule == SBF_ATTACHMENT_RULE_EXPLICIT ? from->points.count : level->positions.count;
  uint32_t *found = sbfi_arena_allocate(scratch, (size_t)max + 1, sizeof *found), count = 0;
  if (!found) return false;
  if (from->rule == SBF_ATTACHMENT_RULE_EXPLICIT) {
    for (uint32_t i = 0; i < max; i++) {
      found[count] = sbfi_level_point(level, from->points.at[i]);
      count += found[count] != UINT32_MAX;
    }
  } else if (hull) {
    for (uint32_t i = 0; i < max; i++)
      if (!pinned[i] && sbfi_hull_contains(hull, level->positions.at[i])) found[count++] = i;
  }
  uint32_t *points = count ? sbf_asset_allocate(asset, count, sizeof *points) : NULL;
  if (count && !points) return false;
  if (count) memcpy(points, found, count * sizeof *points);
  sbf_pin_set_init(to);
  to->name = from->name;
  to->rigid_body = from->rigid_body;
  to->points = (sbf_u32_list){points, count};
  return true;
}

bool sbfi_bone_pins_make(sbf_pin_set *to, const char *set_name, const sbf_level *level, int32_t bone,
    const uint32_t *interior, uint32_t count, sbf_asset *asset) {
  uint32_t *points = sbf_asset_allocate(asset, count, sizeof *points);
  sbf_vec3 *offsets = sbf_asset_allocate(asset, count, sizeof *offsets);
  const char *name = sbf_asset_copy_text(asset, set_name);
  if (!points || !offsets || !name) return false;
  const sbf_bone *frame = &asset->bones.at[bone];
  for (uint32_t i = 0; i < count; i++) {
    sbf_vec3 p = level->positions.at[interior[i]];
    double from_head[3] = {
        (double)p.x - frame->head.x, (double)p.y - frame->head.y, (double)p.z - frame->head.z};
    points[i] = interior[i];
    offsets[i] = rotate_inverse(frame->rotation, from_head);
  }
  sbf_pin_set_init(to);
  to->name = name;
  to->bone = bone;
  to->points = (sbf_u32_list){points, count};
  to->offsets = (sbf_vec3_list){offsets, count};
  return true;
}

bool sbfi_level_pins_make(sbf_level *level, const sbf_soft_body *body, int32_t derivation, sbf_asset *asset,
    const uint32_t *interior, uint32_t interior_count, sbfi_arena *scratch) {
  uint32_t kept = level->pins.count, count = kept;
  size_t max = (size_t)kept + body->pins.count + body->attachments.count + 1;
  sbf_pin_set *sets = sbf_asset_allocate(asset, max, sizeof *sets);
  uint8_t *pinned = sbfi_arena_allocate(scratch, (size_t)level->positions.count + 1, 1);
  if (!sets || !pinned) return false;
  if (kept) memcpy(sets, level->pins.at, kept * sizeof *sets);
  for (uint32_t i = 0; i < body->pins.count; i++)
    if (!copy_set(&sets[count++], &body->pins.at[i], level, asset)) return false;
  /* Attachments come last and skip points that are pinned already. */
  if (interior_count > 0 &&
      !sbfi_bone_pins_make(&sets[count++], "interior", level, body->bone, interior, interior_count, asset))
    return false;
  for (uint32_t i = 0; i < body->attachments.count; i++) {
    level->pins = (sbf_pin_set_list){sets, count};
    sbf_level_pinned_points(level, pinned);
    if (!expand_attachment(&sets[count], &body->attachments.at[i], level, pinned, asset, scratch))
      return false;
    count += sets[count].points.count > 0;
  }
  for (uint32_t i = kept; i < count; i++) sets[i].derived = derivation;
  level->pins = (sbf_pin_set_list){count ? sets : NULL, count};
  return true;
}
