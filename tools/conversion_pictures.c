#include "conversion_pictures.h"

#include <ctype.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "mesh_quality.h"
#include "render/camera.h"
#include "render/canvas.h"
#include "render/draw_scene.h"
#include "render/painter.h"
#include "render/picture.h"
#include "skin_material.h"

enum { WIDTH = 960, HEIGHT = 720 };

/* Polygons as fans of triangles: those of one material slot, or all if `slots` is NULL. An image needs the
 * polygons' mesh. */
static void add_polygons(draw_scene *scene, const sbf_polygon_mesh *mesh, const sbf_u32_list *slots,
    uint32_t slot, const skin_material *style, const sbf_render_mesh *unwrapped, float transparency) {
  size_t capacity = 3 * (size_t)mesh->polygon_points.count + 1;
  uint32_t *triangles = malloc(capacity * sizeof *triangles), count = 0;
  bool stated = unwrapped && unwrapped->normal_corners.count == mesh->polygon_points.count && capacity > 1;
  sbf_vec2 *uvs = style->image ? malloc(capacity * sizeof *uvs) : NULL;
  draw_colour *colours = unwrapped && style->has_colours ? malloc(capacity * sizeof *colours) : NULL;
  sbf_vec3 *normals = stated ? malloc(capacity * sizeof *normals) : NULL;
  for (uint32_t i = 0, at = 0; triangles && i < mesh->polygon_sizes.count; at += mesh->polygon_sizes.at[i++])
    for (uint32_t k = 2; k < mesh->polygon_sizes.at[i] && (!slots || !slots->count || slots->at[i] == slot);
         k++) {
      const uint32_t corners[3] = {at, at + k - 1, at + k};
      for (int c = 0; c < 3; c++) {
        if (uvs) uvs[3 * count + (uint32_t)c] = skin_corner_uv(unwrapped, style, corners[c]);
        if (colours) colours[3 * count + (uint32_t)c] = skin_corner_colour(unwrapped, style, corners[c]);
        if (normals)
          normals[3 * count + (uint32_t)c] = unwrapped->normals.at[unwrapped->normal_corners.at[corners[c]]];
        triangles[3 * count + (uint32_t)c] = mesh->polygon_points.at[corners[c]];
      }
      count++;
    }
  draw_mesh drawn = {.positions = mesh->positions.at,
      .triangles = triangles,
      .vertex_count = mesh->positions.count,
      .triangle_count = count,
      .corner_uvs = uvs,
      .corner_colours = colours,
      .corner_normals = normals,
      .transparency = transparency};
  skin_material_apply(style, &drawn);
  if (count) draw_scene_add_mesh(scene, &drawn);
  free(colours);
  free(triangles);
  free(uvs);
  free(normals);
}

/* Content of a view. */
typedef struct subject {
  const sbf_asset *asset;
  const skin_images *images;
} subject;

static bool add_skin(const subject *of, draw_scene *scene, float transparency) {
  for (uint32_t i = 0; i < of->asset->render_meshes.count; i++) {
    const sbf_render_mesh *mesh = &of->asset->render_meshes.at[i];
    uint32_t slots = mesh->material_slots.count ? mesh->material_slots.count : 1;
    for (uint32_t s = 0; s < slots; s++) {
      skin_material style = skin_material_of(of->asset, of->images, mesh, s);
      add_polygons(scene, &mesh->mesh, &mesh->polygon_materials, s, &style, mesh, transparency);
    }
  }
  return of->asset->render_meshes.count > 0;
}

static bool add_whole_skin(const subject *of, draw_scene *scene) {
  return add_skin(of, scene, 0);
}

