/* Checks tetrahedra: well shaped, no duplicates, no overlaps, connected. Their orientation belongs to the
 * structural check. */
#include "base/union_find.h"
#include "build/geometry/key_set.h"
#include "mechanics/vector.h"
#include "validate/validation.h"

static const double MIN_DIHEDRAL_DEG = 5, DEG_IN_RAD = 57.29577951308232;

static const int faces[4][3] = {{1, 2, 3}, {0, 3, 2}, {0, 1, 3}, {0, 2, 1}}; /* facing outwards */

static sbfi_d3 face_normal(const sbf_vec3 *points, const uint32_t p[4], int face) {
  sbfi_d3 a = sbfi_d3_of(points[p[faces[face][0]]]), b = sbfi_d3_of(points[p[faces[face][1]]]),
          c = sbfi_d3_of(points[p[faces[face][2]]]);
  return sbfi_d3_cross(sbfi_d3_sub(b, a), sbfi_d3_sub(c, a));
}

/* Largest cosine of the six dihedral angles: the cosine of the sharpest. */
static double sharpest_cosine(const sbf_vec3 *points, const uint32_t p[4]) {
  sbfi_d3 n[4];
  double sharpest = -1;
  for (int f = 0; f < 4; f++) n[f] = sbfi_d3_normal(face_normal(points, p, f));
  for (int f = 0; f < 4; f++)
    for (int g = f + 1; g < 4; g++) sharpest = fmax(sharpest, -sbfi_d3_dot(n[f], n[g]));
  return sharpest;
}

static void find_slivers(sbfi_validation *v, const sbf_level *level, const char *path) {
  double limit = cos(MIN_DIHEDRAL_DEG / DEG_IN_RAD);
  for (uint32_t i = 0; i < level->lattice.tetrahedra.count; i++) {
    double cosine = sharpest_cosine(level->positions.at, level->lattice.tetrahedra.at[i].at);
    if (cosine > limit)
      sbfi_found(v, SBF_CODE_TETRAHEDRON_SLIVER, path, i,
          "tetrahedron %u has a dihedral angle of %.2f degrees", i, acos(fmin(cosine, 1)) * DEG_IN_RAD);
  }
}

/* Orientation of a sorted face in a tetrahedron: the two tetrahedra at a face have opposite ones. */
static bool faces_upwards(const uint32_t p[4], int face) {
  uint32_t a = p[faces[face][0]], b = p[faces[face][1]], c = p[faces[face][2]];
  return (a < b) + (b < c) + (c < a) == 2;
}

/* For each face, its first tetrahedron, and whether there was a second. */
typedef struct face_use {
  uint32_t first;
  bool upwards, full;
} face_use;

static void use_face(sbfi_validation *v, const sbf_uint4_list *tetrahedra, uint32_t i, int face,
    sbfi_key_set *set, face_use *uses, uint32_t *use_count, const char *path) {
  const uint32_t *p = tetrahedra->at[i].at;
  sbfi_key key = {{p[faces[face][0]], p[faces[face][1]], p[faces[face][2]], UINT32_MAX}};
  uint32_t *slots = sbfi_key_set_find(set, sbfi_key_sorted(key, 3));
  bool upwards = faces_upwards(p, face);
  if (*slots == UINT32_MAX) {
    *slots = (*use_count)++;
    uses[*slots] = (face_use){i, upwards, false};
    return;
  }
  face_use *use = &uses[*slots];
  if (use->full)
    sbfi_found(v, SBF_CODE_LATTICE_NONMANIFOLD, path, i,
        "tetrahedron %u is on a face that tetrahedron %u and another share already", i, use->first);
  else if (use->upwards == upwards)
    sbfi_found(v, SBF_CODE_LATTICE_OVERLAP, path, i,
        "tetrahedron %u lies on the same side of a face as tetrahedron %u", i, use->first);
  use->full = true;
}

