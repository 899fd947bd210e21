/* Compares a crowd of 200 walking lizards before a moving camera at full detail with the same crowd with
 * automatic detail levels (sbrun/detail.h). Both worlds take the same ticks one after the other. `ms_tick`
 * is the mean processor time of a tick on one thread. Every tenth tick the visible vertices are compared
 * with full detail, projected on a screen of 1080 lines and 60 degrees: `rms_px` over all,
 * `worst_lizard_px` the largest root mean square of a lizard, `worst_px` the largest error of a vertex.
 * Lizards that were off screen continue with another gait phase; they are not compared but counted
 * (`returned`, mean). `visits` is the world's estimate of the cost of a tick. The columns from soft to
 * away are mean numbers of lizards on those detail levels. `mb` is the mean memory of the world and its
 * characters, `mb_most` the maximum, including their creation. In the last cases the lizards stand closer
 * and collide; they are compared with lizards at full detail, made of springs (one soft level) or
 * tetrahedra (three). `coarser` counts soft lizards that are not on the finest level. */
#include <math.h>
#include <stdio.h>
#include <stdlib.h>

#include "crowd/crowd_camera.h"
#include "measured_assets.h"
#include "measuring.h"
#include "sbfmt/build.h"
#include "sbrun/collision.h"
#include "sbrun/detail.h"

enum { MAX = 200, CONTACT_CAPACITY = 40, LATTICES = 20, CASES = 8, COMPARED_EVERY = 10 };

/* Who they are. */
typedef struct species {
  sbf_asset *asset;
  sbr_model *model;
  sbr_detail_level detail_levels[16];
  uint32_t detail_level_count, vertex_count; /* of all skins */
} species;

typedef struct crowd {
  const char *name;
  const species *of;
  const struct crowd *full; /* that it is compared with; itself: it is */
  uint32_t count;
  sbf_allocator allocator;
  size_t retained, max; /* bytes */
  sbr_world *world;
  sbr_character_id ids[MAX];
  bool was_away[MAX];
  double seconds, visits, detail_levels[4], coarser, returned, bytes;
  double squares, worst_square, worst_lizard; /* pixels squared */
  uint64_t vertices;
  uint32_t ticks, styles;
} crowd;

static void *counted(void *user, void *memory, size_t old_size, size_t new_size) {
  crowd *c = user;
  void *moved = new_size ? realloc(memory, new_size) : NULL;
  if (!new_size) free(memory);
  if (new_size && !moved) return NULL;
  c->retained += new_size - (memory ? old_size : 0);
  if (c->retained > c->max) c->max = c->retained;
  return moved;
}

static void open_species(species *of, const sbf_asset *source, const sbf_build_options *built) {
  sbf_diagnostic error;
  sbr_model_options options = sbr_default_model_options();
  options.detail_levels = true;
  bench_require(sbf_build(source, built, &of->asset, NULL, &error), &error);
  bench_require(sbr_model_create(of->asset, &options, &of->model, &error), &error);
  of->detail_level_count = sbr_model_get_detail_levels(of->model, of->detail_levels, 16);
  of->vertex_count = vertex_count_of(of->asset);
}

/* `detail`: NULL for all of it. All who are chosen for begin as bones. */
static void open_crowd(crowd *c, const char *name, const crowd *full, const species *of, uint32_t count,
    bool collides, const sbr_detail_definition *detail) {
  sbf_diagnostic error;
  sbr_world_definition definition = sbr_default_world_definition();
  *c = (crowd){.name = name, .of = of, .full = full, .count = count, .allocator = {counted, c}};
  definition.character_capacity = count;
  definition.allocator = &c->allocator;
  bench_require(sbr_world_create(&definition, &c->world, &error), &error);
  if (detail) bench_require(sbr_world_select_detail_levels(c->world, detail, &error), &error);
  if (collides) bench_require(sbr_world_enable_body_contacts(c->world, 0, &error), &error);
  for (uint32_t i = 0; i < count; i++) {
    sbr_character_definition at = collides ? crowd_arrange_close(i) : crowd_arrange(i);
    if (detail) at.detail_level = of->detail_level_count - 2;
    bench_require(sbr_character_create(c->world, of->model, &at, &c->ids[i], &error), &error);
    crowd_drive(c->world, c->ids[i], i);
  }
}

/* The skin in the world, all meshes behind each other; returns how many vertices. */
static uint32_t read_skin(const crowd *c, uint32_t i, sbf_vec3 *to) {
  uint32_t count = 0, capacity = c->of->vertex_count;
  for (uint32_t m = 0; m < c->of->asset->render_meshes.count; m++)
    count += sbr_character_get_skin(c->world, c->ids[i], m, to + count, NULL, NULL, capacity - count);
  return count;
}

static void compare_lizard(crowd *c, uint32_t i, const sbr_view *view, sbf_vec3 *positions[2]) {
  const crowd *full = c->full;
  sbr_double3 origins[2] = {
      sbr_character_get_origin(full->world, full->ids[i]), sbr_character_get_origin(c->world, c->ids[i])};
  double sum = 0, at[2][2];
  uint32_t seen = 0, count = read_skin(full, i, positions[0]);
  read_skin(c, i, positions[1]);
  for (uint32_t v = 0; v < count; v++) {
    bool within = true;
    for (int k = 0; k < 2; k++)
      within = within && crowd_project(view, origins[k].x + (double)positions[k][v].x,
                             origins[k].y + (double)positions[k][v].y,
                             origins[k].z + (double)positions[k][v].z, &at[k][0], &at[k][1]);
    if (!within) continue;
    double x = at[1][0] - at[0][0], y = at[1][1] - at[0][1], square = x * x + y * y;
    sum += square, seen++;
    if (square > c->worst_square) c->worst_square = square;
  }
  if (!seen) return;
  c->squares += sum, c->vertices += seen;
  if (sum / seen > c->worst_lizard) c->worst_lizard = sum / seen;
}

