/* Hulls against the ground, vertex by vertex.
 *
 * Once a tick the ground is sampled under each vertex that may reach it. For that tick the tangent plane
 * there replaces the ground, as for soft bodies (contact/contact.h). A contact acts on one body only, so it
 * adds to the body's own block of the system; all contacts and all joints are solved together. The normal
 * direction is a unilateral row with a small compliance relative to the body's inertia; it aims at the vertex
 * on the plane at the end of the substep. The tangential direction is a spring whose force continues from the
 * step before (Cundall and Strack, A discrete numerical model for granular assemblies, 1979), cut at
 * Coulomb's bound. A body at rest is therefore held by the same forces in every step, even where it is
 * jammed, and rounding does not make it slide. */
#include "rigid/rigid_work.h"
#include "shapes/ground.h"

/* Contact stiffness relative to the body's own inertia: normal and tangential. */
static const float FIRM = 300, FIRM_ACROSS = 30;
/* A contact with a load above its body's weight, such as a toe below a leg, has proportionally stiffer
 * friction, up to this factor. */
static const float MAX_LOAD = 1000;
/* s: in longer steps contacts are stiffer, so that a resting body has the same penetration. */
static const float FIRM_STEPS_1_S = 240;
/* Forces below this fraction of the body's weight, or of the normal force, are ignored. */
static const float FRICTION_TOLERANCE = 1e-3f;
/* Tolerances as fractions of friction's bound: of the force, and of the bound itself. */
static const float CHANGE = 5e-3f, BOUND_CHANGE = 0.1f;
/* Fraction of a sticking contact's tangential force that decays in a step. It causes a creep of micrometres
 * per second. */
static const float FRICTION_RELEASE = 0.005f;
/* m: maximum height of a vertex that counts as on the ground */
static const float LYING_M = 1e-4f;
/* Fraction of a penetration that is corrected in a substep, and the greatest velocity of the correction. */
static const float LIFT_FRACTION = 0.2f, LIFT_MAX_M_S = 0.5f;

static float height_at(const sbri_rigid_tick *t, float x, float z, sbf_vec3 *normal) {
  double world_x = t->origin.x + (double)t->scale * x, world_z = t->origin.z + (double)t->scale * z;
  return (float)((sbri_ground_height(t->ground, world_x, world_z, normal) - t->origin.y) / t->scale);
}

static void list_body(const sbri_rigid_tick *t, sbri_rigid_solving *work, uint32_t b, int32_t node) {
  const sbri_rigid_body *body = &t->model->bodies[b];
  const sbri_rigid_body_state *s = &t->bodies[b];
  if (sbri_rigid_stair_contacts_find(t, work, b, node)) return;
  sbf_vec3 angular_velocity =
               sbri_angular_velocity_from_momentum(body, s->pose.rotation, s->angular_momentum),
           normal;
  float fastest = sbri_length(s->velocity) + sbri_length(angular_velocity) * body->radius;
  float travel =
      2 * fastest * t->tick_s + 2 * sbri_length(t->gravity) * t->tick_s * t->tick_s + 0.02f * body->radius;
  float ground = height_at(t, s->pose.position.x, s->pose.position.z, &normal);
  float slope = normal.y > 0.1f ? 1 / normal.y : 10; /* ground nearby may rise by as much again */
  double flat;
  float reach = body->radius * (sbri_ground_is_flat(t->ground, &flat) ? 1 : 1 + slope) + travel;
  if (s->pose.position.y - ground > reach) return;
  for (uint32_t i = 0; i < body->vertex_count && work->contact_list.count < work->contact_list.capacity;
       i++) {
    sbf_vec3 at = sbri_add(s->pose.position, sbri_rotate(s->pose.rotation, body->vertices[i]));
    float y = height_at(t, at.x, at.z, &normal);
    if (at.y - y > travel * slope) continue;
    sbri_rigid_contact *contact = &work->contact_list.at[work->contact_list.count++];
    *contact = (sbri_rigid_contact){.node = node,
        .body = b,
        .at = body->vertices[i],
        .normal = normal,
        .offset = sbri_dot(normal, sbri_vec3(at.x, y, at.z)),
        .friction = body->source->friction,
        .restitution = body->source->restitution,
        .collider = UINT32_MAX,
        .surface = UINT32_MAX};
  }
}

