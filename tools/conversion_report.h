/* The report of `sbfmt convert --report`: one object, written as JSON or as a self-contained page. The keys
 * are those of spec/conversion.schema.json. */
#ifndef CONVERSION_REPORT_H
#define CONVERSION_REPORT_H

#include <jansson.h>
#include <stdio.h>

#include "sbfmt/convert.h"

typedef struct conversion_report {
  const char *input, *rig, *output;
  const sbf_convert_options *options;
  const sbf_convert_summary *summary;
  const sbf_asset *asset; /* as it was written */
  const json_t *messages; /* all that was said */
} conversion_report;

/* Whether a report can have this name: .html or .json. */
bool conversion_report_knows(const char *path);

/* The object; NULL where memory runs out. Draws the pictures, if it can. */
json_t *conversion_report_make(const conversion_report *of);

/* Into a file that is there whole or not at all; which form, its ending says. */
sbf_status conversion_report_write(const json_t *report, const char *path, sbf_diagnostic *error);

/* The page, to an open file; false where it cannot be written. */
bool conversion_page_print(const json_t *report, FILE *to);

#endif
