/* Regions of shape matching bodies: weights and offsets, in blocks of eight regions of similar size. */
#include <string.h>

#include "mechanics/shape_region.h"
#include "prepare/island_maker.h"

static bool acts(const sbri_body *body) {
  return body->level->model == SBF_ELASTIC_MODEL_SHAPE_MATCHING && body->level->regions;
}

/* ---- One region ---- */

typedef struct region_weights {
  const sbri_island *island;
  const sbri_body *body;
  uint32_t *uses;   /* (points) number of regions with each point */
  uint32_t *begins; /* (regions + 1) */
  double *weights;  /* of the present region: (its points) a, kg */
  sbfi_d3 *rest;    /* and their rest positions */
} region_weights;

static float mass_of(const region_weights *r, uint32_t point) {
  uint32_t slot = r->body->slots.from_point[point];
  return slot < r->island->free_count ? r->island->masses[slot] : 0;
}

/* Fills weights and rest of region `number`; returns its number of points, 0 if all of them are pinned. */
static uint32_t find_weights(const region_weights *r, uint32_t number) {
  const uint32_t *points = r->body->level->regions->points.at + r->begins[number];
  uint32_t count = r->begins[number + 1] - r->begins[number], free_count = 0;
  double sum = 0;
  for (uint32_t i = 0; i < count; i++) {
    float mass = mass_of(r, points[i]);
    sum += mass;
    free_count += mass > 0;
  }
  for (uint32_t i = 0; free_count && i < count; i++) {
    float mass = mass_of(r, points[i]);
    const sbf_vec3 *p = &r->body->level->positions.at[points[i]];
    r->weights[i] = (mass > 0 ? (double)mass : sum / free_count) / r->uses[points[i]];
    r->rest[i] = (sbfi_d3){p->x, p->y, p->z};
  }
  return free_count ? count : 0;
}

/* ---- Blocks ---- */

static bool open_weights(sbri_island_maker *m, const sbri_body *body, region_weights *r) {
  const sbf_shape_regions *regions = body->level->regions;
  uint32_t count = regions->sizes.count, max = 0;
  *r = (region_weights){.island = m->island, .body = body};
  r->uses = sbri_scratch(m, body->level->positions.count, sizeof *r->uses);
  r->begins = sbri_scratch(m, (size_t)count + 1, sizeof *r->begins);
  if (!r->uses || !r->begins) return false;
  for (uint32_t i = 0; i < count; i++) {
    r->begins[i + 1] = r->begins[i] + regions->sizes.at[i];
    max = regions->sizes.at[i] > max ? regions->sizes.at[i] : max;
  }
  for (uint32_t i = 0; i < regions->points.count; i++) r->uses[regions->points.at[i]]++;
  r->weights = sbri_scratch(m, max, sizeof *r->weights);
  r->rest = sbri_scratch(m, max, sizeof *r->rest);
  return r->weights && r->rest;
}

/* Active regions by decreasing size, equal ones in the level's order. */
static bool sort_regions(sbri_island_maker *m, const region_weights *r, uint32_t *order, uint32_t *count) {
  const sbf_u32_list sizes = r->body->level->regions->sizes;
  uint32_t max = 0;
  for (uint32_t i = 0; i < sizes.count; i++) max = sizes.at[i] > max ? sizes.at[i] : max;
  uint32_t *begins = sbri_scratch(m, (size_t)max + 2, sizeof *begins);
  if (!begins) return false;
  for (uint32_t i = 0; i < sizes.count; i++)
    if (find_weights(r, i)) begins[max - sizes.at[i] + 1]++;
  for (uint32_t size = 0; size <= max; size++) begins[size + 1] += begins[size];
  *count = begins[max + 1];
  for (uint32_t i = 0; i < sizes.count; i++)
    if (find_weights(r, i)) order[begins[max - sizes.at[i]]++] = i;
  return true;
}

