/* Tetrahedra of other programs. The first byte chooses the form; TetGen's two files stand one behind the
 * other, divided by a NUL. */
#include <float.h>
#include <string.h>

#include "fuzz.h"
#include "import/tetrahedra/tet_mesh.h"
#include "model/bulk_check.h"

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size) {
  static const char *const names[] = {"fuzz.ele", "fuzz.msh", "fuzz.vtk", "fuzz.tet", "fuzz.vtu"};
  if (size == 0) return 0;
  const char *name = names[data[0] % 5], *text = (const char *)data + 1;
  sbfi_span first = {text, size - 1}, second = {text, 0};
  const char *divide = data[0] % 5 == 0 ? memchr(text, 0, size - 1) : NULL;
  if (divide) {
    first.length = (size_t)(divide - text);
    second = (sbfi_span){divide + 1, size - 2 - first.length};
  }
  sbfi_tet_mesh mesh;
  sbf_diagnostic error = {0};
  sbf_status status = sbfi_tet_mesh_read_memory(&mesh, name, first, second, NULL, &error);
  if (status != SBF_OK) {
    FUZZ_MUST(error.code != 0 && error.message[0] && !mesh.points.at && !mesh.tetrahedra.at);
    return 0;
  }
  const sbf_uint4 *tetrahedra = mesh.tetrahedra.at;
  FUZZ_MUST(mesh.tetrahedra.count > 0);
  for (size_t i = 0; i < mesh.tetrahedra.count; i++)
    for (int k = 0; k < 4; k++) FUZZ_MUST(tetrahedra[i].at[k] < mesh.points.count);
  FUZZ_MUST(sbfi_find_f32_outside(mesh.points.at, 3 * mesh.points.count, -FLT_MAX, FLT_MAX) ==
            3 * mesh.points.count);
  FUZZ_MUST(
      sbfi_find_not_positive(tetrahedra, mesh.tetrahedra.count, mesh.points.at) == mesh.tetrahedra.count);
  sbfi_array triangles;
  sbfi_array_init(&triangles, NULL, sizeof(uint32_t));
  FUZZ_MUST(sbfi_tet_mesh_boundary(&mesh, &triangles));
  FUZZ_MUST(triangles.count % 3 == 0 && triangles.count <= 12 * mesh.tetrahedra.count);
  sbfi_array_free(&triangles);
  sbfi_tet_mesh_free(&mesh);
  return 0;
}
