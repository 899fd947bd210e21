#include "build/levels/level_statics.h"

#include <math.h>
#include <string.h>

#include "mechanics/vector.h"

/* Of Newton's method: what has not come to rest by then folds up. */
enum { MOST_STEPS = 15 };

/* Of the square of the lowest frequency: so weakly a body that nothing holds is drawn to its place, which
 * moves nothing, the loads being balanced, and keeps the equations solvable. */
static const double tether = 1e-3;

static double component(sbf_vec3 v, int axis) {
  return axis == 0 ? v.x : axis == 1 ? v.y : v.z;
}

/* ---- The network ---- */

static bool acts(const sbf_level *level, const sbf_spring_set *set) {
  return set->extra || level->model == SBF_ELASTIC_MODEL_SPRINGS;
}

static bool take_springs(sbfi_level_statics *s, sbfi_arena *arena) {
  const sbf_level *level = s->level;
  size_t all = 0, used = 0, at = 0;
  for (uint32_t i = 0; i < level->springs.count; i++) {
    all += level->springs.at[i].ends.count;
    if (acts(level, &level->springs.at[i])) used += level->springs.at[i].ends.count;
  }
  if (used == 0) return true;
  uint32_t points = level->positions.count;
  float *every = sbfi_arena_allocate(arena, all, sizeof *every);
  float *stiffness = sbfi_arena_allocate(arena, used, sizeof *stiffness);
  sbf_uint2 *ends = sbfi_arena_allocate(arena, used, sizeof *ends);
  float *volumes = sbfi_arena_allocate(arena, points, sizeof *volumes);
  double *work = sbfi_arena_allocate(arena, points, 2 * sizeof *work);
  if (!every || !stiffness || !ends || !volumes || !work) return false;
  sbf_level_stiffness(s->body, level, volumes, work, every);
  for (uint32_t i = 0; i < level->springs.count; every += level->springs.at[i++].ends.count) {
    const sbf_spring_set *set = &level->springs.at[i];
    if (!acts(level, set)) continue;
    memcpy(ends + at, set->ends.at, set->ends.count * sizeof *ends);
    memcpy(stiffness + at, every, set->ends.count * sizeof *stiffness);
    at += set->ends.count;
  }
  s->network.ends = ends;
  s->network.stiffness = stiffness;
  s->network.spring_count = (uint32_t)used;
  return true;
}

static bool take_tetrahedra(sbfi_level_statics *s, sbfi_arena *arena) {
  const sbf_uint4_list *at = &s->level->lattice.tetrahedra;
  if (s->level->model != SBF_ELASTIC_MODEL_TETRAHEDRA || at->count == 0) return true;
  float *factors = sbfi_arena_allocate(arena, s->level->positions.count, sizeof *factors);
  float *moduli = sbfi_arena_allocate(arena, at->count, sizeof *moduli);
  float *ratios = sbfi_arena_allocate(arena, at->count, sizeof *ratios);
  if (!factors || !moduli || !ratios) return false;
  sbf_level_moduli(s->body, s->level, factors, moduli);
  for (uint32_t t = 0; t < at->count; t++) ratios[t] = s->body->attributes.poisson_ratio;
  s->network.tetrahedra = at->at;
  s->network.tetrahedron_count = at->count;
  s->network.young_modulus = moduli;
  s->network.poisson_ratios = ratios;
  return true;
}

static float weight_of(const sbf_pin_set *set, uint32_t i) {
  float w = set->weights.count == 0 ? 1 : set->weights.at[set->weights.count == 1 ? 0 : i];
  return fminf(fmaxf(w, set->minimum), set->maximum);
}

/* By Newton's method from above: the same bits on every machine. */
static double cube_root(double x) {
  double root = x > 1 ? x : 1, before = 0;
  for (int i = 0; i < 2000 && x > 0 && root != before; i++) {
    before = root;
    root = fmin(root, (2 * root + x / (root * root)) / 3);
  }
  return x > 0 ? root : 0;
}

