/* Choosing rungs: for each character the coarsest that is near enough on the screen, then coarser ones until
 * the budget lasts. A change for the better comes at once; one for the worse waits until it is well below
 * what is allowed, and a while. Done by one thread, in the order of the characters. */
#include "detail/choose.h"

/* The coarsest that has a pose; of one that others may meet, that has bodies. */
static uint32_t last_posed(const sbri_character *c) {
  const sbr_model *base = c->model->base;
  uint32_t last = base->rung_count - 1;
  if (c->near) return sbri_last_that_meets(base);
  return base->ladder[last].kind == SBR_RUNG_AWAY ? last - 1 : last;
}

static uint32_t rung_for(const sbr_world *world, const sbri_character *c, float pixels) {
  const sbri_detail *detail = world->detail;
  const sbri_character_state *head = sbri_head(c);
  const sbr_model *base = c->model->base;
  uint32_t last = last_posed(c), now = head->next_rung < last ? head->next_rung : last, found = 0;
  if (!(pixels > 0)) {
    float after = detail->is.away_after_s;
    return !c->near && after >= 0 && head->unseen_ticks >= sbri_ticks_of(world, after) ? base->rung_count - 1
                                                                                       : last;
  }
  bool may_coarsen = head->rung_ticks >= sbri_ticks_of(world, detail->is.stay_s);
  for (uint32_t r = 1; r <= last; r++) {
    float error = pixels * base->ladder[r].error_m;
    float max = r > now ? detail->is.settle * detail->is.error_px : detail->is.error_px;
    if (error <= max && (r <= now || may_coarsen)) found = r;
  }
  return found;
}

/* False: nothing is chosen for it. */
static bool choose_for(const sbr_world *world, uint32_t index, sbri_choice *choice, double *visits) {
  sbri_character *c = &world->characters[index];
  if (!c->model || sbri_head(c)->paused) return false;
  sbri_character_state *head = sbri_head(c);
  const sbr_model *base = c->model->base;
  float pixels = sbri_pixels_of(world, c);
  if (pixels > 0 && head->unseen_ticks > 0) head->rung_ticks = UINT32_MAX; /* as a new one: nobody saw it */
  head->unseen_ticks = pixels > 0 ? 0 : head->unseen_ticks < UINT32_MAX ? head->unseen_ticks + 1 : UINT32_MAX;
  double now = head->asleep ? 0 : base->ladder[head->rung].visits;
  if (base->rung_count == 1 || head->set_rung_plus_1) {
    *visits += now;
    return false;
  }
  pixels *= sbri_speed_factor(c) * c->scale;
  uint32_t rung = rung_for(world, c, pixels);
  if (head->asleep && rung >= head->rung) return false; /* it costs nothing as it is */
  *choice = (sbri_choice){index, rung, last_posed(c), pixels};
  if (rung > choice->last) choice->last = rung;
  *visits += base->ladder[rung].visits;
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
  if (is_short) visits = sbri_budget_keep(world, visits, max);
  for (uint32_t i = 0; i < detail->choice_count; i++) {
    sbri_character *c = &world->characters[detail->choices[i].character];
    sbri_character_state *head = sbri_head(c);
    const sbr_rung *ladder = c->model->base->ladder;
    uint32_t rung = detail->choices[i].rung;
    /* Where the budget is short two characters would take turns. */
    if (is_short && rung < head->rung && ladder[head->rung].kind != SBR_RUNG_AWAY &&
        head->rung_ticks < sbri_ticks_of(world, detail->is.stay_s)) {
      visits += (double)ladder[head->rung].visits - (double)ladder[rung].visits;
      rung = head->rung;
    }
    if (rung != head->rung) sbri_character_wake(c);
    head->next_rung = rung;
  }
  detail->visits = visits;
}
