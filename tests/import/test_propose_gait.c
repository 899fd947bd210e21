#include "import/gait/propose_gait.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

#include "conversions.h"

static const sbf_gait *gait_of(const sbf_asset *a) {
  ck_assert_uint_eq(a->gaits.count, 1);
  return &a->gaits.at[0];
}

static const char *name_of(const sbf_asset *a, int32_t bone) {
  return bone == SBF_NONE ? "" : a->bones.at[bone].name;
}

/* The leg named after its foot. */
static uint32_t leg_named(const sbf_asset *a, const char *name) {
  const sbf_gait *gait = gait_of(a);
  for (uint32_t l = 0; l < gait->legs.count; l++)
    if (strcmp(gait->legs.at[l].name, name) == 0) return l;
  ck_abort_msg("no leg is named %s", name);
  return 0;
}

/* Checks that every proposal passes. */
static void check_proposal(const sbf_asset *a) {
  const sbf_gait *gait = gait_of(a);
  ck_assert(gait->proposed);
  ck_assert_int_eq(a->bones.at[gait->body].parent, SBF_NONE);
  float shortest = INFINITY;
  for (uint32_t l = 0; l < gait->legs.count; l++) {
    const sbf_leg *leg = &gait->legs.at[l];
    const sbf_ik_chain *chain = &a->ik_chains.at[leg->ik];
    ck_assert(chain->proposed);
    sbf_vec3 head = a->bones.at[chain->end].head;
    ck_assert(leg->home.x == head.x && leg->home.y == head.y && leg->home.z == head.z);
    ck_assert_float_ge(leg->sole, 0);
    ck_assert_float_gt(leg->jump_margin, 0);
    ck_assert_uint_le(leg->group, 1);
    shortest = fminf(shortest, leg->jump_margin * 2);
    /* Its twin on the other side takes turns with it. */
    for (uint32_t k = 0; k < gait->legs.count; k++) {
      sbf_vec3 other = gait->legs.at[k].home;
      float away = hypotf(other.x + head.x, other.z - head.z);
      if (k != l && away < 0.05f * shortest) ck_assert_uint_ne(gait->legs.at[k].group, leg->group);
    }
  }
  ck_assert_float_ge(gait->step_trigger, 0.079f * shortest);
  ck_assert_float_le(gait->step_trigger, 0.221f * shortest);
  ck_assert_float_eq_tol(gait->step_height, 0.12f * shortest, 1e-3f * shortest);
  ck_assert_float_eq_tol(gait->step_duration, 0.42f * sqrtf(shortest), 1e-3f * sqrtf(shortest));
}

/* --- Real rigs --------------------------------------------------------------------------------------- */

typedef struct known_leg {
  const char *foot, *root;
  float forward; /* where the knee goes: the pole's z less the knee's, its sign */
} known_leg;

typedef struct known_rig {
  const char *file, *rig;
  uint32_t legs, tail;
  const char *body, *hips, *chest, *head;
  known_leg known[4];
} known_rig;

