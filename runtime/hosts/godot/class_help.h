/* Help texts of classes in the editor and inspector: built from the class tables, and from texts for each of
 * their names. */
#ifndef SBFMT_GODOT_CLASS_HELP_H
#define SBFMT_GODOT_CLASS_HELP_H

#include "classes.h"

/* Text for a method, a property, a signal or a constant; plain text or Godot's BBCode. */
typedef struct gd_help {
  const char *name, *text;
} gd_help;

/* `about`: text of the class, its first sentence is the short form. `words` end with an entry without a name;
 * the log has an error for each name that they lack, and for each one that the class lacks. Call once, when
 * the editor begins. */
void gd_class_set_help(const gd_class *form, const char *about, const gd_help *words);

/* ---- words.c ---- */

/* Help of all public classes. */
void words_set_help(void);

#endif
