/* Stiff soft tissue on a light bone. A stable explicit step would be tiny for the whole group. */
#include <math.h>

#include "harness.h"
#include "momentum.h"
#include "rigid_scenes.h"
#include "state/state.h"
#include "state/world.h"

enum { ACROSS = 5, HIGH = 3, DEEP = 3, POINTS = ACROSS * HIGH * DEEP };
/* Of the bone with the soft tissue; the other is its parent. */
enum { TRUNK, LIMB };

typedef struct limb {
  bool springs; /* else tetrahedra */
  float soft_kg, bone_kg, damping_ratio;
} limb;

static const limb limbs[] = {{false, 0.4f, 0.3f, 0.2f}, {true, 0.4f, 0.3f, 0.2f}, {false, 0.4f, 0.3f, 0},
    {true, 0.4f, 0.3f, 0}, {false, 0.4f, 0.05f, 0.2f}, {true, 0.4f, 0.05f, 0.2f}, {false, 0.4f, 0.05f, 0},
    {true, 0.4f, 0.3f, 0.01f}, {true, 0.4f, 0.05f, 0}};
/* The bone of the last is so light that it counts as heavier. */
enum { LIMBS = sizeof limbs / sizeof *limbs - 1 };

/* Springs between all points of the grid that are near enough. */
static void spring_all(scene *s, sbf_level *level, const sbf_vec3 *at, float stiffness) {
  sbf_uint2 ends[POINTS * 13];
  float k[POINTS * 13];
  uint32_t count = 0;
  for (uint32_t i = 0; i < POINTS; i++)
    for (uint32_t j = i + 1; j < POINTS; j++) {
      float x = at[j].x - at[i].x, y = at[j].y - at[i].y, z = at[j].z - at[i].z;
      if (x * x + y * y + z * z < 0.071f * 0.071f && count < POINTS * 13)
        ends[count] = (sbf_uint2){{i, j}}, k[count++] = stiffness;
    }
  scene_springs(s, level, ends, k, count);
}

/* A block of soft tissue on one side of a bone, which a ball joint holds to a trunk of 2 kg, far from
 * everything.
 */
static scene limb_of(const limb *of, float gravity) {
  scene s = rigid_begin();
  s.asset->environment.gravity = (sbf_vec3){0, gravity, 0};
  scene_bodies(&s, 1);
  rigid_box(&s, (sbf_vec3){0, 0, 0}, (sbf_vec3){0.2f, 0.2f, 0.2f}, 2);
  rigid_box(&s, (sbf_vec3){0.2f, 0, 0}, (sbf_vec3){0.16f, 0.06f, 0.06f}, of->bone_kg);
  rigid_joint(&s, SBF_JOINT_KIND_SPHERICAL, TRUNK, LIMB, (sbf_vec3){0.11f, 0, 0}, rigid_along_x);
  lattice_box box = lattice_box_make((sbf_vec3){0.12f, 0.03f, -0.04f}, (sbf_vec3){0.16f, 0.08f, 0.08f},
      ACROSS - 1, HIGH - 1, DEEP - 1, of->soft_kg / 1.024e-3f, 6e4f, 0.3f);
  sbf_level *level;
  if (of->springs) {
    float masses[POINTS];
    for (uint32_t i = 0; i < POINTS; i++) masses[i] = of->soft_kg / POINTS;
    level = scene_points(&s, 0, box.positions, masses, POINTS);
    spring_all(&s, level, box.positions, 4000);
  } else
    level = scene_lattice(&s, 0, &box);
  scene_body(&s, 0)->attributes.damping_ratio = of->damping_ratio;
  uint32_t pinned[ACROSS * DEEP];
  for (uint32_t i = 0; i < ACROSS * DEEP; i++) pinned[i] = lattice_box_point(&box, i % ACROSS, 0, i / ACROSS);
  rigid_pin(&s, level, 0, LIMB, pinned, ACROSS * DEEP);
  lattice_box_free(&box);
  return s;
}

static void hit_hard(const scene *s, const limb *of, float times) {
  float kg = times * of->bone_kg;
  rigid_push(s, TRUNK, (sbf_vec3){0, 0.05f, 0}, (sbf_vec3){0.5f * times, 1.5f * times, 0.4f * times});
  rigid_push(s, LIMB, (sbf_vec3){0.02f, 0, 0}, (sbf_vec3){0.2f * kg, -0.8f * kg, 0.5f * kg});
}

static void hit(const scene *s, const limb *of) {
  hit_hard(s, of, 1);
}

static bool is_attached(const scene *s) {
  return sbri_attached_loads(sbri_character_of(s->world, s->character))[LIMB].is_attached;
}

/* Soft tissue with almost no damping could gain energy, so it is not attached. */
static bool may_be_attached(const limb *of) {
  return of->damping_ratio >= 0.03f;
}

