#include "detail_scenes.h"

#include <math.h>
#include <stdlib.h>

#include "harness.h"

static const sbf_vec3 MIDDLE = {0, 1, 0}, SIZE = {0.4f, 0.2f, 0.2f};

static sbf_level make_lattice(scene *s, uint32_t cells, float error_m, bool loose) {
  sbf_vec3 low = {MIDDLE.x - SIZE.x / 2, MIDDLE.y - SIZE.y / 2, MIDDLE.z - SIZE.z / 2};
  lattice_box box = lattice_box_make(low, SIZE, 2 * cells, cells, cells, 1000, 3e5f, 0.4f);
  sbf_level *level = scene_lattice(s, 0, &box);
  uint32_t *pinned = calloc(box.point_count, sizeof *pinned), count = 0;
  for (uint32_t i = 0; i < box.point_count; i++)
    if (box.positions[i].x < low.x + 1e-4f) pinned[count++] = i;
  if (!loose) scene_pin(s, level, 0, pinned, count);
  scene_embed(s, level, &box);
  sbf_embedding *both = sbf_asset_allocate(s->asset, 2, sizeof *both);
  both[0] = both[1] = level->embeddings.at[0];
  both[1].render_mesh = 0;
  level->embeddings = (sbf_embedding_list){both, 2};
  level->simulation.error = error_m;
  sbf_level made = *level;
  free(pinned);
  lattice_box_free(&box);
  return made;
}

static sbf_level make_jiggle(scene *s) {
  sbf_level level;
  sbf_level_init(&level);
  sbf_vec3 *middle = sbf_asset_allocate(s->asset, 1, sizeof *middle);
  sbf_jiggle *jiggle = sbf_asset_allocate(s->asset, 1, sizeof *jiggle);
  sbf_jiggle_init(jiggle);
  *middle = MIDDLE;
  jiggle->frequency = 4;
  jiggle->damping_ratio = 0.3f;
  jiggle->response = 2;
  level.model = SBF_ELASTIC_MODEL_JIGGLE;
  level.positions = (sbf_vec3_list){middle, 1};
  level.jiggle = jiggle;
  level.simulation.error = 0.02f;
  return level;
}

scene detail_scene_begin(bool loose) {
  scene s = scene_begin();
  scene_bone(&s, MIDDLE);
  scene_section(&s, 0, MIDDLE, SIZE, 4);
  scene_skin(&s, 0);
  sbf_level *levels = sbf_asset_allocate(s.asset, 3, sizeof *levels);
  levels[0] = make_lattice(&s, 3, 0, loose);
  levels[1] = make_lattice(&s, 1, 0.01f, loose);
  levels[2] = make_jiggle(&s);
  scene_body(&s, 0)->levels = (sbf_level_list){levels, 3};
  scene_body(&s, 0)->attributes.damping_ratio = 0.3f;
  s.model_options.detail_levels = true;
  return s;
}

scene detail_scene_walking(uint32_t detail_level) {
  scene s = detail_scene_begin(false);
  scene_start(&s);
  sbr_character_set_detail_level(s.world, s.character, detail_level);
  sbr_character_set_drive(s.world, s.character, 0.5f, 0, 0.8f);
  scene_ticks(&s, 90);
  return s;
}

uint32_t detail_scene_skin(const scene *s, sbf_vec3 *positions) {
  sbr_double3 origin = sbr_character_get_origin(s->world, s->character);
  uint32_t count = sbr_character_get_skin(s->world, s->character, 0, positions, NULL, NULL, RUNG_VERTICES);
  ck_assert_uint_le(count, RUNG_VERTICES);
  for (uint32_t v = 0; v < count; v++) {
    positions[v].x += (float)origin.x, positions[v].y += (float)origin.y;
    positions[v].z += (float)origin.z;
  }
  return count;
}

double detail_scene_farthest(const sbf_vec3 *a, const sbf_vec3 *b, uint32_t count) {
  double max = 0;
  for (uint32_t v = 0; v < count; v++) {
    double x = (double)a[v].x - (double)b[v].x, y = (double)a[v].y - (double)b[v].y;
    double z = (double)a[v].z - (double)b[v].z;
    double square = x * x + y * y + z * z;
    if (square > max) max = square; /* fmax here breaks gcc 12 for aarch64 */
  }
  return sqrt(max);
}

double detail_scene_apart(const scene *a, const scene *b) {
  static sbf_vec3 of_a[RUNG_VERTICES], of_b[RUNG_VERTICES];
  uint32_t count = detail_scene_skin(a, of_a);
  ck_assert_uint_eq(detail_scene_skin(b, of_b), count);
  return detail_scene_farthest(of_a, of_b, count);
}

void detail_scene_ticks(scene *a, scene *b, int ticks) {
  scene_ticks(a, ticks);
  scene_ticks(b, ticks);
}

double detail_scene_elastic(const scene *s) {
  return sbr_character_get_body_health(s->world, s->character, 0).elastic_j;
}

double detail_scene_kinetic(const scene *s) {
  return sbr_character_get_body_health(s->world, s->character, 0).kinetic_j;
}
