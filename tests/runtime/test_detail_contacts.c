/* Detail levels in a world with contacts between characters. */
#include <math.h>
#include <stdlib.h>

#include "detail_scenes.h"
#include "event_log.h"
#include "harness.h"
#include "host_threads.h"
#include "sbrun/collision.h"

/* Two boxes that face each other at the given distance along +Z, viewed by a distant camera. */
typedef struct pair {
  scene s;
  sbr_character_id ids[2];
} pair;

static const double APART_M = 4;

static pair make(const sbr_tasks *tasks, bool chooses) {
  pair p = {.s = detail_scene_begin(false)};
  sbr_detail_definition detail = sbr_default_detail_definition();
  sbr_view view = {{0, 1, -400}, {0, 0, 1}, 1.0472f, 16.0f / 9, 1080};
  if (tasks) p.s.world_definition.tasks = *tasks;
  p.s.world_definition.character_capacity = 2;
  scene_start(&p.s);
  ck_assert_int_eq(sbr_world_enable_body_contacts(p.s.world, 0, NULL), SBF_OK);
  sbr_character_definition other = p.s.character_definition;
  other.position.z = APART_M;
  other.heading = 3.14159265f;
  p.ids[0] = p.s.character;
  ck_assert_int_eq(sbr_character_create(p.s.world, p.s.model, &other, &p.ids[1], NULL), SBF_OK);
  if (!chooses) return p;
  ck_assert_int_eq(sbr_world_select_detail_levels(p.s.world, &detail, NULL), SBF_OK);
  sbr_world_set_views(p.s.world, &view, 1);
  return p;
}

static double position_of(const pair *p, int who) {
  sbr_transform bone;
  sbr_character_get_bones(p->s.world, p->ids[who], &bone, 1);
  return sbr_character_get_origin(p->s.world, p->ids[who]).z + (double)bone.position.z;
}

static double bent(const pair *p, int who) {
  return sbr_character_get_body_health(p->s.world, p->ids[who], 0).elastic_j;
}

/* Moves the first box until the two would overlap by this depth if they were rigid. */
static void go(pair *p, int tick, double deep) {
  double left = 2 * (position_of(p, 1) - position_of(p, 0) - 0.2 + deep);
  float speed = left > 1 ? 1.0f : left > 0 ? (float)left : 0;
  sbr_character_set_drive(p->s.world, p->ids[0], tick < 480 ? speed : -1.0f, 0, 0);
}

START_TEST(isolated_characters_use_bones_and_return_before_a_contact)
{
  pair p = make(NULL, true);
  uint32_t contacts = 0;
  double max[2] = {0, 0}, nearest = APART_M;
  bool was_bones = false;
  for (int t = 0; t < 900; t++) {
    go(&p, t, 0.05);
    scene_ticks(&p.s, 1);
    contacts += sbr_world_get_contact_events(p.s.world).begin_count;
    double separation = position_of(&p, 1) - position_of(&p, 0);
    nearest = fmin(nearest, separation);
    for (int k = 0; k < 2; k++) {
      uint32_t detail_level = sbr_character_get_detail_level(p.s.world, p.ids[k]);
      was_bones = was_bones || (t < 120 && detail_level == DETAIL_BONES);
      if (separation < 0.4)
        ck_assert_msg(detail_level <= DETAIL_COARSE, "%d on %u at %g m", k, detail_level, separation);
      if (separation < 0.22) max[k] = fmax(max[k], bent(&p, k));
      ck_assert(sbr_character_get_body_health(p.s.world, p.ids[k], 0).finite);
    }
  }
  ck_assert(was_bones);
  ck_assert_uint_gt(contacts, 0);
  ck_assert_msg(nearest < 0.16, "%g m", nearest);
  for (int k = 0; k < 2; k++) {
    ck_assert_uint_eq(sbr_character_get_detail_level(p.s.world, p.ids[k]), DETAIL_BONES);
    ck_assert_msg(max[k] > 0.05, "%g J", max[k]);
  }
  scene_free(&p.s);
}
END_TEST

