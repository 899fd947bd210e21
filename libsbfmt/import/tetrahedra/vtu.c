/* Reads VTK XML files of unstructured grids (.vtu): points and cells of type 10 of all pieces. Numbers are
 * text, base64, or appended after the document; uncompressed or with zlib. */
#include <string.h>

#include "base/number.h"
#include "import/tetrahedra/tet_mesh.h"
#include "import/tetrahedra/vtu_data.h"
#include "xml/xml_events.h"

enum { VTU_TETRAHEDRON = 10 };
enum { POINTS, CONNECTIVITY, OFFSETS, TYPES, ARRAYS };
typedef enum location { OUTSIDE, IN_FILE, IN_GRID, IN_PIECE, IN_POINTS, IN_CELLS, IN_ARRAY } location;

typedef struct vtu {
  sbfi_word_reader *r;
  sbfi_tet_mesh *mesh;
  sbfi_xml_events events;
  location at, array_in;
  uint32_t passed_over; /* depth below a skipped element */
  sbfi_vtu_coding coding;
  sbfi_vtu_array arrays[ARRAYS], *open;
  uint32_t point_count, cell_count; /* of the current piece */
} vtu;

static bool fail(vtu *v, sbf_code code, const char *message) {
  v->r->line = v->events.line;
  return sbfi_word_fail(v->r, code, "%s", message);
}

static sbfi_span attribute(const sbfi_xml_attribute *attributes, uint32_t count, const char *name) {
  for (uint32_t i = 0; i < count; i++)
    if (strcmp(attributes[i].name, name) == 0) return (sbfi_span){attributes[i].value, attributes[i].length};
  return (sbfi_span){NULL, 0};
}

static bool whole_number(vtu *v, sbfi_span text, uint32_t *value) {
  if (sbfi_parse_u32(text.at ? text.at : "", text.length, value) == SBFI_NUMBER_READ && *value <= INT32_MAX)
    return true;
  return fail(v, SBF_CODE_IMPORT_SYNTAX, "an attribute with a count or an offset is not a valid number");
}

/* --- One piece ---------------------------------------------------------------------------------------- */

static bool read_points(vtu *v) {
  sbfi_array numbers;
  sbfi_array_init(&numbers, &v->mesh->allocator, sizeof(float));
  bool good = sbfi_vtu_floats(v->r, &v->coding, &v->arrays[POINTS], &numbers);
  if (good && numbers.count != 3 * (size_t)v->point_count)
    good = sbfi_word_fail(v->r, SBF_CODE_IMPORT_SYNTAX,
        "the piece states %u points but lists %zu numbers instead of three each", v->point_count,
        numbers.count);
  sbf_vec3 *points = good ? sbfi_word_push(v->r, &v->mesh->points, v->point_count) : NULL;
  if (points) memcpy(points, numbers.at, numbers.count * sizeof(float));
  sbfi_array_free(&numbers);
  return points != NULL;
}

typedef struct cell_lists {
  sbfi_array lists[ARRAYS]; /* uint32_t; that of POINTS stays empty */
} cell_lists;

static bool read_cells(vtu *v, cell_lists *cells, uint32_t first_point) {
  for (int i = CONNECTIVITY; i < ARRAYS; i++) {
    if (!sbfi_vtu_indices(v->r, &v->coding, &v->arrays[i], &cells->lists[i])) return false;
    if (i != CONNECTIVITY && cells->lists[i].count != v->cell_count)
      return sbfi_word_fail(v->r, SBF_CODE_IMPORT_SYNTAX,
          "the piece states %u cells but lists %zu offsets or types", v->cell_count, cells->lists[i].count);
  }
  const uint32_t *points = cells->lists[CONNECTIVITY].at, *ends = cells->lists[OFFSETS].at;
  const uint32_t *types = cells->lists[TYPES].at;
  for (uint32_t i = 0, begin = 0; i < v->cell_count; begin = ends[i++]) {
    if (ends[i] < begin || ends[i] > cells->lists[CONNECTIVITY].count)
      return sbfi_word_fail(
          v->r, SBF_CODE_IMPORT_INDEX, "the offset of cell %u is out of order or beyond the list", i);
    if (types[i] != VTU_TETRAHEDRON || ends[i] - begin != 4) {
      v->mesh->passed_over++;
      continue;
    }
    sbf_uint4 *tetrahedron = sbfi_word_push(v->r, &v->mesh->tetrahedra, 1);
    if (!tetrahedron) return false;
    for (int k = 0; k < 4; k++) {
      uint32_t point = points[begin + (uint32_t)k];
      if (point >= v->point_count)
        return sbfi_word_fail(v->r, SBF_CODE_IMPORT_INDEX,
            "cell %u names point %u, but the piece has %u points", i, point, v->point_count);
      tetrahedron->at[k] = point + first_point;
    }
  }
  return true;
}

