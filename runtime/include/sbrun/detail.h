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
 * The same rules as in sbrun.h: handles that name nothing are ignored, getters then return zeros; nothing
 * allocates but sbr_world_detail. Rungs, and how far a change has come, are state, which snapshots hold;
 * views are the host's. Recordings hold both. */
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
  float error_m;      /* the greatest that its levels state; where one states none, 2 % of the body's size */
  float visits;       /* what a tick costs, in visits of elements, the gait's share included */
} sbr_rung;

/* Rungs of the model, finest first; returns how many there are, of which up to `capacity` are written. 1: it
 * was made without a ladder, or with a body that yields or tears, which keeps its level. Bodies that
 * nothing holds have no rungs below the soft ones. */
SBF_API uint32_t sbr_model_rungs(const sbr_model *model, sbr_rung *rungs, uint32_t capacity);

/* The rung that the character is on, or begins to go over to in the next tick; from 0. */
SBF_API uint32_t sbr_character_rung(const sbr_world *world, sbr_character_id character);
/* Puts it on a rung from the next tick on, beyond the last: the last; SBR_RUNG_CHOSEN: the world chooses
 * again. In a world whose bodies meet each other (sbrun/collision.h) characters stay on their rung. */
#define SBR_RUNG_CHOSEN 0xffffffffu
SBF_API void sbr_character_set_rung(sbr_world *world, sbr_character_id character, uint32_t rung);
/* How far the skin still is from going over: 1 where it shows what it was, 0 where it is over. */
SBF_API float sbr_character_fade(const sbr_world *world, sbr_character_id character);

#ifdef __cplusplus
}
#endif
#endif