static const known_rig known_rigs[] = {
    {"lizard/liz.obj", "lizard/liz.fbx", 4, 3, "Bone", "Body", "Body.002", "Head",
        {{"Arm.003.L", "Arm.001.L", -1}, {"Arm.003.R", "Arm.001.R", -1}, {"Leg.003.L", "Leg.001.L", 1},
            {"Leg.003.R", "Leg.001.R", 1}}},
    {"lizard/lizart.glb", NULL, 4, 3, "Bone", "Body", "Body.002", "Head",
        {{"Arm.003.L", "Arm.001.L", -1}, {"Leg.003.R", "Leg.001.R", 1}}},
    {"lizard/liz.fbx", NULL, 4, 3, "Bone", "Body", "Body.002", "Head", {{"Leg.003.L", "Leg.001.L", 1}}},
    /* It walks on its toes: the long middle foot goes with them, thigh and shin are the upper two. */
    {"fox/fox.glb", NULL, 4, 3, "_rootJoint", "b_Hip_01", "b_Spine02_03", "b_Head_05",
        {{"b_LeftFoot01_017", "b_LeftLeg01_015", 1}, {"b_RightFoot01_021", "b_RightLeg01_019", 1},
            {"b_LeftHand_011", "b_LeftUpperArm_09", -1}, {"b_RightHand_08", "b_RightUpperArm_06", -1}}},
    {"kenney-fbx/kenney_character.fbx", NULL, 2, 0, "HipsCtrl", "Hips", "", "Head",
        {{"LeftFoot", "LeftUpLeg", 1}, {"RightFoot", "RightUpLeg", 1}}},
    /* A joint of the hip before the thigh, and legs as straight as they can be. */
    {"walk-dae/walk.dae", NULL, 2, 0, "Hips", "Hips", "", "Head",
        {{"LeftFoot", "LeftUpLeg", 1}, {"RightFoot", "RightUpLeg", 1}}},
    {"mocap/cmu_01_01.bvh", NULL, 2, 0, "Hips", "Hips", "", "Head",
        {{"LeftFoot", "LeftUpLeg", 1}, {"RightFoot", "RightUpLeg", 1}}},
    /* Its third bones, below ankles higher than its hips, stand on toes. */
    {"spider/spider.glb", NULL, 8, 0, "Root", "Body", "", "Head",
        {{"FrontFoot.L", "FrontLeg.L", -1}, {"MidFrontFoot.R", "MidFrontLeg.R", -1},
            {"MidBackFoot.L", "MidBackLeg.L", 1}, {"BackFoot.R", "BackLeg.R", 1}}},
};

START_TEST(real_rigs)
{
  const known_rig *known = &known_rigs[_i];
  char rig[1024] = "";
  const char *path = known->rig ? harness_shared(known->rig) : NULL;
  if (path) snprintf(rig, sizeof rig, "%s", path);
  path = harness_shared(known->file);
  if (!path) return;
  sbf_convert_options options = {.rig = *rig ? rig : NULL};
  converted c;
  converted_file(&c, path, &options);
  const sbf_asset *a = c.asset;
  const sbf_gait *gait = gait_of(a);
  check_proposal(a);
  ck_assert_uint_eq(gait->legs.count, known->legs);
  ck_assert_str_eq(name_of(a, gait->body), known->body);
  ck_assert_str_eq(name_of(a, gait->hips), known->hips);
  ck_assert_str_eq(name_of(a, gait->chest), known->chest);
  ck_assert_str_eq(gait->head ? name_of(a, gait->head->bone) : "", known->head);
  ck_assert_uint_eq(gait->tails.count, known->tail > 0);
  ck_assert_uint_eq(a->chains.count, known->tail > 0);
  if (known->tail) ck_assert_uint_eq(a->chains.at[0].bones.count, known->tail);
  for (int i = 0; i < 4 && known->known[i].foot; i++) {
    const sbf_ik_chain *chain = &a->ik_chains.at[gait->legs.at[leg_named(a, known->known[i].foot)].ik];
    ck_assert_str_eq(name_of(a, chain->root), known->known[i].root);
    ck_assert_str_eq(name_of(a, chain->end), known->known[i].foot);
    int32_t below = chain->end, bones = 1;
    for (int32_t b = chain->end; b != chain->root; b = a->bones.at[b].parent, bones++) below = b;
    ck_assert(chain->has_pole && (chain->solver == SBF_IK_SOLVER_TWO_BONE) == (bones == 3));
    float knee = a->bones.at[below].head.z;
    ck_assert_float_gt((chain->pole.z - knee) * known->known[i].forward, 0);
  }
  converted_free(&c);
}
END_TEST

