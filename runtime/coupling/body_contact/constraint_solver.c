/* Solver of contact impulses.
 *
 * Projected Gauss-Seidel over accumulated impulses, forwards and backwards (E. Catto, Iterative Dynamics with
 * Temporal Coherence, 2005); a sticking contact is solved in three directions at once. Sweeps alone need
 * nearly one iteration per pair of boxes in a tower, and hundreds where the heavy stand on the light. Between
 * rigid bodies a few sweeps find which contacts press, and conjugate gradients their impulses
 * (active_contacts.c), in turn. With soft bodies the change of an iteration is a gradient, and each iteration
 * continues along the previous ones as nonlinear conjugate gradients do (M. Silcowitz-Hansen, S. Niebe,
 * K. Erleben, A nonsmooth nonlinear conjugate gradient method for interactive contact force problems,
 * 2010). */
#include "coupling/body_contact/constraint_solver.h"

/* Upper bounds. Impulses continue from the previous step, so the contacts of soft bodies converge over a few
 * steps; a tower of rigid boxes stands only if every step converges. */
enum {
  MAX_RIGID_ROUNDS = 32,
  MAX_RIGID_STEPS = 400,
  RIGID_SWEEPS = 2,
  STEP_ATTEMPTS = 6,
  MAX_SOFT_ITERATIONS = 12
};
/* Sweeps end when none changes a velocity by more than this. */
static const float CONVERGED_RIGID_M_S = 2e-5f, CONVERGED_SOFT_M_S = 2e-4f;
/* Compliance of a contact of rigid bodies, as a fraction of the velocity change that its impulse alone
 * causes: without it the impulses of several contacts of a face are not unique. The position correction
 * compensates for it at a depth of micrometres. */
static const float RIGID_COMPLIANCE = 1e-4f;
/* m^2/s^2: slip below this has no direction. */
static const float MIN_SLIP = 1e-20f;

static sbri_four multiply_symmetric(const float m[6], sbri_four v) {
  const sbri_four columns[3] = {sbri_four_of(sbri_vec3(m[0], m[3], m[4])),
      sbri_four_of(sbri_vec3(m[3], m[1], m[5])), sbri_four_of(sbri_vec3(m[4], m[5], m[2]))};
  return sbri_four_times(columns, v);
}

static float max_of(float a, float b) {
  return b > a ? b : a;
}

/* ---- Before and after ---- */

static sbf_vec3 impulse_of(const sbri_contact_constraint *r) {
  return sbri_add_scaled(r->friction_impulse, r->normal, r->normal_impulse);
}

/* Angular velocity per impulse at the lever arm. */
static void find_angular_response(sbri_constraint_side *finish_rigid) {
  float(*e)[3] = finish_rigid->body->inverse_inertia;
  sbf_vec3 r = finish_rigid->lever_arm, x = sbri_vec3(e[0][0], e[1][0], e[2][0]),
           y = sbri_vec3(e[0][1], e[1][1], e[2][1]), z = sbri_vec3(e[0][2], e[1][2], e[2][2]);
  finish_rigid->angular_response[0] = sbri_four_of(sbri_add_scaled(sbri_scale(y, r.z), z, -r.y));
  finish_rigid->angular_response[1] = sbri_four_of(sbri_add_scaled(sbri_scale(z, r.x), x, -r.z));
  finish_rigid->angular_response[2] = sbri_four_of(sbri_add_scaled(sbri_scale(x, r.y), y, -r.x));
}

static void prepare_side(sbri_contact_constraint *r, int tangent_error, sbri_constraint_side *finish_rigid,
    sbri_solver_body *fixed_body) {
  r->wide.bodies[tangent_error] = finish_rigid->body ? finish_rigid->body : fixed_body;
  r->wide.lever_arms[tangent_error] =
      sbri_four_of(finish_rigid->body ? finish_rigid->lever_arm : sbri_vec3(0, 0, 0));
  if (finish_rigid->body) find_angular_response(finish_rigid);
  r->wide.permuted_arms[tangent_error] = sbri_four_yzx(r->wide.lever_arms[tangent_error]);
}

