/* Splits points of networks where springs have torn.
 *
 * Two springs of a point are connected if their other ends are the same, or at most two springs apart without
 * passing this point. If springs that were connected at rest fall into several groups by a tear, the groups
 * are pieces of one fabric that would now rotate about the point as about a hinge. The group with the most
 * springs keeps the point. Each other group gets a spare point of the body at the same position and velocity,
 * with mass in proportion to the stiffness of its springs, so that no group becomes faster; momentum and
 * energy are conserved. A group of one spring is a thread: it stays, and may tear by itself. Springs that
 * were never connected, as on both sides of a rope's point, stay too. Pinned points do not split.
 */
#include "soft/tear/split_springs.h"

#include <string.h>

#include "soft/tear/spare_slot.h"
#include "soft/tear/spring_network.h"

/* Points with more springs do not split: hubs in the middle of sections, which connect all points. */
enum { MAX_SPRINGS = 192 };

typedef struct spring_star {
  uint32_t links[MAX_SPRINGS], others[MAX_SPRINGS];
  uint32_t parts[MAX_SPRINGS]; /* the first of its springs to which it is connected */
  uint32_t count;
} spring_star;

typedef struct fraying {
  sbri_character *c;
  sbri_island island; /* its present state */
  sbri_network whole, rest;
  const uint32_t *origins;
  uint32_t *owners; /* (slots) first spring of each node around the present point; else SBRI_UNUSED */
  spring_star now, made;
} fraying;

/* ---- Around a point ---- */

static uint32_t root_of(spring_star *star, uint32_t i) {
  while (star->parts[i] != i) i = star->parts[i] = star->parts[star->parts[i]];
  return i;
}

static void claim(const fraying *f, spring_star *star, uint32_t node, uint32_t spring) {
  uint32_t *owner = &f->owners[node];
  if (*owner == SBRI_UNUSED) {
    *owner = spring;
    return;
  }
  uint32_t a = root_of(star, *owner), b = root_of(star, spring);
  star->parts[a > b ? a : b] = a < b ? a : b;
}

/* Each spring claims the point at its other end and the neighbours of that point; false: too many. */
static bool find_star(const fraying *f, const sbri_network *network, uint32_t slot, spring_star *star) {
  uint32_t origin = f->origins[slot];
  star->count = 0;
  for (sbri_network_end end = {0}; sbri_network_next(network, slot, &end);) {
    if (star->count == MAX_SPRINGS) return false;
    star->links[star->count] = end.link, star->others[star->count] = end.other;
    star->parts[star->count] = star->count, star->count++;
  }
  for (uint32_t i = 0; i < star->count; i++) {
    claim(f, star, star->others[i], i);
    for (sbri_network_end end = {0}; sbri_network_next(network, star->others[i], &end);)
      if (f->origins[end.other] != origin) claim(f, star, end.other, i);
  }
  for (uint32_t i = 0; i < star->count; i++) {
    f->owners[star->others[i]] = SBRI_UNUSED;
    for (sbri_network_end end = {0}; sbri_network_next(network, star->others[i], &end);)
      f->owners[end.other] = SBRI_UNUSED;
  }
  for (uint32_t i = 0; i < star->count; i++) star->parts[i] = root_of(star, i);
  return true;
}

static uint32_t size_of(const spring_star *star, uint32_t part) {
  uint32_t size = 0;
  for (uint32_t i = 0; i < star->count; i++) size += star->parts[i] == part;
  return size;
}

/* The group of a point's spring at rest. */
static uint32_t fabric_of(const fraying *f, uint32_t spring) {
  for (uint32_t i = 0; i < f->made.count; i++)
    if (f->made.links[i] == f->now.links[spring]) return f->made.parts[i];
  return SBRI_UNUSED;
}

