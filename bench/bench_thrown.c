/* The paper's scene: a soft figure over a rigid skeleton that hangs by its hands from two blocks, and balls
 * thrown at it (examples/bones; Matulewicz and others, Figures 9 and 10 there). The figure has about 2750
 * tetrahedra and 1036 polygons, as the paper's armadillo had, of which two at once ran at 18 frames a second.
 *
 * Four variants: the skeleton as it is, without its limits, with the masses of its bones evened out, and
 * flesh alone. Of each: the largest bend at an elbow, a knee or the neck against rest while six balls of 12
 * cm hit at 5 m/s and bounce off (`bend_deg`); the largest angle by which a joint's limit was broken
 * (`beyond_deg`); how far the skin hangs from its rest shape before, in the mean (`sag_mm`), and how far it
 * was moved at most (`swing_mm`); what of the bends is left eight seconds after the last ball (`left_deg`),
 * which is the shape's error; and the frames a second of two figures on one thread.
 *
 * Ends with a failure where the limits do not hold, make no difference, or the figure does not find back. */
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "measuring.h"
#include "sbfmt/asset.h"
#include "sbfmt/build.h"
#include "sbfmt/io.h"
#include "sbrun/collision.h"
#include "sbrun/rigid.h"

enum { MARKS = 11, BENDS = 5, BALLS = 6, MOST_VERTICES = 4096, SETTLES = 360, EVERY = 30, RESTS = 480 };
enum { QUICK_SHARE = 3 }; /* of all that time and those balls */

static const double HANGS_M = 2;
static const float NEAR_M = 0.11f, BALL_M = 0.12f, BALL_M_S = 5, DEGREES = 57.29578f;

/* Places of the figure at rest: joints, and the middles of the limbs at them. */
static const sbf_vec3 marks[MARKS] = {{0, 1.2f, 0}, {0, 1.43f, 0}, {0, 1.57f, 0}, {0.30f, 1.345f, 0},
    {0.42f, 1.36f, 0}, {0.54f, 1.38f, 0}, {0.105f, 0.69f, 0}, {0.115f, 0.5f, 0.01f}, {0.12f, 0.3f, 0},
    {-0.105f, 0.69f, 0}, {-0.115f, 0.5f, 0.01f}};
static const int bends[BENDS][3] = {{0, 1, 2}, {3, 4, 5}, {6, 7, 8}, {9, 10, -8}, {0, 6, 7}};
/* Where each ball hits. */
static const sbf_vec3 targets[BALLS] = {
    {0, 1.57f, 0}, {0.05f, 1.2f, 0}, {0.12f, 0.35f, 0}, {-0.42f, 1.36f, 0}, {-0.1f, 0.7f, 0}, {0, 0.95f, 0}};

typedef struct shape {
  uint32_t count;
  sbf_vec3 at[MOST_VERTICES];
} shape;

typedef struct scene {
  sbr_world *world;
  sbr_character_id character;
  uint32_t joint_count;
  const shape *rest;
  float raise;
} scene;

typedef struct result {
  float bend, beyond, sag, swing, left;
} result;

static sbf_asset *read_figure(const char *name) {
  char path[512];
  sbf_asset *source, *built;
  sbf_diagnostic error;
  const sbf_build_options options = {.interior = SBF_BUILD_INTERIOR_TETRAHEDRA, .elements = 2800};
  (void)snprintf(path, sizeof path, "%s/examples/bones/%s", BENCH_SOURCE_FOLDER, name);
  bench_require(sbf_load_file(path, NULL, &source, &error), &error);
  bench_require(sbf_build(source, &options, &built, NULL, &error), &error);
  sbf_asset_free(source);
  return built;
}

static sbf_vec3 minus(sbf_vec3 a, sbf_vec3 b) {
  return (sbf_vec3){a.x - b.x, a.y - b.y, a.z - b.z};
}
static float dot(sbf_vec3 a, sbf_vec3 b) {
  return a.x * b.x + a.y * b.y + a.z * b.z;
}

static void look(const scene *s, shape *to) {
  to->count = sbr_character_skin(s->world, s->character, 0, to->at, NULL, NULL, MOST_VERTICES);
  if (to->count > MOST_VERTICES) bench_fail("the figure has more vertices than there is room for");
}

