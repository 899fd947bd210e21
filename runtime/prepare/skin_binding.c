/* Attaches each skin vertex to points of the bodies that it is embedded in, else to bones. */
#include <string.h>

#include "model/level_mesh.h"
#include "prepare/prepare.h"

typedef struct weighted_slot {
  uint32_t vertex, slot;
  float weight;
} weighted_slot;

typedef struct skin_binder {
  sbr_model *model;
  sbri_skin *skin;
  uint32_t source_count;       /* vertices of the mesh */
  const uint32_t *position_of; /* (source_count) index in the skin, UINT32_MAX: not in it; NULL: the same */
  sbfi_arena scratch;
  sbfi_array weighted_slots; /* point and weight */
  sbfi_array bindings;       /* sbri_binding; `cell` is the first of four points until cells are assigned */
  sbfi_array pieces;         /* piece */
  bool shared;               /* the present embedding has vertices with several points */
} skin_binder;

static uint32_t position_of(const skin_binder *c, uint32_t vertex) {
  return c->position_of ? c->position_of[vertex] : vertex;
}

static bool add_weighted_slot(
    skin_binder *c, const sbri_body *body, uint32_t vertex, uint32_t point, float weight) {
  if (weight == 0) return true;
  uint32_t slot = c->model->islands[body->island].first_slot + body->slots.from_point[point];
  return sbfi_array_append(&c->weighted_slots, &(weighted_slot){vertex, slot, weight}, 1);
}

static bool is_among(uint32_t point, const uint32_t points[4]) {
  return point == points[0] || point == points[1] || point == points[2] || point == points[3];
}

/* A tetrahedron with all the points as corners, index in its island; UINT32_MAX: none, or fully pinned. A
 * point may occur several times. */
static uint32_t find_tetrahedron(const sbr_model *model, const sbri_body *body, const uint32_t points[4]) {
  const sbri_island *island = &model->islands[body->island];
  for (uint32_t i = 0; i < 4; i++) {
    uint32_t slot = body->slots.from_point[points[i]];
    if (slot >= island->free_count) continue;
    for (uint32_t at = island->tetrahedra.tears->around_begins[slot];
         at < island->tetrahedra.tears->around_begins[slot + 1]; at++) {
      const uint32_t *corners =
          body->level->lattice.tetrahedra
              .at[island->tetrahedra.tears->around[at] - body->elements.first_tetrahedron]
              .at;
      uint32_t found = 0;
      for (int k = 0; k < 4; k++) found += is_among(points[k], corners);
      if (found == 4) return island->tetrahedra.tears->around[at];
    }
  }
  return UINT32_MAX;
}

/* Whether a vertex is embedded in several points of a network that may tear. */
static bool bind_to_network(skin_binder *c, const sbri_body *body, uint32_t vertex, const uint32_t points[4],
    const float weights[4], bool *bound) {
  const sbri_island *island = &c->model->islands[body->island];
  if (!c->shared) return true;
  sbri_binding binding = {vertex, (uint32_t)c->weighted_slots.count, body->island, UINT32_MAX};
  if (!sbfi_array_append(&c->bindings, &binding, 1)) return false;
  for (int k = 0; k < 4; k++) {
    weighted_slot one = {vertex, island->first_slot + body->slots.from_point[points[k]], weights[k]};
    if (!sbfi_array_append(&c->weighted_slots, &one, 1)) return false;
  }
  *bound = true;
  return true;
}

/* Corners of a tetrahedron that may tear, all four in its own order; `bound` is false if there is none. */
static bool bind_vertex(skin_binder *c, const sbri_body *body, uint32_t vertex, const uint32_t points[4],
    const float weights[4], bool *bound) {
  *bound = false;
  if (c->model->islands[body->island].springs.tear && sbri_body_frays(body))
    return bind_to_network(c, body, vertex, points, weights, bound);
  if (!sbri_body_tears(body)) return true;
  uint32_t found = find_tetrahedron(c->model, body, points);
  if (found == UINT32_MAX) return true;
  const sbri_island *island = &c->model->islands[body->island];
  const uint32_t *corners = body->level->lattice.tetrahedra.at[found - body->elements.first_tetrahedron].at;
  sbri_binding binding = {vertex, (uint32_t)c->weighted_slots.count, body->island, found};
  if (!sbfi_array_append(&c->bindings, &binding, 1)) return false;
  for (int k = 0; k < 4; k++) {
    weighted_slot one = {vertex, island->first_slot + body->slots.from_point[corners[k]], 0};
    for (int i = 0; i < 4; i++) one.weight += points[i] == corners[k] ? weights[i] : 0;
    if (!sbfi_array_append(&c->weighted_slots, &one, 1)) return false;
  }
  *bound = true;
  return true;
}

