#include "mechanics/static_solve.h"

#include <stdlib.h>

#include "harness.h"
#include "lattice_box.h"
#include "mechanics/vector.h"

typedef struct statics {
  lattice_box box;
  sbf_spring_network network;
  double *positions, *forces;
  sbfi_static_outcome outcome;
} statics;

static statics begin(uint32_t along, uint32_t across, double poisson, float density) {
  statics s = {.box = lattice_box_make((sbf_vec3){0, 0, 0}, (sbf_vec3){1, 0.2f, 0.2f}, along, across, across,
                   density, 1e6f, (float)poisson)};
  s.network = (sbf_spring_network){.point_count = s.box.point_count,
      .positions = s.box.positions,
      .masses = s.box.masses,
      .tetrahedron_count = s.box.tetrahedron_count,
      .tetrahedra = s.box.tetrahedra,
      .young_modulus = s.box.young_modulus,
      .poisson_ratios = s.box.poisson_ratios};
  s.positions = calloc(3 * (size_t)s.box.point_count, sizeof *s.positions);
  s.forces = calloc(3 * (size_t)s.box.point_count, sizeof *s.forces);
  ck_assert(s.positions && s.forces);
  sbfi_static_start(&s.network, s.positions);
  return s;
}

static void end(statics *s) {
  free(s->positions);
  free(s->forces);
  lattice_box_free(&s->box);
}

static void solve(statics *s, sbf_vec3 gravity) {
  sbfi_static_problem problem = {.network = &s->network, .gravity = gravity, .forces = s->forces};
  ck_assert(sbfi_static_solve(&problem, s->positions, &s->outcome, NULL));
  ck_assert_msg(s->outcome.converged, "residual %g after %u steps", s->outcome.residual, s->outcome.steps);
  ck_assert_double_le(s->outcome.residual, 1e-8);
  ck_assert_double_gt(s->outcome.min_ratio, 0);
}

/* Mean displacement of the points of the far end. */
static sbfi_d3 tip(const statics *s) {
  sbfi_d3 sum = {0, 0, 0};
  double count = 0;
  for (uint32_t i = 0; i < s->box.point_count; i++) {
    if (i % (s->box.cells[0] + 1) != s->box.cells[0]) continue;
    const double *p = s->positions + 3 * (size_t)i;
    sum = sbfi_d3_add(sum, sbfi_d3_sub((sbfi_d3){p[0], p[1], p[2]}, sbfi_d3_of(s->box.positions[i])));
    count++;
  }
  return sbfi_d3_scale(sum, 1 / count);
}

START_TEST(patch_test)
{
  /* Points of the surface moved by an affine map: those inside follow it exactly, with no force on them. */
  statics s = begin(5, 3, 0.3, 1000);
  const double m[9] = {1.1, 0.05, 0, 0, 0.9, 0.02, 0.1, 0, 1.05};
  uint32_t inside = 0;
  for (uint32_t i = 0; i < s.box.point_count; i++) {
    uint32_t x = i % 6, y = i / 6 % 4, z = i / 24;
    bool pinned = x == 0 || x == 5 || y == 0 || y == 3 || z == 0 || z == 3;
    double *p = s.positions + 3 * (size_t)i, r[3] = {p[0], p[1], p[2]};
    for (int k = 0; k < 3 && pinned; k++) p[k] = m[3 * k] * r[0] + m[3 * k + 1] * r[1] + m[3 * k + 2] * r[2];
    if (pinned) s.box.masses[i] = 0;
    inside += !pinned;
  }
  ck_assert_uint_gt(inside, 0);
  solve(&s, (sbf_vec3){0, 0, 0});
  for (uint32_t i = 0; i < s.box.point_count; i++) {
    sbf_vec3 r = s.box.positions[i];
    for (int k = 0; k < 3; k++)
      ck_assert_double_eq_tol(
          s.positions[3 * (size_t)i + k], m[3 * k] * r.x + m[3 * k + 1] * r.y + m[3 * k + 2] * r.z, 1e-8);
  }
  end(&s);
}
END_TEST

