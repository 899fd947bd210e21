#include "pin_options.h"

#include <stdlib.h>
#include <string.h>

static bool read_goal(const cli_call *call, sbf_convert_options *options) {
  const char *text = cli_value(call, "--goal");
  char *end;
  if (!text) return true;
  double min = strtod(text, &end), max = *end == ',' ? strtod(end + 1, &end) : -1;
  if (end != text && !*end && min >= 0 && max > 0 && max <= 1 && min <= max) {
    options->pinning.goal_minimum = min;
    options->pinning.goal_maximum = max;
    return true;
  }
  cli_wrong(call, "--goal takes two numbers from 0 to 1, for example 0.2,0.7, not '%s'", text);
  return false;
}

/* Values of one option, in allocated memory. */
static bool read_names(
    const cli_call *call, const char *option, sbf_convert_pin **pins, char **text, uint32_t *count) {
  const char *value;
  size_t size = 1;
  *count = 0;
  for (int at = 0; (value = cli_next_value(call, option, &at)); ++*count) size += strlen(value) + 1;
  *pins = calloc(*count + 1, sizeof **pins);
  *text = malloc(size);
  if (!*pins || !*text) {
    cli_wrong(call, "out of memory");
    return false;
  }
  char *next = *text;
  *count = 0;
  for (int at = 0; (value = cli_next_value(call, option, &at)); ++*count) {
    size_t length = strlen(value) + 1;
    memcpy(next, value, length);
    char *equals = strrchr(next, '=');
    if (equals) *equals++ = 0;
    (*pins)[*count] = (sbf_convert_pin){next, equals && strcmp(equals, "world") == 0 ? "" : equals};
    next += length;
  }
  return true;
}

static bool read_attachments(const cli_call *call, pin_options *pins, sbf_convert_options *options) {
  sbf_convert_pin *pairs;
  bool good = read_names(call, "--attach", &pairs, &pins->attached_text, &options->attachment_count);
  if (good) pins->attachments = calloc(options->attachment_count + 1, sizeof *pins->attachments);
  for (uint32_t i = 0; good && pins->attachments && i < options->attachment_count; i++) {
    pins->attachments[i] = (sbf_convert_attachment){pairs[i].group, pairs[i].bone};
    if (pairs[i].bone && pairs[i].bone[0]) continue;
    cli_wrong(call,
        "--attach takes a soft body and the object or bone to attach it to, for example --attach belly=ribs, "
        "not '%s'",
        pairs[i].group);
    good = false;
  }
  if (good && !pins->attachments) cli_wrong(call, "out of memory");
  options->attachments = pins->attachments;
  free(pairs);
  return good && pins->attachments;
}

static bool read_shells(const cli_call *call, pin_options *pins, sbf_convert_options *options) {
  if (!read_names(call, "--shell", &pins->shells, &pins->shell_text, &options->rigging.shell_count))
    return false;
  options->rigging.shells = pins->shells;
  for (uint32_t i = 0; i < options->rigging.shell_count; i++) {
    if (pins->shells[i].bone && pins->shells[i].bone[0]) continue;
    cli_wrong(call,
        "--shell takes an object and the bone that moves it, for example --shell hat=head, not '%s'",
        pins->shells[i].group);
    return false;
  }
  return true;
}

/* Comma separated names in all values of the option, in allocated memory. */
static bool read_bones(
    const cli_call *call, const char *option, const char ***bones, char **text, uint32_t *count) {
  const char *value;
  size_t size = 1, max = 1;
  for (int at = 0; (value = cli_next_value(call, option, &at));) {
    size += strlen(value) + 1;
    max += strlen(value) + 1;
  }
  *bones = calloc(max, sizeof **bones);
  *text = malloc(size);
  if (!*bones || !*text) {
    cli_wrong(call, "out of memory");
    return false;
  }
  char *next = *text;
  *count = 0;
  for (int at = 0; (value = cli_next_value(call, option, &at));) {
    memcpy(next, value, strlen(value) + 1);
    for (char *name = strtok(next, ","); name; name = strtok(NULL, ",")) (*bones)[(*count)++] = name;
    next += strlen(value) + 1;
  }
  return true;
}

static bool read_softness(const cli_call *call, pin_options *pins, sbf_convert_options *options) {
  bool good = cli_number(call, "--firmness", 1e-3, 1e3, &options->softness.firmness) &&
              read_bones(call, "--soft", &pins->soft, &pins->soft_text, &options->softness.soft_count) &&
              read_bones(call, "--rigid", &pins->rigid, &pins->rigid_text, &options->softness.rigid_count);
  options->softness.soft = pins->soft;
  options->softness.rigid = pins->rigid;
  return good;
}

bool pin_options_read(const cli_call *call, pin_options *pins, sbf_convert_options *options) {
  *pins = (pin_options){.pins = NULL};
  if (!read_names(call, "--pin", &pins->pins, &pins->text, &options->pinning.pin_count) ||
      !read_names(call, "--hold", &pins->holds, &pins->pin_text, &options->pinning.section_pin_count) ||
      !read_attachments(call, pins, options) || !read_shells(call, pins, options) ||
      !read_softness(call, pins, options))
    return false;
  options->pinning.pins = pins->pins;
  options->pinning.section_pins = pins->holds;
  return read_goal(call, options) &&
         cli_number(call, "--goal-stiffness", 0, 1e9, &options->pinning.goal_stiffness);
}

void pin_options_free(pin_options *pins) {
  free(pins->soft);
  free(pins->rigid);
  free(pins->soft_text);
  free(pins->rigid_text);
  free(pins->pins);
  free(pins->text);
  free(pins->holds);
  free(pins->pin_text);
  free(pins->shells);
  free(pins->shell_text);
  free(pins->attachments);
  free(pins->attached_text);
}
