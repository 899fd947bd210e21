/* The host's bodies in the step's system.
 *
 * A contact with one couples two bodies; all other contacts act on one. Each hull has its own copy of a
 * host's body (shapes/external_body.h), so the copy is a leaf of the system: it is eliminated exactly before
 * the hull's body, and its change of velocity follows from that body's. The unknowns are y with velocities =
 * `roots` y, where `roots` is the square root of the inverse mass matrix. So y has mass 1 even where the body
 * cannot move in some direction.
 */
#include "rigid/rigid_external_bodies.h"

#include <string.h>

#include "rigid/rigid_work.h"
#include "rigid/sym6.h"

static void spread(const float from[6], float to[3][3]) {
  const int indices[3][3] = {{0, 3, 4}, {3, 1, 5}, {4, 5, 2}};
  for (int i = 0; i < 3; i++)
    for (int j = 0; j < 3; j++) to[i][j] = from[indices[i][j]];
}

uint32_t sbri_rigid_external_body_of(const sbri_rigid_tick *t, sbri_rigid_solving *work, uint32_t body,
    int32_t node, const sbri_collider_frame *frame, uint32_t collider) {
  const sbri_collider *leader = sbri_collider_leader(t->colliders, collider);
  if (!leader) return 0;
  uint32_t number = (uint32_t)(leader - t->colliders->at), i = work->external_list.count;
  while (i > 0 &&
         (work->external_list.at[i - 1].node != node || work->external_list.at[i - 1].is.leader != number))
    i--;
  if (i > 0 || work->external_list.count == work->external_list.capacity) return i;
  const sbri_contact_reports *before = &t->touching[body]; /* not yet reported in this tick */
  sbri_external_body_maker maker = {
      t->colliders, t->origin, t->scale, t->tick_s, before->now, before->before_count};
  sbri_rigid_external_body *g = &work->external_list.at[work->external_list.count++];
  *g = (sbri_rigid_external_body){.is = sbri_external_body_make(&maker, frame, number), .node = node};
  float roots[2][6];
  sbri_external_body_compute_roots(&g->is, leader, roots[0], roots[1]);
  for (int k = 0; k < 2; k++) spread(roots[k], g->roots[k]);
  return work->external_list.count;
}

float sbri_rigid_external_body_inverse_mass(const sbri_rigid_external_body *g, sbf_vec3 arm, sbf_vec3 n) {
  return sbri_dot(n, sbri_external_body_response(&g->is, arm, n)) / g->is.lever;
}

void sbri_rigid_external_bodies_begin(sbri_rigid_solving *work, float step_s) {
  for (uint32_t i = 0; i < work->external_list.count; i++)
    sbri_external_body_begin(&work->external_list.at[i].is, step_s);
}

void sbri_rigid_external_bodies_end_step(sbri_rigid_solving *work, float step_s) {
  for (uint32_t i = 0; i < work->external_list.count; i++)
    sbri_external_body_end_step(&work->external_list.at[i].is, step_s);
}

/* ---- System ---- */

/* Velocity change of a point on it per y. */
static void rates_of(const sbri_rigid_external_body *g, sbf_vec3 arm, double rates[3][6]) {
  float root = sqrtf(g->is.lever);
  for (int k = 0; k < 3; k++) {
    sbf_vec3 turn = {g->roots[1][0][k], g->roots[1][1][k], g->roots[1][2][k]},
             direction = sbri_cross(turn, arm);
    for (int i = 0; i < 3; i++) rates[i][k] = (double)(root * g->roots[0][i][k]);
    rates[0][3 + k] = (double)(root * direction.x), rates[1][3 + k] = (double)(root * direction.y);
    rates[2][3 + k] = (double)(root * direction.z);
  }
}

sbf_vec3 sbri_rigid_external_body_velocity_change(const sbri_rigid_external_body *g, sbf_vec3 arm) {
  double rates[3][6];
  rates_of(g, arm, rates);
  return sbri_vec3(
      (float)sbri_dot6(rates[0], g->y), (float)sbri_dot6(rates[1], g->y), (float)sbri_dot6(rates[2], g->y));
}

void sbri_rigid_external_body_apply_impulse(sbri_rigid_external_body *g, sbf_vec3 arm, sbf_vec3 impulse) {
  const double p[3] = {(double)impulse.x, (double)impulse.y, (double)impulse.z};
  double rates[3][6];
  rates_of(g, arm, rates);
  for (int i = 0; i < 3; i++) sbri_add6(g->b, rates[i], p[i]);
}

void sbri_rigid_external_body_couple(
    sbri_rigid_external_body *g, sbf_vec3 arm, sbf_vec3 own_arm, double w[3][3]) {
  const double r[3] = {(double)own_arm.x, (double)own_arm.y, (double)own_arm.z};
  double rates[3][6], pinned[3][6];
  rates_of(g, arm, rates);
  for (int i = 0; i < 3; i++)
    for (int k = 0; k < 6; k++)
      pinned[i][k] = w[i][0] * rates[0][k] + w[i][1] * rates[1][k] + w[i][2] * rates[2][k];
  for (int k = 0; k < 6; k++)
    for (int j = 0; j <= k; j++)
      g->d[k][j] += rates[0][k] * pinned[0][j] + rates[1][k] * pinned[1][j] + rates[2][k] * pinned[2][j];
  for (int i = 0; i < 3; i++) {
    int a = (i + 1) % 3, b = (i + 2) % 3;
    for (int k = 0; k < 6; k++) {
      g->c[i][k] -= pinned[i][k];
      g->c[3 + i][k] -= r[a] * pinned[b][k] - r[b] * pinned[a][k];
    }
  }
}

