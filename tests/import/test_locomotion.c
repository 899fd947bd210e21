#include "import/gait/locomotion.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

#include "conversions.h"

/* --- Words -------------------------------------------------------------------------------------------- */

typedef struct said {
  const char *name;
  int word; /* SBFI_WORD_..., -1 for none */
} said;

static const said names[] = {{"LeftUpLeg", SBFI_WORD_LEG}, {"thigh.L", SBFI_WORD_LEG},
    {"mixamorig:RightFoot", SBFI_WORD_LEG}, {"leftupperleg", SBFI_WORD_LEG},
    {"Oberschenkel_links", SBFI_WORD_LEG}, {"Fuß.R", SBFI_WORD_LEG}, {"cuisse_gauche", SBFI_WORD_LEG},
    {"pierna_izq", SBFI_WORD_LEG}, {"左足首", SBFI_WORD_LEG}, {"нога_левая", SBFI_WORD_LEG},
    {"大腿", SBFI_WORD_LEG}, {"PectoralFin.L", SBFI_WORD_FIN}, {"Flosse2", SBFI_WORD_FIN},
    {"nageoire", SBFI_WORD_FIN}, {"胸鰭", SBFI_WORD_FIN}, {"WingL", SBFI_WORD_WING},
    {"Flügel.R", SBFI_WORD_WING}, {"aile_droite", SBFI_WORD_WING}, {"wheel_FL", SBFI_WORD_WHEEL},
    {"TankTrack22.L", SBFI_WORD_WHEEL}, {"RaedVorn", -1}, {"roue_avant", SBFI_WORD_WHEEL},
    {"Finger1.L", SBFI_WORD_ARM}, {"swing", -1}, {"coffin", -1}, {"Koala", -1}, {"alarm", -1},
    {"Bone.012", -1}, {"", -1}};

START_TEST(names_identify_parts)
{
  const said *one = &names[_i];
  uint32_t parts =
      sbfi_words_of(one->name) & (1u << SBFI_WORD_LEG | 1u << SBFI_WORD_ARM | 1u << SBFI_WORD_FIN |
                                     1u << SBFI_WORD_WING | 1u << SBFI_WORD_WHEEL);
  ck_assert_msg(parts == (one->word < 0 ? 0 : 1u << one->word), "'%s' gives %x", one->name, parts);
}
END_TEST

START_TEST(clips_identify_kinds)
{
  ck_assert_int_eq(sbfi_clip_kind("Walk_Forward"), SBFI_LOCOMOTION_WALK);
  ck_assert_int_eq(sbfi_clip_kind("Swimming_Fast"), SBFI_LOCOMOTION_SWIM);
  ck_assert_int_eq(sbfi_clip_kind("Fliegen"), SBFI_LOCOMOTION_FLY);
  ck_assert_int_eq(sbfi_clip_kind("Tank_Forward"), SBFI_LOCOMOTION_ROLL);
  ck_assert_int_eq(sbfi_clip_kind("Dodge_Forward"), SBFI_LOCOMOTION_KINDS);
  ck_assert_int_eq(sbfi_clip_kind("Roll"), SBFI_LOCOMOTION_KINDS);
  ck_assert(sbfi_clip_is_idle("Frog_Idle") && sbfi_clip_is_idle("idle"));
  ck_assert(!sbfi_clip_is_idle("Idle_Gun") && !sbfi_clip_is_idle("Idle_swordLeft"));
  ck_assert(!sbfi_clip_is_idle("Jump_Idle") && !sbfi_clip_is_idle("Idle_HitReact_Left") &&
            !sbfi_clip_is_idle("Walk"));
}
END_TEST

/* --- Rigs by hand ------------------------------------------------------------------------------------ */

