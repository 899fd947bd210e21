#include "packed/packed_codec.h"

#define ZLIB_CONST
#include <zlib.h>

#include "base/crc32_fold.h"
#include "packed/packed_filter.h"

enum { BLOCK_BYTES = SBFI_FILTER_BLOCK * 4, PIECE = 1 << 30, HEAD = 16 };

uint32_t sbfi_crc32(const void *bytes, size_t size) {
  uint8_t folded[SBFI_CRC32_FOLDED];
  size_t done = sbfi_crc32_fold(0, bytes, size, folded);
  uLong crc = done ? crc32_z(0xFFFFFFFF, folded, sizeof folded) : 0;
  return (uint32_t)crc32_z(crc, (const uint8_t *)bytes + done, size - done);
}

/* zlib frees without a size, but our allocators need it: it is stored in front of the block. */
static voidpf zlib_allocate(voidpf user, uInt count, uInt item_size) {
  size_t size;
  if (!sbfi_multiply_size(count, item_size, &size) || !sbfi_add_size(size, HEAD, &size)) return NULL;
  uint8_t *block = sbfi_allocate(user, size);
  if (!block) return NULL;
  memcpy(block, &size, sizeof size);
  return block + HEAD;
}

static void zlib_free(voidpf user, voidpf memory) {
  if (!memory) return;
  uint8_t *block = (uint8_t *)memory - HEAD;
  size_t size;
  memcpy(&size, block, sizeof size);
  sbfi_free(user, block, size);
}

void sbfi_packed_coder_init(sbfi_packed_coder *coder, const sbf_allocator *allocator, int level) {
  *coder = (sbfi_packed_coder){.allocator = sbfi_allocator_or_default(allocator), .level = level};
}

void sbfi_packed_coder_free(sbfi_packed_coder *coder) {
  if (coder->inflater) inflateEnd(coder->inflater);
  if (coder->deflater) deflateEnd(coder->deflater);
  sbfi_free(&coder->allocator, coder->inflater, sizeof(z_stream));
  sbfi_free(&coder->allocator, coder->deflater, sizeof(z_stream));
  sbfi_free(&coder->allocator, coder->block, BLOCK_BYTES);
  *coder = (sbfi_packed_coder){.allocator = coder->allocator, .level = coder->level};
}

static z_stream *new_stream(sbfi_packed_coder *coder) {
  z_stream *stream = sbfi_allocate(&coder->allocator, sizeof *stream);
  if (stream) *stream = (z_stream){.zalloc = zlib_allocate, .zfree = zlib_free, .opaque = &coder->allocator};
  return stream;
}

static z_stream *ready_stream(sbfi_packed_coder *coder, void **slot, bool inflating) {
  if (*slot) return (inflating ? inflateReset(*slot) : deflateReset(*slot)) == Z_OK ? *slot : NULL;
  z_stream *stream = new_stream(coder);
  if (!stream) return NULL;
  if ((inflating ? inflateInit(stream) : deflateInit(stream, coder->level)) != Z_OK) {
    sbfi_free(&coder->allocator, stream, sizeof *stream);
    return NULL;
  }
  return *slot = stream;
}

static bool ready_block(sbfi_packed_coder *coder) {
  if (!coder->block) coder->block = sbfi_allocate(&coder->allocator, BLOCK_BYTES);
  return coder->block != NULL;
}

/* zlib sizes have 32 bits: passes input and output in pieces. */
static uInt piece_of(size_t size) {
  return (uInt)(size < PIECE ? size : PIECE);
}

/* Inflates the next `size` bytes; Z_OK or Z_STREAM_END if all were produced. */
static int inflate_some(z_stream *stream, const uint8_t **in, size_t *in_size, uint8_t *out, size_t size) {
  int result = Z_OK;
  while (size && result == Z_OK) {
    uInt given = piece_of(*in_size), capacity = piece_of(size);
    stream->next_in = *in;
    stream->avail_in = given;
    stream->next_out = out;
    stream->avail_out = capacity;
    result = inflate(stream, Z_NO_FLUSH);
    uInt taken = given - stream->avail_in, made = capacity - stream->avail_out;
    *in += taken;
    *in_size -= taken;
    out += made;
    size -= made;
  }
  return size ? (result == Z_MEM_ERROR ? Z_MEM_ERROR : Z_DATA_ERROR) : result;
}

