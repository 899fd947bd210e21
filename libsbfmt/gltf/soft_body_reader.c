/* JSON of the extension to structs: one walk along the schema tables, without knowledge of individual
 * elements. */
#include "gltf/soft_body_reader.h"

#include <stdio.h>

#include "base/diagnostic.h"
#include "base/number.h"
#include "model/element_path.h"

typedef struct reading {
  sbfi_gltf_reader *reader;
  const sbfi_element_path *path; /* of the object being filled */
  char *object;
  uint32_t depth;
} reading;

__attribute__((format(printf, 4, 5))) static bool fault(
    const reading *r, sbf_code code, const sbfi_field *field, const char *format, ...) {
  sbf_diagnostic *error = r->reader->file.error;
  va_list arguments;
  va_start(arguments, format);
  sbfi_diagnose_v(error, code, format, arguments);
  va_end(arguments);
  if (error) sbfi_element_path_print(r->path, field, error->path, sizeof error->path);
  return false;
}

/* Adds the place to an error that a list's reader has set. */
static bool placed(const reading *r, const sbfi_field *field) {
  sbf_diagnostic *error = r->reader->file.error;
  if (error) sbfi_element_path_print(r->path, field, error->path, sizeof error->path);
  return false;
}

static bool no_memory(const reading *r, const sbfi_field *field) {
  return fault(r, SBF_CODE_OUT_OF_MEMORY, field,
      "no memory for `%s`, or more than the limit of %llu bytes in all", field->name,
      (unsigned long long)r->reader->options.limits.memory_bytes);
}

/* --- values --- */

static bool read_scalar(const reading *r, const sbfi_field *field, const sbfi_json *json, char *to) {
  const char *text = json->text.at;
  size_t length = json->text.length;
  bool is_number = json->type == SBFI_JSON_NUMBER, good;
  if (field->type == SBFI_INT) {
    int32_t value = 0;
    good = is_number && sbfi_parse_i32(text, length, &value) == SBFI_NUMBER_READ;
    memcpy(to, &value, sizeof value);
  } else if (field->type == SBFI_UINT || field->type == SBFI_REF) {
    uint32_t value = 0;
    good = is_number && sbfi_parse_u32(text, length, &value) == SBFI_NUMBER_READ &&
           (field->type == SBFI_UINT || value <= INT32_MAX);
    memcpy(to, &value, sizeof value);
  } else {
    float value = 0;
    good = is_number && sbfi_parse_f32(text, length, &value) == SBFI_NUMBER_READ;
    memcpy(to, &value, sizeof value);
  }
  return good || fault(r, SBF_CODE_GLTF_EXTENSION, field, "`%s` is not a number of its type", field->name);
}

static bool read_vector(const reading *r, const sbfi_field *field, const sbfi_json *json) {
  if (json->type != SBFI_JSON_ARRAY || json->count != field->width)
    return fault(
        r, SBF_CODE_GLTF_EXTENSION, field, "`%s` is not an array of %u numbers", field->name, field->width);
  for (uint32_t i = 0; i < field->width; i++)
    if (!read_scalar(r, field, &json->items[i], r->object + field->offset + 4 * (size_t)i)) return false;
  return true;
}

static bool read_enum(const reading *r, const sbfi_field *field, const sbfi_json *json) {
  for (uint32_t i = 0; i < field->words.count; i++)
    if (sbfi_json_is_string(json, field->words.at[i])) {
      sbfi_set_integer(r->object, field, (int32_t)i);
      return true;
    }
  return fault(r, SBF_CODE_GLTF_EXTENSION, field, "`%s` has a value that is none of its names", field->name);
}

static bool read_text(const reading *r, const sbfi_field *field, const sbfi_json *json) {
  if (json->type != SBFI_JSON_STRING)
    return fault(r, SBF_CODE_GLTF_EXTENSION, field, "`%s` is not a string", field->name);
  const char *text = "";
  if (json->text.length && !(text = sbfi_arena_string(r->reader->arena, json->text.at, json->text.length)))
    return no_memory(r, field);
  sbfi_set_pointer(r->object, field, text);
  return true;
}

static bool read_list(const reading *r, const sbfi_field *field, const sbfi_json *json) {
  const sbfi_gltf_list list = {field->name, field->item, field->width};
  const void *items = NULL;
  uint32_t count;
  if (sbfi_gltf_is_borrowed(json)) {
    r->reader->borrowed_count++;
    return true;
  }
  if (!sbfi_gltf_read_list(r->reader, json, &list, r->reader->arena, &items, &count)) return placed(r, field);
  sbfi_set_list(r->object, field, items, count);
  return true;
}

/* --- children --- */

static bool read_members(const reading *r, const sbfi_json *json);

static bool read_child(
    const reading *r, const sbfi_field *field, uint32_t index, void *child, const sbfi_json *json) {
  sbfi_element_path path = sbfi_element_path_child(r->path, field, index);
  reading inner = {r->reader, &path, child, r->depth + 1};
  return read_members(&inner, json);
}

static void init_child(const sbfi_field *field, void *child) {
  sbfi_element_init(field->element, child);
  sbfi_child_fix(field, child);
}

