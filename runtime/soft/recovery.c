/* Bodies that have lost themselves.
 *
 * What is thrown into a heap holds far more energy than anything it meets in use, and swings through all its
 * shapes until that is gone: seconds, where little damps it. So its motion is taken out of it for a while.
 * Then it has either unfolded, or it rests in a knot, which is told and undone. */
#include <math.h>
#include <string.h>

#include "math/vec3.h"
#include "soft/soft.h"
#include "solvers/rigid_motion.h"
#include "solvers/router.h"

/* What has been folded for so many ticks will not come back by itself; what was calmed, and rests in what no
 * load explains, for so many. */
enum { FOLDED_TICKS = 24, CALMED_TICKS = 12, LOOK_EVERY = 4 };

/* What no load explains, and calming does not calm for so many, goes round in steps that are not stable. */
enum { WILD_TICKS = 36 };

/* For so long at most, where loads that nobody knows may be what strains a body: once each time that it gets
 * wild, so that what is meant to be as strained as that is left alone then. */
enum { CALM_TICKS = 30 };

/* Places beyond this many metres from the origin and speeds beyond as many metres a second are no motion any
 * more, though the numbers may be finite yet. */
static const float LOST_BEYOND = 1e6f;

static bool are_sound(const float *numbers, size_t count) {
  uint32_t lost = 0;
  for (size_t i = 0; i < count; i++) lost += !(fabsf(numbers[i]) < LOST_BEYOND);
  return lost == 0;
}

/* What holds a body feels nothing of it; so where that is simulated, whoever steps both does it. */
static void calm(sbri_character *c, uint32_t index, bool coupled) {
  const sbri_island now = sbri_island_now(c, &c->model->islands[index]), *island = &now;
  sbri_point *positions = sbri_positions(c) + island->first_slot;
  float *velocities = sbri_velocities(c) + 3 * (size_t)island->first_slot;
  const float *guides = sbri_guide_velocities(c) + 3 * (size_t)island->first_slot;
  for (uint32_t b = 0; b < island->body_count; b++) {
    const sbri_body *body = &c->model->bodies[island->bodies[b]];
    if (!body->held) sbri_rigid_motion_damp(island, body, positions, velocities, SBRI_CALM_KEPT, 0);
    for (uint32_t i = 3 * body->slot_begin; body->held && !coupled && i < 3 * body->slot_end; i++)
      velocities[i] = guides[i] + (velocities[i] - guides[i]) * SBRI_CALM_KEPT;
  }
}

static void put_back(sbri_character *c, uint32_t index) {
  const sbri_island *island = &c->model->islands[index];
  sbri_island_state *state = &sbri_island_states(c)[index];
  sbri_island_unflow(c, index);
  sbri_island_place_where_it_is(c, index, &c->ground);
  memcpy(sbri_previous_positions(c) + island->first_slot, sbri_positions(c) + island->first_slot,
      island->slot_count * sizeof(sbri_point));
  state->recoveries++;
  state->recovering = SBRI_RECOVERING_TICKS;
}

bool sbri_island_recover(
    const sbr_world *world, sbri_character *c, uint32_t index, sbri_whole_momentum *lost) {
  const sbri_island *island = &c->model->islands[index];
  sbri_island_state *state = &sbri_island_states(c)[index];
  if (!are_sound(&sbri_positions(c)[island->first_slot].x, 4 * (size_t)island->slot_count) ||
      !are_sound(sbri_velocities(c) + 3 * (size_t)island->first_slot, 3 * (size_t)island->free_count)) {
    if (lost) lost->mass = 0;
    put_back(c, index);
    return true;
  }
  if (state->calm_ticks > 0) {
    state->calm_ticks--;
    calm(c, index, lost != NULL);
  }
  if ((world->ticks + index) % LOOK_EVERY) return false;
  sbri_shape shape = sbri_shape_of(world, c, index);
  if (!shape.wild)
    state->calm_ticks = 0;
  else if ((shape.told || !state->wild) && !island->scheme->forceless)
    state->calm_ticks = CALM_TICKS;
  state->wild = shape.wild ? state->wild + LOOK_EVERY : 0;
  state->excess_j = shape.excess_j;
  state->folded_ticks = shape.folded ? state->folded_ticks + LOOK_EVERY : 0;
  if (shape.folded) state->recovering = SBRI_RECOVERING_TICKS;
  bool stays = state->folded_ticks >= (shape.wild && shape.told ? CALMED_TICKS : FOLDED_TICKS);
  if (!stays && !(shape.told && shape.heaped && state->wild >= WILD_TICKS)) return false;
  if (lost) *lost = sbri_island_momentum(c, index);
  put_back(c, index);
  return true;
}
