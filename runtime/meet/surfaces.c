/* What soft bodies meet others with, and the memory for it. */
#include <string.h>

#include "math/vec3.h"
#include "meet/meetings.h"
#include "model/reach.h"
#include "sbfmt/mechanics.h"

/* ---- Making ---- */

static bool has_surface(const sbri_body *body) {
  return body->level && body->surface.vertex_count > 0 && body->source->surface.polygon_sizes.count > 0;
}

static void add_triangles(const sbf_polygon_mesh *mesh, sbri_meet_surface *surface) {
  const uint32_t *corners = mesh->polygon_points.at;
  for (uint32_t p = 0; p < mesh->polygon_sizes.count; corners += mesh->polygon_sizes.at[p++])
    for (uint32_t k = 2; k < mesh->polygon_sizes.at[p]; k++) {
      const uint32_t c[3] = {corners[0], corners[k - 1], corners[k]};
      float least = INFINITY;
      for (int i = 0; i < 3; i++) least = fminf(least, surface->samples[c[i]].weights[0] != 0 ? 1.0f : 0.0f);
      if (!(least > 0)) continue; /* some corner follows frames, not points */
      uint32_t *to = surface->triangles + 3 * (size_t)surface->triangle_count++;
      to[0] = c[0], to[1] = c[1], to[2] = c[2];
    }
}

static uint32_t count_triangles(const sbf_polygon_mesh *mesh) {
  uint32_t count = 0;
  for (uint32_t p = 0; p < mesh->polygon_sizes.count; p++)
    count += mesh->polygon_sizes.at[p] > 2 ? mesh->polygon_sizes.at[p] - 2 : 0;
  return count;
}

/* What is of a tick alone: as the body's surface on another rung has it, or its own. */
static bool make_room(sbri_meet_surface *s, const sbri_meet_surface *other, uint32_t vertices,
    uint32_t triangles, sbfi_arena *arena) {
  if (!other) return sbri_meet_surface_room(s, vertices, triangles, arena);
  s->places = other->places, s->ways = other->ways, s->boxes = other->boxes, s->tree = other->tree;
  s->inside = other->inside;
  return true;
}

/* As it is at rest. */
static void measure(const sbr_model *model, uint32_t body, sbri_meet_surface *s) {
  for (uint32_t v = 0; v < s->vertex_count; v++) s->places[v] = sbri_meet_rest(model, body, &s->samples[v]);
  sbri_meet_surface_measure(s);
}

/* `first`: that of the first rung, or NULL. */
static bool make(const sbr_model *model, const sbri_body *body, sbri_meet_surface *s,
    const sbri_meet_surface *first, sbfi_arena *arena) {
  const sbri_island *island = &model->islands[body->island];
  bool meshed = has_surface(body);
  uint32_t bare = body->slot_real_end - body->slot_begin;
  uint32_t vertices = meshed ? body->surface.vertex_count : bare;
  uint32_t triangles = meshed ? count_triangles(&body->source->surface) : 0;
  s->samples = sbfi_arena_allocate(arena, (size_t)vertices + 1, sizeof *s->samples);
  s->triangles = sbfi_arena_allocate(arena, 3 * (size_t)triangles + 1, sizeof *s->triangles);
  if (!s->samples || !s->triangles || !make_room(s, meshed ? first : NULL, vertices, triangles, arena))
    return false;
  s->vertex_count = vertices;
  for (uint32_t v = 0; v < vertices; v++) {
    uint32_t slot = body->slot_begin + v;
    s->samples[v] = meshed ? sbri_sample_of(island, &body->surface, v)
                           : (sbri_sample){{slot, slot, slot, slot}, {1, 0, 0, 0}, 1, UINT32_MAX};
  }
  if (!meshed) return true;
  add_triangles(&body->source->surface, s);
  sbf_body_measures measures;
  sbf_body_measure(body->source, &measures);
  s->two_sided = measures.sheet || body->rest_volume_m3 == 0;
  s->closed = !s->two_sided && sbri_meet_is_closed(s);
  if (s->closed) measure(model, (uint32_t)(body - model->bodies), s);
  return (!s->two_sided && !s->closed) || sbri_meet_rims_make(s, arena);
}

/* As of another of the same model, if there is one. */
static void note_together(sbr_world *world, uint32_t character, sbri_meet_surface *surfaces,
    sbri_meet_surface *hulls, uint8_t *together, size_t count) {
  const sbri_meetings *all = world->meetings;
  const sbr_model *model = world->characters[character].model->base;
  for (uint32_t i = 0; i < world->character_capacity; i++) {
    const sbr_model *other = world->characters[i].model;
    if (!other || other->base != model || !all->surfaces[i]) continue;
    memcpy(together, all->together[i], count);
    return;
  }
  memset(together, 0, count);
  sbri_meet_rest_look(model, surfaces, hulls, together);
}

static uint32_t soft_rungs_of(const sbr_model *base) {
  uint32_t count = 0;
  while (count < base->rung_count && base->ladder[count].kind == SBR_RUNG_SOFT) count++;
  return count;
}

