#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "base/base64.h"
#include "harness.h"
#include "import/tetrahedra/tet_mesh.h"
#include "import/tetrahedra/vtu_data.h"

#define HEAD                                                                                                 \
  "<VTKFile type=\"UnstructuredGrid\" version=\"1.0\" byte_order=\"LittleEndian\">\n<UnstructuredGrid>\n"    \
  "<Piece NumberOfPoints=\"4\" NumberOfCells=\"1\">\n"
#define PLACES                                                                                               \
  "<Points><DataArray type=\"Float32\" format=\"ascii\">0 0 0 1 0 0 0 1 0 0 0 1</DataArray></Points>\n"
#define ARRAY(name, numbers)                                                                                 \
  "<DataArray type=\"Int32\" Name=\"" name "\" format=\"ascii\">" numbers "</DataArray>\n"
#define TAIL "</Piece></UnstructuredGrid></VTKFile>\n"
#define CELLS ARRAY("connectivity", "0 1 2 3") ARRAY("offsets", "4") ARRAY("types", "10")

static const char whole[] = HEAD PLACES "<Cells>" CELLS "</Cells>\n" TAIL;

static sbf_status read_bytes(const char *bytes, size_t size, const sbf_allocator *allocator,
    sbfi_tet_mesh *mesh, sbf_diagnostic *error) {
  return sbfi_tet_mesh_read_memory(
      mesh, "a.vtu", (sbfi_span){bytes, size}, (sbfi_span){NULL, 0}, allocator, error);
}

START_TEST(a_grid_is_read)
{
  sbfi_tet_mesh mesh;
  sbf_diagnostic error = {0};
  ck_assert_msg(read_bytes(whole, strlen(whole), NULL, &mesh, &error) == SBF_OK, "%s", error.message);
  ck_assert_uint_eq(mesh.points.count, 4);
  ck_assert_uint_eq(mesh.tetrahedra.count, 1);
  ck_assert_float_eq(((const sbf_vec3 *)mesh.points.at)[3].z, 1);
  sbfi_tet_mesh_free(&mesh);
}
END_TEST

typedef struct fault {
  const char *text;
  sbf_code code;
  uint32_t line; /* 0: any */
} fault;

#define POINTS_OF(attributes, text)                                                                          \
  HEAD "<Points><DataArray " attributes ">" text "</DataArray></Points>\n<Cells>" CELLS "</Cells>\n" TAIL
#define CELLS_OF(cells) HEAD PLACES "<Cells>" cells "</Cells>\n" TAIL

