#include "build/embed/tetrahedron_finder.h"

#include "build/geometry/triangle_tree.h"

static const double slack = 1e-9; /* weight tolerance: a point between two tetrahedra is in both */

static void solve(sbfi_solved_tetrahedron *of, const sbf_vec3 *positions, const uint32_t corners[4]) {
  sbfi_d3 origin = sbfi_d3_of(positions[corners[3]]), edges[3];
  double longest2 = 0;
  for (int k = 0; k < 3; k++) {
    edges[k] = sbfi_d3_sub(sbfi_d3_of(positions[corners[k]]), origin);
    longest2 = fmax(longest2, sbfi_d3_dot(edges[k], edges[k]));
  }
  for (int k = 0; k < 3; k++) of->cofactors[k] = sbfi_d3_cross(edges[(k + 1) % 3], edges[(k + 2) % 3]);
  of->volume = sbfi_d3_dot(edges[0], of->cofactors[0]);
  if (!(fabs(of->volume) > 1e-6 * longest2 * sqrt(longest2))) of->volume = 0;
}

static bool weigh_solved(
    const sbfi_solved_tetrahedron *in, sbf_vec3 last_corner, sbfi_d3 point, double weights[4]) {
  if (in->volume == 0) return false;
  sbfi_d3 from = sbfi_d3_sub(point, sbfi_d3_of(last_corner));
  weights[3] = 1;
  for (int k = 0; k < 3; k++) {
    weights[k] = sbfi_d3_dot(from, in->cofactors[k]) / in->volume;
    weights[3] -= weights[k];
  }
  return true;
}

bool sbfi_tetrahedron_weigh(
    const sbf_vec3 *positions, const uint32_t corners[4], sbfi_d3 point, double weights[4]) {
  sbfi_solved_tetrahedron solved;
  solve(&solved, positions, corners);
  return weigh_solved(&solved, positions[corners[3]], point, weights);
}

static sbfi_d3 middle_of(const sbfi_tetrahedron_finder *f, uint32_t tetrahedron) {
  sbfi_d3 sum = {0, 0, 0};
  for (int k = 0; k < 4; k++)
    sum = sbfi_d3_add(sum, sbfi_d3_of(f->positions[f->tetrahedra[tetrahedron].at[k]]));
  return sbfi_d3_scale(sum, 0.25);
}

static uint32_t bin_along(const sbfi_tetrahedron_finder *f, double coordinate, double origin, int axis) {
  double bin = (coordinate - origin) / f->width;
  if (!(bin > 0)) return 0;
  return bin < f->counts[axis] - 1 ? (uint32_t)bin : f->counts[axis] - 1;
}

static size_t bin_of(const sbfi_tetrahedron_finder *f, sbfi_d3 at) {
  size_t x = bin_along(f, at.x, f->origin.x, 0), y = bin_along(f, at.y, f->origin.y, 1),
         z = bin_along(f, at.z, f->origin.z, 2);
  return (z * f->counts[1] + y) * f->counts[0] + x;
}

/* Chooses the bins' width, at least `min_width` radii, and number; false if there are too many. */
static bool lay_out(sbfi_tetrahedron_finder *f, uint32_t count, double min_width, size_t *bins) {
  sbfi_d3 low = middle_of(f, 0), high = low;
  double radius2 = 0, max_spread = 0;
  for (uint32_t t = 0; t < count; t++) {
    double spread = 0;
    sbfi_d3 m = middle_of(f, t);
    low = (sbfi_d3){fmin(low.x, m.x), fmin(low.y, m.y), fmin(low.z, m.z)};
    high = (sbfi_d3){fmax(high.x, m.x), fmax(high.y, m.y), fmax(high.z, m.z)};
    for (int k = 0; k < 4; k++) {
      sbfi_d3 displacement = sbfi_d3_sub(sbfi_d3_of(f->positions[f->tetrahedra[t].at[k]]), m);
      double way2 = sbfi_d3_dot(displacement, displacement);
      if (way2 > radius2) radius2 = way2;
      spread += way2;
    }
    if (spread > max_spread) max_spread = spread;
  }
  const double sizes[3] = {high.x - low.x, high.y - low.y, high.z - low.z};
  f->rounding = 1e-6 * (sizes[0] + sizes[1] + sizes[2]);
  f->radius = sqrt(radius2) * (1 + 1e-6) + f->rounding;
  f->spread = sqrt(max_spread) * (1 + 1e-6);
  f->origin = low;
  /* At most four bins per tetrahedron, also for a long and thin body. */
  for (f->width = fmax(min_width * f->radius, 1e-30);; f->width *= 1.25) {
    double all = 1;
    for (int k = 0; k < 3; k++) all *= floor(sizes[k] / f->width) + 1;
    if (all > 4.0 * count + 64) continue;
    *bins = 1;
    for (int k = 0; k < 3; k++) *bins *= f->counts[k] = (uint32_t)(sizes[k] / f->width) + 1;
    return true;
  }
}

