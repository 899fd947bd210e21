#include "build/embed/embedder.h"

#include <math.h>
#include <string.h>

#include "build/embed/point_rings.h"
#include "build/geometry/topology.h"
#include "mechanics/level_points.h"
#include "mechanics/vector.h"

_Static_assert(sizeof(sbf_vec3) == 3 * sizeof(float), "places are compared and copied as three floats");

static size_t slot_of(const sbfi_embedder *c, sbf_vec3 position) {
  uint32_t bits[3];
  memcpy(bits, &position, sizeof bits);
  uint64_t mixed = bits[0] * UINT64_C(0x9e3779b97f4a7c15) ^ bits[1] * UINT64_C(0xc2b2ae3d27d4eb4f) ^
                   bits[2] * UINT64_C(0x165667b19e3779f9);
  size_t slot = (size_t)(mixed ^ mixed >> 29 ^ mixed >> 47) & (c->slot_count - 1);
  const sbf_vec3 *positions = c->body->surface.positions.at;
  while (
      c->slots[slot] != SBFI_NO_INDEX && memcmp(&positions[c->slots[slot]], &position, sizeof position) != 0)
    slot = (slot + 1) & (c->slot_count - 1);
  return slot;
}

static bool hash_positions(sbfi_embedder *c, sbfi_arena *arena) {
  uint32_t count = c->body->surface.positions.count;
  for (c->slot_count = 16; c->slot_count < 2 * (size_t)count;) c->slot_count *= 2;
  c->slots = sbfi_arena_allocate(arena, c->slot_count, sizeof *c->slots);
  if (!c->slots) return false;
  memset(c->slots, 0xff, c->slot_count * sizeof *c->slots);
  for (uint32_t i = 0; i < count; i++) {
    size_t slot = slot_of(c, c->body->surface.positions.at[i]);
    if (c->slots[slot] == SBFI_NO_INDEX) c->slots[slot] = i;
  }
  return true;
}

/* Directions in which extreme points are searched: the axes, then the diagonals of a box. */
static const int8_t directions[SBFI_EMBEDDER_EXTREMES][3] = {{-1, 0, 0}, {0, -1, 0}, {0, 0, -1}, {1, 0, 0},
    {0, 1, 0}, {0, 0, 1}, {-1, -1, -1}, {1, -1, -1}, {-1, 1, -1}, {1, 1, -1}, {-1, -1, 1}, {1, -1, 1},
    {-1, 1, 1}, {1, 1, 1}};

static void find_extremes(sbfi_embedder *c) {
  const sbf_vec3_list *points = &c->level->positions;
  for (int k = 0; k < SBFI_EMBEDDER_EXTREMES; k++) {
    double max = -INFINITY;
    for (uint32_t i = 0; i < points->count; i++) {
      const sbf_vec3 p = points->at[i];
      double here =
          (double)p.x * directions[k][0] + (double)p.y * directions[k][1] + (double)p.z * directions[k][2];
      if (here > max) max = here, c->extremes[k] = i;
    }
  }
  for (int k = 0; k < 3 && points->count > 0; k++) {
    sbfi_d3 across =
        sbfi_d3_sub(sbfi_d3_of(points->at[c->extremes[k + 3]]), sbfi_d3_of(points->at[c->extremes[k]]));
    if (sbfi_d3_length(across) > c->size) c->size = sbfi_d3_length(across);
  }
}

/* A body without polygons uses its points. */
static bool box_points(sbfi_embedder *c, sbfi_arena *arena) {
  const sbf_vec3_list *points = &c->level->positions;
  if (c->surface.triangle_count > 0 || points->count == 0) return true;
  sbfi_box *boxes = sbfi_arena_allocate(arena, points->count, sizeof *boxes);
  if (!boxes) return false;
  for (uint32_t i = 0; i < points->count; i++) {
    memcpy(boxes[i].low, &points->at[i], sizeof boxes[i].low);
    memcpy(boxes[i].high, &points->at[i], sizeof boxes[i].high);
  }
  return sbfi_box_tree_build(&c->points, boxes, points->count, arena);
}

/* A choice of four points: the weights of the position, and their size. */
typedef struct choice {
  uint32_t points[4];
  double weights[4], size; /* sum of squares: at most 1 inside, growing with the distance outside */
} choice;

