/* Effective mass of a joint's motion in the rest pose, for drives that state accelerations. With the rows J
 * of the moving coordinate and of the locked ones, A = J M^-1 J^T and the row r of the moving one: m = 1 /
 * (A_rr - A_rh A_hh^-1 A_hr) (K. Erleben, Stable, Robust, and Versatile Multibody Dynamics Animation, 2004,
 * chapter 7). */
#include <math.h>

#include "import/physics/physics.h"
#include "motion/quatd.h"
#include "sbfmt/mechanics.h"

enum { COORDINATES = 6 };

/* Adds row_i M^-1 row_j of one body for all coordinates. */
static void add_body(
    const sbf_rigid_body *body, const double rows[COORDINATES][6], double to[COORDINATES][COORDINATES]) {
  sbf_rigid_measures is;
  if (body->motion == SBF_BODY_MOTION_KINEMATIC) return;
  sbf_rigid_body_measure(body, &is);
  const double q[4] = {(double)is.inertia_rotation.x, (double)is.inertia_rotation.y,
      (double)is.inertia_rotation.z, (double)is.inertia_rotation.w};
  const double moments[3] = {(double)is.inertia.x, (double)is.inertia.y, (double)is.inertia.z};
  double back[4], turned[COORDINATES][3];
  sbfi_quatd_conjugate(q, back);
  for (int i = 0; i < COORDINATES; i++) sbfi_quatd_rotate(back, &rows[i][3], turned[i]);
  for (int i = 0; i < COORDINATES; i++)
    for (int j = 0; j < COORDINATES; j++)
      for (int k = 0; k < 3; k++) {
        to[i][j] += rows[i][k] * rows[j][k] / is.mass;
        if (moments[k] > 0) to[i][j] += turned[i][k] * turned[j][k] / moments[k];
      }
}

/* Rates of the joint's coordinates by a body's linear and angular velocity. */
static void fill_rows(const double axes[3][3], const double arm[3], double rows[COORDINATES][6]) {
  for (int i = 0; i < 3; i++)
    for (int k = 0; k < 3; k++) {
      int k1 = (k + 1) % 3, k2 = (k + 2) % 3;
      rows[i][k] = axes[i][k];
      rows[i][3 + k] = arm[k1] * axes[i][k2] - arm[k2] * axes[i][k1];
      rows[3 + i][k] = 0;
      rows[3 + i][3 + k] = axes[i][k];
    }
}

double sbfi_physics_effective_mass(
    const sbf_asset *asset, const sbf_joint *joint, unsigned locked, sbf_joint_axis axis) {
  double axes[3][3], rows[COORDINATES][6], a[COORDINATES][COORDINATES] = {{0}};
  const sbf_quat r = joint->frame_b.rotation;
  const double q[4] = {(double)r.x, (double)r.y, (double)r.z, (double)r.w};
  const sbf_rigid_body *body_b = &asset->rigid_bodies.at[joint->body_b];
  for (int i = 0; i < 3; i++) {
    const double unit[3] = {i == 0, i == 1, i == 2};
    sbfi_quatd_rotate(q, unit, axes[i]); /* at rest a body has the axes of asset space */
  }
  for (int side = 0; side < 2; side++) {
    int32_t body = side ? joint->body_b : joint->body_a;
    if (body == SBF_NONE) continue;
    const sbf_rigid_body *of = &asset->rigid_bodies.at[body];
    sbf_rigid_measures is;
    sbf_rigid_body_measure(of, &is);
    const double arm[3] = {(double)(body_b->center.x + joint->frame_b.position.x - is.center.x),
        (double)(body_b->center.y + joint->frame_b.position.y - is.center.y),
        (double)(body_b->center.z + joint->frame_b.position.z - is.center.z)};
    fill_rows((const double(*)[3])axes, arm, rows);
    add_body(of, (const double(*)[6])rows, a);
  }
  /* Eliminates the locked coordinates one after the other. */
  for (unsigned h = 0; h < COORDINATES; h++) {
    if (!(locked >> h & 1) || h == (unsigned)axis || !(a[h][h] > 1e-12)) continue;
    for (int i = 0; i < COORDINATES; i++)
      for (int j = 0; i != (int)h && j < COORDINATES; j++)
        if (j != (int)h) a[i][j] -= a[i][h] * a[h][j] / a[h][h];
    for (int i = 0; i < COORDINATES; i++) a[i][h] = a[h][i] = 0;
  }
  double free = a[axis][axis];
  return free > 1e-12 ? 1 / free : 0;
}
