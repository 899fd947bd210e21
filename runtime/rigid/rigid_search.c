/* Line search between two iterations.
 *
 * With fixed friction bounds, contacts, drives and springs have an energy of the velocity changes which is
 * convex together with the kinetic energy. An iteration is a Newton step towards its minimum, as if no
 * contact changed its state on the way (Todorov, Convex and analytically-invertible dynamics with contacts
 * and constraints, 2014). The search finds where the slope along the step is 0. With it the iterations
 * converge; without it they may cycle. */
#include "rigid/rigid_work.h"
#include "rigid/sym6.h"

/* Enough evaluations to find where friction begins to stick: in a hard impact it changes sign within 0.05
 * mm/s of metres per second. A search that ends earlier makes the iterations oscillate around that point. The
 * last evaluations are bisections: where the slope is steep on one side and flat on the other, the secant
 * method stalls. */
enum { SECANTS = 20, SEARCHES = 60 };
/* Remaining slope at convergence, as a fraction of the initial one. */
static const float LEVEL = 0.01f;
/* The slope at the end above which the step is too long, as a fraction of that at its beginning. */
static const float FAR = 0.3f;
/* Tolerance as a fraction of the kinetic energy that gravity gives all bodies in a step from rest. */
static const double TRIFLE = 1e-5;

static void add_attached(const sbri_rigid_solving *work, const sbri_edge *e, double *slope, double *rise) {
  double was[3] = {0, 0, 0}, now[3] = {0, 0, 0};
  for (int side = 0; side < SBRI_SIDES; side++) {
    if (e->nodes[side] < 0) continue;
    const sbri_node *node = &work->system.nodes[e->nodes[side]];
    double sign = side == SBRI_B ? 1 : -1;
    for (int k = 0; k < 3; k++) was[k] += sign * node->previous[3 + k], now[k] += sign * node->x[3 + k];
  }
  for (int k = 0; k < 3; k++) {
    double travel = now[k] - was[k];
    *slope -= e->ball->attached_inertia * (e->ball->attached_rhs[k] - was[k]) * travel;
    *rise += e->ball->attached_inertia * travel * travel;
  }
}

/* Slope of all terms but the contacts at the beginning of the step, and its derivative. */
static void find_slope(
    const sbri_rigid_tick *t, const sbri_rigid_solving *work, double *slope, double *rise) {
  double a = 0, q = 0;
  for (uint32_t i = 0; i < work->system.node_count; i++) {
    const sbri_node *node = &work->system.nodes[i];
    double mass = (double)(node->mass_factor * t->model->bodies[node->body].mass),
           swell = (double)node->mass_factor, direction[6];
    for (int k = 0; k < 6; k++)
      direction[k] = node->x[k] - node->previous[k], a -= node->known_impulse[k] * direction[k];
    for (int k = 0; k < 3; k++) {
      const float *row = node->inertia[k];
      double linear = mass * direction[k];
      double angular = swell * ((double)row[0] * direction[3] + (double)row[1] * direction[4] +
                                   (double)row[2] * direction[5]);
      a += node->previous[k] * linear + node->previous[3 + k] * angular;
      q += direction[k] * linear + direction[3 + k] * angular;
    }
    for (int k = 0; node->attached_load && k < 6; k++)
      for (int j = 0; j < 6; j++) {
        double mass_of = node->attached_load[k][j];
        a += mass_of * node->previous[k] * direction[j], q += mass_of * direction[k] * direction[j];
      }
  }
  for (uint32_t i = 0; i < work->system.edge_count; i++) {
    const sbri_edge *e = &work->system.edges[i];
    if (e->ball) add_attached(work, e, &a, &q);
    for (uint32_t r = 0; r < e->active_count; r++) {
      const sbri_row *row = &e->rows[e->actives[r]];
      double was = 0, now = 0;
      if (!(row->compliance > 0) || row->kind == SBRI_ROW_LIMIT) continue;
      for (int side = 0; side < SBRI_SIDES; side++) {
        if (e->nodes[side] < 0) continue;
        const sbri_node *node = &work->system.nodes[e->nodes[side]];
        was += sbri_dot6_rates(row->rates[side], node->previous);
        now += sbri_dot6_rates(row->rates[side], node->x);
      }
      a -= (e->rhs[r] - was) * (now - was) / (double)row->compliance;
      q += (now - was) * (now - was) / (double)row->compliance;
    }
  }
  *slope = a, *rise = q;
  sbri_rigid_external_bodies_compute_slope(work, slope, rise);
}

