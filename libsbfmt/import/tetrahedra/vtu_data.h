/* Numbers of a VTK XML data array: text, base64, or appended after the document; uncompressed or in zlib
 * blocks.
 *
 * Binary numbers have a header. Uncompressed: the number of bytes. Compressed: the number of blocks, the
 * size of a block, the size of the last one if smaller (else 0), and the compressed size of each; header
 * and data may be separate base64 texts. Sizes in a header are limited by the available bytes: deflate
 * expands a byte to at most 1032, and no array has more than SBFI_VTU_ARRAY_BYTES. */
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

/* Type with that name, as "Float32"; SBFI_VTU_TYPES if unknown. */
sbfi_vtu_type sbfi_vtu_type_of(sbfi_span name);

typedef enum sbfi_vtu_format { SBFI_VTU_ASCII, SBFI_VTU_INLINE, SBFI_VTU_APPENDED } sbfi_vtu_format;

/* A data array in the document. */
typedef struct sbfi_vtu_array {
  bool given;
  sbfi_vtu_type type;
  sbfi_vtu_format format;
  uint64_t offset; /* into the appended data */
  uint32_t line;   /* of its tag */
  sbfi_text text;  /* content of the element */
} sbfi_vtu_array;

/* Encoding of all arrays of a file. */
typedef struct sbfi_vtu_coding {
  bool swap_bytes;    /* byte order differs from the machine's */
  bool wide_header;   /* header words have 8 bytes, otherwise 4 */
  bool compressed;    /* zlib blocks */
  bool appended_text; /* the appended data are base64 */
  sbfi_span appended; /* after the underscore */
  sbfi_packed_coder coder;
} sbfi_vtu_coding;

/* Appends all numbers of an array to an array of float or uint32_t. False, with a failure recorded at the
 * array's line, if they are missing, not finite, or not valid indices. */
bool sbfi_vtu_floats(
    sbfi_word_reader *r, sbfi_vtu_coding *coding, const sbfi_vtu_array *from, sbfi_array *to);
bool sbfi_vtu_indices(
    sbfi_word_reader *r, sbfi_vtu_coding *coding, const sbfi_vtu_array *from, sbfi_array *to);

#endif