/* Switched to the bones' level, it stays there only while no character is near. */
START_TEST(a_requested_level_waits_until_nobody_is_near)
{
  pair p = make(NULL, false);
  for (int k = 0; k < 2; k++) sbr_character_set_detail_level(p.s.world, p.ids[k], DETAIL_BONES);
  scene_ticks(&p.s, 3);
  ck_assert(bent(&p, 0) == 0);
  for (int t = 0; t < 470; t++) {
    go(&p, t, 0.05);
    scene_ticks(&p.s, 1);
  }
  ck_assert(bent(&p, 0) > 0 && bent(&p, 1) > 0);
  for (int t = 480; t < 700; t++) {
    go(&p, t, 0.05);
    scene_ticks(&p.s, 1);
  }
  ck_assert(bent(&p, 0) == 0 && bent(&p, 1) == 0);
  scene_free(&p.s);
}
END_TEST

/* While they are pressed together, one changes from lattice to lattice. */
START_TEST(characters_in_contact_change_the_lattice_and_stay_in_contact)
{
  pair p = make(NULL, false), stays = make(NULL, false);
  double max = 0, max_staying = 0, min = 1e9;
  for (int t = 0; t < 470; t++) {
    go(&p, t, 0.05), go(&stays, t, 0.05);
    if (t > 380 && t % 20 == 0) sbr_character_set_detail_level(p.s.world, p.ids[0], t / 20 % 2);
    scene_ticks(&p.s, 1), scene_ticks(&stays.s, 1);
    if (t <= 380) continue;
    for (int k = 0; k < 2; k++) {
      max = fmax(max, bent(&p, k)), max_staying = fmax(max_staying, bent(&stays, k));
      min = fmin(min, bent(&p, k));
      sbr_body_health health = sbr_character_get_body_health(p.s.world, p.ids[k], 0);
      ck_assert(health.finite && health.recoveries == 0);
    }
  }
  ck_assert_msg(max < 2.5 * max_staying, "%g J, %g without a change", max, max_staying);
  ck_assert_msg(min > 0.02, "%g J", min); /* they do not pass through each other */
  scene_free(&p.s), scene_free(&stays.s);
}
END_TEST

static uint64_t run(pair *p, int from, int ticks) {
  for (int t = from; t < from + ticks; t++) {
    go(p, t, 0.05);
    scene_ticks(&p->s, 1);
  }
  return sbr_world_get_state_hash(p->s.world);
}

START_TEST(threads_and_snapshots_change_nothing)
{
  static int threads = 3;
  const sbr_tasks three = {run_on_threads, &threads};
  pair p = make(NULL, true), parallel = make(&three, true);
  ck_assert_uint_eq(run(&p, 0, 250), run(&parallel, 0, 250));
  size_t size = sbr_world_get_snapshot_size(p.s.world);
  unsigned char *bytes = malloc(size);
  ck_assert_int_eq(sbr_world_save_snapshot(p.s.world, bytes, size), SBF_OK);
  uint64_t end = run(&p, 400, 250); /* and on other detail levels by then */
  ck_assert_int_eq(sbr_world_restore_snapshot(p.s.world, bytes, size), SBF_OK);
  ck_assert_uint_eq(run(&p, 400, 250), end);
  free(bytes);
  scene_free(&p.s), scene_free(&parallel.s);
}
END_TEST

START_TEST(a_failed_allocation_keeps_the_world)
{
  harness_memory memory;
  harness_memory_init(&memory, SIZE_MAX);
  scene s = detail_scene_begin(false);
  s.world_definition.allocator = &memory.allocator;
  scene_start(&s);
  size_t pinned = memory.held_bytes, before = memory.calls;
  for (size_t more = 0;; more++) {
    memory.allowed = memory.calls + more;
    if (sbr_world_enable_body_contacts(s.world, 16, NULL) == SBF_OK) break;
    ck_assert_uint_eq(memory.held_bytes, pinned);
    scene_ticks(&s, 1);
  }
  ck_assert_uint_gt(memory.calls, before + 20);
  scene_free(&s);
}
END_TEST

int main(void) {
  Suite *s = suite_create("detail level meetings");
  TCase *c = tcase_create("detail level meetings");
  tcase_add_test(c, isolated_characters_use_bones_and_return_before_a_contact);
  tcase_add_test(c, a_requested_level_waits_until_nobody_is_near);
  tcase_add_test(c, characters_in_contact_change_the_lattice_and_stay_in_contact);
  tcase_add_test(c, threads_and_snapshots_change_nothing);
  tcase_add_test(c, a_failed_allocation_keeps_the_world);
  suite_add_tcase(s, c);
  return harness_run(s);
}
