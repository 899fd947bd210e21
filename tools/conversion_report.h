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
  const sbf_asset *asset; /* as written */
  const json_t *messages; /* all messages */
} conversion_report;

/* Whether the name has a report's extension: .html or .json. */
bool conversion_report_supports(const char *path);

/* Creates the object; NULL if memory runs out. Draws the pictures if possible. */
json_t *conversion_report_make(const conversion_report *of);

/* Writes a file atomically; the extension selects the format. */
sbf_status conversion_report_write(const json_t *report, const char *path, sbf_diagnostic *error);

/* Prints the page to an open file; false if it cannot be written. */
bool conversion_page_print(const json_t *report, FILE *to);

#endif
