/* Hints about softness from names. */
#ifndef SBFI_PART_WORDS_H
#define SBFI_PART_WORDS_H

#include <stdbool.h>

typedef enum sbfi_name_says {
  SBFI_SAYS_NOTHING,
  SBFI_SAYS_SOFT,   /* belly, tail, ear, cheek: soft even if slender */
  SBFI_SAYS_LIMB,   /* hands, feet, fingers, shins, forearms */
  SBFI_SAYS_FACE,   /* eyes, jaw, teeth, beak, horns */
  SBFI_SAYS_PROP,   /* weapons, armour, tools, wheels */
  SBFI_SAYS_MACHINE /* the whole character is a machine: mech, robot, tank, car */
} sbfi_name_says;

/* Matches the English words that rigs use. Names are split at capitals, digits and punctuation. NULL gives
 * no hint. */
sbfi_name_says sbfi_words_of_name(const char *name);

/* Whether the name is that of a hard material: metal, wood, glass, armour. */
bool sbfi_material_is_hard(const char *name);

#endif
