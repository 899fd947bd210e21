/* Flips inverted tetrahedra; removes flat and duplicate ones. A flat one has no mass and no energy; a
 * duplicate is dropped if its values equal the first's. */
#include "build/geometry/key_set.h"
#include "mechanics/vector.h"
#include "validate/repair/repair.h"

static double determinant(const sbf_vec3 *positions, const uint32_t p[4]) {
  sbfi_d3 origin = sbfi_d3_of(positions[p[0]]), edges[3];
  for (int k = 0; k < 3; k++) edges[k] = sbfi_d3_sub(sbfi_d3_of(positions[p[k + 1]]), origin);
  return sbfi_d3_dot(edges[0], sbfi_d3_cross(edges[1], edges[2]));
}

static bool is_same_value(sbf_f32_list values, uint32_t a, uint32_t b) {
  return values.count <= 1 || values.at[a] == values.at[b];
}

typedef struct counts {
  uint32_t inverted, first_inverted, flat, first_flat, repeated, first_repeated;
} counts;

static void count(uint32_t *number, uint32_t *first, uint32_t i) {
  if ((*number)++ == 0) *first = i;
}

static void check(const sbf_level *level, sbfi_key_set *known, uint8_t *dropped, counts *c) {
  const sbf_tetrahedron_mesh *mesh = &level->lattice;
  for (uint32_t i = 0; i < mesh->tetrahedra.count; i++) {
    uint32_t *p = ((sbf_uint4 *)sbfi_writable(mesh->tetrahedra.at))[i].at;
    double volume = determinant(level->positions.at, p);
    if (volume == 0) {
      dropped[i] = 1;
      count(&c->flat, &c->first_flat, i);
      continue;
    }
    if (volume < 0) {
      uint32_t swap = p[2];
      p[2] = p[3];
      p[3] = swap;
      count(&c->inverted, &c->first_inverted, i);
    }
    uint32_t *first = sbfi_key_set_find(known, sbfi_key_sorted((sbfi_key){{p[0], p[1], p[2], p[3]}}, 4));
    if (*first == UINT32_MAX) {
      *first = i;
    } else if (is_same_value(mesh->young_modulus, *first, i) &&
               is_same_value(mesh->reference_modulus, *first, i) &&
               is_same_value(mesh->densities, *first, i) &&
               is_same_value(mesh->stiffness_damping, *first, i)) {
      dropped[i] = 1;
      count(&c->repeated, &c->first_repeated, i);
    }
  }
}

/* A list with one value applies to all. */
static void drop_values(sbf_f32_list *values, const uint8_t *dropped) {
  if (values->count > 1) sbfi_list_drop(values, sizeof *values->at, dropped);
}

static void repair_level(sbfi_repair *m, sbf_level *level, const char *path) {
  sbf_tetrahedron_mesh *mesh = &level->lattice;
  uint32_t all = mesh->tetrahedra.count;
  counts c = {0};
  sbfi_key_set known;
  uint8_t *dropped = sbfi_repair_scratch(m, all, 1);
  if (!dropped || all == 0) return;
  if (!sbfi_key_set_init(&known, all, &m->scratch)) {
    m->out_of_memory = true;
    return;
  }
  check(level, &known, dropped, &c);
  if (c.flat + c.repeated) {
    sbfi_colors_drop(&mesh->color_counts, dropped, all);
    drop_values(&mesh->young_modulus, dropped);
    drop_values(&mesh->reference_modulus, dropped);
    drop_values(&mesh->densities, dropped);
    drop_values(&mesh->stiffness_damping, dropped);
    sbfi_list_drop(&mesh->tetrahedra, sizeof *mesh->tetrahedra.at, dropped);
  }
  sbfi_count_repair(m, SBF_CODE_TETRAHEDRON_INVERTED, c.inverted, path, c.first_inverted,
      "inverted tetrahedra reordered: %u", c.inverted);
  sbfi_count_repair(m, SBF_CODE_TETRAHEDRON_INVERTED, c.flat, path, c.first_flat,
      "tetrahedra without volume removed: %u", c.flat);
  sbfi_count_repair(m, SBF_CODE_TETRAHEDRON_DUPLICATE, c.repeated, path, c.first_repeated,
      "repeated tetrahedra removed: %u", c.repeated);
}

void sbfi_repair_tetrahedra(sbfi_repair *m) {
  for (uint32_t b = 0; b < m->asset->soft_bodies.count; b++)
    for (uint32_t l = 0; l < m->asset->soft_bodies.at[b].levels.count && !m->out_of_memory; l++) {
      sbfi_path path = sbfi_path_of("/sbf/soft_body[%u]/level[%u]/tetrahedron_mesh/tetrahedra", b + 1, l + 1);
      repair_level(m, sbfi_writable(&m->asset->soft_bodies.at[b].levels.at[l]), path.text);
    }
}
