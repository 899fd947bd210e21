#include "model/options.h"

#include <string.h>

#define GIBIBYTE ((uint64_t)1 << 30)

static size_t given_size(size_t stated, size_t known) {
  return stated && stated < known ? stated : known;
}

bool sbfi_options_copy(void *to, size_t known, const void *given) {
  size_t stated = 0;
  if (given) memcpy(&stated, given, sizeof stated);
  if (stated && stated < sizeof stated) return false;
  if (given) memcpy(to, given, given_size(stated, known));
  return true;
}

static void default_u64(uint64_t *limit, uint64_t value) {
  if (*limit == 0) *limit = value;
}

static void default_u32(uint32_t *limit, uint32_t value) {
  if (*limit == 0) *limit = value;
}

sbf_load_options sbfi_load_options_of(const sbf_load_options *given) {
  sbf_load_options options = {0};
  if (given) memcpy(&options, given, given_size(given->struct_size, sizeof options));
  default_u64(&options.limits.file_bytes, 4 * GIBIBYTE);
  default_u64(&options.limits.memory_bytes, 4 * GIBIBYTE);
  default_u32(&options.limits.inflate_ratio, 1100);
  default_u32(&options.limits.list_items, 1u << 30);
  default_u32(&options.limits.depth, 32);
  return options;
}

uint64_t sbfi_inflated_limit(const sbf_limits *limits, uint64_t file_bytes) {
  const uint64_t min = (uint64_t)64 << 20, max = 4 * GIBIBYTE, factor = 64;
  if (limits->inflated_bytes) return limits->inflated_bytes;
  if (file_bytes <= min / factor) return min;
  return file_bytes < max / factor ? file_bytes * factor : max;
}

sbf_save_options sbfi_save_options_of(const sbf_save_options *given) {
  sbf_save_options options = {0};
  if (given) memcpy(&options, given, given_size(given->struct_size, sizeof options));
  if (options.level < 1 || options.level > 9) options.level = 6;
  return options;
}
