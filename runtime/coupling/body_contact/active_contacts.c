/* Conjugate gradients over the active contacts of rigid bodies.
 *
 * Gauss-Seidel finds within a few sweeps which contacts press and which of them stick, but takes hundreds to
 * find the impulses where heavy bodies stand on light ones. While that set stays the same, the impulses solve
 * a symmetric linear system: a sticking contact has three unknowns, a sliding one its normal impulse, and its
 * friction is constant. Blocks of the diagonal precondition it (J. Nocedal, S. Wright, Numerical
 * Optimization, 2006, algorithm 5.3). Alternating both is due to Z. Dostal and J. Schoeberl (Minimizing
 * quadratic functions subject to bound constraints with the rate of convergence and finite termination,
 * 2005). Double precision: directions of redundant contacts at large mass ratios do not stay conjugate in
 * single precision. */
#include "coupling/body_contact/constraint_solver.h"

/* More iterations would be wasted on an active set that soon changes; Gauss-Seidel updates it. */
enum { MAX_STEPS = 20 };
/* Friction above this fraction of its bound counts as sliding. */
static const float SLIDING_FRACTION = 0.999f;

static void to_double(sbf_vec3 v, double to[3]) {
  to[0] = (double)v.x, to[1] = (double)v.y, to[2] = (double)v.z;
}

static double dot(const double a[3], const double b[3]) {
  return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}

static void cross(const double a[3], const double b[3], double to[3]) {
  to[0] = a[1] * b[2] - a[2] * b[1];
  to[1] = a[2] * b[0] - a[0] * b[2];
  to[2] = a[0] * b[1] - a[1] * b[0];
}

/* Keeps the part of a velocity that the contact's unknowns act on. */
static void project(const sbri_contact_constraint *r, double v[3]) {
  if (r->active.is_sticking) return;
  double n[3];
  to_double(r->normal, n);
  double along = dot(n, v);
  for (int k = 0; k < 3; k++) v[k] = along * n[k];
}

/* Impulse that would remove the residual if the contact were the only one. */
static void precondition(const sbri_contact_constraint *r, double z[3]) {
  const float *m = r->effective_mass;
  const double *v = r->active.residual;
  if (!r->active.is_sticking) {
    for (int k = 0; k < 3; k++) z[k] = (double)r->normal_mass * v[k];
    return;
  }
  z[0] = (double)m[0] * v[0] + (double)m[3] * v[1] + (double)m[4] * v[2];
  z[1] = (double)m[3] * v[0] + (double)m[1] * v[1] + (double)m[5] * v[2];
  z[2] = (double)m[4] * v[0] + (double)m[5] * v[1] + (double)m[2] * v[2];
}

/* ---- Response of the bodies ---- */

static void clear_response(const sbri_constraint_side *side) {
  for (int k = 0; side->body && k < 6; k++) side->body->response[k] = 0;
}

static void add_impulse(const sbri_constraint_side *side, const double p[3], double sign) {
  sbri_solver_body *b = side->body;
  if (!b) return;
  double arm[3], moment[3];
  to_double(side->lever_arm, arm);
  cross(arm, p, moment);
  for (int i = 0; i < 3; i++) {
    b->response[i] += sign * (double)b->inverse_mass * p[i];
    for (int j = 0; j < 3; j++) b->response[3 + i] += sign * (double)b->inverse_inertia[i][j] * moment[j];
  }
}

static void add_velocity(const sbri_constraint_side *side, double sign, double to[3]) {
  const sbri_solver_body *b = side->body;
  if (!b) return;
  double arm[3], rotation[3];
  to_double(side->lever_arm, arm);
  cross(b->response + 3, arm, rotation);
  for (int i = 0; i < 3; i++) to[i] += sign * (b->response[i] + rotation[i]);
}

/* Finds how the directions of all contacts change velocities. Returns the sum along the directions. */
static double find_changes(sbri_contact_constraint *rows, uint32_t count) {
  double sum = 0;
  for (uint32_t i = 0; i < count; i++) clear_response(&rows[i].a), clear_response(&rows[i].b);
  for (uint32_t i = 0; i < count; i++) {
    if (!rows[i].active.is_pressing) continue;
    add_impulse(&rows[i].a, rows[i].active.direction, 1);
    add_impulse(&rows[i].b, rows[i].active.direction, -1);
  }
  for (uint32_t i = 0; i < count; i++) {
    sbri_active_contact *active = &rows[i].active;
    if (!active->is_pressing) continue;
    for (int k = 0; k < 3; k++) active->change[k] = (double)rows[i].compliance * active->direction[k];
    add_velocity(&rows[i].a, 1, active->change);
    add_velocity(&rows[i].b, -1, active->change);
    project(&rows[i], active->change);
    sum += dot(active->direction, active->change);
  }
  return sum;
}

/* ---- The solve ---- */

static void begin(sbri_contact_constraint *r, sbf_vec3 velocity_error) {
  sbri_active_contact *active = &r->active;
  sbf_vec3 friction =
      sbri_four_xyz(sbri_four_add_scaled(r->wide.impulse, r->wide.normal, -r->normal_impulse));
  float max_friction = SLIDING_FRACTION * r->friction * r->normal_impulse;
  active->is_pressing = r->is_active && r->normal_impulse > 0;
  active->is_sticking = sbri_dot(friction, friction) < max_friction * max_friction;
  to_double(velocity_error, active->residual);
  project(r, active->residual);
  for (int k = 0; k < 3; k++) active->direction[k] = active->step[k] = 0;
}

/* Sets the directions of the next step. Returns the preconditioned square of the residuals. */
static double choose_directions(sbri_contact_constraint *rows, uint32_t count, double previous) {
  double square = 0;
  for (uint32_t i = 0; i < count; i++) {
    double z[3];
    if (!rows[i].active.is_pressing) continue;
    precondition(&rows[i], z);
    square += dot(rows[i].active.residual, z);
  }
  double factor = previous > 0 ? square / previous : 0;
  for (uint32_t i = 0; i < count; i++) {
    double z[3], *direction = rows[i].active.direction;
    if (!rows[i].active.is_pressing) continue;
    precondition(&rows[i], z);
    for (int k = 0; k < 3; k++) direction[k] = z[k] + factor * direction[k];
  }
  return square;
}

/* Returns the square of the largest residual, m^2/s^2. */
static double advance(sbri_contact_constraint *rows, uint32_t count, double length) {
  double max = 0;
  for (uint32_t i = 0; i < count; i++) {
    sbri_active_contact *active = &rows[i].active;
    if (!active->is_pressing) continue;
    for (int k = 0; k < 3; k++) {
      active->step[k] += length * active->direction[k];
      active->residual[k] -= length * active->change[k];
    }
    double square = dot(active->residual, active->residual);
    max = square > max ? square : max;
  }
  return max;
}

int sbri_solve_active_contacts(sbri_contact_constraint *rows, uint32_t count, float converged_m_s) {
  const double converged = (double)converged_m_s * (double)converged_m_s;
  double square = 0;
  for (uint32_t i = 0; i < count; i++) begin(&rows[i], sbri_four_xyz(sbri_rigid_velocity_error(&rows[i])));
  for (int step = 1; step <= MAX_STEPS; step++) {
    square = choose_directions(rows, count, square);
    double sum = find_changes(rows, count);
    if (!(square > 0 && sum > 0) || advance(rows, count, square / sum) < converged) return step;
  }
  return MAX_STEPS;
}
