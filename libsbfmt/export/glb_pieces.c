/* Building blocks of a glTF file: memory in its binary part, items of its lists, strings. */
#include <string.h>

#include "export/glb.h"
#include "packed/packed_filter.h"

void *sbfi_glb_allocate(sbfi_glb *g, size_t count, size_t size) {
  void *buffer = count ? sbfi_arena_allocate(&g->arena, count, size) : NULL;
  if (count && !buffer) g->failed = true;
  return buffer;
}

sbfi_text *sbfi_glb_item(sbfi_glb *g, sbfi_glb_part part, uint32_t *number) {
  sbfi_glb_array *array = &g->parts[part];
  if (array->count) sbfi_text_char(&array->text, ',');
  if (number) *number = array->count;
  array->count++;
  return &array->text;
}

void sbfi_glb_write_string(sbfi_text *text, const char *string) {
  sbfi_text_char(text, '"');
  for (; *string; string++) {
    unsigned char c = (unsigned char)*string;
    if (c < 0x20 || c == 127)
      sbfi_export_print(text, "\\u%04x", c);
    else {
      if (c == '"' || c == '\\') sbfi_text_char(text, '\\');
      sbfi_text_char(text, *string);
    }
  }
  sbfi_text_char(text, '"');
}

void sbfi_glb_write_numbers(sbfi_text *text, const float *numbers, uint32_t count) {
  for (uint32_t i = 0; i < count; i++) {
    sbfi_text_char(text, i ? ',' : '[');
    sbfi_text_f32(text, numbers[i]);
  }
  sbfi_text_char(text, ']');
}

/* Adds a view of the next `size` bytes. */
static uint32_t open_view(sbfi_glb *g, size_t size, uint32_t target) {
  sbfi_text_repeat(&g->bytes, 0, (4 - g->bytes.length % 4) % 4);
  uint32_t number;
  sbfi_text *view = sbfi_glb_item(g, SBFI_GLB_VIEWS, &number);
  sbfi_export_print(view, "{\"buffer\":0,\"byteOffset\":%llu,\"byteLength\":%llu",
      (unsigned long long)g->bytes.length, (unsigned long long)size);
  if (target) sbfi_export_print(view, ",\"target\":%u", target);
  sbfi_text_char(view, '}');
  return number;
}

uint32_t sbfi_glb_view(sbfi_glb *g, const void *bytes, size_t size) {
  uint32_t number = open_view(g, size, SBFI_GLB_NO_TARGET);
  sbfi_text_append(&g->bytes, bytes, size);
  return number;
}

/* Little-endian on every machine, as the format requires. */
static void store(uint8_t *to, const void *items, size_t scalars, size_t scalar_size) {
  if (scalar_size == 1 || sbfi_host_is_little_endian()) {
    memcpy(to, items, scalars * scalar_size);
    return;
  }
  for (size_t i = 0; i < scalars; i++)
    for (size_t k = 0; k < scalar_size; k++)
      to[i * scalar_size + k] = ((const uint8_t *)items)[(i + 1) * scalar_size - 1 - k];
}

static void write_bounds(sbfi_text *text, const float *items, uint32_t count, uint32_t width) {
  float low[3], high[3];
  for (uint32_t k = 0; k < width; k++) low[k] = high[k] = items[k];
  for (size_t i = width; i < (size_t)count * width; i++) {
    size_t k = i % width;
    if (items[i] < low[k]) low[k] = items[i];
    if (items[i] > high[k]) high[k] = items[i];
  }
  sbfi_text_string(text, ",\"min\":");
  sbfi_glb_write_numbers(text, low, width);
  sbfi_text_string(text, ",\"max\":");
  sbfi_glb_write_numbers(text, high, width);
}

uint32_t sbfi_glb_accessor(
    sbfi_glb *g, const void *items, uint32_t count, sbfi_glb_type type, uint32_t target) {
  static const struct {
    const char *name;
    uint32_t width, component;
  } kinds[] = {{"SCALAR", 1, 5126}, {"VEC2", 2, 5126}, {"VEC3", 3, 5126}, {"VEC4", 4, 5126},
      {"MAT4", 16, 5126}, {"SCALAR", 1, 5125}, {"SCALAR", 1, 5123}, {"VEC4", 4, 5123}, {"VEC4", 4, 5121}};
  uint32_t component = kinds[type].component;
  size_t scalar_size = component == 5121 ? 1 : component == 5123 ? 2 : 4;
  size_t scalars = (size_t)count * kinds[type].width, size = scalars * scalar_size;
  uint32_t view = open_view(g, size, target), number;
  char *to = sbfi_text_reserve(&g->bytes, size);
  if (to) {
    store((uint8_t *)to, items, scalars, scalar_size);
    g->bytes.length += size;
  }
  sbfi_text *text = sbfi_glb_item(g, SBFI_GLB_ACCESSORS, &number);
  sbfi_export_print(text, "{\"bufferView\":%u,\"componentType\":%u,\"count\":%u,\"type\":\"%s\"", view,
      component, count, kinds[type].name);
  if (count && (type == SBFI_GLB_VEC3 || type == SBFI_GLB_FLOAT))
    write_bounds(text, items, count, kinds[type].width);
  sbfi_text_char(text, '}');
  return number;
}
