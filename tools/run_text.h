/* The report of `sbfmt run` for people: a line a measure, with its unit. */
#ifndef RUN_TEXT_H
#define RUN_TEXT_H

#include <jansson.h>

void run_text_print(json_t *report);

#endif
