#include "shapes/hull_pair.h"

#include "harness.h"

static const uint32_t corners[24] = {0, 2, 3, 1, 4, 5, 7, 6, 0, 1, 5, 4, 2, 6, 7, 3, 0, 4, 6, 2, 1, 3, 7, 5};
static const uint32_t quads[6] = {4, 4, 4, 4, 4, 4};

static sbri_hull box_of(sbf_vec3 h, sbfi_arena *arena) {
  sbf_vec3 *at = sbfi_arena_allocate(arena, 8, sizeof *at);
  sbri_hull hull;
  ck_assert_ptr_nonnull(at);
  for (int i = 0; i < 8; i++) at[i] = sbri_vec3(i & 1 ? h.x : -h.x, i & 2 ? h.y : -h.y, i & 4 ? h.z : -h.z);
  ck_assert(sbri_hull_make(&hull, at, 8, quads, 6, corners, arena));
  ck_assert_uint_eq(hull.edge_count, 12);
  return hull;
}

static void arena_begin(sbfi_arena *arena) {
  static sbf_allocator allocator;
  allocator = sbfi_allocator_or_default(NULL);
  sbfi_arena_init(arena, &allocator, 0);
}

/* A smaller box on a larger one: four places, its own corners, with the gap between the faces. */
START_TEST(parallel_faces_have_four_contacts)
{
  sbfi_arena arena;
  arena_begin(&arena);
  sbri_hull small = box_of(sbri_vec3(0.5f, 0.5f, 0.5f), &arena), large = box_of(sbri_vec3(2, 1, 2), &arena);
  const sbf_quat rotation = {0, 0.25881905f, 0, 0.96592583f}; /* 30 degrees */
  const float gaps[2] = {-0.01f, 0.02f};
  for (int i = 0; i < 2; i++)
    for (int swap = 0; swap < 2; swap++) {
      sbri_placed_hull a = {&small, {0.3f, 1.5f + gaps[i], 0.1f}, rotation, 1},
                       b = {&large, {0, 0, 0}, {0, 0, 0, 1}, 1};
      sbri_hull_pair pair;
      ck_assert(swap ? sbri_collide_hulls(&b, &a, 0.05f, &pair) : sbri_collide_hulls(&a, &b, 0.05f, &pair));
      ck_assert_uint_eq(pair.count, 4);
      ck_assert_float_ge(pair.normal.y * (swap ? -1 : 1), 0.99999f);
      for (uint32_t k = 0; k < 4; k++) {
        ck_assert_float_eq_tol(pair.gaps[k], gaps[i], 1e-5f);
        sbf_vec3 x = swap ? pair.on_b[k] : pair.on_a[k], off = sbri_sub(x, a.at);
        ck_assert_float_eq_tol(off.x * off.x + off.z * off.z, 0.5f, 1e-3f); /* its corners */
      }
      sbri_placed_hull far = a;
      far.at.y = 1.6f;
      ck_assert(!sbri_collide_hulls(&far, &b, 0.05f, &pair));
    }
  sbfi_arena_free(&arena);
}
END_TEST

/* A blunt tip on a face: its lowest corner lies inside the outline of the others near the face. */
START_TEST(a_tip_is_in_contact)
{
  static const uint32_t tip_corners[16] = {0, 3, 2, 1, 0, 1, 4, 1, 2, 4, 2, 3, 4, 3, 0, 4};
  static const uint32_t sizes[5] = {4, 3, 3, 3, 3};
  const sbf_vec3 at[5] = {{-1, 0.02f, -1}, {1, 0.02f, -1}, {1, 0.02f, 1}, {-1, 0.02f, 1}, {0, 0, 0}};
  sbfi_arena arena;
  arena_begin(&arena);
  sbri_hull tip, large = box_of(sbri_vec3(2, 1, 2), &arena);
  ck_assert(sbri_hull_make(&tip, at, 5, sizes, 5, tip_corners, &arena));
  sbri_placed_hull a = {&tip, {0, 0.99f, 0}, {0, 0, 0, 1}, 1}, b = {&large, {0, 0, 0}, {0, 0, 0, 1}, 1};
  for (int swap = 0; swap < 2; swap++) {
    sbri_hull_pair pair;
    ck_assert(swap ? sbri_collide_hulls(&b, &a, 0.05f, &pair) : sbri_collide_hulls(&a, &b, 0.05f, &pair));
    ck_assert_float_eq_tol(pair.gaps[0], -0.01f, 1e-5f);
    sbf_vec3 x = swap ? pair.on_b[0] : pair.on_a[0];
    ck_assert_float_le(fabsf(x.x) + fabsf(x.z), 1e-5f);
  }
  sbfi_arena_free(&arena);
}
END_TEST