void sbri_rigid_contacts_find(const sbri_rigid_tick *t, sbri_rigid_solving *work) {
  work->contact_list.count = 0;
  for (uint32_t b = 0; b < t->model->body_count; b++) sbri_contact_reports_begin(&t->touching[b]);
  for (uint32_t i = 0; i < work->system.node_count; i++)
    list_body(t, work, work->system.nodes[i].body, (int32_t)i);
}

/* Inverse effective mass along n at a lever arm. */
static float inverse_mass_of(const sbri_rigid_body *body, sbf_quat rotation, sbf_vec3 arm, sbf_vec3 n) {
  sbf_vec3 local = sbri_rotate(sbri_quat_conjugate(rotation), sbri_cross(arm, n)), i = body->inverse_inertia;
  return body->inverse_mass + local.x * local.x * i.x + local.y * local.y * i.y + local.z * local.z * i.z;
}

static sbf_vec3 velocity_at(sbf_vec3 velocity, sbf_vec3 angular_velocity, sbf_vec3 arm) {
  return sbri_add(velocity, sbri_cross(angular_velocity, arm));
}

static sbri_rigid_external_body *external_body_of(
    const sbri_rigid_solving *work, const sbri_rigid_contact *contact) {
  return contact->external_body ? &work->external_list.at[contact->external_body - 1] : NULL;
}

/* Relative velocity of the contact point. */
static sbf_vec3 slip_of(const sbri_rigid_solving *work, const sbri_rigid_contact *contact) {
  const sbri_part_motion *m = &work->motions[contact->body];
  const sbri_rigid_external_body *g = external_body_of(work, contact);
  sbf_vec3 other_velocity =
      g ? sbri_external_body_velocity(&g->is, contact->external_body_arm) : contact->velocity;
  return sbri_sub(velocity_at(m->velocity, m->turn, contact->substep.arm), other_velocity);
}

/* Mean velocity of the other side since the beginning of the tick. */
static sbf_vec3 mean_plane_velocity(const sbri_rigid_solving *work, const sbri_rigid_contact *contact) {
  const sbri_rigid_external_body *g = external_body_of(work, contact);
  return g ? velocity_at(g->is.begin_velocity, g->is.begin_angular_velocity, contact->external_body_arm)
           : contact->velocity;
}

/* Whether the contact has neither normal force nor friction at that velocity change, as most nearby ones. */
static bool is_idle(const sbri_rigid_contact *contact, sbf_vec3 du) {
  return !(contact->sliding.bound > 0) &&
         !(sbri_dot(contact->normal, sbri_sub(contact->substep.target, du)) > 0);
}

/* Linearises friction at a velocity change du. The contact sticks, as a spring that continues from the force
 * of the previous step, or slides with Coulomb's bound against the direction of that force. */
static void linearise(sbri_rigid_contact *contact, sbf_vec3 du) {
  sbf_vec3 n = contact->normal, error = sbri_sub(contact->substep.target, du);
  if (is_idle(contact, du)) {
    contact->iteration.slides = true, contact->iteration.is_active = false;
    contact->sliding.impulse = sbri_vec3(0, 0, 0), contact->sliding.side_mass = 0;
    return;
  }
  sbf_vec3 friction_start = sbri_add_scaled(contact->sliding.sticking_impulse,
      sbri_add_scaled(error, n, -sbri_dot(n, error)), contact->substep.tangential_mass);
  float tangential = sbri_length(friction_start);
  contact->iteration.slides = tangential > contact->sliding.bound;
  contact->iteration.is_active = sbri_dot(n, error) > 0;
  contact->sliding.impulse = sbri_vec3(0, 0, 0);
  contact->sliding.side_mass = 0;
  if (!contact->iteration.slides || !(contact->sliding.bound > 0)) return;
  sbf_vec3 direction = sbri_scale(friction_start, 1 / tangential);
  contact->sliding.side_direction = sbri_cross(n, direction);
  contact->sliding.side_mass = contact->substep.tangential_mass * contact->sliding.bound / tangential;
  contact->sliding.impulse =
      sbri_add_scaled(sbri_scale(direction, contact->sliding.bound), contact->sliding.side_direction,
          contact->sliding.side_mass * sbri_dot(contact->sliding.side_direction, du));
}