static void clear_arrays(vtu *v) {
  for (int i = 0; i < ARRAYS; i++) {
    sbfi_text_free(&v->arrays[i].text);
    v->arrays[i].given = false;
  }
}

static bool read_piece(vtu *v) {
  static const char *const missing[ARRAYS] = {"the piece has no points",
      "the cells have no array 'connectivity'", "the cells have no array 'offsets'",
      "the cells have no array 'types'"};
  if (v->point_count == 0 && v->cell_count == 0) return true;
  for (int i = 0; i < ARRAYS; i++)
    if (!v->arrays[i].given) return fail(v, SBF_CODE_IMPORT_SYNTAX, missing[i]);
  if (v->point_count == 0) return fail(v, SBF_CODE_IMPORT_SYNTAX, missing[POINTS]);
  if (v->mesh->points.count + v->point_count > INT32_MAX)
    return fail(v, SBF_CODE_IO_TOO_LARGE, "the pieces have too many points");
  uint32_t first_point = (uint32_t)v->mesh->points.count;
  cell_lists cells;
  for (int i = 0; i < ARRAYS; i++) sbfi_array_init(&cells.lists[i], &v->mesh->allocator, sizeof(uint32_t));
  bool good = read_points(v) && read_cells(v, &cells, first_point);
  for (int i = 0; i < ARRAYS; i++) sbfi_array_free(&cells.lists[i]);
  return good;
}

/* --- The document ------------------------------------------------------------------------------------- */

static bool start_file(vtu *v, const char *name, const sbfi_xml_attribute *attributes, uint32_t count) {
  uint16_t probe = 1;
  sbfi_span compressor = attribute(attributes, count, "compressor");
  if (strcmp(name, "VTKFile") != 0 || !sbfi_span_is(attribute(attributes, count, "type"), "UnstructuredGrid"))
    return fail(v, SBF_CODE_IMPORT_REFUSED,
        "only a VTKFile of type UnstructuredGrid can have tetrahedra: save the grid itself, not a file that "
        "refers to it");
  if (compressor.length && !sbfi_span_is(compressor, "vtkZLibDataCompressor"))
    return fail(
        v, SBF_CODE_IMPORT_REFUSED, "the file is not compressed by zlib: save it with zlib, or uncompressed");
  bool big = sbfi_span_is(attribute(attributes, count, "byte_order"), "BigEndian");
  v->coding.swap_bytes = big == (*(unsigned char *)&probe == 1);
  v->coding.wide_header = sbfi_span_is(attribute(attributes, count, "header_type"), "UInt64");
  v->coding.compressed = compressor.length > 0;
  v->at = IN_FILE;
  return true;
}

static bool start_array(vtu *v, const sbfi_xml_attribute *attributes, uint32_t count) {
  static const char *const names[ARRAYS] = {"", "connectivity", "offsets", "types"};
  sbfi_span name = attribute(attributes, count, "Name"), format = attribute(attributes, count, "format");
  int which = v->at == IN_POINTS ? POINTS : CONNECTIVITY;
  while (which != POINTS && which < ARRAYS && !sbfi_span_is(name, names[which])) which++;
  if (which == ARRAYS || v->arrays[which].given) {
    v->passed_over = 1;
    return true;
  }
  sbfi_vtu_array *a = v->open = &v->arrays[which];
  a->given = true;
  a->line = v->events.line;
  a->type = sbfi_vtu_type_of(attribute(attributes, count, "type"));
  a->format = sbfi_span_is(format, "appended") ? SBFI_VTU_APPENDED
              : sbfi_span_is(format, "binary") ? SBFI_VTU_INLINE
                                               : SBFI_VTU_ASCII;
  sbfi_text_init(&a->text, &v->mesh->allocator);
  v->array_in = v->at;
  v->at = IN_ARRAY;
  if (a->type == SBFI_VTU_TYPES) return fail(v, SBF_CODE_IMPORT_SYNTAX, "an array has an unknown type");
  uint32_t offset = 0;
  if (a->format != SBFI_VTU_APPENDED) return true;
  if (!whole_number(v, attribute(attributes, count, "offset"), &offset)) return false;
  a->offset = offset;
  return true;
}

static bool start_piece(vtu *v, const sbfi_xml_attribute *attributes, uint32_t count) {
  v->at = IN_PIECE;
  return whole_number(v, attribute(attributes, count, "NumberOfPoints"), &v->point_count) &&
         whole_number(v, attribute(attributes, count, "NumberOfCells"), &v->cell_count);
}

static bool on_start(void *user, const char *name, const sbfi_xml_attribute *attributes, uint32_t count) {
  vtu *v = user;
  if (v->passed_over || v->at == IN_ARRAY) {
    v->passed_over++;
    return true;
  }
  if (v->at == OUTSIDE) return start_file(v, name, attributes, count);
  if (v->at == IN_GRID && strcmp(name, "Piece") == 0) return start_piece(v, attributes, count);
  if ((v->at == IN_POINTS || v->at == IN_CELLS) && strcmp(name, "DataArray") == 0)
    return start_array(v, attributes, count);
  if (v->at == IN_FILE && strcmp(name, "UnstructuredGrid") == 0)
    v->at = IN_GRID;
  else if (v->at == IN_PIECE && strcmp(name, "Points") == 0)
    v->at = IN_POINTS;
  else if (v->at == IN_PIECE && strcmp(name, "Cells") == 0)
    v->at = IN_CELLS;
  else
    v->passed_over = 1;
  return true;
}

