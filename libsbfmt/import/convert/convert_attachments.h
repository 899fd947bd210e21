/* Attachments of soft bodies to rigid hulls: points inside the hull are pinned. */
#ifndef SBFI_CONVERT_ATTACHMENTS_H
#define SBFI_CONVERT_ATTACHMENTS_H

#include "import/convert/conversion.h"

/* After the joints: adds the attachments that the options request, and converts the objects that hold them
 * to rigid bodies. SBF_CODE_IMPORT_PIN_UNKNOWN if a body or a holder does not exist. */
sbf_status sbfi_convert_attachments(sbfi_conversion *c);

#endif
