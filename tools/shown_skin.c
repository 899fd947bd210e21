#include "shown_skin.h"

#include <stdlib.h>
#include <string.h>

/* The triangles of one mesh with one material. */
typedef struct patch {
  uint32_t *triangles, *whole;          /* all, and a buffer for those that are not torn */
  uint32_t *polygons;                   /* (triangle_count) polygon of each */
  sbf_vec2 *uvs, *whole_uvs;            /* (3 triangle_count) the same for texture coordinates; NULL: none */
  draw_colour *colours, *whole_colours; /* (3 triangle_count) the same for colours; NULL: the material's */
  /* (3 triangle_count) the same for corners of the polygons; NULL: no hard edges */
  uint32_t *corners, *whole_corners;
  uint32_t triangle_count;
  skin_material style;
} patch;

typedef struct mesh_style {
  patch *patches;
  uint32_t patch_count;
  uint8_t *torn;  /* (polygons) */
  uint32_t level; /* displayed level of the mesh */
} mesh_style;

struct shown_skin {
  mesh_style *meshes;
  uint32_t mesh_count;
  sbf_vec3 *positions, *normals; /* buffers for the largest mesh */
  sbf_vec3 *of_corners;          /* buffer for the corners of the largest mesh or level with hard edges */
  sbf_vec3 *of_triangles;        /* the same for its triangles, three each */
  uint32_t capacity, corner_capacity;
};

/* The polygons of a mesh or of one of its levels, over the vertices that the runtime writes for it. */
typedef struct shown_polygons {
  sbf_u32_list sizes, points, materials;
  uint32_t *position_of; /* (vertices of the mesh); NULL: all are written */
  /* (displayed corners) corner of the full mesh with the same attributes; NULL: the same */
  uint32_t *corner_of;
} shown_polygons;

/* A level may have no map of its corners to the full mesh: then uses the first corner at each point. */
static bool find_corners(const sbf_render_mesh *mesh, const sbf_render_level *from, shown_polygons *shown) {
  const sbf_u32_list *points = &mesh->mesh.polygon_points;
  uint32_t *first = malloc((mesh->mesh.positions.count + 1u) * sizeof *first);
  shown->corner_of = malloc((from->polygon_points.count + 1u) * sizeof *shown->corner_of);
  bool good = first && shown->corner_of;
  for (uint32_t i = 0; good && i < mesh->mesh.positions.count; i++) first[i] = 0;
  for (uint32_t i = good ? points->count : 0; i-- > 0;) first[points->at[i]] = i;
  for (uint32_t i = 0; good && i < from->polygon_points.count; i++)
    shown->corner_of[i] = from->corners.count ? from->corners.at[i] : first[from->polygon_points.at[i]];
  free(first);
  return good;
}

static bool shown_of_mesh(const session *s, uint32_t number, uint32_t level, shown_polygons *shown) {
  const sbf_render_mesh *mesh = &s->asset->render_meshes.at[number];
  *shown = (shown_polygons){
      mesh->mesh.polygon_sizes, mesh->mesh.polygon_points, mesh->polygon_materials, NULL, NULL};
  if (level == 0) return true;
  const sbf_render_level *from = &mesh->levels.at[level - 1];
  uint32_t count = sbr_model_get_level_vertices(s->model, number, level, NULL, 0);
  uint32_t *vertices = malloc((count + 1u) * sizeof *vertices);
  shown->position_of = calloc(mesh->mesh.positions.count + 1u, sizeof *shown->position_of);
  bool good = vertices && shown->position_of;
  if (good) sbr_model_get_level_vertices(s->model, number, level, vertices, count);
  for (uint32_t i = 0; good && i < count; i++) shown->position_of[vertices[i]] = i;
  free(vertices);
  shown->sizes = from->polygon_sizes;
  shown->points = from->polygon_points;
  shown->materials = from->polygon_materials;
  return good && find_corners(mesh, from, shown);
}

