/* The samples of spec/samples, and loading texts that a test writes. */
#ifndef TEST_XML_SAMPLES_H
#define TEST_XML_SAMPLES_H

#include "harness.h"
#include "sbfmt/io.h"

/* Loads `text`; NULL with *error filled where that fails. */
sbf_asset *samples_load(const char *text, sbf_diagnostic *error);

/* A document of the current version around `inside`. Valid until the next call. */
const char *samples_document(const char *inside);

/* Fails the test unless loading `text` fails so; `path` NULL: any. */
void samples_expect(const char *text, sbf_code code, uint32_t line, const char *path, int64_t index);

/* Calls `each` with the path of every file of a folder of the checkout whose name has that ending, in order
 * of their names; returns how many there are. */
size_t samples_each(const char *folder, const char *ending, void (*each)(const char *path));

#endif
