/* sbfmt: one program with one file per verb. */
#include <stdlib.h>
#include <string.h>

#include "base/system.h"
#include "cli.h"
#include "generate.h"

#define VERSION_TEXT_(a, b, c) #a "." #b "." #c
#define VERSION_TEXT(a, b, c) VERSION_TEXT_(a, b, c)

static void print_help(void) {
  printf(
      "sbfmt: soft-bodied characters in one file\n\nUsage: sbfmt VERB ... (sbfmt VERB --help says more)\n\n");
  for (int i = 0; cli_verbs[i]; i++) printf("  %-10s %s\n", cli_verbs[i]->name, cli_verbs[i]->summary);
  printf("\nExit status: 0 good, 1 the input is at fault, 2 the call or the machine is.\n");
}

enum { HELP_COLUMN = 27, HELP_WIDTH = 100 };

/* Prints wrapped text from the column on; an empty line separates paragraphs. */
static void print_wrapped(const char *text, int column) {
  int at = column;
  while (*text) {
    int length = (int)strcspn(text, " \n");
    if (at > column && at + 1 + length > HELP_WIDTH) {
      printf("\n%*s", column, "");
      at = column;
    }
    if (at > column) at += printf(" ");
    at += printf("%.*s", length, text);
    text += length;
    if (strncmp(text, "\n\n", 2) == 0) {
      printf("\n\n%*s", column, "");
      at = column;
    }
    text += strspn(text, " \n");
  }
  printf("\n");
}

static void print_options(const cli_option *options) {
  for (const cli_option *o = options; o->name; o++) {
    int width = printf("  %s%s%s", o->name, o->argument ? " " : "", o->argument ? o->argument : "");
    if (width > HELP_COLUMN - 1) {
      printf("\n");
      width = 0;
    }
    printf("%*s", HELP_COLUMN - width, "");
    print_wrapped(o->help, HELP_COLUMN);
  }
}

static void print_verb_help(const cli_verb *verb) {
  printf("sbfmt %s: %s\n\nUsage: sbfmt %s %s\n\n", verb->name, verb->summary, verb->name, verb->synopsis);
  print_wrapped(verb->details, 0);
  printf("\n");
  print_options(verb->options);
  print_options(cli_common_options);
}

static const cli_verb *find_verb(const char *name) {
  for (int i = 0; cli_verbs[i]; i++)
    if (strcmp(cli_verbs[i]->name, name) == 0) return cli_verbs[i];
  return NULL;
}

/* Index of the option in an argument, and its value if written as --name=value. -1: not one of the verb's. */
static int find_option(const cli_verb *verb, const char *argument, const char **value) {
  size_t length = strcspn(argument, "=");
  *value = argument[length] ? argument + length + 1 : NULL;
  for (int i = 0; verb->options[i].name; i++)
    if (strlen(verb->options[i].name) == length && strncmp(verb->options[i].name, argument, length) == 0)
      return i;
  return -1;
}