/* Mean place of the skin that is near a place at rest. */
static sbf_vec3 carried(const scene *s, const shape *now, sbf_vec3 at) {
  sbf_vec3 sum = {0, 0, 0};
  float count = 0;
  for (uint32_t i = 0; i < now->count; i++) {
    sbf_vec3 off = minus(s->rest->at[i], at);
    if (dot(off, off) > NEAR_M * NEAR_M) continue;
    sum = (sbf_vec3){sum.x + now->at[i].x, sum.y + now->at[i].y, sum.z + now->at[i].z};
    count++;
  }
  return (sbf_vec3){sum.x / count, sum.y / count, sum.z / count};
}

static sbf_vec3 marked(const scene *s, const shape *now, int mark) {
  sbf_vec3 at = marks[mark < 0 ? -mark : mark];
  if (mark < 0) at.x = -at.x;
  return carried(s, now, at);
}

static float angle_of(const scene *s, const shape *now, const int at[3]) {
  sbf_vec3 middle = marked(s, now, at[1]);
  sbf_vec3 a = minus(marked(s, now, at[0]), middle), b = minus(marked(s, now, at[2]), middle);
  float c = dot(a, b) / sqrtf(dot(a, a) * dot(b, b));
  return acosf(c < -1 ? -1 : c > 1 ? 1 : c);
}

static float rms(const shape *a, const shape *b) {
  double sum = 0;
  for (uint32_t i = 0; i < a->count; i++) {
    sbf_vec3 off = minus(a->at[i], b->at[i]);
    sum += (double)dot(off, off);
  }
  return (float)sqrt(sum / a->count);
}

static void note(const scene *s, const shape *now, const shape *before, result *r) {
  for (int b = 0; b < BENDS; b++) {
    float bend = fabsf(angle_of(s, now, bends[b]) - angle_of(s, s->rest, bends[b]));
    r->bend = bend > r->bend ? bend : r->bend;
  }
  for (uint32_t j = 0; j < s->joint_count; j++) {
    float beyond = sbr_character_joint_state(s->world, s->character, j).beyond_angle;
    r->beyond = beyond > r->beyond ? beyond : r->beyond;
  }
  float moved = rms(now, before);
  r->swing = moved > r->swing ? moved : r->swing;
}

/* Throws a ball, which bounces back where it touches, and goes on for a while. */
static void throw_ball(const scene *s, const sbr_shape *ball, int number, const shape *before, result *r) {
  sbr_collider_definition definition = sbr_default_collider_definition();
  sbr_collider_id id;
  sbf_diagnostic error;
  static shape now;
  look(s, &now);
  sbf_vec3 aim = carried(s, &now, targets[number]);
  sbr_double3 low = sbr_character_origin(s->world, s->character);
  sbr_double3 at = {low.x + (double)aim.x, low.y + (double)aim.y, low.z + (double)aim.z + 0.5};
  double speed = -(double)BALL_M_S;
  definition.shape = ball;
  definition.position = at;
  bench_require(sbr_collider_create(s->world, &definition, &id, &error), &error);
  for (int i = 0; i < EVERY; i++) {
    sbr_event events[64];
    at.z += speed / 60;
    sbr_collider_move(s->world, id, at, (sbf_quat){0, 0, 0, 1});
    sbr_world_tick(s->world);
    uint32_t count = sbr_world_events(s->world, events, 64);
    for (uint32_t e = 0; e < count && e < 64; e++)
      if (events[e].kind == SBR_EVENT_CONTACT && events[e].collider.value == id.value && speed < 0)
        speed *= -0.3;
    look(s, &now);
    note(s, &now, before, r);
  }
  sbr_collider_destroy(s->world, id);
}

static sbr_world *make_world(void) {
  sbr_world_definition definition = sbr_default_world_definition();
  sbr_world *world;
  sbf_diagnostic error;
  definition.sleep_after_s = 0;
  bench_require(sbr_world_create(&definition, &world, &error), &error);
  return world;
}

static sbr_character_id hang(sbr_world *world, const sbr_model *model, double x) {
  sbr_character_definition definition = sbr_default_character_definition();
  sbr_character_id id;
  sbf_diagnostic error;
  definition.position = (sbr_double3){x, HANGS_M, 0};
  bench_require(sbr_character_create(world, model, &definition, &id, &error), &error);
  return id;
}

