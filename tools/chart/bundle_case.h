/* Cases of a character from a file: its own walk, a hop and a shake. */
#ifndef CHART_BUNDLE_CASE_H
#define CHART_BUNDLE_CASE_H

#include "chart/case.h"

enum { CHART_BUNDLE_CASES = 3 };

/* Strength of the motion. A character of more than 2 m gets hops and turns that are slower by the square
 * root of its size over that, as larger animals move (dynamic similarity: Alexander and Jayes, A dynamic
 * similarity hypothesis for the gaits of quadrupedal mammals, Journal of Zoology 201, 1983). */
typedef struct chart_drive {
  double speed;           /* of the walk, in its own heights per second */
  float curve_rad_s;      /* to the left during the walk */
  double hop;             /* rise of the ground in heights */
  uint32_t hop_ticks[2];  /* from one hop to the next, alternating; for 2 m */
  float turn_rad_s;       /* of the shake; for 2 m */
  uint32_t turn_ticks[2]; /* to one side, alternating; for 2 m */
} chart_drive;

extern const chart_drive chart_usual_drive; /* as in the cases' titles */

typedef struct chart_bundle {
  const sbf_asset *asset;
  chart_drive drive;
  double speed_m_s, hop_m;
  double ground_m;   /* height of the ground, which rises and falls with a hop */
  sbr_ground ground; /* returns `ground_m` */
  char titles[CHART_BUNDLE_CASES][144];
} chart_bundle;

/* Fills `cases` (CHART_BUNDLE_CASES) with walk, hop and shake of two seconds; `drive` NULL: the usual one.
 * `bundle` and the asset must outlive their use. SBF_BAD_INPUT if the asset has no soft body with a level. */
sbf_status chart_bundle_cases(const sbf_asset *asset, const chart_drive *drive, chart_bundle *bundle,
    chart_case *cases, sbf_diagnostic *error);

#endif
