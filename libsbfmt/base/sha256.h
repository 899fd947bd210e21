/* SHA-256 of a stream of bytes: the hash of source files and of canonical XML. */
#ifndef SBFI_SHA256_H
#define SBFI_SHA256_H

#include "sbfmt/base.h"

enum { SBFI_SHA256_BYTES = 32, SBFI_SHA256_TEXT_SIZE = 65 };

typedef struct sbfi_sha256 {
  uint32_t state[8];
  uint8_t pending[64]; /* incomplete block of size % 64 bytes */
  uint64_t size;       /* total bytes so far */
} sbfi_sha256;

void sbfi_sha256_init(sbfi_sha256 *hash);
void sbfi_sha256_update(sbfi_sha256 *hash, const void *bytes, size_t size);
void sbfi_sha256_finish(sbfi_sha256 *hash, uint8_t digest[SBFI_SHA256_BYTES]); /* call init before reuse */

/* As 64 lower-case hexadecimal digits and a NUL. */
void sbfi_sha256_format(const uint8_t digest[SBFI_SHA256_BYTES], char text[SBFI_SHA256_TEXT_SIZE]);

#endif
