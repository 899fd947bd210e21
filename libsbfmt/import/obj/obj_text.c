/* Source: Wavefront, "Advanced Visualizer Manual", appendix B1 (object files), polygonal part. Beyond it: a
 * file may end its lines with CR, LF or both, and an index may name a line that comes later. */
#include "import/obj/obj_text.h"

#include <string.h>

#include "base/diagnostic.h"
#include "base/number.h"
#include "import/quote.h"

enum { MAX_CORNERS = 65535 }; /* of a face */

typedef struct forward_reference {
  uint32_t corner, line;
  uint32_t kind;
} forward_reference;

typedef struct reader {
  sbfi_obj_text *text;
  const char *at, *end;
  char line_end; /* '\n', or '\r' in a file that has no other */
  uint32_t line;
  int32_t material;
  bool in_points; /* the previous statement was v, or one that does not end a block */
  sbf_diagnostic *error;
} reader;

static const char *const kind_names[] = {"vertex", "texture coordinate", "normal"};
static const char *const kind_keywords[] = {"v", "vt", "vn"};

static sbf_status located(reader *r, sbf_status status, uint32_t line) {
  if (r->error) r->error->line = line;
  return status;
}

static sbf_status out_of_memory(reader *r) {
  return sbfi_diagnose(r->error, SBF_CODE_OUT_OF_MEMORY, "memory ran out while the OBJ file was read");
}

/* Indices are kept in 31 bits. */
static sbf_status too_many(reader *r) {
  return located(r,
      sbfi_diagnose(
          r->error, SBF_CODE_IO_TOO_LARGE, "the OBJ file has more than 2147483646 items of one kind"),
      r->line);
}

/* Like sbfi_array_push for one item, but does not zero it: these lists have millions of items. */
static void *push(sbfi_array *array) {
  if (array->count == array->capacity && !sbfi_array_reserve(array, array->count + 1)) return NULL;
  return (char *)array->at + array->count++ * array->item_size;
}

static bool is_blank(char c) {
  return c == ' ' || c == '\t' || c == '\r' || c == '\v' || c == '\f';
}

/* If a backslash at `at` continues the line, returns the beginning of the next line; else NULL. */
static const char *continuation(const reader *r, const char *at) {
  at++;
  if (at < r->end && *at == '\r' && r->line_end == '\n') at++;
  return at < r->end && *at == r->line_end ? at + 1 : NULL;
}

static void skip_blank(reader *r) {
  while (r->at < r->end && *r->at != r->line_end) {
    if (is_blank(*r->at)) {
      r->at++;
    } else if (*r->at == '\\') {
      const char *next = continuation(r, r->at);
      if (!next) return;
      r->at = next;
      r->line++;
    } else {
      return;
    }
  }
}

static bool at_statement_end(const reader *r) {
  return r->at == r->end || *r->at == r->line_end || *r->at == '#';
}

static bool at_word_end(const reader *r) {
  return r->at == r->end || *r->at == r->line_end || is_blank(*r->at) || *r->at == '\\';
}

/* Finds the end of a line. Comments are never continued, because paths in comments may end with a backslash.
 */
static const char *find_line_end(const reader *r) {
  if (r->at >= r->end) return r->end;
  const char *found = memchr(r->at, r->line_end, (size_t)(r->end - r->at));
  return found ? found : r->end;
}

static void skip_statement(reader *r) {
  while (r->at < r->end) {
    const char *stop = find_line_end(r), *last = stop;
    bool comment = memchr(r->at, '#', (size_t)(stop - r->at)) != NULL;
    while (last > r->at && last[-1] == '\r') last--;
    bool continued = !comment && last > r->at && last[-1] == '\\' && stop < r->end;
    r->at = continued ? stop + 1 : stop;
    if (!continued) return;
    r->line++;
  }
}

/* Reads a name: the rest of the line without blanks at its ends. Names may contain blanks. */
static sbfi_span read_name(reader *r) {
  while (r->at < r->end && *r->at != r->line_end && is_blank(*r->at)) r->at++;
  const char *stop = find_line_end(r), *last = stop;
  while (last > r->at && is_blank(last[-1])) last--;
  sbfi_span name = {r->at, (size_t)(last - r->at)};
  r->at = stop;
  return name;
}

