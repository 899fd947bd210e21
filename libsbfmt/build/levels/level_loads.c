#include "build/levels/level_loads.h"

#include <math.h>
#include <string.h>

#include "mechanics/static_solve.h"
#include "mechanics/vector.h"

/* Limits of Newton steps and of their matrix-vector products: without convergence by then the level folds
 * up. */
enum { MAX_STEPS = 15, MAX_PRODUCTS = 1500 };
/* Maximum number of spring and tetrahedron evaluations in all products, so that no level takes many
 * seconds. */
static const double MAX_VISITS = 3e7;

static double component(sbf_vec3 v, int axis) {
  return axis == 0 ? v.x : axis == 1 ? v.y : v.z;
}

static void load_weights(sbf_vec4 from, double to[4]) {
  to[0] = from.x, to[1] = from.y, to[2] = from.z, to[3] = from.w;
}

/* ---- Rigid motions ---- */

/* A rigid motion: v + w x (r - centre). */
typedef struct rigid {
  sbfi_d3 middle, v, w;
} rigid;

/* Solves the symmetric m x = r; x is 0 if m is singular, as for points on a line. */
static sbfi_d3 solve3(const double m[6], sbfi_d3 r) {
  sbfi_d3 a = {m[0], m[3], m[5]}, b = {m[3], m[1], m[4]}, c = {m[5], m[4], m[2]};
  sbfi_d3 bc = sbfi_d3_cross(b, c), ca = sbfi_d3_cross(c, a), ab = sbfi_d3_cross(a, b);
  double det = sbfi_d3_dot(a, bc), scale = fabs(m[0]) + fabs(m[1]) + fabs(m[2]);
  if (!(fabs(det) > 1e-12 * scale * scale * scale)) return (sbfi_d3){0, 0, 0};
  return sbfi_d3_scale((sbfi_d3){sbfi_d3_dot(bc, r), sbfi_d3_dot(ca, r), sbfi_d3_dot(ab, r)}, 1 / det);
}

