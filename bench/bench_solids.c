/* Measures lattices of tetrahedra by size: nanoseconds per tetrahedron and substep, microseconds per frame of
 * 1/60 s.
 *
 * A beam of 1 x 0.2 x 0.2 m and 10 kPa, pinned at one end, sags under a twentieth of gravity. Its cells have
 * six tetrahedra each, from 10 x 2 x 2 to 160 x 32 x 32. It runs with the required number of substeps and
 * with twice as many; the difference is the full cost of the substeps: element forces, weight, damping,
 * ground, pins. `ns_per_element` is that per element. `slope` is the exponent of the cost of a substep
 * against the number of elements, relative to the previous row; 1: proportional. `frame_us` is a whole
 * control tick with the required substeps.
 *
 * Times are the minimum of many ticks, each repeated in several runs. Two runs must end in the same state. */
#include <math.h>
#include <stdio.h>
#include <stdlib.h>

#include "measuring.h"
#include "sbfmt/asset.h"
#include "sbrun/sbrun.h"

/* ---- The beam ---- */

static uint32_t point_at(const uint32_t cells[3], const uint32_t at[3]) {
  return at[0] + (cells[0] + 1) * (at[1] + (cells[1] + 1) * at[2]);
}

/* From a corner of the cell to the opposite one, an axis at a time; neighbours are mirrored. */
static sbf_uint4 *add_cell(sbf_uint4 *to, const uint32_t cells[3], const uint32_t cell[3]) {
  static const int orders[6][3] = {{0, 1, 2}, {1, 2, 0}, {2, 0, 1}, {0, 2, 1}, {2, 1, 0}, {1, 0, 2}};
  bool turned = (cell[0] + cell[1] + cell[2]) % 2;
  for (int o = 0; o < 6; o++, to++) {
    uint32_t at[3];
    for (int k = 0; k < 3; k++) at[k] = cell[k] + cell[k] % 2;
    bool swapped = (o >= 3) != turned;
    for (int k = 0; k < 4; k++) {
      to->at[k < 2 || !swapped ? k : 5 - k] = point_at(cells, at);
      if (k < 3) at[orders[o][k]] = 2 * cell[orders[o][k]] + 1 - at[orders[o][k]];
    }
  }
  return to;
}

static sbf_asset *make_beam(uint32_t along) {
  const uint32_t cells[3] = {along, along / 5, along / 5};
  uint32_t point_count = (cells[0] + 1) * (cells[1] + 1) * (cells[2] + 1);
  uint32_t count = 6 * cells[0] * cells[1] * cells[2], pinned_count = 0;
  sbf_asset *asset = sbf_asset_create(NULL);
  sbf_soft_body *body = asset ? sbf_asset_allocate(asset, 1, sizeof *body) : NULL;
  sbf_level *level = body ? sbf_asset_allocate(asset, 1, sizeof *level) : NULL;
  sbf_pin_set *pins = level ? sbf_asset_allocate(asset, 1, sizeof *pins) : NULL;
  sbf_vec3 *points = pins ? sbf_asset_allocate(asset, point_count, sizeof *points) : NULL;
  uint32_t *pinned = points ? sbf_asset_allocate(asset, point_count, sizeof *pinned) : NULL;
  sbf_uint4 *tetrahedra = pinned ? sbf_asset_allocate(asset, count, sizeof *tetrahedra) : NULL,
            *next = tetrahedra;
  if (!tetrahedra) bench_fail("memory ran out");
  for (uint32_t i = 0; i < point_count; i++) {
    uint32_t x = i % (cells[0] + 1), y = i / (cells[0] + 1) % (cells[1] + 1),
             z = i / (cells[0] + 1) / (cells[1] + 1);
    points[i] = (sbf_vec3){(float)x / (float)along, (float)y / (float)along, (float)z / (float)along};
    if (x == 0) pinned[pinned_count++] = i;
  }
  for (uint32_t z = 0; z < cells[2]; z++)
    for (uint32_t y = 0; y < cells[1]; y++)
      for (uint32_t x = 0; x < cells[0]; x++) next = add_cell(next, cells, (const uint32_t[3]){x, y, z});
  sbf_soft_body_init(body);
  sbf_level_init(level);
  sbf_pin_set_init(pins);
  body->id = "beam";
  body->attributes.young_modulus = 1e4f;
  body->attributes.poisson_ratio = 0.4f;
  body->attributes.gravity_scale = 0.05f;
  body->levels = (sbf_level_list){level, 1};
  level->model = SBF_ELASTIC_MODEL_TETRAHEDRA;
  level->positions = (sbf_vec3_list){points, point_count};
  level->lattice.tetrahedra = (sbf_uint4_list){tetrahedra, count};
  pins->points = (sbf_u32_list){pinned, pinned_count};
  level->pins = (sbf_pin_set_list){pins, 1};
  asset->soft_bodies = (sbf_soft_body_list){body, 1};
  return asset;
}

