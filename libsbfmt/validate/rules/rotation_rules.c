/* Checks that rotations have unit length, wherever the schema has one: uses its tables, not names. */
#include "model/element_path.h"
#include "validate/rules/pose.h"
#include "validate/validation.h"

static sbf_code code_of(const sbfi_element_path *path) {
  bool in_joint = path->up && path->up->element == sbfi_element_field(&sbfi_asset_element, "joints")->element;
  return in_joint ? SBF_CODE_JOINT_FRAME : SBF_CODE_ROTATION_NOT_UNIT;
}

static void check_rotation(sbfi_validation *v, const sbfi_element_path *location, const sbfi_field *field) {
  sbf_quat q;
  sbfi_path path;
  memcpy(&q, (const char *)location->object + field->offset, sizeof q);
  if (sbfi_is_unit(q)) return;
  sbfi_element_path_print(location, field, path.text, sizeof path.text);
  sbfi_found(v, code_of(location), path.text, -1, "the rotation has the length %.4g",
      sqrt((double)q.x * q.x + (double)q.y * q.y + (double)q.z * q.z + (double)q.w * q.w));
}

static void walk(sbfi_validation *v, const sbfi_element_path *path) {
  for (uint32_t i = 0; i < path->element->field_count; i++) {
    const sbfi_field *field = &path->element->fields[i];
    if (field->type == SBFI_QUAT) check_rotation(v, path, field);
    uint32_t count = field->element ? sbfi_child_count(path->object, field) : 0;
    for (uint32_t k = 0; k < count; k++) {
      sbfi_element_path child = sbfi_element_path_child(path, field, k);
      walk(v, &child);
    }
  }
}

/* Keys of clips are plain numbers in the schema. */
static void check_keys(sbfi_validation *v, const sbf_track *track, const char *path) {
  bool cubic = track->interpolation == SBF_INTERPOLATION_CUBIC; /* each value has tangents around it */
  uint32_t stride = cubic ? 12 : 4, first = cubic ? 4 : 0;
  if (track->property != SBF_TRACK_PROPERTY_ROTATION) return;
  for (uint32_t i = 0; i < track->values.count / stride; i++) {
    const float *at = track->values.at + i * stride + first;
    if (!sbfi_is_unit((sbf_quat){at[0], at[1], at[2], at[3]}))
      sbfi_found(v, SBF_CODE_ROTATION_NOT_UNIT, path, i * stride + first,
          "the rotation of key %u is not of length 1", i);
  }
}

void sbfi_check_rotations(sbfi_validation *v) {
  sbfi_element_path root = sbfi_element_path_root(v->asset);
  walk(v, &root);
  for (uint32_t c = 0; c < v->asset->clips.count; c++)
    for (uint32_t t = 0; t < v->asset->clips.at[c].tracks.count; t++)
      check_keys(v, &v->asset->clips.at[c].tracks.at[t],
          sbfi_path_of("/sbf/clips/clip[%u]/track[%u]/values", c + 1, t + 1).text);
}
