/* Bodies whose pins jump relative to each other in one tick, by more than a cell. */
#include <math.h>

#include "harness.h"
#include "prepare/pins.h"
#include "sbrun/animation.h"
#include "scenes.h"
#include "shapes.h"
#include "state/world.h"

enum { CELLS = 4, SIDE = (CELLS + 1) * (CELLS + 1), JUMP_TICK = 30, KEYS = 5 };

static const float CELL = 0.05f;

/* How the second of two bones moves: at once, slowly, or at once and back again three ticks later. */
typedef enum jump_kind { AT_ONCE, SLOWLY, AND_BACK } jump_kind;

typedef struct jump {
  float by[3], young_pa, poisson;
  sbf_scheme scheme;
  jump_kind kind;
} jump;

static void add_clip(scene *s, const jump *j) {
  static const float shortly = 1e-3f, begin = JUMP_TICK / 60.0f, end = 20;
  float *times = sbf_asset_allocate(s->asset, KEYS, sizeof *times);
  float *values = sbf_asset_allocate(s->asset, 3 * KEYS, sizeof *values);
  sbf_clip *clip = sbf_asset_allocate(s->asset, 1, sizeof *clip);
  sbf_track *track = sbf_asset_allocate(s->asset, 1, sizeof *track);
  times[1] = begin - shortly, times[2] = j->kind == SLOWLY ? begin + 2 : begin;
  times[3] = j->kind == AND_BACK ? begin + 3 / 60.0f : end - 1;
  times[4] = j->kind == AND_BACK ? times[3] + shortly : end;
  for (uint32_t k = 2; k < KEYS; k++)
    for (int axis = 0; axis < 3; axis++)
      values[3 * k + axis] = k == 4 && j->kind == AND_BACK ? 0 : j->by[axis];
  sbf_clip_init(clip);
  sbf_track_init(track);
  clip->id = clip->name = "jump";
  clip->duration = end, clip->loop = false;
  clip->tracks = (sbf_track_list){track, 1};
  track->bone = 1;
  track->property = SBF_TRACK_PROPERTY_TRANSLATION;
  track->times = (sbf_f32_list){times, KEYS};
  track->values = (sbf_f32_list){values, 3 * KEYS};
  s->asset->clips = (sbf_clip_list){clip, 1};
}

/* Each end by a bone of its own. */
static void hold_ends(scene *s, sbf_level *level, uint32_t *points[2], uint32_t count) {
  sbf_pin_set *sets = sbf_asset_allocate(s->asset, 2, sizeof *sets);
  for (int end = 0; end < 2; end++) {
    sbf_pin_set_init(&sets[end]);
    sets[end].bone = end;
    sets[end].points = (sbf_u32_list){points[end], count};
  }
  level->pins = (sbf_pin_set_list){sets, 2};
}

/* A bar of 0.6 m, held at one end by a bone that stays and at the other by one that jumps. */
static scene begin(const jump *j) {
  scene s = scene_begin();
  sbf_bone *bones = sbf_asset_allocate(s.asset, 2, sizeof *bones);
  uint32_t *points[2];
  lattice_box box =
      lattice_box_make((sbf_vec3){0, 0, 0}, (sbf_vec3){3 * CELLS * CELL, CELLS * CELL, CELLS * CELL},
          3 * CELLS, CELLS, CELLS, 1000, j->young_pa, j->poisson);
  for (uint32_t end = 0; end < 2; end++) {
    sbf_bone_init(&bones[end]);
    bones[end].id = end ? "b" : "a";
    bones[end].rotation = (sbf_quat){0, 0, 0, 1};
    points[end] = sbf_asset_allocate(s.asset, SIDE, sizeof **points);
    for (uint32_t i = 0; i < SIDE; i++) {
      points[end][i] = lattice_box_point(&box, end * 3 * CELLS, i % (CELLS + 1), i / (CELLS + 1));
      box.masses[points[end][i]] = 0;
    }
  }
  s.asset->bones = (sbf_bone_list){bones, 2};
  sbf_level *level = scene_lattice(&s, 0, &box);
  lattice_box_free(&box);
  hold_ends(&s, level, points, SIDE);
  scene_body(&s, 0)->attributes.damping_ratio = 0.1f;
  scene_body(&s, 0)->attributes.poisson_ratio = j->poisson;
  s.model_options.scheme = j->scheme;
  add_clip(&s, j);
  scene_start(&s);
  sbr_clip_play how = sbr_default_clip_play();
  sbr_character_play_clip(s.world, s.character, 0, 0, &how);
  return s;
}

