#include "measured_bodies.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>

#include "measured_assets.h"
#include "measuring.h"
#include "sbfmt/build.h"
#include "sbfmt/convert.h"

typedef struct builder {
  sbf_asset *asset;
  sbf_vec3 *points;
  uint32_t point_count;
  sbf_uint2 *ends;
  uint32_t spring_count, pinned_count;
  uint32_t *pinned;
} builder;

static void *allocate(sbf_asset *asset, size_t count, size_t size) {
  void *memory = sbf_asset_allocate(asset, count ? count : 1, size);
  if (!memory) bench_fail("memory ran out");
  return memory;
}

sbf_polygon_mesh *box_hull(sbf_asset *asset, sbf_vec3 middle, sbf_vec3 size) {
  static const uint32_t corners[24] = {
      0, 2, 3, 1, 4, 5, 7, 6, 0, 1, 5, 4, 2, 6, 7, 3, 0, 4, 6, 2, 1, 3, 7, 5};
  static const uint32_t sizes[6] = {4, 4, 4, 4, 4, 4};
  sbf_polygon_mesh *hull = allocate(asset, 1, sizeof *hull);
  sbf_vec3 *points = allocate(asset, 8, sizeof *points);
  sbf_polygon_mesh_init(hull);
  for (int i = 0; i < 8; i++)
    points[i] = (sbf_vec3){middle.x + size.x * (i & 1 ? 0.5f : -0.5f),
        middle.y + size.y * (i & 2 ? 0.5f : -0.5f), middle.z + size.z * (i & 4 ? 0.5f : -0.5f)};
  hull->positions = (sbf_vec3_list){points, 8};
  hull->polygon_sizes = (sbf_u32_list){sizes, 6};
  hull->polygon_points = (sbf_u32_list){corners, 24};
  return hull;
}

enum { RINGS = 7, AROUND = 14, CORNERS = RINGS * AROUND + 2, FACES = (RINGS + 1) * AROUND };

/* Of the k-th corner on a ring; rings 0 and RINGS + 1 are the poles, 0 and 1. */
static uint32_t on_ring(uint32_t ring, uint32_t k) {
  if (ring == 0 || ring > RINGS) return ring > RINGS;
  return 2 + (ring - 1) * AROUND + k % AROUND;
}

static sbf_polygon_mesh *ball_hull(sbf_asset *asset, float radius) {
  const double half_turn = 3.14159265358979;
  sbf_polygon_mesh *hull = allocate(asset, 1, sizeof *hull);
  sbf_vec3 *points = allocate(asset, CORNERS, sizeof *points);
  uint32_t *sizes = allocate(asset, FACES, sizeof *sizes);
  uint32_t *corners = allocate(asset, (size_t)4 * FACES, sizeof *corners), face = 0, corner = 0;
  for (uint32_t ring = 0; ring <= RINGS; ring++)
    for (uint32_t k = 0; k < AROUND; k++) {
      double down = half_turn * (ring + 1) / (RINGS + 1), turn = 2 * half_turn * k / AROUND;
      if (ring < RINGS)
        points[on_ring(ring + 1, k)] = (sbf_vec3){radius * (float)(sin(down) * cos(turn)),
            radius * (float)cos(down), radius * (float)(sin(down) * sin(turn))};
      corners[corner++] = on_ring(ring, k);
      if (ring > 0) corners[corner++] = on_ring(ring, k + 1);
      corners[corner++] = on_ring(ring + 1, k + 1);
      if (ring < RINGS) corners[corner++] = on_ring(ring + 1, k);
      sizes[face++] = ring > 0 && ring < RINGS ? 4 : 3;
    }
  points[0] = (sbf_vec3){0, radius, 0}, points[1] = (sbf_vec3){0, -radius, 0};
  sbf_polygon_mesh_init(hull);
  hull->positions = (sbf_vec3_list){points, CORNERS};
  hull->polygon_sizes = (sbf_u32_list){sizes, face};
  hull->polygon_points = (sbf_u32_list){corners, corner};
  return hull;
}

sbf_asset *ball_asset(float radius, float mass) {
  sbf_asset *asset = sbf_asset_create(NULL);
  if (!asset) bench_fail("memory ran out");
  sbf_rigid_body *body = allocate(asset, 1, sizeof *body);
  sbf_rigid_body_init(body);
  body->id = "ball";
  body->motion = SBF_BODY_MOTION_DYNAMIC;
  body->mass = mass;
  body->hull = ball_hull(asset, radius);
  asset->rigid_bodies = (sbf_rigid_body_list){body, 1};
  return asset;
}

