/* Checks the environment: plausible gravity, fields with a direction. */
#include <math.h>

#include "validate/validation.h"

static const double MAX_GRAVITY = 50; /* m/s^2, twice Jupiter's */

static double length_of(sbf_vec3 a) {
  return sqrt((double)a.x * a.x + (double)a.y * a.y + (double)a.z * a.z);
}

void sbfi_check_environment(sbfi_validation *v) {
  const sbf_environment *is = &v->asset->environment;
  double gravity = length_of(is->gravity);
  if (gravity > MAX_GRAVITY || is->gravity.y > 0)
    sbfi_found(v, SBF_CODE_GRAVITY_LOOKS_WRONG, "/sbf/environment", -1, "gravity is %.4g m/s^2 and points %s",
        gravity, is->gravity.y > 0 ? "upwards" : "downwards");
  for (uint32_t i = 0; i < is->fields.count; i++) {
    const sbf_force_field *field = &is->fields.at[i];
    bool directed = field->kind == SBF_FIELD_KIND_UNIFORM || field->kind == SBF_FIELD_KIND_VORTEX;
    if (directed && length_of(field->direction) == 0)
      sbfi_found(v, SBF_CODE_FIELD_NO_DIRECTION, sbfi_path_of("/sbf/environment/force_field[%u]", i + 1).text,
          -1, "the %s field '%s' has no direction", sbf_field_kind_name(field->kind),
          sbfi_label(field->name, field->id));
  }
}