START_TEST(uniaxial_tension)
{
  /* nu = 0: the held end does not matter, and sigma = P / A = E (l - 1) to first order. */
  statics s = begin(5, 1, 0, 1000);
  lattice_box_hold(&s.box);
  double pull = 1e6 * 0.04 * 1e-4; /* a strain of 1e-4 */
  /* A face's load goes to its corners by the triangles at each: 1 or 2 of the 6 thirds. */
  double fractions[4] = {0}, total = 0;
  for (uint32_t t = 0; t < s.box.tetrahedron_count; t++) {
    uint32_t far = 0;
    for (int k = 0; k < 4; k++) far += s.box.tetrahedra[t].at[k] % 6 == 5;
    for (int k = 0; k < 4 && far == 3; k++)
      if (s.box.tetrahedra[t].at[k] % 6 == 5) fractions[s.box.tetrahedra[t].at[k] / 6] += 1, total += 1;
  }
  ck_assert_double_eq(total, 6);
  for (uint32_t i = 0; i < 4; i++) s.forces[3 * (6 * i + 5)] = pull * fractions[i] / total;
  solve(&s, (sbf_vec3){0, 0, 0});
  ck_assert_double_eq_tol(tip(&s).x, 1e-4, 3e-8);
  ck_assert_double_eq_tol(tip(&s).y, 0, 3e-9); /* of second order */
  end(&s);
}
END_TEST

START_TEST(stretch_under_its_own_weight)
{
  /* rho g L^2 / (2 E), hanging along x, nu = 0; the lattice's lumped masses are exact for it at the end. */
  statics s = begin(8, 1, 0, 10);
  lattice_box_hold(&s.box);
  solve(&s, (sbf_vec3){9.81f, 0, 0});
  double exact = 10 * 9.81 / (2 * 1e6);
  ck_assert_double_eq_tol(tip(&s).x, exact, 0.01 * exact);
  end(&s);
}
END_TEST

START_TEST(cantilever_under_its_own_weight)
{
  /* 1 x 0.2 x 0.2 m, E = 1e6 Pa, nu = 0.4, 1000 kg/m^3, q L^3 / (E I) = 2.943: the elastica's tip is 0.3343 m
   * down. Linear tetrahedra are too stiff, less and less so: 34 %, 12 % at these sizes
   * (0.2199, 0.2953). */
  const uint32_t along[] = {10, 20};
  const double known[] = {-0.2199, -0.2953};
  statics s = begin(along[_i], along[_i] / 5, 0.4, 1000);
  lattice_box_hold(&s.box);
  solve(&s, (sbf_vec3){0, -9.81f, 0});
  ck_assert_double_eq_tol(tip(&s).y, known[_i], 0.003);
  ck_assert_double_lt(tip(&s).x, 0);
  end(&s);
}
END_TEST

/* About x, of the middle of the side y = 0 at one cross-section. */
static double angle_at(const statics *s, uint32_t x) {
  uint32_t point = lattice_box_point(&s->box, x, 0, s->box.cells[2] / 2);
  return (s->positions[3 * (size_t)point + 2] - (double)s->box.positions[point].z) / -0.1;
}

START_TEST(torsion_of_a_square_bar)
{
  /* theta = T L / (G J), J = 0.1405770 b^4, between cross-sections away from both ends. The end is twisted by
   * forces that grow with the distance from the axis. Linear tetrahedra are too stiff, by an error that falls
   * with the square of the cell: extrapolated, it is gone. */
  double angles[2], exact = 0.6 / (1e6 / 2.6 * 0.1405770 * 0.2 * 0.2 * 0.2 * 0.2);
  for (uint32_t n = 0; n < 2; n++) {
    statics s = begin(10 * (n + 1), 4 * (n + 1), 0.3, 1000);
    lattice_box_hold(&s.box);
    double arm = 0;
    for (uint32_t i = 0; i < s.box.point_count; i++) {
      if (i % (s.box.cells[0] + 1) != s.box.cells[0]) continue;
      double y = s.box.positions[i].y - 0.1, z = s.box.positions[i].z - 0.1;
      s.forces[3 * i + 1] = -z, s.forces[3 * i + 2] = y;
      arm += y * y + z * z;
    }
    for (uint32_t i = 0; i < 3 * s.box.point_count; i++) s.forces[i] *= 1 / arm;
    solve(&s, (sbf_vec3){0, 0, 0});
    angles[n] = angle_at(&s, 8 * (n + 1)) - angle_at(&s, 2 * (n + 1));
    end(&s);
  }
  ck_assert_double_lt(angles[0], 0.9 * exact);
  ck_assert_double_lt(angles[1], exact);
  double stiffness = 1 / angles[1] - (1 / angles[0] - 1 / angles[1]) / 3;
  ck_assert_double_eq_tol(1 / stiffness, exact, 0.01 * exact);
}
END_TEST

