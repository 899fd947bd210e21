/* The impulses of touches that act on each other.
 *
 * What each needs is found in turn, corrected by what the others have left of it, never pulling and never
 * rubbing by more than its friction (projected Gauss-Seidel over gathered impulses; E. Catto, Iterative
 * Dynamics with Temporal Coherence, 2005), the three directions of a touch at once where it sticks; to and
 * fro. What that has changed is a gradient of what it lowers: each pass goes on along the ways of those
 * before as conjugate gradients do (M. Silcowitz-Hansen, S. Niebe, K. Erleben, A nonsmooth nonlinear
 * conjugate gradient method for interactive contact force problems, 2010), or a tower would need a pass for
 * nearly every pair of its boxes. */
#include "meet/settle.h"

enum { PASSES = 60 }; /* at most */
/* A pass that changes no speed by more is the last. */
static const float SETTLED_M_S = 2e-5f;
/* m^2/s^2: slower across than this is no direction. */
static const float NO_SLIP = 1e-20f;

static sbri_four answer(const float m[6], sbri_four v) {
  const sbri_four columns[3] = {sbri_four_of(sbri_vec3(m[0], m[3], m[4])),
      sbri_four_of(sbri_vec3(m[3], m[1], m[5])), sbri_four_of(sbri_vec3(m[4], m[5], m[2]))};
  return sbri_four_times(columns, v);
}

static float larger(float a, float b) {
  return b > a ? b : a;
}

/* ---- Before and after ---- */

static sbf_vec3 impulse_of(const sbri_meet_row *r) {
  return sbri_add_scaled(r->rub, r->normal, r->gain);
}

/* How a push at the end of its arm turns the mover. */
static void find_spins(sbri_meet_end *end) {
  float(*e)[3] = end->mover->eases;
  sbf_vec3 r = end->arm, x = sbri_vec3(e[0][0], e[1][0], e[2][0]), y = sbri_vec3(e[0][1], e[1][1], e[2][1]),
           z = sbri_vec3(e[0][2], e[1][2], e[2][2]);
  end->spins[0] = sbri_four_of(sbri_add_scaled(sbri_scale(y, r.z), z, -r.y));
  end->spins[1] = sbri_four_of(sbri_add_scaled(sbri_scale(z, r.x), x, -r.z));
  end->spins[2] = sbri_four_of(sbri_add_scaled(sbri_scale(x, r.y), y, -r.x));
}

static void begin_side(sbri_meet_row *r, int side, sbri_meet_end *end, sbri_meet_mover *nobody) {
  r->movers[side] = end->mover ? end->mover : nobody;
  r->arms[side] = sbri_four_of(end->mover ? end->arm : sbri_vec3(0, 0, 0));
  if (end->mover) find_spins(end);
  r->arms_turned[side] = sbri_four_turn(r->arms[side]);
}

static void begin(sbri_meet_row *r, sbri_meet_mover *nobody) {
  const float *b = r->block;
  r->along = sbri_four_of(r->normal);
  r->first = r->impulse;
  r->aim = sbri_four_of(sbri_sub(r->wanted, sbri_sub(r->a.still, r->b.still)));
  r->blocks[0] = sbri_four_of(sbri_vec3(b[0], b[3], b[4]));
  r->blocks[1] = sbri_four_of(sbri_vec3(b[3], b[1], b[5]));
  r->blocks[2] = sbri_four_of(sbri_vec3(b[4], b[5], b[2]));
  begin_side(r, 0, &r->a, nobody);
  begin_side(r, 1, &r->b, nobody);
  r->ease = r->mass > 0 ? 1 / (r->mass * r->mass) : 0;
}

static void note(const sbri_meet_end *end, sbf_vec3 impulse) {
  if (!end->mover) return;
  end->mover->given = sbri_add(end->mover->given, impulse);
  end->mover->moment = sbri_add(end->mover->moment, sbri_cross(end->arm, impulse));
}

static void end(sbri_meet_row *r) {
  if (!r->bears) return;
  sbf_vec3 given = sbri_four_xyz(sbri_four_sub(r->impulse, r->first));
  r->rub = sbri_four_xyz(sbri_four_add_scaled(r->impulse, r->along, -r->gain));
  note(&r->a, given);
  note(&r->b, sbri_scale(given, -1));
}

/* ---- A touch of rigid bodies ---- */

