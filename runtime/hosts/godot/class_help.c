#include "class_help.h"

#include <stdarg.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

/* ---- Growing text ---- */

typedef struct text {
  char *at;
  size_t size, capacity;
} text;

static void add(text *to, const char *from, size_t size) {
  if (to->size + size + 1 > to->capacity) {
    size_t capacity = 2 * (to->size + size) + 1024;
    char *more = realloc(to->at, capacity);
    if (!more) return;
    to->at = more, to->capacity = capacity;
  }
  memcpy(to->at + to->size, from, size);
  to->at[to->size += size] = 0;
}

/* %s is escaped for XML. */
static void write(text *to, const char *format, ...) {
  va_list given;
  va_start(given, format);
  for (; *format; format++) {
    if (format[0] != '%' || format[1] != 's') {
      add(to, format, 1);
      continue;
    }
    format++;
    for (const char *c = va_arg(given, const char *); *c; c++) {
      const char *as = *c == '<' ? "&lt;" : *c == '&' ? "&amp;" : *c == '"' ? "&quot;" : NULL;
      add(to, as ? as : c, as ? strlen(as) : 1);
    }
  }
  va_end(given);
}

/* ---- Names ---- */

static const char *type_name(GDExtensionVariantType type, const char *class_name) {
  switch (type) {
  case GDEXTENSION_VARIANT_TYPE_BOOL:
    return "bool";
  case GDEXTENSION_VARIANT_TYPE_INT: /* also of an enumeration, whose name is in class_name */
    return "int";
  case GDEXTENSION_VARIANT_TYPE_FLOAT:
    return "float";
  case GDEXTENSION_VARIANT_TYPE_STRING:
    return "String";
  case GDEXTENSION_VARIANT_TYPE_VECTOR3:
    return "Vector3";
  case GDEXTENSION_VARIANT_TYPE_NODE_PATH:
    return "NodePath";
  case GDEXTENSION_VARIANT_TYPE_RID:
    return "RID";
  case GDEXTENSION_VARIANT_TYPE_ARRAY:
    return "Array";
  case GDEXTENSION_VARIANT_TYPE_DICTIONARY:
    return "Dictionary";
  case GDEXTENSION_VARIANT_TYPE_TRANSFORM3D:
    return "Transform3D";
  case GDEXTENSION_VARIANT_TYPE_AABB:
    return "AABB";
  case GDEXTENSION_VARIANT_TYPE_OBJECT:
    return class_name ? class_name : "Object";
  case GDEXTENSION_VARIANT_TYPE_PACKED_BYTE_ARRAY:
    return "PackedByteArray";
  case GDEXTENSION_VARIANT_TYPE_PACKED_STRING_ARRAY:
    return "PackedStringArray";
  case GDEXTENSION_VARIANT_TYPE_PACKED_VECTOR3_ARRAY:
    return "PackedVector3Array";
  default:
    return "Variant";
  }
}

static const char *word_of(const gd_class *form, const gd_help *words, const char *name) {
  char message[256];
  for (const gd_help *one = words; one->name; one++)
    if (!strcmp(one->name, name)) return one->text;
  snprintf(message, sizeof message, "%s.%s has no help: say what it is in words.c", form->name, name);
  gd_error(message);
  return "";
}

static bool has_name(const gd_class *form, const char *name) {
  const gd_method *method;
  for (uint32_t i = 0; (method = gd_class_method(form, i)) != NULL; i++)
    if (!strcmp(method->name, name)) return true;
  for (const gd_property *one = form->properties; one && one->name; one++)
    if (one->get && !strcmp(one->name, name)) return true;
  for (const gd_signal *one = form->signals; one && one->name; one++)
    if (!strcmp(one->name, name)) return true;
  for (const gd_constant *one = form->constants; one && one->name; one++)
    if (!strcmp(one->name, name)) return true;
  return false;
}

/* ---- The class ---- */

static void write_arguments(text *to, const gd_argument *arguments, uint32_t count) {
  char number[16];
  for (uint32_t i = 0; i < count; i++) {
    snprintf(number, sizeof number, "%u", i);
    write(to, "<param index=\"%s\" name=\"%s\" type=\"%s\" />", number, arguments[i].name,
        type_name(arguments[i].type, arguments[i].class_name));
  }
}

static void write_members(text *to, const gd_class *form, const gd_help *words) {
  write(to, "<methods>");
  const gd_method *method;
  for (uint32_t i = 0; (method = gd_class_method(form, i)) != NULL; i++) {
    if (method->name[0] == '_') continue;
    write(to, "<method name=\"%s\"><return type=\"%s\" />", method->name,
        method->answers ? type_name(method->result.type, method->result.class_name) : "void");
    write_arguments(to, method->arguments, method->count);
    write(to, "<description>%s</description></method>", word_of(form, words, method->name));
  }
  write(to, "</methods><members>");
  for (const gd_property *one = form->properties; one && one->name; one++)
    if (one->get) {
      write(to, "<member name=\"%s\" type=\"%s\" setter=\"%s\" getter=\"%s\"", one->name,
          type_name(one->type, one->class_name), one->set ? one->setter_name : "", one->getter_name);
      if (one->type == GDEXTENSION_VARIANT_TYPE_INT && one->class_name)
        write(to, " enum=\"%s\"", one->class_name);
      write(to, ">%s</member>", word_of(form, words, one->name));
    }
  write(to, "</members><signals>");
  for (const gd_signal *one = form->signals; one && one->name; one++) {
    write(to, "<signal name=\"%s\">", one->name);
    write_arguments(to, one->arguments, one->count);
    write(to, "<description>%s</description></signal>", word_of(form, words, one->name));
  }
  write(to, "</signals><constants>");
  for (const gd_constant *one = form->constants; one && one->name; one++) {
    char number[24];
    snprintf(number, sizeof number, "%lld", (long long)one->value);
    write(to, "<constant name=\"%s\" value=\"%s\" enum=\"%s\">%s</constant>", one->name, number,
        one->enumeration, word_of(form, words, one->name));
  }
  write(to, "</constants>");
}

void gd_class_set_help(const gd_class *form, const char *about, const gd_help *words) {
  GDExtensionsInterfaceEditorHelpLoadXmlFromUtf8Chars load = gd_editor_help();
  text made = {0};
  char brief[256], message[256];
  const char *end = strstr(about, ". ");
  if (!load) return;
  snprintf(brief, sizeof brief, "%.*s", end ? (int)(end - about) + 1 : (int)sizeof brief - 1, about);
  write(&made,
      "<?xml version=\"1.0\" encoding=\"UTF-8\" ?><class name=\"%s\" inherits=\"%s\"><brief_description>%s"
      "</brief_description><description>%s</description><tutorials></tutorials>",
      form->name, form->parent, brief, about);
  write_members(&made, form, words);
  write(&made, "</class>");
  for (const gd_help *one = words; one->name; one++) {
    if (has_name(form, one->name)) continue;
    snprintf(message, sizeof message, "words.c speaks of %s.%s, which there is not", form->name, one->name);
    gd_error(message);
  }
  if (made.at) load(made.at);
  free(made.at);
}
