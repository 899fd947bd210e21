/* The moving bodies near a character: a query with its bounds as a box finds them, and each of their shapes
 * (physics_shapes.c) is mirrored as a collider of the runtime, which its threads then meet without asking
 * Godot. What these are pushed with goes to the bodies. What stands still is ground (physics_ground.c). */
#include <math.h>
#include <stdlib.h>

#include "soft_character.h"

enum {
  MOST = 64,   /* shapes at once */
  KEPT = 30,   /* frames for which one is kept that is no longer near */
  AGAIN = 4,   /* frames between two looks around */
  FORGET = 64, /* frames after which what stood still is looked at again */
  QUERIES = 8, /* most of them in a look: a mesh that stands still may fill one by itself */
  MODE_RIGID = 2,
  MODE_RIGID_LINEAR = 3,
  PARAM_BOUNCE = 0,
  PARAM_FRICTION = 1,
  PARAM_MASS = 2,
  STATE_TRANSFORM = 0,
  STATE_LINEAR_VELOCITY = 1,
  STATE_ANGULAR_VELOCITY = 2
};
typedef struct mirrored {
  uint64_t body;      /* RID; 0: free */
  int64_t index;      /* of its shapes */
  gd_variant handle;  /* the RID as a value */
  uint64_t object;    /* instance id of the node */
  sbr_shape *shape;   /* NULL: of a kind that has none here */
  sbr_collider_id id; /* in the character's world */
  sbf_vec3 arm;       /* from the body's origin to the shape's, where it was last moved to */
  uint32_t seen;      /* frame it was last near */
} mirrored;

struct physics_bodies {
  mirrored each[MOST];
  uint32_t frame;
  gd_variant query, box; /* PhysicsShapeQueryParameters3D and its BoxShape3D */
  gd_variant still;      /* RIDs that queries leave out: they do not move */
};

physics_bodies *physics_bodies_make(void) {
  physics_bodies *made = calloc(1, sizeof *made);
  if (!made) return NULL;
  made->query = gd_new("PhysicsShapeQueryParameters3D");
  made->box = gd_new("BoxShape3D");
  made->still = gd_empty(GDEXTENSION_VARIANT_TYPE_ARRAY);
  GD_DO(&made->query, "set_shape", gd_copy(&made->box));
  return made;
}

static void drop(mirrored *one, sbr_world *world) {
  if (world) sbr_collider_destroy(world, one->id);
  sbr_shape_destroy(one->shape);
  gd_free(&one->handle);
  *one = (mirrored){0};
}

void physics_bodies_free(physics_bodies *bodies, sbr_world *world) {
  if (!bodies) return;
  for (uint32_t i = 0; i < MOST; i++)
    if (bodies->each[i].body) drop(&bodies->each[i], world);
  gd_free(&bodies->query);
  gd_free(&bodies->box);
  gd_free(&bodies->still);
  free(bodies);
}

gd_variant physics_bodies_handles(const physics_bodies *bodies) {
  gd_variant array = gd_empty(GDEXTENSION_VARIANT_TYPE_ARRAY);
  for (uint32_t i = 0; i < MOST; i++)
    if (bodies->each[i].body) GD_DO(&array, "push_back", gd_copy(&bodies->each[i].handle));
  return array;
}

gd_variant physics_bodies_object(const physics_bodies *bodies, sbr_collider_id collider) {
  for (uint32_t i = 0; collider.value && i < MOST; i++)
    if (bodies->each[i].id.value == collider.value)
      return gd_object(gd.object_get_instance_from_id(bodies->each[i].object));
  return gd_object(NULL);
}

/* ---- Where they are ---- */

static sbf_quat quat_of(float m[3][3]) {
  float t = m[0][0] + m[1][1] + m[2][2];
  sbf_quat q;
  if (t > 0) {
    float s = 2 * sqrtf(t + 1);
    q = (sbf_quat){(m[2][1] - m[1][2]) / s, (m[0][2] - m[2][0]) / s, (m[1][0] - m[0][1]) / s, s / 4};
  } else if (m[0][0] > m[1][1] && m[0][0] > m[2][2]) {
    float s = 2 * sqrtf(1 + m[0][0] - m[1][1] - m[2][2]);
    q = (sbf_quat){s / 4, (m[0][1] + m[1][0]) / s, (m[0][2] + m[2][0]) / s, (m[2][1] - m[1][2]) / s};
  } else if (m[1][1] > m[2][2]) {
    float s = 2 * sqrtf(1 + m[1][1] - m[0][0] - m[2][2]);
    q = (sbf_quat){(m[0][1] + m[1][0]) / s, s / 4, (m[1][2] + m[2][1]) / s, (m[0][2] - m[2][0]) / s};
  } else {
    float s = 2 * sqrtf(1 + m[2][2] - m[0][0] - m[1][1]);
    q = (sbf_quat){(m[0][2] + m[2][0]) / s, (m[1][2] + m[2][1]) / s, s / 4, (m[1][0] - m[0][1]) / s};
  }
  return q;
}

