#include "skin/skin.h"

#include "model/kernels.h"

void sbri_skin_compute_vertices(const sbr_model *model, const sbri_skin *skin, const sbri_point *points,
    const sbri_delta *deltas, sbri_point *vertices) {
  model->kernels->vertices(skin, points, vertices);
  for (uint32_t i = 0; i < skin->frame_vertex_count; i++) {
    const sbri_frame_vertex *v = &skin->frame_vertices[i];
    sbf_vec3 sum = {0, 0, 0};
    for (uint32_t k = v->first; k < v->first + v->count; k++) {
      sbf_vec3 at = sbri_delta_position(&deltas[skin->influences[k].frame], v->rest);
      sum = sbri_add_scaled(sum, at, skin->influences[k].weight);
    }
    vertices[v->vertex] = (sbri_point){sum.x, sum.y, sum.z, 0};
  }
}

/* Sum of the cones from the surface's first vertex: a third of the dot product of base vector and position. A
 * quad counts as its two triangles along the diagonal from its first corner. */
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
