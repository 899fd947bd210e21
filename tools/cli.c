#include "cli.h"

#include <ctype.h>
#include <math.h>
#include <stdarg.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

#include "sbfmt/codes.h"

const cli_option cli_common_options[] = {
    {"--verbose", NULL, "print every finding (otherwise the first of each kind, and a count)"},
    {NULL, NULL, NULL},
};

const char *cli_value(const cli_call *call, const char *name) {
  for (int i = 0; call->verb->options[i].name; i++)
    if (strcmp(call->verb->options[i].name, name) == 0) return call->values[i];
  abort(); /* the verb's table lacks the option */
}

const char *cli_next_value(const cli_call *call, const char *name, int *at) {
  while (*at < call->given_count) {
    const struct cli_given *given = &call->given[(*at)++];
    if (strcmp(call->verb->options[given->index].name, name) == 0) return given->value;
  }
  return NULL;
}

bool cli_switch(const cli_call *call, const char *name) {
  return cli_value(call, name) != NULL;
}

int cli_wrong(const cli_call *call, const char *format, ...) {
  va_list arguments;
  cli_print_counted(call);
  va_start(arguments, format);
  fprintf(stderr, "sbfmt %s: error: ", call->verb->name);
  vfprintf(stderr, format, arguments);
  fprintf(stderr, "\n");
  va_end(arguments);
  return SBF_FAILED;
}

bool cli_number(const cli_call *call, const char *name, double min, double max, double *value) {
  const char *text = cli_value(call, name);
  if (!text) return true;
  char *end;
  double read = strtod(text, &end);
  if (end == text || *end || !isfinite(read) || read < min || read > max) {
    cli_wrong(call, "%s takes a number from %g to %g, not '%s'", name, min, max, text);
    return false;
  }
  *value = read;
  return true;
}

bool cli_integer(const cli_call *call, const char *name, long min, long max, long *value) {
  const char *text = cli_value(call, name);
  if (!text) return true;
  char *end;
  long read = strtol(text, &end, 10);
  if (end == text || *end || read < min || read > max) {
    cli_wrong(call, "%s takes a whole number from %ld to %ld, not '%s'", name, min, max, text);
    return false;
  }
  *value = read;
  return true;
}

bool cli_word(const cli_call *call, const char *name, const char *const *words, int count, int *value) {
  const char *text = cli_value(call, name);
  if (!text) return true;
  for (int i = 0; i < count; i++)
    if (strcmp(text, words[i]) == 0) {
      *value = i;
      return true;
    }
  fprintf(stderr, "sbfmt %s: error: %s takes one of", call->verb->name, name);
  for (int i = 0; i < count; i++) fprintf(stderr, "%s %s", i ? "," : "", words[i]);
  fprintf(stderr, ", not '%s'\n", text);
  return false;
}

static const char *severity_word(sbf_severity severity) {
  static const char *const words[] = {"error", "warning", "info"};
  return (unsigned)severity < 3 ? words[severity] : "error";
}

static const char *code_name(int32_t code) {
  const sbf_code_info *info = sbf_code_find(code);
  return info ? info->name : "NONE";
}

void cli_keep_diagnostic(const cli_call *call, const sbf_diagnostic *d) {
  if (call->messages) json_array_append_new(call->messages, cli_diagnostic_json(d));
}

static void print_finding(const cli_call *call, const sbf_diagnostic *d) {
  cli_progress_end();
  fprintf(stderr, "sbfmt %s: %s: ", call->verb->name, severity_word(d->severity));
  if (d->file[0]) fprintf(stderr, "%s:", d->file);
  if (d->line) fprintf(stderr, "%u:", d->line);
  if (d->file[0] || d->line) fprintf(stderr, " ");
  fprintf(stderr, "%s [%s]", d->message, code_name(d->code));
  if (d->path[0]) fprintf(stderr, " at %s", d->path);
  if (d->index >= 0) fprintf(stderr, " item %lld", (long long)d->index);
  if (d->offset >= 0 && !d->line) fprintf(stderr, " byte %lld", (long long)d->offset);
  fprintf(stderr, "\n");
}

