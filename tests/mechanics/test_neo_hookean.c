#include "mechanics/neo_hookean.h"

#include <string.h>

#include "harness.h"

static const double young = 5e4, poisson = 0.42;
static sbfi_tetrahedron element;
static sbfi_d3 rest[4] = {{0.1, 0.2, -0.3}, {0.4, 0.15, -0.25}, {0.2, 0.5, -0.35}, {0.15, 0.25, 0.1}};
/* Nothing special; squeezed to a third; inside out. */
static const sbfi_d3 states[3][4] = {
    {{0, 0, 0}, {0.35, 0.02, -0.04}, {0.06, 0.33, 0.01}, {-0.02, 0.05, 0.5}},
    {{0, 0, 0}, {0.1, 0.02, 0}, {0.02, 0.3, 0.04}, {0, -0.06, 0.41}},
    {{0, 0, 0}, {-0.3, 0.03, 0}, {0.04, 0.3, 0.02}, {0.02, 0.1, 0.4}},
};

static void setup(void) {
  ck_assert(sbfi_tetrahedron_make(&element, rest, sbfi_lame_of(young, poisson)));
}

/* Of the affine map x -> m x + move. */
static void map(const double m[9], sbfi_d3 move, sbfi_d3 x[4]) {
  for (int i = 0; i < 4; i++) {
    sbfi_d3 r = rest[i];
    x[i] = (sbfi_d3){m[0] * r.x + m[1] * r.y + m[2] * r.z + move.x,
        m[3] * r.x + m[4] * r.y + m[5] * r.z + move.y, m[6] * r.x + m[7] * r.y + m[8] * r.z + move.z};
  }
}

START_TEST(volume_and_gradients)
{
  sbfi_d3 a = sbfi_d3_sub(rest[1], rest[0]), b = sbfi_d3_sub(rest[2], rest[0]),
          c = sbfi_d3_sub(rest[3], rest[0]);
  ck_assert_double_eq_tol(element.volume, sbfi_d3_dot(a, sbfi_d3_cross(b, c)) / 6, 1e-15);
  for (int i = 0; i < 4; i++)
    for (int j = 0; j < 4; j++) {
      double value = sbfi_d3_dot(element.gradients[i], sbfi_d3_sub(rest[j], rest[(i + 1) % 4]));
      ck_assert_double_eq_tol(value, j == i ? 1 : 0, 1e-12);
    }
  const sbfi_d3 turned[4] = {rest[1], rest[0], rest[2], rest[3]},
                flat[4] = {rest[0], rest[1], rest[2], rest[1]};
  sbfi_tetrahedron other;
  ck_assert(!sbfi_tetrahedron_make(&other, turned, element.lame));
  ck_assert(!sbfi_tetrahedron_make(&other, flat, element.lame));
}
END_TEST

START_TEST(rigid_motion_costs_nothing)
{
  double c = 0.6, s = 0.8;
  const double turn[9] = {c, -s, 0, s * c, c * c, -s, s * s, s * c, c}; /* about z, then about x */
  sbfi_d3 x[4], f[4];
  map(turn, (sbfi_d3){3, -2, 7}, x);
  ck_assert_double_eq_tol(sbfi_tetrahedron_volume_ratio(&element, x), 1, 1e-12);
  ck_assert_double_eq_tol(sbfi_tetrahedron_energy(&element, x), 0, 1e-12 * young * element.volume);
  sbfi_tetrahedron_compute_forces(&element, x, f);
  for (int i = 0; i < 4; i++) ck_assert_double_le(sbfi_d3_length(f[i]), 1e-11 * young * element.volume);
}
END_TEST

START_TEST(small_strains_obey_hooke)
{
  /* 2 U / V = stress : strain of Hooke's law in E and nu, for a strain with everything in it. */
  const double e = 1e-6, strain[6] = {1, -0.4, 0.7, 0.3, -0.6, 0.2}; /* xx yy zz xy yz zx */
  const double m[9] = {1 + e * strain[0], e * strain[3], e * strain[5], e * strain[3], 1 + e * strain[1],
      e * strain[4], e * strain[5], e * strain[4], 1 + e * strain[2]};
  double shear = young / (2 * (1 + poisson)), first = young * poisson / ((1 + poisson) * (1 - 2 * poisson));
  double trace = strain[0] + strain[1] + strain[2], squares = 0;
  for (int k = 0; k < 3; k++) squares += strain[k] * strain[k] + 2 * strain[3 + k] * strain[3 + k];
  double expected = element.volume * e * e * (shear * squares + first / 2 * trace * trace);
  sbfi_d3 x[4];
  map(m, (sbfi_d3){0, 0, 0}, x);
  ck_assert_double_eq_tol(sbfi_tetrahedron_energy(&element, x), expected, 1e-4 * expected);
}
END_TEST

