#include <stdio.h>
#include <string.h>

#include "base/number.h"
#include "import/quote.h"
#include "import/rigging/weights_rows.h"

sbf_status sbfi_weights_rows_fail(sbfi_weights_rows *of, uint32_t line, const char *format, ...) {
  char why[256];
  va_list arguments;
  va_start(arguments, format);
  vsnprintf(why, sizeof why, format, arguments);
  va_end(arguments);
  sbf_status status = sbfi_diagnose(of->error, SBF_CODE_RIG_WEIGHTS_FILE, "%s", why);
  if (of->error) of->error->line = line;
  return status;
}

static sbf_status no_memory(const sbfi_weights_rows *of) {
  return sbfi_diagnose(of->error, SBF_CODE_OUT_OF_MEMORY, "memory ran out while weights were read");
}

sbf_status sbfi_weights_rows_add(
    sbfi_weights_rows *to, uint32_t line, sbfi_span vertex, const char *bone, sbfi_span weight) {
  sbfi_weights_row row = {.line = line, .bone = bone};
  if (sbfi_parse_u32(vertex.at, vertex.length, &row.vertex) != SBFI_NUMBER_READ)
    return sbfi_weights_rows_fail(
        to, line, "'%s' is not a vertex number: vertices are counted from 0", sbfi_quote_of(vertex).text);
  if (sbfi_parse_f32(weight.at, weight.length, &row.weight) != SBFI_NUMBER_READ || row.weight < 0 ||
      row.weight > 1)
    return sbfi_weights_rows_fail(
        to, line, "'%s' is not a weight: use a number from 0 to 1", sbfi_quote_of(weight).text);
  return sbfi_array_append(&to->rows, &row, 1) ? SBF_OK : no_memory(to);
}

enum { COLUMN_VERTEX, COLUMN_BONE, COLUMN_WEIGHT, COLUMNS };
static const char *const COLUMN_NAMES[COLUMNS] = {"vertex", "bone", "weight"};

/* Reads the next field of a line; sets `*quoted` if it contains doubled quotes. False at the end. */
static bool next_field(sbfi_span *rest, bool *first, sbfi_span *field, bool *quoted) {
  if (!*first) {
    if (!rest->length || rest->at[0] != ',') return false;
    rest->at++;
    rest->length--;
  }
  *first = false;
  *quoted = rest->length && rest->at[0] == '"';
  size_t end = *quoted ? 1 : 0;
  for (; end < rest->length; end++) {
    if (!*quoted && rest->at[end] == ',') break;
    if (!*quoted || rest->at[end] != '"') continue;
    if (end + 1 < rest->length && rest->at[end + 1] == '"')
      end++;
    else
      break;
  }
  *field = *quoted ? (sbfi_span){rest->at + 1, end - 1} : sbfi_span_trim((sbfi_span){rest->at, end});
  size_t used = *quoted && end < rest->length ? end + 1 : end;
  *rest = (sbfi_span){rest->at + used, rest->length - used};
  return true;
}

static char *field_text(sbfi_arena *arena, sbfi_span field, bool quoted) {
  char *text = sbfi_arena_string(arena, field.at, field.length);
  size_t to = 0;
  for (size_t i = 0; text && i < field.length; i++) {
    text[to++] = text[i];
    if (quoted && text[i] == '"') i++;
  }
  if (text) text[to] = 0;
  return text;
}

static sbf_status read_header(sbfi_weights_rows *to, sbfi_span line, int indices[COLUMNS]) {
  bool first = true, quoted;
  sbfi_span field;
  if (sbfi_span_begins(line, "\xef\xbb\xbf")) line = (sbfi_span){line.at + 3, line.length - 3};
  for (int k = 0; k < COLUMNS; k++) indices[k] = -1;
  for (int at = 0; next_field(&line, &first, &field, &quoted); at++)
    for (int k = 0; k < COLUMNS; k++)
      if (sbfi_span_is(field, COLUMN_NAMES[k])) indices[k] = at;
  for (int k = 0; k < COLUMNS; k++)
    if (indices[k] < 0)
      return sbfi_weights_rows_fail(to, 1,
          "there is no column '%s': the first line must name vertex, bone and weight, "
          "separated by commas",
          COLUMN_NAMES[k]);
  return SBF_OK;
}

sbf_status sbfi_weights_rows_csv(sbfi_weights_rows *to, sbfi_span text) {
  int indices[COLUMNS];
  sbfi_span line;
  sbf_status status = sbfi_span_next_line(&text, &line) ? read_header(to, line, indices)
                                                        : sbfi_weights_rows_fail(to, 1, "the file is empty");
  for (uint32_t number = 2; status == SBF_OK && sbfi_span_next_line(&text, &line); number++) {
    sbfi_span fields[COLUMNS] = {{0}}, field;
    bool first = true, quoted, is_bone_quoted = false;
    if (!sbfi_span_trim(line).length) continue;
    for (int at = 0; next_field(&line, &first, &field, &quoted); at++)
      for (int k = 0; k < COLUMNS; k++) {
        if (indices[k] != at) continue;
        fields[k] = field;
        if (k == COLUMN_BONE) is_bone_quoted = quoted;
      }
    const char *bone = field_text(to->arena, fields[COLUMN_BONE], is_bone_quoted);
    status = bone ? sbfi_weights_rows_add(to, number, fields[COLUMN_VERTEX], bone, fields[COLUMN_WEIGHT])
                  : no_memory(to);
  }
  return status;
}
