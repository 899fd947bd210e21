#include "tune/decimated_skin.h"

#include <math.h>
#include <stdlib.h>

#include "harness.h"
#include "sbfmt/mechanics.h"
#include "skinned_limb.h"

enum { MAX_VERTICES = 2000 };

static double volume_of(const sbf_asset *asset) {
  sbf_surface_measures measures;
  sbf_surface_measure(&asset->render_meshes.at[0].mesh, NULL, &measures);
  return measures.volume;
}

static void ignore(void *user, const sbf_diagnostic *diagnostic) {
  (void)user, (void)diagnostic;
}

static sbf_asset *dense_limb(float radius) {
  const skinned_limb of = {.bones = 4, .sides = 100, .rings_a_bone = 100, .radius = radius, .seam = true};
  return skinned_limb_make(&of);
}

/* 40,000 vertices become at most 2000 at any size, without holes and with each bone's region. */
START_TEST(a_dense_limb)
{
  for (float radius = 0.1f; radius < 2; radius *= 3) {
    sbf_asset *source = dense_limb(radius), *made = tune_decimate_skins(source, MAX_VERTICES);
    ck_assert_ptr_nonnull(made);
    ck_assert_uint_gt(tune_count_vertices(source), 40000);
    ck_assert_uint_le(tune_count_vertices(made), MAX_VERTICES);
    ck_assert_uint_gt(tune_count_vertices(made), MAX_VERTICES / 4);
    ck_assert_double_eq_tol(volume_of(made) / volume_of(source), 1, 0.05);
    const sbf_render_mesh *mesh = &made->render_meshes.at[0];
    ck_assert_uint_eq(sbf_asset_check(made, ignore, NULL, 1), sbf_asset_check(source, ignore, NULL, 1));
    ck_assert_uint_eq(mesh->skin->influence_counts.count, mesh->mesh.positions.count);
    for (uint32_t v = 0, i = 0; v < mesh->mesh.positions.count; i += mesh->skin->influence_counts.at[v++])
      for (uint32_t k = i; k < i + mesh->skin->influence_counts.at[v]; k++)
        if (mesh->skin->weights.at[k] > 0.5f) {
          /* The seam between two bones is a vertex's half spacing off. */
          double above = (double)mesh->mesh.positions.at[v].y - mesh->skin->bones.at[k];
          ck_assert_double_ge(above, -0.011);
          ck_assert_double_le(above, 1.011);
        }
    sbf_asset_free(made);
    sbf_asset_free(source);
  }
}
END_TEST

START_TEST(pins_stay_where_they_are)
{
  sbf_asset *source = dense_limb(0.2f);
  sbf_render_mesh *mesh = (sbf_render_mesh *)(uintptr_t)&source->render_meshes.at[0];
  uint32_t count = mesh->mesh.positions.count / 4;
  uint32_t *points = sbf_asset_allocate(source, count, sizeof *points);
  float *weights = sbf_asset_allocate(source, count, sizeof *weights);
  sbf_pin_set *set = sbf_asset_allocate(source, 1, sizeof *set);
  ck_assert(points && weights && set);
  for (uint32_t i = 0; i < count; i++) points[i] = i, weights[i] = 0.25f; /* the lowest quarter */
  sbf_pin_set_init(set);
  set->points = (sbf_u32_list){points, count};
  set->weights = (sbf_f32_list){weights, count};
  mesh->pins = (sbf_pin_set_list){set, 1};
  sbf_asset *made = tune_decimate_skins(source, MAX_VERTICES);
  ck_assert_ptr_nonnull(made);
  const sbf_render_mesh *coarse = &made->render_meshes.at[0];
  ck_assert_uint_eq(coarse->pins.count, 1);
  const sbf_pin_set *pins = &coarse->pins.at[0];
  ck_assert_uint_eq(pins->weights.count, pins->points.count);
  uint32_t below = 0;
  for (uint32_t v = 0; v < coarse->mesh.positions.count; v++) below += coarse->mesh.positions.at[v].y < 0.9f;
  ck_assert_uint_ge(pins->points.count, below);
  for (uint32_t i = 0; i < pins->points.count; i++) {
    ck_assert_float_lt(coarse->mesh.positions.at[pins->points.at[i]].y, 1.1f);
    ck_assert_float_eq(pins->weights.at[i], 0.25f);
    for (uint32_t k = 0; k < i; k++) ck_assert_uint_ne(pins->points.at[k], pins->points.at[i]);
  }
  sbf_asset_free(made);
  sbf_asset_free(source);
}
END_TEST

/* Vertices without polygons or extent end the search, too. */
START_TEST(points_alone)
{
  for (int spread = 0; spread < 2; spread++) {
    sbf_asset *source = dense_limb(0.2f);
    sbf_render_mesh *mesh = (sbf_render_mesh *)(uintptr_t)&source->render_meshes.at[0];
    sbf_vec3 *at = (sbf_vec3 *)(uintptr_t)mesh->mesh.positions.at;
    mesh->mesh.polygon_sizes.count = mesh->mesh.polygon_points.count = 0;
    for (uint32_t v = 0; !spread && v < mesh->mesh.positions.count; v++) at[v] = (sbf_vec3){3, 4, 5};
    sbf_asset *made = tune_decimate_skins(source, MAX_VERTICES);
    ck_assert_ptr_nonnull(made);
    ck_assert_uint_le(tune_count_vertices(made), MAX_VERTICES);
    ck_assert_uint_ge(tune_count_vertices(made), 4); /* one for each bone */
    sbf_asset_free(made);
    sbf_asset_free(source);
  }
}
END_TEST

int main(void) {
  Suite *s = suite_create("decimated_skin");
  TCase *c = tcase_create("decimated_skin");
  tcase_add_test(c, a_dense_limb);
  tcase_add_test(c, pins_stay_where_they_are);
  tcase_add_test(c, points_alone);
  suite_add_tcase(s, c);
  return harness_run(s);
}
