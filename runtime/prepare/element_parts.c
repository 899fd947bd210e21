/* Division of the tetrahedra of a large island into compact parts, so that few points belong to several: each
 * part is halved across its longest extent, between layers of elements where there are any. */
#include <string.h>

#include "prepare/island_maker.h"

/* Below these numbers of tetrahedra in an island and in a part, starting tasks costs more than it saves. */
enum { MIN_DIVIDED = 28000, MIN_PART = 8000 };

/* Layers in which the centres of a part are counted to find where it is halved. */
enum { LAYERS = 256 };

typedef struct division {
  const sbri_island *island;
  const sbf_uint4 *corners; /* slots */
  uint32_t *ordered, *behind;
} division;

/* Four times the coordinate of the element's centre. */
static float center_of(const division *d, uint32_t element, int axis) {
  float sum = 0;
  for (int k = 0; k < 4; k++) {
    const sbri_point *p = &d->island->rest[d->corners[element].at[k]];
    sum += axis == 0 ? p->x : axis == 1 ? p->y : p->z;
  }
  return sum;
}

typedef struct cut {
  int axis;
  float low, scale;
  uint32_t layer; /* elements in earlier layers are in front */
} cut;

static uint32_t layer_of(const division *d, const cut *c, uint32_t element) {
  float layer = (center_of(d, element, c->axis) - c->low) * c->scale;
  return layer < LAYERS - 1 ? (uint32_t)layer : LAYERS - 1;
}

static cut cut_of(const division *d, uint32_t begin, uint32_t end) {
  cut c = {0, 0, 0, 0};
  float longest = -1;
  for (int axis = 0; axis < 3; axis++) {
    float low = center_of(d, d->ordered[begin], axis), high = low;
    for (uint32_t i = begin + 1; i < end; i++) {
      float x = center_of(d, d->ordered[i], axis);
      low = x < low ? x : low, high = x > high ? x : high;
    }
    if (!(high - low > longest)) continue;
    longest = high - low;
    c.axis = axis, c.low = low, c.scale = longest > 0 ? LAYERS / longest : 0;
  }
  uint32_t counts[LAYERS] = {0}, front = 0, half = (end - begin) / 2;
  for (uint32_t i = begin; i < end; i++) counts[layer_of(d, &c, d->ordered[i])]++;
  while (front + counts[c.layer] / 2 < half) front += counts[c.layer++];
  return c;
}

/* Moves the front half before the other and keeps the order in each. Returns where the other begins. */
static uint32_t halve(const division *d, uint32_t begin, uint32_t end) {
  cut c = cut_of(d, begin, end);
  uint32_t front = begin, behind = 0;
  for (uint32_t i = begin; i < end; i++) {
    uint32_t element = d->ordered[i];
    if (layer_of(d, &c, element) < c.layer)
      d->ordered[front++] = element;
    else
      d->behind[behind++] = element;
  }
  memcpy(d->ordered + front, d->behind, behind * sizeof *d->ordered);
  return front;
}

bool sbri_element_parts_find(
    sbri_island_maker *m, const sbf_uint4 *corners, uint32_t *ordered, sbri_element_parts *parts) {
  uint32_t count = m->island->tetrahedra.count;
  for (uint32_t t = 0; t < count; t++) ordered[t] = t;
  *parts = (sbri_element_parts){1, {0, count}};
  if (count < MIN_DIVIDED) return true;
  division d = {m->island, corners, ordered, sbri_scratch(m, count, sizeof *d.behind)};
  if (!d.behind) return false;
  while (2 * parts->count <= SBRI_MAX_PARTS && count >= 2 * parts->count * MIN_PART) {
    for (uint32_t p = parts->count; p > 0; p--) parts->begins[2 * p] = parts->begins[p];
    parts->count *= 2;
    for (uint32_t p = 0; p < parts->count; p += 2)
      parts->begins[p + 1] = halve(&d, parts->begins[p], parts->begins[p + 2]);
  }
  return true;
}
