/* Checks sections: bodies on a bone are near it. */
#include "validate/rules/pose.h"
#include "validate/validation.h"

/* Approximate distance between the bounding box of points and the bone's line: the distance of the box's
 * centre minus half the diagonal. */
static double distance_from(const sbf_bone *bone, sbf_vec3_list points) {
  sbfi_d3 middle = {0, 0, 0}, head = sbfi_d3_of(bone->head);
  double radius = 0;
  for (uint32_t i = 0; i < points.count; i++)
    middle = sbfi_d3_add(middle, sbfi_d3_scale(sbfi_d3_of(points.at[i]), 1.0 / points.count));
  for (uint32_t i = 0; i < points.count; i++)
    radius = fmax(radius, sbfi_d3_length(sbfi_d3_sub(sbfi_d3_of(points.at[i]), middle)));
  sbfi_d3 along = sbfi_rotated(sbfi_rotation_of(bone->rotation), (sbfi_d3){0, 1, 0});
  double t = sbfi_d3_dot(sbfi_d3_sub(middle, head), along);
  t = fmin(fmax(t, 0), (double)bone->length);
  sbfi_d3 nearest = sbfi_d3_add(head, sbfi_d3_scale(along, t));
  return sbfi_d3_length(sbfi_d3_sub(middle, nearest)) - radius;
}

void sbfi_check_sections(sbfi_validation *v) {
  const sbf_soft_body_list bodies = v->asset->soft_bodies;
  for (uint32_t i = 0; i < bodies.count; i++) {
    const sbf_soft_body *body = &bodies.at[i];
    sbfi_path path = sbfi_path_of("/sbf/soft_body[%u]", i + 1);
    if (v->asset->bones.count && body->bone < 0 && body->pins.count == 0 && body->attachments.count == 0)
      sbfi_found(v, SBF_CODE_SECTION_NO_BONE, path.text, -1, "body '%s' has neither a bone nor pins",
          sbfi_label(body->name, body->id));
    if (body->bone < 0 || body->surface.positions.count == 0) continue;
    const sbf_bone *bone = &v->asset->bones.at[body->bone];
    double size = sbfi_extent(body->surface.positions),
           distance = distance_from(bone, body->surface.positions);
    if (distance > fmax(size, (double)bone->length))
      sbfi_found(v, SBF_CODE_SECTION_FAR, path.text, -1, "section '%s' is %.3g m from its bone '%s'",
          sbfi_label(body->name, body->id), distance, sbfi_bone_label(v->asset, (uint32_t)body->bone));
  }
}
