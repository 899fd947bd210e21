#include "import/tetrahedra/tet_mesh.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "harness.h"

static const char two_nodes[] =
    "5 3 0 1\n1 0 0 0 7\n2 1 0 0 7\n3 0 1 0 7\n# a remark\n4 0 0 1 7\n5 1 1 1 7\n";
static const char two_elements[] = "2 4 1\n1 1 2 3 4 9\n2 2 3 5 4 9\n"; /* the second the other way round */
static const char vtk_text[] = "# vtk DataFile Version 2.0\ntitle\nASCII\nDATASET UNSTRUCTURED_GRID\n"
                               "POINTS 5 float\n0 0 0 1 0 0 0 1 0 0 0 1 1 1 1\n"
                               "CELLS 3 14\n4 0 1 2 3\n3 0 1 2\n4 1 2 3 4\nCELL_TYPES 3\n10 5 10\n"
                               "POINT_DATA 5\nSCALARS whatever\n";
static const char gmsh_1[] = "$NOD\n4\n10 0 0 0\n20 1 0 0\n30 0 1 0\n40 0 0 1\n$ENDNOD\n"
                             "$ELM\n2\n1 2 1 1 3 10 20 30\n2 4 1 1 4 10 20 30 40\n$ENDELM\n";
static const char gmsh_22[] = "$MeshFormat\n2.2 0 8\n$EndMeshFormat\n$PhysicalNames\n1\n3 1 \"all\"\n"
                              "$EndPhysicalNames\n$Nodes\n4\n1 0 0 0\n2 1 0 0\n3 0 1 0\n4 0 0 1\n$EndNodes\n"
                              "$Elements\n1\n1 4 2 1 1 1 2 3 4\n$EndElements\n";
static const char physx[] = "# made by hand\nv 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 1\nt 0 1 2 3\n";

static const char *put(const char *name, const char *text) {
  const char *path = harness_scratch(name);
  ck_assert(harness_write(path, text, strlen(text)));
  return path;
}

static sbf_status read_text(const char *name, const char *text, sbfi_tet_mesh *mesh, sbf_diagnostic *error) {
  return sbfi_tet_mesh_read(mesh, put(name, text), NULL, 0, error);
}

static void expect(const char *name, const char *text, size_t points, size_t tetrahedra) {
  sbfi_tet_mesh mesh;
  sbf_diagnostic error = {0};
  ck_assert_msg(read_text(name, text, &mesh, &error) == SBF_OK, "%s: %s", name, error.message);
  ck_assert_uint_eq(mesh.points.count, points);
  ck_assert_uint_eq(mesh.tetrahedra.count, tetrahedra);
  sbfi_tet_mesh_free(&mesh);
}

START_TEST(every_form_is_read)
{
  put("tet_a.node", two_nodes);
  expect("tet_a.ele", two_elements, 5, 2);
  expect("tet_b.vtk", vtk_text, 5, 2);
  expect("tet_c.msh", gmsh_1, 4, 1);
  expect("tet_d.msh", gmsh_22, 4, 1);
  expect("tet_e.tet", physx, 4, 1);
}
END_TEST

START_TEST(inverted_tetrahedra_are_reversed)
{
  sbfi_tet_mesh mesh;
  put("tet_f.node", two_nodes);
  ck_assert_int_eq(read_text("tet_f.ele", two_elements, &mesh, NULL), SBF_OK);
  ck_assert_uint_eq(mesh.inverted_count, 1);
  const uint32_t *p = ((const sbf_uint4 *)mesh.tetrahedra.at)[1].at;
  ck_assert_uint_eq(p[0], 1);
  ck_assert_uint_eq(p[2], 3);
  ck_assert_uint_eq(p[3], 4);
  sbfi_tet_mesh_free(&mesh);
}
END_TEST

START_TEST(repeated_tetrahedra_are_left_out)
{
  sbfi_tet_mesh mesh;
  put("tet_r.node", "5 3 0 0\n1 0 0 0\n2 1 0 0\n3 0 1 0\n4 0 0 1\n5 1 1 1\n");
  ck_assert_int_eq(
      read_text("tet_r.ele", "4 4 0\n1 1 2 3 4\n2 1 2 3 4\n3 2 1 4 3\n4 2 3 4 5\n", &mesh, NULL), SBF_OK);
  ck_assert_uint_eq(mesh.tetrahedra.count, 2);
  ck_assert_uint_eq(mesh.repeat_count, 2);
  ck_assert_uint_eq(((const sbf_uint4 *)mesh.tetrahedra.at)[0].at[0], 0);
  ck_assert_uint_eq(((const sbf_uint4 *)mesh.tetrahedra.at)[1].at[0], 1);
  sbfi_tet_mesh_free(&mesh);
}
END_TEST