void sbri_rigid_contacts_linearise(
    const sbri_rigid_tick *t, sbri_rigid_solving *work, float since_s, float step_s) {
  float bounce_from = 4 * sbri_length(t->gravity) * step_s;
  float firmer = step_s * FIRM_STEPS_1_S > 1 ? step_s * step_s * FIRM_STEPS_1_S * FIRM_STEPS_1_S : 1;
  for (uint32_t i = 0; i < work->contact_list.count; i++) {
    sbri_rigid_contact *contact = &work->contact_list.at[i];
    const sbri_rigid_body *body = &t->model->bodies[contact->body];
    const sbri_rigid_body_state *s = &t->bodies[contact->body];
    sbf_vec3 n = contact->normal;
    contact->substep.arm = sbri_rotate(s->pose.rotation, contact->at);
    const sbri_rigid_external_body *external_body = external_body_of(work, contact);
    float plane = contact->offset + since_s * sbri_dot(n, mean_plane_velocity(work, contact));
    contact->substep.gap = sbri_dot(n, sbri_add(s->pose.position, contact->substep.arm)) - plane;
    sbf_vec3 u = slip_of(work, contact);
    float speed = sbri_dot(n, u), correction = -LIFT_FRACTION * contact->substep.gap / step_s;
    float target_speed = contact->substep.gap > 0    ? -contact->substep.gap / step_s
                         : correction < LIFT_MAX_M_S ? correction
                                                     : LIFT_MAX_M_S;
    float external_inverse_mass = external_body ? sbri_rigid_external_body_inverse_mass(
                                                      external_body, contact->external_body_arm, n)
                                                : 0,
          mass = body->mass;
    if (external_body && external_body->is.max_inverse_mass * mass > 1)
      mass = 1 / external_body->is.max_inverse_mass;
    contact->substep.inverse_mass =
        inverse_mass_of(body, s->pose.rotation, contact->substep.arm, n) + external_inverse_mass;
    float weight = 1 / contact->substep.inverse_mass, single_impulse = weight * (target_speed - speed);
    contact->substep.target = sbri_sub(sbri_scale(n, target_speed), u);
    contact->iteration.extra_impulse = sbri_vec3(0, 0, 0);
    contact->substep.bounce_m_s = 0;
    contact->substep.closing_speed = -speed;
    if (speed < target_speed && -speed > bounce_from) {
      /* The velocity belongs to half a substep ago; before that, the fall in the substep counts. */
      sbf_vec3 fall = external_body ? sbri_sub(t->gravity, external_body->is.acceleration) : t->gravity;
      float g = -sbri_dot(n, fall), half = 0.5f * g * step_s, begin = speed + half;
      float square = begin * begin + 2 * g * (contact->substep.gap > 0 ? contact->substep.gap : 0);
      contact->substep.bounce_m_s = contact->restitution * (square > 0 ? sqrtf(square) : 0) + half;
      if (!(contact->restitution > 0)) contact->substep.bounce_m_s = 0;
    }
    float normal = work->kick_s * contact->history.normal_n,
          own_weight = mass * sbri_length(t->gravity) * step_s;
    float load = sbri_clamp(own_weight > 0 ? normal / own_weight : 1, 1, MAX_LOAD);
    contact->substep.normal_mass = firmer * FIRM * weight;
    contact->substep.tangential_mass = load * firmer * FIRM_ACROSS * weight;
    contact->sliding.tolerance = FRICTION_TOLERANCE * load * own_weight;
    if (!(contact->history.is_known && (normal > 0 || speed > -bounce_from)))
      normal = single_impulse > 0 ? single_impulse : 0;
    contact->sliding.bound = contact->friction * normal;
    sbf_vec3 old_friction = sbri_scale(
        contact->history.friction_n, contact->history.is_known ? (1 - FRICTION_RELEASE) * work->kick_s : 0);
    contact->sliding.sticking_impulse = sbri_add_scaled(old_friction, n, -sbri_dot(n, old_friction));
    /* Starts from the state of the previous step: sticking or sliding. */
    linearise(contact, contact->history.is_known
                           ? sbri_sub(contact->substep.target, contact->history.velocity_error)
                           : sbri_vec3(0, 0, 0));
    if (!contact->history.is_known) continue;
    if (contact->history.normal_n > 0 && contact->substep.gap < LYING_M) contact->iteration.is_active = true;
    if (contact->history.normal_n == 0 && speed > -bounce_from) contact->iteration.is_active = false;
  }
}

