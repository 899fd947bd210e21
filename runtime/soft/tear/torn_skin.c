/* Skins of lattices and networks that tear.
 *
 * A vertex follows its tetrahedron. If that has torn, the vertex follows an intact tetrahedron at its corner
 * with the largest weight, extrapolated from the rest shape; without one it stays with the torn corners. A
 * polygon is hidden once the tetrahedra of two neighbouring corners, connected by few faces at rest, have
 * lost that connection. For networks soft/tear/torn_network.c decides both. For cloth, whose vertices are
 * points, a polygon is hidden once a spring along one of its edges has torn. */
#include <string.h>

#include "mechanics/neo_hookean.h"
#include "soft/tear/tear.h"
#include "soft/tear/torn_network.h"

/* Maximum number of faces between the tetrahedra of two neighbouring corners. */
enum { MAX_SIDES = 6 };

static void repair(sbri_character *c, const sbri_skin *skin) {
  if (!skin->binding_count) return;
  memcpy(sbri_skin_cells(c) + skin->first_cell, skin->cells, skin->cell_count * sizeof *skin->cells);
  for (uint32_t i = 0; i < skin->binding_count; i++)
    sbri_bound_to(c)[skin->first_binding + i] = skin->bindings[i].tetrahedron;
}

void sbri_restore_skins(sbri_character *c) {
  const sbr_model *model = c->model;
  for (uint32_t i = 0; i < model->skins.count; i++) repair(c, &model->skins.at[i]);
  for (uint32_t i = 0; i < model->asset->soft_bodies.count; i++) repair(c, &model->bodies[i].surface.skin);
  memset(sbri_torn_polygons(c), 0, model->counts.polygons * sizeof(uint32_t));
}

/* ---- Vertices ---- */

typedef struct tearing {
  sbri_character *c;
  const sbri_island *island;
  const uint32_t *torn;
  const sbri_tetrahedron_block *blocks;
  uint32_t index;
  const sbri_torn_network *network; /* NULL: no springs tear */
} tearing;

static uint32_t corner(const tearing *t, uint32_t element, uint32_t k) {
  uint32_t at = t->island->tetrahedra.lanes[2 * element];
  return t->blocks[at / SBRI_BLOCK].corners[k][at % SBRI_BLOCK];
}

static bool has_corner(const tearing *t, uint32_t element, uint32_t slot) {
  for (uint32_t k = 0; k < 4; k++)
    if (corner(t, element, k) == slot) return true;
  return false;
}

/* An intact tetrahedron with that slot as a corner, preferably a neighbour; SBRI_UNUSED: none. */
static uint32_t find_whole(const tearing *t, uint32_t element, uint32_t slot) {
  const sbri_tear_table *table = t->island->tetrahedra.tears;
  for (uint32_t k = 0; k < 4; k++) {
    uint32_t other = table->neighbours[element][k];
    if (other != UINT32_MAX && !t->torn[other] && has_corner(t, other, slot)) return other;
  }
  if (slot >= t->island->free_count) return SBRI_UNUSED;
  uint32_t origin = sbri_origins(t->c)[t->island->first_slot + slot];
  for (uint32_t i = table->around_begins[origin]; i < table->around_begins[origin + 1]; i++)
    if (!t->torn[table->around[i]] && has_corner(t, table->around[i], slot)) return table->around[i];
  return SBRI_UNUSED;
}

static const sbri_body *body_of(const tearing *t, uint32_t element) {
  uint32_t b = 0;
  const sbri_body *bodies = t->c->model->bodies;
  while (element - bodies[t->island->bodies[b]].elements.first_tetrahedron >=
         bodies[t->island->bodies[b]].elements.tetrahedron_count)
    b++;
  return &bodies[t->island->bodies[b]];
}

static sbfi_d3 rest_corner(const tearing *t, uint32_t element, uint32_t k) {
  const sbri_body *body = body_of(t, element);
  uint32_t point = body->level->lattice.tetrahedra.at[element - body->elements.first_tetrahedron].at[k];
  return sbfi_d3_of(body->level->positions.at[point]);
}