/* Whether the group separates from the point, because another group is larger. */
static bool separates(const fraying *f, uint32_t part) {
  uint32_t size = size_of(&f->now, part), fabric = fabric_of(f, part);
  if (size < 2) return false;
  for (uint32_t other = 0; other < f->now.count; other++) {
    if (f->now.parts[other] != other || other == part || fabric_of(f, other) != fabric) continue;
    uint32_t its_size = size_of(&f->now, other);
    if (its_size > size || (its_size == size && other < part)) return true;
  }
  return false;
}

/* ---- Splitting ---- */

/* Cell and lane of a slot's spring. */
static uint32_t cell_of(const fraying *f, uint32_t slot, uint32_t link) {
  uint32_t block = slot / SBRI_BLOCK, lane = slot % SBRI_BLOCK, cell = f->island.cells.begins[block];
  while (f->island.cells.links[cell * SBRI_BLOCK + lane] != link ||
         f->island.cells.at[cell].others[lane] == slot)
    cell++;
  return cell;
}

static float stiffness_of(const fraying *f, uint32_t slot, uint32_t spring) {
  return f->island.cells.at[cell_of(f, slot, f->now.links[spring])].stiffness[slot % SBRI_BLOCK];
}

/* Moves the spring's row of one slot to the end of another's, whose next row is `at`. */
static void move_row(const fraying *f, uint32_t link, uint32_t from, uint32_t to, uint32_t at) {
  const sbri_island *island = &f->island;
  sbri_spring_cell *cells = sbri_thread_cells(f->c) + island->cells.first_state_cell;
  float *damping = sbri_thread_damping(f->c) + (size_t)island->cells.first_state_cell * SBRI_BLOCK;
  float *slack = sbri_thread_slack(f->c) + (size_t)island->cells.first_state_cell * SBRI_BLOCK;
  uint32_t *links = sbri_thread_links(f->c) + (size_t)island->cells.first_state_cell * SBRI_BLOCK;
  uint32_t *ends = sbri_thread_ends(f->c) + island->cells.first_state_block;
  uint32_t old_cell = cell_of(f, from, link), old_lane = from % SBRI_BLOCK;
  uint32_t block = to / SBRI_BLOCK, lane = to % SBRI_BLOCK, cell = island->cells.begins[block] + at;
  sbri_spring_cell *old = &cells[old_cell];
  cells[cell].others[lane] = old->others[old_lane];
  cells[cell].stiffness[lane] = old->stiffness[old_lane],
  cells[cell].rest_force[lane] = old->rest_force[old_lane];
  damping[cell * SBRI_BLOCK + lane] = damping[old_cell * SBRI_BLOCK + old_lane];
  slack[cell * SBRI_BLOCK + lane] = slack[old_cell * SBRI_BLOCK + old_lane];
  links[cell * SBRI_BLOCK + lane] = link;
  old->others[old_lane] = from, old->stiffness[old_lane] = old->rest_force[old_lane] = 0;
  damping[old_cell * SBRI_BLOCK + old_lane] = 0, links[old_cell * SBRI_BLOCK + old_lane] = 0;
  if (cell + 1 > ends[block]) ends[block] = cell + 1;
}

/* Changes an end of the spring from `from` to `to`. */
static void move_spring(const fraying *f, uint32_t spring, uint32_t from, uint32_t to, uint32_t at) {
  const sbri_island *island = &f->island;
  uint32_t link = f->now.links[spring], other = f->now.others[spring];
  sbri_link_block *block = &sbri_thread_blocks(f->c)[island->links.first_state_block + link / SBRI_BLOCK];
  uint32_t lane = link % SBRI_BLOCK;
  *(block->a[lane] == from ? &block->a[lane] : &block->b[lane]) = to;
  move_row(f, link, from, to, at);
  if (other < island->free_count)
    sbri_thread_cells(f->c)[island->cells.first_state_cell + cell_of(f, other, link)]
        .others[other % SBRI_BLOCK] = to;
}