START_TEST(the_boundary_has_every_outer_side_once_facing_outwards)
{
  sbfi_tet_mesh mesh;
  sbfi_array triangles;
  put("tet_g.node", two_nodes);
  ck_assert_int_eq(read_text("tet_g.ele", two_elements, &mesh, NULL), SBF_OK);
  sbfi_array_init(&triangles, NULL, sizeof(uint32_t));
  ck_assert(sbfi_tet_mesh_boundary(&mesh, &triangles));
  ck_assert_uint_eq(triangles.count, 3 * 6); /* two tetrahedra of four sides share one */
  const uint32_t *t = triangles.at;
  const sbf_vec3 *p = mesh.points.at;
  double six_volumes = 0, expected = 0;
  for (size_t i = 0; i < triangles.count; i += 3) {
    sbf_vec3 a = p[t[i]], b = p[t[i + 1]], c = p[t[i + 2]];
    six_volumes += (double)(a.x * (b.y * c.z - b.z * c.y) + a.y * (b.z * c.x - b.x * c.z) +
                            a.z * (b.x * c.y - b.y * c.x));
  }
  expected = 1 + 2; /* the corner of the cube, and the regular one behind it */
  ck_assert_double_eq_tol(six_volumes, expected, 1e-6);
  sbfi_array_free(&triangles);
  sbfi_tet_mesh_free(&mesh);
}
END_TEST

typedef struct fault {
  const char *name, *text;
  sbf_code code;
  uint32_t line;
} fault;

START_TEST(faults_are_named_with_their_line)
{
  static const fault faults[] = {
      {"bad_a.tet", "v 0 0\n", SBF_CODE_IMPORT_SYNTAX, 2},
      {"bad_b.tet", "v 0 0 nan\n", SBF_CODE_IMPORT_SYNTAX, 1},
      {"bad_c.tet", "v 0 0 0\nt 0 1 2 3\n", SBF_CODE_IMPORT_INDEX, 0},
      {"bad_d.tet", "v 0 0 0\nv 1 0 0\n", SBF_CODE_IMPORT_EMPTY, 0},
      {"bad_e.vtk", "hello\n", SBF_CODE_IMPORT_REFUSED, 2},
      {"bad_f.vtk", "# vtk DataFile Version 2.0\nt\nASCII\nDATASET STRUCTURED_POINTS\n",
          SBF_CODE_IMPORT_REFUSED, 4},
      {"bad_g.msh", "$MeshFormat\n9.9 0 8\n", SBF_CODE_IMPORT_REFUSED, 2},
      {"bad_h.msh", "$NOD\n4000000000\n", SBF_CODE_IMPORT_SYNTAX, 2},
      {"bad_i.msh", "$Comments\nno end\n", SBF_CODE_IMPORT_SYNTAX, 1},
      {"bad_j.msh", "nothing of the kind", SBF_CODE_IMPORT_REFUSED, 1},
  };
  for (size_t i = 0; i < sizeof faults / sizeof *faults; i++) {
    sbfi_tet_mesh mesh;
    sbf_diagnostic error = {0};
    ck_assert_int_eq(read_text(faults[i].name, faults[i].text, &mesh, &error), SBF_BAD_INPUT);
    ck_assert_msg(error.code == (int32_t)faults[i].code, "%s: %s", faults[i].name, error.message);
    ck_assert_msg(error.line == faults[i].line, "%s: line %u: %s", faults[i].name, error.line, error.message);
    ck_assert_ptr_null(mesh.points.at);
  }
}
END_TEST

/* Cut anywhere, a file is read or refused, and nothing of it is left behind. */
static void cut_everywhere(const char *name, const char *text, size_t size) {
  const char *path = harness_scratch(name);
  char kept[1100];
  snprintf(kept, sizeof kept, "%s", path);
  for (size_t length = 0; length < size; length++) {
    harness_memory memory;
    sbfi_tet_mesh mesh;
    harness_memory_init(&memory, SIZE_MAX);
    ck_assert(harness_write(kept, text, length));
    if (sbfi_tet_mesh_read(&mesh, kept, &memory.allocator, 0, NULL) == SBF_OK) sbfi_tet_mesh_free(&mesh);
    ck_assert_uint_eq(memory.held_bytes, 0);
  }
}