START_TEST(work_at_rest_equals_the_product)
{
  const sbfi_d3 u[4] = {{0.3, -0.1, 0.7}, {-0.4, 0.2, 0.1}, {0.5, 0.6, -0.2}, {0.1, -0.8, 0.3}},
                v[4] = {{-0.2, 0.4, 0.1}, {0.3, 0.3, -0.6}, {0.7, -0.5, 0.2}, {-0.1, 0.2, 0.9}};
  sbfi_d3 products[4];
  double wanted = 0;
  sbfi_tetrahedron_product(&element, rest, u, products);
  for (int i = 0; i < 4; i++) wanted += sbfi_d3_dot(products[i], v[i]);
  ck_assert_double_eq_tol(sbfi_tetrahedron_rest_work(&element, u, v), wanted, 1e-12 * fabs(wanted));
}
END_TEST

START_TEST(uniaxial_stress)
{
  /* Stretched by 30 % with the sides free: find the width at which they are, then compare the stress with mu
   * (l - w^2 / l) of the closed form (lambda (J - gamma) w l = -mu w eliminated). */
  double l = 1.3, low = 0.5, high = 1.2;
  for (int i = 0; i < 80; i++) {
    double w = 0.5 * (low + high),
           side = element.lame.mu * w + (element.lame.lambda * (l * w * w - 1) - element.lame.mu) * w * l;
    *(side < 0 ? &low : &high) = w;
  }
  double w = low, stress = element.lame.mu * (l - w * w / l);
  const double m[9] = {l, 0, 0, 0, w, 0, 0, 0, w};
  sbfi_d3 x[4], f[4];
  map(m, (sbfi_d3){0, 0, 0}, x);
  sbfi_tetrahedron_compute_forces(&element, x, f);
  for (int i = 0; i < 4; i++) {
    ck_assert_double_eq_tol(f[i].x, -element.volume * stress * element.gradients[i].x, 1e-9 * young);
    ck_assert_double_eq_tol(f[i].y, 0, 1e-9 * young);
    ck_assert_double_eq_tol(f[i].z, 0, 1e-9 * young);
  }
  /* Small: Young's modulus itself, and Poisson's ratio sideways. */
  ck_assert_double_eq_tol(w, 1 - 0.3 * poisson, 0.02);
}
END_TEST

START_TEST(forces_are_the_slope_of_the_energy)
{
  sbfi_d3 x[4], f[4], sum = {0, 0, 0}, moment = {0, 0, 0};
  double h = 1e-6;
  memcpy(x, states[_i], sizeof x);
  sbfi_tetrahedron_compute_forces(&element, x, f);
  for (int i = 0; i < 4; i++) {
    double *coordinates[3] = {&x[i].x, &x[i].y, &x[i].z}, force[3] = {f[i].x, f[i].y, f[i].z};
    for (int k = 0; k < 3; k++) {
      double kept = *coordinates[k];
      *coordinates[k] = kept + h;
      double above = sbfi_tetrahedron_energy(&element, x);
      *coordinates[k] = kept - h;
      double below = sbfi_tetrahedron_energy(&element, x);
      *coordinates[k] = kept;
      ck_assert_double_eq_tol(force[k], -(above - below) / (2 * h), 1e-6 * young * 0.1);
    }
    sum = sbfi_d3_add(sum, f[i]);
    moment = sbfi_d3_add(moment, sbfi_d3_cross(x[i], f[i]));
  }
  ck_assert_double_le(sbfi_d3_length(sum), 1e-9);
  ck_assert_double_le(sbfi_d3_length(moment), 1e-9);
}
END_TEST

