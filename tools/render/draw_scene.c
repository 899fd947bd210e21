#include "render/draw_scene.h"

#include <stdlib.h>
#include <string.h>

#include "render/draw_scene_data.h"

draw_scene *draw_scene_create(void) {
  draw_scene *made = calloc(1, sizeof *made);
  if (made) made->bounds = made->casters = box3_empty();
  return made;
}

void draw_scene_destroy(draw_scene *scene) {
  if (!scene) return;
  draw_scene_list *lists[] = {&scene->positions, &scene->normals, &scene->colours, &scene->uvs,
      &scene->smooth_normals, &scene->indices, &scene->parts, &scene->lines, &scene->painted.sorted_lines,
      &scene->marks, &scene->prints, &scene->painted.mark_rims, &scene->painted.line_corners,
      &scene->painted.sorted_parts, &scene->overlay.lines, &scene->painted.overlay, &scene->ground.positions,
      &scene->ground.normals, &scene->ground.indices};
  for (size_t i = 0; i < sizeof lists / sizeof *lists; i++) free(lists[i]->at);
  free(scene);
}

void draw_scene_clear_ground(draw_scene *scene) {
  scene->ground.positions.count = scene->ground.normals.count = scene->ground.indices.count = 0;
  scene->has_floor = false;
}

void draw_scene_clear(draw_scene *scene) {
  scene->positions.count = scene->normals.count = scene->colours.count = scene->uvs.count = 0;
  scene->indices.count = scene->parts.count = 0;
  scene->lines.count = scene->painted.sorted_lines.count = scene->painted.sorted_parts.count = 0;
  scene->marks.count = scene->prints.count = scene->painted.mark_rims.count = 0;
  scene->overlay.lines.count = scene->painted.overlay.count = 0;
  scene->overlay.rows = scene->overlay.note_rows = 0;
  draw_scene_clear_ground(scene);
  scene->bounds = scene->casters = box3_empty();
  scene->failed = false;
}

box3 draw_scene_bounds(const draw_scene *scene) {
  return scene->bounds;
}

/* Lines and dots may be drawn without their surface: then the surfaces' points do not give the size. */
static bool lines_reach_beyond(const draw_scene *scene) {
  const box3 *all = &scene->bounds, *solid = &scene->casters;
  if (box3_is_empty(all) || box3_is_empty(solid)) return !box3_is_empty(all);
  float margin = 0.01f * (all->max.x - all->min.x + all->max.y - all->min.y + all->max.z - all->min.z);
  return all->min.x < solid->min.x - margin || all->min.y < solid->min.y - margin ||
         all->min.z < solid->min.z - margin || all->max.x > solid->max.x + margin ||
         all->max.y > solid->max.y + margin || all->max.z > solid->max.z + margin;
}

void draw_scene_frame(const draw_scene *scene, draw_camera *camera, float aspect, float yaw, float pitch) {
  const sbf_vec3 *points = scene->positions.at;
  if (!lines_reach_beyond(scene) && scene->positions.count > 0 && scene->positions.count <= UINT32_MAX)
    draw_camera_frame_points(camera, points, (uint32_t)scene->positions.count, aspect, yaw, pitch);
  else
    draw_camera_frame(camera, &scene->bounds, aspect, yaw, pitch);
}

void draw_scene_follow(const draw_scene *scene, draw_camera *camera, float aspect, float seconds) {
  draw_camera best;
  if (box3_is_empty(&scene->bounds)) return;
  draw_scene_frame(scene, &best, aspect, camera->yaw, camera->pitch);
  draw_camera_follow(camera, &best, seconds);
}

void *draw_scene_list_push(draw_scene *scene, draw_scene_list *list, size_t count, size_t item_size) {
  if (count > SIZE_MAX / 4 / item_size - list->count) {
    scene->failed = true;
    return NULL;
  }
  if (!list->at || list->count + count > list->capacity) {
    size_t capacity = list->capacity + list->capacity / 2 + 64;
    if (capacity < list->count + count) capacity = list->count + count;
    void *grown = realloc(list->at, capacity * item_size);
    if (!grown) {
      scene->failed = true;
      return NULL;
    }
    list->at = grown;
    list->capacity = capacity;
  }
  void *destination = (char *)list->at + list->count * item_size;
  list->count += count;
  return destination;
}

