/* Reads PhysX 2.x .tet: lines `v x y z` and `t a b c d`, counted from 0; `#` starts a comment. */
#include "import/tetrahedra/tet_mesh.h"

bool sbfi_read_physx_tet(sbfi_word_reader *r, sbfi_tet_mesh *mesh) {
  sbfi_span word;
  mesh->format = "physx tet";
  r->comment = '#';
  while (sbfi_word_next(r, &word)) {
    if (sbfi_span_is(word, "v")) {
      sbf_vec3 *point = sbfi_word_push(r, &mesh->points, 1);
      if (!point || !sbfi_word_f32(r, &point->x, "a vertex") || !sbfi_word_f32(r, &point->y, "a vertex") ||
          !sbfi_word_f32(r, &point->z, "a vertex"))
        return false;
    } else if (sbfi_span_is(word, "t")) {
      sbf_uint4 *tetrahedron = sbfi_word_push(r, &mesh->tetrahedra, 1);
      for (int k = 0; k < 4; k++)
        if (!tetrahedron || !sbfi_word_u32(r, &tetrahedron->at[k], "a tetrahedron's vertex")) return false;
    } else {
      mesh->passed_over++;
      if (!sbfi_word_line(r, &word)) break;
    }
  }
  return r->status == SBF_OK;
}
