/* Modelling no more than a scene needs: each character as finely as its distance and a budget ask for.
 *
 * A model made with sbr_model_options.ladder has several rungs, finest first: each level of the file's bodies
 * that is stepped; jiggle, one second-order follower a body (spec 10.4); bones alone, whose skin follows
 * them; and away, where the character is but a place that moves as it is driven, without feet or pose. A
 * character is on one rung at a time. Changing it carries shapes and velocities over, and the skin goes from
 * the one to the other over a while, so that nothing is seen to jump: docs/detail.md.
 *
 * A world with sbr_world_detail chooses the rungs itself, at the beginning of each tick, by the views that it
 * is told of: for each character the coarsest whose predicted error is small enough on the screen, and where
 * the budget does not last for that, coarser ones first where that costs the least to look at. The choice
 * depends on what it was told alone: the same on any number of threads and any machine. Without that call the
 * host chooses.
 *
 * Memory follows: a character holds what its rung needs (sbr_rung.bytes), of the world's allocator. A change
 * to another rung is asked for when a tick begins, before anything of it, one character after the other, in
 * the thread that steps; what the character has left is given back when it has not gone back there for a
 * second. So a step in which nobody goes over, comes near, or has done so a second ago asks the allocator for
 * nothing. Where memory runs out the character stays on its rung, SBR_EVENT_NO_MEMORY tells, and it is asked
 * for again every half second. Begin who is far off on a coarse rung (sbr_character_definition.rung).
 *
 * The same rules as in sbrun.h: handles that name nothing are ignored, getters then return zeros; besides,
 * nothing allocates but sbr_world_detail. Rungs, and how far a change has come, are state, which snapshots
 * hold; views are the host's. Recordings hold both. */
#ifndef SBRUN_DETAIL_H
#define SBRUN_DETAIL_H

#include "sbrun/sbrun.h"

#ifdef __cplusplus
extern "C" {
#endif

/* ---- Rungs -------------------------------------------------------------------------------------------- */

/* What a character is on a rung. */
typedef enum sbr_rung_kind {
  SBR_RUNG_SOFT,   /* a level of springs, tetrahedra or regions is stepped */
  SBR_RUNG_JIGGLE, /* each body is carried by its bone and shifted by a follower of its middle */
  SBR_RUNG_BONES,  /* gait and pose; what the bones carry goes along with them */
  SBR_RUNG_AWAY    /* the body's way over the ground; the pose goes along as it was, and no foot steps */
} sbr_rung_kind;

/* A rung of a model. */
typedef struct sbr_rung {
  sbr_rung_kind kind; /* what it is */
  uint32_t level;     /* of soft ones: of each body that has so many, else its coarsest */
  float error_m;      /* the greatest that its levels state, of motion where that was measured (simulation
                         .motion_error), else at rest; where one states none, 2 % of the body's size */
  float visits;       /* what a tick costs, in visits of elements, the gait's share included */
  size_t bytes;       /* that a character holds; what its surfaces meet others with comes on top */
} sbr_rung;

/* Rungs of the model, finest first; returns how many there are, of which up to `capacity` are written. 1: it
 * was made without a ladder, or with a body that yields or tears, which keeps its level. Bodies that
 * nothing holds have no rungs below the soft ones. */
SBF_API uint32_t sbr_model_rungs(const sbr_model *model, sbr_rung *rungs, uint32_t capacity);

/* The rung that the character is on, or is about to go over to; from 0. */
SBF_API uint32_t sbr_character_rung(const sbr_world *world, sbr_character_id character);
/* Puts it on a rung, beyond the last: the last. It goes over when the tick after the next begins: until then
 * it is looked at, so that it is known how it moves; at once where nobody sees it, or it is away.
 * SBR_RUNG_CHOSEN: the world chooses again.
 * In a world whose bodies meet each other (sbrun/collision.h) one that others are near, or will be within
 * half a second, is on no rung below the soft ones, whatever it is put on: it could not meet them. */
#define SBR_RUNG_CHOSEN 0xffffffffu
SBF_API void sbr_character_set_rung(sbr_world *world, sbr_character_id character, uint32_t rung);
/* How far the skin still is from going over: 1 where it shows what it was, 0 where it is over. */
SBF_API float sbr_character_fade(const sbr_world *world, sbr_character_id character);

/* ---- Choosing ----------------------------------------------------------------------------------------- */

/* How a world chooses rungs. */
typedef struct sbr_detail_definition {
  uint32_t cookie;    /* set by sbr_default_detail_definition */
  float error_px;     /* that a character may be off on the screen, or jump when it changes; default 0.5 */
  float budget_us;    /* of processor time a tick, for all characters together; 0 (default): none */
  float ns_per_visit; /* what a visit (sbr_rung.visits) takes on this machine; default 6 */
  float settle; /* a coarser rung is taken where its error is below this share of error_px; default 0.7 */
  float stay_s; /* and no sooner after the last change; default 0.5 */
  float away_after_s; /* unseen for so long, a character goes away; negative: never; default 1 */
} sbr_detail_definition;

/* What a definition begins as. */
SBF_API sbr_detail_definition sbr_default_detail_definition(void);
/* From now on the world chooses the rungs of characters that the host has put on none. A later call changes
 * how. Recordings do not hold this call: make it before they begin. SBF_FAILED where memory runs out or a
 * number is not in its range: error_px and ns_per_visit above 0, settle in (0, 1]. */
SBF_API sbf_status sbr_world_detail(
    sbr_world *world, const sbr_detail_definition *definition, sbf_diagnostic *error);

/* Where characters are looked at from. */
typedef struct sbr_view {
  sbr_double3 eye;   /* world */
  sbf_vec3 forward;  /* where it looks; of any length */
  float height_rad;  /* what it sees from its lower to its upper edge; (0, 3] */
  float width_ratio; /* of its sides, width over height */
  float lines;       /* pixels from its lower to its upper edge */
} sbr_view;
/* The views of the frames to come, at most SBR_MOST_VIEWS; without any nobody is seen. Seen is what some view
 * may have within its edges, and what is on the screen largest there counts. */
#define SBR_MOST_VIEWS 4u
SBF_API void sbr_world_views(sbr_world *world, const sbr_view *views, uint32_t count);

/* What the host knows better than the views. */
typedef enum sbr_shown {
  SBR_SHOWN_BY_VIEWS, /* as they tell */
  SBR_SHOWN_ALWAYS,   /* seen even outside of them, as in a mirror, by its distance */
  SBR_SHOWN_NEVER     /* hidden, as behind a wall */
} sbr_shown;
SBF_API void sbr_character_shown(sbr_world *world, sbr_character_id character, sbr_shown shown);

/* By how many pixels the character is taken to be off now, at its worst place: its rung's error, more where
 * it is fast, in the view that shows it largest. 0: it is not seen. */
SBF_API float sbr_character_error_px(const sbr_world *world, sbr_character_id character);
/* What all characters together were taken to cost in the last tick, visits. */
SBF_API double sbr_world_visits(const sbr_world *world);

#ifdef __cplusplus
}
#endif
#endif
