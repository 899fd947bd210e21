#include "model/schema.h"

#include <stdio.h>

const sbfi_field *sbfi_element_field(const sbfi_element *element, const char *name) {
  for (uint32_t i = 0; i < element->field_count; i++)
    if (strcmp(element->fields[i].name, name) == 0) return &element->fields[i];
  return NULL;
}

bool sbfi_child_fix(const sbfi_field *field, void *child) {
  if (!field->fixed.name) return true;
  const sbfi_field *fixed = sbfi_element_field(field->element, field->fixed.name);
  bool same = sbfi_get_integer(child, fixed) == field->fixed.value;
  sbfi_set_integer(child, fixed, field->fixed.value);
  return same;
}

static void init_field(const sbfi_field *field, char *destination) {
  switch (field->type) {
  case SBFI_BOOL:
    *(bool *)destination = field->initial.integer != 0;
    break;
  case SBFI_INT:
  case SBFI_UINT:
  case SBFI_ENUM:
    memcpy(destination, &field->initial.integer, sizeof field->initial.integer);
    break;
  case SBFI_FLOAT:
  case SBFI_VEC2:
  case SBFI_VEC3:
  case SBFI_VEC4:
  case SBFI_QUAT:
    memcpy(destination, field->initial.scalars, field->width * sizeof(float));
    break;
  case SBFI_STRING:
  case SBFI_TEXT:
  case SBFI_ID:
    memcpy(destination, &field->initial.text, sizeof field->initial.text);
    break;
  case SBFI_REF:
    memcpy(destination, &(int32_t){SBF_NONE}, sizeof(int32_t));
    break;
  case SBFI_ONE:
    sbfi_element_init(field->element, destination);
    sbfi_child_fix(field, destination);
    break;
  case SBFI_LIST:
  case SBFI_OPTIONAL:
  case SBFI_MANY:
    break; /* already zero */
  }
}

void sbfi_element_init(const sbfi_element *element, void *memory) {
  memset(memory, 0, element->struct_size);
  for (uint32_t i = 0; i < element->field_count; i++)
    init_field(&element->fields[i], (char *)memory + element->fields[i].offset);
}

const char *sbfi_child_xml_name(const sbfi_field *field, const void *child, char *buffer, size_t size) {
  if (!field->tag.suffix) return field->tag.xml;
  const sbfi_field *by = sbfi_element_field(field->element, field->tag.by);
  int32_t value = sbfi_get_integer(child, by);
  const char *word = (uint32_t)value < by->words.count ? by->words.at[value] : "unknown";
  snprintf(buffer, size, "%s%s", word, field->tag.suffix);
  return buffer;
}
