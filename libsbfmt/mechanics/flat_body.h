/* Closed surfaces that enclose nothing. */
#ifndef SBFI_FLAT_BODY_H
#define SBFI_FLAT_BODY_H

#include "sbfmt/model.h"

/* Where the body's surface is closed and encloses nothing, as a fin that is drawn from both sides, and no
 * mass is stated: states the area density of one layer of the body's thickness, half of it for each side.
 * The body is then a sheet. Without it, it would have no mass. Returns whether it was stated. */
bool sbfi_flat_body_weigh(sbf_soft_body *body);

#endif
