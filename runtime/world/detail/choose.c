/* Selection of detail levels: for each character the coarsest level with an acceptable error on the screen,
 * then coarser ones until the budget suffices. A change to a finer level is immediate; one to a coarser level
 * waits until the error is well below the bound, and for a while. Runs on one thread, in the order of the
 * characters. */
#include "world/detail/choose.h"

/* The coarsest level with a pose; for a character that may touch others, the coarsest with bodies. */
static uint32_t last_posed(const sbri_character *c) {
  const sbr_model *base = c->model->detail.base;
  uint32_t last = base->detail.level_count - 1;
  if (c->near) return sbri_coarsest_colliding_level(base);
  return base->detail.definitions[last].kind == SBR_DETAIL_OFFSCREEN ? last - 1 : last;
}

static uint32_t detail_level_for(const sbr_world *world, const sbri_character *c, float pixels) {
  const sbri_detail *detail = world->detail;
  const sbri_character_state *head = sbri_header(c);
  const sbr_model *base = c->model->detail.base;
  uint32_t last = last_posed(c), now = head->next_detail_level < last ? head->next_detail_level : last,
           found = 0;
  if (!(pixels > 0)) {
    float after = detail->is.offscreen_after_s;
    return !c->near && after >= 0 && head->unseen_ticks >= sbri_ticks_of(world, after)
               ? base->detail.level_count - 1
               : last;
  }
  bool may_coarsen = head->detail_level_ticks >= sbri_ticks_of(world, detail->is.stay_s);
  for (uint32_t r = 1; r <= last; r++) {
    float error = pixels * base->detail.definitions[r].error_m;
    float max = r > now ? detail->is.coarsen_fraction * detail->is.error_px : detail->is.error_px;
    if (error <= max && (r <= now || may_coarsen)) found = r;
  }
  return found;
}

/* Returns false if the character needs no choice. */
static bool choose_for(const sbr_world *world, uint32_t index, sbri_choice *choice, double *visits) {
  sbri_character *c = &world->characters[index];
  if (!c->model || sbri_header(c)->paused) return false;
  sbri_character_state *head = sbri_header(c);
  const sbr_model *base = c->model->detail.base;
  float pixels = sbri_pixels_of(world, c);
  if (pixels > 0 && head->unseen_ticks > 0)
    head->detail_level_ticks = UINT32_MAX; /* as if new: it was not visible */
  head->unseen_ticks = pixels > 0 ? 0 : head->unseen_ticks < UINT32_MAX ? head->unseen_ticks + 1 : UINT32_MAX;
  double now = head->asleep ? 0 : base->detail.definitions[head->detail_level].visits;
  if (base->detail.level_count == 1 || head->set_detail_level_plus_1) {
    *visits += now;
    return false;
  }
  pixels *= sbri_speed_factor(c) * c->scale;
  uint32_t detail_level = detail_level_for(world, c, pixels);
  if (head->asleep && detail_level >= head->detail_level) return false; /* it costs nothing already */
  *choice = (sbri_choice){index, detail_level, last_posed(c), pixels};
  if (detail_level > choice->last) choice->last = detail_level;
  *visits += base->detail.definitions[detail_level].visits;
  return true;
}

void sbri_detail_choose(sbr_world *world) {
  sbri_detail *detail = world->detail;
  double visits = 0, max = 1e3 * (double)detail->is.budget_us / (double)detail->is.ns_per_visit;
  detail->choice_count = 0;
  for (uint32_t i = 0; i < world->character_capacity; i++)
    if (choose_for(world, i, &detail->choices[detail->choice_count], &visits)) detail->choice_count++;
  bool is_short = max > 0 && visits > max;
  detail->is_short = is_short;
  if (is_short) visits = sbri_budget_fit(world, visits, max);
  for (uint32_t i = 0; i < detail->choice_count; i++) {
    sbri_character *c = &world->characters[detail->choices[i].character];
    sbri_character_state *head = sbri_header(c);
    const sbr_detail_level *detail_levels = c->model->detail.base->detail.definitions;
    uint32_t detail_level = detail->choices[i].detail_level;
    /* If the budget is short, two characters would alternate. */
    if (is_short && detail_level < head->detail_level &&
        detail_levels[head->detail_level].kind != SBR_DETAIL_OFFSCREEN &&
        head->detail_level_ticks < sbri_ticks_of(world, detail->is.stay_s)) {
      visits += (double)detail_levels[head->detail_level].visits - (double)detail_levels[detail_level].visits;
      detail_level = head->detail_level;
    }
    if (detail_level != head->detail_level) sbri_character_wake(c);
    head->next_detail_level = detail_level;
  }
  detail->visits = visits;
}
