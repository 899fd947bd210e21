/* Tetrahedra of another program: TetGen, Gmsh, VTK, PhysX. A loaded mesh has indices in range, finite
 * numbers, and unique tetrahedra of positive volume. */
#ifndef SBFI_TET_MESH_H
#define SBFI_TET_MESH_H

#include "import/tetrahedra/word_reader.h"

typedef struct sbfi_tet_mesh {
  sbf_allocator allocator;
  const char *format;      /* "tetgen", "gmsh", "vtk", "vtu", "physx tet" */
  sbfi_array points;       /* sbf_vec3, in the file's unit, axes and order */
  sbfi_array tetrahedra;   /* sbf_uint4 */
  uint32_t inverted_count; /* inverted in the file: two corners were swapped */
  uint32_t flat_count;     /* without volume: dropped */
  uint32_t repeat_count;   /* duplicates of another's four points: dropped */
  uint32_t passed_over;    /* skipped elements of other kinds */
} sbfi_tet_mesh;

/* Whether a path has a supported extension: .node .ele .msh .vtk .vtu .tet */
bool sbfi_tet_mesh_supports(const char *path);

/* Reads the file. Either file of TetGen's pair may be given, but both must exist. On failure the mesh is
 * empty. */
sbf_status sbfi_tet_mesh_read(sbfi_tet_mesh *mesh, const char *path, const sbf_allocator *allocator,
    uint64_t limit_bytes, sbf_diagnostic *error);
/* Reads from memory; the extension of `name` selects the format. For TetGen's pair `first` is the .node
 * and `second` the .ele; for others `first` is the whole file. */
sbf_status sbfi_tet_mesh_read_memory(sbfi_tet_mesh *mesh, const char *name, sbfi_span first, sbfi_span second,
    const sbf_allocator *allocator, sbf_diagnostic *error);
void sbfi_tet_mesh_free(sbfi_tet_mesh *mesh);

/* Checks every index, flips inverted tetrahedra, and drops flat and duplicate ones; fails if none is left.
 * `path` is used in messages. */
sbf_status sbfi_tet_mesh_repair(sbfi_tet_mesh *mesh, const char *path, sbf_diagnostic *error);

/* Appends the boundary triangles of the tetrahedra, outward facing and in the order of the tetrahedra, to
 * an array of uint32_t, three each. False if memory runs out. */
bool sbfi_tet_mesh_boundary(const sbfi_tet_mesh *mesh, sbfi_array *triangles);

/* ---- The readers: each fills points and tetrahedra as the file has them ---- */

bool sbfi_read_tetgen_nodes(sbfi_word_reader *r, sbfi_tet_mesh *mesh, uint32_t *first_number);
bool sbfi_read_tetgen_elements(sbfi_word_reader *r, sbfi_tet_mesh *mesh, uint32_t first_number);
bool sbfi_read_gmsh(sbfi_word_reader *r, sbfi_tet_mesh *mesh);
bool sbfi_read_vtk(sbfi_word_reader *r, sbfi_tet_mesh *mesh);
bool sbfi_read_vtu(sbfi_word_reader *r, sbfi_tet_mesh *mesh);
bool sbfi_read_physx_tet(sbfi_word_reader *r, sbfi_tet_mesh *mesh);

#endif