static sbr_body_health health_after(const jump *j, uint32_t ticks) {
  scene s = begin(j);
  scene_ticks(&s, ticks);
  sbr_body_health health = sbr_character_get_body_health(s.world, s.character, 0);
  ck_assert(health.finite);
  scene_free(&s);
  return health;
}

static const jump jumps[] = {
    {{0.1f, 0, 0}, 2e4f, 0.45f, SBF_SCHEME_AUTOMATIC, AT_ONCE},
    {{0, 0.3f, 0}, 2e4f, 0.3f, SBF_SCHEME_AUTOMATIC, AT_ONCE},
    {{-0.2f, 0, 0}, 2e5f, 0.45f, SBF_SCHEME_AUTOMATIC, AT_ONCE},
    {{0, -0.4f, 0.2f}, 2e5f, 0.45f, SBF_SCHEME_AUTOMATIC, AT_ONCE},
    {{-0.4f, 0, 0}, 2e4f, 0.3f, SBF_SCHEME_AUTOMATIC, AT_ONCE},
    {{-0.4f, 0, 0}, 2e4f, 0.45f, SBF_SCHEME_AUTOMATIC, AT_ONCE},
    {{-0.4f, 0, 0}, 2e4f, 0.3f, SBF_SCHEME_POSITION_BASED, AT_ONCE},
    {{-0.4f, 0, 0}, 2e4f, 0.45f, SBF_SCHEME_POSITION_BASED, AT_ONCE},
    {{0.5f, 0, 0}, 2e4f, 0.3f, SBF_SCHEME_POSITION_BASED, AT_ONCE},
    {{0, 0.3f, 0}, 2e5f, 0.45f, SBF_SCHEME_POSITION_BASED, AT_ONCE},
    {{-0.4f, 0, 0}, 2e4f, 0.45f, SBF_SCHEME_AUTOMATIC, AND_BACK},
    {{-0.4f, 0, 0}, 2e5f, 0.3f, SBF_SCHEME_AUTOMATIC, AND_BACK},
    {{-0.4f, 0, 0}, 2e4f, 0.45f, SBF_SCHEME_POSITION_BASED, AND_BACK},
    {{0, 0.5f, 0}, 2e4f, 0.3f, SBF_SCHEME_BLOCK_DESCENT, AND_BACK},
};

/* Its final rest shape equals that of the same motion done slowly. A bar pushed together to a third of its
 * length in one tick retained 1.8 times as much energy permanently. */
START_TEST(a_jump_by_cells_leaves_nothing_crushed)
{
  jump j = jumps[_i], slow = j;
  slow.kind = SLOWLY;
  if (j.kind == AND_BACK) slow.by[0] = slow.by[1] = slow.by[2] = 0;
  sbr_body_health was = health_after(&slow, 480), is = health_after(&j, 480);
  ck_assert_msg(
      is.elastic_j < 1.05 * was.elastic_j, "holds %g J, moved slowly %g J", is.elastic_j, was.elastic_j);
  ck_assert(!is.inverted);
  ck_assert_float_gt(is.min_element_ratio, fminf(0.3f, 0.9f * was.min_element_ratio));
}
END_TEST

/* Ends pushed together until a quarter of the bar is left: every possible shape has compressed elements. */
START_TEST(crushed_bodies_are_reported)
{
  jump j = {{-0.45f, 0, 0}, 2e4f, 0.3f, SBF_SCHEME_AUTOMATIC, AT_ONCE};
  ck_assert_float_lt(health_after(&j, 120).min_element_ratio, 0.2f);
  j.by[0] = 0;
  ck_assert_float_gt(health_after(&j, 120).min_element_ratio, 0.7f);
}
END_TEST

/* Soft tissue that falls so fast that it inverts recovers, though its weight alone could strain it by as much
 * energy. In flight it stayed compressed for seconds. */
START_TEST(bodies_crushed_by_a_fall_recover)
{
  static const double heights_m[] = {1, 3, 8, 15};
  scene s = scene_begin();
  lattice_box box =
      lattice_box_make((sbf_vec3){-0.1f, 0, -0.1f}, (sbf_vec3){0.2f, 0.2f, 0.2f}, 4, 4, 4, 920, 4000, 0.48f);
  scene_lattice(&s, 0, &box);
  lattice_box_free(&box);
  scene_body(&s, 0)->attributes.damping_ratio = 0.3f;
  s.model_options.free = true;
  s.character_definition.position = (sbr_double3){0, heights_m[_i], 0};
  s.world_definition.ground = sbr_ground_flat(0);
  scene_start(&s);
  scene_ticks(&s, 360);
  sbr_body_health health = sbr_character_get_body_health(s.world, s.character, 0);
  ck_assert(health.finite && !health.inverted);
  ck_assert_float_gt(health.min_element_ratio, 0.4f);
  scene_free(&s);
}
END_TEST

