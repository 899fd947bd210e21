/* Narrow phase: soft vertices against triangles and hulls, hull corners against triangles, hulls against
 * hulls (hull_contacts.c), edges against edges (edge_contacts.c).
 *
 * Parts of one character that overlap at rest do not collide. Parts that are near at rest keep at most their
 * rest distance. */
#include "coupling/body_contact/narrow_phase.h"
#include "base/assert.h"
#include "model/reach.h"
#include "shapes/shape.h"
#include "shapes/surface_query.h"

/* A sheet's normal within this cosine of a corner's outward direction: the corner has passed through the
 * sheet. */
static const float PASSED_THROUGH_COSINE = 0.3f;
/* Behind a face by more than this fraction of the inner thickness: deep contact. */
static const float DEEP_FRACTION = 0.25f;

static sbri_pair_body pair_body_of(const sbri_narrow_phase *f, uint32_t number) {
  const sbri_contact_body *body = &f->world->body_contacts->broad_phase.bodies[number];
  sbri_pair_body p = {.body = body, .member = f->world->body_contacts->member_of[body->character]};
  p.owner = &f->members[p.member];
  const sbr_model *model = p.owner->character->model;
  if (body->rigid) {
    p.rigid = &model->rigid.bodies[body->body_index];
    p.surface = &f->world->body_contacts->shapes.hulls[body->character][body->body_index];
    p.friction = p.rigid->source->friction, p.restitution = p.rigid->source->restitution;
  } else {
    p.soft = &model->bodies[body->body_index];
    p.surface = &f->world->body_contacts->shapes.surfaces[body->character][body->body_index];
    p.friction = p.soft->contact.friction, p.restitution = p.soft->contact.restitution;
  }
  return p;
}

/* ---- Soft with soft ---- */

static sbri_surface_rule rule_of(const sbri_pair_body *p) {
  const sbf_collision *rule = &p->soft->source->collision;
  return (sbri_surface_rule){rule->outer_thickness * p->owner->scale, rule->inner_thickness * p->owner->scale,
      p->surface->two_sided};
}

static sbri_surface_face face_of(const sbri_pair_body *p, uint32_t triangle) {
  sbri_surface_face face;
  for (int k = 0; k < 3; k++) {
    uint32_t v = p->surface->triangles[3 * (size_t)triangle + (uint32_t)k];
    face.at[k] = p->surface->positions[v], face.directions[k] = p->surface->displacements[v];
  }
  return face;
}

/* A search for triangles of `b` near points of `a`. It extends beyond the margin: a resting contact would
 * otherwise be lost every other tick, and the body would sink. */
typedef struct face_search {
  const sbri_pair_body *b;
  sbri_surface_rule rule;
  float margin, distance; /* m; beyond a point's displacement */
} face_search;

static face_search face_search_of(const sbri_pair_body *a, const sbri_pair_body *b) {
  face_search search = {.b = b, .rule = rule_of(b), .margin = sbri_pair_margin(a, b)};
  float distance = sbri_pair_search_distance(search.margin, b);
  if (a->soft && search.margin > 0 && distance > search.rule.outer)
    search.rule.outer = search.distance = distance;
  return search;
}

static sbri_box search_box(const face_search *search, sbf_vec3 x, sbf_vec3 displacement) {
  sbri_box box = sbri_box_with(sbri_box_of_point(x), sbri_add(x, displacement));
  return sbri_box_grown(box, search->distance);
}

/* Finds the most urgent triangle for a moving point. */
static bool find_face(const face_search *search, sbf_vec3 x, sbf_vec3 displacement, sbri_surface_hit *best) {
  const sbri_pair_body *b = search->b;
  sbri_box box = search_box(search, x, displacement);
  sbri_bounds_walk walk;
  uint32_t triangle;
  *best = sbri_surface_nothing();
  sbri_bounds_walk_begin(&walk, &b->surface->tree, box);
  while (sbri_bounds_walk_next(&walk, &triangle)) {
    if (!sbri_boxes_overlap(&box, &b->surface->boxes[triangle])) continue;
    sbri_surface_face face = face_of(b, triangle);
    sbri_surface_query(&search->rule, x, displacement, &face, triangle, best);
  }
  return sbri_surface_found(best);
}

/* Deep contacts are resolved except between parts of a character that overlap at rest. */
static bool may_resolve_deep(
    const sbri_narrow_phase *f, const sbri_pair_body *soft, const sbri_pair_body *other) {
  if (!sbri_are_same_character(soft, other)) return true;
  const sbr_model *model = soft->owner->character->model;
  size_t softs = model->asset->soft_bodies.count, i = soft->body->body_index, k = other->body->body_index;
  const uint8_t *relations = f->world->body_contacts->shapes.rest_relations[soft->body->character];
  return relations[other->rigid ? softs * softs + i * model->rigid.body_count + k : i * softs + k] ==
         SBRI_REST_SEPARATE;
}

