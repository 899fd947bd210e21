/* Hulls against the built-in stairs. A height function alone has no risers and no nosings.
 *
 * Stairs are the union of one quadrant per step: everything below its tread and behind its riser. A hull
 * collides with each quadrant near it as with any other hull (rigid_shape_contacts.c), so it rests across
 * nosings and leans on risers. A quadrant has one edge and no bottom, so nothing else can catch a hull. */
#include "rigid/rigid_work.h"
#include "shapes/ground.h"
#include "shapes/hull_pair.h"

/* Contact margin: a fraction of the body's size, on top of its displacement in the tick. */
static const float NEAR_FRACTION = 0.02f;
/* Extent of the part of a quadrant that is tested, in sizes of the body. */
static const float PIECE = 6;
/* A body across more steps than this uses the height function: at its size, stairs are a slope. */
enum { MAX_STEPS = 12 };

/* y below 0, z above 0, and as wide. */
static const sbf_vec3 corners[8] = {
    {-1, -1, 0}, {1, -1, 0}, {-1, 0, 0}, {1, 0, 0}, {-1, -1, 1}, {1, -1, 1}, {-1, 0, 1}, {1, 0, 1}};
static const uint32_t rounds[24] = {0, 4, 6, 2, 1, 3, 7, 5, 0, 1, 5, 4, 2, 6, 7, 3, 0, 2, 3, 1, 4, 5, 7, 6};
#define LEFT                                                                                                 \
  { -1, 0, 0 }
#define RIGHT                                                                                                \
  { 1, 0, 0 }
#define DOWN                                                                                                 \
  { 0, -1, 0 }
#define UP                                                                                                   \
  { 0, 1, 0 }
#define FRONT                                                                                                \
  { 0, 0, -1 }
#define BACK                                                                                                 \
  { 0, 0, 1 }
static const sbri_hull_face faces[6] = {
    {LEFT, 1, 0, 4}, {RIGHT, 1, 4, 4}, {DOWN, 1, 8, 4}, {UP, 0, 12, 4}, {FRONT, 0, 16, 4}, {BACK, 1, 20, 4}};
static const sbri_hull_edge edges[12] = {{{0, 1}, {DOWN, FRONT}}, {{2, 3}, {UP, FRONT}},
    {{4, 5}, {DOWN, BACK}}, {{6, 7}, {UP, BACK}}, {{0, 2}, {LEFT, FRONT}}, {{1, 3}, {RIGHT, FRONT}},
    {{4, 6}, {LEFT, BACK}}, {{5, 7}, {RIGHT, BACK}}, {{0, 4}, {LEFT, DOWN}}, {{1, 5}, {RIGHT, DOWN}},
    {{2, 6}, {LEFT, UP}}, {{3, 7}, {RIGHT, UP}}};
static const sbri_hull quadrant = {
    corners, faces, rounds, edges, 8, 6, 24, 12, {0, -0.5f, 0.5f}, {{-1, -1, 0}, {1, 0, 1}}};

typedef struct stairs {
  const sbri_rigid_tick *tick;
  double rise, run; /* m, world */
} stairs;

/* Position of the edge of a step's quadrant, in the character's units. */
static sbf_vec3 edge_of(const stairs *s, int64_t step, float x) {
  const sbri_rigid_tick *t = s->tick;
  double z = s->run * (double)(s->rise > 0 ? step : step + 1);
  return sbri_vec3(x, (float)((s->rise * (double)step - t->origin.y) / (double)t->scale),
      (float)((z - t->origin.z) / (double)t->scale));
}

/* Index of the step at a position; below the first one: 0. */
static int64_t step_at(const stairs *s, float z) {
  double world = (s->tick->origin.z + (double)(s->tick->scale * z)) / s->run;
  int64_t step = world < 1e9 ? (int64_t)(world > 0 ? world : 0) : 1000000000;
  return step;
}

static void add_pair(const stairs *s, sbri_rigid_solving *work, uint32_t b, int32_t node, int64_t step,
    const sbri_hull_pair *pair) {
  const sbri_rigid_body *body = &s->tick->model->bodies[b];
  const sbr_transform *pose = &s->tick->bodies[b].pose;
  for (uint32_t i = 0; i < pair->count && work->contact_list.count < work->contact_list.capacity; i++) {
    sbf_vec3 own = sbri_sub(pair->on_a[i], pose->position);
    work->contact_list.at[work->contact_list.count++] = (sbri_rigid_contact){.node = node,
        .body = b,
        .at = sbri_rotate(sbri_quat_conjugate(pose->rotation), own),
        .normal = pair->normal,
        .offset = sbri_dot(pair->normal, pair->on_b[i]),
        .friction = body->source->friction,
        .restitution = body->source->restitution,
        .collider = UINT32_MAX,
        .surface = UINT32_MAX - 1 - (uint32_t)step};
  }
}

static void collide_step(
    const stairs *s, sbri_rigid_solving *work, uint32_t b, int32_t node, int64_t step, float reach) {
  const sbri_rigid_body *body = &s->tick->model->bodies[b];
  const sbr_transform *pose = &s->tick->bodies[b].pose;
  sbf_vec3 x = pose->position;
  sbri_placed_hull hull = {&body->hull, x, pose->rotation, 1};
  sbri_placed_hull piece = {&quadrant, edge_of(s, step, x.x), {0, 0, 0, 1}, PIECE * body->radius};
  bool level = s->rise > 0 && step == 0; /* nothing is in front of the first riser */
  if (level) piece.at.z = x.z - 0.5f * piece.scale;
  if (s->rise < 0) piece.rotation = (sbf_quat){0, 1, 0, 0};
  float above = x.y - piece.at.y, before = s->rise < 0 ? x.z - piece.at.z : piece.at.z - x.z;
  if (above > body->radius + reach || before > body->radius + reach) return;
  /* Far below and behind the edge: belongs to a step that supports it. */
  if (-above > 0.5f * piece.scale || -before > 0.5f * piece.scale + body->radius) return;
  sbri_hull_pair pair;
  if (sbri_collide_hulls(&hull, &piece, reach, &pair)) add_pair(s, work, b, node, step, &pair);
}

bool sbri_rigid_stair_contacts_find(
    const sbri_rigid_tick *t, sbri_rigid_solving *work, uint32_t b, int32_t node) {
  stairs s = {.tick = t};
  const sbri_rigid_body *body = &t->model->bodies[b];
  const sbri_rigid_body_state *state = &t->bodies[b];
  if (!sbri_ground_is_stairs(t->ground, &s.rise, &s.run) || !body->hull.face_count) return false;
  sbf_vec3 turn = sbri_angular_velocity_from_momentum(body, state->pose.rotation, state->angular_momentum),
           x = state->pose.position;
  float travel = t->tick_s * (sbri_length(state->velocity) + sbri_length(t->gravity) * t->tick_s);
  float swing = t->tick_s * sbri_length(turn) * body->radius + NEAR_FRACTION * body->radius;
  float max = 0.5f * body->radius, reach = swing + (travel < max ? travel : max);
  int64_t first = step_at(&s, x.z - body->radius - reach), last = step_at(&s, x.z + body->radius + reach);
  if (last - first >= MAX_STEPS) return false;
  uint32_t before = work->contact_list.count;
  for (int64_t step = first; step <= last; step++) collide_step(&s, work, b, node, step, reach);
  return work->contact_list.count > before ||
         travel <= max; /* fast bodies might pass through before they are near */
}
