/* Children are collected in rows, one per schema field with many children. No element contains itself, so
 * at most one object of a field is open and no row is reallocated while children of its last object are
 * read. At the end of an object the rows of its children move into the asset. */
#include "xml/xml_reader.h"

#include <stdio.h>

#include "base/diagnostic.h"
#include "base/number.h"
#include "model/asset_box.h"
#include "model/check.h"
#include "model/version.h"
#include "xml/xml_list.h"
#include "xml/xml_schema.h"

typedef enum open_kind { OPEN_OBJECT, OPEN_WRAPPER, OPEN_LIST, OPEN_TEXT, OPEN_SKIPPED } open_kind;

typedef struct open_element {
  open_kind kind;
  const sbfi_field *field;     /* field of the parent object; NULL at the root */
  const sbfi_element *element; /* of an object */
  void *object;
  uint32_t index; /* among the field's children */
  uint64_t seen;  /* bit i: field i of an object occurred */
} open_element;

typedef struct row {
  const sbfi_field *field;
  sbfi_array children;
} row;

typedef struct reader {
  const sbf_load_options *options;
  sbf_allocator allocator;
  sbf_asset *asset;
  sbfi_arena *arena;
  sbfi_xml_events events;
  sbfi_array open; /* open_element, outermost first */
  sbfi_array rows; /* row, in order of first occurrence */
  sbfi_array text; /* bytes of the text element being read */
  sbfi_array *refs;
  sbfi_xml_list list;
  size_t row_bytes;
  bool newer_minor; /* skips unknown content */
  uint32_t minor;   /* of the file; fields of later versions are unknown in it */
  uint32_t left_out;
  char first_left_out[200]; /* path of the first skipped item */
  sbf_diagnostic *error;
  sbf_status status;
} reader;

static open_element *top(const reader *r) {
  return (open_element *)r->open.at + (r->open.count - 1);
}

/* Innermost open object; its wrapper, list or text may be on top of it. */
static open_element *top_object(const reader *r) {
  open_element *element = top(r);
  while (element->kind != OPEN_OBJECT) element--;
  return element;
}

static row *find_row(const reader *r, const sbfi_field *field) {
  row *rows = r->rows.at;
  for (size_t i = 0; i < r->rows.count; i++)
    if (rows[i].field == field) return &rows[i];
  return NULL;
}

/* NULL if memory runs out. */
static row *row_of(reader *r, const sbfi_field *field) {
  row *known = find_row(r, field);
  if (known) return known;
  row *fresh = sbfi_array_push(&r->rows, 1);
  if (!fresh) return NULL;
  fresh->field = field;
  sbfi_array_init(&fresh->children, &r->allocator, field->element->struct_size);
  return fresh;
}

/* --- faults --- */

/* Attaches the children read so far to an open object, because a path numbers siblings. */
static void show_children(const reader *r, const open_element *element) {
  for (uint32_t i = 0; i < element->element->field_count; i++) {
    const sbfi_field *field = &element->element->fields[i];
    const row *children = field->type == SBFI_MANY ? find_row(r, field) : NULL;
    if (children)
      sbfi_set_list(element->object, field, children->children.at, (uint32_t)children->children.count);
  }
}

static void write_path(const reader *r, const sbfi_field *field, char *path, size_t size) {
  enum { DEEPEST = 16 };
  sbfi_element_path paths[DEEPEST];
  uint32_t depth = 0;
  const open_element *open = r->open.at;
  const sbfi_field *wrapper = NULL;
  path[0] = 0;
  for (size_t i = 0; i < r->open.count && depth < DEEPEST; i++) {
    if (open[i].kind == OPEN_LIST || open[i].kind == OPEN_TEXT) field = open[i].field;
    wrapper = open[i].kind == OPEN_WRAPPER ? open[i].field : NULL;
    if (open[i].kind != OPEN_OBJECT) continue;
    show_children(r, &open[i]);
    paths[depth] = (sbfi_element_path){
        depth ? &paths[depth - 1] : NULL, open[i].element, open[i].object, open[i].field, open[i].index};
    depth++;
  }
  if (depth) sbfi_element_path_print(&paths[depth - 1], field ? field : wrapper, path, size);
}