static void prepare_rigid(sbri_contact_constraint *r, sbri_solver_body *fixed_body) {
  const float *b = r->effective_mass;
  r->wide.normal = sbri_four_of(r->normal);
  r->wide.initial_impulse = r->wide.impulse;
  r->wide.target = sbri_four_of(
      sbri_sub(r->target_velocity, sbri_sub(r->a.prescribed_velocity, r->b.prescribed_velocity)));
  r->wide.mass_columns[0] = sbri_four_of(sbri_vec3(b[0], b[3], b[4]));
  r->wide.mass_columns[1] = sbri_four_of(sbri_vec3(b[3], b[1], b[5]));
  r->wide.mass_columns[2] = sbri_four_of(sbri_vec3(b[4], b[5], b[2]));
  prepare_side(r, 0, &r->a, fixed_body);
  prepare_side(r, 1, &r->b, fixed_body);
  r->compliance = r->normal_mass > 0 ? RIGID_COMPLIANCE / r->normal_mass : 0;
  r->inverse_mass_squared = r->normal_mass > 0 ? 1 / (r->normal_mass * r->normal_mass) : 0;
}

static void add_impulse(const sbri_constraint_side *finish_rigid, sbf_vec3 impulse) {
  if (!finish_rigid->body) return;
  finish_rigid->body->impulse = sbri_add(finish_rigid->body->impulse, impulse);
  finish_rigid->body->angular_impulse =
      sbri_add(finish_rigid->body->angular_impulse, sbri_cross(finish_rigid->lever_arm, impulse));
}

static void finish_rigid(sbri_contact_constraint *r) {
  if (!r->is_active) return;
  sbf_vec3 change = sbri_four_xyz(sbri_four_sub(r->wide.impulse, r->wide.initial_impulse));
  r->friction_impulse =
      sbri_four_xyz(sbri_four_add_scaled(r->wide.impulse, r->wide.normal, -r->normal_impulse));
  add_impulse(&r->a, change);
  add_impulse(&r->b, sbri_scale(change, -1));
}

/* ---- Contacts of rigid bodies ---- */

static void apply_rigid_impulse(const sbri_constraint_side *finish_rigid, sbri_solver_body *m, sbri_four p) {
  m->velocity = sbri_four_add_scaled(m->velocity, p, m->inverse_mass);
  m->angular_velocity =
      sbri_four_add(m->angular_velocity, sbri_four_times(finish_rigid->angular_response, p));
}

/* Applies the difference to both bodies. Returns the square of the velocity change. */
static float set_rigid_impulse(sbri_contact_constraint *r, float normal_impulse, sbri_four impulse) {
  sbri_four change = sbri_four_sub(impulse, r->wide.impulse),
            reaction = sbri_four_sub(r->wide.impulse, impulse);
  r->normal_impulse = normal_impulse, r->wide.impulse = impulse;
  if (r->a.body) apply_rigid_impulse(&r->a, r->a.body, change);
  if (r->b.body) apply_rigid_impulse(&r->b, r->b.body, reaction);
  return sbri_four_dot(change, change) * r->inverse_mass_squared;
}

static sbri_four clamp_friction(
    const sbri_contact_constraint *r, sbri_four friction_impulse, float normal_impulse) {
  float max_value = r->friction * normal_impulse, size = sbri_four_dot(friction_impulse, friction_impulse);
  return size > max_value * max_value ? sbri_four_scale(friction_impulse, max_value / sqrtf(size))
                                      : friction_impulse;
}

/* A sliding or separating contact. */
static float slide(sbri_contact_constraint *r, sbri_four error, float normal_error, float normal_impulse) {
  sbri_four n = r->wide.normal,
            friction_impulse = sbri_four_add_scaled(r->wide.impulse, n, -r->normal_impulse);
  if (!(normal_impulse > 0)) normal_impulse = 0;
  sbri_four tangent_error = sbri_four_add_scaled(error, n, -normal_error);
  float slip = sbri_four_dot(tangent_error, tangent_error);
  if (slip > MIN_SLIP)
    friction_impulse = sbri_four_add_scaled(friction_impulse, tangent_error,
        slip / sbri_four_dot(tangent_error, multiply_symmetric(r->inverse_mass, tangent_error)));
  return set_rigid_impulse(r, normal_impulse,
      sbri_four_add_scaled(clamp_friction(r, friction_impulse, normal_impulse), n, normal_impulse));
}

/* Returns the square of the velocity change. */
static float correct_rigid(sbri_contact_constraint *r) {
  sbri_four n = r->wide.normal, error = sbri_rigid_velocity_error(r);
  float normal_error = sbri_four_dot(n, error),
        normal_impulse = r->normal_impulse + r->normal_mass * normal_error;
  if (!(normal_impulse > 0) && r->normal_impulse == 0) return 0;
  sbri_four sticking = sbri_four_add(r->wide.impulse, sbri_four_times(r->wide.mass_columns, error));
  float normal_part = sbri_four_dot(sticking, n), max_value = r->friction * normal_part;
  sbri_four friction_impulse = sbri_four_add_scaled(sticking, n, -normal_part);
  if (!(normal_part > 0 && sbri_four_dot(friction_impulse, friction_impulse) <= max_value * max_value))
    return slide(r, error, normal_error, normal_impulse);
  return set_rigid_impulse(r, normal_part, sticking);
}

