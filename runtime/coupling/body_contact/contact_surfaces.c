/* Contact surfaces of soft bodies, and the memory of all contacts. */
#include <string.h>

#include "coupling/body_contact/body_contacts.h"
#include "math/vec3.h"
#include "model/reach.h"
#include "sbfmt/mechanics.h"

/* ---- Making ---- */

static bool has_surface(const sbri_body *body) {
  return body->level && body->surface.skin.vertex_count > 0 && body->source->surface.polygon_sizes.count > 0;
}

static void add_triangles(const sbf_polygon_mesh *mesh, sbri_contact_surface *surface) {
  const uint32_t *corners = mesh->polygon_points.at;
  for (uint32_t p = 0; p < mesh->polygon_sizes.count; corners += mesh->polygon_sizes.at[p++])
    for (uint32_t k = 2; k < mesh->polygon_sizes.at[p]; k++) {
      const uint32_t c[3] = {corners[0], corners[k - 1], corners[k]};
      float all_simulated = INFINITY;
      for (int i = 0; i < 3; i++)
        all_simulated = fminf(all_simulated, surface->samples[c[i]].weights[0] != 0 ? 1.0f : 0.0f);
      if (!(all_simulated > 0)) continue; /* a corner follows frames, not points */
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

/* Shares the arrays that a tick renews with the surface of another detail level, or allocates them. */
static bool allocate_or_reuse(sbri_contact_surface *s, const sbri_contact_surface *other, uint32_t vertices,
    uint32_t triangles, sbfi_arena *arena) {
  if (!other) return sbri_contact_surface_allocate(s, vertices, triangles, arena);
  s->positions = other->positions, s->displacements = other->displacements, s->boxes = other->boxes;
  s->inside_parents = other->inside_parents;
  return sbri_contact_surface_allocate_tree(s, triangles, arena);
}

static void set_rest_positions(const sbr_model *model, uint32_t body, sbri_contact_surface *s) {
  for (uint32_t v = 0; v < s->vertex_count; v++) {
    s->positions[v] = sbri_sample_rest_position(model, body, &s->samples[v]);
    s->displacements[v] = sbri_vec3(0, 0, 0);
  }
}

/* `first`: surface of the first detail level, or NULL. */
static bool create(const sbr_model *model, const sbri_body *body, sbri_contact_surface *s,
    const sbri_contact_surface *first, sbfi_arena *arena) {
  const sbri_island *island = &model->islands[body->island];
  bool meshed = has_surface(body);
  uint32_t bare = body->slots.real_end - body->slots.begin;
  uint32_t vertices = meshed ? body->surface.skin.vertex_count : bare;
  uint32_t triangles = meshed ? count_triangles(&body->source->surface) : 0;
  s->samples = sbfi_arena_allocate(arena, (size_t)vertices + 1, sizeof *s->samples);
  s->triangles = sbfi_arena_allocate(arena, 3 * (size_t)triangles + 1, sizeof *s->triangles);
  if (!s->samples || !s->triangles ||
      !allocate_or_reuse(s, meshed ? first : NULL, vertices, triangles, arena))
    return false;
  s->vertex_count = vertices;
  for (uint32_t v = 0; v < vertices; v++) {
    uint32_t slot = body->slots.begin + v;
    s->samples[v] = meshed ? sbri_sample_of(island, &body->surface.skin, v)
                           : (sbri_sample){{slot, slot, slot, slot}, {1, 0, 0, 0}, 1, UINT32_MAX};
  }
  if (!meshed) return true;
  add_triangles(&body->source->surface, s);
  sbf_body_measures measures;
  sbf_body_measure(body->source, &measures);
  s->two_sided = measures.sheet || body->surface.rest_volume_m3 == 0;
  s->closed = !s->two_sided && sbri_contact_surface_is_closed(s);
  set_rest_positions(model, (uint32_t)(body - model->bodies), s);
  if (s->closed) sbri_contact_surface_measure(s);
  if ((s->two_sided || s->closed) && !sbri_surface_edges_create(s, arena)) return false;
  sbri_contact_surface_build_tree(s);
  return true;
}

/* Copies the relations of another character of the same model, if there is one. */
static void find_relations(sbr_world *world, uint32_t character, sbri_contact_surface *surfaces,
    sbri_contact_surface *hulls, uint8_t *relations, size_t count) {
  const sbri_body_contacts *all = world->body_contacts;
  const sbr_model *model = world->characters[character].model->detail.base;
  for (uint32_t i = 0; i < world->character_capacity; i++) {
    const sbr_model *other = world->characters[i].model;
    if (!other || other->detail.base != model || !all->shapes.surfaces[i]) continue;
    memcpy(relations, all->shapes.rest_relations[i], count);
    return;
  }
  memset(relations, 0, count);
  sbri_rest_overlaps_find(model, surfaces, hulls, relations);
}

static uint32_t count_soft_levels(const sbr_model *base) {
  uint32_t count = 0;
  while (count < base->detail.level_count && base->detail.definitions[count].kind == SBR_DETAIL_SOFT) count++;
  return count;
}

/* Surfaces of all soft detail levels; they share the arrays that a tick renews. */
static bool create_all(const sbr_model *base, sbri_contact_surface *surfaces, sbfi_arena *arena) {
  uint32_t count = base->asset->soft_bodies.count;
  for (uint32_t r = 0; r < count_soft_levels(base); r++)
    for (uint32_t b = 0; b < count; b++) {
      const sbri_body *body = &base->detail.levels[r]->bodies[b];
      const sbri_contact_surface *first = r > 0 && base->bodies[b].level ? &surfaces[b] : NULL;
      if (body->level &&
          !create(base->detail.levels[r], body, &surfaces[(size_t)r * count + b], first, arena))
        return false;
    }
  return true;
}

void sbri_contact_surfaces_select_level(sbr_world *world, uint32_t character) {
  sbri_body_contacts *all = world->body_contacts;
  const sbr_model *model = world->characters[character].model;
  if (!all || !model || !all->shapes.level_surfaces[character]) return;
  for (uint32_t r = 0; r < count_soft_levels(model->detail.base); r++)
    if (model->detail.base->detail.levels[r] == model)
      all->shapes.surfaces[character] =
          all->shapes.level_surfaces[character] + (size_t)r * model->asset->soft_bodies.count;
}

bool sbri_contact_surfaces_create(sbr_world *world, uint32_t character) {
  sbri_body_contacts *all = world->body_contacts;
  const sbr_model *model = world->characters[character].model;
  if (!all || all->shapes.surfaces[character]) return true;
  uint32_t count = model->asset->soft_bodies.count, levels = count_soft_levels(model->detail.base),
           rigid = model->rigid.body_count;
  size_t pairs = (size_t)count * count + (size_t)count * rigid;
  sbfi_arena *arena = &all->arenas[character];
  sbfi_arena_init(arena, &world->allocator, 0);
  sbri_contact_surface *surfaces = sbfi_arena_allocate(arena, (size_t)levels * count + 1, sizeof *surfaces);
  bool ok = surfaces && create_all(model->detail.base, surfaces, arena);
  sbri_contact_surface *hulls = ok ? sbfi_arena_allocate(arena, (size_t)rigid + 1, sizeof *hulls) : NULL;
  ok = hulls && sbri_contact_hulls_create(model, hulls, arena);
  uint8_t *relations = ok ? sbfi_arena_allocate(arena, pairs + 1, 1) : NULL;
  ok = relations != NULL;
  if (ok) find_relations(world, character, surfaces, hulls, relations, pairs);
  all->shapes.rest_relations[character] = relations, all->shapes.hulls[character] = hulls;
  if (!ok) {
    sbfi_arena_free(arena);
    return false;
  }
  all->shapes.surfaces[character] = all->shapes.level_surfaces[character] = surfaces;
  sbri_contact_surfaces_select_level(world, character);
  return true;
}

void sbri_contact_surfaces_free(sbr_world *world, uint32_t character) {
  sbri_body_contacts *all = world->body_contacts;
  if (!all || !all->shapes.surfaces[character]) return;
  sbfi_arena_free(&all->arenas[character]);
  all->shapes.surfaces[character] = all->shapes.level_surfaces[character] = NULL;
}

/* ---- Memory of all characters ---- */

static void free_bodies(sbr_world *world) {
  sbri_body_contacts *all = world->body_contacts;
  size_t capacity = all->broad_phase.body_capacity;
  sbfi_free(&world->allocator, all->broad_phase.bodies, capacity * sizeof *all->broad_phase.bodies);
  sbfi_free(&world->allocator, all->broad_phase.boxes, capacity * sizeof *all->broad_phase.boxes);
  sbfi_free(&world->allocator, all->solver_bodies,
      SBRI_SOLVER_BODIES_PER_BODY * capacity * sizeof *all->solver_bodies);
  sbfi_free(&world->allocator, all->broad_phase.tree.items, capacity * sizeof *all->broad_phase.tree.items);
  sbfi_free(&world->allocator, all->broad_phase.tree.nodes,
      sbri_bounds_tree_nodes(all->broad_phase.body_capacity) * sizeof *all->broad_phase.tree.nodes);
  all->broad_phase.bodies = NULL, all->broad_phase.boxes = NULL, all->solver_bodies = NULL,
  all->broad_phase.tree.items = NULL, all->broad_phase.tree.nodes = NULL;
  all->broad_phase.body_capacity = all->broad_phase.body_count = 0;
}

static uint32_t count_bodies(const sbr_model *model) {
  return model ? model->asset->soft_bodies.count + model->rigid.body_count : 0;
}

bool sbri_body_contacts_reserve(sbr_world *world, const sbr_model *model) {
  sbri_body_contacts *all = world->body_contacts;
  if (!all) return true;
  uint32_t needed = count_bodies(model);
  for (uint32_t i = 0; i < world->character_capacity; i++) needed += count_bodies(world->characters[i].model);
  if (needed <= all->broad_phase.body_capacity) return true;
  free_bodies(world);
  all->broad_phase.body_capacity = needed;
  all->broad_phase.bodies = sbfi_allocate(&world->allocator, needed * sizeof *all->broad_phase.bodies);
  all->broad_phase.boxes = sbfi_allocate(&world->allocator, needed * sizeof *all->broad_phase.boxes);
  all->solver_bodies = sbfi_allocate(
      &world->allocator, SBRI_SOLVER_BODIES_PER_BODY * (size_t)needed * sizeof *all->solver_bodies);
  all->broad_phase.tree.items =
      sbfi_allocate(&world->allocator, needed * sizeof *all->broad_phase.tree.items);
  all->broad_phase.tree.nodes =
      sbfi_allocate(&world->allocator, sbri_bounds_tree_nodes(needed) * sizeof *all->broad_phase.tree.nodes);
  if (all->broad_phase.bodies && all->broad_phase.boxes && all->solver_bodies &&
      all->broad_phase.tree.items && all->broad_phase.tree.nodes)
    return true;
  free_bodies(world);
  return false;
}

void sbri_body_contacts_free(sbr_world *world) {
  sbri_body_contacts *all = world->body_contacts;
  if (!all) return;
  const sbf_allocator *a = &world->allocator;
  size_t characters = all->character_capacity, contacts = all->contact_capacity;
  for (uint32_t i = 0; all->shapes.surfaces && i < characters; i++) sbri_contact_surfaces_free(world, i);
  free_bodies(world);
  sbfi_free(a, all->arenas, characters * sizeof *all->arenas);
  sbfi_free(a, all->shapes.surfaces, characters * sizeof *all->shapes.surfaces);
  sbfi_free(a, all->shapes.level_surfaces, characters * sizeof *all->shapes.level_surfaces);
  sbfi_free(a, all->shapes.hulls, characters * sizeof *all->shapes.hulls);
  sbfi_free(a, all->shapes.rest_relations, characters * sizeof *all->shapes.rest_relations);
  sbfi_free(a, all->group_of, characters * sizeof *all->group_of);
  sbfi_free(a, all->member_of, characters * sizeof *all->member_of);
  sbfi_free(a, all->next_of_group, characters * sizeof *all->next_of_group);
  sbfi_free(a, all->members, characters * sizeof *all->members);
  sbfi_free(a, all->groups, characters * sizeof *all->groups);
  sbfi_free(a, all->pairs, contacts * sizeof *all->pairs);
  sbfi_free(a, all->found_pairs, contacts * sizeof *all->found_pairs);
  sbfi_free(a, all->contacts, contacts * sizeof *all->contacts);
  sbfi_free(a, all->constraints, contacts * sizeof *all->constraints);
  sbfi_free(a, all->cache.at, contacts * sizeof *all->cache.at);
  sbfi_free(a, all->cache.next, contacts * sizeof *all->cache.next);
  sbfi_free(a, all->pair_reports.at, contacts * sizeof *all->pair_reports.at);
  sbfi_free(a, all->pair_reports.next, contacts * sizeof *all->pair_reports.next);
  sbfi_free(a, all->cache.table, all->cache.table_capacity * sizeof *all->cache.table);
  sbfi_free(a, all, sizeof *all);
  world->body_contacts = NULL;
}

/* ---- In a tick ---- */

static sbf_vec3 displacement_of(const sbri_group_member *m, const sbri_island *island, const sbri_sample *s) {
  const sbri_character *c = m->character;
  const float *velocities = sbri_velocities(c) + 3 * (size_t)island->first_slot;
  const sbri_point *from = sbri_positions(c) + island->first_slot, *to = sbri_targets(c) + island->first_slot;
  sbf_vec3 sum = {0, 0, 0};
  for (int k = 0; k < 4; k++) {
    uint32_t slot = s->slots[k];
    const float *v = velocities + 3 * (slot / SBRI_BLOCK * SBRI_BLOCK) + slot % SBRI_BLOCK;
    sbf_vec3 displacement =
        slot < island->free_count
            ? sbri_scale(sbri_vec3(v[0], v[SBRI_BLOCK], v[2 * SBRI_BLOCK]), m->tick_s)
            : sbri_vec3(to[slot].x - from[slot].x, to[slot].y - from[slot].y, to[slot].z - from[slot].z);
    sum = sbri_add_scaled(sum, displacement, s->weights[k]);
  }
  return sbri_scale(sum, m->scale);
}

void sbri_contact_surface_update(sbr_world *world, const sbri_group_member *m, uint32_t soft_body) {
  const sbri_character *c = m->character;
  const sbri_body *body = &c->model->bodies[soft_body];
  const sbri_island *island = &c->model->islands[body->island];
  sbri_contact_surface *s = &world->body_contacts->shapes.surfaces[c - world->characters][soft_body];
  const sbri_point *points = sbri_positions(c) + island->first_slot;
  if (island->splits && s->triangle_count) {
    sbri_island now = sbri_island_now(c, island);
    sbri_skin skin = sbri_skin_now(c, &body->surface.skin);
    for (uint32_t v = 0; v < s->vertex_count; v++) s->samples[v] = sbri_sample_of(&now, &skin, v);
  }
  for (uint32_t v = 0; v < s->vertex_count; v++) {
    const sbri_sample *sample = &s->samples[v];
    sbf_vec3 x = {0, 0, 0};
    for (int k = 0; k < 4; k++) {
      const sbri_point *p = &points[sample->slots[k]];
      x = sbri_add_scaled(x, sbri_vec3(p->x, p->y, p->z), sample->weights[k]);
    }
    s->positions[v] = sbri_add_scaled(m->offset, x, m->scale);
    s->displacements[v] = displacement_of(m, island, sample);
  }
  s->max_displacement_m =
      sbri_fastest_of(body, sbri_velocities(c) + 3 * (size_t)island->first_slot) * m->tick_s * m->scale;
  if (s->two_sided && s->triangle_count) sbri_surface_edges_update(s);
  const sbf_collision *rule = &body->source->collision;
  float reach = m->scale * fmaxf(rule->outer_thickness, rule->inner_thickness);
  sbri_contact_surface_refit_tree(s, reach);
}