/* Hues are spaced by the golden angle, so that neighbours in the list are always distinct. */
static draw_colour colour_of_section(uint32_t i) {
  double hue = fmod(0.08 + i * 0.6180339887, 1) * 6, rgb[3];
  for (int k = 0; k < 3; k++) {
    double away = fabs(fmod(hue + 6 - 2 * k, 6) - 3) - 1, full = away < 0 ? 0 : away > 1 ? 1 : away;
    rgb[k] = 0.36 + 0.5 * full;
  }
  return (draw_colour){(uint8_t)(255 * rgb[0]), (uint8_t)(255 * rgb[1]), (uint8_t)(255 * rgb[2]), 255};
}

static bool add_sections(const subject *of, draw_scene *scene) {
  const sbf_asset *asset = of->asset;
  uint32_t shown = 0;
  for (uint32_t i = 0; i < asset->soft_bodies.count; i++) {
    const sbf_polygon_mesh *surface = &asset->soft_bodies.at[i].surface;
    skin_material style = {.colour = colour_of_section(i)};
    add_polygons(scene, surface, NULL, 0, &style, NULL, 0);
    shown += surface->polygon_sizes.count > 0;
  }
  return shown > 0;
}

/* --- Tetrahedra, the nearer half taken off --------------------------------------------------------- */

static const sbf_level *finest(const sbf_soft_body *body) {
  return body->levels.count ? &body->levels.at[0] : NULL;
}

static const float PITCH_OF_FLAT = 0.9f; /* rad */

/* Removes the half towards the camera, in front of the middle along +X and +Z. */
static bool is_drawn(const sbf_level *level, const uint32_t *p, float middle) {
  float at = 0;
  for (int k = 0; k < 4; k++) at += level->positions.at[p[k]].x / 4;
  return at <= middle;
}

static void middle_of(const sbf_level *level, float *x) {
  float low = INFINITY, high = -INFINITY;
  for (uint32_t i = 0; i < level->positions.count; i++) {
    low = fminf(low, level->positions.at[i].x);
    high = fmaxf(high, level->positions.at[i].x);
  }
  *x = (low + high) / 2;
}

/* All faces of the remaining tetrahedra, with separate points for their colours: outer faces hide inner
 * ones. */
static bool add_cut(const sbf_level *level, const draw_colour_map *map, draw_scene *scene) {
  static const int sides[4][3] = {{1, 2, 3}, {0, 3, 2}, {0, 1, 3}, {0, 2, 1}};
  const sbf_uint4_list *all = &level->lattice.tetrahedra;
  size_t capacity = 12 * (size_t)all->count + 1;
  sbf_vec3 *points = malloc(capacity * sizeof *points);
  draw_colour *colours = malloc(capacity * sizeof *colours);
  uint32_t *triangles = malloc(capacity * sizeof *triangles), count = 0;
  float middle;
  middle_of(level, &middle);
  for (uint32_t i = 0; points && colours && triangles && i < all->count; i++) {
    const uint32_t *p = all->at[i].at;
    if (!is_drawn(level, p, middle)) continue;
    draw_colour colour = draw_colour_map_at(map, (float)mesh_radius_ratio(level->positions.at, p));
    for (int s = 0; s < 4; s++)
      for (int k = 0; k < 3; k++) {
        points[count] = level->positions.at[p[sides[s][k]]];
        colours[count] = colour;
        triangles[count] = count;
        count++;
      }
  }
  if (count)
    draw_scene_add_mesh(scene, &(draw_mesh){.positions = points,
                                   .colours = colours,
                                   .triangles = triangles,
                                   .vertex_count = count,
                                   .triangle_count = count / 3,
                                   .flat = true});
  free(points);
  free(colours);
  free(triangles);
  return count > 0;
}

static bool add_lattices(const subject *of, draw_scene *scene) {
  const sbf_asset *asset = of->asset;
  draw_colour_map map;
  bool shown = false;
  draw_colour_map_init_sequential(&map);
  for (uint32_t i = 0; i < asset->soft_bodies.count; i++) {
    const sbf_level *level = finest(&asset->soft_bodies.at[i]);
    if (level && level->lattice.tetrahedra.count && add_cut(level, &map, scene)) shown = true;
  }
  if (shown) draw_scene_add_scale(scene, &map, "0", NULL, "1 = regular");
  return shown;
}

