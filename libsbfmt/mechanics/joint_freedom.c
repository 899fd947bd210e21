#include "mechanics/joint_freedom.h"

#define AXIS(name) (1u << SBF_JOINT_AXIS_##name)
static const unsigned linear = AXIS(LINEAR_X) | AXIS(LINEAR_Y) | AXIS(LINEAR_Z);
static const unsigned swings = AXIS(SWING_Y) | AXIS(SWING_Z);
static const unsigned angular = AXIS(TWIST) | AXIS(SWING_Y) | AXIS(SWING_Z);

unsigned sbfi_joint_is_locked(sbf_joint_kind kind) {
  switch (kind) {
  case SBF_JOINT_KIND_PRISMATIC:
    return AXIS(LINEAR_Y) | AXIS(LINEAR_Z) | angular;
  case SBF_JOINT_KIND_REVOLUTE:
    return linear | swings;
  case SBF_JOINT_KIND_CYLINDRICAL:
    return AXIS(LINEAR_Y) | AXIS(LINEAR_Z) | swings;
  case SBF_JOINT_KIND_SPHERICAL:
    return linear;
  case SBF_JOINT_KIND_POINT_ON_LINE:
    return AXIS(LINEAR_Y) | AXIS(LINEAR_Z);
  case SBF_JOINT_KIND_POINT_IN_PLANE:
    return AXIS(LINEAR_X);
  case SBF_JOINT_KIND_DISTANCE:
  case SBF_JOINT_KIND_PULLEY:
  case SBF_JOINT_KIND_SIX_DOF:
    return 0;
  case SBF_JOINT_KIND_FIXED:
  default:
    return linear | angular;
  }
}

bool sbfi_joint_is_free(sbf_joint_kind kind, sbf_joint_axis axis) {
  unsigned free = (linear | angular) & ~sbfi_joint_is_locked(kind);
  if (axis == SBF_JOINT_AXIS_SWING) return (free & swings) != 0;
  if (axis == SBF_JOINT_AXIS_DISTANCE) return (free & linear) != 0;
  return free >> axis & 1;
}
