#include "import/tetrahedra/vtu_data.h"

#include <math.h>
#include <string.h>

#include "base/base64.h"

enum { MAX_INFLATION = 1032, PIECE_OF_TEXT = 1 << 16 };

static const struct {
  const char *name;
  uint32_t size;
} types[SBFI_VTU_TYPES] = {{"Int8", 1}, {"UInt8", 1}, {"Int16", 2}, {"UInt16", 2}, {"Int32", 4},
    {"UInt32", 4}, {"Int64", 8}, {"UInt64", 8}, {"Float32", 4}, {"Float64", 8}};

sbfi_vtu_type sbfi_vtu_type_of(sbfi_span name) {
  int i = 0;
  while (i < SBFI_VTU_TYPES && !sbfi_span_is(name, types[i].name)) i++;
  return (sbfi_vtu_type)i;
}

/* --- Bytes, from base64 or as they are ---------------------------------------------------------------- */

typedef struct byte_source {
  sbfi_word_reader *r;
  sbfi_span from;
  bool is_text;
  size_t read; /* number of consumed characters */
  sbfi_base64_reader base64;
  sbfi_array decoded; /* uint8_t */
} byte_source;

/* Decodes a piece; a new base64 text may follow a finished one. False if it is invalid. */
static bool decode_some(byte_source *s, size_t length) {
  size_t size, kept = s->decoded.count;
  if (!sbfi_word_push(s->r, &s->decoded, SBFI_BASE64_CAPACITY(length))) return false;
  size_t taken =
      sbfi_base64_read(&s->base64, s->from.at + s->read, length, (uint8_t *)s->decoded.at + kept, &size);
  s->decoded.count = kept + size;
  s->read += taken;
  if (taken == length) return true;
  if (!s->base64.ended)
    return sbfi_word_fail(s->r, SBF_CODE_IMPORT_SYNTAX, "an array has a character that is not base64");
  s->base64 = (sbfi_base64_reader){.bits = 0};
  return true;
}

/* First `count` bytes; NULL with a recorded failure if there are fewer. */
static const uint8_t *need(byte_source *s, uint64_t count) {
  if (count > s->from.length) goto short_of_bytes; /* base64 text is longer, so the check is valid for both */
  if (!s->is_text) return (const uint8_t *)s->from.at;
  while (s->decoded.count < count && s->read < s->from.length) {
    size_t left = s->from.length - s->read;
    if (!decode_some(s, left < PIECE_OF_TEXT ? left : PIECE_OF_TEXT)) return NULL;
  }
  if (s->decoded.count >= count) return s->decoded.at;
short_of_bytes:
  sbfi_word_fail(
      s->r, SBF_CODE_IMPORT_SYNTAX, "the data of an array end early: the file is truncated or damaged");
  return NULL;
}

/* --- Headers and blocks ------------------------------------------------------------------------------- */

static uint64_t load(const uint8_t *at, uint32_t size, bool swap) {
  uint8_t bytes[8];
  for (uint32_t i = 0; i < size; i++) bytes[i] = at[swap ? size - 1 - i : i];
  uint64_t wide = 0;
  uint32_t word = 0;
  uint16_t half = 0;
  switch (size) {
  case 1:
    return bytes[0];
  case 2:
    memcpy(&half, bytes, 2);
    return half;
  case 4:
    memcpy(&word, bytes, 4);
    return word;
  default:
    memcpy(&wide, bytes, 8);
    return wide;
  }
}

static uint64_t header_word(const sbfi_vtu_coding *c, const uint8_t *bytes, uint64_t i) {
  uint32_t size = c->wide_header ? 8 : 4;
  return load(bytes + i * size, size, c->swap_bytes);
}

static bool too_large(sbfi_word_reader *r, uint64_t bytes) {
  return sbfi_word_fail(r, SBF_CODE_IO_TOO_LARGE, "an array has %llu bytes, the limit is %llu",
      (unsigned long long)bytes, (unsigned long long)SBFI_VTU_ARRAY_BYTES);
}

typedef struct blocks {
  uint64_t count, size, last;
} blocks;

static uint64_t size_of_block(const blocks *b, uint64_t i) {
  return i + 1 < b->count || b->last == 0 ? b->size : b->last;
}

