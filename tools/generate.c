#include "generate.h"

#include <errno.h>
#include <string.h>

#include "cli.h"

#define VERSION_TEXT_(a, b, c) #a "." #b "." #c
#define VERSION_TEXT(a, b, c) VERSION_TEXT_(a, b, c)
static const char version[] = VERSION_TEXT(SBF_VERSION_MAJOR, SBF_VERSION_MINOR, SBF_VERSION_PATCH);

static FILE *open_in(const char *folder, const char *name, const char *verb, const char *ending) {
  char path[4096];
  int length = snprintf(path, sizeof path, "%s/%s%s%s", folder, name, verb, ending);
  FILE *file = length > 0 && (size_t)length < sizeof path ? fopen(path, "w") : NULL;
  if (!file)
    fprintf(stderr, "sbfmt: error: cannot write %s%s%s into %s: %s\n", name, verb, ending, folder,
        strerror(errno));
  return file;
}

static int close_file(FILE *file) {
  if (fclose(file) == 0) return SBF_OK;
  fprintf(stderr, "sbfmt: error: a file could not be written: %s\n", strerror(errno));
  return SBF_FAILED;
}

/* Choices of an option's value, as in "y|z"; false if its argument names a kind of value. */
static bool has_words(const char *argument) {
  return argument && strchr(argument, '|') &&
         strcspn(argument, ".ABCDEFGHIJKLMNOPQRSTUVWXYZ") == strlen(argument);
}

static bool takes_folder(const char *argument) {
  return argument && strstr(argument, "DIR");
}

static bool takes_path(const char *argument) {
  return argument && (strstr(argument, "FILE") || strstr(argument, "OUT"));
}

/* The choices separated by blanks. */
static void put_words(FILE *file, const char *words) {
  for (; *words; words++) fputc(*words == '|' ? ' ' : *words, file);
}

/* ---- Manual pages, in the man macros ---- */

/* Text of a paragraph: escapes hyphens, backslashes and leading dots; `backquoted` words in bold. */
static void put_roff(FILE *file, const char *text) {
  bool line_start = true, bold = false;
  for (; *text; text++) {
    if (line_start && (*text == '.' || *text == '\'')) fputs("\\&", file);
    line_start = *text == '\n';
    if (*text == '-')
      fputs("\\-", file);
    else if (*text == '\\')
      fputs("\\e", file);
    else if (*text == '`')
      fputs((bold = !bold) ? "\\fB" : "\\fR", file);
    else
      fputc(*text, file);
  }
}

static void put_heading(FILE *file, const char *title) {
  fprintf(file, ".TH %s 1 \"\" \"sbfmt %s\" \"User Commands\"\n", title, version);
}

static void put_exit_status(FILE *file) {
  fputs(".SH EXIT STATUS\n.TP\n0\ngood\n.TP\n1\nthe input is at fault\n.TP\n2\nthe call or the machine is\n",
      file);
}

static void put_paragraphs(FILE *file, const char *text) {
  for (const char *end; *text; text = end) {
    end = strstr(text, "\n\n");
    size_t length = end ? (size_t)(end - text) : strlen(text);
    char piece[4096];
    snprintf(piece, sizeof piece, "%.*s", (int)length, text);
    put_roff(file, piece);
    fputs("\n", file);
    end = end ? end + 2 : text + length;
    if (*end) fputs(".PP\n", file);
  }
}

static void man_options(FILE *file, const cli_option *options) {
  for (const cli_option *o = options; o->name; o++) {
    fputs(".TP\n.B ", file);
    put_roff(file, o->name);
    if (o->argument) {
      fputs(" \\fI", file);
      put_roff(file, o->argument);
      fputs("\\fR", file);
    }
    fputc('\n', file);
    put_roff(file, o->help);
    fputc('\n', file);
  }
}

static int man_of_verb(const cli_verb *verb, const char *folder) {
  FILE *file = open_in(folder, "sbfmt-", verb->name, ".1");
  if (!file) return SBF_FAILED;
  char title[64];
  snprintf(title, sizeof title, "sbfmt\\-%s", verb->name);
  put_heading(file, title);
  fprintf(file, ".SH NAME\nsbfmt\\-%s \\- ", verb->name);
  put_roff(file, verb->summary);
  fprintf(file, "\n.SH SYNOPSIS\n.B sbfmt %s\n", verb->name);
  put_roff(file, verb->synopsis);
  fputs("\n.SH DESCRIPTION\n", file);
  put_paragraphs(file, verb->details);
  fputs(".SH OPTIONS\n", file);
  man_options(file, verb->options);
  man_options(file, cli_common_options);
  put_exit_status(file);
  fputs(".SH SEE ALSO\n.BR sbfmt (1)\n", file);
  return close_file(file);
}

