/* Parts of a body that are too thin for its lattice. */
#ifndef SBFI_LATTICE_THIN_H
#define SBFI_LATTICE_THIN_H

#include "base/memory.h"
#include "sbfmt/model.h"

typedef struct sbfi_thinness {
  uint32_t sample_count; /* number of tested surface points: at most 2000, evenly over the list */
  uint32_t thin_count;   /* of these, the number with a thickness below `limit` */
  double min;            /* m; infinite if nothing was measured */
} sbfi_thinness;

/* Measures the thickness at points of the surface along their inward normals. Returns false if memory runs
 * out. */
bool sbfi_lattice_thinness(
    sbfi_thinness *thinness, const sbf_polygon_mesh *mesh, double limit, sbfi_arena *scratch);

#endif
