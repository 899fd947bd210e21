/* Skins of networks that tear.
 *
 * A vertex is embedded in up to four points. If a tear separates them, the vertex follows the side with the
 * greater weight. Points of the other side are replaced by their copies on this side; the remaining weight
 * goes to this side's own points, with the rest position extrapolated from theirs. Two points are separated
 * if they were within three springs of each other at rest and are not any more.
 */
#include "soft/tear/torn_network.h"

#include "math/vec3.h"

enum { MAX_SPRING_DISTANCE = 3, POINTS = 4 };

void sbri_torn_network_begin(sbri_torn_network *t, sbri_character *c, uint32_t index) {
  const sbri_island *made = &c->model->islands[index];
  t->c = c, t->island = sbri_island_now(c, made);
  t->whole = (sbri_network){&t->island, sbri_strengths(c) + made->links.first_flow};
  t->rest = (sbri_network){made, NULL};
  t->origins = sbri_origins(c) + made->first_slot;
  t->seen = sbri_owners(c) + made->first_slot; /* all SBRI_UNUSED between queries */
  t->queue = t->seen + c->model->slot_count;
}

/* Whether few enough springs connect the two. */
static bool is_near(const sbri_torn_network *t, const sbri_network *network, uint32_t from, uint32_t to) {
  uint32_t end = 1, step_end = 1;
  bool found = from == to;
  t->queue[0] = from, t->seen[from] = 0;
  for (uint32_t next = 0, steps = 0; next < end && steps < MAX_SPRING_DISTANCE && !found; steps++) {
    for (; next < step_end && !found; next++)
      for (sbri_network_end e = {0}; !found && sbri_network_next(network, t->queue[next], &e);) {
        found = e.other == to;
        if (t->seen[e.other] == SBRI_UNUSED) t->seen[e.other] = 0, t->queue[end++] = e.other;
      }
    step_end = end;
  }
  for (uint32_t i = 0; i < end; i++) t->seen[t->queue[i]] = SBRI_UNUSED;
  return found;
}

/* Searches from the free end, since pinned points list no springs. */
static bool is_joined(const sbri_torn_network *t, const sbri_network *network, uint32_t a, uint32_t b) {
  return a < t->island.free_count ? is_near(t, network, a, b) : is_near(t, network, b, a);
}
static bool is_separated(const sbri_torn_network *t, uint32_t a, uint32_t b) {
  return !is_joined(t, &t->whole, a, b) && is_joined(t, &t->rest, t->origins[a], t->origins[b]);
}

/* ---- Sides ---- */

/* The points of a vertex, as slots of the island. */
typedef struct embedding {
  uint32_t slots[POINTS];
  float weights[POINTS];
} embedding;

static embedding read_embedding(const sbri_volume_cell *cells, uint32_t lane, uint32_t first_slot) {
  embedding is;
  for (uint32_t k = 0; k < POINTS; k++)
    is.slots[k] = cells[k].slots[lane] - first_slot, is.weights[k] = cells[k].weights[lane];
  return is;
}

static uint32_t heaviest_of(const embedding *is) {
  uint32_t heavy = 0;
  for (uint32_t k = 1; k < POINTS; k++)
    if (is->weights[k] > is->weights[heavy]) heavy = k;
  return heavy;
}

/* The copy of a point, or the point itself, that is connected to `from`; SBRI_UNUSED: none. */
static uint32_t connected_copy(const sbri_torn_network *t, uint32_t from, uint32_t slot) {
  if (!is_separated(t, from, slot)) return slot;
  for (uint32_t b = 0; b < t->island.body_count; b++) {
    const sbri_body *body = &t->c->model->bodies[t->island.bodies[b]];
    if (t->origins[slot] < body->slots.begin || t->origins[slot] >= body->slots.real_end) continue;
    if (is_joined(t, &t->whole, from, t->origins[slot])) return t->origins[slot];
    for (uint32_t spare = body->slots.first_spare;
         spare < body->slots.real_end && t->origins[spare] != SBRI_UNUSED; spare++)
      if (t->origins[spare] == t->origins[slot] && is_joined(t, &t->whole, from, spare)) return spare;
  }
  return SBRI_UNUSED;
}

/* The point on the side with the largest weight. */
static uint32_t choose_side(const sbri_torn_network *t, const embedding *is) {
  uint32_t best = 0;
  float max = -1;
  for (uint32_t k = 0; k < POINTS; k++) {
    float sum = 0;
    for (uint32_t l = 0; l < POINTS; l++)
      if (is->weights[l] > 0 && connected_copy(t, is->slots[k], is->slots[l]) != SBRI_UNUSED)
        sum += is->weights[l];
    if (is->weights[k] > 0 && sum > max + 1e-4f) best = k, max = sum;
  }
  return best;
}

/* ---- Weights ---- */

static sbf_vec3 rest_of(const sbri_torn_network *t, uint32_t slot) {
  const sbri_point *p = &t->rest.island->rest[t->origins[slot]];
  return sbri_vec3(p->x, p->y, p->z);
}

/* Rest position of the vertex, from its original points. */
static sbf_vec3 rest_position(const sbri_torn_network *t, const embedding *made) {
  sbf_vec3 sum = {0, 0, 0};
  float all = 0;
  for (uint32_t k = 0; k < POINTS; k++)
    sum = sbri_add_scaled(sum, rest_of(t, made->slots[k]), made->weights[k]), all += made->weights[k];
  return sbri_scale(sum, 1 / all);
}

