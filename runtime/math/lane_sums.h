/* Forces (or impulses) on points and their moments, summed by lanes of eight: the same bits for any SIMD
 * width. */
#ifndef SBRI_LANE_SUMS_H
#define SBRI_LANE_SUMS_H

#include "math/vec3.h"
#include "math/wide.h"

typedef struct sbri_lane_sums {
  float force[3][SBRI_BLOCK], moment[3][SBRI_BLOCK];
} sbri_lane_sums;

static inline void sbri_lane_add(float *sum, sbri_wide more) {
  sbri_wide_store(sum, sbri_wide_load(sum) + more);
}

/* Adds a group of lanes at r with forces (or impulses) p. */
static inline void sbri_lane_sums_add(sbri_lane_sums *sums, uint32_t lane, sbri_wide3 r, sbri_wide3 p) {
  sbri_lane_add(sums->force[0] + lane, p.x);
  sbri_lane_add(sums->force[1] + lane, p.y);
  sbri_lane_add(sums->force[2] + lane, p.z);
  sbri_lane_add(sums->moment[0] + lane, r.y * p.z - r.z * p.y);
  sbri_lane_add(sums->moment[1] + lane, r.z * p.x - r.x * p.z);
  sbri_lane_add(sums->moment[2] + lane, r.x * p.y - r.y * p.x);
}

static inline float sbri_lanes_joined(const float a[SBRI_BLOCK]) {
  return ((a[0] + a[4]) + (a[2] + a[6])) + ((a[1] + a[5]) + (a[3] + a[7]));
}
static inline sbf_vec3 sbri_lanes_force(const sbri_lane_sums *s) {
  return sbri_vec3(
      sbri_lanes_joined(s->force[0]), sbri_lanes_joined(s->force[1]), sbri_lanes_joined(s->force[2]));
}
static inline sbf_vec3 sbri_lanes_moment(const sbri_lane_sums *s) {
  return sbri_vec3(
      sbri_lanes_joined(s->moment[0]), sbri_lanes_joined(s->moment[1]), sbri_lanes_joined(s->moment[2]));
}

#endif