/* Of all soft rungs, whose points others are; what a tick makes of them they share. */
static bool make_all(const sbr_model *base, sbri_meet_surface *surfaces, sbfi_arena *arena) {
  uint32_t count = base->asset->soft_bodies.count;
  for (uint32_t r = 0; r < soft_rungs_of(base); r++)
    for (uint32_t b = 0; b < count; b++) {
      const sbri_body *body = &base->rungs[r]->bodies[b];
      const sbri_meet_surface *first = r > 0 && base->bodies[b].level ? &surfaces[b] : NULL;
      if (body->level && !make(base->rungs[r], body, &surfaces[(size_t)r * count + b], first, arena))
        return false;
    }
  return true;
}

void sbri_meet_surfaces_choose(sbr_world *world, uint32_t character) {
  sbri_meetings *all = world->meetings;
  const sbr_model *model = world->characters[character].model;
  if (!all || !model || !all->all_surfaces[character]) return;
  for (uint32_t r = 0; r < soft_rungs_of(model->base); r++)
    if (model->base->rungs[r] == model)
      all->surfaces[character] = all->all_surfaces[character] + (size_t)r * model->asset->soft_bodies.count;
}

bool sbri_meet_surfaces_make(sbr_world *world, uint32_t character) {
  sbri_meetings *all = world->meetings;
  const sbr_model *model = world->characters[character].model;
  if (!all || all->surfaces[character]) return true;
  uint32_t count = model->asset->soft_bodies.count, rungs = soft_rungs_of(model->base),
           rigid = model->rigid.body_count;
  size_t pairs = (size_t)count * count + (size_t)count * rigid;
  sbfi_arena *arena = &all->arenas[character];
  sbfi_arena_init(arena, &world->allocator, 0);
  sbri_meet_surface *surfaces = sbfi_arena_allocate(arena, (size_t)rungs * count + 1, sizeof *surfaces);
  bool good = surfaces && make_all(model->base, surfaces, arena);
  sbri_meet_surface *hulls = good ? sbfi_arena_allocate(arena, (size_t)rigid + 1, sizeof *hulls) : NULL;
  good = hulls && sbri_meet_hulls_make(model, hulls, arena);
  uint8_t *together = good ? sbfi_arena_allocate(arena, pairs + 1, 1) : NULL;
  good = together != NULL;
  if (good) note_together(world, character, surfaces, hulls, together, pairs);
  all->together[character] = together, all->hulls[character] = hulls;
  if (!good) {
    sbfi_arena_free(arena);
    return false;
  }
  all->surfaces[character] = all->all_surfaces[character] = surfaces;
  sbri_meet_surfaces_choose(world, character);
  return true;
}

void sbri_meet_surfaces_free(sbr_world *world, uint32_t character) {
  sbri_meetings *all = world->meetings;
  if (!all || !all->surfaces[character]) return;
  sbfi_arena_free(&all->arenas[character]);
  all->surfaces[character] = all->all_surfaces[character] = NULL;
}

/* ---- Memory of all ---- */

static void free_meeters(sbr_world *world) {
  sbri_meetings *all = world->meetings;
  size_t capacity = all->meeter_capacity;
  sbfi_free(&world->allocator, all->meeters, capacity * sizeof *all->meeters);
  sbfi_free(&world->allocator, all->boxes, capacity * sizeof *all->boxes);
  sbfi_free(&world->allocator, all->movers, SBRI_MOVERS_OF_BODY * capacity * sizeof *all->movers);
  sbfi_free(&world->allocator, all->tree.items, capacity * sizeof *all->tree.items);
  sbfi_free(&world->allocator, all->tree.nodes,
      sbri_bounds_tree_nodes(all->meeter_capacity) * sizeof *all->tree.nodes);
  all->meeters = NULL, all->boxes = NULL, all->movers = NULL, all->tree.items = NULL, all->tree.nodes = NULL;
  all->meeter_capacity = all->meeter_count = 0;
}

static uint32_t bodies_of(const sbr_model *model) {
  return model ? model->asset->soft_bodies.count + model->rigid.body_count : 0;
}

bool sbri_meetings_reserve(sbr_world *world, const sbr_model *model) {
  sbri_meetings *all = world->meetings;
  if (!all) return true;
  uint32_t needed = bodies_of(model);
  for (uint32_t i = 0; i < world->character_capacity; i++) needed += bodies_of(world->characters[i].model);
  if (needed <= all->meeter_capacity) return true;
  free_meeters(world);
  all->meeter_capacity = needed;
  all->meeters = sbfi_allocate(&world->allocator, needed * sizeof *all->meeters);
  all->boxes = sbfi_allocate(&world->allocator, needed * sizeof *all->boxes);
  all->movers = sbfi_allocate(&world->allocator, SBRI_MOVERS_OF_BODY * (size_t)needed * sizeof *all->movers);
  all->tree.items = sbfi_allocate(&world->allocator, needed * sizeof *all->tree.items);
  all->tree.nodes =
      sbfi_allocate(&world->allocator, sbri_bounds_tree_nodes(needed) * sizeof *all->tree.nodes);
  if (all->meeters && all->boxes && all->movers && all->tree.items && all->tree.nodes) return true;
  free_meeters(world);
  return false;
}

