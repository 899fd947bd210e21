/* Sliders of the 2012 dialect and what they mean in SI: section 16 of the specification. */
#ifndef SBFI_PAPER_UNITS_H
#define SBFI_PAPER_UNITS_H

#include "sbfmt/model.h"

enum { SBFI_PAPER_ITERATIONS = 10 }; /* solver iterations where nobody says how many */

/* What the meaning of the sliders depends on. */
typedef struct sbfi_paper_sums {
  uint32_t point_count;
  double volume;       /* m^3 */
  double edge_squares; /* m^2: sum over the distinct edges of their squared lengths */
} sbfi_paper_sums;

/* False where memory runs out. */
bool sbfi_paper_measure(sbf_vec3_list positions, sbf_uint4_list tetrahedra, const sbf_allocator *allocator,
    sbfi_paper_sums *sums);

/* Sets density, young_modulus, poisson_ratio and friction from the sliders. What the sliders make zero stays
 * as it is (mass, volume), or becomes 1 Pa (modulus). */
void sbfi_paper_to_si(const sbf_legacy *sliders, const sbfi_paper_sums *sums, sbf_attributes *to);

/* The sliders at `iterations` that would give what the attributes say, as near as their range allows. */
void sbfi_paper_from_si(const sbf_attributes *from, const sbf_collision *collision,
    const sbfi_paper_sums *sums, uint32_t iterations, sbf_legacy *sliders);

#endif
