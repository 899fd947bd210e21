/* A clip of one skeleton, carried over to another and played there. */
#include <stdlib.h>
#include <string.h>

#include "harness.h"
#include "math/quat_log.h"
#include "quadruped.h"
#include "sbfmt/asset.h"
#include "sbfmt/packed.h"
#include "sbrun/animation.h"

enum { LINKS = 6, SOURCE_BONES = LINKS + 2, BONES = 20, HEAD = 4, TAIL = 5 };

static const sbf_vec3 UP = {0, 1, 0};

/* A root, six links of a tail behind it and a neck. Only two chains have the quadruped's names. In a second,
 * every link bends by 0.1 rad to the side, and the neck nods by 0.5 rad. */
static sbf_asset *serpent(void) {
  static const uint32_t links[LINKS] = {1, 2, 3, 4, 5, 6}, neck[1] = {7};
  static const float times[2] = {0, 1};
  sbf_asset *a = sbf_asset_create(NULL);
  sbf_bone *bones = sbf_asset_allocate(a, SOURCE_BONES, sizeof *bones);
  sbf_clip *clip = sbf_asset_allocate(a, 1, sizeof *clip);
  sbf_track *tracks = sbf_asset_allocate(a, LINKS + 1, sizeof *tracks);
  sbf_retarget_chain *chains = sbf_asset_allocate(a, 2, sizeof *chains);
  for (int i = 0; i < SOURCE_BONES; i++) {
    sbf_bone_init(&bones[i]);
    bones[i].id = bones[i].name = "qx";
    bones[i].parent = i == 0 ? -1 : i == 7 ? 0 : i - 1;
    bones[i].head = i == 7 ? sbri_vec3(0, 2, 1) : sbri_vec3(0, 2, -(float)i);
    bones[i].length = 1;
  }
  for (int i = 0; i <= LINKS; i++) {
    bool nods = i == LINKS;
    sbf_quat rotation = sbri_quat_about(nods ? sbri_vec3(1, 0, 0) : UP, nods ? 0.5f : 0.1f);
    float *values = sbf_asset_allocate(a, 8, sizeof *values);
    const float keys[8] = {0, 0, 0, 1, rotation.x, rotation.y, rotation.z, rotation.w};
    memcpy(values, keys, sizeof keys);
    sbf_track_init(&tracks[i]);
    tracks[i].bone = i + 1;
    tracks[i].property = SBF_TRACK_PROPERTY_ROTATION;
    tracks[i].times = (sbf_f32_list){times, 2};
    tracks[i].values = (sbf_f32_list){values, 8};
  }
  sbf_clip_init(clip);
  clip->id = clip->name = "sway";
  clip->duration = 1;
  clip->loop = false;
  clip->tracks = (sbf_track_list){tracks, LINKS + 1};
  sbf_retarget_chain_init(&chains[0]), sbf_retarget_chain_init(&chains[1]);
  chains[0].name = "rear", chains[0].bones = (sbf_u32_list){links, LINKS};
  chains[1].name = "front", chains[1].bones = (sbf_u32_list){neck, 1};
  a->bones = (sbf_bone_list){bones, SOURCE_BONES};
  a->clips = (sbf_clip_list){clip, 1};
  a->retarget_chains = (sbf_retarget_chain_list){chains, 2};
  return a;
}

/* The quadruped with chains of those names over its head and the three bones of its tail. */
static void name_chains(sbf_asset *a) {
  static const uint32_t tail[3] = {TAIL, TAIL + 1, TAIL + 2}, head[1] = {HEAD};
  sbf_retarget_chain *chains = sbf_asset_allocate(a, 2, sizeof *chains);
  sbf_retarget_chain_init(&chains[0]), sbf_retarget_chain_init(&chains[1]);
  chains[0].id = "to.head", chains[1].id = "to.tail";
  chains[0].name = "front", chains[0].bones = (sbf_u32_list){head, 1};
  chains[1].name = "rear", chains[1].bones = (sbf_u32_list){tail, 3};
  a->retarget_chains = (sbf_retarget_chain_list){chains, 2};
}

typedef struct notes {
  uint32_t clips, unmatched;
} notes;

static void take(void *user, const sbf_diagnostic *d) {
  notes *n = user;
  n->clips += d->code == SBF_CODE_IMPORT_MOTION;
  n->unmatched += d->code == SBF_CODE_IMPORT_MOTION_UNMATCHED;
}

/* How far a bone has turned from rest about an axis, rad. */
static float turned(const sbf_asset *a, const sbr_transform *pose, int bone, sbf_vec3 axis) {
  sbf_quat back = sbri_quat_conjugate(sbri_quat_normalize(a->bones.at[bone].rotation));
  return sbri_dot(sbri_quat_log(sbri_quat_multiply(pose[bone].rotation, back)), axis);
}

