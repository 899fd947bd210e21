/* Where frames carry what hangs on them. */
#include "collide/ground.h"
#include "core/state.h"
#include "math/quat.h"
#include "math/trig.h"

static bool same_bits(const sbf_quat *a, const sbf_quat *b) {
  return a->x == b->x && a->y == b->y && a->z == b->z && a->w == b->w;
}

static sbri_delta delta_of(const sbr_model *model, uint32_t frame, sbr_transform now, float scale) {
  sbr_transform rest = sbri_frame_rest(model, frame);
  sbf_quat turn = sbri_quat_identity(); /* exactly, for a frame that has not turned */
  if (!same_bits(&now.rotation, &rest.rotation))
    turn = sbri_quat_normalize(sbri_quat_multiply(now.rotation, sbri_quat_conjugate(rest.rotation)));
  sbf_vec3 at = sbri_sub(sbri_scale(now.position, 1 / scale), sbri_rotate(turn, rest.position));
  return (sbri_delta){.position = at, .rotation = turn};
}

/* Squashes lie behind the deltas, one for each follower that may be one. */
static void squash(const sbri_character *c, float share, sbri_delta *deltas) {
  const sbf_follower_list *followers = &c->model->asset->followers;
  sbri_squash *squashes = (sbri_squash *)(void *)(deltas + c->model->frame_count);
  for (uint32_t i = 0; i < followers->count; i++) {
    float along = sbri_gait_stretch(&c->model->rig, sbri_gait(c), i, share);
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

size_t sbri_deltas_size(const sbr_model *model) {
  return model->frame_count * sizeof(sbri_delta) + model->asset->followers.count * sizeof(sbri_squash);
}

void sbri_deltas_make(const sbri_character *c, const sbr_transform *pose, float share, sbri_delta *deltas) {
  for (uint32_t f = 0; f < c->model->frame_count; f++) deltas[f] = delta_of(c->model, f, pose[f], c->scale);
  squash(c, share, deltas);
}

void sbri_deltas_between(const sbri_character *c, float share, sbri_delta *deltas) {
  for (uint32_t f = 0; f < c->model->frame_count; f++) {
    const sbr_transform *p = &sbri_previous_pose(c)[f], *q = &sbri_pose(c)[f];
    sbr_transform now = {
        sbri_lerp(p->position, q->position, share), sbri_quat_blend(p->rotation, q->rotation, share)};
    deltas[f] = delta_of(c->model, f, now, c->scale);
  }
  squash(c, share, deltas);
}

/* A rigid motion as three rows of four, the last of them the translation. */
typedef struct rows {
  float at[3][4];
} rows;

static rows rows_of(const sbri_delta *t) {
  sbf_vec3 x = sbri_rotate(t->rotation, sbri_vec3(1, 0, 0)), y = sbri_rotate(t->rotation, sbri_vec3(0, 1, 0)),
           z = sbri_rotate(t->rotation, sbri_vec3(0, 0, 1));
  return (rows){
      {{x.x, y.x, z.x, t->position.x}, {x.y, y.y, z.y, t->position.y}, {x.z, y.z, z.z, t->position.z}}};
}

static sbri_wide row(const rows *r, int k, sbri_wide3 p) {
  return sbri_wide_all(r->at[k][0]) * p.x + sbri_wide_all(r->at[k][1]) * p.y +
         sbri_wide_all(r->at[k][2]) * p.z + sbri_wide_all(r->at[k][3]);
}

static sbri_point guided(const sbri_guide *guide, const sbri_delta *deltas, const sbri_point *rest) {
  sbf_vec3 sum = {0, 0, 0}, p = {rest->x, rest->y, rest->z};
  for (int k = 0; k < SBRI_GUIDES; k++) {
    if (guide->weights[k] == 0) continue;
    sum = sbri_add_scaled(sum, sbri_delta_place(&deltas[guide->frames[k]], p), guide->weights[k]);
  }
  return (sbri_point){sum.x, sum.y, sum.z, 0};
}

void sbri_guide_places(
    const sbr_model *model, const sbri_body *body, const sbri_delta *deltas, sbri_point *places) {
  const sbri_point *rest = model->islands[body->island].rest + body->slot_begin;
  uint32_t count = body->slot_end - body->slot_begin;
  if (body->guides) {
    for (uint32_t i = 0; i < count; i++) places[i] = guided(&body->guides[i], deltas, &rest[i]);
    return;
  }
  if (deltas[body->guide_frame].squash) {
    for (uint32_t i = 0; i < count; i++) {
      sbf_vec3 p = {rest[i].x, rest[i].y, rest[i].z};
      p = sbri_delta_place(&deltas[body->guide_frame], p);
      places[i] = (sbri_point){p.x, p.y, p.z, 0};
    }
    return;
  }
  rows r = rows_of(&deltas[body->guide_frame]);
  for (uint32_t i = 0; i < count; i += SBRI_LANES) {
    sbri_wide3 p = sbri_wide_load_points(rest + i);
    sbri_wide_store_points(places + i, (sbri_wide3){row(&r, 0, p), row(&r, 1, p), row(&r, 2, p)});
  }
}

void sbri_held_places(const sbri_island *island, const sbri_delta *deltas, sbri_point *places) {
  for (uint32_t slot = island->free_count; slot < island->slot_count; slot++) {
    const sbri_delta *d = &deltas[island->frame_of_held[slot - island->free_count]];
    const sbri_point *rest = &island->rest[slot];
    sbf_vec3 p = sbri_delta_place(d, sbri_vec3(rest->x, rest->y, rest->z));
    places[slot] = (sbri_point){p.x, p.y, p.z, 0};
  }
}

sbr_transform sbri_root_place(const sbri_character *c, const sbr_ground *ground) {
  sbf_vec3 place;
  float heading, s, k;
  sbri_gait_placement(sbri_gait(c), &place, &heading);
  sbr_double3 origin = sbri_head(c)->origin;
  double y = sbri_ground_height(ground, origin.x + (double)place.x, origin.z + (double)place.z, NULL);
  sbri_sincos(0.5f * heading, &s, &k);
  return (sbr_transform){{place.x, (float)(y + (double)place.y - origin.y), place.z}, {0, s, 0, k}};
}