/* Triangulates the polygons of one material slot as fans. */
static bool cut_patch(
    const sbf_render_mesh *mesh, const shown_polygons *shown, bool hard, uint32_t slot, patch *p) {
  size_t max = 3 * (size_t)shown->points.count + 1;
  p->triangles = malloc(max * sizeof *p->triangles);
  p->whole = malloc(max * sizeof *p->whole);
  p->polygons = malloc(((size_t)shown->points.count + 1) * sizeof *p->polygons);
  if (!p->triangles || !p->whole || !p->polygons) return false;
  if (p->style.image) {
    p->uvs = malloc(max * sizeof *p->uvs);
    p->whole_uvs = malloc(max * sizeof *p->whole_uvs);
    if (!p->uvs || !p->whole_uvs) return false;
  }
  if (p->style.has_colours) {
    p->colours = malloc(max * sizeof *p->colours);
    p->whole_colours = malloc(max * sizeof *p->whole_colours);
    if (!p->colours || !p->whole_colours) return false;
  }
  if (hard) {
    p->corners = malloc(max * sizeof *p->corners);
    p->whole_corners = malloc(max * sizeof *p->whole_corners);
    if (!p->corners || !p->whole_corners) return false;
  }
  for (uint32_t i = 0, at = 0; i < shown->sizes.count; at += shown->sizes.at[i++]) {
    const uint32_t *corner = shown->points.at + at;
    if ((shown->materials.count ? shown->materials.at[i] : 0) != slot) continue;
    for (uint32_t k = 2; k < shown->sizes.at[i]; k++) {
      const uint32_t fan[3] = {corner[0], corner[k - 1], corner[k]};
      const uint32_t corners[3] = {at, at + k - 1, at + k};
      for (uint32_t c = 0; c < 3; c++) {
        uint32_t to = 3 * p->triangle_count + c;
        p->triangles[to] = shown->position_of ? shown->position_of[fan[c]] : fan[c];
        if (p->corners) p->corners[to] = corners[c];
        uint32_t of_full = shown->corner_of ? shown->corner_of[corners[c]] : corners[c];
        if (p->uvs) p->uvs[to] = skin_corner_uv(mesh, &p->style, of_full);
        if (p->colours) p->colours[to] = skin_corner_colour(mesh, &p->style, of_full);
      }
      p->polygons[p->triangle_count++] = i;
    }
  }
  return true;
}

/* Whether normals of corners at one point differ by more than a degree. */
static bool has_hard_edges(const sbf_render_mesh *mesh, bool *hard) {
  const sbf_u32_list *points = &mesh->mesh.polygon_points, *of = &mesh->normal_corners;
  *hard = false;
  if (of->count == 0) return true;
  uint32_t *first = malloc((mesh->mesh.positions.count + 1u) * sizeof *first);
  if (!first) return false;
  memset(first, 0xff, (mesh->mesh.positions.count + 1u) * sizeof *first);
  for (uint32_t c = 0; c < points->count && c < of->count && !*hard; c++) {
    uint32_t *to = &first[points->at[c]];
    if (*to == UINT32_MAX) *to = of->at[c];
    sbf_vec3 a = mesh->normals.at[*to], b = mesh->normals.at[of->at[c]];
    *hard = a.x * b.x + a.y * b.y + a.z * b.z < 0.99985f;
  }
  free(first);
  return true;
}

static bool style_of_mesh(
    const session *s, const skin_images *images, uint32_t number, uint32_t level, mesh_style *style) {
  const sbf_render_mesh *mesh = &s->asset->render_meshes.at[number];
  uint32_t slots = mesh->material_slots.count ? mesh->material_slots.count : 1;
  shown_polygons shown;
  style->level = level < mesh->levels.count ? level : mesh->levels.count;
  style->patches = calloc(slots, sizeof *style->patches);
  style->patch_count = slots;
  bool hard, good = shown_of_mesh(s, number, style->level, &shown) && style->patches;
  style->torn = calloc(shown.sizes.count + 1u, 1);
  good = good && style->torn && has_hard_edges(mesh, &hard);
  for (uint32_t p = 0; good && p < slots; p++) {
    style->patches[p].style = skin_material_of(s->asset, images, mesh, p);
    good = cut_patch(mesh, &shown, hard, p, &style->patches[p]);
  }
  free(shown.position_of);
  free(shown.corner_of);
  return good;
}

/* Allocates the buffers that are rewritten in each frame. */
static bool reserve(shown_skin *skin, const sbf_asset *asset) {
  uint32_t corners = 0;
  skin->capacity = 1;
  for (uint32_t m = 0; m < skin->mesh_count; m++) {
    const sbf_render_mesh *mesh = &asset->render_meshes.at[m];
    if (mesh->mesh.positions.count > skin->capacity) skin->capacity = mesh->mesh.positions.count;
    if (mesh->mesh.polygon_points.count > corners) corners = mesh->mesh.polygon_points.count;
    for (uint32_t l = 0; l < mesh->levels.count; l++)
      if (mesh->levels.at[l].polygon_points.count > corners)
        corners = mesh->levels.at[l].polygon_points.count;
  }
  skin->corner_capacity = corners;
  skin->positions = malloc(skin->capacity * sizeof *skin->positions);
  skin->normals = malloc(skin->capacity * sizeof *skin->normals);
  skin->of_corners = malloc((corners + 1u) * sizeof *skin->of_corners);
  skin->of_triangles = malloc((3 * (size_t)corners + 1) * sizeof *skin->of_triangles);
  return skin->positions && skin->normals && skin->of_corners && skin->of_triangles;
}

