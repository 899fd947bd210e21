/* Rays and boxes among all that is in a world: sbrun/collision.h. */
#include "collide/triangle.h"
#include "math/usable.h"
#include "query/ground_ray.h"
#include "ragdoll/ragdoll.h"
#include "skin/skin.h"

static const sbr_hit no_hit = {.rigid_body = -1, .soft_body = -1};

/* ---- Rays ---- */

typedef struct ray {
  const sbr_world *world;
  sbr_double3 from;
  sbf_vec3 direction;
  uint32_t mask;
  float fraction; /* of the ray, to the nearest hit so far */
  bool any;
  sbr_hit hit;
} ray;

static void note(ray *r, float fraction, sbf_vec3 normal, sbr_hit hit) {
  r->fraction = fraction, r->any = true;
  r->hit = hit;
  r->hit.normal = normal;
}

static void ask_colliders(ray *r) {
  const sbri_collider_set *set = &r->world->colliders;
  for (uint32_t i = 0; i < set->capacity; i++) {
    const sbri_collider *c = &set->at[i];
    if (!c->shape || !(c->layer & r->mask)) continue;
    sbf_quat into = sbri_quat_conjugate(c->turn_to);
    sbf_vec3 off = {(float)(r->from.x - c->to.x), (float)(r->from.y - c->to.y), (float)(r->from.z - c->to.z)};
    sbf_vec3 x = sbri_rotate(into, off), direction = sbri_rotate(into, r->direction), normal;
    sbri_box all = sbri_box_with(sbri_box_of_point(x), sbri_add(x, direction));
    float fraction;
    if (!sbri_boxes_overlap(&c->shape->bounds, &all) ||
        !sbri_shape_enter(c->shape, x, direction, &fraction, &normal) || fraction >= r->fraction)
      continue;
    sbr_hit hit = no_hit;
    hit.collider = sbri_collider_name(set, i);
    note(r, fraction, sbri_rotate(c->turn_to, normal), hit);
  }
}

/* The ground is on the first layer, as colliders are by default. */
static void ask_ground(ray *r) {
  double fraction;
  sbf_vec3 normal;
  if (!(r->mask & 1) || !sbri_ground_ray(&r->world->ground, r->from, r->direction, &fraction, &normal) ||
      (float)fraction >= r->fraction)
    return;
  sbr_hit hit = no_hit;
  hit.ground = true;
  note(r, (float)fraction, normal, hit);
}

/* Asset metres relative to the character's origin. */
static sbf_vec3 into_asset(const sbri_character *c, sbr_double3 x) {
  sbr_double3 o = sbri_header(c)->origin;
  return sbri_scale(sbri_vec3((float)(x.x - o.x), (float)(x.y - o.y), (float)(x.z - o.z)), 1 / c->scale);
}

static sbr_transform body_pose(const sbri_character *c, uint32_t body) {
  return sbri_rigid_drive(c)->any ? sbri_rigid_bodies(c)[body].pose
                                  : sbri_rigid_target(c, sbri_pose(c), body);
}

static void ask_rigid(ray *r, const sbri_character *c) {
  sbf_vec3 from = into_asset(c, r->from), direction = sbri_scale(r->direction, 1 / c->scale), normal;
  for (uint32_t b = 0; b < c->model->rigid.body_count; b++) {
    const sbri_rigid_body *body = &c->model->rigid.bodies[b];
    if (!body->hull.face_count || !(body->source->layer & r->mask)) continue;
    sbr_transform pose = body_pose(c, b);
    sbf_quat into = sbri_quat_conjugate(pose.rotation);
    float fraction;
    if (!sbri_hull_enter(&body->hull, sbri_rotate(into, sbri_sub(from, pose.position)),
            sbri_rotate(into, direction), &fraction, &normal) ||
        fraction >= r->fraction)
      continue;
    sbr_hit hit = no_hit;
    hit.character = sbri_id_of(r->world, c);
    hit.rigid_body = (int32_t)b;
    note(r, fraction, sbri_rotate(pose.rotation, normal), hit);
  }
}

static sbf_vec3 position_of(const sbri_point *p) {
  return sbri_vec3(p->x, p->y, p->z);
}

static void ask_surface(ray *r, const sbri_character *c, uint32_t b) {
  const sbri_body *body = &c->model->bodies[b];
  sbri_point *vertices = sbri_surface_vertices(c) + body->first_vertex;
  const sbri_skin surface = sbri_skin_now(c, &body->surface);
  sbf_vec3 from = into_asset(c, r->from), direction = sbri_scale(r->direction, 1 / c->scale);
  sbri_skin_compute_vertices(c->model, &surface, sbri_positions(c), sbri_deltas(c), vertices);
  for (uint32_t i = 0; i < surface.face_block_count * SBRI_BLOCK; i++) {
    sbf_vec3 at[4];
    for (int k = 0; k < 4; k++)
      at[k] = position_of(&vertices[surface.faces[i / SBRI_BLOCK].corners[k][i % SBRI_BLOCK]]);
    for (int k = 0; k < 2; k++) {
      sbf_vec3 n = sbri_triangle_normal(at[0], at[k + 1], at[k + 2]);
      float fraction = sbri_triangle_cross(from, direction, at[0], at[k + 1], at[k + 2]);
      if (fraction < 0 || fraction >= r->fraction || sbri_dot(n, n) == 0) continue;
      sbr_hit hit = no_hit;
      hit.character = sbri_id_of(r->world, c);
      hit.soft_body = (int32_t)b;
      note(r, fraction, sbri_dot(n, direction) > 0 ? sbri_scale(n, -1) : n, hit);
    }
  }
}

