/* The inside of a scene, for those who fill it (draw_scene.c and others) and who paint it (painter.c). */
#ifndef RENDER_DRAW_SCENE_DATA_H
#define RENDER_DRAW_SCENE_DATA_H

#include "render/draw_scene.h"

/* A list that grows and is never given back before the scene is. */
typedef struct draw_scene_list {
  void *at;
  size_t count, capacity;
} draw_scene_list;

/* Triangles with one look, consecutive in `indices`. */
typedef struct draw_scene_part {
  uint32_t first_index, index_count;
  sbf_vec3 middle;         /* to draw the far ones first */
  const draw_image *image; /* NULL: none */
  float transparency;
  draw_alpha alpha;
  float cutoff;
  bool one_sided, casts_shadow;
} draw_scene_part;

struct draw_scene {
  draw_scene_list positions, normals, colours; /* (vertices) sbf_vec3, sbf_vec3, colour; all in the world */
  draw_scene_list uvs;                         /* (vertices) sbf_vec2; 0 where there is no image */
  draw_scene_list smooth_normals;              /* sbf_vec3, of one mesh while it is added */
  draw_scene_list indices;                     /* uint32_t, three a triangle */
  draw_scene_list parts;                       /* draw_scene_part */
  draw_scene_list lines;                       /* draw_line */
  draw_scene_list sorted_lines;                /* draw_line, the farthest first: made by the painter */
  draw_scene_list marks;                       /* draw_line */
  draw_scene_list prints;                      /* draw_line */
  draw_scene_list mark_rims;                   /* draw_line, behind them: made by the painter */
  draw_scene_list line_corners;                /* draw_line, each four times: likewise */
  draw_scene_list sorted_parts;                /* uint32_t: parts seen through, the farthest first */
  draw_scene_list ground_positions, ground_normals, ground_indices;
  draw_scene_list overlay; /* draw_line; x and y from the picture's lower left corner, or where z is 1 from
                              its upper left one, in overlay units */
  uint32_t overlay_rows, note_rows;
  uint32_t veil_count;            /* parts seen through in the manner of an x-ray: made by the painter */
  bool overlay_from_top;          /* what is added is */
  draw_scene_list placed_overlay; /* draw_line, in the world: made by the painter */
  box3 bounds;
  box3 casters; /* of what throws a shadow */
  bool has_floor;
  float floor_height;
  bool failed; /* something found no memory */
};

/* Room for `count` more items after the last: where the first goes, or NULL (then the scene has failed). The
 * list's count grows with it. */
void *draw_scene_list_push(draw_scene *scene, draw_scene_list *list, size_t count, size_t item_size);

/* A solid part that throws a shadow, of `vertex_count` vertices and `triangle_count` triangles: where to
 * write them; the indices must be raised by `first_vertex`. False where there is no memory. */
typedef struct draw_scene_space {
  sbf_vec3 *positions, *normals;
  draw_colour *colours;
  sbf_vec2 *uvs; /* all 0 */
  uint32_t *indices;
  uint32_t first_vertex;
} draw_scene_space;
bool draw_scene_reserve(
    draw_scene *scene, uint32_t vertex_count, uint32_t triangle_count, draw_scene_space *space);

/* Closes what draw_scene_reserve opened: `index_count` indices were written from room->indices on. */
void draw_scene_close_part(draw_scene *scene, const draw_scene_space *space, uint32_t vertex_count,
    uint32_t index_count, const draw_scene_part *style);

void draw_scene_clear_ground(draw_scene *scene);

/* Smooth unit normals: each the sum of its triangles', weighted by their areas. */
void draw_scene_smooth_normals(const sbf_vec3 *positions, uint32_t vertex_count, const uint32_t *triangles,
    uint32_t index_count, sbf_vec3 *normals);

/* A pixel of a picture 720 high is one unit; in a smaller one no less than 0.7 pixels, so that words stay
 * legible. `width` and `height` are the picture's. */
void draw_scene_arrange_overlay(
    draw_scene *scene, const draw_camera *camera, uint32_t width, uint32_t height);

/* Fills mark_rims. */
void draw_scene_rim_marks(draw_scene *scene);

/* Fills sorted_lines and sorted_parts for an eye here; `back` as draw_camera_back. */
void draw_scene_sort(draw_scene *scene, sbf_vec3 eye, sbf_vec3 back);

#endif
