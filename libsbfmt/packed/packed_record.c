/* Records to structs: one walk along the schema tables, without knowledge of individual elements. */
#include <stdio.h>

#include "base/diagnostic.h"
#include "model/asset_box.h"
#include "packed/packed_filter.h"
#include "packed/packed_reader.h"

/* A piece of a record: fields from `at` to `end`. */
typedef struct span {
  const sbfi_packed_record *record;
  size_t at, end;
} span;

/* The part whose record is being read. */
typedef struct part_context {
  /* kind, owner, level; field: the part's field that contains the current object */
  sbfi_packed_chunk address;
  uint32_t depth;     /* current nesting depth of elements */
  bool without_lists; /* lists of the part stay empty */
} part_context;

/* Which fields of an element a record contains: a part's label is in its parent's record. */
typedef enum field_set { ALL_FIELDS, LABEL_FIELDS, FIELDS_BUT_LABEL } field_set;

static bool is_in(field_set set, const sbfi_field *field) {
  return set == ALL_FIELDS || (set == LABEL_FIELDS) == sbfi_packed_is_label(field);
}

typedef struct reading {
  sbfi_packed_reader *reader;
  const part_context *part;
  const sbfi_element_path *path; /* of the object being filled */
  char *object;
} reading;

__attribute__((format(printf, 5, 6))) static sbf_status fault(
    const reading *r, sbf_code code, const span *s, const sbfi_field *field, const char *format, ...) {
  sbf_diagnostic *error = r->reader->error;
  va_list arguments;
  va_start(arguments, format);
  sbf_status status = sbfi_diagnose_v(error, code, format, arguments);
  va_end(arguments);
  if (!error) return status;
  const sbfi_packed_chunk *chunk = &r->reader->table.chunks[s->record->number];
  error->offset = (int64_t)(chunk->offset + (s->record->allocated ? 0 : s->at));
  sbfi_element_path_print(r->path, field, error->path, sizeof error->path);
  return status;
}

static sbf_status no_memory(const reading *r, const span *s, const sbfi_field *field) {
  return fault(r, SBF_CODE_OUT_OF_MEMORY, s, field,
      "no memory for `%s`, or more than the limit of %llu bytes in all", field->name,
      (unsigned long long)r->reader->options.limits.memory_bytes);
}

static sbf_status read_fields(const reading *r, span s, field_set set);

/* Reads a child whose fields are in this record. */
static sbf_status read_child(
    const reading *r, span s, const sbfi_field *field, uint32_t index, void *child, field_set set) {
  sbfi_element_path path = sbfi_element_path_child(r->path, field, index);
  part_context within = *r->part;
  if (within.address.field == 0) within.address.field = field->number;
  within.depth++;
  reading inner = {r->reader, &within, &path, child};
  return read_fields(&inner, s, set);
}

static void init_child(const sbfi_field *field, void *child) {
  sbfi_element_init(field->element, child);
  sbfi_child_fix(field, child);
}

static uint32_t read_u32(span *s) {
  uint32_t value = sbfi_get_u32(s->record->at + s->at);
  s->at += 4;
  return value;
}

/* --- values --- */

static sbf_status read_value(const reading *r, const span *s, const sbfi_field *field) {
  const uint8_t *from = s->record->at + s->at;
  char *to = r->object + field->offset;
  if (s->end - s->at != (size_t)field->width * 4)
    return fault(r, SBF_CODE_PACKED_RECORD, s, field, "`%s` has %zu bytes instead of %u", field->name,
        s->end - s->at, field->width * 4);
  if (field->type == SBFI_BOOL) {
    uint32_t value = sbfi_get_u32(from);
    if (value > 1)
      return fault(r, SBF_CODE_PACKED_RECORD, s, field, "`%s` is %u, which is neither false nor true",
          field->name, value);
    *(bool *)to = value != 0;
    return SBF_OK;
  }
  for (uint32_t i = 0; i < field->width; i++) {
    uint32_t value = sbfi_get_u32(from + 4 * i);
    memcpy(to + 4 * i, &value, sizeof value);
  }
  return SBF_OK;
}

