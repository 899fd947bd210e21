/* Whether something says no more than its default, and so can be left out of a file. */
#ifndef SBFI_DEFAULTS_H
#define SBFI_DEFAULTS_H

#include "model/element_path.h"

/* Bit by bit: -0 is not 0. A field that its place fixes counts as at its default when it has that value;
 * lists and children when there are none, a `one` child when all in it is. */
bool sbfi_field_is_default(const sbfi_element_path *path, const sbfi_field *field);

#endif
