/* Simulated bones with attached soft bodies, coupled implicitly, so that steps can be long.
 *
 * In the explicit coupling (coupled.c) a soft body is stepped while its bone continues at its old velocity,
 * and its reaction reaches the bone one step late. That is harmless for slow oscillations. A soft body that
 * oscillates several times within a step becomes unstable with its bone, whatever the bone's mass, so all
 * bodies would need the step size of the fastest.
 *
 * Here a bone that receives an impulse shares it with its soft body within the same step. The soft body's
 * response (prepare/attached_responses.c) says how much of it follows: stiff parts do, soft ones stay behind.
 * The responses' masses are added to the bone's own in the system of the joints: the Schur complement of the
 * coupling for that step. Once all impulses are known the points take their part of the change, in velocity
 * and, over the step, in position. The responses are those of the rest shape; the remainder of linear and
 * angular momentum goes to the bone. The soft body itself still takes as many substeps as it needs. */
#include <string.h>

#include "coupling/ragdoll/ragdoll.h"
#include "math/lane_sums.h"
#include "math/quat.h"
#include "rigid/sym6.h"
#include "soft/solvers/spring_forces.h"

/* Relative tolerance of the step length for which the responses were computed. */
static const float LONGEST = 1.001f;

/* Maximum displacement of a bone relative to its soft body in a step, as a fraction of the body's cells:
 * within it the responses of the rest shape are valid. */
static const float MAX_TRAVEL = 0.1f;

static float longest_step_s(const sbri_character *c) {
  return c->model->asset->environment.control_tick / SBRI_ATTACHED_STEPS;
}

bool sbri_can_attach(const sbri_character *c, uint32_t body) {
  return sbri_rigid_is_simulated(c, body) && c->model->rigid.attached[body].bearable;
}

/* Whether the island is attached to that body only. */
static bool is_attached_to(const sbri_character *c, uint32_t island, uint32_t body) {
  const sbri_island *is = &c->model->islands[island];
  return is->pins.attachment_count == 1 && is->pins.attachments[0] == body;
}

/* Root mean square speed of the island's points relative to the body, m/s. */
static float relative_speed(const sbri_character *c, const sbri_island *island, const sbri_rigid_body *is,
    const sbri_rigid_body_state *body) {
  const sbri_point *at = sbri_positions(c) + island->first_slot;
  const float *velocities = sbri_velocities(c) + 3 * (size_t)island->first_slot;
  sbf_vec3 turn = sbri_angular_velocity_from_momentum(is, body->pose.rotation, body->angular_momentum);
  float sum = 0, kg = 0;
  for (uint32_t slot = 0; slot < island->free_count; slot++) {
    const float *v = velocities + 3 * (slot / SBRI_BLOCK * SBRI_BLOCK) + slot % SBRI_BLOCK;
    sbf_vec3 arm = sbri_sub(sbri_vec3(at[slot].x, at[slot].y, at[slot].z), body->pose.position);
    sbf_vec3 offset = sbri_sub(
        sbri_vec3(v[0], v[SBRI_BLOCK], v[2 * SBRI_BLOCK]), sbri_add(body->velocity, sbri_cross(turn, arm)));
    sum += island->masses[slot] * sbri_dot(offset, offset), kg += island->masses[slot];
  }
  return kg > 0 ? sqrtf(sum / kg) : 0;
}

float sbri_bearing_steps(const sbri_character *c, uint32_t body, float tick_s) {
  float max = tick_s / (LONGEST * longest_step_s(c));
  for (uint32_t i = 0; i < c->model->island_count; i++) {
    const sbri_island *island = &c->model->islands[i];
    if (!is_attached_to(c, i, body) || !(island->stability.cell_m > 0)) continue;
    float speed = relative_speed(c, island, &c->model->rigid.bodies[body], &sbri_rigid_bodies(c)[body]);
    float steps = tick_s * speed / (MAX_TRAVEL * island->stability.cell_m);
    max = steps > max ? steps : max;
  }
  return max;
}

/* ---- Attached mass ---- */

/* Rest axes in space, as columns. */
static void axes_of(sbf_quat rotation, double axes[3][3]) {
  const sbf_vec3 to[3] = {sbri_rotate(rotation, sbri_vec3(1, 0, 0)),
      sbri_rotate(rotation, sbri_vec3(0, 1, 0)), sbri_rotate(rotation, sbri_vec3(0, 0, 1))};
  for (int k = 0; k < 3; k++)
    axes[0][k] = (double)to[k].x, axes[1][k] = (double)to[k].y, axes[2][k] = (double)to[k].z;
}

