#include "physics_parts.h"

#include <stdlib.h>
#include <string.h>

#include "part_shapes.h"
#include "turns.h"

enum { MODE_KINEMATIC = 1, STATE_TRANSFORM = 0, PICKED_LAYER = 31 };

typedef struct body_part {
  part_owner owner;
  bool follows_surface;
  sbf_vec3 middle;   /* of its surface at rest */
  sbf_quat rotation; /* of its surface, last fitted */
  gd_variant shape;  /* RID */
  gd_transform last; /* in the body */
} body_part;

struct physics_parts {
  gd_variant server, body, area; /* body: RID; area: an Area3D that picking finds, nil: none */
  body_part *each;
  uint32_t count;
  sbr_transform *bones; /* capacity for all of the asset */
  sbf_vec3 *surface;    /* capacity for the largest */
  gd_transform last;    /* of the body */
  bool placed;
};

static const gd_transform UNIT = {{{1, 0, 0}, {0, 1, 0}, {0, 0, 1}}, {0, 0, 0}};

static void make_shape(physics_parts *parts, const part_shape *from) {
  body_part *part = &parts->each[parts->count++];
  gd_variant points = gd_packed(GDEXTENSION_VARIANT_TYPE_PACKED_VECTOR3_ARRAY, PART_POINTS);
  *part = (body_part){.owner = {from->bone, from->soft_body},
      .follows_surface = from->follows_surface,
      .middle = from->middle,
      .rotation = {0, 0, 0, 1},
      .shape = GD_CALL(&parts->server, "convex_polygon_shape_create"),
      .last = UNIT};
  memcpy(gd_vector3s(&points), from->hull, sizeof from->hull);
  GD_DO(&parts->server, "shape_set_data", gd_copy(&part->shape), points);
  GD_DO(&parts->server, "body_add_shape", gd_copy(&parts->body), gd_copy(&part->shape),
      gd_transform_value(UNIT));
}

static uint32_t largest_surface(const sbf_asset *asset) {
  uint32_t max = 0;
  for (uint32_t i = 0; i < asset->soft_bodies.count; i++)
    if (asset->soft_bodies.at[i].surface.positions.count > max)
      max = asset->soft_bodies.at[i].surface.positions.count;
  return max;
}

/* Bodies that carry the character by their own script pass through it. */
static void except_ancestors(physics_parts *parts, const gd_variant *node) {
  gd_variant above = GD_CALL(node, "get_parent");
  while (gd_as_object(&above)) {
    if (gd_take_bool(GD_CALL(&above, "is_class", gd_string("CharacterBody3D")))) {
      gd_variant rid = GD_CALL(&above, "get_rid");
      physics_parts_except(parts, &rid, true);
      gd_free(&rid);
    }
    gd_assign(&above, GD_CALL(&above, "get_parent"));
  }
  gd_free(&above);
}

physics_parts *physics_parts_make(const soft_character *one) {
  const sbf_asset *asset = one->model->asset;
  uint32_t count = 0;
  part_shape *shapes = one->settings.collision.collision_layer
                           ? part_shapes_make(asset, one->scale, one->settings.simulation.free_bodies, &count)
                           : NULL;
  physics_parts *made = shapes ? calloc(1, sizeof *made) : NULL;
  if (!made) return free(shapes), NULL;
  made->each = malloc(count * sizeof *made->each);
  made->bones = malloc((asset->bones.count + 1) * sizeof *made->bones);
  made->surface = malloc((largest_surface(asset) + 1) * sizeof *made->surface);
  made->server = gd_singleton("PhysicsServer3D");
  made->body = GD_CALL(&made->server, "body_create");
  made->area = gd_nil();
  if (!made->each || !made->bones || !made->surface) {
    gd_error("no memory for a character's parts in the physics space");
    free(shapes);
    physics_parts_free(made);
    return NULL;
  }
  GD_DO(&made->server, "body_set_mode", gd_copy(&made->body), gd_int(MODE_KINEMATIC));
  GD_DO(&made->server, "body_attach_object_instance_id", gd_copy(&made->body),
      gd_int((int64_t)gd.object_get_instance_id(gd_as_object(&one->node))));
  GD_DO(&made->server, "body_set_ray_pickable", gd_copy(&made->body), gd_bool(false));
  GD_DO(&made->server, "body_set_collision_mask", gd_copy(&made->body), gd_int(0));
  for (uint32_t i = 0; i < count; i++) make_shape(made, &shapes[i]);
  free(shapes);
  except_ancestors(made, &one->node);
  physics_parts_apply_settings(made, one);
  return made;
}

