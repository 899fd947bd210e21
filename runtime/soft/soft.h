/* Soft bodies of one character through a tick: put somewhere, led by what holds them, stepped, mended,
 * asleep. */
#ifndef SBRI_SOFT_H
#define SBRI_SOFT_H

#include "pose/frames.h"

/* ---- soft/placing.c ---- */

/* Everything in its rest shape at the present pose, all speeds zero. */
void sbri_place_at_rest(sbri_character *c);
/* All elements whole again, with the rest shapes they were made with. */
void sbri_mend(sbri_character *c);
/* Rest shapes of one island's elements as they were made; torn ones stay torn. */
void sbri_island_unflow(sbri_character *c, uint32_t island);
/* The same for one island, with the present `deltas`. */
void sbri_island_place_at_rest(sbri_character *c, uint32_t island);
/* The same, but bodies that nothing holds stay where they are: the middle of each where it was, or above the
 * ground if that reaches higher, turned as it was. */
void sbri_island_place_where_it_is(sbri_character *c, uint32_t island, const sbr_ground *ground);
/* An island goes where its frames have gone from `previous_deltas` to `deltas`, keeping its shape, and stops.
 */
void sbri_island_carry(sbri_character *c, uint32_t island);
/* The tick before becomes the same as this one. */
void sbri_settle(sbri_character *c);

/* ---- soft/guiding.c ---- */

/* Finds `guide_velocities` over the tick, whose length `tick_s` is in the character's own seconds, and gives
 * the island's bodies what they need not feel of it. False where what holds them has jumped: then they have
 * been carried along, as fast as it goes, and the tick is over for them. */
bool sbri_island_follow(sbri_character *c, const sbri_island *island, uint32_t index, float tick_s);
/* The velocities alone, over any part of a tick. False where what holds the bodies has jumped. */
bool sbri_guide_velocities_find(sbri_character *c, const sbri_island *island, float tick_s);
/* The island goes on as what holds it went from `previous_deltas` to `deltas`. */
void sbri_guides_go_on(sbri_character *c, const sbri_island *island, float tick_s);

/* ---- soft/whole_motion.c ---- */

/* What the body moves by as a rigid one becomes what it moved by as the character was on another rung: its
 * momentum is the same, and it turns as fast. */
void sbri_body_go_on(sbri_character *c, const sbri_character *was, uint32_t soft_body);

/* How its free points move as one rigid body, in the character's own units. */
sbr_soft_motion sbri_body_motion(const sbri_character *c, const sbri_body *body);

/* ---- soft/host_loads.c ---- */

/* Whether it is simulated, by a scheme that knows forces, and some of it is free. */
bool sbri_body_feels_forces(const sbri_character *c, const sbri_body *body);

/* The points that carry a vertex of the body's surface; false where none do: it follows bones alone. */
bool sbri_vertex_carriers(const sbri_character *c, const sbri_body *body, uint32_t vertex, sbri_carriers *to);
/* Of its free points, in the character's own units. */
float sbri_body_mass(const sbri_character *c, const sbri_body *body);
bool sbri_any_loads(const sbri_character *c);
bool sbri_island_is_loaded(const sbri_character *c, uint32_t island);
/* When a tick begins: what acts in it. */
void sbri_loads_begin(const sbr_world *world, sbri_character *c);

/* ---- soft/island_tick.c ---- */

/* Planes of the ground near the island's points, into the character's scratch, as of now. */
void sbri_island_contacts(const sbr_world *world, sbri_character *c, uint32_t island);

/* What such a tick is put together from; `island` as sbri_island_now has it. */
sbri_island_tick sbri_island_tick_of(
    const sbr_world *world, sbri_character *c, uint32_t index, const sbri_island *island);
/* Inert lanes lie where their block's first point does, room for points that split where the body's does. */
void sbri_island_tuck(sbri_character *c, const sbri_island *island);
void sbri_island_prepare_contacts(const sbri_island_tick *tick, sbri_character *c);
/* Notes for events what its bodies touch, after a tick of it. */
void sbri_island_tell(const sbri_island_tick *tick, sbri_character *c);

/* ---- soft/health.c ---- */

