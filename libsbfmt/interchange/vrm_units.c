#include "interchange/vrm_units.h"

#include <math.h>

static const double RATE_HZ = 60;
static const double MAX_DRAG_FORCE = 1 - 1e-6;

double sbfi_vrm_drag(double drag_force) {
  return -RATE_HZ * log1p(-fmin(drag_force, MAX_DRAG_FORCE));
}

double sbfi_vrm_drag_force(double drag) {
  return -expm1(-drag / RATE_HZ);
}

double sbfi_vrm_acceleration(double drag) {
  double force = sbfi_vrm_drag_force(drag);
  return force > 0 ? drag / force : RATE_HZ;
}
