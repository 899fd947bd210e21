#include "build/lattice/lattice_smooth.h"

#include <string.h>

#include "mechanics/vector.h"

/* Points with more tetrahedra than that, which no grid gives them, stay where they are. */
enum { MOST_TETRAHEDRA = 96, MOST_POINTS = 96 };
enum { ROUNDS = 24, TRIALS = 3 };
/* Moves that are tried at most: so many, and one for so many tetrahedra. A million of them take a third of
 * the time of the whole lattice, and swing half as fast. */
enum { TRIED_ANYWAY = 16384, TETRAHEDRA_A_TRY = 32 };

static const double bulk_share = 5;
/* The grid itself, cut flat along its faces, is at 5.7 over the cell, and inside at 2.8. To go lower costs
 * more of the surface and of the answer under loads than it gains. */
static const double well_enough = 8;
static const double hot_share = 0.64;   /* of the greatest w^2: points above it are worked on */
static const double least_gain = 0.999; /* of w^2 in a round: where it falls by less, it has ended */
static const double first_step = 0.08, step_share = 0.25; /* cells, and what of it the next trial takes */
static const double most_shift = 0.35, most_lift = 0.03;  /* cells, along the surface and across it */
static const double most_cosine = 0.975, least_cosine = -0.94; /* of 12.8 and 160 degrees */

/* S above, and six times the volume of a point's tetrahedra. */
typedef struct form {
  double xx, yy, zz, xy, yz, zx, volume6;
} form;

/* What a point's faces at the surface are, as stuffed; 0 inside. */
typedef struct surface {
  form planes;     /* A: a displacement d is off their planes by the root of d.A d, in the mean by area */
  sbfi_d3 outward; /* unit; the volume grows fastest that way */
  bool found;
} surface;

typedef struct work {
  const uint8_t *held; /* (point_count), or NULL */
  const sbf_uint4 *at;
  uint32_t count, point_count;
  double cell;
  sbfi_d3 *places, *began; /* (point_count) now and as stuffed */
  surface *surfaces;       /* (point_count) */
  uint32_t *begins, *of;   /* tetrahedra of each point: of[begins[i]..begins[i + 1]] */
  form *forms;             /* (point_count) */
  double *speeds;          /* (point_count) w^2 without E */
  uint8_t *hot;            /* (point_count) */
} work;

/* A point and what it is moved among. Each tetrahedron has the point first. */
typedef struct star {
  uint32_t count, point_count;
  uint32_t points[MOST_POINTS]; /* the point itself is the first */
  sbfi_d3 places[MOST_POINTS];
  form rest[MOST_POINTS]; /* of each, without these tetrahedra */
  uint8_t at[MOST_TETRAHEDRA][4];
  double most_cosine, least_cosine;
  double inverse_greatest; /* what speeds are shares of */
} star;

/* Twice the area vectors, outwards, of the faces opposite the corners; six times the volume. */
static double find_areas(const sbfi_d3 x[4], sbfi_d3 n[4]) {
  sbfi_d3 u = sbfi_d3_sub(x[1], x[0]), v = sbfi_d3_sub(x[2], x[0]), w = sbfi_d3_sub(x[3], x[0]);
  n[1] = sbfi_d3_cross(v, w), n[2] = sbfi_d3_cross(w, u), n[3] = sbfi_d3_cross(u, v);
  n[0] = sbfi_d3_scale(sbfi_d3_add(n[1], sbfi_d3_add(n[2], n[3])), -1);
  return sbfi_d3_dot(u, n[1]);
}

/* V g g^T is n n^T / (6 x 6 V) with g = n / 6 V. */
static void add(form *f, sbfi_d3 n, double volume6, double s) {
  f->xx += s * n.x * n.x, f->yy += s * n.y * n.y, f->zz += s * n.z * n.z;
  f->xy += s * n.x * n.y, f->yz += s * n.y * n.z, f->zx += s * n.z * n.x;
  f->volume6 += volume6;
}

static double norm_of(const form *f) {
  return sqrt(
      f->xx * f->xx + f->yy * f->yy + f->zz * f->zz + 2 * (f->xy * f->xy + f->yz * f->yz + f->zx * f->zx));
}

static double speed_of(const form *f) {
  return (f->xx + f->yy + f->zz + bulk_share * norm_of(f)) / f->volume6;
}

static void add_cosines(const sbfi_d3 n[4], double *most, double *least) {
  double inverse[4];
  for (int k = 0; k < 4; k++) inverse[k] = 1 / sbfi_d3_length(n[k]);
  for (int i = 1; i < 4; i++)
    for (int k = 0; k < i; k++) {
      double cosine = -sbfi_d3_dot(n[i], n[k]) * inverse[i] * inverse[k];
      *most = cosine > *most ? cosine : *most;
      *least = cosine < *least ? cosine : *least;
    }
}

