#include "build/lattice/lattice_stuffing.h"

#include <math.h>
#include <stdlib.h>

#include "harness.h"
#include "sbfmt/mechanics.h"

static uint64_t state;
static double random_share(void) {
  state ^= state << 13;
  state ^= state >> 7;
  state ^= state << 17;
  return (double)(state >> 11) / 9007199254740992.0;
}

/* Random signs, cuts anywhere, many of them just inside or outside the distance at which a node is warped:
 * worse than any surface. */
static void make_at_random(const sbfi_lattice_grid *grid, sbfi_arena *arena, sbfi_tetrahedra *made) {
  uint8_t *inside = sbfi_arena_allocate(arena, grid->node_count, 1);
  double density = random_share();
  ck_assert_ptr_nonnull(inside);
  for (uint32_t n = 0; n < grid->node_count; n++) {
    int32_t at[3];
    sbfi_lattice_compute_coordinates(grid, n, at);
    bool within = true;
    for (int k = 0; k < 3; k++) within &= at[k] >= 4 && at[k] <= 16;
    inside[n] = within && random_share() < density;
  }
  sbfi_lattice_cuts cuts;
  ck_assert(sbfi_lattice_cuts_find(&cuts, grid, inside, arena));
  for (size_t s = 0; s < cuts.slot_count; s++) {
    static const double edges[2] = {0.4, 0.28};
    if (cuts.edges[s] == UINT32_MAX) continue;
    double limit = edges[(cuts.edges[s] & 7) < SBFI_LATTICE_LONG_EDGES], pick = random_share(), tiny = 1e-6;
    double fraction = pick < 0.3   ? limit + tiny
                      : pick < 0.6 ? 1 - limit - tiny
                      : pick < 0.7 ? limit - tiny
                      : pick < 0.8 ? 1 - limit + tiny
                                   : random_share();
    cuts.fractions[s] = (float)fraction;
  }
  ck_assert(sbfi_lattice_stuff(grid, inside, &cuts, made, arena, arena));
}

typedef struct face {
  uint32_t points[3];
  int side;
} face;

static int compare(const void *a, const void *b) {
  const face *x = a, *y = b;
  for (int k = 0; k < 3; k++)
    if (x->points[k] != y->points[k]) return x->points[k] < y->points[k] ? -1 : 1;
  return 0;
}

/* Every face belongs to one tetrahedron, or to two on opposite sides: no two diagonals cross, and no
 * tetrahedron is repeated. */
static void check_conforming(const sbfi_tetrahedra *made) {
  static const int corners[4][3] = {{1, 2, 3}, {0, 3, 2}, {0, 1, 3}, {0, 2, 1}};
  face *faces = malloc(4 * (size_t)made->count * sizeof *faces + 1);
  size_t count = 0;
  for (uint32_t t = 0; t < made->count; t++) {
    for (int f = 0; f < 4; f++) {
      face *at = &faces[count++];
      at->side = 1;
      for (int k = 0; k < 3; k++) at->points[k] = made->at[t].at[corners[f][k]];
      for (int i = 0; i < 3; i++) {
        int k = i == 2 ? 0 : i;
        if (at->points[k] < at->points[k + 1]) continue;
        uint32_t swap = at->points[k];
        at->points[k] = at->points[k + 1];
        at->points[k + 1] = swap;
        at->side = -at->side;
      }
    }
  }
  qsort(faces, count, sizeof *faces, compare);
  for (size_t i = 0; i < count;) {
    size_t same = 1;
    int sum = faces[i].side;
    while (i + same < count && compare(&faces[i], &faces[i + same]) == 0) sum += faces[i + same++].side;
    ck_assert_uint_le(same, 2);
    if (same == 2) ck_assert_int_eq(sum, 0);
    i += same;
  }
  free(faces);
}

static void check_volume(const sbfi_tetrahedra *made, double max) {
  sbf_lattice_measures quality;
  sbf_lattice_measure(made->positions, made->at, made->count, &quality);
  ck_assert_double_le(quality.volume, max);
  ck_assert_double_ge(quality.min_dihedral_deg, 10);
  ck_assert_double_le(quality.max_dihedral_deg, 165);
}