/* Reports about the top element, or a field of the top object. */
__attribute__((format(printf, 4, 5))) static bool fail(
    reader *r, sbf_code code, const sbfi_field *field, const char *format, ...) {
  va_list arguments;
  va_start(arguments, format);
  r->status = sbfi_diagnose_v(r->error, code, format, arguments);
  va_end(arguments);
  r->error->line = r->events.line;
  write_path(r, field, r->error->path, sizeof r->error->path);
  return false;
}

static bool fail_memory(reader *r) {
  return fail(r, SBF_CODE_OUT_OF_MEMORY, NULL, "memory ran out, or the limit of %llu bytes was reached",
      (unsigned long long)r->options->limits.memory_bytes);
}

/* Appends an unknown name to the path. */
static bool extend_path(reader *r, const char *separator, const char *name) {
  size_t length = strlen(r->error->path);
  snprintf(r->error->path + length, sizeof r->error->path - length, "%s%s", separator, name);
  return false;
}

/* Whether the memory in use is within the limit; the arena counts only finished objects. */
static bool fits_memory(const reader *r) {
  uint64_t limit = r->options->limits.memory_bytes, used = r->arena->used_bytes;
  uint64_t staged = (uint64_t)r->row_bytes + r->text.count;
  if (r->list.field) staged += sbfi_xml_list_bytes(&r->list);
  return used <= limit && staged <= limit - used;
}

/* Word for a field's type of numbers, for messages. */
static const char *name_of_scalar(const sbfi_field *field) {
  if (field->type == SBFI_INT) return "an integer of 32 bits";
  bool is_uint = field->type == SBFI_UINT || (field->type == SBFI_LIST && field->item == SBFI_ITEM_U32);
  return is_uint ? "an integer from 0 to 4294967295" : "within the range of 32-bit floats";
}

static bool fail_list(reader *r, sbfi_xml_fault fault) {
  const sbfi_xml_list *list = &r->list;
  uint32_t count = sbfi_xml_list_count(list);
  const char *name = list->field->name;
  bool bytes = list->field->item == SBFI_ITEM_U8;
  switch (fault) {
  case SBFI_XML_NOT_FINITE:
    fail(r, SBF_CODE_VALUE_NOT_FINITE, NULL, "`%s` has `%s`: every number must be finite", name, list->wrong);
    break;
  case SBFI_XML_OUT_OF_RANGE:
    fail(r, SBF_CODE_VALUE_OUT_OF_RANGE, NULL, "`%s` has `%s`, which is not %s", name, list->wrong,
        name_of_scalar(list->field));
    break;
  case SBFI_XML_NOT_WHOLE:
    if (bytes)
      return fail(
          r, SBF_CODE_XML_BAD_VALUE, NULL, "`%s` ends inside a group of base64: it was truncated", name);
    return fail(r, SBF_CODE_WRONG_LENGTH, NULL, "`%s` has %zu numbers, not a multiple of %u", name,
        list->scalars.count, list->field->width);
  case SBFI_XML_TOO_LONG:
    return fail(r, SBF_CODE_LIST_TOO_LONG, NULL, "`%s` has more than the limit of %u items", name,
        r->options->limits.list_items);
  case SBFI_XML_NO_MEMORY:
    return fail_memory(r);
  default:
    fail(r, SBF_CODE_XML_BAD_VALUE, NULL,
        bytes ? "`%s` has `%s`, which is not base64" : "`%s` has `%s` instead of a number", name,
        list->wrong);
    break;
  }
  if (!bytes) r->error->index = count;
  return false;
}

/* --- attributes --- */

static bool fail_number(reader *r, const sbfi_field *field, sbfi_xml_fault fault, sbfi_span word) {
  int length = word.length < 40 ? (int)sbfi_utf8_cut(word.at, word.length, 40) : (int)word.length;
  switch (fault) {
  case SBFI_XML_NOT_FINITE:
    return fail(r, SBF_CODE_VALUE_NOT_FINITE, field, "`%s` is `%.*s`: every number must be finite",
        field->name, length, word.at);
  case SBFI_XML_OUT_OF_RANGE:
    return fail(r, SBF_CODE_VALUE_OUT_OF_RANGE, field, "`%s` is `%.*s`, which is not %s", field->name, length,
        word.at, name_of_scalar(field));
  default:
    return fail(
        r, SBF_CODE_XML_BAD_VALUE, field, "`%s` is `%.*s` instead of a number", field->name, length, word.at);
  }
}