/* Goal springs. */
static bool take_anchors(sbfi_level_statics *s, const float *masses, sbfi_arena *arena) {
  const sbf_attributes *matter = &s->body->attributes;
  float *anchors = sbfi_arena_allocate(arena, s->level->positions.count, sizeof *anchors);
  bool any = false;
  if (!anchors) return false;
  for (uint32_t p = 0; p < s->level->pins.count; p++) {
    const sbf_pin_set *set = &s->level->pins.at[p];
    for (uint32_t i = 0; i < set->points.count; i++) {
      uint32_t point = set->points.at[i];
      float w = weight_of(set, i), k = set->stiffness;
      if (!(w > 0) || w >= 1 || !(masses[point] > 0)) continue;
      if (!(k > 0)) k = matter->young_modulus * (float)cube_root(masses[point] / (double)matter->density);
      anchors[point] += w * k;
      any = true;
    }
  }
  s->network.anchors = any ? anchors : NULL;
  s->held |= any;
  return true;
}

static bool add_tethers(sbfi_level_statics *s, sbfi_arena *arena) {
  uint32_t count = s->network.point_count;
  float *anchors = sbfi_arena_allocate(arena, (size_t)count + 1, sizeof *anchors);
  if (!anchors) return false;
  double lowest = sbfi_level_lowest(s, arena);
  for (uint32_t i = 0; i < count; i++) anchors[i] = (float)(tether * lowest * lowest * s->network.masses[i]);
  s->network.anchors = anchors;
  return true;
}

/* ---- The surface ---- */

static bool carry_surface(sbfi_level_statics *s, const sbfi_interior_map *interior, sbfi_arena *arena) {
  const sbf_vec3_list *points = &s->body->surface.positions;
  sbfi_carrier carrier;
  uint32_t frame = s->level->model == SBF_ELASTIC_MODEL_JIGGLE ? 0 : UINT32_MAX;
  s->carried = sbfi_arena_allocate(arena, (size_t)points->count + 1, sizeof *s->carried);
  s->areas = sbfi_arena_allocate(arena, (size_t)points->count + 1, sizeof *s->areas);
  if (!s->carried || !s->areas || !sbfi_carrier_make(&carrier, s->body, s->level, interior, frame, arena))
    return false;
  sbf_surface_point_areas(&s->body->surface, s->areas);
  for (int k = 0; k < 3; k++) s->low[k] = INFINITY, s->high[k] = -INFINITY;
  for (uint32_t i = 0; i < points->count; i++) {
    s->carried[i] = sbfi_carrier_carry(&carrier, points->at[i], i);
    for (int k = 0; k < 3; k++) {
      s->low[k] = fmin(s->low[k], component(points->at[i], k));
      s->high[k] = fmax(s->high[k], component(points->at[i], k));
    }
  }
  for (int k = 0; k < 3; k++) s->size += (s->high[k] - s->low[k]) * (s->high[k] - s->low[k]);
  s->size = sqrt(s->size);
  return true;
}

bool sbfi_level_statics_make(sbfi_level_statics *statics, const sbf_soft_body *body, const sbf_level *level,
    const sbfi_interior_map *interior, sbfi_arena *arena) {
  uint32_t count = level->positions.count;
  *statics = (sbfi_level_statics){
      .body = body, .level = level, .network = {.point_count = count, .positions = level->positions.at}};
  uint8_t *held = sbfi_arena_allocate(arena, (size_t)count + 1, 1);
  float *masses = sbfi_arena_allocate(arena, (size_t)count + 1, sizeof *masses);
  if (!held || !masses) return false;
  statics->held = sbf_level_held_points(level, held) > 0;
  statics->mass = sbf_level_masses(body, level, held, masses);
  statics->network.masses = masses;
  if (!take_springs(statics, arena) || !take_tetrahedra(statics, arena) ||
      !take_anchors(statics, masses, arena) || !carry_surface(statics, interior, arena))
    return false;
  if (!statics->held && !add_tethers(statics, arena)) return false;
  statics->load_count = statics->held ? SBFI_HELD_LOADS : SBFI_FREE_LOADS;
  return true;
}

/* ---- Loads ---- */

/* A rigid motion: v + w x (r - middle). */
typedef struct rigid {
  sbfi_d3 middle, v, w;
} rigid;

