/* Newton iterations over a step's system until the active set is consistent.
 *
 * In each iteration contacts, limits and friction are linearised at the velocity changes of the previous one;
 * in the first iteration at those of the previous step. From the second iteration on a line search follows,
 * also where drives are at their limit or dry friction slips: without it these may cycle with limits.
 * Friction's bounds stay fixed until the rest has converged. Then they are updated from the normal forces,
 * and the iterations continue if that changes the result. */
#include <string.h>

#include "rigid/rigid_work.h"

enum { MAX_PASSES = 40, MAX_BOUNDS = 3 };
/* Tolerance of rigid_coarse: fraction of the kinetic energy of the step's velocity changes. */
static const double LEFT = 1e-3;

void sbri_rigid_factor(const sbri_rigid_tick *t, sbri_rigid_solving *work) {
  for (uint32_t i = 0; i < work->system.node_count; i++) {
    sbri_node *node = &work->system.nodes[i];
    float mass = node->mass_factor * t->model->bodies[node->body].mass;
    memset(node->d, 0, sizeof node->d);
    for (int k = 0; k < 3; k++) {
      node->d[k][k] = mass;
      for (int j = 0; j <= k; j++) node->d[3 + k][3 + j] = node->mass_factor * node->inertia[k][j];
    }
    for (int k = 0; node->attached_load && k < 6; k++)
      for (int j = 0; j <= k; j++) node->d[k][j] += node->attached_load[k][j];
    memcpy(node->b, node->known_impulse, sizeof node->b);
  }
  sbri_rigid_external_bodies_clear(work);
  sbri_rigid_contacts_add(work);
  sbri_rigid_external_bodies_factor(work);
  sbri_system_factor(&work->system);
}

/* Reduces the change since the previous iteration to that fraction. */
static void scale_back(sbri_rigid_solving *work, float fraction) {
  for (uint32_t i = 0; i < work->system.node_count; i++) {
    sbri_node *node = &work->system.nodes[i];
    for (int k = 0; k < 6; k++)
      node->x[k] = node->previous[k] + (double)fraction * (node->x[k] - node->previous[k]);
  }
  for (uint32_t i = 0; i < work->contact_list.count; i++) {
    sbri_rigid_contact *contact = &work->contact_list.at[i];
    contact->iteration.last_change =
        sbri_lerp(contact->iteration.previous_change, contact->iteration.last_change, fraction);
  }
  sbri_rigid_external_bodies_scale_back(work, fraction);
  sbri_joint_rows_scale_back(work, fraction);
}

/* Twice the kinetic energy of the velocity changes, J. */
static double energy_of(const sbri_rigid_tick *t, const sbri_rigid_system *s) {
  double sum = 0;
  for (uint32_t i = 0; i < s->node_count; i++) {
    const sbri_node *node = &s->nodes[i];
    const double *x = node->x, mass = (double)t->model->bodies[node->body].mass;
    sum += mass * (x[0] * x[0] + x[1] * x[1] + x[2] * x[2]);
    for (int k = 0; k < 3; k++) {
      const float *row = node->inertia[k];
      sum += x[3 + k] * ((double)row[0] * x[3] + (double)row[1] * x[4] + (double)row[2] * x[5]);
    }
  }
  return sum;
}

/* Whether contact impulses agree with their linearisation, or nearly if that suffices. */
static bool contacts_agree(const sbri_rigid_tick *t, const sbri_rigid_solving *work) {
  double difference = (double)sbri_rigid_contacts_error(work);
  return difference == 0 || (t->coarse && difference < LEFT * energy_of(t, &work->system));
}

void sbri_rigid_iterate(const sbri_rigid_tick *t, sbri_rigid_solving *work, float step_s) {
  sbri_rigid_system *s = &work->system;
  int bounds = t->coarse ? 0 : MAX_BOUNDS;
  for (int pass = 0; pass < MAX_PASSES; pass++) {
    for (uint32_t i = 0; i < s->node_count; i++)
      memcpy(s->nodes[i].previous, s->nodes[i].x, sizeof s->nodes[i].x);
    sbri_rigid_external_bodies_store_solution(work);
    for (uint32_t e = 0; e < s->edge_count; e++) sbri_joint_rows_set_targets(&s->edges[e]);
    sbri_rigid_factor(t, work);
    sbri_rigid_solve(work);
    sbri_rigid_contacts_update_velocities(work);
    sbri_joint_rows_move(work, t->model, step_s);
    bool agree = contacts_agree(t, work), all = agree && sbri_joint_rows_agree(work);
    if (work->external_list.count && pass + 1 == MAX_PASSES && !all) {
      sbri_rigid_contacts_store_solution(work); /* external bodies must get the impulses that the hulls get */
      return;
    }
    float fraction = pass > 0 && !all ? sbri_rigid_search(t, work, step_s) : 1;
    if (fraction < 1) scale_back(work, fraction);
    bool changed = !agree || fraction < 1;
    if (changed) sbri_rigid_contacts_check(work);
    for (uint32_t e = 0; e < s->edge_count; e++)
      changed = sbri_joint_rows_check(t, work, &s->edges[e], step_s) || changed;
    if (changed) continue;
    if (!bounds-- || !sbri_rigid_contacts_bound(work)) return;
  }
}