static sbf_status read_text(const reading *r, const span *s, const sbfi_field *field) {
  const char *from = (const char *)s->record->at + s->at, *text = "";
  size_t length = s->end - s->at;
  if (length && memchr(from, 0, length))
    return fault(r, SBF_CODE_BAD_TEXT, s, field, "`%s` has a NUL character: remove it", field->name);
  if (length && !(text = sbfi_arena_string(r->reader->arena, from, length))) return no_memory(r, s, field);
  sbfi_set_pointer(r->object, field, text);
  return SBF_OK;
}

/* --- lists --- */

static void unfilter_list(
    sbfi_packed_filter filter, const uint8_t *from, size_t count, uint32_t width, uint8_t *to) {
  for (size_t done = 0; done < count; done += SBFI_FILTER_BLOCK) {
    size_t some = count - done < SBFI_FILTER_BLOCK ? count - done : SBFI_FILTER_BLOCK;
    sbfi_unfilter_block(filter, from + 4 * done, some, width, to, done);
  }
}

static sbf_status read_list(
    const reading *r, const span *s, const sbfi_field *field, sbfi_packed_filter filter) {
  size_t size = s->end - s->at, item_size = sbfi_item_size(field), count = size / item_size;
  if (r->part->without_lists || size == 0) return SBF_OK;
  if (size % item_size)
    return fault(r, SBF_CODE_PACKED_RECORD, s, field, "`%s` has %zu bytes, which is not a multiple of %zu",
        field->name, size, item_size);
  if (count > r->reader->options.limits.list_items)
    return fault(r, SBF_CODE_LIST_TOO_LONG, s, field,
        "`%s` has %zu items, more than the limit of %u: raise it if the file is trusted", field->name, count,
        r->reader->options.limits.list_items);
  const uint8_t *from = s->record->at + s->at;
  uint8_t *items = sbfi_arena_allocate(r->reader->arena, count, item_size);
  if (!items) return no_memory(r, s, field);
  if (filter != SBFI_FILTER_NONE) {
    unfilter_list(filter, from, size / 4, field->width, items);
  } else {
    memcpy(items, from, size);
    if (field->item != SBFI_ITEM_U8) sbfi_scalars_to_host(items, size / 4);
  }
  sbfi_set_list(r->object, field, items, (uint32_t)count);
  return SBF_OK;
}

/* Reads the index of a chunk and the number of the list in it. */
static sbf_status read_chunk_list(const reading *r, span s, const sbfi_field *field) {
  if (s.end - s.at != 4)
    return fault(r, SBF_CODE_PACKED_RECORD, &s, field, "`%s` does not name a chunk", field->name);
  if (r->part->without_lists) return SBF_OK;
  uint32_t number = read_u32(&s);
  sbfi_packed_chunk wanted = r->part->address;
  wanted.list = field->number;
  if (wanted.field == 0) wanted.field = field->number;
  const void *items;
  sbf_status status = sbfi_packed_claim(r->reader, number, &wanted);
  if (status == SBF_OK) status = sbfi_packed_fetch_list(r->reader, number, field, &items);
  if (status == SBF_OK)
    sbfi_set_list(r->object, field, items, (uint32_t)r->reader->table.chunks[number].count);
  else if (r->reader->error)
    sbfi_element_path_print(r->path, field, r->reader->error->path, sizeof r->reader->error->path);
  return status;
}

/* Reads the item count of a list in an outline, which has no items. */
static sbf_status read_count(const reading *r, span s, const sbfi_field *field) {
  if (s.end - s.at != 4)
    return fault(r, SBF_CODE_PACKED_RECORD, &s, field, "`%s` does not state its count", field->name);
  uint32_t count = read_u32(&s);
  if (count > r->reader->options.limits.list_items)
    return fault(r, SBF_CODE_LIST_TOO_LONG, &s, field,
        "`%s` has %u items, more than the limit of %u: raise it if the file is trusted", field->name, count,
        r->reader->options.limits.list_items);
  sbfi_set_list(r->object, field, NULL, count);
  return SBF_OK;
}

