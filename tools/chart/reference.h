/* What a body's motion is measured against. */
#ifndef CHART_REFERENCE_H
#define CHART_REFERENCE_H

#include "chart/case.h"
#include "chart/sheet.h"

/* Tracks of the same motion by two schemes, so that each row has one by another scheme than its own. */
typedef struct chart_truth {
  chart_track track;       /* for all but rows of Heun's method, where the runtime gave both */
  chart_track other;       /* for those; empty where the reference is in double precision */
  chart_reference *stated; /* what the sheet says of it */
} chart_truth;

/* Springs and tetrahedra: in double precision, by Runge and Kutta's method with 2 n steps a tick, its own
 * error by the distance from n, over 15 (Richardson). Everything else: by Heun's method and by the symplectic
 * scheme of the runtime, with four times the most substeps that are swept (32 at least) and twice what is
 * stable; their own error is the distance between the two. Where one of them breaks, or they are farther
 * apart than a thousandth of how far things move, both get twice as many, up to the runtime's 1024, for as
 * long as that brings them nearer. */
sbf_status chart_truth_find(chart_truth *truth, const chart_case *charted, const chart_scene *scene,
    const sbf_vec3 *rest, uint32_t max_substeps, chart_reference *stated, sbf_diagnostic *error);
/* Of a mesh that others are measured against: symplectic, twice as many substeps as it needs, its own
 * error by the distance from half of them; twice as many of both likewise. How far it is off a finer mesh is
 * not in that. */
sbf_status chart_truth_find_mesh(chart_truth *truth, const chart_case *charted, const chart_scene *scene,
    const sbf_vec3 *rest, chart_reference *stated, sbf_diagnostic *error);
/* The same mesh once, with as many substeps as it needs; what it is off itself is not known: 0. */
sbf_status chart_truth_take_mesh(
    chart_truth *truth, const chart_scene *scene, chart_reference *stated, sbf_diagnostic *error);
void chart_truth_free(chart_truth *truth);

static inline const chart_track *chart_truth_for(const chart_truth *truth, sbf_scheme scheme) {
  return scheme == SBF_SCHEME_HEUN && truth->other.positions ? &truth->other : &truth->track;
}

#endif
