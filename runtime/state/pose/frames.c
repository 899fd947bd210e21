/* Motion of the frames of a pose since rest, with squash. */
#include "state/pose/frames.h"
#include "math/quat.h"
#include "math/trig.h"
#include "shapes/ground.h"

static bool same_bits(const sbf_quat *a, const sbf_quat *b) {
  return a->x == b->x && a->y == b->y && a->z == b->z && a->w == b->w;
}

static sbri_delta delta_of(const sbr_model *model, uint32_t frame, sbr_transform now, float scale) {
  sbr_transform rest = sbri_frame_rest(model, frame);
  sbf_quat rotation = sbri_quat_identity(); /* exact for a frame without rotation */
  if (!same_bits(&now.rotation, &rest.rotation))
    rotation = sbri_quat_normalize(sbri_quat_multiply(now.rotation, sbri_quat_conjugate(rest.rotation)));
  sbf_vec3 at = sbri_sub(sbri_scale(now.position, 1 / scale), sbri_rotate(rotation, rest.position));
  return (sbri_delta){.position = at, .rotation = rotation};
}

/* Squashes are stored after the deltas, one for each possible squash follower. */
static void squash(const sbri_character *c, float fraction, sbri_delta *deltas) {
  const sbf_follower_list *followers = &c->model->asset->followers;
  sbri_squash *squashes = (sbri_squash *)(void *)(deltas + c->model->frame_count);
  for (uint32_t i = 0; i < followers->count; i++) {
    float along = sbri_gait_stretch(&c->model->rig, sbri_gait(c), i, fraction);
    if (along == 1) continue;
    uint32_t frame = (uint32_t)followers->at[i].bone;
    sbr_transform rest = sbri_frame_rest(c->model, frame);
    squashes[i] = (sbri_squash){.head = rest.position,
        .axis = sbri_rotate(rest.rotation, sbri_squash_axis(&followers->at[i])),
        .along = along,
        .across = 1 / sqrtf(along)};
    deltas[frame].squash = &squashes[i];
  }
}

sbr_transform sbri_delta_of(const sbri_character *c, const sbr_transform *pose, uint32_t frame) {
  sbri_delta delta = delta_of(c->model, frame, pose[frame], c->scale);
  return (sbr_transform){delta.position, delta.rotation};
}

void sbri_deltas_make(
    const sbri_character *c, const sbr_transform *pose, float fraction, sbri_delta *deltas) {
  for (uint32_t f = 0; f < c->model->frame_count; f++) deltas[f] = delta_of(c->model, f, pose[f], c->scale);
  squash(c, fraction, deltas);
}

void sbri_deltas_interpolate(const sbri_character *c, float fraction, sbri_delta *deltas) {
  for (uint32_t f = 0; f < c->model->frame_count; f++) {
    const sbr_transform *p = &sbri_previous_pose(c)[f], *q = &sbri_pose(c)[f];
    sbr_transform now = {
        sbri_lerp(p->position, q->position, fraction), sbri_quat_blend(p->rotation, q->rotation, fraction)};
    deltas[f] = delta_of(c->model, f, now, c->scale);
  }
  squash(c, fraction, deltas);
}
