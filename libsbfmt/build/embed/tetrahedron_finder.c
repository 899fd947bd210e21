#include "build/embed/tetrahedron_finder.h"

#include "build/geometry/triangle_tree.h"

static const double slack = 1e-9; /* of a weight: a point between two tetrahedra is in both */

bool sbfi_tetrahedron_weigh(
    const sbf_vec3 *positions, const uint32_t corners[4], sbfi_d3 point, double weights[4]) {
  sbfi_d3 origin = sbfi_d3_of(positions[corners[3]]), edges[3], cofactors[3];
  double longest2 = 0;
  for (int k = 0; k < 3; k++) {
    edges[k] = sbfi_d3_sub(sbfi_d3_of(positions[corners[k]]), origin);
    longest2 = fmax(longest2, sbfi_d3_dot(edges[k], edges[k]));
  }
  for (int k = 0; k < 3; k++) cofactors[k] = sbfi_d3_cross(edges[(k + 1) % 3], edges[(k + 2) % 3]);
  double volume = sbfi_d3_dot(edges[0], cofactors[0]);
  if (!(fabs(volume) > 1e-6 * longest2 * sqrt(longest2))) return false;
  sbfi_d3 from = sbfi_d3_sub(point, origin);
  weights[3] = 1;
  for (int k = 0; k < 3; k++) {
    weights[k] = sbfi_d3_dot(from, cofactors[k]) / volume;
    weights[3] -= weights[k];
  }
  return true;
}

static sbfi_d3 middle_of(const sbfi_tetrahedron_finder *f, uint32_t tetrahedron) {
  sbfi_d3 sum = {0, 0, 0};
  for (int k = 0; k < 4; k++)
    sum = sbfi_d3_add(sum, sbfi_d3_of(f->positions[f->tetrahedra[tetrahedron].at[k]]));
  return sbfi_d3_scale(sum, 0.25);
}

static uint32_t bin_along(const sbfi_tetrahedron_finder *f, double place, double origin, int axis) {
  double bin = (place - origin) / f->width;
  if (!(bin > 0)) return 0;
  return bin < f->counts[axis] - 1 ? (uint32_t)bin : f->counts[axis] - 1;
}

static size_t bin_of(const sbfi_tetrahedron_finder *f, sbfi_d3 at) {
  size_t x = bin_along(f, at.x, f->origin.x, 0), y = bin_along(f, at.y, f->origin.y, 1),
         z = bin_along(f, at.z, f->origin.z, 2);
  return (z * f->counts[1] + y) * f->counts[0] + x;
}

/* The bins' width and number; false where there is none for so many. */
static bool lay_out(sbfi_tetrahedron_finder *f, uint32_t count, size_t *bins) {
  sbfi_d3 low = middle_of(f, 0), high = low;
  double radius2 = 0;
  for (uint32_t t = 0; t < count; t++) {
    sbfi_d3 m = middle_of(f, t);
    low = (sbfi_d3){fmin(low.x, m.x), fmin(low.y, m.y), fmin(low.z, m.z)};
    high = (sbfi_d3){fmax(high.x, m.x), fmax(high.y, m.y), fmax(high.z, m.z)};
    for (int k = 0; k < 4; k++) {
      sbfi_d3 way = sbfi_d3_sub(sbfi_d3_of(f->positions[f->tetrahedra[t].at[k]]), m);
      radius2 = fmax(radius2, sbfi_d3_dot(way, way));
    }
  }
  const double sizes[3] = {high.x - low.x, high.y - low.y, high.z - low.z};
  /* With room for what rounding does to the middles. */
  f->radius = sqrt(radius2) * (1 + 1e-6) + 1e-6 * (sizes[0] + sizes[1] + sizes[2]);
  f->origin = low;
  /* No more bins than four times the tetrahedra, however long and thin the body lies. */
  for (f->width = fmax(f->radius, 1e-30);; f->width *= 2) {
    double all = 1;
    for (int k = 0; k < 3; k++) all *= floor(sizes[k] / f->width) + 1;
    if (all > 4.0 * count + 64) continue;
    *bins = 1;
    for (int k = 0; k < 3; k++) *bins *= f->counts[k] = (uint32_t)(sizes[k] / f->width) + 1;
    return true;
  }
}

