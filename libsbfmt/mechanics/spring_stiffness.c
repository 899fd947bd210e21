/* Stiffness of springs that represent a material. */
#include "mechanics/level_points.h"
#include "mechanics/symmetric_eigen.h"
#include "mechanics/vector.h"
#include "sbfmt/mechanics.h"

/* Springs shorter than this fraction of the mean of their neighbours count as that long. */
static const double short_fraction = 0.5;

static double distance(const sbf_vec3 *positions, sbf_uint2 ends) {
  return sbfi_d3_length(sbfi_d3_sub(sbfi_d3_of(positions[ends.at[1]]), sbfi_d3_of(positions[ends.at[0]])));
}

/* Springs at a point: sum of their lengths, and their number. */
typedef struct length_sum {
  double length, count;
} length_sum;

static void add_lengths(const sbf_vec3 *positions, const sbf_uint2 *ends, uint32_t count, length_sum *sums) {
  for (uint32_t s = 0; s < count; s++) {
    double length = distance(positions, ends[s]);
    for (int end = 0; end < 2; end++) {
      sums[ends[s].at[end]].length += length;
      sums[ends[s].at[end]].count += 1;
    }
  }
}

/* C E V_s / L^2 with V_s = L (V_a / sum_a + V_b / sum_b): one length cancels. */
static void distribute_volumes(double modulus, const sbf_vec3 *positions, const float *volumes,
    const sbf_uint2 *ends, uint32_t count, const length_sum *sums, float *stiffness) {
  for (uint32_t s = 0; s < count; s++) {
    uint32_t a = ends[s].at[0], b = ends[s].at[1];
    double length = distance(positions, ends[s]);
    stiffness[s] = 0;
    if (!(length > 0)) continue;
    double mean = (sums[a].length + sums[b].length) / (sums[a].count + sums[b].count);
    double section = volumes[a] / sums[a].length + volumes[b] / sums[b].length;
    double counted = length > short_fraction * mean ? length : short_fraction * mean;
    stiffness[s] = (float)(modulus * section / counted);
  }
}

void sbf_stiffness_of_network(double modulus, const sbf_vec3 *positions, uint32_t point_count,
    const float *volumes, const sbf_uint2 *ends, uint32_t spring_count, double *scratch, float *stiffness) {
  _Static_assert(sizeof(length_sum) == 2 * sizeof(double), "the scratch memory's shape");
  length_sum *sums = (length_sum *)scratch;
  for (uint32_t i = 0; i < point_count; i++) sums[i] = (length_sum){0, 0};
  add_lengths(positions, ends, spring_count, sums);
  distribute_volumes(modulus, positions, volumes, ends, spring_count, sums, stiffness);
}

/* Sums over the anchored springs of one free point. */
typedef struct anchored {
  double count, squares,
      fourths;      /* number of springs, sums of c^2 and c^4; then a, b of k = a + b c^2 in the first two */
  double tensor[6]; /* sum of k n n^T: xx yy zz xy yz zx */
} anchored;

enum { ANCHORED_NUMBERS = 9, MAX_RAISED = 4 /* twice the frequency */ };
static const double min_fraction = 0.05;

/* The free end; the point count if the spring does not connect a pinned to a free point. */
static uint32_t free_end(const uint8_t *pinned, sbf_uint2 ends, uint32_t point_count) {
  if (!pinned[ends.at[0]] == !pinned[ends.at[1]]) return point_count;
  return pinned[ends.at[0]] ? ends.at[1] : ends.at[0];
}

static sbfi_d3 direction(const sbf_vec3 *positions, sbf_uint2 ends) {
  return sbfi_d3_normal(sbfi_d3_sub(sbfi_d3_of(positions[ends.at[1]]), sbfi_d3_of(positions[ends.at[0]])));
}

static double squared_cosine(sbf_vec3 normal, const sbf_vec3 *positions, sbf_uint2 ends) {
  double c = sbfi_d3_dot(direction(positions, ends), sbfi_d3_of(normal));
  return c * c;
}

/* a and b of k = a + b c^2 for a trace of 1, 0.6 of it along the axis: n a + S2 b = 1 and S2 a + S4 b =
 * 0.6. If all springs have equal angles only the trace can be matched. If the solution has negative
 * stiffnesses, b is reduced so that the weakest keeps a tenth of the mean. */
static void fit(anchored *at) {
  double determinant = at->count * at->fourths - at->squares * at->squares, mean = 1 / at->count;
  double b = determinant > 1e-6 * at->count * at->count ? (0.6 * at->count - at->squares) / determinant : 0;
  double mean_square = at->squares / at->count;
  /* With the trace preserved, k = mean + b (c^2 - mean square), and c^2 is in 0..1. */
  double min = b > 0 ? mean - b * mean_square : mean + b * (1 - mean_square);
  if (min < 0.1 * mean) b *= 0.9 * mean / (mean - min);
  at->count = mean - b * mean_square;
  at->squares = b;
}

