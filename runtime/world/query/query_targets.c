#include "world/query/query_targets.h"

#include "coupling/ragdoll/ragdoll.h"
#include "math/quat.h"
#include "shapes/ground.h"

enum { FILTER_COOKIE = 0x5b727166, MAX_CELLS = 32 };
/* m, between samples of the ground. */
static const double SPACING_M = 0.05;

/* ---- Filters ---- */

sbr_query_filter sbr_default_query_filter(void) {
  return (sbr_query_filter){.cookie = FILTER_COOKIE, .layer = UINT32_MAX, .mask = UINT32_MAX};
}

bool sbri_query_filter_of(const sbr_query_filter *given, sbr_query_filter *filter) {
  *filter = given ? *given : sbr_default_query_filter();
  return filter->cookie == FILTER_COOKIE;
}

bool sbri_query_accepts(
    const sbr_query_filter *filter, uint32_t layer, uint32_t mask, const sbr_object *object) {
  return sbri_layers_collide(layer, mask, filter->layer, filter->mask) &&
         (!filter->accept || filter->accept(filter->user, object));
}

bool sbri_query_sees_ground(const sbr_world *world, const sbr_query_filter *filter) {
  return world->ground.height && sbri_query_accepts(filter, 1, UINT32_MAX, &sbri_no_object);
}

/* ---- Bodies ---- */

sbr_transform sbri_query_rigid_pose(const sbri_character *c, uint32_t rigid_body) {
  return sbri_rigid_drive(c)->any_dynamic ? sbri_rigid_bodies(c)[rigid_body].pose
                                          : sbri_rigid_target(c, sbri_pose(c), rigid_body);
}

const sbri_point *sbri_query_surface(const sbri_character *c, uint32_t soft_body, sbri_skin *surface) {
  const sbri_body *body = &c->model->bodies[soft_body];
  sbri_point *vertices = sbri_surface_vertices(c) + body->surface.first_vertex;
  *surface = sbri_skin_now(c, &body->surface.skin);
  sbri_skin_compute_vertices(c->model, surface, sbri_positions(c), sbri_deltas(c), vertices);
  return vertices;
}

/* ---- Convex shapes ---- */

bool sbri_query_convex_of(const sbr_shape *shape, sbf_quat rotation, sbri_convex *convex, sbf_vec3 ends[2]) {
  *convex = (sbri_convex){.points = ends, .count = 1, .radius = (double)shape->radius};
  ends[0] = ends[1] = sbri_vec3(0, 0, 0);
  switch (shape->kind) {
  case SBR_SHAPE_SPHERE:
    break;
  case SBR_SHAPE_CAPSULE:
    ends[0].y = -shape->half_sizes.y, ends[1].y = shape->half_sizes.y;
    convex->count = 2;
    break;
  case SBR_SHAPE_BOX:
  case SBR_SHAPE_HULL:
    convex->points = shape->hull.vertices, convex->count = shape->hull.vertex_count, convex->radius = 0;
    break;
  default:
    return false;
  }
  sbri_convex_set_frame(convex, (sbfi_d3){0, 0, 0}, sbri_quat_normalize(rotation), 1);
  return true;
}

sbri_box sbri_convex_bounds(const sbri_convex *convex) {
  sbri_box box = sbri_box_of_point(sbfi_d3_rounded(sbri_convex_point(convex, 0)));
  for (uint32_t i = 1; i < convex->count; i++)
    box = sbri_box_with(box, sbfi_d3_rounded(sbri_convex_point(convex, i)));
  return sbri_box_grown(box, (float)convex->radius + 1e-4f);
}

/* A point in the frame of a piece's shape. */
static sbf_vec3 in_frame(const sbri_convex *frame, sbfi_d3 x) {
  sbfi_d3 off = sbfi_d3_sub(x, frame->position);
  return sbri_vec3((float)sbfi_d3_dot(frame->axes[0], off), (float)sbfi_d3_dot(frame->axes[1], off),
      (float)sbfi_d3_dot(frame->axes[2], off));
}

