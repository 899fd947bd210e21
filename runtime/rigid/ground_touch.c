/* Hulls against the ground, vertex by vertex.
 *
 * Once a tick the ground is asked under each vertex that may reach it, and stands for that tick as the plane
 * that touches it there, as it does for soft bodies (contact/contact.h). A touch acts on one body alone, and
 * so lies in the body's own block of the system: all touches, and all joints, are solved at once. Along the
 * normal it is a row that gives way by a small share of the body's own inertia there, pushes only, and aims
 * at the vertex's lying on the plane at the substep's end. Across it is a spring whose force goes on from
 * that of the step before (Cundall and Strack, A discrete numerical model for granular assemblies, 1979), cut
 * where it would be more than Coulomb's law allows. So what lies, however it is jammed, is held by the same
 * forces step after step, and the last bits of its place are no reason to slide. */
#include "collide/ground.h"
#include "rigid/rigid_work.h"

/* How much stiffer than the body's own inertia. */
static const float FIRM = 300, FIRM_ACROSS = 30;
/* What presses with more than its body's weight, as a toe with a leg on it, grips as much harder, and no more
 * than this. */
static const float MAX_LOAD = 1000;
/* In steps that are longer than this they are so much stiffer that what lies sinks in as far. */
static const float FIRM_STEPS_1_S = 240;
/* What is less than this share of its body's weight, or of what presses, makes no difference. */
static const float DOUBT = 1e-3f;
/* A friction that is right but for this share of its bound needs no other pass, and for this the bound. */
static const float CHANGE = 5e-3f, BOUND_CHANGE = 0.1f;
/* Of what holds a place that sticks, this share is let go in a step: it creeps by micrometres a second. */
static const float EASE = 0.005f;
/* What is no higher lies on the ground: to pull it down there for one step does next to nothing. */
static const float LYING_M = 1e-4f;
/* What lies below is moved up by this share of it a substep, and no faster than that. */
static const float LIFT_SHARE = 0.2f, LIFT_MAX_M_S = 0.5f;

static float height_at(const sbri_rigid_tick *t, float x, float z, sbf_vec3 *normal) {
  double world_x = t->origin.x + (double)t->scale * x, world_z = t->origin.z + (double)t->scale * z;
  return (float)((sbri_ground_height(t->ground, world_x, world_z, normal) - t->origin.y) / t->scale);
}

