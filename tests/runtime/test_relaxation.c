#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "harness.h"
#include "reference_relaxation.h"
#include "scenes.h"

enum { TICKS = 240 };
static const float tolerance_m = 1e-5f;

static sbf_uint2_list ends_of(scene *s, const reference_pair *pairs, uint32_t count, uint32_t pinned_from) {
  sbf_uint2 *ends = sbf_asset_allocate(s->asset, count, sizeof *ends);
  uint32_t kept = 0;
  for (uint32_t i = 0; i < count; i++)
    if (pairs[i].a < pinned_from || pairs[i].b < pinned_from)
      ends[kept++] = (sbf_uint2){{pairs[i].a, pairs[i].b}};
  return (sbf_uint2_list){ends, kept};
}

/* A soft body with the section's points and springs, its inside held by the bone. */
static void make_body(scene *s, uint32_t index, const reference_section *from) {
  sbf_soft_body *body = scene_body(s, index);
  sbf_vec3 *positions = calloc(from->point_count, sizeof *positions);
  for (uint32_t i = 0; i < from->point_count; i++)
    positions[i] = (sbf_vec3){from->at[i][0], from->at[i][1], from->at[i][2]};
  sbf_level *level = scene_points(s, index, positions, NULL, from->point_count);
  body->bone = 0;
  body->surface.positions = (sbf_vec3_list){level->positions.at, from->surface_count};
  uint32_t *sizes = sbf_asset_allocate(s->asset, from->face_count, sizeof *sizes);
  uint32_t *corners = sbf_asset_allocate(s->asset, 4 * (size_t)from->face_count, sizeof *corners), count = 0;
  for (uint32_t f = 0; f < from->face_count; f++) {
    sizes[f] = from->faces[f].count;
    for (uint32_t c = 0; c < sizes[f]; c++) corners[count++] = from->faces[f].corners[c];
  }
  body->surface.polygon_sizes = (sbf_u32_list){sizes, from->face_count};
  body->surface.polygon_points = (sbf_u32_list){corners, count};
  uint32_t pinned_count = from->point_count - from->surface_count;
  uint32_t *pinned = calloc(pinned_count, sizeof *pinned);
  for (uint32_t i = 0; i < pinned_count; i++) pinned[i] = from->surface_count + i;
  scene_pin(s, level, 0, pinned, pinned_count);
  /* Sets in another order than the visits, which are ordered by kind. */
  const sbf_spring_kind kinds[] = {
      SBF_SPRING_KIND_SHEAR, SBF_SPRING_KIND_STRUCTURAL, SBF_SPRING_KIND_INTERNAL};
  const reference_pair *pairs[] = {from->diagonals, from->edges, from->inner};
  const uint32_t counts[] = {from->diagonal_count, from->edge_count, from->inner_count};
  sbf_spring_set *sets = sbf_asset_allocate(s->asset, 3, sizeof *sets);
  for (int k = 0; k < 3; k++) {
    sbf_spring_set_init(&sets[k]);
    sets[k].kind = kinds[k];
    sets[k].ends = ends_of(s, pairs[k], counts[k], from->surface_count);
  }
  level->springs = (sbf_spring_set_list){sets, 3};
  free(pinned);
  free(positions);
}

/* Greatest distance of a used surface point from the reference over all ticks. */
static float compare(const char *obj, float gravity, float stiffness, bool ground) {
  reference_body reference;
  ck_assert(reference_read(&reference, obj));
  scene s = scene_begin();
  scene_bodies(&s, reference.section_count);
  scene_bone(&s, (sbf_vec3){0, 0, 0});
  for (uint32_t i = 0; i < reference.section_count; i++) make_body(&s, i, &reference.sections[i]);
  s.asset->relaxation.stiffness = stiffness;
  s.asset->relaxation.gravity = gravity;
  s.model_options.scheme = SBF_SCHEME_RELAXATION;
  s.character_definition.hold_pose = true;
  s.character_definition.position.y = ground ? 0 : 1000;
  s.world_definition.ground = sbr_ground_flat(ground ? 0 : -1000);
  scene_start(&s);
  float worst = 0;
  sbf_vec3 points[256];
  for (int tick = 0; tick < TICKS; tick++) {
    reference_tick(&reference, gravity, stiffness, ground);
    scene_ticks(&s, 1);
    for (uint32_t i = 0; i < reference.section_count; i++) {
      const reference_section *section = &reference.sections[i];
      ck_assert_uint_eq(scene_read(&s, i, points, 256), section->point_count);
      for (uint32_t p = 0; p < section->surface_count; p++) {
        if (!section->used[p]) continue;
        float x = points[p].x - section->at[p][0], y = points[p].y - section->at[p][1],
              z = points[p].z - section->at[p][2];
        worst = fmaxf(worst, sqrtf(x * x + y * y + z * z));
      }
    }
  }
  reference_free(&reference);
  scene_free(&s);
  return worst;
}