static result throw_all(const sbr_model *model, uint32_t joint_count, bool quick) {
  int share = quick ? QUICK_SHARE : 1;
  static shape rest, before, after;
  scene s = {.world = make_world(), .joint_count = joint_count, .rest = &rest, .raise = (float)HANGS_M};
  sbr_shape_definition form = sbr_default_shape_definition();
  sbr_shape *ball;
  sbf_diagnostic error;
  result r = {0, 0, 0, 0, 0};
  s.character = hang(s.world, model, 0);
  double low = sbr_character_origin(s.world, s.character).y;
  look(&s, &rest);
  for (uint32_t i = 0; i < rest.count; i++) rest.at[i].y += (float)low - s.raise;
  form.radius = BALL_M;
  bench_require(sbr_shape_create(NULL, &form, &ball, &error), &error);
  for (int i = 0; i < SETTLES / share; i++) sbr_world_tick(s.world);
  look(&s, &before);
  r.sag = rms(&before, &rest);
  for (int b = 0; b < BALLS / share; b++) throw_ball(&s, ball, b, &before, &r);
  for (int i = 0; i < RESTS / share; i++) sbr_world_tick(s.world);
  look(&s, &after);
  for (int b = 0; b < BENDS; b++) {
    float off = fabsf(angle_of(&s, &after, bends[b]) - angle_of(&s, &before, bends[b]));
    r.left = off > r.left ? off : r.left;
  }
  sbr_world_destroy(s.world);
  sbr_shape_destroy(ball);
  return r;
}

/* Two of them, on one thread. */
static double frames_a_second(const sbr_model *model, uint32_t frames) {
  sbr_world *world = make_world();
  double *times = bench_allocate(frames, sizeof *times);
  for (int i = 0; i < 2; i++) (void)hang(world, model, 2 * i);
  for (uint32_t i = 0; i < frames; i++) {
    double begin = bench_now_s();
    sbr_world_tick(world);
    times[i] = bench_now_s() - begin;
  }
  double median = bench_spread_of(times, frames).median;
  sbr_world_destroy(world);
  free(times);
  return 1 / median;
}

static result measure(const char *name, const sbf_asset *asset, bool quick) {
  sbr_model *model;
  sbf_diagnostic error;
  bench_require(sbr_model_create(asset, NULL, &model, &error), &error);
  result r = throw_all(model, asset->joints.count, quick);
  bench_print_row("%s,%u,%u,%u,%.1f,%.3f,%.1f,%.1f,%.2f,%.0f", name,
      asset->soft_bodies.at[0].levels.at[0].lattice.tetrahedra.count,
      asset->render_meshes.at[0].mesh.polygon_sizes.count, asset->joints.count, (double)(r.bend * DEGREES),
      (double)(r.beyond * DEGREES), (double)(1000 * r.sag), (double)(1000 * r.swing),
      (double)(r.left * DEGREES), frames_a_second(model, quick ? 10 : 300));
  sbr_model_destroy(model);
  return r;
}

/* What the variants change in an asset that is this program's own. */
static void even_masses(sbf_asset *asset) {
  sbf_rigid_body *bodies = (sbf_rigid_body *)(uintptr_t)asset->rigid_bodies.at;
  float sum = 0;
  for (uint32_t b = 0; b < asset->rigid_bodies.count; b++) sum += bodies[b].mass;
  for (uint32_t b = 0; b < asset->rigid_bodies.count; b++)
    bodies[b].mass = sum / (float)asset->rigid_bodies.count;
}

static void drop_limits(sbf_asset *asset) {
  sbf_joint *joints = (sbf_joint *)(uintptr_t)asset->joints.at;
  for (uint32_t j = 0; j < asset->joints.count; j++) joints[j].limits.count = 0;
}

static result measure_loose(bool quick) {
  sbf_asset *loose = read_figure("figure.sbf");
  drop_limits(loose);
  result r = measure("skeleton without limits", loose, quick);
  sbf_asset_free(loose);
  return r;
}

static void measure_rest(void) {
  sbf_asset *even = read_figure("figure.sbf"), *flesh = read_figure("flesh.sbf");
  even_masses(even);
  (void)measure("skeleton of even masses", even, false);
  (void)measure("flesh alone", flesh, false);
  sbf_asset_free(even), sbf_asset_free(flesh);
}

int main(int argc, char **argv) {
  bool quick = bench_is_quick(argc, argv);
  sbf_asset *figure = read_figure("figure.sbf");
  bench_print_columns(
      "variant,tetrahedra,polygons,joints,bend_deg,beyond_deg,sag_mm,swing_mm,left_deg,two_at_once_fps");
  result with = measure("skeleton", figure, quick);
  result loose = measure_loose(quick);
  if (!quick) measure_rest();
  if (with.beyond * DEGREES > 1)
    bench_fail("a limit was broken by %g degrees", (double)(with.beyond * DEGREES));
  if (with.bend >= loose.bend) bench_fail("limits do not keep the figure from bending");
  if (with.left * DEGREES > 5) bench_fail("the figure has not found back to its shape");
  sbf_asset_free(figure);
  return 0;
}
