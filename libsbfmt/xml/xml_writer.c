#include "xml/xml_writer.h"

#include "base/base64.h"
#include "base/diagnostic.h"
#include "base/number.h"
#include "model/defaults.h"
#include "model/ids.h"
#include "model/version.h"

enum {
  LINE_SCALARS = 12, /* complete items for one, two, three or four scalars */
  LINE_BYTES = 57,   /* 76 characters of base64 */
  FLUSH_BYTES = 1 << 18
};

typedef struct writer {
  const sbf_asset *asset;
  sbfi_xml_selection selection;
  sbfi_text *text;
  const sbfi_xml_sink *sink; /* NULL: none */
  sbf_diagnostic *error;
  sbf_status status; /* of the sink */
} writer;

/* An element being written. Its start tag stays open until it has content. */
typedef struct open_element {
  const char *name;
  uint32_t depth;
  bool has_content;
  bool is_needed; /* differs from its defaults */
} open_element;

static void flush(writer *w) {
  if (!w->sink || w->text->failed || w->status != SBF_OK) return;
  w->status = w->sink->write(w->sink->user, w->text->at, w->text->length, w->error);
  sbfi_text_clear(w->text);
}

/* Flushes only after an element differs from its defaults, so that no enclosing element is removed later:
 * see write_child. */
static void flush_when_full(writer *w) {
  if (w->text->length >= FLUSH_BYTES) flush(w);
}

static void indent(writer *w, uint32_t depth) {
  sbfi_text_repeat(w->text, ' ', (size_t)depth * 2);
}

static void open_start_tag(writer *w, const open_element *element) {
  indent(w, element->depth);
  sbfi_text_char(w->text, '<');
  sbfi_text_string(w->text, element->name);
}

static void begin_content(writer *w, open_element *element) {
  if (!element->has_content) sbfi_text_string(w->text, ">\n");
  element->has_content = true;
}

static void write_end_tag(writer *w, const char *name) {
  sbfi_text_string(w->text, "</");
  sbfi_text_string(w->text, name);
  sbfi_text_string(w->text, ">\n");
}

static void close_element(writer *w, const open_element *element) {
  if (!element->has_content) {
    sbfi_text_string(w->text, "/>\n");
    return;
  }
  indent(w, element->depth);
  write_end_tag(w, element->name);
}

/* --- texts --- */

static const char *replacement(char c, bool in_attribute) {
  switch (c) {
  case '&':
    return "&amp;";
  case '<':
    return "&lt;";
  case '>':
    return "&gt;";
  case '\r': /* a parser converts it to a line feed */
    return "&#13;";
  case '"':
    return in_attribute ? "&quot;" : NULL;
  case '\t': /* in an attribute these would be read as spaces */
    return in_attribute ? "&#9;" : NULL;
  case '\n':
    return in_attribute ? "&#10;" : NULL;
  default:
    return NULL;
  }
}

static void write_escaped(writer *w, const char *text, bool in_attribute) {
  const char *plain = text;
  for (; *text; text++) {
    const char *instead = replacement(*text, in_attribute);
    if (!instead) continue;
    sbfi_text_append(w->text, plain, (size_t)(text - plain));
    sbfi_text_string(w->text, instead);
    plain = text + 1;
  }
  sbfi_text_append(w->text, plain, (size_t)(text - plain));
}

/* --- attributes --- */

static void write_value(writer *w, const sbfi_element_path *path, const sbfi_field *field) {
  const char *at = (const char *)path->object + field->offset;
  int32_t integer = 0;
  switch (field->type) {
  case SBFI_BOOL:
    sbfi_text_string(w->text, *(const bool *)at ? "true" : "false");
    break;
  case SBFI_INT:
    sbfi_text_i32(w->text, sbfi_get_integer(path->object, field));
    break;
  case SBFI_UINT:
    sbfi_text_u32(w->text, (uint32_t)sbfi_get_integer(path->object, field));
    break;
  case SBFI_FLOAT:
  case SBFI_VEC2:
  case SBFI_VEC3:
  case SBFI_VEC4:
  case SBFI_QUAT:
    for (uint32_t i = 0; i < field->width; i++) {
      float value;
      memcpy(&value, at + i * sizeof value, sizeof value);
      if (i) sbfi_text_char(w->text, ' ');
      sbfi_text_f32(w->text, value);
    }
    break;
  case SBFI_ENUM:
    integer = sbfi_get_integer(path->object, field);
    write_escaped(w, field->words.at[integer], true);
    break;
  case SBFI_REF: {
    const char *id = sbfi_ref_id(w->asset, field, sbfi_get_integer(path->object, field));
    write_escaped(w, id ? id : "", true);
    break;
  }
  default:
    write_escaped(w, sbfi_get_pointer(path->object, field), true);
    break;
  }
}

