#include "interchange/paper_units.h"

#include <math.h>
#include <stdlib.h>

#include "base/memory.h"
#include "mechanics/vector.h"

static const double TICK = 1.0 / 60;
/* maximum fraction of an error that a tick removes: a slider at 1 would be rigid */
static const double MAX = 0.999;

static int compare_edges(const void *a, const void *b) {
  uint64_t x = *(const uint64_t *)a, y = *(const uint64_t *)b;
  return x < y ? -1 : x > y;
}

bool sbfi_paper_measure(sbf_vec3_list positions, sbf_uint4_list tetrahedra, const sbf_allocator *allocator,
    sbfi_paper_sums *sums) {
  static const int sides[6][2] = {{0, 1}, {0, 2}, {0, 3}, {1, 2}, {1, 3}, {2, 3}};
  *sums = (sbfi_paper_sums){.point_count = positions.count};
  if (!tetrahedra.count) return true;
  sbf_allocator memory = sbfi_allocator_or_default(allocator);
  size_t count = (size_t)tetrahedra.count * 6, bytes;
  uint64_t *edges = sbfi_multiply_size(count, sizeof *edges, &bytes) ? sbfi_allocate(&memory, bytes) : NULL;
  if (!edges) return false;
  for (uint32_t i = 0; i < tetrahedra.count; i++) {
    const uint32_t *p = tetrahedra.at[i].at;
    sbfi_d3 a = sbfi_d3_of(positions.at[p[0]]), u = sbfi_d3_sub(sbfi_d3_of(positions.at[p[1]]), a),
            v = sbfi_d3_sub(sbfi_d3_of(positions.at[p[2]]), a),
            w = sbfi_d3_sub(sbfi_d3_of(positions.at[p[3]]), a);
    sums->volume += sbfi_d3_dot(u, sbfi_d3_cross(v, w)) / 6;
    for (int k = 0; k < 6; k++) {
      uint32_t x = p[sides[k][0]], y = p[sides[k][1]];
      edges[(size_t)i * 6 + (size_t)k] = x < y ? (uint64_t)x << 32 | y : (uint64_t)y << 32 | x;
    }
  }
  qsort(edges, count, sizeof *edges, compare_edges);
  for (size_t i = 0; i < count; i++) {
    if (i && edges[i] == edges[i - 1]) continue;
    sbfi_d3 side =
        sbfi_d3_sub(sbfi_d3_of(positions.at[edges[i] >> 32]), sbfi_d3_of(positions.at[(uint32_t)edges[i]]));
    sums->edge_squares += sbfi_d3_dot(side, side);
  }
  sbfi_free(&memory, edges, bytes);
  return true;
}

/* Fraction of an error that `iterations` of a slider remove per tick, and the inverse. */
static double fraction_of(double slider, uint32_t iterations) {
  double left = slider < 1 ? pow(1 - slider, iterations > 1 ? iterations : 1) : 0;
  return 1 - left < MAX ? 1 - left : MAX;
}

static double slider_of(double fraction, uint32_t iterations) {
  double limited = fraction < 0 ? 0 : fraction < MAX ? fraction : MAX;
  return 1 - pow(1 - limited, 1.0 / (iterations > 1 ? iterations : 1));
}

/* Pa at a fraction of one half. */
static double modulus_scale(double mass, const sbfi_paper_sums *sums) {
  return mass / sums->point_count / (2 * TICK * TICK) * sums->edge_squares / (6 * sums->volume);
}

void sbfi_paper_to_si(const sbf_legacy *sliders, const sbfi_paper_sums *sums, sbf_attributes *to) {
  double mass = (double)sliders->mass;
  to->friction = sliders->friction;
  to->poisson_ratio =
      (float)(0.25 + 0.24 * fraction_of((double)sliders->volume_stiffness, sliders->solver_iterations));
  if (!(sums->volume > 0)) return;
  if (mass > 0)
    to->density = (float)(mass / sums->volume);
  else
    mass = (double)to->density * sums->volume;
  double fraction = fraction_of((double)sliders->stretching_stiffness, sliders->solver_iterations);
  double modulus = modulus_scale(mass, sums) * fraction / (1 - fraction);
  to->young_modulus = modulus > 1 ? (float)modulus : 1;
}

void sbfi_paper_from_si(const sbf_attributes *from, const sbf_collision *collision,
    const sbfi_paper_sums *sums, uint32_t iterations, sbf_legacy *sliders) {
  double mass = from->mass > 0 ? (double)from->mass : (double)from->density * sums->volume;
  sliders->mass = (float)mass;
  sliders->solver_iterations = iterations;
  sliders->friction = from->friction;
  sliders->particle_radius = collision->particle_radius;
  sliders->volume_stiffness = (float)slider_of(((double)from->poisson_ratio - 0.25) / 0.24, iterations);
  if (!(sums->volume > 0)) return;
  double ratio = (double)from->young_modulus / modulus_scale(mass, sums);
  sliders->stretching_stiffness = (float)slider_of(ratio / (1 + ratio), iterations);
}
