/* The element path of a diagnostic: where in the asset a walk over the schema tables stands. */
#ifndef SBFI_PATH_H
#define SBFI_PATH_H

#include "model/schema.h"

/* One step from an element to a child; steps are linked from the innermost outwards and live on the walk's
 * stack. The root has none: its path is NULL. */
typedef struct sbfi_path {
  const struct sbfi_path *up;
  const sbfi_field *field; /* of the element above */
  const void *child;
  uint32_t place; /* among its siblings, with SBFI_MANY */
} sbfi_path;

/* Writes the path of a field of the element at `path`, or of that element where `field` is NULL, cut to fit:
 * "/sbf/soft_body[2]/surface/positions". Places count from 0; a single child goes by its field's name; what
 * stands in a wrapper of the XML form is named without it. */
void sbfi_path_write(const sbfi_path *path, const sbfi_field *field, char *to, size_t size);

#endif
