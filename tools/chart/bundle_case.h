/* What is charted of a character of a file: its own walk, a hop and a shake. */
#ifndef CHART_BUNDLE_CASE_H
#define CHART_BUNDLE_CASE_H

#include "chart/case.h"

enum { CHART_BUNDLE_CASES = 3 };

typedef struct chart_bundle {
  const sbf_asset *asset;
  double speed_m_s, hop_m;
  double ground_m;   /* the ground that it stands on rises and falls with a hop */
  sbr_ground ground; /* asks `ground_m` */
} chart_bundle;

/* Fills `cases` (CHART_BUNDLE_CASES) with walk, hop and shake of two seconds. `bundle` and the asset must
 * stay until they have been charted. SBF_BAD_INPUT where the asset has no soft body with a level. */
sbf_status chart_bundle_cases(
    const sbf_asset *asset, chart_bundle *bundle, chart_case *cases, sbf_diagnostic *error);

#endif
