/* Measures the smallest soft character: a limb of 1 m that hangs from a wall, with 240 calibrated
 * tetrahedra and a skin of 962 vertices. It swings under its weight for two seconds.
 *
 * `frame_us` is the time of a control tick of 1/60 s (pinned points, substeps, ground contact query) and
 * of the skin's positions and normals. `tick_us` and `skin_us` are its parts, `worst_us` the slowest
 * frame. All runs are identical: the time of a frame is the minimum of the runs, and columns are means
 * over frames. `strain` is the maximum of any element at any tick. `residual` and `period_error` are
 * calibration's own estimates of the remaining difference to 20,000 elements. */
#define _DEFAULT_SOURCE
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <unistd.h>

#include "measuring.h"
#include "peer_files.h"
#include "sbfmt/asset.h"
#include "sbfmt/build.h"
#include "sbfmt/convert.h"
#include "sbrun/sbrun.h"

enum { RINGS = 41, AROUND = 24, TICKS = 120 };
static const double PI = 3.14159265358979323846;

/* ---- The limb ---- */

static void *allocate(sbf_asset *asset, size_t count, size_t size) {
  void *memory = sbf_asset_allocate(asset, count, size);
  if (!memory) bench_fail("memory ran out");
  return memory;
}

/* A round bar along +Z, thicker in its middle, with a point at the centre of each end. */
static sbf_asset *make_mesh(void) {
  sbf_asset *asset = sbf_asset_create(NULL);
  if (!asset) bench_fail("memory ran out");
  enum { POINTS = RINGS * AROUND + 2, QUADS = (RINGS - 1) * AROUND, FACES = QUADS + 2 * AROUND };
  sbf_vec3 *points = allocate(asset, POINTS, sizeof *points);
  uint32_t *sizes = allocate(asset, FACES, sizeof *sizes),
           *corners = allocate(asset, 4 * FACES, sizeof *corners);
  uint32_t *next = corners, face = 0;
  for (uint32_t r = 0; r < RINGS; r++)
    for (uint32_t k = 0; k < AROUND; k++) {
      double z = (double)r / (RINGS - 1), turn = 2 * PI * k / AROUND, radius = 0.09 + 0.02 * sin(PI * z);
      points[r * AROUND + k] = (sbf_vec3){(float)(radius * cos(turn)), (float)(radius * sin(turn)), (float)z};
    }
  points[POINTS - 2] = (sbf_vec3){0, 0, 0}, points[POINTS - 1] = (sbf_vec3){0, 0, 1};
  for (uint32_t r = 0; r + 1 < RINGS; r++)
    for (uint32_t k = 0; k < AROUND; k++) {
      uint32_t a = r * AROUND + k, b = r * AROUND + (k + 1) % AROUND;
      sizes[face++] = 4;
      *next++ = a, *next++ = b, *next++ = b + AROUND, *next++ = a + AROUND;
    }
  for (uint32_t k = 0; k < AROUND; k++) {
    uint32_t last = (RINGS - 1) * AROUND, other = (k + 1) % AROUND;
    sizes[face++] = 3;
    *next++ = POINTS - 2, *next++ = other, *next++ = k;
    sizes[face++] = 3;
    *next++ = POINTS - 1, *next++ = last + k, *next++ = last + other;
  }
  sbf_render_mesh *mesh = allocate(asset, 1, sizeof *mesh);
  sbf_render_mesh_init(mesh);
  mesh->id = "limb";
  mesh->mesh.positions = (sbf_vec3_list){points, POINTS};
  mesh->mesh.polygon_sizes = (sbf_u32_list){sizes, face};
  mesh->mesh.polygon_points = (sbf_u32_list){corners, (uint32_t)(next - corners)};
  asset->render_meshes = (sbf_render_mesh_list){mesh, 1};
  return asset;
}

/* Points in the first twentieth are pinned. */
static void hold_end(sbf_asset *asset) {
  sbf_soft_body *body = (sbf_soft_body *)(uintptr_t)asset->soft_bodies.at;
  sbf_pin_set *pins = allocate(asset, 1, sizeof *pins);
  uint32_t *pinned = allocate(asset, body->surface.positions.count, sizeof *pinned), count = 0;
  for (uint32_t i = 0; i < body->surface.positions.count; i++)
    if (body->surface.positions.at[i].z < 0.05f) pinned[count++] = i;
  sbf_pin_set_init(pins);
  pins->points = (sbf_u32_list){pinned, count};
  body->pins = (sbf_pin_set_list){pins, 1};
}

