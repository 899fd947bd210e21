#include "import/tetrahedra/word_reader.h"

#include <math.h>
#include <string.h>

#include "base/number.h"

void sbfi_word_reader_init(
    sbfi_word_reader *r, const char *bytes, size_t size, const char *file, sbf_diagnostic *error) {
  if (!bytes) bytes = ""; /* of an empty file */
  *r = (sbfi_word_reader){.at = bytes, .end = bytes + size, .file = file, .line = 1, .error = error};
}

bool sbfi_word_fail(sbfi_word_reader *r, sbf_code code, const char *format, ...) {
  if (r->status != SBF_OK) return false;
  va_list arguments;
  va_start(arguments, format);
  r->status = sbfi_diagnose_v(r->error, code, format, arguments);
  va_end(arguments);
  if (r->error) {
    r->error->line = r->line;
    sbfi_copy_text(r->error->file, sizeof r->error->file, r->file);
  }
  return false;
}

static void skip_space(sbfi_word_reader *r) {
  for (; r->at < r->end; r->at++) {
    if (r->comment && *r->at == r->comment)
      while (r->at < r->end && *r->at != '\n') r->at++;
    if (r->at == r->end || !sbfi_is_space(*r->at)) return;
    r->line += *r->at == '\n';
  }
}

bool sbfi_word_next(sbfi_word_reader *r, sbfi_span *word) {
  if (r->status != SBF_OK) return false;
  skip_space(r);
  const char *begin = r->at;
  while (r->at < r->end && !sbfi_is_space(*r->at)) r->at++;
  *word = (sbfi_span){begin, (size_t)(r->at - begin)};
  return word->length > 0;
}

bool sbfi_word_line(sbfi_word_reader *r, sbfi_span *line) {
  if (r->status != SBF_OK || r->at == r->end) return false;
  const char *begin = r->at, *stop = memchr(begin, '\n', (size_t)(r->end - begin));
  if (!stop) stop = r->end;
  r->at = stop < r->end ? stop + 1 : stop;
  r->line += stop < r->end;
  *line = sbfi_span_trim((sbfi_span){begin, (size_t)(stop - begin)});
  return true;
}

static bool next_number(sbfi_word_reader *r, sbfi_span *word, const char *what) {
  if (sbfi_word_next(r, word)) return true;
  return sbfi_word_fail(r, SBF_CODE_IMPORT_SYNTAX, "the file ends where %s is expected", what);
}

static bool not_a_number(sbfi_word_reader *r, sbfi_span word, const char *what) {
  int length = word.length < 40 ? (int)word.length : 40;
  return sbfi_word_fail(
      r, SBF_CODE_IMPORT_SYNTAX, "found '%.*s' where %s is expected", length, word.at, what);
}

bool sbfi_word_f32(sbfi_word_reader *r, float *value, const char *what) {
  sbfi_span word;
  if (!next_number(r, &word, what)) return false;
  return sbfi_parse_f32(word.at, word.length, value) == SBFI_NUMBER_READ || not_a_number(r, word, what);
}

bool sbfi_word_u32(sbfi_word_reader *r, uint32_t *value, const char *what) {
  sbfi_span word;
  if (!next_number(r, &word, what)) return false;
  return sbfi_parse_u32(word.at, word.length, value) == SBFI_NUMBER_READ || not_a_number(r, word, what);
}

bool sbfi_word_i32(sbfi_word_reader *r, int32_t *value, const char *what) {
  sbfi_span word;
  if (!next_number(r, &word, what)) return false;
  return sbfi_parse_i32(word.at, word.length, value) == SBFI_NUMBER_READ || not_a_number(r, word, what);
}

bool sbfi_word_count(sbfi_word_reader *r, uint32_t *value, uint32_t min_bytes, const char *what) {
  if (!sbfi_word_u32(r, value, what)) return false;
  if (*value <= (size_t)(r->end - r->at) / min_bytes + 1) return true;
  return sbfi_word_fail(r, SBF_CODE_IMPORT_SYNTAX,
      "a count of %u is more than the rest of the file can contain (%s)", *value, what);
}

static bool take(sbfi_word_reader *r, void *to, size_t size, const char *what) {
  if (r->status != SBF_OK) return false;
  if ((size_t)(r->end - r->at) < size)
    return sbfi_word_fail(r, SBF_CODE_IMPORT_SYNTAX, "the file ends in the middle of %s", what);
  unsigned char *bytes = to;
  for (size_t i = 0; i < size; i++) bytes[i] = (unsigned char)r->at[r->swap_bytes ? size - 1 - i : i];
  r->at += size;
  return true;
}

bool sbfi_binary_u32(sbfi_word_reader *r, uint32_t *value, const char *what) {
  return take(r, value, sizeof *value, what);
}

bool sbfi_binary_u64(sbfi_word_reader *r, uint64_t *value, const char *what) {
  return take(r, value, sizeof *value, what);
}

bool sbfi_binary_f32(sbfi_word_reader *r, float *value, const char *what) {
  if (!take(r, value, sizeof *value, what)) return false;
  return isfinite(*value) || sbfi_word_fail(r, SBF_CODE_IMPORT_NOT_FINITE, "%s is not a finite number", what);
}

bool sbfi_binary_f64(sbfi_word_reader *r, double *value, const char *what) {
  if (!take(r, value, sizeof *value, what)) return false;
  return isfinite((float)*value) ||
         sbfi_word_fail(r, SBF_CODE_IMPORT_NOT_FINITE, "%s is not a finite number", what);
}

void *sbfi_word_push(sbfi_word_reader *r, sbfi_array *array, size_t count) {
  void *destination = sbfi_array_push(array, count);
  if (!destination) sbfi_word_fail(r, SBF_CODE_OUT_OF_MEMORY, "memory ran out while reading %s", r->file);
  return destination;
}
