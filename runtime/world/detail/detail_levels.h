/* Levels of detail of characters: changes, transitions, jiggles, offscreen characters, and selection. */
#ifndef SBRI_DETAIL_LEVELS_H
#define SBRI_DETAIL_LEVELS_H

#include "state/world.h"

/* The character's present detail level. */
static inline const sbr_detail_level *sbri_get_detail_level(const sbri_character *c) {
  return &c->model->detail.base->detail.definitions[sbri_header(c)->detail_level];
}
static inline bool sbri_is_away(const sbri_character *c) {
  return sbri_get_detail_level(c)->kind == SBR_DETAIL_OFFSCREEN;
}

/* The coarsest level with body contacts, for a character that needs them. */
static inline uint32_t sbri_coarsest_colliding_level(const sbr_model *base) {
  uint32_t last = 0;
  while (last + 1 < base->detail.level_count && base->detail.definitions[last + 1].kind == SBR_DETAIL_SOFT)
    last++;
  return last;
}

static inline uint32_t sbri_ticks_of(const sbr_world *world, float seconds) {
  float ticks = seconds / (float)world->time.tick_s;
  return !(ticks > 0) ? 0 : ticks < 1e9f ? (uint32_t)ticks : 1000000000u;
}

/* ---- world/detail/detail_level_change.c ---- */

/* The `next_detail_level`, adapted to a character that lies on the ground or needs body contacts. */
const sbr_model *sbri_next_detail_model(const sbri_character *c);
/* Call at the beginning of a tick, before anything else: changes to `next_detail_level` if it differs and its
 * storage exists. */
void sbri_detail_level_change(const sbr_world *world, sbri_character *c);

/* ---- world/detail/fade.c ---- */

/* Three steps of a change: a tick before it; right before it; and after it, with the skin at its old
 * position. The second one returns the maximum visible amplitude, asset metres. */
void sbri_fade_record(sbri_character *c);
float sbri_fade_measure(const sbr_world *world, sbri_character *c);
void sbri_fade_begin(const sbr_world *world, sbri_character *c);
/* Ends the transition at once. */
void sbri_fade_end(sbri_character *c);
/* One tick of the transition. */
void sbri_fade_tick(const sbr_world *world, sbri_character *c);
/* Adds the remaining difference, at a fraction of the tick, to vertices of a render mesh's skin, asset
 * metres. */
void sbri_fade_apply(const sbri_character *c, uint32_t render_mesh, uint32_t render_level,
    const sbri_skin *skin, float fraction, sbri_point *vertices);

/* ---- world/detail/jiggle.c ---- */

/* Targets of the followers from the pose's bones, without oscillation. */
void sbri_jiggles_reset(sbri_character *c);
/* One tick of the jiggles, in the character's own seconds, after its bones have moved. */
void sbri_jiggles_tick(sbri_character *c, float tick_s);
/* Moves the origin by `shift`, in asset metres. */
void sbri_jiggles_rebase(sbri_character *c, sbf_vec3 shift);

/* ---- world/detail/away.c ---- */

/* One tick of an offscreen character. */
void sbri_away_tick(const sbr_world *world, sbri_character *c);
/* Brings an offscreen character back: it stands on its feet at its present position. */
void sbri_away_arrive(const sbr_world *world, sbri_character *c);

#endif
