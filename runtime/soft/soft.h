/* Soft bodies of one character: reset, drivers, tick, recovery and sleep. */
#ifndef SBRI_SOFT_H
#define SBRI_SOFT_H

#include "state/pose/frames.h"

/* ---- soft/rest_reset.c ---- */

/* Resets all soft bodies to their rest shape at the present pose, with zero velocities. */
void sbri_character_reset_to_rest(sbri_character *c);
/* Restores torn and yielded elements. */
void sbri_restore_elements(sbri_character *c);
/* Restores the rest shapes of an island's yielded elements; torn ones stay torn. */
void sbri_island_reset_flow(sbri_character *c, uint32_t island);
/* Resets one island to its rest shape with the present `deltas`. */
void sbri_island_reset_to_rest(sbri_character *c, uint32_t island);
/* The same, but bodies without pins keep their centre, or are raised above the ground, and their orientation.
 */
void sbri_island_reset_in_place(sbri_character *c, uint32_t island, const sbr_ground *ground);
/* Moves an island with its frames from `previous_deltas` to `deltas`, keeps its shape and sets its velocities
 * to zero. */
void sbri_island_move_with_frames(sbri_character *c, uint32_t island);
/* Copies the present state to the previous one, so that interpolation stands still. */
void sbri_character_stop(sbri_character *c);

/* ---- soft/driver_motion.c ---- */

/* Computes `driver_velocities` over the tick of `tick_s` character seconds and adds the excess of their
 * acceleration to the bodies. Returns false if the drivers have jumped: then it moves the bodies along, and
 * their tick is done. */
bool sbri_island_update_drivers(sbri_character *c, const sbri_island *island, uint32_t index, float tick_s);
/* Computes only the velocities, over any part of a tick. False if the drivers have jumped. */
bool sbri_driver_velocities_find(sbri_character *c, const sbri_island *island, float tick_s);
/* Gives the island the motion of its drivers from `previous_deltas` to `deltas`. */
void sbri_drivers_advance(sbri_character *c, const sbri_island *island, float tick_s);

/* ---- soft/whole_motion.c ---- */

/* Gives the body the momentum and angular velocity that it had at another detail level. */
void sbri_body_copy_momentum(sbri_character *c, const sbri_character *was, uint32_t soft_body);

/* Rigid motion of the body's free points, in the character's own units. */
sbr_soft_motion sbri_body_motion(const sbri_character *c, const sbri_body *body);

/* ---- soft/host_loads.c ---- */

/* Whether the body is simulated by a force-based integrator and has free points. */
bool sbri_body_accepts_forces(const sbri_character *c, const sbri_body *body);

/* Finds the points that a vertex of the surface is embedded in; false if it follows bones only. */
bool sbri_vertex_weights_find(
    const sbri_character *c, const sbri_body *body, uint32_t vertex, sbri_vertex_weights *to);
/* Mass of the free points, in the character's own units. */
float sbri_body_mass(const sbri_character *c, const sbri_body *body);
bool sbri_any_loads(const sbri_character *c);
bool sbri_island_is_loaded(const sbri_character *c, uint32_t island);
/* Collects the loads of the tick, at its beginning. */
void sbri_loads_begin(const sbr_world *world, sbri_character *c);

/* ---- soft/island_tick.c ---- */

/* Computes present ground planes near the island's points, into the character's scratch. */
void sbri_island_find_contacts(const sbr_world *world, sbri_character *c, uint32_t island);

/* Builds the input of the island's tick; `island` is from sbri_island_now. */
sbri_island_tick sbri_island_tick_of(
    const sbr_world *world, sbri_character *c, uint32_t index, const sbri_island *island);
/* Puts padding at the first point of its block and spare slots at the first point of the body. */
void sbri_island_fill_unused_slots(sbri_character *c, const sbri_island *island);
void sbri_island_prepare_contacts(const sbri_island_tick *tick, sbri_character *c);
/* Stores the contacts of its bodies for events, after its tick. */
void sbri_island_report_contacts(const sbri_island_tick *tick, sbri_character *c);

/* ---- soft/health.c ---- */

/* Present state of a spring: with its yielded length, without stiffness if torn. */
sbfi_spring sbri_spring_now(const sbri_character *c, const sbri_island *island, uint32_t spring);

/* Volume enclosed by a body's surface for `points` of its character. Uses scratch of the body's island, so
 * tasks may call it in parallel. */