static bool read_floats(reader *r, const sbfi_field *field, sbfi_span value, void *to) {
  float values[4];
  uint32_t count = 0;
  sbfi_span word, rest = value;
  while (sbfi_span_next_word(&rest, &word)) {
    float number;
    sbfi_xml_fault fault = sbfi_xml_scan_number(field, word.at, word.length, &number);
    if (fault) return fail_number(r, field, fault, word);
    if (count < field->width) values[count] = number;
    count++;
  }
  if (count != field->width)
    return fail(r, SBF_CODE_XML_BAD_VALUE, field, "`%s` has %u numbers instead of %u", field->name, count,
        field->width);
  memcpy(to, values, count * sizeof *values);
  return true;
}

static bool read_bool(reader *r, const sbfi_field *field, sbfi_span value, bool *to) {
  *to = sbfi_span_is(value, "true") || sbfi_span_is(value, "1");
  if (*to || sbfi_span_is(value, "false") || sbfi_span_is(value, "0")) return true;
  return fail(r, SBF_CODE_XML_BAD_VALUE, field, "`%s` is neither true nor false", field->name);
}

static bool read_enum(reader *r, const sbfi_field *field, sbfi_span value, void *object) {
  for (uint32_t i = 0; i < field->words.count; i++)
    if (sbfi_span_is(value, field->words.at[i])) {
      sbfi_set_integer(object, field, (int32_t)i);
      return true;
    }
  return fail(r, SBF_CODE_ENUM_OUT_OF_RANGE, field, "`%s` is `%.*s`: use one of %s", field->name,
      (int)sbfi_utf8_cut(value.at, value.length, 60), value.at, sbfi_xml_words_of(field).at);
}

static const char *copy_text(reader *r, sbfi_span value) {
  return sbfi_arena_string(r->arena, value.at, value.length);
}

static bool read_ref(reader *r, const sbfi_field *field, sbfi_span value, void *object) {
  const char **slot = sbfi_array_push(r->refs, 1);
  if (!slot || !(*slot = copy_text(r, value)) || r->refs->count > INT32_MAX) return fail_memory(r);
  sbfi_set_integer(object, field, (int32_t)(r->refs->count - 1));
  return true;
}

static bool read_attribute(reader *r, const sbfi_field *field, sbfi_span value, void *object) {
  char *to = (char *)object + field->offset;
  sbfi_span trimmed = sbfi_span_trim(value);
  sbfi_xml_fault fault;
  switch (field->type) {
  case SBFI_BOOL:
    return read_bool(r, field, trimmed, (bool *)to);
  case SBFI_INT:
  case SBFI_UINT:
    fault = sbfi_xml_scan_number(field, trimmed.at, trimmed.length, to);
    return !fault || fail_number(r, field, fault, trimmed);
  case SBFI_FLOAT:
  case SBFI_VEC2:
  case SBFI_VEC3:
  case SBFI_VEC4:
  case SBFI_QUAT:
    return read_floats(r, field, value, to);
  case SBFI_ENUM:
    return read_enum(r, field, trimmed, object);
  case SBFI_REF:
    return read_ref(r, field, value, object);
  default: {
    const char *text = copy_text(r, value);
    sbfi_set_pointer(object, field, text);
    return text || fail_memory(r);
  }
  }
}

static bool leave_out(reader *r, const char *separator, const char *name) {
  if (r->left_out++ > 0) return true;
  write_path(r, NULL, r->first_left_out, sizeof r->first_left_out);
  size_t used = strlen(r->first_left_out);
  snprintf(r->first_left_out + used, sizeof r->first_left_out - used, "%s%.60s", separator, name);
  return true;
}

