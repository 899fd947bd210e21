/* Springs in colours: no two springs of a colour share a free point, so a sweep handles eight at a time. The
 * order of corrections is then independent of the file's: springs that are listed, and swept, by their
 * distance from a pin can be unstable where the coloured ones are not.
 *
 * Greedy colouring in the springs' order. Pinned points are ignored because nothing moves them. A point with
 * more springs than there are colours has the remaining ones in blocks of one. */
#include <string.h>

#include "base/assert.h"
#include "base/memory.h"
#include "prepare/prepare.h"

enum { COLOUR_WORDS = 4, COLOURS = 64 * COLOUR_WORDS };

typedef struct colouring {
  const sbri_island *island;
  const sbri_body *bodies;        /* of the model */
  uint64_t (*used)[COLOUR_WORDS]; /* (free_count) colours of the springs at each point */
  uint32_t *colours;              /* (spring_count) COLOURS: none free */
  uint32_t *ordered;              /* (spring_count) springs by colour */
  uint32_t counts[COLOURS + 1];
} colouring;

static uint32_t min_colour(const uint64_t *a, const uint64_t *b) {
  for (uint32_t word = 0; word < COLOUR_WORDS; word++) {
    uint64_t used_count = (a ? a[word] : 0) | (b ? b[word] : 0);
    for (uint32_t bit = 0; bit < 64 && used_count != UINT64_MAX; bit++)
      if (!(used_count >> bit & 1)) return 64 * word + bit;
  }
  return COLOURS;
}

static void colour(colouring *c) {
  for (uint32_t i = 0; i < c->island->springs.count; i++) {
    const sbfi_spring *s = &c->island->springs.at[i];
    uint64_t *a = s->a < c->island->free_count ? c->used[s->a] : NULL;
    uint64_t *b = s->b < c->island->free_count ? c->used[s->b] : NULL;
    uint32_t chosen = c->colours[i] = min_colour(a, b);
    c->counts[chosen]++;
    if (chosen == COLOURS) continue;
    if (a) a[chosen / 64] |= UINT64_C(1) << chosen % 64;
    if (b) b[chosen / 64] |= UINT64_C(1) << chosen % 64;
  }
  uint32_t begins[COLOURS + 1], next = 0;
  for (uint32_t k = 0; k <= COLOURS; k++) {
    begins[k] = next;
    next += c->counts[k];
  }
  for (uint32_t i = 0; i < c->island->springs.count; i++) c->ordered[begins[c->colours[i]]++] = i;
}

/* Whether it is a spare slot: a split point may become an end of any spring. */
static bool is_reserved(const colouring *c, uint32_t slot) {
  for (uint32_t b = 0; b < c->island->body_count; b++) {
    const sbri_body *body = &c->bodies[c->island->bodies[b]];
    if (slot >= body->slots.first_spare && slot < body->slots.real_end) return true;
  }
  return false;
}

/* A slot without an end of these springs; slot_count: none. */
static uint32_t spare_slot(const colouring *c, const uint32_t *springs, uint32_t count) {
  const sbri_island *island = c->island;
  for (uint32_t slot = island->slot_count; slot-- > 0;) {
    bool free = !is_reserved(c, slot);
    for (uint32_t i = 0; i < count; i++)
      free = free && island->springs.at[springs[i]].a != slot && island->springs.at[springs[i]].b != slot;
    if (free) return slot;
  }
  return island->slot_count;
}

/* Number of springs in the next block: eight, or fewer with a spare slot for unused lanes. */
static uint32_t next_block_size(
    const colouring *c, const uint32_t *springs, uint32_t remaining, uint32_t *spare) {
  uint32_t count = remaining < SBRI_BLOCK ? remaining : SBRI_BLOCK;
  *spare = 0;
  if (count == SBRI_BLOCK) return count;
  while ((*spare = spare_slot(c, springs, count)) == c->island->slot_count) count--;
  return count;
}

typedef struct link_tables {
  sbri_link_block *links;
  float *damping, *slack;
  sbri_link_limits *limits;
  sbri_link_flows *flows;
  uint32_t *link_of_spring;
} link_tables;

static void fill(const link_tables *t, const sbri_island *island, const sbfi_spring_bounds *bounds,
    uint32_t block, const uint32_t *springs, uint32_t count, uint32_t spare) {
  sbri_link_block *link = &t->links[block];
  for (uint32_t lane = 0; lane < SBRI_BLOCK; lane++) {
    link->a[lane] = link->b[lane] = spare;
    if (t->limits) t->limits[block].min[lane] = -1;
    if (lane >= count) continue;
    const sbfi_spring *s = &island->springs.at[springs[lane]];
    const sbfi_spring_bounds *is = &bounds[springs[lane]];
    link->a[lane] = s->a, link->b[lane] = s->b;
    link->stiffness[lane] = s->stiffness_n_m, link->rest[lane] = s->rest_length_m;
    t->link_of_spring[springs[lane]] = block * SBRI_BLOCK + lane;
    if (t->damping) t->damping[block * SBRI_BLOCK + lane] = s->damping_ns_m;
    if (t->slack) t->slack[block * SBRI_BLOCK + lane] = s->slack;
    if (t->limits) t->limits[block].min[lane] = is->strain_min, t->limits[block].max[lane] = is->strain_max;
    if (!t->flows) continue;
    t->flows[block].yield[lane] = is->yield_strain;
    t->flows[block].rate[lane] = is->yield_strain > 0 ? is->yield_1_s : 0;
    t->flows[block].tear[lane] = is->tear_strain;
  }
}