/* Solves the symmetric m x = r; x is 0 where m is singular, as for points on a line. */
static sbfi_d3 solve3(const double m[6], sbfi_d3 r) {
  sbfi_d3 a = {m[0], m[3], m[5]}, b = {m[3], m[1], m[4]}, c = {m[5], m[4], m[2]};
  sbfi_d3 bc = sbfi_d3_cross(b, c), ca = sbfi_d3_cross(c, a), ab = sbfi_d3_cross(a, b);
  double det = sbfi_d3_dot(a, bc), scale = fabs(m[0]) + fabs(m[1]) + fabs(m[2]);
  if (!(fabs(det) > 1e-12 * scale * scale * scale)) return (sbfi_d3){0, 0, 0};
  return sbfi_d3_scale((sbfi_d3){sbfi_d3_dot(bc, r), sbfi_d3_dot(ca, r), sbfi_d3_dot(ab, r)}, 1 / det);
}

/* The rigid motion nearest to a field over weighted places. */
static rigid nearest_rigid(
    const sbf_vec3 *places, const float *weights, const double *field, uint32_t count) {
  rigid motion = {{0, 0, 0}, {0, 0, 0}, {0, 0, 0}};
  double sum = 0, tensor[6] = {0};
  for (uint32_t i = 0; i < count; i++) {
    sum += weights[i];
    motion.middle = sbfi_d3_add(motion.middle, sbfi_d3_scale(sbfi_d3_of(places[i]), weights[i]));
    motion.v = sbfi_d3_add(
        motion.v, sbfi_d3_scale((sbfi_d3){field[3 * i], field[3 * i + 1], field[3 * i + 2]}, weights[i]));
  }
  if (!(sum > 0)) return motion;
  motion.middle = sbfi_d3_scale(motion.middle, 1 / sum);
  motion.v = sbfi_d3_scale(motion.v, 1 / sum);
  sbfi_d3 moment = {0, 0, 0};
  for (uint32_t i = 0; i < count; i++) {
    sbfi_d3 r = sbfi_d3_sub(sbfi_d3_of(places[i]), motion.middle);
    sbfi_d3 u = {field[3 * i] - motion.v.x, field[3 * i + 1] - motion.v.y, field[3 * i + 2] - motion.v.z};
    double m = weights[i];
    moment = sbfi_d3_add(moment, sbfi_d3_scale(sbfi_d3_cross(r, u), m));
    tensor[0] += m * (r.y * r.y + r.z * r.z), tensor[1] += m * (r.z * r.z + r.x * r.x);
    tensor[2] += m * (r.x * r.x + r.y * r.y), tensor[3] -= m * r.x * r.y;
    tensor[4] -= m * r.y * r.z, tensor[5] -= m * r.z * r.x;
  }
  motion.w = solve3(tensor, moment);
  return motion;
}

static void take_off(const rigid *motion, const sbf_vec3 *places, double *field, uint32_t count) {
  for (uint32_t i = 0; i < count; i++) {
    sbfi_d3 r = sbfi_d3_sub(sbfi_d3_of(places[i]), motion->middle);
    sbfi_d3 u = sbfi_d3_add(motion->v, sbfi_d3_cross(motion->w, r));
    field[3 * i] -= u.x, field[3 * i + 1] -= u.y, field[3 * i + 2] -= u.z;
  }
}

/* Acceleration of load number `load`, of size 1, at a place, along which axis. */
static int axis_of(const sbfi_level_statics *s, uint32_t load) {
  return (int)(s->held ? load : load / 2);
}
static double strength(const sbfi_level_statics *s, uint32_t load, sbf_vec3 place) {
  if (s->held) return 1;
  int along = (axis_of(s, load) + 1 + (int)(load % 2)) % 3;
  double half = (s->high[along] - s->low[along]) / 2;
  double q = half > 0 ? (component(place, along) - s->low[along]) / half - 1 : 0;
  return q * q;
}

