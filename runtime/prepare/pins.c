/* Pins of a level, and the drivers of points that are not fully pinned. */
#include "prepare/pins.h"

#include "math/quat.h"
#include "prepare/prepare.h"

float sbri_pin_weight(const sbf_pin_set *set, uint32_t i) {
  float weight = set->weights.count == 0 ? 1 : set->weights.at[set->weights.count == 1 ? 0 : i];
  if (weight < set->minimum) weight = set->minimum;
  return weight > set->maximum ? set->maximum : weight;
}

uint32_t sbri_pin_frame(const sbr_model *model, const sbf_pin_set *set) {
  if (set->bone >= 0) return (uint32_t)set->bone;
  if (set->rigid_body < 0) return sbri_anchor_frame(model);
  return sbri_body_frame(model, (uint32_t)set->rigid_body);
}

sbf_vec3 sbri_pin_position(
    const sbr_model *model, const sbf_level *level, const sbf_pin_set *set, uint32_t i) {
  if (set->offsets.count == 0) return level->positions.at[set->points.at[i]];
  sbf_vec3 offset = set->offsets.at[i];
  if (set->bone >= 0) {
    const sbr_transform *rest = &model->rig.bones.rest[set->bone];
    return sbri_add(rest->position, sbri_rotate(rest->rotation, offset));
  }
  if (set->rigid_body >= 0) return sbri_add(model->asset->rigid_bodies.at[set->rigid_body].center, offset);
  return offset;
}

void sbri_pins_read(const sbr_model *model, const sbf_level *level, uint32_t *frames, sbf_vec3 *positions) {
  for (uint32_t i = 0; i < level->positions.count; i++) {
    frames[i] = SBRI_FREE;
    positions[i] = level->positions.at[i];
  }
  for (uint32_t s = 0; s < level->pins.count; s++) {
    const sbf_pin_set *set = &level->pins.at[s];
    for (uint32_t i = 0; i < set->points.count; i++) {
      uint32_t point = set->points.at[i];
      if (sbri_pin_weight(set, i) < 1 || frames[point] != SBRI_FREE) continue; /* the first set counts */
      frames[point] = sbri_pin_frame(model, set);
      positions[point] = sbri_pin_position(model, level, set, i);
    }
  }
}

/* ---- Drivers ---- */

enum { SWEEPS = 200 };

typedef struct spread {
  const sbri_island *island;
  uint32_t first, count; /* free slots of the body */
  uint32_t *frames;      /* (frame_count) pin frames of the body */
  uint32_t frame_count;
  float *fractions;              /* (count x frame_count) */
  uint32_t *link_begins, *links; /* corners that share a tetrahedron with each point, once each; NULL: none */
} spread;

static uint32_t frame_position(const spread *s, uint32_t frame) {
  uint32_t index = 0;
  while (index < s->frame_count && s->frames[index] != frame) index++;
  return index;
}

/* Adds the weights of the other end of a spring to those of a point. */
static void add_contributions(const spread *s, float *to, uint32_t other, float weight) {
  if (other >= s->island->free_count) {
    to[frame_position(s, s->island->pins.frames[other - s->island->free_count])] += weight;
  } else if (other >= s->first && other < s->first + s->count) {
    const float *from = s->fractions + (size_t)(other - s->first) * s->frame_count;
    for (uint32_t k = 0; k < s->frame_count; k++) to[k] += weight * from[k];
  }
}

/* Links of regions: points 1, 2, 4, 8 ... indices further in the region. */
static bool list_region_links(spread *s, const sbri_body *body, sbfi_arena *scratch) {
  const sbf_shape_regions *regions = body->level->regions;
  uint32_t *begins = sbfi_arena_allocate(scratch, (size_t)s->count + 2, sizeof *begins), *links = NULL;
  if (!begins) return false;
  for (int pass = 0; pass < 2; pass++) {
    const uint32_t *points = regions->points.at;
    for (uint32_t r = 0; r < regions->sizes.count; points += regions->sizes.at[r++]) {
      uint32_t size = regions->sizes.at[r];
      for (uint32_t i = 0; i < size; i++)
        for (uint32_t far = 1, index = body->slots.from_point[points[i]] - s->first;
             far < size && index < s->count; far *= 2) {
          if (pass)
            links[begins[index + 1]++] = body->slots.from_point[points[(i + far) % size]];
          else
            begins[index + 2]++;
        }
    }
    for (uint32_t i = 0; pass == 0 && i < s->count; i++) begins[i + 2] += begins[i + 1];
    if (pass == 0) links = sbfi_arena_allocate(scratch, (size_t)begins[s->count + 1] + 1, sizeof *links);
    if (!links) return false;
  }
  s->link_begins = begins, s->links = links;
  return true;
}

/* Links of tetrahedra or regions. */
static bool list_links(spread *s, const sbri_body *body, sbfi_arena *scratch) {
  if (body->elements.first_region_block < body->elements.region_block_end)
    return list_region_links(s, body, scratch);
  if (body->elements.tetrahedron_count == 0) return true;
  const sbf_uint4 *tetrahedra = body->level->lattice.tetrahedra.at;
  uint32_t *begins = sbfi_arena_allocate(scratch, (size_t)s->count + 2, sizeof *begins);
  uint32_t *links =
      sbfi_arena_allocate(scratch, 12 * (size_t)body->elements.tetrahedron_count, sizeof *links);
  if (!begins || !links) return false;
  for (uint32_t t = 0; t < body->elements.tetrahedron_count; t++)
    for (int k = 0; k < 4; k++) {
      uint32_t index = body->slots.from_point[tetrahedra[t].at[k]] - s->first;
      if (index < s->count) begins[index + 2] += 3;
    }
  for (uint32_t i = 0; i < s->count; i++) begins[i + 2] += begins[i + 1];
  for (uint32_t t = 0; t < body->elements.tetrahedron_count; t++)
    for (int k = 0; k < 4; k++) {
      uint32_t index = body->slots.from_point[tetrahedra[t].at[k]] - s->first;
      for (int j = 1; j < 4 && index < s->count; j++)
        links[begins[index + 1]++] = body->slots.from_point[tetrahedra[t].at[(k + j) % 4]];
    }
  s->link_begins = begins, s->links = links;
  return true;
}

