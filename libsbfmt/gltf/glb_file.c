#include "gltf/glb_file.h"

#include "base/diagnostic.h"
#include "packed/packed_format.h"

enum { HEADER_SIZE = 12, CHUNK_HEADER_SIZE = 8 };
enum { BYTE = 5121, SHORT = 5123, WORD = 5125, FLOAT = 5126 };
static const uint32_t MAGIC = 0x46546c67, JSON_CHUNK = 0x4e4f534a, BINARY_CHUNK = 0x004e4942;

bool sbfi_glb_fault(const sbfi_glb_file *file, sbf_code code, const char *format, ...) {
  va_list arguments;
  va_start(arguments, format);
  sbfi_diagnose_v(file->error, code, format, arguments);
  va_end(arguments);
  return false;
}

static sbf_status fault(const sbfi_glb_file *file, const char *message) {
  return sbfi_diagnose(file->error, SBF_CODE_GLTF_SYNTAX, "%s", message);
}

bool sbfi_glb_is_begun(const uint8_t *bytes, size_t size) {
  return size >= 4 && sbfi_get_u32(bytes) == MAGIC;
}

sbf_status sbfi_glb_file_parse(sbfi_glb_file *file, const char *json, size_t json_size, const uint8_t *binary,
    size_t binary_size, sbfi_arena *arena, sbf_diagnostic *error) {
  *file = (sbfi_glb_file){NULL, binary, binary_size, arena, error};
  size_t offset;
  const char *reason;
  if (!sbfi_json_parse(json, json_size, arena, &file->root, &offset, &reason))
    return reason == sbfi_json_no_memory ? sbfi_diagnose(error, SBF_CODE_OUT_OF_MEMORY, "%s", reason)
                                         : sbfi_diagnose(error, SBF_CODE_GLTF_SYNTAX,
                                               "the JSON is invalid at byte %zu: %s", offset, reason);
  if (file->root->type != SBFI_JSON_OBJECT) return fault(file, "the JSON is not an object");
  if (!sbfi_json_is_string(sbfi_json_get(sbfi_json_get(file->root, "asset"), "version"), "2.0"))
    return fault(file, "the file does not state version 2.0 of glTF");
  return SBF_OK;
}

sbf_status sbfi_glb_file_read(
    sbfi_glb_file *file, const uint8_t *bytes, size_t size, sbfi_arena *arena, sbf_diagnostic *error) {
  *file = (sbfi_glb_file){.arena = arena, .error = error};
  if (size < HEADER_SIZE + CHUNK_HEADER_SIZE || !sbfi_glb_is_begun(bytes, size))
    return fault(file, "the file is no binary glTF, or shorter than its header");
  if (sbfi_get_u32(bytes + 4) != 2) return fault(file, "the file is not of version 2 of binary glTF");
  if (sbfi_get_u32(bytes + 8) != size)
    return sbfi_diagnose(error, SBF_CODE_GLTF_SYNTAX,
        "the header states %u bytes, and the file has %zu: it was truncated, copy it again",
        sbfi_get_u32(bytes + 8), size);
  const uint8_t *at = bytes + HEADER_SIZE, *end = bytes + size, *json = NULL, *binary = NULL;
  size_t json_size = 0, binary_size = 0;
  while (at < end) {
    if ((size_t)(end - at) < CHUNK_HEADER_SIZE) return fault(file, "a chunk's header is cut short");
    uint32_t length = sbfi_get_u32(at), kind = sbfi_get_u32(at + 4);
    at += CHUNK_HEADER_SIZE;
    if (length > (size_t)(end - at)) return fault(file, "a chunk ends behind the file's end");
    if (!json) {
      if (kind != JSON_CHUNK) return fault(file, "the first chunk is not JSON");
      json = at, json_size = length;
    } else if (kind == BINARY_CHUNK && !binary) {
      binary = at, binary_size = length;
    }
    at += length;
  }
  return sbfi_glb_file_parse(file, (const char *)json, json_size, binary, binary_size, arena, error);
}

const sbfi_json *sbfi_glb_file_item(const sbfi_glb_file *file, const char *list, uint32_t index) {
  const sbfi_json *item = sbfi_json_at(sbfi_json_get(file->root, list), index);
  if (!item) sbfi_glb_fault(file, SBF_CODE_GLTF_SYNTAX, "`%s` has no item %u", list, index);
  return item;
}

/* A number that may be absent. */
static bool get_number(const sbfi_json *object, const char *name, uint32_t fallback, uint32_t *number) {
  const sbfi_json *value = sbfi_json_get(object, name);
  *number = fallback;
  return !value || sbfi_json_u32(value, number);
}