static bool add_embedding(skin_binder *c, const sbri_body *body, const sbf_embedding *embedding) {
  c->shared = false;
  for (uint32_t i = 0; i < embedding->points.count && !c->shared; i++) {
    const sbf_vec4 *w = &embedding->weights.at[i];
    c->shared = (w->x != 0) + (w->y != 0) + (w->z != 0) + (w->w != 0) > 1;
  }
  for (uint32_t i = 0; i < embedding->points.count; i++) {
    uint32_t vertex = embedding->vertices.count ? embedding->vertices.at[i] : i;
    if (vertex >= c->source_count || position_of(c, vertex) == UINT32_MAX) continue;
    const sbf_vec4 *w = &embedding->weights.at[i];
    float weights[4] = {w->x, w->y, w->z, w->w};
    float blend = embedding->blends.count ? embedding->blends.at[i] : 1;
    bool bound;
    for (int k = 0; k < 4; k++) weights[k] *= blend;
    if (!bind_vertex(c, body, position_of(c, vertex), embedding->points.at[i].at, weights, &bound))
      return false;
    for (int k = 0; k < 4 && !bound; k++)
      if (!add_weighted_slot(c, body, position_of(c, vertex), embedding->points.at[i].at[k], weights[k]))
        return false;
  }
  return true;
}

/* `indices` has the cell of each point. */
static bool store_bindings(skin_binder *c, const uint32_t *indices) {
  sbri_skin *skin = c->skin;
  uint32_t count = (uint32_t)c->bindings.count;
  if (count == 0) return true;
  sbri_binding *bindings = sbfi_arena_allocate(&c->model->arena, count, sizeof *bindings);
  uint32_t *binding_of = sbfi_arena_allocate(&c->model->arena, skin->vertex_count, sizeof *binding_of);
  if (!bindings || !binding_of) return false;
  memcpy(bindings, c->bindings.at, count * sizeof *bindings);
  memset(binding_of, 0xff, skin->vertex_count * sizeof *binding_of);
  for (uint32_t i = count; i-- > 0;) {
    bindings[i].cell = indices[bindings[i].cell];
    binding_of[bindings[i].vertex] = i;
  }
  skin->bindings = bindings, skin->binding_of = binding_of, skin->binding_count = count;
  skin->first_binding = c->model->counts.bindings, c->model->counts.bindings += count;
  skin->first_cell = c->model->counts.skin_cells, c->model->counts.skin_cells += skin->cell_count;
  return true;
}

/* Normalises weights whose sum is not 1, as in hand-painted maps. */
static bool fill_cells(skin_binder *c, uint32_t *counts) {
  sbri_skin *skin = c->skin;
  const weighted_slot *weighted_slots = c->weighted_slots.at;
  uint32_t block_count = (skin->vertex_count + SBRI_BLOCK - 1) / SBRI_BLOCK;
  uint32_t *begins = sbfi_arena_allocate(&c->model->arena, (size_t)block_count + 1, sizeof *begins);
  float *sums = sbfi_arena_allocate(&c->scratch, skin->vertex_count, sizeof *sums);
  if (!begins || !sums) return false;
  for (size_t i = 0; i < c->weighted_slots.count; i++) {
    counts[weighted_slots[i].vertex]++;
    sums[weighted_slots[i].vertex] += weighted_slots[i].weight;
  }
  for (uint32_t block = 0; block < block_count; block++) {
    uint32_t max = 0;
    for (uint32_t v = block * SBRI_BLOCK; v < (block + 1) * SBRI_BLOCK && v < skin->vertex_count; v++)
      max = counts[v] > max ? counts[v] : max;
    begins[block + 1] = begins[block] + max;
  }
  size_t cell_count = begins[block_count];
  sbri_volume_cell *cells = sbfi_arena_allocate(&c->model->arena, cell_count ? cell_count : 1, sizeof *cells);
  uint32_t *used = sbfi_arena_allocate(&c->scratch, skin->vertex_count, sizeof *used);
  uint32_t *indices = sbfi_arena_allocate(&c->scratch, c->weighted_slots.count + 1, sizeof *indices);
  if (!cells || !used || !indices) return false;
  for (size_t i = 0; i < c->weighted_slots.count; i++) {
    uint32_t vertex = weighted_slots[i].vertex;
    indices[i] = begins[vertex / SBRI_BLOCK] + used[vertex]++;
    sbri_volume_cell *cell = &cells[indices[i]];
    float sum = sums[vertex];
    cell->slots[vertex % SBRI_BLOCK] = weighted_slots[i].slot;
    cell->weights[vertex % SBRI_BLOCK] = fabsf(sum - 1) < 1e-5f || fabsf(sum) < 1e-6f
                                             ? weighted_slots[i].weight
                                             : weighted_slots[i].weight / sum;
  }
  skin->cell_begins = begins;
  skin->cells = cells;
  skin->cell_count = (uint32_t)cell_count;
  return store_bindings(c, indices);
}

