/* The scene of a paper: a soft figure on a rigid skeleton hangs by its hands from two blocks, and balls
 * are thrown at it (examples/bones; Matulewicz and others, Figures 9 and 10 there). The figure has about
 * 2750 tetrahedra and 1036 polygons, like the paper's armadillo; two of those ran at 18 frames a second.
 * The balls are rigid bodies: the figure's reaction slows them down and throws them back.
 *
 * There are four variants: the complete skeleton, without limits, with equal bone masses, and the soft
 * body alone. Columns while six balls of 12 cm and 7 kg hit at 8 m/s: the largest bend at an elbow, a knee
 * or the neck from rest (`bend_deg`), the largest violation of a joint limit (`beyond_deg`), the mean sag
 * of the skin before the first hit (`sag_mm`), its largest displacement (`swing_mm`), and the mean impulse
 * of a ball (`given_n_s`). Columns eight seconds after the last ball: the remaining bend, which is the
 * error of the shape (`left_deg`), and the remaining displacement of the skin, including the figure's
 * swing about its hands (`left_mm`). Then the frames per second of one and of two figures on one thread
 * while balls hit.
 *
 * `--draw FOLDER` writes four moments of a throw side by side instead, as files for `sbfmt render`:
 * thrown-figure.sbf and thrown-flesh.sbf.
 *
 * Fails if limits are violated or have no effect, if a ball misses, or if the figure does not return to
 * its shape. */
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "measured_bodies.h"
#include "measuring.h"
#include "sbfmt/asset.h"
#include "sbfmt/build.h"
#include "sbfmt/io.h"
#include "sbrun/collision.h"
#include "sbrun/rigid.h"

enum { MARKS = 11, BENDS = 5, BALLS = 6, MAX_VERTICES = 4096, SETTLES = 360, EVERY = 30, RESTS = 480 };
enum { MAX_FIGURES = 2, MOMENTS = 4, QUICK_FRACTION = 3 }; /* of all that time and those balls */

static const double HANGS_M = 2;
static const float NEAR_M = 0.11f, BALL_M = 0.12f, BALL_KG = 7, BALL_M_S = 8, DEGREES = 57.29578f;

/* Places of the figure at rest: joints, and the middles of the limbs at them. */
static const sbf_vec3 marks[MARKS] = {{0, 1.2f, 0.1f}, {0, 1.43f, 0}, {0, 1.57f, 0}, {0.30f, 1.345f, 0},
    {0.42f, 1.36f, 0}, {0.54f, 1.38f, 0}, {0.105f, 0.69f, 0}, {0.115f, 0.5f, 0.01f}, {0.12f, 0.3f, 0},
    {-0.105f, 0.69f, 0}, {-0.115f, 0.5f, 0.01f}};
static const int bends[BENDS][3] = {{0, 1, 2}, {3, 4, 5}, {6, 7, 8}, {9, 10, -8}, {0, 6, 7}};
/* Where each ball hits. */
static const sbf_vec3 targets[BALLS] = {{0, 1.57f, 0}, {0.05f, 1.2f, 0}, {0.12f, 0.35f, 0},
    {-0.42f, 1.36f, 0}, {-0.1f, 0.7f, 0}, {0, 0.95f, 0.1f}};

typedef struct shape {
  uint32_t count;
  sbf_vec3 at[MAX_VERTICES];
} shape;

typedef struct scene {
  sbr_world *world;
  sbr_character_id character;
  const sbr_model *ball;
  uint32_t joint_count;
  const shape *rest;
} scene;