static void find_face_contacts(
    const sbri_narrow_phase *f, const sbri_pair_body *a, const sbri_pair_body *b, bool resolves_deep) {
  sbri_surface_rule rule = rule_of(b);
  const face_search search = face_search_of(a, b);
  const float full_weight = 1;
  for (uint32_t v = 0; v < a->surface->vertex_count; v++) {
    sbri_surface_hit best;
    sbf_vec3 x = a->surface->positions[v], displacement = a->surface->displacements[v];
    sbri_box box = search_box(&search, x, displacement);
    if (!(a->surface->samples[v].mass_kg > 0) || !b->surface->triangle_count ||
        !sbri_boxes_overlap(&box, &b->surface->tree.nodes[0].box))
      continue;
    bool deep = !find_face(&search, x, displacement, &best);
    if (deep && (!resolves_deep || !sbri_find_nearest_exit(b, x, &best))) continue;
    const uint32_t *corners = b->surface->triangles + 3 * (size_t)best.face;
    float margin = search.margin;
    if (sbri_are_same_character(a, b) && !deep) {
      const sbf_vec3 p[3] = {sbri_pair_body_rest_position(b, corners[0]),
          sbri_pair_body_rest_position(b, corners[1]), sbri_pair_body_rest_position(b, corners[2])};
      float rest = sbri_surface_gap(&rule, sbri_pair_body_rest_position(a, v), p);
      if (rest <= SBRI_REST_CONTACT_FRACTION * a->soft->rest_size_m * a->owner->scale) continue;
      margin = SBRI_REST_DISTANCE_FACTOR * rest < margin ? SBRI_REST_DISTANCE_FACTOR * rest : margin;
    }
    sbri_contact t = {.feature = v,
        .a = sbri_soft_contact_side(a, &v, &full_weight, 1),
        .b = sbri_soft_contact_side(b, corners, best.weights, 3),
        .normal = best.normal,
        .margin = margin,
        .is_deep = deep || (best.behind && best.urgency - 1 > DEEP_FRACTION * rule.inner),
        .exits_nearest = deep};
    sbri_narrow_phase_add(f, a, b, &t);
  }
}

/* ---- Itself ---- */

static bool distribute_points(const sbri_sample *a, const sbri_sample *b) {
  for (int i = 0; i < 4; i++)
    for (int k = 0; k < 4; k++)
      if (a->weights[i] != 0 && b->weights[k] != 0 && a->slots[i] == b->slots[k]) return true;
  return false;
}

/* Excludes faces with shared points and faces that touch the vertex at rest. */
static bool may_collide_with_face(
    const sbri_pair_body *p, const sbri_surface_rule *rule, uint32_t v, uint32_t triangle) {
  const uint32_t *corners = p->surface->triangles + 3 * (size_t)triangle;
  sbf_vec3 rest[3];
  for (int k = 0; k < 3; k++) {
    if (corners[k] == v || distribute_points(&p->surface->samples[v], &p->surface->samples[corners[k]]))
      return false;
    rest[k] = sbri_pair_body_rest_position(p, corners[k]);
  }
  return sbri_surface_gap(rule, sbri_pair_body_rest_position(p, v), rest) >
         SBRI_REST_CONTACT_FRACTION * p->soft->rest_size_m * p->owner->scale;
}

static bool find_own_face(const sbri_pair_body *p, uint32_t v, sbri_surface_hit *best) {
  sbri_surface_rule rule = rule_of(p);
  sbf_vec3 x = p->surface->positions[v], displacement = p->surface->displacements[v];
  sbri_box box = sbri_box_with(sbri_box_of_point(x), sbri_add(x, displacement));
  sbri_bounds_walk walk;
  uint32_t triangle;
  *best = sbri_surface_nothing();
  sbri_bounds_walk_begin(&walk, &p->surface->tree, box);
  while (sbri_bounds_walk_next(&walk, &triangle)) {
    if (!sbri_boxes_overlap(&box, &p->surface->boxes[triangle]) ||
        !may_collide_with_face(p, &rule, v, triangle))
      continue;
    sbri_surface_face face = face_of(p, triangle);
    sbri_surface_query(&rule, x, displacement, &face, triangle, best);
  }
  return sbri_surface_found(best);
}

