/* The format: P. Deutsch, RFC 1951 (deflate) and RFC 1950 (zlib), 1996. Codes of up to FAST_BITS bits use
 * a lookup table; longer ones are decoded by length. */
#include "packed/packed_inflate.h"

#include <string.h>

enum { FAST_BITS = 9, LONGEST = 15, LITERALS = 288, DISTANCES = 30, LENGTH_CODES = 19, END_OF_BLOCK = 256 };

typedef struct stream {
  const uint8_t *in, *in_end;
  uint8_t *begin, *out, *out_end;
  uint64_t bits; /* lookahead, the next bit lowest */
  uint32_t bit_count;
  uint32_t missing; /* bits requested beyond the end, read as 0 */
} stream;

typedef struct huffman {
  uint16_t fast[1 << FAST_BITS]; /* symbol << 4 | length; 0: longer, or invalid */
  uint16_t count[LONGEST + 1];   /* number of codes of each length */
  uint16_t symbols[LITERALS];    /* in the order of their codes */
} huffman;

static void fill(stream *s) {
  while (s->bit_count <= 48) {
    if (s->in < s->in_end)
      s->bits |= (uint64_t)*s->in++ << s->bit_count;
    else
      s->missing += 8;
    s->bit_count += 8;
  }
}

/* Reads up to 16 bits. `fill` is required at least before every second call. */
static uint32_t take_bits(stream *s, uint32_t count) {
  uint32_t value = (uint32_t)(s->bits & ((1u << count) - 1));
  s->bits >>= count;
  s->bit_count -= count;
  return value;
}

/* Whether bits beyond the end were consumed, not only read ahead. */
static bool is_beyond(const stream *s) {
  return s->missing > s->bit_count;
}

/* An incomplete code is valid only with a single symbol or none. */
static bool make_huffman(huffman *h, const uint8_t *lengths, uint32_t count) {
  uint32_t first[LONGEST + 1], indices[LONGEST + 1], code = 0, index = 0, used = 0;
  int32_t left = 1;
  memset(h, 0, sizeof *h);
  for (uint32_t i = 0; i < count; i++) h->count[lengths[i]]++;
  used = count - h->count[0];
  h->count[0] = 0;
  for (uint32_t length = 1; length <= LONGEST; length++) {
    left = left * 2 - h->count[length];
    if (left < 0) return false;
    code = (code + h->count[length - 1]) << 1;
    first[length] = code;
    indices[length] = index;
    index += h->count[length];
  }
  if (left > 0 && (used > 1 || (used == 1 && h->count[1] != 1))) return false;
  for (uint32_t i = 0; i < count; i++) {
    uint32_t length = lengths[i];
    if (length == 0) continue;
    uint32_t own = first[length]++, reversed = 0;
    h->symbols[indices[length]++] = (uint16_t)i;
    if (length > FAST_BITS) continue;
    for (uint32_t bit = 0; bit < length; bit++) reversed |= (own >> bit & 1) << (length - 1 - bit);
    for (uint32_t at = reversed; at < 1u << FAST_BITS; at += 1u << length)
      h->fast[at] = (uint16_t)(i << 4 | length);
  }
  return true;
}

/* Decodes the next symbol; -1 for an invalid code. Uses at most 15 bits. */
static int32_t decode(stream *s, const huffman *h) {
  uint32_t entry = h->fast[s->bits & ((1u << FAST_BITS) - 1)];
  if (entry) {
    take_bits(s, entry & 15);
    return (int32_t)(entry >> 4);
  }
  int32_t code = 0, first = 0, index = 0;
  uint64_t bits = s->bits;
  for (uint32_t length = 1; length <= LONGEST; length++, bits >>= 1) {
    int32_t count = h->count[length];
    code |= (int32_t)(bits & 1);
    if (code - first < count) {
      take_bits(s, length);
      return h->symbols[index + code - first];
    }
    index += count;
    first = (first + count) << 1;
    code <<= 1;
  }
  return -1;
}

static bool stored_block(stream *s) {
  take_bits(s, s->bit_count & 7);
  fill(s);
  uint32_t size = take_bits(s, 16), inverse = take_bits(s, 16);
  if (size != (inverse ^ 0xFFFF) || is_beyond(s)) return false;
  /* Returns the lookahead to the input. */
  s->in -= (s->bit_count - s->missing) / 8;
  s->bits = s->bit_count = s->missing = 0;
  if (size > (size_t)(s->in_end - s->in) || size > (size_t)(s->out_end - s->out)) return false;
  if (size) memcpy(s->out, s->in, size);
  s->in += size;
  s->out += size;
  return true;
}

static bool copy_match(stream *s, uint32_t length, const huffman *distances) {
  static const uint16_t bases[DISTANCES] = {1, 2, 3, 4, 5, 7, 9, 13, 17, 25, 33, 49, 65, 97, 129, 193, 257,
      385, 513, 769, 1025, 1537, 2049, 3073, 4097, 6145, 8193, 12289, 16385, 24577};
  int32_t code = decode(s, distances);
  if (code < 0 || code >= DISTANCES) return false;
  size_t distance = bases[code] + take_bits(s, code < 4 ? 0 : (uint32_t)code / 2 - 1);
  if (distance > (size_t)(s->out - s->begin) || length > (size_t)(s->out_end - s->out)) return false;
  const uint8_t *from = s->out - distance;
  while (length--) *s->out++ = *from++; /* ranges may overlap: reads bytes that were just written */
  return true;
}

