#include "build/materials/point_factors.h"

#include <math.h>
#include <string.h>

#include "build/geometry/triangle_tree.h"

typedef struct point_set {
  const sbf_soft_body *body;
  sbfi_triangle_tree surface;
  sbfi_box_tree interior;
} point_set;

static void load(sbf_vec3 from, double to[3]) {
  to[0] = from.x, to[1] = from.y, to[2] = from.z;
}

static double interior_distance(const void *user, uint32_t item, const double point[3]) {
  double at[3], sum = 0;
  load(((const point_set *)user)->body->interior.at[item], at);
  for (int k = 0; k < 3; k++) sum += (at[k] - point[k]) * (at[k] - point[k]);
  return sum;
}

static bool find_positions(point_set *p, sbfi_arena *scratch) {
  const sbf_vec3_list *interior = &p->body->interior;
  sbfi_box *boxes = sbfi_arena_allocate(scratch, (size_t)interior->count + 1, sizeof *boxes);
  if (!boxes || !sbfi_triangle_tree_build(&p->surface, &p->body->surface, scratch)) return false;
  for (uint32_t i = 0; i < interior->count; i++) {
    memcpy(boxes[i].low, &interior->at[i], sizeof boxes[i].low);
    memcpy(boxes[i].high, &interior->at[i], sizeof boxes[i].high);
  }
  return sbfi_box_tree_build(&p->interior, boxes, interior->count, scratch);
}

/* Source points at a position, with weights; an interior point has only the first. */
typedef struct sources {
  uint32_t points[3];
  double weights[3];
} sources;

static sources sources_of(const point_set *p, sbf_vec3 position) {
  const sbf_polygon_mesh *mesh = &p->body->surface;
  sources found = {{0, 0, 0}, {1, 0, 0}};
  double at[3], corners[3][3], min = INFINITY;
  load(position, at);
  uint32_t triangle = sbfi_triangle_tree_nearest(&p->surface, position, &min);
  uint32_t inside = p->interior.item_count
                        ? sbfi_box_tree_nearest(&p->interior, at, interior_distance, p, &min)
                        : UINT32_MAX;
  if (inside != UINT32_MAX) {
    found.points[0] = mesh->positions.count + inside;
  } else if (triangle != UINT32_MAX) {
    memcpy(found.points, p->surface.triangles[triangle].points, sizeof found.points);
    for (int k = 0; k < 3; k++) load(mesh->positions.at[found.points[k]], corners[k]);
    sbfi_triangle_closest(corners[0], corners[1], corners[2], at, found.weights);
  }
  return found;
}

bool sbfi_point_factors(const sbf_soft_body *body, const sbf_level *level, sbf_weight_property property,
    sbfi_arena *scratch, float **factors) {
  point_set p = {.body = body};
  uint32_t maps = 0;
  *factors = NULL;
  for (uint32_t m = 0; m < body->weight_maps.count; m++)
    maps += body->weight_maps.at[m].property == property && body->weight_maps.at[m].values.count > 0;
  if (maps == 0) return true;
  float *made = sbfi_arena_allocate(scratch, (size_t)level->positions.count + 1, sizeof *made);
  if (!made || !find_positions(&p, scratch)) return false;
  for (uint32_t i = 0; i < level->positions.count; i++) {
    sources from = sources_of(&p, level->positions.at[i]);
    made[i] = 1;
    for (uint32_t m = 0; m < body->weight_maps.count; m++) {
      const sbf_weight_map *map = &body->weight_maps.at[m];
      if (map->property != property || map->values.count == 0) continue;
      double factor = 0;
      for (int k = 0; k < 3; k++) factor += from.weights[k] * map->values.at[from.points[k]];
      made[i] *= (float)factor;
    }
  }
  *factors = made;
  return true;
}

/* `whole` times each tetrahedron's mean factor, at least `min` of it. */
static bool spread(const sbf_level *level, const float *factors, double whole, double min, sbf_asset *asset,
    sbf_f32_list *list) {
  const sbf_uint4_list *at = &level->lattice.tetrahedra;
  float *values = sbf_asset_allocate(asset, at->count, sizeof *values);
  if (!values) return false;
  for (uint32_t t = 0; t < at->count; t++) {
    double sum = 0;
    for (int k = 0; k < 4; k++) sum += factors[at->at[t].at[k]];
    values[t] = (float)(whole * fmax(sum / 4, min));
  }
  *list = (sbf_f32_list){values, at->count};
  return true;
}

/* Minimum factor: files must not contain moduli and densities of 0. */
static const double min = 1e-6;

bool sbfi_lattice_weigh(sbf_level *level, const sbf_soft_body *body, sbf_asset *asset, sbfi_arena *scratch) {
  sbf_tetrahedron_mesh *lattice = &level->lattice;
  float *moduli, *densities, *dampings;
  double damping = body->attributes.stiffness_damping;
  if (lattice->tetrahedra.count == 0) return true;
  if (!sbfi_point_factors(body, level, SBF_WEIGHT_PROPERTY_YOUNG_MODULUS, scratch, &moduli) ||
      !sbfi_point_factors(body, level, SBF_WEIGHT_PROPERTY_DENSITY, scratch, &densities) ||
      !sbfi_point_factors(body, level, SBF_WEIGHT_PROPERTY_STIFFNESS_DAMPING, scratch, &dampings))
    return false;
  double density = lattice->densities.count ? lattice->densities.at[0] : body->attributes.density;
  if (moduli) {
    if (!spread(level, moduli, body->attributes.young_modulus, min, asset, &lattice->young_modulus))
      return false;
    lattice->reference_modulus = lattice->young_modulus;
  }
  if (dampings && damping > 0 && !spread(level, dampings, damping, 0, asset, &lattice->stiffness_damping))
    return false;
  return !densities || spread(level, densities, density, min, asset, &lattice->densities);
}
