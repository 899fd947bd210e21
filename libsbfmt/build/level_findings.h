/* Findings about the levels of a body: stored, so that they are reported for bodies equal to it too. */
#ifndef SBFI_LEVEL_FINDINGS_H
#define SBFI_LEVEL_FINDINGS_H

#include "build/build_state.h"
#include "build/lattice/lattice_thin.h"
#include "build/levels/level_set.h"

typedef struct sbfi_level_findings {
  uint32_t missed_elements; /* number of tetrahedra, if none was within the requested error; 0: success */
  double cell;              /* m, of the finest lattice */
  sbfi_thinness thinness;
  bool can_rotate; /* it can rotate about its pinned points */
  sbfi_poor_level poor[SBFI_MAX_LEVELS];
  uint32_t poor_count;
} sbfi_level_findings;

void sbfi_level_findings_report(sbfi_build *build, uint32_t number, const sbfi_level_findings *findings);

/* Adds to the build's report for one more body the counts of an equal one since `before`. */
void sbfi_level_counts_repeat(
    sbf_build_report *report, const sbf_build_report *before, const sbf_build_report *after);

#endif
