#include "view/viewer_choices.h"

/* Grounds that fit a character of a metre. */
typedef struct land {
  const char *name;
  sbr_ground (*make)(float size);
} land;

static sbr_ground make_flat(float size) {
  (void)size;
  return sbr_ground_flat(0);
}
static sbr_ground make_uneven(float size) {
  return sbr_ground_noise(0.12 * (double)size, 7);
}
static sbr_ground make_stairs(float size) {
  return sbr_ground_stairs(0.03 * (double)size, 0.45 * (double)size);
}
static sbr_ground make_slope(float size) {
  (void)size;
  return sbr_ground_slope(12);
}
static const land lands[] = {
    {"flat", make_flat}, {"uneven", make_uneven}, {"stairs", make_stairs}, {"slope", make_slope}};
enum { LAND_COUNT = sizeof lands / sizeof *lands };

static const struct pace {
  const char *name;
  float sizes_s;
} paces[] = {{"slow", 0.25f}, {"walk", 0.5f}, {"fast", 0.9f}};
enum { PACE_COUNT = sizeof paces / sizeof *paces };

const char *viewer_ground_name(const viewer *v) {
  return v->ground < 0 ? "as given" : lands[v->ground].name;
}

sbr_ground viewer_ground_make(const viewer *v) {
  return v->ground < 0 ? v->own_ground : lands[v->ground].make(v->size);
}

int viewer_ground_find(const sbr_ground *ground) {
  return ground->height == make_flat(1).height ? 0 : -1;
}

int viewer_next_ground(const viewer *v) {
  return (v->ground + 1) % LAND_COUNT;
}

static int pace_of(const viewer *v) {
  for (int i = 0; i < PACE_COUNT; i++)
    if (paces[i].sizes_s == v->p.pace) return i;
  return 0;
}

const char *viewer_pace_name(const viewer *v) {
  return paces[pace_of(v)].name;
}

float viewer_first_pace(void) {
  return paces[1].sizes_s;
}

float viewer_next_pace(const viewer *v) {
  return paces[(pace_of(v) + 1) % PACE_COUNT].sizes_s;
}

uint32_t viewer_level_count(const sbf_asset *asset) {
  uint32_t max = 1;
  for (uint32_t i = 0; i < asset->soft_bodies.count; i++)
    if (asset->soft_bodies.at[i].levels.count > max) max = asset->soft_bodies.at[i].levels.count;
  return max;
}

uint32_t viewer_render_level_count(const sbf_asset *asset) {
  uint32_t max = 0;
  for (uint32_t i = 0; i < asset->render_meshes.count; i++)
    if (asset->render_meshes.at[i].levels.count > max) max = asset->render_meshes.at[i].levels.count;
  return max + 1;
}
