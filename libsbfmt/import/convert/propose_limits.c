/* Angles are in degrees, from the straight limb for hinges and from the rest pose for other parts.
 *
 * Human: values of goniometry handbooks for adults, such as that of the American Academy of Orthopaedic
 * Surgeons (elbow 0 to 145-150, knee 0 to 140, hip 120 to -20, wrist 80 to -70, ankle 20 up and 50 down, neck
 * 45 in each direction). Trunk and neck angles are divided among their bones. Soucie et al., Haemophilia 17,
 * 2011, measured 674 people.
 *
 * Quadruped: dogs. Angles between bones of 16 Labradors (Jaegger, Marcellin-Little and Levine, Am. J. Vet.
 * Res. 63, 2002) and from textbooks of lameness: elbow 25-36 bent to 155-165 straight, carpus 32-34 to
 * 196-198, shoulder 47-57 to 159-165 with 30 sideways. Stifle and tarsus resemble elbow and carpus within
 * about ten degrees. A bend is 180 minus that angle. Trunk and tail are estimates.
 *
 * Reptile: the femur of a lizard swings through a large arc and rotates about its axis (Brinkman, J. Zool.
 * 1981, Iguana), knees are strict hinges, ankles twist as they bend (Rewcastle, J. Zool. 1980). The
 * numbers are estimates from these. */
#include "import/convert/propose_limits.h"

#include <ctype.h>
#include <math.h>
#include <string.h>

#include "mechanics/vector.h"

static const double degree = 0.017453292519943295;

/* Direction in which the limb bends. */
typedef enum bend { FORWARD, BACKWARD, UPWARD, BELLY } bend;

typedef struct range {
  bool known, hinge; /* for a hinge min and max are bends of the straight limb */
  float cone;        /* half angle; 0: use the four below */
  float min, max;    /* swing_z, about the axis of bending */
  float aside;       /* swing_y, to both sides */
  float twist;       /* to both sides */
  bend to;
} range;

static const range ranges[3][SBFI_PART_COUNT] = {
    {/* human */
        [SBFI_PART_SPINE] = {true, false, 25, 0, 0, 0, 15, BELLY},
        [SBFI_PART_NECK] = {true, false, 30, 0, 0, 0, 40, BELLY},
        [SBFI_PART_HEAD] = {true, false, 30, 0, 0, 0, 40, BELLY},
        [SBFI_PART_TAIL] = {true, false, 40, 0, 0, 0, 20, BELLY},
        [SBFI_PART_COLLAR] = {true, false, 30, 0, 0, 0, 10, FORWARD},
        [SBFI_PART_SHOULDER] = {true, false, 100, 0, 0, 0, 80, FORWARD},
        [SBFI_PART_ELBOW] = {true, true, 0, 0, 147, 5, 80, FORWARD},
        [SBFI_PART_WRIST] = {true, false, 0, -70, 80, 25, 10, FORWARD},
        [SBFI_PART_HIP] = {true, false, 0, -20, 120, 45, 45, FORWARD},
        [SBFI_PART_KNEE] = {true, true, 0, 0, 140, 5, 10, BACKWARD},
        [SBFI_PART_ANKLE] = {true, false, 0, -50, 20, 25, 20, UPWARD},
        [SBFI_PART_DIGIT] = {true, false, 0, -40, 90, 15, 5, FORWARD}},
    {/* quadruped */
        [SBFI_PART_SPINE] = {true, false, 15, 0, 0, 0, 10, BELLY},
        [SBFI_PART_NECK] = {true, false, 40, 0, 0, 0, 25, BELLY},
        [SBFI_PART_HEAD] = {true, false, 40, 0, 0, 0, 35, BELLY},
        [SBFI_PART_TAIL] = {true, false, 40, 0, 0, 0, 20, BELLY},
        [SBFI_PART_COLLAR] = {true, false, 20, 0, 0, 0, 10, FORWARD},
        [SBFI_PART_SHOULDER] = {true, false, 0, -55, 55, 30, 20, FORWARD},
        [SBFI_PART_ELBOW] = {true, true, 0, 20, 150, 5, 20, FORWARD},
        [SBFI_PART_WRIST] = {true, true, 0, -17, 147, 10, 10, BACKWARD},
        [SBFI_PART_HIP] = {true, false, 0, -55, 55, 35, 25, FORWARD},
        [SBFI_PART_KNEE] = {true, true, 0, 18, 138, 5, 10, BACKWARD},
        [SBFI_PART_ANKLE] = {true, true, 0, 15, 141, 5, 10, FORWARD},
        [SBFI_PART_DIGIT] = {true, false, 0, -60, 60, 10, 5, BACKWARD}},
    {/* reptile */
        [SBFI_PART_SPINE] = {true, false, 20, 0, 0, 0, 10, BELLY},
        [SBFI_PART_NECK] = {true, false, 30, 0, 0, 0, 20, BELLY},
        [SBFI_PART_HEAD] = {true, false, 35, 0, 0, 0, 20, BELLY},
        [SBFI_PART_TAIL] = {true, false, 30, 0, 0, 0, 10, BELLY},
        [SBFI_PART_COLLAR] = {true, false, 15, 0, 0, 0, 10, FORWARD},
        [SBFI_PART_SHOULDER] = {true, false, 55, 0, 0, 0, 45, FORWARD},
        [SBFI_PART_ELBOW] = {true, true, 0, 10, 140, 5, 25, FORWARD},
        [SBFI_PART_WRIST] = {true, false, 0, -60, 60, 25, 15, BACKWARD},
        [SBFI_PART_HIP] = {true, false, 60, 0, 0, 0, 50, FORWARD},
        [SBFI_PART_KNEE] = {true, true, 0, 10, 140, 5, 10, BACKWARD},
        [SBFI_PART_ANKLE] = {true, false, 0, -50, 60, 20, 30, UPWARD},
        [SBFI_PART_DIGIT] = {true, false, 0, -50, 60, 20, 5, BACKWARD}}};