START_TEST(products_are_the_change_of_the_forces)
{
  const sbfi_d3 u[4] = {{0.3, -0.1, 0.2}, {-0.4, 0.2, 0.1}, {0.1, 0.5, -0.3}, {0.2, 0.1, 0.6}};
  sbfi_d3 high[4], low[4], above[4], below[4], products[4];
  double h = 1e-6, blocks[4][4][9];
  for (int i = 0; i < 4; i++) {
    high[i] = sbfi_d3_add(states[_i][i], sbfi_d3_scale(u[i], h));
    low[i] = sbfi_d3_sub(states[_i][i], sbfi_d3_scale(u[i], h));
  }
  sbfi_tetrahedron_compute_forces(&element, high, above);
  sbfi_tetrahedron_compute_forces(&element, low, below);
  sbfi_tetrahedron_product(&element, states[_i], u, products);
  sbfi_tetrahedron_compute_hessian(&element, states[_i], blocks);
  for (int i = 0; i < 4; i++) {
    sbfi_d3 change = sbfi_d3_scale(sbfi_d3_sub(below[i], above[i]), 1 / (2 * h));
    ck_assert_double_le(sbfi_d3_length(sbfi_d3_sub(products[i], change)), 1e-5 * young);
    double row[3] = {0, 0, 0};
    for (int j = 0; j < 4; j++)
      for (int k = 0; k < 3; k++) {
        const double *b = blocks[i][j] + 3 * k;
        row[k] += b[0] * u[j].x + b[1] * u[j].y + b[2] * u[j].z;
      }
    ck_assert_double_le(
        sbfi_d3_length(sbfi_d3_sub(products[i], (sbfi_d3){row[0], row[1], row[2]})), 1e-8 * young);
    /* A corner's own block is positive definite in every state. */
    const double *b = blocks[i][i];
    ck_assert_double_gt(b[0], 0);
    ck_assert_double_gt(b[0] * b[4] - b[1] * b[3], 0);
    ck_assert_double_gt(b[0] * (b[4] * b[8] - b[5] * b[7]) - b[1] * (b[3] * b[8] - b[5] * b[6]) +
                            b[2] * (b[3] * b[7] - b[4] * b[6]),
        0);
  }
}
END_TEST

START_TEST(inside_out_is_pushed_back)
{
  /* Mirrored: the energy is finite, and falls towards where the element is the right way round. */
  const double mirror[9] = {-1, 0, 0, 0, 1, 0, 0, 0, 1}, flat[9] = {0, 0, 0, 0, 1, 0, 0, 0, 1};
  sbfi_d3 x[4], f[4];
  map(mirror, (sbfi_d3){0, 0, 0}, x);
  double inverted = sbfi_tetrahedron_energy(&element, x);
  ck_assert_double_eq_tol(sbfi_tetrahedron_volume_ratio(&element, x), -1, 1e-12);
  sbfi_tetrahedron_compute_forces(&element, x, f);
  double pushed = 0;
  for (int i = 0; i < 4; i++) pushed += f[i].x * rest[i].x;
  ck_assert_double_gt(pushed, 0);
  map(flat, (sbfi_d3){0, 0, 0}, x);
  double flattened = sbfi_tetrahedron_energy(&element, x);
  ck_assert_double_gt(flattened, 0);
  ck_assert_double_gt(inverted, flattened);
}
END_TEST

START_TEST(strains_are_those_of_the_axes)
{
  const double m[9] = {0, -1.5, 0, 0.8, 0, 0, 0, 0, 1.1}; /* stretches 0.8, 1.5, 1.1 and a quarter turn */
  sbfi_d3 x[4];
  map(m, (sbfi_d3){1, 1, 1}, x);
  sbfi_strains strains = sbfi_tetrahedron_strains(&element, x);
  ck_assert_double_eq_tol(strains.max, 0.5, 1e-12);
  ck_assert_double_eq_tol(strains.stretch, 0.5, 1e-12);
  const double mirror[9] = {-0.9, 0, 0, 0, 1, 0, 0, 0, 1};
  map(mirror, (sbfi_d3){0, 0, 0}, x);
  strains = sbfi_tetrahedron_strains(&element, x);
  ck_assert_double_eq_tol(strains.max, 1.9, 1e-12);
  ck_assert_double_eq_tol(strains.stretch, 0, 1e-7);
}
END_TEST

int main(void) {
  Suite *s = suite_create("neo_hookean");
  TCase *c = tcase_create("neo_hookean");
  tcase_add_checked_fixture(c, setup, NULL);
  tcase_add_test(c, volume_and_gradients);
  tcase_add_test(c, rigid_motion_costs_nothing);
  tcase_add_test(c, small_strains_obey_hooke);
  tcase_add_test(c, work_at_rest_equals_the_product);
  tcase_add_test(c, uniaxial_stress);
  tcase_add_loop_test(c, forces_are_the_slope_of_the_energy, 0, 3);
  tcase_add_loop_test(c, products_are_the_change_of_the_forces, 0, 3);
  tcase_add_test(c, inside_out_is_pushed_back);
  tcase_add_test(c, strains_are_those_of_the_axes);
  suite_add_tcase(s, c);
  return harness_run(s);
}