START_TEST(springs_hang_like_the_chain)
{
  enum { COUNT = 6 };
  sbf_vec3 positions[COUNT + 1];
  float masses[COUNT + 1], stiffness[COUNT], rest[COUNT];
  sbf_uint2 ends[COUNT];
  double points[3 * (COUNT + 1)];
  for (uint32_t i = 0; i <= COUNT; i++) {
    positions[i] = (sbf_vec3){0, -(float)i, 0};
    masses[i] = i ? 0.5f : 0;
    if (i) ends[i - 1] = (sbf_uint2){{i - 1, i}}, stiffness[i - 1] = 100, rest[i - 1] = 0.9f;
  }
  sbf_spring_network network = {.point_count = COUNT + 1,
      .spring_count = COUNT,
      .positions = positions,
      .masses = masses,
      .ends = ends,
      .stiffness = stiffness};
  sbfi_static_problem problem = {.network = &network, .rest_lengths = rest, .gravity = {0, -9.81f, 0}};
  sbfi_static_outcome outcome;
  sbfi_static_start(&network, points);
  ck_assert(sbfi_static_solve(&problem, points, &outcome, NULL));
  ck_assert(outcome.converged);
  double down = COUNT * 0.9 + 0.5 * 9.81 / 100 * COUNT * (COUNT + 1) / 2;
  ck_assert_double_eq_tol(points[3 * COUNT + 1], -down, 1e-6);
  /* Sideways, which no spring resists at rest: it swings there and holds by its tension. */
  problem.gravity = (sbf_vec3){9.81f, 0, 0};
  ck_assert(sbfi_static_solve(&problem, points, &outcome, NULL));
  ck_assert(outcome.converged);
  ck_assert_double_eq_tol(points[3 * COUNT], down, 1e-5);
}
END_TEST

START_TEST(unpinned_bodies_do_not_converge)
{
  statics s = begin(3, 1, 0.4, 1000);
  sbfi_static_problem problem = {.network = &s.network, .gravity = {0, -9.81f, 0}, .max_steps = 10};
  ck_assert(sbfi_static_solve(&problem, s.positions, &s.outcome, NULL));
  ck_assert(!s.outcome.converged);
  ck_assert_double_gt(s.outcome.residual, 0.5);
  end(&s);
}
END_TEST

START_TEST(memory_may_run_out)
{
  statics s = begin(2, 1, 0.4, 1000);
  lattice_box_hold(&s.box);
  sbfi_static_problem problem = {.network = &s.network, .gravity = {0, -9.81f, 0}};
  bool done = false;
  for (size_t allowed = 0; !done && allowed < 100; allowed++) {
    harness_memory memory;
    harness_memory_init(&memory, allowed);
    done = sbfi_static_solve(&problem, s.positions, &s.outcome, &memory.allocator);
    ck_assert_uint_eq(memory.held_bytes, 0);
  }
  ck_assert(done && s.outcome.converged);
  end(&s);
}
END_TEST

int main(void) {
  Suite *s = suite_create("static_solve");
  TCase *c = tcase_create("static_solve");
  tcase_add_test(c, patch_test);
  tcase_add_test(c, uniaxial_tension);
  tcase_add_test(c, stretch_under_its_own_weight);
  tcase_add_loop_test(c, cantilever_under_its_own_weight, 0, 2);
  tcase_add_test(c, torsion_of_a_square_bar);
  tcase_add_test(c, springs_hang_like_the_chain);
  tcase_add_test(c, unpinned_bodies_do_not_converge);
  tcase_add_test(c, memory_may_run_out);
  suite_add_tcase(s, c);
  return harness_run(s);
}
