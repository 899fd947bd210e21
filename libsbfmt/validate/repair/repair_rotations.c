/* Normalizes rotations and normals. A quaternion of length 0 means no rotation, as in the specification,
 * and becomes the identity. */
#include "model/element_path.h"
#include "validate/repair/repair.h"
#include "validate/rules/pose.h"

static void normalise(sbf_quat *q) {
  sbfi_rotation unit = sbfi_rotation_of(*q);
  *q = (sbf_quat){(float)unit.v.x, (float)unit.v.y, (float)unit.v.z, (float)unit.w};
}

static void repair_field(sbfi_repair *m, const sbfi_element_path *location, const sbfi_field *field) {
  char *at = (char *)sbfi_writable(location->object) + field->offset;
  sbf_quat q;
  memcpy(&q, at, sizeof q);
  if (sbfi_is_unit(q)) return;
  normalise(&q);
  memcpy(at, &q, sizeof q);
  bool in_joint =
      location->up && location->up->element == sbfi_element_field(&sbfi_asset_element, "joints")->element;
  sbfi_path path;
  sbfi_element_path_print(location, field, path.text, sizeof path.text);
  sbfi_count_repair(m, in_joint ? SBF_CODE_JOINT_FRAME : SBF_CODE_ROTATION_NOT_UNIT, 1, path.text, -1,
      "rotation normalised");
}

static void walk(sbfi_repair *m, const sbfi_element_path *path) {
  for (uint32_t i = 0; i < path->element->field_count; i++) {
    const sbfi_field *field = &path->element->fields[i];
    if (field->type == SBFI_QUAT) repair_field(m, path, field);
    uint32_t count = field->element ? sbfi_child_count(path->object, field) : 0;
    for (uint32_t k = 0; k < count; k++) {
      sbfi_element_path child = sbfi_element_path_child(path, field, k);
      walk(m, &child);
    }
  }
}

static void repair_keys(sbfi_repair *m, const sbf_track *track, uint32_t clip, uint32_t number) {
  bool cubic = track->interpolation == SBF_INTERPOLATION_CUBIC; /* each value has tangents around it */
  uint32_t stride = cubic ? 12 : 4, first = cubic ? 4 : 0, count = 0, at = 0;
  if (track->property != SBF_TRACK_PROPERTY_ROTATION ||
      track->values.count != (size_t)track->times.count * stride)
    return;
  for (uint32_t i = 0; i < track->times.count; i++) {
    sbf_quat q;
    float *key = (float *)sbfi_writable(track->values.at) + i * stride + first;
    memcpy(&q, key, sizeof q);
    if (sbfi_is_unit(q)) continue;
    normalise(&q);
    memcpy(key, &q, sizeof q);
    if (count++ == 0) at = i * stride + first;
  }
  sbfi_path path = sbfi_path_of("/sbf/clips/clip[%u]/track[%u]/values", clip + 1, number + 1);
  sbfi_count_repair(m, SBF_CODE_ROTATION_NOT_UNIT, count, path.text, at, "rotations of %u key%s normalised",
      count, sbfi_plural(count));
}

static void repair_normals(sbfi_repair *m, const sbf_render_mesh *mesh, uint32_t number) {
  uint32_t count = 0, first = 0;
  for (uint32_t i = 0; i < mesh->normals.count; i++) {
    sbf_vec3 *normal = (sbf_vec3 *)sbfi_writable(mesh->normals.at) + i;
    double length = sbfi_d3_length(sbfi_d3_of(*normal));
    /* zero length: the direction is unknown */
    if (fabs(length * length - 1) <= 0.02 || !(length > 0)) continue;
    *normal = sbfi_d3_rounded(sbfi_d3_scale(sbfi_d3_of(*normal), 1 / length));
    if (count++ == 0) first = i;
  }
  sbfi_path path = sbfi_path_of("/sbf/render_mesh[%u]/normals", number + 1);
  sbfi_count_repair(m, SBF_CODE_NORMAL_NOT_UNIT, count, path.text, first, "%u normal%s normalised", count,
      sbfi_plural(count));
}

void sbfi_repair_rotations(sbfi_repair *m) {
  sbfi_element_path root = sbfi_element_path_root(m->asset);
  walk(m, &root);
  for (uint32_t c = 0; c < m->asset->clips.count; c++)
    for (uint32_t t = 0; t < m->asset->clips.at[c].tracks.count; t++)
      repair_keys(m, &m->asset->clips.at[c].tracks.at[t], c, t);
  for (uint32_t i = 0; i < m->asset->render_meshes.count; i++)
    repair_normals(m, &m->asset->render_meshes.at[i], i);
}