START_TEST(chains_of_one_name_carry_a_clip_to_other_bones)
{
  sbf_asset *q = quadruped_asset();
  notes n = {0};
  sbf_diagnostic error;
  name_chains(q);
  sbf_asset *from = serpent();
  ck_assert_msg(
      sbr_asset_retarget_clips(q, from, "a serpent", take, &n, &error) == SBF_OK, "%s", error.message);
  sbf_asset_free(from); /* the retargeted clip needs no other data */
  ck_assert_uint_eq(n.clips, 1);
  ck_assert_uint_eq(n.unmatched, 2);
  ck_assert_uint_eq(q->clips.count, 1);
  ck_assert_str_eq(q->clips.at[0].name, "sway");

  sbr_model *model;
  sbr_world *world;
  sbr_character_id character;
  sbr_world_definition definition = sbr_default_world_definition();
  sbr_character_definition standing = sbr_default_character_definition();
  sbr_clip_play how = sbr_default_clip_play();
  sbr_transform pose[BONES];
  ck_assert_int_eq(sbr_model_create(q, NULL, &model, NULL), SBF_OK);
  ck_assert_int_eq(sbr_world_create(&definition, &world, NULL), SBF_OK);
  ck_assert_int_eq(sbr_character_create(world, model, &standing, &character, NULL), SBF_OK);
  sbr_character_play_clip(world, character, 0, 0, &how);
  for (int i = 0; i < 90; i++) sbr_world_tick(world);
  sbr_character_get_bones(world, character, pose, BONES);
  /* Three bones for six links: each turns as the second, fourth and sixth have. */
  for (int k = 0; k < 3; k++)
    ck_assert_float_eq_tol(turned(q, pose, TAIL + k, UP), 0.2f * (float)(k + 1), 2e-3f);
  ck_assert_float_eq_tol(turned(q, pose, HEAD, sbri_vec3(1, 0, 0)), 0.5f, 2e-3f);
  ck_assert_float_le(fabsf(turned(q, pose, 3, UP)), 1e-3f); /* the chest has no counterpart */
  for (int foot = 10; foot < BONES; foot += 3)
    ck_assert_float_le(sbri_length(sbri_sub(pose[foot].position, q->bones.at[foot].head)), 1e-3f);
  sbr_world_destroy(world);
  sbr_model_destroy(model);
  sbf_asset_free(q);
}
END_TEST

START_TEST(loaded_characters_accept_clips)
{
  sbf_asset *q = quadruped_asset();
  sbf_asset *loaded;
  sbf_diagnostic error;
  name_chains(q);
  const char *path = harness_scratch("carry.sbfz");
  ck_assert_msg(sbf_packed_save_file(q, path, NULL, &error) == SBF_OK, "%s", error.message);
  ck_assert_msg(sbf_packed_load_file(path, NULL, &loaded, &error) == SBF_OK, "%s", error.message);
  sbf_asset *from = serpent();
  for (int i = 0; i < 2; i++)
    ck_assert_int_eq(sbr_asset_retarget_clips(loaded, from, NULL, NULL, NULL, &error), SBF_OK);
  ck_assert_uint_eq(loaded->clips.count, 2);
  ck_assert_uint_eq(sbf_asset_check(loaded, NULL, NULL, 0), 0);
  sbf_asset_free(from);
  sbf_asset_free(loaded);
  sbf_asset_free(q);
}
END_TEST

START_TEST(skeletons_without_common_bones_are_refused)
{
  sbf_asset *q = quadruped_asset();
  sbf_diagnostic error;
  sbf_asset *from = serpent();
  ck_assert_int_eq(sbr_asset_retarget_clips(q, from, "a serpent", NULL, NULL, &error), SBF_BAD_INPUT);
  ck_assert_int_eq(error.code, SBF_CODE_IMPORT_MOTION_NONE);
  ck_assert_str_eq(error.file, "a serpent");
  ck_assert_uint_eq(q->clips.count, 0);
  ck_assert_int_eq(
      sbr_asset_retarget_clips(from, q, NULL, NULL, NULL, &error), SBF_BAD_INPUT); /* it has no clip */
  ck_assert_int_eq(sbr_asset_retarget_clips(NULL, from, NULL, NULL, NULL, &error), SBF_FAILED);
  sbf_asset_free(from);
  sbf_asset_free(q);
}
END_TEST

int main(void) {
  Suite *suite = suite_create("retarget");
  TCase *tests = tcase_create("all");
  tcase_add_test(tests, chains_of_one_name_carry_a_clip_to_other_bones);
  tcase_add_test(tests, loaded_characters_accept_clips);
  tcase_add_test(tests, skeletons_without_common_bones_are_refused);
  suite_add_tcase(suite, tests);
  return harness_run(suite);
}
