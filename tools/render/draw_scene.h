/* Content of the picture: meshes, lines, dots, bones and the ground, as plain arrays for every frame.
 * Everything is copied, so the caller's arrays may change immediately. Memory is kept between frames, so a
 * steady animation allocates nothing. Metres, +Y up. Not thread safe. */
#ifndef RENDER_DRAW_SCENE_H
#define RENDER_DRAW_SCENE_H

#include "render/base_image.h"
#include "render/camera.h"
#include "render/palette.h"

typedef struct draw_scene draw_scene;

draw_scene *draw_scene_create(void); /* NULL if memory runs out */
void draw_scene_destroy(draw_scene *scene);
void draw_scene_clear(draw_scene *scene); /* empties it but keeps the memory */

/* Adding never fails at the call: items without memory are dropped, and painting reports the failure. */

/* Transform of a rigid object: rotated, then translated. */
typedef struct draw_transform {
  sbf_quat rotation;
  sbf_vec3 position;
} draw_transform;

/* Effect of the opacity of colours and images: none, a hole below the cutoff, or blending with the
 * background. */
typedef enum draw_alpha { DRAW_OPAQUE, DRAW_MASK, DRAW_BLEND } draw_alpha;

/* A surface of triangles, lit from both sides. Zero is the default of every field. */
typedef struct draw_mesh {
  const sbf_vec3 *positions;  /* (vertex_count) */
  const sbf_vec3 *normals;    /* (vertex_count) unit; NULL: computed, smooth */
  const draw_colour *colours; /* (vertex_count); NULL: `colour` for all */
  /* (3 triangle_count) into positions; triangles with an index out of range are skipped */
  const uint32_t *triangles;
  uint32_t vertex_count, triangle_count;
  draw_colour colour;
  const draw_image *image;    /* multiplied with the colour if opaque; NULL: none. Not copied: must outlive,
                                 unchanged, the painters that have used it */
  const sbf_vec2 *corner_uvs; /* (3 triangle_count) texture coordinates of each corner, lower left is 0, 0 */
  const sbf_vec3 *corner_normals;    /* (3 triangle_count) unit, replace `normals`; NULL: no hard edges */
  const draw_colour *corner_colours; /* (3 triangle_count) replace `colours`; NULL: none */
  draw_alpha alpha;
  float cutoff;       /* of DRAW_MASK */
  bool one_sided;     /* back faces, with clockwise triangles, are culled */
  float transparency; /* 0 opaque; 0.75 an x-ray view, which shows the inside; below 1 */
  bool flat;          /* flat shading */
  bool no_shadow;
  const draw_transform *transform; /* NULL: positions are in world space */
} draw_mesh;

#define DRAW_XRAY 0.75f /* transparency of a skin whose springs or bones are shown */

/* Consecutive meshes of one transparency with shadows form one skin: if transparent, they do not show
 * inside each other. */
void draw_scene_add_mesh(draw_scene *scene, const draw_mesh *mesh);

/* A straight line with round ends. A width of 1 is a thin line at any picture size: 1 pixel in a picture
 * 720 high at the distance of the camera's subject, and more if closer. With more than some thousands of
 * lines all are thinner. */
typedef struct draw_line {
  sbf_vec3 from, to;
  draw_colour from_colour, to_colour; /* a < 255: transparent */
  float width;
} draw_line;

void draw_scene_add_line(draw_scene *scene, const draw_line *line);
void draw_scene_add_dot(draw_scene *scene, sbf_vec3 at, float width, draw_colour colour);

/* Edges of a mesh or springs between points: pairs of indices; `colours` one per line, or NULL. */
void draw_scene_add_lines(draw_scene *scene, const sbf_vec3 *positions, uint32_t position_count,
    const sbf_uint2 *ends, const draw_colour *colours, uint32_t line_count, draw_colour colour, float width);

void draw_scene_add_sphere(draw_scene *scene, sbf_vec3 centre, float radius, draw_colour colour);

/* Marks are drawn on top of everything, including the inside of bodies, with a pale rim for contrast; one
 * of length 0 is a dot. Framing includes their ends, but not rings. */
void draw_scene_add_mark(draw_scene *scene, const draw_line *mark);
void draw_scene_add_ring_mark(
    draw_scene *scene, sbf_vec3 centre, sbf_vec3 normal, float radius, float width, draw_colour colour);

/* A ring on the ground, hidden by objects in front of it; framing ignores it. */
void draw_scene_add_print(
    draw_scene *scene, sbf_vec3 centre, sbf_vec3 normal, float radius, float width, draw_colour colour);

/* A bone in the usual style: an octahedron, thick near its head, with a small ball at both ends. */
void draw_scene_add_bone(draw_scene *scene, sbf_vec3 head, sbf_vec3 tail, draw_colour colour);

/* A convex hull: transparent faces, and lines along edges between facets at different angles. */
void draw_scene_add_hull(draw_scene *scene, const sbf_vec3 *positions, uint32_t vertex_count,
    const uint32_t *triangles, uint32_t triangle_count, const draw_transform *transform, draw_colour colour);

/* Legend in the lower left corner of the picture, from the bottom up. Supports English letters without
 * case, digits and + - % . , ' / = ( ) :; other characters are blank. */
void draw_scene_add_legend(draw_scene *scene, const char *name, draw_colour colour);

/* Text in the upper left corner, from the top down, with an optional coloured dot. */
void draw_scene_add_note(draw_scene *scene, const char *words, const draw_colour *colour);

/* Colour bar of the whole map, with labels at its ends and its centre (each may be NULL). */
void draw_scene_add_scale(
    draw_scene *scene, const draw_colour_map *map, const char *low, const char *middle, const char *high);

/* The ground: an infinite level floor, or a surface of triangles (see terrain.h). Without one, objects
 * float in front of the backdrop. It fades out around the camera's subject. */
void draw_scene_set_floor(draw_scene *scene, float height);
void draw_scene_set_ground(draw_scene *scene, const sbf_vec3 *positions, const sbf_vec3 *normals,
    uint32_t vertex_count, const uint32_t *triangles, uint32_t triangle_count);

/* A ground given by its height, metres, over x and z: sampled around a position at the resolution of the
 * picture, with sharp steps (of stairs along x or z, for example). `radius`: extent around that position,
 * metres. */
typedef float (*draw_height)(void *user, float x, float z);
void draw_scene_set_terrain(
    draw_scene *scene, draw_height height, void *user, float x, float z, float radius);

/* Frames everything added so far except the ground, more tightly than with a bounding box: see
 * draw_camera_frame. */
void draw_scene_frame(const draw_scene *scene, draw_camera *camera, float aspect, float yaw, float pitch);

/* Follows everything added so far with the current framing: see draw_camera_follow. */
void draw_scene_follow(const draw_scene *scene, draw_camera *camera, float aspect, float seconds);

box3 draw_scene_bounds(
    const draw_scene *scene); /* of everything added except the ground; empty if there is nothing */

#endif
