/* Command line: a table of verbs with their options, from which parsing, help, manual pages and shell
 * completion are generated. */
#ifndef CLI_H
#define CLI_H

#include <jansson.h>
#include <stdio.h>

#include "sbfmt/base.h"

typedef struct cli_option {
  const char *name;     /* as "--rig" or "-o" */
  const char *argument; /* name of its value, as "FILE"; NULL for a switch */
  const char *help;
} cli_option;

typedef struct cli_call cli_call;

typedef struct cli_verb {
  const char *name;
  const char *synopsis;       /* text after `sbfmt NAME` */
  const char *summary;        /* one line */
  const char *details;        /* paragraphs for --help and the manual page */
  const cli_option *options;  /* ends with a name of NULL */
  int min_inputs, max_inputs; /* positional arguments; maximum -1: any number */
  int (*run)(cli_call *call); /* exit status */
} cli_verb;

enum { CLI_MAX_OPTIONS = 64 };
struct cli_call {
  const cli_verb *verb;
  const char **inputs;
  int input_count;
  const char *values[CLI_MAX_OPTIONS]; /* by index in verb->options; NULL: absent; "" for a switch */
  struct cli_given {                   /* every option with a value, in command line order */
    int index;
    const char *value;
  } * given;
  int given_count;
  bool json;        /* --format json */
  bool verbose;     /* --verbose, which every verb takes */
  json_t *messages; /* receives every printed diagnostic unless NULL */
};

extern const cli_verb *const cli_verbs[]; /* ends with NULL */

/* Options that every verb accepts in addition to its own; ends with a name of NULL. */
extern const cli_option cli_common_options[];

/* Value of an option; NULL if absent. `name` must be one of the verb's. */
const char *cli_value(const cli_call *call, const char *name);
bool cli_switch(const cli_call *call, const char *name);

/* Values of a repeatable option, in order: start with *at 0; NULL after the last. */
const char *cli_next_value(const cli_call *call, const char *name, int *at);

/* Numbers and words of options: false, with a message, if the value is not in [min, max]. */
bool cli_number(const cli_call *call, const char *name, double min, double max, double *value);
bool cli_integer(const cli_call *call, const char *name, long min, long max, long *value);
bool cli_word(const cli_call *call, const char *name, const char *const *words, int count, int *value);

/* Prints one line to standard error, `sbfmt VERB: error: …`; returns SBF_FAILED, the status of a wrong
 * call. */
int cli_wrong(const cli_call *call, const char *format, ...) __attribute__((format(printf, 2, 3)));

/* Prints a diagnostic to standard error, and adds it to `messages`. Among warnings and notes with one
 * code, whose messages differ only in names and numbers, prints the first and counts the others, unless
 * the call is verbose. */
void cli_print_diagnostic(const cli_call *call, const sbf_diagnostic *diagnostic);
/* At the end of a file: prints the number of findings that were only counted, one line per kind, and
 * resets it. */
void cli_print_counted(const cli_call *call);
/* cli_print_diagnostic as a callback for `report`; `call` is a cli_call. */
void cli_report(void *call, const sbf_diagnostic *diagnostic);
/* Adds it to `messages` only. */
void cli_keep_diagnostic(const cli_call *call, const sbf_diagnostic *diagnostic);
json_t *cli_diagnostic_json(const sbf_diagnostic *diagnostic);

/* Prints the object alone to standard output and frees it. Returns `status`. */
int cli_print_json(json_t *object, int status);

/* A line that overwrites itself on a terminal; prints nothing elsewhere. `fraction` 0..1; cli_progress_end
 * clears it. */
void cli_progress(const char *what, double fraction);
void cli_progress_end(void);

#endif