/* Whether no two springs of a block share a free point: lanes then write to different points. */
static bool is_disjoint(const sbri_island *island, const uint32_t *springs, uint32_t count) {
  for (uint32_t i = 0; i < count; i++)
    for (uint32_t k = 0; k < i; k++) {
      const sbfi_spring *a = &island->springs.at[springs[i]], *b = &island->springs.at[springs[k]];
      if (a->a < island->free_count && (a->a == b->a || a->a == b->b)) return false;
      if (a->b < island->free_count && (a->b == b->a || a->b == b->b)) return false;
    }
  return true;
}

/* Visits the colours; with `t` NULL it only counts the blocks. */
static uint32_t visit_colours(const colouring *c, const link_tables *t, const sbfi_spring_bounds *bounds) {
  uint32_t block = 0;
  const uint32_t *next = c->ordered;
  for (uint32_t k = 0; k <= COLOURS; k++)
    for (uint32_t remaining = c->counts[k]; remaining > 0;) {
      uint32_t spare, count = next_block_size(c, next, k == COLOURS ? 1 : remaining, &spare);
      SBF_ASSERT(count > 0 && count <= SBRI_BLOCK && is_disjoint(c->island, next, count));
      if (t) fill(t, c->island, bounds, block, next, count, spare);
      block++, next += count, remaining -= count;
    }
  return block;
}

static bool allocate(
    sbr_model *model, sbri_island *island, const sbfi_spring_bounds *bounds, link_tables *t) {
  bool damped = false, slack = false, limited = false, flowing = false;
  for (uint32_t i = 0; i < island->springs.count; i++) {
    const sbfi_spring_bounds *is = &bounds[i];
    slack = slack || island->springs.at[i].slack != 0;
    damped = damped || slack || island->springs.at[i].damping_ns_m > 0;
    limited = limited || is->strain_min > -1 || is->strain_max > 0;
    flowing = flowing || (is->yield_strain > 0 && is->yield_1_s > 0) || is->tear_strain > 0;
  }
  size_t blocks = island->links.block_count ? island->links.block_count : 1;
  t->links = sbfi_arena_allocate(&model->arena, blocks, sizeof *t->links);
  t->link_of_spring = sbfi_arena_allocate(&model->arena, (size_t)island->springs.count + 1, sizeof(uint32_t));
  if (damped) t->damping = sbfi_arena_allocate(&model->arena, blocks * SBRI_BLOCK, sizeof *t->damping);
  if (slack) t->slack = sbfi_arena_allocate(&model->arena, blocks * SBRI_BLOCK, sizeof *t->slack);
  if (limited) t->limits = sbfi_arena_allocate(&model->arena, blocks, sizeof *t->limits);
  if (flowing) t->flows = sbfi_arena_allocate(&model->arena, blocks, sizeof *t->flows);
  return t->links && t->link_of_spring && (!damped || t->damping) && (!slack || t->slack) &&
         (!limited || t->limits) && (!flowing || t->flows);
}

bool sbri_links_make(sbr_model *model, sbri_island *island, const sbfi_spring_bounds *bounds) {
  sbfi_arena scratch;
  sbfi_arena_init(&scratch, &model->arena.allocator, 0);
  colouring *c = sbfi_arena_allocate(&scratch, 1, sizeof *c);
  size_t springs = (size_t)island->springs.count + 1;
  bool good = c != NULL;
  if (good) {
    c->island = island, c->bodies = model->bodies;
    c->used = sbfi_arena_allocate(&scratch, (size_t)island->free_count + 1, sizeof *c->used);
    c->colours = sbfi_arena_allocate(&scratch, springs, sizeof *c->colours);
    c->ordered = sbfi_arena_allocate(&scratch, springs, sizeof *c->ordered);
    good = c->used && c->colours && c->ordered;
  }
  link_tables t = {0};
  if (good) {
    colour(c);
    island->links.block_count = visit_colours(c, NULL, bounds);
    good = allocate(model, island, bounds, &t);
  }
  if (good) visit_colours(c, &t, bounds);
  sbfi_arena_free(&scratch);
  island->links.blocks = t.links, island->links.damping = t.damping, island->links.slack = t.slack,
  island->links.limits = t.limits;
  island->links.flows = t.flows, island->links.of_spring = t.link_of_spring;
  return good;
}
