/* Tetrahedra of another program: TetGen, Gmsh, VTK, PhysX. What a loaded mesh promises: indices in range,
 * numbers finite, every tetrahedron of positive volume
 * and listed once. */
#ifndef SBFI_TET_MESH_H
#define SBFI_TET_MESH_H

#include "import/tetrahedra/word_reader.h"

typedef struct sbfi_tet_mesh {
  sbf_allocator allocator;
  const char *format;    /* "tetgen", "gmsh", "vtk", "vtu", "physx tet" */
  sbfi_array points;     /* sbf_vec3, in the file's unit and axes, in its order */
  sbfi_array tetrahedra; /* sbf_uint4 */
  uint32_t turned_count; /* listed the other way round in the file: two corners were exchanged */
  uint32_t flat_count;   /* without volume: left out */
  uint32_t repeat_count; /* with the four points of another: left out */
  uint32_t passed_over;  /* elements of other kinds */
} sbfi_tet_mesh;

/* Whether a path's ending is one of those read here: .node .ele .msh .vtk .vtu .tet */
bool sbfi_tet_mesh_knows(const char *path);

/* Reads the file; of TetGen's pair either may be named and both must be there. On failure the mesh is empty.
 */
sbf_status sbfi_tet_mesh_read(sbfi_tet_mesh *mesh, const char *path, const sbf_allocator *allocator,
    uint64_t limit_bytes, sbf_diagnostic *error);
/* The same from memory: `name` has the ending that says which form. Of TetGen's pair `first` is the .node,
 * `second` the .ele; of the others `first` is all. */
sbf_status sbfi_tet_mesh_read_memory(sbfi_tet_mesh *mesh, const char *name, sbfi_span first, sbfi_span second,
    const sbf_allocator *allocator, sbf_diagnostic *error);
void sbfi_tet_mesh_free(sbfi_tet_mesh *mesh);

/* Checks every index, turns what is listed the other way round, leaves out what is flat or
 * repeats another; an error where nothing is left. `path` is the file's, for messages. */
sbf_status sbfi_tet_mesh_repair(sbfi_tet_mesh *mesh, const char *path, sbf_diagnostic *error);

/* Triangles that bound the tetrahedra, each once, facing outwards, in the order of the tetrahedra: appended
 * to an array of uint32_t, three each. False where memory runs out. */
bool sbfi_tet_mesh_boundary(const sbfi_tet_mesh *mesh, sbfi_array *triangles);

/* ---- The readers: each fills points and tetrahedra as the file has them ---- */

bool sbfi_read_tetgen_nodes(sbfi_word_reader *r, sbfi_tet_mesh *mesh, uint32_t *first_number);
bool sbfi_read_tetgen_elements(sbfi_word_reader *r, sbfi_tet_mesh *mesh, uint32_t first_number);
bool sbfi_read_gmsh(sbfi_word_reader *r, sbfi_tet_mesh *mesh);
bool sbfi_read_vtk(sbfi_word_reader *r, sbfi_tet_mesh *mesh);
bool sbfi_read_vtu(sbfi_word_reader *r, sbfi_tet_mesh *mesh);
bool sbfi_read_physx_tet(sbfi_word_reader *r, sbfi_tet_mesh *mesh);

#endif