static builder begin(uint32_t points) {
  builder b = {.asset = sbf_asset_create(NULL)};
  if (!b.asset) bench_fail("memory ran out");
  b.points = allocate(b.asset, points, sizeof *b.points);
  b.ends = allocate(b.asset, 7 * (size_t)points, sizeof *b.ends);
  b.pinned = allocate(b.asset, points, sizeof *b.pinned);
  return b;
}

static void join(builder *b, uint32_t from, uint32_t to) {
  b->ends[b->spring_count++] = (sbf_uint2){{from, to}};
}

/* A body of all that was put into `b`, without elements yet. */
static sbf_level *make_body(builder *b, sbf_soft_body **made) {
  sbf_soft_body *body = allocate(b->asset, 1, sizeof *body);
  sbf_level *level = allocate(b->asset, 1, sizeof *level);
  sbf_pin_set *pins = allocate(b->asset, 1, sizeof *pins);
  sbf_soft_body_init(body), sbf_level_init(level), sbf_pin_set_init(pins);
  body->id = "body";
  level->positions = (sbf_vec3_list){b->points, b->point_count};
  pins->points = (sbf_u32_list){b->pinned, b->pinned_count};
  level->pins = (sbf_pin_set_list){pins, b->pinned_count ? 1 : 0};
  body->levels = (sbf_level_list){level, 1};
  b->asset->soft_bodies = (sbf_soft_body_list){body, 1};
  *made = body;
  return level;
}

static void add_springs(builder *b, sbf_level *level, float stiffness) {
  sbf_spring_set *set = allocate(b->asset, 1, sizeof *set);
  sbf_spring_set_init(set);
  set->ends = (sbf_uint2_list){b->ends, b->spring_count};
  if (stiffness > 0) {
    float *one = allocate(b->asset, 1, sizeof *one);
    *one = stiffness;
    set->stiffness = (sbf_f32_list){one, 1};
  }
  level->springs = (sbf_spring_set_list){set, 1};
}

static sbf_asset *finish_springs(builder *b, float mass, float stiffness) {
  sbf_soft_body *body;
  sbf_level *level = make_body(b, &body);
  body->attributes.mass = mass;
  body->attributes.damping_ratio = 0.02f;
  add_springs(b, level, stiffness);
  return b->asset;
}

sbf_asset *cloth_of_springs(uint32_t side) {
  builder b = begin(side * side);
  for (uint32_t i = 0; i < side; i++)
    for (uint32_t k = 0; k < side; k++) {
      uint32_t at = i * side + k;
      b.points[b.point_count++] = (sbf_vec3){0.01f * (float)k, 0, 0.01f * (float)i};
      if (k > 0) join(&b, at - 1, at);
      if (i > 0) join(&b, at - side, at);
      if (i > 0 && k > 0) join(&b, at - side - 1, at);
    }
  b.pinned[0] = 0, b.pinned[1] = side - 1, b.pinned_count = 2;
  return finish_springs(&b, 0.2f * 4, 200);
}

/* ---- Beams ---- */

static void put_beam_points(builder *b, uint32_t across, uint32_t along, float cell_m) {
  for (uint32_t z = 0; z <= along; z++)
    for (uint32_t y = 0; y <= across; y++)
      for (uint32_t x = 0; x <= across; x++) {
        if (z == 0) b->pinned[b->pinned_count++] = b->point_count;
        b->points[b->point_count++] = (sbf_vec3){cell_m * (float)x, cell_m * (float)y, cell_m * (float)z};
      }
}

sbf_asset *beam_of_springs(uint32_t across, uint32_t along, float cell_m, float stiffness) {
  uint32_t n = across + 1, slab = n * n;
  builder b = begin(slab * (along + 1));
  put_beam_points(&b, across, along, cell_m);
  for (uint32_t z = 0; z <= along; z++)
    for (uint32_t y = 0; y < n; y++)
      for (uint32_t x = 0; x < n; x++) {
        uint32_t at = z * slab + y * n + x;
        if (x > 0) join(&b, at - 1, at);
        if (y > 0) join(&b, at - n, at);
        if (z > 0) join(&b, at - slab, at);
        bool odd = (x + y + z) % 2; /* diagonals go from odd points to odd ones */
        if (x > 0 && y > 0) odd ? join(&b, at - n - 1, at) : join(&b, at - n, at - 1);
        if (x > 0 && z > 0) odd ? join(&b, at - slab - 1, at) : join(&b, at - slab, at - 1);
        if (y > 0 && z > 0) odd ? join(&b, at - slab - n, at) : join(&b, at - slab, at - n);
      }
  float volume = (float)(across * across * along) * cell_m * cell_m * cell_m;
  return finish_springs(&b, 1000 * volume, stiffness);
}

