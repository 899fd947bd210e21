/* Reads legacy VTK files, text or binary (big-endian): points of an unstructured grid and cells of type
 * 10. */
#include <string.h>

#include "import/tetrahedra/tet_mesh.h"

enum { VTK_TETRAHEDRON = 10 };

typedef struct vtk {
  sbfi_word_reader *r;
  sbfi_tet_mesh *mesh;
  bool binary;
  sbfi_array cells; /* uint32_t: size, then points, for each cell */
  sbfi_array types; /* uint32_t */
} vtk;

static bool read_u32(vtk *v, uint32_t *value, const char *what) {
  return v->binary ? sbfi_binary_u32(v->r, value, what) : sbfi_word_u32(v->r, value, what);
}

static bool read_coordinate(vtk *v, bool is_double, float *value) {
  if (!v->binary) return sbfi_word_f32(v->r, value, "a point");
  if (!is_double) return sbfi_binary_f32(v->r, value, "a point");
  double wide;
  if (!sbfi_binary_f64(v->r, &wide, "a point")) return false;
  *value = (float)wide;
  return true;
}

/* Binary numbers begin after the end of the line. */
static bool end_line(vtk *v) {
  sbfi_span rest;
  if (v->binary) sbfi_word_line(v->r, &rest);
  return true;
}

static bool read_points(vtk *v) {
  uint32_t count;
  sbfi_span type;
  if (!sbfi_word_count(v->r, &count, 6, "the points") || !sbfi_word_next(v->r, &type)) return false;
  bool is_double = sbfi_span_is(type, "double");
  if (!is_double && !sbfi_span_is(type, "float"))
    return sbfi_word_fail(v->r, SBF_CODE_IMPORT_SYNTAX, "points must be float or double");
  end_line(v);
  sbf_vec3 *points = sbfi_word_push(v->r, &v->mesh->points, count);
  for (uint32_t i = 0; points && i < count; i++)
    if (!read_coordinate(v, is_double, &points[i].x) || !read_coordinate(v, is_double, &points[i].y) ||
        !read_coordinate(v, is_double, &points[i].z))
      return false;
  return points != NULL;
}

static bool read_cells(vtk *v) {
  uint32_t count, size;
  if (!sbfi_word_count(v->r, &count, 4, "the cells") || !sbfi_word_count(v->r, &size, 2, "the cells' size"))
    return false;
  end_line(v);
  uint32_t *cells = sbfi_word_push(v->r, &v->cells, size);
  for (uint32_t i = 0; cells && i < size; i++)
    if (!read_u32(v, &cells[i], "a cell")) return false;
  return cells != NULL;
}

static bool read_types(vtk *v) {
  uint32_t count;
  if (!sbfi_word_count(v->r, &count, 2, "the cells' types")) return false;
  end_line(v);
  uint32_t *types = sbfi_word_push(v->r, &v->types, count);
  for (uint32_t i = 0; types && i < count; i++)
    if (!read_u32(v, &types[i], "a cell's type")) return false;
  return types != NULL;
}

static bool read_tetrahedra(vtk *v) {
  const uint32_t *cells = v->cells.at, *types = v->types.at;
  for (size_t i = 0, at = 0; i < v->types.count; i++) {
    if (at >= v->cells.count || cells[at] >= v->cells.count - at)
      return sbfi_word_fail(v->r, SBF_CODE_IMPORT_SYNTAX, "cell %zu reaches beyond the list of cells", i);
    if (types[i] == VTK_TETRAHEDRON && cells[at] == 4) {
      sbf_uint4 *tetrahedron = sbfi_word_push(v->r, &v->mesh->tetrahedra, 1);
      if (!tetrahedron) return false;
      memcpy(tetrahedron->at, cells + at + 1, sizeof tetrahedron->at);
    } else {
      v->mesh->passed_over++;
    }
    at += cells[at] + 1;
  }
  return true;
}

static bool read_sections(vtk *v) {
  sbfi_span word;
  while (sbfi_word_next(v->r, &word)) {
    if (sbfi_span_is(word, "DATASET")) {
      if (!sbfi_word_next(v->r, &word) || !sbfi_span_is(word, "UNSTRUCTURED_GRID"))
        return sbfi_word_fail(v->r, SBF_CODE_IMPORT_REFUSED, "only an unstructured grid can have tetrahedra");
    } else if (sbfi_span_is(word, "POINTS")) {
      if (!read_points(v)) return false;
    } else if (sbfi_span_is(word, "CELLS")) {
      if (!read_cells(v)) return false;
    } else if (sbfi_span_is(word, "CELL_TYPES")) {
      if (!read_types(v)) return false;
    } else if (sbfi_span_is(word, "POINT_DATA") || sbfi_span_is(word, "CELL_DATA")) {
      break; /* the rest is data of these points and cells */
    }
  }
  return v->r->status == SBF_OK && read_tetrahedra(v);
}

bool sbfi_read_vtk(sbfi_word_reader *r, sbfi_tet_mesh *mesh) {
  sbfi_span line;
  uint16_t probe = 1;
  vtk v = {.r = r, .mesh = mesh};
  mesh->format = "vtk";
  if (!sbfi_word_line(r, &line) || !sbfi_span_begins(line, "# vtk DataFile"))
    return sbfi_word_fail(r, SBF_CODE_IMPORT_REFUSED, "the file does not begin as a legacy VTK file does");
  sbfi_word_line(r, &line); /* title */
  if (!sbfi_word_line(r, &line))
    return sbfi_word_fail(r, SBF_CODE_IMPORT_SYNTAX, "the file ends within its header");
  v.binary = sbfi_span_is(line, "BINARY");
  r->swap_bytes = *(unsigned char *)&probe == 1; /* the file is big-endian */
  sbfi_array_init(&v.cells, &mesh->allocator, sizeof(uint32_t));
  sbfi_array_init(&v.types, &mesh->allocator, sizeof(uint32_t));
  bool good = read_sections(&v);
  sbfi_array_free(&v.cells);
  sbfi_array_free(&v.types);
  return good;
}
