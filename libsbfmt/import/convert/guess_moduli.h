/* What bodies are made of where nobody says so. */
#ifndef SBFI_GUESS_MODULI_H
#define SBFI_GUESS_MODULI_H

#include "import/convert/conversion.h"

/* Gives sections on bones the modulus of flesh, or as much as their thickness takes, and bodies that nothing
 * holds as much as it takes to stand on the ground; tells what was guessed. */
void sbfi_guess_moduli(sbfi_conversion *c);

#endif