START_TEST(faults_are_named)
{
  static const fault faults[] = {
      {"", SBF_CODE_XML_SYNTAX, 0},
      {"<VTKFile type=\"PolyData\"/>", SBF_CODE_IMPORT_REFUSED, 1},
      {"<VTKFile type=\"UnstructuredGrid\" compressor=\"vtkLZMADataCompressor\"/>", SBF_CODE_IMPORT_REFUSED,
          1},
      {"<VTKFile type=\"UnstructuredGrid\"/>", SBF_CODE_IMPORT_EMPTY, 0},
      {HEAD TAIL, SBF_CODE_IMPORT_SYNTAX, 4},
      {HEAD PLACES TAIL, SBF_CODE_IMPORT_SYNTAX, 5},
      {CELLS_OF(ARRAY("connectivity", "0 1 2 4") ARRAY("offsets", "4") ARRAY("types", "10")),
          SBF_CODE_IMPORT_INDEX, 0},
      {CELLS_OF(ARRAY("connectivity", "0 1 2 -3") ARRAY("offsets", "4") ARRAY("types", "10")),
          SBF_CODE_IMPORT_SYNTAX, 5},
      {CELLS_OF(ARRAY("connectivity", "0 1 2 3") ARRAY("offsets", "5") ARRAY("types", "10")),
          SBF_CODE_IMPORT_INDEX, 0},
      {CELLS_OF(ARRAY("connectivity", "0 1 2 3") ARRAY("offsets", "4 4") ARRAY("types", "10")),
          SBF_CODE_IMPORT_SYNTAX, 6},
      {CELLS_OF(ARRAY("connectivity", "0 1 2 3") ARRAY("offsets", "4")), SBF_CODE_IMPORT_SYNTAX, 0},
      {CELLS_OF(ARRAY("connectivity", "0 1 2 3") ARRAY("offsets", "4") ARRAY("types", "5")),
          SBF_CODE_IMPORT_EMPTY, 0},
      {POINTS_OF("type=\"Float32\"", "0 0 0"), SBF_CODE_IMPORT_SYNTAX, 4},
      {POINTS_OF("type=\"Float32\"", "0 0 nan"), SBF_CODE_IMPORT_SYNTAX, 4},
      {POINTS_OF("type=\"Float16\"", "0 0 0"), SBF_CODE_IMPORT_SYNTAX, 4},
      {POINTS_OF("type=\"Float32\" format=\"binary\"", "AAAA!"), SBF_CODE_IMPORT_SYNTAX, 4},
      {POINTS_OF("type=\"Float32\" format=\"binary\"", "MAAAAA=="), SBF_CODE_IMPORT_SYNTAX, 4},
      {POINTS_OF("type=\"Float32\" format=\"binary\"", "/////w=="), SBF_CODE_IO_TOO_LARGE, 4},
      {POINTS_OF("type=\"Int32\" format=\"binary\"", "BAAAAAAAAAA="), SBF_CODE_IMPORT_REFUSED, 4},
      {POINTS_OF("type=\"Float32\" format=\"binary\"", "BAAAAAAAgH8="), SBF_CODE_IMPORT_NOT_FINITE, 4},
      {POINTS_OF("type=\"Float32\" format=\"appended\" offset=\"9\"", ""), SBF_CODE_IMPORT_SYNTAX, 4},
      {POINTS_OF("type=\"Float32\" format=\"appended\" offset=\"-1\"", ""), SBF_CODE_IMPORT_SYNTAX, 4},
      {HEAD "<AppendedData encoding=\"raw\">no", SBF_CODE_IMPORT_SYNTAX, 0},
      {HEAD "<AppendedData encoding=\"rot13\">_no", SBF_CODE_IMPORT_REFUSED, 0},
      {"<!DOCTYPE VTKFile [<!ENTITY a 'b'>]><VTKFile/>", SBF_CODE_XML_DOCTYPE, 1},
  };
  for (size_t i = 0; i < sizeof faults / sizeof *faults; i++) {
    sbfi_tet_mesh mesh;
    sbf_diagnostic error = {0};
    ck_assert_msg(read_bytes(faults[i].text, strlen(faults[i].text), NULL, &mesh, &error) == SBF_BAD_INPUT,
        "fault %zu", i);
    ck_assert_msg(error.code == (int32_t)faults[i].code, "fault %zu: %s", i, error.message);
    ck_assert_msg(faults[i].line == 0 || error.line == faults[i].line, "fault %zu: line %u: %s", i,
        error.line, error.message);
    ck_assert_str_eq(error.file, "a.vtu");
    ck_assert_ptr_null(mesh.points.at);
  }
}
END_TEST

/* --- Compressed arrays: what a header may claim ------------------------------------------------------- */

/* A compressed array of `raw` bytes in one block, with the header's words replaced where they are not 0. */
static void put_compressed(sbfi_text *to, const void *raw, uint32_t size, uint32_t block, uint32_t stored) {
  uint8_t buffer[4096];
  size_t length;
  sbfi_packed_coder coder;
  sbfi_packed_coder_init(&coder, NULL, 9);
  ck_assert_int_eq(
      sbfi_packed_deflate(&coder, raw, size, SBFI_FILTER_NONE, 0, buffer, sizeof buffer, &length),
      SBFI_CODED);
  sbfi_packed_coder_free(&coder);
  uint32_t words[4] = {1, block ? block : size, 0, stored ? stored : (uint32_t)length};
  uint8_t header[16];
  for (int i = 0; i < 16; i++) header[i] = (uint8_t)(words[i / 4] >> 8 * (i % 4));
  sbfi_base64_encode(to, header, sizeof header);
  sbfi_base64_encode(to, buffer, length);
}