/* Raises all springs of a point if some direction has almost no stiffness. */
static void raise(anchored *at) {
  const double *t = at->tensor;
  double matrix[9] = {t[0], t[3], t[5], t[3], t[1], t[4], t[5], t[4], t[2]}, vectors[9];
  sbfi_symmetric_compute_eigen(3, matrix, vectors);
  double min = matrix[0] < matrix[4] ? matrix[0] : matrix[4];
  if (matrix[8] < min) min = matrix[8];
  double wanted = min_fraction / SBF_STIFFNESS_ANCHOR, raised = 1; /* for a trace of 1 */
  if (min < wanted) raised = min > wanted / MAX_RAISED ? wanted / min : MAX_RAISED;
  if (min < 1e-6) raised = 1; /* no spring has that direction: scaling cannot help */
  at->count *= raised;
  at->squares *= raised;
}

void sbf_stiffness_of_anchors(double modulus, double depth, const sbf_vec3 *normals,
    const sbf_vec3 *positions, uint32_t point_count, const float *volumes, const uint8_t *pinned,
    const sbf_uint2 *ends, uint32_t spring_count, double *scratch, float *stiffness) {
  _Static_assert(sizeof(anchored) == ANCHORED_NUMBERS * sizeof(double), "the scratch memory's shape");
  anchored *gathered = (anchored *)scratch;
  for (uint32_t i = 0; i < point_count; i++) gathered[i] = (anchored){0};
  for (uint32_t s = 0; s < spring_count; s++) {
    uint32_t point = free_end(pinned, ends[s], point_count);
    if (point == point_count || !(distance(positions, ends[s]) > 0)) continue;
    double square = squared_cosine(normals[point], positions, ends[s]);
    gathered[point].count += 1;
    gathered[point].squares += square;
    gathered[point].fourths += square * square;
  }
  for (uint32_t i = 0; i < point_count; i++)
    if (gathered[i].count > 0) fit(&gathered[i]);
  for (uint32_t s = 0; s < spring_count; s++) {
    uint32_t point = free_end(pinned, ends[s], point_count);
    if (point == point_count) continue;
    sbfi_d3 n = direction(positions, ends[s]);
    anchored *at = &gathered[point];
    double k = at->count + at->squares * squared_cosine(normals[point], positions, ends[s]);
    const double products[6] = {n.x * n.x, n.y * n.y, n.z * n.z, n.x * n.y, n.y * n.z, n.z * n.x};
    for (int i = 0; i < 6; i++) at->tensor[i] += k * products[i];
  }
  for (uint32_t i = 0; i < point_count; i++)
    if (gathered[i].count > 0) raise(&gathered[i]);
  for (uint32_t s = 0; s < spring_count; s++) {
    uint32_t point = free_end(pinned, ends[s], point_count);
    stiffness[s] = 0;
    if (point == point_count || !(distance(positions, ends[s]) > 0) || !(depth > 0)) continue;
    double trace = SBF_STIFFNESS_ANCHOR * modulus * volumes[point] / (depth * depth);
    const anchored *at = &gathered[point];
    stiffness[s] =
        (float)(trace * (at->count + at->squares * squared_cosine(normals[point], positions, ends[s])));
  }
}

void sbf_level_stiffness(
    const sbf_soft_body *body, const sbf_level *level, float *volumes, double *scratch, float *stiffness) {
  length_sum *sums = (length_sum *)scratch;
  sbf_body_measures measures;
  sbf_body_measure(body, &measures);
  sbf_level_mass_fractions(body, level, NULL, volumes);
  double modulus =
      body->attributes.young_modulus * (measures.sheet ? SBF_STIFFNESS_SHEET : SBF_STIFFNESS_VOLUME);
  uint32_t count = level->positions.count;
  sbfi_level_weigh(body, level, SBF_WEIGHT_PROPERTY_YOUNG_MODULUS, volumes);
  for (uint32_t i = 0; i < count; i++) {
    volumes[i] = (float)(volumes[i] * measures.volume);
    sums[i] = (length_sum){0, 0};
  }
  for (uint32_t s = 0; s < level->springs.count; s++) {
    const sbf_spring_set *set = &level->springs.at[s];
    if (set->stiffness.count == 0) add_lengths(level->positions.at, set->ends.at, set->ends.count, sums);
  }
  for (uint32_t s = 0; s < level->springs.count; s++) {
    const sbf_spring_set *set = &level->springs.at[s];
    if (set->stiffness.count == 0)
      distribute_volumes(
          modulus, level->positions.at, volumes, set->ends.at, set->ends.count, sums, stiffness);
    for (uint32_t i = 0; i < set->ends.count && set->stiffness.count > 0; i++)
      stiffness[i] = set->stiffness.at[set->stiffness.count == 1 ? 0 : i];
    stiffness += set->ends.count;
  }
}