static uint32_t word_length(const reader *r) {
  const char *at = r->at;
  while (at < r->end && *at != r->line_end && !is_blank(*at) && at - r->at < 40) at++;
  return (uint32_t)(at - r->at);
}

static bool is_not_finite_text(sbfi_span word) {
  for (size_t i = 0; i + 3 <= word.length; i++) {
    char a = (char)(word.at[i] | 0x20), b = (char)(word.at[i + 1] | 0x20), c = (char)(word.at[i + 2] | 0x20);
    if ((a == 'n' && b == 'a' && c == 'n') || (a == 'i' && b == 'n' && (c == 'f' || c == 'd'))) return true;
  }
  return false;
}

static sbf_status number_refused(reader *r, sbfi_number_status status, const char *keyword) {
  sbfi_span word = {r->at, word_length(r)};
  if (status == SBFI_NUMBER_OUT_OF_RANGE || is_not_finite_text(word))
    return located(r,
        sbfi_diagnose(r->error, SBF_CODE_IMPORT_NOT_FINITE,
            "\"%s\" in a line \"%s\" is not a finite number in single precision: export the file again",
            sbfi_quote_of(word).text, keyword),
        r->line);
  return located(r,
      sbfi_diagnose(r->error, SBF_CODE_IMPORT_SYNTAX, "found \"%s\" where a line \"%s\" needs a number%s",
          sbfi_quote_of(word).text, keyword,
          memchr(word.at, ',', word.length) ? ": use a decimal point, not a comma" : ""),
      r->line);
}

/* Reads up to `wanted` numbers, at least `needed`; missing ones are 0. */
static sbf_status read_numbers(
    reader *r, const char *keyword, float *values, uint32_t needed, uint32_t wanted) {
  for (uint32_t i = 0; i < wanted; i++) {
    size_t used;
    skip_blank(r);
    if (at_statement_end(r)) {
      if (i >= needed) break;
      return located(r,
          sbfi_diagnose(r->error, SBF_CODE_IMPORT_SYNTAX, "a line \"%s\" needs %u numbers, this one has %u",
              keyword, needed, i),
          r->line);
    }
    const char *word = r->at;
    sbfi_number_status status = sbfi_scan_f32(r->at, (size_t)(r->end - r->at), &values[i], &used);
    if (status == SBFI_NUMBER_READ) {
      r->at += used;
      if (at_word_end(r)) continue;
      r->at = word;
      status = SBFI_NUMBER_MALFORMED;
    }
    return number_refused(r, status, keyword);
  }
  return SBF_OK;
}

static sbf_status read_point(reader *r) {
  sbfi_obj_text *text = r->text;
  if (!r->in_points) {
    sbfi_obj_block *block = push(&text->blocks);
    if (!block) return out_of_memory(r);
    *block = (sbfi_obj_block){(uint32_t)text->points.count, (uint32_t)text->runs.count - 1};
    r->in_points = true;
  }
  float v[3];
  sbf_status status = read_numbers(r, "v", v, 3, 3);
  if (status) return status;
  if (text->points.count >= INT32_MAX - 1) return too_many(r);
  sbf_vec3 *point = push(&text->points);
  if (!point) return out_of_memory(r);
  *point = (sbf_vec3){v[0], v[1], v[2]};
  const char *after = r->at;
  uint32_t more = 0, line = r->line; /* one is a weight, three or more are a color */
  for (skip_blank(r); more < 3 && !at_statement_end(r); skip_blank(r), more++)
    while (r->at < r->end && *r->at != r->line_end && !is_blank(*r->at)) r->at++;
  if (more == 3 && text->colored_count++ == 0) text->colored_line = line;
  r->at = after;
  r->line = line;
  skip_statement(r);
  return SBF_OK;
}

static sbf_status read_uv(reader *r) {
  float v[2] = {0, 0};
  sbf_status status = read_numbers(r, "vt", v, 1, 2);
  if (status) return status;
  if (r->text->uvs.count >= INT32_MAX - 1) return too_many(r);
  sbf_vec2 *uv = push(&r->text->uvs);
  if (!uv) return out_of_memory(r);
  *uv = (sbf_vec2){v[0], v[1]};
  skip_statement(r); /* a depth */
  return SBF_OK;
}

