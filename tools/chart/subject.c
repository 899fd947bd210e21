#include "chart/subject.h"

/* A body of points with springs between them, some of which are pinned. */
static sbf_asset *make(const sbf_vec3 *points, uint32_t count, float mass_kg, const sbf_uint2 *ends,
    uint32_t spring_count, float stiffness, const uint32_t *pinned, uint32_t pinned_count) {
  sbf_asset *asset = sbf_asset_create(NULL);
  if (!asset) return NULL;
  sbf_soft_body *body = sbf_asset_allocate(asset, 1, sizeof *body);
  sbf_level *level = sbf_asset_allocate(asset, 1, sizeof *level);
  sbf_spring_set *set = sbf_asset_allocate(asset, 1, sizeof *set);
  sbf_pin_set *pins = sbf_asset_allocate(asset, 1, sizeof *pins);
  sbf_vec3 *positions = sbf_asset_allocate(asset, count, sizeof *positions);
  float *masses = sbf_asset_allocate(asset, count, sizeof *masses);
  sbf_uint2 *springs = sbf_asset_allocate(asset, spring_count, sizeof *springs);
  float *strength = sbf_asset_allocate(asset, 1, sizeof *strength);
  uint32_t *holds = sbf_asset_allocate(asset, pinned_count, sizeof *holds);
  if (!body || !level || !set || !pins || !positions || !masses || !springs || !strength || !holds) {
    sbf_asset_free(asset);
    return NULL;
  }
  sbf_soft_body_init(body), sbf_level_init(level), sbf_spring_set_init(set), sbf_pin_set_init(pins);
  for (uint32_t i = 0; i < count; i++) positions[i] = points[i], masses[i] = mass_kg;
  for (uint32_t i = 0; i < spring_count; i++) springs[i] = ends[i];
  for (uint32_t i = 0; i < pinned_count; i++) holds[i] = pinned[i], masses[pinned[i]] = 0;
  *strength = stiffness;
  body->id = "body";
  body->attributes.damping_ratio = 0;
  set->ends = (sbf_uint2_list){springs, spring_count};
  set->stiffness = (sbf_f32_list){strength, 1};
  pins->points = (sbf_u32_list){holds, pinned_count};
  level->positions = (sbf_vec3_list){positions, count};
  level->masses = (sbf_f32_list){masses, count};
  level->springs = (sbf_spring_set_list){set, 1};
  level->pins = (sbf_pin_set_list){pins, 1};
  body->levels = (sbf_level_list){level, 1};
  asset->soft_bodies = (sbf_soft_body_list){body, 1};
  return asset;
}

sbf_asset *chart_mass_on_spring(float mass_kg, float stiffness) {
  return make((const sbf_vec3[]){{0, 0, 0}, {0, -1, 0}}, 2, mass_kg, &(sbf_uint2){{0, 1}}, 1, stiffness,
      &(uint32_t){0}, 1);
}

sbf_asset *chart_pinned_chain(uint32_t count, float length_m, float mass_kg, float stiffness) {
  enum { MAX = 256 };
  sbf_vec3 points[MAX + 2];
  sbf_uint2 ends[MAX + 1];
  if (count > MAX) count = MAX;
  for (uint32_t i = 0; i < count + 2; i++) points[i] = (sbf_vec3){0, -length_m * (float)i, 0};
  for (uint32_t i = 0; i < count + 1; i++) ends[i] = (sbf_uint2){{i, i + 1}};
  return make(points, count + 2, mass_kg, ends, count + 1, stiffness, (const uint32_t[]){0, count + 1}, 2);
}

sbf_asset *chart_hung_chain(uint32_t count, float length_m, float mass_kg, float end_kg, float stiffness) {
  enum { MAX = 256 };
  sbf_vec3 points[MAX + 1];
  sbf_uint2 ends[MAX];
  if (count > MAX) count = MAX;
  for (uint32_t i = 0; i < count + 1; i++) points[i] = (sbf_vec3){0, -length_m * (float)i, 0};
  for (uint32_t i = 0; i < count; i++) ends[i] = (sbf_uint2){{i, i + 1}};
  sbf_asset *asset = make(points, count + 1, mass_kg, ends, count, stiffness, &(uint32_t){0}, 1);
  if (asset) ((float *)(uintptr_t)asset->soft_bodies.at[0].levels.at[0].masses.at)[count] = end_kg;
  return asset;
}

sbf_asset *chart_level_pendulum(float length_m, float mass_kg, float stiffness) {
  return make((const sbf_vec3[]){{0, 0, 0}, {length_m, 0, 0}}, 2, mass_kg, &(sbf_uint2){{0, 1}}, 1, stiffness,
      &(uint32_t){0}, 1);
}

uint32_t chart_elements_of(const sbf_soft_body *body) {
  if (!body->levels.count) return 0;
  const sbf_level *level = &body->levels.at[0];
  bool springs = level->model == SBF_ELASTIC_MODEL_SPRINGS;
  uint32_t count = 0;
  if (level->model == SBF_ELASTIC_MODEL_TETRAHEDRA) count += level->lattice.tetrahedra.count;
  if (level->model == SBF_ELASTIC_MODEL_SHAPE_MATCHING && level->regions)
    count += level->regions->sizes.count;
  for (uint32_t i = 0; i < level->springs.count; i++)
    if (springs || level->springs.at[i].extra) count += level->springs.at[i].ends.count;
  return count;
}

uint32_t chart_all_elements_of(const sbf_asset *asset) {
  uint32_t count = 0;
  for (uint32_t b = 0; b < asset->soft_bodies.count; b++)
    count += chart_elements_of(&asset->soft_bodies.at[b]);
  return count;
}