void sbri_rigid_external_bodies_clear(sbri_rigid_solving *work) {
  for (uint32_t i = 0; i < work->external_list.count; i++) {
    sbri_rigid_external_body *g = &work->external_list.at[i];
    memset(g->d, 0, sizeof g->d), memset(g->c, 0, sizeof g->c), memset(g->b, 0, sizeof g->b);
    for (int k = 0; k < 6; k++) g->d[k][k] = 1;
  }
}

void sbri_rigid_external_bodies_factor(sbri_rigid_solving *work) {
  for (uint32_t i = 0; i < work->external_list.count; i++) {
    sbri_rigid_external_body *g = &work->external_list.at[i];
    sbri_node *node = &work->system.nodes[g->node];
    sbri_sym6_factor(g->d);
    for (int k = 0; k < 6; k++) {
      sbri_sym6_solve_forward(g->d, g->c[k]);
      for (int j = 0; j <= k; j++) node->d[k][j] -= sbri_dot6(g->c[k], g->c[j]);
    }
  }
}

void sbri_rigid_solve(sbri_rigid_solving *work) {
  for (uint32_t i = 0; i < work->external_list.count; i++) {
    sbri_rigid_external_body *g = &work->external_list.at[i];
    sbri_sym6_solve_forward(g->d, g->b);
    for (int k = 0; k < 6; k++) work->system.nodes[g->node].b[k] -= sbri_dot6(g->c[k], g->b);
  }
  sbri_system_solve(&work->system);
  for (uint32_t i = 0; i < work->external_list.count; i++) {
    sbri_rigid_external_body *g = &work->external_list.at[i];
    memcpy(g->y, g->b, sizeof g->y);
    for (int k = 0; k < 6; k++) sbri_add6(g->y, g->c[k], -work->system.nodes[g->node].x[k]);
    sbri_sym6_solve_back(g->d, g->y);
  }
}

/* ---- Iterations ---- */

void sbri_rigid_external_bodies_store_solution(sbri_rigid_solving *work) {
  for (uint32_t i = 0; i < work->external_list.count; i++)
    memcpy(work->external_list.at[i].was, work->external_list.at[i].y, sizeof work->external_list.at[i].was);
}

void sbri_rigid_external_bodies_scale_back(sbri_rigid_solving *work, float fraction) {
  for (uint32_t i = 0; i < work->external_list.count; i++) {
    sbri_rigid_external_body *g = &work->external_list.at[i];
    for (int k = 0; k < 6; k++) g->y[k] = g->was[k] + (double)fraction * (g->y[k] - g->was[k]);
  }
}

void sbri_rigid_external_bodies_compute_slope(const sbri_rigid_solving *work, double *slope, double *rise) {
  for (uint32_t i = 0; i < work->external_list.count; i++) {
    const sbri_rigid_external_body *g = &work->external_list.at[i];
    for (int k = 0; k < 6; k++) {
      double travel = g->y[k] - g->was[k];
      *slope += g->was[k] * travel, *rise += travel * travel;
    }
  }
}

static sbf_vec3 moved_by(float roots[3][3], const double y[3], float fraction) {
  float v[3];
  for (int i = 0; i < 3; i++)
    v[i] = fraction *
           (float)((double)roots[i][0] * y[0] + (double)roots[i][1] * y[1] + (double)roots[i][2] * y[2]);
  return sbri_vec3(v[0], v[1], v[2]);
}

void sbri_rigid_external_bodies_apply_solution(sbri_rigid_solving *work) {
  for (uint32_t i = 0; i < work->external_list.count; i++) {
    sbri_rigid_external_body *g = &work->external_list.at[i];
    float root = sqrtf(g->is.lever);
    sbf_vec3 direction = moved_by(g->roots[0], g->y, 1 / root),
             turn = moved_by(g->roots[1], g->y + 3, 1 / root);
    g->is.velocity = sbri_add(g->is.velocity, direction),
    g->is.angular_velocity = sbri_add(g->is.angular_velocity, turn);
    g->is.seen_velocity = sbri_add_scaled(g->is.seen_velocity, direction, g->is.lever);
    g->is.seen_angular_velocity = sbri_add_scaled(g->is.seen_angular_velocity, turn, g->is.lever);
  }
}

void sbri_rigid_external_bodies_update_seen(sbri_rigid_solving *work) {
  for (uint32_t i = 0; i < work->external_list.count; i++) {
    sbri_external_body *g = &work->external_list.at[i].is;
    g->seen_velocity = g->velocity, g->seen_angular_velocity = g->angular_velocity, g->lever = 1;
  }
}