static bool inflate_block(sbfi_word_reader *r, sbfi_vtu_coding *c, const uint8_t *stored,
    uint64_t stored_size, sbfi_array *to, uint64_t size) {
  if (size / MAX_INFLATION > stored_size)
    return sbfi_word_fail(
        r, SBF_CODE_IMPORT_SYNTAX, "a compressed block states more bytes than it can contain");
  uint8_t *destination = sbfi_word_push(r, to, (size_t)size);
  if (!destination) return false;
  switch (sbfi_packed_inflate(
      &c->coder, stored, (size_t)stored_size, SBFI_FILTER_NONE, 0, destination, (size_t)size)) {
  case SBFI_CODED:
    return true;
  case SBFI_CODED_NO_MEMORY:
    return sbfi_word_fail(r, SBF_CODE_OUT_OF_MEMORY, "memory ran out while reading %s", r->file);
  default:
    return sbfi_word_fail(r, SBF_CODE_IMPORT_SYNTAX, "a compressed block of an array is damaged");
  }
}

static bool inflate_blocks(byte_source *s, sbfi_vtu_coding *c, sbfi_array *to) {
  uint32_t word = c->wide_header ? 8 : 4;
  const uint8_t *head = need(s, 3 * word);
  if (!head) return false;
  blocks b = {header_word(c, head, 0), header_word(c, head, 1), header_word(c, head, 2)};
  if (b.count == 0) return true;
  if (b.size == 0 || b.last > b.size)
    return sbfi_word_fail(s->r, SBF_CODE_IMPORT_SYNTAX, "the header of a compressed array is damaged");
  if (b.count > SBFI_VTU_ARRAY_BYTES / b.size) return too_large(s->r, UINT64_MAX);
  if (b.count > s->from.length / word) return need(s, UINT64_MAX) != NULL; /* reports the failure */
  uint64_t at = (3 + b.count) * word, end = at;
  head = need(s, at);
  for (uint64_t i = 0; head && i < b.count; i++) {
    uint64_t stored = header_word(c, head, 3 + i);
    if (stored > s->from.length) stored = s->from.length; /* too large anyway */
    end += stored;
  }
  head = head ? need(s, end) : NULL;
  for (uint64_t i = 0; head && i < b.count; i++) {
    uint64_t stored = header_word(c, head, 3 + i);
    if (!inflate_block(s->r, c, head + at, stored, to, size_of_block(&b, i))) return false;
    at += stored;
  }
  return head != NULL;
}

static bool copy_plain(byte_source *s, sbfi_vtu_coding *c, sbfi_array *to) {
  uint32_t word = c->wide_header ? 8 : 4;
  const uint8_t *head = need(s, word);
  if (!head) return false;
  uint64_t size = header_word(c, head, 0);
  if (size > SBFI_VTU_ARRAY_BYTES) return too_large(s->r, size);
  head = need(s, word + size);
  uint8_t *destination = head && size ? sbfi_word_push(s->r, to, (size_t)size) : NULL;
  if (destination) memcpy(destination, head + word, (size_t)size);
  return head && (destination || size == 0);
}

/* Copies the array's bytes as they were in VTK's memory. */
static bool read_bytes(sbfi_word_reader *r, sbfi_vtu_coding *c, const sbfi_vtu_array *from, sbfi_array *to) {
  byte_source s = {.r = r, .is_text = true, .from = {from->text.at, from->text.length}};
  if (from->format == SBFI_VTU_APPENDED) {
    if (!c->appended.at || from->offset > c->appended.length)
      return sbfi_word_fail(r, SBF_CODE_IMPORT_SYNTAX,
          "an array begins at byte %llu of the appended data, which have %llu bytes",
          (unsigned long long)from->offset, (unsigned long long)c->appended.length);
    s.from = (sbfi_span){c->appended.at + from->offset, c->appended.length - (size_t)from->offset};
    s.is_text = c->appended_text;
  }
  sbfi_array_init(&s.decoded, &to->allocator, 1);
  bool good = c->compressed ? inflate_blocks(&s, c, to) : copy_plain(&s, c, to);
  sbfi_array_free(&s.decoded);
  return good;
}

