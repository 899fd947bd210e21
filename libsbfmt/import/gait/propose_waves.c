/* Proposes gaits for swimmers, fliers, slitherers and hoppers: waves along the spine, fins and wings, the
 * medium. */
#include <math.h>
#include <string.h>

#include "import/gait/gait_parts.h"

/* --- Waves ------------------------------------------------------------------------------------------- */

/* Whether the tail ends in a horizontal fluke, as a whale's does. */
static bool beats_vertically(const sbfi_rig_view *view) {
  double low[2] = {INFINITY, INFINITY}, high[2] = {-INFINITY, -INFINITY};
  double end = view->points.low[2] + 0.15 * sbfi_view_extent(view, 2);
  for (uint32_t i = 0; i < view->points.count; i++) {
    const double p[2] = {(double)view->points.at[i].x, (double)view->points.at[i].y};
    if ((double)view->points.at[i].z > end) continue;
    for (int k = 0; k < 2; k++) {
      low[k] = fmin(low[k], p[k]);
      high[k] = fmax(high[k], p[k]);
    }
  }
  bool is_flat = sbfi_view_extent(view, 1) < 0.25 * sbfi_view_extent(view, 0);
  return !is_flat && high[0] - low[0] > 1.5 * (high[1] - low[1]);
}

static bool propose_undulation(sbfi_conversion *c, const sbfi_rig_view *view, sbf_gait *gait) {
  sbf_u32_list bones;
  if (!sbfi_find_backbone(view, c->asset, &c->scratch, &bones)) return false;
  if (bones.count < 2) return true;
  sbf_undulation *wave = sbfi_convert_allocate(c, 1, sizeof *wave);
  if (!wave) return false;
  sbf_undulation_init(wave);
  wave->bones = bones;
  wave->length = (float)sbfi_view_extent(view, 2);
  gait->undulation = wave;
  return true;
}

/* --- Fins and wings ---------------------------------------------------------------------------------- */

/* Bones of a limb from the body to its tip: follows the child with most points in its subtree. */
static bool limb_bones(sbfi_conversion *c, const sbfi_rig_view *view, int32_t root, sbf_u32_list *list) {
  const sbfi_gait_draft *d = &view->draft;
  uint32_t count = 0, *bones = sbfi_convert_allocate(c, d->asset->bones.count, sizeof *bones);
  if (!bones) return false;
  for (int32_t bone = root; bone != SBF_NONE;) {
    double farthest = -1;
    int32_t next = SBF_NONE;
    bones[count++] = (uint32_t)bone;
    for (uint32_t i = (uint32_t)bone + 1; i < d->asset->bones.count; i++) {
      double x = fabs((double)sbfi_draft_head(d, (int32_t)i).x);
      if (sbfi_draft_bone(d, (int32_t)i)->parent != bone || !d->shapes[i].moves_points || x <= farthest)
        continue;
      farthest = x;
      next = (int32_t)i;
    }
    bone = next;
  }
  *list = (sbf_u32_list){bones, count};
  return true;
}

static bool fill_fin(
    sbfi_conversion *c, const sbfi_rig_view *view, const sbfi_limb_shape *limb, sbf_fin *fin) {
  sbf_fin_init(fin);
  fin->name = c->asset->bones.at[limb->root].name;
  fin->axis = (sbf_vec3){0, 0, limb->side > 0 ? 1 : -1}; /* both rise with positive angles */
  return limb_bones(c, view, limb->root, &fin->bones);
}

static double reach_of(const sbfi_limb_shape *limb) {
  return limb->high[0] - limb->low[0];
}

static double depth_of(const sbfi_limb_shape *limb) {
  return limb->high[2] - limb->low[2];
}

/* Twins that extend farthest sideways and are flat or named as wings; stores their wing area, m^2. */
static int32_t widest_pair(const sbfi_rig_view *view, sbfi_word word, double *area) {
  double best = 0;
  int32_t pair = SBF_NONE;
  for (uint32_t l = 0; l < view->limb_count; l++) {
    const sbfi_limb_shape *limb = &view->limbs[l];
    uint32_t words = sbfi_words_of(view->draft.asset->bones.at[limb->root].name);
    bool named = words >> word & 1;
    if (limb->twin == SBF_NONE || limb->points == 0 || words >> SBFI_WORD_LEG & 1) continue;
    double score = reach_of(limb) * (named ? 4 : limb->flatness < 0.33 ? 1 : 0);
    if (score <= best) continue;
    best = score;
    pair = (int32_t)l;
    *area = 2 * reach_of(limb) * depth_of(limb) * 0.7;
  }
  return pair;
}

