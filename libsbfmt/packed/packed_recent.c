#include "packed/packed_recent.h"

#include <string.h>

/* The most recent scalars, newest first, and the last new one: the next new one is stored as a difference
 * from it. */
typedef struct recent {
  uint32_t at[SBFI_RECENT_COUNT];
  uint32_t last_new;
} recent;

static uint32_t load_scalar(const uint8_t *from, size_t index) {
  uint32_t value;
  memcpy(&value, from + 4 * index, sizeof value);
  return value;
}

static void begin(recent *r, const uint8_t *scalars, size_t done) {
  memset(r->at, 0, sizeof r->at);
  r->last_new = done ? load_scalar(scalars, done - 1) : 0;
}

/* Moves the value in front of the first `index` others. */
static void put_first(recent *r, size_t index, uint32_t value) {
  memmove(r->at + 1, r->at, index * sizeof *r->at);
  r->at[0] = value;
}

static size_t find(const recent *r, uint32_t value) {
  size_t index = 0;
  while (index < SBFI_RECENT_COUNT && r->at[index] != value) index++;
  return index;
}

bool sbfi_filter_recent(const uint8_t *from, size_t done, size_t count, uint8_t *block) {
  recent r;
  size_t new_count = 0;
  begin(&r, from, done);
  for (size_t i = 0; i < count; i++) {
    uint32_t value = load_scalar(from, done + i);
    size_t index = find(&r, value);
    bool is_new = index == SBFI_RECENT_COUNT;
    block[i] = is_new ? 0 : (uint8_t)(index + 1);
    new_count += is_new;
    put_first(&r, is_new ? index - 1 : index, value);
  }
  if (new_count > 3 * count / 4) return false;
  uint8_t *planes = block + count;
  size_t k = 0;
  for (size_t i = 0; i < count; i++) {
    if (block[i]) continue;
    uint32_t value = load_scalar(from, done + i), difference = value - r.last_new;
    uint32_t zigzag = difference << 1 ^ (0u - (difference >> 31));
    for (size_t plane = 0; plane < 4; plane++)
      planes[plane * new_count + k] = (uint8_t)(zigzag >> (8 * plane));
    r.last_new = value;
    k++;
  }
  memset(planes + 4 * new_count, 0, 3 * count - 4 * new_count);
  return true;
}

bool sbfi_unfilter_recent(const uint8_t *block, size_t count, uint8_t *to, size_t done) {
  recent r;
  size_t new_count = 0, k = 0;
  for (size_t i = 0; i < count; i++) {
    if (block[i] > SBFI_RECENT_COUNT) return false;
    new_count += block[i] == 0;
  }
  if (new_count > 3 * count / 4) return false;
  const uint8_t *planes = block + count;
  begin(&r, to, done);
  for (size_t i = 0; i < count; i++) {
    size_t index = block[i];
    uint32_t value;
    if (index) {
      value = r.at[--index];
    } else {
      uint32_t zigzag = planes[k] | (uint32_t)planes[new_count + k] << 8 |
                        (uint32_t)planes[2 * new_count + k] << 16 | (uint32_t)planes[3 * new_count + k] << 24;
      value = r.last_new += zigzag >> 1 ^ (0u - (zigzag & 1));
      index = SBFI_RECENT_COUNT - 1;
      k++;
    }
    put_first(&r, index, value);
    memcpy(to + 4 * (done + i), &value, sizeof value);
  }
  return true;
}
