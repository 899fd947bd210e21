#include "skin/skin.h"

#include "kernels/kernels.h"
#include "math/quat.h"

void sbri_skin_vertices(const sbr_model *model, const sbri_skin *skin, const sbri_point *points,
    const sbr_transform *deltas, sbri_point *vertices) {
  model->kernels->vertices(skin, points, vertices);
  for (uint32_t i = 0; i < skin->frame_vertex_count; i++) {
    const sbri_frame_vertex *v = &skin->frame_vertices[i];
    sbf_vec3 sum = {0, 0, 0};
    for (uint32_t k = v->first; k < v->first + v->count; k++) {
      const sbr_transform *d = &deltas[skin->influences[k].frame];
      sbf_vec3 at = sbri_add(d->position, sbri_rotate(d->rotation, v->rest));
      sum = sbri_add_scaled(sum, at, skin->influences[k].weight);
    }
    vertices[v->vertex] = (sbri_point){sum.x, sum.y, sum.z, 0};
  }
}

/* Of the cones from the surface's first vertex: a third of the product of base vector and place. A quad
 * counts as its two triangles along the diagonal from its first corner. */
double sbri_skin_volume(const sbri_skin *skin, const sbri_point *vertices) {
  double six_fold = 0;
  if (skin->vertex_count == 0) return 0;
  const sbri_point *o = &vertices[0];
  for (uint32_t block = 0; block < skin->face_block_count; block++)
    for (int lane = 0; lane < SBRI_BLOCK; lane++) {
      const uint32_t(*corners)[SBRI_BLOCK] = skin->faces[block].corners;
      const sbri_point *p = &vertices[corners[0][lane]], *q = &vertices[corners[1][lane]];
      const sbri_point *r = &vertices[corners[2][lane]], *s = &vertices[corners[3][lane]];
      double ax = (double)r->x - p->x, ay = (double)r->y - p->y, az = (double)r->z - p->z;
      double bx = (double)s->x - q->x, by = (double)s->y - q->y, bz = (double)s->z - q->z;
      double x = (double)p->x - o->x, y = (double)p->y - o->y, z = (double)p->z - o->z;
      six_fold += x * (ay * bz - az * by) + y * (az * bx - ax * bz) + z * (ax * by - ay * bx);
    }
  return six_fold / 6;
}

double sbri_surface_volume(const sbri_character *c, const sbri_body *body, const sbri_point *points) {
  sbri_point *vertices = sbri_surface_vertices(c) + body->first_vertex;
  const sbri_skin surface = sbri_skin_now(c, &body->surface);
  sbri_skin_vertices(c->model, &surface, points, sbri_deltas(c), vertices);
  return sbri_skin_volume(&body->surface, vertices);
}

/* A surface that is open by no more than this share of its area, as by a stray triangle, still has a volume.
 */
static const double MOST_OPENING = 0.05;

bool sbri_rest_volumes_find(sbr_model *model) {
  sbfi_arena scratch;
  sbfi_arena_init(&scratch, &model->arena.allocator, 0);
  bool good = true;
  for (uint32_t b = 0; good && b < model->asset->soft_bodies.count; b++) {
    sbri_body *body = &model->bodies[b];
    uint32_t count = body->surface.vertex_count;
    sbf_surface_measures measures;
    sbf_surface_measure(&body->source->surface, NULL, &measures);
    if (count == 0 || measures.opening > MOST_OPENING || !(measures.volume > 0)) continue;
    sbri_point *vertices = sbfi_arena_allocate(&scratch, count, sizeof *vertices);
    good = vertices != NULL;
    for (uint32_t i = 0; good && i < count; i++) {
      sbf_vec3 p = body->source->surface.positions.at[i];
      vertices[i] = (sbri_point){p.x, p.y, p.z, 0};
    }
    if (!good) break;
    body->rest_volume_m3 = sbri_skin_volume(&body->surface, vertices);
    body->keeps_volume = body->source->attributes.pressure_mode == SBF_PRESSURE_MODE_VOLUME &&
                         body->rest_volume_m3 > 0 && body->level;
    if (body->keeps_volume) good = sbri_volume_table_make(model, body);
  }
  sbfi_arena_free(&scratch);
  return good;
}
