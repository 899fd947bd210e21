/* One tetrahedron of a body: for mechanics/, and as a lane of a block. */
#include "mechanics/neo_hookean.h"
#include "model/runtime_model.h"

bool sbri_body_tetrahedron(const sbri_body *body, uint32_t tetrahedron, sbfi_tetrahedron *made) {
  sbfi_d3 rest[4];
  const uint32_t *points = body->level->lattice.tetrahedra.at[tetrahedron].at;
  for (int k = 0; k < 4; k++) rest[k] = sbfi_d3_of(body->level->positions.at[points[k]]);
  return sbfi_tetrahedron_make(made, rest,
      sbfi_lame_of(body->elements.moduli[tetrahedron], body->elements.poisson_ratios[tetrahedron]));
}

void sbri_tetrahedron_fill(sbri_tetrahedron_block *block, uint32_t lane, const sbfi_tetrahedron *t) {
  const sbfi_d3 *g = t->gradients;
  double s = t->volume * t->lame.mu;
  static const int pairs[6][2] = {{1, 1}, {2, 2}, {3, 3}, {1, 2}, {2, 3}, {3, 1}};
  for (int i = 0; i < 6; i++)
    block->stiffness[i][lane] = (float)(s * sbfi_d3_dot(g[pairs[i][0]], g[pairs[i][1]]));
  block->inverse_volume[lane] = (float)(1 / (6 * t->volume));
  block->bulk[lane] = (float)(t->lame.lambda / 6);
  block->shear[lane] = (float)(t->lame.mu / 6);
}
