/* How far joints turn, by what the bones are called and how they lie: a proposal, marked as one. */
#ifndef SBFI_PROPOSE_LIMITS_H
#define SBFI_PROPOSE_LIMITS_H

#include "import/convert/conversion.h"

/* What a bone is, seen from the joint at its head. */
typedef enum sbfi_limb_part {
  SBFI_PART_OTHER,
  SBFI_PART_SPINE,
  SBFI_PART_NECK,
  SBFI_PART_HEAD,
  SBFI_PART_TAIL,
  SBFI_PART_COLLAR,
  SBFI_PART_SHOULDER, /* the upper arm, or fore leg */
  SBFI_PART_ELBOW,
  SBFI_PART_WRIST,
  SBFI_PART_HIP, /* the thigh */
  SBFI_PART_KNEE,
  SBFI_PART_ANKLE,
  SBFI_PART_DIGIT,
  SBFI_PART_COUNT
} sbfi_limb_part;

/* By its name alone: English words, as rigs have them, whatever else stands around them. */
sbfi_limb_part sbfi_part_by_name(const char *name);

/* After the joints: gives every joint that states no limits those of the kind of animal that the options
 * name, where its bone's part is known: the legs of the gait by their place in it, others by name. The
 * joint's frames are turned about the twist axis so that positive swing_z bends the limb. */
sbf_status sbfi_propose_limits(sbfi_conversion *c);

#endif
