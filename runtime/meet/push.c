/* Touching places push each other off, before a step.
 *
 * Weight, springs and joints act in the step that follows. That weight will is looked ahead at, or all that
 * rests would sink by a step's fall each time. What else does is answered where it has moved places: into
 * each other, or across while they stick, by a share of that a step. To look ahead at it too, by what it did
 * in the step before, drives soft bodies against each other. */
#include "meet/settle.h"

/* Slower contacts do not bounce. */
static const float BOUNCE_FROM_M_S = 0.3f;
/* What is deeper than this comes out by that share of it a step, and no faster; soft matter in soft matter,
 * whose surfaces are never quite of one form, by less. */
static const float SLACK_M = 1e-4f, OUT_SHARE = 0.1f, SOFT_OUT_SHARE = 0.05f, OUT_M_S = 0.2f;
/* As near to the most friction as this share it slides. */
static const float SLIDES_SHARE = 0.999f;
/* Soft in soft what is deeper than this share of the smaller body's size looks ahead, by what is learnt of
 * each step. */
static const float DEEP_SHARE = 0.003f, DEEP_OF_MARGIN = 0.1f, LEARNS = 0.3f;
static const sbf_vec3 nothing = {0, 0, 0};

static bool is_plane(const sbri_meet_touch *t) {
  return t->b.rigid_body == SBRI_MEET_PLANE;
}

static bool both_are_soft(const sbri_meet_touch *t) {
  return t->a.rigid_body == SBRI_MEET_SOFT && t->b.rigid_body == SBRI_MEET_SOFT;
}

static float out_share(const sbri_meet_touch *t) {
  return both_are_soft(t) ? SOFT_OUT_SHARE : OUT_SHARE;
}

/* The speed along the normal that a touch may come to. Nearer than the slack it closes, or comes out, by a
 * share of the gap: what lies there would else answer each rounding of its place with a push. */
static float wanted_of(const sbri_meet_row *r, float step_s) {
  float share = out_share(r->touch), depth = -r->gap;
  if (r->gap > SLACK_M) return -(r->gap - (1 - share) * SLACK_M) / step_s;
  if (is_plane(r->touch) && depth > 0) return 0; /* its own step lifts it */
  float speed = share * depth / step_s;
  return speed > OUT_M_S ? OUT_M_S : speed;
}

/* Acceleration by weight of an end that it moves. */
static sbf_vec3 fall_of(const sbr_world *world, const sbri_meet_group *group, const sbri_meet_side *side,
    const sbri_meet_end *end) {
  const sbri_meet_member *m = &world->meetings->members[group->first_member + side->member];
  const sbr_model *model = m->character->model;
  if (side->guest) return sbri_meet_guest_fall(group, m, side->guest);
  sbf_vec3 weight = world->has_gravity ? world->gravity : model->asset->environment.gravity;
  float share = end->mover ? model->rigid.bodies[side->rigid_body].source->gravity_scale : 0;
  for (uint32_t k = 0; k < end->count; k++) share += end->weights[k];
  return sbri_scale(weight, share);
}

/* How far a has gone across b since they stick. */
static sbf_vec3 slid_now(const sbri_meet_row *r) {
  const sbri_meet_touch *t = r->touch;
  sbf_vec3 way = sbri_sub(r->apart, t->apart);
  if (is_plane(t)) return nothing;
  return sbri_add(t->slid, sbri_add_scaled(way, t->normal, -sbri_dot(way, t->normal)));
}

/* From there on, and twice as deep wholly. */
static float deep_of(const sbri_meet_touch *t) {
  float deep = DEEP_SHARE * t->soft_m, thin = DEEP_OF_MARGIN * t->margin;
  return t->margin > 0 && thin < deep ? thin : deep;
}

/* Notes what the step before has changed the speed along the normal by: by a share, but at once where a blow
 * presses soft bodies into each other, which would go in as it is learnt. What lay deep in when the tick
 * began goes out gently. */
static void learn(sbri_meet_row *r, float speed) {
  sbri_meet_touch *t = r->touch;
  float change = speed - t->after - t->pull;
  bool presses = change < 0 && speed < -BOUNCE_FROM_M_S && both_are_soft(t) && t->margin == 0 && !t->is_in &&
                 -r->gap > 2 * deep_of(t);
  if (t->was_pushed) t->pull += presses ? change : LEARNS * change;
  t->was_pushed = false;
}

/* The speed against what will press in, beside weight, where something soft is pressed: rigid parts that it
 * lies on do not swing with it, another soft body does, and is looked ahead at only where it is deep. */
static float pull_ahead(const sbri_meet_row *r, float fall) {
  const sbri_meet_touch *t = r->touch;
  float pull = t->pull - fall;
  if (!(t->soft_m > 0) || pull >= 0) return 0;
  return both_are_soft(t) ? -pull * sbri_clamp(-r->gap / deep_of(t) - 1, 0, 1) : -pull;
}