/* A box of x, y, z half extents about the bone's head moved by `shift`, carried by the bone. */
static int32_t box_bone(sbfi_scene *scene, const char *name, int32_t parent, const double at[3],
    const double half[3], const double shift[3]) {
  int32_t bone = scene_node(scene, name, parent, true, at[0], at[1], at[2]);
  int32_t node = scene_node(scene, "part", bone, false, shift[0], shift[1], shift[2]);
  for (int k = 0; k < 3; k++) scene_local(scene, node)->at[k][k] = half[k];
  scene_box(scene, node, 1, 0, 0, 0, false);
  return bone;
}

#define D3(...)                                                                                              \
  (const double[3]) {                                                                                        \
    __VA_ARGS__                                                                                              \
  }

typedef void builder(sbfi_scene *scene);

/* A fish about the origin, looking along +Z, without a name that says so. */
static void build_fish(sbfi_scene *s) {
  int32_t bone = SBF_NONE;
  for (int i = 0; i < 6; i++) {
    double width = i < 3 ? 0.12 : 0.12 - 0.03 * (i - 2);
    bone = box_bone(s, "b", bone, D3(0, 0, i ? -0.25 : 0.6), D3(width, 0.25, 0.125), D3(0, 0, 0));
  }
}

/* A person of boxes with arms held out. */
static void build_person(sbfi_scene *s) {
  int32_t hips = box_bone(s, "b", SBF_NONE, D3(0, 1, 0), D3(0.17, 0.1, 0.11), D3(0, 0, 0));
  int32_t chest = box_bone(s, "b", hips, D3(0, 0.25, 0), D3(0.17, 0.2, 0.11), D3(0, 0.05, 0));
  box_bone(s, "b", chest, D3(0, 0.35, 0), D3(0.1, 0.13, 0.11), D3(0, 0.1, 0.01));
  for (int side = 1; side >= -1; side -= 2) {
    int32_t b = box_bone(s, "b", hips, D3(0.1 * side, -0.1, 0), D3(0.07, 0.2, 0.07), D3(0, -0.2, 0));
    b = box_bone(s, "b", b, D3(0, -0.42, 0.01), D3(0.06, 0.2, 0.06), D3(0, -0.2, 0));
    box_bone(s, "b", b, D3(0, -0.42, -0.01), D3(0.05, 0.03, 0.12), D3(0, -0.03, 0.06));
    b = box_bone(s, "b", chest, D3(0.2 * side, 0.2, 0), D3(0.14, 0.05, 0.05), D3(0.14 * side, 0, 0));
    b = box_bone(s, "b", b, D3(0.28 * side, 0, 0), D3(0.13, 0.04, 0.04), D3(0.13 * side, 0, 0));
    box_bone(s, "b", b, D3(0.26 * side, 0, 0), D3(0.08, 0.02, 0.04), D3(0.08 * side, 0, 0));
  }
}

static void build_dog(sbfi_scene *s) {
  int32_t hips = box_bone(s, "b", SBF_NONE, D3(0, 0.6, -0.4), D3(0.12, 0.12, 0.2), D3(0, 0, 0));
  int32_t chest = box_bone(s, "b", hips, D3(0, 0, 0.7), D3(0.13, 0.14, 0.2), D3(0, 0, -0.1));
  box_bone(s, "b", chest, D3(0, 0.25, 0.25), D3(0.08, 0.09, 0.15), D3(0, 0, 0.05));
  for (int fore = 0; fore < 2; fore++)
    for (int side = 1; side >= -1; side -= 2) {
      int32_t b = box_bone(
          s, "b", fore ? chest : hips, D3(0.1 * side, -0.05, 0), D3(0.05, 0.13, 0.05), D3(0, -0.13, 0));
      b = box_bone(s, "b", b, D3(0, -0.27, 0.02), D3(0.04, 0.12, 0.04), D3(0, -0.12, 0));
      box_bone(s, "b", b, D3(0, -0.25, -0.02), D3(0.04, 0.015, 0.06), D3(0, -0.015, 0.03));
    }
}

