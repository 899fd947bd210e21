/* What the pieces of the WebAssembly library share. Each WEB_CALL is seen from JavaScript under its own name;
 * sbfmt.js is what calls them, and the one that programs are to use. Addresses and counts are 32 bits there.
 */
#ifndef WEB_H
#define WEB_H

#include "sbfmt/packed.h"
#include "sbrun/animation.h"
#include "sbrun/collision.h"
#include "sbrun/events.h"
#include "sbrun/query.h"
#include "sbrun/rigid.h"

#define WEB_CALL(name) __attribute__((export_name(#name), visibility("default"))) name

/* Where the last failure is written to. */
sbf_diagnostic *web_failure(void);

#endif
