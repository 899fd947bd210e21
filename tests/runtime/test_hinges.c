/* Damping of sheets: the lowest bending mode, and rigid motion without damping. */
#include "prepare/hinges.h"

#include <math.h>

#include "harness.h"
#include "sbrun/animation.h"
#include "scenes.h"
#include "state/world.h"

enum {
  CELLS = 6,
  POINTS = (CELLS + 1) * (CELLS + 1),
  QUADS = CELLS * CELLS,
  SPRINGS = 4 * CELLS * (CELLS + 1)
};

static uint32_t point(uint32_t x, uint32_t z) {
  return x * (CELLS + 1) + z;
}

/* An asset with a square metre of cotton, 0.15 kg, level, in springs along its sides and diagonals; `pinned`:
 * by the bone, or by the world where that is -1, along x = 0. */
static scene make_cotton(bool pinned, int32_t bone, float damping_ratio) {
  static sbf_vec3 positions[POINTS];
  static float masses[POINTS], stiffness[SPRINGS];
  static uint32_t sizes[QUADS], corners[4 * QUADS], edge[CELLS + 1];
  static sbf_uint2 ends[SPRINGS];
  uint32_t springs = 0, quads = 0;
  for (uint32_t x = 0; x <= CELLS; x++)
    for (uint32_t z = 0; z <= CELLS; z++) {
      uint32_t at = point(x, z);
      positions[at] = (sbf_vec3){(float)x / CELLS, 0, (float)z / CELLS};
      masses[at] = 0.15f / POINTS;
      if (x < CELLS) ends[springs++] = (sbf_uint2){{at, point(x + 1, z)}};
      if (z < CELLS) ends[springs++] = (sbf_uint2){{at, point(x, z + 1)}};
      if (x < CELLS && z < CELLS) {
        ends[springs++] = (sbf_uint2){{at, point(x + 1, z + 1)}};
        ends[springs++] = (sbf_uint2){{point(x, z + 1), point(x + 1, z)}};
        const uint32_t quad[4] = {at, point(x, z + 1), point(x + 1, z + 1), point(x + 1, z)};
        sizes[quads] = 4;
        for (int k = 0; k < 4; k++) corners[4 * quads + (uint32_t)k] = quad[k];
        quads++;
      }
    }
  for (uint32_t i = 0; i < springs; i++) stiffness[i] = 1500;
  for (uint32_t z = 0; z <= CELLS; z++) edge[z] = point(0, z);
  scene s = scene_begin();
  if (bone >= 0) scene_bone(&s, (sbf_vec3){0, 0, 0});
  sbf_level *level = scene_points(&s, 0, positions, masses, POINTS);
  scene_springs(&s, level, ends, stiffness, springs);
  if (pinned) scene_pin(&s, level, bone, edge, CELLS + 1);
  sbf_soft_body *body = scene_body(&s, 0);
  body->surface.positions = (sbf_vec3_list){positions, POINTS};
  body->surface.polygon_sizes = (sbf_u32_list){sizes, QUADS};
  body->surface.polygon_points = (sbf_u32_list){corners, 4 * QUADS};
  body->attributes.thickness = 3e-4f;
  body->attributes.area_density = 0.15f;
  body->attributes.young_modulus = 1e7f;
  body->attributes.poisson_ratio = 0.3f;
  body->attributes.bending_stiffness = 7e-6f;
  body->attributes.damping_ratio = damping_ratio;
  return s;
}

static scene cotton(bool pinned, float damping_ratio) {
  scene s = make_cotton(pinned, -1, damping_ratio);
  scene_start(&s);
  return s;
}

/* A free square plate's lowest mode twists its corners against each other: w = 13.5 sqrt(D / (m L^2)) with nu
 * = 0.3 (Leissa, Vibration of Plates, 1969). Hinges have no Poisson's ratio, and polynomials give an upper
 * bound. */
START_TEST(the_lowest_mode_bends)
{
  scene s = cotton(false, 0.1f);
  double plate = 13.5 * sqrt(7e-6 / 0.15), found = (double)s.model->bodies[0].damping.lowest_rad_s;
  ck_assert_double_gt(found, 0.5 * plate);
  ck_assert_double_lt(found, 2 * plate);
  scene_free(&s);
}
END_TEST

/* With the ratio of the cotton preset the free edge falls as it does undamped. */
START_TEST(cloth_does_not_fall_through_honey)
{
  double fallen[2];
  for (int k = 0; k < 2; k++) {
    scene s = cotton(true, k ? 0.1f : 0);
    scene_ticks(&s, 30);
    fallen[k] = (double)scene_point(&s, 0, point(CELLS, CELLS / 2)).y;
    scene_free(&s);
  }
  ck_assert_double_lt(fallen[0], -0.7);
  ck_assert_double_lt(fabs(fallen[1] / fallen[0] - 1), 0.05);
}
END_TEST

/* Without weight: the pinned edge is lifted by 0.4 m in a sixth of a second, the free edge lags behind. Soft
 * tissue follows its bone where its strain would become too large; a sheet may bend freely. */
START_TEST(cloth_stays_behind_its_bone)
{
  static const float times[2] = {0, 1 / 6.0f}, values[6] = {0, 0, 0, 0, 0.4f, 0};
  scene s = make_cotton(true, 0, 0.1f);
  s.asset->environment.gravity = (sbf_vec3){0, 0, 0};
  sbf_clip *clip = sbf_asset_allocate(s.asset, 1, sizeof *clip);
  sbf_track *track = sbf_asset_allocate(s.asset, 1, sizeof *track);
  sbf_clip_init(clip);
  sbf_track_init(track);
  clip->id = clip->name = "lifted";
  clip->duration = times[1];
  clip->loop = false;
  clip->tracks = (sbf_track_list){track, 1};
  track->bone = 0;
  track->property = SBF_TRACK_PROPERTY_TRANSLATION;
  track->times = (sbf_f32_list){times, 2};
  track->values = (sbf_f32_list){values, 6};
  s.asset->clips = (sbf_clip_list){clip, 1};
  scene_start(&s);
  sbr_clip_play how = sbr_default_clip_play();
  sbr_character_play_clip(s.world, s.character, 0, 0, &how);
  scene_ticks(&s, 11);
  ck_assert_float_gt(scene_point(&s, 0, point(0, CELLS / 2)).y, 0.39f);
  ck_assert_float_lt(fabsf(scene_point(&s, 0, point(CELLS, CELLS / 2)).y), 0.1f);
  scene_free(&s);
}
END_TEST

int main(void) {
  Suite *suite = suite_create("hinges");
  TCase *c = tcase_create("hinges");
  tcase_add_test(c, the_lowest_mode_bends);
  tcase_add_test(c, cloth_does_not_fall_through_honey);
  tcase_add_test(c, cloth_stays_behind_its_bone);
  suite_add_tcase(suite, c);
  return harness_run(suite);
}
