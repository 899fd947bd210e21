/* Results for ParaView: VTK's XML unstructured grids (VTK User's Guide, "VTK File Formats"), one per
 * frame, and a collection that lists them. Arrays are base64 after their size in bytes as 64 bits, both
 * little-endian. */
#include <stdio.h>
#include <string.h>

#include "base/base64.h"
#include "base/file.h"
#include "base/text.h"
#include "sbfmt/export.h"

enum { PATH_BYTES = 1024, FRAME_BYTES = PATH_BYTES + 32, VTK_VERTEX = 1, VTK_LINE = 3, VTK_TETRAHEDRON = 10 };
static const char part[] = ".part", ending[] = ".pvd";

struct sbf_result_series {
  sbf_allocator allocator;
  const sbf_result_mesh *mesh;
  char path[PATH_BYTES];
  size_t stem;          /* length of the path without its extension */
  sbfi_text collection; /* entries of the frames so far */
  sbfi_text frame;      /* the current frame */
  sbfi_text bytes;      /* its current array */
  uint32_t written;
};

static void frame_path(const sbf_result_series *s, uint32_t frame, const char *behind, char to[FRAME_BYTES]) {
  snprintf(to, FRAME_BYTES, "%.*s_%05u.vtu%s", (int)s->stem, s->path, frame, behind);
}

/* ---- Arrays ---- */

static void put_little(sbfi_text *bytes, uint64_t value, uint32_t size) {
  for (uint32_t i = 0; i < size; i++) sbfi_text_char(bytes, (char)(uint8_t)(value >> (8 * i)));
}

static void begin_array(
    sbf_result_series *s, const char *type, const char *name, uint32_t width, uint64_t byte_count) {
  static const char *const tensor[6] = {"XX", "YY", "ZZ", "XY", "YZ", "XZ"};
  char head[200];
  snprintf(
      head, sizeof head, "<DataArray type=\"%s\" Name=\"%s\" NumberOfComponents=\"%u\"", type, name, width);
  sbfi_text_string(&s->frame, head);
  for (uint32_t k = 0; width == 6 && k < 6; k++) {
    snprintf(head, sizeof head, " ComponentName%u=\"%s\"", k, tensor[k]);
    sbfi_text_string(&s->frame, head);
  }
  sbfi_text_string(&s->frame, " format=\"binary\">\n");
  sbfi_text_clear(&s->bytes);
  put_little(&s->bytes, byte_count, 8);
}

static void end_array(sbf_result_series *s) {
  if (s->bytes.failed || !sbfi_base64_encode(&s->frame, (const uint8_t *)s->bytes.at, s->bytes.length))
    s->frame.failed = true;
  sbfi_text_string(&s->frame, "\n</DataArray>\n");
}

static void put_f32(sbf_result_series *s, const sbf_result_array *array, uint32_t count) {
  size_t total = (size_t)count * array->width;
  begin_array(s, "Float32", array->name, array->width, 4 * total);
  for (size_t i = 0; i < total; i++) {
    uint32_t bits;
    memcpy(&bits, &array->values[i], sizeof bits);
    put_little(&s->bytes, bits, 4);
  }
  end_array(s);
}

static void put_arrays(sbf_result_series *s, const char *element, const sbf_result_array *arrays,
    uint32_t array_count, uint32_t count) {
  sbfi_text_char(&s->frame, '<');
  sbfi_text_string(&s->frame, element);
  sbfi_text_string(&s->frame, ">\n");
  for (uint32_t i = 0; i < array_count; i++) put_f32(s, &arrays[i], count);
  sbfi_text_string(&s->frame, "</");
  sbfi_text_string(&s->frame, element);
  sbfi_text_string(&s->frame, ">\n");
}

static void put_points(sbf_result_series *s, const double *points) {
  size_t total = 3 * (size_t)s->mesh->point_count;
  sbfi_text_string(&s->frame, "<Points>\n");
  begin_array(s, "Float64", "points", 3, 8 * total);
  for (size_t i = 0; i < total; i++) {
    uint64_t bits;
    memcpy(&bits, &points[i], sizeof bits);
    put_little(&s->bytes, bits, 8);
  }
  end_array(s);
  sbfi_text_string(&s->frame, "</Points>\n");
}

static void put_cells(sbf_result_series *s) {
  const sbf_result_mesh *m = s->mesh;
  size_t corner_count = 0;
  for (uint32_t i = 0; i < m->cell_count; i++) corner_count += m->sizes[i];
  sbfi_text_string(&s->frame, "<Cells>\n");
  begin_array(s, "UInt32", "connectivity", 1, 4 * corner_count);
  for (size_t i = 0; i < corner_count; i++) put_little(&s->bytes, m->corners[i], 4);
  end_array(s);
  begin_array(s, "UInt32", "offsets", 1, 4 * (uint64_t)m->cell_count);
  uint32_t offset = 0;
  for (uint32_t i = 0; i < m->cell_count; i++) put_little(&s->bytes, offset += m->sizes[i], 4);
  end_array(s);
  begin_array(s, "UInt8", "types", 1, m->cell_count);
  for (uint32_t i = 0; i < m->cell_count; i++)
    put_little(&s->bytes,
        (uint64_t)(m->sizes[i] == 4   ? VTK_TETRAHEDRON
                   : m->sizes[i] == 2 ? VTK_LINE
                                      : VTK_VERTEX),
        1);
  end_array(s);
  sbfi_text_string(&s->frame, "</Cells>\n");
}

/* ---- The series ---- */

static sbf_status no_memory(sbf_diagnostic *error) {
  return sbfi_diagnose(error, SBF_CODE_OUT_OF_MEMORY, "memory ran out for the results");
}

