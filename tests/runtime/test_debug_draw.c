/* What sbr_world_draw shows, against the state that it shows. */
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "sbrun/debug.h"

#include "collision_scenes.h"
#include "harness.h"
#include "quadruped.h"
#include "rigid_scenes.h"

enum { MAX_LINES = 4096, RED = 0xe05040, GREY = 0x808890, BLUE = 0x4080e0 };

typedef struct drawn_line {
  sbr_double3 from, to;
  uint32_t color;
} drawn_line;

typedef struct drawing {
  drawn_line lines[MAX_LINES];
  uint32_t line_count, point_count;
} drawing;

static drawing sheet;

static void note_line(void *user, sbr_double3 from, sbr_double3 to, uint32_t color) {
  drawing *d = user;
  ck_assert_uint_lt(d->line_count, MAX_LINES);
  d->lines[d->line_count++] = (drawn_line){from, to, color};
}

static void note_point(void *user, sbr_double3 position, float size_pixels, uint32_t color) {
  (void)position, (void)color;
  ck_assert_float_gt(size_pixels, 0);
  ((drawing *)user)->point_count++;
}

static drawing *draw(const sbr_world *world, uint32_t parts) {
  sbr_debug_draw to = sbr_default_debug_draw();
  to.line = note_line, to.point = note_point, to.user = &sheet, to.parts = parts;
  to.impulse_m = 0.01f;
  memset(&sheet, 0, sizeof sheet);
  sbr_world_draw(world, &to);
  return &sheet;
}

static double length_of(const drawn_line *line) {
  double x = line->to.x - line->from.x, y = line->to.y - line->from.y, z = line->to.z - line->from.z;
  return sqrt(x * x + y * y + z * z);
}

/* Sum of the heights of the contacts' lines, as N s. */
static double upward_impulse(const drawing *d) {
  double sum = 0;
  for (uint32_t i = 0; i < d->line_count; i++) {
    ck_assert_uint_eq(d->lines[i].color, RED);
    ck_assert_double_lt(fabs(d->lines[i].from.y), 2e-3);
    sum += (d->lines[i].to.y - d->lines[i].from.y) / 0.01;
  }
  return sum;
}

/* A loose block of tetrahedra, 8 kg, on the ground. */
static scene lying_block(float scale) {
  scene s = scene_begin();
  lattice_box box =
      lattice_box_make((sbf_vec3){-0.1f, 0, -0.1f}, (sbf_vec3){0.2f, 0.2f, 0.2f}, 2, 2, 2, 1000, 2e5f, 0.4f);
  scene_bone(&s, (sbf_vec3){0, 0.1f, 0});
  scene_section(&s, 0, (sbf_vec3){0, 0.1f, 0}, (sbf_vec3){0.2f, 0.2f, 0.2f}, 3);
  scene_embed(&s, scene_lattice(&s, 0, &box), &box);
  lattice_box_free(&box);
  scene_body(&s, 0)->attributes.damping_ratio = 1;
  s.model_options.free = true;
  s.world_definition.ground = sbr_ground_flat(0);
  s.world_definition.gravity = (sbf_vec3){0, -9.81f, 0};
  s.character_definition.position.y = 0;
  s.character_definition.scale = scale;
  scene_start(&s);
  scene_ticks(&s, 300);
  return s;
}

START_TEST(contacts_of_a_lying_body_carry_its_weight)
{
  const float scale = _i ? 1.5f : 1;
  scene s = lying_block(scale);
  double weight = 8 * pow((double)scale, 3) * 9.81;
  uint64_t before = sbr_world_get_state_hash(s.world);
  ck_assert_double_eq_tol(upward_impulse(draw(s.world, SBR_DRAW_CONTACTS)) * 60, weight, 0.03 * weight);
  ck_assert_uint_gt(sheet.point_count, 4);
  ck_assert_uint_eq(sbr_world_get_state_hash(s.world), before);
  scene_free(&s);
}
END_TEST

START_TEST(contacts_of_a_rigid_body_carry_its_weight)
{
  scene s = rigid_begin();
  s.world_definition.ground = sbr_ground_flat(0);
  s.world_definition.gravity = (sbf_vec3){0, -9.81f, 0};
  s.character_definition.position.y = 0;
  rigid_box(&s, (sbf_vec3){0, 0.1f, 0}, (sbf_vec3){0.2f, 0.2f, 0.2f}, 8);
  scene_start(&s);
  scene_ticks(&s, 120);
  ck_assert_double_eq_tol(upward_impulse(draw(s.world, SBR_DRAW_CONTACTS)) * 60, 8 * 9.81, 0.03 * 8 * 9.81);
  ck_assert_uint_eq(draw(s.world, SBR_DRAW_RIGID_BODIES)->line_count, 12);
  for (uint32_t i = 0; i < 12; i++) ck_assert_double_eq_tol(length_of(&sheet.lines[i]), 0.2, 1e-6);
  scene_free(&s);
}
END_TEST