/* A bird on the wing: broad flat wings, no legs. */
static void build_bird(sbfi_scene *s) {
  int32_t body = box_bone(s, "b", SBF_NONE, D3(0, 1, 0), D3(0.1, 0.1, 0.25), D3(0, 0, 0));
  box_bone(s, "b", body, D3(0, 0.08, 0.3), D3(0.07, 0.07, 0.08), D3(0, 0, 0));
  for (int side = 1; side >= -1; side -= 2) {
    int32_t b = box_bone(s, "b", body, D3(0.1 * side, 0.05, 0), D3(0.25, 0.012, 0.15), D3(0.25 * side, 0, 0));
    box_bone(s, "b", b, D3(0.5 * side, 0, 0), D3(0.25, 0.01, 0.1), D3(0.25 * side, 0, 0));
  }
}

static void build_snake(sbfi_scene *s) {
  int32_t bone = SBF_NONE;
  for (int i = 0; i < 10; i++)
    bone = box_bone(
        s, "b", bone, D3(0, i ? 0 : 0.05, i ? -0.2 : 0.9), D3(0.06 - 0.004 * i, 0.05, 0.1), D3(0, 0, 0));
}

/* Points on two circles: a wheel of eight sides is round enough for nobody, so this has sixteen of two boxes
 * turned against each other. */
static void add_wheel(sbfi_scene *s, int32_t body, double x, double z) {
  static const double h = 0.70710678118654752;
  int32_t bone = scene_node(s, "w", body, true, x, -0.2, z);
  for (int k = 0; k < 4; k++) {
    double c = cos(k * 0.39269908169872414), sine = sin(k * 0.39269908169872414);
    int32_t node = scene_node(s, "part", bone, false, 0, 0, 0);
    sbfi_matrix *m = scene_local(s, node);
    double r = 0.3 * h;
    m->at[0][0] = 0.06;
    m->at[1][1] = r * c;
    m->at[1][2] = -r * sine;
    m->at[2][1] = r * sine;
    m->at[2][2] = r * c;
    scene_box(s, node, 1, 0, 0, 0, false);
  }
}

static void build_car(sbfi_scene *s) {
  int32_t body = box_bone(s, "b", SBF_NONE, D3(0, 0.5, 0), D3(0.5, 0.25, 1.2), D3(0, 0.2, 0));
  for (int fore = 0; fore < 2; fore++)
    for (int side = 1; side >= -1; side -= 2) add_wheel(s, body, 0.55 * side, fore ? 0.8 : -0.8);
}

static void build_chest(sbfi_scene *s) {
  int32_t body = box_bone(s, "b", SBF_NONE, D3(0, 0.2, 0), D3(0.4, 0.2, 0.25), D3(0, 0, 0));
  box_bone(s, "b", body, D3(0, 0.2, -0.25), D3(0.4, 0.1, 0.25), D3(0, 0.1, 0.25));
}

typedef struct known_shape {
  builder *build;
  sbfi_locomotion_kind kind;
  uint32_t legs;
} known_shape;

static const known_shape shapes[] = {{build_fish, SBFI_LOCOMOTION_SWIM, 0},
    {build_person, SBFI_LOCOMOTION_WALK, 2}, {build_dog, SBFI_LOCOMOTION_WALK, 4},
    {build_bird, SBFI_LOCOMOTION_FLY, 0}, {build_snake, SBFI_LOCOMOTION_SLITHER, 0},
    {build_car, SBFI_LOCOMOTION_ROLL, 0}, {build_chest, SBFI_LOCOMOTION_NONE, 0}};

static void make(converted *c, builder *build, double scale, bool turned, const char *clip) {
  sbfi_scene scene;
  scene_begin(&scene);
  build(&scene);
  if (clip) scene_clip(&scene, clip, 1, 1)->node = 0;
  scene_end(&scene);
  sbf_convert_options options = {.unit_m = scale, .forward = NULL};
  if (turned) { /* a quarter about +Y */
    static const sbfi_matrix quarter = {{{0, 0, 1, 0}, {0, 1, 0, 0}, {-1, 0, 0, 0}, {0, 0, 0, 1}}};
    scene.axes = quarter;
  }
  converted_scene(c, &scene, &scene, &options);
  sbfi_scene_free(&scene);
}