/* Adds the same to the host's body, and the coupling of both. */
static void add_external_body(sbri_rigid_external_body *g, const sbri_rigid_contact *contact, float more,
    float tangential, float sideways, sbf_vec3 f) {
  const double n[3] = {(double)contact->normal.x, (double)contact->normal.y, (double)contact->normal.z};
  const double p[3] = {(double)contact->sliding.side_direction.x, (double)contact->sliding.side_direction.y,
      (double)contact->sliding.side_direction.z};
  double w[3][3];
  for (int i = 0; i < 3; i++)
    for (int j = 0; j < 3; j++)
      w[i][j] =
          (i == j ? (double)tangential : 0) + (double)more * n[i] * n[j] + (double)sideways * p[i] * p[j];
  sbri_rigid_external_body_couple(g, contact->external_body_arm, contact->substep.arm, w);
  sbri_rigid_external_body_apply_impulse(g, contact->external_body_arm, sbri_scale(f, -1));
}

/* d += J^T W J, b += J^T f, with J = (1, -arm x), W = stiff n n^T + tangential (1 - n n^T) for sticking
 * and stiff n n^T + sideways side side^T for sliding, and f the impulse at zero velocity change. */
static void add_contact(
    sbri_node *node, const sbri_rigid_contact *contact, sbri_rigid_external_body *external_body) {
  float stiff = contact->iteration.is_active ? contact->substep.normal_mass : 0,
        tangential = contact->iteration.slides ? 0 : contact->substep.tangential_mass,
        more = stiff - tangential;
  float sideways = contact->iteration.slides ? contact->sliding.side_mass : 0;
  const float n[3] = {contact->normal.x, contact->normal.y, contact->normal.z};
  const float p[3] = {contact->sliding.side_direction.x, contact->sliding.side_direction.y,
      contact->sliding.side_direction.z};
  sbf_vec3 arm_w[3]; /* columns of arm x W */
  for (int j = 0; j < 3; j++) {
    float column[3];
    for (int i = 0; i < 3; i++) column[i] = (i == j ? tangential : 0) + more * n[i] * n[j];
    if (contact->iteration.slides)
      for (int i = 0; i < 3; i++) column[i] += sideways * p[i] * p[j];
    arm_w[j] = sbri_cross(contact->substep.arm, sbri_vec3(column[0], column[1], column[2]));
    node->d[3][j] += arm_w[j].x, node->d[4][j] += arm_w[j].y, node->d[5][j] += arm_w[j].z;
    for (int i = j; i < 3; i++) node->d[i][j] += column[i];
  }
  const sbf_vec3 rows[3] = {{arm_w[0].x, arm_w[1].x, arm_w[2].x}, {arm_w[0].y, arm_w[1].y, arm_w[2].y},
      {arm_w[0].z, arm_w[1].z, arm_w[2].z}};
  for (int i = 0; i < 3; i++) {
    sbf_vec3 turned = sbri_cross(contact->substep.arm, rows[i]);
    const float to[3] = {turned.x, turned.y, turned.z};
    for (int j = 0; j <= i; j++) node->d[3 + i][3 + j] += to[j];
  }
  float target_speed = sbri_dot(contact->normal, contact->substep.target);
  sbf_vec3 f = sbri_scale(contact->normal, stiff * target_speed);
  if (contact->iteration.slides) {
    f = sbri_add(f, contact->sliding.impulse);
  } else {
    sbf_vec3 direction = sbri_add_scaled(contact->substep.target, contact->normal, -target_speed);
    f = sbri_add(
        f, sbri_add_scaled(contact->sliding.sticking_impulse, direction, contact->substep.tangential_mass));
  }
  sbf_vec3 moment = sbri_cross(contact->substep.arm, f);
  const float both[6] = {f.x, f.y, f.z, moment.x, moment.y, moment.z};
  for (int i = 0; i < 6; i++) node->b[i] += both[i];
  if (external_body) add_external_body(external_body, contact, more, tangential, sideways, f);
}

