#include "contact/contact_selection.h"

#include "contact/contact_block.h"
#include "harness.h"
#include "sbrun/collision.h"
#include "scenes.h"
#include "shapes.h"
#include "soft/soft.h"
#include "world/world.h"

static const sbf_vec3 low = {-0.2f, 0, -0.2f}, size = {0.4f, 0.2f, 0.4f};

/* A box of 2 x 1 x 2 cells on flat ground, its faces divided into 24 x 24: many vertices a point. */
static scene dense_box(void) {
  scene s = scene_begin();
  lattice_box box = lattice_box_make(low, size, 2, 1, 2, 1000, 1e5f, 0.4f);
  sbf_level *level = scene_lattice(&s, 0, &box);
  sbf_polygon_mesh mesh = shape_cube(s.asset, 24, 1, (sbf_vec3){0, 0.5f, 0});
  sbf_vec3 *at = (sbf_vec3 *)(uintptr_t)mesh.positions.at;
  for (uint32_t i = 0; i < mesh.positions.count; i++)
    at[i] = (sbf_vec3){at[i].x * size.x, at[i].y * size.y, at[i].z * size.z};
  scene_body(&s, 0)->surface = mesh;
  scene_embed(&s, level, &box);
  lattice_box_free(&box);
  scene_body(&s, 0)->attributes.damping_ratio = 0.3f;
  s.world_definition.ground = sbr_ground_flat(0);
  s.world_definition.sleep_after_s = 0;
  s.character_definition.position = (sbr_double3){0, 0, 0};
  return s;
}

static uint32_t contacts_of(const scene *s, const sbri_soft_contact **contacts) {
  sbri_character *c = sbri_character_of(s->world, s->character);
  *contacts = sbri_contacts(c) + s->model->bodies[0].first_soft_contact;
  return sbri_contact_counts(c)[0];
}

/* Number of contacts of the point that has most, on one collider. */
static uint32_t most_of_a_point(const scene *s, uint32_t collider) {
  const sbri_soft_contact *contacts;
  uint32_t count = contacts_of(s, &contacts), most = 0;
  for (uint32_t i = 0; i < count; i++) {
    uint32_t same = 0;
    for (uint32_t k = 0; k < count; k++)
      same += contacts[k].collider == collider && contacts[i].collider == collider &&
              sbri_main_slot(&contacts[k].sample) == sbri_main_slot(&contacts[i].sample);
    most = same > most ? same : most;
  }
  return most;
}

START_TEST(few_contacts_of_a_flat_base_stay_the_same_ones)
{
  static uint32_t before[4096];
  scene s = dense_box();
  scene_start(&s);
  scene_ticks(&s, 120);
  ck_assert_uint_eq(most_of_a_point(&s, SBRI_NO_COLLIDER), SBRI_POINT_CONTACTS);
  const sbri_soft_contact *contacts;
  uint32_t count = contacts_of(&s, &contacts);
  ck_assert_uint_le(count, 9 * SBRI_POINT_CONTACTS);
  for (uint32_t i = 0; i < count; i++) before[i] = contacts[i].sample.vertex;
  scene_ticks(&s, 1);
  ck_assert_uint_eq(contacts_of(&s, &contacts), count);
  for (uint32_t i = 0; i < count; i++) ck_assert_uint_eq(contacts[i].sample.vertex, before[i]);
  scene_free(&s);
}
END_TEST

/* Leaving out most of them lets none of the others through. */
START_TEST(no_vertex_goes_into_the_ground)
{
  static sbf_vec3 at[4096];
  scene s = dense_box();
  s.character_definition.position.y = 0.5;
  scene_start(&s);
  for (int tick = 0; tick < 120; tick++) {
    scene_ticks(&s, 1);
    uint32_t count = sbr_character_get_surface(s.world, s.character, 0, at, 4096);
    double origin = sbr_character_get_origin(s.world, s.character).y;
    for (uint32_t i = 0; i < count; i++) ck_assert_double_gt(origin + (double)at[i].y, -1e-3);
  }
  scene_free(&s);
}
END_TEST

