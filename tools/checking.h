/* A file checked against all rules, with its findings. */
#ifndef CHECKING_H
#define CHECKING_H

#include "cli.h"
#include "sbfmt/io.h"
#include "sbfmt/validate.h"

typedef struct findings {
  sbf_diagnostic *at;
  size_t count, capacity;
  bool lost; /* memory ran out: findings are counted, but not listed */
} findings;

void findings_add(findings *to, const sbf_diagnostic *diagnostic);
/* Callback: `user` is the findings. */
void findings_take(void *user, const sbf_diagnostic *diagnostic);
void findings_free(findings *f);

typedef struct checked {
  const char *path;
  findings found;
  sbf_validate_result result;
  sbf_status status; /* SBF_FAILED: the file could not be read, or memory ran out */
} checked;

/* Loads and checks a file. Thread safe on different results. */
void check_file(const char *path, checked *result);

/* Checks only the rules, for an asset whose file is, or will be, at `path`; without line numbers. */
void check_loaded(const sbf_asset *asset, const char *path, checked *result);

bool checked_is_valid(const checked *one, bool strict);

/* Prints the findings, or adds them to `messages` unless that is NULL. */
void checked_report(const cli_call *call, checked *one, json_t *messages);

#endif
