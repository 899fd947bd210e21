/* Changes of rung of what swings hard: nothing is seen to jump. */
#include <math.h>
#include <stdlib.h>

#include "harness.h"
#include "rung_scenes.h"
#include "sbrun/collision.h"

/* A screen of 1080, 60 degrees high. */
static const float LINES = 1080, HEIGHT_RAD = 1.0471976f;

/* What it is made to do: goes to and fro; stops short; is struck from below; turns to and fro. */
enum { SHAKEN, STOPPED, KNOCKED, TURNED, MOTIONS, TURNS_TICKS = 14 };

static void shake(scene *s, int motion, int tick) {
  float to = tick / TURNS_TICKS % 2 ? -1.0f : 1.0f;
  if (motion == SHAKEN) sbr_character_drive(s->world, s->character, 2.5f * to, 0, 0);
  if (motion == STOPPED) sbr_character_drive(s->world, s->character, tick < 60 ? 4.0f : 0, 0, 0);
  if (motion == TURNED) sbr_character_drive(s->world, s->character, 0, 0, 6 * to);
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

static swinging begin(int motion, uint32_t rung, int ticks) {
  swinging w = {.s = rung_scene_begin(false), .motion = motion};
  scene_start(&w.s);
  sbr_character_set_rung(w.s.world, w.s.character, rung);
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

/* The farthest that a vertex is from where it would be on its old rung, at the end of the tick of the change,
 * as a share of how far it has been from where bones alone would have it. */
static double jump(int motion, uint32_t from, uint32_t to, int at) {
  swinging w = begin(motion, from, at - 20), stays = begin(motion, from, at - 20),
           bones = begin(motion, RUNG_BONES, at - 20);
  double most = 0, reach = 1e-6;
  for (int t = at - 20; t < at; t++) {
    swing(&w, t, 1), swing(&stays, t, 1), swing(&bones, t, 1);
    reach = fmax(reach, rung_scene_apart(&stays.s, &bones.s));
  }
  sbr_character_set_rung(w.s.world, w.s.character, to);
  for (int t = at; t < at + 2; t++) {
    swing(&w, t, 1), swing(&stays, t, 1);
    most = fmax(most, rung_scene_apart(&w.s, &stays.s));
    if (sbr_character_fade(w.s.world, w.s.character) < 1) break;
  }
  ck_assert(sbr_character_fade(w.s.world, w.s.character) < 1);
  end(&w), end(&stays), end(&bones);
  return reach > 1e-3 ? most / reach : 0; /* a jiggle does not feel what strikes it */
}

START_TEST(hardly_anything_of_a_swing_jumps)
{
  uint32_t from = (uint32_t)_i / RUNG_AWAY, to = (uint32_t)_i % RUNG_AWAY;
  if (from == to || from == RUNG_BONES) return;
  for (int motion = 0; motion < MOTIONS; motion++)
    for (int at = 65 + 20 * (motion == KNOCKED), end_at = at + 30; at < end_at; at += 5) {
      if ((at + 1) % TURNS_TICKS < 4) continue; /* nobody can know that it is about to be driven elsewhere */
      double share = jump(motion, from, to, at);
      ck_assert_msg(share < 0.08, "motion %d, %u to %u at %d: %g of the swing", motion, from, to, at, share);
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
  sbr_double3 at = sbr_character_origin(s->world, s->character);
  sbr_transform bone;
  sbr_character_bones(s->world, s->character, &bone, 1);
  sbr_view view = {.forward = {0, 0, 1}, .height_rad = HEIGHT_RAD, .width_ratio = 1.7f, .lines = LINES};
  view.eye = (sbr_double3){at.x + (double)bone.position.x, at.y + (double)bone.position.y,
      at.z + (double)bone.position.z - distance};
  return view;
}

/* The camera goes from a metre and a half to four hundred away and back, twice. */
START_TEST(chosen_changes_jump_by_less_than_half_a_pixel)
{
  swinging w = {.s = rung_scene_begin(false), .motion = _i}, twin = {.s = rung_scene_begin(false)};
  const sbr_detail_definition detail = sbr_default_detail_definition();
  state_errors(&w.s), state_errors(&twin.s);
  scene_start(&w.s), scene_start(&twin.s);
  ck_assert_int_eq(sbr_world_detail(w.s.world, &detail, NULL), SBF_OK);
  size_t size = sbr_world_snapshot_size(w.s.world);
  unsigned char *bytes = malloc(size);
  float fade = 0;
  uint32_t rung = 0, before = 0, changes = 0;
  double most = 0;
  for (int t = 0; t < 960; t++) {
    double share = 0.5 - 0.5 * cos(t / 480.0 * 6.283185), distance = 1.5 * pow(400 / 1.5, share);
    sbr_view view = view_from(&w.s, distance);
    before = rung, rung = sbr_character_rung(w.s.world, w.s.character);
    sbr_world_views(w.s.world, &view, 1);
    ck_assert_int_eq(sbr_world_snapshot_save(w.s.world, bytes, size), SBF_OK);
    shake(&w.s, _i, t % 240);
    scene_ticks(&w.s, 1);
    float now = sbr_character_fade(w.s.world, w.s.character);
    if (fade == 1 && now > 0 && now < 1) { /* twin stays on its rung */
      ck_assert_int_eq(sbr_world_snapshot_restore(twin.s.world, bytes, size), SBF_OK);
      sbr_character_set_rung(twin.s.world, twin.s.character, before);
      shake(&twin.s, _i, t % 240);
      scene_ticks(&twin.s, 1);
      double metres = rung_scene_apart(&w.s, &twin.s);
      most = fmax(most, metres * (double)LINES / (2 * tan((double)HEIGHT_RAD / 2) * (distance - 0.45)));
      changes++;
    }
    fade = now;
  }
  ck_assert_uint_ge(changes, 4);
  ck_assert_msg(most < 0.5, "motion %d: %g pixels in %u changes", _i, most, changes);
  free(bytes);
  end(&w), end(&twin);
}
END_TEST

int main(void) {
  Suite *s = suite_create("rung swings");
  TCase *c = tcase_create("rung swings");
  tcase_set_timeout(c, 120);
  tcase_add_loop_test(c, hardly_anything_of_a_swing_jumps, 0, RUNG_AWAY * RUNG_AWAY);
  tcase_add_loop_test(c, chosen_changes_jump_by_less_than_half_a_pixel, SHAKEN, KNOCKED);
  tcase_add_loop_test(c, chosen_changes_jump_by_less_than_half_a_pixel, TURNED, MOTIONS);
  suite_add_tcase(s, c);
  return harness_run(s);
}
