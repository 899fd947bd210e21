#include "build/geometry/soup.h"

#include <stdlib.h>
#include <string.h>

#include "base/union_find.h"
#include "build/geometry/topology.h"

/* An edge of triangles, and the first two triangles that traverse it. */
typedef struct side {
  uint32_t uses[2]; /* 3 * triangle + edge number */
  uint32_t use_count;
  uint32_t ends[2]; /* points, the lower first */
  int32_t balance;  /* upward minus downward traversals */
} side;

typedef struct work {
  sbfi_soup *soup;
  sbfi_arena *arena;   /* of the soup */
  sbfi_arena *scratch; /* of the rest, which takes several times as much */
  side *sides;
  uint32_t *side_of; /* (3 * triangle_count) */
  uint32_t side_count;
  uint8_t *flipped; /* (triangle_count) */
} work;

static uint64_t mixed(uint64_t key) {
  key = (key ^ key >> 29) * UINT64_C(0x9e3779b97f4a7c15);
  return key ^ key >> 32;
}

static size_t table_size(size_t count) {
  size_t size = 16;
  while (size < 2 * count) size *= 2;
  return size;
}

/* Numbers the positions: `new_from_old` receives each point's. */
static bool weld(work *w, const sbf_vec3_list *from, uint32_t *new_from_old) {
  size_t size = table_size(from->count);
  uint32_t *slots = sbfi_arena_allocate(w->scratch, size, sizeof *slots);
  if (!slots) return false;
  memset(slots, 0xff, size * sizeof *slots);
  for (uint32_t i = 0; i < from->count; i++) {
    /* Adding zero makes both zeros equal. */
    const sbf_vec3 p = {from->at[i].x + 0.0f, from->at[i].y + 0.0f, from->at[i].z + 0.0f};
    const sbfi_d3 position = sbfi_d3_of(p);
    uint32_t bits[3];
    memcpy(bits, &p, sizeof bits);
    size_t slot = (size_t)mixed(mixed((uint64_t)bits[0] << 32 | bits[1]) + bits[2]) & (size - 1);
    while (slots[slot] != SBFI_NO_INDEX &&
           memcmp(&w->soup->points[slots[slot]], &position, sizeof position) != 0)
      slot = (slot + 1) & (size - 1);
    if (slots[slot] == SBFI_NO_INDEX) {
      slots[slot] = w->soup->point_count;
      w->soup->points[w->soup->point_count++] = position;
    }
    new_from_old[i] = slots[slot];
  }
  return true;
}

static void grow(sbfi_soup *soup, sbfi_d3 p, bool first) {
  if (first || p.x < soup->low.x) soup->low.x = p.x;
  if (first || p.y < soup->low.y) soup->low.y = p.y;
  if (first || p.z < soup->low.z) soup->low.z = p.z;
  if (first || p.x > soup->high.x) soup->high.x = p.x;
  if (first || p.y > soup->high.y) soup->high.y = p.y;
  if (first || p.z > soup->high.z) soup->high.z = p.z;
}

static void fan(sbfi_soup *soup, const sbf_polygon_mesh *mesh, const uint32_t *new_from_old) {
  const uint32_t *corners = mesh->polygon_points.at;
  for (uint32_t p = 0; p < mesh->polygon_sizes.count; corners += mesh->polygon_sizes.at[p++]) {
    for (uint32_t k = 2; k < mesh->polygon_sizes.at[p]; k++) {
      uint32_t a = new_from_old[corners[0]], b = new_from_old[corners[k - 1]], c = new_from_old[corners[k]];
      if (a == b || b == c || c == a) continue;
      uint32_t *triangle = soup->triangles[soup->triangle_count++];
      triangle[0] = a, triangle[1] = b, triangle[2] = c;
      for (int i = 0; i < 3; i++) grow(soup, soup->points[triangle[i]], soup->triangle_count == 1 && i == 0);
    }
  }
}