static gd_transform place_of(const gd_variant *server, mirrored *one) {
  gd_variant body = GD_CALL(server, "body_get_state", gd_copy(&one->handle), gd_int(STATE_TRANSFORM));
  gd_variant inner = GD_CALL(server, "body_get_shape_transform", gd_copy(&one->handle), gd_int(one->index));
  gd_transform a = gd_as_transform(&body), b = gd_as_transform(&inner), made;
  for (int i = 0; i < 3; i++)
    for (int j = 0; j < 3; j++)
      made.basis[i][j] =
          a.basis[i][0] * b.basis[0][j] + a.basis[i][1] * b.basis[1][j] + a.basis[i][2] * b.basis[2][j];
  sbf_vec3 o = b.origin;
  sbf_vec3 arm = {a.basis[0][0] * o.x + a.basis[0][1] * o.y + a.basis[0][2] * o.z,
      a.basis[1][0] * o.x + a.basis[1][1] * o.y + a.basis[1][2] * o.z,
      a.basis[2][0] * o.x + a.basis[2][1] * o.y + a.basis[2][2] * o.z};
  one->arm = arm;
  made.origin = (sbf_vec3){a.origin.x + arm.x, a.origin.y + arm.y, a.origin.z + arm.z};
  gd_free(&body);
  gd_free(&inner);
  return made;
}

/* Frozen ones are not. */
static bool is_rigid(const gd_variant *server, const gd_variant *handle) {
  int64_t mode = gd_take_int(GD_CALL(server, "body_get_mode", gd_copy(handle)));
  return mode == MODE_RIGID || mode == MODE_RIGID_LINEAR;
}

static sbf_vec3 velocity_of(const gd_variant *server, const mirrored *at, int64_t which) {
  return gd_take_vector3(GD_CALL(server, "body_get_state", gd_copy(&at->handle), gd_int(which)));
}

/* To where the body will be after the physics step that follows, if nothing changes its velocity; what is not
 * rigid moves by itself, and stays where it is. */
static void move(sbr_world *world, const gd_variant *server, mirrored *at, float frame_s) {
  gd_transform now = place_of(server, at);
  sbf_vec3 o = now.origin;
  sbf_quat q = quat_of(now.basis);
  if (is_rigid(server, &at->handle)) {
    sbf_vec3 v = velocity_of(server, at, STATE_LINEAR_VELOCITY),
             w = velocity_of(server, at, STATE_ANGULAR_VELOCITY), a = at->arm;
    v = (sbf_vec3){v.x + w.y * a.z - w.z * a.y, v.y + w.z * a.x - w.x * a.z, v.z + w.x * a.y - w.y * a.x};
    o = (sbf_vec3){o.x + frame_s * v.x, o.y + frame_s * v.y, o.z + frame_s * v.z};
    float h = 0.5f * frame_s; /* q + h w q, which the runtime makes a unit again */
    q = (sbf_quat){q.x + h * (w.x * q.w + w.y * q.z - w.z * q.y),
        q.y + h * (w.y * q.w + w.z * q.x - w.x * q.z), q.z + h * (w.z * q.w + w.x * q.y - w.y * q.x),
        q.w - h * (w.x * q.x + w.y * q.y + w.z * q.z)};
  }
  sbr_collider_move(world, at->id, (sbr_double3){o.x, o.y, o.z}, q);
}

static void meet(soft_character *one, const gd_variant *server, const gd_variant *hit) {
  physics_bodies *bodies = one->bodies;
  gd_variant handle = gd_key(hit, "rid"), object = gd_key(hit, "collider");
  uint64_t body = gd_as_rid(&handle);
  int64_t index = gd_take_int(gd_key(hit, "shape"));
  bool moves = is_rigid(server, &handle);
  if (!moves && gd_as_object(&object)) /* a frozen body's mode says nothing of what it is */
    moves = gd_take_bool(GD_CALL(&object, "is_class", gd_string("CharacterBody3D"))) ||
            gd_take_bool(GD_CALL(&object, "is_class", gd_string("RigidBody3D")));
  mirrored *room = NULL, *known = NULL;
  for (uint32_t i = 0; i < MOST; i++) {
    mirrored *at = &bodies->each[i];
    if (at->body == body && at->index == index && body) known = at;
    if (!at->body && !room) room = at;
  }
  if (known) known->seen = bodies->frame;
  if (!known && moves && room && body) {
    *room = (mirrored){.body = body,
        .index = index,
        .handle = gd_copy(&handle),
        .object = gd.variant_get_object_instance_id(&object),
        .seen = bodies->frame};
    room->shape = physics_shape_of(server, &handle, index, &object);
    gd_transform at = place_of(server, room);
    sbr_collider_definition made = sbr_default_collider_definition();
    made.shape = room->shape;
    made.position = (sbr_double3){at.origin.x, at.origin.y, at.origin.z};
    made.rotation = quat_of(at.basis);
    made.friction =
        (float)gd_take_float(GD_CALL(server, "body_get_param", gd_copy(&handle), gd_int(PARAM_FRICTION)));
    made.restitution =
        (float)gd_take_float(GD_CALL(server, "body_get_param", gd_copy(&handle), gd_int(PARAM_BOUNCE)));
    if (room->shape) sbr_collider_create(one->world, &made, &room->id, NULL);
  }
  if (!known && !moves && body) GD_DO(&bodies->still, "push_back", gd_copy(&handle));
  gd_free(&handle);
  gd_free(&object);
}

