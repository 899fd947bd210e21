#include "base/base64.h"

static const char alphabet[64] = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";

bool sbfi_base64_encode(sbfi_text *to, const uint8_t *bytes, size_t size) {
  if (size > SIZE_MAX / 4 * 3 - 3) {
    to->failed = true;
    return false;
  }
  size_t length = (size + 2) / 3 * 4;
  char *place = sbfi_text_reserve(to, length);
  if (!place) return false;
  for (size_t i = 0; i < size; i += 3) {
    size_t left = size - i;
    uint32_t bits = (uint32_t)bytes[i] << 16;
    if (left > 1) bits |= (uint32_t)bytes[i + 1] << 8;
    if (left > 2) bits |= bytes[i + 2];
    *place++ = alphabet[bits >> 18];
    *place++ = alphabet[bits >> 12 & 63];
    *place++ = left > 1 ? alphabet[bits >> 6 & 63] : '=';
    *place++ = left > 2 ? alphabet[bits & 63] : '=';
  }
  to->length += length;
  return true;
}

/* The value of a digit, -1 for anything else. */
static int digit_value(char c) {
  if (c >= 'A' && c <= 'Z') return c - 'A';
  if (c >= 'a' && c <= 'z') return c - 'a' + 26;
  if (c >= '0' && c <= '9') return c - '0' + 52;
  return c == '+' ? 62 : c == '/' ? 63 : -1;
}

size_t sbfi_base64_read(sbfi_base64_reader *r, const char *text, size_t length, uint8_t *to, size_t *size) {
  uint8_t *at = to;
  size_t i = 0;
  for (; i < length; i++) {
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
