#include "xml/xml_list.h"

#include "base/number.h"

void sbfi_xml_list_init(sbfi_xml_list *list, const sbf_allocator *allocator, uint32_t item_limit) {
  *list = (sbfi_xml_list){.item_limit = item_limit};
  sbfi_array_init(&list->scalars, allocator, sizeof(uint32_t));
  sbfi_text_init(&list->begun, allocator);
}

void sbfi_xml_list_free(sbfi_xml_list *list) {
  sbfi_array_free(&list->scalars);
  sbfi_text_free(&list->begun);
}

static bool is_bytes(const sbfi_field *field) {
  return field->item == SBFI_ITEM_U8;
}

void sbfi_xml_list_begin(sbfi_xml_list *list, const sbfi_field *field) {
  size_t item_size = is_bytes(field) ? 1 : sizeof(uint32_t);
  /* keeps the memory block and only changes the item size */
  if (item_size != list->scalars.item_size) {
    sbfi_array_free(&list->scalars);
    list->scalars.item_size = item_size;
  }
  list->field = field;
  list->scalars.count = 0;
  list->base64 = (sbfi_base64_reader){0};
  sbfi_text_clear(&list->begun);
  list->wrong[0] = 0;
}

uint32_t sbfi_xml_list_count(const sbfi_xml_list *list) {
  return (uint32_t)(list->scalars.count / list->field->width);
}

size_t sbfi_xml_list_bytes(const sbfi_xml_list *list) {
  return list->scalars.count * list->scalars.item_size + list->begun.length;
}

sbfi_xml_fault sbfi_xml_list_append_given(sbfi_xml_list *list, const sbf_given_list *given) {
  size_t count = given->size / list->scalars.item_size;
  if (given->size % list->scalars.item_size) return SBFI_XML_NOT_WHOLE;
  if (count / list->field->width > list->item_limit) return SBFI_XML_TOO_LONG;
  return sbfi_array_append(&list->scalars, given->at, count) ? SBFI_XML_FINE : SBFI_XML_NO_MEMORY;
}

/* --- numbers --- */

static size_t word_length(const char *text, size_t length) {
  size_t i = 0;
  while (i < length && !sbfi_is_space(text[i])) i++;
  return i;
}

static bool is_word_for_no_number(const char *text, size_t length) {
  static const char *const words[] = {"nan", "inf", "infinity", "1.#inf", "1.#qnan", "1.#ind"};
  if (length && (*text == '-' || *text == '+')) text++, length--;
  for (size_t w = 0; w < sizeof words / sizeof *words; w++) {
    size_t i = 0;
    while (
        i < length && words[w][i] && (text[i] | (text[i] >= 'A' && text[i] <= 'Z' ? 32 : 0)) == words[w][i])
      i++;
    if (i == length && words[w][i] == 0) return true;
  }
  return false;
}

/* Reason why this word is not a number of the type. */
static sbfi_xml_fault check(const char *text, size_t length, sbfi_number_status status) {
  size_t word = word_length(text, length);
  if (is_word_for_no_number(text, word)) return SBFI_XML_NOT_FINITE;
  return status == SBFI_NUMBER_OUT_OF_RANGE ? SBFI_XML_OUT_OF_RANGE : SBFI_XML_MALFORMED;
}

sbfi_xml_fault sbfi_xml_scan_number(const sbfi_field *field, const char *text, size_t length, void *to) {
  sbfi_number_status status = field->type == SBFI_INT    ? sbfi_parse_i32(text, length, to)
                              : field->type == SBFI_UINT ? sbfi_parse_u32(text, length, to)
                                                         : sbfi_parse_f32(text, length, to);
  return status == SBFI_NUMBER_READ ? SBFI_XML_FINE : check(text, length, status);
}

static void store_invalid(sbfi_xml_list *list, const char *text, size_t length) {
  size_t kept = sbfi_utf8_cut(text, word_length(text, length), sizeof list->wrong - 1);
  if (kept) memcpy(list->wrong, text, kept);
  list->wrong[kept] = 0;
}

