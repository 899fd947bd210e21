/* The numbers of a VTK XML data array: as text, as base64, or behind the document; plain or in zlib blocks.
 *
 * Binary numbers stand behind a header. Plain: the count of bytes. Compressed: the number of blocks, the
 * bytes of a block, those of the last one if they are fewer (else 0), the compressed bytes of each; header
 * and data may be base64 of their own. What a header claims is believed only as far as the bytes that are
 * there allow: deflate makes at most 1032 bytes of one, and no array has more than SBFI_VTU_ARRAY_BYTES. */
#ifndef SBFI_VTU_DATA_H
#define SBFI_VTU_DATA_H

#include "import/tetrahedra/word_reader.h"
#include "packed/packed_codec.h"

#define SBFI_VTU_ARRAY_BYTES ((uint64_t)1 << 30)

typedef enum sbfi_vtu_type {
  SBFI_VTU_INT8,
  SBFI_VTU_UINT8,
  SBFI_VTU_INT16,
  SBFI_VTU_UINT16,
  SBFI_VTU_INT32,
  SBFI_VTU_UINT32,
  SBFI_VTU_INT64,
  SBFI_VTU_UINT64,
  SBFI_VTU_FLOAT32,
  SBFI_VTU_FLOAT64,
  SBFI_VTU_TYPES
} sbfi_vtu_type;

/* The type of that name, as "Float32"; SBFI_VTU_TYPES for none. */
sbfi_vtu_type sbfi_vtu_type_of(sbfi_span name);

typedef enum sbfi_vtu_format { SBFI_VTU_ASCII, SBFI_VTU_INLINE, SBFI_VTU_APPENDED } sbfi_vtu_format;

/* One data array as the document has it. */
typedef struct sbfi_vtu_array {
  bool given;
  sbfi_vtu_type type;
  sbfi_vtu_format format;
  uint64_t offset; /* into the appended data */
  uint32_t line;   /* of its tag */
  sbfi_text text;  /* what stands in the element */
} sbfi_vtu_array;

/* What holds for all arrays of a file. */
typedef struct sbfi_vtu_coding {
  bool swap_bytes;    /* numbers stand in the other order than the machine's */
  bool wide_header;   /* words of headers have 8 bytes, else 4 */
  bool compressed;    /* blocks of zlib */
  bool appended_text; /* the appended data are base64 */
  sbfi_span appended; /* behind their underscore */
  sbfi_packed_coder coder;
} sbfi_vtu_coding;

/* All numbers of an array, appended to an array of float, or of uint32_t; false, with the failure recorded at
 * the array's line, where they cannot be had, are not finite, or are no indices. */
bool sbfi_vtu_floats(
    sbfi_word_reader *r, sbfi_vtu_coding *coding, const sbfi_vtu_array *from, sbfi_array *to);
bool sbfi_vtu_indices(
    sbfi_word_reader *r, sbfi_vtu_coding *coding, const sbfi_vtu_array *from, sbfi_array *to);

#endif