static sbf_gait_kind kind_of(const sbf_asset *a) {
  return a->gaits.count ? a->gaits.at[0].kind : SBF_GAIT_KIND_NONE;
}

/* Of any size, looking along Z or X, without names or clips. */
START_TEST(shapes_identify_kinds)
{
  const known_shape *known = &shapes[_i / 4];
  converted c;
  make(&c, known->build, _i & 1 ? 37 : 1, _i & 2, NULL);
  ck_assert_str_eq(sbf_gait_kind_name(kind_of(c.asset)), sbfi_locomotion_name(known->kind));
  if (c.asset->gaits.count) ck_assert_uint_eq(c.asset->gaits.at[0].legs.count, known->legs);
  converted_free(&c);
}
END_TEST

/* A caller that knows is obeyed, and nothing is said to be unclear. */
START_TEST(the_caller_decides)
{
  sbfi_scene scene;
  converted c;
  scene_begin(&scene);
  build_bird(&scene);
  scene_end(&scene);
  sbf_convert_options options = {.gait = "swim"};
  converted_scene(&c, &scene, &scene, &options);
  ck_assert_int_eq(kind_of(c.asset), SBF_GAIT_KIND_SWIM);
  ck_assert_uint_eq(
      converted_count(&c, SBF_CODE_GAIT_KIND) + converted_count(&c, SBF_CODE_GAIT_KIND_UNSURE), 0);
  converted_free(&c);
  sbfi_scene_free(&scene);
  sbf_asset *asset;
  sbf_diagnostic error;
  options.gait = "dance";
  ck_assert_int_ne(sbf_convert("x.glb", &options, &asset, &error), SBF_OK);
  ck_assert_ptr_nonnull(strstr(error.message, "slither"));
}
END_TEST

/* A clip that speaks against the shape makes it doubtful. */
START_TEST(ambiguity_is_reported)
{
  converted c;
  make(&c, build_chest, 1, false, "Walk");
  const sbf_diagnostic *note = converted_note(&c, SBF_CODE_GAIT_KIND_UNSURE);
  ck_assert_ptr_nonnull(note);
  ck_assert_ptr_nonnull(strstr(note->message, "--gait"));
  converted_free(&c);
}
END_TEST

START_TEST(parts_of_other_kinds)
{
  converted c;
  make(&c, build_fish, 1, false, NULL);
  const sbf_gait *gait = &c.asset->gaits.at[0];
  ck_assert_uint_eq(gait->undulation->bones.count, 6);
  ck_assert_float_eq_tol(gait->undulation->length, 1.5f, 1e-5f);
  ck_assert_int_eq(gait->undulation->plane, SBF_WAVE_PLANE_LATERAL);
  ck_assert_float_gt(gait->medium->altitude, 0.4f);
  for (uint32_t i = 0; i < 6; i++) ck_assert_uint_eq(gait->undulation->bones.at[i], i);
  converted_free(&c);
  make(&c, build_bird, 1, false, NULL);
  gait = &c.asset->gaits.at[0];
  ck_assert_uint_eq(gait->fins.count, 2);
  for (int i = 0; i < 2; i++) {
    ck_assert_uint_eq(gait->fins.at[i].bones.count, 2);
    ck_assert_float_eq(
        gait->fins.at[i].axis.z, c.asset->bones.at[gait->fins.at[i].bones.at[0]].head.x > 0 ? 1 : -1);
  }
  converted_free(&c);
  make(&c, build_car, 1, false, NULL);
  gait = &c.asset->gaits.at[0];
  ck_assert_uint_eq(gait->wheels.count, 4);
  for (int i = 0; i < 4; i++) {
    ck_assert_float_eq_tol(gait->wheels.at[i].radius, 0.3f, 0.02f);
    ck_assert(
        (gait->wheels.at[i].steer_limit > 0) == (c.asset->bones.at[gait->wheels.at[i].bone].head.z > 0));
  }
  converted_free(&c);
}
END_TEST

