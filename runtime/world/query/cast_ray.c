/* Rays: sbrun/query.h. */
#include "math/quat.h"
#include "math/usable.h"
#include "shapes/triangle.h"
#include "world/query/ground_ray.h"
#include "world/query/query_targets.h"

typedef struct ray {
  const sbr_world *world;
  sbr_double3 from;
  sbf_vec3 direction;
  const sbr_query_filter *filter;
  float fraction; /* of the ray, up to the nearest hit so far */
  bool any;
  sbr_object object;
  sbf_vec3 normal;
} ray;

static void note(ray *r, float fraction, sbf_vec3 normal, const sbr_object *object) {
  r->fraction = fraction, r->any = true;
  r->normal = normal;
  r->object = *object;
}

static void hit_colliders(ray *r) {
  const sbri_collider_set *set = &r->world->colliders;
  for (uint32_t i = 0; i < set->capacity; i++) {
    const sbri_collider *c = &set->at[i];
    if (!c->shape) continue;
    sbf_quat into = sbri_quat_conjugate(c->rotation_to);
    sbf_vec3 off = {(float)(r->from.x - c->to.x), (float)(r->from.y - c->to.y), (float)(r->from.z - c->to.z)};
    sbf_vec3 x = sbri_rotate(into, off), direction = sbri_rotate(into, r->direction), normal;
    sbri_box all = sbri_box_with(sbri_box_of_point(x), sbri_add(x, direction));
    float fraction;
    if (!sbri_boxes_overlap(&c->shape->bounds, &all) ||
        !sbri_shape_enter(c->shape, x, direction, &fraction, &normal) || fraction >= r->fraction)
      continue;
    sbr_object object = sbri_no_object;
    object.collider = sbri_collider_name(set, i);
    if (sbri_query_accepts(r->filter, c->layer, c->mask, &object))
      note(r, fraction, sbri_rotate(c->rotation_to, normal), &object);
  }
}

static void hit_ground(ray *r) {
  double fraction;
  sbf_vec3 normal;
  if (sbri_query_sees_ground(r->world, r->filter) &&
      sbri_ground_ray(&r->world->ground, r->from, r->direction, &fraction, &normal) &&
      (float)fraction < r->fraction)
    note(r, (float)fraction, normal, &sbri_no_object);
}

/* In asset metres relative to the character's origin. */
static sbf_vec3 into_asset(const sbri_character *c, sbr_double3 x) {
  sbr_double3 o = sbri_header(c)->origin;
  return sbri_scale(sbri_vec3((float)(x.x - o.x), (float)(x.y - o.y), (float)(x.z - o.z)), 1 / c->scale);
}

static void hit_rigid_bodies(ray *r, const sbri_character *c) {
  sbf_vec3 from = into_asset(c, r->from), direction = sbri_scale(r->direction, 1 / c->scale), normal;
  for (uint32_t b = 0; b < c->model->rigid.body_count; b++) {
    const sbri_rigid_body *body = &c->model->rigid.bodies[b];
    if (!body->hull.face_count) continue;
    sbr_transform pose = sbri_query_rigid_pose(c, b);
    sbf_quat into = sbri_quat_conjugate(pose.rotation);
    float fraction;
    if (!sbri_hull_enter(&body->hull, sbri_rotate(into, sbri_sub(from, pose.position)),
            sbri_rotate(into, direction), &fraction, &normal) ||
        fraction >= r->fraction)
      continue;
    sbr_object object = sbri_no_object;
    object.character = sbri_id_of(r->world, c);
    object.rigid_body = (int32_t)b;
    if (sbri_query_accepts(r->filter, body->source->layer, body->source->mask, &object))
      note(r, fraction, sbri_rotate(pose.rotation, normal), &object);
  }
}

static sbf_vec3 position_of(const sbri_point *p) {
  return sbri_vec3(p->x, p->y, p->z);
}

static void hit_surface(ray *r, const sbri_character *c, const sbr_object *object) {
  sbri_skin surface;
  const sbri_point *vertices = sbri_query_surface(c, (uint32_t)object->soft_body, &surface);
  sbf_vec3 from = into_asset(c, r->from), direction = sbri_scale(r->direction, 1 / c->scale);
  for (uint32_t i = 0; i < surface.face_block_count * SBRI_BLOCK; i++) {
    sbf_vec3 at[4];
    for (int k = 0; k < 4; k++)
      at[k] = position_of(&vertices[surface.faces[i / SBRI_BLOCK].corners[k][i % SBRI_BLOCK]]);
    for (int k = 0; k < 2; k++) {
      sbf_vec3 n = sbri_triangle_normal(at[0], at[k + 1], at[k + 2]);
      float fraction = sbri_triangle_cross(from, direction, at[0], at[k + 1], at[k + 2]);
      if (fraction < 0 || fraction >= r->fraction || sbri_dot(n, n) == 0) continue;
      note(r, fraction, sbri_dot(n, direction) > 0 ? sbri_scale(n, -1) : n, object);
    }
  }
}

bool sbr_world_cast_ray(const sbr_world *world, sbr_double3 from, sbf_vec3 direction, double length,
    const sbr_query_filter *filter, sbr_hit *hit) {
  sbr_query_filter used;
  sbf_vec3 unit = sbri_normalize(direction, sbri_vec3(0, 0, 0));
  const double position[4] = {from.x, from.y, from.z, length};
  if (!world || !hit || !(length > 0) || !(sbri_dot(unit, unit) > 0) || !sbri_usable(position, 4) ||
      !sbri_query_filter_of(filter, &used))
    return false;
  ray r = {.world = world,
      .from = from,
      .direction = sbri_scale(unit, (float)length),
      .filter = &used,
      .fraction = 1.000001f};
  hit_ground(&r);
  hit_colliders(&r);
  for (uint32_t i = 0; i < world->character_capacity; i++) {
    const sbri_character *c = &world->characters[i];
    if (!c->model) continue;
    hit_rigid_bodies(&r, c);
    sbr_object object = sbri_no_object;
    object.character = sbri_id_of(world, c);
    for (uint32_t b = 0; b < c->model->asset->soft_bodies.count; b++) {
      const sbf_collision *collision = &c->model->asset->soft_bodies.at[b].collision;
      object.soft_body = (int32_t)b;
      if (sbri_query_accepts(&used, collision->layer, collision->mask, &object)) hit_surface(&r, c, &object);
    }
  }
  *hit = (sbr_hit){.object = r.object, .normal = r.normal, .distance = (double)r.fraction * length};
  hit->position = (sbr_double3){from.x + (double)unit.x * hit->distance,
      from.y + (double)unit.y * hit->distance, from.z + (double)unit.z * hit->distance};
  return r.any;
}
