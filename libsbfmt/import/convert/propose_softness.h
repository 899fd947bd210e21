/* Which parts of a skin become soft bodies, and how soft: a proposal, marked as one. */
#ifndef SBFI_PROPOSE_SOFTNESS_H
#define SBFI_PROPOSE_SOFTNESS_H

#include "import/convert/conversion.h"

/* After the gait and the ground: gives each bone whose part of the skins would become a section a recipe, as
 * sbf_convert_options has it, and reports what was decided and why. Nothing where the asset has recipes or
 * nothing is to be cut. SBF_CODE_IMPORT_PIN_UNKNOWN: `soft` or `rigid` names a bone that is not there. */
sbf_status sbfi_propose_softness(sbfi_conversion *c);

#endif