static sbf_status read_points(
    const float *points, uint32_t count, uint32_t block, uint32_t stored, sbf_diagnostic *error) {
  sbfi_text text;
  sbfi_tet_mesh mesh;
  char head[400];
  sbfi_text_init(&text, NULL);
  snprintf(head, sizeof head,
      "<VTKFile type=\"UnstructuredGrid\" byte_order=\"LittleEndian\" compressor=\"vtkZLibDataCompressor\">"
      "<UnstructuredGrid><Piece NumberOfPoints=\"%u\" NumberOfCells=\"1\"><Points>"
      "<DataArray type=\"Float32\" format=\"binary\">",
      count);
  sbfi_text_string(&text, head);
  put_compressed(&text, points, 12 * count, block, stored);
  sbfi_text_string(&text, "</DataArray></Points><Cells>" CELLS "</Cells>" TAIL);
  sbf_status status = read_bytes(text.at, text.length, NULL, &mesh, error);
  if (status == SBF_OK) sbfi_tet_mesh_free(&mesh);
  sbfi_text_free(&text);
  return status;
}

START_TEST(headers_are_believed_as_far_as_the_bytes_allow)
{
  const float points[12] = {0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0, 1};
  sbf_diagnostic error = {0};
  ck_assert_msg(read_points(points, 4, 0, 0, &error) == SBF_OK, "%s", error.message);
  static const struct {
    uint32_t block, stored;
    sbf_code code;
  } claims[] = {{49, 0, SBF_CODE_IMPORT_SYNTAX}, {47, 0, SBF_CODE_IMPORT_SYNTAX},
      {48, 9, SBF_CODE_IMPORT_SYNTAX}, {48, 4000000000, SBF_CODE_IMPORT_SYNTAX},
      {1 << 20, 0, SBF_CODE_IMPORT_SYNTAX}, {(1 << 30) + 1, 0, SBF_CODE_IO_TOO_LARGE},
      {UINT32_MAX, 0, SBF_CODE_IO_TOO_LARGE}};
  for (size_t i = 0; i < sizeof claims / sizeof *claims; i++) {
    ck_assert_int_eq(read_points(points, 4, claims[i].block, claims[i].stored, &error), SBF_BAD_INPUT);
    ck_assert_msg(error.code == (int32_t)claims[i].code, "claim %zu: %s", i, error.message);
  }
}
END_TEST

/* Zeros, which deflate compresses the most, are still within the limit. */
START_TEST(large_empty_grids_are_read)
{
  enum { COUNT = 80000 };
  float *points = calloc(COUNT, 12);
  sbf_diagnostic error = {0};
  points[3] = points[7] = points[11] = 1;
  ck_assert_msg(read_points(points, COUNT, 0, 0, &error) == SBF_OK, "%s", error.message);
  free(points);
}
END_TEST

START_TEST(a_truncated_file_leaks_nothing)
{
  for (size_t length = 0; length < strlen(whole); length++) {
    harness_memory memory;
    sbfi_tet_mesh mesh;
    harness_memory_init(&memory, SIZE_MAX);
    if (read_bytes(whole, length, &memory.allocator, &mesh, NULL) == SBF_OK) sbfi_tet_mesh_free(&mesh);
    ck_assert_uint_eq(memory.held_bytes, 0);
  }
}
END_TEST

START_TEST(every_allocation_may_fail)
{
  for (size_t allowed = 0;; allowed++) {
    harness_memory memory;
    sbfi_tet_mesh mesh;
    sbf_diagnostic error = {0};
    harness_memory_init(&memory, allowed);
    sbf_status status = read_bytes(whole, strlen(whole), &memory.allocator, &mesh, &error);
    if (status == SBF_OK) {
      sbfi_tet_mesh_free(&mesh);
      ck_assert_uint_eq(memory.held_bytes, 0);
      ck_assert_uint_gt(allowed, 4);
      return;
    }
    ck_assert_int_eq(error.code, SBF_CODE_OUT_OF_MEMORY);
    ck_assert_uint_eq(memory.held_bytes, 0);
  }
}
END_TEST

int main(void) {
  Suite *suite = suite_create("vtu");
  TCase *tests = tcase_create("all");
  tcase_add_test(tests, a_grid_is_read);
  tcase_add_test(tests, faults_are_named);
  tcase_add_test(tests, headers_are_believed_as_far_as_the_bytes_allow);
  tcase_add_test(tests, large_empty_grids_are_read);
  tcase_add_test(tests, a_truncated_file_leaks_nothing);
  tcase_add_test(tests, every_allocation_may_fail);
  suite_add_tcase(suite, tests);
  return harness_run(suite);
}