static bool points_at_derivation(const sbfi_field *field) {
  return field->type == SBFI_REF && strcmp(field->reference.name, "derivations") == 0;
}

static void write_attribute(
    writer *w, const sbfi_element_path *path, const sbfi_field *field, open_element *element) {
  bool by_name = path->field && path->field->tag.by && strcmp(path->field->tag.by, field->name) == 0;
  bool is_default = sbfi_field_is_default(path, field);
  if (by_name || (is_default && !field->required)) return;
  if (w->selection.source_only && (field->volatile_ || points_at_derivation(field))) return;
  if (!is_default) element->is_needed = true;
  sbfi_text_char(w->text, ' ');
  sbfi_text_string(w->text, field->name);
  sbfi_text_string(w->text, "=\"");
  write_value(w, path, field);
  sbfi_text_char(w->text, '"');
}

/* --- lists --- */

static void write_numbers(writer *w, const sbfi_field *field, const void *at, size_t count) {
  char *to = sbfi_text_reserve(w->text, count * (SBFI_F32_TEXT_SIZE + 1));
  if (!to) return;
  const char *begin = to;
  const float *floats = at;
  const uint32_t *integers = at;
  for (size_t i = 0; i < count; i++) {
    if (i) *to++ = ' ';
    to += field->item == SBFI_ITEM_F32 ? sbfi_print_f32(to, floats[i]) : sbfi_print_u32(to, integers[i]);
  }
  w->text->length += (size_t)(to - begin);
}

static void write_line(writer *w, const sbfi_field *field, sbfi_list list, size_t first, size_t count) {
  if (field->item == SBFI_ITEM_U8)
    sbfi_base64_encode(w->text, (const uint8_t *)list.at + first, count);
  else
    write_numbers(w, field, (const uint32_t *)list.at + first, count);
}

static void write_list(
    writer *w, const sbfi_element_path *path, const sbfi_field *field, open_element *parent) {
  sbfi_list list = sbfi_get_list(path->object, field);
  if (!list.count) return;
  size_t scalars = (size_t)list.count * field->width;
  size_t line = field->item == SBFI_ITEM_U8 ? LINE_BYTES : LINE_SCALARS;
  const open_element self = {.name = field->name, .depth = parent->depth + 1};
  begin_content(w, parent);
  parent->is_needed = true;
  open_start_tag(w, &self);
  sbfi_text_char(w->text, '>');
  if (scalars <= line) {
    write_line(w, field, list, 0, scalars);
  } else {
    sbfi_text_char(w->text, '\n');
    for (size_t i = 0; i < scalars && !w->text->failed && w->status == SBF_OK; i += line) {
      write_line(w, field, list, i, scalars - i < line ? scalars - i : line);
      sbfi_text_char(w->text, '\n');
      flush_when_full(w);
    }
    indent(w, self.depth);
  }
  write_end_tag(w, field->name);
}

static void write_text(
    writer *w, const sbfi_element_path *path, const sbfi_field *field, open_element *parent) {
  const char *text = sbfi_get_pointer(path->object, field);
  if (!*text) return;
  const open_element self = {.name = field->name, .depth = parent->depth + 1};
  begin_content(w, parent);
  parent->is_needed = true;
  open_start_tag(w, &self);
  sbfi_text_char(w->text, '>');
  write_escaped(w, text, false);
  write_end_tag(w, field->name);
}

/* --- children --- */

static bool is_set(const void *object, const sbfi_element *element, const char *ref) {
  const sbfi_field *field = sbfi_element_field(element, ref);
  return field && points_at_derivation(field) && sbfi_get_integer(object, field) != SBF_NONE;
}