/* One iteration of relaxation towards the mean of the neighbours, weighted by stiffness. */
static void sweep(const spread *s, float *scratch) {
  for (uint32_t i = 0; i < s->count; i++) {
    uint32_t slot = s->first + i, block = slot / SBRI_BLOCK, lane = slot % SBRI_BLOCK;
    for (uint32_t k = 0; k < s->frame_count; k++) scratch[k] = 0;
    float sum = 0;
    for (uint32_t c = s->island->cells.begins[block]; c < s->island->cells.begins[block + 1]; c++) {
      const sbri_spring_cell *cell = &s->island->cells.at[c];
      float k = cell->stiffness[lane];
      uint32_t other = cell->others[lane];
      bool within = other >= s->island->free_count || (other >= s->first && other < s->first + s->count);
      if (!(k > 0) || !within) continue;
      add_contributions(s, scratch, other, k);
      sum += k;
    }
    for (uint32_t l = s->link_begins ? s->link_begins[i] : 0; s->link_begins && l < s->link_begins[i + 1];
         l++) {
      add_contributions(s, scratch, s->links[l], 1);
      sum += 1;
    }
    float *to = s->fractions + (size_t)i * s->frame_count;
    for (uint32_t k = 0; k < s->frame_count && sum > 0; k++) to[k] = scratch[k] / sum;
  }
}

/* The largest weights, with sum 1; only `otherwise` if nothing reaches the point. */
static sbri_driver driver_of(const spread *s, const float *fractions, uint32_t otherwise) {
  sbri_driver driver = {{otherwise, otherwise, otherwise, otherwise}, {1, 0, 0, 0}};
  float sum = 0, taken[SBRI_DRIVERS] = {0};
  uint32_t indices[SBRI_DRIVERS] = {0};
  for (int n = 0; n < SBRI_DRIVERS; n++)
    for (uint32_t k = 0; k < s->frame_count; k++) {
      bool used = false;
      for (int m = 0; m < n; m++) used = used || (taken[m] > 0 && indices[m] == k);
      if (!used && fractions[k] > taken[n]) taken[n] = fractions[k], indices[n] = k;
    }
  for (int n = 0; n < SBRI_DRIVERS; n++) sum += taken[n];
  for (int n = 0; n < SBRI_DRIVERS && sum > 1e-6f; n++) {
    driver.weights[n] = taken[n] / sum;
    if (taken[n] > 0) driver.frames[n] = s->frames[indices[n]];
  }
  return driver;
}

bool sbri_drivers_make(sbr_model *model, const sbri_island *island, sbri_body *body) {
  uint32_t count = body->slots.end - body->slots.begin, otherwise = sbri_root_frame(model);
  if (body->source->bone >= 0) otherwise = (uint32_t)body->source->bone;
  body->driver_frame = otherwise;
  body->is_pinned = false;
  sbfi_arena scratch;
  sbfi_arena_init(&scratch, &model->arena.allocator, 0);
  spread s = {
      .island = island, .first = body->slots.begin, .count = body->slots.real_end - body->slots.begin};
  s.frames = sbfi_arena_allocate(&scratch, model->frame_count, sizeof *s.frames);
  bool good = s.frames != NULL;
  for (uint32_t c = island->cells.begins[body->slots.begin / SBRI_BLOCK];
       good && c < island->cells.begins[body->slots.end / SBRI_BLOCK]; c++)
    for (int lane = 0; lane < SBRI_BLOCK; lane++) {
      uint32_t other = island->cells.at[c].others[lane];
      if (other < island->free_count || !(island->cells.at[c].stiffness[lane] > 0)) continue;
      uint32_t frame = island->pins.frames[other - island->free_count];
      if (frame_position(&s, frame) == s.frame_count) s.frames[s.frame_count++] = frame;
    }
  good = good && list_links(&s, body, &scratch);
  for (uint32_t l = 0; good && s.links && l < s.link_begins[s.count]; l++) {
    if (s.links[l] < island->free_count) continue;
    uint32_t frame = island->pins.frames[s.links[l] - island->free_count];
    if (frame_position(&s, frame) == s.frame_count) s.frames[s.frame_count++] = frame;
  }
  body->is_pinned = good && s.frame_count > 0;
  if (good && s.frame_count == 1) body->driver_frame = s.frames[0];
  if (good && s.frame_count > 1) {
    s.fractions = sbfi_arena_allocate(&scratch, (size_t)s.count * s.frame_count, sizeof *s.fractions);
    float *mean = sbfi_arena_allocate(&scratch, s.frame_count, sizeof *mean);
    sbri_driver *drivers = sbfi_arena_allocate(&model->arena, count, sizeof *drivers);
    good = s.fractions && mean && drivers;
    for (int i = 0; good && i < SWEEPS; i++) sweep(&s, mean);
    for (uint32_t i = 0; good && i < count; i++)
      drivers[i] =
          i < s.count ? driver_of(&s, s.fractions + (size_t)i * s.frame_count, otherwise) : drivers[0];
    body->drivers = drivers;
  }
  sbfi_arena_free(&scratch);
  return good;
}
