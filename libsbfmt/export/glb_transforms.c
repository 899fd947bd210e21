/* Transforms of nodes relative to their parents. */
#include <math.h>

#include "export/glb.h"
#include "motion/quatd.h"

static void unit(sbf_quat q, double to[4]) {
  to[0] = q.x, to[1] = q.y, to[2] = q.z, to[3] = q.w;
  double squares = to[0] * to[0] + to[1] * to[1] + to[2] * to[2] + to[3] * to[3];
  double length = squares > 0 ? sqrt(squares) : 1;
  for (int k = 0; k < 4; k++) to[k] /= length;
  if (!(squares > 0)) to[3] = 1;
}

void sbfi_glb_compute_local(
    sbfi_glb_transform own, const sbfi_glb_transform *parent, float translation[3], float rotation[4]) {
  double orientation[4], up[4] = {0, 0, 0, 1}, at[3] = {own.position.x, own.position.y, own.position.z};
  unit(own.rotation, orientation);
  if (parent) {
    const double from[3] = {parent->position.x, parent->position.y, parent->position.z};
    unit(parent->rotation, up);
    sbfi_quatd_conjugate(up, up);
    for (int k = 0; k < 3; k++) at[k] -= from[k];
    sbfi_quatd_rotate(up, at, at);
    sbfi_quatd_multiply(up, orientation, orientation);
  }
  for (int k = 0; k < 3; k++) translation[k] = (float)at[k];
  for (int k = 0; k < 4; k++) rotation[k] = (float)orientation[k];
}

sbfi_glb_transform sbfi_glb_rest(const sbf_asset *asset, uint32_t bone) {
  return (sbfi_glb_transform){asset->bones.at[bone].head, asset->bones.at[bone].rotation};
}
