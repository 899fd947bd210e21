/* Optimizes all joints of a pose together by Gauss-Newton steps. Points of each surface are pulled to the
 * nearest point of the other with a similar normal, with weights that decrease with distance. Rotations
 * that the surface does not determine are damped (Besl and McKay 1992; joints as in Pellegrini, Schindler
 * and Nardi 2008). Lengths are fractions of the rig's size. */
#include <math.h>
#include <string.h>

#include "import/rigging/align.h"
#include "import/rigging/pose_fit.h"

enum { STEPS = 20, MAX_MOVED = 64 };

/* Final and relative correspondence distance per step; weight of the tangential part of a pull. */
static const double LAST_WITHIN = 0.025, NEARER = 0.9, ALONG = 0.1;
/* Cost of a rotation by 1 rad relative to a mean squared distance: first, last, and factor per step. */
static const double FIRST_COST = 3e-5, LAST_COST = 1e-6, CHEAPER = 0.7;

typedef struct system {
  sbfi_pose_fit *f;
  uint32_t *columns; /* (bones) index of the first of a bone's three unknowns + 1; 0: it does not rotate */
  uint32_t count;    /* number of unknowns */
  double *matrix, *right;
  sbfi_d3 *levers, *joints; /* (bones) of the current point; positions of the joints */
  double *fractions;        /* (bones) sum of its weights on the bone and descendants */
  uint32_t moved[MAX_MOVED], moved_count;
} system;

/* --- What a point takes part in ------------------------------------------------------------------------ */

static void add_levers(system *s, uint32_t bone, sbfi_d3 position, double weight) {
  for (int32_t b = (int32_t)bone; b != SBF_NONE; b = s->f->bones[b].parent) {
    if (!s->columns[b]) continue;
    if (s->fractions[b] <= 0) {
      if (s->moved_count == MAX_MOVED) return;
      s->moved[s->moved_count++] = (uint32_t)b;
      s->levers[b] = (sbfi_d3){0, 0, 0};
    }
    s->fractions[b] += weight;
    s->levers[b] = sbfi_d3_add(s->levers[b], sbfi_d3_scale(sbfi_d3_sub(position, s->joints[b]), weight));
  }
}

static void collect_bones(system *s, const uint32_t points[3], const double weights[3]) {
  const sbfi_rigging *r = s->f->r;
  s->moved_count = 0;
  for (int k = 0; k < 3; k++) {
    const sbfi_influences *of = &r->rig_weights[points[k]];
    sbfi_d3 bound = sbfi_d3_of(r->rig.mesh.positions.at[points[k]]);
    for (uint32_t i = 0; i < SBFI_MAX_INFLUENCES && of->at[i].weight > 0; i++) {
      uint32_t bone = (uint32_t)r->c->bone_of_node[of->at[i].node];
      double weight = weights[k] * (double)of->at[i].weight;
      if (weight > 1e-4) add_levers(s, bone, sbfi_similarity_apply(&s->f->motions[bone], bound), weight);
    }
  }
  for (uint32_t i = 0; i < s->moved_count; i++) s->fractions[s->moved[i]] = 0;
}

/* --- The system ---------------------------------------------------------------------------------------- */

/* Adds an equation: the rotations should close a distance along a direction. */
static void add_row(system *s, sbfi_d3 direction, double distance, double weight, double size) {
  sbfi_d3 slopes[MAX_MOVED];
  for (uint32_t i = 0; i < s->moved_count; i++)
    slopes[i] = sbfi_d3_scale(sbfi_d3_cross(s->levers[s->moved[i]], direction), 1 / size);
  for (uint32_t i = 0; i < s->moved_count; i++) {
    const double a[3] = {weight * slopes[i].x, weight * slopes[i].y, weight * slopes[i].z};
    uint32_t row = s->columns[s->moved[i]] - 1;
    for (int k = 0; k < 3; k++) s->right[row + (uint32_t)k] += a[k] * distance / size;
    for (uint32_t j = 0; j < s->moved_count; j++) {
      uint32_t column = s->columns[s->moved[j]] - 1;
      if (column > row) continue;
      for (uint32_t k = 0; k < 3; k++) {
        double *to = &s->matrix[(size_t)(row + k) * s->count + column];
        to[0] += a[k] * slopes[j].x;
        to[1] += a[k] * slopes[j].y;
        to[2] += a[k] * slopes[j].z;
      }
    }
  }
}

