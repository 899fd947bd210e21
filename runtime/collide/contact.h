/* Points against the ground.
 *
 * Once a tick the ground is asked under each point that may reach it, and stands for that tick as the plane
 * that touches it there. In each substep a point that would end below its plane has its normal speed cut so
 * that it just arrives (or thrown back by the restitution where it is fast), and Coulomb friction takes no
 * more from its sideways speed than the friction coefficient times what the normal lost. What lies below
 * already is moved up, at a limited rate and without gaining speed; nothing is ever pulled down or held. */
#ifndef SBRI_CONTACT_H
#define SBRI_CONTACT_H

#include "model/runtime_model.h"

typedef struct sbri_contact_input {
  const sbri_island *island;
  const sbri_body *body;
  const sbri_point *positions; /* of the island, asset metres */
  const float *velocities;     /* of the island, blocks of three by eight */
  const sbr_ground *ground;
  sbr_double3 origin;
  float scale;
  float tick_s; /* of the body's own time */
} sbri_contact_input;

/* Marks the body's blocks of points that may touch the ground within the tick, and gives each of their points
 * its plane: blocks of four by eight, the unit normal and n.x of the plane. */
void sbri_contact_prepare(const sbri_contact_input *input, uint8_t *near_ground, float *planes);

typedef struct sbri_contact_rule {
  float friction, restitution;
  float step_s;
  float push_m;          /* most that a point is moved up in a substep */
  float bounce_from_m_s; /* slower contacts do not bounce */
} sbri_contact_rule;

/* One group of lanes in a substep: corrects velocity and place; `x` comes in as at the beginning of the
 * substep and goes out as at its end. */
static inline void sbri_contact_move(
    sbri_wide3 *x, sbri_wide3 *v, const float *plane, const sbri_contact_rule *rule) {
  sbri_wide nx = sbri_wide_load(plane), ny = sbri_wide_load(plane + SBRI_BLOCK);
  sbri_wide nz = sbri_wide_load(plane + 2 * SBRI_BLOCK), offset = sbri_wide_load(plane + 3 * SBRI_BLOCK);
  sbri_wide zero = sbri_wide_all(0), h = sbri_wide_all(rule->step_s);
  sbri_wide gap = nx * x->x + ny * x->y + nz * x->z - offset;
  sbri_wide speed = nx * v->x + ny * v->y + nz * v->z;
  sbri_mask touches = gap + h * speed < zero;
  /* To where it just arrives; nowhere, where it lies below already. */
  sbri_wide wanted = zero - sbri_wide_max(gap, zero) / h;
  sbri_mask bounces = speed < sbri_wide_all(-rule->bounce_from_m_s);
  wanted = sbri_wide_select(
      bounces, sbri_wide_max(wanted, zero - sbri_wide_all(rule->restitution) * speed), wanted);
  sbri_wide gain = sbri_wide_select(touches, sbri_wide_max(wanted - speed, zero), zero);
  sbri_wide sx = v->x - nx * speed, sy = v->y - ny * speed, sz = v->z - nz * speed;
  sbri_wide sideways = sbri_wide_sqrt(sx * sx + sy * sy + sz * sz);
  sbri_wide most = sbri_wide_all(rule->friction) * gain;
  /* Share of the sideways speed that friction takes. */
  sbri_wide share = sbri_wide_min(most / sbri_wide_max(sideways, sbri_wide_all(1e-20f)), sbri_wide_all(1));
  v->x = v->x + nx * gain - sx * share;
  v->y = v->y + ny * gain - sy * share;
  v->z = v->z + nz * gain - sz * share;
  sbri_wide up = sbri_wide_min(sbri_wide_max(zero - gap, zero), sbri_wide_all(rule->push_m));
  up = sbri_wide_select(touches, up, zero);
  x->x = x->x + h * v->x + nx * up;
  x->y = x->y + h * v->y + ny * up;
  x->z = x->z + h * v->z + nz * up;
}

#endif