/* --- children --- */

static sbf_status read_optional(const reading *r, const span *s, const sbfi_field *field) {
  void *child = sbfi_arena_allocate(r->reader->arena, 1, field->element->struct_size);
  if (!child) return no_memory(r, s, field);
  init_child(field, child);
  sbfi_set_pointer(r->object, field, child);
  return read_child(r, *s, field, 0, child, ALL_FIELDS);
}

/* Reads the number of children and allocates them; each takes at least `min` bytes of the record. */
static sbf_status make_children(
    const reading *r, span *s, const sbfi_field *field, size_t min, char **children, uint32_t *count) {
  *count = 0;
  if (s->end - s->at < 4)
    return fault(r, SBF_CODE_PACKED_RECORD, s, field, "the count of `%s` is truncated", field->name);
  uint32_t stated = read_u32(s);
  if (stated > (s->end - s->at) / min)
    return fault(r, SBF_CODE_PACKED_RECORD, s, field, "%u `%s` do not fit into %zu bytes", stated,
        field->name, s->end - s->at);
  if (stated > r->reader->options.limits.list_items)
    return fault(r, SBF_CODE_LIST_TOO_LONG, s, field,
        "there are %u `%s`, more than the limit of %u: raise it if the file is trusted", stated, field->name,
        r->reader->options.limits.list_items);
  if (stated == 0) return SBF_OK;
  *children = sbfi_arena_allocate(r->reader->arena, stated, field->element->struct_size);
  if (!*children) return no_memory(r, s, field);
  for (uint32_t i = 0; i < stated; i++)
    init_child(field, *children + (size_t)i * field->element->struct_size);
  *count = stated;
  sbfi_set_list(r->object, field, *children, stated);
  return SBF_OK;
}

/* Reads a size and splits a piece of that size off the front of `s`. */
static sbf_status read_piece(const reading *r, span *s, const sbfi_field *field, span *piece) {
  if (s->end - s->at < 4)
    return fault(r, SBF_CODE_PACKED_RECORD, s, field, "one of the `%s` is truncated", field->name);
  uint32_t size = read_u32(s);
  if (size > s->end - s->at)
    return fault(r, SBF_CODE_PACKED_RECORD, s, field, "one of the `%s` has %u bytes, but only %zu are left",
        field->name, size, s->end - s->at);
  *piece = (span){s->record, s->at, s->at + size};
  s->at += size;
  return SBF_OK;
}

static sbf_status check_end(const reading *r, const span *s, const sbfi_field *field) {
  if (s->at == s->end) return SBF_OK;
  return fault(
      r, SBF_CODE_PACKED_RECORD, s, field, "%zu bytes are left over after `%s`", s->end - s->at, field->name);
}

static sbf_status read_records(const reading *r, span s, const sbfi_field *field) {
  char *children = NULL;
  uint32_t count;
  span piece;
  sbf_status status = make_children(r, &s, field, 4, &children, &count);
  for (uint32_t i = 0; status == SBF_OK && i < count; i++) {
    char *child = children + (size_t)i * field->element->struct_size;
    status = read_piece(r, &s, field, &piece);
    if (status == SBF_OK) status = read_child(r, piece, field, i, child, ALL_FIELDS);
  }
  return status == SBF_OK ? check_end(r, &s, field) : status;
}

/* --- parts --- */

static sbf_status read_part(sbfi_packed_reader *reader, uint32_t number, const part_context *part,
    const sbfi_element_path *path, void *object, field_set set) {
  sbfi_packed_record record;
  sbf_status status = sbfi_packed_claim(reader, number, &part->address);
  if (status == SBF_OK) status = sbfi_packed_fetch_record(reader, number, &record);
  if (status != SBF_OK) {
    if (reader->error) sbfi_element_path_print(path, NULL, reader->error->path, sizeof reader->error->path);
    return status;
  }
  const reading r = {reader, part, path, object};
  status = read_fields(&r, (span){&record, 0, record.size}, set);
  sbfi_packed_release_record(reader, &record);
  return status;
}