static sbf_asset *make_limb(float young_modulus) {
  char path[] = "/tmp/sbfmt-limb-XXXXXX.obj";
  int file = mkstemps(path, 4);
  sbf_asset *mesh = make_mesh(), *read, *built;
  sbf_diagnostic error;
  const sbf_build_options options = {.interior = SBF_BUILD_INTERIOR_TETRAHEDRA, .elements = 240};
  if (file < 0) bench_fail("no temporary file");
  close(file);
  write_obj(path, mesh);
  bench_require(sbf_convert(path, NULL, &read, &error), &error);
  unlink(path);
  hold_end(read);
  ((sbf_soft_body *)(uintptr_t)read->soft_bodies.at)->attributes.young_modulus = young_modulus;
  bench_require(sbf_build(read, &options, &built, NULL, &error), &error);
  sbf_asset_free(mesh);
  sbf_asset_free(read);
  return built;
}

/* ---- Running ---- */

typedef struct swing {
  sbr_model *model;
  double tick_s[TICKS], skin_s[TICKS];
  float strain;
  uint64_t hash;
} swing;

static void run_once(swing *s, const sbf_asset *asset, uint32_t ticks, uint32_t number) {
  uint32_t count = asset->render_meshes.at[0].mesh.positions.count;
  sbf_vec3 *skin = bench_allocate(2 * (size_t)count, sizeof *skin);
  sbf_diagnostic error;
  sbr_world *world;
  sbr_character_id id;
  sbr_world_definition definition = sbr_default_world_definition();
  sbr_character_definition standing = sbr_default_character_definition();
  standing.position.y = 3;
  bench_require(sbr_world_create(&definition, &world, &error), &error);
  bench_require(sbr_character_create(world, s->model, &standing, &id, &error), &error);
  for (uint32_t i = 0; i < ticks; i++) {
    double begin = bench_now_s();
    sbr_world_step(world, 1 / 60.0);
    double stepped = bench_now_s();
    sbr_character_get_skin(world, id, 0, skin, skin + count, NULL, count);
    double skinned = bench_now_s();
    if (number == 0 || stepped - begin < s->tick_s[i]) s->tick_s[i] = stepped - begin;
    if (number == 0 || skinned - stepped < s->skin_s[i]) s->skin_s[i] = skinned - stepped;
    if (number > 0) continue;
    sbr_body_health health = sbr_character_get_body_health(world, id, 0);
    if (!health.finite || health.inverted || health.recoveries) bench_fail("the limb lost its shape");
    s->strain = health.max_strain > s->strain ? health.max_strain : s->strain;
  }
  uint64_t hash = sbr_world_get_state_hash(world);
  if (number > 0 && hash != s->hash) bench_fail("two runs ended in different states");
  s->hash = hash;
  sbr_world_destroy(world);
  free(skin);
}

int main(int argument_count, char **arguments) {
  static const float moduli[] = {6e5f, 3e5f, 1.5e5f};
  bool quick = bench_is_quick(argument_count, arguments);
  bench_print_columns("young_modulus,elements,points,vertices,substeps,strain,residual,period_error,tick_us,"
                      "skin_us,frame_us,worst_us");
  for (uint32_t n = 0; n < (quick ? 1 : 3); n++) {
    sbf_asset *asset = make_limb(moduli[n]);
    const sbf_level *level = &asset->soft_bodies.at[0].levels.at[0];
    swing s = {.strain = 0};
    sbf_diagnostic error;
    uint32_t ticks = quick ? 4 : TICKS;
    double tick = 0, skin = 0, worst = 0;
    bench_require(sbr_model_create(asset, NULL, &s.model, &error), &error);
    for (uint32_t r = 0; r < (quick ? 2 : 15); r++) run_once(&s, asset, ticks, r);
    for (uint32_t i = 0; i < ticks; i++) {
      double frame = s.tick_s[i] + s.skin_s[i];
      tick += 1e6 * s.tick_s[i] / ticks, skin += 1e6 * s.skin_s[i] / ticks;
      worst = 1e6 * frame > worst ? 1e6 * frame : worst;
    }
    bench_print_row("%g,%u,%u,%u,%u,%.3f,%.3f,%.3f,%.2f,%.2f,%.2f,%.2f", (double)moduli[n],
        level->lattice.tetrahedra.count, level->positions.count,
        asset->render_meshes.at[0].mesh.positions.count, sbr_model_get_substeps(s.model), (double)s.strain,
        (double)level->calibration->residual, (double)level->calibration->period_error, tick, skin,
        tick + skin, worst);
    sbr_model_destroy(s.model);
    sbf_asset_free(asset);
  }
  return 0;
}