static sbfi_d3 at_rest(const sbfi_embedder *c, uint32_t point) {
  return sbfi_d3_of(c->level->positions.at[point]);
}

/* Vertices farther outside would amplify small strains too much, and files must not contain such weights. */
static bool is_bounded(const choice *of) {
  for (int k = 0; k < 4; k++)
    if (!(of->weights[k] >= SBFI_MIN_EMBEDDED && of->weights[k] <= SBFI_MAX_EMBEDDED)) return false;
  return true;
}

/* Weights of a position in a tetrahedron; false if that is nearly degenerate. */
static bool weigh(const sbfi_embedder *c, choice *in, sbfi_d3 position) {
  if (!sbfi_tetrahedron_weigh(c->level->positions.at, in->points, position, in->weights)) return false;
  in->size = 0;
  for (int k = 0; k < 4; k++) in->size += in->weights[k] * in->weights[k];
  return true;
}

/* Acceptable sum of squares of a load's weights; at most 1 inside. */
static const double MAX_LOAD_SIZE = 3;

static bool is_good(const sbfi_embedder *c, const choice *of) {
  return c->use == SBFI_EMBEDS_LOADS ? of->size <= MAX_LOAD_SIZE : is_bounded(of);
}

/* Replaces `best` if the weights are smaller, or acceptable while the best's are not. */
static void try_choice(const sbfi_embedder *c, choice *tried, sbfi_d3 position, choice *best) {
  if (!weigh(c, tried, position)) return;
  bool good = is_good(c, tried), other = best->size < INFINITY && is_good(c, best);
  /* A tiny improvement must not count: the choice would depend on rounding. */
  if (good != other ? good : tried->size < best->size * (1 - 1e-6)) *best = *tried;
}

/* Tries the triangle with a fourth point. */
static void try_fourth(
    const sbfi_embedder *c, const uint32_t corners[3], uint32_t fourth, sbfi_d3 position, choice *best) {
  choice tried = {.points = {corners[0], corners[1], corners[2], fourth}};
  if (fourth != SBFI_NO_INDEX) try_choice(c, &tried, position, best);
}

static bool level_corners(const sbfi_embedder *c, uint32_t triangle, uint32_t corners[3]) {
  for (int k = 0; k < 3; k++) {
    corners[k] = sbfi_level_point(c->level, c->surface.triangles[triangle].points[k]);
    if (corners[k] == SBFI_NO_INDEX) return false;
  }
  return true;
}

static sbfi_embedded_vertex written(const sbfi_embedder *c, const choice *chosen, sbfi_d3 position) {
  sbfi_embedded_vertex embedded = {.outside = 0};
  float weights[4];
  for (int k = 0; k < 3; k++) weights[k] = (float)chosen->weights[k];
  weights[3] = (float)(1.0 - weights[0] - weights[1] - weights[2]);
  sbfi_d3 point = {0, 0, 0};
  for (int k = 0; k < 4; k++) {
    embedded.points.at[k] = chosen->points[k];
    point = sbfi_d3_add(point, sbfi_d3_scale(at_rest(c, chosen->points[k]), weights[k]));
  }
  embedded.weights = (sbf_vec4){weights[0], weights[1], weights[2], weights[3]};
  embedded.error = (float)sbfi_d3_length(sbfi_d3_sub(point, position));
  return embedded;
}

/* Comes as close to the position as bounded weights allow, on the line from the centre of the four points. */
static sbfi_embedded_vertex embedded_bounded(const sbfi_embedder *c, const choice *chosen, sbfi_d3 position) {
  choice near = *chosen;
  double fraction = 1;
  for (int k = 0; k < 4 && c->use == SBFI_EMBEDS_VERTICES; k++) {
    double off = chosen->weights[k] - 0.25;
    double bound = (off < 0 ? SBFI_MIN_EMBEDDED : SBFI_MAX_EMBEDDED) - 0.25;
    if (fabs(off) * fraction > fabs(bound)) fraction = bound / off;
  }
  for (int k = 0; k < 4; k++) near.weights[k] = 0.25 + fraction * (chosen->weights[k] - 0.25);
  sbfi_embedded_vertex embedded = written(c, &near, position);
  embedded.beyond = fraction < 1;
  return embedded;
}

static sbfi_embedded_vertex embedded_alone(uint32_t point, double error) {
  return (sbfi_embedded_vertex){{{point, point, point, point}}, {1, 0, 0, 0}, (float)error, 0, false};
}

