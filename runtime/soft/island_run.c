/* One control tick of an island: prepares pins, contacts and tables, runs the time integrator, then reports
 * contacts, splits torn points, recovers from failure and updates sleep. */
#include "base/assert.h"
#include "contact/contact.h"
#include "math/vec3.h"
#include "skin/skin.h"
#include "soft/soft.h"
#include "soft/solvers/external_forces.h"
#include "soft/solvers/rolling.h"
#include "soft/solvers/router.h"
#include "soft/solvers/soft_contacts.h"
#include "soft/tear/tear.h"

/* Minimum number of springs of an island whose tick is divided among tasks. */
enum { MIN_DIVIDED_SPRINGS = 20000 };

bool sbri_island_may_divide(const sbri_character *c, uint32_t index) {
  const sbri_island *island = &c->model->islands[index];
  const sbri_island_state *state = &sbri_island_states(c)[index];
  bool large = island->tetrahedra.parts || island->springs.count >= MIN_DIVIDED_SPRINGS;
  return large && !state->asleep && sbri_router_scheme(island, &state->recovery) == &sbri_symplectic;
}

void sbri_island_run(const sbr_world *world, sbri_character *c, uint32_t index, const sbr_tasks *tasks) {
  if (sbri_island_sleeps(world, c, index)) return;
  SBF_ASSERT(index < c->model->island_count && world->time.tick_s > 0 && c->time_scale > 0);
  const sbr_model *model = c->model;
  sbri_island now = sbri_island_now(c, &model->islands[index]);
  const sbri_island *island = &now;
  size_t first = island->first_slot;
  float tick_s = (float)world->time.tick_s * c->time_scale;
  if (!sbri_island_update_drivers(c, island, index, tick_s)) return;
  sbri_compute_pin_targets(island, sbri_deltas(c), sbri_targets(c) + first);
  sbri_island_fill_unused_slots(c, island);
  sbri_island_store_motions(c, index);
  sbri_island_tick tick = sbri_island_tick_of(world, c, index, island);
  tick.surfaces.external_rad_s = &now.stability.external_rad_s;
  tick.tasks = tasks;
  if (!island->scheme->forceless) sbri_update_gas_stiffness(&tick), sbri_island_prepare_contacts(&tick, c);
  sbri_router_choose(&tick, &sbri_island_states(c)[index].recovery)->tick(&tick);
  sbri_island_report_contacts(&tick, c);
  if (island->splits && tick.tears->count > 0) tick.tears->unsplit = sbri_island_split(c, index);
  (void)sbri_island_recover(world, c, index, NULL);
  sbri_island_update_sleep(world, c, index);
}
