/* Structs to records: the inverse of packed_record.c, one walk along the schema tables. */
#include "packed/packed_plan.h"

#include "base/memory.h"
#include "packed/packed_attempt.h"
#include "packed/packed_filter.h"

/* A part whose record is still to be written; the queue starts with the root. */
typedef struct queued_part {
  const sbfi_element *element;
  const void *object;
  sbfi_packed_chunk address; /* kind, owner, level */
  size_t record_begin, record_end;
} queued_part;

typedef struct planner {
  sbfi_text *to;
  sbfi_packed_coder *coder; /* NULL: nothing will be compressed */
  sbfi_array parts;         /* queued_part */
  sbfi_array lists;         /* sbfi_planned_chunk */
  uint32_t part_count;
  size_t outline_begin;
  bool outline; /* writes counts instead of lists, and parts inline */
  /* of the current part; field: the part's field that contains the current object */
  sbfi_packed_chunk address;
  sbfi_planned result;
} planner;

typedef enum field_set { ALL_FIELDS, LABEL_FIELDS, FIELDS_BUT_LABEL } field_set;

static void put_u32(planner *p, uint32_t value) {
  uint8_t bytes[4];
  sbfi_put_u32(bytes, value);
  sbfi_text_append(p->to, bytes, sizeof bytes);
}

/* Reserves a size that end_size fills in. */
static size_t begin_size(planner *p) {
  put_u32(p, 0);
  return p->to->length;
}

static void end_size(planner *p, size_t begin) {
  size_t size = p->to->length - begin;
  if (p->to->failed) return;
  if (size > UINT32_MAX - 3) p->result = SBFI_PLANNED_TOO_LARGE;
  sbfi_put_u32((uint8_t *)p->to->at + begin - 4, (uint32_t)size);
}

static size_t begin_field(planner *p, const sbfi_field *field, sbfi_packed_form form) {
  uint8_t head[4];
  sbfi_put_u16(head, field->number);
  sbfi_put_u16(head + 2, (uint16_t)form);
  sbfi_text_append(p->to, head, sizeof head);
  return begin_size(p);
}

static void end_field(planner *p, size_t begin) {
  end_size(p, begin);
  sbfi_text_repeat(p->to, 0, (0u - (p->to->length - begin)) & 3);
}

static void write_fields(planner *p, const sbfi_element *element, const void *object, field_set set);

static void write_child(planner *p, const sbfi_field *field, const void *child, field_set set) {
  uint16_t outer = p->address.field;
  if (outer == 0) p->address.field = field->number;
  write_fields(p, field->element, child, set);
  p->address.field = outer;
}

/* --- values --- */

static bool is_default(const sbfi_field *field, const void *object) {
  const char *destination = (const char *)object + field->offset;
  const int32_t none = SBF_NONE;
  switch (field->type) {
  case SBFI_BOOL:
    return *(const bool *)destination == (field->initial.integer != 0);
  case SBFI_INT:
  case SBFI_UINT:
  case SBFI_ENUM:
    return memcmp(destination, &field->initial.integer, sizeof field->initial.integer) == 0;
  case SBFI_REF:
    return memcmp(destination, &none, sizeof none) == 0;
  case SBFI_STRING:
  case SBFI_TEXT:
  case SBFI_ID:
    return strcmp(sbfi_get_pointer(object, field), field->initial.text) == 0;
  case SBFI_LIST:
  case SBFI_MANY:
    return sbfi_get_list(object, field).count == 0;
  case SBFI_OPTIONAL:
    return sbfi_get_pointer(object, field) == NULL;
  case SBFI_ONE:
    return false;
  default: /* floats and vectors, compared bit by bit: -0 differs from 0 */
    return memcmp(destination, field->initial.scalars, field->width * sizeof(float)) == 0;
  }
}

static void write_value(planner *p, const sbfi_field *field, const void *object) {
  const char *destination = (const char *)object + field->offset;
  size_t begin = begin_field(p, field, SBFI_FORM_VALUE);
  for (uint32_t i = 0; i < field->width; i++) {
    uint32_t value;
    if (field->type == SBFI_BOOL)
      value = *(const bool *)destination;
    else
      memcpy(&value, destination + 4 * i, sizeof value);
    put_u32(p, value);
  }
  end_field(p, begin);
}