static double point_distance(const void *user, uint32_t point, const double position[3]) {
  const sbfi_embedder *c = user;
  sbfi_d3 displacement = sbfi_d3_sub(at_rest(c, point), (sbfi_d3){position[0], position[1], position[2]});
  return sbfi_d3_dot(displacement, displacement);
}

static sbfi_embedded_vertex embed_by_points(const sbfi_embedder *c, sbf_vec3 position) {
  double min = INFINITY, at[3] = {position.x, position.y, position.z};
  uint32_t nearest = sbfi_box_tree_nearest(&c->points, at, point_distance, c, &min);
  return embedded_alone(nearest != SBFI_NO_INDEX ? nearest : 0, sqrt(min));
}

/* Without a fourth point off the plane: uses the triangle's point nearest to the vertex. */
static sbfi_embedded_vertex embedded_flat(
    const sbfi_embedder *c, const uint32_t corners[3], sbfi_d3 position) {
  sbfi_d3 a = at_rest(c, corners[0]), b = at_rest(c, corners[1]), d = at_rest(c, corners[2]);
  choice flat = {.points = {corners[0], corners[1], corners[2], corners[0]}};
  sbfi_triangle_closest((double[]){a.x, a.y, a.z}, (double[]){b.x, b.y, b.z}, (double[]){d.x, d.y, d.z},
      (double[]){position.x, position.y, position.z}, flat.weights);
  sbfi_embedded_vertex embedded = written(c, &flat, position);
  /* The fourth point equals the first, so merges the rounding remainder. */
  embedded.weights.x += embedded.weights.w;
  embedded.weights.w = 0;
  return embedded;
}

/* Sum of the amounts by which weights are out of bounds. */
static double excess(const choice *of) {
  double sum = 0;
  for (int k = 0; k < 4; k++)
    sum += fmax(0, SBFI_MIN_EMBEDDED - of->weights[k]) + fmax(0, of->weights[k] - SBFI_MAX_EMBEDDED);
  return sum;
}

/* Bound of the interpolation error by these four points, in units of half the largest second derivative of
 * a field: near points are better than small weights. */
static double interpolation_error(const sbfi_embedder *c, const choice *of, sbfi_d3 position) {
  double sum = 0;
  for (int k = 0; k < 4; k++) {
    sbfi_d3 away = sbfi_d3_sub(at_rest(c, of->points[k]), position);
    sum += fabs(of->weights[k]) * sbfi_d3_dot(away, away);
  }
  return sum;
}

/* Exchanges the four points one by one with the candidate (NULL: all points of the level, or a sample of
 * many) that brings the weights closest to their bounds, until they are within. */
static void exchange(
    const sbfi_embedder *c, const uint32_t *points, uint32_t count, sbfi_d3 position, choice *best) {
  enum { MAX_ROUNDS = 6, MAX_TRIED = 4096 };
  uint32_t stride = count / MAX_TRIED + 1;
  bool changed = best->size < INFINITY && c->use == SBFI_EMBEDS_VERTICES;
  for (int round = 0; round < MAX_ROUNDS && changed && !is_bounded(best); round++) {
    changed = false;
    for (uint32_t slot = 0; slot < 4; slot++)
      for (uint32_t i = 0; i < count && !is_bounded(best); i += stride) {
        choice tried = *best;
        tried.points[slot] = points ? points[i] : i;
        if (!weigh(c, &tried, position) || !(excess(&tried) < excess(best) * (1 - 1e-6))) continue;
        *best = tried;
        changed = true;
      }
  }
}

typedef struct neighbour_search {
  const sbfi_embedder *embedder;
  sbfi_d3 position;
  double error;
  choice *best;
} neighbour_search;

static void try_neighbour(void *user, uint32_t tetrahedron) {
  neighbour_search *n = user;
  choice tried = {.size = 0};
  memcpy(tried.points, n->embedder->level->lattice.tetrahedra.at[tetrahedron].at, sizeof tried.points);
  if (!weigh(n->embedder, &tried, n->position) || !is_bounded(&tried)) return;
  double error = interpolation_error(n->embedder, &tried, n->position);
  if (!(error < n->error * (1 - 1e-6))) return;
  n->error = error;
  *n->best = tried;
}