/* `distance` points from the rig's point to the input's. */
static void add_pull(system *s, sbfi_d3 distance, sbfi_d3 normal, double within) {
  double size = s->f->r->rig.size, length = sbfi_d3_length(distance) / (within * size / 3);
  double weight = 1 / ((1 + length * length) * (1 + length * length)) / SBFI_POSE_SAMPLES;
  if (!s->moved_count) return;
  add_row(s, normal, sbfi_d3_dot(normal, distance), weight, size);
  add_row(s, (sbfi_d3){1, 0, 0}, distance.x, ALONG * weight, size);
  add_row(s, (sbfi_d3){0, 1, 0}, distance.y, ALONG * weight, size);
  add_row(s, (sbfi_d3){0, 0, 1}, distance.z, ALONG * weight, size);
}

static void add_pulls(system *s, double within) {
  const sbfi_pose_fit *f = s->f;
  double size = f->r->rig.size;
  for (uint32_t i = 0; i < SBFI_POSE_SAMPLES; i++) {
    const sbfi_surface_sample *at = &f->rig_samples[i];
    if (at->gap < within * size) {
      collect_bones(s, at->points, at->weights);
      add_pull(s, sbfi_d3_sub(sbfi_surface_point(&f->input, &at->near), at->position),
          sbfi_surface_normal(&f->input, &at->near), within);
    }
    at = &f->input_samples[i];
    if (at->gap < within * size) {
      collect_bones(s, at->near.points, at->near.weights);
      add_pull(s, sbfi_d3_sub(at->position, sbfi_surface_point(&f->posed, &at->near)), at->normal, within);
    }
  }
}

static void add_costs(system *s, double cost) {
  for (uint32_t b = 0; b < s->f->bone_count; b++) {
    if (!s->columns[b]) continue;
    sbfi_d3 angles = sbfi_pose_fit_rotation_vector(s->f, b);
    const double back[3] = {angles.x, angles.y, angles.z};
    for (uint32_t k = 0; k < 3; k++) {
      uint32_t row = s->columns[b] - 1 + k;
      s->matrix[(size_t)row * s->count + row] += cost;
      s->right[row] -= cost * back[k];
    }
  }
}

/* Cholesky factorization of the lower triangle in place; the solution replaces the right-hand side. */
static bool solve(system *s) {
  uint32_t n = s->count;
  double *a = s->matrix, *x = s->right;
  for (uint32_t i = 0; i < n; i++) {
    for (uint32_t j = 0; j <= i; j++) {
      double sum = a[(size_t)i * n + j];
      for (uint32_t k = 0; k < j; k++) sum -= a[(size_t)i * n + k] * a[(size_t)j * n + k];
      if (i == j && !(sum > 0)) return false;
      a[(size_t)i * n + j] = i == j ? sqrt(sum) : sum / a[(size_t)j * n + j];
    }
    for (uint32_t k = 0; k < i; k++) x[i] -= a[(size_t)i * n + k] * x[k];
    x[i] /= a[(size_t)i * n + i];
  }
  for (uint32_t i = n; i-- > 0;) {
    for (uint32_t k = i + 1; k < n; k++) x[i] -= a[(size_t)k * n + i] * x[k];
    x[i] /= a[(size_t)i * n + i];
  }
  return true;
}

static void rotate_bones(system *s) {
  static const double farthest = 0.5; /* rad per step */
  for (uint32_t b = 0; b < s->f->bone_count; b++) {
    if (!s->columns[b]) continue;
    const double *at = &s->right[s->columns[b] - 1];
    double half = 0.5 * fmin(1, farthest / fmax(sbfi_d3_length((sbfi_d3){at[0], at[1], at[2]}), 1e-9));
    double w = 1 / sqrt(1 + half * half * (at[0] * at[0] + at[1] * at[1] + at[2] * at[2]));
    const double rotation[4] = {half * w * at[0], half * w * at[1], half * w * at[2], w};
    sbfi_pose_fit_rotate(s->f, b, rotation);
  }
}

