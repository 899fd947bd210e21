/* Objects that overlap a box or a shape: sbrun/query.h. */
#include "math/usable.h"
#include "shapes/ground.h"
#include "world/query/query_targets.h"

typedef struct reports {
  sbr_overlap_callback *call;
  void *user;
  uint32_t count;
  bool ended;
} reports;

static void report(reports *r, const sbr_object *object) {
  if (r->ended) return;
  r->count++;
  if (r->call && !r->call(r->user, object)) r->ended = true;
}

/* ---- Boxes ---- */

/* The box is in metres from `origin`. */
typedef struct box_query {
  const sbr_world *world;
  const sbr_query_filter *filter;
  sbr_double3 origin;
  sbri_box box;
  reports *reports;
} box_query;

static void report_box(
    const box_query *q, const sbri_box *bounds, uint32_t layer, uint32_t mask, const sbr_object *object) {
  if (sbri_boxes_overlap(bounds, &q->box) && sbri_query_accepts(q->filter, layer, mask, object))
    report(q->reports, object);
}

static sbri_box box_of_collider(const box_query *q, const sbri_collider *collider) {
  const sbri_collider_frame f = sbri_collider_frame_of(collider, q->origin, 1);
  const sbri_box *own = &collider->shape->bounds;
  sbri_box box = {{0, 0, 0}, {0, 0, 0}};
  for (int i = 0; i < 8; i++) {
    sbf_vec3 corner = {
        i & 1 ? own->high.x : own->low.x, i & 2 ? own->high.y : own->low.y, i & 4 ? own->high.z : own->low.z};
    sbf_vec3 x = sbri_add(f.to, sbri_rotate(collider->rotation_to, corner));
    box = i ? sbri_box_with(box, x) : sbri_box_of_point(x);
  }
  return box;
}

static sbf_vec3 position_of(const sbri_point *p) {
  return sbri_vec3(p->x, p->y, p->z);
}

static sbri_box placed(const box_query *q, const sbri_character *c, sbri_box box) {
  sbr_double3 o = sbri_header(c)->origin;
  sbf_vec3 off = {(float)(o.x - q->origin.x), (float)(o.y - q->origin.y), (float)(o.z - q->origin.z)};
  return (sbri_box){
      sbri_add(off, sbri_scale(box.low, c->scale)), sbri_add(off, sbri_scale(box.high, c->scale))};
}

static void report_character(const box_query *q, const sbri_character *c) {
  sbr_object object = sbri_no_object;
  object.character = sbri_id_of(q->world, c);
  for (uint32_t b = 0; b < c->model->rigid.body_count; b++) {
    const sbri_rigid_body *body = &c->model->rigid.bodies[b];
    if (!body->vertex_count) continue;
    sbr_transform pose = sbri_query_rigid_pose(c, b);
    sbri_box box = sbri_box_of_point(sbri_add(pose.position, sbri_rotate(pose.rotation, body->vertices[0])));
    for (uint32_t v = 1; v < body->vertex_count; v++)
      box = sbri_box_with(box, sbri_add(pose.position, sbri_rotate(pose.rotation, body->vertices[v])));
    box = placed(q, c, box);
    object.rigid_body = (int32_t)b;
    report_box(q, &box, body->source->layer, body->source->mask, &object);
  }
  object.rigid_body = -1;
  for (uint32_t b = 0; b < c->model->asset->soft_bodies.count; b++) {
    const sbri_body *body = &c->model->bodies[b];
    if (!body->level || body->slots.begin == body->slots.real_end) continue;
    const sbri_point *points = sbri_positions(c) + c->model->islands[body->island].first_slot;
    sbri_box box = sbri_box_of_point(position_of(&points[body->slots.begin]));
    for (uint32_t slot = body->slots.begin; slot < body->slots.real_end; slot++)
      box = sbri_box_with(box, position_of(&points[slot]));
    box = placed(q, c, box);
    object.soft_body = (int32_t)b;
    report_box(q, &box, body->source->collision.layer, body->source->collision.mask, &object);
  }
}

/* A triangle of the ground overlaps the box by its bounds; a box wholly below it is inside. */
static bool test_ground(void *context, const sbri_query_piece *piece) {
  bool *sees = context;
  *sees = piece->kind == SBRI_PIECE_CONVEX;
  return !*sees;
}

static bool reaches_ground(const box_query *q) {
  double level, x = q->origin.x, z = q->origin.z, low = q->origin.y + (double)q->box.low.y;
  if (sbri_ground_is_flat(&q->world->ground, &level)) return low <= level;
  if (low <= sbri_ground_height(&q->world->ground, x, z, NULL)) return true;
  sbri_query_space space = {.world = q->world, .filter = q->filter, .origin = q->origin, .box = q->box};
  bool sees = false;
  sbri_query_visit_ground(&space, test_ground, &sees);
  return sees;
}