/* ---- Running ---- */

typedef struct beam_run {
  sbr_model *model;
  double *min; /* (ticks) s */
  uint32_t ticks;
  uint64_t hash;
} beam_run;

static void open_run(beam_run *r, const sbf_asset *asset, uint32_t substeps, uint32_t ticks) {
  sbf_diagnostic error;
  *r = (beam_run){.ticks = ticks, .min = bench_allocate(ticks, sizeof(double))};
  sbr_model_options options = sbr_default_model_options();
  options.substeps = substeps;
  bench_require(sbr_model_create(asset, &options, &r->model, &error), &error);
}

static void run_once(beam_run *r, uint32_t number) {
  sbf_diagnostic error;
  sbr_world *world;
  sbr_character_id character;
  sbr_world_definition definition = sbr_default_world_definition();
  sbr_character_definition standing = sbr_default_character_definition();
  standing.position.y = 2;
  bench_require(sbr_world_create(&definition, &world, &error), &error);
  bench_require(sbr_character_create(world, r->model, &standing, &character, &error), &error);
  for (uint32_t i = 0; i < r->ticks; i++) {
    double begin = bench_now_s();
    sbr_world_step(world, 1 / 60.0);
    double taken = bench_now_s() - begin;
    if (number == 0 || taken < r->min[i]) r->min[i] = taken;
  }
  sbr_body_health health = sbr_character_get_body_health(world, character, 0);
  if (!health.finite || health.inverted || health.recoveries) bench_fail("the beam lost its shape");
  uint64_t hash = sbr_world_get_state_hash(world);
  if (number > 0 && hash != r->hash) bench_fail("two runs ended in different states");
  r->hash = hash;
  sbr_world_destroy(world);
}

static double mean(const beam_run *r) {
  double sum = 0;
  for (uint32_t i = 0; i < r->ticks; i++) sum += r->min[i] / r->ticks;
  return sum;
}

static void close_run(beam_run *r) {
  free(r->min);
  sbr_model_destroy(r->model);
}

int main(int argument_count, char **arguments) {
  static const uint32_t lengths[] = {10, 20, 40, 80, 160};
  bool quick = bench_is_quick(argument_count, arguments);
  uint32_t max = quick ? 2 : 5;
  double before = 0, elements_before = 0;
  bench_print_columns("tetrahedra,points,substeps,ticks,runs,frame_us,substep_us,ns_per_element,slope");
  for (uint32_t n = 0; n < max; n++) {
    sbf_asset *asset = make_beam(lengths[n]);
    uint32_t elements = asset->soft_bodies.at[0].levels.at[0].lattice.tetrahedra.count;
    uint32_t ticks = quick ? 3 : elements > 500000 ? 4 : elements > 50000 ? 20 : 60, runs = quick ? 2 : 7;
    beam_run own, once, twice;
    open_run(&own, asset, 0, ticks);
    uint32_t substeps = sbr_model_get_substeps(own.model);
    open_run(&once, asset, substeps, ticks);
    open_run(&twice, asset, 2 * substeps, ticks);
    for (uint32_t r = 0; r < runs; r++) {
      run_once(r % 2 ? &twice : &own, r);
      run_once(&once, r);
      run_once(r % 2 ? &own : &twice, r);
    }
    double substep = (mean(&twice) - mean(&once)) / substeps;
    double slope = n ? log(substep / before) / log(elements / elements_before) : 1;
    bench_print_row("%u,%u,%u,%u,%u,%.2f,%.3f,%.2f,%.3f", elements,
        asset->soft_bodies.at[0].levels.at[0].positions.count, substeps, ticks, runs, mean(&own) * 1e6,
        substep * 1e6, substep * 1e9 / elements, slope);
    fflush(stdout);
    before = substep, elements_before = elements;
    close_run(&own);
    close_run(&once);
    close_run(&twice);
    sbf_asset_free(asset);
  }
  return 0;
}