/* A ray: its pair of fins makes up most of its width and length. */
static bool is_ray(const sbfi_rig_view *view, int32_t pair) {
  if (pair == SBF_NONE) return false;
  const sbfi_limb_shape *limb = &view->limbs[pair];
  return 2 * reach_of(limb) > 0.6 * sbfi_view_extent(view, 0) &&
         sbfi_view_extent(view, 0) > 0.55 * sbfi_view_extent(view, 2) &&
         sbfi_view_extent(view, 1) < 0.35 * sbfi_view_extent(view, 0);
}

static void beat_as_ray(sbf_fin *fin) {
  fin->motion = SBF_FIN_MOTION_FLAP;
  fin->amplitude = 0.28f; /* 16 degrees at the root, 49 at the tip: measured on a manta's clip */
  fin->flex = fin->bones.count > 1 ? 0.57f : 0;
  fin->lag = fin->bones.count > 1 ? 1.6f : 0;
  fin->frequency = 0.5f;
}

static void trail(const sbfi_rig_view *view, const sbfi_limb_shape *limb, sbf_fin *fin) {
  double middle = 0.5 * (view->points.low[2] + view->points.high[2]);
  bool ahead = 0.5 * (limb->low[2] + limb->high[2]) > middle;
  fin->motion = ahead ? SBF_FIN_MOTION_STEER : SBF_FIN_MOTION_TRAIL;
  fin->amplitude = ahead ? 0.4f : 0.3f;
}

static bool propose_fins(sbfi_conversion *c, const sbfi_rig_view *view, sbf_gait *gait, int32_t ray) {
  sbf_fin *fins = sbfi_convert_allocate(c, (size_t)view->limb_count + 1, sizeof *fins);
  uint32_t count = 0;
  if (!fins) return false;
  for (uint32_t l = 0; l < view->limb_count; l++) {
    const sbfi_limb_shape *limb = &view->limbs[l];
    if (limb->twin == SBF_NONE || limb->points == 0 || !view->draft.shapes[limb->root].moves_points) continue;
    if (!fill_fin(c, view, limb, &fins[count])) return false;
    bool beats = ray != SBF_NONE && ((int32_t)l == ray || limb->twin == ray);
    if (beats)
      beat_as_ray(&fins[count]);
    else
      trail(view, limb, &fins[count]);
    count++;
  }
  gait->fins = (sbf_fin_list){count ? fins : NULL, count};
  return true;
}

/* --- The medium -------------------------------------------------------------------------------------- */

static sbf_medium *propose_medium(sbfi_conversion *c, const sbfi_rig_view *view, sbf_gait *gait) {
  sbf_medium *medium = sbfi_convert_allocate(c, 1, sizeof *medium);
  if (!medium) return NULL;
  sbf_medium_init(medium);
  medium->altitude = (float)fmax(sbfi_view_extent(view, 1), 0.6 * sbfi_view_size(view));
  gait->medium = medium;
  return medium;
}

/* --- Kinds ------------------------------------------------------------------------------------------- */

bool sbfi_propose_swim(sbfi_conversion *c, const sbfi_rig_view *view, sbf_gait *gait) {
  double length = sbfi_view_extent(view, 2), area;
  int32_t ray = widest_pair(view, SBFI_WORD_FIN, &area);
  if (!is_ray(view, ray)) ray = SBF_NONE;
  /* One body length per second. Above one metre the beat slows as 1/L and the speed grows with the root. */
  gait->walk_speed = (float)fmax(0.02, length > 1 ? sqrt(length) : length);
  if (!propose_undulation(c, view, gait) || !propose_fins(c, view, gait, ray)) return false;
  sbf_undulation *wave = (sbf_undulation *)(uintptr_t)gait->undulation; /* created above and still writable */
  if (wave) {
    bool slender = length > 6 * fmax(sbfi_view_extent(view, 0), sbfi_view_extent(view, 1));
    bool whale = !slender && beats_vertically(view);
    wave->exaggeration = ray != SBF_NONE ? 0.3f : 1.5f;
    if (slender) { /* an eel: the whole body waves */
      wave->amplitude = (sbf_vec3){0.02f, 0.08f, 0};
      wave->wavelength = 0.7f;
    }
    if (whale || ray != SBF_NONE) wave->plane = SBF_WAVE_PLANE_VERTICAL;
    if (whale) wave->wavelength = 1.2f;
  }
  return propose_medium(c, view, gait) != NULL;
}