uint32_t sbr_world_overlap_aabb(const sbr_world *world, sbr_double3 low, sbr_double3 high,
    const sbr_query_filter *filter, sbr_overlap_callback *call, void *user) {
  sbr_query_filter used;
  const double numbers[6] = {low.x, low.y, low.z, high.x, high.y, high.z};
  if (!world || !sbri_usable(numbers, 6) || !(low.x <= high.x && low.y <= high.y && low.z <= high.z) ||
      !sbri_query_filter_of(filter, &used))
    return 0;
  sbr_double3 origin = {0.5 * (low.x + high.x), 0.5 * (low.y + high.y), 0.5 * (low.z + high.z)};
  sbf_vec3 half = {(float)(high.x - origin.x), (float)(high.y - origin.y), (float)(high.z - origin.z)};
  reports to = {.call = call, .user = user};
  box_query q = {world, &used, origin, {sbri_scale(half, -1), half}, &to};
  const sbri_collider_set *set = &world->colliders;
  for (uint32_t i = 0; i < set->capacity && !to.ended; i++) {
    if (!set->at[i].shape) continue;
    sbri_box box = box_of_collider(&q, &set->at[i]);
    sbr_object object = sbri_no_object;
    object.collider = sbri_collider_name(set, i);
    report_box(&q, &box, set->at[i].layer, set->at[i].mask, &object);
  }
  for (uint32_t i = 0; i < world->character_capacity && !to.ended; i++)
    if (world->characters[i].model) report_character(&q, &world->characters[i]);
  if (!to.ended && sbri_query_sees_ground(world, &used) && reaches_ground(&q)) report(&to, &sbri_no_object);
  return to.count;
}

/* ---- Shapes ---- */

typedef struct shape_query {
  sbri_convex shape;
  reports *reports;
  bool found; /* the ground */
} shape_query;

static double depth_at_plane(const shape_query *q, const sbri_query_piece *piece) {
  double min = INFINITY;
  for (uint32_t i = 0; i < q->shape.count; i++) {
    sbfi_d3 off = sbfi_d3_sub(sbri_convex_point(&q->shape, i), piece->convex.position);
    double height = sbfi_d3_dot(piece->normal, off);
    if (height < min) min = height; /* gcc 12.2 for aarch64 crashes on fmin here */
  }
  return min - q->shape.radius;
}

static bool overlaps(const shape_query *q, const sbri_query_piece *piece) {
  const sbfi_d3 here = {0, 0, 0};
  sbfi_d3 normal;
  if (piece->kind == SBRI_PIECE_PLANE) return depth_at_plane(q, piece) <= 0;
  if (piece->kind == SBRI_PIECE_HOST)
    return sbri_query_host_distance(piece, &q->shape, here, 1, &normal) <= 0;
  if (piece->kind == SBRI_PIECE_INSIDE) return sbri_query_is_inside(piece, &q->shape);
  return sbri_convex_distance(&q->shape, here, &piece->convex).distance <= 0;
}

static bool report_piece(void *context, const sbri_query_piece *piece) {
  shape_query *q = context;
  if (!overlaps(q, piece)) return true;
  report(q->reports, piece->object);
  return false;
}

static bool find_ground(void *context, const sbri_query_piece *piece) {
  shape_query *q = context;
  q->found = overlaps(q, piece);
  return !q->found;
}

static bool is_below_ground(const shape_query *q, const sbri_query_space *space) {
  sbfi_d3 x = sbri_convex_point(&q->shape, 0);
  double y = sbri_ground_height(&space->world->ground, space->origin.x + x.x, space->origin.z + x.z, NULL);
  return space->origin.y + x.y < y;
}

uint32_t sbr_world_overlap_shape(const sbr_world *world, const sbr_shape *shape, sbr_double3 position,
    sbf_quat rotation, const sbr_query_filter *filter, sbr_overlap_callback *call, void *user) {
  sbr_query_filter used;
  sbf_vec3 ends[2];
  reports to = {.call = call, .user = user};
  shape_query q = {.reports = &to};
  const double numbers[7] = {position.x, position.y, position.z, (double)rotation.x, (double)rotation.y,
      (double)rotation.z, (double)rotation.w};
  if (!world || !shape || !sbri_usable(numbers, 7) || !sbri_query_filter_of(filter, &used) ||
      !sbri_query_convex_of(shape, rotation, &q.shape, ends))
    return 0;
  sbri_query_space space = {
      .world = world, .filter = &used, .origin = position, .box = sbri_convex_bounds(&q.shape)};
  sbri_query_visit(&space, report_piece, &q);
  if (to.ended || !sbri_query_sees_ground(world, &used)) return to.count;
  q.found = is_below_ground(&q, &space);
  if (!q.found) sbri_query_visit_ground(&space, find_ground, &q);
  if (q.found) report(&to, &sbri_no_object);
  return to.count;
}