/* --- lists --- */

static void write_chunk_list(planner *p, const sbfi_field *field, sbfi_list list) {
  sbfi_planned_chunk *planned = sbfi_array_push(&p->lists, 1);
  if (!planned) {
    p->result = SBFI_PLANNED_NO_MEMORY;
    return;
  }
  uint64_t size = (uint64_t)list.count * sbfi_item_size(field);
  *planned = (sbfi_planned_chunk){.chunk = p->address, .at = list.at, .item = field->item};
  sbfi_packed_chunk *chunk = &planned->chunk;
  chunk->list = field->number;
  if (chunk->field == 0) chunk->field = field->number;
  chunk->stride = sbfi_item_size(field);
  chunk->count = list.count;
  chunk->raw_size = chunk->stored_size = size;
  size_t begin = begin_field(p, field, SBFI_FORM_CHUNK);
  put_u32(p, p->part_count + (uint32_t)(p->lists.count - 1));
  end_field(p, begin);
}

/* Filters do not pay off for fewer bytes. */
enum { FILTERED_FROM = 64 };

/* Writes the list with the filter that compresses best with the rest of the record; false if that is none. */
static bool write_filtered_list(planner *p, const sbfi_field *field, sbfi_list list) {
  size_t size = (size_t)list.count * sbfi_item_size(field);
  sbfi_packed_filter filter;
  uint8_t planes[SBFI_PACKED_CHUNK_FROM_COMPRESSED];
  if (!p->coder || field->item == SBFI_ITEM_U8 || size < FILTERED_FROM) return false;
  if (!sbfi_packed_best_filter(p->coder, list.at, size, sbfi_item_size(field), &filter)) {
    p->result = SBFI_PLANNED_NO_MEMORY;
    return false;
  }
  if (filter == SBFI_FILTER_NONE) return false;
  sbfi_filter_block(filter, list.at, 0, size / 4, field->width, planes);
  size_t begin = begin_field(p, field, filter == SBFI_FILTER_PLANES ? SBFI_FORM_PLANES : SBFI_FORM_DELTA);
  sbfi_text_append(p->to, planes, size);
  end_field(p, begin);
  return true;
}

static void write_list(planner *p, const sbfi_field *field, const void *object) {
  sbfi_list list = sbfi_get_list(object, field);
  size_t size = (size_t)list.count * sbfi_item_size(field);
  if (p->outline) {
    size_t count_begin = begin_field(p, field, SBFI_FORM_COUNT);
    put_u32(p, list.count);
    end_field(p, count_begin);
    return;
  }
  if (size >= (p->coder ? SBFI_PACKED_CHUNK_FROM_COMPRESSED : SBFI_PACKED_CHUNK_FROM)) {
    write_chunk_list(p, field, list);
    return;
  }
  if (write_filtered_list(p, field, list)) return;
  size_t begin = begin_field(p, field, SBFI_FORM_LIST);
  if (field->item == SBFI_ITEM_U8) {
    sbfi_text_append(p->to, list.at, size);
  } else {
    for (size_t i = 0; i < size; i += 4) {
      uint32_t value;
      memcpy(&value, (const char *)list.at + i, sizeof value);
      put_u32(p, value);
    }
  }
  end_field(p, begin);
}

/* --- children --- */

static void write_records(planner *p, const sbfi_field *field, const void *object) {
  sbfi_list children = sbfi_get_list(object, field);
  size_t begin = begin_field(p, field, SBFI_FORM_RECORDS);
  put_u32(p, children.count);
  for (uint32_t i = 0; i < children.count; i++) {
    size_t child_begin = begin_size(p);
    write_child(p, field, (const char *)children.at + (size_t)i * field->element->struct_size, ALL_FIELDS);
    end_size(p, child_begin);
  }
  end_field(p, begin);
}