/* m/s that are missing. */
static sbri_four off_of(const sbri_meet_row *r) {
  const sbri_meet_mover *a = r->movers[0], *b = r->movers[1];
  sbri_four v =
      sbri_four_sub(a->velocity, b->velocity); /* and the products of spins and arms, turned back: */
  sbri_four w = sbri_four_sub(
      sbri_four_mul(a->spin, r->arms_turned[0]), sbri_four_mul(sbri_four_turn(a->spin), r->arms[0]));
  sbri_four u = sbri_four_sub(
      sbri_four_mul(b->spin, r->arms_turned[1]), sbri_four_mul(sbri_four_turn(b->spin), r->arms[1]));
  return sbri_four_sub(r->aim, sbri_four_add(v, sbri_four_turn(sbri_four_sub(w, u))));
}

static void give_mover(const sbri_meet_end *end, sbri_meet_mover *m, sbri_four p) {
  m->velocity = sbri_four_add_scaled(m->velocity, p, m->ease);
  m->spin = sbri_four_add(m->spin, sbri_four_times(end->spins, p));
}

/* Gives both the difference; returns the square of the speed that it has changed. */
static float take(sbri_meet_row *r, float gain, sbri_four impulse) {
  sbri_four change = sbri_four_sub(impulse, r->impulse), back = sbri_four_sub(r->impulse, impulse);
  r->gain = gain, r->impulse = impulse;
  if (r->a.mover) give_mover(&r->a, r->a.mover, change);
  if (r->b.mover) give_mover(&r->b, r->b.mover, back);
  return sbri_four_dot(change, change) * r->ease;
}

static sbri_four within_friction(const sbri_meet_row *r, sbri_four rub, float gain) {
  float most = r->friction * gain, size = sbri_four_dot(rub, rub);
  return size > most * most ? sbri_four_scale(rub, most / sqrtf(size)) : rub;
}

/* Where it slides, or lets go. */
static float slide(sbri_meet_row *r, sbri_four off, float along, float gain) {
  sbri_four n = r->along, rub = sbri_four_add_scaled(r->impulse, n, -r->gain);
  if (!(gain > 0)) gain = 0;
  sbri_four side = sbri_four_add_scaled(off, n, -along);
  float slip = sbri_four_dot(side, side);
  if (slip > NO_SLIP)
    rub = sbri_four_add_scaled(rub, side, slip / sbri_four_dot(side, answer(r->eases, side)));
  return take(r, gain, sbri_four_add_scaled(within_friction(r, rub, gain), n, gain));
}

/* Returns the square of the speed that it has changed. */
static float correct(sbri_meet_row *r) {
  sbri_four n = r->along, off = off_of(r);
  float along = sbri_four_dot(n, off), gain = r->gain + r->mass * along;
  if (!(gain > 0) && r->gain == 0) return 0;
  sbri_four sticks = sbri_four_add(r->impulse, sbri_four_times(r->blocks, off));
  float bears = sbri_four_dot(sticks, n), most = r->friction * bears;
  sbri_four rub = sbri_four_add_scaled(sticks, n, -bears);
  if (!(bears > 0 && sbri_four_dot(rub, rub) <= most * most)) return slide(r, off, along, gain);
  return take(r, bears, sticks);
}

/* On along the way, as far as a touch may. */
static void go_on(sbri_meet_row *r, float share) {
  sbri_four p = sbri_four_add_scaled(r->impulse, r->way, share);
  float gain = sbri_four_dot(p, r->along);
  sbri_four rub = sbri_four_add_scaled(p, r->along, -gain);
  if (!(gain > 0)) gain = 0;
  (void)take(r, gain, sbri_four_add_scaled(within_friction(r, rub, gain), r->along, gain));
}

/* ---- A touch of which one end may be carried by points ---- */

static sbf_vec3 answer_of(const float m[6], sbf_vec3 v) {
  return sbri_vec3(m[0] * v.x + m[3] * v.y + m[4] * v.z, m[3] * v.x + m[1] * v.y + m[5] * v.z,
      m[4] * v.x + m[5] * v.y + m[2] * v.z);
}

static sbf_vec3 within_friction_of(const sbri_meet_row *r, sbf_vec3 rub, float gain) {
  float most = r->friction * gain, size = sbri_dot(rub, rub);
  return size > most * most ? sbri_scale(rub, most / sqrtf(size)) : rub;
}

