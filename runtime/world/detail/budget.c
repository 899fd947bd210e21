/* Saving: changes to coarser levels are taken in the order of pixels of error per saved visit until the
 * budget suffices. The changes of one character have increasing prices (its levels are on the lower hull), so
 * the order holds for all characters together. Ties go to the character that was created first. */
#include "world/detail/choose.h"

static bool is_before(const sbri_saving *a, const sbri_saving *b) {
  return a->price < b->price || (a->price == b->price && a->choice < b->choice);
}

static void push(sbri_detail *detail, sbri_saving saving) {
  uint32_t at = detail->saving_count++;
  for (; at > 0 && is_before(&saving, &detail->savings[(at - 1) / 2]); at = (at - 1) / 2)
    detail->savings[at] = detail->savings[(at - 1) / 2];
  detail->savings[at] = saving;
}

static sbri_saving pop(sbri_detail *detail) {
  sbri_saving first = detail->savings[0], last = detail->savings[--detail->saving_count];
  uint32_t at = 0, count = detail->saving_count;
  for (uint32_t next; (next = 2 * at + 1) < count; at = next) {
    if (next + 1 < count && is_before(&detail->savings[next + 1], &detail->savings[next])) next++;
    if (!is_before(&detail->savings[next], &last)) break;
    detail->savings[at] = detail->savings[next];
  }
  detail->savings[at] = last;
  return first;
}

static const sbr_detail_level *detail_levels_of(const sbr_world *world, const sbri_choice *choice) {
  return world->characters[choice->character].model->detail.base->detail.definitions;
}

/* Offers the next change of a choice, if there is one. */
static void offer(const sbr_world *world, uint32_t index) {
  const sbri_choice *choice = &world->detail->choices[index];
  const sbr_detail_level *detail_levels = detail_levels_of(world, choice),
                         *now = &detail_levels[choice->detail_level];
  sbri_saving best = {INFINITY, index, choice->detail_level};
  for (uint32_t r = choice->detail_level + 1; r <= choice->last; r++) {
    float saved = now->visits - detail_levels[r].visits;
    if (!(saved > 0)) continue;
    float price = choice->pixels * (detail_levels[r].error_m - now->error_m) / saved;
    if (price <= best.price) best.price = price, best.to = r;
  }
  if (best.to != choice->detail_level) push(world->detail, best);
}

double sbri_budget_fit(const sbr_world *world, double visits, double max) {
  sbri_detail *detail = world->detail;
  detail->saving_count = 0;
  for (uint32_t i = 0; i < detail->choice_count && visits > max; i++) offer(world, i);
  while (visits > max && detail->saving_count > 0) {
    sbri_saving saving = pop(detail);
    sbri_choice *choice = &detail->choices[saving.choice];
    const sbr_detail_level *detail_levels = detail_levels_of(world, choice);
    visits += (double)detail_levels[saving.to].visits - (double)detail_levels[choice->detail_level].visits;
    choice->detail_level = saving.to;
    offer(world, saving.choice);
  }
  return visits;
}
