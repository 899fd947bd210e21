/* Reads numbers, flags and indices of the extensions' JSON, with the checks that their schemas ask for. */
#include <math.h>

#include "base/number.h"
#include "import/physics/physics.h"

bool sbfi_physics_fault(const sbfi_physics *p, const char *format, ...) {
  va_list arguments;
  va_start(arguments, format);
  sbfi_diagnose_v(p->file.error, SBF_CODE_IMPORT_PHYSICS, format, arguments);
  va_end(arguments);
  return false;
}

static bool number_of(const sbfi_json *value, float *to) {
  return value && value->type == SBFI_JSON_NUMBER &&
         sbfi_parse_f32(value->text.at, value->text.length, to) == SBFI_NUMBER_READ && isfinite(*to);
}

bool sbfi_physics_number(
    const sbfi_physics *p, const sbfi_json *object, const char *name, float fallback, float *value) {
  const sbfi_json *member = sbfi_json_get(object, name);
  *value = fallback;
  return !member || number_of(member, value) ||
         sbfi_physics_fault(p, "`%s` at byte %zu of the JSON is no finite number", name, member->offset);
}

bool sbfi_physics_number_from(const sbfi_physics *p, const sbfi_json *object, const char *name,
    float fallback, float min, bool above, float *value) {
  if (!sbfi_physics_number(p, object, name, fallback, value)) return false;
  if (*value > min || (*value == min && !above)) return true;
  return sbfi_physics_fault(p, "`%s` at byte %zu of the JSON is %g and must be %s %g", name,
      sbfi_json_get(object, name) ? sbfi_json_get(object, name)->offset : 0, (double)*value,
      above ? "above" : "at least", (double)min);
}

bool sbfi_physics_numbers(
    const sbfi_physics *p, const sbfi_json *object, const char *name, uint32_t count, float *values) {
  const sbfi_json *member = sbfi_json_get(object, name);
  if (!member) return true;
  bool good = member->type == SBFI_JSON_ARRAY && member->count == count;
  for (uint32_t i = 0; good && i < count; i++) good = number_of(sbfi_json_at(member, i), &values[i]);
  return good || sbfi_physics_fault(p, "`%s` at byte %zu of the JSON is no list of %u finite numbers", name,
                     member->offset, count);
}

bool sbfi_physics_flag(const sbfi_physics *p, const sbfi_json *object, const char *name, bool *value) {
  const sbfi_json *member = sbfi_json_get(object, name);
  *value = member && member->type == SBFI_JSON_TRUE;
  return !member || *value || member->type == SBFI_JSON_FALSE ||
         sbfi_physics_fault(
             p, "`%s` at byte %zu of the JSON is neither true nor false", name, member->offset);
}

bool sbfi_physics_index(
    const sbfi_physics *p, const sbfi_json *object, const char *name, uint32_t count, int32_t *index) {
  const sbfi_json *member = sbfi_json_get(object, name);
  uint32_t value;
  *index = SBF_NONE;
  if (!member) return true;
  if (!sbfi_json_u32(member, &value) || value >= count)
    return sbfi_physics_fault(p,
        "`%s` at byte %zu of the JSON must be an index below %u, the number of items that the file has", name,
        member->offset, count);
  *index = (int32_t)value;
  return true;
}