static part_context part_inside(const part_context *outer, const sbfi_element *element, uint32_t index) {
  part_context inner = {.depth = outer->depth + 1};
  inner.address.kind = element->kind;
  bool in_root = outer->address.kind == sbfi_asset_element.kind;
  inner.address.owner = in_root ? index : outer->address.owner;
  inner.address.level = in_root ? SBFI_PACKED_NO_LEVEL : index;
  return inner;
}

static sbf_status read_parts(const reading *r, span s, const sbfi_field *field) {
  char *children = NULL;
  uint32_t count;
  sbf_status status = make_children(r, &s, field, 8, &children, &count);
  for (uint32_t i = 0; status == SBF_OK && i < count; i++) {
    char *child = children + (size_t)i * field->element->struct_size;
    span label;
    if (s.end - s.at < 4)
      return fault(r, SBF_CODE_PACKED_RECORD, &s, field, "one of the `%s` is truncated", field->name);
    uint32_t number = read_u32(&s);
    status = read_piece(r, &s, field, &label);
    if (status == SBF_OK) status = read_child(r, label, field, i, child, LABEL_FIELDS);
    if (status != SBF_OK) return status;
    sbfi_element_path path = sbfi_element_path_child(r->path, field, i);
    if (!sbfi_packed_selects(r->reader->options.selection, &path)) continue;
    part_context inner = part_inside(r->part, field->element, i);
    status = read_part(r->reader, number, &inner, &path, child, FIELDS_BUT_LABEL);
  }
  return status == SBF_OK ? check_end(r, &s, field) : status;
}

/* --- fields --- */

static sbfi_packed_form form_of(const sbfi_field *field, bool outline, uint16_t stated) {
  switch (field->type) {
  case SBFI_STRING:
  case SBFI_TEXT:
  case SBFI_ID:
    return SBFI_FORM_TEXT;
  case SBFI_LIST:
    if (outline) return SBFI_FORM_COUNT;
    if (stated == SBFI_FORM_CHUNK) return SBFI_FORM_CHUNK;
    if (field->item == SBFI_ITEM_U8) return SBFI_FORM_LIST;
    return stated == SBFI_FORM_PLANES || stated == SBFI_FORM_DELTA ? (sbfi_packed_form)stated
                                                                   : SBFI_FORM_LIST;
  case SBFI_ONE:
  case SBFI_OPTIONAL:
    return SBFI_FORM_RECORD;
  case SBFI_MANY:
    return field->element->kind && !outline ? SBFI_FORM_PARTS : SBFI_FORM_RECORDS;
  default:
    return SBFI_FORM_VALUE;
  }
}

static sbf_status read_field(const reading *r, span s, const sbfi_field *field, uint16_t stated) {
  sbfi_packed_form form = form_of(field, r->reader->has_outline, stated);
  if (form != stated)
    return fault(r, SBF_CODE_PACKED_RECORD, &s, field, "`%s` has form %u instead of form %u", field->name,
        stated, (unsigned)form);
  switch (form) {
  case SBFI_FORM_VALUE:
    return read_value(r, &s, field);
  case SBFI_FORM_TEXT:
    return read_text(r, &s, field);
  case SBFI_FORM_LIST:
    return read_list(r, &s, field, SBFI_FILTER_NONE);
  case SBFI_FORM_PLANES:
    return read_list(r, &s, field, SBFI_FILTER_PLANES);
  case SBFI_FORM_DELTA:
    return read_list(r, &s, field, SBFI_FILTER_DELTA);
  case SBFI_FORM_CHUNK:
    return read_chunk_list(r, s, field);
  case SBFI_FORM_RECORD:
    if (field->type == SBFI_OPTIONAL) return read_optional(r, &s, field);
    return read_child(r, s, field, 0, r->object + field->offset, ALL_FIELDS);
  case SBFI_FORM_RECORDS:
    return read_records(r, s, field);
  case SBFI_FORM_PARTS:
    return read_parts(r, s, field);
  case SBFI_FORM_COUNT:
    return read_count(r, s, field);
  }
  return SBF_OK;
}

