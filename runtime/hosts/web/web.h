/* Shared parts of the WebAssembly library. Each WEB_CALL is exported to JavaScript under its own name;
 * sbfmt.js calls them, and programs use sbfmt.js. Addresses and counts have 32 bits there. */
#ifndef WEB_H
#define WEB_H

#include "sbfmt/packed.h"
#include "sbrun/animation.h"
#include "sbrun/collision.h"
#include "sbrun/events.h"
#include "sbrun/query.h"
#include "sbrun/rigid.h"

#define WEB_CALL(name) __attribute__((export_name(#name), visibility("default"))) name

/* Diagnostic of the last failure. */
sbf_diagnostic *web_failure(void);

#endif
