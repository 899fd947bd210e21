#include "soft/solvers/descent_table.h"

#include <string.h>

#include "mechanics/neo_hookean.h"

enum { MAX_COLOURS = 64 };

/* Elements of each free slot; those of `slot` begin at begins[slot]. */
typedef struct ends {
  uint32_t *begins, *elements; /* an element: its index x 4 + its end */
} ends;

typedef struct descent_maker {
  sbr_model *model;
  sbri_island *island;
  sbfi_arena scratch;
  const sbf_uint4 *corners; /* (tetrahedron_count) slots */
  ends springs, solids;
  uint8_t *colours;
  sbfi_array blocks, cells, damping, slack, solid_blocks; /* damping, slack: eight per cell */
} descent_maker;

static uint32_t slot_of(const descent_maker *m, bool solid, uint32_t element, uint32_t end) {
  const sbfi_spring *s = &m->island->springs.at[element];
  return solid ? m->corners[element].at[end] : end ? s->b : s->a;
}

static bool list_ends(descent_maker *m, bool solid, ends *to) {
  uint32_t width = solid ? 4 : 2, free_count = m->island->free_count;
  uint32_t count = solid ? m->island->tetrahedra.count : m->island->springs.count;
  to->begins = sbfi_arena_allocate(&m->scratch, (size_t)free_count + 2, sizeof *to->begins);
  to->elements = sbfi_arena_allocate(&m->scratch, (size_t)count * width + 1, sizeof *to->elements);
  if (!to->begins || !to->elements) return false;
  for (int pass = 0; pass < 2; pass++) {
    for (uint32_t e = 0; e < count; e++)
      for (uint32_t k = 0; k < width; k++) {
        uint32_t slot = slot_of(m, solid, e, k);
        if (slot >= free_count) continue;
        if (pass)
          to->elements[to->begins[slot + 1]++] = 4 * e + k;
        else
          to->begins[slot + 2]++;
      }
    for (uint32_t i = 0; pass == 0 && i < free_count; i++) to->begins[i + 2] += to->begins[i + 1];
  }
  return true;
}

static void add_neighbour_colours(
    const descent_maker *m, bool solid, const ends *of, uint32_t slot, uint64_t *used_colours) {
  for (uint32_t i = of->begins[slot]; i < of->begins[slot + 1]; i++)
    for (uint32_t k = 0; k < (solid ? 4u : 2u); k++) {
      uint32_t other = slot_of(m, solid, of->elements[i] / 4, k);
      if (other != slot && other < m->island->free_count && m->colours[other])
        *used_colours |= (uint64_t)1 << (m->colours[other] - 1);
    }
}

/* Gives each point the first colour that no neighbour has. The last colour takes all remaining points, which
 * move one at a time. */
static void colour_points(descent_maker *m, uint32_t *count) {
  *count = 0;
  for (uint32_t slot = 0; slot < m->island->free_count; slot++) {
    uint64_t used_colours = 0;
    uint32_t colour = 0;
    if (!(m->island->masses[slot] > 0)) continue;
    add_neighbour_colours(m, false, &m->springs, slot, &used_colours);
    add_neighbour_colours(m, true, &m->solids, slot, &used_colours);
    while (colour < MAX_COLOURS && used_colours >> colour & 1) colour++;
    if (colour == MAX_COLOURS) colour--;
    m->colours[slot] = (uint8_t)(colour + 1);
    if (colour + 1 > *count) *count = colour + 1;
  }
}

/* ---- Blocks ---- */

static void fill_spring(descent_maker *m, uint32_t number, uint32_t lane, uint32_t element) {
  const sbfi_spring *s = &m->island->springs.at[element / 4];
  sbri_spring_cell *cell = (sbri_spring_cell *)m->cells.at + number;
  ((float *)m->damping.at)[(size_t)number * SBRI_BLOCK + lane] = s->damping_ns_m;
  ((float *)m->slack.at)[(size_t)number * SBRI_BLOCK + lane] = s->slack;
  cell->others[lane] = element % 4 ? s->a : s->b;
  cell->stiffness[lane] = s->stiffness_n_m;
  cell->rest_force[lane] = s->stiffness_n_m * s->rest_length_m;
}

