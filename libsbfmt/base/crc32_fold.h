/* CRC-32 at memory bandwidth, on processors with carry-less multiplication (PCLMULQDQ of x86-64). */
#ifndef SBFI_CRC32_FOLD_H
#define SBFI_CRC32_FOLD_H

#include <stddef.h>
#include <stdint.h>

enum { SBFI_CRC32_FOLDED = 16 };

/* Folds the first bytes into 16 and returns their number. The CRC-32 of all `size` bytes with initial value
 * `crc` equals that of `folded` with initial value 0xFFFFFFFF, continued over the remaining bytes. Returns 0
 * and does nothing if the processor lacks the instruction or `size` is below 64. */
size_t sbfi_crc32_fold(uint32_t crc, const void *bytes, size_t size, uint8_t folded[SBFI_CRC32_FOLDED]);

#endif
