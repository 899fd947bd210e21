/* Response of a soft body to a velocity change of the rigid body that it is attached to: the change of its
 * points' velocities at the end of the step, for the implicit coupling (coupling/ragdoll/attached_bodies.c).
 *
 * If its frame's velocity changes by u, a mode of angular frequency w has followed by the fraction 1 - cos(w
 * h) of u after a step h: little for a slow mode, an arbitrary amount for one that has oscillated several
 * times. The response uses a fraction that is stable for every w: close to the exact one for small w h, and 1
 * for w h above 1.8, where a reaction one step late would be unstable: v = X u - p(h^2 M^-1 K) X u, where X u
 * is the rigid motion of the free points. p is the polynomial of lowest degree that is 1 at 0 and at most a
 * thousandth between 1.8^2 and the square of the fastest mode: Chebyshev's, by its recurrence (Zhou and Saad,
 * A Chebyshev-Davidson algorithm for large symmetric eigenproblems, 2007). The reaction on the rigid body is
 * X^T M v. That matrix is symmetric: mass and moments of inertia that the rigid body has in the step in
 * addition to its own.
 *
 * This conserves momentum but not energy: fast modes gain some in each exchange (an undamped soft body eight
 * times as heavy as its bone gains twelve times the energy of an impact in nine seconds). So it is used only
 * for bodies whose own damping removes more than that. */
#include <string.h>

#include "mechanics/network.h"
#include "prepare/island_maker.h"
#include "soft/solvers/scheme.h"

/* Squared w h from which on a mode follows completely, and the tolerance of that. */
static const double ALONG = 3.2, BEHIND = 1e-3;
/* The estimate of the fastest mode is a lower bound. */
static const double FASTEST_MARGIN = 1.1;
enum { MAX_DEGREE = 64 };
/* Maximum ratio of a soft body's mass to its bone's: the bone takes the errors of rounding and strain. */
static const float MAX_ATTACHED_TRAVEL = 10;
/* Minimum damping ratio of the soft body's slowest stretching mode. */
static const float MIN_DAMPING = 0.03f;

/* The only rigid body to which pinned points and springs of the island belong; -1: several, or none. */
static int32_t single_rigid_body(const sbri_island_maker *m) {
  const sbri_island *island = m->island;
  const int32_t *attachments = m->model->rigid_body_of_frame;
  int32_t found = -1;
  for (uint32_t b = 0; b < island->body_count; b++) {
    const sbri_body *body = sbri_maker_body(m, b);
    for (uint32_t i = 0; i < body->level->positions.count; i++) {
      uint32_t slot = body->slots.from_point[i];
      if (slot < island->free_count) continue;
      int32_t attachment = attachments[island->pins.frames[slot - island->free_count]];
      if (attachment < 0 || (found >= 0 && attachment != found)) return -1;
      found = attachment;
    }
  }
  for (uint32_t i = 0; i < m->goals.count; i++) {
    int32_t attachment = attachments[((const sbri_goal *)m->goals.at)[i].frame];
    if (attachment < 0 || (found >= 0 && attachment != found)) return -1;
    found = attachment;
  }
  return found;
}

/* Whether all points of the island's bodies have enough damping. */
static bool is_damped(const sbri_island_maker *m) {
  for (uint32_t b = 0; b < m->island->body_count; b++) {
    const sbri_body *body = sbri_maker_body(m, b);
    float w = body->damping.stretching_rad_s, min = body->damping.alpha_1_s;
    for (uint32_t slot = body->slots.begin; body->damping.alphas && slot < body->slots.real_end; slot++)
      min = body->damping.alphas[slot] < min ? body->damping.alphas[slot] : min;
    float springs = body->source->attributes.stiffness_damping * w * w;
    if (!(min + springs >= 2 * MIN_DAMPING * w)) return false;
  }
  return true;
}

/* Rigid motion for one of the six velocities. */
static sbfi_d3 rigid_motion(sbf_vec3 arm, int index) {
  double x = (double)arm.x, y = (double)arm.y, z = (double)arm.z;
  const sbfi_d3 all[6] = {{1, 0, 0}, {0, 1, 0}, {0, 0, 1}, {0, -z, y}, {z, 0, -x}, {-y, x, 0}};
  return all[index];
}

