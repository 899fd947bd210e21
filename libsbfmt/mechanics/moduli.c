/* Young's modulus of each tetrahedron: the level's, or else the body's with its weight maps. */
#include "mechanics/level_points.h"
#include "sbfmt/mechanics.h"

void sbf_level_moduli(const sbf_soft_body *body, const sbf_level *level, float *factors, float *moduli) {
  const sbf_tetrahedron_mesh *lattice = &level->lattice;
  const sbf_f32_list *stated = &lattice->young_modulus;
  for (uint32_t i = 0; i < level->positions.count && stated->count == 0; i++) factors[i] = 1;
  if (stated->count == 0) sbfi_level_weigh(body, level, SBF_WEIGHT_PROPERTY_YOUNG_MODULUS, factors);
  for (uint32_t t = 0; t < lattice->tetrahedra.count; t++) {
    const uint32_t *at = lattice->tetrahedra.at[t].at;
    if (stated->count > 0)
      moduli[t] = stated->at[stated->count == 1 ? 0 : t];
    else
      moduli[t] = body->attributes.young_modulus * 0.25f *
                  (factors[at[0]] + factors[at[1]] + factors[at[2]] + factors[at[3]]);
  }
}
