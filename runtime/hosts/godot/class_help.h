/* What the editor's help and the inspector's hints say of a class: made of its tables, and of words about
 * each of their names. */
#ifndef SBFMT_GODOT_CLASS_HELP_H
#define SBFMT_GODOT_CLASS_HELP_H

#include "classes.h"

/* Of a method, a property, a signal or a constant; plain text or Godot's BBCode. */
typedef struct gd_help {
  const char *name, *text;
} gd_help;

/* `about`: the class itself, its first sentence the short form. `words` end with an entry without a name; of
 * names that they lack, and of those that the class lacks, the log has an error. Once, when the editor
 * begins. */
void gd_class_set_help(const gd_class *form, const char *about, const gd_help *words);

/* ---- words.c ---- */

/* Help of all public classes. */
void words_set_help(void);

#endif
