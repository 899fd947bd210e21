/* Bodies of the physics space near a character: floors, walls, platforms and movable bodies. A query with a
 * box around the character finds them, a wider query finds the fast ones. Each of their shapes
 * (physics_shapes.c) gets a collider of the runtime, so that its threads need not call Godot. Impulses on
 * these colliders go to the bodies. Bodies below the character's node are ignored. */
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "physics_kinds.h"
#include "physics_mass.h"
#include "physics_parts.h"
#include "soft_character.h"
#include "turns.h"

enum {
  MAX = 256,   /* maximum number of shapes */
  KEPT = 30,   /* frames for which a distant shape is kept if there is capacity */
  AGAIN = 4,   /* frames between two queries */
  FORGET = 64, /* frames after which ignored bodies are checked again */
  QUERIES = 8, /* maximum number per frame: a mesh may fill one result by itself */
  PARAM_BOUNCE = 0,
  PARAM_FRICTION = 1,
  STATE_TRANSFORM = 0,
  STATE_LINEAR_VELOCITY = 1,
  STATE_ANGULAR_VELOCITY = 2
};

typedef struct mirrored {
  uint64_t body;           /* RID; 0: free */
  int64_t index;           /* index of its shape */
  gd_variant handle;       /* the RID as a value */
  uint64_t object;         /* instance id of the node */
  sbr_shape *shape;        /* NULL: its kind is not supported */
  sbr_collider_id id;      /* in the character's world */
  gd_transform inner;      /* transform of the runtime's shape in Godot's */
  gd_transform last;       /* last transform of the shape in the world */
  sbf_vec3 arm;            /* from the body's origin to that of the shape */
  uint32_t seen;           /* last frame in which it was near */
  uint32_t found;          /* query that last found it */
  body_mass mass;          /* mass of the body when its collider was created */
  bool leads, is_reported; /* its collider has the mass; its motion was set in the previous frame */
} mirrored;

struct physics_bodies {
  mirrored each[MAX];
  uint32_t frame;
  gd_variant query, box; /* PhysicsShapeQueryParameters3D and its BoxShape3D */
  gd_variant passed;     /* RIDs that queries exclude: bodies below characters */
  gd_variant still;      /* those and static bodies: excluded from queries for fast bodies */
  uint32_t query_count;
  bool warned; /* the warning about capacity was given */
};

physics_bodies *physics_bodies_make(void) {
  physics_bodies *made = calloc(1, sizeof *made);
  if (!made) return NULL;
  made->query = gd_new("PhysicsShapeQueryParameters3D");
  made->box = gd_new("BoxShape3D");
  made->passed = gd_empty(GDEXTENSION_VARIANT_TYPE_ARRAY);
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
  for (uint32_t i = 0; i < MAX; i++)
    if (bodies->each[i].body) drop(&bodies->each[i], world);
  gd_free(&bodies->query);
  gd_free(&bodies->box);
  gd_free(&bodies->passed);
  gd_free(&bodies->still);
  free(bodies);
}

gd_variant physics_bodies_object(const physics_bodies *bodies, sbr_collider_id collider) {
  for (uint32_t i = 0; collider.value && i < MAX; i++)
    if (bodies->each[i].id.value == collider.value)
      return gd_object(gd.object_get_instance_from_id(bodies->each[i].object));
  return gd_object(NULL);
}

/* ---- Positions ---- */

static float length(sbf_vec3 v) {
  return sqrtf(v.x * v.x + v.y * v.y + v.z * v.z);
}

static gd_transform body_transform(const gd_variant *server, mirrored *one) {
  gd_variant body = GD_CALL(server, "body_get_state", gd_copy(&one->handle), gd_int(STATE_TRANSFORM));
  gd_variant inner = GD_CALL(server, "body_get_shape_transform", gd_copy(&one->handle), gd_int(one->index));
  gd_transform a = gd_as_transform(&body), b = gd_as_transform(&inner);
  b = placed_in(&b, &one->inner);
  one->arm = placed_vector(&a, b.origin);
  gd_free(&body);
  gd_free(&inner);
  return placed_in(&a, &b);
}

