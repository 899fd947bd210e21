/* `--pin GROUP[=BONE]`, `--hold`, `--attach BODY=HULL`, `--shell OBJECT=BONE`, the bounds and stiffness of
 * goals, and softness (`--soft`, `--rigid`, `--firmness`), for sbf_convert. */
#ifndef PIN_OPTIONS_H
#define PIN_OPTIONS_H

#include "cli.h"
#include "sbfmt/convert.h"

#define PIN_OPTIONS                                                                                          \
  {"--pin", "GROUP[=BONE]",                                                                                  \
      "pin what a vertex group or a bone's weights name to a bone (that of its name, else the world); may "  \
      "be "                                                                                                  \
      "given again"},                                                                                        \
      {"--hold", "GROUP[=BONE]",                                                                             \
          "hold what a vertex group or a bone's weights name in the sections that a skin is cut into, by "   \
          "the "                                                                                             \
          "section's bone or that one; may be given again"},                                                 \
      {"--attach", "BODY=HULL",                                                                              \
          "let everything of a soft body inside the hull of another object, or of a bone's rigid body, be "  \
          "held by "                                                                                         \
          "it; that object is then a rigid body and no longer drawn; may be given again"},                   \
      {"--shell", "OBJECT[#N]=BONE",                                                                         \
          "let one bone of the rig move an object, or its shell number N; may be given again"},              \
      {"--soft", "BONE,...", "let what these bones hold of a skin be soft; '*': all; may be given again"},   \
      {"--rigid", "BONE,...", "let what these bones hold move with them; '*': all; may be given again"},     \
      {"--firmness", "X", "factor on the modulus of what becomes soft by itself (1)"},                       \
      {"--goal", "MIN,MAX", "bounds of pin weights; below 1 a pin is a goal spring (0,1)"}, {                \
    "--goal-stiffness", "N/M", "of a goal spring at weight 1 (by the body's modulus)"                        \
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
