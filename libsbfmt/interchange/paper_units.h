/* Converts sliders of the 2012 dialect to SI: section 16 of the specification. */
#ifndef SBFI_PAPER_UNITS_H
#define SBFI_PAPER_UNITS_H

#include "sbfmt/model.h"

enum { SBFI_PAPER_ITERATIONS = 10 }; /* default number of solver iterations */

/* Quantities that the conversion of sliders depends on. */
typedef struct sbfi_paper_sums {
  uint32_t point_count;
  double volume;       /* m^3 */
  double edge_squares; /* m^2, sum of squared lengths of the distinct edges */
} sbfi_paper_sums;

/* False if memory runs out. */
bool sbfi_paper_measure(sbf_vec3_list positions, sbf_uint4_list tetrahedra, const sbf_allocator *allocator,
    sbfi_paper_sums *sums);

/* Sets density, young_modulus, poisson_ratio and friction from the sliders. Values that would be zero stay
 * unchanged (mass, volume) or become 1 Pa (modulus). */
void sbfi_paper_to_si(const sbf_legacy *sliders, const sbfi_paper_sums *sums, sbf_attributes *to);

/* The sliders at `iterations` closest to the attributes within their range. */
void sbfi_paper_from_si(const sbf_attributes *from, const sbf_collision *collision,
    const sbfi_paper_sums *sums, uint32_t iterations, sbf_legacy *sliders);

#endif