/* A corner of each even point of a cell, and what the four odd points have between them. */
static sbf_uint4 *put_cell(sbf_uint4 *to, const uint32_t corners[8], bool odd) {
  static const uint8_t even_ones[4] = {0, 3, 5, 6}, odd_ones[4] = {1, 2, 4, 7};
  const uint8_t *cut = odd ? odd_ones : even_ones, *middle = odd ? even_ones : odd_ones;
  for (int k = 0; k < 4; k++, to++) {
    uint32_t at = cut[k], x = corners[at ^ 1], y = corners[at ^ 2], z = corners[at ^ 4];
    bool upright = at == 0 || at == 3 || at == 5 || at == 6;
    *to = (sbf_uint4){{corners[at], x, upright ? y : z, upright ? z : y}};
  }
  *to = (sbf_uint4){
      {corners[middle[0]], corners[middle[odd ? 2 : 1]], corners[middle[odd ? 1 : 2]], corners[middle[3]]}};
  return to + 1;
}

sbf_asset *beam_of_tetrahedra(uint32_t across, uint32_t along, float cell_m, float young_modulus) {
  uint32_t n = across + 1, slab = n * n, count = 5 * across * across * along;
  builder b = begin(slab * (along + 1));
  sbf_uint4 *tetrahedra = allocate(b.asset, count, sizeof *tetrahedra), *next = tetrahedra;
  put_beam_points(&b, across, along, cell_m);
  for (uint32_t z = 0; z < along; z++)
    for (uint32_t y = 0; y < across; y++)
      for (uint32_t x = 0; x < across; x++) {
        uint32_t corners[8];
        for (uint32_t k = 0; k < 8; k++)
          corners[k] = (z + (k >> 2)) * slab + (y + (k >> 1 & 1)) * n + x + (k & 1);
        next = put_cell(next, corners, (x + y + z) % 2);
      }
  sbf_soft_body *body;
  sbf_level *level = make_body(&b, &body);
  body->attributes.young_modulus = young_modulus;
  level->model = SBF_ELASTIC_MODEL_TETRAHEDRA;
  level->lattice.tetrahedra = (sbf_uint4_list){tetrahedra, count};
  return b.asset;
}

/* ---- The armadillo ---- */

static const double ARMADILLO_TALL = 15.13; /* in the units of its file */

sbf_asset *armadillo_of_tetrahedra(uint32_t elements) {
  const char *path = SHARED_FOLDER "/armadillo/armadillo_25k.obj";
  FILE *file = fopen(path, "rb");
  if (!file) return NULL;
  fclose(file);
  const sbf_convert_options convert = {.unit_m = 1 / ARMADILLO_TALL};
  const sbf_build_options options = {
      .interior = SBF_BUILD_INTERIOR_TETRAHEDRA, .elements = elements, .without_calibration = true};
  sbf_asset *read, *built;
  sbf_diagnostic error;
  bench_require(sbf_convert(path, &convert, &read, &error), &error);
  bench_require(sbf_build(read, &options, &built, NULL, &error), &error);
  sbf_asset_free(read);
  sbf_soft_body *body = (sbf_soft_body *)(uintptr_t)built->soft_bodies.at;
  sbf_level *level = (sbf_level *)(uintptr_t)body->levels.at;
  body->attributes.young_modulus = 1e5f;
  level->lattice.young_modulus = (sbf_f32_list){NULL, 0};
  return built;
}

/* ---- The slab ---- */

enum { SLAB_SIDE = 46 }; /* points of its surface along an edge */

/* A point of the box [-1, 1]^3 on the face across `axis`, on the side of `sign`. */
static sbf_vec3 on_face(int axis, float sign, float u, float v) {
  float at[3];
  at[axis] = sign, at[(axis + 1) % 3] = u, at[(axis + 2) % 3] = sign * v;
  return (sbf_vec3){at[0], at[1], at[2]};
}