/* Returns the number of groups that could not be split off. */
static uint32_t split(fraying *f, uint32_t slot) {
  const sbri_island *island = &f->island;
  if (!find_star(f, &f->whole, slot, &f->now) || size_of(&f->now, 0) == f->now.count) return 0;
  if (!find_star(f, &f->rest, f->origins[slot], &f->made)) return 0;
  float all = 0, mass = island->masses[slot], left = mass;
  uint32_t unsplit = 0;
  bool leaving[MAX_SPRINGS];
  for (uint32_t i = 0; i < f->now.count; i++) {
    all += stiffness_of(f, slot, i);
    leaving[i] = f->now.parts[i] == i && separates(f, i);
  }
  for (uint32_t part = 0; part < f->now.count; part++) {
    if (!leaving[part]) continue;
    uint32_t capacity = sbri_find_spare_slot(f->c, island, slot), block = capacity / SBRI_BLOCK, at = 0;
    if (capacity == SBRI_UNUSED ||
        size_of(&f->now, part) > island->cells.begins[block + 1] - island->cells.begins[block]) {
      unsplit++;
      continue;
    }
    float stiffness = 0;
    for (uint32_t i = 0; i < f->now.count; i++)
      if (f->now.parts[i] == part) stiffness += stiffness_of(f, slot, i);
    float fraction = all > 0 ? mass * (stiffness / all) : 0.5f * left;
    sbri_split_copy(f->c, island, slot, capacity);
    sbri_split_weigh(f->c, island, capacity, fraction);
    left -= fraction;
    for (uint32_t i = 0; i < f->now.count; i++)
      if (f->now.parts[i] == part) move_spring(f, i, slot, capacity, at++);
  }
  sbri_split_weigh(f->c, island, slot, left);
  return unsplit;
}

/* ---- A whole island ---- */

/* Ends of torn springs and their neighbours: no other point can have lost a connection. */
static void mark(const fraying *f, uint8_t *torn_ends) {
  const sbri_island *island = &f->island;
  enum { TORN = 1, NEAR = 2 };
  memset(torn_ends, 0, island->slot_count);
  for (uint32_t i = 0; i < island->links.block_count * SBRI_BLOCK; i++)
    if (!(f->whole.strengths[i] > 0)) {
      const sbri_link_block *link = &island->links.blocks[i / SBRI_BLOCK];
      torn_ends[link->a[i % SBRI_BLOCK]] = torn_ends[link->b[i % SBRI_BLOCK]] = TORN;
    }
  for (uint32_t slot = 0; slot < island->free_count; slot++)
    for (sbri_network_end end = {0}; !torn_ends[slot] && sbri_network_next(&f->whole, slot, &end);)
      if (torn_ends[end.other] == TORN) torn_ends[slot] = NEAR;
}

uint32_t sbri_island_split_springs(sbri_character *c, uint32_t index) {
  const sbri_island *made = &c->model->islands[index];
  const float *strengths = sbri_strengths(c) + made->links.first_flow;
  uint8_t *torn_ends = sbri_torn_ends(c) + made->first_slot;
  fraying f = {.c = c,
      .island = sbri_island_now(c, made),
      .rest = {made, NULL},
      .origins = sbri_origins(c) + made->first_slot,
      .owners = sbri_owners(c) + made->first_slot};
  f.whole = (sbri_network){&f.island, strengths};
  memset(f.owners, 0xff, made->slot_count * sizeof *f.owners);
  mark(&f, torn_ends);
  uint32_t unsplit = 0;
  for (uint32_t b = 0; b < made->body_count; b++) {
    const sbri_body *body = &c->model->bodies[made->bodies[b]];
    for (uint32_t slot = body->slots.begin; sbri_body_frays(body) && slot < body->slots.real_end; slot++)
      if (f.origins[slot] != SBRI_UNUSED && torn_ends[slot]) unsplit += split(&f, slot);
  }
  return unsplit;
}
