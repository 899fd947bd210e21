/* Test bodies for schemes whose motion has a closed form. */
#ifndef CHART_SUBJECT_H
#define CHART_SUBJECT_H

#include "sbfmt/asset.h"

/* One asset with one soft body whose finest level is measured. */
typedef struct chart_subject {
  sbf_asset *asset;
  char model[32]; /* label of its lines: the elastic model, and a number if there are several */
  char line[32];  /* for a case of space: replaces the scheme */
} chart_subject;

/* All without damping, along -y under the caller's gravity; NULL if memory runs out. */

/* One mass on a spring of 1 m that is pinned above. */
sbf_asset *chart_mass_on_spring(float mass_kg, float stiffness);

/* `count` masses in a vertical line between two pinned points, each `length_m` from the next. */
sbf_asset *chart_pinned_chain(uint32_t count, float length_m, float mass_kg, float stiffness);

/* `count` masses below one pinned point, each `length_m` from the next, the last of `end_kg`. */
sbf_asset *chart_hung_chain(uint32_t count, float length_m, float mass_kg, float end_kg, float stiffness);

/* A mass on a spring at the height of its pin, `length_m` away along x. */
sbf_asset *chart_level_pendulum(float length_m, float mass_kg, float stiffness);

/* Springs, tetrahedra and regions of the finest level of a body, and of all bodies. */
uint32_t chart_elements_of(const sbf_soft_body *body);
uint32_t chart_all_elements_of(const sbf_asset *asset);

#endif
