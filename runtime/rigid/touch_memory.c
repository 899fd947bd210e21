/* What touches did in the last step, kept to the next tick: the passes that find who presses, who sticks and
 * who slides begin there, and where a body lies they end there too. The forces are no part of the solution:
 * they are guesses of it, and the bounds of friction for the first pass. */
#include "base/assert.h"
#include "rigid/rigid_work.h"

/* A place on a shape is the same as before within this share of its body's size. */
static const float SAME_SHARE = 0.05f;

/* What has not been found again bears on within this share of it, if it pressed in so many ticks, beside one
 * that faces as much alike. */
static const float NEAR_SHARE = 0.02f, FACING = 0.97f;
enum { IDLE_TICKS = 4 };

static bool is_same(const sbri_kept_touch *kept, const sbri_ground_touch *touch, float max) {
  sbf_vec3 off = sbri_sub(kept->at, touch->at);
  return kept->surface == touch->surface && sbri_dot(off, off) <= max * max;
}

static void give_back(const sbri_kept_touch *kept, sbri_ground_touch *touch) {
  touch->known = true;
  touch->idle = kept->idle;
  touch->normal_n = kept->normal_n, touch->drag_n = kept->drag_n;
  touch->left = kept->left;
}

/* A touch of the pair that has been found anew and faces as the one that has not; NULL: none. */
static const sbri_ground_touch *beside(const sbri_rigid_solving *work, const sbri_kept_touch *kept) {
  for (uint32_t i = 0; i < work->touch_count; i++) {
    const sbri_ground_touch *touch = &work->touches[i];
    if (touch->body == kept->body && touch->surface == kept->surface &&
        sbri_dot(touch->normal, kept->normal) > FACING && sbri_dot(touch->velocity, touch->velocity) == 0)
      return touch;
  }
  return NULL;
}

/* Two hulls whose edges cross are told to touch at one place, and rock between two: the one that has not been
 * found this time bears on while the body is near it. */
static void bear_on(const sbri_rigid_tick *t, sbri_rigid_solving *work, const sbri_kept_touch *kept) {
  if (kept->idle > IDLE_TICKS || work->touch_count >= work->touch_capacity) return;
  const sbri_ground_touch *by = beside(work, kept);
  if (!by) return;
  const sbri_rigid_body_state *s = &t->bodies[kept->body];
  sbf_vec3 x = sbri_add(s->pose.position, sbri_rotate(s->pose.rotation, kept->at));
  float gap = sbri_dot(kept->normal, x) - kept->offset;
  if (fabsf(gap) > NEAR_SHARE * t->model->bodies[kept->body].radius) return;
  sbri_ground_touch *touch = &work->touches[work->touch_count++];
  *touch = *by;
  touch->at = kept->at, touch->normal = kept->normal, touch->offset = kept->offset;
  if (touch->external_body)
    touch->external_body_arm = sbri_sub(x, work->external_bodies[touch->external_body - 1].is.centre);
  give_back(kept, touch);
}

void sbri_touch_memory_recall(const sbri_rigid_tick *t, sbri_rigid_solving *work) {
  uint32_t count = t->drive->kept_touches, begin = 0;
  for (uint32_t i = 0; i < work->touch_count; i++) {
    sbri_ground_touch *touch = &work->touches[i];
    float max = SAME_SHARE * t->model->bodies[touch->body].radius;
    if (touch->surface == UINT32_MAX) max = 0; /* those on the ground are vertices */
    for (uint32_t k = 0; k < count; k++) {     /* mostly the one behind the last */
      sbri_kept_touch *kept = &t->kept[(begin + k) % count];
      if (kept->body != touch->body || !is_same(kept, touch, max)) continue;
      kept->found = 1;
      give_back(kept, touch);
      begin = (begin + k + 1) % count;
      break;
    }
  }
  for (uint32_t k = 0; k < count; k++)
    if (!t->kept[k].found && t->kept[k].surface != UINT32_MAX) bear_on(t, work, &t->kept[k]);
}

void sbri_touch_memory_keep(const sbri_rigid_tick *t, const sbri_rigid_solving *work) {
  uint32_t count = 0;
  for (uint32_t i = 0; i < work->touch_count; i++) {
    const sbri_ground_touch *touch = &work->touches[i];
    if (!touch->known) continue;
    t->kept[count++] = (sbri_kept_touch){.body = touch->body,
        .surface = touch->surface,
        .at = touch->at,
        .drag_n = touch->drag_n,
        .left = touch->left,
        .idle = touch->normal_n > 0 ? 0 : touch->idle + 1,
        .normal = touch->normal,
        .offset = touch->offset,
        .normal_n = touch->normal_n};
  }
  SBF_ASSERT(count <= sbri_rigid_touch_capacity(t->model));
  t->drive->kept_touches = count;
}