static bool has(const char *name, const char *word) {
  return strstr(name, word) != NULL;
}

sbfi_limb_part sbfi_part_by_name(const char *name) {
  /* The first match wins, so specific words come before general ones. */
  static const struct {
    const char *word;
    sbfi_limb_part part;
  } words[] = {{"finger", SBFI_PART_DIGIT}, {"thumb", SBFI_PART_DIGIT}, {"index", SBFI_PART_DIGIT},
      {"pinky", SBFI_PART_DIGIT}, {"toe", SBFI_PART_DIGIT}, {"digit", SBFI_PART_DIGIT},
      {"forearm", SBFI_PART_ELBOW}, {"lowerarm", SBFI_PART_ELBOW}, {"lower_arm", SBFI_PART_ELBOW},
      {"elbow", SBFI_PART_ELBOW}, {"upperarm", SBFI_PART_SHOULDER}, {"upper_arm", SBFI_PART_SHOULDER},
      {"humer", SBFI_PART_SHOULDER}, {"upleg", SBFI_PART_HIP}, {"upperleg", SBFI_PART_HIP},
      {"upper_leg", SBFI_PART_HIP}, {"thigh", SBFI_PART_HIP}, {"femur", SBFI_PART_HIP},
      {"lowerleg", SBFI_PART_KNEE}, {"lower_leg", SBFI_PART_KNEE}, {"shin", SBFI_PART_KNEE},
      {"calf", SBFI_PART_KNEE}, {"knee", SBFI_PART_KNEE}, {"tibia", SBFI_PART_KNEE},
      {"clavicle", SBFI_PART_COLLAR}, {"collar", SBFI_PART_COLLAR}, {"shoulder", SBFI_PART_COLLAR},
      {"scapula", SBFI_PART_COLLAR}, {"hand", SBFI_PART_WRIST}, {"wrist", SBFI_PART_WRIST},
      {"palm", SBFI_PART_WRIST}, {"foot", SBFI_PART_ANKLE}, {"ankle", SBFI_PART_ANKLE},
      {"heel", SBFI_PART_ANKLE}, {"neck", SBFI_PART_NECK}, {"head", SBFI_PART_HEAD}, {"tail", SBFI_PART_TAIL},
      {"spine", SBFI_PART_SPINE}, {"chest", SBFI_PART_SPINE}, {"torso", SBFI_PART_SPINE},
      {"belly", SBFI_PART_SPINE}, {"abdomen", SBFI_PART_SPINE}, {"hips", SBFI_PART_SPINE},
      {"pelvis", SBFI_PART_SPINE}, {"body", SBFI_PART_SPINE}, {"arm", SBFI_PART_SHOULDER},
      {"leg", SBFI_PART_KNEE}};
  char lower[128];
  size_t length = 0;
  for (; name[length] && length + 1 < sizeof lower; length++)
    lower[length] = (char)tolower((unsigned char)name[length]);
  lower[length] = 0;
  for (size_t i = 0; i < sizeof words / sizeof *words; i++)
    if (has(lower, words[i].word)) return words[i].part;
  return SBFI_PART_OTHER;
}