static float take_soft(sbri_meet_row *r, float gain, sbf_vec3 rub) {
  sbf_vec3 before = impulse_of(r);
  r->gain = gain, r->rub = rub;
  sbf_vec3 now = impulse_of(r), change = sbri_sub(now, before);
  sbri_meet_give(r, change);
  r->impulse = sbri_four_of(now);
  return sbri_dot(change, change) / (r->mass * r->mass);
}

static float correct_soft(sbri_meet_row *r) {
  sbf_vec3 n = r->normal, off = sbri_sub(r->wanted, sbri_meet_between(r));
  float along = sbri_dot(n, off), gain = r->gain + r->mass * along;
  if (!(gain > 0) && r->gain == 0) return 0;
  sbf_vec3 sticks = sbri_add(impulse_of(r), answer_of(r->block, off));
  float bears = sbri_dot(sticks, n), most = r->friction * bears;
  sbf_vec3 rub = sbri_add_scaled(sticks, n, -bears);
  if (bears > 0 && sbri_dot(rub, rub) <= most * most) return take_soft(r, bears, rub);
  if (!(gain > 0)) gain = 0;
  sbf_vec3 side = sbri_add_scaled(off, n, -along);
  float slip = sbri_dot(side, side);
  rub = slip > NO_SLIP ? sbri_add_scaled(r->rub, side, slip / sbri_dot(side, answer_of(r->eases, side)))
                       : r->rub;
  return take_soft(r, gain, within_friction_of(r, rub, gain));
}

static void go_on_soft(sbri_meet_row *r, float share) {
  sbf_vec3 p = sbri_add_scaled(impulse_of(r), sbri_four_xyz(r->way), share);
  float gain = sbri_dot(p, r->normal);
  sbf_vec3 rub = sbri_add_scaled(p, r->normal, -gain);
  if (!(gain > 0)) gain = 0;
  (void)take_soft(r, gain, within_friction_of(r, rub, gain));
}

/* ---- All ---- */

typedef struct kind {
  float (*correct)(sbri_meet_row *row);
  void (*go_on)(sbri_meet_row *row, float share);
} kind;

SBRI_INLINE void settle(sbri_meet_row *rows, uint32_t count, const kind *of) {
  const float settled = SETTLED_M_S * SETTLED_M_S;
  float last = 0;
  for (int pass = 0; pass < PASSES; pass++) {
    float most = 0, sum = 0;
    for (uint32_t i = 0; i < count; i++) {
      rows[i].change = sbri_four_scale(rows[i].impulse, -1);
      if (rows[i].bears) most = larger(most, of->correct(&rows[i]));
    }
    for (uint32_t i = count; i-- > 0;)
      if (rows[i].bears) most = larger(most, of->correct(&rows[i]));
    if (most < settled) return;
    for (uint32_t i = 0; i < count; i++) {
      sbri_meet_row *r = &rows[i];
      if (!r->bears) continue;
      r->change = sbri_four_add(r->change, r->impulse);
      sum += sbri_four_dot(r->change, r->change) / r->mass;
    }
    float share = last > 0 && sum <= last ? sum / last : 0;
    last = sum;
    for (uint32_t i = 0; i < count; i++) {
      sbri_meet_row *r = &rows[i];
      if (!r->bears) continue;
      if (share > 0) of->go_on(r, share);
      r->way = sbri_four_add_scaled(r->change, r->way, share);
    }
  }
}

void sbri_meet_settle(sbri_meet_row *rows, uint32_t count) {
  static const kind rigid = {correct, go_on}, any = {correct_soft, go_on_soft};
  sbri_meet_mover nobody = {.ease = 0};
  bool all_are_rigid = true;
  for (uint32_t i = 0; i < count; i++) {
    rows[i].impulse = sbri_four_of(impulse_of(&rows[i]));
    rows[i].way = sbri_four_of(sbri_vec3(0, 0, 0));
    all_are_rigid = all_are_rigid && rows[i].a.count + rows[i].b.count == 0;
  }
  if (!all_are_rigid) {
    settle(rows, count, &any);
    return;
  }
  for (uint32_t i = 0; i < count; i++) begin(&rows[i], &nobody);
  settle(rows, count, &rigid);
  for (uint32_t i = 0; i < count; i++) end(&rows[i]);
}