/* --- Numbers ------------------------------------------------------------------------------------------ */

static bool one_float(sbfi_word_reader *r, sbfi_vtu_type type, uint64_t bits, float *to) {
  uint32_t word = (uint32_t)bits;
  double wide;
  if (type == SBFI_VTU_FLOAT32) {
    memcpy(to, &word, 4);
  } else if (type == SBFI_VTU_FLOAT64) {
    memcpy(&wide, &bits, 8);
    *to = (float)wide;
  } else {
    return sbfi_word_fail(r, SBF_CODE_IMPORT_REFUSED, "points must be Float32 or Float64");
  }
  return isfinite(*to) || sbfi_word_fail(r, SBF_CODE_IMPORT_NOT_FINITE, "a point is not finite");
}

static bool one_index(sbfi_word_reader *r, sbfi_vtu_type type, uint64_t bits, uint32_t *to) {
  bool is_signed = type == SBFI_VTU_INT8 || type == SBFI_VTU_INT16 || type == SBFI_VTU_INT32;
  if (type == SBFI_VTU_FLOAT32 || type == SBFI_VTU_FLOAT64)
    return sbfi_word_fail(r, SBF_CODE_IMPORT_REFUSED, "cells must be whole numbers");
  bool negative = is_signed && bits >> (8 * types[type].size - 1);
  if (negative || bits > INT32_MAX)
    return sbfi_word_fail(r, SBF_CODE_IMPORT_INDEX, "a number of the cells is negative or above 2147483647");
  *to = (uint32_t)bits;
  return true;
}

static bool read_text(sbfi_word_reader *r, const sbfi_vtu_array *from, sbfi_array *to, bool floats) {
  sbfi_word_reader words;
  sbfi_word_reader_init(&words, from->text.at, from->text.length, r->file, r->error);
  words.line = from->line;
  for (;;) {
    const char *end = words.end;
    while (words.at < end && sbfi_is_space(*words.at)) words.line += *words.at++ == '\n';
    if (words.at == end) return true;
    void *destination = sbfi_word_push(&words, to, 1);
    if (!destination || !(floats ? sbfi_word_f32(&words, destination, "a number of the points")
                                 : sbfi_word_u32(&words, destination, "a number of the cells"))) {
      r->status = words.status;
      return false;
    }
  }
}

static bool read_numbers(
    sbfi_word_reader *r, sbfi_vtu_coding *c, const sbfi_vtu_array *from, sbfi_array *to, bool floats) {
  r->line = from->line;
  if (from->text.failed)
    return sbfi_word_fail(r, SBF_CODE_OUT_OF_MEMORY, "memory ran out while reading %s", r->file);
  if (from->format == SBFI_VTU_ASCII) return read_text(r, from, to, floats);
  sbfi_array bytes;
  sbfi_array_init(&bytes, &to->allocator, 1);
  bool good = read_bytes(r, c, from, &bytes);
  uint32_t size = types[from->type].size;
  if (good && bytes.count % size)
    good = sbfi_word_fail(
        r, SBF_CODE_IMPORT_SYNTAX, "the number of bytes of an array is not a multiple of its item size");
  size_t count = good ? bytes.count / size : 0;
  char *destination =
      count ? sbfi_word_push(r, to, count) : NULL; /* items of four bytes, float or uint32_t */
  good = good && (destination || count == 0);
  for (size_t i = 0; good && i < count; i++) {
    uint64_t bits = load((const uint8_t *)bytes.at + i * size, size, c->swap_bytes);
    good = floats ? one_float(r, from->type, bits, (float *)(void *)destination + i)
                  : one_index(r, from->type, bits, (uint32_t *)(void *)destination + i);
  }
  sbfi_array_free(&bytes);
  return good;
}

bool sbfi_vtu_floats(sbfi_word_reader *r, sbfi_vtu_coding *c, const sbfi_vtu_array *from, sbfi_array *to) {
  return read_numbers(r, c, from, to, true);
}

bool sbfi_vtu_indices(sbfi_word_reader *r, sbfi_vtu_coding *c, const sbfi_vtu_array *from, sbfi_array *to) {
  return read_numbers(r, c, from, to, false);
}
