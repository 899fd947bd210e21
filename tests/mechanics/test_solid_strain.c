#include "mechanics/solid_strain.h"

#include "harness.h"
#include "mechanics/neo_hookean.h"
#include "mechanics/symmetric_eigen.h"

static const sbfi_d3 rest[4] = {{0, 0, 0}, {0.3, 0.1, 0}, {0, 0.4, 0.05}, {0.1, 0, 0.2}};

typedef struct matrix {
  double at[3][3];
} matrix;

static matrix times(matrix a, matrix b) {
  matrix c = {{{0}}};
  for (int i = 0; i < 3; i++)
    for (int j = 0; j < 3; j++)
      for (int k = 0; k < 3; k++) c.at[i][j] += a.at[i][k] * b.at[k][j];
  return c;
}
static matrix transposed(matrix a) {
  matrix b;
  for (int i = 0; i < 3; i++)
    for (int j = 0; j < 3; j++) b.at[i][j] = a.at[j][i];
  return b;
}
static sbfi_d3 apply(matrix a, sbfi_d3 v) {
  return (sbfi_d3){a.at[0][0] * v.x + a.at[0][1] * v.y + a.at[0][2] * v.z,
      a.at[1][0] * v.x + a.at[1][1] * v.y + a.at[1][2] * v.z,
      a.at[2][0] * v.x + a.at[2][1] * v.y + a.at[2][2] * v.z};
}
/* About z, then about x. */
static matrix turn(double a, double b) {
  matrix z = {{{cos(a), -sin(a), 0}, {sin(a), cos(a), 0}, {0, 0, 1}}};
  matrix x = {{{1, 0, 0}, {0, cos(b), -sin(b)}, {0, sin(b), cos(b)}}};
  return times(x, z);
}
static matrix diagonal(double x, double y, double z) {
  return (matrix){{{x, 0, 0}, {0, y, 0}, {0, 0, z}}};
}

static sbfi_solid_metric metric_of(matrix inverse_plastic) {
  sbfi_tetrahedron element;
  ck_assert(sbfi_tetrahedron_make(&element, rest, sbfi_lame_of(1, 0.3)));
  static const int pairs[6][2] = {{1, 1}, {2, 2}, {3, 3}, {1, 2}, {2, 3}, {3, 1}};
  sbfi_solid_metric metric;
  for (int i = 0; i < 6; i++) /* of F_p^-T g: F_e = D (F_p D0)^-1 */
    metric.at[i] = sbfi_d3_dot(apply(transposed(inverse_plastic), element.gradients[pairs[i][0]]),
        apply(transposed(inverse_plastic), element.gradients[pairs[i][1]]));
  return metric;
}
static void edges_of(matrix f, sbfi_d3 edges[3]) {
  for (int k = 0; k < 3; k++) edges[k] = apply(f, sbfi_d3_sub(rest[k + 1], rest[0]));
}
static void sort(double v[3]) {
  for (int i = 0; i < 3; i++)
    for (int k = i + 1; k < 3; k++)
      if (v[k] < v[i]) {
        double t = v[i];
        v[i] = v[k], v[k] = t;
      }
}

START_TEST(stretches_are_the_singular_values)
{
  matrix f = times(turn(0.4, 1.1), times(diagonal(1.3, 0.8, _i ? -0.5 : 1.05), turn(-0.7, 0.2)));
  sbfi_solid_metric metric = metric_of(diagonal(1, 1, 1));
  sbfi_d3 edges[3];
  sbfi_stretches found;
  edges_of(f, edges);
  ck_assert(sbfi_stretches_find(&metric, edges, &found));
  for (int k = 0; k < 3; k++) { /* D q_k has that length */
    const double *q = found.directions[k];
    sbfi_d3 v = sbfi_d3_add(sbfi_d3_add(sbfi_d3_scale(edges[0], q[0]), sbfi_d3_scale(edges[1], q[1])),
        sbfi_d3_scale(edges[2], q[2]));
    ck_assert_double_eq_tol(sbfi_d3_length(v), fabs(found.values[k]), 1e-12);
  }
  sort(found.values);
  const double expected[2][3] = {{0.8, 1.05, 1.3}, {-0.5, 0.8, 1.3}};
  for (int k = 0; k < 3; k++) ck_assert_double_eq_tol(found.values[k], expected[_i][k], 1e-12);
}
END_TEST