static bool unknown_attribute(reader *r, const char *name) {
  const open_element *self = top(r);
  if (r->newer_minor) return leave_out(r, "/@", name);
  if (self->kind == OPEN_OBJECT) {
    if (sbfi_element_field(self->element, name) && self->field && self->field->tag.by &&
        strcmp(self->field->tag.by, name) == 0)
      fail(r, SBF_CODE_XML_UNKNOWN_ATTRIBUTE, NULL, "the element's name states `%.60s`: remove it", name);
    else if (sbfi_xml_find_element(self->element, name))
      fail(r, SBF_CODE_XML_UNKNOWN_ATTRIBUTE, NULL, "`%.60s` is an element: write it between the tags", name);
    else
      fail(r, SBF_CODE_XML_UNKNOWN_ATTRIBUTE, NULL, "<%s> has no attribute `%.60s`%s", self->element->xml,
          name, sbfi_xml_suggest_attribute(self->element, self->field, name).at);
  } else {
    fail(r, SBF_CODE_XML_UNKNOWN_ATTRIBUTE, NULL, "this element has no attributes: remove `%.60s`", name);
  }
  return extend_path(r, "/@", name);
}

static sbfi_span value_of(const sbfi_xml_attribute *attribute) {
  return (sbfi_span){attribute->value, attribute->length};
}

/* All readers treat a file alike: a later reader also rejects what the stated version lacks. */
static bool refuse_later(reader *r, const sbfi_field *field) {
  return fail(r, SBF_CODE_VERSION_FIELD, field,
      "`%s` needs version 1.%u, but the file states %.20s: state 1.%u", field->name, field->since_minor,
      r->asset->version, field->since_minor);
}

static bool read_attributes(reader *r, const sbfi_xml_attribute *attributes, uint32_t count) {
  open_element *self = top(r);
  for (uint32_t i = 0; i < count; i++) {
    const sbfi_field *field = sbfi_xml_find_attribute(self->element, self->field, attributes[i].name);
    if (field && field->since_minor > r->minor) return refuse_later(r, field);
    if (!field) {
      if (!unknown_attribute(r, attributes[i].name)) return false;
      continue;
    }
    self->seen |= (uint64_t)1 << (field - self->element->fields);
    if (!read_attribute(r, field, value_of(&attributes[i]), self->object)) return false;
  }
  return fits_memory(r) || fail_memory(r);
}

static bool check_attributes(reader *r) {
  const open_element *self = top(r);
  for (uint32_t i = 0; i < self->element->field_count; i++) {
    const sbfi_field *field = &self->element->fields[i];
    if (!field->required || self->seen >> i & 1) continue;
    /* the element's name defines it */
    if (!sbfi_xml_find_attribute(self->element, self->field, field->name)) continue;
    return fail(r, SBF_CODE_REQUIRED_MISSING, field, "<%s> must have the attribute `%s`", self->element->xml,
        field->name);
  }
  const sbfi_field *holder = self->field;
  if (!holder || !holder->fixed.name) return true;
  const sbfi_field *fixed = sbfi_element_field(self->element, holder->fixed.name);
  return sbfi_get_integer(self->object, fixed) == holder->fixed.value ||
         fail(r, SBF_CODE_FIXED_VALUE, fixed, "`%s` must be `%s` here", fixed->name,
             fixed->words.at[holder->fixed.value]);
}

/* --- elements that begin --- */

static open_element *push(reader *r, open_kind kind, const sbfi_field *field) {
  open_element *element = sbfi_array_push(&r->open, 1);
  if (!element) {
    fail_memory(r);
    return NULL;
  }
  *element = (open_element){.kind = kind, .field = field};
  return element;
}