bool draw_scene_reserve(
    draw_scene *scene, uint32_t vertex_count, uint32_t triangle_count, draw_scene_space *space) {
  size_t vertices = scene->positions.count, indices = scene->indices.count;
  space->first_vertex = (uint32_t)vertices;
  space->positions = space->normals = NULL;
  space->colours = NULL;
  space->uvs = NULL;
  space->indices = NULL;
  if (vertices + vertex_count <= UINT32_MAX && triangle_count <= UINT32_MAX / 3) {
    space->positions = draw_scene_list_push(scene, &scene->positions, vertex_count, sizeof(sbf_vec3));
    space->normals = draw_scene_list_push(scene, &scene->normals, vertex_count, sizeof(sbf_vec3));
    space->colours = draw_scene_list_push(scene, &scene->colours, vertex_count, sizeof(draw_colour));
    space->uvs = draw_scene_list_push(scene, &scene->uvs, vertex_count, sizeof(sbf_vec2));
    space->indices =
        draw_scene_list_push(scene, &scene->indices, 3 * (size_t)triangle_count, sizeof(uint32_t));
  }
  if (space->positions && space->normals && space->colours && space->uvs && space->indices) {
    memset(space->uvs, 0, vertex_count * sizeof *space->uvs);
    return true;
  }
  scene->positions.count = scene->normals.count = scene->colours.count = scene->uvs.count = vertices;
  scene->indices.count = indices;
  scene->failed = true;
  return false;
}

static bool is_same_style(const draw_scene_part *a, const draw_scene_part *b) {
  return a->transparency == b->transparency && a->casts_shadow == b->casts_shadow && a->image == b->image &&
         a->alpha == b->alpha && a->cutoff == b->cutoff && a->one_sided == b->one_sided;
}

void draw_scene_close_part(draw_scene *scene, const draw_scene_space *space, uint32_t vertex_count,
    uint32_t index_count, const draw_scene_part *style) {
  draw_scene_part part = *style;
  box3 box = box3_empty();
  part.first_index = (uint32_t)(space->indices - (uint32_t *)scene->indices.at);
  part.index_count = index_count;
  scene->indices.count = part.first_index + index_count;
  for (uint32_t i = 0; i < vertex_count; i++) box3_add(&box, space->positions[i]);
  if (!box3_is_empty(&box)) {
    part.middle = v3_scale(v3_add(box.min, box.max), 0.5f);
    box3_add(&scene->bounds, box.min);
    box3_add(&scene->bounds, box.max);
    if (part.casts_shadow) {
      box3_add(&scene->casters, box.min);
      box3_add(&scene->casters, box.max);
    }
  }
  /* Merges consecutive meshes with one look: one draw call, and one skin if transparent, in which sections
   * of a body do not show inside each other. Parts without shadow, and blended parts, stay separate and
   * are drawn in order. */
  draw_scene_part *last =
      scene->parts.count ? (draw_scene_part *)scene->parts.at + scene->parts.count - 1 : NULL;
  if (last && is_same_style(last, &part) && part.alpha != DRAW_BLEND &&
      (part.transparency <= 0 || part.casts_shadow)) {
    last->index_count += index_count;
    return;
  }
  draw_scene_part *position = draw_scene_list_push(scene, &scene->parts, 1, sizeof part);
  if (position) *position = part;
}

void draw_scene_smooth_normals(const sbf_vec3 *positions, uint32_t vertex_count, const uint32_t *triangles,
    uint32_t index_count, sbf_vec3 *normals) {
  memset(normals, 0, vertex_count * sizeof *normals);
  for (uint32_t i = 0; i + 2 < index_count; i += 3) {
    const uint32_t *corner = triangles + i;
    sbf_vec3 a = positions[corner[0]];
    sbf_vec3 across = v3_cross(v3_sub(positions[corner[1]], a), v3_sub(positions[corner[2]], a));
    for (int k = 0; k < 3; k++) normals[corner[k]] = v3_add(normals[corner[k]], across);
  }
  for (uint32_t i = 0; i < vertex_count; i++) normals[i] = v3_unit(normals[i], v3(0, 1, 0));
}

static bool in_range(const uint32_t *triangle, uint32_t vertex_count) {
  return triangle[0] < vertex_count && triangle[1] < vertex_count && triangle[2] < vertex_count;
}