/* The smallest weights with sum 1 by which `count` points approximate the position: with M = B' B + e and B
 * the offsets of the points, in proportion to M^-1 1. */
static void find_weights(const sbf_vec3 *offsets, uint32_t count, double *weights) {
  double m[POINTS][POINTS], size = 0, sum = 0;
  for (uint32_t i = 0; i < count; i++) size += (double)sbri_dot(offsets[i], offsets[i]);
  for (uint32_t i = 0; i < count; i++) {
    for (uint32_t j = 0; j < count; j++) m[i][j] = (double)sbri_dot(offsets[i], offsets[j]);
    m[i][i] += 1e-4 * size + 1e-30, weights[i] = 1;
  }
  for (uint32_t i = 0; i < count; i++) /* symmetric positive definite: no pivoting */
    for (uint32_t row = i + 1; row < count; row++) {
      double fraction = m[row][i] / m[i][i];
      for (uint32_t j = i; j < count; j++) m[row][j] -= fraction * m[i][j];
      weights[row] -= fraction * weights[i];
    }
  for (uint32_t i = count; i-- > 0;) {
    for (uint32_t j = i + 1; j < count; j++) weights[i] -= m[i][j] * weights[j];
    weights[i] /= m[i][i], sum += weights[i];
  }
  for (uint32_t i = 0; i < count; i++) weights[i] /= sum;
}

static bool has(const embedding *is, uint32_t count, uint32_t slot) {
  for (uint32_t k = 0; k < count; k++)
    if (is->slots[k] == slot) return true;
  return false;
}

/* Moves the vertex to one side: its remaining points, then other points of the side. */
static void move_to_side(const sbri_torn_network *t, embedding *is, uint32_t side, const embedding *made) {
  embedding next = {{0}, {0}};
  double weights[POINTS];
  sbf_vec3 offsets[POINTS], position = rest_position(t, made);
  uint32_t count = 0, from = is->slots[side];
  float all = 0;
  for (uint32_t k = 0; k < POINTS; k++) {
    uint32_t slot = is->weights[k] != 0 ? connected_copy(t, from, is->slots[k]) : SBRI_UNUSED;
    all += is->weights[k];
    if (slot != SBRI_UNUSED && !has(&next, count, slot)) next.slots[count++] = slot;
  }
  for (sbri_network_end e = {0}; count < POINTS && sbri_network_next(&t->whole, from, &e);)
    if (!has(&next, count, e.other)) next.slots[count++] = e.other;
  for (uint32_t k = 0; k < count; k++) offsets[k] = sbri_sub(rest_of(t, next.slots[k]), position);
  find_weights(offsets, count, weights);
  for (uint32_t k = 0; k < count; k++) next.weights[k] = all * (float)weights[k];
  for (uint32_t k = count; k < POINTS; k++) next.slots[k] = from;
  *is = next;
}

/* ---- Updates after the tears of a tick ---- */

bool sbri_network_vertex_follow(const sbri_torn_network *t, const sbri_skin *skin, uint32_t binding) {
  const sbri_binding *bound = &skin->bindings[binding];
  uint32_t lane = bound->vertex % SBRI_BLOCK, first = t->island.first_slot;
  sbri_volume_cell *cells = sbri_skin_cells(t->c) + skin->first_cell + bound->cell;
  const uint8_t *torn_ends = sbri_torn_ends(t->c) + first;
  embedding is = read_embedding(cells, lane, first),
            made = read_embedding(skin->cells + bound->cell, lane, first);
  bool near = false, parted = false, lost = false;
  for (uint32_t k = 0; k < POINTS; k++) near = near || torn_ends[is.slots[k]];
  if (!near) return false;
  for (uint32_t k = 0; k < POINTS; k++)
    for (uint32_t l = 0; l < k; l++)
      parted =
          parted || (is.weights[k] != 0 && is.weights[l] != 0 && is_separated(t, is.slots[k], is.slots[l]));
  if (!parted) return true;
  uint32_t side = choose_side(t, &is);
  embedding copies = is;
  for (uint32_t k = 0; k < POINTS; k++) {
    if (is.weights[k] != 0) copies.slots[k] = connected_copy(t, is.slots[side], is.slots[k]);
    lost = lost || copies.slots[k] == SBRI_UNUSED;
  }
  if (lost)
    move_to_side(t, &is, side, &made);
  else
    is = copies;
  for (uint32_t k = 0; k < POINTS; k++)
    cells[k].slots[lane] = first + is.slots[k], cells[k].weights[lane] = is.weights[k];
  return true;
}

bool sbri_network_vertices_part(
    const sbri_torn_network *t, const sbri_skin *skin, uint32_t binding_a, uint32_t binding_b) {
  uint32_t slots[2];
  for (int i = 0; i < 2; i++) {
    const sbri_binding *bound = &skin->bindings[i ? binding_b : binding_a];
    embedding is = read_embedding(sbri_skin_cells(t->c) + skin->first_cell + bound->cell,
        bound->vertex % SBRI_BLOCK, t->island.first_slot);
    slots[i] = is.slots[heaviest_of(&is)];
  }
  return is_separated(t, slots[0], slots[1]);
}
