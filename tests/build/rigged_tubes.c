#include "rigged_tubes.h"

#include "harness.h"

enum { SIDES = 12 };

static const double ROUND[SIDES][2] = {{1, 0}, {0.866, 0.5}, {0.5, 0.866}, {0, 1}, {-0.5, 0.866},
    {-0.866, 0.5}, {-1, 0}, {-0.866, -0.5}, {-0.5, -0.866}, {0, -1}, {0.5, -0.866}, {0.866, -0.5}};

static uint32_t add_point(rigged_tubes *to, sbfi_d3 at) {
  ck_assert_uint_lt(to->point_count, TUBE_POINTS);
  to->points[to->point_count] = sbfi_d3_rounded(at);
  return to->point_count++;
}

static void add_triangle(rigged_tubes *to, uint32_t a, uint32_t b, uint32_t c) {
  ck_assert_uint_lt(to->triangle_count, TUBE_POINTS);
  uint32_t *corners = to->triangles[to->triangle_count++];
  corners[0] = a, corners[1] = b, corners[2] = c;
}

static uint32_t add_ring(rigged_tubes *to, sbfi_d3 middle, sbfi_d3 along, double radius) {
  sbfi_d3 axis = sbfi_d3_normal(along), spare = fabs(axis.z) < 0.9 ? (sbfi_d3){0, 0, 1} : (sbfi_d3){1, 0, 0};
  sbfi_d3 x = sbfi_d3_normal(sbfi_d3_cross(axis, spare)), y = sbfi_d3_cross(axis, x);
  uint32_t first = to->point_count;
  for (int k = 0; k < SIDES; k++) {
    sbfi_d3 aside = sbfi_d3_add(sbfi_d3_scale(x, ROUND[k][0]), sbfi_d3_scale(y, ROUND[k][1]));
    add_point(to, sbfi_d3_add(middle, sbfi_d3_scale(aside, radius)));
  }
  return first;
}

static void join_rings(rigged_tubes *to, uint32_t a, uint32_t b) {
  for (uint32_t k = 0; k < SIDES; k++) {
    uint32_t next = (k + 1) % SIDES;
    add_triangle(to, a + k, a + next, b + next);
    add_triangle(to, a + k, b + next, b + k);
  }
}

static void close_ring(rigged_tubes *to, uint32_t ring, sbfi_d3 at, bool is_begin) {
  uint32_t apex = add_point(to, at);
  for (uint32_t k = 0; k < SIDES; k++) {
    uint32_t a = ring + k, b = ring + (k + 1) % SIDES;
    add_triangle(to, apex, is_begin ? b : a, is_begin ? a : b);
  }
}

uint32_t tubes_add(
    rigged_tubes *to, const sbfi_d3 *path, uint32_t path_count, double radius, uint32_t rings, bool open) {
  uint32_t first = to->point_count, last = UINT32_MAX, begin = 0;
  for (uint32_t p = 0; p + 1 < path_count; p++)
    for (uint32_t i = p ? 1 : 0; i <= rings; i++) {
      sbfi_d3 along = sbfi_d3_sub(path[p + 1], path[p]), direction = along;
      if (i == rings && p + 2 < path_count) /* halfway round the bend */
        direction = sbfi_d3_add(sbfi_d3_normal(along), sbfi_d3_normal(sbfi_d3_sub(path[p + 2], path[p + 1])));
      sbfi_d3 middle = sbfi_d3_add(path[p], sbfi_d3_scale(along, (double)i / rings));
      uint32_t ring = add_ring(to, middle, direction, radius);
      if (last == UINT32_MAX)
        begin = ring;
      else
        join_rings(to, last, ring);
      last = ring;
    }
  if (open) return first;
  close_ring(to, begin, path[0], true);
  close_ring(to, last, path[path_count - 1], false);
  return first;
}

uint32_t tubes_add_ball(rigged_tubes *to, sbfi_d3 middle, double radius, uint32_t rings) {
  uint32_t first = to->point_count, last = UINT32_MAX;
  const sbfi_d3 up = {0, 1, 0};
  for (uint32_t i = 1; i < rings; i++) {
    double height = -1 + 2.0 * i / rings;
    uint32_t ring = add_ring(
        to, sbfi_d3_add(middle, sbfi_d3_scale(up, radius * height)), up, radius * sqrt(1 - height * height));
    if (last == UINT32_MAX)
      close_ring(to, ring, sbfi_d3_sub(middle, sbfi_d3_scale(up, radius)), true);
    else
      join_rings(to, last, ring);
    last = ring;
  }
  close_ring(to, last, sbfi_d3_add(middle, sbfi_d3_scale(up, radius)), false);
  return first;
}

/* The rotation that takes +Y to a direction. */
static sbf_quat rotation_to(sbfi_d3 direction) {
  sbfi_d3 to = sbfi_d3_normal(direction);
  if (to.y < -0.999999) return (sbf_quat){1, 0, 0, 0};
  double w = 1 + to.y, length = sqrt(to.z * to.z + to.x * to.x + w * w);
  return (sbf_quat){(float)(to.z / length), 0, (float)(-to.x / length), (float)(w / length)};
}

uint32_t tubes_add_bone(rigged_tubes *to, const char *name, int32_t parent, sbfi_d3 head, sbfi_d3 tail) {
  ck_assert_uint_lt(to->bone_count, TUBE_BONES);
  sbf_bone *bone = &to->bones[to->bone_count];
  sbf_bone_init(bone);
  bone->name = name;
  bone->parent = parent;
  bone->head = sbfi_d3_rounded(head);
  bone->rotation = rotation_to(sbfi_d3_sub(tail, head));
  return to->bone_count++;
}

sbfi_weights_input tubes_input(const rigged_tubes *of) {
  return (sbfi_weights_input){.points = of->points,
      .triangles = of->triangles,
      .point_count = of->point_count,
      .triangle_count = of->triangle_count,
      .bones = of->bones,
      .bone_count = of->bone_count};
}

double tubes_weight(const sbfi_weights *weights, uint32_t point, uint32_t bone) {
  for (int k = 0; k < SBFI_WEIGHTS_PER_POINT; k++)
    if (weights->joints[point][k] == bone && weights->weights[point][k] > 0)
      return (double)weights->weights[point][k];
  return 0;
}

void tubes_check_sums(const sbfi_weights *weights) {
  for (uint32_t i = 0; i < weights->point_count; i++) {
    double sum = 0;
    for (int k = 0; k < SBFI_WEIGHTS_PER_POINT; k++) {
      ck_assert_float_ge(weights->weights[i][k], 0);
      if (k) ck_assert_float_le(weights->weights[i][k], weights->weights[i][k - 1]);
      sum += (double)weights->weights[i][k];
    }
    ck_assert_double_eq_tol(sum, 1, 1e-5);
  }
}
