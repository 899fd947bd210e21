/* Numbers as text, the same bytes in every locale and rounding mode.
 *
 * The reader accepts what XML Schema's xs:float accepts, except INF and NaN:
 *
 *     [+-]? ( digits ( "." digits? )? | "." digits ) ( [eE] [+-]? digits )?
 *
 * It rounds to the nearest float32, ties to even, for any number of digits. A number that is too small
 * becomes a subnormal or a zero of its sign; one that would round to infinity is refused. Integers are [+-]?
 * digits. Nothing is skipped: white space, hexadecimal, and digit separators are not part of a number.
 *
 * The writer produces the canonical form, the same as C++17's std::to_chars(first, last, float):
 *
 *   - the fewest significant digits that read back to the same float32, and among those the nearest to it;
 *   - the shorter of the layouts 123.45 and d.ddde±XX (sign always, at least two exponent digits), the first
 *     if they are equally long: 1000, 0.001, 1e+05, 1.5e-07;
 *   - no "+" in front, no needless leading or trailing zero, no trailing point; zeros are 0 and -0;
 *   - a whole number without exponent is written exactly, 123456792 and not 123456790.
 *
 * All functions are thread safe and allocate nothing. */
#ifndef SBFI_NUMBER_H
#define SBFI_NUMBER_H

#include "sbfmt/base.h"

typedef enum sbfi_number_status {
  SBFI_NUMBER_READ = 0,
  SBFI_NUMBER_MALFORMED,   /* no number, or an incomplete one such as "1e" */
  SBFI_NUMBER_OUT_OF_RANGE /* a number outside the type's range */
} sbfi_number_status;

/* Reads the number at the start of the span; the caller checks what follows it ("1..2" gives 1 and stops at
 * the second point). `*used` receives the length of the number or, if malformed, the offset of the first
 * invalid character. `*value` is written only on SBFI_NUMBER_READ. */
sbfi_number_status sbfi_scan_f32(const char *text, size_t length, float *value, size_t *used);
sbfi_number_status sbfi_scan_i32(const char *text, size_t length, int32_t *value, size_t *used);
sbfi_number_status sbfi_scan_u32(const char *text, size_t length, uint32_t *value, size_t *used);

/* The same, but the span must contain nothing else. */
sbfi_number_status sbfi_parse_f32(const char *text, size_t length, float *value);
sbfi_number_status sbfi_parse_i32(const char *text, size_t length, int32_t *value);
sbfi_number_status sbfi_parse_u32(const char *text, size_t length, uint32_t *value);

/* Maximum length of a number; no NUL is written. */
enum { SBFI_F32_TEXT_SIZE = 16, SBFI_INTEGER_TEXT_SIZE = 20 };

/* Each writes the number to `to` and returns its length. sbfi_print_f32 returns 0 and writes nothing for an
 * infinity or a NaN, which have no text form. */
size_t sbfi_print_f32(char *to, float value);
size_t sbfi_print_i32(char *to, int32_t value);
size_t sbfi_print_u32(char *to, uint32_t value);
size_t sbfi_print_u64(char *to, uint64_t value);

#endif