/* Self-contact of an embedded surface. Surfaces of simulated points are handled by the soft body itself. */
static void find_self_contacts(const sbri_narrow_phase *f, const sbri_pair_body *p) {
  const float full_weight = 1;
  for (uint32_t v = 0; v < p->surface->vertex_count; v++) {
    sbri_surface_hit best;
    if (!(p->surface->samples[v].mass_kg > 0) || !find_own_face(p, v, &best)) continue;
    sbri_contact t = {.feature = v,
        .a = sbri_soft_contact_side(p, &v, &full_weight, 1),
        .b = sbri_soft_contact_side(p, p->surface->triangles + 3 * (size_t)best.face, best.weights, 3),
        .normal = best.normal,
        .margin = sbri_pair_margin(p, p)};
    sbri_narrow_phase_add(f, p, p, &t);
  }
}

/* ---- Rigid ---- */

static sbf_vec3 to_world(const sbr_transform *frame, sbf_vec3 local, float scale) {
  return sbri_add_scaled(frame->position, sbri_rotate(frame->rotation, local), scale);
}

static void find_hull_vertex_contacts(
    const sbri_narrow_phase *f, const sbri_pair_body *soft, const sbri_pair_body *rigid) {
  sbr_transform source = sbri_pair_body_frame(rigid, false), to = sbri_pair_body_frame(rigid, true);
  const sbri_hull *hull = &rigid->rigid->hull;
  float scale = rigid->owner->scale, margin = soft->soft->contact.margin_m * soft->owner->scale;
  const float full_weight = 1;
  for (uint32_t v = 0; v < soft->surface->vertex_count; v++) {
    if (!(soft->surface->samples[v].mass_kg > 0)) continue;
    sbf_vec3 x = soft->surface->positions[v];
    sbf_vec3 begin = sbri_to_local(&source, x, scale),
             end = sbri_to_local(&to, sbri_add(x, soft->surface->displacements[v]), scale);
    sbf_vec3 displacement = sbri_sub(end, begin), point, normal, entered;
    float fraction, local = sbri_length(displacement) * scale;
    float reach =
        sbri_reach_of(soft->soft, soft->owner->scale, local, soft->surface->max_displacement_m) / scale;
    uint32_t face;
    sbri_box swept_box = sbri_box_grown(sbri_box_with(sbri_box_of_point(begin), end), reach);
    if (!sbri_boxes_overlap(&swept_box, &hull->box) || sbri_hull_depth(hull, begin, &face) > reach) continue;
    float gap = sbri_hull_nearest(hull, begin, &point, &normal);
    if (gap > 0 && sbri_hull_enter(hull, begin, displacement, &fraction, &entered))
      point = sbri_add_scaled(begin, displacement, fraction), normal = entered;
    else if (gap > reach)
      continue;
    if (sbri_are_same_character(soft, rigid)) {
      sbr_transform rest = {sbri_scale(rigid->rigid->center, scale), rigid->rigid->axes};
      float relations = SBRI_REST_CONTACT_FRACTION * soft->soft->rest_size_m;
      if (sbri_hull_depth(hull, sbri_to_local(&rest, sbri_pair_body_rest_position(soft, v), scale), &face) <=
          relations)
        continue;
    }
    sbri_contact t = {.feature = v,
        .a = sbri_soft_contact_side(soft, &v, &full_weight, 1),
        .b = sbri_rigid_contact_side(rigid, point),
        .normal = sbri_rotate(source.rotation, normal),
        .margin = margin,
        .is_deep = -gap * scale > DEEP_FRACTION * rule_of(soft).inner};
    sbri_narrow_phase_add(f, soft, rigid, &t);
  }
}

/* A corner that has passed through a sheet without thickness is pushed back through it. The opposite normal
 * would fight the contact of the sheet's points with the hull. */
static void flip_if_passed_through(const sbri_pair_body *rigid, const sbri_pair_body *soft, sbf_vec3 corner,
    const sbr_transform *at, sbri_surface_hit *best) {
  sbf_vec3 out = sbri_rotate(at->rotation, sbri_sub(corner, rigid->rigid->hull.middle));
  sbri_surface_rule rule = rule_of(soft);
  bool is_near = best->urgency >= 1 && best->urgency - 1 <= rule.inner && rule.outer == 0;
  if (is_near && sbri_dot(best->normal, out) > PASSED_THROUGH_COSINE * sbri_length(out))
    best->normal = sbri_scale(best->normal, -1);
}

