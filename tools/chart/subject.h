/* Bodies whose motion has a closed form, made to chart schemes by. */
#ifndef CHART_SUBJECT_H
#define CHART_SUBJECT_H

#include "sbfmt/asset.h"

/* One asset with one soft body whose finest level is charted. */
typedef struct chart_subject {
  sbf_asset *asset;
  char model[32]; /* what its lines are called: the elastic model, and which of several */
  char line[32];  /* of a case of space: what stands for the scheme */
} chart_subject;

/* All without damping, along -y under a gravity of the caller's; NULL where memory runs out. */

/* One mass on a spring of 1 m that is held above. */
sbf_asset *chart_mass_on_spring(float mass_kg, float stiffness);

/* `count` masses between two held points, one below the other, each `length_m` from the next. */
sbf_asset *chart_pinned_chain(uint32_t count, float length_m, float mass_kg, float stiffness);

/* `count` masses below one held point, each `length_m` from the next, the last of `end_kg`. */
sbf_asset *chart_hung_chain(uint32_t count, float length_m, float mass_kg, float end_kg, float stiffness);

/* A mass level with what holds it, `length_m` away along x, on a spring. */
sbf_asset *chart_level_pendulum(float length_m, float mass_kg, float stiffness);

/* Springs, tetrahedra and regions of the finest level of a body, and of all. */
uint32_t chart_elements_of(const sbf_soft_body *body);
uint32_t chart_all_elements_of(const sbf_asset *asset);

#endif