static bool find_sides(work *w) {
  const sbfi_soup *soup = w->soup;
  size_t uses = 3 * (size_t)soup->triangle_count, size = table_size(uses);
  uint32_t *slots = sbfi_arena_allocate(w->scratch, size, sizeof *slots);
  uint64_t *keys = sbfi_arena_allocate(w->scratch, uses, sizeof *keys);
  w->sides = sbfi_arena_allocate(w->scratch, uses, sizeof *w->sides);
  w->side_of = sbfi_arena_allocate(w->scratch, uses, sizeof *w->side_of);
  if (!slots || !keys || !w->sides || !w->side_of) return false;
  memset(slots, 0xff, size * sizeof *slots);
  for (uint32_t use = 0; use < uses; use++) {
    uint32_t a = soup->triangles[use / 3][use % 3], b = soup->triangles[use / 3][(use + 1) % 3];
    uint64_t key = a < b ? (uint64_t)a << 32 | b : (uint64_t)b << 32 | a;
    size_t slot = (size_t)mixed(key) & (size - 1);
    while (slots[slot] != SBFI_NO_INDEX && keys[slots[slot]] != key) slot = (slot + 1) & (size - 1);
    if (slots[slot] == SBFI_NO_INDEX) {
      slots[slot] = w->side_count;
      keys[w->side_count++] = key;
    }
    side *s = &w->sides[w->side_of[use] = slots[slot]];
    if (s->use_count < 2) s->uses[s->use_count] = use;
    s->use_count++;
  }
  return true;
}

static bool goes_up(const sbfi_soup *soup, uint32_t use) {
  return soup->triangles[use / 3][use % 3] < soup->triangles[use / 3][(use + 1) % 3];
}

static double area_of(const sbfi_soup *soup, uint32_t triangle) {
  const uint32_t *at = soup->triangles[triangle];
  sbfi_d3 a = soup->points[at[0]];
  return sbfi_d3_length(
      sbfi_d3_cross(sbfi_d3_sub(soup->points[at[1]], a), sbfi_d3_sub(soup->points[at[2]], a)));
}

enum { UNSEEN = 2 };

/* Walks over the piece of the triangle; `facing` receives 0, or 1 for opposite orientation. Leaves the
 * piece in `waiting`. Returns its number of triangles. */
static uint32_t walk_piece(const work *w, uint32_t first, uint8_t *facing, uint32_t *waiting) {
  uint32_t count = 0;
  facing[first] = 0;
  waiting[count++] = first;
  for (uint32_t next = 0; next < count; next++) {
    uint32_t here = waiting[next];
    for (uint32_t use = 3 * here; use < 3 * here + 3; use++) {
      const side *s = &w->sides[w->side_of[use]];
      if (s->use_count != 2) continue;
      uint32_t other = s->uses[0] == use ? s->uses[1] : s->uses[0];
      if (facing[other / 3] != UNSEEN) continue;
      facing[other / 3] = facing[here] ^ (goes_up(w->soup, use) == goes_up(w->soup, other));
      waiting[count++] = other / 3;
    }
  }
  return count;
}

static bool flip_pieces(work *w) {
  sbfi_soup *soup = w->soup;
  uint8_t *facing = sbfi_arena_allocate(w->scratch, soup->triangle_count, 1);
  uint32_t *waiting = sbfi_arena_allocate(w->scratch, soup->triangle_count, sizeof *waiting);
  if (!facing || !waiting) return false;
  memset(facing, UNSEEN, soup->triangle_count);
  for (uint32_t t = 0; t < soup->triangle_count; t++) {
    if (facing[t] != UNSEEN) continue;
    uint32_t count = walk_piece(w, t, facing, waiting);
    double areas[2] = {0, 0};
    for (uint32_t i = 0; i < count; i++) areas[facing[waiting[i]]] += area_of(soup, waiting[i]);
    uint8_t wrong = areas[1] <= areas[0];
    for (uint32_t i = 0; i < count; i++) facing[waiting[i]] = facing[waiting[i]] == wrong;
  }
  w->flipped = facing;
  for (uint32_t t = 0; t < soup->triangle_count; t++) {
    if (!facing[t]) continue;
    uint32_t swap = soup->triangles[t][1];
    soup->triangles[t][1] = soup->triangles[t][2];
    soup->triangles[t][2] = swap;
    soup->flipped_count++;
  }
  return true;
}

/* Updates the edges after the flips, which changed edge numbers. Returns the sum of their imbalances. */
static uint32_t balance_sides(const work *w) {
  static const uint32_t indices[3] = {2, 1, 0};
  const sbfi_soup *soup = w->soup;
  uint32_t missing = 0;
  for (uint32_t use = 0; use < 3 * soup->triangle_count; use++) {
    uint32_t now = w->flipped[use / 3] ? use / 3 * 3 + indices[use % 3] : use;
    side *s = &w->sides[w->side_of[use]];
    s->ends[0] = soup->triangles[now / 3][now % 3];
    s->ends[1] = soup->triangles[now / 3][(now + 1) % 3];
    if (s->ends[0] > s->ends[1]) {
      uint32_t swap = s->ends[0];
      s->ends[0] = s->ends[1];
      s->ends[1] = swap;
    }
    s->balance += goes_up(soup, now) ? 1 : -1;
  }
  for (uint32_t s = 0; s < w->side_count; s++) missing += (uint32_t)abs(w->sides[s].balance);
  return missing;
}