void physics_parts_free(physics_parts *parts) {
  if (!parts) return;
  if (gd_as_object(&parts->area)) GD_DO(&parts->area, "queue_free");
  GD_DO(&parts->server, "free_rid", gd_copy(&parts->body));
  for (uint32_t i = 0; i < parts->count; i++) {
    GD_DO(&parts->server, "free_rid", gd_copy(&parts->each[i].shape));
    gd_free(&parts->each[i].shape);
  }
  gd_free(&parts->area);
  gd_free(&parts->body);
  gd_free(&parts->server);
  free(parts->each);
  free(parts->bones);
  free(parts->surface);
  free(parts);
}

/* ---- Picking ---- */

/* Godot's viewports pick nodes of collision objects alone, so an area with the same shapes stands in for the
 * character. It is on layer 32. */
static void make_area(physics_parts *parts, const soft_character *one) {
  static const char *const reports[][2] = {
      {"input_event", "_picked"}, {"mouse_entered", "_mouse_entered"}, {"mouse_exited", "_mouse_exited"}};
  gd_assign(&parts->area, gd_new("Area3D"));
  GD_DO(&parts->area, "set_name", gd_string("Picked"));
  GD_DO(&parts->area, "set_as_top_level", gd_bool(true));
  GD_DO(&parts->area, "set_monitoring", gd_bool(false));
  GD_DO(&parts->area, "set_monitorable", gd_bool(false));
  GD_DO(&parts->area, "set_collision_mask", gd_int(0));
  GD_DO(&parts->area, "set_collision_layer", gd_int((int64_t)1 << PICKED_LAYER));
  for (int i = 0; i < 3; i++)
    GD_DO(&parts->area, "connect", gd_name(reports[i][0]), soft_character_callable(one, reports[i][1]));
  gd_variant area = GD_CALL(&parts->area, "get_rid");
  for (uint32_t i = 0; i < parts->count; i++)
    GD_DO(&parts->server, "area_add_shape", gd_copy(&area), gd_copy(&parts->each[i].shape),
        gd_transform_value(parts->each[i].last));
  gd_free(&area);
  GD_DO(&one->node, "add_child", gd_copy(&parts->area), gd_bool(false), gd_int(1)); /* INTERNAL_MODE_FRONT */
  GD_DO(&parts->area, "set_global_transform", gd_transform_value(parts->last));
}

void physics_parts_apply_settings(physics_parts *parts, const soft_character *one) {
  if (!parts) return;
  GD_DO(&parts->server, "body_set_collision_layer", gd_copy(&parts->body),
      gd_int(one->settings.collision.collision_layer & UINT32_MAX));
  bool picked = gd_as_object(&parts->area) != NULL;
  if (one->settings.collision.input_ray_pickable && !picked && parts->placed) make_area(parts, one);
  if (one->settings.collision.input_ray_pickable || !picked) return;
  GD_DO(&parts->area, "queue_free");
  gd_assign(&parts->area, gd_nil());
}

/* ---- A frame ---- */