static void find_forces(const sbfi_level_statics *s, uint32_t load, double size, double *forces) {
  const sbf_spring_network *n = &s->network;
  memset(forces, 0, 3 * (size_t)n->point_count * sizeof *forces);
  for (uint32_t i = 0; i < n->point_count; i++)
    forces[3 * (size_t)i + (size_t)axis_of(s, load)] = size * strength(s, load, n->positions[i]);
  if (!s->held) {
    rigid motion = nearest_rigid(n->positions, n->masses, forces, n->point_count);
    take_off(&motion, n->positions, forces, n->point_count);
  }
  for (uint32_t i = 0; i < n->point_count; i++)
    for (int k = 0; k < 3; k++) forces[3 * (size_t)i + (size_t)k] *= n->masses[i];
}

/* Rayleigh's quotient of displacements u under a load: u.f / u.M u. */
static double quotient(const sbf_spring_network *n, const double *forces, const double *places) {
  double work = 0, inertia = 0;
  for (size_t i = 0; i < 3 * (size_t)n->point_count; i++) {
    double moved = places[i] - component(n->positions[i / 3], (int)(i % 3));
    work += forces[i] * moved;
    inertia += n->masses[i / 3] * moved * moved;
  }
  return work > 0 && inertia > 0 ? sqrt(work / inertia) : 0;
}

bool sbfi_level_give(const sbfi_level_statics *s, uint32_t load, double size, double tolerance,
    double *displacements, sbfi_rest *rest, sbfi_arena *scratch) {
  const sbf_spring_network *n = &s->network;
  const sbf_vec3_list *surface = &s->body->surface.positions;
  size_t numbers = 3 * (size_t)n->point_count;
  double *forces = sbfi_arena_allocate(scratch, numbers + 1, sizeof *forces);
  double *places = sbfi_arena_allocate(scratch, numbers + 1, sizeof *places);
  if (!forces || !places) return false;
  find_forces(s, load, size, forces);
  sbfi_static_problem problem = {
      .network = n, .forces = forces, .tolerance = tolerance, .most_steps = MOST_STEPS};
  sbfi_static_outcome outcome;
  sbfi_static_start(n, places);
  if (!sbfi_static_solve(&problem, places, &outcome, &scratch->allocator)) return false;
  *rest = (sbfi_rest){outcome.residual <= 10 * tolerance, quotient(n, forces, places)};
  for (uint32_t i = 0; i < surface->count; i++) {
    const float w[4] = {
        s->carried[i].weights.x, s->carried[i].weights.y, s->carried[i].weights.z, s->carried[i].weights.w};
    for (int k = 0; k < 3; k++) {
      double moved = 0;
      for (int c = 0; c < 4; c++) {
        uint32_t point = s->carried[i].points.at[c];
        moved += w[c] * (places[3 * (size_t)point + (size_t)k] - component(n->positions[point], k));
      }
      displacements[3 * (size_t)i + (size_t)k] = moved;
    }
  }
  if (s->held) return true;
  rigid motion = nearest_rigid(surface->at, s->areas, displacements, surface->count);
  take_off(&motion, surface->at, displacements, surface->count);
  return true;
}

double sbfi_level_yielding(const sbfi_level_statics *s, uint32_t load, const double *displacements) {
  const sbf_vec3_list *surface = &s->body->surface.positions;
  double sum = 0, area = 0;
  for (uint32_t i = 0; i < surface->count; i++) {
    double moved = displacements[3 * (size_t)i + (size_t)axis_of(s, load)];
    sum += s->areas[i] * moved * strength(s, load, surface->at[i]);
    area += s->areas[i];
  }
  return area > 0 ? sum / area : 0;
}

double sbfi_level_lowest(const sbfi_level_statics *s, sbfi_arena *scratch) {
  double *work = sbfi_arena_allocate(scratch, s->network.point_count, 16 * sizeof *work);
  return work ? sbf_network_lowest(&s->network, false, work) : 0;
}

double sbfi_level_cost(const sbfi_level_statics *s, double tick, sbfi_arena *scratch) {
  double *work = sbfi_arena_allocate(scratch, s->network.point_count, 6 * sizeof *work);
  if (!work) return 0;
  double highest = sbf_network_highest(&s->network, 20, work);
  double substeps = fmax(1, ceil(1.1 * tick * highest / 2));
  return substeps * ((double)s->network.spring_count + s->network.tetrahedron_count);
}
