/* Hulls against the ground, vertex by vertex.
 *
 * Once a tick the ground is asked under each vertex that may reach it, and stands for that tick as the plane
 * that touches it there, as it does for soft bodies (contact/contact.h). A touch acts on one body alone, and
 * so lies in the body's own block of the system: all touches, and all joints, are solved at once. Along the
 * normal it is a row that gives way by a small share of the body's own inertia there, pushes only, and aims
 * at the vertex's lying on the plane at the substep's end. Across it is the same where it sticks; where that
 * would take more than Coulomb's law allows it is a damper of friction times normal impulse over the speed of
 * sliding, and who sticks and who slides is found in a few passes. */
#include "collide/ground.h"
#include "rigid/rigid_work.h"

/* How much stiffer than the body's own inertia. */
static const float FIRM = 3000;
/* By this share more than Coulomb's law allows still sticks. */
static const float STICK_SLACK = 5e-4f;
/* Slower than this, the direction of sliding stays what it was. */
static const float SLOW_M_S = 1e-4f;
/* A drag that is right but for this share needs no other pass. */
static const float DRAG_CHANGE = 0.01f;
/* What is no higher lies on the ground: to pull it down there for one step does next to nothing. */
static const float LYING_M = 1e-4f;
/* What lies below is moved up by this share of it a substep, and no faster than that. */
static const float LIFT_SHARE = 0.2f, LIFT_MOST_M_S = 0.5f;

static float height_at(const sbri_rigid_tick *t, float x, float z, sbf_vec3 *normal) {
  double world_x = t->origin.x + (double)t->scale * x, world_z = t->origin.z + (double)t->scale * z;
  return (float)((sbri_ground_height(t->ground, world_x, world_z, normal) - t->origin.y) / t->scale);
}