/* Frame of the part, relative to the character's origin; false where it cannot be read. */
static bool frame_of(physics_parts *parts, const soft_character *one, body_part *part, gd_transform *frame) {
  if (!part->follows_surface) {
    sbr_transform bone = parts->bones[part->owner.bone];
    *frame = placed_at(bone.rotation, bone.position);
    return true;
  }
  const sbf_vec3_list *rest = &one->model->asset->soft_bodies.at[part->owner.soft_body].surface.positions;
  uint32_t count = sbr_character_get_surface(
      one->world, one->id, (uint32_t)part->owner.soft_body, parts->surface, rest->count);
  if (count != rest->count) return false;
  double x = 0, y = 0, z = 0;
  for (uint32_t i = 0; i < count; i++) {
    sbf_vec3 p = parts->surface[i];
    x += (double)p.x, y += (double)p.y, z += (double)p.z;
  }
  sbf_vec3 center = {(float)(x / count), (float)(y / count), (float)(z / count)};
  part->rotation = part_rotation(rest->at, part->middle, parts->surface, center, count, part->rotation);
  *frame = placed_at(part->rotation, center);
  return true;
}

static void enter(physics_parts *parts, const soft_character *one) {
  gd_variant world = GD_CALL(&one->node, "get_world_3d");
  if (gd_as_object(&world))
    GD_DO(&parts->server, "body_set_space", gd_copy(&parts->body), GD_CALL(&world, "get_space"));
  gd_free(&world);
  parts->placed = true;
  physics_parts_apply_settings(parts, one);
}

void physics_parts_move(physics_parts *parts, const soft_character *one) {
  if (!parts) return;
  sbr_double3 origin = sbr_character_get_origin(one->world, one->id);
  sbr_character_get_bones(one->world, one->id, parts->bones, one->model->asset->bones.count);
  gd_transform at = upright(one->placement.shown_at.origin, transform_heading(&one->placement.shown_at), 1);
  gd_transform back = upright((sbf_vec3){0, 0, 0}, -transform_heading(&one->placement.shown_at), 1), frame;
  gd_variant area = gd_as_object(&parts->area) ? GD_CALL(&parts->area, "get_rid") : gd_nil();
  bool has_area = gd_as_object(&parts->area) != NULL;
  if (memcmp(&at, &parts->last, sizeof at) != 0) {
    GD_DO(&parts->server, "body_set_state", gd_copy(&parts->body), gd_int(STATE_TRANSFORM),
        gd_transform_value(at));
    if (has_area) GD_DO(&parts->area, "set_global_transform", gd_transform_value(at));
  }
  parts->last = at;
  for (uint32_t i = 0; i < parts->count; i++) {
    body_part *part = &parts->each[i];
    if (!frame_of(parts, one, part, &frame)) continue;
    sbf_vec3 o = frame.origin;
    frame.origin = (sbf_vec3){(float)(origin.x - (double)at.origin.x) + o.x,
        (float)(origin.y - (double)at.origin.y) + o.y, (float)(origin.z - (double)at.origin.z) + o.z};
    frame = placed_in(&back, &frame);
    if (!memcmp(&frame, &part->last, sizeof frame)) continue;
    part->last = frame;
    GD_DO(&parts->server, "body_set_shape_transform", gd_copy(&parts->body), gd_int(i),
        gd_transform_value(frame));
    if (has_area)
      GD_DO(&parts->server, "area_set_shape_transform", gd_copy(&area), gd_int(i), gd_transform_value(frame));
  }
  gd_free(&area);
  if (!parts->placed) enter(parts, one);
}

/* ---- Others ---- */

void physics_parts_except(physics_parts *parts, const gd_variant *body, bool excepted) {
  if (!parts) return;
  GD_DO(&parts->server, excepted ? "body_add_collision_exception" : "body_remove_collision_exception",
      gd_copy(&parts->body), gd_copy(body));
}

part_owner physics_parts_owner(const physics_parts *parts, int64_t shape) {
  if (!parts || shape < 0 || shape >= parts->count) return (part_owner){-1, -1};
  return parts->each[shape].owner;
}

gd_variant physics_parts_rid(const physics_parts *parts) {
  return parts ? gd_copy(&parts->body) : gd_empty(GDEXTENSION_VARIANT_TYPE_RID);
}