START_TEST(springs_are_coloured_by_strain)
{
  scene s = scene_begin();
  const sbf_vec3 at[] = {{0, 0, 0}, {1.2f, 0, 0}, {2.0f, 0, 0}, {3, 0, 0}};
  const float masses[] = {1, 1, 1, 1}, stiffness[] = {1, 1, 1};
  const sbf_uint2 ends[] = {{{0, 1}}, {{1, 2}}, {{2, 3}}};
  sbf_level *level = scene_points(&s, 0, at, masses, 4);
  scene_springs(&s, level, ends, stiffness, 3);
  float rest[] = {1, 1, 1};
  ((sbf_spring_set *)(uintptr_t)level->springs.at)->rest_lengths = (sbf_f32_list){rest, 3};
  scene_start(&s);
  ck_assert_uint_eq(draw(s.world, SBR_DRAW_SPRINGS)->line_count, 3);
  const uint32_t colors[3] = {RED, BLUE, GREY};
  const double lengths[3] = {1.2, 0.8, 1};
  for (uint32_t i = 0; i < 3; i++)
    for (uint32_t k = 0; k < 3; k++)
      if (fabs(length_of(&sheet.lines[i]) - lengths[k]) < 1e-6)
        for (int shift = 0; shift < 24; shift += 8)
          ck_assert_int_le(
              abs((int)(sheet.lines[i].color >> shift & 255) - (int)(colors[k] >> shift & 255)), 1);
  scene_free(&s);
}
END_TEST

START_TEST(bounds_enclose_an_island_and_sleepers_are_grey)
{
  scene s = scene_begin();
  scene_bone(&s, (sbf_vec3){0, 1, 0});
  scene_section(&s, 0, (sbf_vec3){0, 1, 0}, (sbf_vec3){0.3f, 0.2f, 0.4f}, 3);
  scene_body(&s, 0)->attributes.damping_ratio = 0.3f;
  s.world_definition.sleep_after_s = 0.5;
  scene_start(&s);
  scene_ticks(&s, 2);
  sbf_vec3 points[512], low = {1e9f, 1e9f, 1e9f};
  uint32_t count = scene_read(&s, 0, points, 512);
  for (uint32_t i = 0; i < count; i++) {
    low.x = fminf(low.x, points[i].x), low.y = fminf(low.y, points[i].y), low.z = fminf(low.z, points[i].z);
  }
  sbr_double3 origin = sbr_character_get_origin(s.world, s.character);
  ck_assert_uint_eq(draw(s.world, SBR_DRAW_BOUNDS)->line_count, 12);
  ck_assert_double_eq_tol(sheet.lines[0].from.x, origin.x + (double)low.x, 1e-5);
  ck_assert_double_eq_tol(sheet.lines[0].from.y, origin.y + (double)low.y, 1e-5);
  ck_assert_double_eq_tol(sheet.lines[0].from.z, origin.z + (double)low.z, 1e-5);
  ck_assert_uint_ne(sheet.lines[0].color, GREY);
  ck_assert_uint_gt(draw(s.world, SBR_DRAW_SURFACES)->line_count, 100);
  scene_ticks(&s, 600);
  ck_assert_uint_eq(draw(s.world, SBR_DRAW_BOUNDS)->lines[0].color, GREY);
  scene_free(&s);
}
END_TEST

START_TEST(joints_show_their_frames_limits_and_error)
{
  scene s = rigid_begin();
  uint32_t body = rigid_box(&s, (sbf_vec3){0, -0.5f, 0}, (sbf_vec3){0.1f, 0.1f, 0.1f}, 1);
  sbf_joint *joint =
      rigid_joint(&s, SBF_JOINT_KIND_SPHERICAL, -1, body, (sbf_vec3){0, 0, 0}, (sbf_quat){0, 0, 0, 1});
  rigid_limit(&s, joint, (sbf_limit){.target = SBF_JOINT_AXIS_SWING, .min = 0, .max = 0.5f});
  scene_start(&s);
  drawing *d = draw(s.world, SBR_DRAW_JOINTS);
  ck_assert_uint_eq(d->line_count, 3 + 3 + 1 + 24 + 4); /* two frames, their distance, a cone */
  ck_assert_double_lt(length_of(&d->lines[6]), 1e-5);
  double size = length_of(&d->lines[0]);
  for (uint32_t i = d->line_count - 4; i < d->line_count; i++) {
    ck_assert_double_eq_tol(length_of(&d->lines[i]), size, 1e-5);
    ck_assert_double_eq_tol((d->lines[i].to.x - d->lines[i].from.x) / size, cos(0.5), 1e-5);
  }
  scene_free(&s);
}
END_TEST