START_TEST(any_surface_gives_a_valid_lattice)
{
  sbfi_lattice_grid grid;
  size_t count = 0;
  state = 88172645463325252u;
  ck_assert(sbfi_lattice_grid_fit(&grid, (sbfi_d3){0, 0, 0}, (sbfi_d3){6, 6, 6}, 1));
  for (int round = 0; round < 60; round++) {
    sbfi_arena arena;
    sbfi_tetrahedra made;
    sbfi_arena_init(&arena, NULL, 0);
    make_at_random(&grid, &arena, &made);
    count += made.count;
    ck_assert_uint_eq(made.flat_count, 0);
    check_conforming(&made);
    check_volume(&made, 8 * 8 * 8);
    sbfi_arena_free(&arena);
  }
  ck_assert_uint_gt(count, 10000);
}
END_TEST

START_TEST(an_all_inside_lattice_is_the_grid)
{
  sbfi_lattice_grid grid;
  sbfi_arena arena;
  sbfi_lattice_cuts cuts;
  sbfi_tetrahedra made;
  sbfi_arena_init(&arena, NULL, 0);
  ck_assert(sbfi_lattice_grid_fit(&grid, (sbfi_d3){0, 0, 0}, (sbfi_d3){4, 3, 2}, 1));
  uint8_t *inside = sbfi_arena_allocate(&arena, grid.node_count, 1);
  /* One middle, and nothing else: its cut edges all at two fifths and more. */
  inside[sbfi_lattice_node(&grid, 7, 7, 7)] = 1;
  ck_assert(sbfi_lattice_cuts_find(&cuts, &grid, inside, &arena));
  ck_assert_uint_eq(cuts.count, 14);
  for (size_t s = 0; s < cuts.slot_count; s++) cuts.fractions[s] = 0.5f;
  ck_assert(sbfi_lattice_stuff(&grid, inside, &cuts, &made, &arena, &arena));
  ck_assert_uint_eq(made.count, 24); /* tetrahedra at a node */
  ck_assert_uint_eq(made.point_count, 15);
  check_conforming(&made);
  sbfi_arena_free(&arena);
}
END_TEST

START_TEST(edges_end_at_the_stated_nodes)
{
  sbfi_lattice_grid grid;
  ck_assert(sbfi_lattice_grid_fit(&grid, (sbfi_d3){-1, 0, 2}, (sbfi_d3){3, 2, 5}, 0.5));
  ck_assert_uint_eq(grid.counts[0], 13);
  ck_assert_double_eq_tol(grid.origin.x, -2, 1e-12);
  for (int32_t kind = 0; kind < 2; kind++) {
    uint32_t node = sbfi_lattice_node(&grid, 6 + kind, 4 + kind, 8 + kind);
    int32_t at[3], there[3];
    sbfi_lattice_compute_coordinates(&grid, node, at);
    ck_assert_int_eq(at[0], 6 + kind);
    ck_assert_uint_eq(sbfi_lattice_kind(&grid, node), (uint32_t)kind);
    for (int k = 0; k < SBFI_LATTICE_EDGES; k++) {
      sbfi_lattice_compute_coordinates(&grid, (uint32_t)((int64_t)node + grid.steps[kind][k]), there);
      for (int axis = 0; axis < 3; axis++)
        ck_assert_int_eq(there[axis] - at[axis], sbfi_lattice_directions[k][axis]);
    }
  }
  ck_assert(!sbfi_lattice_grid_fit(&grid, (sbfi_d3){0, 0, 0}, (sbfi_d3){1, 1, 1}, 1e-3 / 2));
}
END_TEST

int main(void) {
  Suite *s = suite_create("lattice_stuffing");
  TCase *c = tcase_create("lattice_stuffing");
  tcase_add_test(c, any_surface_gives_a_valid_lattice);
  tcase_add_test(c, an_all_inside_lattice_is_the_grid);
  tcase_add_test(c, edges_end_at_the_stated_nodes);
  suite_add_tcase(s, c);
  return harness_run(s);
}
