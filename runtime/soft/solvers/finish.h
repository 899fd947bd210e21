/* End of a substep, shared by all energy-based integrators: volume preservation, strain limits of springs,
 * yield and tear, strain limits of tetrahedra, compression limits, and damping of sliding contacts.
 *
 * Written for the lanes of the including file; see model/kernels.h. */
#ifndef SBRI_FINISH_H
#define SBRI_FINISH_H

#include "soft/solvers/compression_limit.h"
#include "soft/solvers/flow.h"
#include "soft/solvers/slide_damping.h"
#include "soft/solvers/soft_contacts.h"
#include "soft/solvers/solid_limits.h"
#include "soft/solvers/strain_limit.h"
#include "soft/solvers/volume_preservation.h"

/* Alternates compression limits and ground contacts, because each undoes a little of the other. */
static inline void sbri_limit_compression_above_ground(const sbri_island_tick *t, float h) {
  bool contacts_stored = false;
  for (int sweep = 0; sweep < SBRI_COMPRESSION_SWEEPS && sbri_limit_compression_sweep(t, &contacts_stored);
       sweep++)
    for (uint32_t b = 0; b < t->island->body_count; b++) {
      const sbri_body *body = &t->model->bodies[t->island->bodies[b]];
      const sbri_contact_rule rule = sbri_contact_rule_of(t, body, h);
      sbri_soft_contacts_bound(t, body, &rule);
    }
}

static inline void sbri_finish_substep(const sbri_island_tick *t, float h) {
  for (uint32_t b = 0; b < t->island->body_count; b++)
    if (t->model->bodies[t->island->bodies[b]].volume.is_preserved)
      sbri_volume_preserve(t, &t->model->bodies[t->island->bodies[b]], h);
  if (t->island->links.limits) sbri_limit_strains(t);
  if (t->springs.rests) sbri_yield_and_tear(t, h);
  if (t->island->tetrahedra.limits) sbri_limit_solids(t, h);
  if (sbri_is_compressed(t)) sbri_limit_compression_above_ground(t, h);
  for (uint32_t b = 0; b < t->island->body_count; b++) {
    const sbri_body *body = &t->model->bodies[t->island->bodies[b]];
    const sbri_contact_rule rule = sbri_contact_rule_of(t, body, h);
    if (sbri_may_collide(t, body)) sbri_slide_damp(t, body, &rule);
    sbri_soft_contacts_advance(t, body, h);
  }
}

#endif