/* A search evaluates some tens of tetrahedra: if there are no more than this per search, solving them in
 * advance is faster. */
enum { PER_SEARCH = 16 };

static bool solve_all(sbfi_tetrahedron_finder *f, uint32_t count, sbfi_arena *arena) {
  f->solved = sbfi_arena_allocate(arena, count, sizeof *f->solved);
  if (!f->solved) return false;
  for (uint32_t t = 0; t < count; t++) solve(&f->solved[t], f->positions, f->tetrahedra[t].at);
  return true;
}

bool sbfi_tetrahedron_finder_make(sbfi_tetrahedron_finder *finder, const sbf_vec3 *positions,
    const sbf_uint4 *tetrahedra, uint32_t count, uint32_t searches, sbfi_arena *arena) {
  size_t bins = 0;
  *finder = (sbfi_tetrahedron_finder){.positions = positions, .tetrahedra = tetrahedra};
  bool prepare = count / PER_SEARCH <= searches;
  lay_out(finder, count, prepare ? 0.85 : 1, &bins);
  finder->begins = sbfi_arena_allocate(arena, bins + 2, sizeof *finder->begins);
  finder->items = sbfi_arena_allocate(arena, count, sizeof *finder->items);
  finder->middles = sbfi_arena_allocate(arena, count, sizeof *finder->middles);
  if (!finder->begins || !finder->items || !finder->middles) return false;
  for (uint32_t t = 0; t < count; t++) finder->begins[bin_of(finder, middle_of(finder, t)) + 2]++;
  for (size_t b = 2; b < bins + 2; b++) finder->begins[b] += finder->begins[b - 1];
  for (uint32_t t = 0; t < count; t++) {
    sbfi_d3 middle = middle_of(finder, t);
    uint32_t index = finder->begins[bin_of(finder, middle) + 1]++;
    finder->items[index] = t;
    finder->middles[index] = sbfi_d3_rounded(sbfi_d3_sub(middle, finder->origin));
  }
  return !prepare || solve_all(finder, count, arena);
}

/* Range of bins that may contain centres within `reach` of the point. */
static void bins_around(
    const sbfi_tetrahedron_finder *f, sbfi_d3 at, double reach, uint32_t first[3], uint32_t last[3]) {
  const double position[3] = {at.x, at.y, at.z}, origin[3] = {f->origin.x, f->origin.y, f->origin.z};
  for (int k = 0; k < 3; k++) {
    first[k] = bin_along(f, position[k] - reach, origin[k], k);
    last[k] = bin_along(f, position[k] + reach, origin[k], k);
  }
}

typedef struct search search;
typedef void visitor(search *s, uint32_t tetrahedron, double middle2);

struct search {
  const sbfi_tetrahedron_finder *finder;
  sbfi_d3 at;
  double within2; /* squared distance of centres to visit; visitors may reduce it */
  uint32_t best;
  double distance, max, size; /* m; m; quantity that is minimized */
};

/* Distance from a coordinate to a bin along one axis, both relative to the origin. Nothing is beyond the
 * outermost bins. */
static double gap_to_bin(double coordinate, uint32_t bin, double width) {
  double below = bin * width - coordinate, above = coordinate - (bin + 1.0) * width;
  return below > 0 ? below : above > 0 ? above : 0;
}