/* Best fitting rigid motion of a field at weighted positions. */
static rigid nearest_rigid(
    const sbf_vec3 *positions, const float *weights, const double *field, uint32_t count) {
  rigid motion = {{0, 0, 0}, {0, 0, 0}, {0, 0, 0}};
  double sum = 0, tensor[6] = {0};
  for (uint32_t i = 0; i < count; i++) {
    sum += weights[i];
    motion.middle = sbfi_d3_add(motion.middle, sbfi_d3_scale(sbfi_d3_of(positions[i]), weights[i]));
    motion.v = sbfi_d3_add(
        motion.v, sbfi_d3_scale((sbfi_d3){field[3 * i], field[3 * i + 1], field[3 * i + 2]}, weights[i]));
  }
  if (!(sum > 0)) return motion;
  motion.middle = sbfi_d3_scale(motion.middle, 1 / sum);
  motion.v = sbfi_d3_scale(motion.v, 1 / sum);
  sbfi_d3 moment = {0, 0, 0};
  for (uint32_t i = 0; i < count; i++) {
    sbfi_d3 r = sbfi_d3_sub(sbfi_d3_of(positions[i]), motion.middle);
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

static void subtract_motion(const rigid *motion, const sbf_vec3 *positions, double *field, uint32_t count) {
  for (uint32_t i = 0; i < count; i++) {
    sbfi_d3 r = sbfi_d3_sub(sbfi_d3_of(positions[i]), motion->middle);
    sbfi_d3 u = sbfi_d3_add(motion->v, sbfi_d3_cross(motion->w, r));
    field[3 * i] -= u.x, field[3 * i + 1] -= u.y, field[3 * i + 2] -= u.z;
  }
}

/* Axis of a load, and its acceleration of size 1 at a position. */
static int axis_of(const sbfi_level_statics *s, uint32_t load) {
  if (s->is_pinned) return (int)load;
  return (int)(load < SBFI_BENDS ? load / 2 : load - SBFI_BENDS);
}
static double strength(const sbfi_level_statics *s, uint32_t load, sbf_vec3 position) {
  if (s->is_pinned) return 1;
  bool bends = load < SBFI_BENDS;
  int along = bends ? (axis_of(s, load) + 1 + (int)(load % 2)) % 3 : axis_of(s, load);
  double half = (s->high[along] - s->low[along]) / 2;
  double q = half > 0 ? (component(position, along) - s->low[along]) / half - 1 : 0;
  return bends ? q * q : q;
}

/* ---- Loads ---- */

/* Converts forces to accelerations, subtracts their rigid motion, and converts back. */
static void balance(const sbf_spring_network *n, double *forces) {
  for (size_t i = 0; i < 3 * (size_t)n->point_count; i++)
    forces[i] = n->masses[i / 3] > 0 ? forces[i] / n->masses[i / 3] : 0;
  rigid motion = nearest_rigid(n->positions, n->masses, forces, n->point_count);
  subtract_motion(&motion, n->positions, forces, n->point_count);
  for (size_t i = 0; i < 3 * (size_t)n->point_count; i++) forces[i] *= n->masses[i / 3];
}

void sbfi_level_compute_forces(const sbfi_level_statics *s, uint32_t load, double size, double *forces) {
  const sbf_spring_network *n = &s->network;
  memset(forces, 0, 3 * (size_t)n->point_count * sizeof *forces);
  for (uint32_t i = 0; i < n->point_count; i++)
    forces[3 * (size_t)i + (size_t)axis_of(s, load)] =
        n->masses[i] * size * strength(s, load, n->positions[i]);
  if (!s->is_pinned) balance(n, forces);
}

static bool is_loose(const sbfi_level_statics *s, uint32_t vertex) {
  double weights[4];
  load_weights(s->embedded[vertex].weights, weights);
  for (int k = 0; k < 4; k++)
    if (weights[k] > 1e-3 && s->network.masses[s->embedded[vertex].points.at[k]] > 0) return true;
  return false;
}

bool sbfi_level_pushes_make(sbfi_level_pushes *made, const sbfi_level_statics *s, sbfi_arena *arena) {
  const sbf_vec3_list *points = &s->body->surface.positions;
  double *nearest2 = sbfi_arena_allocate(arena, (size_t)points->count + 1, sizeof *nearest2);
  *made = (sbfi_level_pushes){0};
  made->patches = sbfi_arena_allocate(arena, (size_t)points->count + 1, sizeof *made->patches);
  if (!made->patches || !nearest2) return false;
  uint32_t middle = UINT32_MAX;
  for (uint32_t i = 0; i < points->count; i++) {
    bool is_pushed = s->areas[i] > 0 && is_loose(s, i);
    made->patches[i] = UINT32_MAX;
    nearest2[i] = is_pushed ? INFINITY : -1;
    if (is_pushed && middle == UINT32_MAX) middle = i;
  }
  while (middle != UINT32_MAX && made->patch_count < SBFI_PUSHED_PATCHES) {
    double max = 0;
    uint32_t next = UINT32_MAX;
    for (uint32_t i = 0; i < points->count; i++) {
      sbfi_d3 displacement = sbfi_d3_sub(sbfi_d3_of(points->at[i]), sbfi_d3_of(points->at[middle]));
      double squared = sbfi_d3_dot(displacement, displacement);
      if (squared < nearest2[i]) {
        nearest2[i] = squared;
        made->patches[i] = made->patch_count;
      }
      if (nearest2[i] <= max) continue;
      max = nearest2[i];
      next = i;
    }
    made->patch_count++;
    middle = next;
  }
  for (uint32_t i = 0; i < points->count; i++)
    if (made->patches[i] != UINT32_MAX) made->areas[made->patches[i]] += s->areas[i];
  return true;
}

/* Deterministic pseudo-random direction for a patch in a push. */
static sbfi_d3 find_displacement(uint32_t push, uint32_t patch) {
  uint32_t h = (patch + 1) * 2654435761u + (push + 1) * 2246822519u;
  h = (h ^ h >> 15) * 3266489917u;
  h ^= h >> 13;
  return sbfi_d3_normal((sbfi_d3){
      (double)(h & 1023) - 511.5, (double)(h >> 10 & 1023) - 511.5, (double)(h >> 20 & 1023) - 511.5});
}

/* Force of a twist on a surface of 1 m^2. */
static sbfi_d3 twist_of(const sbfi_level_statics *s, uint32_t axis, sbf_vec3 position) {
  const double from[3] = {position.x, position.y, position.z};
  double q[3], arm = 1;
  for (int k = 0; k < 3; k++) q[k] = from[k] - (s->low[k] + s->high[k]) / 2;
  if (!s->is_pinned) arm = q[axis] / s->size;
  uint32_t b = (axis + 1) % 3, c = (axis + 2) % 3;
  double force[3] = {0};
  force[b] = -arm * q[c] / (s->size * s->size);
  force[c] = arm * q[b] / (s->size * s->size);
  return (sbfi_d3){force[0], force[1], force[2]};
}

void sbfi_level_push(
    const sbfi_level_statics *s, const sbfi_level_pushes *pushes, uint32_t push, double *forces) {
  const sbf_spring_network *n = &s->network;
  memset(forces, 0, 3 * (size_t)n->point_count * sizeof *forces);
  for (uint32_t i = 0; i < s->body->surface.positions.count; i++) {
    uint32_t patch = pushes->patches[i];
    double weights[4];
    if (patch == UINT32_MAX) continue;
    bool twists = push >= SBFI_PUSHES - SBFI_TWISTS;
    sbfi_d3 displacement =
        twists ? twist_of(s, push - (SBFI_PUSHES - SBFI_TWISTS), s->body->surface.positions.at[i])
               : find_displacement(push, patch);
    sbfi_d3 part = sbfi_d3_scale(displacement, twists ? s->areas[i] : s->areas[i] / pushes->areas[patch]);
    load_weights(s->embedded[i].weights, weights);
    for (int k = 0; k < 4; k++) {
      double *to = forces + 3 * (size_t)s->embedded[i].points.at[k];
      to[0] += weights[k] * part.x, to[1] += weights[k] * part.y, to[2] += weights[k] * part.z;
    }
  }
  if (!s->is_pinned) balance(n, forces);
}

/* ---- Results ---- */

/* Rayleigh's quotient of displacements u under a load: u.f / u.M u. */
static double quotient(const sbf_spring_network *n, const double *forces, const double *moved) {
  double work = 0, inertia = 0;
  for (size_t i = 0; i < 3 * (size_t)n->point_count; i++) {
    work += forces[i] * moved[i];
    inertia += n->masses[i / 3] * moved[i] * moved[i];
  }
  return work > 0 && inertia > 0 ? sqrt(work / inertia) : 0;
}

void sbfi_level_get_surface_displacements(
    const sbfi_level_statics *s, const double *moved, double *displacements) {
  const sbf_vec3_list *surface = &s->body->surface.positions;
  for (uint32_t i = 0; i < surface->count; i++) {
    double weights[4];
    load_weights(s->embedded[i].weights, weights);
    for (size_t k = 0; k < 3; k++) {
      double sum = 0;
      for (int c = 0; c < 4; c++) sum += weights[c] * moved[3 * (size_t)s->embedded[i].points.at[c] + k];
      displacements[3 * (size_t)i + k] = sum;
    }
  }
  if (s->is_pinned) return;
  rigid motion = nearest_rigid(surface->at, s->areas, displacements, surface->count);
  subtract_motion(&motion, surface->at, displacements, surface->count);
}

bool sbfi_level_solve_nonlinear(const sbfi_level_statics *s, uint32_t load, double size, double tolerance,
    double *displacements, bool *converged, sbfi_progress progress, sbfi_arena *scratch) {
  const sbf_spring_network *n = &s->network;
  size_t numbers = 3 * (size_t)n->point_count;
  double *forces = sbfi_arena_allocate(scratch, numbers + 1, sizeof *forces);
  double *positions = sbfi_arena_allocate(scratch, numbers + 1, sizeof *positions);
  if (!forces || !positions) return false;
  sbfi_level_compute_forces(s, load, size, forces);
  sbfi_static_problem problem = {.network = n,
      .forces = forces,
      .tolerance = tolerance,
      .max_steps = MAX_STEPS,
      .max_products =
          (uint32_t)fmin(MAX_PRODUCTS, 1 + MAX_VISITS / (1.0 + n->spring_count + n->tetrahedron_count)),
      .progress = progress};
  sbfi_static_outcome outcome;
  sbfi_static_start(n, positions);
  if (!sbfi_static_solve(&problem, positions, &outcome, &scratch->allocator) || outcome.ended) return false;
  *converged = outcome.residual <= 10 * tolerance;
  for (size_t i = 0; i < numbers; i++) positions[i] -= component(n->positions[i / 3], (int)(i % 3));
  sbfi_level_get_surface_displacements(s, positions, displacements);
  return true;
}

bool sbfi_level_solve_linear(const sbfi_level_statics *s, sbfi_linear_statics *linear, uint32_t load,
    double fraction, double *displacements, double *frequency, sbfi_arena *scratch) {
  size_t numbers = 3 * (size_t)s->network.point_count;
  double *forces = sbfi_arena_allocate(scratch, numbers + 1, sizeof *forces);
  double *moved = sbfi_arena_allocate(scratch, numbers + 1, sizeof *moved);
  if (!forces || !moved) return false;
  sbfi_level_compute_forces(s, load, 1, forces);
  sbfi_linear_statics_solve(linear, forces, fraction, moved);
  *frequency = quotient(&s->network, forces, moved);
  sbfi_level_get_surface_displacements(s, moved, displacements);
  return true;
}

bool sbfi_level_twist_frequency(const sbfi_level_statics *s, sbfi_linear_statics *linear, uint32_t axis,
    double fraction, double *frequency, sbfi_arena *scratch) {
  const sbf_spring_network *n = &s->network;
  double *forces = sbfi_arena_allocate(scratch, 3 * (size_t)n->point_count + 1, sizeof *forces);
  double *moved = sbfi_arena_allocate(scratch, 3 * (size_t)n->point_count + 1, sizeof *moved);
  if (!forces || !moved) return false;
  for (uint32_t i = 0; i < n->point_count; i++) {
    sbfi_d3 force = sbfi_d3_scale(twist_of(s, axis, n->positions[i]), (double)n->masses[i]);
    double *at = forces + 3 * (size_t)i;
    at[0] = force.x, at[1] = force.y, at[2] = force.z;
  }
  if (!s->is_pinned) balance(n, forces);
  sbfi_linear_statics_solve(linear, forces, fraction, moved);
  *frequency = quotient(n, forces, moved);
  return true;
}

double sbfi_level_mean_displacement(const sbfi_level_statics *s, uint32_t load, const double *displacements) {
  const sbf_vec3_list *surface = &s->body->surface.positions;
  double sum = 0, area = 0;
  for (uint32_t i = 0; i < surface->count; i++) {
    double moved = displacements[3 * (size_t)i + (size_t)axis_of(s, load)];
    sum += s->areas[i] * moved * strength(s, load, surface->at[i]);
    area += s->areas[i];
  }
  return area > 0 ? sum / area : 0;
}