/* --- Rigs that are drawn otherwise ------------------------------------------------------------------- */

/* A long body above the ground, without wings: the wave carries it, not its height. */
static void build_dragon(sbfi_scene *s) {
  int32_t bone = SBF_NONE;
  for (int i = 0; i < 12; i++) {
    double size = i < 8 ? 0.1 : 0.1 - 0.02 * (i - 7);
    bone = box_bone(s, "b", bone, D3(0, i ? 0 : 1, i ? -0.25 : 1.4), D3(size, size, 0.125), D3(0, 0, 0));
  }
}

START_TEST(height_does_not_determine_a_long_body)
{
  converted c;
  make(&c, build_dragon, 1, false, NULL);
  ck_assert_int_eq(kind_of(c.asset), SBF_GAIT_KIND_SWIM);
  ck_assert_uint_eq(converted_count(&c, SBF_CODE_GAIT_KIND_UNSURE), 0);
  ck_assert_uint_eq(converted_count(&c, SBF_CODE_GAIT_KIND), 1);
  converted_free(&c);
}
END_TEST

/* A person with broad wings: as likely to fly, but it has legs. */
static void build_angel(sbfi_scene *s) {
  build_person(s);
  for (int side = 1; side >= -1; side -= 2) {
    int32_t b = box_bone(s, "wing", 1, D3(0.1 * side, 0.3, -0.15), D3(0.4, 0.3, 0.012), D3(0.4 * side, 0, 0));
    box_bone(s, "wing", b, D3(0.8 * side, 0, 0), D3(0.4, 0.3, 0.01), D3(0.4 * side, 0, 0));
  }
}

START_TEST(unclear_characters_get_legs)
{
  converted c;
  make(&c, build_angel, 1, false, "Fly");
  ck_assert_int_eq(kind_of(c.asset), SBF_GAIT_KIND_WALK);
  ck_assert_uint_eq(c.asset->gaits.at[0].legs.count, 2);
  const sbf_diagnostic *note = converted_note(&c, SBF_CODE_GAIT_KIND_UNSURE);
  ck_assert_ptr_nonnull(note);
  ck_assert_ptr_nonnull(strstr(note->message, "fly is almost as likely"));
  ck_assert_ptr_nonnull(strstr(note->message, "--gait"));
  converted_free(&c);
}
END_TEST

/* A body on one leg. */
static void build_hopper(sbfi_scene *s) {
  int32_t torso = box_bone(s, "torso", SBF_NONE, D3(0, 0.6, 0), D3(0.15, 0.25, 0.15), D3(0, 0.2, 0));
  int32_t thigh = box_bone(s, "thigh", torso, D3(0, 0, 0), D3(0.06, 0.12, 0.06), D3(0, -0.12, 0));
  int32_t shin = box_bone(s, "shin", thigh, D3(0, -0.25, 0.05), D3(0.05, 0.12, 0.05), D3(0, -0.12, 0));
  box_bone(s, "foot", shin, D3(0, -0.25, -0.05), D3(0.05, 0.05, 0.1), D3(0, -0.05, 0.05));
}

/* The file states crawl: a message about walk would mislead. */
START_TEST(one_leg_gives_no_gait)
{
  converted c;
  make(&c, build_hopper, 1, false, NULL);
  ck_assert_int_eq(kind_of(c.asset), SBF_GAIT_KIND_CRAWL);
  ck_assert_uint_eq(c.asset->gaits.at[0].legs.count, 0);
  ck_assert_uint_eq(converted_count(&c, SBF_CODE_RIG_NO_LEGS), 0);
  const sbf_diagnostic *note = converted_note(&c, SBF_CODE_GAIT_KIND);
  ck_assert_ptr_nonnull(note);
  ck_assert_ptr_nonnull(strstr(note->message, "crawl instead of walk"));
  converted_free(&c);
}
END_TEST

