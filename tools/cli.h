/* The command line: a table of verbs, each with its options, from which parsing, help, manual pages and shell
 * completion all come. */
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
  const char *synopsis;       /* behind `sbfmt NAME` */
  const char *summary;        /* one line */
  const char *details;        /* paragraphs for --help and the manual page */
  const cli_option *options;  /* ends with a name of NULL */
  int min_inputs, max_inputs; /* positional arguments; most -1: any number */
  int (*run)(cli_call *call); /* exit status */
} cli_verb;

enum { CLI_MAX_OPTIONS = 64 };
struct cli_call {
  const cli_verb *verb;
  const char **inputs;
  int input_count;
  const char *values[CLI_MAX_OPTIONS]; /* by place in verb->options; NULL: not given; "" for a switch */
  struct cli_given {                   /* every option with a value as it was given, in order */
    int index;
    const char *value;
  } * given;
  int given_count;
  bool json;        /* --format json */
  bool verbose;     /* --verbose, which every verb takes */
  json_t *messages; /* where not NULL: every diagnostic printed is added to this list */
};

extern const cli_verb *const cli_verbs[]; /* ends with NULL */

/* Options that every verb takes beside its own; ends with a name of NULL. */
extern const cli_option cli_common_options[];

/* What was given for an option; NULL if it was not. `name` must be one of the verb's. */
const char *cli_value(const cli_call *call, const char *name);
bool cli_switch(const cli_call *call, const char *name);

/* The values of an option that may be given several times, in order: begin with *at 0; NULL after the last.
 */
const char *cli_next_value(const cli_call *call, const char *name, int *at);

/* Numbers and words among the options: false, with a message, where the value is not one in [min, max]. */
bool cli_number(const cli_call *call, const char *name, double min, double max, double *value);
bool cli_integer(const cli_call *call, const char *name, long min, long max, long *value);
bool cli_word(const cli_call *call, const char *name, const char *const *words, int count, int *value);

/* One line on standard error, `sbfmt VERB: error: …`; returns SBF_FAILED, the status for a wrong call. */
int cli_wrong(const cli_call *call, const char *format, ...) __attribute__((format(printf, 2, 3)));

/* A diagnostic on standard error, and in `messages`. Of warnings and notes with one code, whose messages
 * differ in names and numbers alone, the first is printed and the others are counted, unless the call is
 * verbose. */
void cli_print_diagnostic(const cli_call *call, const sbf_diagnostic *diagnostic);
/* At the end of a file: prints the number of findings that were only counted, a line a kind, and resets it.
 */
void cli_print_counted(const cli_call *call);
/* cli_print_diagnostic as a callback, `call` a cli_call: for `report` of loads and the like. */
void cli_report(void *call, const sbf_diagnostic *diagnostic);
/* For `messages` alone. */
void cli_keep_diagnostic(const cli_call *call, const sbf_diagnostic *diagnostic);
json_t *cli_diagnostic_json(const sbf_diagnostic *diagnostic);

/* Prints the object on standard output, and nothing else; frees it. Returns `status`. */
int cli_print_json(json_t *object, int status);

/* A line that overwrites itself on a terminal, and says nothing elsewhere. `fraction` 0..1; cli_progress_end
 * clears it. */
void cli_progress(const char *what, double fraction);
void cli_progress_end(void);

#endif