START_TEST(the_example_lizard)
{
  converted c;
  sbf_convert_options options = {.rig = harness_source("examples/lizard/lizard.glb")};
  converted_file(&c, harness_source("examples/lizard/lizard.obj"), &options);
  const sbf_asset *a = c.asset;
  const sbf_gait *gait = gait_of(a);
  check_proposal(a);
  ck_assert_uint_eq(gait->legs.count, 4);
  ck_assert_str_eq(name_of(a, gait->hips), "pelvis");
  ck_assert_str_eq(name_of(a, gait->chest), "chest");
  ck_assert_str_eq(name_of(a, gait->head->bone), "head");
  ck_assert_uint_eq(a->chains.at[0].bones.count, 5);
  ck_assert_float_eq_tol(gait->legs.at[leg_named(a, "foot.L")].sole, 0.044f, 1e-4f);
  ck_assert_float_gt(gait->legs.at[leg_named(a, "foot.L")].home.x, 0); /* left is +X */
  ck_assert_uint_eq(gait->legs.at[leg_named(a, "foot.L")].group, gait->legs.at[leg_named(a, "hand.R")].group);
  ck_assert_uint_ne(gait->legs.at[leg_named(a, "foot.L")].group, gait->legs.at[leg_named(a, "hand.L")].group);
  converted_free(&c);
}
END_TEST

/* Its legs are one bone each, on a hip that swings them. */
START_TEST(legs_of_one_bone)
{
  const char *path = harness_shared("greenman/greenman.glb");
  if (!path) return;
  converted c;
  converted_file(&c, path, NULL);
  const sbf_asset *a = c.asset;
  check_proposal(a);
  ck_assert_uint_eq(gait_of(a)->legs.count, 2);
  const sbf_ik_chain *chain = &a->ik_chains.at[gait_of(a)->legs.at[leg_named(a, "leg_L")].ik];
  ck_assert_str_eq(name_of(a, chain->root), "hip_L");
  ck_assert(!chain->has_pole && chain->solver == SBF_IK_SOLVER_CCD);
  ck_assert_ptr_null(gait_of(a)->head);
  ck_assert_uint_eq(a->chains.count, 0);
  converted_free(&c);
}
END_TEST

START_TEST(a_snake_slithers)
{
  const char *path = harness_shared("snake/snake.glb");
  if (!path) return;
  converted c;
  converted_file(&c, path, NULL);
  const sbf_gait *gait = gait_of(c.asset);
  ck_assert(gait->proposed && gait->kind == SBF_GAIT_KIND_SLITHER);
  ck_assert_uint_eq(gait->legs.count, 0);
  ck_assert_ptr_nonnull(gait->undulation);
  const sbf_u32_list *bones = &gait->undulation->bones;
  static const char *const names[] = {"Head", "Neck", "Chest", "Tail", "Tail1", "Tail2", "Tail3"};
  ck_assert_uint_eq(bones->count, sizeof names / sizeof *names);
  for (uint32_t i = 0; i < bones->count; i++)
    ck_assert_str_eq(name_of(c.asset, (int32_t)bones->at[i]), names[i]);
  ck_assert_uint_eq(converted_count(&c, SBF_CODE_RIG_NO_LEGS), 0);
  ck_assert_uint_eq(converted_count(&c, SBF_CODE_GAIT_KIND), 1);
  ck_assert_ptr_nonnull(strstr(converted_note(&c, SBF_CODE_GAIT_KIND)->message, "slither"));
  converted_free(&c);
}
END_TEST