sbf_asset *slab_of_tetrahedra(uint32_t elements) {
  const uint32_t face_points = SLAB_SIDE * SLAB_SIDE, face_quads = (SLAB_SIDE - 1) * (SLAB_SIDE - 1);
  const sbf_build_options options = {
      .interior = SBF_BUILD_INTERIOR_TETRAHEDRA, .elements = elements, .without_calibration = true};
  builder b = begin(6 * face_points);
  sbf_soft_body *body = allocate(b.asset, 1, sizeof *body);
  uint32_t *sizes = allocate(b.asset, 6 * face_quads, sizeof *sizes), quad = 0;
  uint32_t *corners = allocate(b.asset, 24 * (size_t)face_quads, sizeof *corners);
  for (int face = 0; face < 6; face++)
    for (uint32_t i = 0; i < SLAB_SIDE; i++)
      for (uint32_t k = 0; k < SLAB_SIDE; k++) {
        float u = 2 * (float)k / (SLAB_SIDE - 1) - 1, v = 2 * (float)i / (SLAB_SIDE - 1) - 1;
        sbf_vec3 p = on_face(face % 3, face < 3 ? 1 : -1, u, v);
        uint32_t at = b.point_count, *c = corners + 4 * quad;
        b.points[b.point_count++] = (sbf_vec3){0.5f * p.x, 0.1f * p.y, 0.5f * p.z};
        if (i + 1 == SLAB_SIDE || k + 1 == SLAB_SIDE) continue;
        c[0] = at, c[1] = at + 1, c[2] = at + SLAB_SIDE + 1, c[3] = at + SLAB_SIDE;
        sizes[quad++] = 4;
      }
  sbf_soft_body_init(body);
  body->id = "slab";
  body->attributes.young_modulus = 1e5f;
  body->surface.positions = (sbf_vec3_list){b.points, b.point_count};
  body->surface.polygon_sizes = (sbf_u32_list){sizes, quad};
  body->surface.polygon_points = (sbf_u32_list){corners, 4 * quad};
  b.asset->soft_bodies = (sbf_soft_body_list){body, 1};
  sbf_asset *built;
  sbf_diagnostic error;
  bench_require(sbf_build(b.asset, &options, &built, NULL, &error), &error);
  sbf_asset_free(b.asset);
  return built;
}

/* ---- Others of them ---- */

void hold_above(sbf_asset *asset, double fraction) {
  sbf_level *level = (sbf_level *)(uintptr_t)asset->soft_bodies.at[0].levels.at;
  const sbf_vec3 *points = level->positions.at;
  uint32_t count = level->positions.count, pinned_count = 0;
  uint32_t *pinned = allocate(asset, count, sizeof *pinned);
  sbf_pin_set *pins = allocate(asset, 1, sizeof *pins);
  float low = points[0].y, high = points[0].y;
  for (uint32_t i = 0; i < count; i++) {
    low = points[i].y < low ? points[i].y : low;
    high = points[i].y > high ? points[i].y : high;
  }
  for (uint32_t i = 0; i < count; i++)
    if (points[i].y > low + (float)fraction * (high - low)) pinned[pinned_count++] = i;
  sbf_pin_set_init(pins);
  pins->points = (sbf_u32_list){pinned, pinned_count};
  level->pins = (sbf_pin_set_list){pins, 1};
}

static int compare_ends(const void *a, const void *b) {
  const sbf_uint2 *x = a, *y = b;
  if (x->at[0] != y->at[0]) return x->at[0] < y->at[0] ? -1 : 1;
  return (x->at[1] > y->at[1]) - (x->at[1] < y->at[1]);
}

sbf_asset *springs_of_edges(const sbf_asset *solid) {
  sbf_asset *copy = sbf_asset_clone(solid, NULL);
  if (!copy) bench_fail("memory ran out");
  sbf_level *level = (sbf_level *)(uintptr_t)copy->soft_bodies.at[0].levels.at;
  uint32_t count = level->lattice.tetrahedra.count;
  builder b = {.asset = copy, .ends = allocate(copy, 6 * (size_t)count, sizeof *b.ends)};
  for (uint32_t t = 0; t < count; t++)
    for (int i = 0; i < 4; i++)
      for (int k = 0; k < i; k++) {
        uint32_t p = level->lattice.tetrahedra.at[t].at[i], q = level->lattice.tetrahedra.at[t].at[k];
        join(&b, p < q ? p : q, p < q ? q : p);
      }
  qsort(b.ends, b.spring_count, sizeof *b.ends, compare_ends);
  uint32_t kept = 0;
  for (uint32_t i = 0; i < b.spring_count; i++)
    if (i == 0 || compare_ends(&b.ends[i], &b.ends[kept - 1])) b.ends[kept++] = b.ends[i];
  b.spring_count = kept;
  level->model = SBF_ELASTIC_MODEL_SPRINGS;
  level->lattice.tetrahedra = (sbf_uint4_list){NULL, 0};
  level->lattice.young_modulus = (sbf_f32_list){NULL, 0};
  add_springs(&b, level, 0);
  return copy;
}
