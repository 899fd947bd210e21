/* Transforms as translation, rotation and scale, for keys. */
#ifndef SBFI_TRS_H
#define SBFI_TRS_H

#include "import/scene/scene.h"

typedef struct sbfi_trs {
  double position[3];
  double rotation[4]; /* x y z w, unit length */
  double scale[3];    /* along the rotated axes; a mirrored transform has its negative sign in x */
} sbfi_trs;

sbfi_matrix sbfi_trs_compose(const sbfi_trs *trs); /* scale first, then rotation, then translation */

/* Drops shear, because keys cannot represent it. */
sbfi_trs sbfi_trs_decompose(const sbfi_matrix *matrix);

#endif