/* The parts themselves are queued. */
static void write_parts(planner *p, const sbfi_field *field, const void *object) {
  sbfi_list children = sbfi_get_list(object, field);
  bool in_root = p->address.kind == sbfi_asset_element.kind;
  size_t begin = begin_field(p, field, SBFI_FORM_PARTS);
  put_u32(p, children.count);
  for (uint32_t i = 0; i < children.count; i++) {
    const char *child = (const char *)children.at + (size_t)i * field->element->struct_size;
    put_u32(p, (uint32_t)p->parts.count);
    size_t label_begin = begin_size(p);
    write_child(p, field, child, LABEL_FIELDS);
    end_size(p, label_begin);
    queued_part *part = sbfi_array_push(&p->parts, 1);
    if (!part) {
      p->result = SBFI_PLANNED_NO_MEMORY;
      return;
    }
    *part = (queued_part){.element = field->element, .object = child};
    part->address.kind = field->element->kind;
    part->address.owner = in_root ? i : p->address.owner;
    part->address.level = in_root ? SBFI_PACKED_NO_LEVEL : i;
  }
  end_field(p, begin);
}

static void write_field(planner *p, const sbfi_field *field, const void *object) {
  size_t begin;
  switch (field->type) {
  case SBFI_STRING:
  case SBFI_TEXT:
  case SBFI_ID:
    begin = begin_field(p, field, SBFI_FORM_TEXT);
    sbfi_text_string(p->to, sbfi_get_pointer(object, field));
    end_field(p, begin);
    break;
  case SBFI_LIST:
    write_list(p, field, object);
    break;
  case SBFI_ONE:
    begin = begin_field(p, field, SBFI_FORM_RECORD);
    write_child(p, field, (const char *)object + field->offset, ALL_FIELDS);
    end_field(p, begin);
    if (p->to->length == begin && !p->to->failed) p->to->length = begin - SBFI_PACKED_FIELD_SIZE;
    break;
  case SBFI_OPTIONAL:
    begin = begin_field(p, field, SBFI_FORM_RECORD);
    write_child(p, field, sbfi_get_pointer(object, field), ALL_FIELDS);
    end_field(p, begin);
    break;
  case SBFI_MANY:
    if (field->element->kind && !p->outline)
      write_parts(p, field, object);
    else
      write_records(p, field, object);
    break;
  default:
    write_value(p, field, object);
    break;
  }
}

static void write_fields(planner *p, const sbfi_element *element, const void *object, field_set set) {
  for (uint32_t i = 0; i < element->field_count && p->result == SBFI_PLANNED; i++) {
    const sbfi_field *field = &element->fields[i];
    if (set != ALL_FIELDS && (set == LABEL_FIELDS) != sbfi_packed_is_label(field)) continue;
    if (field->required || !is_default(field, object)) write_field(p, field, object);
  }
}

/* --- the plan --- */

/* Lists are numbered after all parts, so counts the parts first. */
static uint64_t count_parts(const sbfi_element *element, const void *object) {
  uint64_t count = 1;
  for (uint32_t i = 0; i < element->field_count; i++) {
    const sbfi_field *field = &element->fields[i];
    if (field->type != SBFI_MANY || !field->element->kind) continue;
    sbfi_list children = sbfi_get_list(object, field);
    for (uint32_t k = 0; k < children.count; k++)
      count +=
          count_parts(field->element, (const char *)children.at + (size_t)k * field->element->struct_size);
  }
  return count;
}

static void write_queue(planner *p, const sbf_asset *asset) {
  queued_part *part = sbfi_array_push(&p->parts, 1);
  if (!part) {
    p->result = SBFI_PLANNED_NO_MEMORY;
    return;
  }
  *part = (queued_part){.element = &sbfi_asset_element, .object = asset};
  part->address.kind = sbfi_asset_element.kind;
  part->address.level = SBFI_PACKED_NO_LEVEL;
  for (size_t i = 0; i < p->parts.count && p->result == SBFI_PLANNED; i++) {
    part = (queued_part *)p->parts.at + i;
    p->address = part->address;
    size_t begin = p->to->length;
    write_fields(p, part->element, part->object,
        part->address.kind == sbfi_asset_element.kind ? ALL_FIELDS : FIELDS_BUT_LABEL);
    part = (queued_part *)p->parts.at + i; /* the queue may have been reallocated */
    part->record_begin = begin;
    part->record_end = p->to->length;
  }
  if (p->to->failed) p->result = SBFI_PLANNED_NO_MEMORY;
}

