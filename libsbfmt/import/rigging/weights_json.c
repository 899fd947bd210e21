/* Parses the subset of JSON (RFC 8259) that a list of weights needs; skips values of other keys. */
#include <string.h>

#include "import/quote.h"
#include "import/rigging/weights_rows.h"

enum { DEEPEST = 64 };

typedef struct reader {
  sbfi_weights_rows *to;
  const char *at, *end;
  uint32_t line;
} reader;

static void skip_blanks(reader *r) {
  for (; r->at < r->end && sbfi_is_space(*r->at); r->at++) r->line += *r->at == '\n';
}

static bool take(reader *r, char c) {
  skip_blanks(r);
  if (r->at == r->end || *r->at != c) return false;
  r->at++;
  return true;
}

static sbf_status fail(const reader *r, const char *wanted) {
  size_t length = (size_t)(r->end - r->at);
  return sbfi_weights_rows_fail(r->to, r->line, "JSON: expected %s instead of '%s'", wanted,
      sbfi_quote_of((sbfi_span){r->at, length < 24 ? length : 24}).text);
}

static int hex_of(const char *at) {
  int value = 0;
  for (int k = 0; k < 4; k++) {
    const char *digits = "0123456789abcdef0123456789ABCDEF", *found = at[k] ? strchr(digits, at[k]) : NULL;
    if (!found) return -1;
    value = value * 16 + (int)((found - digits) % 16);
  }
  return value;
}

static char *put_utf8(char *to, uint32_t code) {
  if (code < 0x80) {
    *to++ = (char)code;
  } else if (code < 0x800) {
    *to++ = (char)(0xC0 | code >> 6);
    *to++ = (char)(0x80 | (code & 63));
  } else if (code < 0x10000) {
    *to++ = (char)(0xE0 | code >> 12);
    *to++ = (char)(0x80 | (code >> 6 & 63));
    *to++ = (char)(0x80 | (code & 63));
  } else {
    *to++ = (char)(0xF0 | code >> 18);
    *to++ = (char)(0x80 | (code >> 12 & 63));
    *to++ = (char)(0x80 | (code >> 6 & 63));
    *to++ = (char)(0x80 | (code & 63));
  }
  return to;
}

/* Parses an escape after its backslash; NULL if it is invalid. */
static char *read_escape(reader *r, char *to) {
  static const char names[] = "\"\\/bfnrt", values[] = "\"\\/\b\f\n\r\t";
  const char *found = r->at < r->end && *r->at ? strchr(names, *r->at) : NULL;
  if (found) {
    r->at++;
    *to = values[found - names];
    return to + 1;
  }
  if (r->end - r->at < 5 || *r->at != 'u') return NULL;
  int code = hex_of(r->at + 1), low = -1;
  r->at += 5;
  if (code >= 0xD800 && code < 0xDC00 && r->end - r->at >= 6 && r->at[0] == '\\' && r->at[1] == 'u')
    low = hex_of(r->at + 2);
  if (low >= 0xDC00 && low < 0xE000) {
    r->at += 6;
    return put_utf8(to, 0x10000 + ((uint32_t)(code - 0xD800) << 10) + (uint32_t)(low - 0xDC00));
  }
  return code > 0 && (code < 0xD800 || code >= 0xE000) ? put_utf8(to, (uint32_t)code) : NULL;
}

static sbf_status read_string(reader *r, const char **text) {
  if (!take(r, '"')) return fail(r, "a text in quotes");
  const char *close = r->at;
  while (close < r->end && *close != '"') close += *close == '\\' && close + 1 < r->end ? 2 : 1;
  if (close >= r->end) return fail(r, "the end of a text");
  char *made = sbfi_arena_allocate(r->to->arena, (size_t)(close - r->at) + 1, 1), *to = made;
  if (!made)
    return sbfi_diagnose(r->to->error, SBF_CODE_OUT_OF_MEMORY, "memory ran out while weights were read");
  while (r->at < close) {
    if (*r->at != '\\') {
      *to++ = *r->at++;
      continue;
    }
    r->at++;
    to = read_escape(r, to);
    if (!to) return fail(r, "an escape");
  }
  r->at = close + 1;
  *text = made;
  return SBF_OK;
}

/* Returns a number or a word as text. */
static sbfi_span read_word(reader *r) {
  skip_blanks(r);
  const char *from = r->at;
  while (r->at < r->end && !sbfi_is_space(*r->at) && !strchr(",]}:[{\"", *r->at)) r->at++;
  return (sbfi_span){from, (size_t)(r->at - from)};
}

/* Skips any value. */
static sbf_status skip_value(reader *r) {
  int depth = 0;
  do {
    const char *text;
    skip_blanks(r);
    if (r->at == r->end) return fail(r, "a value");
    if (*r->at == '"') {
      sbf_status status = read_string(r, &text);
      if (status != SBF_OK) return status;
    } else if (strchr("[{", *r->at)) {
      depth++;
      r->at++;
    } else if (strchr("]}", *r->at)) {
      depth--;
      r->at++;
    } else if (strchr(",:", *r->at)) {
      r->at++;
    } else if (!read_word(r).length) {
      return fail(r, "a value");
    }
    if (depth < 0 || depth > DEEPEST) return fail(r, "a value with less nesting");
  } while (depth);
  return SBF_OK;
}

static sbf_status read_row(reader *r) {
  sbfi_span vertex = {0}, weight = {0};
  const char *bone = NULL, *key;
  uint32_t line = r->line;
  sbf_status status = take(r, '{') ? SBF_OK : fail(r, "an object with vertex, bone and weight");
  for (bool more = status == SBF_OK && !take(r, '}'); more && status == SBF_OK;) {
    status = read_string(r, &key);
    if (status == SBF_OK && !take(r, ':')) status = fail(r, "':'");
    if (status != SBF_OK) break;
    if (strcmp(key, "vertex") == 0)
      vertex = read_word(r);
    else if (strcmp(key, "weight") == 0)
      weight = read_word(r);
    else
      status = strcmp(key, "bone") == 0 ? read_string(r, &bone) : skip_value(r);
    more = status == SBF_OK && take(r, ',');
    if (status == SBF_OK && !more && !take(r, '}')) status = fail(r, "',' or '}'");
  }
  if (status != SBF_OK) return status;
  if (!bone) return sbfi_weights_rows_fail(r->to, line, "a row has no bone");
  return sbfi_weights_rows_add(r->to, line, vertex, bone, weight);
}

static sbf_status read_rows(reader *r) {
  if (!take(r, '[')) return fail(r, "a list of weights");
  if (take(r, ']')) return SBF_OK;
  sbf_status status;
  do status = read_row(r);
  while (status == SBF_OK && take(r, ','));
  return status != SBF_OK || take(r, ']') ? status : fail(r, "',' or ']'");
}

sbf_status sbfi_weights_rows_json(sbfi_weights_rows *to, sbfi_span text) {
  reader r = {to, text.at, text.at + text.length, 1};
  const char *key;
  skip_blanks(&r);
  if (r.at < r.end && *r.at == '[') return read_rows(&r);
  if (!take(&r, '{')) return fail(&r, "a list, or an object with \"weights\"");
  while (!take(&r, '}')) {
    sbf_status status = read_string(&r, &key);
    if (status == SBF_OK && !take(&r, ':')) status = fail(&r, "':'");
    if (status == SBF_OK && strcmp(key, "weights") == 0) return read_rows(&r);
    if (status == SBF_OK) status = skip_value(&r);
    if (status != SBF_OK) return status;
    take(&r, ',');
  }
  return sbfi_weights_rows_fail(to, 1, "the object has no \"weights\"");
}