/* --- The input's position ---------------------------------------------------------------------------------
 */

/* Aligns the input with the posed rig as a whole. */
static bool move_input(sbfi_pose_fit *f, double within) {
  sbfi_d3 from[SBFI_POSE_SAMPLES], to[SBFI_POSE_SAMPLES];
  sbfi_matrix back, fitted;
  uint32_t count = 0;
  if (!sbfi_matrix_invert(&f->to_asset, &back)) return true;
  for (uint32_t i = 0; i < SBFI_POSE_SAMPLES; i++) {
    const sbfi_surface_sample *at = &f->input_samples[i];
    if (at->gap >= within * f->r->rig.size) continue;
    from[count] = sbfi_similarity_apply(&back, at->position);
    to[count++] = sbfi_surface_point(&f->posed, &at->near);
  }
  if (count < SBFI_POSE_SAMPLES / 4 ||
      !sbfi_similarity_fit(
          from, to, count, sbfi_matrix_determinant(&f->to_asset) < 0, f->r->c->options->unit_m, &fitted) ||
      !sbfi_alignment_allowed(f->r, &fitted))
    return true;
  f->to_asset = fitted;
  return sbfi_pose_fit_move_input(f);
}

static bool make_system(system *s, sbfi_pose_fit *f) {
  *s = (system){.f = f};
  s->columns = sbfi_arena_allocate(f->arena, (size_t)f->bone_count + 1, sizeof *s->columns);
  s->levers = sbfi_arena_allocate(f->arena, (size_t)f->bone_count + 1, sizeof *s->levers);
  s->joints = sbfi_arena_allocate(f->arena, (size_t)f->bone_count + 1, sizeof *s->joints);
  s->fractions = sbfi_arena_allocate(f->arena, (size_t)f->bone_count + 1, sizeof *s->fractions);
  if (!s->columns || !s->levers || !s->joints || !s->fractions) return false;
  for (uint32_t i = 0; i < SBFI_POSE_SAMPLES; i++)
    for (int k = 0; k < 3; k++) {
      const sbfi_influences *of = &f->r->rig_weights[f->rig_samples[i].points[k]];
      for (uint32_t n = 0; n < SBFI_MAX_INFLUENCES && of->at[n].weight > 0; n++)
        for (int32_t b = f->r->c->bone_of_node[of->at[n].node]; b != SBF_NONE; b = f->bones[b].parent)
          s->columns[b] = f->bones[b].parent != SBF_NONE;
    }
  for (uint32_t b = 0; b < f->bone_count; b++)
    if (s->columns[b]) {
      s->columns[b] = s->count + 1;
      s->count += 3;
    }
  s->matrix = sbfi_arena_allocate(f->arena, (size_t)s->count * s->count + 1, sizeof *s->matrix);
  s->right = sbfi_arena_allocate(f->arena, (size_t)s->count + 1, sizeof *s->right);
  return s->matrix && s->right;
}

bool sbfi_pose_fit_joints(sbfi_pose_fit *f, double within, bool free_input) {
  system s;
  if (!make_system(&s, f)) return false;
  double cost = FIRST_COST;
  for (int step = 0; step < STEPS; step++) {
    memset(s.matrix, 0, (size_t)s.count * s.count * sizeof *s.matrix);
    memset(s.right, 0, s.count * sizeof *s.right);
    for (uint32_t b = 0; b < f->bone_count; b++) s.joints[b] = sbfi_pose_fit_joint(f, b);
    add_pulls(&s, within);
    add_costs(&s, cost);
    if (!solve(&s)) return true;
    rotate_bones(&s);
    if (!sbfi_pose_fit_update(f)) return false;
    if (free_input && (!move_input(f, within) || !sbfi_pose_fit_update(f))) return false;
    within = fmax(LAST_WITHIN, NEARER * within);
    cost = fmax(LAST_COST, CHEAPER * cost);
  }
  return true;
}