static int man(const char *folder) {
  FILE *file = open_in(folder, "sbfmt", "", ".1");
  if (!file) return SBF_FAILED;
  put_heading(file, "SBFMT");
  fputs(".SH NAME\nsbfmt \\- soft\\-bodied characters in one file\n.SH SYNOPSIS\n.B sbfmt\n.I VERB ...\n"
        ".SH DESCRIPTION\nReads, checks, builds, converts, moves and draws files of the sbf format: .sbf is "
        "XML text, "
        ".sbfz the packed form.\n.SH VERBS\n",
      file);
  for (int i = 0; cli_verbs[i]; i++) {
    fprintf(file, ".TP\n.BR sbfmt\\-%s (1)\n", cli_verbs[i]->name);
    put_roff(file, cli_verbs[i]->summary);
    fputc('\n', file);
  }
  fputs(".SH OPTIONS\n.TP\n.B \\-\\-help\nthe list of verbs; behind a verb, what it takes\n"
        ".TP\n.B \\-\\-version\nthe version\n",
      file);
  put_exit_status(file);
  int status = close_file(file);
  for (int i = 0; cli_verbs[i]; i++)
    if (man_of_verb(cli_verbs[i], folder) != SBF_OK) status = SBF_FAILED;
  return status;
}

/* ---- bash ---- */

static void bash_value(FILE *file, const cli_option *o) {
  if (!o->argument) return;
  fprintf(file, "    %s)\n      ", o->name);
  if (has_words(o->argument)) {
    fputs("COMPREPLY=($(compgen -W \"", file);
    put_words(file, o->argument);
    fputs("\" -- \"$word\"))\n", file);
  } else if (takes_folder(o->argument)) {
    fputs("COMPREPLY=($(compgen -d -- \"$word\"))\n", file);
  } else if (takes_path(o->argument)) {
    fputs("COMPREPLY=($(compgen -f -- \"$word\"))\n", file);
  } else {
    fputs("COMPREPLY=()\n", file);
  }
  fputs("      return ;;\n", file);
}

static int bash(const char *folder) {
  FILE *file = open_in(folder, "sbfmt", "", "");
  if (!file) return SBF_FAILED;
  fputs("# bash completion of sbfmt, made by sbfmt --generate bash\n_sbfmt() {\n"
        "  local word=${COMP_WORDS[COMP_CWORD]} before=${COMP_WORDS[COMP_CWORD-1]} options=\n"
        "  COMPREPLY=()\n  if [ \"$COMP_CWORD\" -eq 1 ]; then\n    COMPREPLY=($(compgen -W \"",
      file);
  for (int i = 0; cli_verbs[i]; i++) fprintf(file, "%s ", cli_verbs[i]->name);
  fputs("--help --version\" -- \"$word\"))\n    return\n  fi\n  case ${COMP_WORDS[1]} in\n", file);
  for (int i = 0; cli_verbs[i]; i++) {
    const cli_option *options = cli_verbs[i]->options;
    fprintf(file, "  %s)\n    case $before in\n", cli_verbs[i]->name);
    for (const cli_option *o = options; o->name; o++) bash_value(file, o);
    fputs("    esac\n    options=\"", file);
    for (const cli_option *o = options; o->name; o++) fprintf(file, "%s ", o->name);
    for (const cli_option *o = cli_common_options; o->name; o++) fprintf(file, "%s ", o->name);
    fputs("--help\" ;;\n", file);
  }
  fputs("  esac\n  case $word in\n  -*) COMPREPLY=($(compgen -W \"$options\" -- \"$word\")) ;;\n"
        "  *) COMPREPLY=($(compgen -f -- \"$word\")) ;;\n  esac\n}\ncomplete -o filenames -F _sbfmt sbfmt\n",
      file);
  return close_file(file);
}

/* ---- zsh ---- */

/* Text inside single quotes of an _arguments specification. */
static void put_zsh(FILE *file, const char *text) {
  for (; *text; text++) {
    if (*text == '\'')
      fputs("'\\''", file);
    else if (strchr("[]:\\", *text))
      fprintf(file, "\\%c", *text);
    else
      fputc(*text, file);
  }
}

