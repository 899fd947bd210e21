/* The moving bodies near a character: a query with its bounds as a box finds them, and each of their shapes
 * (physics_shapes.c) is mirrored as a collider of the runtime, which its threads then meet without asking
 * Godot. What these are pushed with goes to the bodies. What stands still is ground (physics_ground.c). */
#include <math.h>
#include <stdlib.h>
#include <string.h>

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
  STATE_TRANSFORM = 0,
  STATE_LINEAR_VELOCITY = 1,
  STATE_ANGULAR_VELOCITY = 2
};

/* What of a body makes it light or heavy; zeros: nothing moves it. */
typedef struct body_mass {
  float inverse;                    /* 1/kg */
  sbf_vec3 inverse_inertia, centre; /* 1/(kg m^2); m, in the body's frame */
} body_mass;

typedef struct mirrored {
  uint64_t body;      /* RID; 0: free */
  int64_t index;      /* of its shapes */
  gd_variant handle;  /* the RID as a value */
  uint64_t object;    /* instance id of the node */
  sbr_shape *shape;   /* NULL: of a kind that has none here */
  sbr_collider_id id; /* in the character's world */
  sbf_vec3 arm;       /* from the body's origin to the shape's, where it was last moved to */
  uint32_t seen;      /* frame it was last near */
  body_mass mass;     /* the body's, as its collider was made */
  bool leads, told;   /* its collider has the mass; it was told of in the frame before */
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

static sbf_vec3 state_of(const gd_variant *server, const mirrored *at, int64_t which) {
  return gd_take_vector3(GD_CALL(server, "body_get_state", gd_copy(&at->handle), gd_int(which)));
}

static sbf_vec3 cross(sbf_vec3 a, sbf_vec3 b) {
  return (sbf_vec3){a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x};
}

/* ---- What they weigh ---- */

static body_mass mass_of(const gd_variant *server, const mirrored *at) {
  body_mass mass = {0, {0, 0, 0}, {0, 0, 0}};
  if (!is_rigid(server, &at->handle)) return mass;
  gd_variant state = GD_CALL(server, "body_get_direct_state", gd_copy(&at->handle));
  if (gd_as_object(&state)) {
    mass.inverse = (float)gd_take_float(GD_CALL(&state, "get_inverse_mass"));
    mass.inverse_inertia = gd_take_vector3(GD_CALL(&state, "get_inverse_inertia"));
    mass.centre = gd_take_vector3(GD_CALL(&state, "get_center_of_mass_local"));
  }
  gd_free(&state);
  return mass;
}

/* The collider of its body that has the mass; NULL: there is none yet. */
static mirrored *leader_of(physics_bodies *bodies, const mirrored *at) {
  for (uint32_t i = 0; i < MOST; i++) {
    mirrored *other = &bodies->each[i];
    if (other->body == at->body && other->leads && other->id.value) return other;
  }
  return NULL;
}

static float inverse(float number) {
  return number > 0 ? 1 / number : 0;
}

/* The turn from the shape's axes to the world's, taken off one from others to the world's. */
static sbf_quat without(sbf_quat turn, sbf_quat shape) {
  sbf_quat a = {-shape.x, -shape.y, -shape.z, shape.w}, b = turn;
  return (sbf_quat){a.w * b.x + a.x * b.w + a.y * b.z - a.z * b.y,
      a.w * b.y - a.x * b.z + a.y * b.w + a.z * b.x, a.w * b.z + a.x * b.y - a.y * b.x + a.z * b.w,
      a.w * b.w - a.x * b.x - a.y * b.y - a.z * b.z};
}

/* How the body's principal axes stand in the world. */
static sbf_quat axes_of(const gd_variant *server, const mirrored *at) {
  gd_variant state = GD_CALL(server, "body_get_direct_state", gd_copy(&at->handle));
  gd_variant axes = gd_as_object(&state) ? GD_CALL(&state, "get_principal_inertia_axes") : gd_nil();
  float m[3][3] = {{1, 0, 0}, {0, 1, 0}, {0, 0, 1}};
  for (int64_t k = 0; k < 3 && gd_type(&axes) == GDEXTENSION_VARIANT_TYPE_BASIS; k++) {
    gd_variant column = gd_at(&axes, k);
    sbf_vec3 v = gd_take_vector3(column);
    m[0][k] = v.x, m[1][k] = v.y, m[2][k] = v.z;
  }
  gd_free(&axes);
  gd_free(&state);
  return quat_of(m);
}

/* A collider for the body's shape; what it weighs is the first one's of the body. */
static void make_collider(physics_bodies *bodies, sbr_world *world, const gd_variant *server, mirrored *at) {
  sbr_collider_definition made = sbr_default_collider_definition();
  gd_transform place = place_of(server, at);
  made.shape = at->shape;
  made.position = (sbr_double3){place.origin.x, place.origin.y, place.origin.z};
  made.rotation = quat_of(place.basis);
  made.friction =
      (float)gd_take_float(GD_CALL(server, "body_get_param", gd_copy(&at->handle), gd_int(PARAM_FRICTION)));
  made.restitution =
      (float)gd_take_float(GD_CALL(server, "body_get_param", gd_copy(&at->handle), gd_int(PARAM_BOUNCE)));
  const mirrored *leader = leader_of(bodies, at);
  at->leads = at->told = false;
  if (at->mass.inverse > 0 && leader) {
    made.part_of = leader->id;
  } else if (at->mass.inverse > 0) {
    sbf_vec3 i = at->mass.inverse_inertia, c = at->mass.centre;
    at->leads = true;
    made.mass = 1 / at->mass.inverse;
    made.inertia = (sbf_vec3){inverse(i.x), inverse(i.y), inverse(i.z)};
    made.inertia_axes = without(axes_of(server, at), made.rotation);
    gd_variant inner = GD_CALL(server, "body_get_shape_transform", gd_copy(&at->handle), gd_int(at->index));
    gd_transform t = gd_as_transform(&inner); /* a shape's own axes may be scaled */
    gd_free(&inner);
    sbf_vec3 off = {c.x - t.origin.x, c.y - t.origin.y, c.z - t.origin.z}, *to = &made.centre;
    sbf_quat back = quat_of(t.basis);
    sbf_vec3 axis = {-back.x, -back.y, -back.z}, once = cross(axis, off);
    once = (sbf_vec3){2 * once.x, 2 * once.y, 2 * once.z};
    sbf_vec3 twice = cross(axis, once);
    *to = (sbf_vec3){off.x + back.w * once.x + twice.x, off.y + back.w * once.y + twice.y,
        off.z + back.w * once.z + twice.z};
  }
  sbr_collider_create(world, &made, &at->id, NULL);
}

/* What has another mass than its collider, or lost the one that had it, gets a new one. */
static void follow_mass(
    physics_bodies *bodies, sbr_world *world, const gd_variant *server, mirrored *at, bool pushes) {
  body_mass now = pushes ? mass_of(server, at) : (body_mass){0, {0, 0, 0}, {0, 0, 0}};
  bool same = !memcmp(&now, &at->mass, sizeof now);
  if (same && (!(now.inverse > 0) || leader_of(bodies, at))) return;
  sbr_collider_destroy(world, at->id);
  at->id = (sbr_collider_id){0};
  at->mass = now;
  make_collider(bodies, world, server, at);
}

/* From where it is, by its velocity; with a mass also by what pulls at it. What is not rigid moves by itself,
 * and stays where it is. */
static void move(sbr_world *world, const gd_variant *server, mirrored *at, float frame_s) {
  gd_transform now = place_of(server, at);
  sbf_vec3 o = now.origin;
  sbf_quat q = quat_of(now.basis);
  if (!is_rigid(server, &at->handle)) {
    sbr_collider_move(world, at->id, (sbr_double3){o.x, o.y, o.z}, q);
    return;
  }
  gd_variant state = GD_CALL(server, "body_get_direct_state", gd_copy(&at->handle));
  sbf_vec3 v = state_of(server, at, STATE_LINEAR_VELOCITY), w = state_of(server, at, STATE_ANGULAR_VELOCITY);
  sbf_vec3 centre = {0, 0, 0}, pull = {0, 0, 0};
  if (gd_as_object(&state)) {
    centre = gd_take_vector3(GD_CALL(&state, "get_center_of_mass"));
    pull = gd_take_vector3(GD_CALL(&state, "get_total_gravity"));
  }
  gd_free(&state);
  sbf_vec3 off = cross(w, (sbf_vec3){at->arm.x - centre.x, at->arm.y - centre.y, at->arm.z - centre.z});
  sbr_collider_motion motion = {.position = {o.x, o.y, o.z},
      .rotation = q,
      .velocity = {v.x + off.x, v.y + off.y, v.z + off.z},
      .spin = w,
      .acceleration = pull,
      .since_s = at->told ? frame_s : 0};
  at->told = true;
  sbr_collider_set_motion(world, at->id, &motion);
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
    if (one->settings.push_bodies) room->mass = mass_of(server, room);
    if (room->shape) make_collider(bodies, one->world, server, room);
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

void physics_bodies_move(physics_bodies *bodies, sbr_world *world, float frame_s, bool pushes) {
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
    follow_mass(bodies, world, &server, at, pushes);
  }
  for (uint32_t i = 0; i < MOST; i++) {
    mirrored *at = &bodies->each[i];
    if (!at->body || !at->id.value) continue;
    move(world, &server, at, frame_s);
  }
  gd_free(&server);
}

static float length(sbf_vec3 v) {
  return sqrtf(v.x * v.x + v.y * v.y + v.z * v.z);
}

/* No more at once than makes the body so much faster. */
static float share_of(const mirrored *at, sbf_vec3 impulse, float limit) {
  float size = length(impulse) * at->mass.inverse, most = limit;
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
    float k = share_of(at, j, (float)settings->push_limit);
    GD_DO(&server, "body_apply_impulse", gd_copy(&at->handle),
        gd_vector3((sbf_vec3){k * j.x, k * j.y, k * j.z}), gd_vector3(at->arm));
    GD_DO(&server, "body_apply_torque_impulse", gd_copy(&at->handle),
        gd_vector3((sbf_vec3){k * m.x, k * m.y, k * m.z}));
  }
  gd_free(&server);
}