/* Weights of the same rest position in another tetrahedron. */
static void move_weights(
    const tearing *t, sbri_volume_cell *cells, uint32_t lane, uint32_t from, uint32_t to) {
  const sbri_body *body = body_of(t, to);
  sbfi_tetrahedron element;
  sbfi_d3 position = {0, 0, 0}, weights = {0, 0, 0};
  float sum = 0;
  if (!sbri_body_tetrahedron(body, to - body->elements.first_tetrahedron, &element)) return;
  for (uint32_t k = 0; k < 4; k++) sum += cells[k].weights[lane];
  if (!(sum > 0)) return;
  for (uint32_t k = 0; k < 4; k++)
    position = sbfi_d3_add(position, sbfi_d3_scale(rest_corner(t, from, k), cells[k].weights[lane] / sum));
  sbfi_d3 offset = sbfi_d3_sub(position, rest_corner(t, to, 0));
  weights.x = sbfi_d3_dot(element.gradients[1], offset),
  weights.y = sbfi_d3_dot(element.gradients[2], offset);
  weights.z = sbfi_d3_dot(element.gradients[3], offset);
  cells[0].weights[lane] = sum * (float)(1 - weights.x - weights.y - weights.z);
  cells[1].weights[lane] = sum * (float)weights.x;
  cells[2].weights[lane] = sum * (float)weights.y;
  cells[3].weights[lane] = sum * (float)weights.z;
}

/* Returns whether its embedding has changed. */
static bool follow(const tearing *t, const sbri_skin *skin, uint32_t i) {
  const sbri_binding *binding = &skin->bindings[i];
  uint32_t *bound = &sbri_bound_to(t->c)[skin->first_binding + i], lane = binding->vertex % SBRI_BLOCK,
           heavy = 0;
  if (binding->tetrahedron == UINT32_MAX) return sbri_network_vertex_follow(t->network, skin, i);
  sbri_volume_cell *cells = sbri_skin_cells(t->c) + skin->first_cell + binding->cell;
  bool changed = false;
  if (t->torn[*bound]) {
    for (uint32_t k = 1; k < 4; k++)
      if (cells[k].weights[lane] > cells[heavy].weights[lane]) heavy = k;
    uint32_t whole = find_whole(t, *bound, corner(t, *bound, heavy));
    if (whole != SBRI_UNUSED) move_weights(t, cells, lane, *bound, whole), *bound = whole;
    changed = t->torn[*bound] == SBRI_TORN_NOW || whole != SBRI_UNUSED;
  }
  for (uint32_t k = 0; k < 4; k++) {
    uint32_t slot = t->island->first_slot + corner(t, *bound, k);
    changed = changed || cells[k].slots[lane] != slot;
    cells[k].slots[lane] = slot;
  }
  return changed;
}

/* ---- Polygons ---- */

/* Whether few faces connect one to the other: through intact tetrahedra, or at rest through all. */
static bool is_joined(const tearing *t, uint32_t from, uint32_t to, bool at_rest) {
  uint32_t *stamps = sbri_visits(t->c) + t->island->tetrahedra.first_state,
           *queue = sbri_queue(t->c) + t->island->tetrahedra.first_state;
  uint32_t *steps = stamps + t->c->model->counts.state_tetrahedra, end = 1;
  if (from == to) return true;
  bool found = false;
  queue[0] = from, stamps[from] = 1, steps[from] = 0;
  for (uint32_t next = 0; next < end && !found; next++)
    for (uint32_t k = 0; k < 4 && steps[queue[next]] < MAX_SIDES; k++) {
      uint32_t other = t->island->tetrahedra.tears->neighbours[queue[next]][k];
      if (other == UINT32_MAX || stamps[other] || (!at_rest && t->torn[other])) continue;
      stamps[other] = 1, steps[other] = steps[queue[next]] + 1;
      queue[end++] = other;
      found = found || other == to;
    }
  for (uint32_t i = 0; i < end; i++) stamps[queue[i]] = 0;
  return found;
}

/* The tetrahedron of the vertex, at rest or now; SBRI_UNUSED: none of this island. */
static uint32_t tetrahedron_of(const tearing *t, const sbri_skin *skin, uint32_t vertex, bool at_rest) {
  uint32_t i = skin->binding_of[vertex];
  if (i == UINT32_MAX || skin->bindings[i].island != t->index) return SBRI_UNUSED;
  return at_rest ? skin->bindings[i].tetrahedron : sbri_bound_to(t->c)[skin->first_binding + i];
}

/* The binding of a vertex to this island's springs; UINT32_MAX: none. */
static uint32_t spring_binding(const tearing *t, const sbri_skin *skin, uint32_t vertex) {
  uint32_t i = skin->binding_of[vertex];
  bool is =
      i != UINT32_MAX && skin->bindings[i].island == t->index && skin->bindings[i].tetrahedron == UINT32_MAX;
  return is ? i : UINT32_MAX;
}
static bool spans_springs(const tearing *t, const sbri_skin *skin, uint32_t a, uint32_t b) {
  uint32_t from = spring_binding(t, skin, a), to = spring_binding(t, skin, b);
  return from != UINT32_MAX && to != UINT32_MAX && sbri_network_vertices_part(t->network, skin, from, to);
}