static bool coded_block(stream *s, const huffman *literals, const huffman *distances) {
  static const uint16_t bases[29] = {3, 4, 5, 6, 7, 8, 9, 10, 11, 13, 15, 17, 19, 23, 27, 31, 35, 43, 51, 59,
      67, 83, 99, 115, 131, 163, 195, 227, 258};
  for (;;) {
    fill(s); /* enough for a length, 15 + 5 bits, and a distance, 15 + 13 */
    int32_t symbol = decode(s, literals);
    if (symbol < 0 || is_beyond(s)) return false;
    if (symbol == END_OF_BLOCK) return true;
    if (symbol < END_OF_BLOCK) {
      if (s->out == s->out_end) return false;
      *s->out++ = (uint8_t)symbol;
      continue;
    }
    uint32_t index = (uint32_t)symbol - END_OF_BLOCK - 1;
    if (index >= 29) return false;
    uint32_t extra = index < 8 || index == 28 ? 0 : index / 4 - 1;
    if (!copy_match(s, bases[index] + take_bits(s, extra), distances)) return false;
  }
}

static bool fixed_block(stream *s) {
  huffman literals, distances;
  uint8_t lengths[LITERALS];
  for (int i = 0; i < LITERALS; i++) lengths[i] = i < 144 ? 8 : i < 256 ? 9 : i < 280 ? 7 : 8;
  if (!make_huffman(&literals, lengths, LITERALS)) return false;
  memset(lengths, 5, 32);
  return make_huffman(&distances, lengths, 32) && coded_block(s, &literals, &distances);
}

static bool dynamic_block(stream *s) {
  static const uint8_t order[LENGTH_CODES] = {
      16, 17, 18, 0, 8, 7, 9, 6, 10, 5, 11, 4, 12, 3, 13, 2, 14, 1, 15};
  huffman literals, distances;
  uint8_t lengths[LITERALS + 32] = {0};
  fill(s);
  uint32_t literal_count = take_bits(s, 5) + 257, distance_count = take_bits(s, 5) + 1,
           code_count = take_bits(s, 4) + 4;
  if (literal_count > 286 || distance_count > DISTANCES) return false;
  for (uint32_t i = 0; i < code_count; i++) {
    fill(s);
    lengths[order[i]] = (uint8_t)take_bits(s, 3);
  }
  huffman *codes = &distances; /* reuses the memory until the distances are decoded */
  if (!make_huffman(codes, lengths, LENGTH_CODES)) return false;
  for (uint32_t i = 0; i < literal_count + distance_count;) {
    fill(s);
    int32_t symbol = decode(s, codes);
    if (symbol < 0 || is_beyond(s)) return false;
    uint32_t times = 1, value = (uint32_t)symbol;
    if (symbol >= 16) {
      if (symbol == 16 && i == 0) return false;
      value = symbol == 16 ? lengths[i - 1] : 0;
      times = symbol == 16 ? 3 + take_bits(s, 2) : symbol == 17 ? 3 + take_bits(s, 3) : 11 + take_bits(s, 7);
    }
    if (times > literal_count + distance_count - i) return false;
    while (times--) lengths[i++] = (uint8_t)value;
  }
  return lengths[END_OF_BLOCK] != 0 && make_huffman(&literals, lengths, literal_count) &&
         make_huffman(&distances, lengths + literal_count, distance_count) &&
         coded_block(s, &literals, &distances);
}

static uint32_t adler32(const uint8_t *bytes, size_t size) {
  uint32_t a = 1, b = 0;
  while (size) {
    size_t some = size < 5552 ? size : 5552; /* the sums stay below 2^32 */
    size -= some;
    while (some--) b += a += *bytes++;
    a %= 65521;
    b %= 65521;
  }
  return b << 16 | a;
}

bool sbfi_inflate(const uint8_t *stored, size_t stored_size, uint8_t *to, size_t size) {
  if (stored_size < 6 || (stored[0] & 15) != 8 || stored[0] >> 4 > 7 || (stored[1] & 0x20) ||
      (stored[0] << 8 | stored[1]) % 31)
    return false;
  stream s = {.in = stored + 2, .in_end = stored + stored_size, .begin = to, .out = to, .out_end = to + size};
  for (bool last = false; !last;) {
    fill(&s);
    last = take_bits(&s, 1);
    uint32_t kind = take_bits(&s, 2);
    bool good = kind == 0 ? stored_block(&s) : kind == 1 ? fixed_block(&s) : kind == 2 && dynamic_block(&s);
    if (!good || is_beyond(&s)) return false;
  }
  fill(&s);
  take_bits(&s, s.bit_count & 7);
  if (s.out != s.out_end || is_beyond(&s)) return false;
  const uint8_t *end = s.in - (s.bit_count - s.missing) / 8;
  if (s.in_end - end != 4) return false;
  uint32_t sum = (uint32_t)end[0] << 24 | (uint32_t)end[1] << 16 | (uint32_t)end[2] << 8 | end[3];
  return sum == adler32(to, size);
}