/* Fourteen legs on seven bones, each hanging on the one before: no hips and no chest, but a chain. */
START_TEST(a_caterpillar_is_a_chain_on_feet)
{
  converted c;
  converted_file(&c, harness_source("examples/caterpillar/caterpillar.glb"), NULL);
  const sbf_gait *gait = gait_of(c.asset);
  ck_assert_uint_eq(gait->legs.count, 14);
  ck_assert_int_eq(gait->hips, SBF_NONE);
  ck_assert_int_eq(gait->chest, SBF_NONE);
  ck_assert_ptr_nonnull(gait->head);
  ck_assert_uint_eq(gait->tails.count, 0);
  ck_assert_uint_eq(c.asset->chains.count, 1);
  const sbf_chain *chain = &c.asset->chains.at[0];
  ck_assert_int_eq(chain->kind, SBF_CHAIN_KIND_DISTANCE);
  ck_assert_uint_eq(chain->bones.count, 7);
  ck_assert_str_eq(name_of(c.asset, (int32_t)chain->bones.at[0]), "segment1");
  ck_assert_str_eq(name_of(c.asset, (int32_t)chain->bones.at[6]), "segment7");
  for (uint32_t i = 0; i + 1 < 7; i++) ck_assert_float_eq_tol(chain->spacing.at[i], 0.104f, 0.03f);
  ck_assert_uint_eq(sbf_asset_check(c.asset, NULL, NULL, 0), 0);
  converted_free(&c);
}
END_TEST

START_TEST(rigs_without_legs_or_spine)
{
  static const char *const files[] = {"letter-f/letter_f.dae", "sausage/sausage_7500_ascii.fbx"};
  for (int i = 0; i < 2; i++) {
    const char *path = harness_shared(files[i]);
    if (!path) return;
    converted c;
    converted_file(&c, path, NULL);
    ck_assert_uint_eq(c.asset->gaits.count + c.asset->chains.count + c.asset->ik_chains.count, 0);
    ck_assert_uint_eq(converted_count(&c, SBF_CODE_RIG_NO_LEGS), 1);
    converted_free(&c);
  }
}
END_TEST

/* --- Rigs by hand ------------------------------------------------------------------------------------ */

static int32_t hang(
    sbfi_scene *scene, const char *name, int32_t parent, double x, double y, double z, double half) {
  int32_t bone = scene_node(scene, name, parent, true, x, y, z);
  if (half > 0) {
    char section[40];
    snprintf(section, sizeof section, "s%d", bone);
    int32_t node =
        scene_node(scene, sbfi_arena_string(&scene->arena, section, strlen(section)), bone, false, 0, 0, 0);
    scene_box(scene, node, half, 0, 0, 0, false);
  }
  return bone;
}

/* An animal with names that say nothing: a trunk of two girdles, legs with collar bones and toes, a neck with
 * ears on the head, and what leads back behind. */
START_TEST(shapes_identify_parts_without_names)
{
  sbfi_scene scene;
  scene_begin(&scene);
  int32_t root = scene_node(&scene, "b0", SBF_NONE, true, 0, 0, 0);
  int32_t hips = hang(&scene, "b1", root, 0, 1, -0.5, 0.125);
  int32_t chest = hang(&scene, "b2", hips, 0, 0, 1, 0.125);
  for (int side = 1; side >= -1; side -= 2)
    for (int fore = 0; fore < 2; fore++) {
      int32_t b = hang(&scene, fore ? "collar" : "pelvic", fore ? chest : hips, 0, 0, 0, 0);
      b = hang(&scene, "thigh", b, 0.25 * side, -0.0625, 0, 0);
      b = hang(&scene, "shin", b, 0, -0.4375, 0.0625, 0);
      b = hang(&scene, "foot", b, 0, -0.375, -0.0625, 0);
      hang(&scene, "toes", b, 0, -0.0625, 0.125, 0.0625);
    }
  int32_t neck = hang(&scene, "b3", chest, 0, 0.25, 0.25, 0);
  int32_t head = hang(&scene, "b4", neck, 0, 0.25, 0.25, 0.125);
  hang(&scene, "b5", head, 0.25, 0.125, 0, 0.03125);
  hang(&scene, "b6", head, -0.25, 0.125, 0, 0.03125);
  int32_t back = hang(&scene, "b7", hips, 0, 0, -0.25, 0.0625);
  hang(&scene, "b8", back, 0, -0.125, -0.5, 0.0625);
  scene_end(&scene);
  converted c;
  converted_scene(&c, &scene, &scene, NULL);
  const sbf_asset *a = c.asset;
  check_proposal(a);
  const sbf_gait *gait = gait_of(a);
  ck_assert_uint_eq(gait->legs.count, 4);
  for (uint32_t l = 0; l < 4; l++) {
    const sbf_ik_chain *chain = &a->ik_chains.at[gait->legs.at[l].ik];
    ck_assert_str_eq(name_of(a, chain->root), "thigh");
    ck_assert_str_eq(name_of(a, chain->end), "foot");
    ck_assert_float_eq_tol(gait->legs.at[l].sole, 0.125f, 1e-6f);
    for (uint32_t k = 0; k < l; k++) ck_assert_str_ne(a->ik_chains.at[l].id, a->ik_chains.at[k].id);
  }
  ck_assert_str_eq(name_of(a, gait->hips), "b1");
  ck_assert_str_eq(name_of(a, gait->chest), "b2");
  ck_assert_str_eq(name_of(a, gait->head->bone), "b4");
  ck_assert_uint_eq(a->chains.at[0].bones.count, 2);
  ck_assert_str_eq(name_of(a, (int32_t)a->chains.at[0].bones.at[0]), "b7");
  converted_free(&c);
  sbfi_scene_free(&scene);
}
END_TEST