START_TEST(the_reference_lizard_on_the_ground)
{
  const char *path = harness_shared("lizard/liz.obj");
  if (!path) return;
  char *obj = harness_read(path, NULL);
  ck_assert_ptr_nonnull(obj);
  ck_assert_float_le(compare(obj, 0.001f, 0.3f, true), tolerance_m);
  free(obj);
}
END_TEST

START_TEST(the_reference_lizard_in_the_air)
{
  const char *path = harness_shared("lizard/liz.obj");
  if (!path) return;
  char *obj = harness_read(path, NULL);
  ck_assert_ptr_nonnull(obj);
  ck_assert_float_le(compare(obj, 0.001f, 0.5f, false), tolerance_m);
  free(obj);
}
END_TEST

/* Two quads and a triangle, a corner of it in the ground. */
static const char *scrap =
    "g Scrap_1\nv -1 0.2 0\nv 0 0.5 0\nv 0 0.5 1\nv -1 -0.1 1\nv 1 0.4 0\nv 1 0.3 1\nv 0.5 0.9 2\n"
    "f 1 2 3 4\nf 2 5 6 3\nf 3 6 7\n";

START_TEST(a_small_mesh)
{
  ck_assert_float_le(compare(scrap, 0.001f, 0.3f, true), tolerance_m);
  ck_assert_float_le(compare(scrap, 0.01f, 0.5f, false), tolerance_m);
  ck_assert_float_le(compare(scrap, 0.02f, 0.2f, true), tolerance_m);
}
END_TEST

START_TEST(the_reference_moves_at_all)
{
  reference_body body;
  ck_assert(reference_read(&body, scrap));
  ck_assert_uint_eq(body.sections[0].edge_count, 9);
  ck_assert_uint_eq(body.sections[0].diagonal_count, 4);
  ck_assert_uint_eq(body.sections[0].inner_count, 7 + 2 * 5);
  float before = body.sections[0].at[6][1];
  for (int i = 0; i < 60; i++) reference_tick(&body, 0.001f, 0.3f, true);
  ck_assert_float_lt(body.sections[0].at[6][1], before - 0.001f);
  ck_assert_float_ge(body.sections[0].at[3][1], 0);
  reference_free(&body);
}
END_TEST

START_TEST(pinned_points_drag_the_body_along)
{
  scene s = scene_begin();
  scene_bone(&s, (sbf_vec3){0, 0, 0});
  scene_section(&s, 0, (sbf_vec3){0, 1, 0}, (sbf_vec3){0.4f, 0.3f, 0.6f}, 2);
  s.model_options.scheme = SBF_SCHEME_RELAXATION;
  s.character_definition.position.y = 0;
  s.world_definition.ground = sbr_ground_flat(0);
  scene_start(&s);
  sbr_character_set_drive(s.world, s.character, 0.5f, 0, 0);
  scene_ticks(&s, 1200); /* 10 m, and so over moves of the origin */
  sbr_double3 origin = sbr_character_get_origin(s.world, s.character);
  double z = origin.z + (double)scene_point(&s, 0, 0).z;
  ck_assert_double_gt(z, 9);
  ck_assert_double_lt(z, 10.5);
  scene_free(&s);
}
END_TEST

static Suite *suite(void) {
  Suite *s = suite_create("relaxation");
  TCase *c = tcase_create("relaxation");
  tcase_add_test(c, the_reference_lizard_on_the_ground);
  tcase_add_test(c, the_reference_lizard_in_the_air);
  tcase_add_test(c, a_small_mesh);
  tcase_add_test(c, the_reference_moves_at_all);
  tcase_add_test(c, pinned_points_drag_the_body_along);
  suite_add_tcase(s, c);
  return s;
}

int main(void) {
  return harness_run(suite());
}
