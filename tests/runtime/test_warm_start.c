/* Contacts store their impulses between ticks: all contacts of two bodies, on either body, of faces and of
 * edges. */
#include <stdlib.h>

#include "collision_scenes.h"
#include "coupling/body_contact/body_contacts.h"
#include "harness.h"
#include "rigid_scenes.h"
#include "state/world.h"

enum { CELLS = 16 };

static void add_sheet(scene *s, uint32_t body, sbf_vec3 at, float side, bool pinned) {
  (void)collision_sheet(s, body, at, side, CELLS, pinned);
  scene_body(s, body)->attributes.damping_ratio = 0.3f;
  scene_body(s, body)->attributes.friction = 0.5f;
  scene_body(s, body)->collision.outer_thickness = 0.005f;
}

static void start(scene *s) {
  scene_start(s);
  ck_assert(sbr_world_enable_body_contacts(s->world, 0, NULL) == SBF_OK);
}

/* ---- Of a scene ---- */

typedef enum kind { FACES, FACES_OF_THE_OTHER, RIMS, KINDS } kind;

static kind kind_of(const sbri_contact *t) {
  if (t->feature >> 31) return RIMS; /* coupling/body_contact/edge_contacts.c */
  return t->body_ids[0] < t->body_ids[1] ? FACES : FACES_OF_THE_OTHER;
}

typedef struct tally {
  uint32_t again; /* contacts with an impulse in the tick before that exist again */
  uint32_t known; /* those of them with a stored impulse */
} tally;

static bool are_same(const sbri_cached_contact *m, const sbri_contact *t) {
  return m->body_ids[0] == t->body_ids[0] && m->body_ids[1] == t->body_ids[1] && m->feature == t->feature;
}

/* Steps a tick. The contacts cached before are then in `next_cached`. */
static void advance(scene *s, tally of[KINDS]) {
  const sbri_body_contacts *all = s->world->body_contacts;
  uint32_t before = all->cache.count;
  scene_ticks(s, 1);
  for (uint32_t i = 0; i < all->groups[0].contact_count; i++) {
    const sbri_contact *t = &all->contacts[all->groups[0].first_contact + i];
    bool again = false;
    for (uint32_t k = 0; k < before; k++) again = again || are_same(&all->cache.next[k], t);
    of[kind_of(t)].again += again;
    of[kind_of(t)].known += again && !t->is_new;
  }
}

/* Two sheets hang over a ball, rotated against each other: points of each lie on the other, and their edges
 * cross. No contact with an impulse is new in the next tick. */
START_TEST(contacts_are_matched_in_the_next_tick)
{
  scene s = rigid_begin();
  scene_bodies(&s, 2);
  add_sheet(&s, 0, (sbf_vec3){0, 0, 0}, 1, false);
  add_sheet(&s, 1, (sbf_vec3){0.073f, 0.006f, 0.119f}, 0.9f, false);
  s.character_definition.position.y = 0.31;
  start(&s);
  sbr_shape_definition ball = sbr_default_shape_definition();
  ball.radius = 0.3f;
  sbr_shape *shape = collision_shape(ball);
  (void)collision_collider(&s, shape, (sbr_double3){0, 0, 0});
  scene_ticks(&s, 20);
  tally of[KINDS] = {{0, 0}};
  for (int i = 0; i < 30; i++) advance(&s, of);
  for (kind k = 0; k < KINDS; k++) {
    ck_assert_uint_ge(of[k].again, 30);
    ck_assert_uint_eq(of[k].known, of[k].again);
  }
  scene_free(&s);
  sbr_shape_destroy(shape);
}
END_TEST

/* ---- By ids ---- */

/* Stored contacts of each pair of bodies are found in their order, at any index. */
START_TEST(cached_contacts_follow_by_body_ids)
{
  static const uint64_t names[4][2] = {{1, 2}, {2, 1}, {1, 3}, {1, 4}};
  static const uint32_t lie[9] = {0, 0, 1, 0, 2, 1, 2, 0, 2};
  scene s = rigid_begin();
  scene_bodies(&s, 1);
  add_sheet(&s, 0, (sbf_vec3){0, 0, 0}, 1, true);
  start(&s);
  sbri_body_contacts *all = s.world->body_contacts;
  unsigned char *bytes = calloc(1, sbri_contact_cache_size(s.world));
  ck_assert(bytes != NULL);
  for (uint32_t i = 0; i < 9; i++)
    all->cache.at[i] = (sbri_cached_contact){.body_ids = {names[lie[i]][0], names[lie[i]][1]}, .feature = i};
  all->cache.count = 9;
  sbri_contact_cache_save(s.world, bytes);
  sbri_contact_cache_restore(s.world, bytes);
  for (uint32_t k = 0; k < 4; k++) {
    const sbri_cached_contact *m = sbri_first_cached_contact(all, names[k]);
    for (uint32_t i = 0; i < 9; i++) {
      if (lie[i] != k) continue;
      ck_assert(m != NULL);
      ck_assert_uint_eq(m->feature, i);
      m = sbri_next_cached_contact(all, m);
    }
    ck_assert(m == NULL);
  }
  free(bytes);
  scene_free(&s);
}
END_TEST

int main(void) {
  Suite *suite = suite_create("warm start");
  TCase *tests = tcase_create("all");
  tcase_add_test(tests, contacts_are_matched_in_the_next_tick);
  tcase_add_test(tests, cached_contacts_follow_by_body_ids);
  suite_add_tcase(suite, tests);
  return harness_run(suite);
}
