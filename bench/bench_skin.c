/* Measures the cost of a frame's skin at each render level: positions and normals of the vertices of the
 * level. Characters of ../shared/data if that folder exists, else our lizard only. */
#include <stdlib.h>

#include "measured_assets.h"
#include "measuring.h"
#include "sbfmt/build.h"
#include "sbrun/sbrun.h"

enum { LEVELS = 4, CALLS = 50 };

typedef struct clothed {
  sbf_asset *asset;
  sbr_model *model;
  sbr_world *world;
  sbr_character_id character;
  sbf_vec3 *buffer; /* positions, then normals */
  uint32_t vertex_count;
} clothed;

typedef struct skin_case {
  const clothed *of;
  uint32_t level;
} skin_case;

static void run(void *context) {
  const skin_case *c = context;
  const clothed *w = c->of;
  for (int call = 0; call < CALLS; call++)
    for (uint32_t m = 0; m < w->asset->render_meshes.count; m++)
      sbr_character_get_level_skin(
          w->world, w->character, m, c->level, w->buffer, w->buffer + w->vertex_count, NULL, w->vertex_count);
}

static void clothe(clothed *w, sbf_asset *source) {
  const sbf_build_options options = {.render_levels = LEVELS};
  sbf_diagnostic error;
  sbr_world_definition world = sbr_default_world_definition();
  sbr_character_definition standing = sbr_default_character_definition();
  bench_require(sbf_build(source, &options, &w->asset, NULL, &error), &error);
  sbf_asset_free(source);
  bench_require(sbr_model_create(w->asset, NULL, &w->model, &error), &error);
  bench_require(sbr_world_create(&world, &w->world, &error), &error);
  bench_require(sbr_character_create(w->world, w->model, &standing, &w->character, &error), &error);
  sbr_world_tick(w->world);
  w->vertex_count = vertex_count_of(w->asset);
  w->buffer = bench_allocate(2 * (size_t)w->vertex_count, sizeof *w->buffer);
}

static void measure(const char *name, sbf_asset *source, uint32_t rounds) {
  clothed w;
  skin_case contexts[LEVELS + 1];
  bench_case cases[LEVELS + 1];
  clothe(&w, source);
  uint32_t levels = w.asset->render_meshes.at[0].levels.count;
  for (uint32_t l = 0; l <= levels; l++) {
    contexts[l] = (skin_case){&w, l};
    cases[l] = (bench_case){.run = run, .context = &contexts[l]};
  }
  bench_rounds(cases, levels + 1, rounds);
  for (uint32_t l = 0; l <= levels; l++) {
    uint32_t triangles = 0, vertices = 0;
    for (uint32_t m = 0; m < w.asset->render_meshes.count; m++) {
      const sbf_render_mesh *mesh = &w.asset->render_meshes.at[m];
      if (l > mesh->levels.count) continue;
      const sbf_u32_list *points = l ? &mesh->levels.at[l - 1].polygon_points : &mesh->mesh.polygon_points;
      const sbf_u32_list *sizes = l ? &mesh->levels.at[l - 1].polygon_sizes : &mesh->mesh.polygon_sizes;
      triangles += points->count - 2 * sizes->count;
      vertices += sbr_model_get_level_vertices(w.model, m, l, NULL, 0);
    }
    bench_print_row("%s,%u,%u,%u,%.2f,%.2f,%.3f", name, l, triangles, vertices, cases[l].s.min * 1e6 / CALLS,
        cases[l].s.median * 1e6 / CALLS, cases[l].s.min / cases[0].s.min);
  }
  sbr_world_destroy(w.world);
  sbr_model_destroy(w.model);
  sbf_asset_free(w.asset);
  free(w.buffer);
}

int main(int argument_count, char **arguments) {
  static const char *const meshes[][2] = {{SHARED_FOLDER "/armadillo", "armadillo_25k.obj"},
      {SHARED_FOLDER "/spot", "spot.obj"}, {SHARED_FOLDER "/kenney-fbx", "kenney_character.fbx"},
      {SHARED_FOLDER "/fox", "fox.glb"}};
  bool quick = bench_is_quick(argument_count, arguments);
  bench_print_columns("mesh,level,triangles,vertices,least_us,median_us,of_full");
  if (quick) {
    measure("our lizard", our_lizard(false), 1);
    return 0;
  }
  for (size_t i = 0; i < sizeof meshes / sizeof *meshes; i++) {
    sbf_asset *source = character_asset(meshes[i][0], meshes[i][1], NULL, false);
    if (source) measure(meshes[i][1], source, bench_round_count(25));
  }
  return 0;
}