/* Three skeletons in a row are no body, and that something rests on the ground is little to say that it hops.
 */
static void build_posts(sbfi_scene *s) {
  for (int i = 0; i < 3; i++) {
    int32_t bone = box_bone(s, "b", SBF_NONE, D3(0, 0.5, 2.0 * i), D3(0.1, 0.5, 0.1), D3(0, 0, 0));
    box_bone(s, "b", bone, D3(0, 1, 0), D3(0.1, 0.5, 0.1), D3(0, 0, 0));
  }
}

START_TEST(weak_evidence_gives_no_gait)
{
  for (int turned = 0; turned < 2; turned++) {
    converted c;
    make(&c, build_posts, 1, turned, NULL);
    ck_assert_uint_eq(c.asset->gaits.count, 0);
    ck_assert_uint_eq(converted_count(&c, SBF_CODE_IMPORT_FACING), 0);
    ck_assert_uint_eq(converted_count(&c, SBF_CODE_RIG_NO_LEGS), 1);
    converted_free(&c);
  }
}
END_TEST

/* A fish whose bones drift to one side, and whose head is the narrower end. */
static void build_skewed_fish(sbfi_scene *s) {
  int32_t bone = SBF_NONE;
  for (int i = 0; i < 6; i++) {
    double width = i < 2 ? 0.03 : 0.06 + 0.01 * i;
    bone = box_bone(
        s, "b", bone, D3(i ? -0.1 : 0, 0, i ? 0.25 : -0.6), D3(width, 0.25, 0.125), D3(0.1 * i, 0, 0));
  }
}

START_TEST(the_head_leads_a_chain)
{
  converted c;
  make(&c, build_skewed_fish, 1, false, "Swim");
  const sbf_gait *gait = &c.asset->gaits.at[0];
  ck_assert_int_eq(gait->kind, SBF_GAIT_KIND_SWIM);
  ck_assert_uint_eq(gait->undulation->bones.count, 6);
  for (uint32_t i = 0; i < 6; i++) ck_assert_uint_eq(gait->undulation->bones.at[i], i);
  ck_assert_float_gt(c.asset->bones.at[0].head.z, 0.5f);
  converted_free(&c);
}
END_TEST

/* A coiled snake: the bones' z goes back and forth. Its tongue is no part of it, and neither is its root,
 * which holds something but lies beyond both ways. */
static void build_coiled_snake(sbfi_scene *s) {
  static const double ahead[9] = {1.5, 0.3, 0.3, -0.2, -0.3, -0.3, -0.3, -0.3, -0.3};
  int32_t root = box_bone(s, "control", SBF_NONE, D3(0, 0.05, -1.5), D3(0.02, 0.02, 0.02), D3(0, 0, 0));
  int32_t bone = root;
  for (int i = 0; i < 9; i++)
    bone = box_bone(s, i ? "tail" : "trunk", bone, D3(0, 0, ahead[i]), D3(0.05, 0.05, 0.1), D3(0, 0, 0));
  bone = box_bone(s, "neck", root, D3(0, 0.2, 1.7), D3(0.05, 0.05, 0.1), D3(0, 0, 0));
  bone = box_bone(s, "head", bone, D3(0, 0.1, 0.1), D3(0.06, 0.05, 0.1), D3(0, 0, 0));
  for (int i = 0; i < 4; i++)
    bone = box_bone(s, "tongue", bone, D3(0, 0, 0.3), D3(0.01, 0.01, 0.1), D3(0, 0, 0));
}