static bool on_text(void *user, const char *text, size_t length) {
  vtu *v = user;
  if (v->at != IN_ARRAY || v->passed_over || v->open->format == SBFI_VTU_APPENDED) return true;
  return sbfi_text_append(&v->open->text, text, length) ||
         fail(v, SBF_CODE_OUT_OF_MEMORY, "memory ran out for an array's text");
}

static bool on_end(void *user) {
  vtu *v = user;
  if (v->passed_over) {
    v->passed_over--;
    return true;
  }
  bool good = v->at != IN_PIECE || read_piece(v);
  if (v->at == IN_PIECE) clear_arrays(v);
  v->at = v->at == IN_ARRAY                         ? v->array_in
          : v->at == IN_POINTS || v->at == IN_CELLS ? IN_PIECE
                                                    : (location)(v->at - 1);
  return good;
}

/* --- Appended data ------------------------------------------------------------------------------------ */

static const char *find(sbfi_span in, const char *what) {
  size_t length = strlen(what);
  for (const char *at = in.at, *end = in.at + in.length; (size_t)(end - at) >= length; at++) {
    at = memchr(at, what[0], (size_t)(end - at) - length + 1);
    if (!at) return NULL;
    if (memcmp(at, what, length) == 0) return at;
  }
  return NULL;
}

/* Raw bytes are invalid XML: cuts the document before them and appends the closing tags. Fills `document`
 * if there are any. */
static bool cut_appended(vtu *v, sbfi_text *document) {
  sbfi_span all = {v->r->at, (size_t)(v->r->end - v->r->at)};
  const char *tag = find(all, "<AppendedData");
  if (!tag) return true;
  const char *end = memchr(tag, '>', (size_t)(v->r->end - tag));
  if (!end) return true; /* truncated XML, which the parser reports */
  sbfi_span attributes = {tag, (size_t)(end - tag)}, data = {end + 1, (size_t)(v->r->end - end - 1)};
  const char *underscore = memchr(data.at, '_', data.length);
  if (!underscore)
    return fail(v, SBF_CODE_IMPORT_SYNTAX, "the appended data do not begin with an underscore");
  v->coding.appended_text = find(attributes, "base64") != NULL;
  v->coding.appended = (sbfi_span){underscore + 1, (size_t)(v->r->end - underscore - 1)};
  if (v->coding.appended_text) {
    const char *stop = memchr(v->coding.appended.at, '<', v->coding.appended.length);
    if (stop) v->coding.appended.length = (size_t)(stop - v->coding.appended.at);
  } else if (!find(attributes, "raw")) {
    return fail(v, SBF_CODE_IMPORT_REFUSED, "the appended data have an unknown encoding");
  }
  return (sbfi_text_append(document, all.at, (size_t)(end + 1 - all.at)) &&
             sbfi_text_string(document, "</AppendedData></VTKFile>")) ||
         fail(v, SBF_CODE_OUT_OF_MEMORY, "memory ran out for the document");
}

static void parse(vtu *v) {
  sbfi_text document;
  sbfi_text_init(&document, &v->mesh->allocator);
  if (cut_appended(v, &document)) {
    sbfi_xml_source source = {.bytes = v->r->at, .size = (uint64_t)(v->r->end - v->r->at)};
    if (document.length) source = (sbfi_xml_source){.bytes = document.at, .size = document.length};
    sbf_diagnostic error = {.code = 0};
    sbf_status status = sbfi_xml_parse(&source, &v->events, &v->mesh->allocator, &error);
    if (status != SBF_OK && v->r->status == SBF_OK) {
      v->r->status = status;
      if (v->r->error) {
        *v->r->error = error;
        sbfi_copy_text(v->r->error->file, sizeof v->r->error->file, v->r->file);
      }
    }
  }
  sbfi_text_free(&document);
}

bool sbfi_read_vtu(sbfi_word_reader *r, sbfi_tet_mesh *mesh) {
  vtu v = {.r = r, .mesh = mesh, .events = {on_start, on_text, on_end, NULL, 0}};
  mesh->format = "vtu";
  v.events.user = &v;
  for (int i = 0; i < ARRAYS; i++) sbfi_text_init(&v.arrays[i].text, &mesh->allocator);
  sbfi_packed_coder_init(&v.coding.coder, &mesh->allocator, 6);
  parse(&v);
  clear_arrays(&v);
  sbfi_packed_coder_free(&v.coding.coder);
  return r->status == SBF_OK;
}
