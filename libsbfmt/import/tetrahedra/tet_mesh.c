#include "import/tetrahedra/tet_mesh.h"

#include <stdlib.h>
#include <string.h>

#include "base/diagnostic.h"
#include "base/file.h"
#include "build/geometry/key_set.h"

static bool ends_with(const char *text, const char *ending) {
  size_t length = strlen(text), tail = strlen(ending);
  return length > tail && strcmp(text + length - tail, ending) == 0;
}

bool sbfi_tet_mesh_supports(const char *path) {
  static const char *const endings[] = {".node", ".ele", ".msh", ".vtk", ".vtu", ".tet"};
  for (size_t i = 0; i < sizeof endings / sizeof *endings; i++)
    if (ends_with(path, endings[i])) return true;
  return false;
}

void sbfi_tet_mesh_free(sbfi_tet_mesh *mesh) {
  sbfi_array_free(&mesh->points);
  sbfi_array_free(&mesh->tetrahedra);
}

typedef bool read_function(sbfi_word_reader *, sbfi_tet_mesh *, uint32_t *);

static sbf_status read_text(sbfi_tet_mesh *mesh, const char *name, sbfi_span text, sbf_diagnostic *error,
    read_function *read, uint32_t *first) {
  sbfi_word_reader r;
  sbfi_word_reader_init(&r, text.at, text.length, name, error);
  read(&r, mesh, first);
  return r.status;
}

/* Reads one whole file with one reader. */
static sbf_status read_file(sbfi_tet_mesh *mesh, const char *path, uint64_t limit_bytes,
    sbf_diagnostic *error, read_function *read, uint32_t *first) {
  sbfi_file_content content;
  sbf_status status = sbfi_file_map(path, limit_bytes, &mesh->allocator, &content, error);
  if (status != SBF_OK) return status;
  status = read_text(mesh, path, (sbfi_span){(const char *)content.at, content.size}, error, read, first);
  sbfi_file_content_free(&content);
  return status;
}

static bool elements(sbfi_word_reader *r, sbfi_tet_mesh *mesh, uint32_t *first) {
  return sbfi_read_tetgen_elements(r, mesh, *first);
}

static bool any_other(sbfi_word_reader *r, sbfi_tet_mesh *mesh, uint32_t *first) {
  (void)first;
  if (ends_with(r->file, ".msh")) return sbfi_read_gmsh(r, mesh);
  if (ends_with(r->file, ".vtu")) return sbfi_read_vtu(r, mesh);
  return ends_with(r->file, ".vtk") ? sbfi_read_vtk(r, mesh) : sbfi_read_physx_tet(r, mesh);
}

static sbf_status read_tetgen(
    sbfi_tet_mesh *mesh, const char *path, uint64_t limit_bytes, sbf_diagnostic *error) {
  char other[4096];
  size_t stem = (size_t)(strrchr(path, '.') - path);
  uint32_t first = 0;
  if (stem + 6 > sizeof other)
    return sbfi_diagnose(error, SBF_CODE_IO_CANNOT_READ, "the path is too long: %.80s...", path);
  memcpy(other, path, stem);
  strcpy(other + stem, ".node");
  mesh->format = "tetgen";
  sbf_status status = read_file(mesh, other, limit_bytes, error, sbfi_read_tetgen_nodes, &first);
  if (status != SBF_OK) return status;
  strcpy(other + stem, ".ele");
  return read_file(mesh, other, limit_bytes, error, elements, &first);
}

static double volume_of(const sbf_vec3 *points, const uint32_t *p) {
  double e[3][3];
  for (int k = 0; k < 3; k++) {
    e[k][0] = (double)points[p[k + 1]].x - (double)points[p[0]].x;
    e[k][1] = (double)points[p[k + 1]].y - (double)points[p[0]].y;
    e[k][2] = (double)points[p[k + 1]].z - (double)points[p[0]].z;
  }
  return e[0][0] * (e[1][1] * e[2][2] - e[1][2] * e[2][1]) -
         e[0][1] * (e[1][0] * e[2][2] - e[1][2] * e[2][0]) +
         e[0][2] * (e[1][0] * e[2][1] - e[1][1] * e[2][0]);
}

static sbf_status repair(sbfi_tet_mesh *mesh, sbfi_key_set *known, const char *path, sbf_diagnostic *error) {
  sbf_uint4 *tetrahedra = mesh->tetrahedra.at;
  size_t kept = 0;
  for (size_t i = 0; i < mesh->tetrahedra.count; i++) {
    uint32_t *p = tetrahedra[i].at;
    for (int k = 0; k < 4; k++)
      if (p[k] >= mesh->points.count) {
        sbf_status status = sbfi_diagnose(error, SBF_CODE_IMPORT_INDEX,
            "tetrahedron %zu names point %u, but there are %zu points", i, p[k], mesh->points.count);
        if (error) sbfi_copy_text(error->file, sizeof error->file, path);
        return status;
      }
    double volume = volume_of(mesh->points.at, p);
    if (volume == 0) {
      mesh->flat_count++;
      continue;
    }
    sbf_uint4 whole = tetrahedra[i];
    uint32_t *seen = sbfi_key_set_find(known, sbfi_key_sorted((sbfi_key){{p[0], p[1], p[2], p[3]}}, 4));
    if (*seen != UINT32_MAX) {
      mesh->repeat_count++;
      continue;
    }
    *seen = (uint32_t)kept;
    if (volume < 0) {
      mesh->inverted_count++;
      whole.at[2] = p[3];
      whole.at[3] = p[2];
    }
    tetrahedra[kept++] = whole;
  }
  mesh->tetrahedra.count = kept;
  if (kept) return SBF_OK;
  sbf_status status = sbfi_diagnose(error, SBF_CODE_IMPORT_EMPTY, "the file has no tetrahedra");
  if (error) sbfi_copy_text(error->file, sizeof error->file, path);
  return status;
}

