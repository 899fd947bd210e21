#include "mechanics/network.h"

#include "mechanics/vector.h"

double sbfi_dot(const double *a, const double *b, size_t count) {
  double sum = 0;
  for (size_t i = 0; i < count; i++) sum += a[i] * b[i];
  return sum;
}

static sbfi_d3 load(const double *x, uint32_t point, double scale) {
  const double *at = x + 3 * (size_t)point;
  return (sbfi_d3){at[0] * scale, at[1] * scale, at[2] * scale};
}

static void add(double *y, uint32_t point, sbfi_d3 direction, double factor) {
  double *at = y + 3 * (size_t)point;
  at[0] += direction.x * factor;
  at[1] += direction.y * factor;
  at[2] += direction.z * factor;
}

bool sbfi_network_tetrahedron(const sbf_spring_network *network, uint32_t t, sbfi_tetrahedron *made) {
  sbfi_d3 rest[4];
  for (int k = 0; k < 4; k++) rest[k] = sbfi_d3_of(network->positions[network->tetrahedra[t].at[k]]);
  return sbfi_tetrahedron_make(
      made, rest, sbfi_lame_of(network->young_modulus[t], network->poisson_ratios[t]));
}

static void apply_tetrahedra(
    const sbf_spring_network *network, const double *scale, const double *x, double *y) {
  sbfi_tetrahedron element;
  sbfi_d3 rest[4], u[4], products[4];
  for (uint32_t t = 0; t < network->tetrahedron_count; t++) {
    const uint32_t *at = network->tetrahedra[t].at;
    double scales[4];
    if (!sbfi_network_tetrahedron(network, t, &element)) continue;
    for (int k = 0; k < 4; k++) {
      scales[k] = network->masses[at[k]] > 0 ? (scale ? scale[at[k]] : 1) : 0;
      rest[k] = sbfi_d3_of(network->positions[at[k]]);
      u[k] = load(x, at[k], scales[k]);
    }
    sbfi_tetrahedron_product(&element, rest, u, products);
    for (int k = 0; k < 4; k++) add(y, at[k], products[k], scales[k]);
  }
}

static void apply_hinges(const sbf_spring_network *network, const double *scale, const double *x, double *y) {
  for (uint32_t h = 0; h < network->hinge_count; h++) {
    const uint32_t *at = network->hinges[h].at;
    const sbf_vec3 *gradients = network->hinge_gradients + 4 * (size_t)h;
    double scales[4], angle = 0;
    for (int k = 0; k < 4; k++) {
      scales[k] = network->masses[at[k]] > 0 ? (scale ? scale[at[k]] : 1) : 0;
      angle += sbfi_d3_dot(sbfi_d3_of(gradients[k]), load(x, at[k], scales[k]));
    }
    double moment = (double)network->hinge_stiffness[h] * angle;
    for (int k = 0; k < 4; k++) add(y, at[k], sbfi_d3_of(gradients[k]), moment * scales[k]);
  }
}

void sbfi_network_apply(const sbf_spring_network *network, const double *scale, const double *x, double *y) {
  for (uint32_t i = 0; i < network->point_count; i++) {
    double anchor = network->anchors && network->masses[i] > 0 ? network->anchors[i] : 0;
    if (scale) anchor *= scale[i] * scale[i];
    for (int k = 0; k < 3; k++) y[3 * (size_t)i + k] = anchor * x[3 * (size_t)i + k];
  }
  for (uint32_t s = 0; s < network->spring_count; s++) {
    uint32_t a = network->ends[s].at[0], b = network->ends[s].at[1];
    double a_scale = network->masses[a] > 0 ? (scale ? scale[a] : 1) : 0;
    double b_scale = network->masses[b] > 0 ? (scale ? scale[b] : 1) : 0;
    sbfi_d3 displacement = sbfi_d3_sub(sbfi_d3_of(network->positions[b]), sbfi_d3_of(network->positions[a]));
    double squared = sbfi_d3_dot(displacement, displacement);
    if (!(squared > 0)) continue;
    double stretch = sbfi_d3_dot(sbfi_d3_sub(load(x, b, b_scale), load(x, a, a_scale)), displacement);
    double pull = network->stiffness[s] * stretch / squared;
    add(y, a, displacement, -pull * a_scale);
    add(y, b, displacement, pull * b_scale);
  }
  apply_tetrahedra(network, scale, x, y);
  apply_hinges(network, scale, x, y);
}