sbfi_coded sbfi_packed_inflate(sbfi_packed_coder *coder, const uint8_t *stored, size_t stored_size,
    sbfi_packed_filter filter, uint32_t width, uint8_t *to, size_t raw_size) {
  z_stream *stream = ready_stream(coder, &coder->inflater, true);
  if (!stream || (filter && !ready_block(coder))) return SBFI_CODED_NO_MEMORY;
  int result = Z_OK;
  if (!filter) result = inflate_some(stream, &stored, &stored_size, to, raw_size);
  for (size_t done = 0; filter && done < raw_size && result == Z_OK;) {
    size_t some = raw_size - done < BLOCK_BYTES ? raw_size - done : BLOCK_BYTES;
    result = inflate_some(stream, &stored, &stored_size, coder->block, some);
    if (result != Z_OK && result != Z_STREAM_END) break;
    bool sound = sbfi_unfilter_block(filter, coder->block, some / 4, width, to, done / 4);
    done += some;
    if (!sound) result = Z_DATA_ERROR;
    if (result == Z_STREAM_END && done < raw_size) result = Z_DATA_ERROR;
  }
  uint8_t beyond;
  if (result == Z_OK) { /* all bytes were produced: only the end mark and its checksum may follow */
    stream->next_in = stored;
    stream->avail_in = piece_of(stored_size);
    stream->next_out = &beyond;
    stream->avail_out = 1;
    result = inflate(stream, Z_FINISH);
    if (stream->avail_out == 0) result = Z_DATA_ERROR;
    stored_size -= piece_of(stored_size) - stream->avail_in;
  }
  if (result == Z_MEM_ERROR) return SBFI_CODED_NO_MEMORY;
  return result == Z_STREAM_END && stored_size == 0 ? SBFI_CODED : SBFI_CODED_DAMAGED;
}

/* Deflates `size` more bytes; false if the capacity is exhausted. */
static bool deflate_some(z_stream *stream, const uint8_t *in, size_t size, size_t *buffer, bool last) {
  do {
    uInt given = piece_of(size), free_bytes = piece_of(*buffer);
    int flush = last && given == size ? Z_FINISH : Z_NO_FLUSH;
    stream->next_in = in;
    stream->avail_in = given;
    stream->avail_out = free_bytes;
    int result = deflate(stream, flush);
    *buffer -= free_bytes - stream->avail_out;
    in += given - stream->avail_in;
    size -= given - stream->avail_in;
    if (flush == Z_FINISH && result == Z_STREAM_END) return true;
    if (*buffer == 0 || (result != Z_OK && result != Z_BUF_ERROR)) return false;
  } while (size || last);
  return true;
}

sbfi_coded sbfi_packed_deflate(sbfi_packed_coder *coder, const uint8_t *raw, size_t raw_size,
    sbfi_packed_filter filter, uint32_t width, uint8_t *to, size_t capacity, size_t *stored_size) {
  z_stream *stream = ready_stream(coder, &coder->deflater, false);
  if (!stream || (filter && !ready_block(coder))) return SBFI_CODED_NO_MEMORY;
  stream->next_out = to;
  size_t left = capacity;
  bool fits = true;
  if (!filter || raw_size == 0) fits = deflate_some(stream, raw, raw_size, &left, true);
  for (size_t done = 0; filter && fits && done < raw_size;) {
    size_t some = raw_size - done < BLOCK_BYTES ? raw_size - done : BLOCK_BYTES;
    fits = sbfi_filter_block(filter, raw, done / 4, some / 4, width, coder->block);
    done += some;
    fits = fits && deflate_some(stream, coder->block, some, &left, done == raw_size);
  }
  *stored_size = capacity - left;
  return fits ? SBFI_CODED : SBFI_CODED_TOO_LONG;
}
