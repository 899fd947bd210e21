/* Contact impulses before a step.
 *
 * Gravity, springs and joints act in the step that follows. Gravity is predicted; otherwise all resting
 * bodies would sink by the fall of a step. Other forces are compensated after they have moved points,
 * normally or tangentially, by a fraction per step. Predicting them from the previous step too would make
 * soft bodies excite each other. */
#include "coupling/body_contact/constraint_solver.h"

/* Slower contacts do not bounce. */
static const float MIN_BOUNCE_SPEED_M_S = 0.3f;
/* Allowed penetration; fraction of the excess that a step removes; the same between soft bodies, whose
 * surfaces never fit exactly; largest push-out speed. */
static const float SLACK_M = 1e-4f, PUSH_OUT_RATE = 0.1f, SOFT_PUSH_OUT_RATE = 0.05f, MAX_PUSH_OUT_M_S = 0.2f;
/* Friction above this fraction of its bound counts as sliding. */
static const float SLIDING_FRACTION = 0.999f;
/* Soft contacts deeper than this fraction of the smaller body, or of the margin, use the learnt bias;
 * fraction of a change that a step learns. */
static const float DEEP_FRACTION = 0.003f, DEEP_MARGIN_FRACTION = 0.1f, BIAS_GAIN = 0.3f;
/* A soft body counts as crushed below this volume ratio of an element, or above this stretch of a spring. */
static const float CRUSHED_RATIO = 0.15f, CRUSHED_STRETCH = 0.8f;
static const sbf_vec3 zero = {0, 0, 0};

static bool is_plane(const sbri_contact *t) {
  return t->b.rigid_body == SBRI_CONTACT_PLANE;
}

static bool both_are_soft(const sbri_contact *t) {
  return t->a.rigid_body == SBRI_CONTACT_SOFT && t->b.rigid_body == SBRI_CONTACT_SOFT;
}

static float push_out_rate(const sbri_contact *t) {
  return both_are_soft(t) ? SOFT_PUSH_OUT_RATE : PUSH_OUT_RATE;
}

/* Normal velocity that a contact may reach. Within the slack it closes or opens by a fraction of the gap:
 * answering each rounding of the position with an impulse would cause jitter. */
static float target_speed(const sbri_contact_constraint *r, float step_s) {
  float rate = push_out_rate(r->contact), depth = -r->separation;
  if (r->separation > SLACK_M) return -(r->separation - (1 - rate) * SLACK_M) / step_s;
  if (is_plane(r->contact) && depth > 0) return 0; /* the body's own step corrects it */
  float speed = rate * depth / step_s;
  return speed > MAX_PUSH_OUT_M_S ? MAX_PUSH_OUT_M_S : speed;
}

/* Gravitational acceleration of a side. */
static sbf_vec3 gravity_acceleration(const sbr_world *world, const sbri_contact_group *group,
    const sbri_contact_side *side, const sbri_constraint_side *store_solution) {
  const sbri_group_member *m = &world->body_contacts->members[group->first_member + side->member];
  const sbr_model *model = m->character->model;
  if (side->external) return sbri_external_body_acceleration(group, m, side->external);
  sbf_vec3 weight = world->has_gravity ? world->gravity : model->asset->environment.gravity;
  float rate = store_solution->body ? model->rigid.bodies[side->rigid_body].source->gravity_scale : 0;
  for (uint32_t k = 0; k < store_solution->count; k++) rate += store_solution->weights[k];
  return sbri_scale(weight, rate);
}

/* Tangential slip of a relative to b since they stick. */
static sbf_vec3 current_slip(const sbri_contact_constraint *r) {
  const sbri_contact *t = r->contact;
  sbf_vec3 movement = sbri_sub(r->offset, t->sticking.separation);
  if (is_plane(t)) return zero;
  return sbri_add(t->sticking.slip, sbri_add_scaled(movement, t->normal, -sbri_dot(movement, t->normal)));
}

/* Depth at which the bias begins to act; it acts fully at twice this depth. */
static float deep_threshold(const sbri_contact *t) {
  float by_size = DEEP_FRACTION * t->soft_size_m, by_margin = DEEP_MARGIN_FRACTION * t->margin;
  return t->margin > 0 && by_margin < by_size ? by_margin : by_size;
}