void sbfi_network_solve(const sbf_spring_network *network, const double *scale, sbfi_null_fields null_fields,
    double tolerance, uint32_t iterations, double *r, double *y, double *work) {
  size_t size = 3 * (size_t)network->point_count;
  double *p = work, *q = work + size;
  if (null_fields.project) null_fields.project(null_fields.user, r);
  for (size_t i = 0; i < size; i++) {
    y[i] = 0;
    p[i] = r[i];
  }
  double left = sbfi_dot(r, r, size), enough = tolerance * tolerance * left, stiffest = 0;
  for (uint32_t n = 0; n < iterations && left > enough; n++) {
    sbfi_network_apply(network, scale, p, q);
    double resisted = sbfi_dot(p, q, size), quotient = resisted / sbfi_dot(p, p, size);
    if (quotient > stiffest) stiffest = quotient;
    if (!(quotient > 1e-12 * stiffest)) break; /* no stiffness in this direction beyond rounding */
    double step = left / resisted;
    for (size_t i = 0; i < size; i++) {
      y[i] += step * p[i];
      r[i] -= step * q[i];
    }
    double before = left;
    left = sbfi_dot(r, r, size);
    for (size_t i = 0; i < size; i++) p[i] = r[i] + left / before * p[i];
  }
  /* K maps nothing into the null fields, so this removes only rounding errors. */
  if (null_fields.project) null_fields.project(null_fields.user, y);
}

double sbf_network_static(const sbf_spring_network *network, const double *forces, double tolerance,
    uint32_t iterations, double *displacements, double *scratch) {
  uint32_t count = network->point_count;
  size_t size = 3 * (size_t)count;
  double *scale = scratch, *r = scratch + count, *work = r + size;
  /* Scales by the stiffness at each point: the cheapest preconditioner. */
  for (uint32_t i = 0; i < count; i++)
    scale[i] = network->anchors && network->masses[i] > 0 ? network->anchors[i] : 0;
  for (uint32_t s = 0; s < network->spring_count; s++)
    for (int end = 0; end < 2; end++) scale[network->ends[s].at[end]] += network->stiffness[s];
  for (uint32_t t = 0; t < network->tetrahedron_count; t++) {
    sbfi_tetrahedron element;
    if (!sbfi_network_tetrahedron(network, t, &element)) continue;
    for (int k = 0; k < 4; k++)
      scale[network->tetrahedra[t].at[k]] += element.volume * (3 * element.lame.mu + element.lame.lambda) *
                                             sbfi_d3_dot(element.gradients[k], element.gradients[k]);
  }
  double total = 0;
  for (uint32_t i = 0; i < count; i++) {
    scale[i] = network->masses[i] > 0 && scale[i] > 0 ? 1 / sqrt(scale[i]) : 0;
    for (int k = 0; k < 3; k++) {
      size_t index = 3 * (size_t)i + (size_t)k;
      r[index] = forces[index] * scale[i];
      if (network->masses[i] > 0) total += forces[index] * forces[index];
    }
  }
  sbfi_network_solve(
      network, scale, (sbfi_null_fields){NULL, NULL}, tolerance, iterations, r, displacements, work);
  for (uint32_t i = 0; i < count; i++)
    for (int k = 0; k < 3; k++) displacements[3 * (size_t)i + (size_t)k] *= scale[i];
  sbfi_network_apply(network, NULL, displacements, work);
  double missing = 0;
  for (size_t i = 0; i < size; i++) {
    double error = network->masses[i / 3] > 0 ? forces[i] - work[i] : 0;
    missing += error * error;
  }
  return total > 0 ? sqrt(missing / total) : 0;
}
