#include "build/weights/body_grid.h"

#include <stdlib.h>

#include "harness.h"
#include "rigged_tubes.h"

/* A square of side 1 at a height, of two triangles. */
static void add_sheet(rigged_tubes *to, float height) {
  uint32_t first = to->point_count;
  for (uint32_t i = 0; i < 4; i++)
    to->points[to->point_count++] = (sbf_vec3){i == 1 || i == 2 ? 1 : 0, height, i >= 2 ? 1 : 0};
  for (uint32_t t = 0; t < 2; t++) {
    uint32_t *corners = to->triangles[to->triangle_count++];
    corners[0] = first, corners[1] = first + 1 + t, corners[2] = first + 2 + t;
  }
}

/* Stacked sheets have a winding number above a half even below the lowest one, in the margin. */
START_TEST(the_margin_stays_empty)
{
  sbfi_arena arena;
  sbfi_weight_mesh mesh;
  sbfi_body_rays rays;
  sbfi_body_grid grid;
  rigged_tubes *tubes = calloc(1, sizeof *tubes);
  ck_assert_ptr_nonnull(tubes);
  for (int i = 0; i < 5; i++) add_sheet(tubes, 0.001f * (float)i);
  tubes_add_bone(tubes, "bone", SBF_NONE, (sbfi_d3){0, 0, 0.5}, (sbfi_d3){1, 0, 0.5});
  const sbfi_weights_input in = tubes_input(tubes);
  sbfi_arena_init(&arena, NULL, 0);
  ck_assert_int_eq(sbfi_weight_mesh_make(&mesh, &in, &arena), SBFI_WEIGHT_MESH_GOOD);
  uint32_t *sizes = sbfi_arena_allocate(&arena, mesh.triangle_count, sizeof *sizes);
  ck_assert_ptr_nonnull(sizes);
  for (uint32_t t = 0; t < mesh.triangle_count; t++) sizes[t] = 3;
  const sbf_polygon_mesh surface = sbfi_weight_mesh_surface(&mesh, sizes);
  ck_assert(sbfi_body_rays_make(&rays, &surface, &arena));
  ck_assert(sbfi_body_contains(&rays, (sbfi_d3){0.5, -0.01, 0.5}));
  ck_assert(sbfi_body_grid_make(&grid, &mesh, &rays, &arena));
  ck_assert_uint_gt(grid.cell_count, 0);
  for (uint32_t cell = 0; cell < grid.cell_count; cell++) {
    uint32_t box = grid.box_of_cell[cell];
    const uint32_t at[3] = {
        box % grid.counts[0], box / grid.counts[0] % grid.counts[1], box / grid.counts[0] / grid.counts[1]};
    for (int k = 0; k < 3; k++) {
      ck_assert_uint_gt(at[k], 0);
      ck_assert_uint_lt(at[k] + 1, grid.counts[k]);
    }
  }
  sbfi_arena_free(&arena);
  free(tubes);
}
END_TEST

int main(void) {
  Suite *s = suite_create("body_grid");
  TCase *c = tcase_create("body_grid");
  tcase_add_test(c, the_margin_stays_empty);
  suite_add_tcase(s, c);
  return harness_run(s);
}
