#include "build/body_interior.h"

#include "sbfmt/mechanics.h"

/* Bodies without pins with springs only are so soft that their equations take hundreds of iterations each. */
enum { MAX_CALIBRATED_POINTS = 20000, MAX_CALIBRATED_FREE_POINTS = 1000 };

sbf_build_interior sbfi_body_interior(const sbf_build_options *options, const sbf_soft_body *body) {
  sbf_body_measures measures;
  sbf_body_measure(body, &measures);
  sbf_build_interior wanted = options->interior;
  if (wanted == SBF_BUILD_INTERIOR_AUTOMATIC && body->derived != SBF_NONE) return wanted;
  /* A section is attached to its bone by its centroid; a body without a bone is filled, or is a sheet. */
  if (wanted == SBF_BUILD_INTERIOR_AUTOMATIC)
    wanted = body->bone != SBF_NONE ? SBF_BUILD_INTERIOR_CENTROID
             : measures.sheet       ? SBF_BUILD_INTERIOR_NONE
                                    : SBF_BUILD_INTERIOR_TETRAHEDRA;
  if (wanted == SBF_BUILD_INTERIOR_CENTROID || wanted == SBF_BUILD_INTERIOR_BRUTE) return wanted;
  return measures.sheet ? SBF_BUILD_INTERIOR_NONE : wanted;
}

bool sbfi_body_is_calibrated(const sbf_soft_body *body, sbf_build_interior interior) {
  sbf_body_measures measures;
  if (interior == SBF_BUILD_INTERIOR_TETRAHEDRA) return true;
  bool is_free = body->bone == SBF_NONE && body->pins.count == 0 && body->attachments.count == 0;
  uint32_t max = is_free ? MAX_CALIBRATED_FREE_POINTS : MAX_CALIBRATED_POINTS;
  if (interior != SBF_BUILD_INTERIOR_CENTROID || body->surface.positions.count > max) return false;
  sbf_body_measure(body, &measures);
  return !measures.sheet && body->surface.polygon_sizes.count > 0;
}