bool sbri_query_is_inside(const sbri_query_piece *piece, const sbri_convex *convex) {
  const sbri_box *bounds = &piece->shape->bounds;
  sbri_nearest found;
  return sbri_shape_nearest(piece->shape, in_frame(&piece->convex, sbri_convex_point(convex, 0)), 0,
             sbri_length(sbri_sub(bounds->high, bounds->low)), &found) &&
         found.gap < 0;
}

double sbri_query_host_distance(
    const sbri_query_piece *piece, const sbri_convex *convex, sbfi_d3 offset, double reach, sbfi_d3 *normal) {
  const sbr_host_shape *host = &piece->shape->host;
  const sbfi_d3 *axes = piece->convex.axes;
  double min = reach;
  for (uint32_t i = 0; i < convex->count; i++) {
    sbf_vec3 x = in_frame(&piece->convex, sbfi_d3_add(sbri_convex_point(convex, i), offset)), n = {0, 1, 0};
    double gap = (double)host->distance(host->user, x, (float)(min + convex->radius), &n) - convex->radius;
    if (!(gap < min)) continue;
    min = gap;
    *normal = sbfi_d3_add(sbfi_d3_scale(axes[0], (double)n.x),
        sbfi_d3_add(sbfi_d3_scale(axes[1], (double)n.y), sbfi_d3_scale(axes[2], (double)n.z)));
  }
  return min;
}

/* ---- Pieces ---- */

typedef struct visit {
  const sbri_query_space *space;
  sbri_query_visitor *call;
  void *context;
} visit;

static sbfi_d3 from_origin(const sbri_query_space *space, sbr_double3 x) {
  return (sbfi_d3){x.x - space->origin.x, x.y - space->origin.y, x.z - space->origin.z};
}

static bool visit_convex(const visit *v, const sbri_query_piece *piece) {
  sbri_box box = sbri_convex_bounds(&piece->convex);
  return !sbri_boxes_overlap(&box, &v->space->box) || v->call(v->context, piece);
}

/* `normal`: of a triangle that is solid behind it, in the frame of its points. */
static bool visit_triangle(
    const visit *v, sbri_query_piece *piece, const sbf_vec3 corners[3], const sbf_vec3 *normal) {
  const sbfi_d3 *axes = piece->convex.axes;
  piece->convex.points = corners, piece->convex.count = 3;
  piece->normal = (sbfi_d3){0, 0, 0};
  if (normal)
    piece->normal = sbfi_d3_normal(sbfi_d3_add(sbfi_d3_scale(axes[0], (double)normal->x),
        sbfi_d3_add(sbfi_d3_scale(axes[1], (double)normal->y), sbfi_d3_scale(axes[2], (double)normal->z))));
  return visit_convex(v, piece);
}

/* The query's box in the frame of a collider at the origin's distance. */
static sbri_box box_in_frame(const sbri_box *box, const sbri_convex *frame) {
  sbri_box inside = {{0, 0, 0}, {0, 0, 0}};
  for (int i = 0; i < 8; i++) {
    sbf_vec3 corner = {
        i & 1 ? box->high.x : box->low.x, i & 2 ? box->high.y : box->low.y, i & 4 ? box->high.z : box->low.z};
    sbf_vec3 x = in_frame(frame, sbfi_d3_of(corner));
    inside = i ? sbri_box_with(inside, x) : sbri_box_of_point(x);
  }
  return sbri_box_grown(inside, 1e-4f);
}

