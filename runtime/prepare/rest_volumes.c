/* Rest volumes of soft bodies, and which bodies keep their volume. */
#include "prepare/prepare.h"

#include "skin/skin.h"

/* Maximum opening of a surface that still has a volume, as a fraction of its area: a missing triangle. */
static const double MAX_OPENING = 0.05;

bool sbri_rest_volumes_find(sbr_model *model) {
  sbfi_arena scratch;
  sbfi_arena_init(&scratch, &model->arena.allocator, 0);
  bool good = true;
  for (uint32_t b = 0; good && b < model->asset->soft_bodies.count; b++) {
    sbri_body *body = &model->bodies[b];
    uint32_t count = body->surface.skin.vertex_count;
    sbf_surface_measures measures;
    sbf_surface_measure(&body->source->surface, NULL, &measures);
    if (count == 0 || measures.opening > MAX_OPENING || !(measures.volume > 0)) continue;
    sbri_point *vertices = sbfi_arena_allocate(&scratch, count, sizeof *vertices);
    good = vertices != NULL;
    for (uint32_t i = 0; good && i < count; i++) {
      sbf_vec3 p = body->source->surface.positions.at[i];
      vertices[i] = (sbri_point){p.x, p.y, p.z, 0};
    }
    if (!good) break;
    body->surface.rest_volume_m3 = sbri_skin_volume(&body->surface.skin, vertices);
    body->volume.is_preserved = body->source->attributes.pressure_mode == SBF_PRESSURE_MODE_VOLUME &&
                                body->surface.rest_volume_m3 > 0 && body->level;
    if (body->volume.is_preserved) good = sbri_volume_table_make(model, body);
  }
  sbfi_arena_free(&scratch);
  return good;
}