/* A spring of the island as it is now: yielded, or without stiffness where it is torn. */
sbfi_spring sbri_spring_now(const sbri_character *c, const sbri_island *island, uint32_t spring);

/* Volume within a body's surface as `points` of its character lie; uses scratch of the body's own island, so
 * that tasks may call it side by side. */
double sbri_surface_volume(const sbri_character *c, const sbri_body *body, const sbri_point *points);
/* Volume of a body's tetrahedra against rest, where they neither yield nor tear. */
double sbri_lattice_share(const sbri_character *c, const sbri_body *body);

/* One region of shape matching: adds its energy; the greatest way of a point from its place, as a share of
 * the region's size. */
double sbri_region_look(const sbri_region_block *block, const sbri_region_member *members, uint32_t lane,
    const sbri_point *positions, double *energy_j);
/* As sbr_character_health has it. */
sbr_body_health sbri_body_health(const sbr_world *world, const sbri_character *c, uint32_t soft_body);

/* ---- soft/pin_forces.c ---- */

/* Forces of the island's elements on its held slots, as of the last tick, into `element_forces` of its
 * character: N in its own units. */
void sbri_pin_forces_find(const sbr_world *world, sbri_character *c, uint32_t island);

/* ---- soft/folded.c ---- */

/* An element with less than this share of its volume is crushed. */
#define SBRI_CRUSHED_RATIO 0.2f

/* How an island looks as it now is. */
typedef struct sbri_shape {
  bool folded;    /* it has lost its shape, and will not find it again by itself should that last */
  bool heaped;    /* so strained that it was thrown about or put so */
  bool unstable;  /* the same, or not yet back from there */
  float excess_j; /* what it holds beyond its rest shape; 0: not looked at */
  bool told;      /* all that loads it is known, so that no load is what strains it */
  bool crushed;   /* an element is, of a body of which all loads are known */
} sbri_shape;
sbri_shape sbri_shape_of(const sbr_world *world, const sbri_character *c, uint32_t island);

/* ---- soft/recovery.c ---- */

/* Of many masses: kg, kg m, kg m/s and kg m^2/s, about the origin. */
typedef struct sbri_whole_momentum {
  double mass, first[3], linear[3], angular[3];
} sbri_whole_momentum;
void sbri_momentum_add(sbri_whole_momentum *to, double mass, sbf_vec3 at, sbf_vec3 velocity);
/* Of the island's free points. */
sbri_whole_momentum sbri_island_momentum(const sbri_character *c, uint32_t island);

/* Of its speed against what holds it, or against its own rigid motion, a calmed body keeps this in a tick. */
#define SBRI_CALM_KEPT 0.7f
/* Before a tick: keeps how the island's loose bodies move, unless it is in trouble. */
void sbri_island_keep_motions(sbri_character *c, uint32_t island);
/* After a tick: calms what is wild, and puts into its rest shape what has lost its numbers or its shape for
 * good; whether it has done that. Loose bodies keep their momentum, or, where they have gained more than
 * weight gives, that which they had when they were last sound. What is put back three times in a row moves as
 * a rigid body for a second or more. `lost`: NULL, or the caller steps what holds it as well: calms, in the
 * next tick, what moves against that, and gives it what rest shapes have not of the momentum before, which is
 * put there; its mass is 0 where that was lost with its numbers. */
bool sbri_island_recover(
    const sbr_world *world, sbri_character *c, uint32_t island, sbri_whole_momentum *lost);

/* ---- soft/sleep.c ---- */

/* Whether the island sleeps through this tick, whose frames are known; it wakes where it does not. */
bool sbri_island_sleeps(const sbr_world *world, sbri_character *c, uint32_t island);
/* After a tick of it; and the parts of that: whether it is slow enough, and that it sleeps from now on. */
void sbri_island_may_sleep(const sbr_world *world, sbri_character *c, uint32_t island);
bool sbri_island_is_quiet(const sbri_character *c, uint32_t island);
void sbri_island_put_to_sleep(const sbr_world *world, sbri_character *c, uint32_t island);

/* ---- soft/island_run.c ---- */

/* One control tick of an island by itself. */
void sbri_island_run(const sbr_world *world, sbri_character *c, uint32_t island);

#endif