/* Attaches a vertex rigidly to a body, for detail levels without soft bodies. */
typedef struct piece {
  uint32_t vertex, frame;
  float weight;
} piece;

static bool add_piece(skin_binder *c, uint32_t vertex, uint32_t frame, float weight) {
  return weight == 0 || sbfi_array_append(&c->pieces, &(piece){vertex, frame, weight}, 1);
}

/* Adds the drivers of a point of the first detail level. */
static bool add_drivers(
    skin_binder *c, const sbri_body *body, uint32_t vertex, uint32_t point, float weight) {
  const sbri_island *island = &c->model->detail.base->islands[body->island];
  uint32_t slot = body->slots.from_point[point];
  if (slot >= island->free_count)
    return add_piece(c, vertex, island->pins.frames[slot - island->free_count], weight);
  if (!body->drivers) return add_piece(c, vertex, body->driver_frame, weight);
  const sbri_driver *driver = &body->drivers[slot - body->slots.begin];
  for (int k = 0; k < SBRI_DRIVERS; k++)
    if (!add_piece(c, vertex, driver->frames[k], weight * driver->weights[k])) return false;
  return true;
}

/* Frames of the vertices if bodies follow their drivers without inertia, or jiggle. */
static bool add_pieces(
    skin_binder *c, const sbri_body *body, uint32_t frame, const sbf_embedding *embedding) {
  for (uint32_t i = 0; i < embedding->points.count; i++) {
    uint32_t vertex = embedding->vertices.count ? embedding->vertices.at[i] : i;
    float blend = embedding->blends.count ? embedding->blends.at[i] : 1;
    const sbf_vec4 *w = &embedding->weights.at[i];
    const float weights[4] = {w->x, w->y, w->z, w->w};
    if (vertex >= c->source_count) continue;
    if (frame != UINT32_MAX && !add_piece(c, vertex, frame, blend)) return false;
    for (int k = 0; k < 4 && frame == UINT32_MAX; k++)
      if (!add_drivers(c, body, vertex, embedding->points.at[i].at[k], weights[k] * blend)) return false;
  }
  return true;
}

static bool add_all_pieces(skin_binder *c, uint32_t render_mesh) {
  const sbr_model *model = c->model;
  for (uint32_t b = 0; model->detail.kind != SBR_DETAIL_SOFT && b < model->asset->soft_bodies.count; b++) {
    const sbri_body *body = &model->detail.base->bodies[b];
    uint32_t frame = UINT32_MAX;
    for (uint32_t j = 0; j < model->jiggle_count; j++)
      if (model->jiggles[j].body == b) frame = sbri_first_jiggle_frame(model) + j;
    for (uint32_t e = 0; body->level && e < body->level->embeddings.count; e++)
      if (body->level->embeddings.at[e].render_mesh == (int32_t)render_mesh &&
          !add_pieces(c, body, frame, &body->level->embeddings.at[e]))
        return false;
  }
  return true;
}

/* Sorts pieces by vertices: first piece of each vertex. */
static bool sort_pieces(skin_binder *c, const uint32_t **begins, const piece **sorted) {
  const piece *pieces = c->pieces.at;
  uint32_t *starts = sbfi_arena_allocate(&c->scratch, (size_t)c->source_count + 2, sizeof *starts);
  piece *to = sbfi_arena_allocate(&c->scratch, c->pieces.count + 1, sizeof *to);
  if (!starts || !to) return false;
  for (size_t i = 0; i < c->pieces.count; i++) starts[pieces[i].vertex + 2]++;
  for (uint32_t v = 0; v < c->source_count; v++) starts[v + 2] += starts[v + 1];
  for (size_t i = 0; i < c->pieces.count; i++) to[starts[pieces[i].vertex + 1]++] = pieces[i];
  *begins = starts, *sorted = to; /* each now marks the beginning of the next */
  return true;
}

