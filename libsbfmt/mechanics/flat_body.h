/* Closed surfaces without volume. */
#ifndef SBFI_FLAT_BODY_H
#define SBFI_FLAT_BODY_H

#include "sbfmt/model.h"

/* If the body's surface is closed but encloses nothing, such as a two-sided fin, and no mass is stated:
 * sets the area density of one layer of the body's thickness, half for each side. The body is then a
 * sheet; otherwise it would have no mass. Returns whether it was set. */
bool sbfi_flat_body_weigh(sbf_soft_body *body);

#endif
