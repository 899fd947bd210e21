#include "base/base64.h"

static const char alphabet[] = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";

bool sbfi_base64_encode(sbfi_text *to, const uint8_t *bytes, size_t size) {
  if (size > SIZE_MAX / 4 * 3 - 3) {
    to->failed = true;
    return false;
  }
  size_t length = (size + 2) / 3 * 4;
  char *destination = sbfi_text_reserve(to, length);
  if (!destination) return false;
  for (size_t i = 0; i < size; i += 3) {
    size_t left = size - i;
    uint32_t bits = (uint32_t)bytes[i] << 16;
    if (left > 1) bits |= (uint32_t)bytes[i + 1] << 8;
    if (left > 2) bits |= bytes[i + 2];
    *destination++ = alphabet[bits >> 18];
    *destination++ = alphabet[bits >> 12 & 63];
    *destination++ = left > 1 ? alphabet[bits >> 6 & 63] : '=';
    *destination++ = left > 2 ? alphabet[bits & 63] : '=';
  }
  to->length += length;
  return true;
}

/* The value of each digit; -1 for other characters. */
static const int8_t values[128] = {-1, -1, -1, -1, -1, -1, -1, -1, -1, -1, -1, -1, -1, -1, -1, -1, -1, -1, -1,
    -1, -1, -1, -1, -1, -1, -1, -1, -1, -1, -1, -1, -1, -1, -1, -1, -1, -1, -1, -1, -1, -1, -1, -1, 62, -1,
    -1, -1, 63, 52, 53, 54, 55, 56, 57, 58, 59, 60, 61, -1, -1, -1, -1, -1, -1, -1, 0, 1, 2, 3, 4, 5, 6, 7, 8,
    9, 10, 11, 12, 13, 14, 15, 16, 17, 18, 19, 20, 21, 22, 23, 24, 25, -1, -1, -1, -1, -1, -1, 26, 27, 28, 29,
    30, 31, 32, 33, 34, 35, 36, 37, 38, 39, 40, 41, 42, 43, 44, 45, 46, 47, 48, 49, 50, 51, -1, -1, -1, -1,
    -1};

static inline int digit_value(char c) {
  return (unsigned char)c < 128 ? values[(unsigned char)c] : -1;
}

/* Decodes complete groups of four digits up to the first other character; returns the offset after them. */
static size_t read_groups(const char *text, size_t length, uint8_t **to) {
  uint8_t *at = *to;
  size_t i = 0;
  for (; length - i >= 4; i += 4) {
    int a = digit_value(text[i]), b = digit_value(text[i + 1]);
    int c = digit_value(text[i + 2]), d = digit_value(text[i + 3]);
    if (a < 0 || b < 0 || c < 0 || d < 0) break;
    *at++ = (uint8_t)(a << 2 | b >> 4);
    *at++ = (uint8_t)(b << 4 | c >> 2);
    *at++ = (uint8_t)(c << 6 | d);
  }
  *to = at;
  return i;
}

size_t sbfi_base64_read(sbfi_base64_reader *r, const char *text, size_t length, uint8_t *to, size_t *size) {
  uint8_t *at = to;
  size_t i = 0;
  for (; i < length; i++) {
    if (r->digits + r->paddings == 0 && !r->ended) i += read_groups(text + i, length - i, &at);
    if (i == length) break;
    char c = text[i];
    if (sbfi_is_space(c)) continue;
    if (r->ended) break;
    if (c == '=') {
      /* One byte leaves 4 bits of the second digit unused, two bytes 2 bits of the third. */
      if (r->digits < 2 || (r->bits & (r->digits == 2 ? 0xF : 0x3))) break;
      r->paddings++;
    } else {
      int value = digit_value(c);
      if (value < 0 || r->paddings) break;
      r->bits = r->bits << 6 | (uint32_t)value;
      r->digits++;
    }
    if (r->digits + r->paddings < 4) continue;
    uint32_t bits = r->bits << 6 * r->paddings;
    *at++ = (uint8_t)(bits >> 16);
    if (r->paddings < 2) *at++ = (uint8_t)(bits >> 8);
    if (r->paddings < 1) *at++ = (uint8_t)bits;
    *r = (sbfi_base64_reader){.ended = r->paddings > 0};
  }
  *size = (size_t)(at - to);
  return i;
}

bool sbfi_base64_is_complete(const sbfi_base64_reader *r) {
  return r->digits + r->paddings == 0;
}