static sbf_status read_normal(reader *r) {
  float v[3];
  sbf_status status = read_numbers(r, "vn", v, 3, 3);
  if (status) return status;
  if (r->text->normals.count >= INT32_MAX - 1) return too_many(r);
  sbf_vec3 *normal = push(&r->text->normals);
  if (!normal) return out_of_memory(r);
  *normal = (sbf_vec3){v[0], v[1], v[2]};
  skip_statement(r);
  return SBF_OK;
}

static size_t count_of(const sbfi_obj_text *text, uint32_t kind) {
  const sbfi_array *lists[] = {&text->points, &text->uvs, &text->normals};
  return lists[kind]->count;
}

static sbf_status index_refused(reader *r, uint32_t kind, int64_t value, uint32_t line) {
  const char *name = kind_names[kind];
  if (value == 0)
    return located(r,
        sbfi_diagnose(
            r->error, SBF_CODE_IMPORT_INDEX, "a face refers to %s 0, but they are counted from 1", name),
        line);
  return located(r,
      sbfi_diagnose(r->error, SBF_CODE_IMPORT_INDEX,
          "a face refers to %s %lld, but the file has %zu lines \"%s\"%s: the file is cut off or damaged",
          name, (long long)value, count_of(r->text, kind), kind_keywords[kind],
          value < 0 ? " before it" : ""),
      line);
}

/* One index: [+-]? digits. */
static sbf_status read_index(reader *r, uint32_t kind, int32_t *index) {
  const char *word = r->at;
  bool negative = *r->at == '-';
  if (*r->at == '-' || *r->at == '+') r->at++;
  int64_t value = 0;
  const char *first = r->at;
  while (r->at < r->end && *r->at >= '0' && *r->at <= '9') {
    value = value * 10 + (*r->at++ - '0');
    if (value > INT32_MAX) return index_refused(r, kind, negative ? -value : value, r->line);
  }
  if (r->at == first) {
    r->at = word;
    return located(r,
        sbfi_diagnose(r->error, SBF_CODE_IMPORT_SYNTAX, "found \"%s\" where a face needs an index",
            sbfi_quote_of((sbfi_span){word, word_length(r)}).text),
        r->line);
  }
  int64_t count = (int64_t)count_of(r->text, kind);
  if (value == 0 || (negative && value > count)) return index_refused(r, kind, -value, r->line);
  *index = (int32_t)(negative ? count - value : value - 1);
  if (*index >= count) {
    forward_reference *later = push(&r->text->forward);
    if (!later) return out_of_memory(r);
    *later = (forward_reference){(uint32_t)r->text->corners.count, r->line, kind};
  }
  return SBF_OK;
}

static bool at_index(const reader *r) {
  return r->at < r->end && ((*r->at >= '0' && *r->at <= '9') || *r->at == '-' || *r->at == '+');
}

/* p, p/t, p//n or p/t/n */
static sbf_status read_corner(reader *r) {
  sbfi_obj_corner corner = {{0, SBF_NONE, SBF_NONE}};
  const char *word = r->at;
  sbf_status status = read_index(r, SBFI_OBJ_POINT, &corner.index[SBFI_OBJ_POINT]);
  for (uint32_t kind = SBFI_OBJ_UV; kind < SBFI_OBJ_KINDS && !status; kind++) {
    if (r->at == r->end || *r->at != '/') break;
    r->at++;
    if (at_index(r)) status = read_index(r, kind, &corner.index[kind]);
  }
  if (status) return status;
  if (!at_word_end(r)) {
    r->at = word;
    return located(r,
        sbfi_diagnose(r->error, SBF_CODE_IMPORT_SYNTAX,
            "\"%s\" is not a corner of a face: it must look like 1, 1/2, 1//3 or 1/2/3",
            sbfi_quote_of((sbfi_span){word, word_length(r)}).text),
        r->line);
  }
  if (r->text->corners.count >= INT32_MAX - 1) return too_many(r);
  sbfi_obj_corner *position = push(&r->text->corners);
  if (!position) return out_of_memory(r);
  *position = corner;
  return SBF_OK;
}

