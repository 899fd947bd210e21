#include "build/build_settings.h"

#include <stddef.h>
#include <stdio.h>

#include "base/diagnostic.h"
#include "base/number.h"
#include "base/text.h"
#include "build/levels/level_set.h"
#include "build/render/render_levels.h"

typedef enum setting_kind {
  WITHOUT,     /* bool, recorded as its opposite */
  UNLESS,      /* the same, recorded if it is false */
  INTERIOR,    /* sbf_build_interior, by name */
  SECTIONS,    /* sbf_build_sections, by name; automatic is not recorded */
  COUNT,       /* uint32_t; 0 is not recorded */
  MICROMETRES, /* double, metres; 0 is not recorded. Integers parse equally everywhere */
} setting_kind;

/* Settings that affect the result, in alphabetical order, for writing and reading. */
static const struct {
  const char *name;
  setting_kind kind;
  size_t offset;
} settings[] = {
    {"calibration", UNLESS, offsetof(sbf_build_options, without_calibration)},
    {"cell_um", MICROMETRES, offsetof(sbf_build_options, cell_m)},
    {"elements", COUNT, offsetof(sbf_build_options, elements)},
    {"embeddings", WITHOUT, offsetof(sbf_build_options, without_embeddings)},
    {"error_um", MICROMETRES, offsetof(sbf_build_options, error_m)},
    {"flexion", WITHOUT, offsetof(sbf_build_options, without_flexion)},
    {"hulls", WITHOUT, offsetof(sbf_build_options, without_hulls)},
    {"interior", INTERIOR, offsetof(sbf_build_options, interior)},
    {"levels", COUNT, offsetof(sbf_build_options, levels)},
    {"overlap_um", MICROMETRES, offsetof(sbf_build_options, overlap_m)},
    {"render_error_um", MICROMETRES, offsetof(sbf_build_options, render_error_m)},
    {"render_levels", COUNT, offsetof(sbf_build_options, render_levels)},
    {"sections", SECTIONS, offsetof(sbf_build_options, sections)},
};
enum { SETTING_COUNT = sizeof settings / sizeof *settings };

static const char *const interior_words[SBFI_BUILD_INTERIOR_COUNT] = {
    "automatic", "centroid", "none", "lattice", "brute", "tetrahedra", "shape_matching"};

static const double max_um = 4e9; /* fits into 32 bits */

double sbfi_build_settings_cell(double cell_m) {
  if (!(cell_m > 0)) return 0;
  double um = cell_m * 1e6;
  if (!(um < max_um)) return max_um / 1e6;
  uint32_t whole = (uint32_t)(um + 0.5);
  return (whole ? whole : 1) / 1e6;
}

void sbfi_build_settings_write(const sbf_build_options *options, char text[SBFI_BUILD_SETTINGS_SIZE]) {
  size_t length = 0;
  text[0] = 0;
  for (int i = 0; i < SETTING_COUNT; i++) {
    const void *field = (const char *)options + settings[i].offset;
    const char *word = NULL;
    uint32_t number = 0;
    switch (settings[i].kind) {
    case UNLESS:
      word = *(const bool *)field ? "false" : NULL;
      break;
    case WITHOUT:
      word = *(const bool *)field ? "false" : "true";
      break;
    case INTERIOR:
      word = interior_words[*(const sbf_build_interior *)field];
      break;
    case SECTIONS:
      if (*(const sbf_build_sections *)field == SBF_BUILD_SECTIONS_NONE) word = "none";
      break;
    case COUNT:
      number = *(const uint32_t *)field;
      break;
    case MICROMETRES:
      number = (uint32_t)(sbfi_build_settings_cell(*(const double *)field) * 1e6 + 0.5);
      break;
    }
    if (!word && !number) continue;
    int written = word ? snprintf(text + length, SBFI_BUILD_SETTINGS_SIZE - length, "%s%s=%s",
                             length ? " " : "", settings[i].name, word)
                       : snprintf(text + length, SBFI_BUILD_SETTINGS_SIZE - length, "%s%s=%u",
                             length ? " " : "", settings[i].name, (unsigned)number);
    length += (size_t)written;
  }
}

static bool read_flag(sbfi_span value, bool *without) {
  *without = sbfi_span_is(value, "false");
  return *without || sbfi_span_is(value, "true");
}

static bool read_interior(sbfi_span value, sbf_build_interior *interior) {
  for (int i = 0; i < SBFI_BUILD_INTERIOR_COUNT; i++)
    if (sbfi_span_is(value, interior_words[i])) {
      *interior = (sbf_build_interior)i;
      return true;
    }
  return false;
}

static bool read_number(sbfi_span value, uint32_t *number) {
  return sbfi_parse_u32(value.at, value.length, number) == SBFI_NUMBER_READ && *number > 0;
}

static bool read_setting(setting_kind kind, sbfi_span value, void *field) {
  uint32_t number;
  switch (kind) {
  case UNLESS:
  case WITHOUT:
    return read_flag(value, field);
  case INTERIOR:
    return read_interior(value, field);
  case SECTIONS:
    *(sbf_build_sections *)field = SBF_BUILD_SECTIONS_NONE;
    return sbfi_span_is(value, "none");
  case COUNT:
    return read_number(value, field);
  case MICROMETRES:
    if (!read_number(value, &number)) return false;
    *(double *)field = number / 1e6;
    return true;
  }
  return false;
}

bool sbfi_build_settings_read(const char *text, sbf_build_options *options) {
  sbfi_span rest = sbfi_span_of(text), word;
  while (sbfi_span_next_word(&rest, &word)) {
    size_t equals = 0;
    while (equals < word.length && word.at[equals] != '=') equals++;
    if (equals == word.length) return false;
    sbfi_span name = {word.at, equals}, value = {word.at + equals + 1, word.length - equals - 1};
    int i = 0;
    while (i < SETTING_COUNT && !sbfi_span_is(name, settings[i].name)) i++;
    if (i == SETTING_COUNT || !read_setting(settings[i].kind, value, (char *)options + settings[i].offset))
      return false;
  }
  return true;
}

static bool is_length(double metres) {
  return metres >= 0 && metres <= 1e9;
}

sbf_status sbfi_build_settings_check(sbf_build_options *o, sbf_diagnostic *error) {
  if ((unsigned)o->interior >= SBFI_BUILD_INTERIOR_COUNT)
    return sbfi_diagnose(error, SBF_CODE_BAD_CALL, "the build options have an unknown interior method");
  if ((unsigned)o->sections > SBF_BUILD_SECTIONS_NONE || !is_length(o->overlap_m))
    return sbfi_diagnose(
        error, SBF_CODE_BAD_CALL, "the build options have an unknown method to cut sections");
  if (!is_length(o->cell_m))
    return sbfi_diagnose(error, SBF_CODE_BAD_CALL,
        "the cell size of the build options is not a length: use a finite number above 0, or 0 for the "
        "default");
  if (o->levels > SBFI_MAX_LEVELS || o->render_levels > SBFI_MAX_RENDER_LEVELS || !is_length(o->error_m) ||
      !is_length(o->render_error_m))
    return sbfi_diagnose(error, SBF_CODE_BAD_CALL,
        "the build options have more than 8 levels, or an error that is not a length");
  double *lengths[] = {&o->overlap_m, &o->cell_m, &o->error_m, &o->render_error_m};
  for (size_t i = 0; i < sizeof lengths / sizeof *lengths; i++)
    *lengths[i] = sbfi_build_settings_cell(*lengths[i]);
  return SBF_OK;
}