static bool is_torn(const tearing *t, const sbri_skin *skin, const uint32_t *points, uint32_t size) {
  for (uint32_t i = 0; i < size; i++) {
    uint32_t a = points[i], b = points[(i + 1) % size];
    if (spans_springs(t, skin, a, b)) return true;
    uint32_t from = tetrahedron_of(t, skin, a, false), to = tetrahedron_of(t, skin, b, false);
    if (from == SBRI_UNUSED || to == SBRI_UNUSED || is_joined(t, from, to, false)) continue;
    if (is_joined(t, tetrahedron_of(t, skin, a, true), tetrahedron_of(t, skin, b, true), true)) return true;
  }
  return false;
}

static void follow_vertices(const tearing *t, const sbri_skin *skin) {
  uint8_t *touched = sbri_touched(t->c) + skin->first_binding;
  for (uint32_t i = 0; i < skin->binding_count; i++)
    touched[i] = skin->bindings[i].island == t->index && follow(t, skin, i);
  /* Older tears may have opened further, so vertices that already follow another tetrahedron are checked too.
   */
  for (uint32_t i = 0; i < skin->binding_count; i++) {
    const sbri_binding *binding = &skin->bindings[i];
    const sbri_volume_cell *now = sbri_skin_cells(t->c) + skin->first_cell + binding->cell,
                           *made = skin->cells + binding->cell;
    for (uint32_t k = 0; k < 4 && !touched[i]; k++)
      touched[i] = now[k].slots[binding->vertex % SBRI_BLOCK] != made[k].slots[binding->vertex % SBRI_BLOCK];
  }
}

/* Polygons of the mesh or of a render level, which uses the mesh's vertices: `skin` is the mesh's. */
static void open_polygons(const tearing *t, const sbri_skin *skin, const sbf_u32_list *sizes,
    const uint32_t *points, uint32_t *torn) {
  const uint8_t *touched = sbri_touched(t->c) + skin->first_binding;
  for (uint32_t p = 0; p < sizes->count; points += sizes->at[p++]) {
    bool near = false;
    for (uint32_t i = 0; i < sizes->at[p]; i++)
      near = near || (skin->binding_of[points[i]] != UINT32_MAX && touched[skin->binding_of[points[i]]]);
    if (near && !torn[p] && is_torn(t, skin, points, sizes->at[p])) torn[p] = SBRI_POLYGON_TORN;
  }
}

static void follow_mesh(const tearing *t, uint32_t render_mesh) {
  const sbr_model *model = t->c->model;
  const sbf_render_mesh *mesh = &model->asset->render_meshes.at[render_mesh];
  const sbri_skin *full = sbri_skin_of(model, render_mesh, 0);
  for (uint32_t level = 0; full->binding_count && level <= mesh->levels.count; level++) {
    const sbri_skin *skin = sbri_skin_of(model, render_mesh, level);
    const sbf_u32_list *sizes = level ? &mesh->levels.at[level - 1].polygon_sizes : &mesh->mesh.polygon_sizes;
    const sbf_u32_list *points =
        level ? &mesh->levels.at[level - 1].polygon_points : &mesh->mesh.polygon_points;
    if (!skin->binding_count) continue;
    follow_vertices(t, skin);
    open_polygons(t, full, sizes, points->at, sbri_torn_polygons(t->c) + skin->first_polygon);
  }
}

void sbri_skins_follow(sbri_character *c, uint32_t index) {
  const sbr_model *model = c->model;
  const sbri_island *island = &model->islands[index];
  sbri_torn_network network;
  if (island->springs.tear) sbri_torn_network_begin(&network, c, index);
  tearing t = {c, island, sbri_torn(c) + island->tetrahedra.first_state,
      sbri_solids(c) + island->tetrahedra.first_state_block, index, island->springs.tear ? &network : NULL};
  for (uint32_t i = 0; i < model->asset->render_meshes.count; i++) follow_mesh(&t, i);
  for (uint32_t b = 0; b < island->body_count; b++) {
    const sbri_skin *surface = &model->bodies[island->bodies[b]].surface.skin;
    if (surface->binding_count) follow_vertices(&t, surface);
  }
  uint32_t *torn = sbri_torn(c) + island->tetrahedra.first_state;
  for (uint32_t e = 0; island->tetrahedra.tears && e < island->tetrahedra.count; e++)
    if (torn[e]) torn[e] = SBRI_TORN_BEFORE;
}