bool sbfi_propose_fly(sbfi_conversion *c, const sbfi_rig_view *view, sbf_gait *gait) {
  double area = 0, size = sbfi_view_size(view), span = sbfi_view_extent(view, 0);
  int32_t pair = widest_pair(view, SBFI_WORD_WING, &area);
  sbf_medium *medium = propose_medium(c, view, gait);
  if (!medium) return false;
  gait->walk_speed = (float)fmax(0.1, 1.5 * sqrt(size));
  medium->bob_frequency = 0.8f;
  medium->bob = (float)(0.02 * size);
  medium->tilt = 0.25f;
  if (pair == SBF_NONE) return true;
  sbf_fin *fins = sbfi_convert_allocate(c, (size_t)view->limb_count + 1, sizeof *fins);
  uint32_t count = 0;
  if (!fins) return false;
  bool bird = view->limbs[pair].bones >= 2 && area > 0.15 * span * span;
  for (uint32_t l = 0; l < view->limb_count; l++) {
    const sbfi_limb_shape *limb = &view->limbs[l];
    bool same = (int32_t)l == pair || limb->twin == pair;
    uint32_t words = sbfi_words_of(c->asset->bones.at[limb->root].name);
    if (limb->twin == SBF_NONE || limb->points == 0 || (!same && !(words >> SBFI_WORD_WING & 1))) continue;
    sbf_fin *fin = &fins[count++];
    if (!fill_fin(c, view, limb, fin)) return false;
    fin->motion = SBF_FIN_MOTION_FLAP;
    /* Wingbeat frequencies of similar fliers scale as 1 / sqrt(span) (Pennycuick 1996); faster ones are
     * not visible as beats. */
    fin->frequency = (float)fmin(8, fmax(0.5, 4.4 / sqrt(fmax(span, 0.01))));
    fin->amplitude = bird ? 0.6f : 0.75f;
    fin->mean = bird ? 0.1f : 0;
    fin->flex = fin->bones.count > 1 ? 0.4f : 0;
    fin->lag = fin->bones.count > 1 ? 0.9f : 0;
    fin->twist = bird ? 0.2f : 0.3f;
  }
  gait->fins = (sbf_fin_list){count ? fins : NULL, count};
  if (bird) {
    medium->glide_ratio = 8;
    medium->tilt = 0;
  }
  medium->bob = (float)(0.05 * size);
  medium->bob_frequency = (float)fmin(1.5, 0.5 * (double)fins[0].frequency);
  return true;
}

bool sbfi_propose_slither(sbfi_conversion *c, const sbfi_rig_view *view, sbf_gait *gait) {
  gait->walk_speed = (float)fmax(0.02, 0.4 * sbfi_view_extent(view, 2));
  if (!propose_undulation(c, view, gait)) return false;
  sbf_undulation *wave = (sbf_undulation *)(uintptr_t)gait->undulation; /* created above and still writable */
  if (wave) wave->wavelength = 0.6f;
  return true;
}

bool sbfi_propose_crawl(sbfi_conversion *c, const sbfi_rig_view *view, sbf_gait *gait) {
  double height = fmax(sbfi_view_extent(view, 1), 1e-3), size = sbfi_view_size(view);
  (void)c;
  gait->step_height = (float)(0.12 * height);
  gait->step_duration = (float)fmin(0.6, fmax(0.2, 0.35 * sqrt(height)));
  gait->walk_speed = (float)fmax(0.02, 0.6 * size);
  return true;
}
