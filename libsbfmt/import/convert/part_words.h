/* Hints about softness from names. */
#ifndef SBFI_PART_WORDS_H
#define SBFI_PART_WORDS_H

#include <stdbool.h>

typedef enum sbfi_name_hint {
  SBFI_NAME_HINT_NONE,
  SBFI_NAME_HINT_SOFT,   /* belly, tail, ear, cheek: soft even if slender */
  SBFI_NAME_HINT_LIMB,   /* hands, feet, fingers, shins, forearms */
  SBFI_NAME_HINT_FACE,   /* eyes, jaw, teeth, beak, horns */
  SBFI_NAME_HINT_PROP,   /* weapons, armour, tools, wheels */
  SBFI_NAME_HINT_MACHINE /* the whole character is a machine: mech, robot, tank, car */
} sbfi_name_hint;

/* Matches the English words that rigs use. Names are split at capitals, digits and punctuation. NULL gives
 * no hint. */
sbfi_name_hint sbfi_words_of_name(const char *name);

/* Whether the name is that of a hard material: metal, wood, glass, armour. */
bool sbfi_material_is_hard(const char *name);

#endif