void sbri_rigid_contacts_add(sbri_rigid_solving *work) {
  for (uint32_t i = 0; i < work->contact_list.count; i++) {
    const sbri_rigid_contact *contact = &work->contact_list.at[i];
    if (contact->iteration.is_active || contact->sliding.bound > 0)
      add_contact(&work->system.nodes[contact->node], contact, external_body_of(work, contact));
  }
}

/* W x, as in add_contact. */
static sbf_vec3 reaction_velocity(const sbri_rigid_contact *contact, sbf_vec3 x) {
  float normal_part = sbri_dot(contact->normal, x);
  sbf_vec3 f = sbri_scale(
      contact->normal, contact->iteration.is_active ? contact->substep.normal_mass * normal_part : 0);
  if (contact->iteration.slides)
    return sbri_add_scaled(f, contact->sliding.side_direction,
        contact->sliding.side_mass * sbri_dot(contact->sliding.side_direction, x));
  return sbri_add_scaled(
      f, sbri_add_scaled(x, contact->normal, -normal_part), contact->substep.tangential_mass);
}

static sbf_vec3 velocity_change_now(const sbri_rigid_solving *work, const sbri_rigid_contact *contact) {
  const double *x = work->system.nodes[contact->node].x;
  sbf_vec3 change = velocity_at(sbri_vec3((float)x[0], (float)x[1], (float)x[2]),
      sbri_vec3((float)x[3], (float)x[4], (float)x[5]), contact->substep.arm);
  const sbri_rigid_external_body *g = external_body_of(work, contact);
  return g ? sbri_sub(change, sbri_rigid_external_body_velocity_change(g, contact->external_body_arm))
           : change;
}

/* Impulse at a velocity change, without linearisation. */
static sbf_vec3 impulse_at(const sbri_rigid_contact *contact, sbf_vec3 du, float *normal) {
  sbf_vec3 n = contact->normal, error = sbri_sub(contact->substep.target, du);
  float into = sbri_dot(n, error);
  *normal = into > 0 ? contact->substep.normal_mass * into : 0;
  sbf_vec3 friction_start = sbri_add_scaled(
      contact->sliding.sticking_impulse, sbri_add_scaled(error, n, -into), contact->substep.tangential_mass);
  float tangential = sbri_length(friction_start);
  return tangential > contact->sliding.bound ? sbri_scale(friction_start, contact->sliding.bound / tangential)
                                             : friction_start;
}

static double dot_of(sbf_vec3 a, sbf_vec3 b) {
  return (double)a.x * (double)b.x + (double)a.y * (double)b.y + (double)a.z * (double)b.z;
}