/* Momentum is conserved except rounding, in any orientation of the soft tissue. */
START_TEST(momentum_is_conserved)
{
  scene s = limb_of(&limbs[_i], 0);
  scene_start(&s);
  hit(&s, &limbs[_i]);
  scene_momentum first = scene_momentum_of(&s);
  for (int second = 0; second < 5; second++) {
    scene_ticks(&s, 60);
    ck_assert_int_eq(is_attached(&s), may_be_attached(&limbs[_i]));
    scene_momentum now = scene_momentum_of(&s);
    for (int k = 0; k < 3; k++) {
      ck_assert_double_eq_tol(now.linear[k], first.linear[k], 2e-5 * first.mass);
      ck_assert_double_eq_tol(now.angular[k], first.angular[k], 2e-4 * first.mass);
    }
  }
  scene_free(&s);
}
END_TEST

/* J, total energy of all moving parts. */
static double kinetic(const scene *s) {
  const sbri_character *c = sbri_character_of(s->world, s->character);
  const sbri_island *island = &c->model->islands[0];
  double sum = (double)rigid_state(s, TRUNK).kinetic_j + (double)rigid_state(s, LIMB).kinetic_j;
  for (uint32_t slot = 0; slot < island->free_count; slot++) {
    sbf_vec3 v = scene_slot_velocity(c, island, slot);
    sum += 0.5 * (double)(island->masses[slot] * (v.x * v.x + v.y * v.y + v.z * v.z));
  }
  return sum;
}

START_TEST(a_hit_does_not_increase_the_motion)
{
  scene s = limb_of(&limbs[_i], 0);
  scene_start(&s);
  hit(&s, &limbs[_i]);
  double first = kinetic(&s);
  for (int t = 0; t < 300; t++) {
    sbr_world_tick(s.world);
    ck_assert_msg(kinetic(&s) < 1.01 * first, "tick %d: %g J of %g", t, kinetic(&s), first);
  }
  scene_free(&s);
}
END_TEST

/* Without damping, the energy stays constant for nine seconds. At ten times the impulse it may only fall:
 * compressed elements and the speed limit take energy. The tolerance is the error of a step, which evaluates
 * positions and velocities half a step apart. */
START_TEST(an_undamped_soft_body_conserves_energy)
{
  static const int which[] = {2, 3, 6, 8};
  static const float hits[] = {1, 10};
  const limb *of = &limbs[which[_i / 2]];
  scene s = limb_of(of, 0);
  scene_start(&s);
  hit_hard(&s, of, hits[_i % 2]);
  double first = scene_energy_of(&s), last = 0;
  scene_ticks(&s, 2); /* absorbed at once, partly by the compression limit */
  double taken = scene_energy_of(&s);
  for (int t = 0; t < 540; t++) {
    sbr_world_tick(s.world);
    last = scene_energy_of(&s);
    ck_assert_msg(
        last < 1.05 * first && last < 1.1 * taken, "tick %d: %g J of %g, %g", t, last, first, taken);
  }
  if (hits[_i % 2] == 1) ck_assert_double_ge(last, 0.95 * taken);
  scene_free(&s);
}
END_TEST

static float separation(sbf_vec3 a, sbf_vec3 b) {
  return sqrtf((a.x - b.x) * (a.x - b.x) + (a.y - b.y) * (a.y - b.y) + (a.z - b.z) * (a.z - b.z));
}

/* Compared with as many steps as the stiffest body needs, and a quarter of the requested steps in flight:
 * bones and soft tissue follow the same path. */
START_TEST(it_moves_as_with_fine_steps)
{
  scene s = limb_of(&limbs[_i], -9.81f), fine = limb_of(&limbs[_i], -9.81f);
  fine.model_options.rigid_substeps = 256;
  scene_start(&s);
  scene_start(&fine);
  hit(&s, &limbs[_i]);
  hit(&fine, &limbs[_i]);
  for (int t = 0; t < 30; t++) {
    sbr_world_tick(s.world);
    sbr_world_tick(fine.world);
    ck_assert(is_attached(&s) == may_be_attached(&limbs[_i]) && !is_attached(&fine));
    float bone = separation(rigid_state(&s, LIMB).center, rigid_state(&fine, LIMB).center), soft = 0;
    for (uint32_t i = 0; i < POINTS; i++)
      soft = fmaxf(soft, separation(scene_point(&s, 0, i), scene_point(&fine, 0, i)));
    ck_assert_msg(bone < 6e-3f && soft < 12e-3f, "tick %d: %g, %g m", t, (double)bone, (double)soft);
  }
  scene_free(&s);
  scene_free(&fine);
}
END_TEST

int main(void) {
  Suite *suite = suite_create("attached soft bodies");
  TCase *tests = tcase_create("all");
  tcase_add_loop_test(tests, momentum_is_conserved, 0, LIMBS);
  tcase_add_loop_test(tests, a_hit_does_not_increase_the_motion, 0, LIMBS);
  tcase_add_loop_test(tests, it_moves_as_with_fine_steps, 0, 4);
  tcase_add_loop_test(tests, an_undamped_soft_body_conserves_energy, 0, 8);
  suite_add_tcase(suite, tests);
  return harness_run(suite);
}