/* Adds limits: a unilateral row along the step. `into` changes from its initial value by -`distance`, and the
 * force is proportional to it. Friction changes from P by -G, up to its bound; the squares of both and the
 * friction_change are stored. */
static void add_limits(sbri_rigid_solving *work) {
  for (uint32_t i = 0; i < work->system.edge_count; i++) {
    const sbri_edge *e = &work->system.edges[i];
    for (uint32_t r = 0; r < e->row_count; r++) {
      const sbri_row *row = &e->rows[r];
      float travel = row->change.last - row->change.previous, sign = (float)row->sign;
      if (row->kind != SBRI_ROW_LIMIT || travel == 0) continue;
      work->pushes[work->push_count++] = (sbri_contact_search){.stiff = 1 / (double)row->compliance,
          .into = (double)(sign * (row->change.target - row->change.previous)),
          .distance = (double)(sign * travel)};
    }
  }
}

/* Slope from contacts and limits at that fraction of the step. */
static double slope_of_contacts(const sbri_rigid_solving *work, double fraction) {
  double sum = 0;
  for (uint32_t i = 0; i < work->push_count; i++) {
    const sbri_contact_search *p = &work->pushes[i];
    double into = p->into - fraction * p->distance;
    if (into > 0) sum += p->stiff * into * p->distance;
    if (!(p->bound > 0)) continue;
    double square = p->start_square - fraction * (2 * p->start_dot_change - fraction * p->change_square);
    double along = p->start_dot_change - fraction * p->change_square;
    if (square > p->bound * p->bound) along *= p->bound / sqrt(square);
    sum += along * p->inverse_mass;
  }
  return sum;
}

static double gravity_energy(const sbri_rigid_tick *t, const sbri_rigid_solving *work, float step_s) {
  double mass = 0, speed = (double)(sbri_length(t->gravity) * step_s);
  for (uint32_t i = 0; i < work->system.node_count; i++)
    mass += (double)t->model->bodies[work->system.nodes[i].body].mass;
  for (uint32_t i = 0; i < work->external_list.count;
       i++) { /* its energy is negligible compared with the bodies' */
    double light = 1 / (double)work->external_list.at[i].is.max_inverse_mass;
    mass = light < mass ? light : mass;
  }
  return mass * speed * speed;
}

float sbri_rigid_search(const sbri_rigid_tick *t, sbri_rigid_solving *work, float step_s) {
  double slope, rise;
  find_slope(t, work, &slope, &rise);
  work->push_count = 0;
  sbri_rigid_contacts_find_changes(work);
  add_limits(work);
  double first = slope - slope_of_contacts(work, 0);
  double last = slope + rise - slope_of_contacts(work, 1), level = -(double)LEVEL * first;
  double min_level = TRIFLE * gravity_energy(t, work, step_s);
  if (level < min_level) level = min_level;
  if (!(first < 0) || last <= level || last <= -(double)FAR * first) return 1;
  float low = 0, high = 1;
  for (int i = 0; i < SEARCHES; i++) {
    float fraction = low + (high - low) * (float)(first / (first - last));
    float min = low + 0.02f * (high - low), max = high - 0.02f * (high - low);
    fraction = i & 1 || i > SECANTS ? 0.5f * (low + high) : sbri_clamp(fraction, min, max);
    double here = slope + (double)fraction * rise - slope_of_contacts(work, (double)fraction);
    if (here >= 0 && here <= level) return fraction;
    if (here < 0)
      low = fraction, first = here;
    else
      high = fraction, last = here;
  }
  return high; /* beyond the discontinuity, so that the next iteration sees it */
}