bool sbfi_tetrahedron_finder_make(sbfi_tetrahedron_finder *finder, const sbf_vec3 *positions,
    const sbf_uint4 *tetrahedra, uint32_t count, sbfi_arena *arena) {
  size_t bins = 0;
  *finder = (sbfi_tetrahedron_finder){.positions = positions, .tetrahedra = tetrahedra};
  lay_out(finder, count, &bins);
  finder->begins = sbfi_arena_allocate(arena, bins + 2, sizeof *finder->begins);
  finder->items = sbfi_arena_allocate(arena, count, sizeof *finder->items);
  finder->middles = sbfi_arena_allocate(arena, count, sizeof *finder->middles);
  if (!finder->begins || !finder->items || !finder->middles) return false;
  for (uint32_t t = 0; t < count; t++) finder->begins[bin_of(finder, middle_of(finder, t)) + 2]++;
  for (size_t b = 2; b < bins + 2; b++) finder->begins[b] += finder->begins[b - 1];
  for (uint32_t t = 0; t < count; t++) {
    sbfi_d3 middle = middle_of(finder, t);
    uint32_t place = finder->begins[bin_of(finder, middle) + 1]++;
    finder->items[place] = t;
    finder->middles[place] = sbfi_d3_rounded(sbfi_d3_sub(middle, finder->origin));
  }
  return true;
}

/* The bins that may hold middles within `reach` of the point. */
static void bins_around(
    const sbfi_tetrahedron_finder *f, sbfi_d3 at, double reach, uint32_t first[3], uint32_t last[3]) {
  const double place[3] = {at.x, at.y, at.z}, origin[3] = {f->origin.x, f->origin.y, f->origin.z};
  for (int k = 0; k < 3; k++) {
    first[k] = bin_along(f, place[k] - reach, origin[k], k);
    last[k] = bin_along(f, place[k] + reach, origin[k], k);
  }
}

typedef struct search search;
typedef void visitor(search *s, uint32_t tetrahedron, double middle2);

struct search {
  const sbfi_tetrahedron_finder *finder;
  sbfi_d3 at;
  double within2; /* squared distance of the middles that are looked at; visitors may lower it */
  uint32_t best;
  double distance, most, size; /* m; m; what is to be small in the best one */
};

/* Calls for each tetrahedron whose middle lies so near. */
static void visit_within(search *s, double within, visitor *visit) {
  const sbfi_tetrahedron_finder *f = s->finder;
  uint32_t first[3], last[3];
  sbfi_d3 at = sbfi_d3_sub(s->at, f->origin);
  s->within2 = within * within;
  bins_around(f, s->at, within, first, last);
  for (uint32_t z = first[2]; z <= last[2]; z++) {
    for (uint32_t y = first[1]; y <= last[1]; y++) {
      size_t row = ((size_t)z * f->counts[1] + y) * f->counts[0];
      for (uint32_t i = f->begins[row + first[0]]; i < f->begins[row + last[0] + 1]; i++) {
        sbfi_d3 way = sbfi_d3_sub(sbfi_d3_of(f->middles[i]), at);
        double middle2 = sbfi_d3_dot(way, way);
        if (middle2 <= s->within2) visit(s, f->items[i], middle2);
      }
    }
  }
}

/* Whether no weight of sbfi_tetrahedron_weigh is negative. Most of those asked are not the one: the first
 * negative weight ends it. */
static bool is_inside(const sbf_vec3 *positions, const uint32_t corners[4], sbfi_d3 point) {
  sbfi_d3 origin = sbfi_d3_of(positions[corners[3]]), edges[3], from = sbfi_d3_sub(point, origin);
  double volume = 0, last = 1, longest2 = 0;
  for (int k = 0; k < 3; k++) edges[k] = sbfi_d3_sub(sbfi_d3_of(positions[corners[k]]), origin);
  for (int k = 0; k < 3; k++) {
    sbfi_d3 cofactor = sbfi_d3_cross(edges[(k + 1) % 3], edges[(k + 2) % 3]);
    if (k == 0) volume = sbfi_d3_dot(edges[0], cofactor);
    double weight = sbfi_d3_dot(from, cofactor) / volume;
    if (weight < -slack) return false;
    last -= weight;
  }
  if (last < -slack) return false;
  for (int k = 0; k < 3; k++) longest2 = fmax(longest2, sbfi_d3_dot(edges[k], edges[k]));
  return fabs(volume) > 1e-6 * longest2 * sqrt(longest2);
}

static void look_inside(search *s, uint32_t tetrahedron, double middle2) {
  const sbfi_tetrahedron_finder *f = s->finder;
  (void)middle2;
  if (tetrahedron >= s->best) return;
  if (is_inside(f->positions, f->tetrahedra[tetrahedron].at, s->at)) s->best = tetrahedron;
}

/* Whether one of the sides' planes has the tetrahedron on its one side and, farther off than that, the point
 * on the other. */
