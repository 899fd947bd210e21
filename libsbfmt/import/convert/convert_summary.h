/* What came in, for whoever asked. */
#ifndef SBFI_CONVERT_SUMMARY_H
#define SBFI_CONVERT_SUMMARY_H

#include "import/convert/conversion.h"
#include "import/paper/dialect2012.h"
#include "import/tetrahedra/tet_mesh.h"

/* Fills options->summary, where it is not NULL: of the conversion's scenes, or of `tets` or `paper` where
 * those are what was read. */
void sbfi_summarize(sbfi_conversion *c, const sbfi_tet_mesh *tets, const sbfi_paper_model *paper,
    const sbf_convert_options *options);

#endif