static bool begin_root(reader *r, const char *name, const sbfi_xml_attribute *attributes, uint32_t count) {
  const sbfi_element *element = &sbfi_asset_element;
  if (strcmp(name, element->xml) != 0) {
    fail(r, SBF_CODE_XML_NOT_SBF, NULL, "the root is <%.80s>, not <%s>: this is another kind of file", name,
        element->xml);
    return false;
  }
  open_element *self = push(r, OPEN_OBJECT, NULL);
  if (!self) return false;
  self->element = element;
  self->object = r->asset;
  const sbfi_field *version = sbfi_element_field(element, "version");
  /* read first, because it defines how the rest is read */
  for (uint32_t i = 0; i < count; i++)
    if (strcmp(attributes[i].name, version->name) == 0 &&
        !read_attribute(r, version, value_of(&attributes[i]), self->object))
      return false;
  r->minor = sbfi_version_minor(r->asset->version);
  switch (sbfi_version_check(r->asset->version)) {
  case SBFI_VERSION_KNOWN:
    break;
  case SBFI_VERSION_NEWER_MINOR:
    r->newer_minor = true;
    break;
  case SBFI_VERSION_TOO_NEW:
    return fail(r, SBF_CODE_VERSION_TOO_NEW, version,
        "the file has version %.20s, this library reads %s: update it", r->asset->version,
        SBF_FORMAT_VERSION);
  case SBFI_VERSION_MALFORMED:
    return fail(r, SBF_CODE_XML_BAD_VALUE, version,
        "`version` is `%.20s`, which does not have the form major.minor: write %s", r->asset->version,
        SBF_FORMAT_VERSION);
  }
  return read_attributes(r, attributes, count) && check_attributes(r);
}

/* Allocates a child with default values. */
static void *make_child(reader *r, void *parent, const sbfi_field *field, uint32_t *index) {
  void *child = NULL;
  if (field->type == SBFI_ONE) return (char *)parent + field->offset;
  if (field->type == SBFI_OPTIONAL) {
    child = sbfi_arena_allocate(r->arena, 1, field->element->struct_size);
    sbfi_set_pointer(parent, field, child);
  } else {
    row *siblings = row_of(r, field);
    if (siblings && siblings->children.count < UINT32_MAX) child = sbfi_array_push(&siblings->children, 1);
    if (child) {
      *index = (uint32_t)siblings->children.count - 1;
      r->row_bytes += field->element->struct_size;
    }
  }
  if (child) sbfi_element_init(field->element, child);
  return child;
}

static bool begin_child(reader *r, const sbfi_field *field, const char *name,
    const sbfi_xml_attribute *attributes, uint32_t count) {
  uint32_t index = 0;
  int32_t value;
  void *child = make_child(r, top_object(r)->object, field, &index);
  if (!child) return fail_memory(r);
  open_element *self = push(r, OPEN_OBJECT, field);
  if (!self) return false;
  self->element = field->element;
  self->object = child;
  self->index = index;
  if (sbfi_xml_is_child(field, name, &value) && value >= 0)
    sbfi_set_integer(child, sbfi_element_field(field->element, field->tag.by), value);
  return read_attributes(r, attributes, count) && check_attributes(r);
}

/* Takes the list with the number in an attribute `given`. */
static bool append_given(reader *r, const sbfi_xml_attribute *given) {
  uint32_t number;
  if (sbfi_parse_u32(given->value, given->length, &number) != SBFI_NUMBER_READ ||
      number >= r->options->given_list_count)
    return fail(r, SBF_CODE_XML_BAD_VALUE, NULL, "`given` does not name one of the %u lists that were passed",
        r->options->given_list_count);
  sbfi_xml_fault fault = sbfi_xml_list_append_given(&r->list, &r->options->given_lists[number]);
  return (!fault || fail_list(r, fault)) && (fits_memory(r) || fail_memory(r));
}

static bool begin_plain(reader *r, open_kind kind, const sbfi_field *field,
    const sbfi_xml_attribute *attributes, uint32_t count) {
  if (!push(r, kind, field)) return false;
  if (kind == OPEN_LIST) sbfi_xml_list_begin(&r->list, field);
  r->text.count = 0;
  if (kind == OPEN_LIST && count == 1 && r->options->given_list_count && !strcmp(attributes->name, "given"))
    return append_given(r, attributes);
  return !count || unknown_attribute(r, attributes[0].name);
}

