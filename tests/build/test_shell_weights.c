#include "build/weights/shell_weights.h"

#include <stdlib.h>
#include <string.h>

#include "harness.h"
#include "rigged_tubes.h"

enum { BONES = 3 };

static rigged_tubes *tubes;
static sbfi_arena arena;
static sbfi_weight_mesh mesh;
static sbfi_site_weights *weights;
static sbfi_bone_segment segments[BONES];
static bool holds[24];
static sbfi_weights_figures figures;

static void setup(void) {
  tubes = calloc(1, sizeof *tubes);
  ck_assert_ptr_nonnull(tubes);
  sbfi_arena_init(&arena, NULL, 0);
  for (int b = 0; b < BONES; b++)
    segments[b] =
        (sbfi_bone_segment){.head = {9, 9, 9}, .tail = {9, 9, 9}, .next = SBF_NONE, .is_deforming = true};
  memset(holds, 0, sizeof holds);
}

static void teardown(void) {
  sbfi_arena_free(&arena);
  free(tubes);
}

/* The weights of all sites of a shell; those of two bones where `fraction` of the first is below 1. */
static void weigh(uint32_t shell, uint32_t bone, uint32_t other, float fraction) {
  for (uint32_t i = 0; i < mesh.site_count; i++) {
    if (mesh.shell_of_site[i] != shell) continue;
    for (int k = 0; k < SBFI_SITE_BONES; k++) weights[i].bones[k] = UINT32_MAX, weights[i].weights[k] = 0;
    weights[i].bones[0] = bone, weights[i].weights[0] = fraction;
    if (fraction < 1) weights[i].bones[1] = other, weights[i].weights[1] = 1 - fraction;
  }
}

static void make_mesh(void) {
  sbfi_weights_input in = tubes_input(tubes);
  ck_assert_int_eq(sbfi_weight_mesh_make(&mesh, &in, &arena), SBFI_WEIGHT_MESH_GOOD);
  weights = sbfi_arena_allocate(&arena, mesh.site_count, sizeof *weights);
}

static void repair(void) {
  const sbfi_bone_reach reach = {.shell_contains_bone = holds};
  figures = (sbfi_weights_figures){0};
  ck_assert(sbfi_shell_weights_repair(&mesh, segments, BONES, &reach, weights, &figures, &arena));
}

static void check_shell(uint32_t shell, uint32_t bone) {
  for (uint32_t i = 0; i < mesh.site_count; i++)
    if (mesh.shell_of_site[i] == shell) {
      ck_assert_uint_eq(weights[i].bones[0], bone);
      ck_assert_float_eq(weights[i].weights[0], 1);
    }
}

/* An eye in a head beside a finger: the finger's bone is the nearest to it, and no bone runs through it. */
START_TEST(small_shells_copy_the_shell_beside_them)
{
  const sbfi_d3 finger[] = {{0.62, 0, 0}, {1.2, 0, 0}};
  tubes_add_ball(tubes, (sbfi_d3){0, 0, 0}, 0.5, 24);
  tubes_add_ball(tubes, (sbfi_d3){0.5, 0, 0}, 0.04, 8);
  tubes_add(tubes, finger, 2, 0.05, 12, false);
  make_mesh();
  holds[0] = holds[2] = true;
  weigh(0, 0, 0, 1);
  weigh(1, 1, 0, 1);
  weigh(2, 1, 0, 1);
  repair();
  check_shell(0, 0);
  check_shell(1, 0);
  check_shell(2, 1);
  holds[1] = true; /* with a bone of its own it keeps it */
  weigh(1, 1, 0, 1);
  repair();
  check_shell(1, 1);
}
END_TEST

/* A middling shell is rigid where one bone leads clearly; a large one never. */
START_TEST(middling_shells_follow_a_clear_lead)
{
  const sbfi_d3 body[] = {{0, 0, 0}, {1, 0, 0}}, belt[] = {{0.4, 0.3, 0}, {0.7, 0.3, 0}};
  tubes_add(tubes, body, 2, 0.2, 12, false);
  tubes_add(tubes, belt, 2, 0.05, 6, false);
  make_mesh();
  holds[0] = holds[1] = true;
  weigh(0, 0, 1, 0.9f);
  weigh(1, 0, 1, 0.9f);
  repair();
  check_shell(1, 0);
  ck_assert_uint_eq(figures.rigid_shell_count, 1);
  weigh(1, 0, 1, 0.7f);
  repair();
  ck_assert_uint_eq(figures.rigid_shell_count, 0);
}
END_TEST

/* A shell with equal influence of both sides belongs to the bone between them. */
START_TEST(shells_across_the_middle_are_of_neither_side)
{
  tubes_add_ball(tubes, (sbfi_d3){0, 0, 0}, 1, 12);
  tubes_add_ball(tubes, (sbfi_d3){0, 1.1, 0}, 0.08, 8);
  make_mesh();
  holds[0] = holds[1] = true;
  segments[1].side = 1;
  segments[2].side = -1;
  weigh(0, 0, 0, 1);
  weigh(1, 1, 2, 0.5f);
  for (uint32_t i = 0; i < mesh.site_count; i++)
    if (mesh.shell_of_site[i] == 1) {
      weights[i].weights[0] = 0.45f, weights[i].weights[1] = 0.35f;
      weights[i].bones[2] = 0, weights[i].weights[2] = 0.2f;
    }
  repair();
  check_shell(1, 0);
}
END_TEST