static sbf_status read_face(reader *r) {
  sbfi_obj_text *text = r->text;
  uint32_t line = r->line, first = (uint32_t)text->corners.count;
  r->in_points = false;
  for (;;) {
    skip_blank(r);
    if (at_statement_end(r)) break;
    sbf_status status = read_corner(r);
    if (status) return status;
    if (text->corners.count - first > MAX_CORNERS)
      return located(r,
          sbfi_diagnose(r->error, SBF_CODE_IMPORT_POLYGON,
              "a face has more than %d corners: divide it, for example by triangulating the mesh",
              MAX_CORNERS),
          line);
  }
  if (text->corners.count - first < 3)
    return located(r,
        sbfi_diagnose(r->error, SBF_CODE_IMPORT_POLYGON,
            "a face needs three corners or more, this one has %zu", text->corners.count - first),
        line);
  sbfi_obj_polygon *polygon = push(&text->polygons);
  if (!polygon) return out_of_memory(r);
  *polygon = (sbfi_obj_polygon){first, r->material};
  return SBF_OK;
}

static sbf_status begin_run(reader *r, int32_t object, int32_t group) {
  sbfi_obj_run *run = push(&r->text->runs);
  if (!run) return out_of_memory(r);
  *run = (sbfi_obj_run){(uint32_t)r->text->polygons.count, object, group};
  r->in_points = false;
  return SBF_OK;
}

static sbf_status read_object(reader *r) {
  sbfi_obj_text *text = r->text;
  const sbfi_obj_run *runs = text->runs.at;
  int32_t group = runs[text->runs.count - 1].group;
  sbfi_span name = read_name(r);
  if (text->objects.count >= INT32_MAX - 1) return too_many(r);
  if (!sbfi_array_append(&text->objects, &name, 1)) return out_of_memory(r);
  return begin_run(r, (int32_t)text->objects.count - 1, group);
}

static sbf_status read_group(reader *r) {
  sbfi_obj_text *text = r->text;
  const sbfi_obj_run *runs = text->runs.at;
  int32_t object = runs[text->runs.count - 1].object;
  sbfi_span name = read_name(r);
  int64_t group = sbfi_name_table_add(&text->groups, name);
  return group < 0 ? out_of_memory(r) : begin_run(r, object, (int32_t)group);
}

static sbf_status read_material(reader *r) {
  sbfi_span name = read_name(r);
  int64_t material = sbfi_name_table_add(&r->text->materials, name);
  if (material < 0) return out_of_memory(r);
  r->material = (int32_t)material;
  return SBF_OK;
}

static sbf_status read_library(reader *r) {
  sbfi_span name = read_name(r);
  return sbfi_array_append(&r->text->libraries, &name, 1) ? SBF_OK : out_of_memory(r);
}

/* Statements without effect on the polygon mesh. Smoothing groups are already in the normals. */
static bool is_silent(sbfi_span word) {
  static const char *const silent[] = {
      "s", "vp", "mg", "lod", "bevel", "c_interp", "d_interp", "usemap", "maplib", "shadow_obj", "trace_obj"};
  for (size_t i = 0; i < sizeof silent / sizeof *silent; i++)
    if (sbfi_span_is(word, silent[i])) return true;
  return false;
}

static sbf_status read_other(reader *r, sbfi_span word) {
  if (!is_silent(word) && r->text->ignored_count++ == 0) {
    r->text->ignored_line = r->line;
    r->text->ignored_keyword = word;
  }
  skip_statement(r);
  return SBF_OK;
}

static sbf_status read_statement(reader *r) {
  sbfi_span word = {r->at, word_length(r)};
  r->at += word.length;
  if (word.length == 1) {
    if (*word.at == 'v') return read_point(r);
    if (*word.at == 'f') return read_face(r);
    if (*word.at == 'g') return read_group(r);
    if (*word.at == 'o') return read_object(r);
  }
  if (sbfi_span_is(word, "vt")) return read_uv(r);
  if (sbfi_span_is(word, "vn")) return read_normal(r);
  if (sbfi_span_is(word, "fo")) return read_face(r);
  if (sbfi_span_is(word, "usemtl")) return read_material(r);
  if (sbfi_span_is(word, "mtllib")) return read_library(r);
  return read_other(r, word);
}