static bool enter(const work *w, uint32_t point, uint32_t tetrahedron, star *s) {
  static const uint8_t turned[4][4] = {{0, 1, 2, 3}, {1, 0, 3, 2}, {2, 3, 0, 1}, {3, 2, 1, 0}};
  const uint32_t *corners = w->at[tetrahedron].at;
  int first = 0;
  while (corners[first] != point) first++;
  for (int k = 0; k < 4; k++) {
    uint32_t p = corners[turned[first][k]], n = 0;
    while (n < s->point_count && s->points[n] != p) n++;
    if (n == MOST_POINTS) return false;
    if (n == s->point_count) {
      s->points[n] = p, s->places[n] = w->places[p], s->rest[n] = w->forms[p];
      s->point_count++;
    }
    s->at[s->count][k] = (uint8_t)n;
  }
  s->count++;
  return true;
}

static double corner_areas(const star *s, uint32_t t, sbfi_d3 at, sbfi_d3 n[4]) {
  const uint8_t *corners = s->at[t];
  const sbfi_d3 x[4] = {at, s->places[corners[1]], s->places[corners[2]], s->places[corners[3]]};
  return find_areas(x, n);
}

static bool gather(const work *w, uint32_t point, double greatest, star *s) {
  s->count = s->point_count = 0;
  s->most_cosine = most_cosine, s->least_cosine = least_cosine, s->inverse_greatest = 1 / greatest;
  if (w->begins[point + 1] - w->begins[point] > MOST_TETRAHEDRA) return false;
  for (uint32_t i = w->begins[point]; i < w->begins[point + 1]; i++)
    if (!enter(w, point, w->of[i], s)) return false;
  for (uint32_t t = 0; t < s->count; t++) {
    sbfi_d3 n[4];
    double volume6 = corner_areas(s, t, s->places[0], n);
    for (int k = 0; k < 4; k++) add(&s->rest[s->at[t][k]], n[k], -volume6, -1 / volume6);
    add_cosines(n, &s->most_cosine, &s->least_cosine);
  }
  return true;
}

static double sixth(double x) {
  return x * x * x * x * x * x;
}

/* The sum of the speeds' sixth powers with the point at `at`; INFINITY where that turns one inside out. */
static double sum_at(const star *s, sbfi_d3 at, form *forms) {
  double sum = 0;
  memcpy(forms, s->rest, s->point_count * sizeof *forms);
  for (uint32_t t = 0; t < s->count; t++) {
    sbfi_d3 n[4];
    double volume6 = corner_areas(s, t, at, n);
    if (!(volume6 > 0)) return INFINITY;
    double inverse = 1 / volume6;
    for (int k = 0; k < 4; k++) add(&forms[s->at[t][k]], n[k], volume6, inverse);
  }
  for (uint32_t i = 0; i < s->point_count; i++) sum += sixth(speed_of(&forms[i]) * s->inverse_greatest);
  return sum;
}

static bool keeps_angles(const star *s, sbfi_d3 at) {
  double most = s->most_cosine, least = s->least_cosine;
  for (uint32_t t = 0; t < s->count; t++) {
    sbfi_d3 n[4];
    corner_areas(s, t, at, n);
    add_cosines(n, &most, &least);
    if (most > s->most_cosine || least < s->least_cosine) return false;
  }
  return true;
}

/* How a speed goes with S and with the volume, times what the sum goes with the speed. */
static form slope_of(const form *f, double inverse_greatest) {
  double speed = speed_of(f), share = speed * inverse_greatest, norm = norm_of(f);
  double weight = 6 * share * share * share * share * share * inverse_greatest / f->volume6,
         s = bulk_share / norm;
  return (form){weight * (1 + s * f->xx), weight * (1 + s * f->yy), weight * (1 + s * f->zz),
      weight * s * f->xy, weight * s * f->yz, weight * s * f->zx, -weight * speed};
}

static sbfi_d3 times(const form *m, sbfi_d3 v) {
  return (sbfi_d3){m->xx * v.x + m->xy * v.y + m->zx * v.z, m->xy * v.x + m->yy * v.y + m->yz * v.z,
      m->zx * v.x + m->yz * v.y + m->zz * v.z};
}

/* The gradient of the sum where the point is. Area vectors change by the opposite side's cross product with
 * the point's move, the volume by the first one's product with it. */
