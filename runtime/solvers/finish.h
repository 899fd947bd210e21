/* What every scheme that follows the energy does at the end of a substep, once all points are where it puts
 * them: volumes kept, springs held within their strain limits, then yield and tear, tetrahedra that are
 * being crushed, and the deformation of what slides damped.
 *
 * Written for the lanes of the file that includes it; see model/kernels.h. */
#ifndef SBRI_FINISH_H
#define SBRI_FINISH_H

#include "solvers/crush.h"
#include "solvers/flow.h"
#include "solvers/slide_damping.h"
#include "solvers/solid_limits.h"
#include "solvers/strain_limit.h"
#include "solvers/touches.h"
#include "solvers/volume_keep.h"

/* What is crushed strikes the ground: it is not to be moved into it. Each of the two undoes a little of the
 * other, so they take turns. */
static inline void sbri_uncrush_above_ground(const sbri_island_tick *t, float h) {
  bool remembered = false;
  for (int sweep = 0; sweep < SBRI_CRUSH_SWEEPS && sbri_uncrush_sweep(t, &remembered); sweep++)
    for (uint32_t b = 0; b < t->island->body_count; b++) {
      const sbri_body *body = &t->model->bodies[t->island->bodies[b]];
      const sbri_contact_rule rule = sbri_contact_rule_of(body, h);
      sbri_touches_bound(t, body, &rule);
    }
}

static inline void sbri_finish_substep(const sbri_island_tick *t, float h) {
  for (uint32_t b = 0; b < t->island->body_count; b++)
    if (t->model->bodies[t->island->bodies[b]].keeps_volume)
      sbri_volume_keep(t, &t->model->bodies[t->island->bodies[b]], h);
  if (t->island->link_limits) sbri_limit_strains(t);
  if (t->rests) sbri_flow(t, h);
  if (t->island->solid_limits) sbri_limit_solids(t, h);
  if (sbri_is_crushed(t)) sbri_uncrush_above_ground(t, h);
  for (uint32_t b = 0; b < t->island->body_count; b++) {
    const sbri_body *body = &t->model->bodies[t->island->bodies[b]];
    const sbri_contact_rule rule = sbri_contact_rule_of(body, h);
    if (sbri_may_touch(t, body)) sbri_slide_damp(t, body, &rule);
    sbri_touches_go_on(t, body, h);
  }
}

#endif
