/* Hulls against the host's shapes: contact points on the hull, each with a plane, in the same list as those
 * on the ground (rigid_contacts.c), which solves them.
 *
 * A body that moves by more than half its size in the tick could pass through a thin shape unnoticed. If the
 * path of its centre enters a shape, the plane at that point becomes a contact. */
#include "rigid/rigid_work.h"
#include "shapes/colliders.h"
#include "shapes/hull_pair.h"

/* Maximum number of shape contacts of a body, within the capacity for all. */
enum { MAX_TRIANGLES = 64 };

/* Contact margin: a fraction of the body's size, on top of its displacement in the tick. */
static const float NEAR_FRACTION = 0.02f;

typedef struct shape_pair {
  const sbri_rigid_tick *tick;
  sbri_rigid_solving *work;
  const sbri_rigid_body *body;
  uint32_t number;
  int32_t node;
  sbr_transform pose;
  sbri_collider_frame frame;
  uint32_t collider;
  sbri_placed_hull hull; /* in the shape's frame and lengths */
  float reach, radius;   /* in the same units */
} shape_pair;

/* Adds a contact of a hull point and a shape point, both in the shape's frame. */
static void add_contact(const shape_pair *m, sbf_vec3 on_hull, sbf_vec3 on_shape, sbf_vec3 normal) {
  if (m->work->contact_list.count >= m->work->contact_list.capacity) return;
  const sbri_collider *c = m->frame.collider;
  sbf_vec3 own = sbri_sub(sbri_out_of_shape(&m->frame, on_hull), m->pose.position);
  sbf_vec3 n = sbri_rotate(c->rotation_from, normal), position = sbri_out_of_shape(&m->frame, on_shape);
  uint32_t external_body =
      sbri_rigid_external_body_of(m->tick, m->work, m->number, m->node, &m->frame, m->collider);
  sbf_vec3 centre = external_body ? m->work->external_list.at[external_body - 1].is.centre : position;
  m->work->contact_list.at[m->work->contact_list.count++] = (sbri_rigid_contact){.node = m->node,
      .body = m->number,
      .at = sbri_rotate(sbri_quat_conjugate(m->pose.rotation), own),
      .normal = n,
      .offset = sbri_dot(n, position),
      .velocity = sbri_scale(sbri_shape_displacement(&m->frame, on_shape), 1 / m->tick->tick_s),
      .friction = sbri_friction_with(c, m->body->source->friction),
      .restitution = sbri_restitution_with(c, m->body->source->restitution),
      .collider = m->collider,
      .surface = m->collider,
      .external_body = external_body,
      .external_body_arm = sbri_sub(position, centre)};
}

static void add_pair(const shape_pair *m, const sbri_hull_pair *pair) {
  for (uint32_t i = 0; i < pair->count; i++) add_contact(m, pair->on_a[i], pair->on_b[i], pair->normal);
}

static sbf_vec3 vertex(const shape_pair *m, uint32_t i) {
  return sbri_add(
      m->hull.at, sbri_rotate(m->hull.rotation, sbri_scale(m->hull.hull->vertices[i], m->hull.scale)));
}

/* ---- Round and infinite shapes ---- */

/* Distance of x from the hull. */
static float hull_distance(const shape_pair *m, sbf_vec3 x, sbf_vec3 *position, sbf_vec3 *normal) {
  sbf_vec3 own = sbri_rotate(sbri_quat_conjugate(m->hull.rotation), sbri_sub(x, m->hull.at));
  float gap = sbri_hull_nearest(m->hull.hull, sbri_scale(own, 1 / m->hull.scale), position, normal);
  *position = sbri_add(m->hull.at, sbri_rotate(m->hull.rotation, sbri_scale(*position, m->hull.scale)));
  *normal = sbri_rotate(m->hull.rotation, *normal);
  return gap * m->hull.scale;
}

/* Contact of a sphere with the hull. */
static void collide_ball(const shape_pair *m, sbf_vec3 middle) {
  sbf_vec3 on_hull, normal;
  float radius = m->frame.collider->shape->radius;
  if (hull_distance(m, middle, &on_hull, &normal) > radius + m->reach) return;
  sbf_vec3 n = sbri_scale(normal, -1);
  add_contact(m, on_hull, sbri_add_scaled(middle, n, radius), n);
}

static float distance_at(const shape_pair *m, float y) {
  sbf_vec3 position, normal;
  return hull_distance(m, sbri_vec3(0, y, 0), &position, &normal);
}

/* Both ends, and the nearest point between them: the distance to a convex shape has a single minimum along a
 * line (golden section search). */
