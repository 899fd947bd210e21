/* Default moduli for bodies without an authored one. */
#ifndef SBFI_GUESS_MODULI_H
#define SBFI_GUESS_MODULI_H

#include "import/convert/conversion.h"

/* Sets the modulus of sections on bones to that of soft tissue, or higher if their thickness needs it, and of
 * free bodies to one that can carry their weight on the ground. Reports the guesses. */
void sbfi_guess_moduli(sbfi_conversion *c);

#endif
