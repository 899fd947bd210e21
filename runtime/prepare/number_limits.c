/* Refuses assets with numbers so large that products in the simulation become infinite. The format allows
 * every finite number. */
#include <string.h>

#include "base/diagnostic.h"
#include "math/usable.h"
#include "model/element_path.h"
#include "prepare/prepare.h"

/* m; inertia has the fifth power of lengths */
static const double MAX_LENGTH_M = 1e6;

/* Lists of points without a unit are lengths too. */
static bool is_length(const sbfi_field *field) {
  return strcmp(field->unit, "m") == 0 || (field->type == SBFI_LIST && field->width == 3);
}

static sbf_status check_numbers(const sbfi_element_path *path, const sbfi_field *field, const float *numbers,
    size_t count, sbf_diagnostic *error) {
  double max = is_length(field) ? MAX_LENGTH_M : SBRI_MAX_NUMBER;
  for (size_t i = 0; i < count; i++) {
    if ((double)numbers[i] <= max && (double)numbers[i] >= -max) continue;
    sbf_status status = sbfi_diagnose(error, SBF_CODE_VALUE_OUT_OF_RANGE,
        "%g in `%s`: the runtime simulates numbers of up to %g %s", (double)numbers[i], field->name, max,
        max == MAX_LENGTH_M ? "m: state lengths in metres" : field->unit);
    if (error) sbfi_element_path_print(path, field, error->path, sizeof error->path);
    return status;
  }
  return SBF_OK;
}

static sbf_status check_element(const sbfi_element_path *path, sbf_diagnostic *error) {
  sbf_status status = SBF_OK;
  for (uint32_t i = 0; i < path->element->field_count && status == SBF_OK; i++) {
    const sbfi_field *field = &path->element->fields[i];
    const char *at = (const char *)path->object + field->offset;
    if (field->type >= SBFI_FLOAT && field->type <= SBFI_QUAT)
      status = check_numbers(path, field, (const float *)(const void *)at, field->width, error);
    if (field->type == SBFI_LIST && field->item == SBFI_ITEM_F32) {
      sbfi_list list = sbfi_get_list(path->object, field);
      status = check_numbers(path, field, list.at, list.at ? (size_t)list.count * field->width : 0, error);
    }
    uint32_t children = sbfi_child_count(path->object, field);
    for (uint32_t k = 0; k < children && status == SBF_OK; k++) {
      sbfi_element_path child = sbfi_element_path_child(path, field, k);
      status = check_element(&child, error);
    }
  }
  return status;
}

sbf_status sbri_number_limits_check(const sbf_asset *asset, sbf_diagnostic *error) {
  sbfi_element_path root = sbfi_element_path_root(asset);
  return check_element(&root, error);
}