/* Visits each tetrahedron whose centre is within the distance. */
static void visit_within(search *s, double within, visitor *visit) {
  const sbfi_tetrahedron_finder *f = s->finder;
  uint32_t first[3], last[3];
  sbfi_d3 at = sbfi_d3_sub(s->at, f->origin);
  double spare = 1e-6 * (f->width + within); /* margin for rounding of the centres */
  s->within2 = within * within;
  bins_around(f, s->at, within, first, last);
  for (uint32_t z = first[2]; z <= last[2]; z++) {
    double off_z = gap_to_bin(at.z, z, f->width);
    for (uint32_t y = first[1]; y <= last[1]; y++) {
      double off_y = gap_to_bin(at.y, y, f->width);
      double left2 = s->within2 - off_z * off_z - off_y * off_y;
      if (left2 < -spare * within) continue;
      double along = (left2 > 0 ? sqrt(left2) : 0) + spare;
      size_t row = ((size_t)z * f->counts[1] + y) * f->counts[0];
      uint32_t begin = f->begins[row + bin_along(f, s->at.x - along, f->origin.x, 0)];
      uint32_t end = f->begins[row + bin_along(f, s->at.x + along, f->origin.x, 0) + 1];
      for (uint32_t i = begin; i < end; i++) {
        sbfi_d3 displacement = sbfi_d3_sub(sbfi_d3_of(f->middles[i]), at);
        double middle2 = sbfi_d3_dot(displacement, displacement);
        if (middle2 <= s->within2) visit(s, f->items[i], middle2);
      }
    }
  }
}

/* Solution of a tetrahedron: precomputed, or computed now. */
static const sbfi_solved_tetrahedron *solved_of(
    const sbfi_tetrahedron_finder *f, uint32_t tetrahedron, sbfi_solved_tetrahedron *now) {
  if (f->solved) return &f->solved[tetrahedron];
  solve(now, f->positions, f->tetrahedra[tetrahedron].at);
  return now;
}

static bool any_below(const double weights[4], double limit) {
  return weights[0] < limit || weights[1] < limit || weights[2] < limit || weights[3] < limit;
}

/* Whether one of the first three weights is clearly negative: this excludes most tetrahedra without a
 * division. */
static bool is_clearly_outside(const sbfi_solved_tetrahedron *in, sbf_vec3 last_corner, sbfi_d3 point) {
  sbfi_d3 from = sbfi_d3_sub(point, sbfi_d3_of(last_corner));
  double limit = -2 * slack * in->volume * in->volume;
  for (int k = 0; k < 3; k++)
    if (sbfi_d3_dot(from, in->cofactors[k]) * in->volume < limit) return true;
  return false;
}

static void find_inside(search *s, uint32_t tetrahedron, double middle2) {
  const sbfi_tetrahedron_finder *f = s->finder;
  sbfi_solved_tetrahedron now;
  double weights[4];
  (void)middle2;
  if (tetrahedron >= s->best) return;
  const sbfi_solved_tetrahedron *in = solved_of(f, tetrahedron, &now);
  sbf_vec3 last_corner = f->positions[f->tetrahedra[tetrahedron].at[3]];
  if (is_clearly_outside(in, last_corner, s->at) || !weigh_solved(in, last_corner, s->at, weights)) return;
  if (!any_below(weights, -slack)) s->best = tetrahedron;
}

/* Whether a face's plane separates the tetrahedron from a point with these weights by more than the
 * distance. */
static bool is_farther(const sbfi_solved_tetrahedron *in, const double weights[4], double distance) {
  sbfi_d3 last = sbfi_d3_add(sbfi_d3_add(in->cofactors[0], in->cofactors[1]), in->cofactors[2]);
  for (int k = 0; k < 4; k++) {
    sbfi_d3 normal = k < 3 ? in->cofactors[k] : last;
    double off = weights[k] * in->volume; /* times the normal's length */
    if (weights[k] < 0 && off * off > distance * distance * sbfi_d3_dot(normal, normal)) return true;
  }
  return false;
}

/* Distance to the nearest face towards the point (the faces with negative weights), or to all faces if no
 * weight is negative. NULL: the weights are unknown. */
static double distance_to(
    const sbfi_tetrahedron_finder *f, uint32_t tetrahedron, sbfi_d3 at, const double *weights) {
  static const int faces[4][3] = {{1, 2, 3}, {0, 2, 3}, {0, 1, 3}, {0, 1, 2}}; /* opposite to each corner */
  const double point[3] = {at.x, at.y, at.z};
  double corners[4][3], unused[3], min = INFINITY;
  bool any = !weights || !any_below(weights, 0);
  for (int k = 0; k < 4; k++) {
    sbf_vec3 p = f->positions[f->tetrahedra[tetrahedron].at[k]];
    corners[k][0] = p.x, corners[k][1] = p.y, corners[k][2] = p.z;
  }
  for (int i = 0; i < 4; i++)
    if (any || weights[i] < 0)
      min = fmin(min, sbfi_triangle_closest(
                          corners[faces[i][0]], corners[faces[i][1]], corners[faces[i][2]], point, unused));
  return sqrt(min);
}

