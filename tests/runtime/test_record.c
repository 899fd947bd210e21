#include "sbrun/record.h"

#include <string.h>

#include "harness.h"
#include "sbfmt/codes.h"
#include "sbrun/animation.h"
#include "sbrun/soft_body.h"
#include "scenes.h"
#include "tape.h"

static scene make(sbr_instructions instructions) {
  scene s = scene_begin();
  scene_bone(&s, (sbf_vec3){0, 1, 0});
  scene_section(&s, 0, (sbf_vec3){0, 1, 0}, (sbf_vec3){0.4f, 0.3f, 0.6f}, 2);
  s.model_options.instructions = instructions;
  scene_start(&s);
  return s;
}

static void push(const scene *s, int which) {
  sbr_vertex_grab hold = sbr_default_vertex_grab();
  hold.target = (sbr_double3){12, 901, -3};
  const sbf_vec3 one = {0.1f, 0.2f, -0.3f};
  if (which == 0) (void)sbr_character_set_soft_velocity(s->world, s->character, 0, one, one, NULL);
  if (which == 1) (void)sbr_character_apply_soft_impulse(s->world, s->character, 0, 3, one, NULL);
  if (which == 2) (void)sbr_character_apply_soft_force(s->world, s->character, 0, 5, one, 0.1f, NULL);
  if (which == 3) (void)sbr_character_grab_vertex(s->world, s->character, 0, 2, &hold, NULL);
  if (which == 4) (void)sbr_character_release_vertex(s->world, s->character, 0, 2);
}

/* Two seconds of all kinds of calls, in frames of uneven length. */
static uint64_t act(scene *s) {
  for (int i = 0; i < 80; i++) {
    if (i == 3) sbr_character_set_drive(s->world, s->character, 0.7f, -0.2f, 1.5f);
    if (i == 20) sbr_character_teleport(s->world, s->character, (sbr_double3){12.25, 900, -3.1}, 0.4f);
    if (i == 30) sbr_character_set_paused(s->world, s->character, true);
    if (i == 34) sbr_character_set_paused(s->world, s->character, false);
    if (i == 40) sbr_character_wake(s->world, s->character);
    if (i >= 41 && i <= 45) push(s, i - 41);
    if (i == 60) sbr_character_reset(s->world, s->character);
    if (i == 61) sbr_world_tick(s->world);
    sbr_world_step(s->world, 0.01 + 0.0007 * (i % 40));
  }
  return sbr_world_get_state_hash(s->world);
}

static uint64_t record(tape *t) {
  scene s = make(SBR_INSTRUCTIONS_AUTOMATIC);
  const sbr_record_output output = {tape_keep, t};
  t->size = 0;
  sbr_world_set_recording(s.world, &output);
  uint64_t hash = act(&s);
  sbr_world_set_recording(s.world, NULL);
  size_t end = t->size;
  scene_ticks(&s, 5); /* no longer recorded */
  ck_assert_uint_eq(t->size, end);
  scene_free(&s);
  return hash;
}

START_TEST(replays_end_in_the_same_state)
{
  static tape t, again;
  uint64_t hash = record(&t);
  scene s = make(_i ? SBR_INSTRUCTIONS_SCALAR : SBR_INSTRUCTIONS_AUTOMATIC);
  const sbr_record_output output = {tape_keep, &again};
  again.size = 0;
  sbr_world_set_recording(s.world, &output);
  sbr_replay replay;
  ck_assert_int_eq(sbr_replay_begin(&replay, s.world, t.bytes, t.size, NULL), SBF_OK);
  ck_assert_uint_eq(replay.frame_count, 81);
  ck_assert_uint_eq(replay.checks, 1);
  while (sbr_replay_step(&replay)) ck_assert_double_gt(replay.frame_s, 0.009);
  ck_assert_uint_eq(replay.frames, 81);
  ck_assert_uint_ge(replay.checks, 3);
  ck_assert(!replay.differs);
  ck_assert_uint_eq(sbr_world_get_state_hash(s.world), hash);
  /* A replay can be recorded, with an equal result. */
  sbr_world_set_recording(s.world, NULL);
  ck_assert_uint_eq(again.size, t.size);
  ck_assert_mem_eq(again.bytes, t.bytes, t.size);
  scene_free(&s);
}
END_TEST

