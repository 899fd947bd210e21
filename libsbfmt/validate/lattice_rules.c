/* Tetrahedra: well shaped, each once, all of one piece. That they are the right way out is part of the
 * structure. */
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "validate/validation.h"

static const double LEAST_DIHEDRAL_DEG = 5;

static void subtract(sbf_vec3 a, sbf_vec3 b, double d[3]) {
  d[0] = (double)a.x - (double)b.x;
  d[1] = (double)a.y - (double)b.y;
  d[2] = (double)a.z - (double)b.z;
}

static void cross(const double a[3], const double b[3], double c[3]) {
  c[0] = a[1] * b[2] - a[2] * b[1];
  c[1] = a[2] * b[0] - a[0] * b[2];
  c[2] = a[0] * b[1] - a[1] * b[0];
}

/* Largest cosine of the six dihedral angles: of the sharpest. */
static double sharpest_cosine(const sbf_vec3 *points, const uint32_t p[4]) {
  static const int faces[4][3] = {{1, 2, 3}, {0, 3, 2}, {0, 1, 3}, {0, 2, 1}};
  double n[4][3], sharpest = -1;
  for (int f = 0; f < 4; f++) {
    double a[3], b[3];
    subtract(points[p[faces[f][1]]], points[p[faces[f][0]]], a);
    subtract(points[p[faces[f][2]]], points[p[faces[f][0]]], b);
    cross(a, b, n[f]);
    double length = sqrt(n[f][0] * n[f][0] + n[f][1] * n[f][1] + n[f][2] * n[f][2]);
    for (int k = 0; k < 3; k++) n[f][k] = length > 0 ? n[f][k] / length : 0;
  }
  for (int f = 0; f < 4; f++)
    for (int g = f + 1; g < 4; g++)
      sharpest = fmax(sharpest, -(n[f][0] * n[g][0] + n[f][1] * n[g][1] + n[f][2] * n[g][2]));
  return sharpest;
}

typedef struct element {
  uint32_t points[4], place; /* points sorted */
} element;

static int compare_elements(const void *a, const void *b) {
  const element *x = a, *y = b;
  for (int k = 0; k < 4; k++)
    if (x->points[k] != y->points[k]) return x->points[k] < y->points[k] ? -1 : 1;
  return x->place < y->place ? -1 : x->place > y->place;
}

static void sort_points(uint32_t p[4]) {
  for (int i = 1; i < 4; i++)
    for (int k = i; k > 0 && p[k] < p[k - 1]; k--) {
      uint32_t swap = p[k];
      p[k] = p[k - 1];
      p[k - 1] = swap;
    }
}

static void find_duplicates(sbfi_validation *v, const sbf_uint4_list *tetrahedra, const char *path) {
  element *elements = sbfi_arena_allocate(&v->scratch, tetrahedra->count, sizeof *elements);
  if (!elements) {
    v->out_of_memory = true;
    return;
  }
  for (uint32_t i = 0; i < tetrahedra->count; i++) {
    memcpy(elements[i].points, tetrahedra->at[i].at, sizeof elements[i].points);
    sort_points(elements[i].points);
    elements[i].place = i;
  }
  qsort(elements, tetrahedra->count, sizeof *elements, compare_elements);
  for (uint32_t i = 1; i < tetrahedra->count; i++)
    if (memcmp(elements[i].points, elements[i - 1].points, sizeof elements[i].points) == 0)
      sbfi_found(v, SBF_CODE_TETRAHEDRON_DUPLICATE, path, elements[i].place,
          "tetrahedron %u has the points of tetrahedron %u", elements[i].place, elements[i - 1].place);
}

static uint32_t find_root(uint32_t *parents, uint32_t i) {
  while (parents[i] != i) i = parents[i] = parents[parents[i]];
  return i;
}

static void find_pieces(sbfi_validation *v, const sbf_level *level, const char *path) {
  uint32_t n = level->positions.count, pieces = 0, unused = 0;
  uint32_t *parents = sbfi_arena_allocate(&v->scratch, n, sizeof *parents);
  uint8_t *used = sbfi_arena_allocate(&v->scratch, n, 1);
  if (n && (!parents || !used)) {
    v->out_of_memory = true;
    return;
  }
  for (uint32_t i = 0; i < n; i++) parents[i] = i;
  for (uint32_t t = 0; t < level->lattice.tetrahedra.count; t++)
    for (int k = 0; k < 4; k++) {
      const uint32_t *p = level->lattice.tetrahedra.at[t].at;
      used[p[k]] = 1;
      parents[find_root(parents, p[k])] = find_root(parents, p[0]);
    }
  for (uint32_t i = 0; i < n; i++) {
    unused += !used[i];
    pieces += used[i] && parents[i] == i;
  }
  if (pieces > 1)
    sbfi_found(v, SBF_CODE_LATTICE_PIECES, path, -1, "the lattice consists of %u pieces", pieces);
  if (unused && level->springs.count == 0)
    sbfi_found(v, SBF_CODE_LATTICE_POINT_UNUSED, path, -1, "%u points are in no tetrahedron", unused);
}

static void check_lattice(sbfi_validation *v, const sbf_level *level, const char *path) {
  if (level->lattice.tetrahedra.count == 0) {
    if (level->model == SBF_ELASTIC_MODEL_TETRAHEDRA)
      sbfi_found(v, SBF_CODE_LEVEL_EMPTY, path, -1, "the level's model is tetrahedra and it has none");
    return;
  }
  double limit = cos(LEAST_DIHEDRAL_DEG * 3.14159265358979 / 180);
  for (uint32_t i = 0; i < level->lattice.tetrahedra.count; i++) {
    double cosine = sharpest_cosine(level->positions.at, level->lattice.tetrahedra.at[i].at);
    if (cosine > limit)
      sbfi_found(v, SBF_CODE_TETRAHEDRON_SLIVER, path, i,
          "tetrahedron %u has a dihedral angle of %.2f degrees", i,
          acos(fmin(cosine, 1)) * 180 / 3.14159265358979);
  }
  find_duplicates(v, &level->lattice.tetrahedra, path);
  find_pieces(v, level, path);
}

void sbfi_check_lattices(sbfi_validation *v) {
  for (uint32_t b = 0; b < v->asset->soft_bodies.count; b++)
    for (uint32_t l = 0; l < v->asset->soft_bodies.at[b].levels.count && !v->out_of_memory; l++)
      check_lattice(v, &v->asset->soft_bodies.at[b].levels.at[l],
          sbfi_path_of("/sbf/soft_body[%u]/level[%u]/tetrahedron_mesh", b + 1, l + 1).text);
}