static void visit_mesh(const visit *v, const sbr_shape *shape, sbri_query_piece *piece) {
  const sbri_triangles *t = &shape->triangles;
  sbri_bounds_walk walk;
  uint32_t i;
  sbri_bounds_walk_begin(&walk, &t->tree, box_in_frame(&v->space->box, &piece->convex));
  while (sbri_bounds_walk_next(&walk, &i)) {
    const uint32_t *c = t->corners + 3 * (size_t)i;
    const sbf_vec3 corners[3] = {t->points[c[0]], t->points[c[1]], t->points[c[2]]};
    sbf_vec3 normal = sbri_triangle_normal(corners[0], corners[1], corners[2]);
    if (sbri_dot(normal, normal) > 0 && !visit_triangle(v, piece, corners, &normal)) return;
  }
  piece->kind = SBRI_PIECE_INSIDE;
  v->call(v->context, piece);
}

static void visit_collider(const visit *v, uint32_t index) {
  const sbri_collider_set *set = &v->space->world->colliders;
  const sbri_collider *c = &set->at[index];
  if (!c->shape) return;
  sbr_object object = sbri_no_object;
  object.collider = sbri_collider_name(set, index);
  sbri_query_piece piece = {.object = &object, .kind = SBRI_PIECE_CONVEX, .shape = c->shape};
  sbf_vec3 ends[2];
  if (!sbri_query_convex_of(c->shape, c->rotation_to, &piece.convex, ends)) piece.convex.radius = 0;
  sbri_convex_set_frame(&piece.convex, from_origin(v->space, c->to), c->rotation_to, 1);
  sbri_box inside = box_in_frame(&v->space->box, &piece.convex);
  if (!sbri_boxes_overlap(&inside, &c->shape->bounds)) return;
  if (!sbri_query_accepts(v->space->filter, c->layer, c->mask, &object)) return;
  switch (c->shape->kind) {
  case SBR_SHAPE_PLANE:
    piece.kind = SBRI_PIECE_PLANE, piece.normal = piece.convex.axes[1];
    v->call(v->context, &piece);
    break;
  case SBR_SHAPE_HOST:
    piece.kind = SBRI_PIECE_HOST;
    v->call(v->context, &piece);
    break;
  case SBR_SHAPE_MESH:
  case SBR_SHAPE_HEIGHT_FIELD:
    visit_mesh(v, c->shape, &piece);
    break;
  default:
    visit_convex(v, &piece);
    break;
  }
}

static void visit_rigid_bodies(const visit *v, const sbri_character *c, sbr_object object) {
  sbfi_d3 origin = from_origin(v->space, sbri_header(c)->origin);
  for (uint32_t b = 0; b < c->model->rigid.body_count; b++) {
    const sbri_rigid_body *body = &c->model->rigid.bodies[b];
    if (!body->hull.vertex_count) continue;
    object.rigid_body = (int32_t)b;
    sbr_transform pose = sbri_query_rigid_pose(c, b);
    sbri_query_piece piece = {
        .object = &object, .convex = {.points = body->hull.vertices, .count = body->hull.vertex_count}};
    sbfi_d3 at = sbfi_d3_add(origin, sbfi_d3_scale(sbfi_d3_of(pose.position), (double)c->scale));
    sbri_convex_set_frame(&piece.convex, at, pose.rotation, (double)c->scale);
    sbri_box box = sbri_convex_bounds(&piece.convex);
    if (sbri_boxes_overlap(&box, &v->space->box) &&
        sbri_query_accepts(v->space->filter, body->source->layer, body->source->mask, &object))
      v->call(v->context, &piece);
  }
}

static sbf_vec3 position_of(const sbri_point *p) {
  return sbri_vec3(p->x, p->y, p->z);
}