/* Tries tetrahedra next to that one with weights in bounds. */
static void try_neighbours(const sbfi_embedder *c, uint32_t tetrahedron, sbfi_d3 position, choice *best) {
  neighbour_search n = {c, position, INFINITY, best};
  if (c->use == SBFI_EMBEDS_LOADS) return;
  const sbf_uint4 corners = c->level->lattice.tetrahedra.at[tetrahedron];
  for (int k = 0; k < 4; k++) sbfi_find_tetrahedra_about(&c->lattice, corners.at[k], try_neighbour, &n);
}

/* Tries four of the level's first `count` extremes, and takes those with the smallest weights if they are
 * smaller than the current ones. */
static void try_four_of(const sbfi_embedder *c, int count, sbfi_d3 position, choice *best) {
  for (int i = 0; i < count; i++)
    for (int j = i + 1; j < count; j++)
      for (int k = j + 1; k < count; k++)
        for (int l = k + 1; l < count; l++) {
          choice tried = {.points = {c->extremes[i], c->extremes[j], c->extremes[k], c->extremes[l]}};
          try_choice(c, &tried, position, best);
        }
}

static void try_extremes(const sbfi_embedder *c, sbfi_d3 position, choice *best) {
  try_four_of(c, 6, position, best);
  if (c->use == SBFI_EMBEDS_VERTICES && !is_bounded(best))
    try_four_of(c, SBFI_EMBEDDER_EXTREMES, position, best);
  exchange(c, NULL, c->level->positions.count, position, best);
}

static sbfi_embedded_vertex embed_on_surface(const sbfi_embedder *c, sbf_vec3 position) {
  const double deep = 2; /* weights of this size require another triangle */
  double min = INFINITY;
  sbfi_d3 at = sbfi_d3_of(position);
  uint32_t corners[3], triangle = sbfi_triangle_tree_nearest(&c->surface, position, &min);
  if (triangle == SBFI_NO_INDEX || !level_corners(c, triangle, corners)) return embed_by_points(c, position);
  choice best = {.size = INFINITY};
  uint32_t polygon = c->surface.triangles[triangle].polygon;
  try_fourth(c, corners, c->interior.centre, at, &best);
  if (c->interior.polygon_points) try_fourth(c, corners, c->interior.polygon_points[polygon], at, &best);
  if (best.size > deep && c->interior.centre != SBFI_NO_INDEX) {
    uint32_t through[3], pierced = sbfi_triangle_tree_pierced(
                             &c->surface, c->level->positions.at[c->interior.centre], position, INFINITY);
    if (pierced != SBFI_NO_INDEX && level_corners(c, pierced, through))
      try_fourth(c, through, c->interior.centre, at, &best);
  }
  for (int k = 0; k < 6 && best.size > deep; k++) try_fourth(c, corners, c->extremes[k], at, &best);
  bool is_beyond = c->use == SBFI_EMBEDS_VERTICES && best.size < INFINITY && !is_bounded(&best);
  if (is_beyond) try_extremes(c, at, &best);
  return best.size < INFINITY ? embedded_bounded(c, &best, at) : embedded_flat(c, corners, at);
}

sbfi_embedded_vertex sbfi_embedder_embed_by_frame(const sbfi_embedder *c, uint32_t frame, sbf_vec3 position) {
  choice by = {.size = 0};
  for (int k = 0; k < 4; k++) by.points[k] = frame + (uint32_t)k;
  return weigh(c, &by, sbfi_d3_of(position)) ? embedded_bounded(c, &by, sbfi_d3_of(position))
                                             : embedded_alone(frame, 0);
}

/* Tries points in growing rings around the tetrahedron until the weights are small enough: a small
 * tetrahedron would amplify the motion of a vertex outside it. */
static void try_rings(const sbfi_embedder *c, uint32_t tetrahedron, sbfi_d3 position, choice *best) {
  sbfi_point_rings rings;
  sbfi_point_rings_begin(&rings, &c->lattice, tetrahedron);
  while (!is_good(c, best) && sbfi_point_rings_widen(&rings)) {
    choice tried = {.size = 0};
    sbfi_point_rings_widest(&rings, tried.points);
    try_choice(c, &tried, position, best);
    exchange(c, rings.points, rings.count, position, best);
  }
}

/* A vertex far outside uses the frame points if there are any. Otherwise a vertex outside by at most a
 * tetrahedron's width uses points around it, and one farther away uses widely spaced points, with which it
 * follows the body as a whole: a small tetrahedron would amplify its motion. */
