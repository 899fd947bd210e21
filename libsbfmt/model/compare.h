/* Equality of parts of assets. */
#ifndef SBFI_COMPARE_H
#define SBFI_COMPARE_H

#include "model/schema.h"

/* Whether all fields of two objects of the element, and all below them, are equal bit by bit; what an asset's
 * own equality leaves out does not count. */
bool sbfi_objects_equal(const sbfi_element *element, const void *a, const void *b);

#endif
