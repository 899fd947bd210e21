/* Lowest mode by the Rayleigh-Ritz method with quadratic polynomials of the position as displacement
 * fields, so that a body can translate, rotate, stretch, bend and twist as a whole; then inverse
 * iteration. */
#include <string.h>

#include "mechanics/network.h"
#include "mechanics/symmetric_eigen.h"
#include "mechanics/vector.h"

enum { MONOMIALS = 10, FIELDS = 3 * MONOMIALS, MAX_NULL = 6, INVERSE_STEPS = 4, SOLVE_STEPS = 200 };

typedef struct basis {
  const sbf_spring_network *network;
  const double *scale_of; /* (point_count) 1 / root of the mass; 0: pinned or too loose */
  sbfi_d3 center;
  double shrink;                 /* 1 / size of the body */
  uint32_t null_count;           /* number of fields without stiffness */
  double null[MAX_NULL][FIELDS]; /* coefficients by monomial, orthonormal with respect to mass */
} basis;

static void evaluate(const basis *of, uint32_t point, double monomials[MONOMIALS]) {
  sbfi_d3 p = sbfi_d3_scale(sbfi_d3_sub(sbfi_d3_of(of->network->positions[point]), of->center), of->shrink);
  const double values[MONOMIALS] = {
      1, p.x, p.y, p.z, p.x * p.x, p.y * p.y, p.z * p.z, p.x * p.y, p.y * p.z, p.z * p.x};
  memcpy(monomials, values, sizeof values);
}

static double mass_of(const basis *of, uint32_t point) {
  double scale = of->scale_of[point];
  return scale > 0 ? 1 / (scale * scale) : 0;
}

/* A point on a single spring, where others have three or more, swings like a pendulum. Such modes are
 * irrelevant for the body, so the point counts as pinned. */
static void find_scales(const sbf_spring_network *network, double *scale_of) {
  double max = 0;
  for (uint32_t i = 0; i < network->point_count; i++)
    scale_of[i] = network->anchors && network->anchors[i] > 0 ? 3 : 0;
  for (uint32_t s = 0; s < network->spring_count; s++)
    for (int end = 0; end < 2; end++) scale_of[network->ends[s].at[end]] += network->stiffness[s] > 0;
  for (uint32_t t = 0; t < network->tetrahedron_count; t++)
    for (int k = 0; k < 4; k++) scale_of[network->tetrahedra[t].at[k]] += 3;
  for (uint32_t i = 0; i < network->point_count; i++)
    if (network->masses[i] > 0 && scale_of[i] > max) max = scale_of[i];
  for (uint32_t i = 0; i < network->point_count; i++) {
    bool counts = network->masses[i] > 0 && (scale_of[i] > 1 || max < 3);
    scale_of[i] = counts ? 1 / sqrt(network->masses[i]) : 0;
  }
}

static void fill_basis(basis *of, const sbf_spring_network *network, const double *scale_of) {
  double mass = 0, spread = 0;
  *of = (basis){.network = network, .scale_of = scale_of, .shrink = 1};
  for (uint32_t i = 0; i < network->point_count; i++) {
    of->center = sbfi_d3_add(of->center, sbfi_d3_scale(sbfi_d3_of(network->positions[i]), mass_of(of, i)));
    mass += mass_of(of, i);
  }
  if (!(mass > 0)) return;
  of->center = sbfi_d3_scale(of->center, 1 / mass);
  for (uint32_t i = 0; i < network->point_count; i++) {
    sbfi_d3 from = sbfi_d3_sub(sbfi_d3_of(network->positions[i]), of->center);
    spread += mass_of(of, i) * sbfi_d3_dot(from, from);
  }
  if (spread > 0) of->shrink = sqrt(mass / spread);
}

/* Makes scalar fields orthonormal with respect to mass, `coefficients` (MONOMIALS x count) by columns.
 * Drops combinations that vanish at all points, such as z in a flat body. */