static void fill_lane(const region_weights *r, uint32_t number, sbri_region_block *block,
    sbri_region_member *members, uint32_t lane) {
  const sbf_shape_regions *regions = r->body->level->regions;
  const uint32_t *points = regions->points.at + r->begins[number];
  uint32_t count = find_weights(r, number);
  double square = (double)regions->stiffness * regions->stiffness, sum = 0;
  sbfi_d3 center = sbfi_region_center(r->weights, r->rest, count);
  for (uint32_t i = 0; i < block->member_count; i++) {
    sbri_region_member *to = &members[i];
    to->slots[lane] = r->body->slots.from_point[points[i < count ? i : 0]];
    if (i >= count) continue;
    sbfi_d3 offset = sbfi_d3_sub(r->rest[i], center);
    to->stiffness[lane] = (float)(r->weights[i] * square);
    to->offsets[0][lane] = (float)offset.x, to->offsets[1][lane] = (float)offset.y;
    to->offsets[2][lane] = (float)offset.z;
    sum += (double)to->stiffness[lane];
  }
  block->inverse_sums[lane] = (float)(1 / sum);
}

/* Unused lanes hold a point of the block's first region. */
static void fill_block(const region_weights *r, const uint32_t *order, uint32_t count,
    sbri_region_block *block, sbri_region_member *members) {
  for (uint32_t lane = 0; lane < SBRI_BLOCK; lane++)
    if (lane < count) fill_lane(r, order[lane], block, members, lane);
  for (uint32_t lane = count; lane < SBRI_BLOCK; lane++)
    for (uint32_t i = 0; i < block->member_count; i++) members[i].slots[lane] = members[0].slots[0];
}

typedef struct tables {
  sbfi_array blocks, members;
} tables;

static bool add_body(sbri_island_maker *m, sbri_body *body, tables *to) {
  region_weights r;
  if (!open_weights(m, body, &r)) return false;
  const sbf_shape_regions *regions = body->level->regions;
  uint32_t count = 0, *order = sbri_scratch(m, regions->sizes.count, sizeof *order);
  if (!order || !sort_regions(m, &r, order, &count)) return false;
  for (uint32_t first = 0; first < count; first += SBRI_BLOCK) {
    uint32_t max = regions->sizes.at[order[first]];
    sbri_region_block *block = sbfi_array_push(&to->blocks, 1);
    sbri_region_member *members = sbfi_array_push(&to->members, max);
    if (!block || !members) return false;
    memset(members, 0, max * sizeof *members);
    *block = (sbri_region_block){.first_member = (uint32_t)to->members.count - max,
        .member_count = max,
        .damping_s = body->source->attributes.stiffness_damping};
    uint32_t here = count - first < SBRI_BLOCK ? count - first : SBRI_BLOCK;
    fill_block(&r, order + first, here, block, members);
  }
  if (count && m->island->regions.max_rad_s < regions->stiffness)
    m->island->regions.max_rad_s = regions->stiffness;
  double beta = count ? body->source->attributes.stiffness_damping : 0;
  if (beta > m->island->springs.stiffness_damping_s) m->island->springs.stiffness_damping_s = beta;
  m->island->regions.have_damping = m->island->regions.have_damping || beta > 0;
  return true;
}

static const void *keep(sbri_island_maker *m, const sbfi_array *from, size_t size) {
  void *kept = sbri_model_allocate(m, from->count, size);
  return kept && from->count ? memcpy(kept, from->at, from->count * size) : kept;
}

bool sbri_regions_make(sbri_island_maker *m) {
  sbri_island *island = m->island;
  tables made;
  sbfi_array_init(&made.blocks, &m->model->arena.allocator, sizeof(sbri_region_block));
  sbfi_array_init(&made.members, &m->model->arena.allocator, sizeof(sbri_region_member));
  bool good = true;
  for (uint32_t b = 0; good && b < island->body_count; b++) {
    sbri_body *body = sbri_maker_body(m, b);
    body->elements.first_region_block = (uint32_t)made.blocks.count;
    if (acts(body)) good = add_body(m, body, &made);
    body->elements.region_block_end = (uint32_t)made.blocks.count;
  }
  island->regions.block_count = (uint32_t)made.blocks.count;
  if (good && island->regions.block_count > 0) {
    island->regions.blocks = keep(m, &made.blocks, sizeof(sbri_region_block));
    island->regions.members = keep(m, &made.members, sizeof(sbri_region_member));
    good = island->regions.blocks && island->regions.members;
  }
  sbfi_array_free(&made.blocks);
  sbfi_array_free(&made.members);
  return good;
}