static sbf_vec3 middle_of(const sbri_island *island) {
  double x = 0, y = 0, z = 0, kg = 0;
  for (uint32_t slot = 0; slot < island->free_count; slot++) {
    double m = (double)island->masses[slot];
    x += m * (double)island->rest[slot].x, y += m * (double)island->rest[slot].y;
    z += m * (double)island->rest[slot].z, kg += m;
  }
  return kg > 0 ? (sbf_vec3){(float)(x / kg), (float)(y / kg), (float)(z / kg)} : (sbf_vec3){0, 0, 0};
}

static sbf_vec3 arm_of(const sbri_island *island, uint32_t slot, sbf_vec3 about) {
  const sbri_point *at = &island->rest[slot];
  return (sbf_vec3){at->x - about.x, at->y - about.y, at->z - about.z};
}

/* For one velocity: the fractions of the points, and a column of the mass matrix. */
static void fill(const sbri_island *island, sbri_attached_responses *answers, float *fractions,
    const double *lags, int column) {
  for (uint32_t slot = 0; slot < island->free_count; slot++) {
    sbf_vec3 arm = arm_of(island, slot, answers->about);
    sbfi_d3 rigid = rigid_motion(arm, column);
    double m = (double)island->masses[slot];
    if (!(m > 0)) continue;
    const double v[3] = {
        rigid.x - lags[3 * slot], rigid.y - lags[3 * slot + 1], rigid.z - lags[3 * slot + 2]};
    float *to = fractions + SBRI_ANSWER * (slot / SBRI_BLOCK * SBRI_BLOCK) + slot % SBRI_BLOCK;
    for (int i = 0; i < 3; i++) to[(size_t)(3 * column + i) * SBRI_BLOCK] = (float)v[i];
    for (int row = 0; row < 6; row++) {
      sbfi_d3 x = rigid_motion(arm, row);
      answers->mass[row][column] += m * (x.x * v[0] + x.y * v[1] + x.z * v[2]);
    }
  }
}

static void symmetrise(double mass[6][6]) {
  for (int i = 0; i < 6; i++)
    for (int j = 0; j < i; j++) mass[i][j] = mass[j][i] = 0.5 * (mass[i][j] + mass[j][i]);
}

/* y = (middle - h^2 M^-1 K) x for free points, 0 for pinned ones. */
static void apply(
    const sbf_spring_network *network, double middle, double square_s, const double *x, double *y) {
  sbfi_network_apply(network, NULL, x, y);
  for (uint32_t i = 0; i < network->point_count; i++) {
    double m = (double)network->masses[i];
    for (int k = 0; k < 3; k++)
      y[3 * (size_t)i + k] = m > 0 ? middle * x[3 * (size_t)i + k] - square_s / m * y[3 * (size_t)i + k] : 0;
  }
}

/* Filters the motion in `now` in place, so that the part remains that does not follow; `work` has twice its
 * size. */
static void filter(
    const sbf_spring_network *network, double square_s, double fastest, double *now, double *work) {
  size_t size = 3 * (size_t)network->point_count;
  double high = fastest > 1.5 * ALONG ? fastest : 1.5 * ALONG, middle = 0.5 * (high + ALONG),
         half = 0.5 * (high - ALONG), first = half / middle, ratio = first, min = 1, before = middle / half;
  double *was = work, *next = work + size;
  int degree = 1;
  for (double value = before; degree < MAX_DEGREE && 1 / value > BEHIND;
       degree++) { /* T of this degree at 0 */
    double then = 2 * middle / half * value - min;
    min = value, value = then;
  }
  memcpy(was, now, size * sizeof *was);
  apply(network, middle, square_s, was, now);
  for (size_t i = 0; i < size; i++) now[i] /= middle;
  for (int d = 1; d < degree; d++) {
    double then = 1 / (2 / first - ratio);
    apply(network, middle, square_s, now, next);
    for (size_t i = 0; i < size; i++) {
      double value = 2 * then / half * next[i] - ratio * then * was[i];
      was[i] = now[i], now[i] = value;
    }
    ratio = then;
  }
}