void sbri_rigid_contacts_find_changes(sbri_rigid_solving *work) {
  for (uint32_t i = 0; i < work->contact_list.count; i++) {
    const sbri_rigid_contact *contact = &work->contact_list.at[i];
    if (is_idle(contact, contact->iteration.previous_change) &&
        is_idle(contact, contact->iteration.last_change))
      continue;
    sbf_vec3 n = contact->normal,
             error = sbri_sub(contact->substep.target, contact->iteration.previous_change),
             displacement = sbri_sub(contact->iteration.last_change, contact->iteration.previous_change);
    float into = sbri_dot(n, error), normal_part = sbri_dot(n, displacement);
    sbri_contact_search *p = &work->pushes[work->push_count++];
    *p = (sbri_contact_search){
        .stiff = (double)contact->substep.normal_mass, .into = (double)into, .distance = (double)normal_part};
    if (!(contact->sliding.bound > 0)) continue;
    sbf_vec3 tangential = sbri_add_scaled(error, n, -into),
             tangential_change = sbri_add_scaled(displacement, n, -normal_part);
    sbf_vec3 friction_start = sbri_add_scaled(
                 contact->sliding.sticking_impulse, tangential, contact->substep.tangential_mass),
             friction_change = sbri_scale(tangential_change, contact->substep.tangential_mass);
    p->bound = (double)contact->sliding.bound;
    p->inverse_mass = 1 / (double)contact->substep.tangential_mass;
    p->start_square = dot_of(friction_start, friction_start),
    p->start_dot_change = dot_of(friction_start, friction_change),
    p->change_square = dot_of(friction_change, friction_change);
  }
}

void sbri_rigid_contacts_update_velocities(sbri_rigid_solving *work) {
  for (uint32_t i = 0; i < work->contact_list.count; i++) {
    sbri_rigid_contact *contact = &work->contact_list.at[i];
    contact->iteration.previous_change = contact->iteration.last_change;
    contact->iteration.last_change = velocity_change_now(work, contact);
  }
}

/* Impulse at a velocity change by the last linearisation. */
static sbf_vec3 linear_at(const sbri_rigid_contact *contact, sbf_vec3 du, float *normal) {
  sbf_vec3 n = contact->normal, error = sbri_sub(contact->substep.target, du);
  float into = sbri_dot(n, error);
  *normal = contact->iteration.is_active ? contact->substep.normal_mass * into : 0;
  if (contact->iteration.slides)
    return sbri_add_scaled(contact->sliding.impulse, contact->sliding.side_direction,
        -contact->sliding.side_mass * sbri_dot(contact->sliding.side_direction, du));
  return sbri_add_scaled(
      contact->sliding.sticking_impulse, sbri_add_scaled(error, n, -into), contact->substep.tangential_mass);
}

float sbri_rigid_contacts_error(const sbri_rigid_solving *work) {
  float energy = 0;
  for (uint32_t i = 0; i < work->contact_list.count; i++) {
    const sbri_rigid_contact *contact = &work->contact_list.at[i];
    if (!contact->iteration.is_active && is_idle(contact, contact->iteration.last_change)) continue;
    float normal, linear;
    sbf_vec3 was = linear_at(contact, contact->iteration.last_change, &linear),
             is = impulse_at(contact, contact->iteration.last_change, &normal);
    float tangential = sbri_length(sbri_sub(was, is));
    float normal_part = fabsf(normal - linear);
    if (normal_part > contact->sliding.tolerance ||
        tangential > CHANGE * contact->sliding.bound + contact->sliding.tolerance)
      energy += contact->substep.inverse_mass * (normal_part * normal_part + tangential * tangential);
  }
  return energy;
}

void sbri_rigid_contacts_store_solution(sbri_rigid_solving *work) {
  for (uint32_t i = 0; i < work->contact_list.count; i++) {
    sbri_rigid_contact *contact = &work->contact_list.at[i];
    if (!contact->iteration.is_active && is_idle(contact, contact->iteration.last_change)) continue;
    float normal, linear;
    sbf_vec3 was = linear_at(contact, contact->iteration.last_change, &linear),
             is = impulse_at(contact, contact->iteration.last_change, &normal);
    contact->iteration.extra_impulse = sbri_add_scaled(sbri_sub(was, is), contact->normal, linear - normal);
  }
}

void sbri_rigid_contacts_check(sbri_rigid_solving *work) {
  for (uint32_t i = 0; i < work->contact_list.count; i++) {
    sbri_rigid_contact *contact = &work->contact_list.at[i];
    if (contact->iteration.is_active || !is_idle(contact, contact->iteration.last_change))
      linearise(contact, contact->iteration.last_change);
  }
}

