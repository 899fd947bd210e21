/* Proposes wheels and tracks. */
#include <math.h>
#include <stdlib.h>

#include "import/gait/gait_parts.h"

enum { MIN_LINKS = 8 };

/* Extent of a bone's own points. */
static uint32_t box_of(const sbfi_rig_view *view, int32_t bone, double low[3], double high[3]) {
  uint32_t count = 0;
  for (int k = 0; k < 3; k++) {
    low[k] = INFINITY;
    high[k] = -INFINITY;
  }
  for (uint32_t i = 0; i < view->points.count; i++) {
    const double p[3] = {
        (double)view->points.at[i].x, (double)view->points.at[i].y, (double)view->points.at[i].z};
    if (view->points.bone[i] != bone) continue;
    count++;
    for (int k = 0; k < 3; k++) {
      low[k] = fmin(low[k], p[k]);
      high[k] = fmax(high[k], p[k]);
    }
  }
  return count;
}

static const sbfi_limb_shape *limb_at(const sbfi_rig_view *view, int32_t root) {
  for (uint32_t l = 0; l < view->limb_count; l++)
    if (view->limbs[l].root == root) return &view->limbs[l];
  return NULL;
}

/* Whether the bone is a disc that touches the ground, or is named a wheel and as high as long. */
static bool is_wheel(const sbfi_rig_view *view, int32_t bone, double *radius) {
  double low[3], high[3], ground = view->points.low[1], height = sbfi_view_extent(view, 1);
  const sbfi_limb_shape *limb = limb_at(view, bone);
  if (limb && limb->is_loop) return false;
  if (box_of(view, bone, low, high) < 6 || low[1] > ground + 0.12 * height) return false;
  double tall = high[1] - low[1], length = high[2] - low[2];
  bool named = sbfi_words_of(view->draft.asset->bones.at[bone].name) >> SBFI_WORD_WHEEL & 1;
  bool square = fmin(tall, length) > 0.8 * fmax(tall, length);
  *radius = 0.25 * (tall + length);
  double center = (double)sbfi_draft_head(&view->draft, bone).y;
  if (fabs(center - 0.5 * (low[1] + high[1])) > 0.5 * *radius) return false;
  return square && *radius > 0 && (named || (limb && limb->is_round));
}

typedef struct link {
  double angle; /* rad, about the loop's centre, upwards from the front */
  uint32_t bone;
} link;

static int by_angle(const void *a, const void *b) {
  double p = ((const link *)a)->angle, q = ((const link *)b)->angle;
  return p < q ? 1 : p > q ? -1 : 0;
}

/* Adds the links of one loop so that the upper links move forward. */
static bool add_tread(sbfi_conversion *c, const sbfi_rig_view *view, const sbfi_limb_shape *first, bool *done,
    sbf_tread_list *treads) {
  const sbf_bone_list *bones = &c->asset->bones;
  link *links = sbfi_arena_allocate(&c->scratch, (size_t)view->limb_count + 1, sizeof *links);
  double y = 0, z = 0;
  uint32_t count = 0, listed_count = 0;
  if (!links) return false;
  for (int pass = 0; pass < 2; pass++)
    for (uint32_t l = 0; l < view->limb_count; l++) {
      const sbfi_limb_shape *limb = &view->limbs[l];
      if (!limb->is_loop || limb->side != first->side || !limb->points ||
          bones->at[limb->root].parent != bones->at[first->root].parent)
        continue;
      double at_y = 0.5 * (limb->low[1] + limb->high[1]), at_z = 0.5 * (limb->low[2] + limb->high[2]);
      done[l] = true;
      if (pass == 0) {
        y += at_y;
        z += at_z;
        count++;
      } else {
        links[listed_count++] = (link){atan2(at_y - y / count, at_z - z / count), (uint32_t)limb->root};
      }
    }
  if (count < MIN_LINKS) return true;
  qsort(links, count, sizeof *links, by_angle);
  uint32_t *listed = sbfi_convert_allocate(c, count, sizeof *listed);
  if (!listed) return false;
  for (uint32_t i = 0; i < count; i++) listed[i] = links[i].bone;
  sbf_tread *tread = (sbf_tread *)(uintptr_t)&treads->at[treads->count++];
  sbf_tread_init(tread);
  tread->name = first->side > 0 ? "left" : "right";
  tread->bones = (sbf_u32_list){listed, count};
  return true;
}

bool sbfi_propose_roll(sbfi_conversion *c, const sbfi_rig_view *view, sbf_gait *gait) {
  uint32_t count = c->asset->bones.count, wheels = 0;
  sbf_wheel *list = sbfi_convert_allocate(c, count, sizeof *list);
  sbf_tread *treads = sbfi_convert_allocate(c, (size_t)view->limb_count + 1, sizeof *treads);
  bool *done = sbfi_arena_allocate(&c->scratch, (size_t)view->limb_count + 1, sizeof *done);
  double size = sbfi_view_size(view), foremost = -INFINITY, rearmost = INFINITY, radius;
  if (!list || !treads || !done) return false;
  sbf_tread_list of_tracks = {treads, 0};
  for (uint32_t i = 0; i < count; i++) {
    if (!is_wheel(view, (int32_t)i, &radius)) continue;
    sbf_wheel *wheel = &list[wheels++];
    sbf_wheel_init(wheel);
    wheel->name = c->asset->bones.at[i].name;
    wheel->bone = (int32_t)i;
    wheel->radius = (float)radius;
    double z = (double)c->asset->bones.at[i].head.z;
    foremost = fmax(foremost, z);
    rearmost = fmin(rearmost, z);
  }
  for (uint32_t l = 0; l < view->limb_count; l++)
    if (view->limbs[l].is_loop && !done[l] && !add_tread(c, view, &view->limbs[l], done, &of_tracks))
      return false;
  for (uint32_t w = 0; w < wheels && of_tracks.count == 0; w++) /* tracks replace wheels */
    if (foremost - rearmost > (double)list[w].radius &&
        (double)c->asset->bones.at[list[w].bone].head.z > foremost - 0.25 * (foremost - rearmost))
      list[w].steer_limit = 0.5f;
  gait->wheels = (sbf_wheel_list){wheels ? list : NULL, wheels};
  gait->treads = (sbf_tread_list){of_tracks.count ? treads : NULL, of_tracks.count};
  gait->walk_speed = (float)fmax(0.05, 1.2 * sqrt(size));
  return true;
}