START_TEST(another_world_is_reported)
{
  static tape t;
  record(&t);
  scene s = make(SBR_INSTRUCTIONS_AUTOMATIC);
  sbr_replay replay;
  scene_ticks(&s, 1);
  ck_assert_int_eq(sbr_replay_begin(&replay, s.world, t.bytes, t.size, NULL), SBF_OK);
  ck_assert(replay.differs);
  ck_assert_uint_eq(replay.differs_at_tick, 1);
  scene_free(&s);
  /* A changed input has an effect a second later. */
  s = make(SBR_INSTRUCTIONS_AUTOMATIC);
  for (size_t at = 8; at < t.size; at += 8 + 8 * (size_t)t.bytes[at + 4])
    if (t.bytes[at] == 5) t.bytes[at + 8 + 8 + 6] ^= 8; /* forward of a drive */
  ck_assert_int_eq(sbr_replay_begin(&replay, s.world, t.bytes, t.size, NULL), SBF_OK);
  ck_assert(!replay.differs);
  while (sbr_replay_step(&replay))
    ;
  ck_assert(replay.differs);
  ck_assert_uint_ge(replay.differs_at_tick, 60);
  ck_assert_uint_le(replay.differs_at_tick, 100);
  scene_free(&s);
}
END_TEST

/* A truncated record plays its intact frames. With a byte changed anywhere, it is refused or plays something
 * else, without a crash. */
START_TEST(damaged_recordings_do_no_harm)
{
  static tape t, cut;
  record(&t);
  for (size_t at = 0; at < t.size; at += 97) {
    scene s = make(SBR_INSTRUCTIONS_AUTOMATIC);
    sbr_replay replay;
    sbf_diagnostic error;
    if (_i == 0) {
      sbf_status status = sbr_replay_begin(&replay, s.world, t.bytes, at, &error);
      ck_assert_int_eq(status, at < 8 ? SBF_BAD_INPUT : SBF_OK);
    } else {
      cut = t;
      cut.bytes[at] ^= 0x41;
      sbr_replay_begin(&replay, s.world, cut.bytes, cut.size, &error);
    }
    for (int frame = 0; frame < 200 && sbr_replay_step(&replay); frame++)
      ;
    ck_assert(_i || !replay.differs);
    scene_free(&s);
  }
}
END_TEST

START_TEST(characters_created_meanwhile_are_reported)
{
  static tape t;
  scene s = make(SBR_INSTRUCTIONS_AUTOMATIC);
  const sbr_record_output output = {tape_keep, &t};
  sbr_character_id other;
  sbr_replay replay;
  sbf_diagnostic error;
  t.size = 0;
  sbr_world_set_recording(s.world, &output);
  scene_ticks(&s, 3);
  ck_assert_int_eq(sbr_character_create(s.world, s.model, &s.character_definition, &other, NULL), SBF_OK);
  ck_assert_int_eq(sbr_replay_begin(&replay, s.world, t.bytes, t.size, &error), SBF_BAD_INPUT);
  ck_assert_ptr_nonnull(strstr(error.message, "characters were created"));
  ck_assert(!sbr_replay_step(&replay));
  ck_assert_int_eq(sbr_replay_begin(NULL, s.world, t.bytes, t.size, &error), SBF_FAILED);
  sbr_world_set_recording(NULL, &output);
  ck_assert(!sbr_replay_step(NULL));
  scene_free(&s);
}
END_TEST

int main(void) {
  Suite *s = suite_create("record");
  TCase *c = tcase_create("record");
  tcase_add_loop_test(c, replays_end_in_the_same_state, 0, 2);
  tcase_add_test(c, another_world_is_reported);
  tcase_add_loop_test(c, damaged_recordings_do_no_harm, 0, 2);
  tcase_add_test(c, characters_created_meanwhile_are_reported);
  suite_add_tcase(s, c);
  return harness_run(s);
}
