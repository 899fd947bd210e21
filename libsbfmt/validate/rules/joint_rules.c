/* Checks joints: two bodies, frames that coincide at rest, limits and drives on free coordinates. */
#include <math.h>

#include "model/element_path.h"
#include "validate/rules/joint_rest.h"
#include "validate/validation.h"

static const double PI = 3.14159265358979, REST_M = 1e-3, REST_FRACTION = 0.01, REST_RAD = 0.02, SLACK = 1e-3;

typedef struct jointed {
  sbfi_validation *v;
  const sbf_joint *joint;
  const char *name, *path;
  sbfi_joint_rest rest;
} jointed;

static bool is_angle(sbf_joint_axis axis) {
  return axis == SBF_JOINT_AXIS_TWIST || axis == SBF_JOINT_AXIS_SWING || axis == SBF_JOINT_AXIS_SWING_Y ||
         axis == SBF_JOINT_AXIS_SWING_Z;
}

/* Finds the first coordinate that the joint locks at 0 but that differs from 0 at rest. A rope or rod
 * keeps its length. */
static void check_rest(const jointed *j) {
  for (int axis = 0; axis < SBF_JOINT_AXIS_COUNT; axis++) {
    double value = fabs(j->rest.at[axis]),
           tolerance = is_angle(axis) ? REST_RAD : REST_M + REST_FRACTION * j->rest.arm;
    if (sbfi_joint_is_free(j->joint->kind, axis) || value <= tolerance) continue;
    sbfi_found(j->v, SBF_CODE_JOINT_NOT_AT_REST, j->path, -1,
        "joint '%s' locks %s at 0, but it is %.3g %s at rest", j->name, sbf_joint_axis_name(axis),
        j->rest.at[axis], is_angle(axis) ? "rad" : "m");
    return;
  }
}

static bool is_beyond(const sbf_limit *limit) {
  double min = limit->min, max = limit->max;
  if (limit->target == SBF_JOINT_AXIS_DISTANCE) return min < 0;
  if (limit->target == SBF_JOINT_AXIS_SWING) return min != 0 || max > PI + SLACK;
  return is_angle(limit->target) && (min < -2 * PI - SLACK || max > 2 * PI + SLACK);
}

static void check_limit(const jointed *j, uint32_t number, const char *path) {
  const sbf_limit *limit = &j->joint->limits.at[number];
  const char *axis = sbf_joint_axis_name(limit->target);
  double at_rest = j->rest.at[limit->target];
  for (uint32_t k = 0; k < number; k++)
    if (j->joint->limits.at[k].target == limit->target) {
      sbfi_found(j->v, SBF_CODE_LIMIT_REPEATED, path, -1, "joint '%s' has two limits of %s", j->name, axis);
      break;
    }
  if (limit->min > limit->max)
    sbfi_found(j->v, SBF_CODE_LIMIT_ORDER, path, -1,
        "the %s limit of joint '%s' has the minimum %.4g and the maximum %.4g", axis, j->name,
        (double)limit->min, (double)limit->max);
  else if (is_beyond(limit))
    sbfi_found(j->v, SBF_CODE_LIMIT_BEYOND_RANGE, path, -1, "the %s limit of joint '%s' is from %.4g to %.4g",
        axis, j->name, (double)limit->min, (double)limit->max);
  else if (!sbfi_joint_is_free(j->joint->kind, limit->target))
    sbfi_found(j->v, SBF_CODE_LIMIT_IDLE, path, -1, "joint '%s' is %s and has no %s to limit", j->name,
        sbf_joint_kind_name(j->joint->kind), axis);
  else if (at_rest < (double)limit->min - SLACK || at_rest > (double)limit->max + SLACK)
    sbfi_found(j->v, SBF_CODE_LIMIT_EXCLUDES_REST, path, -1,
        "%s of joint '%s' is %.4g at rest, but limited to %.4g … %.4g", axis, j->name, at_rest,
        (double)limit->min, (double)limit->max);
}

static void check_drive(const jointed *j, const sbf_drive *drive, const char *path) {
  const char *axis = sbf_joint_axis_name(drive->target);
  if (!sbfi_joint_is_free(j->joint->kind, drive->target))
    sbfi_found(j->v, SBF_CODE_DRIVE_IDLE, path, -1, "joint '%s' is %s and has no %s to drive", j->name,
        sbf_joint_kind_name(j->joint->kind), axis);
  else if (drive->stiffness == 0 && drive->damping == 0)
    sbfi_found(j->v, SBF_CODE_DRIVE_IDLE, path, -1,
        "the %s drive of joint '%s' has neither stiffness nor damping", axis, j->name);
}

static void check_joint(const jointed *j) {
  const sbf_joint *joint = j->joint;
  if (joint->body_a == joint->body_b) {
    sbfi_found(j->v, SBF_CODE_JOINT_ONE_BODY, j->path, -1, "joint '%s' joins a body to itself", j->name);
    return;
  }
  check_rest(j);
  if (joint->kind == SBF_JOINT_KIND_PULLEY && (j->rest.rope_a < 1e-6 || j->rest.rope_b < 1e-6))
    sbfi_found(
        j->v, SBF_CODE_PULLEY_NO_ROPE, j->path, -1, "a rope of joint '%s' has no length at rest", j->name);
  for (uint32_t l = 0; l < joint->limits.count; l++)
    check_limit(j, l, sbfi_path_of("%s/limits/limit[%u]", j->path, l + 1).text);
  for (uint32_t d = 0; d < joint->drives.count; d++)
    check_drive(j, &joint->drives.at[d], sbfi_path_of("%s/drive[%u]", j->path, d + 1).text);
}

void sbfi_check_joints(sbfi_validation *v) {
  const sbfi_element_path root = sbfi_element_path_root(v->asset);
  const sbfi_field *joints = sbfi_element_field(&sbfi_asset_element, "joints");
  for (uint32_t i = 0; i < v->asset->joints.count; i++) {
    const sbf_joint *joint = &v->asset->joints.at[i];
    sbfi_element_path location =
        sbfi_element_path_child(&root, joints, i); /* numbered among joints of its kind */
    sbfi_path path;
    sbfi_element_path_print(&location, NULL, path.text, sizeof path.text);
    jointed j = {
        v, joint, sbfi_label(joint->name, joint->id), path.text, sbfi_joint_rest_of(v->asset, joint)};
    check_joint(&j);
  }
}