bool sbri_rigid_contacts_bound(sbri_rigid_solving *work) {
  float error = 0, all = 0, tolerance_sum = 0;
  for (uint32_t i = 0; i < work->contact_list.count; i++) {
    sbri_rigid_contact *contact = &work->contact_list.at[i];
    float normal, used = sbri_length(impulse_at(contact, contact->iteration.last_change, &normal)),
                  bound = contact->friction * normal;
    all += bound;
    tolerance_sum += contact->sliding.tolerance;
    if (contact->iteration.slides || used > bound) error += fabsf(bound - contact->sliding.bound);
  }
  if (error <= BOUND_CHANGE * all + tolerance_sum) return false;
  for (uint32_t i = 0; i < work->contact_list.count; i++) {
    sbri_rigid_contact *contact = &work->contact_list.at[i];
    float normal;
    (void)impulse_at(contact, contact->iteration.last_change, &normal);
    contact->sliding.bound = contact->friction * normal;
    linearise(contact, contact->iteration.last_change);
  }
  return true;
}

void sbri_rigid_contacts_apply_impulse(sbri_rigid_solving *work) {
  for (uint32_t i = 0; i < work->contact_list.count; i++) {
    sbri_rigid_contact *contact = &work->contact_list.at[i];
    if (!contact->iteration.is_active && !(contact->sliding.bound > 0)) continue;
    sbf_vec3 direction = reaction_velocity(contact, velocity_change_now(work, contact));
    contact->iteration.extra_impulse = sbri_sub(contact->iteration.extra_impulse, direction);
  }
}

void sbri_rigid_contacts_report(const sbri_rigid_tick *t, sbri_rigid_solving *work) {
  for (uint32_t i = 0; i < work->contact_list.count; i++) {
    sbri_rigid_contact *contact = &work->contact_list.at[i];
    float normal;
    sbf_vec3 tangential = impulse_at(contact, contact->iteration.last_change, &normal);
    contact->history.is_known = true;
    contact->history.velocity_error = sbri_sub(contact->substep.target, contact->iteration.last_change);
    contact->history.normal_n = normal / work->kick_s;
    contact->history.friction_n = sbri_scale(tangential, normal > 0 ? 1 / work->kick_s : 0);
    if (!(normal > 0)) continue;
    sbf_vec3 position = sbri_add(t->bodies[contact->body].pose.position, contact->substep.arm);
    sbri_contact_report *one = sbri_contact_reports_add(&t->touching[contact->body], contact->collider,
        position, contact->normal, normal, contact->substep.closing_speed);
    sbf_vec3 push =
        sbri_add(sbri_add_scaled(tangential, contact->normal, normal), contact->iteration.extra_impulse);
    if (one) sbri_contact_report_add_impulse(one, position, push);
  }
}

bool sbri_rigid_contacts_bounce(sbri_rigid_solving *work) {
  bool any = false;
  for (uint32_t i = 0; i < work->contact_list.count; i++) {
    sbri_rigid_contact *contact = &work->contact_list.at[i];
    if (!contact->iteration.is_active || !(contact->substep.bounce_m_s > 0)) continue;
    sbf_vec3 u = slip_of(work, contact), n = contact->normal;
    sbf_vec3 f = sbri_scale(n, contact->substep.normal_mass * (contact->substep.bounce_m_s - sbri_dot(n, u)));
    sbf_vec3 moment = sbri_cross(contact->substep.arm, f);
    const float both[6] = {f.x, f.y, f.z, moment.x, moment.y, moment.z};
    for (int k = 0; k < 6; k++) work->system.nodes[contact->node].b[k] += both[k];
    if (contact->external_body)
      sbri_rigid_external_body_apply_impulse(
          external_body_of(work, contact), contact->external_body_arm, sbri_scale(f, -1));
    contact->iteration.extra_impulse = sbri_add(contact->iteration.extra_impulse, f);
    any = true;
  }
  return any;
}
