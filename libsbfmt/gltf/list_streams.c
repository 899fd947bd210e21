/* Lists of the extension: arrays of JSON, or bytes of a buffer view, filtered and compressed as in the packed
 * form. */
#include "base/number.h"
#include "gltf/soft_body_reader.h"
#include "packed/packed_filter.h"

const char *const sbfi_gltf_filter_names[SBFI_FILTER_COUNT] = {"none", "planes", "delta", "recent"};
const char *const sbfi_gltf_codec_names[SBFI_CODEC_COUNT] = {"none", "zlib"};

static bool fault(const sbfi_gltf_reader *r, const sbfi_gltf_list *list, const char *message) {
  return sbfi_glb_fault(&r->file, SBF_CODE_GLTF_EXTENSION, "`%s`: %s", list->name, message);
}

static size_t scalar_size(const sbfi_gltf_list *list) {
  return list->item == SBFI_ITEM_U8 ? 1 : 4;
}

bool sbfi_gltf_is_borrowed(const sbfi_json *json) {
  const sbfi_json *value = sbfi_json_get(json, "gltf");
  return value && value->type == SBFI_JSON_TRUE;
}

bool sbfi_gltf_count(
    const sbfi_gltf_reader *r, const sbfi_json *json, const sbfi_gltf_list *list, uint32_t *count) {
  if (json->type == SBFI_JSON_ARRAY) {
    if (json->count % list->width) return fault(r, list, "its length is no multiple of its items' width");
    *count = json->count / list->width;
  } else if (!sbfi_json_u32(sbfi_json_get(json, "count"), count)) {
    return fault(r, list, "it is neither an array nor states its count");
  }
  if (*count > r->options.limits.list_items)
    return sbfi_glb_fault(&r->file, SBF_CODE_LIST_TOO_LONG,
        "`%s` has %u items, more than the limit of %u: raise it if the file is trusted", list->name, *count,
        r->options.limits.list_items);
  return true;
}

static bool read_array(
    const sbfi_gltf_reader *r, const sbfi_json *json, const sbfi_gltf_list *list, uint8_t *to) {
  for (uint32_t i = 0; i < json->count; i++) {
    uint32_t bits;
    float value;
    bool good;
    if (list->item == SBFI_ITEM_F32) {
      good = json->items[i].type == SBFI_JSON_NUMBER &&
             sbfi_parse_f32(json->items[i].text.at, json->items[i].text.length, &value) == SBFI_NUMBER_READ;
      if (good) memcpy(to + 4 * (size_t)i, &value, sizeof value);
    } else {
      good = sbfi_json_u32(&json->items[i], &bits) && (list->item == SBFI_ITEM_U32 || bits < 256);
      if (good && list->item == SBFI_ITEM_U8) to[i] = (uint8_t)bits;
      if (good && list->item == SBFI_ITEM_U32) memcpy(to + 4 * (size_t)i, &bits, sizeof bits);
    }
    if (!good) return fault(r, list, "an item is not a number of its type");
  }
  return true;
}

/* Where the bytes of a list are. */
typedef struct stream {
  sbfi_glb_bytes bytes;
  sbfi_packed_filter filter;
  sbfi_packed_codec codec;
  size_t raw_size;
} stream;

/* Index of a member's text among names; the first if it is absent. */
static bool find_name(
    const sbfi_json *json, const char *member, const char *const *names, int count, int *index) {
  const sbfi_json *value = sbfi_json_get(json, member);
  for (*index = 0; value && *index < count; ++*index)
    if (sbfi_json_is_string(value, names[*index])) return true;
  return !value;
}