/* Objects state that they are derived; for a mesh, its parent object does. */
static bool is_derived(const sbfi_element_path *child) {
  char companion[64] = "";
  strncat(companion, child->field->name, sizeof companion - sizeof "_derived");
  strcat(companion, "_derived");
  return is_set(child->object, child->element, "derived") ||
         is_set(child->up->object, child->up->element, companion);
}

static bool is_kept(const writer *w, const sbfi_element_path *child) {
  if (w->selection.source_only && is_derived(child)) return false;
  return !w->selection.keep || w->selection.keep(w->selection.user, child);
}

static bool is_source(const sbfi_element_path *path, const sbfi_field *field) {
  return !field->volatile_ && (path->up || strcmp(field->name, "derivations") != 0);
}

static bool write_object(writer *w, const sbfi_element_path *path, const char *name, uint32_t depth);

/* A `one` child that equals its defaults is removed afterwards, together with the end of its parent's
 * start tag. None of it can have been flushed, because only lists flush. */
static void write_child(writer *w, const sbfi_element_path *child, open_element *parent) {
  char buffer[128];
  if (!is_kept(w, child)) return;
  size_t start = w->text->length;
  bool had_content = parent->has_content;
  const char *name = sbfi_child_xml_name(child->field, child->object, buffer, sizeof buffer);
  begin_content(w, parent);
  if (write_object(w, child, name, parent->depth + 1) || child->field->type != SBFI_ONE) {
    parent->is_needed = true;
    flush_when_full(w);
    return;
  }
  w->text->length = start;
  parent->has_content = had_content;
}

static void write_children(
    writer *w, const sbfi_element_path *path, const sbfi_field *field, open_element *parent) {
  uint32_t count = sbfi_child_count(path->object, field);
  size_t start = w->text->length;
  bool had_content = parent->has_content;
  open_element wrapper = {.name = field->tag.wrapper, .depth = parent->depth + 1};
  open_element *inside = field->tag.wrapper ? &wrapper : parent;
  if (field->tag.wrapper) {
    begin_content(w, parent);
    open_start_tag(w, &wrapper);
  }
  for (uint32_t i = 0; i < count && !w->text->failed && w->status == SBF_OK; i++) {
    sbfi_element_path child = sbfi_element_path_child(path, field, i);
    write_child(w, &child, inside);
  }
  if (!field->tag.wrapper) return;
  if (wrapper.has_content) {
    close_element(w, &wrapper);
    parent->is_needed = true;
  } else {
    w->text->length = start;
    parent->has_content = had_content;
  }
}

/* Returns whether it differs from its defaults. */
static bool write_object(writer *w, const sbfi_element_path *path, const char *name, uint32_t depth) {
  open_element self = {.name = name, .depth = depth};
  open_start_tag(w, &self);
  for (uint32_t i = 0; i < path->element->field_count; i++)
    if (sbfi_field_is_attribute(&path->element->fields[i]))
      write_attribute(w, path, &path->element->fields[i], &self);
  for (uint32_t i = 0; i < path->element->field_count; i++) {
    const sbfi_field *field = &path->element->fields[i];
    if (w->selection.source_only && !is_source(path, field)) continue;
    if (field->type == SBFI_LIST)
      write_list(w, path, field, &self);
    else if (field->type == SBFI_TEXT)
      write_text(w, path, field, &self);
    else if (field->element)
      write_children(w, path, field, &self);
  }
  close_element(w, &self);
  return self.is_needed;
}

sbf_status sbfi_xml_write(const sbf_asset *asset, const sbfi_xml_selection *selection, sbfi_text *text,
    const sbfi_xml_sink *sink, sbf_diagnostic *error) {
  char version[SBFI_VERSION_TEXT];
  sbf_asset stated = *asset;
  writer w = {.asset = &stated, .text = text, .sink = sink, .error = error};
  if (selection) w.selection = *selection;
  /* In a hash of the source the version is fixed: a material of a later version makes no part stale. */
  stated.version = w.selection.source_only ? "1.0" : sbfi_version_to_state(asset, version);
  sbfi_element_path root = sbfi_element_path_root(&stated);
  sbfi_text_string(text, "<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n");
  write_object(&w, &root, root.element->xml, 0);
  flush(&w);
  if (text->failed)
    return sbfi_diagnose(error, SBF_CODE_OUT_OF_MEMORY, "memory ran out while XML was written");
  return w.status;
}
