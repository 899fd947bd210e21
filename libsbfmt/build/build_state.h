/* State shared by the passes of a build: options, results, and reports.
 *
 * build.c runs the passes one after the other; each reads the results of earlier ones here. */
#ifndef SBFI_BUILD_STATE_H
#define SBFI_BUILD_STATE_H

#include "base/diagnostic.h"
#include "base/progress.h"
#include "build/sections/sections.h"
#include "build/springs/spring_level.h"
#include "model/ids.h"
#include "sbfmt/build.h"

enum { SBFI_BUILD_DERIVATION = 0 }; /* a build has one entry in `derivations` */

typedef struct sbfi_build {
  sbf_build_options options;
  const sbf_asset *from;
  sbf_asset *asset; /* under construction */
  sbf_derivation *derivation;
  sbf_soft_body *bodies;
  uint32_t bodies_count;   /* of bodies */
  sbfi_interior_map *maps; /* (bodies) of the new levels */
  bool *made;              /* (bodies) the level was built here and is the body's only one */
  uint32_t *frames;        /* (bodies) first frame point of the new level; SBFI_NO_INDEX: none */
  sbfi_sections sections;  /* cut here: the last of the bodies */
  uint32_t usual_elements; /* maximum number of tetrahedra of a body with automatic size */
  sbfi_arena scratch;
  sbfi_ids ids;
  sbfi_reporter reporter;
  sbf_build_report report;
  sbf_diagnostic *error;
  const char *pass; /* name of the pass in progress reports */
  bool cancelled;
} sbfi_build;

/* Call if memory ran out, or `progress` cancelled the build, which has then set `error`. */
sbf_status sbfi_build_no_memory(sbfi_build *build);

/* Reports progress before a pass; not SBF_OK if the build is cancelled. */
sbf_status sbfi_build_report_progress(sbfi_build *build, const char *pass, double done);

/* Progress of a pass from `from` to `to` of the whole; one at a time. */
sbfi_progress sbfi_build_stretch(sbfi_build *build, const char *pass, double from, double to);

/* Reports a finding about soft body `number` and returns SBF_OK; or fails the build if its code is an error.
 */
sbf_status sbfi_build_report_of_body(sbfi_build *build, uint32_t number, sbf_code code, const char *format,
    ...) __attribute__((format(printf, 4, 5)));

#endif