static sbf_vec3 placed(const draw_transform *transform, sbf_vec3 p) {
  return transform ? v3_add(v3_rotate(transform->rotation, p), transform->position) : p;
}

static sbf_vec3 turned(const draw_transform *transform, sbf_vec3 normal) {
  return transform ? v3_rotate(transform->rotation, normal) : normal;
}

static void add_smooth(draw_scene *scene, const draw_mesh *mesh, const draw_scene_part *style) {
  draw_scene_space space;
  uint32_t index_count = 0;
  if (!draw_scene_reserve(scene, mesh->vertex_count, mesh->triangle_count, &space)) return;
  for (uint32_t i = 0; i < mesh->vertex_count; i++) {
    space.positions[i] = placed(mesh->transform, mesh->positions[i]);
    space.colours[i] = mesh->colours ? mesh->colours[i] : mesh->colour;
  }
  for (uint32_t t = 0; t < mesh->triangle_count; t++) {
    const uint32_t *triangle = mesh->triangles + 3 * (size_t)t;
    if (!in_range(triangle, mesh->vertex_count)) continue;
    for (int k = 0; k < 3; k++) space.indices[index_count++] = triangle[k];
  }
  if (mesh->normals)
    for (uint32_t i = 0; i < mesh->vertex_count; i++)
      space.normals[i] = turned(mesh->transform, mesh->normals[i]);
  else
    draw_scene_smooth_normals(space.positions, mesh->vertex_count, space.indices, index_count, space.normals);
  for (uint32_t i = 0; i < index_count; i++) space.indices[i] += space.first_vertex;
  draw_scene_close_part(scene, &space, mesh->vertex_count, index_count, style);
}

/* Of the mesh's vertices before its transform; `indices` has a capacity for all its triangles. */
static const sbf_vec3 *find_smooth_normals(draw_scene *scene, const draw_mesh *mesh, uint32_t *indices) {
  uint32_t count = 0;
  scene->smooth_normals.count = 0;
  sbf_vec3 *normals =
      draw_scene_list_push(scene, &scene->smooth_normals, mesh->vertex_count, sizeof *normals);
  for (uint32_t t = 0; normals && t < mesh->triangle_count; t++) {
    const uint32_t *triangle = mesh->triangles + 3 * (size_t)t;
    if (!in_range(triangle, mesh->vertex_count)) continue;
    for (int k = 0; k < 3; k++) indices[count++] = triangle[k];
  }
  if (normals) draw_scene_smooth_normals(mesh->positions, mesh->vertex_count, indices, count, normals);
  return normals;
}

/* Uses a separate vertex for each corner: for facets, hard edges, and seams of images. */
static void add_corners(draw_scene *scene, const draw_mesh *mesh, const draw_scene_part *style) {
  draw_scene_space space;
  uint32_t count = 0;
  if (mesh->triangle_count > UINT32_MAX / 3 ||
      !draw_scene_reserve(scene, 3 * mesh->triangle_count, mesh->triangle_count, &space)) {
    scene->failed = true;
    return;
  }
  const sbf_vec3 *normals = mesh->normals, *hard = mesh->flat ? NULL : mesh->corner_normals;
  if (!mesh->flat && !normals && !hard) normals = find_smooth_normals(scene, mesh, space.indices);
  bool facets = mesh->flat || (!normals && !hard);
  for (uint32_t t = 0; t < mesh->triangle_count; t++) {
    const uint32_t *triangle = mesh->triangles + 3 * (size_t)t;
    if (!in_range(triangle, mesh->vertex_count)) continue;
    sbf_vec3 corner[3];
    for (int k = 0; k < 3; k++) corner[k] = placed(mesh->transform, mesh->positions[triangle[k]]);
    sbf_vec3 across = v3_cross(v3_sub(corner[1], corner[0]), v3_sub(corner[2], corner[0]));
    sbf_vec3 of_facet = v3_unit(across, v3(0, 1, 0));
    for (int k = 0; k < 3; k++, count++) {
      space.positions[count] = corner[k];
      if (facets)
        space.normals[count] = of_facet;
      else
        space.normals[count] =
            turned(mesh->transform, hard ? hard[3 * (size_t)t + (size_t)k] : normals[triangle[k]]);
      space.colours[count] = mesh->corner_colours ? mesh->corner_colours[3 * (size_t)t + (size_t)k]
                             : mesh->colours      ? mesh->colours[triangle[k]]
                                                  : mesh->colour;
      if (style->image) space.uvs[count] = mesh->corner_uvs[3 * (size_t)t + (size_t)k];
      space.indices[count] = space.first_vertex + count;
    }
  }
  scene->positions.count = scene->normals.count = scene->colours.count = scene->uvs.count =
      space.first_vertex + (size_t)count;
  draw_scene_close_part(scene, &space, count, count, style);
}