sbf_status sbf_result_series_open(
    const char *path, const sbf_result_mesh *mesh, sbf_result_series **series, sbf_diagnostic *error) {
  sbf_allocator allocator = sbfi_allocator_or_default(NULL);
  size_t length = strlen(path), end = sizeof ending - 1;
  *series = NULL;
  if (length >= PATH_BYTES || length <= end || strcmp(path + length - end, ending) != 0)
    return sbfi_diagnose(error, SBF_CODE_BAD_CALL, "%s: the path of results must end in .pvd", path);
  sbf_result_series *s = sbfi_allocate(&allocator, sizeof *s);
  if (!s) return no_memory(error);
  *s = (sbf_result_series){.allocator = allocator, .mesh = mesh, .stem = length - end};
  sbfi_copy_text(s->path, sizeof s->path, path);
  sbfi_text_init(&s->collection, &allocator);
  sbfi_text_init(&s->frame, &allocator);
  sbfi_text_init(&s->bytes, &allocator);
  *series = s;
  return SBF_OK;
}

/* Escapes a file name for an attribute. */
static void put_escaped(sbfi_text *to, const char *text) {
  for (; *text; text++) {
    const char *as = *text == '&' ? "&amp;" : *text == '<' ? "&lt;" : *text == '"' ? "&quot;" : NULL;
    if (as)
      sbfi_text_string(to, as);
    else
      sbfi_text_char(to, *text);
  }
}

static void list_frame(sbf_result_series *s, double time_s) {
  char path[FRAME_BYTES], head[64];
  frame_path(s, s->written, "", path);
  snprintf(head, sizeof head, "<DataSet timestep=\"%.9g\" part=\"0\" file=\"", time_s);
  sbfi_text_string(&s->collection, head);
  put_escaped(&s->collection, sbfi_path_name(path));
  sbfi_text_string(&s->collection, "\"/>\n");
}

sbf_status sbf_result_series_add(sbf_result_series *s, const sbf_result_frame *frame, sbf_diagnostic *error) {
  char head[160], path[FRAME_BYTES];
  snprintf(head, sizeof head, "<UnstructuredGrid>\n<Piece NumberOfPoints=\"%u\" NumberOfCells=\"%u\">\n",
      s->mesh->point_count, s->mesh->cell_count);
  sbfi_text_clear(&s->frame);
  sbfi_text_string(&s->frame, "<?xml version=\"1.0\"?>\n"
                              "<VTKFile type=\"UnstructuredGrid\" version=\"1.0\" "
                              "byte_order=\"LittleEndian\" header_type=\"UInt64\">\n");
  sbfi_text_string(&s->frame, head);
  put_arrays(s, "PointData", frame->of_points, frame->point_array_count, s->mesh->point_count);
  put_arrays(s, "CellData", frame->of_cells, frame->cell_array_count, s->mesh->cell_count);
  put_points(s, frame->points);
  put_cells(s);
  sbfi_text_string(&s->frame, "</Piece>\n</UnstructuredGrid>\n</VTKFile>\n");
  list_frame(s, frame->time_s);
  if (s->frame.failed || s->collection.failed) return no_memory(error);
  frame_path(s, s->written, part, path);
  sbf_status status = sbfi_file_write(path, s->frame.at, s->frame.length, &s->allocator, error);
  if (status == SBF_OK) s->written++;
  return status;
}

static void end(sbf_result_series *s) {
  sbf_allocator allocator = s->allocator;
  sbfi_text_free(&s->collection);
  sbfi_text_free(&s->frame);
  sbfi_text_free(&s->bytes);
  sbfi_free(&allocator, s, sizeof *s);
}

/* Replaces an existing file even if the system's rename does not. */
static bool replace_file(const char *from, const char *to) {
  if (rename(from, to) == 0) return true;
  return remove(to) == 0 && rename(from, to) == 0;
}

static sbf_status rename_frames(const sbf_result_series *s, sbf_diagnostic *error) {
  char from[FRAME_BYTES], to[FRAME_BYTES];
  for (uint32_t i = 0; i < s->written; i++) {
    frame_path(s, i, part, from);
    frame_path(s, i, "", to);
    if (!replace_file(from, to))
      return sbfi_diagnose(error, SBF_CODE_IO_CANNOT_WRITE, "%s cannot be renamed to %s", from, to);
  }
  return SBF_OK;
}

sbf_status sbf_result_series_commit(sbf_result_series *s, sbf_diagnostic *error) {
  sbf_status status = rename_frames(s, error);
  sbfi_text_clear(&s->frame);
  sbfi_text_string(&s->frame,
      "<?xml version=\"1.0\"?>\n<VTKFile type=\"Collection\" version=\"1.0\" byte_order=\"LittleEndian\">\n"
      "<Collection>\n");
  sbfi_text_append(&s->frame, s->collection.at, s->collection.length);
  sbfi_text_string(&s->frame, "</Collection>\n</VTKFile>\n");
  if (status == SBF_OK && s->frame.failed) status = no_memory(error);
  if (status == SBF_OK) status = sbfi_file_write(s->path, s->frame.at, s->frame.length, &s->allocator, error);
  if (status == SBF_OK)
    end(s);
  else
    sbf_result_series_abandon(s);
  return status;
}

void sbf_result_series_abandon(sbf_result_series *s) {
  char path[FRAME_BYTES];
  if (!s) return;
  for (uint32_t i = 0; i < s->written; i++) {
    frame_path(s, i, part, path);
    (void)remove(path);
  }
  end(s);
}