static void collide_capsule(const shape_pair *m) {
  const float golden = 0.618034f, half = m->frame.collider->shape->half_sizes.y;
  float low = -half, high = half;
  for (int i = 0; i < 24 && half > 0; i++) {
    float a = high - golden * (high - low), b = low + golden * (high - low);
    if (distance_at(m, a) < distance_at(m, b))
      high = b;
    else
      low = a;
  }
  float between = 0.5f * (low + high);
  collide_ball(m, sbri_vec3(0, -half, 0));
  if (half > 0) collide_ball(m, sbri_vec3(0, half, 0));
  if (fabsf(between) < 0.95f * half) collide_ball(m, sbri_vec3(0, between, 0));
}

static void collide_by_vertices(const shape_pair *m) {
  for (uint32_t i = 0; i < m->hull.hull->vertex_count; i++) {
    sbri_nearest found;
    sbf_vec3 x = vertex(m, i);
    if (sbri_shape_nearest(m->frame.collider->shape, x, m->reach, m->radius, &found))
      add_contact(m, x, found.position, found.normal);
  }
}

/* ---- Triangles ---- */

static sbri_box bounds_of(const shape_pair *m) {
  sbri_box box = sbri_box_of_point(vertex(m, 0));
  for (uint32_t i = 1; i < m->hull.hull->vertex_count; i++) box = sbri_box_with(box, vertex(m, i));
  return box;
}

static void collide_triangle(const shape_pair *m, const sbf_vec3 at[3]) {
  static const uint32_t in_turn[6] = {0, 1, 2, 0, 2, 1};
  sbf_vec3 n = sbri_triangle_normal(at[0], at[1], at[2]), back = sbri_scale(n, -1);
  if (sbri_dot(n, n) == 0 || sbri_dot(n, sbri_sub(m->hull.at, at[0])) < -m->radius) return;
  const sbri_hull_face faces[2] = {{n, sbri_dot(n, at[0]), 0, 3}, {back, -sbri_dot(n, at[0]), 3, 3}};
  const sbri_hull_edge edges[3] = {{{0, 1}, {n, back}}, {{1, 2}, {n, back}}, {{2, 0}, {n, back}}};
  sbri_hull flat = {.vertices = at,
      .faces = faces,
      .corners = in_turn,
      .edges = edges,
      .vertex_count = 3,
      .face_count = 2,
      .corner_count = 6,
      .edge_count = 3,
      .middle = sbri_scale(sbri_add(sbri_add(at[0], at[1]), at[2]), 1.0f / 3)};
  sbri_placed_hull triangle = {&flat, {0, 0, 0}, {0, 0, 0, 1}, 1};
  sbri_hull_pair pair;
  if (!sbri_collide_hulls(&m->hull, &triangle, m->reach, &pair)) return;
  if (sbri_dot(pair.normal, n) < 0.1f) { /* sideways, as between coplanar triangles, or behind */
    if (sbri_dot(pair.normal, n) < -0.1f && pair.gap > 0) return;
    pair.normal = n;
    for (uint32_t i = 0; i < pair.count; i++)
      pair.on_b[i] = sbri_add_scaled(pair.on_a[i], n, -sbri_dot(n, sbri_sub(pair.on_a[i], at[0])));
  }
  add_pair(m, &pair);
}

static void collide_triangles(const shape_pair *m) {
  const sbri_triangles *t = &m->frame.collider->shape->triangles;
  sbri_bounds_walk walk;
  uint32_t item, count = 0;
  sbri_bounds_walk_begin(&walk, &t->tree, sbri_box_grown(bounds_of(m), m->reach));
  while (count < MAX_TRIANGLES && sbri_bounds_walk_next(&walk, &item)) {
    const uint32_t *c = t->corners + 3 * (size_t)item;
    const sbf_vec3 at[3] = {t->points[c[0]], t->points[c[1]], t->points[c[2]]};
    uint32_t before = m->work->contact_list.count;
    collide_triangle(m, at);
    count += m->work->contact_list.count > before;
  }
}

/* ---- All shapes ---- */

/* Where the centre's path enters the shape: the plane there, for the hull's extreme point in that direction.
 */