bool sbfi_glb_file_view(const sbfi_glb_file *file, uint32_t index, sbfi_glb_bytes *bytes) {
  const sbfi_json *view = sbfi_glb_file_item(file, "bufferViews", index);
  uint32_t buffer, offset, size, stride;
  if (!view) return false;
  if (sbfi_json_get(sbfi_json_get(view, "extensions"), "EXT_meshopt_compression"))
    return sbfi_glb_fault(file, SBF_CODE_GLTF_CHANGED,
        "buffer view %u is compressed by EXT_meshopt_compression: decompress it with the tool that did it",
        index);
  if (!get_number(view, "buffer", UINT32_MAX, &buffer) || !get_number(view, "byteOffset", 0, &offset) ||
      !get_number(view, "byteLength", UINT32_MAX, &size) || !get_number(view, "byteStride", 0, &stride) ||
      buffer != 0 || offset > file->binary_size || size > file->binary_size - offset)
    return sbfi_glb_fault(file, SBF_CODE_GLTF_SYNTAX,
        "buffer view %u does not lie inside the file's binary chunk: it has to be in one .glb", index);
  *bytes = (sbfi_glb_bytes){file->binary + offset, size, stride};
  return true;
}

static uint32_t width_of(const char *type) {
  static const char *const names[] = {"SCALAR", "VEC2", "VEC3", "VEC4"};
  for (uint32_t i = 0; i < 4; i++)
    if (strcmp(type, names[i]) == 0) return i + 1;
  return 0;
}

bool sbfi_glb_file_accessor(
    const sbfi_glb_file *file, const sbfi_json *index, const char *type, sbfi_glb_items *items) {
  uint32_t number, view, offset, count, component;
  sbfi_glb_bytes bytes;
  if (!sbfi_json_u32(index, &number))
    return sbfi_glb_fault(file, SBF_CODE_GLTF_SYNTAX, "an accessor of type %s is missing", type);
  const sbfi_json *accessor = sbfi_glb_file_item(file, "accessors", number);
  if (!accessor) return false;
  if (sbfi_json_get(accessor, "sparse") || !sbfi_json_get(accessor, "bufferView"))
    return sbfi_glb_fault(
        file, SBF_CODE_GLTF_CHANGED, "accessor %u is sparse: another program changed the file", number);
  if (!sbfi_json_is_string(sbfi_json_get(accessor, "type"), type) ||
      !get_number(accessor, "bufferView", 0, &view) || !get_number(accessor, "byteOffset", 0, &offset) ||
      !get_number(accessor, "count", 0, &count) || !get_number(accessor, "componentType", 0, &component))
    return sbfi_glb_fault(file, SBF_CODE_GLTF_SYNTAX, "accessor %u is not of type %s", number, type);
  if (!sbfi_glb_file_view(file, view, &bytes)) return false;
  uint32_t width = width_of(type);
  size_t scalar = component == BYTE ? 1 : component == SHORT ? 2 : 4, item = scalar * width;
  size_t stride = bytes.stride ? bytes.stride : item;
  bool fits = stride >= item && offset <= bytes.size &&
              (!count || (bytes.size - offset >= item && (bytes.size - offset - item) / stride >= count - 1));
  if (!fits)
    return sbfi_glb_fault(file, SBF_CODE_GLTF_SYNTAX, "accessor %u ends behind its buffer view", number);
  *items = (sbfi_glb_items){bytes.at ? bytes.at + offset : NULL, stride, count, width, component};
  return true;
}

bool sbfi_glb_is_float(const sbfi_glb_file *file, const sbfi_glb_items *items) {
  if (items->component == FLOAT) return true;
  return sbfi_glb_fault(file, SBF_CODE_GLTF_CHANGED,
      "numbers of a mesh are not 32-bit floats: another program quantized them, so use the file before that");
}

bool sbfi_glb_is_whole(const sbfi_glb_file *file, const sbfi_glb_items *items) {
  if (items->component == BYTE || items->component == SHORT || items->component == WORD) return true;
  return sbfi_glb_fault(file, SBF_CODE_GLTF_SYNTAX, "indices are not unsigned whole numbers");
}

static const uint8_t *scalar_at(const sbfi_glb_items *items, uint32_t item, uint32_t scalar, size_t size) {
  return items->at + (size_t)item * items->stride + scalar * size;
}

float sbfi_glb_float(const sbfi_glb_items *items, uint32_t item, uint32_t scalar) {
  uint32_t bits = sbfi_get_u32(scalar_at(items, item, scalar, 4));
  float value;
  memcpy(&value, &bits, sizeof value);
  return value;
}

uint32_t sbfi_glb_whole(const sbfi_glb_items *items, uint32_t item, uint32_t scalar) {
  if (items->component == BYTE) return *scalar_at(items, item, scalar, 1);
  if (items->component == SHORT) return sbfi_get_u16(scalar_at(items, item, scalar, 2));
  return sbfi_get_u32(scalar_at(items, item, scalar, 4));
}