static uint32_t most_deep(const sbri_contact_choice *best, uint8_t count) {
  for (uint32_t i = 1; i < count; i++) ck_assert(!sbri_comes_before(best[i], best[i - 1]));
  return best[0].item;
}

START_TEST(the_deepest_stay)
{
  enum { COUNT = 40 };
  sbri_body body = {.rest_size_m = 1};
  sbri_contact_choice best[SBRI_POINT_CONTACTS];
  uint8_t count = 0;
  for (uint32_t i = 0; i < COUNT; i++) /* gaps of 0 to 39 cm, in no order */
    sbri_contact_choose(best, &count, sbri_contact_choice_of(&body, i, 0.01f * (float)(i * 17 % COUNT), i));
  ck_assert_uint_eq(count, SBRI_POINT_CONTACTS);
  ck_assert_uint_eq(most_deep(best, count), 0);
  for (uint32_t i = 0; i < count; i++) ck_assert_uint_eq(best[i].item * 17 % COUNT, i);
  /* Gaps that differ by less than a thousandth of the body are alike: rank decides. */
  sbri_contact_choice a = sbri_contact_choice_of(&body, 0, 1e-4f, 1);
  sbri_contact_choice b = sbri_contact_choice_of(&body, 0, -1e-4f, 0);
  ck_assert(sbri_comes_before(b, a));
  b.rank = a.rank + 1;
  ck_assert(!sbri_comes_before(b, a));
}
END_TEST

/* Over the edge of a shape the contacts of both its faces stay. */
START_TEST(contacts_that_face_another_way_stay)
{
  scene s = dense_box();
  scene_start(&s);
  sbri_character *c = sbri_character_of(s.world, s.character);
  const sbri_body *body = &s.model->bodies[0];
  sbri_island now = sbri_island_now(c, &s.model->islands[0]);
  sbri_island_tick tick = sbri_island_tick_of(s.world, c, 0, &now);
  sbri_contact_tables tables = {.contacts = sbri_contacts(c),
      .contact_counts = sbri_contact_counts(c),
      .slot_contacts = sbri_slot_contacts(c),
      .choices = sbri_contact_choices(c)};
  uint32_t count = 3 * SBRI_POINT_CONTACTS;
  sbri_soft_contact *contacts = tables.contacts + body->first_soft_contact;
  for (uint32_t i = 0; i < count; i++)
    contacts[i] = (sbri_soft_contact){.sample = body->samples[0],
        .normal = i % 3 ? (sbf_vec3){0, 1, 0} : (sbf_vec3){1, 0, 0},
        .offset = i % 3 ? 10 + (float)i : 0};
  tables.contact_counts[0] = count;
  sbri_contacts_select(&tick, body, 0, &tables);
  uint32_t sideways = 0, upward = 0;
  for (uint32_t i = 0; i < tables.contact_counts[0]; i++)
    (contacts[i].normal.x > 0 ? &sideways : &upward)[0]++;
  ck_assert_uint_eq(sideways, SBRI_POINT_CONTACTS);
  ck_assert_uint_eq(upward, SBRI_POINT_CONTACTS);
  ck_assert_float_eq(contacts[tables.contact_counts[0] - 1].offset, 10 + (float)count - 1); /* the deepest */
  scene_free(&s);
}
END_TEST

static Suite *suite(void) {
  Suite *s = suite_create("contact selection");
  TCase *c = tcase_create("contact selection");
  tcase_add_test(c, few_contacts_of_a_flat_base_stay_the_same_ones);
  tcase_add_test(c, no_vertex_goes_into_the_ground);
  tcase_add_test(c, the_deepest_stay);
  tcase_add_test(c, contacts_that_face_another_way_stay);
  suite_add_tcase(s, c);
  return s;
}

int main(void) {
  return harness_run(suite());
}