static int orthonormalise(const basis *of, double coefficients[MONOMIALS * MONOMIALS]) {
  double gram[MONOMIALS * MONOMIALS] = {0}, vectors[MONOMIALS * MONOMIALS], phi[MONOMIALS], max = 0;
  for (uint32_t i = 0; i < of->network->point_count; i++) {
    evaluate(of, i, phi);
    for (int a = 0; a < MONOMIALS; a++)
      for (int b = 0; b < MONOMIALS; b++) gram[a * MONOMIALS + b] += mass_of(of, i) * phi[a] * phi[b];
  }
  sbfi_symmetric_compute_eigen(MONOMIALS, gram, vectors);
  for (int a = 0; a < MONOMIALS; a++)
    if (gram[a * (MONOMIALS + 1)] > max) max = gram[a * (MONOMIALS + 1)];
  int count = 0;
  for (int a = 0; a < MONOMIALS; a++) {
    double value = gram[a * (MONOMIALS + 1)];
    if (!(value > 1e-10 * max)) continue;
    for (int m = 0; m < MONOMIALS; m++)
      coefficients[m * MONOMIALS + count] = vectors[m * MONOMIALS + a] / sqrt(value);
    count++;
  }
  return count;
}

/* Adds an element's term to the energy matrix: k g g^T. */
static void add_energy(double stiffness[FIELDS * FIELDS], double k, const double g[FIELDS]) {
  for (int a = 0; a < FIELDS; a++)
    for (int b = 0; b <= a && g[a] != 0; b++) stiffness[a * FIELDS + b] += k * g[a] * g[b];
}

/* Hooke's law as a sum of squares: half of lambda (tr e)^2 + 2 mu sum e_ii^2 + mu sum of the squared
 * shears. */
static void add_tetrahedra(const basis *of, double stiffness[FIELDS * FIELDS]) {
  const sbf_spring_network *network = of->network;
  double phi[MONOMIALS], slopes[3][MONOMIALS], g[FIELDS];
  sbfi_tetrahedron element;
  for (uint32_t t = 0; t < network->tetrahedron_count; t++) {
    if (!sbfi_network_tetrahedron(network, t, &element)) continue;
    memset(slopes, 0, sizeof slopes);
    for (int k = 0; k < 4; k++) {
      uint32_t point = network->tetrahedra[t].at[k];
      if (!(of->scale_of[point] > 0)) continue;
      evaluate(of, point, phi);
      for (int m = 0; m < MONOMIALS; m++) {
        slopes[0][m] += phi[m] * element.gradients[k].x;
        slopes[1][m] += phi[m] * element.gradients[k].y;
        slopes[2][m] += phi[m] * element.gradients[k].z;
      }
    }
    double mu = element.volume * element.lame.mu, first = element.volume * element.lame.lambda - mu;
    for (int f = 0; f < FIELDS; f++) g[f] = slopes[f % 3][f / 3];
    add_energy(stiffness, first, g);
    for (int axis = 0; axis < 3; axis++) {
      int next = (axis + 1) % 3;
      for (int f = 0; f < FIELDS; f++) g[f] = f % 3 == axis ? slopes[axis][f / 3] : 0;
      add_energy(stiffness, 2 * mu, g);
      for (int f = 0; f < FIELDS; f++)
        g[f] = f % 3 == axis ? slopes[next][f / 3] : f % 3 == next ? slopes[axis][f / 3] : 0;
      add_energy(stiffness, mu, g);
    }
  }
}

