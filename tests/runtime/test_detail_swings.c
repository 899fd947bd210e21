/* Detail level changes of characters that swing strongly: no visible jump. */
#include <math.h>
#include <stdlib.h>

#include "detail_scenes.h"
#include "harness.h"
#include "sbrun/collision.h"

/* A screen of 1080, 60 degrees high. */
static const float LINES = 1080, HEIGHT_RAD = 1.0471976f;

/* Motions: to and fro; a sudden stop; a hit from below; rotation to and fro; a walk. */
enum { SHAKEN, STOPPED, KNOCKED, TURNED, MOTIONS, CALM = MOTIONS, TURNS_TICKS = 14 };

static void shake(scene *s, int motion, int tick) {
  float to = tick / TURNS_TICKS % 2 ? -1.0f : 1.0f;
  if (motion == SHAKEN) sbr_character_set_drive(s->world, s->character, 2.5f * to, 0, 0);
  if (motion == STOPPED) sbr_character_set_drive(s->world, s->character, tick < 60 ? 4.0f : 0, 0, 0);
  if (motion == CALM) sbr_character_set_drive(s->world, s->character, 0.5f, 0, 0);
  if (motion == TURNED) sbr_character_set_drive(s->world, s->character, 0, 0, 6 * to);
}

typedef struct swinging {
  scene s;
  sbr_shape *club;
  sbr_collider_id striking;
  int motion;
} swinging;

static void swing(swinging *w, int from, int ticks) {
  for (int t = from; t < from + ticks; t++) {
    shake(&w->s, w->motion, t);
    if (w->club && t < 72)
      sbr_collider_move(w->s.world, w->striking,
          (sbr_double3){0.15, 0.72 + 0.03 * (t < 66 ? t - 60 : 72 - t), 0}, (sbf_quat){0, 0, 0, 1});
    scene_ticks(&w->s, 1);
  }
}

static swinging begin(int motion, uint32_t detail_level, int ticks) {
  swinging w = {.s = detail_scene_begin(false), .motion = motion};
  scene_start(&w.s);
  sbr_character_set_detail_level(w.s.world, w.s.character, detail_level);
  if (motion == KNOCKED) {
    sbr_shape_definition ball = sbr_default_shape_definition();
    sbr_collider_definition there = sbr_default_collider_definition();
    ball.kind = SBR_SHAPE_SPHERE, ball.radius = 0.1f;
    ck_assert_int_eq(sbr_shape_create(NULL, &ball, &w.club, NULL), SBF_OK);
    there.shape = w.club;
    there.position = (sbr_double3){0.15, 0.72, 0};
    ck_assert_int_eq(sbr_collider_create(w.s.world, &there, &w.striking, NULL), SBF_OK);
  }
  swing(&w, 0, ticks);
  return w;
}

static void end(swinging *w) {
  scene_free(&w->s);
  sbr_shape_destroy(w->club);
}

/* Maximum distance of a vertex from its position on the old level, at the end of the tick of the change, as a
 * fraction of its distance from the position by bones alone. */
static double jump(int motion, uint32_t from, uint32_t to, int at) {
  swinging w = begin(motion, from, at - 20), stays = begin(motion, from, at - 20),
           bones = begin(motion, DETAIL_BONES, at - 20);
  double max = 0, reach = 1e-6;
  for (int t = at - 20; t < at; t++) {
    swing(&w, t, 1), swing(&stays, t, 1), swing(&bones, t, 1);
    reach = fmax(reach, detail_scene_apart(&stays.s, &bones.s));
  }
  sbr_character_set_detail_level(w.s.world, w.s.character, to);
  for (int t = at; t < at + 2; t++) {
    swing(&w, t, 1), swing(&stays, t, 1);
    max = fmax(max, detail_scene_apart(&w.s, &stays.s));
    if (sbr_character_get_detail_fade(w.s.world, w.s.character) < 1) break;
  }
  ck_assert(sbr_character_get_detail_fade(w.s.world, w.s.character) < 1);
  end(&w), end(&stays), end(&bones);
  return reach > 1e-3 ? max / reach : 0; /* a jiggle does not feel what strikes it */
}

