/* A chain along a quadratic curve. */
#include "animation/ik/ik.h"

typedef struct curve {
  sbf_vec3 a, b, c; /* from a towards b to c */
} curve;

static sbf_vec3 curve_at(const curve *q, float t) {
  float u = 1 - t;
  sbf_vec3 p = sbri_add(sbri_scale(q->a, u * u), sbri_scale(q->b, 2 * u * t));
  return sbri_add(p, sbri_scale(q->c, t * t));
}

/* The parameter, from `t` on, where the curve leaves a sphere; 2: never. */
static float leave(const curve *q, sbf_vec3 from, float t, float length) {
  float low = t, high = 2;
  for (int k = 1; k <= 32; k++) {
    float at = t + (1 - t) * (float)k / 32;
    if (sbri_length(sbri_sub(curve_at(q, at), from)) < length) {
      low = at;
      continue;
    }
    high = at;
    break;
  }
  if (high > 1) return 2;
  for (int k = 0; k < 24; k++) {
    float middle = 0.5f * (low + high);
    if (sbri_length(sbri_sub(curve_at(q, middle), from)) < length)
      low = middle;
    else
      high = middle;
  }
  return high;
}

/* Places the joints on the curve, one length after the other, and straight on beyond its end. Returns the
 * length of the chain beyond the curve's end, or minus the length of the curve beyond the chain's. */
static float lay(const sbri_ik_chain *chain, const curve *q, sbf_vec3 *positions) {
  float t = 0;
  positions[0] = q->a;
  for (uint32_t i = 1; i < chain->count; i++) {
    float length = sbri_length(chain->joints[i].offset);
    float next = t > 1 ? 2 : leave(q, positions[i - 1], t, length);
    if (next <= 1) {
      positions[i] = curve_at(q, next);
    } else {
      sbf_vec3 out = sbri_normalize(sbri_sub(q->c, q->b), sbri_sub(q->c, q->a));
      sbf_vec3 spare = sbri_normalize(sbri_sub(q->c, positions[i - 1]), out);
      positions[i] = sbri_add_scaled(positions[i - 1], t > 1 ? out : spare, length);
    }
    t = next;
  }
  float beyond = sbri_length(sbri_sub(positions[chain->count - 1], q->c));
  return t > 1 ? beyond : -beyond;
}

sbri_ik_result sbri_ik_spline(sbri_ik_chain *chain) {
  sbr_transform frames[SBRI_IK_MAX_JOINTS];
  sbf_vec3 positions[SBRI_IK_MAX_JOINTS], target = sbri_ik_begin(chain, frames);
  sbf_vec3 root = frames[0].position, middle = sbri_lerp(root, target, 0.5f), bow = {0, 0, 0};
  float reach = sbri_ik_reach(chain);
  for (uint32_t i = 1; i + 1 < chain->count; i++) bow = sbri_add(bow, sbri_sub(frames[i].position, middle));
  if (chain->has_pole) bow = sbri_sub(chain->pole, middle);
  sbf_vec3 along = sbri_normalize(sbri_sub(target, root), sbri_vec3(0, 1, 0));
  bow = sbri_add_scaled(bow, along, -sbri_dot(bow, along));
  sbf_vec3 spare = fabsf(along.x) < 0.9f ? sbri_vec3(1, 0, 0) : sbri_vec3(0, 0, 1);
  bow = sbri_normalize(bow, sbri_normalize(sbri_cross(along, spare), spare));
  /* The bend for which the last joint meets the target. */
  float low = 0, high = 2 * reach;
  uint32_t passes = 0, max = chain->iterations < 40 ? chain->iterations : 40;
  curve q = {root, middle, target};
  for (; passes < max; passes++) {
    float height = 0.5f * (low + high);
    q.b = sbri_add_scaled(middle, bow, height);
    float beyond = lay(chain, &q, positions);
    if (fabsf(beyond) <= 0.1f * chain->tolerance) break;
    if (beyond > 0)
      low = height;
    else
      high = height;
  }
  sbri_ik_through(chain, positions, frames);
  sbri_ik_compute_frames(chain, frames);
  return sbri_ik_finish(chain, target, frames, passes);
}