/* Arms that hang, a spine that leans back, a pony tail and a head band are no legs, tail or head. */
START_TEST(similar_cases_are_not_matched)
{
  sbfi_scene scene;
  scene_begin(&scene);
  int32_t hips = hang(&scene, "hips", SBF_NONE, 0, 1, 0, 0.125);
  int32_t spine = hang(&scene, "spine", hips, 0, 0.25, -0.0625, 0.125);
  int32_t chest = hang(&scene, "chest", spine, 0, 0.25, -0.0625, 0.125);
  int32_t head = hang(&scene, "Head", chest, 0, 0.25, 0.125, 0.125);
  hang(&scene, "ponytail", head, 0, 0, -0.25, 0.0625);
  for (int side = 1; side >= -1; side -= 2) {
    int32_t b = hang(&scene, "arm headband", chest, 0.25 * side, 0, 0, 0);
    b = hang(&scene, "forearm", b, 0.125 * side, -0.5, 0, 0);
    hang(&scene, "hand", b, 0, -0.5, 0, 0.0625); /* at the knees */
    b = hang(&scene, "thigh", hips, 0.125 * side, 0, 0, 0);
    b = hang(&scene, "shin", b, 0, -0.5, 0, 0);
    hang(&scene, "foot", b, 0, -0.4375, 0, 0.0625);
  }
  scene_end(&scene);
  converted c;
  converted_scene(&c, &scene, &scene, NULL);
  const sbf_gait *gait = gait_of(c.asset);
  check_proposal(c.asset);
  ck_assert_uint_eq(gait->legs.count, 2);
  ck_assert_str_eq(gait->legs.at[0].name, "foot");
  ck_assert_str_eq(name_of(c.asset, gait->head->bone), "Head");
  ck_assert_uint_eq(gait->tails.count, 0);
  converted_free(&c);
  sbfi_scene_free(&scene);
}
END_TEST

/* Twice as large: lengths double, times grow by the root. */
START_TEST(steps_scale_with_size)
{
  sbf_gait gaits[2];
  for (int i = 0; i < 2; i++) {
    converted c;
    sbf_convert_options options = {.unit_m = i ? 2 : 1};
    converted_file(&c, harness_source("examples/lizard/lizard.glb"), &options);
    gaits[i] = *gait_of(c.asset);
    converted_free(&c);
  }
  ck_assert_float_eq_tol(gaits[1].step_trigger, 2 * gaits[0].step_trigger, 1e-6f);
  ck_assert_float_eq_tol(gaits[1].step_height, 2 * gaits[0].step_height, 1e-6f);
  ck_assert_float_eq_tol(gaits[1].walk_speed, 2 * gaits[0].walk_speed, 1e-6f);
  ck_assert_float_eq_tol(gaits[1].step_duration, 1.41421356f * gaits[0].step_duration, 1e-6f);
}
END_TEST