START_TEST(cut_files_are_refused)
{
  put("cut_a.node", two_nodes);
  cut_everywhere("cut_a.ele", two_elements, strlen(two_elements));
  cut_everywhere("cut_b.vtk", vtk_text, strlen(vtk_text));
  cut_everywhere("cut_c.msh", gmsh_1, strlen(gmsh_1));
  cut_everywhere("cut_d.msh", gmsh_22, strlen(gmsh_22));
  cut_everywhere("cut_e.tet", physx, strlen(physx));
  const char *binary = harness_shared("tets/cube_41_binary.msh");
  size_t size;
  char *bytes = binary ? harness_read(binary, &size) : NULL;
  if (bytes) cut_everywhere("cut_f.msh", bytes, size);
  free(bytes);
}
END_TEST

START_TEST(every_allocation_may_fail)
{
  const char *path = put("mem.msh", gmsh_22);
  for (size_t allowed = 0;; allowed++) {
    harness_memory memory;
    sbfi_tet_mesh mesh;
    sbf_diagnostic error;
    harness_memory_init(&memory, allowed);
    sbf_status status = sbfi_tet_mesh_read(&mesh, path, &memory.allocator, 0, &error);
    if (status == SBF_OK) {
      sbfi_tet_mesh_free(&mesh);
      ck_assert_uint_eq(memory.held_bytes, 0);
      ck_assert_uint_gt(allowed, 2);
      break;
    }
    ck_assert_int_eq(error.code, SBF_CODE_OUT_OF_MEMORY);
    ck_assert_uint_eq(memory.held_bytes, 0);
  }
}
END_TEST

typedef struct real_file {
  const char *path;
  size_t points, tetrahedra, boundary;
} real_file;

START_TEST(real_files_have_their_counts)
{
  static const real_file files[] = {
      {"tets/ball.vtk", 600, 2536, 648},
      {"tets/cube_22_ascii.msh", 14, 24, 24},
      {"tets/cube_22_binary.msh", 14, 24, 24},
      {"tets/cube_41_ascii.msh", 14, 24, 24},
      {"tets/cube_41_binary.msh", 14, 24, 24},
      {"tets/liver_v1.msh", 181, 596, 276},
      {"tube/cylinder.msh", 510, 2430, 360},
      {"tube/tube.vtk", 600, 2221, 816},
      {"armadillo/armadillo_4k.node", 1180, 3717, 2102},
      {"armadillo/armadillo_4k.ele", 1180, 3717, 2102},
  };
  for (size_t i = 0; i < sizeof files / sizeof *files; i++) {
    const char *path = harness_shared(files[i].path);
    if (!path) return;
    sbfi_tet_mesh mesh;
    sbf_diagnostic error;
    sbfi_array triangles;
    ck_assert_msg(sbfi_tet_mesh_read(&mesh, path, NULL, 0, &error) == SBF_OK, "%s: %s", path, error.message);
    sbfi_array_init(&triangles, NULL, sizeof(uint32_t));
    ck_assert(sbfi_tet_mesh_boundary(&mesh, &triangles));
    ck_assert_uint_eq(mesh.points.count, files[i].points);
    ck_assert_uint_eq(mesh.tetrahedra.count, files[i].tetrahedra);
    ck_assert_uint_eq(triangles.count, 3 * files[i].boundary);
    ck_assert_uint_eq(mesh.inverted_count + mesh.flat_count, 0);
    sbfi_array_free(&triangles);
    sbfi_tet_mesh_free(&mesh);
  }
}
END_TEST

int main(void) {
  Suite *suite = suite_create("tet_mesh");
  TCase *tests = tcase_create("all");
  tcase_add_test(tests, every_form_is_read);
  tcase_add_test(tests, inverted_tetrahedra_are_reversed);
  tcase_add_test(tests, repeated_tetrahedra_are_left_out);
  tcase_add_test(tests, the_boundary_has_every_outer_side_once_facing_outwards);
  tcase_add_test(tests, faults_are_named_with_their_line);
  tcase_add_test(tests, cut_files_are_refused);
  tcase_add_test(tests, every_allocation_may_fail);
  tcase_add_test(tests, real_files_have_their_counts);
  suite_add_tcase(suite, tests);
  return harness_run(suite);
}