static void zsh_option(FILE *file, const cli_option *o) {
  fprintf(file, " \\\n      '*%s[", o->name);
  put_zsh(file, o->help);
  fputc(']', file);
  if (o->argument) {
    fputc(':', file);
    put_zsh(file, o->argument);
    fputc(':', file);
    if (has_words(o->argument)) {
      fputc('(', file);
      put_words(file, o->argument);
      fputc(')', file);
    } else if (takes_folder(o->argument)) {
      fputs("_files -/", file);
    } else if (takes_path(o->argument)) {
      fputs("_files", file);
    }
  }
  fputc('\'', file);
}

static int zsh(const char *folder) {
  FILE *file = open_in(folder, "_sbfmt", "", "");
  if (!file) return SBF_FAILED;
  fputs("#compdef sbfmt\n# zsh completion of sbfmt, made by sbfmt --generate zsh\n_sbfmt() {\n  local -a "
        "verbs\n"
        "  verbs=(\n",
      file);
  for (int i = 0; cli_verbs[i]; i++) {
    fprintf(file, "    '%s:", cli_verbs[i]->name);
    put_zsh(file, cli_verbs[i]->summary);
    fputs("'\n", file);
  }
  fputs("  )\n  if (( CURRENT == 2 )); then\n    _describe verb verbs\n    return\n  fi\n"
        "  local verb=$words[2]\n  shift words\n  (( CURRENT-- ))\n  case $verb in\n",
      file);
  for (int i = 0; cli_verbs[i]; i++) {
    fprintf(file, "  %s)\n    _arguments", cli_verbs[i]->name);
    for (const cli_option *o = cli_verbs[i]->options; o->name; o++) zsh_option(file, o);
    for (const cli_option *o = cli_common_options; o->name; o++) zsh_option(file, o);
    fputs(" \\\n      '--help[what the verb takes]' '*:file:_files' ;;\n", file);
  }
  fputs("  esac\n}\nif [ \"$funcstack[1]\" = _sbfmt ]; then\n  _sbfmt \"$@\"\nelse\n  compdef _sbfmt "
        "sbfmt\nfi\n",
      file);
  return close_file(file);
}

/* ---- fish ---- */

static void put_fish(FILE *file, const char *text) {
  for (; *text; text++) {
    if (*text == '\'' || *text == '\\') fputc('\\', file);
    fputc(*text, file);
  }
}

static void fish_option(FILE *file, const char *verb, const cli_option *o) {
  fprintf(file, "complete -c sbfmt -n '__fish_seen_subcommand_from %s' %s %s -d '", verb,
      o->name[1] == '-' ? "-l" : "-s", o->name + (o->name[1] == '-' ? 2 : 1));
  put_fish(file, o->help);
  fputc('\'', file);
  if (has_words(o->argument)) {
    fputs(" -x -a '", file);
    put_words(file, o->argument);
    fputc('\'', file);
  } else if (takes_folder(o->argument)) {
    fputs(" -x -a '(__fish_complete_directories)'", file);
  } else if (takes_path(o->argument)) {
    fputs(" -r -F", file);
  } else if (o->argument) {
    fputs(" -x", file);
  }
  fputc('\n', file);
}

static int fish(const char *folder) {
  FILE *file = open_in(folder, "sbfmt", "", ".fish");
  if (!file) return SBF_FAILED;
  fputs("# fish completion of sbfmt, made by sbfmt --generate fish\n", file);
  for (int i = 0; cli_verbs[i]; i++) {
    fprintf(file, "complete -c sbfmt -n __fish_use_subcommand -f -a %s -d '", cli_verbs[i]->name);
    put_fish(file, cli_verbs[i]->summary);
    fputs("'\n", file);
  }
  for (int i = 0; cli_verbs[i]; i++) {
    for (const cli_option *o = cli_verbs[i]->options; o->name; o++) fish_option(file, cli_verbs[i]->name, o);
    for (const cli_option *o = cli_common_options; o->name; o++) fish_option(file, cli_verbs[i]->name, o);
  }
  return close_file(file);
}

int generate_files(const char *what, const char *folder) {
  static const struct {
    const char *name;
    int (*make)(const char *folder);
  } makers[] = {{"man", man}, {"bash", bash}, {"zsh", zsh}, {"fish", fish}};
  for (size_t i = 0; i < sizeof makers / sizeof *makers; i++)
    if (strcmp(makers[i].name, what) == 0) return makers[i].make(folder);
  fprintf(stderr, "sbfmt: error: --generate makes man, bash, zsh or fish, not '%s'\n", what);
  return SBF_FAILED;
}
