/* Largest frequency: Gershgorin's circles over the blocks of M^-1 K (Golub & Van Loan, Matrix
 * Computations, section 7.2), and power iteration (section 7.3). */
#include "mechanics/network.h"
#include "mechanics/vector.h"

/* K_e = V B^T C B with |dF|^2 <= |G| |u|^2: an upper bound of the stiffness at each corner. */
static void add_tetrahedra(const sbf_spring_network *network, double *sums) {
  sbfi_tetrahedron element;
  for (uint32_t t = 0; t < network->tetrahedron_count; t++) {
    if (!sbfi_network_tetrahedron(network, t, &element)) continue;
    double gram = 0, mu = element.lame.mu, first = element.lame.lambda - mu;
    for (int i = 0; i < 4; i++)
      for (int j = 0; j < 4; j++) {
        double product = sbfi_d3_dot(element.gradients[i], element.gradients[j]);
        gram += product * product;
      }
    double stiffest = first > 0 ? 3 * first + 2 * mu : 2 * mu;
    for (int k = 0; k < 4; k++) sums[network->tetrahedra[t].at[k]] += element.volume * stiffest * sqrt(gram);
  }
}

double sbf_network_highest_bound(const sbf_spring_network *network, double *scratch) {
  double highest = 0;
  for (uint32_t i = 0; i < network->point_count; i++) scratch[i] = network->anchors ? network->anchors[i] : 0;
  for (uint32_t s = 0; s < network->spring_count; s++) {
    uint32_t a = network->ends[s].at[0], b = network->ends[s].at[1];
    double k = network->stiffness[s];
    /* The point's own block, and the neighbour's if that is free. */
    scratch[a] += network->masses[b] > 0 ? 2 * k : k;
    scratch[b] += network->masses[a] > 0 ? 2 * k : k;
  }
  add_tetrahedra(network, scratch);
  for (uint32_t i = 0; i < network->point_count; i++) {
    double squared = network->masses[i] > 0 ? scratch[i] / network->masses[i] : 0;
    if (squared > highest) highest = squared;
  }
  return sqrt(highest);
}

/* Deterministic pseudo-random numbers in -1..1. */
static double scattered(uint64_t i) {
  uint64_t mixed = (i + 1) * UINT64_C(0x9e3779b97f4a7c15);
  mixed = (mixed ^ mixed >> 30) * UINT64_C(0xbf58476d1ce4e5b9);
  return (double)(int64_t)(mixed ^ mixed >> 27) / 9223372036854775808.0;
}

double sbf_network_highest(const sbf_spring_network *network, uint32_t iterations, double *scratch) {
  size_t size = 3 * (size_t)network->point_count;
  double *v = scratch, *w = scratch + size, squared = 0;
  for (size_t i = 0; i < size; i++) v[i] = network->masses[i / 3] > 0 ? scattered(i) : 0;
  for (uint32_t n = 0; n <= iterations; n++) {
    /* v = displacements of length 1 in the mass norm; then w = M^-1 K v, and v.M w is Rayleigh's quotient. */
    double length = 0, quotient = 0;
    for (size_t i = 0; i < size; i++) length += v[i] * v[i] * network->masses[i / 3];
    if (!(length > 0)) return 0;
    for (size_t i = 0; i < size; i++) v[i] /= sqrt(length);
    sbfi_network_apply(network, NULL, v, w);
    for (size_t i = 0; i < size; i++) {
      quotient += v[i] * w[i];
      v[i] = network->masses[i / 3] > 0 ? w[i] / network->masses[i / 3] : 0;
    }
    squared = quotient;
  }
  return sqrt(squared > 0 ? squared : 0);
}