/* A bar bent by half a turn, with a surface of 8 vertices that then encloses nothing. */
static scene begin_bent(void) {
  static const float times[] = {0, 2, 4, 8};
  static const float turns[] = {0, 0, 0, 1, 0, 0, 0.70710678f, 0.70710678f, 0, 0, 1, 0, 0, 0, 1, 0};
  scene s = scene_begin();
  sbf_bone *bones = sbf_asset_allocate(s.asset, 2, sizeof *bones);
  uint32_t *points[2];
  lattice_box box =
      lattice_box_make((sbf_vec3){0, -0.1f, -0.1f}, (sbf_vec3){1.2f, 0.2f, 0.2f}, 12, 2, 2, 1000, 2e4f, 0.3f);
  for (uint32_t end = 0; end < 2; end++) {
    sbf_bone_init(&bones[end]);
    bones[end].id = end ? "b" : "a";
    bones[end].rotation = (sbf_quat){0, 0, 0, 1};
    if (end) bones[end].head = (sbf_vec3){0.6f, 0.36f, 0};
    points[end] = sbf_asset_allocate(s.asset, 9, sizeof **points);
    for (uint32_t i = 0; i < 9; i++) {
      points[end][i] = lattice_box_point(&box, end * 12, i % 3, i / 3);
      box.masses[points[end][i]] = 0;
    }
  }
  s.asset->bones = (sbf_bone_list){bones, 2};
  sbf_level *level = scene_lattice(&s, 0, &box);
  sbf_polygon_mesh mesh = shape_cube(s.asset, 1, 1, (sbf_vec3){0.5f, 0, 0});
  sbf_vec3 *at = (sbf_vec3 *)(uintptr_t)mesh.positions.at;
  for (uint32_t i = 0; i < mesh.positions.count; i++)
    at[i] = (sbf_vec3){at[i].x * 1.2f, at[i].y * 0.2f, at[i].z * 0.2f};
  scene_body(&s, 0)->surface = mesh;
  scene_embed(&s, level, &box);
  lattice_box_free(&box);
  hold_ends(&s, level, points, 9);
  scene_body(&s, 0)->attributes.damping_ratio = 0.1f;
  s.asset->environment.gravity = (sbf_vec3){0, 0, 0};
  sbf_clip *clip = sbf_asset_allocate(s.asset, 1, sizeof *clip);
  sbf_track *track = sbf_asset_allocate(s.asset, 1, sizeof *track);
  sbf_clip_init(clip);
  sbf_track_init(track);
  clip->id = clip->name = "bend";
  clip->duration = 8, clip->loop = false;
  clip->tracks = (sbf_track_list){track, 1};
  track->bone = 1;
  track->property = SBF_TRACK_PROPERTY_ROTATION;
  track->times = (sbf_f32_list){times, 4};
  track->values = (sbf_f32_list){turns, 16};
  s.asset->clips = (sbf_clip_list){clip, 1};
  scene_start(&s);
  sbr_clip_play how = sbr_default_clip_play();
  sbr_character_play_clip(s.world, s.character, 0, 0, &how);
  return s;
}

START_TEST(a_bent_bar_of_few_vertices_is_not_put_back)
{
  scene s = begin_bent();
  for (int i = 0; i < 420; i++) {
    scene_ticks(&s, 1);
    sbr_body_health health = sbr_character_get_body_health(s.world, s.character, 0);
    ck_assert(health.finite && !health.inverted);
    ck_assert_uint_eq(health.recoveries, 0);
    ck_assert_float_gt(health.min_element_ratio, 0.3f);
    if (i == 419) ck_assert_float_lt(health.volume_ratio, 0.1f);
  }
  scene_free(&s);
}
END_TEST

int main(void) {
  Suite *suite = suite_create("jump");
  TCase *c = tcase_create("jump");
  tcase_set_timeout(c, 120);
  tcase_add_loop_test(
      c, a_jump_by_cells_leaves_nothing_crushed, 0, HARNESS_FEW((int)(sizeof jumps / sizeof *jumps), 3));
  tcase_add_test(c, a_bent_bar_of_few_vertices_is_not_put_back);
  tcase_add_test(c, crushed_bodies_are_reported);
  tcase_add_loop_test(c, bodies_crushed_by_a_fall_recover, 0, 4);
  suite_add_tcase(suite, c);
  return harness_run(suite);
}