/* Part by its index in a leg of the gait: thigh, shin, foot. Fore legs are those in front of the mean of
 * all. */
static sbfi_limb_part part_by_gait(const sbf_asset *a, int32_t bone) {
  if (a->gaits.count == 0) return SBFI_PART_OTHER;
  const sbf_leg_list *legs = &a->gaits.at[0].legs;
  double middle = 0;
  for (uint32_t l = 0; l < legs->count; l++) middle += (double)legs->at[l].home.z / legs->count;
  for (uint32_t l = 0; l < legs->count; l++) {
    const sbf_ik_chain *chain = &a->ik_chains.at[legs->at[l].ik];
    bool fore = legs->count > 2 && (double)legs->at[l].home.z > middle;
    if (bone == chain->root) return fore ? SBFI_PART_SHOULDER : SBFI_PART_HIP;
    if (bone == chain->end) return fore ? SBFI_PART_WRIST : SBFI_PART_ANKLE;
    for (int32_t b = a->bones.at[chain->end].parent; b != SBF_NONE && b != chain->root;
         b = a->bones.at[b].parent)
      if (b == bone) return fore ? SBFI_PART_ELBOW : SBFI_PART_KNEE;
  }
  return SBFI_PART_OTHER;
}

static sbfi_d3 rotated(sbf_quat q, sbfi_d3 v) {
  sbfi_d3 u = {q.x, q.y, q.z}, t = sbfi_d3_scale(sbfi_d3_cross(u, v), 2);
  return sbfi_d3_add(v, sbfi_d3_add(sbfi_d3_scale(t, q.w), sbfi_d3_cross(u, t)));
}

/* The frame with the axes x, y, z as columns. */
static sbf_quat frame_of(sbfi_d3 x, sbfi_d3 y, sbfi_d3 z) {
  double trace = x.x + y.y + z.z, q[4];
  if (trace > 0) {
    double s = 2 * sqrt(trace + 1);
    q[0] = (y.z - z.y) / s, q[1] = (z.x - x.z) / s, q[2] = (x.y - y.x) / s, q[3] = s / 4;
  } else if (x.x >= y.y && x.x >= z.z) {
    double s = 2 * sqrt(1 + x.x - y.y - z.z);
    q[0] = s / 4, q[1] = (y.x + x.y) / s, q[2] = (z.x + x.z) / s, q[3] = (y.z - z.y) / s;
  } else if (y.y >= z.z) {
    double s = 2 * sqrt(1 + y.y - x.x - z.z);
    q[0] = (y.x + x.y) / s, q[1] = s / 4, q[2] = (z.y + y.z) / s, q[3] = (z.x - x.z) / s;
  } else {
    double s = 2 * sqrt(1 + z.z - x.x - y.y);
    q[0] = (z.x + x.z) / s, q[1] = (z.y + y.z) / s, q[2] = s / 4, q[3] = (x.y - y.x) / s;
  }
  return (sbf_quat){(float)q[0], (float)q[1], (float)q[2], (float)q[3]};
}

/* Axis about which the bone bends, and its bend at rest, rad. A hinge that is bent at rest keeps that
 * direction. */