/* Hull corners against triangles of the soft surface. */
static void find_hull_corner_contacts(
    const sbri_narrow_phase *f, const sbri_pair_body *rigid, const sbri_pair_body *soft, bool resolves_deep) {
  sbr_transform source = sbri_pair_body_frame(rigid, false), to = sbri_pair_body_frame(rigid, true);
  const face_search search = face_search_of(rigid, soft);
  for (uint32_t i = 0; i < rigid->rigid->vertex_count; i++) {
    sbf_vec3 local = rigid->rigid->vertices[i], x = to_world(&source, local, rigid->owner->scale);
    sbri_surface_hit best;
    bool deep = !find_face(&search, x, sbri_sub(to_world(&to, local, rigid->owner->scale), x), &best);
    if (deep && (!resolves_deep || !sbri_find_nearest_exit(soft, x, &best))) continue;
    const uint32_t *corners = soft->surface->triangles + 3 * (size_t)best.face;
    if (soft->surface->two_sided) flip_if_passed_through(rigid, soft, local, &source, &best);
    if (sbri_are_same_character(soft, rigid) && !deep) {
      sbr_transform rest = {sbri_scale(rigid->rigid->center, rigid->owner->scale), rigid->rigid->axes};
      const sbf_vec3 p[3] = {sbri_pair_body_rest_position(soft, corners[0]),
          sbri_pair_body_rest_position(soft, corners[1]), sbri_pair_body_rest_position(soft, corners[2])};
      sbri_surface_rule rule = rule_of(soft);
      float relations = SBRI_REST_CONTACT_FRACTION * soft->soft->rest_size_m * soft->owner->scale;
      if (sbri_surface_gap(&rule, to_world(&rest, local, rigid->owner->scale), p) <= relations) continue;
    }
    sbri_contact t = {.feature = i,
        .a = sbri_rigid_contact_side(rigid, local),
        .b = sbri_soft_contact_side(soft, corners, best.weights, 3),
        .normal = best.normal,
        .margin = sbri_pair_margin(rigid, soft),
        .is_deep = deep || (best.behind && best.urgency - 1 > DEEP_FRACTION * rule_of(soft).inner),
        .exits_nearest = deep};
    sbri_narrow_phase_add(f, rigid, soft, &t);
  }
}

/* Ground and collider planes of rigid bodies join the solve, so that stacks are solved as a whole. Soft
 * bodies handle the ground in their own steps. */
static void add_plane_contacts(const sbri_narrow_phase *f, uint32_t member) {
  const sbri_group_member *m = &f->members[member];
  const sbri_rigid_solving *work = &m->parts.work;
  for (uint32_t i = 0; m->parts.steps && i < work->contact_list.count; i++) {
    const sbri_rigid_contact *source = &work->contact_list.at[i];
    bool is_dynamic =
        source->external_body && sbri_rigid_external_body_is_mobile(
                                     &work->external_list.at[source->external_body - 1], source->normal);
    if (is_dynamic && source->external_body > sbri_count_member_externals(m)) continue;
    if (f->group->contact_count >= f->group->contact_capacity) return;
    SBF_ASSERT(f->group->first_contact + f->group->contact_count < f->world->body_contacts->contact_capacity);
    sbri_contact *t = &f->world->body_contacts->contacts[f->group->first_contact + f->group->contact_count++];
    sbf_vec3 on_plane = sbri_scale(source->normal, source->offset);
    *t = (sbri_contact){.a = {.member = member, .rigid_body = (int32_t)source->body, .point = source->at},
        .b = {.member = member,
            .rigid_body = SBRI_CONTACT_PLANE,
            .point = is_dynamic ? source->external_body_arm : sbri_add_scaled(m->offset, on_plane, m->scale),
            .plane_velocity = sbri_scale(source->velocity, m->velocity_scale),
            .external = is_dynamic ? source->external_body : 0},
        .body_ids = {sbri_contact_body_id(
                         &(sbri_contact_body){.character = (uint32_t)(m->character - f->world->characters),
                             .body_index = source->body,
                             .rigid = true}),
            SBRI_GROUND_CONTACT_ID - (source->collider + 1)},
        .normal = source->normal,
        .friction = source->external_body && !is_dynamic
                        ? 0
                        : source->friction}; /* friction acts in the body's own step */
  }
}

/* ---- All ---- */

/* Whether a soft body and a hull are within the search distance. */
static bool may_collide_with_hull(const sbri_pair_body *soft, const sbri_pair_body *rigid) {
  const sbri_contact_surface *s = soft->surface;
  if (!s->triangle_count) return true;
  float reach = sbri_reach_of(soft->soft, soft->owner->scale, s->max_displacement_m, s->max_displacement_m),
        distance = sbri_pair_search_distance(sbri_pair_margin(rigid, soft), soft);
  sbri_box grown = sbri_box_grown(sbri_pair_body_hull_box(rigid), reach > distance ? reach : distance);
  return sbri_boxes_overlap(&grown, &s->tree.nodes[0].box);
}

