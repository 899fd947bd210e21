/* Prints the report of `sbfmt run` as text: one line per measure, with units. */
#ifndef RUN_TEXT_H
#define RUN_TEXT_H

#include <jansson.h>

void run_text_print(json_t *report);

#endif
