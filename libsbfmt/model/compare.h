/* Comparison of parts of assets. */
#ifndef SBFI_COMPARE_H
#define SBFI_COMPARE_H

#include "model/schema.h"

/* Whether all fields of two objects of the element, including descendants, are equal bit by bit; ignores
 * what asset equality ignores. */
bool sbfi_objects_equal(const sbfi_element *element, const void *a, const void *b);

#endif