static void add_hinges(const basis *of, double stiffness[FIELDS * FIELDS]) {
  const sbf_spring_network *network = of->network;
  double phi[MONOMIALS], g[FIELDS];
  for (uint32_t h = 0; h < network->hinge_count; h++) {
    memset(g, 0, sizeof g);
    for (int k = 0; k < 4; k++) {
      uint32_t point = network->hinges[h].at[k];
      sbf_vec3 by = network->hinge_gradients[4 * (size_t)h + (size_t)k];
      if (!(of->scale_of[point] > 0)) continue;
      evaluate(of, point, phi);
      for (int m = 0; m < MONOMIALS; m++) {
        g[3 * m] += (double)by.x * phi[m];
        g[3 * m + 1] += (double)by.y * phi[m];
        g[3 * m + 2] += (double)by.z * phi[m];
      }
    }
    add_energy(stiffness, (double)network->hinge_stiffness[h], g);
  }
}

static void sum_stiffness(const basis *of, double stiffness[FIELDS * FIELDS]) {
  const sbf_spring_network *network = of->network;
  double from[MONOMIALS], to[MONOMIALS], g[FIELDS];
  memset(stiffness, 0, FIELDS * FIELDS * sizeof *stiffness);
  for (uint32_t s = 0; s < network->spring_count; s++) {
    uint32_t a = network->ends[s].at[0], b = network->ends[s].at[1];
    sbfi_d3 n =
        sbfi_d3_normal(sbfi_d3_sub(sbfi_d3_of(network->positions[b]), sbfi_d3_of(network->positions[a])));
    double a_moves = of->scale_of[a] > 0, b_moves = of->scale_of[b] > 0;
    evaluate(of, a, from);
    evaluate(of, b, to);
    for (int m = 0; m < MONOMIALS; m++) {
      double difference = b_moves * to[m] - a_moves * from[m];
      g[3 * m] = n.x * difference;
      g[3 * m + 1] = n.y * difference;
      g[3 * m + 2] = n.z * difference;
    }
    add_energy(stiffness, network->stiffness[s], g);
  }
  for (uint32_t i = 0; network->anchors && i < network->point_count; i++) {
    if (!(of->scale_of[i] > 0) || !(network->anchors[i] > 0)) continue;
    evaluate(of, i, from);
    for (int axis = 0; axis < 3; axis++) {
      for (int f = 0; f < FIELDS; f++) g[f] = f % 3 == axis ? from[f / 3] : 0;
      add_energy(stiffness, network->anchors[i], g);
    }
  }
  add_tetrahedra(of, stiffness);
  add_hinges(of, stiffness);
  for (int a = 0; a < FIELDS; a++)
    for (int b = a + 1; b < FIELDS; b++) stiffness[a * FIELDS + b] = stiffness[b * FIELDS + a];
}

/* Finds the lowest eigenvalue above zero and its field; stores fields below it as null fields. Returns 0
 * if there is none. */
static double ritz(basis *of, double threshold, double field[FIELDS]) {
  double coefficients[MONOMIALS * MONOMIALS], full[FIELDS * FIELDS], small[FIELDS * FIELDS],
      vectors[FIELDS * FIELDS], half[FIELDS];
  int scalars = orthonormalise(of, coefficients), count = 3 * scalars, lowest = -1;
  sum_stiffness(of, full);
  for (int j = 0; j < count; j++) {
    /* Column j of C^T K C: field j is scalar field j / 3 along axis j % 3. */
    for (int a = 0; a < FIELDS; a++) {
      half[a] = 0;
      for (int m = 0; m < MONOMIALS; m++)
        half[a] += full[a * FIELDS + 3 * m + j % 3] * coefficients[m * MONOMIALS + j / 3];
    }
    for (int i = 0; i < count; i++) {
      double sum = 0;
      for (int m = 0; m < MONOMIALS; m++) sum += coefficients[m * MONOMIALS + i / 3] * half[3 * m + i % 3];
      small[i * count + j] = sum;
    }
  }
  sbfi_symmetric_compute_eigen(count, small, vectors);
  of->null_count = 0;
  for (int i = 0; i < count; i++) {
    double value = small[i * (count + 1)], *target = field;
    if (value > threshold) {
      if (lowest >= 0 && value >= small[lowest * (count + 1)]) continue;
      lowest = i;
    } else {
      if (of->null_count++ >= MAX_NULL) continue;
      target = of->null[of->null_count - 1];
    }
    memset(target, 0, FIELDS * sizeof *target);
    for (int j = 0; j < count; j++)
      for (int m = 0; m < MONOMIALS; m++)
        target[3 * m + j % 3] += vectors[j * count + i] * coefficients[m * MONOMIALS + j / 3];
  }
  return lowest < 0 ? 0 : small[lowest * (count + 1)];
}