/* Findings of one kind in the current file: with one code and messages that differ only in names and
 * numbers. */
typedef struct counted {
  sbf_diagnostic first, last;
  uint32_t count; /* findings after the first, which was printed */
} counted;
static counted *counts;
static size_t kind_count;

static bool is_letter(char c) {
  return isalnum((unsigned char)c) != 0;
}

/* Skips a quoted name or a number at the start of the text; `before` is the preceding character. */
static const char *skip_name(const char *text, char before) {
  if (isdigit((unsigned char)*text)) return text + strspn(text, "0123456789.e+-");
  if ((*text != '"' && *text != '\'') || is_letter(before)) return text;
  const char *end = strchr(text + 1, *text);
  return end ? end + 1 : text;
}

static bool is_alike(const char *a, const char *b) {
  char before = ' ';
  for (;; before = *a, a++, b++) {
    const char *behind_a = skip_name(a, before), *behind_b = skip_name(b, before);
    if ((behind_a != a) != (behind_b != b)) return false;
    a = behind_a, b = behind_b;
    if (*a != *b) return false;
    if (!*a) return true;
  }
}

/* True if a finding of that kind was printed before: then it is only counted. */
static bool count_repeated(const sbf_diagnostic *d) {
  for (size_t i = 0; i < kind_count; i++)
    if (counts[i].first.code == d->code && is_alike(counts[i].first.message, d->message)) {
      counts[i].count++;
      counts[i].last = *d;
      return true;
    }
  counted *grown = realloc(counts, (kind_count + 1) * sizeof *grown);
  if (!grown) return false; /* prints each one */
  counts = grown;
  counts[kind_count++] = (counted){.first = *d};
  return false;
}

void cli_print_diagnostic(const cli_call *call, const sbf_diagnostic *d) {
  cli_keep_diagnostic(call, d);
  bool is_foldable = d->severity != SBF_SEVERITY_ERROR && !call->verbose;
  if (!is_foldable || !count_repeated(d)) print_finding(call, d);
}

void cli_print_counted(const cli_call *call) {
  for (size_t i = 0; i < kind_count; i++) {
    const counted *c = &counts[i];
    if (c->count == 1) print_finding(call, &c->last);
    if (c->count < 2) continue;
    cli_progress_end();
    fprintf(stderr, "sbfmt %s: %s: %u more findings of this kind, which --verbose prints [%s]\n",
        call->verb->name, severity_word(c->last.severity), (unsigned)c->count, code_name(c->last.code));
  }
  free(counts);
  counts = NULL;
  kind_count = 0;
}

void cli_report(void *call, const sbf_diagnostic *d) {
  cli_print_diagnostic(call, d);
}

json_t *cli_diagnostic_json(const sbf_diagnostic *d) {
  json_t *object = json_pack("{s:s, s:s, s:s, s:s}", "code", code_name(d->code), "severity",
      severity_word(d->severity), "message", d->message, "path", d->path);
  if (d->file[0]) json_object_set_new(object, "file", json_string(d->file));
  if (d->line)
    json_object_set_new(object, "line", json_integer(d->line));
  else if (d->offset >= 0)
    json_object_set_new(object, "offset", json_integer(d->offset));
  if (d->index >= 0) json_object_set_new(object, "index", json_integer(d->index));
  return object;
}

int cli_print_json(json_t *object, int status) {
  char *text = object ? json_dumps(object, JSON_INDENT(2) | JSON_REAL_PRECISION(9)) : NULL;
  json_decref(object);
  if (text) {
    puts(text);
  } else {
    fprintf(stderr, "sbfmt: error: memory ran out for the report\n");
    status = SBF_FAILED;
  }
  free(text);
  return status;
}

static bool progress_shown;

void cli_progress(const char *what, double fraction) {
  if (!isatty(STDERR_FILENO)) return;
  fprintf(stderr, "\r\033[K%s %3.0f %%", what, 100 * fraction);
  fflush(stderr);
  progress_shown = true;
}

void cli_progress_end(void) {
  if (progress_shown) fprintf(stderr, "\r\033[K");
  progress_shown = false;
}