static void visit_surface(const visit *v, const sbri_character *c, const sbr_object *object) {
  sbri_skin surface;
  const sbri_point *vertices = sbri_query_surface(c, (uint32_t)object->soft_body, &surface);
  sbri_query_piece piece = {.object = object};
  sbri_convex_set_frame(
      &piece.convex, from_origin(v->space, sbri_header(c)->origin), (sbf_quat){0, 0, 0, 1}, (double)c->scale);
  for (uint32_t i = 0; i < surface.face_block_count * SBRI_BLOCK; i++) {
    sbf_vec3 at[4];
    for (int k = 0; k < 4; k++)
      at[k] = position_of(&vertices[surface.faces[i / SBRI_BLOCK].corners[k][i % SBRI_BLOCK]]);
    for (int k = 0; k < 2; k++) {
      const sbf_vec3 corners[3] = {at[0], at[k + 1], at[k + 2]};
      sbf_vec3 n = sbri_triangle_normal(corners[0], corners[1], corners[2]);
      if (sbri_dot(n, n) > 0 && !visit_triangle(v, &piece, corners, NULL)) return;
    }
  }
}

static void visit_character(const visit *v, const sbri_character *c) {
  sbr_object object = sbri_no_object;
  object.character = sbri_id_of(v->space->world, c);
  visit_rigid_bodies(v, c, object);
  for (uint32_t b = 0; b < c->model->asset->soft_bodies.count; b++) {
    const sbf_collision *collision = &c->model->asset->soft_bodies.at[b].collision;
    object.soft_body = (int32_t)b;
    if (sbri_query_accepts(v->space->filter, collision->layer, collision->mask, &object))
      visit_surface(v, c, &object);
  }
}

void sbri_query_visit(const sbri_query_space *space, sbri_query_visitor *call, void *context) {
  const visit v = {space, call, context};
  for (uint32_t i = 0; i < space->world->colliders.capacity; i++) visit_collider(&v, i);
  for (uint32_t i = 0; i < space->world->character_capacity; i++)
    if (space->world->characters[i].model) visit_character(&v, &space->world->characters[i]);
}

/* ---- Ground ---- */

static sbf_vec3 ground_point(const sbri_query_space *space, double x, double z) {
  double y = sbri_ground_height(&space->world->ground, space->origin.x + x, space->origin.z + z, NULL);
  return sbri_vec3((float)x, (float)(y - space->origin.y), (float)z);
}

void sbri_query_visit_ground(const sbri_query_space *space, sbri_query_visitor *call, void *context) {
  const visit v = {space, call, context};
  const sbri_box *box = &space->box;
  sbri_query_piece piece = {.object = &sbri_no_object, .normal = {0, 1, 0}};
  sbri_convex_set_frame(&piece.convex, (sbfi_d3){0, 0, 0}, (sbf_quat){0, 0, 0, 1}, 1);
  double level;
  if (sbri_ground_is_flat(&space->world->ground, &level)) {
    piece.kind = SBRI_PIECE_PLANE, piece.convex.position.y = level - space->origin.y;
    call(context, &piece);
    return;
  }
  double width = (double)box->high.x - (double)box->low.x, depth = (double)box->high.z - (double)box->low.z;
  double size = width > depth ? width : depth, spacing = size / MAX_CELLS;
  if (!(spacing > SPACING_M)) spacing = SPACING_M;
  int columns = 1 + (int)(width / spacing), rows = 1 + (int)(depth / spacing);
  for (int row = 0; row < rows; row++) {
    sbf_vec3 at[4]; /* of a cell: x and z low, z high, x high, both high */
    double z = (double)box->low.z + row * spacing;
    at[2] = ground_point(space, (double)box->low.x, z);
    at[3] = ground_point(space, (double)box->low.x, z + spacing);
    for (int column = 0; column < columns; column++) {
      double x = (double)box->low.x + (column + 1) * spacing;
      at[0] = at[2], at[1] = at[3];
      at[2] = ground_point(space, x, z), at[3] = ground_point(space, x, z + spacing);
      for (int k = 0; k < 2; k++) {
        const sbf_vec3 corners[3] = {at[k ? 2 : 0], at[1], at[k ? 3 : 2]};
        sbf_vec3 normal = sbri_triangle_normal(corners[0], corners[1], corners[2]);
        if (!visit_triangle(&v, &piece, corners, &normal)) return;
      }
    }
  }
}
