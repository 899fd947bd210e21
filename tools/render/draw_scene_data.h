/* Internals of a scene, for the code that fills it (draw_scene.c and others) and paints it (painter.c). */
#ifndef RENDER_DRAW_SCENE_DATA_H
#define RENDER_DRAW_SCENE_DATA_H

#include "render/draw_scene.h"

/* A growing list whose memory is kept until the scene is freed. */
typedef struct draw_scene_list {
  void *at;
  size_t count, capacity;
} draw_scene_list;

/* Triangles with one look, contiguous in `indices`. */
typedef struct draw_scene_part {
  uint32_t first_index, index_count;
  sbf_vec3 middle;         /* for sorting by distance */
  const draw_image *image; /* NULL: none */
  float transparency;
  draw_alpha alpha;
  float cutoff;
  bool one_sided, casts_shadow;
} draw_scene_part;

/* Triangles of the ground. */
typedef struct draw_scene_ground {
  draw_scene_list positions, normals; /* sbf_vec3 */
  draw_scene_list indices;            /* uint32_t */
} draw_scene_ground;

/* Text and figures over the picture. */
typedef struct draw_scene_overlay {
  draw_scene_list lines; /* draw_line; x and y from the picture's lower left corner, or if z is 1 from its
                            upper left one, in overlay units */
  uint32_t rows, note_rows;
  bool from_top; /* the current item is relative to the top */
} draw_scene_overlay;

/* What the painter fills for a camera. */
typedef struct draw_scene_painted {
  draw_scene_list sorted_lines; /* draw_line, farthest first */
  draw_scene_list mark_rims;    /* draw_line, behind the marks */
  draw_scene_list line_corners; /* draw_line, each four times */
  draw_scene_list sorted_parts; /* uint32_t: transparent parts, farthest first */
  draw_scene_list overlay;      /* draw_line, in world space */
  uint32_t xray_count;          /* number of x-ray parts */
} draw_scene_painted;

struct draw_scene {
  draw_scene_list positions, normals, colours; /* (vertices) sbf_vec3, sbf_vec3, colour; all in world space */
  draw_scene_list uvs;                         /* (vertices) sbf_vec2; 0 without an image */
  draw_scene_list smooth_normals;              /* sbf_vec3, of the mesh that is being added */
  draw_scene_list indices;                     /* uint32_t, three per triangle */
  draw_scene_list parts;                       /* draw_scene_part */
  draw_scene_list lines;                       /* draw_line */
  draw_scene_list marks;                       /* draw_line */
  draw_scene_list prints;                      /* draw_line */
  draw_scene_ground ground;
  draw_scene_overlay overlay;
  draw_scene_painted painted;
  box3 bounds;
  box3 casters; /* bounds of shadow casters */
  bool has_floor;
  float floor_height;
  bool failed; /* memory ran out for an item */
};

/* Extends the list by `count` items: returns the first, or NULL (then the scene has failed). */
void *draw_scene_list_push(draw_scene *scene, draw_scene_list *list, size_t count, size_t item_size);

/* An opaque part with a shadow, of `vertex_count` vertices and `triangle_count` triangles: the memory to
 * fill; `first_vertex` must be added to indices. False if memory runs out. */
typedef struct draw_scene_space {
  sbf_vec3 *positions, *normals;
  draw_colour *colours;
  sbf_vec2 *uvs; /* all 0 */
  uint32_t *indices;
  uint32_t first_vertex;
} draw_scene_space;
bool draw_scene_reserve(
    draw_scene *scene, uint32_t vertex_count, uint32_t triangle_count, draw_scene_space *space);

/* Completes a part of draw_scene_reserve: `index_count` indices were written from room->indices on. */
void draw_scene_close_part(draw_scene *scene, const draw_scene_space *space, uint32_t vertex_count,
    uint32_t index_count, const draw_scene_part *style);

void draw_scene_clear_ground(draw_scene *scene);

/* Smooth unit normals: area-weighted sums over the triangles. */
void draw_scene_smooth_normals(const sbf_vec3 *positions, uint32_t vertex_count, const uint32_t *triangles,
    uint32_t index_count, sbf_vec3 *normals);

/* One unit is a pixel of a picture 720 high, in a smaller one at least 0.7 pixels, so that text stays
 * legible. `width` and `height` are the picture's. */
void draw_scene_arrange_overlay(
    draw_scene *scene, const draw_camera *camera, uint32_t width, uint32_t height);

/* Fills painted.mark_rims. */
void draw_scene_rim_marks(draw_scene *scene);

/* Fills the sorted lists of `painted` for an eye position; `back` as in draw_camera_back. */
void draw_scene_sort(draw_scene *scene, sbf_vec3 eye, sbf_vec3 back);

#endif
