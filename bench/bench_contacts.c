/* Measures collision of rigid boxes, each in its own character: the cost of a contact, and how the time of
 * the broad phase grows with the number of boxes.
 *
 * `apart`: boxes stand in a wide grid on the ground without contact. The cost of collision detection is
 * the difference to the same boxes in a world in which bodies do not collide (`alone`). `towers`: stacks
 * of four, with four contacts between two boxes. The time is the median of many ticks of 1/60 s after half
 * a second, nothing asleep, on one thread. `touches_a_second` counts contacts between boxes on one
 * processor. `slope` is the exponent of the time of a tick against the number of boxes, from the row
 * before. */
#include <math.h>
#include <stdlib.h>

#include "measured_bodies.h"
#include "measuring.h"
#include "sbfmt/asset.h"
#include "sbrun/collision.h"

enum { HIGH = 4, SETTLES = 30, LIKE_THIS = 3 };
typedef enum layout { ALONE, SEPARATE, TOWERS } layout;
static const char *const layout_names[LIKE_THIS] = {"alone", "apart", "towers"};
static const float SIDE_M = 0.2f;

static sbf_asset *make_box(void) {
  sbf_asset *asset = sbf_asset_create(NULL);
  sbf_rigid_body *body = asset ? sbf_asset_allocate(asset, 1, sizeof *body) : NULL;
  if (!body) bench_fail("memory ran out");
  sbf_rigid_body_init(body);
  body->id = "box";
  body->motion = SBF_BODY_MOTION_DYNAMIC;
  body->center = (sbf_vec3){0, 0.5f * SIDE_M, 0};
  body->mass = 1;
  body->hull = box_hull(asset, body->center, (sbf_vec3){SIDE_M, SIDE_M, SIDE_M});
  asset->rigid_bodies = (sbf_rigid_body_list){body, 1};
  return asset;
}

static sbr_world *make_world(const sbr_model *model, layout how, uint32_t count) {
  sbr_world_definition definition = sbr_default_world_definition();
  sbr_world *world;
  sbf_diagnostic error;
  uint32_t high = how == TOWERS ? HIGH : 1, wide = (uint32_t)ceil(sqrt((double)(count / high)));
  definition.sleep_after_s = 0;
  definition.character_capacity = count;
  bench_require(sbr_world_create(&definition, &world, &error), &error);
  if (how != ALONE) bench_require(sbr_world_enable_body_contacts(world, 16 * count, &error), &error);
  for (uint32_t i = 0; i < count; i++) {
    sbr_character_definition d = sbr_default_character_definition();
    sbr_character_id id;
    uint32_t tower = i / high;
    d.position = (sbr_double3){tower % wide, 0.001 + (double)(SIDE_M + 0.001f) * (i % high), tower / wide};
    bench_require(sbr_character_create(world, model, &d, &id, &error), &error);
  }
  return world;
}

static double tick_s(const sbr_model *model, layout how, uint32_t count, uint32_t ticks) {
  sbr_world *world = make_world(model, how, count);
  double *times = bench_allocate(ticks, sizeof *times);
  for (int i = 0; i < SETTLES; i++) sbr_world_tick(world);
  for (uint32_t i = 0; i < ticks; i++) {
    double begin = bench_now_s();
    sbr_world_tick(world);
    times[i] = bench_now_s() - begin;
  }
  double median = bench_spread_of(times, ticks).median;
  sbr_world_destroy(world);
  free(times);
  return median;
}

int main(int argc, char **argv) {
  bool quick = bench_is_quick(argc, argv);
  sbf_asset *asset = make_box();
  sbr_model *model;
  sbf_diagnostic error;
  bench_require(sbr_model_create(asset, NULL, &model, &error), &error);
  bench_print_columns("layout,boxes,touches,tick_us,box_us,touches_a_second,slope");
  for (int how = ALONE; how < LIKE_THIS; how++) {
    double before = 0;
    for (uint32_t count = 16; count <= (quick ? 16 : 1024); count *= 4) {
      double tick = tick_s(model, (layout)how, count, quick ? 3 : 60);
      uint32_t contacts = how == TOWERS ? 4 * (HIGH - 1) * (count / HIGH) : 0;
      bench_print_row("%s,%u,%u,%.1f,%.2f,%.0f,%.2f", layout_names[how], count, contacts, 1e6 * tick,
          1e6 * tick / count, contacts / tick, before > 0 ? log(tick / before) / log(4) : 0);
      before = tick;
    }
  }
  sbr_model_destroy(model);
  sbf_asset_free(asset);
  return 0;
}