/* A second record of the whole asset, after all others. */
static void write_outline(planner *p, const sbf_asset *asset) {
  p->outline = true;
  p->outline_begin = p->to->length;
  write_fields(p, &sbfi_asset_element, asset, ALL_FIELDS);
  if (p->to->failed) p->result = SBFI_PLANNED_NO_MEMORY;
}

static void gather_outline(planner *p, sbfi_packed_plan *plan) {
  sbfi_planned_chunk *planned = sbfi_array_push(&plan->chunks, 1);
  if (!planned) {
    p->result = SBFI_PLANNED_NO_MEMORY;
    return;
  }
  sbfi_packed_chunk *chunk = &planned->chunk;
  planned->at = plan->records.at + p->outline_begin;
  chunk->kind = SBFI_PACKED_OUTLINE;
  chunk->level = SBFI_PACKED_NO_LEVEL;
  chunk->stride = 1;
  chunk->count = chunk->raw_size = chunk->stored_size = p->to->length - p->outline_begin;
}

/* Parts and lists become chunks, in this order. */
static void gather(planner *p, sbfi_packed_plan *plan) {
  for (size_t i = 0; i < p->parts.count; i++) {
    const queued_part *part = (const queued_part *)p->parts.at + i;
    sbfi_planned_chunk *planned = sbfi_array_push(&plan->chunks, 1);
    if (!planned) {
      p->result = SBFI_PLANNED_NO_MEMORY;
      return;
    }
    planned->chunk = part->address;
    planned->chunk.stride = 1;
    planned->chunk.count = part->record_end - part->record_begin;
    planned->chunk.raw_size = planned->chunk.stored_size = planned->chunk.count;
    planned->at = plan->records.at + part->record_begin;
  }
  if (!sbfi_array_append(&plan->chunks, p->lists.at, p->lists.count)) p->result = SBFI_PLANNED_NO_MEMORY;
  for (size_t i = 0; i < plan->chunks.count; i++)
    sbfi_packed_plan_chunk(plan, i)->chunk.flags = SBFI_CHUNK_CRITICAL;
}

sbfi_planned sbfi_packed_plan_make(sbfi_packed_plan *plan, const sbf_asset *asset, sbfi_packed_coder *coder,
    const sbf_allocator *allocator) {
  sbfi_array_init(&plan->chunks, allocator, sizeof(sbfi_planned_chunk));
  sbfi_text_init(&plan->records, allocator);
  sbfi_arena_init(&plan->arena, allocator, 0);
  uint64_t part_count = count_parts(&sbfi_asset_element, asset);
  if (part_count > UINT32_MAX) return SBFI_PLANNED_TOO_LARGE;
  planner p = {.to = &plan->records, .coder = coder, .part_count = (uint32_t)part_count};
  sbfi_array_init(&p.parts, allocator, sizeof(queued_part));
  sbfi_array_init(&p.lists, allocator, sizeof(sbfi_planned_chunk));
  write_queue(&p, asset);
  if (p.result == SBFI_PLANNED && p.lists.count > UINT32_MAX - 1 - p.part_count)
    p.result = SBFI_PLANNED_TOO_LARGE;
  bool outlined = p.parts.count + p.lists.count >= SBFI_PACKED_OUTLINE_FROM;
  if (p.result == SBFI_PLANNED && outlined) write_outline(&p, asset);
  if (p.result == SBFI_PLANNED) gather(&p, plan);
  if (p.result == SBFI_PLANNED && outlined) gather_outline(&p, plan);
  sbfi_array_free(&p.parts);
  sbfi_array_free(&p.lists);
  return p.result;
}

void sbfi_packed_plan_free(sbfi_packed_plan *plan) {
  sbfi_array_free(&plan->chunks);
  sbfi_text_free(&plan->records);
  sbfi_arena_free(&plan->arena);
}