void sbri_meetings_free(sbr_world *world) {
  sbri_meetings *all = world->meetings;
  if (!all) return;
  const sbf_allocator *a = &world->allocator;
  size_t characters = all->character_capacity, touches = all->touch_capacity;
  for (uint32_t i = 0; all->surfaces && i < characters; i++) sbri_meet_surfaces_free(world, i);
  free_meeters(world);
  sbfi_free(a, all->arenas, characters * sizeof *all->arenas);
  sbfi_free(a, all->surfaces, characters * sizeof *all->surfaces);
  sbfi_free(a, all->all_surfaces, characters * sizeof *all->all_surfaces);
  sbfi_free(a, all->hulls, characters * sizeof *all->hulls);
  sbfi_free(a, all->together, characters * sizeof *all->together);
  sbfi_free(a, all->group_of, characters * sizeof *all->group_of);
  sbfi_free(a, all->member_of, characters * sizeof *all->member_of);
  sbfi_free(a, all->next_of_group, characters * sizeof *all->next_of_group);
  sbfi_free(a, all->members, characters * sizeof *all->members);
  sbfi_free(a, all->groups, characters * sizeof *all->groups);
  sbfi_free(a, all->pairs, touches * sizeof *all->pairs);
  sbfi_free(a, all->found_pairs, touches * sizeof *all->found_pairs);
  sbfi_free(a, all->touches, touches * sizeof *all->touches);
  sbfi_free(a, all->rows, touches * sizeof *all->rows);
  sbfi_free(a, all->memories, touches * sizeof *all->memories);
  sbfi_free(a, all->next_memories, touches * sizeof *all->next_memories);
  sbfi_free(a, all->contacts, touches * sizeof *all->contacts);
  sbfi_free(a, all->next_contacts, touches * sizeof *all->next_contacts);
  sbfi_free(a, all->found_memories, all->found_capacity * sizeof *all->found_memories);
  sbfi_free(a, all, sizeof *all);
  world->meetings = NULL;
}

/* ---- In a tick ---- */

static sbf_vec3 way_of(const sbri_meet_member *m, const sbri_island *island, const sbri_sample *s) {
  const sbri_character *c = m->character;
  const float *velocities = sbri_velocities(c) + 3 * (size_t)island->first_slot;
  const sbri_point *from = sbri_positions(c) + island->first_slot, *to = sbri_targets(c) + island->first_slot;
  sbf_vec3 sum = {0, 0, 0};
  for (int k = 0; k < 4; k++) {
    uint32_t slot = s->slots[k];
    const float *v = velocities + 3 * (slot / SBRI_BLOCK * SBRI_BLOCK) + slot % SBRI_BLOCK;
    sbf_vec3 way =
        slot < island->free_count
            ? sbri_scale(sbri_vec3(v[0], v[SBRI_BLOCK], v[2 * SBRI_BLOCK]), m->tick_s)
            : sbri_vec3(to[slot].x - from[slot].x, to[slot].y - from[slot].y, to[slot].z - from[slot].z);
    sum = sbri_add_scaled(sum, way, s->weights[k]);
  }
  return sbri_scale(sum, m->scale);
}

void sbri_meet_surface_place(sbr_world *world, const sbri_meet_member *m, uint32_t soft_body) {
  const sbri_character *c = m->character;
  const sbri_body *body = &c->model->bodies[soft_body];
  const sbri_island *island = &c->model->islands[body->island];
  sbri_meet_surface *s = &world->meetings->surfaces[c - world->characters][soft_body];
  const sbri_point *points = sbri_positions(c) + island->first_slot;
  if (island->splits && s->triangle_count) {
    sbri_island now = sbri_island_now(c, island);
    sbri_skin skin = sbri_skin_now(c, &body->surface);
    for (uint32_t v = 0; v < s->vertex_count; v++) s->samples[v] = sbri_sample_of(&now, &skin, v);
  }
  for (uint32_t v = 0; v < s->vertex_count; v++) {
    const sbri_sample *sample = &s->samples[v];
    sbf_vec3 x = {0, 0, 0};
    for (int k = 0; k < 4; k++) {
      const sbri_point *p = &points[sample->slots[k]];
      x = sbri_add_scaled(x, sbri_vec3(p->x, p->y, p->z), sample->weights[k]);
    }
    s->places[v] = sbri_add_scaled(m->offset, x, m->scale);
    s->ways[v] = way_of(m, island, sample);
  }
  s->fastest_m =
      sbri_fastest_of(body, sbri_velocities(c) + 3 * (size_t)island->first_slot) * m->tick_s * m->scale;
  if (s->two_sided && s->triangle_count) sbri_meet_rims_look(s);
  const sbf_collision *rule = &body->source->collision;
  float reach = m->scale * fmaxf(rule->outer_thickness, rule->inner_thickness);
  sbri_meet_tree_make(s, reach);
}
