/* Writes the text of MJCF: attributes and names. */
#include <string.h>

#include "export/mjcf.h"

sbf_vec3 sbfi_mjcf_from_asset(sbf_vec3 v) {
  return (sbf_vec3){v.x, 0 - v.z, v.y};
}

void sbfi_mjcf_write_f32(mjcf_writer *w, const char *name, float value) {
  sbfi_export_format(w->e, " %s=\"", name);
  sbfi_text_f32(&w->e->text, value);
  sbfi_text_char(&w->e->text, '"');
}

void sbfi_mjcf_write_vec3(mjcf_writer *w, const char *name, sbf_vec3 asset_space) {
  const sbf_vec3 v = sbfi_mjcf_from_asset(asset_space);
  const float numbers[3] = {v.x, v.y, v.z};
  sbfi_export_format(w->e, " %s=\"", name);
  for (int k = 0; k < 3; k++) {
    if (k) sbfi_text_char(&w->e->text, ' ');
    sbfi_text_f32(&w->e->text, numbers[k]);
  }
  sbfi_text_char(&w->e->text, '"');
}

static bool is_plain(char c) {
  return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') || strchr("_-.", c);
}

void sbfi_mjcf_name(mjcf_writer *w, const char *id, uint32_t index) {
  bool plain = *id && strcmp(id, "world") != 0;
  for (const char *c = id; *c; c++) {
    plain = plain && is_plain(*c);
    sbfi_text_char(&w->e->text, is_plain(*c) ? *c : '_');
  }
  if (!plain) sbfi_export_format(w->e, "~%u", index);
}

void sbfi_mjcf_rigid_name(mjcf_writer *w, int32_t body) {
  if (body < 0)
    sbfi_text_string(&w->e->text, "world");
  else
    sbfi_mjcf_name(w, w->e->asset->rigid_bodies.at[body].id, (uint32_t)body);
}