static sbf_vec3 velocity_of(const gd_variant *server, const gd_variant *handle) {
  return gd_take_vector3(GD_CALL(server, "body_get_state", gd_copy(handle), gd_int(STATE_LINEAR_VELOCITY)));
}

static sbf_vec3 angular_velocity_of(const gd_variant *server, const gd_variant *handle) {
  return gd_take_vector3(GD_CALL(server, "body_get_state", gd_copy(handle), gd_int(STATE_ANGULAR_VELOCITY)));
}

/* ---- Colliders ---- */

/* The collider with the mass of the body; NULL: none yet. */
static mirrored *leader_of(physics_bodies *bodies, const mirrored *at) {
  for (uint32_t i = 0; i < MAX; i++) {
    mirrored *other = &bodies->each[i];
    if (other->body == at->body && other->leads && other->id.value) return other;
  }
  return NULL;
}

/* Creates a collider for the body's shape; the first one of the body has its mass. */
static void make_collider(physics_bodies *bodies, sbr_world *world, const gd_variant *server, mirrored *at) {
  sbr_collider_definition made = sbr_default_collider_definition();
  gd_transform target = body_transform(server, at);
  made.shape = at->shape;
  made.position = (sbr_double3){target.origin.x, target.origin.y, target.origin.z};
  made.rotation = turn_of(target.basis);
  made.friction =
      (float)gd_take_float(GD_CALL(server, "body_get_param", gd_copy(&at->handle), gd_int(PARAM_FRICTION)));
  made.restitution =
      (float)gd_take_float(GD_CALL(server, "body_get_param", gd_copy(&at->handle), gd_int(PARAM_BOUNCE)));
  const mirrored *leader = leader_of(bodies, at);
  at->leads = at->is_reported = false;
  at->last = target;
  if (at->mass.inverse > 0 && leader) {
    made.part_of = leader->id;
  } else if (at->mass.inverse > 0) {
    at->leads = true;
    body_mass_give(&at->mass, server, &at->handle, at->index, &made);
  }
  sbr_collider_create(world, &made, &at->id, NULL);
}

/* Recreates the collider if the mass has changed, or its leader was removed. */
static void follow_mass(
    physics_bodies *bodies, sbr_world *world, const gd_variant *server, mirrored *at, bool pushes) {
  body_mass now = pushes ? body_mass_of(server, &at->handle) : (body_mass){0, {0, 0, 0}, {0, 0, 0}};
  bool same = !memcmp(&now, &at->mass, sizeof now);
  if (same && (!(now.inverse > 0) || leader_of(bodies, at))) return;
  sbr_collider_destroy(world, at->id);
  at->id = (sbr_collider_id){0};
  at->mass = now;
  make_collider(bodies, world, server, at);
}

/* m per frame: larger movements are placements, not motion. */
static const float JUMP = 2;

/* Bodies that are not rigid are moved by the game; most never move. */
static void follow_moved(sbr_world *world, mirrored *at, const gd_transform *now) {
  if (!memcmp(now, &at->last, sizeof *now)) return;
  sbf_vec3 o = now->origin, was = at->last.origin;
  sbr_double3 target = {o.x, o.y, o.z};
  gd_transform turn = *now;
  if (length((sbf_vec3){o.x - was.x, o.y - was.y, o.z - was.z}) > JUMP)
    sbr_collider_set_transform(world, at->id, target, turn_of(turn.basis));
  else
    sbr_collider_move(world, at->id, target, turn_of(turn.basis));
}

