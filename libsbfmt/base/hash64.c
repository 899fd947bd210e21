/* XXH64, written from the description "xxHash fast digest algorithm", version 0.1.1, by Y. Collet: four lanes
 * of 64 bits consume eight bytes each and are merged at the end; then the remaining bytes are mixed in. */
#include "base/hash64.h"

#include <string.h>

enum { STRIPE = 32 };

static const uint64_t prime1 = UINT64_C(0x9E3779B185EBCA87), prime2 = UINT64_C(0xC2B2AE3D27D4EB4F),
                      prime3 = UINT64_C(0x165667B19E3779F9), prime4 = UINT64_C(0x85EBCA77C2B2AE63),
                      prime5 = UINT64_C(0x27D4EB2F165667C5);

static inline uint64_t rotate(uint64_t x, int left) {
  return x << left | x >> (64 - left);
}

/* Loads little-endian numbers; compilers emit one load on little-endian machines. */
static inline uint64_t load32(const uint8_t *at) {
  return (uint64_t)at[0] | (uint64_t)at[1] << 8 | (uint64_t)at[2] << 16 | (uint64_t)at[3] << 24;
}
static inline uint64_t load64(const uint8_t *at) {
  return load32(at) | load32(at + 4) << 32;
}

static inline uint64_t mix(uint64_t lane, uint64_t number) {
  return rotate(lane + number * prime2, 31) * prime1;
}

static void add_stripes(uint64_t lane[4], const uint8_t *at, size_t count) {
  uint64_t a = lane[0], b = lane[1], c = lane[2], d = lane[3];
  for (; count; count--, at += STRIPE) {
    a = mix(a, load64(at));
    b = mix(b, load64(at + 8));
    c = mix(c, load64(at + 16));
    d = mix(d, load64(at + 24));
  }
  lane[0] = a;
  lane[1] = b;
  lane[2] = c;
  lane[3] = d;
}

void sbfi_hash64_init(sbfi_hash64 *hash) {
  memset(hash, 0, sizeof *hash);
  hash->lane[0] = prime1 + prime2;
  hash->lane[1] = prime2;
  hash->lane[3] = 0 - prime1;
}

void sbfi_hash64_add_bytes(sbfi_hash64 *hash, const void *bytes, size_t size) {
  const uint8_t *at = bytes;
  size_t pending = hash->size % STRIPE;
  hash->size += size;
  if (pending) {
    size_t used = size < STRIPE - pending ? size : STRIPE - pending;
    if (used) memcpy(hash->pending + pending, at, used);
    if (pending + used < STRIPE) return;
    add_stripes(hash->lane, hash->pending, 1);
    at += used;
    size -= used;
  }
  add_stripes(hash->lane, at, size / STRIPE);
  if (size % STRIPE) memcpy(hash->pending, at + size / STRIPE * STRIPE, size % STRIPE);
}

static bool is_little_endian(void) {
  const uint32_t one = 1;
  uint8_t first;
  memcpy(&first, &one, 1);
  return first == 1;
}

/* Adds numbers of `width` bytes as little-endian bytes. */
static void add_numbers(sbfi_hash64 *hash, const void *numbers, size_t count, size_t width) {
  if (is_little_endian()) {
    sbfi_hash64_add_bytes(hash, numbers, count * width);
    return;
  }
  const uint8_t *at = numbers;
  for (size_t i = 0; i < count; i++, at += width) {
    uint8_t reversed[8];
    for (size_t k = 0; k < width; k++) reversed[k] = at[width - 1 - k];
    sbfi_hash64_add_bytes(hash, reversed, width);
  }
}

void sbfi_hash64_add_u32(sbfi_hash64 *hash, const uint32_t *numbers, size_t count) {
  add_numbers(hash, numbers, count, sizeof *numbers);
}

void sbfi_hash64_add_u64(sbfi_hash64 *hash, const uint64_t *numbers, size_t count) {
  add_numbers(hash, numbers, count, sizeof *numbers);
}

void sbfi_hash64_add_f32(sbfi_hash64 *hash, const float *numbers, size_t count) {
  add_numbers(hash, numbers, count, sizeof *numbers);
}

void sbfi_hash64_add_f64(sbfi_hash64 *hash, const double *numbers, size_t count) {
  add_numbers(hash, numbers, count, sizeof *numbers);
}

uint64_t sbfi_hash64_value(const sbfi_hash64 *hash) {
  uint64_t value = prime5; /* input below one stripe does not use the lanes */
  if (hash->size >= STRIPE) {
    const uint64_t *lane = hash->lane;
    value = rotate(lane[0], 1) + rotate(lane[1], 7) + rotate(lane[2], 12) + rotate(lane[3], 18);
    for (int i = 0; i < 4; i++) value = (value ^ mix(0, lane[i])) * prime1 + prime4;
  }
  value += hash->size;
  const uint8_t *at = hash->pending;
  size_t left = hash->size % STRIPE;
  for (; left >= 8; left -= 8, at += 8) value = rotate(value ^ mix(0, load64(at)), 27) * prime1 + prime4;
  for (; left >= 4; left -= 4, at += 4) value = rotate(value ^ load32(at) * prime1, 23) * prime2 + prime3;
  for (; left; left--, at++) value = rotate(value ^ *at * prime5, 11) * prime1;
  value = (value ^ value >> 33) * prime2;
  value = (value ^ value >> 29) * prime3;
  return value ^ value >> 32;
}
