/* Summary of the input for the caller. */
#ifndef SBFI_CONVERT_SUMMARY_H
#define SBFI_CONVERT_SUMMARY_H

#include "import/convert/conversion.h"
#include "import/paper/dialect2012.h"
#include "import/tetrahedra/tet_mesh.h"

/* Fills options->summary unless it is NULL: from the conversion's scenes, or from `tets` or `paper` if one
 * of them is the input. */
void sbfi_summarize(sbfi_conversion *c, const sbfi_tet_mesh *tets, const sbfi_paper_model *paper,
    const sbf_convert_options *options);

#endif