/* Predicts motion by the velocity; with a mass also by its acceleration. */
static void move(sbr_world *world, const gd_variant *server, mirrored *at, float frame_s) {
  gd_transform now = body_transform(server, at);
  sbf_vec3 o = now.origin;
  sbf_quat q = turn_of(now.basis);
  bool rigid = body_is_rigid(server, &at->handle);
  if (!rigid) follow_moved(world, at, &now);
  at->last = now;
  if (!rigid) return;
  gd_variant state = GD_CALL(server, "body_get_direct_state", gd_copy(&at->handle));
  sbf_vec3 v = velocity_of(server, &at->handle), w = angular_velocity_of(server, &at->handle);
  sbf_vec3 centre = {0, 0, 0}, pull = {0, 0, 0};
  if (gd_as_object(&state)) {
    centre = gd_take_vector3(GD_CALL(&state, "get_center_of_mass"));
    pull = gd_take_vector3(GD_CALL(&state, "get_total_gravity"));
  }
  gd_free(&state);
  sbf_vec3 off = turn_cross(w, (sbf_vec3){at->arm.x - centre.x, at->arm.y - centre.y, at->arm.z - centre.z});
  sbr_collider_motion motion = {.position = {o.x, o.y, o.z},
      .rotation = q,
      .velocity = {v.x + off.x, v.y + off.y, v.z + off.z},
      .angular_velocity = w,
      .acceleration = pull,
      .since_s = at->is_reported ? frame_s : 0};
  at->is_reported = true;
  sbr_collider_set_motion(world, at->id, &motion);
}

/* m/s: maximum speed of a body that is found in time. */
static const float FASTEST = 50;

/* A free entry, or the one that has been distant for longest; NULL: all are near. */
static mirrored *find_unused(physics_bodies *bodies, sbr_world *world) {
  mirrored *oldest = &bodies->each[0];
  for (uint32_t i = 0; i < MAX; i++) {
    mirrored *at = &bodies->each[i];
    if (!at->body) return at;
    if (bodies->frame - at->seen > bodies->frame - oldest->seen) oldest = at;
  }
  if (bodies->frame - oldest->seen <= 2 * AGAIN) return NULL;
  drop(oldest, world);
  return oldest;
}

/* Whether Godot's engine may move it, perhaps later. */
static bool is_movable(const gd_variant *server, const mirrored *at) {
  gd_variant object = gd_object(gd.object_get_instance_from_id(at->object));
  bool movable =
      body_is_rigid(server, &at->handle) ||
      (gd_as_object(&object) && gd_take_bool(GD_CALL(&object, "is_class", gd_string("RigidBody3D"))));
  gd_free(&object);
  return movable;
}

void physics_bodies_except(const physics_bodies *bodies, physics_parts *parts) {
  gd_variant server = gd_singleton("PhysicsServer3D");
  for (uint32_t i = 0; i < MAX; i++)
    if (bodies->each[i].body && is_movable(&server, &bodies->each[i]))
      physics_parts_except(parts, &bodies->each[i].handle, true);
  gd_free(&server);
}

/* Adds a body's shape that is new. */
static void adopt(soft_character *one, const gd_variant *server, const gd_variant *handle, int64_t index,
    const gd_variant *object) {
  physics_bodies *bodies = one->physics.bodies;
  mirrored *unused = find_unused(bodies, one->world);
  if (!unused) {
    if (!bodies->warned)
      soft_character_warning(one, "more than 256 shapes of bodies are near it, and it passes through the "
                                  "rest (reported once). Remove some from the layers of its collision_mask");
    bodies->warned = true;
    return;
  }
  *unused = (mirrored){.body = gd_as_rid(handle),
      .index = index,
      .handle = gd_copy(handle),
      .object = gd.variant_get_object_instance_id(object),
      .seen = bodies->frame};
  if (is_movable(server, unused)) shared_world_except(one->shared, handle);
  unused->shape = physics_shape_of(server, handle, index, object, &unused->inner);
  if (one->settings.collision.push_bodies) unused->mass = body_mass_of(server, handle);
  if (unused->shape) make_collider(bodies, one->world, server, unused);
}