static void compare(crowd *c, const sbr_view *view, sbf_vec3 *positions[2]) {
  c->styles++;
  for (uint32_t i = 0; i < c->count; i++) {
    c->returned += c->was_away[i];
    if (!c->was_away[i]) compare_lizard(c, i, view, positions);
  }
}

static void step(crowd *c, const sbr_view *view, bool counts) {
  double begin = bench_now_s();
  sbr_world_set_views(c->world, view, 1);
  sbr_world_tick(c->world);
  double taken = bench_now_s() - begin;
  for (uint32_t i = 0; i < c->count; i++) {
    uint32_t number = sbr_character_get_detail_level(c->world, c->ids[i]);
    const sbr_detail_level *detail_level = &c->of->detail_levels[number];
    c->was_away[i] = c->was_away[i] || detail_level->kind == SBR_DETAIL_OFFSCREEN;
    if (!counts) continue;
    c->detail_levels[detail_level->kind]++, c->visits += (double)detail_level->visits;
    if (detail_level->kind == SBR_DETAIL_SOFT && number > 0) c->coarser++;
  }
  if (counts) c->seconds += taken, c->bytes += (double)c->retained, c->ticks++;
}

static void report(const crowd *c) {
  double ticks = c->ticks, vertices = c->vertices ? (double)c->vertices : 1;
  bench_print_row("%s,%u,%.2f,%.1f,%.0f,%.3f,%.3f,%.2f,%.1f,%.1f,%.1f,%.1f,%.1f,%.1f,%.0f,%.0f", c->name,
      c->count, 1e3 * c->seconds / ticks, c->full->seconds / c->seconds, c->visits / ticks,
      sqrt(c->squares / vertices), sqrt(c->worst_lizard), sqrt(c->worst_square),
      c->detail_levels[SBR_DETAIL_SOFT] / ticks, c->coarser / ticks,
      c->detail_levels[SBR_DETAIL_JIGGLE] / ticks, c->detail_levels[SBR_DETAIL_BONES] / ticks,
      c->detail_levels[SBR_DETAIL_OFFSCREEN] / ticks, c->styles ? c->returned / c->styles : 0,
      c->bytes / ticks / 1e6, (double)c->max / 1e6);
}

int main(int argument_count, char **arguments) {
  bool quick = bench_is_quick(argument_count, arguments);
  uint32_t count = quick ? 6 : MAX, shape_pair = quick ? 4 : CONTACT_CAPACITY,
           lattices = quick ? 4 : LATTICES, ticks = quick ? 12 : 210;
  uint32_t first = quick ? 2 : 30;
  sbf_asset *source = our_lizard(false);
  static species springs, tetrahedra;
  open_species(&springs, source, &(sbf_build_options){.levels = 2});
  open_species(
      &tetrahedra, source, &(sbf_build_options){.interior = SBF_BUILD_INTERIOR_TETRAHEDRA, .levels = 4});
  sbr_detail_definition stays = sbr_default_detail_definition(), goes = stays, spares = stays;
  stays.offscreen_after_s = -1;
  spares.offscreen_after_s = -1, spares.budget_us = 4000;
  static crowd c[CASES];
  open_crowd(&c[0], "full detail", &c[0], &springs, count, false, NULL);
  open_crowd(&c[1], "half a pixel", &c[0], &springs, count, false, &stays);
  open_crowd(&c[2], "and away where unseen", &c[0], &springs, count, false, &goes);
  open_crowd(&c[3], "half a pixel or 4 ms", &c[0], &springs, count, false, &spares);
  open_crowd(&c[4], "meeting at full detail", &c[4], &springs, shape_pair, true, NULL);
  open_crowd(&c[5], "meeting at half a pixel", &c[4], &springs, shape_pair, true, &stays);
  open_crowd(&c[6], "lattices meeting at full detail", &c[6], &tetrahedra, lattices, true, NULL);
  open_crowd(&c[7], "lattices meeting at half a pixel", &c[6], &tetrahedra, lattices, true, &stays);
  sbf_vec3 *positions[2];
  uint32_t max =
      springs.vertex_count > tetrahedra.vertex_count ? springs.vertex_count : tetrahedra.vertex_count;
  for (int k = 0; k < 2; k++) positions[k] = bench_allocate(max + 1, sizeof *positions[k]);
  for (uint32_t t = 0; t < ticks; t++) {
    sbr_view view = crowd_view(t, ticks);
    for (int k = 0; k < CASES; k++) step(&c[k], &view, t >= first);
    for (int k = 0; k < CASES && t >= first && t % COMPARED_EVERY == 0; k++)
      if (c[k].full != &c[k]) compare(&c[k], &view, positions);
  }
  bench_print_columns(
      "case,lizards,ms_tick,times_full,visits,rms_px,worst_lizard_px,worst_px,soft,coarser,jiggle,"
      "bones,away,returned,mb,mb_most");
  for (int k = 0; k < CASES; k++) report(&c[k]);
  for (int k = 0; k < CASES; k++) sbr_world_destroy(c[k].world);
  for (int k = 0; k < 2; k++) free(positions[k]);
  for (int k = 0; k < 2; k++) {
    const species *of = k ? &tetrahedra : &springs;
    sbr_model_destroy(of->model);
    sbf_asset_free(of->asset);
  }
  sbf_asset_free(source);
  return 0;
}