/* One influence per frame, with sum 1; returns the end index. */
static uint32_t join_pieces(const piece *pieces, uint32_t count, sbri_influence *to, uint32_t begin) {
  uint32_t end = begin;
  float sum = 0;
  for (uint32_t i = 0; i < count; i++) {
    uint32_t at = begin;
    while (at < end && to[at].frame != pieces[i].frame) at++;
    if (at == end) to[end++] = (sbri_influence){pieces[i].frame, 0};
    to[at].weight += pieces[i].weight;
    sum += pieces[i].weight;
  }
  if (!(sum > 1e-6f)) return begin;
  for (uint32_t i = begin; i < end; i++) to[i].weight /= sum;
  return end;
}

/* Vertices without a body: they follow pieces, else the skin's weights, else `frame`. */
static bool fill_frames(
    skin_binder *c, const uint32_t *counts, const sbf_vec3 *rest, const sbf_skin *weights, uint32_t frame) {
  sbri_skin *skin = c->skin;
  const uint32_t *begins;
  const piece *pieces;
  uint32_t vertex_count = 0, influence_count = (uint32_t)c->pieces.count, first = 0;
  if (!sort_pieces(c, &begins, &pieces)) return false;
  for (uint32_t v = 0; v < c->source_count; v++) {
    if (position_of(c, v) == UINT32_MAX || counts[position_of(c, v)]) continue;
    vertex_count++;
    influence_count += weights && weights->influence_counts.at[v] ? weights->influence_counts.at[v] : 1;
  }
  if (vertex_count == 0) return true;
  sbri_frame_vertex *vertices = sbfi_arena_allocate(&c->model->arena, vertex_count, sizeof *vertices);
  sbri_influence *influences = sbfi_arena_allocate(&c->model->arena, influence_count, sizeof *influences);
  if (!vertices || !influences) return false;
  uint32_t next = 0;
  for (uint32_t v = 0, index = 0; v < c->source_count; v++) {
    uint32_t count = weights ? weights->influence_counts.at[v] : 0, to_slot = position_of(c, v);
    if (to_slot != UINT32_MAX && !counts[to_slot]) {
      sbri_frame_vertex *to = &vertices[index++];
      uint32_t from = next;
      next = join_pieces(pieces + begins[v], begins[v + 1] - begins[v], influences, next);
      bool has_pieces = next > from;
      float sum = 0;
      for (uint32_t i = 0; i < count && !has_pieces; i++) sum += weights->weights.at[first + i];
      for (uint32_t i = 0; i < count && !has_pieces; i++)
        influences[next++] = (sbri_influence){weights->bones.at[first + i],
            sum > 1e-6f ? weights->weights.at[first + i] / sum : 1 / (float)count};
      if (next == from) influences[next++] = (sbri_influence){frame, 1};
      *to = (sbri_frame_vertex){to_slot, from, next - from, rest[v]};
    }
    first += count;
  }
  skin->frame_vertices = vertices;
  skin->frame_vertex_count = vertex_count;
  skin->influences = influences;
  return true;
}

static bool finish(skin_binder *c, const sbf_vec3 *rest, const sbf_skin *weights, int32_t bone, bool good) {
  uint32_t *counts = NULL;
  if (good && c->skin->vertex_count) {
    counts = sbfi_arena_allocate(&c->scratch, c->skin->vertex_count, sizeof *counts);
    uint32_t frame = bone >= 0 ? (uint32_t)bone : sbri_root_frame(c->model);
    good = counts && fill_cells(c, counts) && fill_frames(c, counts, rest, weights, frame);
  }
  sbfi_array_free(&c->pieces);
  sbfi_array_free(&c->bindings);
  sbfi_array_free(&c->weighted_slots);
  sbfi_arena_free(&c->scratch);
  return good;
}

static skin_binder begin(sbr_model *model, sbri_skin *skin, uint32_t vertex_count) {
  skin_binder c = {.model = model, .skin = skin, .source_count = vertex_count};
  sbfi_arena_init(&c.scratch, &model->arena.allocator, 0);
  sbfi_array_init(&c.weighted_slots, &model->arena.allocator, sizeof(weighted_slot));
  sbfi_array_init(&c.bindings, &model->arena.allocator, sizeof(sbri_binding));
  sbfi_array_init(&c.pieces, &model->arena.allocator, sizeof(piece));
  skin->vertex_count = vertex_count;
  return c;
}

