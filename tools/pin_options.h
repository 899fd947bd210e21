/* `--pin GROUP[=BONE]`, `--hold`, `--attach BODY=HULL`, `--shell OBJECT=BONE`, the bounds and stiffness of
 * goals, and softness (`--soft`, `--rigid`, `--firmness`), for sbf_convert. */
#ifndef PIN_OPTIONS_H
#define PIN_OPTIONS_H

#include "cli.h"
#include "sbfmt/convert.h"

#define PIN_OPTIONS                                                                                          \
  {"--pin", "GROUP[=BONE]",                                                                                  \
      "pin a vertex group, or points with weights on a bone, to a bone (the one of that name, else the "     \
      "world); repeatable"},                                                                                 \
      {"--hold", "GROUP[=BONE]",                                                                             \
          "pin a vertex group, or points with weights on a bone, in the sections cut from a skin, to the "   \
          "section's bone or the named one; repeatable"},                                                    \
      {"--attach", "BODY=HULL",                                                                              \
          "attach the points of a soft body inside the hull of another object, or of a bone's rigid body, "  \
          "to it; that object becomes a rigid body and is no longer drawn; repeatable"},                     \
      {"--shell", "OBJECT[#N]=BONE",                                                                         \
          "move an object, or its shell number N, with one bone of the rig; repeatable"},                    \
      {"--soft", "BONE,...", "make the parts of the skin on these bones soft; '*': all; repeatable"},        \
      {"--rigid", "BONE,...",                                                                                \
          "let the parts of the skin on these bones move rigidly with them; '*': all; repeatable"},          \
      {"--firmness", "X", "factor on the modulus of parts that are made soft automatically (1)"},            \
      {"--goal", "MIN,MAX", "bounds of pin weights; below 1 a pin is a goal spring (0,1)"}, {                \
    "--goal-stiffness", "N/M", "stiffness of a goal spring at weight 1 (from the body's modulus)"            \
  }

typedef struct pin_options {
  sbf_convert_pin *pins, *holds, *shells;
  sbf_convert_attachment *attachments;
  const char **soft, **rigid;                         /* bones */
  char *text, *pin_text, *attached_text, *shell_text; /* storage of all names */
  char *soft_text, *rigid_text;
} pin_options;

/* Sets the pins of the command line in `*options`; "world" or an empty value means the world. Returns
 * false, with a message, if a value is wrong. Free `*pins` in either case. */
bool pin_options_read(const cli_call *call, pin_options *pins, sbf_convert_options *options);
void pin_options_free(pin_options *pins);

#endif
