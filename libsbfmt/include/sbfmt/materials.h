/* What bodies are made of, by name: presets of physical attributes, each with where its numbers come from.
 *
 * Numbers are of matter at room temperature (tissue: in the living body), at the small strains and the speeds
 * of everyday motion. Real cloth and tissue differ from piece to piece by a factor of two and more, stiffen
 * when stretched, and are not the same in all directions: a preset is a good beginning, not a measurement.
 * Everything here is constant: thread safe, nothing to free. */
#ifndef SBFMT_MATERIALS_H
#define SBFMT_MATERIALS_H

#include "sbfmt/model.h"

#ifdef __cplusplus
extern "C" {
#endif

/* One preset. */
typedef struct sbf_material_preset {
  const char *name;        /* as "rubber" */
  bool cloth;              /* a layer: the last three of the numbers count, the density follows from them */
  float density;           /* kg/m^3; of cloth its area density over its thickness */
  float young_modulus;     /* Pa, for small strains; of cloth along its layer */
  float poisson_ratio;     /* no more than 0.48: nearer to 0.5 every solver needs many more steps */
  float damping_ratio;     /* at the body's lowest mode */
  float friction;          /* Coulomb coefficient, against like matter or skin */
  float area_density;      /* kg/m^2 */
  float thickness;         /* m */
  float bending_stiffness; /* N*m, as measured: a weave bends more easily than a plate of its modulus would */
  const char *source;      /* where the numbers come from, and which of them are a judgement */
} sbf_material_preset;

/* All presets, in alphabetical order; `*count` receives how many. */
SBF_API const sbf_material_preset *sbf_material_presets(uint32_t *count);

/* The preset of that name; NULL: there is none. */
SBF_API const sbf_material_preset *sbf_material_find(const char *name);

/* Sets what the preset knows in `*attributes` and leaves the rest: mass, stiffness_damping, gravity,
 * pressure, strain bounds, yield and tear. A preset of cloth makes the surface a layer (`area_density`), even
 * where it is closed, and takes volume-keeping pressure off it; any other makes a layer into matter again. */
SBF_API void sbf_material_apply(const sbf_material_preset *preset, sbf_attributes *attributes);

#ifdef __cplusplus
}
#endif
#endif