static sbf_status check_required(const reading *r, const span *s, field_set set, uint64_t seen) {
  const sbfi_element *element = r->path->element;
  for (uint32_t i = 0; i < element->field_count; i++) {
    const sbfi_field *field = &element->fields[i];
    if (field->required && is_in(set, field) && !(seen >> i & 1))
      return fault(r, SBF_CODE_REQUIRED_MISSING, s, field, "`%s` is required", field->name);
  }
  return SBF_OK;
}

/* Fields are ordered by number; skips those of a later version. */
static sbf_status read_fields(const reading *r, span s, field_set set) {
  const sbfi_element *element = r->path->element;
  uint32_t last = 0;
  uint64_t seen = 0;
  if (r->part->depth > r->reader->options.limits.depth)
    return fault(r, SBF_CODE_PACKED_RECORD, &s, NULL, "elements are nested deeper than the limit of %u",
        r->reader->options.limits.depth);
  while (s.at < s.end) {
    if (s.end - s.at < SBFI_PACKED_FIELD_SIZE)
      return fault(r, SBF_CODE_PACKED_RECORD, &s, NULL, "a field is truncated");
    const uint8_t *head = s.record->at + s.at;
    uint16_t number = sbfi_get_u16(head), form = sbfi_get_u16(head + 2);
    uint32_t size = sbfi_get_u32(head + 4);
    size_t padded = (size_t)size + (-(size_t)size & 3), left = s.end - s.at - SBFI_PACKED_FIELD_SIZE;
    if (number <= last)
      return fault(r, SBF_CODE_PACKED_RECORD, &s, NULL, "field %u comes after field %u", number, last);
    if (size > left || padded > left)
      return fault(r, SBF_CODE_PACKED_RECORD, &s, NULL, "field %u has %u bytes, but only %zu are left",
          number, size, left);
    span payload = {s.record, s.at + SBFI_PACKED_FIELD_SIZE, s.at + SBFI_PACKED_FIELD_SIZE + size};
    bool known = number <= element->field_count && is_in(set, &element->fields[number - 1]);
    if (known && element->fields[number - 1].since_minor > r->reader->table.header.minor)
      return fault(r, SBF_CODE_VERSION_FIELD, &s, &element->fields[number - 1],
          "`%s` needs version 1.%u, but the file states 1.%u", element->fields[number - 1].name,
          element->fields[number - 1].since_minor, r->reader->table.header.minor);
    if (known) {
      sbf_status status = read_field(r, payload, &element->fields[number - 1], form);
      if (status != SBF_OK) return status;
      seen |= (uint64_t)1 << (number - 1);
    } else if (!r->reader->table.newer || number <= element->field_count) {
      return fault(r, SBF_CODE_PACKED_RECORD, &s, NULL, "field %u is not allowed here", number);
    } else if (r->reader->left_out++ == 0) {
      char path[120];
      sbfi_element_path_print(r->path, NULL, path, sizeof path);
      snprintf(r->reader->first_left_out, sizeof r->reader->first_left_out, "field %u of %s", number, path);
    }
    last = number;
    s.at = payload.at + padded;
  }
  return check_required(r, &s, set, seen);
}

sbf_status sbfi_packed_read_asset(sbfi_packed_reader *reader, sbf_asset *asset) {
  sbfi_element_path path = sbfi_element_path_root(asset);
  part_context root = {
      .depth = 1, .without_lists = !sbfi_packed_selects_root_lists(reader->options.selection)};
  root.address.kind = sbfi_asset_element.kind;
  root.address.level = SBFI_PACKED_NO_LEVEL;
  if (reader->has_outline) root.address.kind = SBFI_PACKED_OUTLINE;
  return read_part(reader, 0, &root, &path, asset, ALL_FIELDS);
}