/* Displacement of the field at a point times the root of its mass. */
static void weigh(const basis *of, const double field[FIELDS], uint32_t point, double v[3]) {
  double phi[MONOMIALS], root = sqrt(mass_of(of, point));
  evaluate(of, point, phi);
  for (int axis = 0; axis < 3; axis++) {
    v[axis] = 0;
    for (int m = 0; m < MONOMIALS; m++) v[axis] += root * field[3 * m + axis] * phi[m];
  }
}

static void project(const void *user, double *v) {
  const basis *of = user;
  double part[3];
  for (uint32_t n = 0; n < of->null_count; n++) {
    double fraction = 0;
    for (uint32_t i = 0; i < of->network->point_count; i++) {
      weigh(of, of->null[n], i, part);
      fraction += sbfi_dot(part, v + 3 * (size_t)i, 3);
    }
    for (uint32_t i = 0; i < of->network->point_count; i++) {
      weigh(of, of->null[n], i, part);
      for (int axis = 0; axis < 3; axis++) v[3 * (size_t)i + axis] -= fraction * part[axis];
    }
  }
}

/* Inverse iteration in mass-normalized coordinates. Returns `start` if the quotient falls below a quarter,
 * because it then converges to a loose part instead of the body's mode. */
static double iterate(const basis *of, double start, const double field[FIELDS], double *scratch) {
  const sbf_spring_network *network = of->network;
  size_t size = 3 * (size_t)network->point_count;
  double *v = scratch + network->point_count, *r = v + size, *y = r + size, *work = y + size;
  double best = start;
  for (uint32_t i = 0; i < network->point_count; i++) weigh(of, field, i, v + 3 * (size_t)i);
  sbfi_null_fields none = {of->null_count ? project : NULL, of};
  for (int n = 0; n < INVERSE_STEPS; n++) {
    double length = sqrt(sbfi_dot(v, v, size));
    if (!(length > 0)) return best;
    for (size_t i = 0; i < size; i++) r[i] = v[i] /= length;
    sbfi_network_solve(network, of->scale_of, none, 1e-3, SOLVE_STEPS, r, y, work);
    sbfi_network_apply(network, of->scale_of, y, work);
    double norm = sbfi_dot(y, y, size), value = norm > 0 ? sbfi_dot(y, work, size) / norm : 0;
    if (!(value > start / 4)) return start;
    if (value < best) best = value;
    memcpy(v, y, size * sizeof *v);
  }
  return best;
}

/* Fraction of the squared bound below which a mode has no stiffness: sheets bend a million times as easily
 * as they stretch. */
static const double NOTHING = 1e-10, NOTHING_OF_SHEETS = 1e-14;

double sbf_network_lowest(const sbf_spring_network *network, bool refine, double *scratch) {
  basis of;
  double field[FIELDS], bound = sbf_network_highest_bound(network, scratch);
  if (!(bound > 0)) return 0;
  find_scales(network, scratch);
  fill_basis(&of, network, scratch);
  double nothing = network->hinge_count ? NOTHING_OF_SHEETS : NOTHING;
  double value = ritz(&of, nothing * bound * bound, field);
  if (!(value > 0)) return 0;
  if (refine && of.null_count <= MAX_NULL) value = iterate(&of, value, field, scratch);
  return sqrt(value);
}
