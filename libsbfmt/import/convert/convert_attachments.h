/* What of a soft body a rigid hull holds: everything of it inside. */
#ifndef SBFI_CONVERT_ATTACHMENTS_H
#define SBFI_CONVERT_ATTACHMENTS_H

#include "import/convert/conversion.h"

/* After the joints: gives bodies the attachments that the options ask for, and makes rigid bodies of the
 * objects that are to hold. SBF_CODE_IMPORT_PIN_UNKNOWN: there is no such body or holder. */
sbf_status sbfi_convert_attachments(sbfi_conversion *c);

#endif