shown_skin *shown_skin_create(const session *s, const skin_images *images, uint32_t render_level) {
  shown_skin *skin = calloc(1, sizeof *skin);
  if (!skin) return NULL;
  skin->mesh_count = s->asset->render_meshes.count;
  skin->meshes = calloc(skin->mesh_count + 1u, sizeof *skin->meshes);
  bool good = skin->meshes && reserve(skin, s->asset);
  for (uint32_t i = 0; good && i < skin->mesh_count; i++)
    good = style_of_mesh(s, images, i, render_level, &skin->meshes[i]);
  if (good) return skin;
  shown_skin_destroy(skin);
  return NULL;
}

static void free_patch(patch *p) {
  free(p->triangles);
  free(p->whole);
  free(p->polygons);
  free(p->uvs);
  free(p->whole_uvs);
  free(p->colours);
  free(p->whole_colours);
  free(p->corners);
  free(p->whole_corners);
}

void shown_skin_destroy(shown_skin *skin) {
  if (!skin) return;
  for (uint32_t i = 0; skin->meshes && i < skin->mesh_count; i++) {
    for (uint32_t p = 0; skin->meshes[i].patches && p < skin->meshes[i].patch_count; p++)
      free_patch(&skin->meshes[i].patches[p]);
    free(skin->meshes[i].patches);
    free(skin->meshes[i].torn);
  }
  free(skin->meshes);
  free(skin->positions);
  free(skin->normals);
  free(skin->of_corners);
  free(skin->of_triangles);
  free(skin);
}

/* Copies the patch's triangles that are not torn to p->whole and related buffers; returns their number. */
static uint32_t copy_whole(const patch *p, const uint8_t *torn) {
  uint32_t count = 0;
  for (uint32_t i = 0; i < p->triangle_count; i++) {
    if (torn[p->polygons[i]]) continue;
    if (p->uvs) memcpy(p->whole_uvs + 3 * (size_t)count, p->uvs + 3 * (size_t)i, 3 * sizeof *p->uvs);
    if (p->colours)
      memcpy(p->whole_colours + 3 * (size_t)count, p->colours + 3 * (size_t)i, 3 * sizeof *p->colours);
    if (p->corners)
      memcpy(p->whole_corners + 3 * (size_t)count, p->corners + 3 * (size_t)i, 3 * sizeof *p->corners);
    memcpy(p->whole + 3 * (size_t)count++, p->triangles + 3 * (size_t)i, 3 * sizeof *p->whole);
  }
  return count;
}

/* Normals of the corners of these triangles; NULL: the patch has no hard edges. */
static const sbf_vec3 *normals_of(shown_skin *skin, const patch *p, uint32_t triangles) {
  if (!p->corners) return NULL;
  for (uint32_t k = 0; k < 3 * triangles; k++) skin->of_triangles[k] = skin->of_corners[p->whole_corners[k]];
  return skin->of_triangles;
}

static void add_mesh(shown_skin *skin, const session *s, uint32_t number, sbf_vec3 origin, float transparency,
    draw_scene *scene) {
  const mesh_style *mesh = &skin->meshes[number];
  uint32_t count = sbr_character_get_level_skin(
      s->world, s->character, number, mesh->level, skin->positions, skin->normals, NULL, skin->capacity);
  for (uint32_t i = 0; i < count; i++) {
    sbf_vec3 *p = &skin->positions[i];
    *p = (sbf_vec3){p->x + origin.x, p->y + origin.y, p->z + origin.z};
  }
  uint32_t polygons = sbr_character_get_torn_polygons(s->world, s->character, number, mesh->level, NULL, 0);
  sbr_character_get_torn_polygons(s->world, s->character, number, mesh->level, mesh->torn, polygons);
  if (mesh->patches[0].corners)
    sbr_character_get_level_corner_normals(
        s->world, s->character, number, mesh->level, skin->of_corners, skin->corner_capacity);
  for (uint32_t p = 0; p < mesh->patch_count; p++) {
    const patch *one = &mesh->patches[p];
    uint32_t triangles = copy_whole(one, mesh->torn);
    if (triangles == 0) continue;
    draw_mesh drawn = {.positions = skin->positions,
        .normals = skin->normals,
        .corner_normals = normals_of(skin, one, triangles),
        .triangles = one->whole,
        .vertex_count = count,
        .triangle_count = triangles,
        .corner_uvs = one->whole_uvs,
        .corner_colours = one->whole_colours,
        .transparency = transparency};
    skin_material_apply(&one->style, &drawn);
    draw_scene_add_mesh(scene, &drawn);
  }
}

void shown_skin_add(
    shown_skin *skin, const session *s, sbf_vec3 origin, float transparency, draw_scene *scene) {
  for (uint32_t m = 0; m < skin->mesh_count; m++) add_mesh(skin, s, m, origin, transparency, scene);
}