static void list_body(const sbri_rigid_tick *t, sbri_rigid_solving *work, uint32_t b, int32_t node) {
  const sbri_rigid_body *body = &t->model->bodies[b];
  const sbri_rigid_body_state *s = &t->bodies[b];
  if (sbri_stair_touches_find(t, work, b, node)) return;
  sbf_vec3 turn = sbri_spin_velocity(body, s->pose.rotation, s->spin), normal;
  float fastest = sbri_length(s->velocity) + sbri_length(turn) * body->radius;
  float way =
      2 * fastest * t->tick_s + 2 * sbri_length(t->gravity) * t->tick_s * t->tick_s + 0.02f * body->radius;
  float under = height_at(t, s->pose.position.x, s->pose.position.z, &normal);
  float slope = normal.y > 0.1f ? 1 / normal.y : 10; /* and ground that rises nearby by as much again */
  double flat;
  float reach = body->radius * (sbri_ground_is_flat(t->ground, &flat) ? 1 : 1 + slope) + way;
  if (s->pose.position.y - under > reach) return;
  for (uint32_t i = 0; i < body->vertex_count && work->touch_count < work->touch_capacity; i++) {
    sbf_vec3 at = sbri_add(s->pose.position, sbri_rotate(s->pose.rotation, body->vertices[i]));
    float y = height_at(t, at.x, at.z, &normal);
    if (at.y - y > way * slope) continue;
    sbri_ground_touch *touch = &work->touches[work->touch_count++];
    *touch = (sbri_ground_touch){.node = node,
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

void sbri_ground_touches_find(const sbri_rigid_tick *t, sbri_rigid_solving *work) {
  work->touch_count = 0;
  for (uint32_t b = 0; b < t->model->body_count; b++) sbri_touching_begin(&t->touching[b]);
  for (uint32_t i = 0; i < work->system.node_count; i++)
    list_body(t, work, work->system.nodes[i].body, (int32_t)i);
}

/* 1 / mass that answers a push along n at an arm. */
static float ease(const sbri_rigid_body *body, sbf_quat turn, sbf_vec3 arm, sbf_vec3 n) {
  sbf_vec3 own = sbri_rotate(sbri_quat_conjugate(turn), sbri_cross(arm, n)), i = body->inverse_inertia;
  return body->inverse_mass + own.x * own.x * i.x + own.y * own.y * i.y + own.z * own.z * i.z;
}

static sbf_vec3 velocity_at(sbf_vec3 velocity, sbf_vec3 turn, sbf_vec3 arm) {
  return sbri_add(velocity, sbri_cross(turn, arm));
}

static sbri_rigid_external_body *external_body_of(
    const sbri_rigid_solving *work, const sbri_ground_touch *touch) {
  return touch->external_body ? &work->external_bodies[touch->external_body - 1] : NULL;
}

/* Of the place against what it touches. */
static sbf_vec3 slip_of(const sbri_rigid_solving *work, const sbri_ground_touch *touch) {
  const sbri_part_motion *m = &work->motions[touch->body];
  const sbri_rigid_external_body *g = external_body_of(work, touch);
  sbf_vec3 under = g ? sbri_external_body_velocity(&g->is, touch->external_body_arm) : touch->velocity;
  return sbri_sub(velocity_at(m->velocity, m->turn, touch->arm), under);
}

/* Of what it touches, in all the tick so far. */
static sbf_vec3 gone_with(const sbri_rigid_solving *work, const sbri_ground_touch *touch) {
  const sbri_rigid_external_body *g = external_body_of(work, touch);
  return g ? velocity_at(g->is.begin_velocity, g->is.begin_spin, touch->external_body_arm) : touch->velocity;
}

/* Neither presses at that change of velocity nor has any friction: the most of those nearby. */
static bool is_idle(const sbri_ground_touch *touch, sbf_vec3 du) {
  return !(touch->bound > 0) && !(sbri_dot(touch->normal, sbri_sub(touch->target, du)) > 0);
}

/* How friction answers at a change of velocity du, linearised there: it sticks, giving way from the force of
 * the step before on, or slides with what Coulomb's law allows against where that would go. */
static void linearise(sbri_ground_touch *touch, sbf_vec3 du) {
  sbf_vec3 n = touch->normal, off = sbri_sub(touch->target, du);
  if (is_idle(touch, du)) {
    touch->slides = true, touch->active = false;
    touch->drag = sbri_vec3(0, 0, 0), touch->side_grip = 0;
    return;
  }
  sbf_vec3 pull = sbri_add_scaled(touch->hold, sbri_add_scaled(off, n, -sbri_dot(n, off)), touch->grip);
  float across = sbri_length(pull);
  touch->slides = across > touch->bound;
  touch->active = sbri_dot(n, off) > 0;
  touch->drag = sbri_vec3(0, 0, 0);
  touch->side_grip = 0;
  if (!touch->slides || !(touch->bound > 0)) return;
  sbf_vec3 along = sbri_scale(pull, 1 / across);
  touch->side = sbri_cross(n, along);
  touch->side_grip = touch->grip * touch->bound / across;
  touch->drag = sbri_add_scaled(
      sbri_scale(along, touch->bound), touch->side, touch->side_grip * sbri_dot(touch->side, du));
}

void sbri_ground_touches_make(
    const sbri_rigid_tick *t, sbri_rigid_solving *work, float since_s, float step_s) {
  float bounce_from = 4 * sbri_length(t->gravity) * step_s;
  float firmer = step_s * FIRM_STEPS_1_S > 1 ? step_s * step_s * FIRM_STEPS_1_S * FIRM_STEPS_1_S : 1;
  for (uint32_t i = 0; i < work->touch_count; i++) {
    sbri_ground_touch *touch = &work->touches[i];
    const sbri_rigid_body *body = &t->model->bodies[touch->body];
    const sbri_rigid_body_state *s = &t->bodies[touch->body];
    sbf_vec3 n = touch->normal;
    touch->arm = sbri_rotate(s->pose.rotation, touch->at);
    const sbri_rigid_external_body *external_body = external_body_of(work, touch);
    float plane = touch->offset + since_s * sbri_dot(n, gone_with(work, touch));
    touch->gap = sbri_dot(n, sbri_add(s->pose.position, touch->arm)) - plane;
    sbf_vec3 u = slip_of(work, touch);
    float speed = sbri_dot(n, u), lift = -LIFT_SHARE * touch->gap / step_s;
    float wanted = touch->gap > 0 ? -touch->gap / step_s : lift < LIFT_MAX_M_S ? lift : LIFT_MAX_M_S;
    float gives =
              external_body ? sbri_rigid_external_body_ease(external_body, touch->external_body_arm, n) : 0,
          mass = body->mass;
    if (external_body && external_body->is.max_inverse_mass * mass > 1)
      mass = 1 / external_body->is.max_inverse_mass;
    touch->ease = ease(body, s->pose.rotation, touch->arm, n) + gives;
    float weight = 1 / touch->ease, alone = weight * (wanted - speed);
    touch->target = sbri_sub(sbri_scale(n, wanted), u);
    touch->more = sbri_vec3(0, 0, 0);
    touch->bounce_m_s = 0;
    if (speed < wanted && -speed > bounce_from) {
      /* Velocities are those half a substep ago; before, the substep's own fall is in it. */
      sbf_vec3 falls = external_body ? sbri_sub(t->gravity, external_body->is.acceleration) : t->gravity;
      float g = -sbri_dot(n, falls), half = 0.5f * g * step_s, begin = speed + half;
      float square = begin * begin + 2 * g * (touch->gap > 0 ? touch->gap : 0);
      touch->bounce_m_s = touch->restitution * (square > 0 ? sqrtf(square) : 0) + half;
      if (!(touch->restitution > 0)) touch->bounce_m_s = 0;
    }
    float normal = work->kick_s * touch->normal_n, own = mass * sbri_length(t->gravity) * step_s;
    float load = sbri_clamp(own > 0 ? normal / own : 1, 1, MAX_LOAD);
    touch->stiff = firmer * FIRM * weight;
    touch->grip = load * firmer * FIRM_ACROSS * weight;
    touch->doubt = DOUBT * load * own;
    if (!(touch->known && (normal > 0 || speed > -bounce_from))) normal = alone > 0 ? alone : 0;
    touch->bound = touch->friction * normal;
    sbf_vec3 held = sbri_scale(touch->drag_n, touch->known ? (1 - EASE) * work->kick_s : 0);
    touch->hold = sbri_add_scaled(held, n, -sbri_dot(n, held));
    /* What stuck most likely sticks on, and what slid slides on as it did. */
    linearise(touch, touch->known ? sbri_sub(touch->target, touch->left) : sbri_vec3(0, 0, 0));
    if (!touch->known) continue;
    if (touch->normal_n > 0 && touch->gap < LYING_M) touch->active = true;
    if (touch->normal_n == 0 && speed > -bounce_from) touch->active = false;
  }
}

/* The same to the host's body that it touches, and what couples both. */
static void add_external_body(sbri_rigid_external_body *g, const sbri_ground_touch *touch, float more,
    float grip, float across, sbf_vec3 f) {
  const double n[3] = {(double)touch->normal.x, (double)touch->normal.y, (double)touch->normal.z};
  const double p[3] = {(double)touch->side.x, (double)touch->side.y, (double)touch->side.z};
  double w[3][3];
  for (int i = 0; i < 3; i++)
    for (int j = 0; j < 3; j++)
      w[i][j] = (i == j ? (double)grip : 0) + (double)more * n[i] * n[j] + (double)across * p[i] * p[j];
  sbri_rigid_external_body_couple(g, touch->external_body_arm, touch->arm, w);
  sbri_rigid_external_body_push(g, touch->external_body_arm, sbri_scale(f, -1));
}

/* d += J^T W J, b += J^T f, with J = (1, -arm x), W = stiff n n^T + grip (1 - n n^T) where it sticks and
 * stiff n n^T + side_grip side side^T where it slides, and f the impulse that it has without giving way. */
static void add_touch(
    sbri_node *node, const sbri_ground_touch *touch, sbri_rigid_external_body *external_body) {
  float stiff = touch->active ? touch->stiff : 0, grip = touch->slides ? 0 : touch->grip, more = stiff - grip;
  float across = touch->slides ? touch->side_grip : 0;
  const float n[3] = {touch->normal.x, touch->normal.y, touch->normal.z};
  const float p[3] = {touch->side.x, touch->side.y, touch->side.z};
  sbf_vec3 arm_w[3]; /* columns of arm x W */
  for (int j = 0; j < 3; j++) {
    float column[3];
    for (int i = 0; i < 3; i++) column[i] = (i == j ? grip : 0) + more * n[i] * n[j];
    if (touch->slides)
      for (int i = 0; i < 3; i++) column[i] += across * p[i] * p[j];
    arm_w[j] = sbri_cross(touch->arm, sbri_vec3(column[0], column[1], column[2]));
    node->d[3][j] += arm_w[j].x, node->d[4][j] += arm_w[j].y, node->d[5][j] += arm_w[j].z;
    for (int i = j; i < 3; i++) node->d[i][j] += column[i];
  }
  const sbf_vec3 rows[3] = {{arm_w[0].x, arm_w[1].x, arm_w[2].x}, {arm_w[0].y, arm_w[1].y, arm_w[2].y},
      {arm_w[0].z, arm_w[1].z, arm_w[2].z}};
  for (int i = 0; i < 3; i++) {
    sbf_vec3 turned = sbri_cross(touch->arm, rows[i]);
    const float to[3] = {turned.x, turned.y, turned.z};
    for (int j = 0; j <= i; j++) node->d[3 + i][3 + j] += to[j];
  }
  float wanted = sbri_dot(touch->normal, touch->target);
  sbf_vec3 f = sbri_scale(touch->normal, stiff * wanted);
  if (touch->slides) {
    f = sbri_add(f, touch->drag);
  } else {
    sbf_vec3 along = sbri_add_scaled(touch->target, touch->normal, -wanted);
    f = sbri_add(f, sbri_add_scaled(touch->hold, along, touch->grip));
  }
  sbf_vec3 moment = sbri_cross(touch->arm, f);
  const float both[6] = {f.x, f.y, f.z, moment.x, moment.y, moment.z};
  for (int i = 0; i < 6; i++) node->b[i] += both[i];
  if (external_body) add_external_body(external_body, touch, more, grip, across, f);
}

void sbri_ground_touches_add(sbri_rigid_solving *work) {
  for (uint32_t i = 0; i < work->touch_count; i++) {
    const sbri_ground_touch *touch = &work->touches[i];
    if (touch->active || touch->bound > 0)
      add_touch(&work->system.nodes[touch->node], touch, external_body_of(work, touch));
  }
}

/* W x of add_touch. */
static sbf_vec3 given_way(const sbri_ground_touch *touch, sbf_vec3 x) {
  float along = sbri_dot(touch->normal, x);
  sbf_vec3 f = sbri_scale(touch->normal, touch->active ? touch->stiff * along : 0);
  if (touch->slides) return sbri_add_scaled(f, touch->side, touch->side_grip * sbri_dot(touch->side, x));
  return sbri_add_scaled(f, sbri_add_scaled(x, touch->normal, -along), touch->grip);
}

static sbf_vec3 moved_now(const sbri_rigid_solving *work, const sbri_ground_touch *touch) {
  const double *x = work->system.nodes[touch->node].x;
  sbf_vec3 moved = velocity_at(sbri_vec3((float)x[0], (float)x[1], (float)x[2]),
      sbri_vec3((float)x[3], (float)x[4], (float)x[5]), touch->arm);
  const sbri_rigid_external_body *g = external_body_of(work, touch);
  return g ? sbri_sub(moved, sbri_rigid_external_body_moved(g, touch->external_body_arm)) : moved;
}

/* The impulse at a change of velocity: nothing but that stands in it. */
static sbf_vec3 impulse_at(const sbri_ground_touch *touch, sbf_vec3 du, float *normal) {
  sbf_vec3 n = touch->normal, off = sbri_sub(touch->target, du);
  float into = sbri_dot(n, off);
  *normal = into > 0 ? touch->stiff * into : 0;
  sbf_vec3 pull = sbri_add_scaled(touch->hold, sbri_add_scaled(off, n, -into), touch->grip);
  float across = sbri_length(pull);
  return across > touch->bound ? sbri_scale(pull, touch->bound / across) : pull;
}

static double dot_of(sbf_vec3 a, sbf_vec3 b) {
  return (double)a.x * (double)b.x + (double)a.y * (double)b.y + (double)a.z * (double)b.z;
}

void sbri_ground_touches_on_the_way(sbri_rigid_solving *work) {
  for (uint32_t i = 0; i < work->touch_count; i++) {
    const sbri_ground_touch *touch = &work->touches[i];
    if (is_idle(touch, touch->was) && is_idle(touch, touch->moved)) continue;
    sbf_vec3 n = touch->normal, off = sbri_sub(touch->target, touch->was),
             way = sbri_sub(touch->moved, touch->was);
    float into = sbri_dot(n, off), along = sbri_dot(n, way);
    sbri_push_way *p = &work->pushes[work->push_count++];
    *p = (sbri_push_way){.stiff = (double)touch->stiff, .into = (double)into, .way = (double)along};
    if (!(touch->bound > 0)) continue;
    sbf_vec3 across = sbri_add_scaled(off, n, -into), turn = sbri_add_scaled(way, n, -along);
    sbf_vec3 pull = sbri_add_scaled(touch->hold, across, touch->grip), grip = sbri_scale(turn, touch->grip);
    p->bound = (double)touch->bound;
    p->ease = 1 / (double)touch->grip;
    p->pull_pull = dot_of(pull, pull), p->pull_grip = dot_of(pull, grip), p->grip_grip = dot_of(grip, grip);
  }
}

void sbri_ground_touches_move(sbri_rigid_solving *work) {
  for (uint32_t i = 0; i < work->touch_count; i++) {
    sbri_ground_touch *touch = &work->touches[i];
    touch->was = touch->moved;
    touch->moved = moved_now(work, touch);
  }
}

/* The same as the last pass had it. */
static sbf_vec3 linear_at(const sbri_ground_touch *touch, sbf_vec3 du, float *normal) {
  sbf_vec3 n = touch->normal, off = sbri_sub(touch->target, du);
  float into = sbri_dot(n, off);
  *normal = touch->active ? touch->stiff * into : 0;
  if (touch->slides)
    return sbri_add_scaled(touch->drag, touch->side, -touch->side_grip * sbri_dot(touch->side, du));
  return sbri_add_scaled(touch->hold, sbri_add_scaled(off, n, -into), touch->grip);
}

float sbri_ground_touches_off(const sbri_rigid_solving *work) {
  float energy = 0;
  for (uint32_t i = 0; i < work->touch_count; i++) {
    const sbri_ground_touch *touch = &work->touches[i];
    if (!touch->active && is_idle(touch, touch->moved)) continue;
    float normal, linear;
    sbf_vec3 was = linear_at(touch, touch->moved, &linear), is = impulse_at(touch, touch->moved, &normal);
    float across = sbri_length(sbri_sub(was, is));
    float along = fabsf(normal - linear);
    if (along > touch->doubt || across > CHANGE * touch->bound + touch->doubt)
      energy += touch->ease * (along * along + across * across);
  }
  return energy;
}

void sbri_ground_touches_as_solved(sbri_rigid_solving *work) {
  for (uint32_t i = 0; i < work->touch_count; i++) {
    sbri_ground_touch *touch = &work->touches[i];
    if (!touch->active && is_idle(touch, touch->moved)) continue;
    float normal, linear;
    sbf_vec3 was = linear_at(touch, touch->moved, &linear), is = impulse_at(touch, touch->moved, &normal);
    touch->more = sbri_add_scaled(sbri_sub(was, is), touch->normal, linear - normal);
  }
}

void sbri_ground_touches_judge(sbri_rigid_solving *work) {
  for (uint32_t i = 0; i < work->touch_count; i++) {
    sbri_ground_touch *touch = &work->touches[i];
    if (touch->active || !is_idle(touch, touch->moved)) linearise(touch, touch->moved);
  }
}

bool sbri_ground_touches_bound(sbri_rigid_solving *work) {
  float off = 0, all = 0, doubt = 0;
  for (uint32_t i = 0; i < work->touch_count; i++) {
    sbri_ground_touch *touch = &work->touches[i];
    float normal, used = sbri_length(impulse_at(touch, touch->moved, &normal)),
                  bound = touch->friction * normal;
    all += bound;
    doubt += touch->doubt;
    if (touch->slides || used > bound) off += fabsf(bound - touch->bound);
  }
  if (off <= BOUND_CHANGE * all + doubt) return false;
  for (uint32_t i = 0; i < work->touch_count; i++) {
    sbri_ground_touch *touch = &work->touches[i];
    float normal;
    (void)impulse_at(touch, touch->moved, &normal);
    touch->bound = touch->friction * normal;
    linearise(touch, touch->moved);
  }
  return true;
}

void sbri_ground_touches_give(sbri_rigid_solving *work) {
  for (uint32_t i = 0; i < work->touch_count; i++) {
    sbri_ground_touch *touch = &work->touches[i];
    if (!touch->active && !(touch->bound > 0)) continue;
    sbf_vec3 way = given_way(touch, moved_now(work, touch));
    touch->more = sbri_sub(touch->more, way);
  }
}

void sbri_ground_touches_tell(const sbri_rigid_tick *t, sbri_rigid_solving *work) {
  for (uint32_t i = 0; i < work->touch_count; i++) {
    sbri_ground_touch *touch = &work->touches[i];
    float normal;
    sbf_vec3 across = impulse_at(touch, touch->moved, &normal);
    touch->known = true;
    touch->left = sbri_sub(touch->target, touch->moved);
    touch->normal_n = normal / work->kick_s;
    touch->drag_n = sbri_scale(across, normal > 0 ? 1 / work->kick_s : 0);
    if (!(normal > 0)) continue;
    sbf_vec3 place = sbri_add(t->bodies[touch->body].pose.position, touch->arm);
    sbri_touching_one *one =
        sbri_touching_add(&t->touching[touch->body], touch->collider, place, touch->normal, normal);
    sbf_vec3 push = sbri_add(sbri_add_scaled(across, touch->normal, normal), touch->more);
    if (one) sbri_touching_push(one, place, push);
  }
}

bool sbri_ground_touches_bounce(sbri_rigid_solving *work) {
  bool any = false;
  for (uint32_t i = 0; i < work->touch_count; i++) {
    sbri_ground_touch *touch = &work->touches[i];
    if (!touch->active || !(touch->bounce_m_s > 0)) continue;
    sbf_vec3 u = slip_of(work, touch), n = touch->normal;
    sbf_vec3 f = sbri_scale(n, touch->stiff * (touch->bounce_m_s - sbri_dot(n, u)));
    sbf_vec3 moment = sbri_cross(touch->arm, f);
    const float both[6] = {f.x, f.y, f.z, moment.x, moment.y, moment.z};
    for (int k = 0; k < 6; k++) work->system.nodes[touch->node].b[k] += both[k];
    if (touch->external_body)
      sbri_rigid_external_body_push(
          external_body_of(work, touch), touch->external_body_arm, sbri_scale(f, -1));
    touch->more = sbri_add(touch->more, f);
    any = true;
  }
  return any;
}
