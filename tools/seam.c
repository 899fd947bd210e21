#include "seam.h"

#include <math.h>
#include <stdlib.h>

typedef struct location {
  sbf_vec3 at;
  uint32_t mesh, vertex; /* index in the skin */
} location;

struct seams {
  location *sorted; /* sorted by mesh and rest position, ties by vertex */
  uint32_t count;
  double gap_m;
};

static int by_position(const void *a, const void *b) {
  const location *p = a, *q = b;
  if (p->mesh != q->mesh) return p->mesh < q->mesh ? -1 : 1;
  if (p->at.x != q->at.x) return p->at.x < q->at.x ? -1 : 1;
  if (p->at.y != q->at.y) return p->at.y < q->at.y ? -1 : 1;
  if (p->at.z != q->at.z) return p->at.z < q->at.z ? -1 : 1;
  return p->vertex < q->vertex ? -1 : p->vertex > q->vertex;
}

static bool is_same_position(const location *p, const location *q) {
  return p->mesh == q->mesh && p->at.x == q->at.x && p->at.y == q->at.y && p->at.z == q->at.z;
}

seams *seams_create(const session *s) {
  seams *all = calloc(1, sizeof *all);
  uint32_t count = 0;
  if (!all) return NULL;
  for (uint32_t m = 0; m < s->asset->render_meshes.count; m++)
    count += s->asset->render_meshes.at[m].mesh.positions.count;
  all->sorted = malloc(((size_t)count + 1) * sizeof *all->sorted);
  if (!all->sorted) return free(all), NULL;
  for (uint32_t m = 0; m < s->asset->render_meshes.count; m++) {
    const sbf_vec3_list at = s->asset->render_meshes.at[m].mesh.positions;
    for (uint32_t v = 0; v < at.count; v++, all->count++)
      all->sorted[all->count] = (location){at.at[v], m, all->count};
  }
  qsort(all->sorted, all->count, sizeof *all->sorted, by_position);
  return all;
}

void seams_destroy(seams *all) {
  if (all) free(all->sorted);
  free(all);
}

void seams_measure(seams *all, const sbf_vec3 *skin) {
  for (uint32_t i = 1, first = 0; all && i < all->count; i++) {
    if (!is_same_position(&all->sorted[first], &all->sorted[i])) {
      first = i;
      continue;
    }
    sbf_vec3 p = skin[all->sorted[first].vertex], q = skin[all->sorted[i].vertex];
    double x = (double)p.x - (double)q.x, y = (double)p.y - (double)q.y, z = (double)p.z - (double)q.z;
    all->gap_m = fmax(all->gap_m, sqrt(x * x + y * y + z * z));
  }
}

double seams_gap(const seams *all) {
  return all ? all->gap_m : 0;
}