START_TEST(a_change_of_level_hardly_changes_a_swing)
{
  uint32_t from = (uint32_t)_i / (DETAIL_OFFSCREEN - 1), to = (uint32_t)_i % (DETAIL_OFFSCREEN - 1);
  to += to >= from;
  for (int motion = 0; motion < MOTIONS; motion++)
    for (int at = 65 + 20 * (motion == KNOCKED), end_at = at + 30; at < end_at; at += 5) {
      if ((at + 1) % TURNS_TICKS < 4) continue; /* no level can predict a change of the drive */
      double fraction = jump(motion, from, to, at);
      ck_assert_msg(
          fraction < 0.08, "motion %d, %u to %u at %d: %g of the swing", motion, from, to, at, fraction);
    }
}
END_TEST

/* Levels that state errors as small as a built character's. */
static void state_errors(scene *s) {
  static const float errors[] = {0, 0.5e-3f, 1e-3f};
  sbf_level *levels = (sbf_level *)(uintptr_t)scene_body(s, 0)->levels.at;
  for (int l = 0; l < 3; l++) levels[l].simulation.error = errors[l];
}

static sbr_view view_from(const scene *s, double distance) {
  sbr_double3 at = sbr_character_get_origin(s->world, s->character);
  sbr_transform bone;
  sbr_character_get_bones(s->world, s->character, &bone, 1);
  sbr_view view = {.forward = {0, 0, 1}, .height_rad = HEIGHT_RAD, .width_ratio = 1.7f, .lines = LINES};
  view.eye = (sbr_double3){at.x + (double)bone.position.x, at.y + (double)bone.position.y,
      at.z + (double)bone.position.z - distance};
  return view;
}

/* How many pixels a metre of it is high, a box's half nearer. */
static double pixels_of(double distance) {
  return (double)LINES / (2 * tan((double)HEIGHT_RAD / 2) * (distance - 0.45));
}

/* Drives that replace the motion in the tick of a change; the first: the motion itself. */
static const float elsewhere[][2] = {{0, 0}, {0, 0}, {4, 0}, {-4, 0}, {0.5f, 0}, {0, 6}, {0, -6}};
enum { ELSEWHERE = sizeof elsewhere / sizeof *elsewhere };

/* A world that chooses levels, one in the same state with another drive, and one that stays on its detail
 * level. */
typedef struct watched_changes {
  swinging w;
  scene other, stays;
  int motion;
  unsigned char *bytes;
  size_t size;
  uint32_t changes, put_off;
} watched_changes;

static watched_changes watch_changes(int motion) {
  watched_changes c = {.w = {.s = detail_scene_begin(false), .motion = motion},
      .other = detail_scene_begin(false),
      .stays = detail_scene_begin(false),
      .motion = motion};
  const sbr_detail_definition detail = sbr_default_detail_definition();
  state_errors(&c.w.s), state_errors(&c.other), state_errors(&c.stays);
  scene_start(&c.w.s), scene_start(&c.other), scene_start(&c.stays);
  ck_assert_int_eq(sbr_world_select_detail_levels(c.w.s.world, &detail, NULL), SBF_OK);
  ck_assert_int_eq(sbr_world_select_detail_levels(c.other.world, &detail, NULL), SBF_OK);
  c.size = sbr_world_get_snapshot_size(c.w.s.world);
  c.bytes = malloc(c.size);
  return c;
}

static void end_changes(watched_changes *c) {
  free(c->bytes);
  end(&c->w);
  scene_free(&c->other), scene_free(&c->stays);
}

static bool is_fading(const scene *s) {
  float fade = sbr_character_get_detail_fade(s->world, s->character);
  return fade > 0 && fade < 1;
}