/* Reorders the tetrahedron so that corner 0 is the point. Two swaps preserve its orientation. */
static void fill_corner(
    const descent_maker *m, sbri_tetrahedron_block *block, uint32_t lane, uint32_t element) {
  static const int orders[4][4] = {{0, 1, 2, 3}, {1, 0, 3, 2}, {2, 3, 0, 1}, {3, 2, 1, 0}};
  const int *order = orders[element % 4];
  uint32_t number = element / 4;
  sbfi_tetrahedron made, reordered;
  for (uint32_t b = 0; b < m->island->body_count; b++) {
    const sbri_body *body = &m->model->bodies[m->island->bodies[b]];
    if (number - body->elements.first_tetrahedron >= body->elements.tetrahedron_count) continue;
    if (!sbri_body_tetrahedron(body, number - body->elements.first_tetrahedron, &made)) return;
    reordered = made;
    for (int k = 0; k < 4; k++) {
      reordered.gradients[k] = made.gradients[order[k]];
      block->corners[k][lane] = m->corners[number].at[order[k]];
    }
    sbri_tetrahedron_fill(block, lane, &reordered);
  }
}

static bool add_block(descent_maker *m, const uint32_t *slots, uint32_t count) {
  sbri_descent_block *block = sbfi_array_push(&m->blocks, 1);
  uint32_t springs = 0, solids = 0;
  if (!block) return false;
  *block = (sbri_descent_block){
      .first_spring = (uint32_t)m->cells.count, .first_corner = (uint32_t)m->solid_blocks.count};
  for (uint32_t lane = 0; lane < SBRI_BLOCK; lane++) {
    uint32_t slot = block->slots[lane] = slots[lane < count ? lane : 0];
    if (lane >= count) continue;
    block->masses[lane] = m->island->masses[slot];
    uint32_t spring_count = m->springs.begins[slot + 1] - m->springs.begins[slot];
    uint32_t solid_count = m->solids.begins[slot + 1] - m->solids.begins[slot];
    springs = spring_count > springs ? spring_count : springs;
    solids = solid_count > solids ? solid_count : solids;
  }
  block->spring_end = block->first_spring + springs, block->corner_end = block->first_corner + solids;
  sbri_spring_cell *cells = sbfi_array_push(&m->cells, springs);
  sbri_tetrahedron_block *corners = sbfi_array_push(&m->solid_blocks, solids);
  bool has_tables = sbfi_array_push(&m->damping, (size_t)springs * SBRI_BLOCK) &&
                    sbfi_array_push(&m->slack, (size_t)springs * SBRI_BLOCK);
  if ((springs && !(cells && has_tables)) || (solids && !corners)) return false;
  if (springs) memset(cells, 0, springs * sizeof *cells);
  if (solids) memset(corners, 0, solids * sizeof *corners);
  for (uint32_t lane = 0; lane < SBRI_BLOCK; lane++) {
    uint32_t slot = block->slots[lane];
    for (uint32_t i = 0; i < springs; i++) cells[i].others[lane] = slot;
    for (uint32_t i = 0; i < solids; i++)
      for (int k = 0; k < 4; k++) corners[i].corners[k][lane] = slot;
    if (lane >= count) continue;
    const ends *s = &m->springs, *t = &m->solids;
    for (uint32_t i = s->begins[slot]; i < s->begins[slot + 1]; i++) {
      fill_spring(m, block->first_spring + (i - s->begins[slot]), lane, s->elements[i]);
    }
    for (uint32_t i = t->begins[slot]; i < t->begins[slot + 1]; i++)
      fill_corner(m, &corners[i - t->begins[slot]], lane, t->elements[i]);
  }
  return true;
}