bool sbr_world_cast_ray(const sbr_world *world, sbr_double3 from, sbf_vec3 direction, double length,
    uint32_t mask, sbr_hit *hit) {
  sbf_vec3 unit = sbri_normalize(direction, sbri_vec3(0, 0, 0));
  const double position[4] = {from.x, from.y, from.z, length};
  if (!world || !hit || !(length > 0) || !(sbri_dot(unit, unit) > 0) || !sbri_usable(position, 4))
    return false;
  ray r = {world, from, sbri_scale(unit, (float)length), mask, 1.000001f, false, no_hit};
  ask_ground(&r);
  ask_colliders(&r);
  for (uint32_t i = 0; i < world->character_capacity; i++) {
    const sbri_character *c = &world->characters[i];
    if (!c->model) continue;
    ask_rigid(&r, c);
    for (uint32_t b = 0; b < c->model->asset->soft_bodies.count; b++)
      if (c->model->asset->soft_bodies.at[b].collision.layer & mask) ask_surface(&r, c, b);
  }
  *hit = r.hit;
  hit->distance = (double)r.fraction * length;
  hit->position = (sbr_double3){from.x + (double)unit.x * hit->distance,
      from.y + (double)unit.y * hit->distance, from.z + (double)unit.z * hit->distance};
  return r.any;
}

/* ---- Boxes ---- */

typedef struct listing {
  const sbr_world *world;
  sbri_box box;
  sbr_hit *hits;
  uint32_t count, capacity;
} listing;

static void list(listing *l, const sbri_box *bounds, sbr_hit hit) {
  if (!sbri_boxes_overlap(bounds, &l->box)) return;
  if (l->count < l->capacity) l->hits[l->count] = hit;
  l->count++;
}

static void list_character(listing *l, const sbri_character *c, uint32_t mask) {
  sbr_double3 origin = sbri_header(c)->origin;
  sbr_hit hit = no_hit;
  hit.character = sbri_id_of(l->world, c);
  for (uint32_t b = 0; b < c->model->rigid.body_count; b++) {
    const sbri_rigid_body *body = &c->model->rigid.bodies[b];
    if (!body->vertex_count || !(body->source->layer & mask)) continue;
    sbr_transform pose = body_pose(c, b);
    sbri_box box = sbri_box_of_point(sbri_add(pose.position, sbri_rotate(pose.rotation, body->vertices[0])));
    for (uint32_t v = 1; v < body->vertex_count; v++)
      box = sbri_box_with(box, sbri_add(pose.position, sbri_rotate(pose.rotation, body->vertices[v])));
    box = sbri_box_in_world(box, origin, c->scale);
    hit.rigid_body = (int32_t)b;
    list(l, &box, hit);
  }
  hit.rigid_body = -1;
  for (uint32_t b = 0; b < c->model->asset->soft_bodies.count; b++) {
    const sbri_body *body = &c->model->bodies[b];
    if (!body->level || !(body->source->collision.layer & mask) || body->slot_begin == body->slot_real_end)
      continue;
    const sbri_point *points = sbri_positions(c) + c->model->islands[body->island].first_slot;
    sbri_box box = sbri_box_of_point(position_of(&points[body->slot_begin]));
    for (uint32_t slot = body->slot_begin; slot < body->slot_real_end; slot++)
      box = sbri_box_with(box, position_of(&points[slot]));
    box = sbri_box_in_world(box, origin, c->scale);
    hit.soft_body = (int32_t)b;
    list(l, &box, hit);
  }
}

uint32_t sbr_world_overlap_aabb(const sbr_world *world, sbr_double3 low, sbr_double3 high, uint32_t mask,
    sbr_hit *hits, uint32_t capacity) {
  if (!world) return 0;
  listing l = {world,
      {{(float)low.x, (float)low.y, (float)low.z}, {(float)high.x, (float)high.y, (float)high.z}}, hits, 0,
      hits ? capacity : 0};
  const sbri_collider_set *set = &world->colliders;
  for (uint32_t i = 0; i < set->capacity; i++) {
    if (!set->at[i].shape || !(set->at[i].layer & mask)) continue;
    sbri_box box = sbri_collider_bounds(&set->at[i]);
    sbr_hit hit = no_hit;
    hit.collider = sbri_collider_name(set, i);
    list(&l, &box, hit);
  }
  for (uint32_t i = 0; i < world->character_capacity; i++)
    if (world->characters[i].model) list_character(&l, &world->characters[i], mask);
  return l.count;
}