static void list_body(const sbri_rigid_tick *t, sbri_rigid_solving *work, uint32_t b, int32_t node) {
  const sbri_rigid_body *body = &t->model->bodies[b];
  const sbri_rigid_body_state *s = &t->bodies[b];
  sbf_vec3 turn = sbri_spin_velocity(body, s->pose.rotation, s->spin), normal;
  float fastest = sbri_length(s->velocity) + sbri_length(turn) * body->radius;
  float way =
      2 * fastest * t->tick_s + 2 * sbri_length(t->gravity) * t->tick_s * t->tick_s + 0.02f * body->radius;
  float under = height_at(t, s->pose.position.x, s->pose.position.z, &normal);
  float slope = normal.y > 0.1f ? 1 / normal.y : 10; /* and ground that rises nearby by as much again */
  double flat;
  float reach = body->radius * (sbri_ground_is_flat(t->ground, &flat) ? 1 : 1 + slope) + way;
  if (s->pose.position.y - under > reach) return;
  for (uint32_t i = 0; i < body->vertex_count; i++) {
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
        .collider = UINT32_MAX};
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

/* Of the place against what it touches. */
static sbf_vec3 slip_of(const sbri_rigid_solving *work, const sbri_ground_touch *touch) {
  const sbri_part_motion *m = &work->motions[touch->body];
  return sbri_sub(velocity_at(m->velocity, m->turn, touch->arm), touch->velocity);
}

void sbri_ground_touches_make(
    const sbri_rigid_tick *t, sbri_rigid_solving *work, float since_s, float step_s) {
  float bounce_from = 4 * sbri_length(t->gravity) * step_s;
  for (uint32_t i = 0; i < work->touch_count; i++) {
    sbri_ground_touch *touch = &work->touches[i];
    const sbri_rigid_body *body = &t->model->bodies[touch->body];
    const sbri_rigid_body_state *s = &t->bodies[touch->body];
    sbf_vec3 n = touch->normal;
    touch->arm = sbri_rotate(s->pose.rotation, touch->at);
    float plane = touch->offset + since_s * sbri_dot(n, touch->velocity);
    touch->gap = sbri_dot(n, sbri_add(s->pose.position, touch->arm)) - plane;
    sbf_vec3 u = slip_of(work, touch);
    float speed = sbri_dot(n, u), lift = -LIFT_SHARE * touch->gap / step_s;
    float wanted = touch->gap > 0 ? -touch->gap / step_s : lift < LIFT_MOST_M_S ? lift : LIFT_MOST_M_S;
    touch->target = sbri_sub(sbri_scale(n, wanted), u);
    touch->active = speed < wanted;
    touch->bounce_m_s = 0;
    if (touch->active && -speed > bounce_from) {
      /* Velocities are those half a substep ago; before, the substep's own fall is in it. */
      float g = -sbri_dot(n, t->gravity), half = 0.5f * g * step_s, begin = speed + half;
      float square = begin * begin + 2 * g * (touch->gap > 0 ? touch->gap : 0);
      touch->bounce_m_s = touch->restitution * (square > 0 ? sqrtf(square) : 0) + half;
      if (!(touch->restitution > 0)) touch->bounce_m_s = 0;
    }
    touch->stiff = FIRM / ease(body, s->pose.rotation, touch->arm, n);
    touch->grip = touch->stiff;
    /* What is faster than friction could stop in the substep slides, against where it comes from. */
    float slip = sbri_length(sbri_add_scaled(u, n, -speed));
    bool slides = !(touch->friction > 0) || slip > 4 * bounce_from * touch->friction;
    if (slides && !touch->slides) touch->drag = sbri_vec3(0, 0, 0), touch->side_grip = 0;
    touch->slides = touch->slides || slides;
  }
}

/* d += J^T W J, b += J^T (W wanted + drag), with J = (1, -arm x), and W = stiff n n^T + grip (1 - n n^T)
 * where it sticks, stiff n n^T + side_grip side side^T where it slides. */
static void add_touch(sbri_node *node, const sbri_ground_touch *touch) {
  float grip = touch->slides ? 0 : touch->grip, more = touch->stiff - grip;
  float across = touch->slides ? touch->side_grip : 0;
  const float n[3] = {touch->normal.x, touch->normal.y, touch->normal.z};
  const float p[3] = {touch->side.x, touch->side.y, touch->side.z};
  sbf_vec3 w[3], arm_w[3]; /* columns of W, and of arm x W */
  for (int j = 0; j < 3; j++) {
    float column[3];
    for (int i = 0; i < 3; i++) column[i] = (i == j ? grip : 0) + more * n[i] * n[j] + across * p[i] * p[j];
    w[j] = sbri_vec3(column[0], column[1], column[2]);
    arm_w[j] = sbri_cross(touch->arm, w[j]);
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
  sbf_vec3 t = touch->target;
  sbf_vec3 f = sbri_add_scaled(sbri_add_scaled(sbri_scale(w[0], t.x), w[1], t.y), w[2], t.z);
  if (touch->slides) f = sbri_add(f, touch->drag);
  sbf_vec3 moment = sbri_cross(touch->arm, f);
  const float both[6] = {f.x, f.y, f.z, moment.x, moment.y, moment.z};
  for (int i = 0; i < 6; i++) node->b[i] += both[i];
}

void sbri_ground_touches_add(sbri_rigid_solving *work) {
  for (uint32_t i = 0; i < work->touch_count; i++)
    if (work->touches[i].active) add_touch(&work->system.nodes[work->touches[i].node], &work->touches[i]);
}

static void slide(sbri_ground_touch *touch, sbf_vec3 against, float most, float speed) {
  touch->drag = sbri_scale(against, most);
  touch->side = sbri_cross(touch->normal, against);
  touch->side_grip = speed * touch->grip > most ? most / speed : touch->grip;
}

/* Sticks or slides; whether that is another than it was. `left` is the velocity across that is left, `slip`
 * the speed across without the ground, and `impulse` the one across that sticking takes. */
static bool judge_grip(
    sbri_ground_touch *touch, float friction, sbf_vec3 impulse, sbf_vec3 left, float slip) {
  float most = friction * (touch->normal_impulse > 0 ? touch->normal_impulse : 0);
  if (!touch->slides) {
    float across = sbri_length(impulse);
    if (across <= most * (1 + STICK_SLACK)) return false;
    touch->slides = true;
    slide(touch, sbri_scale(impulse, 1 / across), most, slip * (1 - most / across));
    return true;
  }
  float before = sbri_length(touch->drag), speed = sbri_length(left);
  if (sbri_dot(left, touch->drag) > 0) { /* friction does not turn it round */
    touch->slides = false;
    return true;
  }
  sbf_vec3 against =
      speed > SLOW_M_S ? sbri_scale(left, -1 / speed) : sbri_normalize(touch->drag, sbri_vec3(0, 0, 0));
  sbf_vec3 was = touch->drag;
  /* Half way: the normal impulses of the pass before were those of its own friction. */
  slide(touch, against, before > 0 ? 0.5f * (before + most) : most, speed);
  return sbri_length(sbri_sub(touch->drag, was)) > DRAG_CHANGE * (before > most ? before : most);
}

/* What the system's solution gives a touch. */
typedef struct outcome {
  sbf_vec3 left;    /* velocity across */
  sbf_vec3 impulse; /* across, if it sticks */
  float slip;       /* speed across without the ground */
  float speed;      /* along the normal */
} outcome;

static outcome outcome_of(const sbri_rigid_solving *work, sbri_ground_touch *touch) {
  const double *x = work->system.nodes[touch->node].x;
  sbf_vec3 n = touch->normal, du = velocity_at(sbri_vec3((float)x[0], (float)x[1], (float)x[2]),
                                  sbri_vec3((float)x[3], (float)x[4], (float)x[5]), touch->arm);
  sbf_vec3 u = slip_of(work, touch), now = sbri_add(u, du);
  if (touch->active) touch->normal_impulse = touch->stiff * (sbri_dot(n, touch->target) - sbri_dot(n, du));
  sbf_vec3 impulse = sbri_scale(sbri_sub(touch->target, du), touch->grip);
  float speed = sbri_dot(n, now);
  return (outcome){.left = sbri_add_scaled(now, n, -speed),
      .impulse = sbri_add_scaled(impulse, n, -sbri_dot(n, impulse)),
      .slip = sbri_length(sbri_add_scaled(u, n, -sbri_dot(n, u))),
      .speed = speed};
}

/* Where passes do not settle who slides, as where a limb is jammed, friction becomes a damper of what it
 * would be at the speed that is left: that takes energy whatever its strength. */
static bool damp_slides(sbri_rigid_solving *work) {
  bool any = false;
  for (uint32_t i = 0; i < work->touch_count; i++) {
    sbri_ground_touch *touch = &work->touches[i];
    if (!touch->active || !touch->slides) continue;
    float normal = touch->normal_impulse > 0 ? touch->normal_impulse : 0;
    float most = touch->friction * normal;
    float speed = sbri_length(outcome_of(work, touch).left);
    if (speed * touch->grip > most) touch->grip = most / speed;
    touch->slides = false;
    any = true;
  }
  return any;
}

bool sbri_ground_touches_judge(sbri_rigid_solving *work, float step_s, int stage) {
  bool settle = stage > 0;
  bool changed = settle && damp_slides(work);
  for (uint32_t i = 0; i < work->touch_count; i++) {
    sbri_ground_touch *touch = &work->touches[i];
    outcome is = outcome_of(work, touch);
    float friction = touch->friction;
    if (!settle && touch->active && friction > 0 && judge_grip(touch, friction, is.impulse, is.left, is.slip))
      changed = true;
    else if ((stage == 0 || (stage == 1 && touch->gap < LYING_M)) && !touch->active &&
             touch->gap + step_s * is.speed < -1e-6f && is.speed < 0)
      touch->active = changed = true;
  }
  if (changed) return true; /* who pulls is judged by friction as it should be */
  for (uint32_t i = 0; i < work->touch_count; i++) {
    sbri_ground_touch *touch = &work->touches[i];
    if (!touch->active || touch->normal_impulse >= 0) continue;
    touch->active = false;
    changed = true;
  }
  return changed;
}

void sbri_ground_touches_tell(const sbri_rigid_tick *t, const sbri_rigid_solving *work) {
  for (uint32_t i = 0; i < work->touch_count; i++) {
    const sbri_ground_touch *touch = &work->touches[i];
    if (touch->active && touch->normal_impulse > 0)
      sbri_touching_add(&t->touching[touch->body], touch->collider,
          sbri_add(t->bodies[touch->body].pose.position, touch->arm), touch->normal, touch->normal_impulse);
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
    any = true;
  }
  return any;
}
