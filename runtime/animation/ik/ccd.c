/* Cyclic coordinate descent. */
#include "animation/ik/ik.h"

/* Joints from the end to the root. While a joint rotates, the frames of those before it do not move, so an
 * iteration only needs its initial frames and the position of the end. */
static void pass(sbri_ik_chain *chain, sbf_vec3 target, const sbr_transform *frames) {
  sbf_vec3 end = frames[chain->count - 1].position;
  for (uint32_t i = chain->count - 1; i-- > 0;) {
    sbf_vec3 pivot = frames[i].position, arm = sbri_sub(end, pivot);
    sbf_vec3 is = sbri_normalize(arm, sbri_vec3(0, 1, 0));
    sbf_vec3 wanted = sbri_normalize(sbri_sub(target, pivot), is);
    sbri_ik_rotate_bone(chain, i, sbri_quat_between(is, wanted), frames);
    sbf_quat before = i ? frames[i - 1].rotation : chain->base.rotation;
    sbf_quat now = sbri_quat_multiply(before, chain->joints[i].rotation);
    sbf_quat turned = sbri_quat_normalize(sbri_quat_multiply(now, sbri_quat_conjugate(frames[i].rotation)));
    end = sbri_add(pivot, sbri_rotate(turned, arm));
  }
}

sbri_ik_result sbri_ccd(sbri_ik_chain *chain) {
  sbr_transform frames[SBRI_IK_MAX_JOINTS];
  sbf_vec3 target = sbri_ik_begin(chain, frames);
  uint32_t passes = 0, last = chain->count - 1;
  while (
      passes < chain->iterations && sbri_length(sbri_sub(frames[last].position, target)) > chain->tolerance) {
    sbf_vec3 before = frames[last].position;
    pass(chain, target, frames);
    sbri_ik_compute_frames(chain, frames);
    passes++;
    if (sbri_length(sbri_sub(frames[last].position, before)) < 0.001f * chain->tolerance) break;
  }
  return sbri_ik_finish(chain, target, frames, passes);
}