/* Reports a duplicate tetrahedron only as that. */
static bool is_repeated(
    sbfi_validation *v, const sbf_uint4_list *tetrahedra, uint32_t i, sbfi_key_set *whole, const char *path) {
  const uint32_t *p = tetrahedra->at[i].at;
  uint32_t *first = sbfi_key_set_find(whole, sbfi_key_sorted((sbfi_key){{p[0], p[1], p[2], p[3]}}, 4));
  if (*first == UINT32_MAX) *first = i;
  if (*first != i)
    sbfi_found(v, SBF_CODE_TETRAHEDRON_DUPLICATE, path, i, "tetrahedron %u has the points of tetrahedron %u",
        i, *first);
  return *first != i;
}

static void find_overlaps(sbfi_validation *v, const sbf_uint4_list *tetrahedra, const char *path) {
  sbfi_key_set shared, whole;
  uint32_t use_count = 0;
  face_use *uses = sbfi_scratch(v, 4 * (size_t)tetrahedra->count, sizeof *uses);
  if (!uses) return;
  if (!sbfi_key_set_init(&shared, 4 * (size_t)tetrahedra->count, &v->scratch) ||
      !sbfi_key_set_init(&whole, tetrahedra->count, &v->scratch)) {
    v->out_of_memory = true;
    return;
  }
  for (uint32_t i = 0; i < tetrahedra->count; i++) {
    if (is_repeated(v, tetrahedra, i, &whole, path)) continue;
    for (int face = 0; face < 4; face++) use_face(v, tetrahedra, i, face, &shared, uses, &use_count, path);
  }
}

static void find_pieces(sbfi_validation *v, const sbf_level *level, const char *path) {
  uint32_t n = level->positions.count, pieces = 0, unused = 0;
  uint32_t *parents = sbfi_scratch(v, n, sizeof *parents);
  uint8_t *used = sbfi_scratch(v, n, 1);
  if (!parents || !used) return;
  sbfi_sets_begin(parents, n);
  for (uint32_t t = 0; t < level->lattice.tetrahedra.count; t++)
    for (int k = 0; k < 4; k++) {
      const uint32_t *p = level->lattice.tetrahedra.at[t].at;
      used[p[k]] = 1;
      sbfi_sets_join(parents, p[k], p[0]);
    }
  for (uint32_t i = 0; i < n; i++) {
    unused += !used[i];
    pieces += used[i] && parents[i] == i;
  }
  if (pieces > 1)
    sbfi_found(v, SBF_CODE_LATTICE_PIECES, path, -1, "the lattice consists of %u pieces", pieces);
  if (unused && level->springs.count == 0)
    sbfi_found(v, SBF_CODE_LATTICE_POINT_UNUSED, path, -1, "%u point%s in no tetrahedron", unused,
        unused == 1 ? " is" : "s are");
}

static void check_lattice(sbfi_validation *v, const sbf_level *level, const char *path) {
  sbfi_path tetrahedra = sbfi_path_of("%s/tetrahedra", path);
  if (level->lattice.tetrahedra.count == 0) {
    if (level->model == SBF_ELASTIC_MODEL_TETRAHEDRA)
      sbfi_found(v, SBF_CODE_LEVEL_EMPTY, path, -1, "the level's model is tetrahedra, but it has none");
    return;
  }
  find_slivers(v, level, tetrahedra.text);
  find_overlaps(v, &level->lattice.tetrahedra, tetrahedra.text);
  find_pieces(v, level, path);
}

void sbfi_check_lattices(sbfi_validation *v) {
  for (uint32_t b = 0; b < v->asset->soft_bodies.count; b++)
    for (uint32_t l = 0; l < v->asset->soft_bodies.at[b].levels.count && !v->out_of_memory; l++)
      check_lattice(v, &v->asset->soft_bodies.at[b].levels.at[l],
          sbfi_path_of("/sbf/soft_body[%u]/level[%u]/tetrahedron_mesh", b + 1, l + 1).text);
}