sbf_status sbfi_tet_mesh_repair(sbfi_tet_mesh *mesh, const char *path, sbf_diagnostic *error) {
  sbfi_arena scratch;
  sbfi_key_set known;
  sbfi_arena_init(&scratch, &mesh->allocator, 0);
  sbf_status status =
      sbfi_key_set_init(&known, mesh->tetrahedra.count + 1, &scratch)
          ? repair(mesh, &known, path, error)
          : sbfi_diagnose(error, SBF_CODE_OUT_OF_MEMORY, "memory ran out while %s was read", path);
  sbfi_arena_free(&scratch);
  return status;
}

static void begin(sbfi_tet_mesh *mesh, const sbf_allocator *allocator) {
  *mesh = (sbfi_tet_mesh){.allocator = sbfi_allocator_or_default(allocator), .format = ""};
  sbfi_array_init(&mesh->points, allocator, sizeof(sbf_vec3));
  sbfi_array_init(&mesh->tetrahedra, allocator, sizeof(sbf_uint4));
}

static bool is_pair(const char *path) {
  return ends_with(path, ".node") || ends_with(path, ".ele");
}

static sbf_status end(sbfi_tet_mesh *mesh, sbf_status status, const char *path, sbf_diagnostic *error) {
  if (status == SBF_OK) status = sbfi_tet_mesh_repair(mesh, path, error);
  if (status != SBF_OK) sbfi_tet_mesh_free(mesh);
  return status;
}

sbf_status sbfi_tet_mesh_read(sbfi_tet_mesh *mesh, const char *path, const sbf_allocator *allocator,
    uint64_t limit_bytes, sbf_diagnostic *error) {
  begin(mesh, allocator);
  sbf_status status = is_pair(path) ? read_tetgen(mesh, path, limit_bytes, error)
                                    : read_file(mesh, path, limit_bytes, error, any_other, NULL);
  return end(mesh, status, path, error);
}

sbf_status sbfi_tet_mesh_read_memory(sbfi_tet_mesh *mesh, const char *name, sbfi_span first, sbfi_span second,
    const sbf_allocator *allocator, sbf_diagnostic *error) {
  uint32_t first_number = 0;
  begin(mesh, allocator);
  bool pair = is_pair(name);
  if (pair) mesh->format = "tetgen";
  sbf_status status =
      read_text(mesh, name, first, error, pair ? sbfi_read_tetgen_nodes : any_other, &first_number);
  if (status == SBF_OK && pair) status = read_text(mesh, name, second, error, elements, &first_number);
  return end(mesh, status, name, error);
}

typedef struct side {
  uint32_t sorted[3], corners[3];
} side;

static int compare_sides(const void *a, const void *b) {
  const side *x = a, *y = b;
  for (int k = 0; k < 3; k++)
    if (x->sorted[k] != y->sorted[k]) return x->sorted[k] < y->sorted[k] ? -1 : 1;
  return 0;
}

static bool same_side(const side *a, const side *b) {
  return compare_sides(a, b) == 0;
}

static void sort3(uint32_t *p) {
  for (int pass = 0; pass < 2; pass++)
    for (int k = 0; k < 2; k++)
      if (p[k] > p[k + 1]) {
        uint32_t swap = p[k];
        p[k] = p[k + 1];
        p[k + 1] = swap;
      }
}

static void side_of(const sbf_uint4 *tetrahedron, int face, side *s) {
  static const int faces[4][3] = {{1, 2, 3}, {0, 3, 2}, {0, 1, 3}, {0, 2, 1}}; /* facing outwards */
  for (int k = 0; k < 3; k++) s->sorted[k] = s->corners[k] = tetrahedron->at[faces[face][k]];
  sort3(s->sorted);
}

bool sbfi_tet_mesh_boundary(const sbfi_tet_mesh *mesh, sbfi_array *triangles) {
  const sbf_uint4 *tetrahedra = mesh->tetrahedra.at;
  sbfi_array sides;
  sbfi_array_init(&sides, &mesh->allocator, sizeof(side));
  side *all = sbfi_array_push(&sides, 4 * mesh->tetrahedra.count);
  for (size_t i = 0; all && i < sides.count; i++) side_of(&tetrahedra[i / 4], (int)(i % 4), &all[i]);
  if (all) qsort(all, sides.count, sizeof *all, compare_sides);
  bool good = all != NULL;
  for (size_t i = 0; good && i < 4 * mesh->tetrahedra.count; i++) {
    side one;
    side_of(&tetrahedra[i / 4], (int)(i % 4), &one);
    const side *found = bsearch(&one, all, sides.count, sizeof *all, compare_sides);
    bool twice = (found > all && same_side(found - 1, &one)) ||
                 (found + 1 < all + sides.count && same_side(found + 1, &one));
    if (!twice) good = sbfi_array_append(triangles, one.corners, 3);
  }
  sbfi_array_free(&sides);
  return good;
}