static bool add_embeddings(skin_binder *c, uint32_t render_mesh) {
  const sbr_model *model = c->model;
  bool good = true;
  for (uint32_t b = 0; b < model->asset->soft_bodies.count; b++) {
    const sbf_level *level = model->bodies[b].level;
    for (uint32_t e = 0; good && level && e < level->embeddings.count; e++)
      if (level->embeddings.at[e].render_mesh == (int32_t)render_mesh)
        good = add_embedding(c, &model->bodies[b], &level->embeddings.at[e]);
  }
  return good;
}

/* Faces and normals, which all detail levels share. */
static bool shade(sbr_model *model, sbri_skin *skin, const sbf_render_mesh *shown, uint32_t render_mesh,
    uint32_t render_level) {
  if (model->detail.base == model) return sbri_shading_make(skin, &shown->mesh, shown, &model->arena);
  const sbri_skin *made = sbri_skin_of(model->detail.base, render_mesh, render_level);
  skin->face_block_count = made->face_block_count, skin->faces = made->faces;
  skin->normals = made->normals;
  skin->tangents = made->tangents;
  return true;
}

bool sbri_skin_make(sbr_model *model, uint32_t render_mesh, uint32_t render_level) {
  const sbf_render_mesh *mesh = &model->asset->render_meshes.at[render_mesh];
  sbri_skin *skin = &model->skins.at[model->skins.first[render_mesh] + render_level];
  skin_binder c = begin(model, skin, mesh->mesh.positions.count);
  sbf_render_mesh shown = *mesh;
  bool good = true;
  if (render_level > 0) {
    sbfi_level_mesh level;
    good = sbfi_level_mesh_make(&level, mesh, &mesh->levels.at[render_level - 1], &c.scratch);
    if (good)
      skin->vertices =
          sbfi_arena_copy(&model->arena, level.vertices, level.vertex_count + 1u, sizeof *level.vertices);
    good = good && skin->vertices;
    shown = level.mesh;
    skin->vertex_count = level.vertex_count;
    c.position_of = level.position_of;
  }
  skin->first_polygon = model->counts.polygons;
  good = good && add_embeddings(&c, render_mesh) && add_all_pieces(&c, render_mesh) &&
         shade(model, skin, &shown, render_mesh, render_level);
  if (c.bindings.count) model->counts.polygons += shown.mesh.polygon_sizes.count;
  const sbf_render_level *level = render_level ? &mesh->levels.at[render_level - 1] : NULL;
  return finish(&c, mesh->mesh.positions.at, mesh->skin, mesh->bone, good) &&
         sbri_torn_sides_make(model, skin, sbri_skin_of(model, render_mesh, 0),
             level ? &level->polygon_sizes : &mesh->mesh.polygon_sizes,
             level ? &level->polygon_points : &mesh->mesh.polygon_points);
}

/* Without an embedding of its own surface, a level's points begin with those of the surface. */
static bool add_surface_points(skin_binder *c, const sbri_body *body) {
  const sbf_u32_list *new_from_old = &body->level->new_from_old;
  for (uint32_t i = 0; i < c->skin->vertex_count; i++) {
    uint32_t point = i < new_from_old->count ? new_from_old->at[i] : i;
    if (point < body->level->positions.count && !add_weighted_slot(c, body, i, point, 1)) return false;
  }
  return true;
}

bool sbri_surface_make(sbr_model *model, uint32_t soft_body) {
  sbri_body *body = &model->bodies[soft_body];
  const sbf_polygon_mesh *mesh = &body->source->surface;
  skin_binder c = begin(model, &body->surface.skin, mesh->positions.count);
  bool good = true, embedded = false;
  for (uint32_t e = 0; good && body->level && e < body->level->embeddings.count; e++)
    if (body->level->embeddings.at[e].render_mesh < 0) {
      good = add_embedding(&c, body, &body->level->embeddings.at[e]);
      embedded = true;
    }
  if (good && body->level && !embedded) good = add_surface_points(&c, body);
  return finish(&c, mesh->positions.at, NULL, body->source->bone, good) &&
         sbri_faces_make(&body->surface.skin, mesh, &model->arena);
}
