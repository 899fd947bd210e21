/* Reference of a body's motion. */
#ifndef CHART_REFERENCE_H
#define CHART_REFERENCE_H

#include "chart/case.h"
#include "chart/sheet.h"

/* Tracks of one motion by two schemes, so that each row is compared with another scheme than its own. */
typedef struct chart_truth {
  chart_track track;       /* for all rows except Heun's method, if both tracks are from the runtime */
  chart_track other;       /* for those; empty if the reference is in double precision */
  chart_reference *stated; /* information for the sheet */
} chart_truth;

/* Springs and tetrahedra: in double precision, by the Runge-Kutta method with 2 n steps per tick; its
 * error is the distance from n steps over 15 (Richardson). Others: by the runtime's Heun and symplectic
 * schemes, with four times the maximum substeps of the sweep (at least 32) and twice what is stable; their
 * error is the distance between the two. If one of them breaks, or they differ by more than a thousandth
 * of the displacement, both get twice as many, up to the runtime's 1024, while that improves them. */
sbf_status chart_truth_find(chart_truth *truth, const chart_case *charted, const chart_scene *scene,
    const sbf_vec3 *rest, uint32_t max_substeps, chart_reference *stated, sbf_diagnostic *error);
/* For the reference mesh: symplectic, with twice the required substeps; its error is the distance from
 * half of them; refined in the same way. Excludes the error relative to a finer mesh. */
sbf_status chart_truth_find_mesh(chart_truth *truth, const chart_case *charted, const chart_scene *scene,
    const sbf_vec3 *rest, chart_reference *stated, sbf_diagnostic *error);
/* The same mesh once, with the required substeps; its own error is unknown: 0. */
sbf_status chart_truth_take_mesh(
    chart_truth *truth, const chart_scene *scene, chart_reference *stated, sbf_diagnostic *error);
void chart_truth_free(chart_truth *truth);

static inline const chart_track *chart_truth_for(const chart_truth *truth, sbf_scheme scheme) {
  return scheme == SBF_SCHEME_HEUN && truth->other.positions ? &truth->other : &truth->track;
}

#endif