static sbf_status check_forward(reader *r) {
  const forward_reference *later = r->text->forward.at;
  const sbfi_obj_corner *corners = r->text->corners.at;
  for (size_t i = 0; i < r->text->forward.count; i++) {
    int64_t index = corners[later[i].corner].index[later[i].kind];
    if (index >= (int64_t)count_of(r->text, later[i].kind))
      return index_refused(r, later[i].kind, index + 1, later[i].line);
  }
  sbfi_array_free(&r->text->forward);
  return SBF_OK;
}

static sbf_status nul_refused(reader *r, const char *bytes, const char *nul) {
  uint32_t line = 1;
  for (const char *at = bytes; at < nul; at++) line += *at == r->line_end;
  return located(r,
      sbfi_diagnose(r->error, SBF_CODE_IMPORT_SYNTAX,
          "byte %zu of the file is 0, which an OBJ text never contains: the file is damaged or has another "
          "format",
          (size_t)(nul - bytes)),
      line);
}

static sbf_status read_text(reader *r, const char *bytes, size_t size) {
  if (size >= 3 && memcmp(bytes, "\xEF\xBB\xBF", 3) == 0) r->at += 3;
  if (size >= 2 && (memcmp(bytes, "\xFF\xFE", 2) == 0 || memcmp(bytes, "\xFE\xFF", 2) == 0))
    return sbfi_diagnose(r->error, SBF_CODE_IMPORT_SYNTAX, "the OBJ file is UTF-16 text: save it as UTF-8");
  if (size && !memchr(bytes, '\n', size)) r->line_end = '\r';
  const char *nul = size ? memchr(bytes, 0, size) : NULL;
  if (nul) return nul_refused(r, bytes, nul);
  sbf_status status = begin_run(r, SBF_NONE, SBF_NONE);
  while (!status && r->at < r->end) {
    skip_blank(r);
    if (r->at < r->end && *r->at == '#') r->at = find_line_end(r);
    if (!at_statement_end(r)) {
      status = read_statement(r);
      if (status) break;
      skip_blank(r);
      if (r->at < r->end && *r->at == '#') r->at = find_line_end(r);
    }
    if (r->at < r->end && *r->at == r->line_end) {
      r->at++;
      r->line++;
    }
  }
  return status ? status : check_forward(r);
}

sbf_status sbfi_obj_text_read(sbfi_obj_text *text, const char *bytes, size_t size,
    const sbf_allocator *allocator, sbf_diagnostic *error) {
  *text = (sbfi_obj_text){0};
  sbfi_array_init(&text->points, allocator, sizeof(sbf_vec3));
  sbfi_array_init(&text->uvs, allocator, sizeof(sbf_vec2));
  sbfi_array_init(&text->normals, allocator, sizeof(sbf_vec3));
  sbfi_array_init(&text->corners, allocator, sizeof(sbfi_obj_corner));
  sbfi_array_init(&text->polygons, allocator, sizeof(sbfi_obj_polygon));
  sbfi_array_init(&text->runs, allocator, sizeof(sbfi_obj_run));
  sbfi_array_init(&text->blocks, allocator, sizeof(sbfi_obj_block));
  sbfi_array_init(&text->objects, allocator, sizeof(sbfi_span));
  sbfi_array_init(&text->libraries, allocator, sizeof(sbfi_span));
  sbfi_array_init(&text->forward, allocator, sizeof(forward_reference));
  sbfi_name_table_init(&text->groups, allocator);
  sbfi_name_table_init(&text->materials, allocator);
  if (size == 0) bytes = "";
  reader r = {.text = text,
      .at = bytes,
      .end = bytes + size,
      .line_end = '\n',
      .line = 1,
      .material = SBF_NONE,
      .error = error};
  sbf_status status = read_text(&r, bytes, size);
  if (status) sbfi_obj_text_free(text);
  return status;
}

void sbfi_obj_text_free(sbfi_obj_text *text) {
  sbfi_array *arrays[] = {&text->points, &text->uvs, &text->normals, &text->corners, &text->polygons,
      &text->runs, &text->blocks, &text->objects, &text->libraries, &text->forward};
  for (size_t i = 0; i < sizeof arrays / sizeof *arrays; i++) sbfi_array_free(arrays[i]);
  sbfi_name_table_free(&text->groups);
  sbfi_name_table_free(&text->materials);
}
