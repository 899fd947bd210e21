/* Proposes which parts of a skin become soft bodies, and their moduli, and marks them as proposals. */
#ifndef SBFI_PROPOSE_SOFTNESS_H
#define SBFI_PROPOSE_SOFTNESS_H

#include "import/convert/conversion.h"

/* After the gait and the ground: adds a recipe for each bone whose part of the skins would become a
 * section, as described for sbf_convert_options, and reports the decisions with reasons. Does nothing if
 * the asset has recipes or no skin will be cut. SBF_CODE_IMPORT_PIN_UNKNOWN if `soft` or `rigid` names an
 * unknown bone. */
sbf_status sbfi_propose_softness(sbfi_conversion *c);

#endif