/* Adds a result of a query. Shapes that it finds again, as each triangle of a mesh may be, are excluded from
 * the following queries, by `known`. */
static void note_found(
    soft_character *one, const gd_variant *server, const gd_variant *hit, float speed, gd_variant *known) {
  physics_bodies *bodies = one->physics.bodies;
  gd_variant handle = gd_key(hit, "rid");
  uint64_t body = gd_as_rid(&handle);
  int64_t index = gd_take_int(gd_key(hit, "shape"));
  mirrored *mirror = NULL;
  for (uint32_t i = 0; i < MAX && !mirror; i++)
    if (bodies->each[i].body == body && bodies->each[i].index == index) mirror = &bodies->each[i];
  if (mirror) {
    if (mirror->found == bodies->query_count) GD_DO(known, "push_back", gd_copy(&handle));
    mirror->seen = bodies->frame, mirror->found = bodies->query_count;
  } else if (body) {
    gd_variant object = gd_key(hit, "collider");
    bool own = shared_world_has(one->shared, &object);
    if (own) GD_DO(&bodies->passed, "push_back", gd_copy(&handle));
    if (own || (speed > 0 && body_is_static(server, &handle)))
      GD_DO(&bodies->still, "push_back", gd_copy(&handle));
    else if (!(speed > 0) || length(velocity_of(server, &handle)) > speed)
      adopt(one, server, &handle, index, &object);
    gd_free(&object);
  }
  gd_free(&handle);
}

/* Runs the query for bodies of at least that speed (m/s), and again if its results were full. */
static void ask(soft_character *one, const gd_variant *space, const gd_variant *server, float speed) {
  physics_bodies *bodies = one->physics.bodies;
  gd_variant known = GD_CALL(speed > 0 ? &bodies->still : &bodies->passed, "duplicate");
  bool more = true;
  for (int i = 0; i < QUERIES && more; i++) {
    bodies->query_count++;
    GD_DO(&bodies->query, "set_exclude", gd_copy(&known));
    int64_t left_out = gd_size(&known);
    gd_variant hits = GD_CALL(space, "intersect_shape", gd_copy(&bodies->query), gd_int(MAX));
    int64_t count = gd_size(&hits);
    for (int64_t k = 0; k < count; k++) {
      gd_variant hit = gd_at(&hits, k);
      note_found(one, server, &hit, speed, &known);
      gd_free(&hit);
    }
    gd_free(&hits);
    more = count == MAX && gd_size(&known) > left_out;
  }
  gd_free(&known);
}

/* Every few frames finds all bodies in a box around the character; in each frame those that are fast enough
 * to pass it before the next. */
