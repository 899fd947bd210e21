/* CRC-32 at the speed of memory, where the processor multiplies without carries (PCLMULQDQ of x86-64). */
#ifndef SBFI_CRC32_FOLD_H
#define SBFI_CRC32_FOLD_H

#include <stddef.h>
#include <stdint.h>

enum { SBFI_CRC32_FOLDED = 16 };

/* Folds the first bytes, as many as it returns, into 16: the CRC-32 of all `size` bytes, begun with `crc`, is
 * that of the folded ones, begun with 0xFFFFFFFF, continued over the rest. Returns 0, and folds nothing,
 * where the processor cannot or `size` is below 64. */
size_t sbfi_crc32_fold(uint32_t crc, const void *bytes, size_t size, uint8_t folded[SBFI_CRC32_FOLDED]);

#endif
