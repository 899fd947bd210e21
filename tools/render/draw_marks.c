/* Marks: lines and dots on top of everything, with a pale rim; and prints, which are on the ground. */
#include "render/draw_scene_data.h"

enum { RING_SEGMENTS = 40 };

static const float full_turn = 6.28318531f;
static const float rim_width = 2.4f; /* sum of both sides */
/* fraction of a print's radius, so that the ground does not cut through it */
static const float lifted = 0.08f;

/* Adds a vertex without triangle, which framing includes. */
static void include_in_frame(draw_scene *scene, sbf_vec3 position) {
  draw_scene_space space;
  if (!draw_scene_reserve(scene, 1, 0, &space)) return;
  *space.positions = position;
  *space.normals = v3(0, 1, 0);
  *space.colours = (draw_colour){0, 0, 0, 0};
}

void draw_scene_add_mark(draw_scene *scene, const draw_line *mark) {
  draw_line *stored = draw_scene_list_push(scene, &scene->marks, 1, sizeof *stored);
  if (stored) *stored = *mark;
  include_in_frame(scene, mark->from);
  include_in_frame(scene, mark->to);
}

static void push_ring(draw_scene *scene, draw_scene_list *list, sbf_vec3 centre, sbf_vec3 normal,
    float radius, float width, draw_colour colour) {
  sbf_vec3 up = v3_unit(normal, v3(0, 1, 0)), right = v3_side(up), over = v3_cross(up, right);
  sbf_vec3 before = v3_add(centre, v3_scale(right, radius));
  draw_line *stored = draw_scene_list_push(scene, list, RING_SEGMENTS, sizeof *stored);
  for (int i = 1; stored && i <= RING_SEGMENTS; i++) {
    float angle = full_turn * (float)i / RING_SEGMENTS;
    sbf_vec3 out = v3_add(v3_scale(right, cosf(angle)), v3_scale(over, sinf(angle)));
    sbf_vec3 here = v3_add(centre, v3_scale(out, radius));
    *stored++ = (draw_line){before, here, colour, colour, width};
    before = here;
  }
}

void draw_scene_add_ring_mark(
    draw_scene *scene, sbf_vec3 centre, sbf_vec3 normal, float radius, float width, draw_colour colour) {
  push_ring(scene, &scene->marks, centre, normal, radius, width, colour);
}

void draw_scene_add_print(
    draw_scene *scene, sbf_vec3 centre, sbf_vec3 normal, float radius, float width, draw_colour colour) {
  sbf_vec3 above = v3_add(centre, v3_scale(v3_unit(normal, v3(0, 1, 0)), lifted * radius));
  push_ring(scene, &scene->prints, above, normal, radius, width, colour);
}

void draw_scene_rim_marks(draw_scene *scene) {
  static const draw_colour pale = {250, 250, 246, 255};
  const draw_line *marks = scene->marks.at;
  size_t count = scene->marks.count;
  scene->painted.mark_rims.count = 0;
  draw_line *rims = draw_scene_list_push(scene, &scene->painted.mark_rims, count, sizeof *rims);
  for (size_t i = 0; rims && i < count; i++)
    rims[i] = (draw_line){marks[i].from, marks[i].to, pale, pale, marks[i].width + rim_width};
}
