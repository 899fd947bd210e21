/* Limits on the strain of springs, which must be ordered so that each can be reached. */
#ifndef SBFI_STRAIN_ORDER_H
#define SBFI_STRAIN_ORDER_H

#include "validate/validation.h"

/* As in attributes and spring sets: -1 and 0 mean no limit. */
typedef struct sbfi_strains {
  float min, max, yield, tear;
} sbfi_strains;

void sbfi_check_strain_order(sbfi_validation *v, const sbfi_strains *strains, const char *path);

#endif