static bool unknown_element(reader *r, const char *name) {
  const open_element *around = top(r);
  if (around->kind == OPEN_LIST || around->kind == OPEN_TEXT) {
    fail(r, SBF_CODE_XML_UNKNOWN_ELEMENT, NULL, "<%.60s> is inside `%s`, which can contain only text", name,
        around->field->name);
  } else if (r->newer_minor) {
    return leave_out(r, "/", name) && push(r, OPEN_SKIPPED, NULL) != NULL;
  } else if (around->kind == OPEN_WRAPPER) {
    fail(r, SBF_CODE_XML_UNKNOWN_ELEMENT, NULL, "<%s> cannot contain <%.60s>%s", around->field->tag.wrapper,
        name, sbfi_xml_suggest_child(around->field, name).at);
  } else if (sbfi_xml_find_attribute(around->element, around->field, name)) {
    fail(r, SBF_CODE_XML_UNKNOWN_ELEMENT, NULL, "`%.60s` is an attribute: write it inside the tag", name);
  } else {
    fail(r, SBF_CODE_XML_UNKNOWN_ELEMENT, NULL, "<%s> cannot contain <%.60s>%s", around->element->xml, name,
        sbfi_xml_suggest_element(around->element, name).at);
  }
  return extend_path(r, "/", name);
}

static bool begin_in_object(
    reader *r, const char *name, const sbfi_xml_attribute *attributes, uint32_t count) {
  open_element *around = top(r);
  const sbfi_field *field = sbfi_xml_find_element(around->element, name);
  if (!field) return unknown_element(r, name);
  if (field->since_minor > r->minor) return refuse_later(r, field);
  uint64_t bit = (uint64_t)1 << (field - around->element->fields);
  bool many = field->type == SBFI_MANY && !field->tag.wrapper;
  if (around->seen & bit && !many)
    return fail(r, SBF_CODE_XML_REPEATED, field, "<%.60s> occurs here a second time: merge the two", name);
  around->seen |= bit;
  if (field->type == SBFI_LIST) return begin_plain(r, OPEN_LIST, field, attributes, count);
  if (field->type == SBFI_TEXT) return begin_plain(r, OPEN_TEXT, field, attributes, count);
  if (field->tag.wrapper) return begin_plain(r, OPEN_WRAPPER, field, attributes, count);
  return begin_child(r, field, name, attributes, count);
}

static bool on_start(void *user, const char *name, const sbfi_xml_attribute *attributes, uint32_t count) {
  reader *r = user;
  int32_t value;
  if (r->open.count >= r->options->limits.depth)
    return fail(r, SBF_CODE_XML_TOO_DEEP, NULL, "<%.60s> is nested deeper than the limit of %u elements",
        name, r->options->limits.depth);
  if (r->open.count == 0) return begin_root(r, name, attributes, count);
  switch (top(r)->kind) {
  case OPEN_OBJECT:
    return begin_in_object(r, name, attributes, count);
  case OPEN_WRAPPER:
    if (!sbfi_xml_is_child(top(r)->field, name, &value)) return unknown_element(r, name);
    return begin_child(r, top(r)->field, name, attributes, count);
  case OPEN_SKIPPED:
    return push(r, OPEN_SKIPPED, NULL) != NULL;
  default:
    return unknown_element(r, name);
  }
}

/* --- text --- */

static uint32_t count_lines(const char *text, size_t length) {
  uint32_t lines = 0;
  for (size_t i = 0; i < length; i++) lines += text[i] == '\n';
  return lines;
}

static bool on_text(void *user, const char *text, size_t length) {
  reader *r = user;
  if (r->open.count == 0) return true;
  const open_element *self = top(r);
  size_t index;
  switch (self->kind) {
  case OPEN_LIST: {
    sbfi_xml_fault fault = sbfi_xml_list_add(&r->list, text, length, &index);
    if (fault) {
      fail_list(r, fault);
      if (fault < SBFI_XML_NOT_WHOLE) r->error->line -= count_lines(text + index, length - index);
      return false;
    }
    return fits_memory(r) || fail_memory(r);
  }
  case OPEN_TEXT:
    return (sbfi_array_append(&r->text, text, length) && fits_memory(r)) || fail_memory(r);
  case OPEN_SKIPPED:
    return true;
  default:
    for (size_t i = 0; i < length; i++)
      if (!sbfi_is_space(text[i])) {
        sbfi_span rest = {text + i, length - i}, line;
        sbfi_span_next_line(&rest, &line);
        fail(r, SBF_CODE_XML_STRAY_TEXT, NULL, "found text where only elements are allowed: `%.*s`",
            (int)sbfi_utf8_cut(line.at, line.length, 40), line.at);
        r->error->line -= count_lines(text + i, length - i);
        return false;
      }
    return true;
  }
}