/* Adds an apex for each piece of rim, and a triangle from it for each missing traversal of an edge. */
static bool cap_holes(work *w, uint32_t missing) {
  sbfi_soup *soup = w->soup;
  uint32_t count = soup->point_count;
  uint32_t *parents = sbfi_arena_allocate(w->scratch, count, sizeof *parents);
  uint32_t *apexes = sbfi_arena_allocate(w->scratch, count, sizeof *apexes);
  uint32_t *sums = sbfi_arena_allocate(w->scratch, count, sizeof *sums);
  sbfi_d3 *points = sbfi_arena_allocate(w->arena, (size_t)count + missing, sizeof *points);
  uint32_t(*triangles)[3] =
      sbfi_arena_allocate(w->arena, (size_t)soup->triangle_count + missing, sizeof *triangles);
  if (!parents || !apexes || !sums || !points || !triangles) return false;
  memcpy(points, soup->points, count * sizeof *points);
  memcpy(triangles, soup->triangles, soup->triangle_count * sizeof *triangles);
  soup->points = points;
  soup->triangles = triangles;
  sbfi_sets_begin(parents, count);
  for (uint32_t s = 0; s < w->side_count; s++) {
    if (w->sides[s].balance == 0) continue;
    sbfi_sets_join(parents, w->sides[s].ends[0], w->sides[s].ends[1]);
  }
  for (uint32_t s = 0; s < w->side_count; s++) {
    if (w->sides[s].balance == 0) continue;
    uint32_t root = sbfi_set_root(parents, w->sides[s].ends[0]);
    if (sums[root] == 0) {
      apexes[root] = soup->point_count++;
      points[apexes[root]] = (sbfi_d3){0, 0, 0};
    }
    sbfi_d3 *apex = &points[apexes[root]];
    for (int k = 0; k < 2; k++) *apex = sbfi_d3_add(*apex, points[w->sides[s].ends[k]]);
    sums[root] += 2;
  }
  /* In single precision, like all points. */
  for (uint32_t i = 0; i < count; i++)
    if (sums[i])
      points[apexes[i]] = sbfi_d3_of(sbfi_d3_rounded(sbfi_d3_scale(points[apexes[i]], 1.0 / sums[i])));
  for (uint32_t s = 0; s < w->side_count; s++) {
    const side *at = &w->sides[s];
    uint32_t apex = at->balance ? apexes[sbfi_set_root(parents, at->ends[0])] : 0;
    for (int32_t n = abs(at->balance); n > 0; n--) {
      uint32_t *triangle = triangles[soup->triangle_count + soup->cap_count++];
      triangle[0] = at->ends[at->balance > 0];
      triangle[1] = at->ends[at->balance < 0];
      triangle[2] = apex;
    }
  }
  return true;
}

static bool make(work *w, const sbf_polygon_mesh *mesh, size_t max) {
  sbfi_soup *soup = w->soup;
  uint32_t *new_from_old = sbfi_arena_allocate(w->scratch, mesh->positions.count, sizeof *new_from_old);
  soup->points = sbfi_arena_allocate(w->arena, mesh->positions.count, sizeof *soup->points);
  soup->triangles = sbfi_arena_allocate(w->arena, max, sizeof *soup->triangles);
  if (!new_from_old || !soup->points || !soup->triangles) return false;
  if (!weld(w, &mesh->positions, new_from_old)) return false;
  fan(soup, mesh, new_from_old);
  if (soup->triangle_count == 0) return true;
  if (!find_sides(w) || !flip_pieces(w)) return false;
  uint32_t missing = balance_sides(w);
  return missing == 0 || cap_holes(w, missing);
}

bool sbfi_soup_make(sbfi_soup *soup, const sbf_polygon_mesh *mesh, sbfi_arena *arena) {
  sbfi_arena scratch;
  work w = {.soup = soup, .arena = arena, .scratch = &scratch};
  size_t max = 0;
  *soup = (sbfi_soup){.triangle_count = 0};
  for (uint32_t p = 0; p < mesh->polygon_sizes.count; p++) max += mesh->polygon_sizes.at[p] - 2;
  if (max == 0) return true;
  if (max > UINT32_MAX / 8) return false; /* at most three traversals per triangle are counted in 32 bits */
  sbfi_arena_init(&scratch, &arena->allocator, 0);
  bool good = make(&w, mesh, max);
  sbfi_arena_free(&scratch);
  return good;
}