static bool add_colour(descent_maker *m, uint32_t colour) {
  uint32_t slots[SBRI_BLOCK], count = 0, width = colour == MAX_COLOURS ? 1 : SBRI_BLOCK;
  for (uint32_t slot = 0; slot < m->island->free_count; slot++) {
    if (m->colours[slot] != colour) continue;
    slots[count++] = slot;
    if (count == width && !add_block(m, slots, count)) return false;
    if (count == width) count = 0;
  }
  return count == 0 || add_block(m, slots, count);
}

static const void *copy_table(descent_maker *m, const sbfi_array *from, size_t size) {
  void *copy = sbfi_arena_allocate(&m->model->arena, from->count ? from->count : 1, size);
  return copy && from->count ? memcpy(copy, from->at, from->count * size) : copy;
}

static bool make(descent_maker *m, sbri_descent *made) {
  sbri_island *island = m->island;
  sbf_uint4 *corners =
      sbfi_arena_allocate(&m->scratch, (size_t)island->tetrahedra.count + 1, sizeof *corners);
  m->colours = sbfi_arena_allocate(&m->scratch, (size_t)island->free_count + 1, 1);
  if (!corners || !m->colours) return false;
  m->corners = corners;
  for (uint32_t b = 0; b < island->body_count; b++) {
    const sbri_body *body = &m->model->bodies[island->bodies[b]];
    for (uint32_t t = 0; t < body->elements.tetrahedron_count; t++)
      for (int k = 0; k < 4; k++)
        corners[body->elements.first_tetrahedron + t].at[k] =
            body->slots.from_point[body->level->lattice.tetrahedra.at[t].at[k]];
  }
  if (!list_ends(m, false, &m->springs) || !list_ends(m, true, &m->solids)) return false;
  colour_points(m, &made->colour_count);
  for (uint32_t colour = 1; colour <= made->colour_count; colour++)
    if (!add_colour(m, colour)) return false;
  made->block_count = (uint32_t)m->blocks.count;
  made->blocks = copy_table(m, &m->blocks, sizeof(sbri_descent_block));
  made->springs = copy_table(m, &m->cells, sizeof(sbri_spring_cell));
  made->corners = copy_table(m, &m->solid_blocks, sizeof(sbri_tetrahedron_block));
  if (island->cells.damping) {
    made->damping = copy_table(m, &m->damping, sizeof(float));
    if (!made->damping) return false;
  }
  if (island->cells.slack) {
    made->slack = copy_table(m, &m->slack, sizeof(float));
    if (!made->slack) return false;
  }
  return made->blocks && made->springs && made->corners;
}

bool sbri_descent_make(sbr_model *model, sbri_island *island) {
  descent_maker m = {.model = model, .island = island};
  sbri_descent *made = sbfi_arena_allocate(&model->arena, 1, sizeof *made);
  if (!made) return false;
  sbfi_arena_init(&m.scratch, &model->arena.allocator, 0);
  sbfi_array_init(&m.blocks, &model->arena.allocator, sizeof(sbri_descent_block));
  sbfi_array_init(&m.cells, &model->arena.allocator, sizeof(sbri_spring_cell));
  sbfi_array_init(&m.damping, &model->arena.allocator, sizeof(float));
  sbfi_array_init(&m.slack, &model->arena.allocator, sizeof(float));
  sbfi_array_init(&m.solid_blocks, &model->arena.allocator, sizeof(sbri_tetrahedron_block));
  bool good = make(&m, made);
  sbfi_array_free(&m.solid_blocks);
  sbfi_array_free(&m.slack);
  sbfi_array_free(&m.damping);
  sbfi_array_free(&m.cells);
  sbfi_array_free(&m.blocks);
  sbfi_arena_free(&m.scratch);
  island->descent = made;
  return good;
}
