/* Levels of detail of characters: changing detail levels, what fades between them, jiggles, being away;
 * choosing. */
#ifndef SBRI_DETAIL_LEVELS_H
#define SBRI_DETAIL_LEVELS_H

#include "world/world.h"

/* What the character is on its detail level. */
static inline const sbr_detail_level *sbri_get_detail_level(const sbri_character *c) {
  return &c->model->base->detail_levels[sbri_header(c)->detail_level];
}
static inline bool sbri_is_away(const sbri_character *c) {
  return sbri_get_detail_level(c)->kind == SBR_DETAIL_OFFSCREEN;
}

/* The coarsest level with body contacts, for a character that needs them. */
static inline uint32_t sbri_coarsest_colliding_level(const sbr_model *base) {
  uint32_t last = 0;
  while (last + 1 < base->detail_level_count && base->detail_levels[last + 1].kind == SBR_DETAIL_SOFT) last++;
  return last;
}

static inline uint32_t sbri_ticks_of(const sbr_world *world, float seconds) {
  float ticks = seconds / (float)world->tick_s;
  return !(ticks > 0) ? 0 : ticks < 1e9f ? (uint32_t)ticks : 1000000000u;
}

/* ---- detail/detail_level_change.c ---- */

/* The `next_detail_level` of a character that lies on the ground or needs body contacts. */
const sbr_model *sbri_next_detail_model(const sbri_character *c);
/* At the beginning of a tick, before anything of it: goes over to `next_detail_level`, if that is another and
 * there is room for it. */
void sbri_detail_level_change(const sbr_world *world, sbri_character *c);

/* ---- detail/fade.c ---- */

/* The three moments of a change: a tick before it; right before it; and after it, when the skin is where it
 * was. The second returns the greatest visible amplitude, asset metres. */
void sbri_fade_record(sbri_character *c);
float sbri_fade_keep(const sbr_world *world, sbri_character *c);
void sbri_fade_begin(const sbr_world *world, sbri_character *c);
/* No vertex is off its place any more. */
void sbri_fade_end(sbri_character *c);
/* A tick of it. */
void sbri_fade_tick(const sbr_world *world, sbri_character *c);
/* Adds the remaining difference, at a fraction of the tick, to vertices of a render mesh's skin, asset
 * metres. */
void sbri_fade_apply(const sbri_character *c, uint32_t render_mesh, uint32_t render_level,
    const sbri_skin *skin, float fraction, sbri_point *vertices);

/* ---- detail/jiggle.c ---- */

/* Where the followers of the pose's bones are to be, without swinging. */
void sbri_jiggles_reset(sbri_character *c);
/* A tick of the jiggles, of so many of the character's own seconds, after its bones have moved. */
void sbri_jiggles_tick(sbri_character *c, float tick_s);
/* The origin moved by `shift`, in asset metres. */
void sbri_jiggles_rebase(sbri_character *c, sbf_vec3 shift);

/* ---- detail/away.c ---- */

/* A tick of one that is away. */
void sbri_away_tick(const sbr_world *world, sbri_character *c);
/* Brings an offscreen character back: it stands on its feet at its present position. */
void sbri_away_arrive(const sbr_world *world, sbri_character *c);

#endif
