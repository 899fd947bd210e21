/* Whether a value equals its default and can be omitted from a file. */
#ifndef SBFI_DEFAULTS_H
#define SBFI_DEFAULTS_H

#include "model/element_path.h"

/* Bit by bit: -0 differs from 0. A field fixed by its parent is at its default with that value; lists and
 * children if empty; a `one` child if all its fields are. */
bool sbfi_field_is_default(const sbfi_element_path *path, const sbfi_field *field);

#endif
