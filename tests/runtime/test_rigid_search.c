/* Length of a solver step where a narrow optimum stops a long move. */
#include <math.h>
#include <string.h>

#include "harness.h"
#include "rigid/rigid_work.h"

static const float KG = 8;

/* A box of eight kilograms that had the velocity `was` along x after the previous pass, m/s, and would have
 * `to` without contact. While it slides, an impulse of at most `bound` acts against it. Within `sticks` m/s
 * of rest, the impulse is as large as rest requires. */
typedef struct slide {
  sbri_node node;
  sbri_rigid_body body;
  sbri_rigid_model model;
  sbri_rigid_contact contact;
  sbri_rigid_solving work;
  sbri_contact_search search;
  sbri_rigid_tick tick;
} slide;

static void slide_of(slide *s, float was, float to, float bound, float sticks) {
  memset(s, 0, sizeof *s);
  s->body.mass = KG;
  s->model = (sbri_rigid_model){.bodies = &s->body, .body_count = 1};
  s->node.mass_factor = 1;
  s->node.previous[0] = (double)was, s->node.x[0] = (double)to;
  s->node.known_impulse[0] = (double)(KG * to); /* what moves it there */
  for (int k = 0; k < 3; k++) s->node.inertia[k][k] = 1;
  s->contact.normal = (sbf_vec3){0, 1, 0};
  s->contact.substep.tangential_mass = bound / sticks, s->contact.sliding.bound = bound,
  s->contact.iteration.slides = true;
  s->contact.iteration.previous_change.x = was, s->contact.iteration.last_change.x = to;
  s->work.system.nodes = &s->node, s->work.system.node_count = 1;
  s->work.pushes = &s->search;
  s->work.contact_list.at = &s->contact, s->work.contact_list.count = 1;
  s->tick.model = &s->model;
}

/* Friction of up to 6.9 N s against 6.4 N s: the box stands still within the tolerance of friction, for any
 * width of the optimum and from either side. */
START_TEST(stuck_bodies_are_found_in_any_gap)
{
  const float sticks[4] = {1e-2f, 1e-3f, 5e-5f, 1e-5f};
  for (int side = -1; side <= 1; side += 2)
    for (int from = -1; from <= 1; from += 2) {
      slide s;
      slide_of(&s, 2e-4f * (float)from, 0.8f * (float)side, 6.9f, sticks[_i]);
      if (from == side)
        s.node.previous[0] = s.contact.iteration.previous_change.x = -2.1f * sticks[_i] * (float)side;
      float fraction = sbri_rigid_search(&s.tick, &s.work, 1e-3f);
      double at = s.node.previous[0] + (double)fraction * (s.node.x[0] - s.node.previous[0]);
      ck_assert_double_le(fabs(at), 1.02 * (double)sticks[_i]);
    }
}
END_TEST

int main(void) {
  Suite *suite = suite_create("rigid_search");
  TCase *tests = tcase_create("all");
  tcase_add_loop_test(tests, stuck_bodies_are_found_in_any_gap, 0, 4);
  suite_add_tcase(suite, tests);
  return harness_run(suite);
}