/* Sweeps forwards and backwards. Returns the square of the largest change of a velocity. */
static float sweep_rigid(sbri_contact_constraint *rows, uint32_t count) {
  float max_value = 0;
  for (uint32_t i = 0; i < count; i++)
    if (rows[i].is_active) max_value = max_of(max_value, correct_rigid(&rows[i]));
  for (uint32_t i = count; i-- > 0;)
    if (rows[i].is_active) max_value = max_of(max_value, correct_rigid(&rows[i]));
  return max_value;
}

/* Sets the impulse to that at the begin plus a fraction of the step of the active contacts, within the
 * friction cone. */
static void advance(sbri_contact_constraint *r, float fraction) {
  const double *step = r->active.step;
  sbri_four p = sbri_four_add_scaled(
      r->search_direction, sbri_four_of(sbri_vec3((float)step[0], (float)step[1], (float)step[2])), fraction);
  float normal_impulse = sbri_four_dot(p, r->wide.normal);
  sbri_four friction_impulse = sbri_four_add_scaled(p, r->wide.normal, -normal_impulse);
  if (!(normal_impulse > 0)) normal_impulse = 0;
  (void)set_rigid_impulse(r, normal_impulse,
      sbri_four_add_scaled(
          clamp_friction(r, friction_impulse, normal_impulse), r->wide.normal, normal_impulse));
}

/* Twice the decrease of the energy that the impulses minimise, J: with the velocity error e it decreases from
 * p to p + d by d (e(p) + e(p + d)) / 2. */
static float fall_of_energy(const sbri_contact_constraint *rows, uint32_t count) {
  float sum = 0;
  for (uint32_t i = 0; i < count; i++) {
    const sbri_contact_constraint *r = &rows[i];
    if (!r->active.is_pressing) continue;
    sbri_four errors = sbri_four_add(r->change, sbri_rigid_velocity_error(r));
    sum += sbri_four_dot(sbri_four_sub(r->wide.impulse, r->search_direction), errors);
  }
  return sum;
}

/* The step is exact while the same contacts are active and stick. If the friction cones cut it off so that
 * the energy increases, a smaller fraction is applied, in the end nothing. */
static void apply_active_steps(sbri_contact_constraint *rows, uint32_t count) {
  for (uint32_t i = 0; i < count; i++)
    rows[i].change = sbri_rigid_velocity_error(&rows[i]), rows[i].search_direction = rows[i].wide.impulse;
  float fraction = 1;
  for (int attempt = 0; attempt <= STEP_ATTEMPTS; attempt++) {
    if (attempt == STEP_ATTEMPTS) fraction = 0;
    for (uint32_t i = 0; i < count; i++)
      if (rows[i].active.is_pressing) advance(&rows[i], fraction);
    if (fall_of_energy(rows, count) > 0) return;
    fraction *= 0.25f;
  }
}

static void solve_rigid(sbri_contact_constraint *rows, uint32_t count) {
  const float converged = CONVERGED_RIGID_M_S * CONVERGED_RIGID_M_S;
  int steps = 0;
  for (int round = 0; round < MAX_RIGID_ROUNDS && steps < MAX_RIGID_STEPS; round++) {
    for (int i = 0; i < RIGID_SWEEPS; i++)
      if (sweep_rigid(rows, count) < converged) return;
    steps += sbri_solve_active_contacts(rows, count, 0.5f * CONVERGED_RIGID_M_S);
    apply_active_steps(rows, count);
  }
}

/* ---- Contacts of soft bodies ---- */

static sbf_vec3 multiply_symmetric_vec3(const float m[6], sbf_vec3 v) {
  return sbri_vec3(m[0] * v.x + m[3] * v.y + m[4] * v.z, m[3] * v.x + m[1] * v.y + m[5] * v.z,
      m[4] * v.x + m[5] * v.y + m[2] * v.z);
}

static sbf_vec3 clamp_friction_vec3(
    const sbri_contact_constraint *r, sbf_vec3 friction_impulse, float normal_impulse) {
  float max_value = r->friction * normal_impulse, size = sbri_dot(friction_impulse, friction_impulse);
  return size > max_value * max_value ? sbri_scale(friction_impulse, max_value / sqrtf(size))
                                      : friction_impulse;
}

static float set_soft_impulse(sbri_contact_constraint *r, float normal_impulse, sbf_vec3 friction_impulse) {
  sbf_vec3 before = impulse_of(r);
  r->normal_impulse = normal_impulse, r->friction_impulse = friction_impulse;
  sbf_vec3 now = impulse_of(r), change = sbri_sub(now, before);
  sbri_constraint_apply_impulse(r, change);
  r->wide.impulse = sbri_four_of(now);
  return sbri_dot(change, change) / (r->normal_mass * r->normal_mass);
}