/* Parses the arguments into options and inputs; false, with a message, if they are invalid for the verb. */
static bool parse(cli_call *call, int count, char **arguments) {
  const cli_verb *verb = call->verb;
  bool options_over = false;
  for (int i = 0; i < count; i++) {
    const char *argument = arguments[i], *value;
    bool is_option = !options_over && argument[0] == '-' && argument[1];
    if (strcmp(argument, "-") == 0) {
      cli_wrong(call, "standard input is not supported: use the name of a file instead of '-'");
      return false;
    }
    if (!is_option) {
      call->inputs[call->input_count++] = argument;
      continue;
    }
    if (strcmp(argument, "--") == 0) {
      options_over = true;
      continue;
    }
    if (strcmp(argument, "--verbose") == 0) {
      call->verbose = true;
      continue;
    }
    int index = find_option(verb, argument, &value);
    if (index < 0) {
      cli_wrong(call, "no option %s; see sbfmt %s --help", argument, verb->name);
      return false;
    }
    if (!verb->options[index].argument) {
      call->values[index] = "";
      continue;
    }
    if (!value && i + 1 == count) {
      cli_wrong(call, "%s needs a value: %s", argument, verb->options[index].argument);
      return false;
    }
    if (!value) value = arguments[++i];
    if (call->values[index] && strcmp(verb->options[index].name, "-o") == 0) {
      cli_wrong(
          call, "-o is given twice, as '%s' and '%s': a call writes one file", call->values[index], value);
      return false;
    }
    call->values[index] = value;
    call->given[call->given_count++] = (struct cli_given){index, call->values[index]};
  }
  bool too_many = verb->max_inputs >= 0 && call->input_count > verb->max_inputs;
  if (too_many) {
    cli_wrong(call, "unexpected input '%s'; usage: sbfmt %s %s", call->inputs[verb->max_inputs], verb->name,
        verb->synopsis);
    return false;
  }
  if (call->input_count < verb->min_inputs) {
    cli_wrong(call, "usage: sbfmt %s %s", verb->name, verb->synopsis);
    return false;
  }
  return true;
}

static int no_verb(const char *name) {
  fprintf(stderr, "sbfmt: error: no verb '%s'; sbfmt --help lists them\n", name);
  return SBF_FAILED;
}

/* `sbfmt help VERB` is `sbfmt VERB --help`. */
static int help(int argc, char **argv) {
  const cli_verb *verb = argc > 2 ? find_verb(argv[2]) : NULL;
  if (argc > 2 && !verb && argv[2][0] != '-') return no_verb(argv[2]);
  if (verb)
    print_verb_help(verb);
  else
    print_help();
  return argc < 2 ? SBF_FAILED : SBF_OK;
}

static int run_call(int argc, char **argv) {
  if (argc < 2 || strcmp(argv[1], "--help") == 0 || strcmp(argv[1], "help") == 0 ||
      strcmp(argv[1], "-h") == 0)
    return help(argc, argv);
  if (strcmp(argv[1], "--version") == 0) {
    printf("sbfmt %s\n", VERSION_TEXT(SBF_VERSION_MAJOR, SBF_VERSION_MINOR, SBF_VERSION_PATCH));
    return SBF_OK;
  }
  if (strcmp(argv[1], "--generate") == 0) {
    if (argc == 4) return generate_files(argv[2], argv[3]);
    fprintf(stderr, "sbfmt: error: usage: sbfmt --generate man|bash|zsh|fish DIR\n");
    return SBF_FAILED;
  }
  const cli_verb *verb = find_verb(argv[1]);
  if (!verb) return no_verb(argv[1]);
  for (int i = 2; i < argc; i++)
    if (strcmp(argv[i], "--help") == 0 || strcmp(argv[i], "-h") == 0) {
      print_verb_help(verb);
      return SBF_OK;
    }
  cli_call call = {.verb = verb,
      .inputs = calloc((size_t)argc, sizeof(char *)),
      .given = calloc((size_t)argc, sizeof *call.given)};
  if (!call.inputs || !call.given) return cli_wrong(&call, "out of memory");
  int status = SBF_FAILED;
  if (parse(&call, argc - 2, argv + 2)) {
    static const char *const formats[] = {"text", "json"};
    int format = 0;
    bool has_format = false;
    for (const cli_option *o = verb->options; o->name; o++) has_format |= strcmp(o->name, "--format") == 0;
    if (!has_format || cli_word(&call, "--format", formats, 2, &format)) {
      call.json = format == 1;
      status = verb->run(&call);
      cli_print_counted(&call);
    }
  }
  free(call.given);
  free(call.inputs);
  return status;
}

/* Checks that all output was written, to report a full disk for text and JSON. */
int main(int argc, char **argv) {
  system_begin(argc, argv);
  int status = run_call(argc, argv);
  if (fflush(stdout) == 0 && !ferror(stdout)) return status;
  fprintf(stderr, "sbfmt: error: standard output could not be written (is the disk full?)\n");
  return SBF_FAILED;
}