static bool open_stream(
    sbfi_gltf_reader *r, const sbfi_json *json, const sbfi_gltf_list *list, uint32_t count, stream *s) {
  uint32_t view;
  int filter, codec;
  if (!sbfi_json_u32(sbfi_json_get(json, "bufferView"), &view))
    return fault(r, list, "it names no buffer view");
  if (!sbfi_glb_file_view(&r->file, view, &s->bytes)) return false;
  if (!find_name(json, "filter", sbfi_gltf_filter_names, SBFI_FILTER_COUNT, &filter) ||
      !find_name(json, "codec", sbfi_gltf_codec_names, SBFI_CODEC_COUNT, &codec))
    return sbfi_glb_fault(&r->file, SBF_CODE_PACKED_CODEC,
        "`%s` has a filter or a codec that this library does not know: use a newer one", list->name);
  s->filter = (sbfi_packed_filter)filter, s->codec = (sbfi_packed_codec)codec;
  s->raw_size = (size_t)count * list->width * scalar_size(list);
  if (s->codec == SBFI_CODEC_NONE) {
    if (s->filter != SBFI_FILTER_NONE) return fault(r, list, "a filter needs a codec");
    return s->bytes.size == s->raw_size || fault(r, list, "its buffer view has another size than its items");
  }
  if (list->item == SBFI_ITEM_U8 && s->filter != SBFI_FILTER_NONE)
    return fault(r, list, "bytes have no filter");
  r->inflated_bytes += s->raw_size;
  if (s->raw_size / r->options.limits.inflate_ratio > s->bytes.size || r->inflated_bytes > r->inflated_limit)
    return sbfi_glb_fault(&r->file, SBF_CODE_PACKED_RATIO,
        "`%s` inflates to %zu bytes, more than the limits allow: raise them if the file is trusted",
        list->name, s->raw_size);
  return true;
}

static bool read_stream(sbfi_gltf_reader *r, const stream *s, const sbfi_gltf_list *list, uint8_t *to) {
  if (s->codec == SBFI_CODEC_NONE) {
    memcpy(to, s->bytes.at, s->raw_size);
  } else {
    sbfi_coded coded =
        sbfi_packed_inflate(&r->coder, s->bytes.at, s->bytes.size, s->filter, list->width, to, s->raw_size);
    if (coded == SBFI_CODED_NO_MEMORY)
      return sbfi_glb_fault(&r->file, SBF_CODE_OUT_OF_MEMORY, "no memory to inflate `%s`", list->name);
    if (coded != SBFI_CODED)
      return sbfi_glb_fault(&r->file, SBF_CODE_PACKED_INFLATE,
          "`%s` does not inflate to its size: the file is damaged, copy it again", list->name);
  }
  if (list->item != SBFI_ITEM_U8 && s->filter == SBFI_FILTER_NONE) sbfi_scalars_to_host(to, s->raw_size / 4);
  return true;
}

static bool no_memory(const sbfi_gltf_reader *r, const sbfi_gltf_list *list) {
  return sbfi_glb_fault(&r->file, SBF_CODE_OUT_OF_MEMORY,
      "no memory for `%s`, or more than the limit of %llu bytes in all", list->name,
      (unsigned long long)r->options.limits.memory_bytes);
}

bool sbfi_gltf_read_list(sbfi_gltf_reader *r, const sbfi_json *json, const sbfi_gltf_list *list,
    sbfi_arena *arena, const void **items, uint32_t *count) {
  stream s;
  *items = NULL;
  if (!sbfi_gltf_count(r, json, list, count)) return false;
  if (!*count) return true;
  bool in_json = json->type == SBFI_JSON_ARRAY;
  if (!in_json && !open_stream(r, json, list, *count, &s)) return false;
  uint8_t *memory = sbfi_arena_allocate(arena, *count, list->width * scalar_size(list));
  if (!memory) return no_memory(r, list);
  *items = memory;
  return in_json ? read_array(r, json, list, memory) : read_stream(r, &s, list, memory);
}

bool sbfi_gltf_correct(sbfi_gltf_reader *r, const sbfi_json *json, const sbfi_gltf_list *list,
    uint32_t *scalars, uint32_t count) {
  const sbfi_json *correction = sbfi_json_get(json, "correction");
  const void *differences;
  uint32_t given;
  if (!correction) return true;
  sbfi_gltf_list differences_of = {list->name, SBFI_ITEM_U32, list->width};
  if (!sbfi_gltf_read_list(r, correction, &differences_of, &r->scratch, &differences, &given)) return false;
  if (given != count) return fault(r, list, "its correction has another count");
  for (size_t i = 0; i < (size_t)count * list->width; i++)
    scalars[i] = sbfi_gltf_add_difference(scalars[i], ((const uint32_t *)differences)[i]);
  return true;
}