static float correct_soft(sbri_contact_constraint *r) {
  sbf_vec3 n = r->normal, error = sbri_sub(r->target_velocity, sbri_constraint_velocity(r));
  float normal_error = sbri_dot(n, error), normal_impulse = r->normal_impulse + r->normal_mass * normal_error;
  if (!(normal_impulse > 0) && r->normal_impulse == 0) return 0;
  sbf_vec3 sticking = sbri_add(impulse_of(r), multiply_symmetric_vec3(r->effective_mass, error));
  float normal_part = sbri_dot(sticking, n), max_value = r->friction * normal_part;
  sbf_vec3 friction_impulse = sbri_add_scaled(sticking, n, -normal_part);
  if (normal_part > 0 && sbri_dot(friction_impulse, friction_impulse) <= max_value * max_value)
    return set_soft_impulse(r, normal_part, friction_impulse);
  if (!(normal_impulse > 0)) normal_impulse = 0;
  sbf_vec3 tangent_error = sbri_add_scaled(error, n, -normal_error);
  float slip = sbri_dot(tangent_error, tangent_error);
  friction_impulse =
      slip > MIN_SLIP
          ? sbri_add_scaled(r->friction_impulse, tangent_error,
                slip / sbri_dot(tangent_error, multiply_symmetric_vec3(r->inverse_mass, tangent_error)))
          : r->friction_impulse;
  return set_soft_impulse(r, normal_impulse, clamp_friction_vec3(r, friction_impulse, normal_impulse));
}

static void extrapolate_soft(sbri_contact_constraint *r, float factor) {
  sbf_vec3 p = sbri_add_scaled(impulse_of(r), sbri_four_xyz(r->search_direction), factor);
  float normal_impulse = sbri_dot(p, r->normal);
  sbf_vec3 friction_impulse = sbri_add_scaled(p, r->normal, -normal_impulse);
  if (!(normal_impulse > 0)) normal_impulse = 0;
  (void)set_soft_impulse(r, normal_impulse, clamp_friction_vec3(r, friction_impulse, normal_impulse));
}

static void solve_soft(sbri_contact_constraint *rows, uint32_t count) {
  const float converged = CONVERGED_SOFT_M_S * CONVERGED_SOFT_M_S;
  float last = 0;
  for (int iteration = 0; iteration < MAX_SOFT_ITERATIONS; iteration++) {
    float max_value = 0, sum = 0;
    for (uint32_t i = 0; i < count; i++) {
      rows[i].change = sbri_four_scale(rows[i].wide.impulse, -1);
      if (rows[i].is_active) max_value = max_of(max_value, correct_soft(&rows[i]));
    }
    for (uint32_t i = count; i-- > 0;)
      if (rows[i].is_active) max_value = max_of(max_value, correct_soft(&rows[i]));
    if (max_value < converged) return;
    for (uint32_t i = 0; i < count; i++) {
      sbri_contact_constraint *r = &rows[i];
      if (!r->is_active) continue;
      r->change = sbri_four_add(r->change, r->wide.impulse);
      sum += sbri_four_dot(r->change, r->change) / r->normal_mass;
    }
    float factor = last > 0 && sum <= last ? sum / last : 0;
    last = sum;
    for (uint32_t i = 0; i < count; i++) {
      sbri_contact_constraint *r = &rows[i];
      if (!r->is_active) continue;
      if (factor > 0) extrapolate_soft(r, factor);
      r->search_direction = sbri_four_add_scaled(r->change, r->search_direction, factor);
    }
  }
}

/* ---- All contacts ---- */

void sbri_solve_constraints(sbri_contact_constraint *rows, uint32_t count) {
  sbri_solver_body fixed_body = {.inverse_mass = 0};
  bool all_are_rigid = true;
  for (uint32_t i = 0; i < count; i++) {
    rows[i].wide.impulse = sbri_four_of(impulse_of(&rows[i]));
    rows[i].search_direction = sbri_four_of(sbri_vec3(0, 0, 0));
    all_are_rigid = all_are_rigid && rows[i].a.count + rows[i].b.count == 0;
  }
  if (!all_are_rigid) {
    solve_soft(rows, count);
    return;
  }
  for (uint32_t i = 0; i < count; i++) prepare_rigid(&rows[i], &fixed_body);
  solve_rigid(rows, count);
  for (uint32_t i = 0; i < count; i++) finish_rigid(&rows[i]);
}