/* --- elements that end --- */

static bool end_list(reader *r, const sbfi_field *field) {
  sbfi_xml_fault fault = sbfi_xml_list_end(&r->list);
  if (fault) return fail_list(r, fault);
  uint32_t count = sbfi_xml_list_count(&r->list);
  const void *items = sbfi_arena_copy(r->arena, r->list.scalars.at, count, sbfi_item_size(field));
  if (count && !items) return fail_memory(r);
  sbfi_set_list(top_object(r)->object, field, items, count);
  r->list.scalars.count = 0;
  return true;
}

static bool end_text(reader *r, const sbfi_field *field) {
  const char *text = sbfi_arena_string(r->arena, r->text.at, r->text.count);
  if (!text) return fail_memory(r);
  sbfi_set_pointer(top_object(r)->object, field, text);
  r->text.count = 0;
  return true;
}

static bool end_object(reader *r, const open_element *self) {
  for (uint32_t i = 0; i < self->element->field_count; i++) {
    const sbfi_field *field = &self->element->fields[i];
    if (field->type != SBFI_MANY || !(self->seen >> i & 1)) continue;
    row *found = find_row(r, field);
    if (!found || !found->children.count) continue; /* an empty wrapper */
    sbfi_array *children = &found->children;
    void *kept = sbfi_arena_copy(r->arena, children->at, children->count, children->item_size);
    if (!kept) return fail_memory(r);
    sbfi_set_list(self->object, field, kept, (uint32_t)children->count);
    r->row_bytes -= children->count * children->item_size;
    children->count = 0;
  }
  return true;
}

static bool on_end(void *user) {
  reader *r = user;
  const open_element *self = top(r);
  bool good = true;
  if (self->kind == OPEN_LIST) good = end_list(r, self->field);
  if (self->kind == OPEN_TEXT) good = end_text(r, self->field);
  if (self->kind == OPEN_OBJECT) good = end_object(r, self);
  if (good) r->open.count--;
  return good;
}

/* --- the document --- */

static void free_reader(reader *r) {
  row *rows = r->rows.at;
  for (size_t i = 0; i < r->rows.count; i++) sbfi_array_free(&rows[i].children);
  sbfi_array_free(&r->rows);
  sbfi_array_free(&r->open);
  sbfi_array_free(&r->text);
  sbfi_xml_list_free(&r->list);
}

sbf_status sbfi_xml_read_tree(const sbfi_xml_source *source, const sbf_load_options *options,
    sbf_asset *asset, sbfi_array *refs, sbf_diagnostic *error) {
  reader r = {.options = options, .asset = asset, .refs = refs, .error = error};
  r.arena = &sbfi_asset_box_of(asset)->arena;
  r.allocator = r.arena->allocator;
  r.events = (sbfi_xml_events){.start = on_start, .text = on_text, .end = on_end, .user = &r};
  sbfi_array_init(&r.open, &r.allocator, sizeof(open_element));
  sbfi_array_init(&r.rows, &r.allocator, sizeof(row));
  sbfi_array_init(&r.text, &r.allocator, 1);
  sbfi_xml_list_init(&r.list, &r.allocator, options->limits.list_items);
  sbf_status status = sbfi_xml_parse(source, &r.events, &r.allocator, error);
  if (status != SBF_OK)
    write_path(&r, NULL, error->path, sizeof error->path);
  else
    status = r.status;
  if (status == SBF_OK && r.newer_minor) { /* unknown content was skipped */
    sbfi_report_left_out(options, asset->version, r.left_out, r.first_left_out);
    asset->version = SBF_FORMAT_VERSION;
  }
  free_reader(&r);
  return status;
}
