#include "build/levels/calibrate.h"

#include <math.h>
#include <stdio.h>
#include <time.h>

#include "harness.h"
#include "shapes.h"

/* A beam of 1 x 0.2 x 0.2 m that is held at one end, as in every textbook. */
static sbf_soft_body *add_beam(sbf_asset *asset, uint32_t n) {
  sbf_polygon_mesh cube = shape_cube(asset, n, 0.2f, (sbf_vec3){0, 0, 0});
  sbf_vec3 *at = (sbf_vec3 *)(uintptr_t)cube.positions.at;
  for (uint32_t i = 0; i < cube.positions.count; i++) at[i].x = 5 * (at[i].x + 0.1f);
  sbf_soft_body *body = shape_add_body(asset, "beam", &cube, false);
  body->attributes.young_modulus = 1e6f;
  body->attributes.poisson_ratio = 0.4f;
  sbf_pin_set *pins = sbf_asset_allocate(asset, 1, sizeof *pins);
  uint32_t *held = sbf_asset_allocate(asset, cube.positions.count, sizeof *held), count = 0;
  for (uint32_t i = 0; i < cube.positions.count; i++)
    if (at[i].x < 1e-6f) held[count++] = i;
  sbf_pin_set_init(pins);
  pins->points = (sbf_u32_list){held, count};
  body->pins = (sbf_pin_set_list){pins, 1};
  return body;
}

START_TEST(probe)
{
  sbf_asset *asset = sbf_asset_create(NULL);
  const sbf_soft_body *body = add_beam(asset, 8);
  sbfi_reference r;
  clock_t t0 = clock();
  setvbuf(stdout, NULL, _IONBF, 0);
  ck_assert_int_eq(sbfi_reference_make(&r, body, asset, true, (sbfi_lattice_progress){0}, NULL), 0);
  printf("reference %.2f s, %u tets, lowest %.4g rad/s, sound %d yields %g %g %g\n",
      (double)(clock() - t0) / CLOCKS_PER_SEC, r.made.lattice.tetrahedra.count, sbfi_reference_frequency(&r),
      r.sound, r.yieldings[0], r.yieldings[1], r.yieldings[2]);
  for (uint32_t n = 30; n < 8000; n *= 2) {
    sbf_level level;
    sbfi_arena scratch;
    sbfi_arena_init(&scratch, NULL, 0);
    sbfi_lattice_counts counts;
    sbfi_lattice_recipe recipe = {.elements = n};
    ck_assert_int_eq(
        sbfi_lattice_level_make(&level, body, &recipe, asset, &counts, (sbfi_lattice_progress){0}, &scratch),
        0);
    sbfi_calibration c;
    t0 = clock();
    ck_assert(sbfi_level_calibrate(&level, body, NULL, &r, 1.0 / 60, asset, &c, NULL));
    printf("%u tets: factor %.3f residual %.3f period %+.3f error %.4f m cost %.0f, %.2f s\n",
        counts.tetrahedra, c.factor, c.residual, c.period_error, c.error, (double)level.simulation.cost,
        (double)(clock() - t0) / CLOCKS_PER_SEC);
    sbfi_arena_free(&scratch);
  }
  sbfi_reference_free(&r);
  sbf_asset_free(asset);
}
END_TEST

static Suite *suite(void) {
  Suite *s = suite_create("calibrate");
  TCase *c = tcase_create("calibrate");
  tcase_add_test(c, probe);
  suite_add_tcase(s, c);
  return s;
}

int main(void) {
  return harness_run(suite());
}
