/* Unattached objects beside a skeleton follow the objects that they touch. */
#include "conversions.h"

enum { HULL_BONE, ARM_BONE, BONES };

static const uint32_t all_of_hull[8] = {0}, all_of_arm[8] = {1, 1, 1, 1, 1, 1, 1, 1};

typedef struct loose_scene {
  sbfi_scene scene;
  int32_t joints[BONES];
} loose_scene;

/* A skin of two boxes: one of 2 m about 0, 1, 0 on the bone "hull", one of 1 m about 3, 1, 0 on "arm". */
static void begin(loose_scene *s) {
  scene_begin(&s->scene);
  s->joints[HULL_BONE] = scene_node(&s->scene, "hull", SBF_NONE, true, 0, 0, 0);
  s->joints[ARM_BONE] = scene_node(&s->scene, "arm", s->joints[HULL_BONE], true, 2, 1, 0);
  int32_t body = scene_node(&s->scene, "body", SBF_NONE, false, 0, 1, 0);
  int32_t hand = scene_node(&s->scene, "hand", SBF_NONE, false, 3, 1, 0);
  scene_end(&s->scene);
  scene_skin(&s->scene, scene_box(&s->scene, body, 1, 0, 0, 0, false), BONES, s->joints, all_of_hull);
  scene_skin(&s->scene, scene_box(&s->scene, hand, 0.5, 0, 0, 0, false), BONES, s->joints, all_of_arm);
}

static void add_box(loose_scene *s, const char *name, double x, double y, double z, double half) {
  int32_t node = scene_node(&s->scene, name, SBF_NONE, false, x, y, z);
  (void)scene_box(&s->scene, node, half, 0, 0, 0, false);
}

static void convert(loose_scene *s, converted *c) {
  scene_end(&s->scene);
  static const char *const all[] = {"*"};
  const sbf_convert_options options = {.no_gait = true, .softness.soft = all, .softness.soft_count = 1};
  converted_scene(c, &s->scene, &s->scene, &options);
}

static void end(loose_scene *s, converted *c) {
  converted_free(c);
  sbfi_scene_free(&s->scene);
}

static int32_t carrier(const converted *c, const char *object) {
  int32_t bone = body_named(c->asset, object)->bone;
  ck_assert_int_eq(mesh_named(c->asset, object)->bone, bone);
  return bone;
}

START_TEST(objects_in_contact_with_the_skin_follow_its_bone)
{
  loose_scene s;
  converted c;
  begin(&s);
  add_box(&s, "turret", 0, 2.5, 0, 0.5);     /* stands on the body */
  add_box(&s, "glove", 3.8, 1, 0, 0.4);      /* through the hand's side */
  add_box(&s, "buried", 0.2, 1.2, 0.1, 1.1); /* edges cross, no point of one lies on the other */
  convert(&s, &c);
  ck_assert_int_eq(carrier(&c, "turret"), bone_named(c.asset, "hull"));
  ck_assert_int_eq(carrier(&c, "glove"), bone_named(c.asset, "arm"));
  ck_assert_int_eq(carrier(&c, "buried"), bone_named(c.asset, "hull"));
  ck_assert_uint_eq(converted_count(&c, SBF_CODE_RIG_SECTION_GUESSED), 3);
  end(&s, &c);
}
END_TEST

/* In any order. */
START_TEST(objects_in_contact_with_attached_objects_follow_them)
{
  loose_scene s;
  converted c;
  begin(&s);
  add_box(&s, "flag", 3, 4, 0, 0.5);
  add_box(&s, "mast", 3, 2.5, 0, 1);
  convert(&s, &c);
  ck_assert_int_eq(carrier(&c, "mast"), bone_named(c.asset, "arm"));
  ck_assert_int_eq(carrier(&c, "flag"), bone_named(c.asset, "arm"));
  end(&s, &c);
}
END_TEST

START_TEST(objects_without_contact_stay_unattached)
{
  loose_scene s;
  converted c;
  begin(&s);
  add_box(&s, "ball", 0, 3.2, 0, 0.5);    /* a hand's breadth above */
  add_box(&s, "plinth", 0, -0.5, 0, 0.5); /* below it */
  add_box(&s, "house", 0, 4, 0, 5);       /* around it */
  convert(&s, &c);
  ck_assert_int_eq(carrier(&c, "ball"), SBF_NONE);
  ck_assert_int_eq(carrier(&c, "plinth"), SBF_NONE);
  ck_assert_int_eq(carrier(&c, "house"), SBF_NONE);
  ck_assert_uint_eq(converted_count(&c, SBF_CODE_RIG_SECTION_GUESSED), 0);
  end(&s, &c);
}
END_TEST

int main(void) {
  Suite *suite = suite_create("attach_objects");
  TCase *tests = tcase_create("all");
  tcase_add_test(tests, objects_in_contact_with_the_skin_follow_its_bone);
  tcase_add_test(tests, objects_in_contact_with_attached_objects_follow_them);
  tcase_add_test(tests, objects_without_contact_stay_unattached);
  suite_add_tcase(suite, tests);
  return harness_run(suite);
}