/* Two beams crosswise, each on an edge: one place. */
START_TEST(crossing_edges_have_one_contact)
{
  sbfi_arena arena;
  arena_begin(&arena);
  sbri_hull beam = box_of(sbri_vec3(2, 0.1f, 0.1f), &arena);
  const sbf_quat roll = {0.38268343f, 0, 0, 0.92387953f}, across = {0, 0.70710678f, 0, 0.70710678f};
  float separation = 2 * 0.1f * sqrtf(2);
  sbri_placed_hull a = {&beam, {0, separation - 0.003f, 0}, sbri_quat_multiply(across, roll), 1};
  sbri_placed_hull b = {&beam, {0, 0, 0}, roll, 1};
  sbri_hull_pair pair;
  ck_assert(sbri_collide_hulls(&a, &b, 0.01f, &pair));
  ck_assert_uint_eq(pair.count, 1);
  ck_assert_float_eq_tol(pair.gaps[0], -0.003f, 1e-5f);
  ck_assert_float_ge(pair.normal.y, 0.9999f);
  ck_assert_float_le(fabsf(pair.on_a[0].x) + fabsf(pair.on_a[0].z), 1e-4f);
  sbfi_arena_free(&arena);
}
END_TEST

/* The measured gap is the shortest separation: moved by it along the normal, the hulls just touch. */
START_TEST(the_penetration_is_the_smallest_separating_distance)
{
  sbfi_arena arena;
  arena_begin(&arena);
  sbri_hull one = box_of(sbri_vec3(0.3f, 0.5f, 0.7f), &arena),
            other = box_of(sbri_vec3(0.4f, 0.4f, 0.4f), &arena);
  uint32_t seed = 7;
  int hits = 0;
  for (int i = 0; i < 500; i++) {
    float r[7];
    for (int k = 0; k < 7; k++) {
      seed = seed * 1664525u + 1013904223u;
      r[k] = (float)(seed >> 8) / 8388608.0f - 1;
    }
    sbri_placed_hull a = {
        &one, {r[0], r[1], r[2]}, sbri_quat_normalize((sbf_quat){r[3], r[4], r[5], r[6]}), 1};
    sbri_placed_hull b = {&other, {0, 0, 0}, {0, 0, 0, 1}, 1};
    sbri_hull_pair pair;
    if (!sbri_collide_hulls(&a, &b, 0, &pair)) continue;
    hits++;
    ck_assert_float_le(pair.gap, 1e-5f);
    sbri_placed_hull out = a;
    out.at = sbri_add_scaled(a.at, pair.normal, -pair.gap + 1e-4f);
    sbri_hull_pair again;
    ck_assert(!sbri_collide_hulls(&out, &b, 0, &again));
  }
  ck_assert_int_ge(hits, 100);
  sbfi_arena_free(&arena);
}
END_TEST

int main(void) {
  Suite *suite = suite_create("hull_pair");
  TCase *tests = tcase_create("all");
  tcase_add_test(tests, parallel_faces_have_four_contacts);
  tcase_add_test(tests, a_tip_is_in_contact);
  tcase_add_test(tests, crossing_edges_have_one_contact);
  tcase_add_test(tests, the_penetration_is_the_smallest_separating_distance);
  suite_add_tcase(suite, tests);
  return harness_run(suite);
}