static void sweep_triangle(const shape_pair *m, sbf_vec3 direction) {
  float fraction;
  sbf_vec3 normal;
  if (!sbri_shape_enter(m->frame.collider->shape, m->hull.at, direction, &fraction, &normal)) return;
  sbf_vec3 position = sbri_add_scaled(m->hull.at, direction, fraction);
  sbf_vec3 own = sbri_rotate(sbri_quat_conjugate(m->hull.rotation), sbri_scale(normal, -1));
  float lowest = sbri_dot(normal, vertex(m, sbri_hull_support(m->hull.hull, own)));
  sbri_hull_pair pair = {.normal = normal};
  for (uint32_t i = 0; i < m->hull.hull->vertex_count; i++) {
    sbf_vec3 x = vertex(m, i);
    if (sbri_dot(normal, x) > lowest + 0.1f * m->radius) continue;
    float gap = sbri_dot(normal, sbri_sub(x, position));
    sbri_hull_pair_add(&pair, x, sbri_add_scaled(x, normal, -gap), gap);
  }
  add_pair(m, &pair);
}

static void collide(const shape_pair *m, sbf_vec3 direction) {
  uint32_t before = m->work->contact_list.count;
  const sbr_shape *shape = m->frame.collider->shape;
  switch (shape->kind) {
  case SBR_SHAPE_SPHERE:
    collide_ball(m, sbri_vec3(0, 0, 0));
    break;
  case SBR_SHAPE_CAPSULE:
    collide_capsule(m);
    break;
  case SBR_SHAPE_PLANE:
  case SBR_SHAPE_HOST:
    collide_by_vertices(m);
    break;
  case SBR_SHAPE_MESH:
  case SBR_SHAPE_HEIGHT_FIELD:
    collide_triangles(m);
    break;
  case SBR_SHAPE_BOX:
  case SBR_SHAPE_HULL: {
    sbri_placed_hull other = {&shape->hull, {0, 0, 0}, {0, 0, 0, 1}, 1};
    sbri_hull_pair pair;
    if (sbri_collide_hulls(&m->hull, &other, m->reach, &pair)) add_pair(m, &pair);
  }
  }
  if (m->work->contact_list.count == before && sbri_length(direction) > 0.5f * m->radius)
    sweep_triangle(m, direction);
}

static void collide_body(const sbri_rigid_tick *t, sbri_rigid_solving *work, uint32_t b, int32_t node) {
  const sbri_collider_set *set = t->colliders;
  const sbri_rigid_body *body = &t->model->bodies[b];
  const sbri_rigid_body_state *s = &t->bodies[b];
  if (!body->hull.face_count) return;
  sbf_vec3 turn = sbri_angular_velocity_from_momentum(body, s->pose.rotation, s->angular_momentum),
           x = s->pose.position;
  sbf_vec3 fall = sbri_scale(t->gravity, t->tick_s * t->tick_s);
  sbf_vec3 displacement = sbri_add(sbri_scale(s->velocity, t->tick_s), fall);
  float swing = sbri_length(turn) * body->radius * t->tick_s + NEAR_FRACTION * body->radius;
  sbri_box box =
      sbri_box_grown(sbri_box_with(sbri_box_of_point(x), sbri_add(x, displacement)), body->radius + swing);
  box = sbri_box_in_world(box, t->origin, t->scale);
  sbri_bounds_walk walk;
  uint32_t item;
  sbri_bounds_walk_begin(&walk, &set->tree, box);
  while (sbri_bounds_walk_next(&walk, &item)) {
    const sbri_collider *c = &set->at[set->listed[item]];
    if (!sbri_boxes_overlap(&set->bounds[item], &box) ||
        !sbri_layers_collide(body->source->layer, body->source->mask, c->layer, c->mask))
      continue;
    shape_pair m = {.tick = t,
        .work = work,
        .body = body,
        .number = b,
        .node = node,
        .pose = s->pose,
        .frame = sbri_collider_frame_of(c, t->origin, t->scale),
        .collider = set->listed[item]};
    sbf_vec3 at = sbri_into_shape(&m.frame, x, false);
    sbf_vec3 end = sbri_into_shape(&m.frame, sbri_add(x, displacement), true);
    sbf_vec3 own_displacement = sbri_sub(end, at);
    m.hull = (sbri_placed_hull){&body->hull, at,
        sbri_quat_multiply(sbri_quat_conjugate(c->rotation_from), s->pose.rotation), t->scale};
    m.radius = t->scale * body->radius;
    float ahead = sbri_length(own_displacement), max = 0.5f * m.radius;
    m.reach = t->scale * swing + (ahead < max ? ahead : max);
    collide(&m, own_displacement);
  }
}

void sbri_rigid_shape_contacts_find(const sbri_rigid_tick *t, sbri_rigid_solving *work) {
  work->external_list.count = 0;
  if (!t->colliders || !t->colliders->tree.node_count) return;
  for (uint32_t i = 0; i < work->system.node_count; i++)
    collide_body(t, work, work->system.nodes[i].body, (int32_t)i);
}
