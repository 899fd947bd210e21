/* What is in the picture: meshes, lines, dots, bones and the ground, given anew for every frame as plain
 * arrays. All that is added is copied, so the caller's arrays may change at once; the room is kept from frame
 * to frame, so a steady animation allocates nothing. Metres, +Y up. Not thread safe. */
#ifndef RENDER_DRAW_SCENE_H
#define RENDER_DRAW_SCENE_H

#include "render/base_image.h"
#include "render/camera.h"
#include "render/palette.h"

typedef struct draw_scene draw_scene;

draw_scene *draw_scene_create(void); /* NULL: no memory */
void draw_scene_destroy(draw_scene *scene);
void draw_scene_clear(draw_scene *scene); /* empty again, the room kept */

/* Adding cannot fail where it is called: what found no memory is left out, and painting then reports it. */

/* Where a rigid thing is: rotated, then moved. */
typedef struct draw_transform {
  sbf_quat rotation;
  sbf_vec3 position;
} draw_transform;

/* What the opacity of colours and images does: nothing, a hole below the cutoff, or a blend with what is
 * behind.
 */
typedef enum draw_alpha { DRAW_OPAQUE, DRAW_MASK, DRAW_BLEND } draw_alpha;

/* A surface of triangles, lit from both sides. Zero means the plain choice everywhere. */
typedef struct draw_mesh {
  const sbf_vec3 *positions;  /* (vertex_count) */
  const sbf_vec3 *normals;    /* (vertex_count) unit; NULL: computed, smooth */
  const draw_colour *colours; /* (vertex_count); NULL: `colour` for all */
  const uint32_t *triangles;  /* (3 triangle_count) into positions; one out of range is left out */
  uint32_t vertex_count, triangle_count;
  draw_colour colour;
  const draw_image *image;    /* multiplies the colour where it is solid; NULL: none. Not copied: it stays,
                                 unchanged, as long as the painters that have painted it */
  const sbf_vec2 *corner_uvs; /* (3 triangle_count) a place in it for each corner, its lower left 0, 0 */
  const sbf_vec3 *corner_normals;    /* (3 triangle_count) unit, instead of `normals`; NULL: no hard edges */
  const draw_colour *corner_colours; /* (3 triangle_count) instead of `colours`; NULL: those */
  draw_alpha alpha;
  float cutoff;       /* of DRAW_MASK */
  bool one_sided;     /* not drawn from behind, where its triangles run clockwise */
  float transparency; /* 0 solid; 0.75 an x-ray view, which shows what is inside; below 1 */
  bool flat;          /* facets keep their edges */
  bool no_shadow;
  const draw_transform *transform; /* NULL: positions are in the world */
} draw_mesh;

#define DRAW_XRAY 0.75f /* transparency of a skin whose springs or bones are shown */

/* Meshes of one transparency that follow each other and throw shadows are one skin: seen through, they do not
 * show inside each other. */
void draw_scene_add_mesh(draw_scene *scene, const draw_mesh *mesh);

/* A straight line with round ends. A width of 1 reads as a fine line at any picture size: it is 1 pixel in a
 * picture 720 high, at the distance of what the camera looks at, and more nearer by. Beyond some thousands of
 * lines all are drawn thinner. */
typedef struct draw_line {
  sbf_vec3 from, to;
  draw_colour from_colour, to_colour; /* a < 255 lets what is behind shine through */
  float width;
} draw_line;

void draw_scene_add_line(draw_scene *scene, const draw_line *line);
void draw_scene_add_dot(draw_scene *scene, sbf_vec3 at, float width, draw_colour colour);

/* Edges of a mesh or springs between points: pairs of indices; `colours` one a line, or NULL. */
void draw_scene_add_lines(draw_scene *scene, const sbf_vec3 *positions, uint32_t position_count,
    const sbf_uint2 *ends, const draw_colour *colours, uint32_t line_count, draw_colour colour, float width);

void draw_scene_add_sphere(draw_scene *scene, sbf_vec3 centre, float radius, draw_colour colour);

/* Marks are painted over all else, what is inside of bodies or behind them too, with a pale rim that sets
 * them off from any skin; one that ends where it begins is a dot. Pictures are framed for their ends too, but
 * not for rings. */
void draw_scene_add_mark(draw_scene *scene, const draw_line *mark);
void draw_scene_add_ring_mark(
    draw_scene *scene, sbf_vec3 centre, sbf_vec3 normal, float radius, float width, draw_colour colour);

/* A ring on the ground, which what stands before it hides; it may be left behind, no picture is framed for
 * it.
 */
void draw_scene_add_print(
    draw_scene *scene, sbf_vec3 centre, sbf_vec3 normal, float radius, float width, draw_colour colour);

/* A bone as animators know it: an octahedron, thick near its head, with a small ball at either end. */
void draw_scene_add_bone(draw_scene *scene, sbf_vec3 head, sbf_vec3 tail, draw_colour colour);

/* A convex hull: a veil of its colour, and lines along the edges where two facets really meet at an angle. */
void draw_scene_add_hull(draw_scene *scene, const sbf_vec3 *positions, uint32_t vertex_count,
    const uint32_t *triangles, uint32_t triangle_count, const draw_transform *transform, draw_colour colour);

/* Words in the lower left corner of the picture: what the colours mean, from the bottom up. Letters are those
 * of English without case, figures and + - % . , ' / = ( ) :, and anything else is a gap. */
void draw_scene_add_legend(draw_scene *scene, const char *name, draw_colour colour);

/* Words in the upper left corner, from the top down, behind a spot of a colour where one is given. */
void draw_scene_add_note(draw_scene *scene, const char *words, const draw_colour *colour);

/* A bar of the whole map, with words at its ends and its middle (each may be NULL). */
void draw_scene_add_scale(
    draw_scene *scene, const draw_colour_map *map, const char *low, const char *middle, const char *high);

/* The ground: an endless level floor, or a surface of triangles (see terrain.h). Without any, things float
 * before the backdrop. The picture fades out around what the camera looks at. */
void draw_scene_set_floor(draw_scene *scene, float height);
void draw_scene_set_ground(draw_scene *scene, const sbf_vec3 *positions, const sbf_vec3 *normals,
    uint32_t vertex_count, const uint32_t *triangles, uint32_t triangle_count);

/* A ground given by its height, metres, over x and z: sampled around a place as finely as the picture needs,
 * and with its steps (of stairs along x or z, say) kept sharp. `radius`: how far from there, metres. */
typedef float (*draw_height)(void *user, float x, float z);
void draw_scene_set_terrain(
    draw_scene *scene, draw_height height, void *user, float x, float z, float radius);

/* Frames all that was added so far but the ground, closer than a box about it could: see draw_camera_frame.
 */
void draw_scene_frame(const draw_scene *scene, draw_camera *camera, float aspect, float yaw, float pitch);

/* Follows all that was added so far, to keep it as well framed as it was: see draw_camera_follow. */
void draw_scene_follow(const draw_scene *scene, draw_camera *camera, float aspect, float seconds);

box3 draw_scene_bounds(
    const draw_scene *scene); /* of all that was added but the ground; empty where nothing was */

#endif