static sbfi_d3 gradient_of(const work *w, const star *s) {
  form slopes[MOST_POINTS];
  sbfi_d3 sum = {0, 0, 0};
  for (uint32_t i = 0; i < s->point_count; i++)
    slopes[i] = slope_of(&w->forms[s->points[i]], s->inverse_greatest);
  for (uint32_t t = 0; t < s->count; t++) {
    const uint8_t *at = s->at[t];
    sbfi_d3 n[4];
    double volume6 = corner_areas(s, t, s->places[0], n), by_volume = 0;
    for (int k = 0; k < 4; k++) {
      const form *by = &slopes[at[k]];
      sbfi_d3 product = times(by, n[k]);
      by_volume += by->volume6 - sbfi_d3_dot(product, n[k]) / (volume6 * volume6);
      if (k == 0) continue;
      sbfi_d3 side = sbfi_d3_sub(s->places[at[1 + (k + 1) % 3]], s->places[at[1 + k % 3]]);
      sum = sbfi_d3_add(sum, sbfi_d3_scale(sbfi_d3_cross(product, side), 2 / volume6));
    }
    sum = sbfi_d3_add(sum, sbfi_d3_scale(n[0], by_volume));
  }
  return sum;
}

/* Of the point as stuffed; see `surface`. A face of one tetrahedron alone is at the surface. */
static void find_surface(const work *w, const star *s, surface *of) {
  uint8_t sides[MOST_POINTS][MOST_POINTS];
  sbfi_d3 at = w->began[s->points[0]];
  double all = 0;
  for (uint32_t i = 0; i < s->point_count; i++) memset(sides[i], 0, s->point_count);
  for (uint32_t t = 0; t < s->count; t++)
    for (int k = 1; k < 4; k++) {
      uint8_t from = s->at[t][k], to = s->at[t][1 + k % 3];
      sides[from < to ? from : to][from < to ? to : from] += from < to ? 1 : 2;
    }
  *of = (surface){.found = true};
  for (uint32_t from = 1; from < s->point_count; from++)
    for (uint32_t to = from + 1; to < s->point_count; to++) {
      if (sides[from][to] != 1 && sides[from][to] != 2) continue;
      sbfi_d3 normal =
          sbfi_d3_cross(sbfi_d3_sub(w->began[s->points[from]], at), sbfi_d3_sub(w->began[s->points[to]], at));
      double area = sbfi_d3_length(normal);
      if (!(area > 0)) continue;
      add(&of->planes, normal, 0, 1 / area);
      of->outward = sbfi_d3_add(of->outward, sbfi_d3_scale(normal, sides[from][to] == 1 ? -1 : 1));
      all += area;
    }
  if (!(all > 0)) return;
  form *planes = &of->planes;
  planes->xx /= all, planes->yy /= all, planes->zz /= all;
  planes->xy /= all, planes->yz /= all, planes->zx /= all;
  of->outward = sbfi_d3_normal(of->outward);
}

/* As near to `to` as the point may go. */
static sbfi_d3 within_reach(const work *w, uint32_t point, sbfi_d3 to) {
  enum { STEPS = 16 };
  const surface *of = &w->surfaces[point];
  sbfi_d3 from = w->began[point], way = sbfi_d3_sub(to, from);
  double lift = most_lift * w->cell, farthest = most_shift * w->cell, length = sbfi_d3_length(way);
  if (length > farthest) way = sbfi_d3_scale(way, farthest / length);
  double inwards = -sbfi_d3_dot(way, of->outward);
  if (inwards > 0) way = sbfi_d3_add(way, sbfi_d3_scale(of->outward, inwards));
  for (int step = 0; step < STEPS; step++) {
    sbfi_d3 off = times(&of->planes, way);
    if (!(sbfi_d3_dot(way, off) > lift * lift)) break;
    way = sbfi_d3_sub(way, sbfi_d3_scale(off, 0.5));
  }
  return sbfi_d3_of(sbfi_d3_rounded(sbfi_d3_add(from, way)));
}

static void move_point(work *w, uint32_t point, double greatest) {
  star s = {.count = 0};
  form forms[MOST_POINTS];
  if (!gather(w, point, greatest, &s)) return;
  double now = 0, step = first_step * w->cell;
  if (!w->surfaces[point].found) find_surface(w, &s, &w->surfaces[point]);
  sbfi_d3 down = sbfi_d3_normal(gradient_of(w, &s));
  for (uint32_t i = 0; i < s.point_count; i++) now += sixth(w->speeds[s.points[i]] * s.inverse_greatest);
  for (int trial = 0; trial < TRIALS; trial++, step *= step_share) {
    sbfi_d3 to = within_reach(w, point, sbfi_d3_sub(s.places[0], sbfi_d3_scale(down, step)));
    if (!(sum_at(&s, to, forms) < now) || !keeps_angles(&s, to)) continue;
    w->places[point] = to;
    for (uint32_t i = 0; i < s.point_count; i++) {
      w->forms[s.points[i]] = forms[i];
      w->speeds[s.points[i]] = speed_of(&forms[i]);
    }
    return;
  }
}

