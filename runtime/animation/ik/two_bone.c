#include "animation/ik/two_bone.h"

#include "animation/ik/ik.h"

/* The part of `v` perpendicular to the unit vector `along`; applied twice, because the first result for a
 * nearly parallel `v` is mostly rounding. */
static sbf_vec3 across(sbf_vec3 v, sbf_vec3 along) {
  for (int i = 0; i < 2; i++) v = sbri_add_scaled(v, along, -sbri_dot(v, along));
  return v;
}

sbri_two_bone_result sbri_two_bone(sbf_vec3 hip, sbf_vec3 target, sbf_vec3 pole, sbf_vec3 fallback,
    float upper, float lower, float soft_reach) {
  float reach = upper + lower, nearest = fabsf(upper - lower);
  sbf_vec3 to_target = sbri_sub(target, hip);
  float wanted = sbri_length(to_target);
  sbf_vec3 along = sbri_normalize(to_target, sbri_vec3(0, -1, 0));
  float distance = sbri_clamp(sbri_soften_reach(wanted, reach, soft_reach), nearest, reach);

  sbf_vec3 out = across(sbri_sub(pole, hip), along);
  if (sbri_dot(out, out) < 1e-10f * reach * reach) out = across(sbri_sub(fallback, hip), along);
  sbf_vec3 spare = sbri_cross(along, fabsf(along.x) < 0.9f ? sbri_vec3(1, 0, 0) : sbri_vec3(0, 0, 1));
  out = sbri_normalize(out, sbri_normalize(spare, sbri_vec3(0, 0, 1)));

  float x = distance > 0 ? (upper * upper - lower * lower + distance * distance) / (2 * distance) : 0;
  float height = upper * upper - x * x;
  height = height > 0 ? sqrtf(height) : 0;
  sbri_two_bone_result result;
  result.knee = sbri_add_scaled(sbri_add_scaled(hip, along, x), out, height);
  result.ankle = sbri_add_scaled(hip, along, distance);
  result.reached = fabsf(distance - wanted) <= 1e-6f * reach;
  return result;
}

sbri_ik_result sbri_ik_two_bone(sbri_ik_chain *chain) {
  sbr_transform frames[SBRI_IK_MAX_JOINTS];
  sbf_vec3 target = sbri_ik_begin(chain, frames), hip = frames[0].position, knee = frames[1].position;
  float upper = sbri_length(chain->joints[1].offset), lower = sbri_length(chain->joints[2].offset);
  sbf_vec3 middle = sbri_lerp(hip, frames[2].position, 0.5f), out = sbri_sub(knee, middle);
  sbf_vec3 pole = chain->has_pole ? chain->pole : sbri_add_scaled(knee, out, 2);
  sbri_two_bone_result solved = sbri_two_bone(hip, target, pole, knee, upper, lower, 0);
  const sbf_vec3 positions[3] = {hip, solved.knee, solved.ankle};
  sbri_ik_through(chain, positions, frames);
  sbri_ik_result result = sbri_ik_finish(chain, target, frames, 1);
  float away = sbri_length(sbri_sub(solved.ankle, target));
  if (result.error <= away + chain->tolerance) return result;
  return sbri_ccd(chain); /* a limit forbids the result */
}