typedef struct result {
  float bend, beyond, sag, swing, given, left, left_m;
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

static void check(const scene *s, shape *to) {
  to->count = sbr_character_get_skin(s->world, s->character, 0, to->at, NULL, NULL, MAX_VERTICES);
  if (to->count > MAX_VERTICES) bench_fail("the figure has more vertices than there is room for");
}

/* Mean place of the skin that is near a place at rest. */
static sbf_vec3 attached(const scene *s, const shape *now, sbf_vec3 at) {
  sbf_vec3 sum = {0, 0, 0};
  float count = 0;
  for (uint32_t i = 0; i < now->count; i++) {
    sbf_vec3 off = minus(s->rest->at[i], at);
    if (dot(off, off) > NEAR_M * NEAR_M) continue;
    sum = (sbf_vec3){sum.x + now->at[i].x, sum.y + now->at[i].y, sum.z + now->at[i].z};
    count++;
  }
  if (!(count > 0)) bench_fail("no skin near %g %g %g", (double)at.x, (double)at.y, (double)at.z);
  return (sbf_vec3){sum.x / count, sum.y / count, sum.z / count};
}

static sbf_vec3 marked(const scene *s, const shape *now, int mark) {
  sbf_vec3 at = marks[mark < 0 ? -mark : mark];
  if (mark < 0) at.x = -at.x;
  return attached(s, now, at);
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
    float beyond = sbr_character_get_joint_state(s->world, s->character, j).angle_violation;
    r->beyond = beyond > r->beyond ? beyond : r->beyond;
  }
  float moved = rms(now, before);
  r->swing = moved > r->swing ? moved : r->swing;
}

/* A ball on its way to a place of a character's skin, half a metre off. */
static sbr_character_id throw_ball(const scene *s, sbf_vec3 aim) {
  sbr_character_definition definition = sbr_default_character_definition();
  sbr_double3 from = sbr_character_get_origin(s->world, s->character);
  sbr_character_id id;
  sbf_diagnostic error;
  from = (sbr_double3){from.x + (double)aim.x, from.y + (double)aim.y, from.z + (double)aim.z + 0.5};
  definition.position = from;
  bench_require(sbr_character_create(s->world, s->ball, &definition, &id, &error), &error);
  sbr_character_apply_rigid_impulse(s->world, id, 0, from, (sbf_vec3){0, 0, -BALL_KG * BALL_M_S});
  return id;
}

/* Throws one, goes on for a while, and takes it away. */
static void throw_and_note(const scene *s, int number, const shape *before, result *r) {
  static shape now;
  check(s, &now);
  sbr_character_id ball = throw_ball(s, attached(s, &now, targets[number]));
  for (int i = 0; i < EVERY; i++) {
    sbr_world_tick(s->world);
    check(s, &now);
    note(s, &now, before, r);
  }
  float given = BALL_KG * (BALL_M_S + sbr_character_get_rigid_state(s->world, ball, 0).velocity.z);
  if (!(given > 0.3f * BALL_KG * BALL_M_S)) bench_fail("ball %d passed by", number);
  r->given += given;
  sbr_character_destroy(s->world, ball);
}

