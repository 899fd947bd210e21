/* Blended items must be drawn from far to near. */
#include "render/draw_scene_data.h"

enum { BUCKET_COUNT = 1024 };

static float line_depth(const draw_line *line, sbf_vec3 eye, sbf_vec3 back) {
  return v3_dot(v3_sub(eye, v3_scale(v3_add(line->from, line->to), 0.5f)), back);
}

/* NaN goes to the front, where the painter skips it. */
static unsigned bucket_of(float depth, float farthest, float scale) {
  float coordinate = (farthest - depth) * scale;
  return coordinate >= 0 && coordinate < BUCKET_COUNT - 1 ? (unsigned)coordinate : BUCKET_COUNT - 1;
}

/* Counting sort in slices of a thousandth of the depth range: linear time, and lines in one slice keep
 * their order, so that they do not flicker. */
static void sort_lines(draw_scene *scene, sbf_vec3 eye, sbf_vec3 back) {
  const draw_line *lines = scene->lines.at;
  size_t count = scene->lines.count, starts[BUCKET_COUNT + 1] = {0};
  float nearest = INFINITY, farthest = -INFINITY;
  scene->painted.sorted_lines.count = 0;
  if (count == 0) return;
  draw_line *sorted = draw_scene_list_push(scene, &scene->painted.sorted_lines, count, sizeof *sorted);
  if (!sorted) return;
  for (size_t i = 0; i < count; i++) {
    float depth = line_depth(&lines[i], eye, back);
    nearest = fminf(nearest, depth), farthest = fmaxf(farthest, depth);
  }
  float scale = farthest > nearest ? BUCKET_COUNT / (farthest - nearest) : 0;
  for (size_t i = 0; i < count; i++)
    starts[bucket_of(line_depth(&lines[i], eye, back), farthest, scale) + 1]++;
  for (size_t i = 0; i < BUCKET_COUNT; i++) starts[i + 1] += starts[i];
  for (size_t i = 0; i < count; i++)
    sorted[starts[bucket_of(line_depth(&lines[i], eye, back), farthest, scale)]++] = lines[i];
}

/* They are few, so insertion sort is best. */
static void sort_parts(draw_scene *scene, sbf_vec3 eye, sbf_vec3 back) {
  const draw_scene_part *parts = scene->parts.at;
  scene->painted.sorted_parts.count = scene->painted.xray_count = 0;
  for (size_t i = 0; i < scene->parts.count; i++) {
    if (parts[i].transparency <= 0 && parts[i].alpha != DRAW_BLEND) continue;
    if (!draw_scene_list_push(scene, &scene->painted.sorted_parts, 1, sizeof(uint32_t))) return;
    scene->painted.xray_count += parts[i].transparency > 0;
    uint32_t *order = scene->painted.sorted_parts.at;
    size_t at = scene->painted.sorted_parts.count - 1;
    float depth = v3_dot(v3_sub(eye, parts[i].middle), back);
    for (; at > 0 && v3_dot(v3_sub(eye, parts[order[at - 1]].middle), back) < depth; at--)
      order[at] = order[at - 1];
    order[at] = (uint32_t)i;
  }
}

void draw_scene_sort(draw_scene *scene, sbf_vec3 eye, sbf_vec3 back) {
  sort_lines(scene, eye, back);
  sort_parts(scene, eye, back);
}
