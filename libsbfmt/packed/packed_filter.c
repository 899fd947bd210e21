#include "packed/packed_filter.h"

#include "packed/packed_recent.h"

enum { STEP = 2048 }; /* scalars joined and summed at once; they fit in the L1 cache */

bool sbfi_host_is_little_endian(void) {
  const uint32_t one = 1;
  uint8_t first;
  memcpy(&first, &one, 1);
  return first == 1;
}

void sbfi_scalars_to_host(void *at, size_t scalar_count) {
  if (sbfi_host_is_little_endian()) return;
  uint8_t *bytes = at;
  for (size_t i = 0; i < scalar_count; i++) {
    uint32_t value = sbfi_get_u32(bytes + 4 * i);
    memcpy(bytes + 4 * i, &value, sizeof value);
  }
}

static uint32_t load_scalar(const uint8_t *from, size_t index) {
  uint32_t value;
  memcpy(&value, from + 4 * index, sizeof value);
  return value;
}

static uint32_t zigzag(uint32_t difference) {
  return difference << 1 ^ (0u - (difference >> 31));
}

bool sbfi_filter_block(sbfi_packed_filter filter, const uint8_t *from, size_t done, size_t count,
    uint32_t width, uint8_t *planes) {
  if (filter == SBFI_FILTER_RECENT) return sbfi_filter_recent(from, done, count, planes);
  for (size_t i = 0; i < count; i++) {
    uint32_t value = load_scalar(from, done + i);
    if (filter == SBFI_FILTER_DELTA)
      value = zigzag(value - (done + i < width ? 0 : load_scalar(from, done + i - width)));
    for (size_t plane = 0; plane < 4; plane++) planes[plane * count + i] = (uint8_t)(value >> (8 * plane));
  }
  return true;
}

/* The compiler vectorizes both loops: widens bytes of four streams and combines them. */
static void join_planes(const uint8_t *restrict planes, size_t stride, size_t count, uint32_t *restrict to) {
  const uint8_t *p0 = planes, *p1 = p0 + stride, *p2 = p1 + stride, *p3 = p2 + stride;
  for (size_t i = 0; i < count; i++)
    to[i] = p0[i] | (uint32_t)p1[i] << 8 | (uint32_t)p2[i] << 16 | (uint32_t)p3[i] << 24;
}

static void undo_zigzag(uint32_t *values, size_t count) {
  for (size_t i = 0; i < count; i++) values[i] = values[i] >> 1 ^ (0u - (values[i] & 1));
}

/* Running sums of each component; the sums stay in registers because the width is known. */
static void sum_1(uint32_t *values, size_t count, uint32_t *before) {
  uint32_t a = before[0];
  for (size_t i = 0; i < count; i++) values[i] = a += values[i];
  before[0] = a;
}
static void sum_2(uint32_t *values, size_t count, uint32_t *before) {
  uint32_t a = before[0], b = before[1];
  for (size_t i = 0; i + 1 < count; i += 2) {
    values[i] = a += values[i];
    values[i + 1] = b += values[i + 1];
  }
  before[0] = a;
  before[1] = b;
}
static void sum_3(uint32_t *values, size_t count, uint32_t *before) {
  uint32_t a = before[0], b = before[1], c = before[2];
  for (size_t i = 0; i + 2 < count; i += 3) {
    values[i] = a += values[i];
    values[i + 1] = b += values[i + 1];
    values[i + 2] = c += values[i + 2];
  }
  before[0] = a;
  before[1] = b;
  before[2] = c;
}
static void sum_4(uint32_t *values, size_t count, uint32_t *before) {
  uint32_t a = before[0], b = before[1], c = before[2], d = before[3];
  for (size_t i = 0; i + 3 < count; i += 4) {
    values[i] = a += values[i];
    values[i + 1] = b += values[i + 1];
    values[i + 2] = c += values[i + 2];
    values[i + 3] = d += values[i + 3];
  }
  before[0] = a;
  before[1] = b;
  before[2] = c;
  before[3] = d;
}

bool sbfi_unfilter_block(sbfi_packed_filter filter, const uint8_t *planes, size_t count, uint32_t width,
    uint8_t *to, size_t done) {
  if (filter == SBFI_FILTER_RECENT) return sbfi_unfilter_recent(planes, count, to, done);
  static void (*const sums[])(uint32_t *, size_t, uint32_t *) = {sum_1, sum_2, sum_3, sum_4};
  uint32_t values[STEP / 12 * 12], before[4] = {0};
  size_t step = sizeof values / sizeof *values;
  for (uint32_t c = 0; c < width && done; c++) before[c] = load_scalar(to, done - width + c);
  for (size_t i = 0; i < count; i += step) {
    size_t some = count - i < step ? count - i : step;
    join_planes(planes + i, count, some, values);
    if (filter == SBFI_FILTER_DELTA) {
      undo_zigzag(values, some);
      sums[width - 1](values, some, before);
    }
    memcpy(to + 4 * (done + i), values, some * sizeof *values);
  }
  return true;
}