START_TEST(colliders_are_drawn_where_they_are)
{
  scene s = lying_block(1);
  sbr_shape *ball = collision_shape(collision_ball(0.25f)),
            *box = collision_shape(collision_box(0.1f, 0.2f, 0.3f));
  collision_collider(&s, ball, (sbr_double3){2, 5, 1});
  draw(s.world, SBR_DRAW_COLLIDERS);
  ck_assert_uint_gt(sheet.line_count, 24);
  for (uint32_t i = 0; i < sheet.line_count; i++) {
    drawn_line from_center = {{2, 5, 1}, sheet.lines[i].from, 0};
    ck_assert_double_eq_tol(length_of(&from_center), 0.25, 1e-6);
  }
  sbr_collider_id id = collision_collider(&s, box, (sbr_double3){0, 0, 0});
  uint32_t round_lines = sheet.line_count;
  sbr_collider_set_transform(s.world, id, (sbr_double3){7, 0, 0}, (sbf_quat){0, 0, 0.70710678f, 0.70710678f});
  scene_ticks(&s, 1);
  ck_assert_uint_eq(draw(s.world, SBR_DRAW_COLLIDERS)->line_count, round_lines + 12);
  double right = 0;
  for (uint32_t i = round_lines; i < sheet.line_count; i++) right = fmax(right, sheet.lines[i].from.x);
  ck_assert_double_eq_tol(right, 7.2, 1e-6);
  scene_free(&s);
  sbr_shape_destroy(ball), sbr_shape_destroy(box);
}
END_TEST

START_TEST(a_walker_shows_bones_and_feet)
{
  scene s = scene_begin();
  sbf_asset_free(s.asset);
  s.asset = quadruped_asset();
  s.world_definition.ground = sbr_ground_flat(0);
  s.world_definition.gravity = (sbf_vec3){0, -9.81f, 0};
  s.character_definition.position.y = 0;
  scene_start(&s);
  sbr_character_set_drive(s.world, s.character, 0.5f, 0, 0);
  scene_ticks(&s, 40);
  sbr_leg_state legs[4];
  uint32_t lifted = 0, count = sbr_character_get_legs(s.world, s.character, legs, 4);
  for (uint32_t i = 0; i < count; i++) lifted += !legs[i].planted;
  draw(s.world, SBR_DRAW_GAIT);
  ck_assert_uint_eq(sheet.point_count, 2 * count + lifted);
  ck_assert_uint_eq(sheet.line_count, lifted);
  ck_assert_uint_eq(draw(s.world, SBR_DRAW_BONES)->line_count, s.asset->bones.count);
  scene_free(&s);
}
END_TEST

START_TEST(nothing_is_drawn_without_a_world_or_functions)
{
  scene s = lying_block(1);
  sbr_debug_draw to = sbr_default_debug_draw();
  sbr_world_draw(s.world, &to);
  sbr_world_draw(s.world, NULL);
  to.line = note_line, to.user = &sheet;
  memset(&sheet, 0, sizeof sheet);
  sbr_world_draw(NULL, &to);
  to.cookie = 0;
  sbr_world_draw(s.world, &to);
  ck_assert_uint_eq(sheet.line_count, 0);
  scene_free(&s);
}
END_TEST

int main(void) {
  Suite *suite = suite_create("debug_draw");
  TCase *c = tcase_create("debug_draw");
  tcase_add_loop_test(c, contacts_of_a_lying_body_carry_its_weight, 0, 2);
  tcase_add_test(c, contacts_of_a_rigid_body_carry_its_weight);
  tcase_add_test(c, springs_are_coloured_by_strain);
  tcase_add_test(c, bounds_enclose_an_island_and_sleepers_are_grey);
  tcase_add_test(c, joints_show_their_frames_limits_and_error);
  tcase_add_test(c, colliders_are_drawn_where_they_are);
  tcase_add_test(c, a_walker_shows_bones_and_feet);
  tcase_add_test(c, nothing_is_drawn_without_a_world_or_functions);
  suite_add_tcase(suite, c);
  return harness_run(suite);
}