double sbri_surface_volume(const sbri_character *c, const sbri_body *body, const sbri_point *points);
/* Volume of a body's tetrahedra relative to rest, without those that yield or tear. */
double sbri_lattice_fraction(const sbri_character *c, const sbri_body *body);

/* Adds the energy of a shape matching region; returns the maximum distance of a point from its goal, relative
 * to the region's size. */
double sbri_region_measure(const sbri_region_block *block, const sbri_region_member *members, uint32_t lane,
    const sbri_point *positions, double *energy_j);
/* Implements sbr_character_get_body_health for one body. */
sbr_body_health sbri_body_health(const sbr_world *world, const sbri_character *c, uint32_t soft_body);

/* ---- soft/pin_forces.c ---- */

/* Computes the forces of elements on pinned slots as of the last tick, N in character units, into
 * `element_forces`. */
void sbri_pin_forces_find(const sbr_world *world, sbri_character *c, uint32_t island);

/* ---- soft/collapsed.c ---- */

/* An element with a smaller volume ratio is crushed. */
#define SBRI_CRUSHED_RATIO 0.2f

/* Assessment of an island's present shape. */
typedef struct sbri_shape {
  bool collapsed;   /* will not regain its shape by itself */
  bool heaped;      /* strained by a throw or by an initial position */
  bool unstable;    /* heaped or not yet recovered from it */
  float excess_j;   /* elastic energy above the rest shape, J; 0: not measured */
  bool is_reported; /* all loads are known, so they do not explain the strain */
  bool crushed;     /* some element is crushed in a body with known loads */
  bool inside_out;  /* loads explain the strain, but have turned a whole body inside out */
} sbri_shape;
/* Whether loads explain the strain of an island, but have turned a whole body of it inside out. */
bool sbri_is_inside_out(const sbri_character *c, uint32_t island);
sbri_shape sbri_shape_of(const sbr_world *world, const sbri_character *c, uint32_t island);

/* ---- soft/recovery.c ---- */

/* Mass, first moment, momentum and angular momentum about the origin: kg, kg m, kg m/s, kg m^2/s. */
typedef struct sbri_whole_momentum {
  double mass, first[3], linear[3], angular[3];
} sbri_whole_momentum;
void sbri_momentum_add(sbri_whole_momentum *to, double mass, sbf_vec3 at, sbf_vec3 velocity);
/* Momentum of the island's free points. */
sbri_whole_momentum sbri_island_momentum(const sbri_character *c, uint32_t island);

/* Fraction of the velocity relative to drivers, or to the rigid motion, that is left per tick with extra
 * damping. */
#define SBRI_DAMPING_KEPT 0.7f
/* Before a tick: stores the rigid motion of bodies without pins, unless the island is failing. */
void sbri_island_store_motions(sbri_character *c, uint32_t island);
/* After a tick: damps unstable islands, and resets islands to their rest shape if their numbers are invalid
 * or they have collapsed. Returns whether it has reset the island. Loose bodies keep their momentum; if it is
 * more than gravity explains, they get that of their last stable state. A body that is reset three times in a
 * row moves as a rigid body for a second or more.
 *
 * `lost`: NULL, or the caller steps the rigid bodies of the pins too. It must then damp the motion relative
 * to them in the next tick, and restore the momentum that the reset removes, which is written to `lost`. Its
 * mass is 0 if the momentum was invalid. */
bool sbri_island_recover(
    const sbr_world *world, sbri_character *c, uint32_t island, sbri_whole_momentum *lost);

/* ---- soft/sleep.c ---- */

/* Whether the island sleeps through this tick, whose frames are known; wakes it otherwise. */
bool sbri_island_sleeps(const sbr_world *world, sbri_character *c, uint32_t island);
/* After its tick: puts the island to sleep when it has been slow for long enough. The next two functions are
 * its parts: the speed test, and falling asleep. */
void sbri_island_update_sleep(const sbr_world *world, sbri_character *c, uint32_t island);
bool sbri_island_is_idle(const sbri_character *c, uint32_t island);
void sbri_island_put_to_sleep(const sbr_world *world, sbri_character *c, uint32_t island);

/* ---- soft/island_run.c ---- */

/* Steps an island that is neither grouped nor coupled by one control tick. `tasks`: those that may divide its
 * work, or NULL; the result is the same. */
void sbri_island_run(const sbr_world *world, sbri_character *c, uint32_t island, const sbr_tasks *tasks);
/* Whether the island is large enough for that in this tick, and its integrator can. */
bool sbri_island_may_divide(const sbri_character *c, uint32_t island);

#endif
