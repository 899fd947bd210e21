/* Offset of a point before its joint blend so that it ends at a target: with M the blend of the bones'
 * motions from rest, M (rest + offset) = target. If M is singular (two bones rotated by 180 degrees
 * against each other) there is no exact offset, and the best of bounded length is used. */
#include <math.h>
#include <string.h>

#include "export/glb.h"
#include "motion/quatd.h"

typedef sbfi_glb_affine affine;

/* Motion of a bone from rest in a frame. */
static affine motion_of(const sbfi_glb *g, uint32_t frame, uint32_t bone) {
  const sbf_bone *rest = &g->e->asset->bones.at[bone];
  size_t at = (size_t)frame * g->e->asset->bones.count + bone;
  sbf_quat now = g->e->motion->bone_rotations[at];
  sbf_vec3 position = g->e->motion->bone_positions[at];
  double a[4] = {now.x, now.y, now.z, now.w};
  double b[4] = {rest->rotation.x, rest->rotation.y, rest->rotation.z, rest->rotation.w};
  affine to;
  sbfi_quatd_conjugate(b, b);
  sbfi_quatd_multiply(a, b, a);
  for (int column = 0; column < 3; column++) {
    double axis[3] = {column == 0, column == 1, column == 2};
    sbfi_quatd_rotate(a, axis, axis);
    for (int row = 0; row < 3; row++) to.m[row][column] = axis[row];
  }
  const double head[3] = {rest->head.x, rest->head.y, rest->head.z};
  double moved[3];
  sbfi_quatd_rotate(a, head, moved);
  to.t[0] = (double)position.x - moved[0];
  to.t[1] = (double)position.y - moved[1];
  to.t[2] = (double)position.z - moved[2];
  return to;
}

static void add_scaled(affine *to, const affine *from, double weight) {
  for (int row = 0; row < 3; row++) {
    for (int column = 0; column < 3; column++) to->m[row][column] += weight * from->m[row][column];
    to->t[row] += weight * from->t[row];
  }
}

static void identity_scaled(affine *to, double weight) {
  const affine still = {{{1, 0, 0}, {0, 1, 0}, {0, 0, 1}}, {0, 0, 0}};
  add_scaled(to, &still, weight);
}

/* Cramer's rule; false if the determinant is below `min`. */
static bool solve(const affine *of, const double r[3], double min, double x[3]) {
  double c[3];
  for (int k = 0; k < 3; k++) {
    int i = (k + 1) % 3, j = (k + 2) % 3;
    c[k] = of->m[1][i] * of->m[2][j] - of->m[1][j] * of->m[2][i];
  }
  double determinant = of->m[0][0] * c[0] + of->m[0][1] * c[1] + of->m[0][2] * c[2];
  if (!(fabs(determinant) >= min)) return false;
  for (int k = 0; k < 3; k++) {
    double b[3][3];
    memcpy(b, of->m, sizeof b);
    for (int row = 0; row < 3; row++) b[row][k] = r[row];
    x[k] = (b[0][0] * (b[1][1] * b[2][2] - b[1][2] * b[2][1]) -
               b[0][1] * (b[1][0] * b[2][2] - b[1][2] * b[2][0]) +
               b[0][2] * (b[1][0] * b[2][1] - b[1][1] * b[2][0])) /
           determinant;
  }
  return true;
}

/* Minimizes |M x - r|^2 + damping |x|^2. */
static void solve_damped(const affine *of, const double r[3], double damping, double x[3]) {
  const double(*m)[3] = of->m;
  affine a;
  double right[3];
  for (int i = 0; i < 3; i++) {
    right[i] = m[0][i] * r[0] + m[1][i] * r[1] + m[2][i] * r[2];
    for (int j = 0; j < 3; j++)
      a.m[i][j] = m[0][i] * m[0][j] + m[1][i] * m[1][j] + m[2][i] * m[2][j] + (i == j ? damping : 0);
  }
  solve(&a, right, 0, x);
}

static sbf_vec3 offset_to(sbfi_glb *g, const affine *blend, sbf_vec3 rest, sbf_vec3 wanted) {
  const double MIN_DETERMINANT = 0.05, DAMPING = 0.01;
  const double from[3] = {rest.x, rest.y, rest.z}, to[3] = {wanted.x, wanted.y, wanted.z};
  double r[3], x[3];
  for (int k = 0; k < 3; k++)
    r[k] =
        to[k] - blend->t[k] - blend->m[k][0] * from[0] - blend->m[k][1] * from[1] - blend->m[k][2] * from[2];
  if (!solve(blend, r, MIN_DETERMINANT, x)) {
    double squares = 0;
    solve_damped(blend, r, DAMPING, x);
    for (int k = 0; k < 3; k++) {
      double off = blend->m[k][0] * x[0] + blend->m[k][1] * x[1] + blend->m[k][2] * x[2] - r[k];
      squares += off * off;
    }
    if (squares > g->worst_m * g->worst_m) g->worst_m = sqrt(squares);
  }
  return (sbf_vec3){(float)x[0], (float)x[1], (float)x[2]};
}

/* Blend of one point, whose influences begin at `from`. */
static affine blend_of(const sbf_skin *skin, uint32_t from, uint32_t count, const affine *motions) {
  affine blend = {.t = {0, 0, 0}};
  double sum = 0;
  for (uint32_t i = from; i < from + count; i++) sum += (double)skin->weights.at[i];
  for (uint32_t i = from; i < from + count && sum > 0; i++)
    add_scaled(&blend, &motions[skin->bones.at[i]], (double)skin->weights.at[i] / sum);
  if (!(sum > 0)) identity_scaled(&blend, 1);
  return blend;
}

void sbfi_glb_compute_offsets(sbfi_glb *g, const sbfi_glb_mesh *mesh, uint32_t frame, sbf_vec3 *offsets) {
  const sbf_asset *asset = g->e->asset;
  const sbf_export_motion *motion = g->e->motion;
  const sbf_vec3 *wanted = motion->skin + (size_t)frame * g->frame_points + mesh->first_point;
  const sbf_vec3_list rest = mesh->full->mesh.positions;
  for (uint32_t b = 0; mesh->skin && b < asset->bones.count; b++) g->bone_motions[b] = motion_of(g, frame, b);
  affine whole = {.t = {0, 0, 0}};
  if (mesh->bone >= 0)
    whole = motion_of(g, frame, (uint32_t)mesh->bone);
  else
    identity_scaled(&whole, 1);
  for (uint32_t p = 0, at = 0, shown = 0; p < rest.count; p++) {
    uint32_t count = mesh->skin ? mesh->skin->influence_counts.at[p] : 0, begins = at;
    at += count;
    if (mesh->full_of_shown) {
      if (shown == mesh->shown->mesh.positions.count) break;
      if (mesh->full_of_shown[shown] != p) continue;
    }
    affine blend = mesh->skin ? blend_of(mesh->skin, begins, count, g->bone_motions) : whole;
    offsets[shown++] = offset_to(g, &blend, rest.at[p], wanted[p]);
  }
}