/* Reads the numbers of `text`, none of which is cut off. */
static sbfi_xml_fault add_numbers(sbfi_xml_list *list, const char *text, size_t length, size_t *offset) {
  size_t i = 0, used = 0;
  uint64_t scalar_limit = (uint64_t)list->item_limit * list->field->width;
  bool floats = list->field->item == SBFI_ITEM_F32;
  sbfi_number_status status = SBFI_NUMBER_READ;
  if (!sbfi_array_reserve(&list->scalars, list->scalars.count + length / 2 + 1)) return SBFI_XML_NO_MEMORY;
  uint32_t *begin = list->scalars.at, *to = begin + list->scalars.count;
  for (;; i += used, to++) {
    while (i < length && sbfi_is_space(text[i])) i++;
    if (i == length) break;
    status = floats ? sbfi_scan_f32(text + i, length - i, (float *)to, &used)
                    : sbfi_scan_u32(text + i, length - i, to, &used);
    if (status != SBFI_NUMBER_READ || (i + used < length && !sbfi_is_space(text[i + used]))) break;
  }
  list->scalars.count = (size_t)(to - begin);
  *offset = i;
  if (i == length) return list->scalars.count > scalar_limit ? SBFI_XML_TOO_LONG : SBFI_XML_FINE;
  store_invalid(list, text + i, length - i);
  return check(text + i, length - i, status);
}

/* Continues a number that began in the last piece. */
static sbfi_xml_fault add_to_begun(sbfi_xml_list *list, const char *text, size_t length) {
  return sbfi_text_append(&list->begun, text, length) ? SBFI_XML_FINE : SBFI_XML_NO_MEMORY;
}

static sbfi_xml_fault finish_begun(sbfi_xml_list *list) {
  size_t index, length = list->begun.length;
  list->begun.length = 0;
  return length ? add_numbers(list, list->begun.at, length, &index) : SBFI_XML_FINE;
}

static sbfi_xml_fault add_number_text(sbfi_xml_list *list, const char *text, size_t length, size_t *offset) {
  size_t first = list->begun.length ? word_length(text, length) : 0, last = length;
  sbfi_xml_fault fault = add_to_begun(list, text, first);
  *offset = 0;
  if (fault || first == length) return fault;
  if ((fault = finish_begun(list))) return fault;
  while (last > first && !sbfi_is_space(text[last - 1])) last--;
  fault = add_numbers(list, text + first, last - first, offset);
  *offset += first;
  if (fault) return fault;
  *offset = last;
  return add_to_begun(list, text + last, length - last);
}

/* --- bytes --- */

static sbfi_xml_fault add_base64(sbfi_xml_list *list, const char *text, size_t length, size_t *offset) {
  size_t size;
  if (!sbfi_array_reserve(&list->scalars, list->scalars.count + SBFI_BASE64_CAPACITY(length)))
    return SBFI_XML_NO_MEMORY;
  uint8_t *to = (uint8_t *)list->scalars.at + list->scalars.count;
  *offset = sbfi_base64_read(&list->base64, text, length, to, &size);
  list->scalars.count += size;
  if (*offset < length) {
    store_invalid(list, text + *offset, length - *offset);
    return SBFI_XML_MALFORMED;
  }
  return list->scalars.count > list->item_limit ? SBFI_XML_TOO_LONG : SBFI_XML_FINE;
}

sbfi_xml_fault sbfi_xml_list_add(sbfi_xml_list *list, const char *text, size_t length, size_t *offset) {
  return is_bytes(list->field) ? add_base64(list, text, length, offset)
                               : add_number_text(list, text, length, offset);
}

sbfi_xml_fault sbfi_xml_list_end(sbfi_xml_list *list) {
  if (is_bytes(list->field))
    return sbfi_base64_is_complete(&list->base64) ? SBFI_XML_FINE : SBFI_XML_NOT_WHOLE;
  sbfi_xml_fault fault = finish_begun(list);
  if (fault) return fault;
  return list->scalars.count % list->field->width ? SBFI_XML_NOT_WHOLE : SBFI_XML_FINE;
}