static sbr_world *make_world(void) {
  sbr_world_definition definition = sbr_default_world_definition();
  sbr_world *world;
  sbf_diagnostic error;
  definition.sleep_after_s = 0;
  bench_require(sbr_world_create(&definition, &world, &error), &error);
  bench_require(sbr_world_enable_body_contacts(world, 0, &error), &error);
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

/* Hangs the figure up; `rest` is its shape before anything moves. */
static void hang_at_rest(scene *s, const sbr_model *model, double x, shape *rest) {
  s->rest = rest;
  s->character = hang(s->world, model, x);
  check(s, rest);
  float low = (float)(sbr_character_get_origin(s->world, s->character).y - HANGS_M);
  for (uint32_t i = 0; i < rest->count; i++) rest->at[i].y += low;
}

static result throw_all(const sbr_model *model, const sbr_model *ball, uint32_t joint_count, bool quick) {
  int portion = quick ? QUICK_FRACTION : 1;
  static shape rest, before, after;
  scene s = {.world = make_world(), .ball = ball, .joint_count = joint_count};
  result r = {0};
  hang_at_rest(&s, model, 0, &rest);
  for (int i = 0; i < SETTLES / portion; i++) sbr_world_tick(s.world);
  check(&s, &before);
  r.sag = rms(&before, &rest);
  for (int b = 0; b < BALLS / portion; b++) throw_and_note(&s, b, &before, &r);
  r.given /= (float)(BALLS / portion);
  for (int i = 0; i < RESTS / portion; i++) sbr_world_tick(s.world);
  check(&s, &after);
  r.left_m = rms(&after, &before);
  for (int b = 0; b < BENDS; b++) {
    float off = fabsf(angle_of(&s, &after, bends[b]) - angle_of(&s, &before, bends[b]));
    r.left = off > r.left ? off : r.left;
  }
  sbr_world_destroy(s.world);
  return r;
}

/* So many figures on one thread, a ball thrown at each every half second. */
static double frames_a_second(
    const sbr_model *model, const sbr_model *ball, uint32_t figures, uint32_t frames) {
  static shape rest, now;
  scene s[MAX_FIGURES];
  sbr_character_id balls[MAX_FIGURES];
  sbr_world *world = make_world();
  double spent = 0;
  for (uint32_t k = 0; k < figures; k++) {
    s[k] = (scene){.world = world, .ball = ball};
    hang_at_rest(&s[k], model, 2 * k, &rest);
  }
  for (uint32_t i = 0; i < frames; i++) {
    for (uint32_t k = 0; k < figures && i % EVERY == 0; k++) {
      if (i > 0) sbr_character_destroy(world, balls[k]);
      check(&s[k], &now);
      balls[k] = throw_ball(&s[k], attached(&s[k], &now, targets[i / EVERY % BALLS]));
    }
    double begin = bench_now_s();
    sbr_world_tick(world);
    spent += bench_now_s() - begin;
  }
  sbr_world_destroy(world);
  return frames / spent;
}

static sbr_model *model_of(const sbf_asset *asset) {
  sbr_model *model;
  sbf_diagnostic error;
  bench_require(sbr_model_create(asset, NULL, &model, &error), &error);
  return model;
}

static result measure(const char *name, const sbf_asset *asset, bool quick) {
  sbf_asset *round = ball_asset(BALL_M, BALL_KG);
  sbr_model *ball = model_of(round), *model = model_of(asset);
  uint32_t frames = bench_runs_once() ? 10 : 300;
  result r = throw_all(model, ball, asset->joints.count, quick);
  bench_print_row("%s,%u,%u,%u,%.1f,%.3f,%.1f,%.1f,%.1f,%.2f,%.1f,%.0f,%.0f", name,
      asset->soft_bodies.at[0].levels.at[0].lattice.tetrahedra.count,
      asset->render_meshes.at[0].mesh.polygon_sizes.count, asset->joints.count, (double)(r.bend * DEGREES),
      (double)(r.beyond * DEGREES), (double)(1000 * r.sag), (double)(1000 * r.swing), (double)r.given,
      (double)(r.left * DEGREES), (double)(1000 * r.left_m), frames_a_second(model, ball, 1, frames),
      frames_a_second(model, ball, 2, frames));
  sbr_model_destroy(model), sbr_model_destroy(ball);
  sbf_asset_free(round);
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
  sbf_asset *even = read_figure("figure.sbf"), *soft_figure = read_figure("flesh.sbf");
  even_masses(even);
  (void)measure("skeleton of even masses", even, false);
  (void)measure("flesh alone", soft_figure, false);
  sbf_asset_free(even), sbf_asset_free(soft_figure);
}

/* ---- Pictures ---- */

/* Adds a mesh with the same faces and other points; slot: its material. */
static void add_mesh(sbf_asset *to, sbf_render_mesh *mesh, const char *id, const sbf_polygon_mesh *like,
    const sbf_vec3 *at, sbf_vec3 shift, const sbf_material_slot *slot) {
  sbf_vec3 *points = sbf_asset_allocate(to, like->positions.count, sizeof *points);
  if (!points) bench_fail("memory ran out");
  for (uint32_t i = 0; i < like->positions.count; i++)
    points[i] = (sbf_vec3){at[i].x + shift.x, at[i].y + shift.y, at[i].z + shift.z};
  sbf_render_mesh_init(mesh);
  mesh->id = id;
  mesh->mesh.positions = (sbf_vec3_list){points, like->positions.count};
  mesh->mesh.polygon_sizes = like->polygon_sizes;
  mesh->mesh.polygon_points = like->polygon_points;
  mesh->material_slots = (sbf_material_slot_list){slot, 1};
}

/* Four moments of a ball that hits a thigh, beside each other. */
static void draw_throw(const char *name, const char *folder) {
  static const int moments[MOMENTS] = {2, 5, 9, 14};
  static const char *const ids[2 * MOMENTS] = {"a", "a_ball", "b", "b_ball", "c", "c_ball", "d", "d_ball"};
  static shape rest, now;
  char path[512];
  sbf_asset *figure = read_figure(name), *round = ball_asset(BALL_M, BALL_KG),
            *drawn = sbf_asset_create(NULL);
  sbf_render_mesh *meshes = drawn ? sbf_asset_allocate(drawn, 2 * MOMENTS, sizeof *meshes) : NULL;
  const sbf_polygon_mesh *skin = &figure->render_meshes.at[0].mesh, *hull = round->rigid_bodies.at[0].hull;
  sbr_model *model = model_of(figure), *ball = model_of(round);
  scene s = {.world = make_world(), .ball = ball};
  sbf_diagnostic error;
  static const sbf_material_slot slots[2] = {{0}, {1}};
  sbf_material *materials = drawn ? sbf_asset_allocate(drawn, 2, sizeof *materials) : NULL;
  if (!meshes || !materials) bench_fail("memory ran out");
  for (int k = 0; k < 2; k++) sbf_material_init(&materials[k]);
  materials[0].id = "flesh", materials[0].base_color = (sbf_vec4){0.12f, 0.42f, 0.2f, 1};
  materials[1].id = "ball", materials[1].base_color = (sbf_vec4){0.8f, 0.25f, 0.03f, 1};
  drawn->materials = (sbf_material_list){materials, 2};
  hang_at_rest(&s, model, 0, &rest);
  for (int i = 0; i < SETTLES; i++) sbr_world_tick(s.world);
  check(&s, &now);
  sbr_character_id thrown = throw_ball(&s, attached(&s, &now, targets[4]));
  for (int i = 0, next = 0; next < MOMENTS; i++) {
    sbr_world_tick(s.world);
    if (i != moments[next]) continue;
    sbr_double3 o = sbr_character_get_origin(s.world, s.character),
                b = sbr_character_get_origin(s.world, thrown);
    sbf_vec3 c = sbr_character_get_rigid_state(s.world, thrown, 0).center;
    float across = 1.75f * (float)next;
    check(&s, &now);
    add_mesh(drawn, &meshes[2 * next], ids[2 * next], skin, now.at,
        (sbf_vec3){across + (float)o.x, (float)o.y, (float)o.z}, &slots[0]);
    add_mesh(drawn, &meshes[2 * next + 1], ids[2 * next + 1], hull, hull->positions.at,
        (sbf_vec3){across + c.x + (float)b.x, c.y + (float)b.y, c.z + (float)b.z}, &slots[1]);
    next++;
  }
  drawn->render_meshes = (sbf_render_mesh_list){meshes, 2 * MOMENTS};
  (void)snprintf(path, sizeof path, "%s/thrown-%s", folder, name);
  bench_require(sbf_save_file(drawn, path, NULL, &error), &error);
  sbr_world_destroy(s.world);
  sbr_model_destroy(model), sbr_model_destroy(ball);
  sbf_asset_free(drawn), sbf_asset_free(figure), sbf_asset_free(round);
}

int main(int argc, char **argv) {
  if (argc == 3 && strcmp(argv[1], "--draw") == 0) {
    draw_throw("figure.sbf", argv[2]), draw_throw("flesh.sbf", argv[2]);
    return 0;
  }
  bool quick = bench_is_quick(argc, argv);
  sbf_asset *figure = read_figure("figure.sbf");
  bench_print_columns(
      "variant,tetrahedra,polygons,joints,bend_deg,beyond_deg,sag_mm,swing_mm,given_n_s,left_deg,left_mm,"
      "one_fps,two_at_once_fps");
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
