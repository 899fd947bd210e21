/* Selects which parts of a packed file are read. */
#include "packed/packed_reader.h"

static bool is_among(const char *text, sbf_string_list list) {
  for (uint32_t i = 0; i < list.count; i++)
    if (strcmp(text, list.at[i]) == 0) return true;
  return false;
}

static bool is_named(const sbfi_element_path *part, sbf_string_list names) {
  for (uint32_t i = 0; i < part->element->field_count; i++) {
    const sbfi_field *field = &part->element->fields[i];
    if (sbfi_packed_is_label(field) && is_among(sbfi_get_pointer(part->object, field), names)) return true;
  }
  return false;
}

/* A part with required fields besides its label would fail the check with all fields at their defaults. */
static bool must_be_read(const sbfi_element *element) {
  for (uint32_t i = 0; i < element->field_count; i++) {
    const sbfi_field *field = &element->fields[i];
    bool may_not_be_default =
        field->type == SBFI_REF || field->type == SBFI_STRING || field->type == SBFI_TEXT;
    if (field->required && may_not_be_default && !sbfi_packed_is_label(field)) return true;
  }
  return false;
}

bool sbfi_packed_selects(const sbf_selection *selection, const sbfi_element_path *part) {
  if (!selection || must_be_read(part->element)) return true;
  if (selection->kinds.count && !is_among(part->element->name, selection->kinds)) return false;
  if (!part->up->up) return !selection->parts.count || is_named(part, selection->parts);
  if (!selection->levels.count) return true;
  for (uint32_t i = 0; i < selection->levels.count; i++)
    if (selection->levels.at[i] == part->index) return true;
  return false;
}

bool sbfi_packed_selects_root_lists(const sbf_selection *selection) {
  return !selection || !selection->kinds.count || is_among(sbfi_asset_element.name, selection->kinds);
}