/* The ball of a joint moves with the bone that begins in its middle, whichever bone is the parent. */
START_TEST(hinges_follow_the_bone_that_begins_there)
{
  const sbfi_d3 arm[] = {{0, 0, 0}, {3, 0, 0}};
  tubes_add(tubes, arm, 2, 0.1, 12, false);
  tubes_add_ball(tubes, (sbfi_d3){1.5, 0, 0}, 0.15, 8);
  make_mesh();
  holds[0] = holds[1] = true;
  weigh(0, 0, 0, 1);
  weigh(1, 0, 1, 0.8f);
  segments[1].head = sbfi_weight_mesh_position(&mesh, (sbf_vec3){1.5f, 0, 0});
  repair();
  check_shell(1, 1);
  segments[2].head = segments[1].head; /* two begin there: the leading one */
  weigh(1, 0, 1, 0.8f);
  repair();
  check_shell(1, 0);
}
END_TEST

/* --- Machines: more parts than a character with a skin has ---------------------------------------------- */

enum { PARTS = 16 };

/* Shells 0 to 15 are balls of bone 2; those of the test follow. */
static void add_machine(void) {
  for (int i = 0; i < PARTS; i++) tubes_add_ball(tubes, (sbfi_d3){-6, 0, 1.5 * i}, 0.5, 8);
}

static void lay_bone(uint32_t bone, sbf_vec3 head, sbf_vec3 tail, int32_t next) {
  segments[bone].head = sbfi_weight_mesh_position(&mesh, head);
  segments[bone].tail = sbfi_weight_mesh_position(&mesh, tail);
  segments[bone].next = next;
}

/* All parts lie inside their bones; `bone` leads those of the test. */
static void weigh_machine(uint32_t bone) {
  for (uint32_t s = 0; s < mesh.shell_count; s++) {
    holds[s] = true;
    weigh(s, s < PARTS ? 2 : bone, 0, 1);
  }
}

START_TEST(kneecaps_follow_the_lower_leg)
{
  add_machine();
  tubes_add_ball(tubes, (sbfi_d3){4.4, 0.3, 0}, 0.5, 8); /* beyond the end of its bone */
  tubes_add_ball(tubes, (sbfi_d3){3.8, 0.5, 0}, 0.5, 8); /* at it */
  tubes_add_ball(tubes, (sbfi_d3){5.2, 0, 0}, 0.5, 8);   /* far beyond */
  make_mesh();
  lay_bone(0, (sbf_vec3){0, 0, 0}, (sbf_vec3){4, 0, 0}, 1);
  lay_bone(1, (sbf_vec3){4, 0, 0}, (sbf_vec3){4, -4, 0}, SBF_NONE);
  weigh_machine(0);
  repair();
  check_shell(PARTS, 1);
  check_shell(PARTS + 1, 0);
  check_shell(PARTS + 2, 0);
  lay_bone(0, (sbf_vec3){3.5f, 0, 0}, (sbf_vec3){4, 0, 0}, 1); /* shorter than the part */
  weigh_machine(0);
  repair();
  check_shell(PARTS, 0);
}
END_TEST

START_TEST(toes_follow_the_foot)
{
  add_machine();
  tubes_add_ball(tubes, (sbfi_d3){0, 0.1, 0.8}, 0.3, 8);
  tubes_add_ball(tubes, (sbfi_d3){0, 0.5, -0.4}, 0.3, 8); /* heel */
  tubes_add_ball(tubes, (sbfi_d3){0, 2, 0.6}, 0.3, 8);    /* shin */
  make_mesh();
  lay_bone(0, (sbf_vec3){0, 4, 0}, (sbf_vec3){0, 0.2f, 0}, 1);
  lay_bone(1, (sbf_vec3){0, 0.2f, 0}, (sbf_vec3){0, 0.2f, 0.1f}, SBF_NONE);
  weigh_machine(0);
  repair();
  check_shell(PARTS, 1);
  check_shell(PARTS + 1, 0);
  check_shell(PARTS + 2, 0);
}
END_TEST

START_TEST(axles_stay_with_the_body)
{
  const sbfi_d3 axle[] = {{1, 0, 0}, {2.2, 0, 0}}, thigh[] = {{2.1, 0.3, 0}, {2.1, -1, 0}},
                outside[] = {{1.9, 0.1, 0}, {3.2, 0.1, 0}};
  add_machine();
  tubes_add(tubes, axle, 2, 0.15, 8, false);
  tubes_add(tubes, thigh, 2, 0.2, 8, false);
  tubes_add(tubes, outside, 2, 0.15, 8, false);
  make_mesh();
  lay_bone(0, (sbf_vec3){0, 0, 0}, (sbf_vec3){0, 2, 0}, SBF_NONE);
  lay_bone(1, (sbf_vec3){2, 0, 0}, (sbf_vec3){2, -3, 0}, SBF_NONE);
  weigh_machine(1);
  repair();
  check_shell(PARTS, 0);
  check_shell(PARTS + 1, 1);
  check_shell(PARTS + 2, 1);
}
END_TEST

static Suite *suite(void) {
  Suite *s = suite_create("shell_weights");
  TCase *c = tcase_create("shell_weights");
  tcase_add_checked_fixture(c, setup, teardown);
  tcase_add_test(c, small_shells_copy_the_shell_beside_them);
  tcase_add_test(c, middling_shells_follow_a_clear_lead);
  tcase_add_test(c, shells_across_the_middle_are_of_neither_side);
  tcase_add_test(c, hinges_follow_the_bone_that_begins_there);
  tcase_add_test(c, kneecaps_follow_the_lower_leg);
  tcase_add_test(c, toes_follow_the_foot);
  tcase_add_test(c, axles_stay_with_the_body);
  suite_add_tcase(s, c);
  return s;
}

int main(void) {
  return harness_run(suite());
}
