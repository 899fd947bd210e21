#include "model/version.h"

#include <stdio.h>
#include <string.h>

#include "base/number.h"
#include "model/defaults.h"

/* Digits only: the number parser would accept a sign. */
static bool read_part(const char **text, uint32_t *value) {
  size_t used;
  if (**text < '0' || **text > '9') return false;
  if (sbfi_scan_u32(*text, strlen(*text), value, &used) != SBFI_NUMBER_READ) return false;
  *text += used;
  return true;
}

static bool read_version(const char *text, uint32_t *major, uint32_t *minor) {
  return read_part(&text, major) && *text++ == '.' && read_part(&text, minor) && *text == 0;
}

sbfi_version_verdict sbfi_version_check(const char *version) {
  uint32_t major, minor, our_major, our_minor;
  if (!read_version(version, &major, &minor)) return SBFI_VERSION_MALFORMED;
  if (!read_version(SBF_FORMAT_VERSION, &our_major, &our_minor)) return SBFI_VERSION_MALFORMED;
  if (major > our_major) return SBFI_VERSION_TOO_NEW;
  return major == our_major && minor > our_minor ? SBFI_VERSION_NEWER_MINOR : SBFI_VERSION_KNOWN;
}

uint32_t sbfi_version_minor(const char *version) {
  uint32_t major, minor;
  return read_version(version, &major, &minor) && major == 1 ? minor : 0;
}

static uint32_t minor_in_use(const sbfi_element_path *path) {
  uint32_t max = 0;
  for (uint32_t i = 0; i < path->element->field_count; i++) {
    const sbfi_field *field = &path->element->fields[i];
    if (field->since_minor > max && !sbfi_field_is_default(path, field)) max = field->since_minor;
    for (uint32_t k = 0; field->element && k < sbfi_child_count(path->object, field); k++) {
      sbfi_element_path child = sbfi_element_path_child(path, field, k);
      uint32_t below = minor_in_use(&child);
      max = below > max ? below : max;
    }
  }
  return max;
}

const char *sbfi_version_to_state(const sbf_asset *asset, char text[SBFI_VERSION_TEXT]) {
  sbfi_element_path root = sbfi_element_path_root(asset);
  uint32_t minor = minor_in_use(&root);
  if (minor <= sbfi_version_minor(asset->version)) return asset->version;
  snprintf(text, SBFI_VERSION_TEXT, "1.%u", minor);
  return text;
}