static bool read_optional(const reading *r, const sbfi_field *field, const sbfi_json *json) {
  void *child = sbfi_arena_allocate(r->reader->arena, 1, field->element->struct_size);
  if (!child) return no_memory(r, field);
  init_child(field, child);
  sbfi_set_pointer(r->object, field, child);
  return read_child(r, field, 0, child, json);
}

static bool read_children(const reading *r, const sbfi_field *field, const sbfi_json *json) {
  if (json->type != SBFI_JSON_ARRAY)
    return fault(r, SBF_CODE_GLTF_EXTENSION, field, "`%s` is not an array", field->name);
  if (!json->count) return true;
  size_t size = field->element->struct_size;
  char *children = sbfi_arena_allocate(r->reader->arena, json->count, size);
  if (!children) return no_memory(r, field);
  for (uint32_t i = 0; i < json->count; i++) init_child(field, children + i * size);
  sbfi_set_list(r->object, field, children, json->count);
  for (uint32_t i = 0; i < json->count; i++)
    if (!read_child(r, field, i, children + i * size, &json->items[i])) return false;
  return true;
}

/* --- members --- */

static bool read_member(const reading *r, const sbfi_field *field, const sbfi_json *json) {
  switch (field->type) {
  case SBFI_BOOL:
    if (json->type != SBFI_JSON_TRUE && json->type != SBFI_JSON_FALSE)
      return fault(r, SBF_CODE_GLTF_EXTENSION, field, "`%s` is neither true nor false", field->name);
    *(bool *)(r->object + field->offset) = json->type == SBFI_JSON_TRUE;
    return true;
  case SBFI_INT:
  case SBFI_UINT:
  case SBFI_FLOAT:
  case SBFI_REF:
    return read_scalar(r, field, json, r->object + field->offset);
  case SBFI_VEC2:
  case SBFI_VEC3:
  case SBFI_VEC4:
  case SBFI_QUAT:
    return read_vector(r, field, json);
  case SBFI_ENUM:
    return read_enum(r, field, json);
  case SBFI_STRING:
  case SBFI_TEXT:
  case SBFI_ID:
    return read_text(r, field, json);
  case SBFI_LIST:
    return read_list(r, field, json);
  case SBFI_ONE:
    return read_child(r, field, 0, r->object + field->offset, json);
  case SBFI_OPTIONAL:
    return read_optional(r, field, json);
  case SBFI_MANY:
    return read_children(r, field, json);
  }
  return true;
}

static bool skip_member(const reading *r, const char *name) {
  sbfi_gltf_reader *reader = r->reader;
  if (strcmp(name, "gltf") == 0 || strcmp(name, "extras") == 0 || strcmp(name, "extensions") == 0)
    return true;
  if (!reader->newer)
    return fault(r, SBF_CODE_GLTF_EXTENSION, NULL, "the member `%.60s` is unknown here", name);
  if (reader->left_out++ == 0) {
    char path[100];
    sbfi_element_path_print(r->path, NULL, path, sizeof path);
    snprintf(reader->first_left_out, sizeof reader->first_left_out, "%.50s of %s", name, path);
  }
  return true;
}

static bool check_required(const reading *r, uint64_t seen) {
  const sbfi_element *element = r->path->element;
  for (uint32_t i = 0; i < element->field_count; i++)
    if (element->fields[i].required && !(seen >> i & 1))
      return fault(
          r, SBF_CODE_REQUIRED_MISSING, &element->fields[i], "`%s` must be given", element->fields[i].name);
  return true;
}

static bool read_members(const reading *r, const sbfi_json *json) {
  const sbfi_element *element = r->path->element;
  uint64_t seen = 0;
  if (json->type != SBFI_JSON_OBJECT)
    return fault(r, SBF_CODE_GLTF_EXTENSION, NULL, "the element is not an object");
  if (r->depth > r->reader->options.limits.depth)
    return fault(r, SBF_CODE_GLTF_EXTENSION, NULL,
        "elements lie inside each other deeper than the limit of %u", r->reader->options.limits.depth);
  for (uint32_t i = 0; i < json->count; i++) {
    const sbfi_field *field = sbfi_element_field(element, json->names[i].at);
    if (!field) {
      if (!skip_member(r, json->names[i].at)) return false;
      continue;
    }
    if (field->since_minor > r->reader->minor)
      return fault(r, SBF_CODE_VERSION_FIELD, field, "`%s` is of version 1.%u, and the file states 1.%u",
          field->name, field->since_minor, r->reader->minor);
    if (!read_member(r, field, &json->items[i])) return false;
    seen |= (uint64_t)1 << (field - element->fields);
  }
  return check_required(r, seen);
}

sbf_status sbfi_gltf_read_asset(sbfi_gltf_reader *reader, const sbfi_json *extension, sbf_asset *asset) {
  sbfi_element_path path = sbfi_element_path_root(asset);
  reading r = {reader, &path, (char *)asset, 1};
  if (read_members(&r, extension) && sbfi_gltf_restore(reader, extension, asset)) return SBF_OK;
  return sbf_code_find(reader->file.error->code)->fault;
}