bool sbri_attached_responses_make(sbri_island_maker *m, const sbf_spring_network *found) {
  sbri_island *island = m->island;
  uint32_t points = island->slot_count;
  island->stepping.lightly_damped = !is_damped(m);
  if (island->scheme != &sbri_symplectic || island->regions.block_count || single_rigid_body(m) < 0 ||
      island->stepping.lightly_damped)
    return true;
  sbf_spring_network network = *found;
  size_t size = 3 * (size_t)points;
  float *masses = sbri_scratch(m, points, sizeof *masses);
  double *lags = sbri_scratch(m, 3 * size, sizeof *lags);
  sbri_attached_responses *answers = sbri_model_allocate(m, 1, sizeof *answers);
  float *fractions = sbri_model_allocate(m, (size_t)SBRI_ANSWER * island->free_count, sizeof *fractions);
  if (!masses || !lags || !answers || !fractions) return false;
  double h = (double)m->model->asset->environment.control_tick / SBRI_ATTACHED_STEPS,
         fastest = FASTEST_MARGIN * h * h * island->stability.fastest_rad_s * island->stability.fastest_rad_s;
  if (island->free_count) memcpy(masses, island->masses, island->free_count * sizeof *masses);
  network.masses = masses;
  answers->about = middle_of(island), answers->fractions = fractions;
  for (int column = 0; column < 6; column++) {
    memset(lags, 0, size * sizeof *lags);
    for (uint32_t slot = 0; slot < island->free_count; slot++) {
      sbfi_d3 x = rigid_motion(arm_of(island, slot, answers->about), column);
      if (masses[slot] > 0) lags[3 * slot] = x.x, lags[3 * slot + 1] = x.y, lags[3 * slot + 2] = x.z;
    }
    filter(&network, h * h, fastest, lags, lags + size);
    fill(island, answers, fractions, lags, column);
  }
  symmetrise(answers->mass);
  island->pins.responses = answers;
  return true;
}

/* ---- On bodies ---- */

/* Adds a mass matrix about the response's `about`, expressed at `from`: the velocity there is u + w x (about
 * - from). */
static void add_mass(const sbri_attached_responses *answers, sbf_vec3 from, double to[6][6]) {
  double x = (double)(answers->about.x - from.x), y = (double)(answers->about.y - from.y),
         z = (double)(answers->about.z - from.z);
  const double move[6][6] = {{1, 0, 0, 0, z, -y}, {0, 1, 0, -z, 0, x}, {0, 0, 1, y, -x, 0},
      {0, 0, 0, 1, 0, 0}, {0, 0, 0, 0, 1, 0}, {0, 0, 0, 0, 0, 1}};
  double half[6][6] = {{0}};
  for (int i = 0; i < 6; i++)
    for (int j = 0; j < 6; j++)
      for (int k = 0; k < 6; k++) half[i][j] += answers->mass[i][k] * move[k][j];
  for (int i = 0; i < 6; i++)
    for (int j = 0; j < 6; j++)
      for (int k = 0; k < 6; k++) to[i][j] += move[k][i] * half[k][j];
}

static bool is_attached_to(const sbri_island *island, uint32_t attachment) {
  for (uint32_t i = 0; i < island->pins.attachment_count; i++)
    if (island->pins.attachments[i] == attachment) return true;
  return false;
}

void sbri_attached_mass_join(sbr_model *model) {
  for (uint32_t c = 0; c < model->rigid.body_count; c++) {
    sbri_attached_mass *attached = &model->rigid.attached[c];
    bool any = false, all = true;
    for (uint32_t i = 0; i < model->island_count; i++) {
      const sbri_island *island = &model->islands[i];
      if (!is_attached_to(island, c)) continue;
      any = true;
      all = all && island->pins.responses && island->scheme == &sbri_symplectic && !island->splits &&
            !(island->stability.external_rad_s > 0);
      if (all) add_mass(island->pins.responses, model->rigid.bodies[c].center, attached->mass);
    }
    attached->bearable =
        any && all && model->rigid.attached_masses[c] <= MAX_ATTACHED_TRAVEL * model->rigid.bodies[c].mass;
  }
}
