/* Reads TetGen's .node and .ele: a line of counts, then one line per item that starts with its number.
 * Numbers start at that of the first node, 0 or 1. '#' starts a comment. */
#include "import/tetrahedra/tet_mesh.h"

/* Skips words that the counts include but we do not use: attributes, markers. */
static bool skip_words(sbfi_word_reader *r, uint32_t count) {
  sbfi_span word;
  for (uint32_t i = 0; i < count; i++)
    if (!sbfi_word_next(r, &word))
      return sbfi_word_fail(r, SBF_CODE_IMPORT_SYNTAX, "the file ends within the attributes of an item");
  return true;
}

bool sbfi_read_tetgen_nodes(sbfi_word_reader *r, sbfi_tet_mesh *mesh, uint32_t *first_number) {
  uint32_t count, dimension, attributes, markers, number;
  r->comment = '#';
  if (!sbfi_word_count(r, &count, 8, "the nodes") || !sbfi_word_u32(r, &dimension, "the dimension") ||
      !sbfi_word_u32(r, &attributes, "the number of attributes") ||
      !sbfi_word_u32(r, &markers, "the number of markers"))
    return false;
  if (dimension != 3)
    return sbfi_word_fail(r, SBF_CODE_IMPORT_SYNTAX, "the nodes have %u dimensions, not 3", dimension);
  sbf_vec3 *points = sbfi_word_push(r, &mesh->points, count);
  for (uint32_t i = 0; points && i < count; i++) {
    if (!sbfi_word_u32(r, &number, "a node's number")) return false;
    if (i == 0) *first_number = number;
    if (number != *first_number + i)
      return sbfi_word_fail(
          r, SBF_CODE_IMPORT_SYNTAX, "found node %u instead of node %u", number, *first_number + i);
    if (!sbfi_word_f32(r, &points[i].x, "a node's place") ||
        !sbfi_word_f32(r, &points[i].y, "a node's place") ||
        !sbfi_word_f32(r, &points[i].z, "a node's place") || !skip_words(r, attributes + markers))
      return false;
  }
  return r->status == SBF_OK;
}

bool sbfi_read_tetgen_elements(sbfi_word_reader *r, sbfi_tet_mesh *mesh, uint32_t first_number) {
  uint32_t count, nodes, attributes, number;
  r->comment = '#';
  if (!sbfi_word_count(r, &count, 10, "the tetrahedra") ||
      !sbfi_word_u32(r, &nodes, "the nodes of a tetrahedron") ||
      !sbfi_word_u32(r, &attributes, "the number of attributes"))
    return false;
  if (nodes != 4 && nodes != 10)
    return sbfi_word_fail(r, SBF_CODE_IMPORT_SYNTAX, "elements of %u nodes are not tetrahedra", nodes);
  sbf_uint4 *tetrahedra = sbfi_word_push(r, &mesh->tetrahedra, count);
  for (uint32_t i = 0; tetrahedra && i < count; i++) {
    if (!sbfi_word_u32(r, &number, "a tetrahedron's number")) return false;
    for (int k = 0; k < 4; k++) {
      if (!sbfi_word_u32(r, &number, "a tetrahedron's node")) return false;
      /* numbers that are too small wrap around and fail the range check */
      tetrahedra[i].at[k] = number - first_number;
    }
    if (!skip_words(r, nodes - 4 + attributes)) return false;
  }
  return r->status == SBF_OK;
}