static bool add_springs(const subject *of, draw_scene *scene) {
  const sbf_asset *asset = of->asset;
  unsigned seen = 0;
  for (uint32_t i = 0; i < asset->soft_bodies.count; i++) {
    const sbf_level *level = finest(&asset->soft_bodies.at[i]);
    for (uint32_t s = 0; level && s < level->springs.count; s++) {
      const sbf_spring_set *set = &level->springs.at[s];
      const draw_spring_style *style = draw_spring_style_of((draw_spring_style_kind)set->kind);
      draw_scene_add_lines(scene, level->positions.at, level->positions.count, set->ends.at, NULL,
          set->ends.count, style->colour, style->width);
      seen |= set->ends.count ? 1u << set->kind : 0;
    }
  }
  if (!seen) return false;
  add_skin(of, scene, 0.88f);
  for (int k = DRAW_SPRING_STYLE_COUNT - 1; k >= 0; k--) {
    const draw_spring_style *style = draw_spring_style_of((draw_spring_style_kind)k);
    if (seen & 1u << k) draw_scene_add_legend(scene, style->name, style->colour);
  }
  return true;
}

static bool add_bones(const subject *of, draw_scene *scene) {
  const sbf_asset *asset = of->asset;
  for (uint32_t i = 0; i < asset->bones.count; i++) {
    const sbf_bone *b = &asset->bones.at[i];
    sbf_vec3 along = v3_scale(v3_rotate(b->rotation, v3(0, 1, 0)), b->length);
    if (b->length > 0) draw_scene_add_bone(scene, b->head, v3_add(b->head, along), draw_colour_of_bone());
  }
  if (asset->bones.count) add_skin(of, scene, DRAW_XRAY);
  return asset->bones.count > 0;
}

/* --- Drawing ------------------------------------------------------------------------------------------- */

static const struct {
  const char *name, *title, *caption;
  bool (*add)(const subject *, draw_scene *);
} views[] = {
    {"skin", "Skin", "The render meshes at rest, in their base colours and the images on them.",
        add_whole_skin},
    {"sections", "Sections", "The surface of every soft body in a colour of its own.", add_sections},
    {"lattice", "Lattice",
        "The tetrahedra of the finest levels, half of each body taken off, by how near they are to regular.",
        add_lattices},
    {"springs", "Springs", "The springs of the finest levels, by kind.", add_springs},
    {"bones", "Bones", "The skeleton at rest.", add_bones},
};

typedef struct page_canvas {
  draw_canvas *canvas;
  draw_painter *painter;
  draw_scene *scene;
  uint8_t *rgb;
  skin_images images;
  char *notes; /* images that are not drawn, one sentence each after a blank; NULL: none */
} page_canvas;

static sbf_status open_canvas(page_canvas *e, sbf_diagnostic *error) {
  sbf_status status = draw_canvas_open(&e->canvas, WIDTH, HEIGHT, DRAW_CANVAS_STILL, error);
  if (status == SBF_OK) status = draw_painter_create(&e->painter, e->canvas, error);
  if (status != SBF_OK) return status;
  e->scene = draw_scene_create();
  e->rgb = malloc((size_t)3 * WIDTH * HEIGHT);
  if (e->scene && e->rgb) return SBF_OK;
  snprintf(error->message, sizeof error->message, "memory ran out for the pictures");
  return SBF_FAILED;
}

static void close_canvas(page_canvas *e) {
  if (e->scene) draw_scene_destroy(e->scene);
  draw_painter_destroy(e->painter);
  draw_canvas_close(e->canvas);
  skin_images_free(&e->images);
  free(e->notes);
  free(e->rgb);
}

