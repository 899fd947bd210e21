/* Proposes joint limits from the names and positions of bones, and marks them as proposals. */
#ifndef SBFI_PROPOSE_LIMITS_H
#define SBFI_PROPOSE_LIMITS_H

#include "import/convert/conversion.h"

/* Kind of bone by the joint at its head. */
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

/* Part from the name alone: matches the English words that rigs use anywhere in the name. */
sbfi_limb_part sbfi_part_by_name(const char *name);

/* After the joints: adds limits to every joint without authored limits whose bone has a known part, for
 * the kind of animal that the options name. Legs of the gait are known by position, other bones by name.
 * The joint's frames are rotated about the twist axis so that positive swing_z bends the limb. */
sbf_status sbfi_propose_limits(sbfi_conversion *c);

#endif