void draw_scene_add_mesh(draw_scene *scene, const draw_mesh *mesh) {
  draw_scene_part style = {.transparency = mesh->transparency, .casts_shadow = !mesh->no_shadow};
  if (mesh->triangle_count == 0 || mesh->vertex_count == 0) return;
  if (mesh->transparency <= 0) { /* a transparent one has no texture */
    style.image = mesh->corner_uvs ? mesh->image : NULL;
    style.alpha = mesh->alpha;
    style.cutoff = mesh->cutoff;
    style.one_sided = mesh->one_sided;
    style.casts_shadow = style.casts_shadow && mesh->alpha != DRAW_BLEND;
  }
  if (mesh->flat || mesh->corner_normals || mesh->corner_colours || style.image)
    add_corners(scene, mesh, &style);
  else
    add_smooth(scene, mesh, &style);
}

void draw_scene_add_line(draw_scene *scene, const draw_line *line) {
  draw_line *stored = draw_scene_list_push(scene, &scene->lines, 1, sizeof *stored);
  if (!stored) return;
  *stored = *line;
  box3_add(&scene->bounds, line->from);
  box3_add(&scene->bounds, line->to);
}

void draw_scene_add_dot(draw_scene *scene, sbf_vec3 at, float width, draw_colour colour) {
  draw_scene_add_line(scene, &(draw_line){at, at, colour, colour, width});
}

void draw_scene_add_lines(draw_scene *scene, const sbf_vec3 *positions, uint32_t position_count,
    const sbf_uint2 *ends, const draw_colour *colours, uint32_t line_count, draw_colour colour, float width) {
  draw_line *stored = draw_scene_list_push(scene, &scene->lines, line_count, sizeof *stored);
  if (!stored) return;
  size_t added = 0;
  for (uint32_t i = 0; i < line_count; i++) {
    if (ends[i].at[0] >= position_count || ends[i].at[1] >= position_count) continue;
    draw_colour shown = colours ? colours[i] : colour;
    draw_line line = {positions[ends[i].at[0]], positions[ends[i].at[1]], shown, shown, width};
    stored[added++] = line;
    box3_add(&scene->bounds, line.from);
    box3_add(&scene->bounds, line.to);
  }
  scene->lines.count -= line_count - added;
}

void draw_scene_set_floor(draw_scene *scene, float height) {
  draw_scene_clear_ground(scene);
  scene->has_floor = true;
  scene->floor_height = height;
}

void draw_scene_set_ground(draw_scene *scene, const sbf_vec3 *positions, const sbf_vec3 *normals,
    uint32_t vertex_count, const uint32_t *triangles, uint32_t triangle_count) {
  draw_scene_clear_ground(scene);
  if (triangle_count == 0 || vertex_count == 0 || triangle_count > UINT32_MAX / 3) return;
  sbf_vec3 *to = draw_scene_list_push(scene, &scene->ground.positions, vertex_count, sizeof *to);
  sbf_vec3 *normal = draw_scene_list_push(scene, &scene->ground.normals, vertex_count, sizeof *normal);
  uint32_t *index =
      draw_scene_list_push(scene, &scene->ground.indices, 3 * (size_t)triangle_count, sizeof *index);
  if (!to || !normal || !index) {
    draw_scene_clear_ground(scene);
    return;
  }
  uint32_t count = 0;
  memcpy(to, positions, vertex_count * sizeof *to);
  for (uint32_t t = 0; t < triangle_count; t++) {
    const uint32_t *triangle = triangles + 3 * (size_t)t;
    if (!in_range(triangle, vertex_count)) continue;
    for (int k = 0; k < 3; k++) index[count++] = triangle[k];
  }
  scene->ground.indices.count = count;
  if (normals)
    memcpy(normal, normals, vertex_count * sizeof *normal);
  else
    draw_scene_smooth_normals(to, vertex_count, index, count, normal);
}
