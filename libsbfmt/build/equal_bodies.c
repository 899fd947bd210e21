#include "build/equal_bodies.h"

#include <math.h>
#include <string.h>

#include "base/hash64.h"
#include "model/compare.h"

enum { MAX_SAMPLES = 64 };
static const double MAX_DISTANCE = 1e-4; /* fraction of a body's size */

bool sbfi_equal_bodies_make(
    sbfi_equal_bodies *made, const sbf_soft_body *bodies, uint32_t count, sbfi_arena *arena) {
  uint32_t slots = 16;
  while (slots < count && slots < 1u << 30) slots *= 2;
  *made = (sbfi_equal_bodies){.bodies = bodies, .slot_count = slots};
  made->slots = sbfi_arena_allocate(arena, slots, sizeof *made->slots);
  made->earlier = sbfi_arena_allocate(arena, (size_t)count + 1, sizeof *made->earlier);
  if (!made->slots || !made->earlier) return false;
  memset(made->slots, 0xff, slots * sizeof *made->slots);
  return true;
}

/* Hash of properties that do not depend on the position. */
static uint32_t slot_of(const sbfi_equal_bodies *all, const sbf_soft_body *body) {
  const sbf_polygon_mesh *surface = &body->surface;
  const uint32_t counts[] = {surface->positions.count, surface->polygon_sizes.count};
  const float matter[] = {body->attributes.young_modulus, body->attributes.density};
  sbfi_hash64 hash;
  sbfi_hash64_init(&hash);
  sbfi_hash64_add_u32(&hash, counts, 2);
  sbfi_hash64_add_f32(&hash, matter, 2);
  sbfi_hash64_add_u32(&hash, surface->polygon_points.at, surface->polygon_points.count);
  return (uint32_t)sbfi_hash64_value(&hash) & (all->slot_count - 1);
}

static bool is_loose(const sbf_soft_body *body) {
  return body->bone == SBF_NONE && body->pins.count == 0 && body->attachments.count == 0 &&
         body->interior.count == 0;
}

/* Mean displacement from the points of one body to those of the other; false if it is not a translation. */
static bool is_moved(const sbf_vec3_list *from, const sbf_vec3_list *to, sbfi_d3 *offset) {
  sbfi_d3 sum = {0, 0, 0}, low = sbfi_d3_of(from->at[0]), high = low;
  for (uint32_t i = 0; i < from->count; i++) {
    sbfi_d3 at = sbfi_d3_of(from->at[i]);
    sum = sbfi_d3_add(sum, sbfi_d3_sub(sbfi_d3_of(to->at[i]), at));
    low = (sbfi_d3){fmin(low.x, at.x), fmin(low.y, at.y), fmin(low.z, at.z)};
    high = (sbfi_d3){fmax(high.x, at.x), fmax(high.y, at.y), fmax(high.z, at.z)};
  }
  *offset = sbfi_d3_scale(sum, 1.0 / from->count);
  double limit = MAX_DISTANCE * sbfi_d3_length(sbfi_d3_sub(high, low));
  for (uint32_t i = 0; i < from->count; i++) {
    sbfi_d3 displacement = sbfi_d3_sub(sbfi_d3_of(to->at[i]), sbfi_d3_of(from->at[i]));
    if (!(sbfi_d3_length(sbfi_d3_sub(displacement, *offset)) <= limit)) return false;
  }
  return true;
}

static bool is_equal(const sbf_soft_body *a, const sbf_soft_body *b, sbfi_d3 *offset) {
  const sbfi_element *element = sbfi_element_field(&sbfi_asset_element, "soft_bodies")->element;
  sbf_soft_body there = *b;
  if (a->surface.positions.count != b->surface.positions.count || a->surface.positions.count == 0 ||
      !is_moved(&a->surface.positions, &b->surface.positions, offset))
    return false;
  there.id = a->id;
  there.name = a->name;
  there.source_points = a->source_points;
  there.surface.positions = a->surface.positions;
  there.levels = a->levels;
  return sbfi_objects_equal(element, a, &there);
}

uint32_t sbfi_equal_bodies_find(const sbfi_equal_bodies *all, uint32_t number, sbfi_d3 *offset) {
  const sbf_soft_body *body = &all->bodies[number];
  if (!is_loose(body) || body->levels.count > 0) return UINT32_MAX;
  uint32_t other = all->slots[slot_of(all, body)];
  for (int styles = 0; other != UINT32_MAX && styles < MAX_SAMPLES; styles++, other = all->earlier[other])
    if (is_loose(&all->bodies[other]) && is_equal(&all->bodies[other], body, offset)) return other;
  return UINT32_MAX;
}

void sbfi_equal_bodies_add(sbfi_equal_bodies *all, uint32_t number) {
  uint32_t *slot = &all->slots[slot_of(all, &all->bodies[number])];
  all->earlier[number] = *slot;
  *slot = number;
}

bool sbfi_levels_moved(
    sbf_level_list *moved, const sbf_level_list *levels, sbfi_d3 offset, sbf_asset *asset) {
  sbf_level *made = sbf_asset_allocate(asset, levels->count, sizeof *made);
  if (!made) return false;
  memcpy(made, levels->at, levels->count * sizeof *made);
  for (uint32_t l = 0; l < levels->count; l++) {
    const sbf_vec3_list *from = &levels->at[l].positions;
    sbf_vec3 *to = sbf_asset_allocate(asset, from->count, sizeof *to);
    if (!to) return false;
    for (uint32_t i = 0; i < from->count; i++)
      to[i] = sbfi_d3_rounded(sbfi_d3_add(sbfi_d3_of(from->at[i]), offset));
    made[l].positions.at = to;
  }
  *moved = (sbf_level_list){made, levels->count};
  return true;
}
