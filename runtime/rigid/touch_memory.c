/* What touches did in the last step, kept to the next tick: the passes that find who presses, who sticks and
 * who slides begin there, and where a body lies they end there too. The forces are no part of the solution:
 * they are guesses of it, and the bounds of friction for the first pass. */
#include "rigid/rigid_work.h"

/* A place on a shape is the same as before within this share of its body's size. */
static const float SAME_SHARE = 0.05f;

static bool is_same(const sbri_kept_touch *kept, const sbri_ground_touch *touch, float most) {
  sbf_vec3 off = sbri_sub(kept->at, touch->at);
  return kept->collider == touch->collider && sbri_dot(off, off) <= most * most;
}

void sbri_touch_memory_recall(const sbri_rigid_tick *t, sbri_rigid_solving *work) {
  uint32_t count = t->drive->kept_touches, begin = 0;
  for (uint32_t i = 0; i < work->touch_count; i++) {
    sbri_ground_touch *touch = &work->touches[i];
    float most = SAME_SHARE * t->model->bodies[touch->body].radius;
    if (touch->collider == UINT32_MAX) most = 0; /* those on the ground are vertices */
    for (uint32_t k = 0; k < count; k++) {       /* mostly the one behind the last */
      const sbri_kept_touch *kept = &t->kept[(begin + k) % count];
      if (kept->body != touch->body || !is_same(kept, touch, most)) continue;
      touch->known = true;
      touch->normal_n = kept->normal_n, touch->drag_n = kept->drag_n;
      begin = (begin + k + 1) % count;
      break;
    }
  }
}

void sbri_touch_memory_keep(const sbri_rigid_tick *t, const sbri_rigid_solving *work) {
  uint32_t count = 0;
  for (uint32_t i = 0; i < work->touch_count; i++) {
    const sbri_ground_touch *touch = &work->touches[i];
    if (!touch->known) continue;
    t->kept[count++] = (sbri_kept_touch){.body = touch->body,
        .collider = touch->collider,
        .at = touch->at,
        .drag_n = touch->drag_n,
        .normal_n = touch->normal_n};
  }
  t->drive->kept_touches = count;
}