/* The same for two soft bodies. */
static bool may_collide(const sbri_pair_body *a, const sbri_pair_body *b) {
  if (!a->surface->triangle_count || !b->surface->triangle_count) return true;
  float distance = fmaxf(sbri_pair_search_distance(sbri_pair_margin(a, b), b),
      sbri_pair_search_distance(sbri_pair_margin(b, a), a));
  sbri_box grown = sbri_box_grown(a->surface->tree.nodes[0].box, distance);
  return sbri_boxes_overlap(&grown, &b->surface->tree.nodes[0].box);
}

/* Surfaces of the soft bodies that are in a pair. */
static void update_surfaces(const sbri_narrow_phase *f) {
  const sbri_body_contacts *all = f->world->body_contacts;
  for (uint32_t i = 0; i < 2 * f->group->pair_count; i++) {
    const sbri_contact_pair *pair = &all->pairs[f->group->first_pair + i / 2];
    sbri_pair_body p = pair_body_of(f, i % 2 ? pair->b : pair->a);
    if (p.soft) p.surface->is_current = false;
  }
  for (uint32_t i = 0; i < 2 * f->group->pair_count; i++) {
    const sbri_contact_pair *pair = &all->pairs[f->group->first_pair + i / 2];
    sbri_pair_body p = pair_body_of(f, i % 2 ? pair->b : pair->a);
    if (!p.soft || p.surface->is_current) continue;
    sbri_contact_surface_update(f->world, p.owner, p.body->body_index);
    p.surface->is_current = true;
  }
}

/* Marks the islands in contact. */
static void mark_islands(const sbri_narrow_phase *f) {
  const sbri_contact *contacts = f->world->body_contacts->contacts + f->group->first_contact;
  for (uint32_t i = 0; i < f->group->contact_count; i++) {
    const sbri_contact_side *sides[2] = {&contacts[i].a, &contacts[i].b};
    for (int k = 0; k < 2; k++)
      if (sides[k]->rigid_body == SBRI_CONTACT_SOFT)
        sbri_contact_islands(f->members[sides[k]->member].character)[sides[k]->island] = 1;
  }
}

void sbri_narrow_phase_update(sbr_world *world, sbri_contact_group *group) {
  sbri_body_contacts *all = world->body_contacts;
  sbri_narrow_phase f = {world, group, all->members + group->first_member};
  group->contact_count = 0;
  update_surfaces(&f);
  for (uint32_t i = 0; i < group->pair_count; i++) {
    sbri_contact_pair pair = all->pairs[group->first_pair + i];
    sbri_pair_body a = pair_body_of(&f, pair.a), b = pair_body_of(&f, pair.b);
    if (pair.a == pair.b) {
      find_self_contacts(&f, &a);
    } else if (a.rigid && b.rigid) {
      sbri_find_hull_contacts(&f, &a, &b);
    } else if (a.rigid || b.rigid) {
      const sbri_pair_body *rigid = a.rigid ? &a : &b, *soft = a.rigid ? &b : &a;
      if (!may_collide_with_hull(soft, rigid)) continue;
      uint32_t first = group->contact_count;
      bool resolve_deep = may_resolve_deep(&f, soft, rigid);
      find_hull_vertex_contacts(&f, soft, rigid);
      find_hull_corner_contacts(&f, rigid, soft, resolve_deep);
      if (resolve_deep && soft->surface->closed) {
        sbri_resolve_crossings(&f, soft, rigid, first);
        sbri_find_ridge_contacts(&f, soft, rigid, first);
      }
    } else if (may_collide(&a, &b)) {
      uint32_t first = group->contact_count;
      bool resolve_deep = may_resolve_deep(&f, &a, &b);
      find_face_contacts(&f, &a, &b, resolve_deep);
      find_face_contacts(&f, &b, &a, resolve_deep);
      if (resolve_deep && a.surface->closed && b.surface->closed) {
        sbri_resolve_crossings(&f, &a, &b, first);
        sbri_find_ridge_contacts(&f, &a, &b, first);
      }
      if (a.surface->two_sided && b.surface->two_sided) sbri_find_edge_contacts(&f, &a, &b);
    }
  }
  for (uint32_t m = 0; m < group->member_count; m++) add_plane_contacts(&f, m);
  mark_islands(&f);
}
