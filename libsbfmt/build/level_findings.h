/* What a build reports of the levels made for a body: kept, so that it is reported of bodies equal to it too.
 */
#ifndef SBFI_LEVEL_FINDINGS_H
#define SBFI_LEVEL_FINDINGS_H

#include "build/build_state.h"
#include "build/lattice/lattice_thin.h"
#include "build/levels/level_set.h"

typedef struct sbfi_level_findings {
  uint32_t missed_elements; /* tetrahedra it got as none came within the error asked for; 0: one did */
  double cell;              /* m, of the finest lattice */
  sbfi_thinness thinness;
  bool turns; /* about the points that hold it */
  sbfi_poor_level poor[SBFI_MAX_LEVELS];
  uint32_t poor_count;
} sbfi_level_findings;

void sbfi_level_findings_report(sbfi_build *build, uint32_t number, const sbfi_level_findings *findings);

/* Counts in the build's report for one more body what it gained for an equal one since it was `before`. */
void sbfi_level_counts_repeat(
    sbf_build_report *report, const sbf_build_report *before, const sbf_build_report *after);

#endif
