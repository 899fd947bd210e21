/* What the passes of one build share: what is asked for, what is made so far, whom to tell.
 *
 * build.c runs the passes one after the other; each reads what those before it left here. */
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
  sbfi_interior_map *maps; /* (bodies) of the levels made */
  bool *made;              /* (bodies) the level is made here, the body's only one */
  uint32_t *frames;        /* (bodies) first frame point of the level made; SBFI_NO_INDEX: none */
  sbfi_sections sections;  /* cut here: the last of the bodies */
  uint32_t usual_elements; /* the most tetrahedra of a body that nobody sizes */
  sbfi_arena scratch;
  sbfi_ids ids;
  sbfi_reporter reporter;
  sbf_build_report report;
  sbf_diagnostic *error;
  const char *pass; /* that a stretch of it is told under */
  bool cancelled;
} sbfi_build;

/* Where memory ran out, or what `progress` was told ended the work: `error` then says so already. */
sbf_status sbfi_build_no_memory(sbfi_build *build);

/* Tells how much of the whole is done before that pass; not SBF_OK where the work is to end. */
sbf_status sbfi_build_report_progress(sbfi_build *build, const char *pass, double done);

/* For a pass that takes the stretch from `from` to `to` of the whole; one at a time. */
sbfi_progress sbfi_build_stretch(sbfi_build *build, const char *pass, double from, double to);

/* A finding about soft body `number`: reported, and SBF_OK, or where its code is an error's, the build's. */
sbf_status sbfi_build_report_of_body(sbfi_build *build, uint32_t number, sbf_code code, const char *format,
    ...) __attribute__((format(printf, 4, 5)));

#endif