static bool is_farther(const sbfi_tetrahedron_finder *f, uint32_t tetrahedron, sbfi_d3 at, double distance) {
  static const int faces[4][4] = {{1, 2, 3, 0}, {0, 3, 2, 1}, {0, 1, 3, 2}, {0, 2, 1, 3}};
  sbfi_d3 c[4];
  for (int k = 0; k < 4; k++) c[k] = sbfi_d3_of(f->positions[f->tetrahedra[tetrahedron].at[k]]);
  for (int i = 0; i < 4; i++) {
    sbfi_d3 from = c[faces[i][0]];
    sbfi_d3 normal = sbfi_d3_cross(sbfi_d3_sub(c[faces[i][1]], from), sbfi_d3_sub(c[faces[i][2]], from));
    double own = sbfi_d3_dot(normal, sbfi_d3_sub(c[faces[i][3]], from));
    double side = sbfi_d3_dot(normal, sbfi_d3_sub(at, from));
    if (own * side < 0 && side * side > distance * distance * sbfi_d3_dot(normal, normal)) return true;
  }
  return false;
}

/* To the nearest of the sides. */
static double distance_to(const sbfi_tetrahedron_finder *f, uint32_t tetrahedron, sbfi_d3 at) {
  static const int faces[4][3] = {{0, 1, 2}, {0, 1, 3}, {0, 2, 3}, {1, 2, 3}};
  const double point[3] = {at.x, at.y, at.z};
  double corners[4][3], unused[3], least = INFINITY;
  for (int k = 0; k < 4; k++) {
    sbf_vec3 p = f->positions[f->tetrahedra[tetrahedron].at[k]];
    corners[k][0] = p.x, corners[k][1] = p.y, corners[k][2] = p.z;
  }
  for (int i = 0; i < 4; i++)
    least = fmin(least, sbfi_triangle_closest(
                            corners[faces[i][0]], corners[faces[i][1]], corners[faces[i][2]], point, unused));
  return sqrt(least);
}

/* The middle nearest to the point, for a first distance. */
static void look_for_middle(search *s, uint32_t tetrahedron, double middle2) {
  if (middle2 == s->within2 && tetrahedron > s->best) return;
  s->within2 = middle2;
  s->best = tetrahedron;
}

static void look_near(search *s, uint32_t tetrahedron, double middle2) {
  (void)middle2;
  if (is_farther(s->finder, tetrahedron, s->at, s->distance)) return;
  double distance = distance_to(s->finder, tetrahedron, s->at);
  if (distance < s->distance || (distance == s->distance && tetrahedron < s->best)) s->best = tetrahedron;
  s->distance = fmin(s->distance, distance);
  double within = s->distance + s->finder->radius;
  s->within2 = within * within;
}

static void look_for_small(search *s, uint32_t tetrahedron, double middle2) {
  double weights[4], size = 0;
  const uint32_t *corners = s->finder->tetrahedra[tetrahedron].at;
  (void)middle2;
  if (!sbfi_tetrahedron_weigh(s->finder->positions, corners, s->at, weights)) return;
  for (int k = 0; k < 4; k++) size += weights[k] * weights[k];
  if (size > s->size || (size == s->size && tetrahedron >= s->best)) return;
  if (is_farther(s->finder, tetrahedron, s->at, s->most)) return;
  if (distance_to(s->finder, tetrahedron, s->at) > s->most) return;
  s->size = size;
  s->best = tetrahedron;
}

sbfi_found_tetrahedron sbfi_tetrahedron_find(const sbfi_tetrahedron_finder *finder, sbf_vec3 point) {
  search s = {finder, sbfi_d3_of(point), 0, UINT32_MAX, INFINITY, 0, INFINITY};
  visit_within(&s, finder->radius, look_inside);
  if (s.best != UINT32_MAX) return (sbfi_found_tetrahedron){s.best, 0};
  for (double reach = finder->radius; s.best == UINT32_MAX; reach *= 2)
    visit_within(&s, reach, look_for_middle);
  s.distance = distance_to(finder, s.best, s.at);
  /* What is nearer has its middle within that way and a radius. */
  visit_within(&s, s.distance + finder->radius, look_near);
  s.most = s.distance + finder->radius / 2;
  /* The nearest itself first: few others have smaller weights, and of those alone the distance is asked. */
  uint32_t nearest = s.best;
  s.best = UINT32_MAX;
  look_for_small(&s, nearest, 0);
  visit_within(&s, s.most + finder->radius, look_for_small);
  return (sbfi_found_tetrahedron){s.best != UINT32_MAX ? s.best : nearest, s.distance};
}