/* Rotates each of the four blocks: A block A^T. */
static void rotate_mass(const sbri_attached_mass *attached, double axes[3][3], double to[6][6]) {
  const double *from[6];
  for (int i = 0; i < 6; i++) from[i] = attached->mass[i];
  for (int block = 0; block < 4; block++) {
    int row = 3 * (block / 2), column = 3 * (block % 2);
    double half[3][3];
    for (int i = 0; i < 3; i++)
      for (int j = 0; j < 3; j++)
        half[i][j] = (axes[i][0] * from[row][column + j] + axes[i][1] * from[row + 1][column + j]) +
                     axes[i][2] * from[row + 2][column + j];
    for (int i = 0; i < 3; i++)
      for (int j = 0; j < 3; j++)
        to[row + i][column + j] =
            (half[i][0] * axes[j][0] + half[i][1] * axes[j][1]) + half[i][2] * axes[j][2];
  }
}

static sbf_quat rotation_of(const sbri_rigid_body *is, const sbr_transform *pose) {
  return sbri_quat_normalize(sbri_quat_multiply(pose->rotation, sbri_quat_conjugate(is->axes)));
}

void sbri_attached_loads_begin(sbri_character *c, const sbri_rigid_tick *t, float step_s) {
  for (uint32_t b = 0; b < t->model->body_count; b++) {
    sbri_attached_load *attached_load = &sbri_attached_loads(c)[b];
    const sbri_rigid_body_state *body = &t->bodies[b];
    double axes[3][3];
    attached_load->is_attached =
        attached_load->needed_steps * step_s > LONGEST * t->tick_s && step_s <= LONGEST * longest_step_s(c);
    if (!attached_load->is_attached) continue;
    attached_load->begin = body->pose, attached_load->velocity = body->velocity,
    attached_load->angular_momentum = body->angular_momentum;
    axes_of(rotation_of(&t->model->bodies[b], &body->pose), axes);
    rotate_mass(&t->model->attached[b], axes, attached_load->mass);
  }
}

/* Velocity change by an impulse and a moment: of bone and soft body together, and of the bone alone. */
static void apply_impulse(const sbri_rigid_tick *t, uint32_t b, sbf_quat rotation, sbf_vec3 impulse,
    sbf_vec3 moment, sbf_vec3 *velocity, sbf_vec3 *turn) {
  const sbri_rigid_body *is = &t->model->bodies[b];
  sbri_rigid_body_state *body = &t->bodies[b];
  float moments[3][3];
  double mass[6][6], x[6] = {(double)impulse.x, (double)impulse.y, (double)impulse.z, (double)moment.x,
                         (double)moment.y, (double)moment.z};
  memcpy(mass, t->external.attached_loads[b].mass, sizeof mass);
  sbri_rigid_compute_moments(is->inertia, rotation, moments);
  for (int k = 0; k < 3; k++) {
    mass[k][k] += (double)is->mass;
    for (int j = 0; j < 3; j++) mass[3 + k][3 + j] += (double)moments[k][j];
  }
  sbri_sym6_factor(mass);
  sbri_sym6_solve_forward(mass, x);
  sbri_sym6_solve_back(mass, x);
  *velocity = sbri_vec3((float)x[0], (float)x[1], (float)x[2]);
  *turn = sbri_vec3((float)x[3], (float)x[4], (float)x[5]);
  body->velocity = sbri_add(body->velocity, *velocity);
  body->angular_momentum =
      sbri_add(body->angular_momentum, sbri_angular_momentum_from_velocity(is, rotation, *turn));
}

void sbri_attached_load_apply_impulse(const sbri_rigid_tick *t, uint32_t b, const sbri_reaction *changes) {
  sbf_vec3 velocity, turn;
  apply_impulse(t, b, t->bodies[b].pose.rotation, changes->impulse, changes->moment, &velocity, &turn);
}

/* ---- Motion of the attached points ---- */

/* Velocity changes of a body, without gravity. */
typedef struct change {
  sbf_vec3 velocity, angular_velocity; /* of the centre; rad/s */
  sbf_vec3 about;                      /* its centre at the beginning of the step */
  sbf_quat rotation;                   /* since the rest pose */
  float step_s;
} change;