/* What both may come to at the step's end, and what pushes of the step before they begin with. */
static void begin(const sbr_world *world, const sbri_meet_group *group, sbri_meet_row *r) {
  sbri_meet_touch *t = r->touch;
  float step_s = group->step_s, speed = sbri_dot(t->normal, sbri_meet_between(r));
  float wanted = wanted_of(r, step_s);
  r->speed = speed;
  learn(r, speed);
  if (r->gap + step_s * speed < 0 && -t->restitution * speed > wanted && speed < -BOUNCE_FROM_M_S) {
    r->wanted = sbri_scale(t->normal, -t->restitution * speed);
  } else {
    sbf_vec3 fall = sbri_sub(fall_of(world, group, &t->a, &r->a), fall_of(world, group, &t->b, &r->b));
    r->wanted = sbri_add_scaled(sbri_scale(t->normal, wanted), fall, -step_s);
    r->wanted = sbri_add_scaled(r->wanted, slid_now(r), -out_share(t) / step_s);
    r->wanted = sbri_add_scaled(r->wanted, t->normal, pull_ahead(r, step_s * sbri_dot(fall, t->normal)));
  }
  bool out = is_plane(t) && speed < -BOUNCE_FROM_M_S; /* its own step throws it back */
  if (out) t->pushed = false;
  r->bears = r->mass > 0 && !out;
  if (!t->pushed) t->gain = 0, t->rub = nothing;
  r->gain = t->gain, r->rub = t->rub;
}

/* To the body's touches, of which it is one: the ground and the host's shapes hear of it from there. */
static void tell_plane(const sbri_meetings *all, const sbri_meet_group *group, const sbri_meet_row *r) {
  const sbri_meet_touch *t = r->touch;
  const sbri_meet_member *m = &all->members[group->first_member + t->a.member];
  sbf_vec3 place = sbri_scale(sbri_sub(r->place, m->offset), 1 / m->scale);
  sbf_vec3 push = sbri_scale(sbri_add_scaled(r->rub, r->normal, r->gain), 1 / (m->mass * m->speed));
  sbri_touching_one *one = sbri_touching_add(&sbri_rigid_touching(m->character)[t->a.rigid_body],
      sbri_meet_collider_of(t->names[1]), place, r->normal, sbri_dot(push, r->normal));
  if (one) sbri_touching_push(one, place, push);
}

static void end(const sbri_meet_row *r) {
  sbri_meet_touch *t = r->touch;
  float most = SLIDES_SHARE * t->friction * r->gain;
  t->gain = r->gain, t->rub = r->rub;
  t->pushed = t->gain > 0;
  t->after = sbri_dot(t->normal, sbri_meet_between(r));
  t->was_pushed = true;
  if (t->pushed) {
    t->impulse += t->gain, t->place = r->place;
    t->closing = t->closing > -r->speed ? t->closing : -r->speed;
  }
  if (sbri_dot(t->rub, t->rub) >= most * most) t->slid = nothing, t->apart = r->apart;
}

void sbri_meet_push(const sbr_world *world, const sbri_meet_group *group, bool first) {
  const sbri_meetings *all = world->meetings;
  sbri_meet_row *rows = all->rows + group->first_touch;
  uint32_t count = group->touch_count;
  sbri_meet_movers_read(all, group);
  for (uint32_t i = 0; i < count; i++) {
    rows[i].touch = &all->touches[group->first_touch + i];
    sbri_meet_row_begin(all, group, &rows[i], first);
    if (first) rows[i].touch->apart = rows[i].apart;
  }
  for (uint32_t i = 0; i < count; i++) begin(world, group, &rows[i]);
  for (uint32_t i = 0; i < count; i++)
    if (rows[i].touch->pushed)
      sbri_meet_give(&rows[i], sbri_add_scaled(rows[i].rub, rows[i].normal, rows[i].gain));
  sbri_meet_settle(rows, count);
  for (uint32_t i = 0; i < count; i++) {
    end(&rows[i]);
    if (is_plane(rows[i].touch) && rows[i].gain > 0) tell_plane(all, group, &rows[i]);
  }
  sbri_meet_movers_write(all, group);
}

void sbri_meet_look(const sbri_meetings *all, const sbri_meet_group *group) {
  sbri_meet_movers_read(all, group);
  for (uint32_t i = 0; i < group->touch_count; i++) {
    sbri_meet_row *r = &all->rows[group->first_touch + i];
    sbri_meet_row_begin(all, group, r, false);
    r->touch->slid = slid_now(r);
    learn(r, sbri_dot(r->normal, sbri_meet_between(r)));
  }
}