/* Distance of the skin, in metres, from its position on the level that it leaves, driven by the `number`-th
 * drive. */
static double jump_driven(
    watched_changes *c, int number, uint32_t detail_level, int t, const sbr_view *view) {
  scene *both[] = {&c->other, &c->stays};
  for (int i = 0; i < 2; i++) {
    ck_assert_int_eq(sbr_world_restore_snapshot(both[i]->world, c->bytes, c->size), SBF_OK);
    if (both[i] == &c->stays)
      sbr_character_set_detail_level(both[i]->world, both[i]->character, detail_level);
    else
      sbr_world_set_views(both[i]->world, view, 1);
    if (number)
      sbr_character_set_drive(
          both[i]->world, both[i]->character, elsewhere[number][0], 0, elsewhere[number][1]);
    else
      shake(both[i], c->motion, t % 240);
    scene_ticks(both[i], 1);
  }
  c->put_off += !is_fading(&c->other);
  return is_fading(&c->other) ? detail_scene_apart(&c->other, &c->stays) : 0;
}

/* The camera goes from a metre and a half to four hundred away and back, twice. */
START_TEST(chosen_changes_jump_by_less_than_half_a_pixel)
{
  watched_changes c = watch_changes(_i);
  scene *s = &c.w.s;
  uint32_t detail_level = 0;
  bool before = false;
  for (int t = 0; t < 960; t++) {
    double fraction = 0.5 - 0.5 * cos(t / 480.0 * 6.283185), distance = 1.5 * pow(400 / 1.5, fraction);
    sbr_view view = view_from(s, distance);
    sbr_world_set_views(s->world, &view, 1);
    ck_assert_int_eq(sbr_world_save_snapshot(s->world, c.bytes, c.size), SBF_OK);
    shake(s, _i, t % 240);
    scene_ticks(s, 1);
    bool changes = is_fading(s) && !before;
    for (int k = 0; changes && k < ELSEWHERE; k++) {
      double pixels = jump_driven(&c, k, detail_level, t, &view) * pixels_of(distance);
      ck_assert_msg(pixels < 0.5, "motion %d at %d, driven by %d: %g pixels", _i, t, k, pixels);
    }
    if (changes) detail_level = sbr_character_get_detail_level(s->world, s->character), c.changes++;
    before = is_fading(s);
  }
  ck_assert_uint_ge(c.changes, 4);
  ck_assert_uint_ge(c.put_off, 1);
  end_changes(&c);
}
END_TEST

/* A new character has no visible history. */
START_TEST(a_new_character_begins_on_its_chosen_detail_level)
{
  watched_changes c = watch_changes(CALM);
  sbr_view view = view_from(&c.w.s, 1.5);
  sbr_world_set_views(c.w.s.world, &view, 1);
  scene_ticks(&c.w.s, 1);
  ck_assert_uint_eq(sbr_character_get_detail_level(c.w.s.world, c.w.s.character), DETAIL_COARSE);
  ck_assert(!is_fading(&c.w.s));
  sbr_character_set_detail_level(c.w.s.world, c.w.s.character, DETAIL_FINE);
  scene_ticks(&c.w.s, 2);
  ck_assert(is_fading(&c.w.s));
  end_changes(&c);
}
END_TEST

int main(void) {
  Suite *s = suite_create("detail level swings");
  TCase *c = tcase_create("detail level swings");
  tcase_add_loop_test(
      c, a_change_of_level_hardly_changes_a_swing, 0, HARNESS_FEW(DETAIL_BONES * (DETAIL_OFFSCREEN - 1), 3));
  tcase_add_loop_test(c, chosen_changes_jump_by_less_than_half_a_pixel, SHAKEN, KNOCKED);
  tcase_add_loop_test(c, chosen_changes_jump_by_less_than_half_a_pixel, TURNED, CALM + 1);
  tcase_add_test(c, a_new_character_begins_on_its_chosen_detail_level);
  suite_add_tcase(s, c);
  return harness_run(s);
}
