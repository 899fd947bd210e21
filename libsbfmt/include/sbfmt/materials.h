/* Material presets by name: physical attributes, each with the source of its numbers.
 *
 * The numbers hold for matter at room temperature (tissue: in the living body), at the small strains and
 * speeds of everyday motion. Real cloth and tissue vary from piece to piece by a factor of two and more,
 * stiffen when stretched, and are anisotropic. A preset is a good start, not a measurement. Everything here
 * is constant: thread safe, nothing to free. */
#ifndef SBFMT_MATERIALS_H
#define SBFMT_MATERIALS_H

#include "sbfmt/model.h"

#ifdef __cplusplus
extern "C" {
#endif

/* One preset. */
typedef struct sbf_material_preset {
  const char *name;        /* as "rubber" */
  bool cloth;              /* a layer: uses the last three numbers, and the density follows from them */
  float density;           /* kg/m^3; for cloth, area density over thickness */
  float young_modulus;     /* Pa, for small strains; for cloth, in its plane */
  float poisson_ratio;     /* at most 0.48: closer to 0.5 every solver needs many more steps */
  float damping_ratio;     /* at the body's lowest mode */
  float friction;          /* Coulomb coefficient, against the same material or skin */
  float area_density;      /* kg/m^2 */
  float thickness;         /* m */
  float bending_stiffness; /* N*m, as measured: a weave bends more easily than a plate of the same modulus */
  const char *source;      /* source of the numbers; says which of them are estimates */
} sbf_material_preset;

/* All presets, in alphabetical order; `*count` receives how many. */
SBF_API const sbf_material_preset *sbf_material_presets(uint32_t *count);

/* The preset of that name, or NULL if there is none. */
SBF_API const sbf_material_preset *sbf_material_find(const char *name);

/* Sets the preset's values in `*attributes`. Mass, stiffness_damping, gravity, pressure, strain bounds, yield
 * and tear are not changed. A cloth preset makes even a closed surface a layer (`area_density`) and removes
 * volume-keeping pressure. Any other preset makes a layer a volume again. */
SBF_API void sbf_material_apply(const sbf_material_preset *preset, sbf_attributes *attributes);

#ifdef __cplusplus
}
#endif
#endif