/* Learns how the last step has changed the normal velocity. The bias follows gradually, but at once if an
 * impact compresses soft bodies, which would interpenetrate meanwhile. Contacts that began deep separate
 * slowly. */
static void update_external_bias(sbri_contact_constraint *r, float speed) {
  sbri_contact *t = r->contact;
  float change = speed - t->solved_speed - t->external_bias;
  bool is_compressing = change < 0 && speed < -MIN_BOUNCE_SPEED_M_S && both_are_soft(t) && t->margin == 0 &&
                        !t->is_deep && -r->separation > 2 * deep_threshold(t);
  if (t->has_solved_speed) t->external_bias += is_compressing ? change : BIAS_GAIN * change;
  t->has_solved_speed = false;
}

/* Bias against predicted compression beside gravity, for soft contacts. Rigid bodies do not oscillate with a
 * soft one; another soft body does, so between two soft bodies the bias acts only where they are deep. */
static float predicted_bias(const sbri_contact_constraint *r, float acceleration) {
  const sbri_contact *t = r->contact;
  float bias = t->external_bias - acceleration;
  if (!(t->soft_size_m > 0) || bias >= 0) return 0;
  return both_are_soft(t) ? -bias * sbri_clamp(-r->separation / deep_threshold(t) - 1, 0, 1) : -bias;
}

/* Whether a contact of a crushed soft body with a body pinned to bones is left out. Nothing stops bones, so
 * there may be no room for the soft body. Impulses would then add energy in each step until it is unstable,
 * so it overlaps instead. */
static bool overlaps_by_pins(
    const sbr_world *world, const sbri_contact_group *group, const sbri_contact_constraint *r) {
  const sbri_contact_side *sides[2] = {&r->contact->a, &r->contact->b};
  const sbri_solver_body *rigid[2] = {r->a.body, r->b.body};
  bool is_crushed = false, is_pinned = false;
  for (int k = 0; k < 2 && !is_plane(r->contact); k++) {
    const sbri_character *c = world->body_contacts->members[group->first_member + sides[k]->member].character;
    if (sides[k]->rigid_body != SBRI_CONTACT_SOFT) {
      is_pinned = is_pinned || !rigid[k];
      continue;
    }
    const sbri_island *island = &c->model->islands[sides[k]->island];
    const sbri_island_state *state = &sbri_island_states(c)[sides[k]->island];
    is_crushed = is_crushed || state->min_ratio < CRUSHED_RATIO || state->stretch > CRUSHED_STRETCH;
    is_pinned = is_pinned || island->slot_count > island->free_count;
  }
  return is_crushed && is_pinned;
}

/* Sets the target velocity and the warm-start impulses. */
static void prepare_target(
    const sbr_world *world, const sbri_contact_group *group, sbri_contact_constraint *r) {
  sbri_contact *t = r->contact;
  float step_s = group->step_s, speed = sbri_dot(t->normal, sbri_constraint_velocity(r));
  float target = target_speed(r, step_s);
  r->initial_normal_speed = speed;
  update_external_bias(r, speed);
  if (r->separation + step_s * speed < 0 && -t->restitution * speed > target &&
      speed < -MIN_BOUNCE_SPEED_M_S) {
    r->target_velocity = sbri_scale(t->normal, -t->restitution * speed);
  } else {
    sbf_vec3 acceleration = sbri_sub(
        gravity_acceleration(world, group, &t->a, &r->a), gravity_acceleration(world, group, &t->b, &r->b));
    r->target_velocity = sbri_add_scaled(sbri_scale(t->normal, target), acceleration, -step_s);
    r->target_velocity = sbri_add_scaled(r->target_velocity, current_slip(r), -push_out_rate(t) / step_s);
    r->target_velocity = sbri_add_scaled(
        r->target_velocity, t->normal, predicted_bias(r, step_s * sbri_dot(acceleration, t->normal)));
  }
  bool rebounds = is_plane(t) && speed < -MIN_BOUNCE_SPEED_M_S; /* the body's own step handles the bounce */
  if (rebounds) t->is_loaded = false;
  bool is_open = overlaps_by_pins(world, group, r);
  if (is_open) t->is_loaded = false;
  r->is_active = r->normal_mass > 0 && !rebounds && !is_open;
  if (!t->is_loaded) t->normal_impulse = 0, t->friction_impulse = zero;
  r->normal_impulse = t->normal_impulse, r->friction_impulse = t->friction_impulse;
}