/* Tetrahedra by their points. */
static bool list_tetrahedra(work *w, sbfi_arena *scratch) {
  w->begins = sbfi_arena_allocate(scratch, (size_t)w->point_count + 2, sizeof *w->begins);
  w->of = sbfi_arena_allocate(scratch, 4 * (size_t)w->count, sizeof *w->of);
  if (!w->begins || !w->of) return false;
  for (uint32_t t = 0; t < w->count; t++)
    for (int k = 0; k < 4; k++) w->begins[w->at[t].at[k] + 2]++;
  for (uint32_t i = 0; i < w->point_count; i++) w->begins[i + 2] += w->begins[i + 1];
  for (uint32_t t = 0; t < w->count; t++)
    for (int k = 0; k < 4; k++) w->of[w->begins[w->at[t].at[k] + 1]++] = t;
  return true;
}

/* Forms and speeds of all points. */
static bool look(work *w, sbfi_arena *scratch) {
  size_t count = w->point_count;
  w->forms = sbfi_arena_allocate(scratch, count, sizeof *w->forms);
  w->speeds = sbfi_arena_allocate(scratch, count, sizeof *w->speeds);
  w->hot = sbfi_arena_allocate(scratch, count, 1);
  w->surfaces = sbfi_arena_allocate(scratch, count, sizeof *w->surfaces);
  if (!w->forms || !w->speeds || !w->hot || !w->surfaces) return false;
  for (uint32_t t = 0; t < w->count; t++) {
    sbfi_d3 x[4], n[4];
    for (int k = 0; k < 4; k++) x[k] = w->places[w->at[t].at[k]];
    double volume6 = find_areas(x, n);
    for (int k = 0; k < 4; k++) {
      uint32_t p = w->at[t].at[k];
      add(&w->forms[p], n[k], volume6, 1 / volume6);
    }
  }
  for (uint32_t i = 0; i < count; i++) w->speeds[i] = speed_of(&w->forms[i]);
  return true;
}

static bool is_held(const work *w, uint32_t point) {
  return w->held && w->held[point];
}

/* Marks the points about which the speed is above `from`. */
static void mark_hot(work *w, double from) {
  memset(w->hot, 0, w->point_count);
  for (uint32_t i = 0; i < w->point_count; i++)
    for (uint32_t n = w->begins[i]; w->speeds[i] > from && !is_held(w, i) && n < w->begins[i + 1]; n++)
      for (int k = 0; k < 4; k++) w->hot[w->at[w->of[n]].at[k]] = 1;
}

static double greatest_speed(const work *w) {
  double greatest = 0;
  for (uint32_t i = 0; i < w->point_count; i++)
    if (w->speeds[i] > greatest && !is_held(w, i)) greatest = w->speeds[i];
  return greatest;
}

bool sbfi_lattice_smooth(sbfi_tetrahedra *made, double cell, const uint8_t *held, sbfi_arena *scratch) {
  work w = {
      .held = held, .at = made->at, .count = made->count, .point_count = made->point_count, .cell = cell};
  size_t count = made->point_count;
  if (made->count == 0) return true;
  w.places = sbfi_arena_allocate(scratch, count, sizeof *w.places);
  if (!w.places) return false;
  for (size_t i = 0; i < count; i++) w.places[i] = sbfi_d3_of(made->positions[i]);
  w.began = sbfi_arena_copy(scratch, w.places, count, sizeof *w.began);
  if (!w.began || !list_tetrahedra(&w, scratch) || !look(&w, scratch)) return false;
  double greatest = greatest_speed(&w), before = INFINITY, well = well_enough * well_enough / (cell * cell);
  if (!(greatest > well)) return true;
  uint32_t tried = 0, most_tried = TRIED_ANYWAY + made->count / TETRAHEDRA_A_TRY;
  for (int round = 0;
       round < ROUNDS && greatest > well && greatest < least_gain * before && tried < most_tried; round++) {
    mark_hot(&w, fmax(well, hot_share * greatest));
    for (uint32_t i = 0; i < count; i++) {
      if (!w.hot[i] || is_held(&w, i)) continue;
      move_point(&w, i, greatest);
      tried++;
    }
    before = greatest, greatest = greatest_speed(&w);
  }
  for (size_t i = 0; i < count; i++) made->positions[i] = sbfi_d3_rounded(w.places[i]);
  return true;
}
