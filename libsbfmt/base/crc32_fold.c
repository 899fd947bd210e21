/* A CRC is the remainder of the message, as a polynomial over two elements, divided by P. Sixteen bytes that
 * stand D bits before others may be added to those if multiplied by x^D; modulo P that is a product of each
 * half with a constant of 33 bits, which keeps the sum at sixteen bytes. Four such sums run side by side,
 * since a product takes several cycles and begins every one.
 *
 * V. Gopal and others, "Fast CRC Computation for Generic Polynomials Using PCLMULQDQ Instruction", Intel,
 * 2009. */
#include "base/crc32_fold.h"

#if defined(__x86_64__) && defined(__GNUC__)
#include <immintrin.h>
#define FOLDS __attribute__((target("pclmul,sse2")))

/* For D bits: x^(D + 32) mod P for the half that comes first, x^(D - 32) for the other; as the CRC has its
 * bits, lowest power in the highest bit, and shifted by the one bit that a product of such numbers is short
 * of. */
FOLDS static inline __m128i over_512_bits(void) {
  return _mm_set_epi64x(0x1c6e41596, 0x154442bd4);
}
FOLDS static inline __m128i over_128_bits(void) {
  return _mm_set_epi64x(0x0ccaa009e, 0x1751997d0);
}

FOLDS static inline __m128i carry_over(__m128i sum, __m128i constants, __m128i onto) {
  __m128i first = _mm_clmulepi64_si128(sum, constants, 0x00),
          second = _mm_clmulepi64_si128(sum, constants, 0x11);
  return _mm_xor_si128(onto, _mm_xor_si128(first, second));
}

FOLDS static inline __m128i load(const uint8_t *from) {
  return _mm_loadu_si128((const __m128i *)(const void *)from);
}

/* Processors look ahead within a page only: measured, a quarter of the time where the bytes lie in the
 * third-level cache. As a number, since there may be nothing so far on. */
enum { AHEAD = 8192 };

FOLDS static inline void announce(const uint8_t *at) {
  __builtin_prefetch((const void *)((uintptr_t)at + AHEAD));
}

FOLDS static size_t fold(uint32_t crc, const uint8_t *bytes, size_t size, uint8_t *folded) {
  __m128i far = over_512_bits(), near = over_128_bits();
  __m128i a = _mm_xor_si128(load(bytes), _mm_cvtsi32_si128((int32_t)~crc));
  __m128i b = load(bytes + 16), c = load(bytes + 32), d = load(bytes + 48);
  size_t done = 64;
  for (; size - done >= 64; done += 64) {
    announce(bytes + done);
    a = carry_over(a, far, load(bytes + done));
    b = carry_over(b, far, load(bytes + done + 16));
    c = carry_over(c, far, load(bytes + done + 32));
    d = carry_over(d, far, load(bytes + done + 48));
  }
  d = carry_over(carry_over(carry_over(a, near, b), near, c), near, d);
  for (; size - done >= 16; done += 16) d = carry_over(d, near, load(bytes + done));
  _mm_storeu_si128((__m128i *)(void *)folded, d);
  return done;
}

size_t sbfi_crc32_fold(uint32_t crc, const void *bytes, size_t size, uint8_t folded[SBFI_CRC32_FOLDED]) {
  return size >= 64 && __builtin_cpu_supports("pclmul") ? fold(crc, bytes, size, folded) : 0;
}

#else

size_t sbfi_crc32_fold(uint32_t crc, const void *bytes, size_t size, uint8_t folded[SBFI_CRC32_FOLDED]) {
  (void)crc, (void)bytes, (void)size, (void)folded;
  return 0;
}

#endif