/* What the query finds, and what it found no room for. */
static void ask(soft_character *one, const gd_variant *space, const gd_variant *server) {
  physics_bodies *bodies = one->bodies;
  int64_t count = MOST;
  for (int i = 0; i < QUERIES && count == MOST; i++) {
    GD_DO(&bodies->query, "set_exclude", gd_copy(&bodies->still));
    gd_variant hits = GD_CALL(space, "intersect_shape", gd_copy(&bodies->query), gd_int(MOST));
    count = gd_size(&hits);
    for (int64_t k = 0; k < count; k++) {
      gd_variant hit = gd_at(&hits, k);
      meet(one, server, &hit);
      gd_free(&hit);
    }
    gd_free(&hits);
  }
}

/* The bodies in a box about the character. */
static void look_around(soft_character *one) {
  physics_bodies *bodies = one->bodies;
  gd_variant world = GD_CALL(&one->node, "get_world_3d");
  gd_variant space = gd_as_object(&world) ? GD_CALL(&world, "get_direct_space_state") : gd_nil();
  if (gd_as_object(&space)) {
    float wide = fmaxf(fmaxf(one->high.x, -one->low.x), fmaxf(one->high.z, -one->low.z)) * one->scale;
    float tall = (one->high.y - one->low.y) * one->scale;
    gd_variant server = gd_singleton("PhysicsServer3D");
    gd_transform at = {{{1, 0, 0}, {0, 1, 0}, {0, 0, 1}}, one->put.origin};
    at.origin.y += (one->low.y + one->high.y) / 2 * one->scale;
    GD_DO(&bodies->box, "set_size", gd_vector3((sbf_vec3){4 * wide, 2 * tall + 2 * wide, 4 * wide}));
    GD_DO(&bodies->query, "set_transform", gd_transform_value(at));
    GD_DO(&bodies->query, "set_collision_mask", gd_int(one->settings.collision_mask));
    if (bodies->frame % FORGET < AGAIN) gd_assign(&bodies->still, gd_empty(GDEXTENSION_VARIANT_TYPE_ARRAY));
    ask(one, &space, &server);
    gd_free(&server);
  }
  gd_free(&space);
  gd_free(&world);
}

void physics_bodies_look(soft_character *one, bool now) {
  physics_bodies *bodies = one->bodies;
  if (bodies->frame % AGAIN == 0 || now) look_around(one);
}

void physics_bodies_move(physics_bodies *bodies, sbr_world *world, float frame_s) {
  gd_variant server = gd_nil();
  bodies->frame++;
  for (uint32_t i = 0; i < MOST; i++) {
    mirrored *at = &bodies->each[i];
    if (!at->body) continue;
    if (bodies->frame - at->seen > KEPT || !gd.object_get_instance_from_id(at->object)) {
      drop(at, world);
      continue;
    }
    if (!at->id.value) continue;
    if (!gd_as_object(&server)) gd_assign(&server, gd_singleton("PhysicsServer3D"));
    move(world, &server, at, frame_s);
  }
  gd_free(&server);
}

static float length(sbf_vec3 v) {
  return sqrtf(v.x * v.x + v.y * v.y + v.z * v.z);
}

/* No more at once than makes the body so much faster: one far lighter than what pushes it would be shot away,
 * as what pushes takes it for something that does not give way within the frame. */
static float share_of(const gd_variant *server, const mirrored *at, sbf_vec3 impulse, float limit) {
  float mass =
      (float)gd_take_float(GD_CALL(server, "body_get_param", gd_copy(&at->handle), gd_int(PARAM_MASS)));
  float size = length(impulse), most = limit * mass;
  return limit > 0 && size > most ? most / size : 1;
}

void physics_bodies_push(physics_bodies *bodies, sbr_world *world, const soft_settings *settings) {
  gd_variant server = gd_nil();
  for (uint32_t i = 0; i < MOST; i++) {
    mirrored *at = &bodies->each[i];
    if (!at->id.value) continue;
    sbr_collider_push push = sbr_collider_take_push(world, at->id);
    sbf_vec3 j = push.impulse, m = push.moment;
    if (!settings->push_bodies || (length(j) == 0 && length(m) == 0)) continue;
    if (!gd_as_object(&server)) gd_assign(&server, gd_singleton("PhysicsServer3D"));
    if (!gd.object_get_instance_from_id(at->object) || !is_rigid(&server, &at->handle)) continue;
    float k = share_of(&server, at, j, (float)settings->push_limit);
    GD_DO(&server, "body_apply_impulse", gd_copy(&at->handle),
        gd_vector3((sbf_vec3){k * j.x, k * j.y, k * j.z}), gd_vector3(at->arm));
    GD_DO(&server, "body_apply_torque_impulse", gd_copy(&at->handle),
        gd_vector3((sbf_vec3){k * m.x, k * m.y, k * m.z}));
  }
  gd_free(&server);
}
