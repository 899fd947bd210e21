#include "xml/xml_schema.h"

#include <stdio.h>

/* Name of a field's own element; NULL if its children have several names. */
static const char *element_name(const sbfi_field *field) {
  if (sbfi_field_is_attribute(field)) return NULL;
  if (field->tag.wrapper) return field->tag.wrapper;
  if (field->tag.suffix) return NULL;
  return field->element ? field->tag.xml : field->name;
}

const sbfi_field *sbfi_xml_find_element(const sbfi_element *element, const char *name) {
  for (uint32_t i = 0; i < element->field_count; i++) {
    const sbfi_field *field = &element->fields[i];
    const char *own = element_name(field);
    int32_t value;
    if (own ? strcmp(own, name) == 0 : field->tag.suffix && sbfi_xml_is_child(field, name, &value))
      return field;
  }
  return NULL;
}

bool sbfi_xml_is_child(const sbfi_field *field, const char *name, int32_t *value) {
  *value = -1;
  if (!field->element) return false;
  if (!field->tag.suffix) return strcmp(field->tag.xml, name) == 0;
  size_t length = strlen(name), suffix = strlen(field->tag.suffix);
  if (length <= suffix || strcmp(name + length - suffix, field->tag.suffix) != 0) return false;
  const sbfi_field *by = sbfi_element_field(field->element, field->tag.by);
  const sbfi_span word = {name, length - suffix};
  for (uint32_t i = 0; i < by->words.count; i++)
    if (sbfi_span_is(word, by->words.at[i])) *value = (int32_t)i;
  return *value >= 0;
}

static bool is_set_by_name(const sbfi_field *holder, const sbfi_field *field) {
  return holder && holder->tag.by && strcmp(holder->tag.by, field->name) == 0;
}

const sbfi_field *sbfi_xml_find_attribute(
    const sbfi_element *element, const sbfi_field *holder, const char *name) {
  const sbfi_field *field = sbfi_element_field(element, name);
  return field && sbfi_field_is_attribute(field) && !is_set_by_name(holder, field) ? field : NULL;
}

static void consider_children(
    sbfi_suggestion *suggestion, const sbfi_field *field, char (*names)[96], int *used) {
  if (!field->tag.suffix) {
    sbfi_suggestion_consider(suggestion, field->tag.xml);
    return;
  }
  const sbfi_field *by = sbfi_element_field(field->element, field->tag.by);
  for (uint32_t i = 0; i < by->words.count; i++) {
    /* alternates two buffers: the best name so far must stay valid */
    char *name = names[*used];
    snprintf(name, sizeof *names, "%s%s", by->words.at[i], field->tag.suffix);
    sbfi_suggestion_consider(suggestion, name);
    if (suggestion->best == name) *used = !*used;
  }
}

sbfi_suggestion_text sbfi_xml_suggest_element(const sbfi_element *element, const char *name) {
  sbfi_suggestion suggestion = sbfi_suggestion_for(sbfi_span_of(name));
  char names[2][96];
  int used = 0;
  for (uint32_t i = 0; i < element->field_count; i++) {
    const sbfi_field *field = &element->fields[i];
    const char *own = element_name(field);
    if (own)
      sbfi_suggestion_consider(&suggestion, own);
    else if (field->tag.suffix)
      consider_children(&suggestion, field, names, &used);
  }
  return sbfi_suggestion_text_of(&suggestion);
}

sbfi_suggestion_text sbfi_xml_suggest_child(const sbfi_field *field, const char *name) {
  sbfi_suggestion suggestion = sbfi_suggestion_for(sbfi_span_of(name));
  char names[2][96];
  int used = 0;
  consider_children(&suggestion, field, names, &used);
  return sbfi_suggestion_text_of(&suggestion);
}

sbfi_suggestion_text sbfi_xml_suggest_attribute(
    const sbfi_element *element, const sbfi_field *holder, const char *name) {
  sbfi_suggestion suggestion = sbfi_suggestion_for(sbfi_span_of(name));
  for (uint32_t i = 0; i < element->field_count; i++)
    if (sbfi_xml_find_attribute(element, holder, element->fields[i].name))
      sbfi_suggestion_consider(&suggestion, element->fields[i].name);
  return sbfi_suggestion_text_of(&suggestion);
}

sbfi_xml_words sbfi_xml_words_of(const sbfi_field *field) {
  sbfi_xml_words words = {""};
  size_t length = 0;
  for (uint32_t i = 0; i < field->words.count && length < sizeof words.at; i++) {
    int added =
        snprintf(words.at + length, sizeof words.at - length, "%s%s", i ? ", " : "", field->words.at[i]);
    length += added > 0 ? (size_t)added : 0;
  }
  return words;
}