/* Flat objects are seen from well above, with a floor below them. */
static sbf_status paint(page_canvas *e, sbf_diagnostic *error) {
  draw_camera camera;
  box3 box = draw_scene_bounds(e->scene);
  float width = fmaxf(box.max.x - box.min.x, box.max.z - box.min.z);
  bool flat = box.max.y - box.min.y < 0.1f * width;
  if (!box3_is_empty(&box)) draw_scene_set_floor(e->scene, flat ? box.min.y - 0.03f * width : box.min.y);
  draw_scene_frame(e->scene, &camera, (float)WIDTH / HEIGHT, DRAW_CAMERA_THREE_QUARTER_YAW,
      flat ? PITCH_OF_FLAT : DRAW_CAMERA_THREE_QUARTER_PITCH);
  sbf_status status = draw_painter_paint(e->painter, e->scene, &camera, error);
  return status == SBF_OK ? draw_canvas_read(e->canvas, e->rgb, error) : status;
}

/* As in RFC 4648. */
static char *base64_of(const uint8_t *bytes, size_t size) {
  static const char digits[] = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
  char *text = malloc((size + 2) / 3 * 4 + 1), *to = text;
  for (size_t i = 0; text && i < size; i += 3) {
    uint32_t bits = (uint32_t)bytes[i] << 16;
    if (i + 1 < size) bits |= (uint32_t)bytes[i + 1] << 8;
    if (i + 2 < size) bits |= bytes[i + 2];
    *to++ = digits[bits >> 18];
    *to++ = digits[bits >> 12 & 63];
    *to++ = i + 1 < size ? digits[bits >> 6 & 63] : '=';
    *to++ = i + 2 < size ? digits[bits & 63] : '=';
  }
  if (text) *to = 0;
  return text;
}

/* The first view shows the skin. */
static bool append(json_t *list, const page_canvas *e, size_t view, const uint8_t *png, size_t size) {
  char *text = base64_of(png, size);
  json_t *one =
      text ? json_pack("{s:s, s:s, s:s+, s:i, s:i, s:s}", "name", views[view].name, "title",
                 views[view].title, "caption", views[view].caption, view == 0 && e->notes ? e->notes : "",
                 "width", WIDTH, "height", HEIGHT, "png", text)
           : NULL;
  free(text);
  return one && json_array_append_new(list, one) == 0;
}

/* If memory runs out, the note is lost but not the picture. */
static void store_note(void *user, const sbf_diagnostic *note) {
  page_canvas *e = user;
  size_t before = e->notes ? strlen(e->notes) : 0, more = strlen(note->message) + 3;
  char *grown = realloc(e->notes, before + more);
  if (!grown) return;
  e->notes = grown;
  snprintf(grown + before, more, " %s.", note->message);
  grown[before + 1] = (char)toupper((unsigned char)grown[before + 1]);
}

bool conversion_pictures_draw(const sbf_asset *asset, const char *file, json_t *list, char **why) {
  page_canvas e = {.canvas = NULL};
  sbf_diagnostic error = {.code = 0};
  sbf_status status = open_canvas(&e, &error);
  bool good = true;
  subject of = {asset, &e.images};
  if (status == SBF_OK) skin_images_load(&e.images, asset, file, store_note, &e);
  for (size_t i = 0; status == SBF_OK && good && i < sizeof views / sizeof *views; i++) {
    uint8_t *png = NULL;
    size_t size = 0;
    draw_scene_clear(e.scene);
    if (!views[i].add(&of, e.scene)) continue;
    status = paint(&e, &error);
    if (status == SBF_OK) status = draw_picture_encode_png(e.rgb, WIDTH, HEIGHT, &png, &size, &error);
    if (status == SBF_OK) good = append(list, &e, i, png, size);
    free(png);
  }
  close_canvas(&e);
  *why = status == SBF_OK ? NULL : strdup(error.message);
  return good && (status == SBF_OK || *why);
}