static void query_around(soft_character *one, bool all) {
  physics_bodies *bodies = one->physics.bodies;
  gd_variant world = GD_CALL(&one->node, "get_world_3d");
  gd_variant space = gd_as_object(&world) ? GD_CALL(&world, "get_direct_space_state") : gd_nil();
  if (gd_as_object(&space)) {
    float frame_s = (float)gd_take_float(GD_CALL(&one->node, "get_physics_process_delta_time"));
    float wide = 1.3f * (float)soft_character_around(one),
          tall = (one->bounds.high.y - one->bounds.low.y) * one->scale;
    float more = 2 * FASTEST * frame_s;
    gd_variant server = gd_singleton("PhysicsServer3D");
    gd_transform at = {{{1, 0, 0}, {0, 1, 0}, {0, 0, 1}}, one->placement.shown_at.origin};
    sbf_vec3 size = {2 * wide, 2 * tall + wide, 2 * wide};
    at.origin.y += (one->bounds.low.y + one->bounds.high.y) / 2 * one->scale;
    GD_DO(&bodies->query, "set_transform", gd_transform_value(at));
    GD_DO(&bodies->query, "set_collision_mask", gd_int(one->settings.collision.collision_mask));
    if (bodies->frame % FORGET == 0) {
      gd_assign(&bodies->passed, gd_empty(GDEXTENSION_VARIANT_TYPE_ARRAY));
      gd_assign(&bodies->still, gd_empty(GDEXTENSION_VARIANT_TYPE_ARRAY));
    }
    if (all) {
      /* Distance that the character covers until the next query at twice its speed. */
      sbf_vec3 o = one->placement.shown_at.origin, was = one->placement.queried_at;
      float goes = fminf(4 * length((sbf_vec3){o.x - was.x, o.y - was.y, o.z - was.z}), FASTEST);
      size = (sbf_vec3){size.x + goes, size.y + goes, size.z + goes};
      one->placement.queried_at = o;
      GD_DO(&bodies->box, "set_size", gd_vector3(size));
      ask(one, &space, &server, 0);
    }
    if (frame_s > 0) {
      GD_DO(&bodies->box, "set_size", gd_vector3((sbf_vec3){size.x + more, size.y + more, size.z + more}));
      ask(one, &space, &server, wide / (4 * AGAIN * frame_s));
    }
    gd_free(&server);
  }
  gd_free(&space);
  gd_free(&world);
}

void physics_bodies_query(soft_character *one, bool now) {
  query_around(one, now || one->physics.bodies->frame % AGAIN == 0);
}

void physics_bodies_move(physics_bodies *bodies, sbr_world *world, float frame_s, bool pushes) {
  gd_variant server = gd_nil();
  bodies->frame++;
  for (uint32_t i = 0; i < MAX; i++) {
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
  for (uint32_t i = 0; i < MAX; i++) {
    mirrored *at = &bodies->each[i];
    if (!at->body || !at->id.value) continue;
    move(world, &server, at, frame_s);
  }
  gd_free(&server);
}

/* Limits the impulse to a velocity change in m/s, or to that which reflects a faster body. */
static float fraction_of(const gd_variant *server, const mirrored *at, sbf_vec3 impulse, float limit) {
  float size = length(impulse) * at->mass.inverse;
  if (!(limit > 0) || size <= limit) return 1;
  float max = fmaxf(limit, 2 * length(velocity_of(server, &at->handle)));
  return size > max ? max / size : 1;
}

void physics_bodies_push(physics_bodies *bodies, sbr_world *world, const soft_settings *settings) {
  gd_variant server = gd_nil();
  for (uint32_t i = 0; i < MAX; i++) {
    mirrored *at = &bodies->each[i];
    if (!at->id.value) continue;
    sbr_collider_impulse push = sbr_collider_take_impulse(world, at->id);
    sbf_vec3 j = push.impulse, m = push.moment;
    if (!settings->collision.push_bodies || (length(j) == 0 && length(m) == 0)) continue;
    if (!gd_as_object(&server)) gd_assign(&server, gd_singleton("PhysicsServer3D"));
    if (!gd.object_get_instance_from_id(at->object) || !body_is_rigid(&server, &at->handle)) continue;
    float k = fraction_of(&server, at, j, (float)settings->collision.push_limit);
    GD_DO(&server, "body_apply_impulse", gd_copy(&at->handle),
        gd_vector3((sbf_vec3){k * j.x, k * j.y, k * j.z}), gd_vector3(at->arm));
    GD_DO(&server, "body_apply_torque_impulse", gd_copy(&at->handle),
        gd_vector3((sbf_vec3){k * m.x, k * m.y, k * m.z}));
  }
  gd_free(&server);
}

bool physics_bodies_any_rigid(const physics_bodies *bodies) {
  gd_variant server = gd_singleton("PhysicsServer3D");
  bool any = false;
  for (uint32_t i = 0; i < MAX && !any; i++)
    any = bodies->each[i].body && body_is_rigid(&server, &bodies->each[i].handle);
  gd_free(&server);
  return any;
}