/* Nearest centre to the point, for an initial distance. */
static void find_middle(search *s, uint32_t tetrahedron, double middle2) {
  if (middle2 == s->within2 && tetrahedron > s->best) return;
  s->within2 = middle2;
  s->best = tetrahedron;
}

static void find_nearby(search *s, uint32_t tetrahedron, double middle2) {
  const sbfi_tetrahedron_finder *f = s->finder;
  sbfi_solved_tetrahedron now;
  double weights[4];
  (void)middle2;
  const sbfi_solved_tetrahedron *in = solved_of(f, tetrahedron, &now);
  bool known = weigh_solved(in, f->positions[f->tetrahedra[tetrahedron].at[3]], s->at, weights);
  if (known && is_farther(in, weights, s->distance)) return;
  double distance = distance_to(f, tetrahedron, s->at, known ? weights : NULL);
  if (distance < s->distance || (distance == s->distance && tetrahedron < s->best)) s->best = tetrahedron;
  s->distance = fmin(s->distance, distance);
  double within = s->distance + f->radius;
  s->within2 = within * within;
}

/* Maximum distance of a tetrahedron's centre from the point if the sum of squares of the point's weights
 * is at most `size`: the offset is the sum of the corners' offsets from the centre, each times its weight
 * minus a quarter (Cauchy-Schwarz inequality). */
static double within_of_size(const sbfi_tetrahedron_finder *f, double size) {
  return f->spread * sqrt(size > 0.25 ? size - 0.25 : 0) * (1 + 1e-9) + f->rounding;
}

static void find_small(search *s, uint32_t tetrahedron, double middle2) {
  const sbfi_tetrahedron_finder *f = s->finder;
  sbfi_solved_tetrahedron now;
  double weights[4], size = 0;
  (void)middle2;
  const sbfi_solved_tetrahedron *in = solved_of(f, tetrahedron, &now);
  if (!weigh_solved(in, f->positions[f->tetrahedra[tetrahedron].at[3]], s->at, weights)) return;
  for (int k = 0; k < 4; k++) size += weights[k] * weights[k];
  if (size > s->size || (size == s->size && tetrahedron >= s->best)) return;
  if (is_farther(in, weights, s->max)) return;
  if (distance_to(f, tetrahedron, s->at, weights) > s->max) return;
  s->size = size;
  s->best = tetrahedron;
  double within = within_of_size(f, size);
  if (within * within < s->within2) s->within2 = within * within;
}

sbfi_found_tetrahedron sbfi_tetrahedron_find(const sbfi_tetrahedron_finder *finder, sbf_vec3 point) {
  search s = {finder, sbfi_d3_of(point), 0, UINT32_MAX, INFINITY, 0, INFINITY};
  visit_within(&s, finder->radius, find_inside);
  if (s.best != UINT32_MAX) return (sbfi_found_tetrahedron){s.best, 0};
  for (double reach = finder->radius; s.best == UINT32_MAX; reach *= 2) visit_within(&s, reach, find_middle);
  s.distance = distance_to(finder, s.best, s.at, NULL);
  /* Anything nearer has its centre within that distance plus a radius. */
  visit_within(&s, s.distance + finder->radius, find_nearby);
  s.max = s.distance + finder->radius / 2;
  /* The nearest first: few others have smaller weights, and only for those the distance is computed. */
  uint32_t nearest = s.best;
  s.best = UINT32_MAX;
  find_small(&s, nearest, 0);
  visit_within(&s, fmin(s.max + finder->radius, within_of_size(finder, s.size)), find_small);
  return (sbfi_found_tetrahedron){s.best != UINT32_MAX ? s.best : nearest, s.distance};
}

typedef struct corner_search {
  search s; /* first member, so that visitors can cast to it */
  uint32_t corner;
  sbfi_tetrahedron_visitor *visit;
  void *user;
} corner_search;

static void find_corner(search *s, uint32_t tetrahedron, double middle2) {
  const corner_search *c = (const corner_search *)s;
  const uint32_t *at = s->finder->tetrahedra[tetrahedron].at;
  (void)middle2;
  if (at[0] == c->corner || at[1] == c->corner || at[2] == c->corner || at[3] == c->corner)
    c->visit(c->user, tetrahedron);
}

void sbfi_find_tetrahedra_about(
    const sbfi_tetrahedron_finder *finder, uint32_t corner, sbfi_tetrahedron_visitor *visit, void *user) {
  corner_search c = {{.finder = finder, .at = sbfi_d3_of(finder->positions[corner])}, corner, visit, user};
  visit_within(&c.s, finder->radius, find_corner);
}
