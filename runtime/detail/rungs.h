/* Levels of detail of characters: changing rungs, what fades between them, jiggles, being away; choosing. */
#ifndef SBRI_RUNGS_H
#define SBRI_RUNGS_H

#include "world/world.h"

/* What the character is on its rung. */
static inline const sbr_rung *sbri_rung_of(const sbri_character *c) {
  return &c->model->base->ladder[sbri_head(c)->rung];
}
static inline bool sbri_is_away(const sbri_character *c) {
  return sbri_rung_of(c)->kind == SBR_RUNG_AWAY;
}

/* The coarsest that can meet others, where it has to. */
static inline uint32_t sbri_last_that_meets(const sbr_model *base) {
  uint32_t last = 0;
  while (last + 1 < base->rung_count && base->ladder[last + 1].kind == SBR_RUNG_SOFT) last++;
  return last;
}

static inline uint32_t sbri_ticks_of(const sbr_world *world, float seconds) {
  float ticks = seconds / (float)world->tick_s;
  return !(ticks > 0) ? 0 : ticks < 1e9f ? (uint32_t)ticks : 1000000000u;
}

/* ---- detail/rung_change.c ---- */

/* What `next_rung` will be for one who lies about, or must meet others. */
const sbr_model *sbri_rung_ahead(const sbri_character *c);
/* At the beginning of a tick, before anything of it: goes over to `next_rung`, if that is another and there
 * is room for it. */
void sbri_rung_change(const sbr_world *world, sbri_character *c);

/* ---- detail/fade.c ---- */

/* Of a change of rungs: a tick before it; then right before it, and after it, when the skin is where it was.
 * The second returns how far what is seen swings at most, asset metres. */
void sbri_fade_look(sbri_character *c);
float sbri_fade_keep(const sbr_world *world, sbri_character *c);
void sbri_fade_begin(const sbr_world *world, sbri_character *c);
/* No vertex is off its place any more. */
void sbri_fade_end(sbri_character *c);
/* A tick of it. */
void sbri_fade_tick(const sbr_world *world, sbri_character *c);
/* What is left of it, at a share of the tick, on vertices of a skin of a render mesh, asset metres. */
void sbri_fade_apply(const sbri_character *c, uint32_t render_mesh, uint32_t render_level,
    const sbri_skin *skin, float share, sbri_point *vertices);

/* ---- detail/jiggle.c ---- */

/* Where the followers of the pose's bones are to be, without swinging. */
void sbri_jiggles_place(sbri_character *c);
/* A tick of them, of so many of the character's own seconds, once its bones are where they go. */
void sbri_jiggles_tick(sbri_character *c, float tick_s);
/* The origin moved by `shift`, in asset metres. */
void sbri_jiggles_rebase(sbri_character *c, sbf_vec3 shift);

/* ---- detail/away.c ---- */

/* A tick of one that is away. */
void sbri_away_tick(const sbr_world *world, sbri_character *c);
/* It comes back: it stands on its feet where it has come to. */
void sbri_away_arrive(const sbr_world *world, sbri_character *c);

#endif
