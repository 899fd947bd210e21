#include "build/levels/loose_pieces.h"

#include "harness.h"

/* Two springs in a row, 0-1-2, a heavier pair 3-4 and a point of its own, 5. */
static const sbf_uint2 ends[] = {{{0, 1}}, {{1, 2}}, {{4, 3}}};
static float masses[6];
static sbfi_arena arena;

static sbf_spring_network network(void) {
  const float all[6] = {1, 1, 1, 4, 4, 0.5f};
  for (int i = 0; i < 6; i++) masses[i] = all[i];
  return (sbf_spring_network){.point_count = 6, .spring_count = 3, .ends = ends, .masses = masses};
}

static void setup(void) {
  sbfi_arena_init(&arena, NULL, 0);
}
static void teardown(void) {
  sbfi_arena_free(&arena);
}

static void check(const char *kept, double expected_kg, double loose_kg) {
  for (int i = 0; i < 6; i++) ck_assert_msg((masses[i] > 0) == (kept[i] == '1'), "point %d", i);
  ck_assert_double_eq_tol(loose_kg, expected_kg, 1e-9);
}

START_TEST(the_heaviest_unpinned_piece_is_kept)
{
  double loose_kg;
  sbf_spring_network n = network();
  ck_assert(sbfi_loose_pieces_pin(&n, false, masses, &loose_kg, &arena));
  check("000110", 3.5, loose_kg);
}
END_TEST

START_TEST(pieces_on_a_pinned_point_are_kept)
{
  double loose_kg;
  sbf_spring_network n = network();
  masses[2] = 0;
  ck_assert(sbfi_loose_pieces_pin(&n, true, masses, &loose_kg, &arena));
  check("110000", 8.5, loose_kg);
}
END_TEST

START_TEST(a_goal_counts_as_a_pin)
{
  double loose_kg;
  float anchors[6] = {0, 0, 0, 0, 10, 0};
  sbf_spring_network n = network();
  n.anchors = anchors;
  ck_assert(sbfi_loose_pieces_pin(&n, true, masses, &loose_kg, &arena));
  check("000110", 3.5, loose_kg);
}
END_TEST

START_TEST(tetrahedra_join_too)
{
  double loose_kg;
  const sbf_uint4 corners[] = {{{5, 4, 2, 0}}};
  sbf_spring_network n = network();
  n.tetrahedra = corners, n.tetrahedron_count = 1;
  ck_assert(sbfi_loose_pieces_pin(&n, false, masses, &loose_kg, &arena));
  check("111111", 0, loose_kg);
}
END_TEST

/* A square of springs with its diagonal, and an unpinned pair. */
static bool turns(const char *pinned) {
  static const sbf_uint2 sides[] = {{{0, 1}}, {{1, 2}}, {{2, 3}}, {{3, 0}}, {{0, 2}}, {{4, 5}}};
  static const sbf_vec3 at[] = {{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}, {9, 0, 0}, {9, 1, 0}};
  sbf_spring_network n = network();
  bool turn;
  for (int i = 0; i < 6; i++) masses[i] = pinned[i] == '1' ? 0 : 1;
  n.ends = sides, n.spring_count = 6, n.positions = at;
  ck_assert(sbfi_pieces_can_rotate(&n, 10, &turn, &arena));
  return turn;
}

START_TEST(pieces_pinned_on_a_line_can_rotate)
{
  ck_assert(!turns("000000"));
  ck_assert(turns("100000"));
  ck_assert(turns("110000"));
  ck_assert(!turns("111000"));
  ck_assert(turns("111010"));  /* the pair, about one end */
  ck_assert(!turns("111011")); /* which does not move any more */
}
END_TEST

START_TEST(memory_may_run_out)
{
  harness_memory memory;
  bool good = false;
  for (size_t allowed = 0; !good; allowed++) {
    double loose_kg;
    sbfi_arena small;
    sbf_spring_network n = network();
    harness_memory_init(&memory, allowed);
    sbfi_arena_init(&small, &memory.allocator, 0);
    good = sbfi_loose_pieces_pin(&n, false, masses, &loose_kg, &small);
    sbfi_arena_free(&small);
    ck_assert_uint_eq(memory.held_bytes, 0);
    ck_assert_uint_lt(allowed, 10);
  }
}
END_TEST

int main(void) {
  Suite *s = suite_create("loose_pieces");
  TCase *c = tcase_create("loose_pieces");
  tcase_add_checked_fixture(c, setup, teardown);
  tcase_add_test(c, the_heaviest_unpinned_piece_is_kept);
  tcase_add_test(c, pieces_on_a_pinned_point_are_kept);
  tcase_add_test(c, a_goal_counts_as_a_pin);
  tcase_add_test(c, tetrahedra_join_too);
  tcase_add_test(c, pieces_pinned_on_a_line_can_rotate);
  tcase_add_test(c, memory_may_run_out);
  suite_add_tcase(s, c);
  return harness_run(s);
}