/* Skin of the shins comes down to the ground beside the feet. With `marked`, the feet have no skin of their
 * own. */
START_TEST(shins_on_the_ground_have_feet)
{
  bool marked = _i == 1;
  sbfi_scene scene;
  scene_begin(&scene);
  int32_t hips = hang(&scene, "hips", SBF_NONE, 0, 1, 0, 0.125);
  for (int side = 1; side >= -1; side -= 2) {
    int32_t b = hang(&scene, "joint", hips, 0.125 * side, 0, 0, 0.0625);
    b = hang(&scene, "thigh", b, 0.125 * side, 0, 0, 0.0625);
    b = hang(&scene, "shin", b, 0, -0.5, 0.0625, 0.5);
    b = hang(&scene, "foot", b, 0, -0.4375, -0.0625, marked ? 0 : 0.0625);
    if (!marked) hang(&scene, "toes", b, 0, -0.03125, 0.25, 0.03125);
  }
  scene_end(&scene);
  converted c;
  converted_scene(&c, &scene, &scene, NULL);
  const sbf_asset *a = c.asset;
  check_proposal(a);
  ck_assert_uint_eq(gait_of(a)->legs.count, 2);
  for (uint32_t l = 0; l < 2; l++) {
    const sbf_ik_chain *chain = &a->ik_chains.at[gait_of(a)->legs.at[l].ik];
    ck_assert_str_eq(name_of(a, chain->root), "thigh");
    ck_assert_str_eq(name_of(a, chain->end), "foot");
    ck_assert(chain->has_pole);
    ck_assert_float_eq_tol(gait_of(a)->legs.at[l].sole, 0.0625f, 1e-5f);
  }
  converted_free(&c);
  sbfi_scene_free(&scene);
}
END_TEST

/* What has a gait keeps it. */
START_TEST(an_authored_gait_is_kept)
{
  sbf_asset *asset = sbf_asset_create(NULL);
  static const sbf_bone bones[1] = {{.id = "b", .name = "b", .parent = SBF_NONE}};
  sbf_gait gait;
  sbf_gait_init(&gait);
  asset->bones = (sbf_bone_list){bones, 1};
  asset->gaits = (sbf_gait_list){&gait, 1};
  sbfi_conversion c = {.asset = asset};
  ck_assert_int_eq(sbfi_propose_gait(&c), SBF_OK);
  ck_assert_ptr_eq(asset->gaits.at, &gait);
  sbf_asset_free(asset);
}
END_TEST

int main(void) {
  Suite *suite = suite_create("propose_gait");
  TCase *tests = tcase_create("all");
  tcase_add_loop_test(tests, real_rigs, 0, sizeof known_rigs / sizeof *known_rigs);
  tcase_add_test(tests, the_example_lizard);
  tcase_add_test(tests, legs_of_one_bone);
  tcase_add_test(tests, a_snake_slithers);
  tcase_add_test(tests, a_caterpillar_is_a_chain_on_feet);
  tcase_add_test(tests, rigs_without_legs_or_spine);
  tcase_add_test(tests, shapes_identify_parts_without_names);
  tcase_add_test(tests, similar_cases_are_not_matched);
  tcase_add_loop_test(tests, shins_on_the_ground_have_feet, 0, 2);
  tcase_add_test(tests, steps_scale_with_size);
  tcase_add_test(tests, an_authored_gait_is_kept);
  suite_add_tcase(suite, tests);
  return harness_run(suite);
}
