/* Horizontal geometry: rotation about +Y, horizontal distances, and the ground below a point. */
#include "animation/gait/gait_state.h"
#include "math/trig.h"

static const float PI = 3.14159265f;

float sbri_wrap_angle(float angle) {
  while (angle > PI) angle -= 2 * PI;
  while (angle <= -PI) angle += 2 * PI;
  return angle;
}

sbf_vec3 sbri_rotate_yaw(sbf_vec3 v, float yaw) {
  float s, c;
  sbri_sincos(yaw, &s, &c);
  return sbri_vec3(c * v.x + s * v.z, v.y, c * v.z - s * v.x);
}

sbf_vec3 sbri_ground_below(const sbri_gait_input *input, sbf_vec3 position, sbf_vec3 *normal) {
  sbf_vec3 unit;
  double y = input->ground->height(
      input->ground, input->origin.x + (double)position.x, input->origin.z + (double)position.z, &unit);
  if (normal) *normal = unit;
  return sbri_vec3(position.x, (float)(y - input->origin.y), position.z);
}

float sbri_flat_distance(sbf_vec3 a, sbf_vec3 b) {
  float x = a.x - b.x, z = a.z - b.z;
  return sqrtf(x * x + z * z);
}