START_TEST(a_backbone_follows_the_hierarchy)
{
  sbfi_scene scene;
  converted c;
  scene_begin(&scene);
  build_coiled_snake(&scene);
  scene_end(&scene);
  sbf_convert_options options = {.gait = "slither"};
  converted_scene(&c, &scene, &scene, &options);
  const sbf_asset *a = c.asset;
  const sbf_u32_list *bones = &a->gaits.at[0].undulation->bones;
  ck_assert_uint_eq(bones->count, 11);
  ck_assert_str_eq(a->bones.at[bones->at[0]].name, "head");
  ck_assert_str_eq(a->bones.at[bones->at[1]].name, "neck");
  ck_assert_str_eq(a->bones.at[bones->at[2]].name, "trunk");
  for (uint32_t i = 3; i < 11; i++)
    ck_assert_int_eq(a->bones.at[bones->at[i]].parent, (int32_t)bones->at[i - 1]);
  converted_free(&c);
  sbfi_scene_free(&scene);
}
END_TEST

/* Water carries a swimmer's soft tissue; nothing carries a snake's. */
START_TEST(water_carries_soft_parts)
{
  static const char *const files[] = {"examples/koi/koi.glb", "examples/snake/snake.glb"};
  for (int i = 0; i < 2; i++) {
    converted c;
    converted_file(&c, harness_source(files[i]), NULL);
    ck_assert_uint_ge(c.asset->section_recipes.count, 4);
    for (uint32_t k = 0; k < c.asset->section_recipes.count; k++)
      ck_assert_float_eq(c.asset->section_recipes.at[k].attributes.gravity_scale, i);
    converted_free(&c);
  }
}
END_TEST

/* --- Rigs of other makers ---------------------------------------------------------------------------- */

START_TEST(weights_of_the_zoo)
{
  char path[1024], line[512];
  const char *truth = harness_shared("../zoo/truth.tsv");
  uint32_t count = 0;
  if (!truth) return;
  FILE *file = fopen(truth, "r");
  ck_assert_ptr_nonnull(file);
  while (fgets(line, sizeof line, file)) {
    char name[256], kind[32];
    unsigned legs;
    if (sscanf(line, "%255s %31s %u", name, kind, &legs) != 3) continue; /* the header */
    snprintf(path, sizeof path, "%.*s%s", (int)(strlen(truth) - strlen("truth.tsv")), truth, name);
    converted c;
    converted_file(&c, path, NULL);
    const sbf_asset *a = c.asset;
    ck_assert_msg(strcmp(sbf_gait_kind_name(kind_of(a)), kind) == 0, "%s: %s and not %s", name,
        sbf_gait_kind_name(kind_of(a)), kind);
    if (a->gaits.count)
      ck_assert_msg(
          a->gaits.at[0].legs.count == legs, "%s: %u legs, not %u", name, a->gaits.at[0].legs.count, legs);
    converted_free(&c);
    count++;
  }
  fclose(file);
  ck_assert_uint_ge(count, 60);
}
END_TEST

int main(void) {
  Suite *suite = suite_create("locomotion");
  TCase *tests = tcase_create("all");
  tcase_set_timeout(tests, 120);
  tcase_add_loop_test(tests, names_identify_parts, 0, sizeof names / sizeof *names);
  tcase_add_test(tests, clips_identify_kinds);
  tcase_add_loop_test(tests, shapes_identify_kinds, 0, 4 * sizeof shapes / sizeof *shapes);
  tcase_add_test(tests, the_caller_decides);
  tcase_add_test(tests, ambiguity_is_reported);
  tcase_add_test(tests, parts_of_other_kinds);
  tcase_add_test(tests, height_does_not_determine_a_long_body);
  tcase_add_test(tests, unclear_characters_get_legs);
  tcase_add_test(tests, one_leg_gives_no_gait);
  tcase_add_test(tests, weak_evidence_gives_no_gait);
  tcase_add_test(tests, the_head_leads_a_chain);
  tcase_add_test(tests, a_backbone_follows_the_hierarchy);
  tcase_add_test(tests, water_carries_soft_parts);
  tcase_add_test(tests, weights_of_the_zoo);
  suite_add_tcase(suite, tests);
  return harness_run(suite);
}