static sbfi_embedded_vertex embed_in_lattice(const sbfi_embedder *c, sbf_vec3 position) {
  sbfi_d3 at = sbfi_d3_of(position);
  sbfi_found_tetrahedron found = sbfi_tetrahedron_find(&c->lattice, position);
  choice in = {.size = 0};
  memcpy(in.points, c->level->lattice.tetrahedra.at[found.tetrahedron].at, sizeof in.points);
  bool good = weigh(c, &in, at), near = found.distance < 2 * c->lattice.radius;
  if (good && !is_good(c, &in)) try_neighbours(c, found.tetrahedron, at, &in);
  if (c->frame != SBFI_NO_INDEX && (!good || !is_good(c, &in)))
    return sbfi_embedder_embed_by_frame(c, c->frame, position);
  if (good && !is_good(c, &in) && near) try_rings(c, found.tetrahedron, at, &in);
  if (good && !is_good(c, &in)) try_extremes(c, at, &in);
  sbfi_embedded_vertex embedded =
      good ? embedded_bounded(c, &in, at) : embedded_alone(in.points[0], found.distance);
  embedded.outside = (float)found.distance;
  return embedded;
}

/* A render mesh mostly equals the surface: its embedding is computed once. */
static bool find_in_lattice(sbfi_embedder *c, sbfi_arena *arena) {
  const sbf_uint4_list *tetrahedra = &c->level->lattice.tetrahedra;
  const sbf_vec3_list *surface = &c->body->surface.positions;
  if (tetrahedra->count == 0) return true;
  c->in_lattice = sbfi_arena_allocate(arena, (size_t)surface->count + 1, sizeof *c->in_lattice);
  if (!c->in_lattice || !sbfi_tetrahedron_finder_make(&c->lattice, c->level->positions.at, tetrahedra->at,
                            tetrahedra->count, surface->count, arena))
    return false;
  for (uint32_t i = 0; i < surface->count; i++) c->in_lattice[i] = embed_in_lattice(c, surface->at[i]);
  return true;
}

bool sbfi_embedder_make(sbfi_embedder *embedder, sbfi_embedder_use use, const sbf_soft_body *body,
    const sbf_level *level, const sbfi_interior_map *interior, uint32_t frame, sbfi_arena *arena) {
  *embedder = (sbfi_embedder){
      .use = use, .body = body, .level = level, .interior = {SBFI_NO_INDEX, NULL}, .frame = frame};
  if (interior) embedder->interior = *interior;
  find_extremes(embedder);
  return hash_positions(embedder, arena) &&
         sbfi_triangle_tree_build(&embedder->surface, &body->surface, arena) &&
         find_in_lattice(embedder, arena) && box_points(embedder, arena);
}

sbfi_embedded_vertex sbfi_embedder_embed(const sbfi_embedder *embedder, sbf_vec3 position, uint32_t likely) {
  const sbf_vec3_list *surface = &embedder->body->surface.positions;
  uint32_t same = likely;
  if (likely >= surface->count || memcmp(&surface->at[likely], &position, sizeof position) != 0)
    same = surface->count ? embedder->slots[slot_of(embedder, position)] : SBFI_NO_INDEX;
  if (embedder->in_lattice)
    return same != SBFI_NO_INDEX ? embedder->in_lattice[same] : embed_in_lattice(embedder, position);
  if (same != SBFI_NO_INDEX) same = sbfi_level_point(embedder->level, same);
  if (same != SBFI_NO_INDEX) return embedded_alone(same, 0);
  return embedder->frame != SBFI_NO_INDEX ? sbfi_embedder_embed_by_frame(embedder, embedder->frame, position)
                                          : embed_on_surface(embedder, position);
}

bool sbfi_embedder_has(const sbfi_embedder *embedder, sbf_vec3 position) {
  return embedder->slots[slot_of(embedder, position)] != SBFI_NO_INDEX;
}

double sbfi_embedder_distance(const sbfi_embedder *embedder, sbf_vec3 position, double min) {
  const double at[3] = {position.x, position.y, position.z};
  if (embedder->points.node_count > 0)
    sbfi_box_tree_nearest(&embedder->points, at, point_distance, embedder, &min);
  sbfi_triangle_tree_nearest(&embedder->surface, position, &min);
  return min;
}
