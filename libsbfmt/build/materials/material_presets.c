/* Material presets by name, from the table of the specification. */
#include <string.h>

#include "build/materials/material_table.h"

enum { PRESET_COUNT = sizeof presets / sizeof *presets };

const sbf_material_preset *sbf_material_presets(uint32_t *count) {
  *count = PRESET_COUNT;
  return presets;
}

const sbf_material_preset *sbf_material_find(const char *name) {
  for (int i = 0; i < PRESET_COUNT; i++)
    if (strcmp(presets[i].name, name) == 0) return &presets[i];
  return NULL;
}

void sbf_material_apply(const sbf_material_preset *preset, sbf_attributes *attributes) {
  attributes->density = preset->density;
  attributes->young_modulus = preset->young_modulus;
  attributes->poisson_ratio = preset->poisson_ratio;
  attributes->damping_ratio = preset->damping_ratio;
  attributes->friction = preset->friction;
  attributes->area_density = preset->area_density;
  attributes->thickness = preset->thickness;
  attributes->bending_stiffness = preset->bending_stiffness;
  if (preset->cloth && attributes->pressure_mode == SBF_PRESSURE_MODE_VOLUME)
    attributes->pressure_mode = SBF_PRESSURE_MODE_NONE;
}