/* Applies the changes to the points. */
static void move_points(const sbri_character *c, const sbri_island *island, const change *changes,
    const sbri_rigid_body *is, sbri_lane_sums *sums) {
  const sbri_attached_responses *answers = island->pins.responses;
  sbf_quat to_body = sbri_quat_conjugate(changes->rotation);
  sbf_vec3 angular_velocity = sbri_rotate(to_body, changes->angular_velocity),
           arm = sbri_sub(answers->about, is->center),
           velocity = sbri_add(sbri_rotate(to_body, changes->velocity), sbri_cross(angular_velocity, arm));
  const float speeds[6] = {
      velocity.x, velocity.y, velocity.z, angular_velocity.x, angular_velocity.y, angular_velocity.z};
  double axes[3][3];
  axes_of(changes->rotation, axes);
  sbri_wide a[3][3], step = sbri_wide_all(changes->step_s);
  for (int i = 0; i < 3; i++)
    for (int j = 0; j < 3; j++) a[i][j] = sbri_wide_all((float)axes[i][j]);
  sbri_point *points = sbri_positions(c) + island->first_slot;
  float *velocities = sbri_velocities(c) + 3 * (size_t)island->first_slot;
  for (uint32_t slot = 0; slot < island->free_count; slot += SBRI_LANES) {
    uint32_t block = slot / SBRI_BLOCK * SBRI_BLOCK, lane = slot % SBRI_BLOCK;
    const float *fractions = answers->fractions + (size_t)SBRI_ANSWER * block + lane;
    sbri_wide u[3];
    for (int i = 0; i < 3; i++) {
      u[i] = sbri_wide_load(fractions + i * SBRI_BLOCK) * sbri_wide_all(speeds[0]);
      for (int k = 1; k < 6; k++)
        u[i] = u[i] + sbri_wide_load(fractions + (3 * k + i) * SBRI_BLOCK) * sbri_wide_all(speeds[k]);
    }
    sbri_wide point_change[3];
    for (int i = 0; i < 3; i++) point_change[i] = a[i][0] * u[0] + a[i][1] * u[1] + a[i][2] * u[2];
    float *at = velocities + (size_t)3 * block + lane;
    sbri_wide3 x = sbri_wide_load_points(points + slot), v = sbri_load3(at);
    sbri_store3(at, (sbri_wide3){v.x + point_change[0], v.y + point_change[1], v.z + point_change[2]});
    sbri_wide_store_points(points + slot, (sbri_wide3){x.x + step * point_change[0],
                                              x.y + step * point_change[1], x.z + step * point_change[2]});
    /* (x + h g) x (v + g) - x x v = (x - h v) x g */
    sbri_wide m = sbri_wide_load(island->masses + slot);
    sbri_wide3 r = {x.x - step * v.x - sbri_wide_all(changes->about.x),
        x.y - step * v.y - sbri_wide_all(changes->about.y),
        x.z - step * v.z - sbri_wide_all(changes->about.z)};
    sbri_lane_sums_add(
        sums, lane, r, (sbri_wide3){m * point_change[0], m * point_change[1], m * point_change[2]});
  }
}

/* Momentum that the system gave to the soft body, minus the momentum that its points took. */
static void find_remainder(const sbri_attached_load *attached_load, const change *changes,
    const sbri_lane_sums *applied, sbf_vec3 *impulse, sbf_vec3 *moment) {
  const double x[6] = {(double)changes->velocity.x, (double)changes->velocity.y, (double)changes->velocity.z,
      (double)changes->angular_velocity.x, (double)changes->angular_velocity.y,
      (double)changes->angular_velocity.z};
  double total[6];
  for (int i = 0; i < 6; i++) total[i] = sbri_dot6(attached_load->mass[i], x);
  *impulse =
      sbri_sub(sbri_vec3((float)total[0], (float)total[1], (float)total[2]), sbri_lanes_force(applied));
  *moment =
      sbri_sub(sbri_vec3((float)total[3], (float)total[4], (float)total[5]), sbri_lanes_moment(applied));
}

static void move_all_points(
    const sbri_character *c, uint32_t b, const change *changes, sbri_lane_sums *applied) {
  for (uint32_t i = 0; i < c->model->island_count; i++)
    if (is_attached_to(c, i, b))
      move_points(c, &c->model->islands[i], changes, &c->model->rigid.bodies[b], applied);
}

/* The remainder of the first distribution is distributed once more; the rest of that goes to the bone. */
void sbri_attached_loads_end(sbri_character *c, const sbri_rigid_tick *t, float step_s, float weight_s) {
  for (uint32_t b = 0; b < t->model->body_count; b++) {
    const sbri_attached_load *attached_load = &sbri_attached_loads(c)[b];
    const sbri_rigid_body *is = &t->model->bodies[b];
    sbri_rigid_body_state *body = &t->bodies[b];
    sbri_lane_sums applied = {{{0}}, {{0}}}, again = applied;
    sbf_vec3 impulse, moment;
    if (!attached_load->is_attached) continue;
    sbf_vec3 fall = sbri_scale(t->gravity, weight_s * is->source->gravity_scale);
    change changes = {.velocity = sbri_sub(sbri_sub(body->velocity, attached_load->velocity), fall),
        .angular_velocity = sbri_angular_velocity_from_momentum(is, attached_load->begin.rotation,
            sbri_sub(body->angular_momentum, attached_load->angular_momentum)),
        .about = attached_load->begin.position,
        .rotation = rotation_of(is, &attached_load->begin),
        .step_s = step_s};
    move_all_points(c, b, &changes, &applied);
    find_remainder(attached_load, &changes, &applied, &impulse, &moment);
    sbf_vec3 displacement = sbri_sub(body->pose.position, changes.about);
    apply_impulse(t, b, attached_load->begin.rotation, impulse,
        sbri_sub(moment, sbri_cross(displacement, impulse)), &changes.velocity, &changes.angular_velocity);
    changes.about = body->pose.position, changes.step_s = 0; /* its motion is already final */
    move_all_points(c, b, &changes, &again);
    find_remainder(attached_load, &changes, &again, &impulse, &moment);
    body->velocity = sbri_add_scaled(body->velocity, impulse, is->inverse_mass);
    body->angular_momentum = sbri_add(body->angular_momentum, moment);
  }
}