/* Adds the impulse to the body's own contacts, from which the ground and colliders are reported. */
static void report_plane_contact(
    const sbri_body_contacts *all, const sbri_contact_group *group, const sbri_contact_constraint *r) {
  const sbri_contact *t = r->contact;
  const sbri_group_member *m = &all->members[group->first_member + t->a.member];
  sbf_vec3 position = sbri_scale(sbri_sub(r->position, m->offset), 1 / m->scale);
  sbf_vec3 impulse = sbri_scale(
      sbri_add_scaled(r->friction_impulse, r->normal, r->normal_impulse), 1 / (m->mass * m->velocity_scale));
  sbri_contact_report *touching = sbri_contact_reports_add(
      &sbri_rigid_touching(m->character)[t->a.rigid_body], sbri_contact_collider_index(t->body_ids[1]),
      position, r->normal, sbri_dot(impulse, r->normal), -r->initial_normal_speed / m->velocity_scale);
  if (touching) sbri_contact_report_add_impulse(touching, position, impulse);
}

static void store_solution(const sbri_contact_constraint *r) {
  sbri_contact *t = r->contact;
  float max_friction = SLIDING_FRACTION * t->friction * r->normal_impulse;
  t->normal_impulse = r->normal_impulse, t->friction_impulse = r->friction_impulse;
  t->is_loaded = t->normal_impulse > 0;
  t->solved_speed = sbri_dot(t->normal, sbri_constraint_velocity(r));
  t->has_solved_speed = true;
  if (t->is_loaded) {
    t->tick.impulse += t->normal_impulse, t->tick.position = r->position;
    t->tick.max_closing_speed = t->tick.max_closing_speed > -r->initial_normal_speed
                                    ? t->tick.max_closing_speed
                                    : -r->initial_normal_speed;
  }
  if (sbri_dot(t->friction_impulse, t->friction_impulse) >= max_friction * max_friction)
    t->sticking.slip = zero, t->sticking.separation = r->offset;
}

void sbri_contacts_solve(const sbr_world *world, const sbri_contact_group *group, bool first) {
  const sbri_body_contacts *all = world->body_contacts;
  sbri_contact_constraint *rows = all->constraints + group->first_contact;
  uint32_t count = group->contact_count;
  sbri_solver_bodies_read(all, group);
  for (uint32_t i = 0; i < count; i++) {
    rows[i].contact = &all->contacts[group->first_contact + i];
    sbri_contact_constraint_prepare(all, group, &rows[i], first);
    if (first) rows[i].contact->sticking.separation = rows[i].offset;
  }
  for (uint32_t i = 0; i < count; i++) prepare_target(world, group, &rows[i]);
  for (uint32_t i = 0; i < count; i++)
    if (rows[i].contact->is_loaded)
      sbri_constraint_apply_impulse(
          &rows[i], sbri_add_scaled(rows[i].friction_impulse, rows[i].normal, rows[i].normal_impulse));
  sbri_solve_constraints(rows, count);
  for (uint32_t i = 0; i < count; i++) {
    store_solution(&rows[i]);
    if (is_plane(rows[i].contact) && rows[i].normal_impulse > 0) report_plane_contact(all, group, &rows[i]);
  }
  sbri_solver_bodies_write(all, group);
}

void sbri_contacts_finish_tick(const sbri_body_contacts *all, const sbri_contact_group *group) {
  sbri_solver_bodies_read(all, group);
  for (uint32_t i = 0; i < group->contact_count; i++) {
    sbri_contact_constraint *r = &all->constraints[group->first_contact + i];
    sbri_contact_constraint_prepare(all, group, r, false);
    r->contact->sticking.slip = current_slip(r);
    update_external_bias(r, sbri_dot(r->normal, sbri_constraint_velocity(r)));
  }
}
