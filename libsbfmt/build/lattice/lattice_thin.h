/* Where a body is too thin for its lattice. */
#ifndef SBFI_LATTICE_THIN_H
#define SBFI_LATTICE_THIN_H

#include "base/memory.h"
#include "sbfmt/model.h"

typedef struct sbfi_thinness {
  uint32_t sample_count; /* points of the surface looked at: 2000 at most, evenly over the list */
  uint32_t thin_count;   /* of them, those with less than `limit` of matter under them */
  double min;            /* m; infinite where nothing was measured */
} sbfi_thinness;

/* Measures the way from points of the surface along their normals to where it comes out again. False where
 * memory runs out. */
bool sbfi_lattice_thinness(
    sbfi_thinness *thinness, const sbf_polygon_mesh *mesh, double limit, sbfi_arena *scratch);

#endif