START_TEST(invalid_metrics_are_refused)
{
  sbfi_d3 edges[3] = {{1, 0, 0}, {0, 1, 0}, {0, 0, 1}};
  sbfi_stretches found;
  ck_assert(!sbfi_stretches_find(&(sbfi_solid_metric){{0}}, edges, &found));
  ck_assert(!sbfi_stretches_find(&(sbfi_solid_metric){{1, 1, 1, 2, 0, 0}}, edges, &found));
  ck_assert(!sbfi_stretches_find(&(sbfi_solid_metric){{1, 1, -1, 0, 0, 0}}, edges, &found));
}
END_TEST

/* The formula of the specification, in F_p itself: F_p <- W diag(r) W^T F_p. */
static matrix flowed(matrix f, matrix inverse_plastic, double y, double fraction) {
  matrix elastic = times(f, inverse_plastic), squares = times(transposed(elastic), elastic),
         inverse = {{{0}}};
  double vectors[9], r[3], product = 1;
  sbfi_symmetric_compute_eigen(3, &squares.at[0][0], vectors);
  for (int k = 0; k < 3; k++) {
    double s = sqrt(squares.at[k][k]), cut = s > 1 + y ? 1 + y : s < 1 - y ? 1 - y : s;
    r[k] = pow(s / cut, fraction);
    product *= r[k];
  }
  for (int k = 0; k < 3; k++)
    for (int i = 0; i < 3; i++)
      for (int j = 0; j < 3; j++)
        inverse.at[i][j] += vectors[3 * i + k] * vectors[3 * j + k] / (r[k] / cbrt(product));
  return times(inverse_plastic, inverse);
}

START_TEST(flow_follows_the_specification)
{
  matrix f = times(turn(0.4, 1.1), times(diagonal(1.4, 0.7, 1.05), turn(-0.7, 0.2)));
  matrix inverse_plastic = diagonal(1, 1, 1);
  sbfi_solid_metric metric = metric_of(inverse_plastic);
  sbfi_d3 edges[3];
  for (int step = 0; step < 8; step++) {
    if (step == 4) f = times(turn(1, -0.4), times(diagonal(0.9, 1.2, 1.3), turn(0.3, 0.8)));
    sbfi_stretches found;
    edges_of(f, edges);
    ck_assert(sbfi_stretches_find(&metric, edges, &found));
    ck_assert(sbfi_solid_flow(&found, 0.05, 0.3, &metric));
    inverse_plastic = flowed(f, inverse_plastic, 0.05, 0.3);
    sbfi_solid_metric expected = metric_of(inverse_plastic);
    for (int i = 0; i < 6; i++) ck_assert_double_eq_tol(metric.at[i], expected.at[i], 1e-9 * expected.at[0]);
  }
}
END_TEST

START_TEST(flow_ends_at_the_yield_strain_and_keeps_the_volume)
{
  matrix f = diagonal(1.5, 0.85, 0.8);
  sbfi_solid_metric metric = metric_of(diagonal(1, 1, 1));
  sbfi_d3 edges[3];
  sbfi_stretches found;
  edges_of(f, edges);
  for (int step = 0; step < 400; step++) {
    ck_assert(sbfi_stretches_find(&metric, edges, &found));
    ck_assert_double_eq_tol(found.values[0] * found.values[1] * found.values[2], 1.5 * 0.85 * 0.8, 1e-6);
    if (!sbfi_solid_flow(&found, 0.1, 0.1, &metric)) break;
  }
  for (int k = 0; k < 3; k++) ck_assert_double_le(fabs(found.values[k] - 1), 0.1 + 1e-4);
  sbfi_solid_metric before = metric;
  ck_assert(!sbfi_solid_flow(&found, 0.12, 1, &metric)); /* within */
  found.values[0] = -0.5;
  ck_assert(!sbfi_solid_flow(&found, 0.1, 1, &metric)); /* inside out */
  for (int i = 0; i < 6; i++) ck_assert_double_eq(metric.at[i], before.at[i]);
}
END_TEST

int main(void) {
  Suite *s = suite_create("solid_strain");
  TCase *c = tcase_create("solid_strain");
  tcase_add_loop_test(c, stretches_are_the_singular_values, 0, 2);
  tcase_add_test(c, invalid_metrics_are_refused);
  tcase_add_test(c, flow_follows_the_specification);
  tcase_add_test(c, flow_ends_at_the_yield_strain_and_keeps_the_volume);
  suite_add_tcase(s, c);
  return harness_run(s);
}
