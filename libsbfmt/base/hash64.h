/* A fast 64-bit hash for the state of a simulation and for finding equal content; not for untrusted keys. The
 * value is XXH64 with seed 0 over numbers as little-endian bytes, so it is the same on every machine and any
 * other program can compute it. Floats are hashed as bits: 0 and -0 differ. */
#ifndef SBFI_HASH64_H
#define SBFI_HASH64_H

#include "sbfmt/base.h"

typedef struct sbfi_hash64 {
  uint64_t lane[4];
  uint8_t pending[32]; /* incomplete stripe of size % 32 bytes */
  uint64_t size;       /* total bytes so far */
} sbfi_hash64;

void sbfi_hash64_init(sbfi_hash64 *hash);
/* The division of a sequence of bytes into calls does not matter. */
void sbfi_hash64_add_bytes(sbfi_hash64 *hash, const void *bytes, size_t size);
void sbfi_hash64_add_u32(sbfi_hash64 *hash, const uint32_t *numbers, size_t count);
void sbfi_hash64_add_u64(sbfi_hash64 *hash, const uint64_t *numbers, size_t count);
void sbfi_hash64_add_f32(sbfi_hash64 *hash, const float *numbers, size_t count);
void sbfi_hash64_add_f64(sbfi_hash64 *hash, const double *numbers, size_t count);
/* Hash of everything so far; more may follow. */
uint64_t sbfi_hash64_value(const sbfi_hash64 *hash);

#endif