static sbfi_d3 bending(const sbfi_conversion *c, int32_t bone, const range *r, double *bent) {
  const sbf_bone_list *bones = &c->asset->bones;
  sbfi_d3 along = rotated(bones->at[bone].rotation, (sbfi_d3){0, 1, 0});
  *bent = 0;
  if (r->hinge && bones->at[bone].parent != SBF_NONE) {
    sbfi_d3 above = sbfi_d3_normal(
        sbfi_d3_sub(sbfi_d3_of(bones->at[bone].head), sbfi_d3_of(bones->at[bones->at[bone].parent].head)));
    sbfi_d3 across = sbfi_d3_cross(above, along);
    double sine = sbfi_d3_length(across);
    *bent = atan2(sine, sbfi_d3_dot(above, along));
    if (sine > 0.17) return sbfi_d3_scale(across, 1 / sine);
  }
  bool upright = c->options->limits == SBF_CONVERT_LIMITS_HUMAN;
  sbfi_d3 to = {0, 0, r->to == FORWARD ? 1 : -1};
  if (r->to == UPWARD) to = (sbfi_d3){0, 1, 0};
  if (r->to == BELLY) to = upright ? (sbfi_d3){0, 0, 1} : (sbfi_d3){0, -1, 0};
  sbfi_d3 axis = sbfi_d3_cross(along, to);
  double sine = sbfi_d3_length(axis);
  if (sine > 0.2) return sbfi_d3_scale(axis, 1 / sine);
  /* The bone points in its bending direction: any axis across it will do. Chooses the leftmost. */
  sbfi_d3 left = {fabs(along.x) < 0.9, fabs(along.x) >= 0.9, 0};
  return sbfi_d3_normal(sbfi_d3_sub(left, sbfi_d3_scale(along, sbfi_d3_dot(left, along))));
}

static void add(sbf_limit_list *list, sbf_joint_axis axis, double min, double max) {
  sbf_limit *limit = (sbf_limit *)(uintptr_t)&list->at[list->count++]; /* propose allocates it */
  sbf_limit_init(limit);
  limit->target = axis;
  /* The range always includes the rest pose, even against the handbooks. */
  limit->min = (float)(fmin(min, 0) * degree);
  limit->max = (float)(fmax(max, 0) * degree);
}

static bool propose(sbfi_conversion *c, sbf_joint *joint, const range *r) {
  int32_t bone = c->asset->rigid_bodies.at[joint->body_b].bone;
  sbf_limit *limits = sbfi_convert_allocate(c, 3, sizeof *limits);
  if (!limits) return false;
  double bent;
  sbfi_d3 along = rotated(c->asset->bones.at[bone].rotation, (sbfi_d3){0, 1, 0});
  sbfi_d3 axis = bending(c, bone, r, &bent);
  axis = sbfi_d3_normal(sbfi_d3_sub(axis, sbfi_d3_scale(along, sbfi_d3_dot(axis, along))));
  joint->frame_a.rotation = joint->frame_b.rotation = frame_of(along, sbfi_d3_cross(axis, along), axis);
  joint->limits = (sbf_limit_list){limits, 0};
  add(&joint->limits, SBF_JOINT_AXIS_TWIST, -r->twist, r->twist);
  if (r->cone > 0) {
    add(&joint->limits, SBF_JOINT_AXIS_SWING, 0, r->cone);
  } else {
    add(&joint->limits, SBF_JOINT_AXIS_SWING_Y, -r->aside, r->aside);
    add(&joint->limits, SBF_JOINT_AXIS_SWING_Z, r->min - bent / degree, r->max - bent / degree);
  }
  joint->proposed = true;
  return true;
}

sbf_status sbfi_propose_limits(sbfi_conversion *c) {
  if (c->options->limits == SBF_CONVERT_LIMITS_NONE) return SBF_OK;
  const sbf_asset *a = c->asset;
  uint32_t proposed = 0, unknown = 0;
  for (uint32_t j = 0; j < a->joints.count; j++) {
    sbf_joint *joint = (sbf_joint *)(uintptr_t)&a->joints.at[j]; /* an earlier pass created it */
    if (joint->limits.count || joint->body_b == SBF_NONE) continue;
    int32_t bone = a->rigid_bodies.at[joint->body_b].bone;
    sbfi_limb_part part = part_by_gait(a, bone);
    if (part == SBFI_PART_OTHER) part = sbfi_part_by_name(a->bones.at[bone].name);
    const range *r = &ranges[c->options->limits - 1][part];
    if (r->known && !propose(c, joint, r)) return sbfi_convert_no_memory(c);
    proposed += r->known;
    unknown += !r->known;
  }
  if (proposed + unknown == 0) return SBF_OK;
  sbfi_convert_warn(c, SBF_CODE_RIG_LIMITS_PROPOSED,
      "limits are proposed for %u joints; %u have none, because neither their name nor their position "
      "identifies them",
      (unsigned)proposed, (unsigned)unknown);
  return SBF_OK;
}
