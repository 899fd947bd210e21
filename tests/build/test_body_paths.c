#include "build/weights/body_paths.h"

#include <math.h>
#include <string.h>

#include "harness.h"

enum { ROW = 64 };

/* A body of one row of cells along x. */
static void make_row(sbfi_body_grid *g, sbfi_arena *arena) {
  *g = (sbfi_body_grid){.counts = {ROW + 2, 3, 3}, .box_count = (ROW + 2) * 9, .cell_count = ROW};
  g->cell_of_box = sbfi_arena_allocate(arena, g->box_count, sizeof *g->cell_of_box);
  g->box_of_cell = sbfi_arena_allocate(arena, ROW, sizeof *g->box_of_cell);
  ck_assert(g->cell_of_box && g->box_of_cell);
  memset(g->cell_of_box, 0xff, g->box_count * sizeof *g->cell_of_box);
  for (uint32_t i = 0; i < ROW; i++) {
    g->box_of_cell[i] = (3 + 1) * (ROW + 2) + 1 + i;
    g->cell_of_box[g->box_of_cell[i]] = (int32_t)i;
  }
  int direction = 0;
  for (int z = -1; z <= 1; z++)
    for (int y = -1; y <= 1; y++)
      for (int x = -1; x <= 1; x++) {
        if (!x && !y && !z) continue;
        g->steps[direction] = (z * 3 + y) * (ROW + 2) + x;
        g->lengths[direction++] = (float)sqrt(x * x + y * y + z * z);
      }
}

static sbfi_bone_segment point_at(double cell) {
  sbfi_d3 at = {(cell + 0.5) / SBFI_BODY_CELLS, 0.5 / SBFI_BODY_CELLS, 0.5 / SBFI_BODY_CELLS};
  return (sbfi_bone_segment){.head = at, .tail = at};
}

static void check_from(double bone, double link, bool has_link) {
  sbfi_arena arena;
  sbfi_body_grid grid;
  sbfi_body_paths paths;
  const sbfi_bone_segment segments[] = {point_at(bone), point_at(link)};
  sbfi_arena_init(&arena, NULL, 0);
  make_row(&grid, &arena);
  ck_assert(sbfi_body_paths_make(&paths, &grid, &arena));
  sbfi_body_paths_from(&paths, segments, has_link ? 2 : 1);
  for (uint32_t i = 0; i < ROW; i++) {
    double outside = fmax(bone - (ROW - 1), 0), expected = outside + fabs(i - fmin(bone, ROW - 1));
    if (has_link) expected = fmin(expected, fabs(i - link));
    ck_assert_double_eq_tol((double)paths.distances[i], expected, 1e-3);
  }
  sbfi_arena_free(&arena);
}

START_TEST(a_bone_inside)
{ check_from(10, 0, false); }
END_TEST

/* At any distance: its cell is visited in order, also after those of an inner link. */
START_TEST(a_bone_far_outside)
{
  for (double away = 0.5; away < 600; away += 8.25) {
    check_from(ROW - 1 + away, 0, false);
    check_from(ROW - 1 + away, 0, true);
    check_from(ROW - 1 + away, 40, true);
  }
}
END_TEST

int main(void) {
  Suite *s = suite_create("body_paths");
  TCase *c = tcase_create("body_paths");
  tcase_add_test(c, a_bone_inside);
  tcase_add_test(c, a_bone_far_outside);
  suite_add_tcase(s, c);
  return harness_run(s);
}
