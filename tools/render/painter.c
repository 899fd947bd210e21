#include "render/painter.h"

#include <stddef.h>
#include <stdlib.h>
#include <string.h>

#include "render/draw_scene_data.h"
#include "render/fault.h"
#include "render/image_textures.h"
#include "render/layers.h"
#include "render/light_maps.h"
#include "render/programs.h"

enum { DISC_POINTS = 24 };

/* The block Frame of shaders/common.glsl, in its order: std140 packs vec4 and mat4 as C does. */
typedef struct frame_block {
  matrix4 clip_from_world, shadow_from_world;
  float eye[4], subject[4], key[4], fill[4], rim[4], screen[4], floor_grid[4], ground_map[4], heights[4],
      shadow[4], depth[4];
  float disc[DISC_POINTS][4];
} frame_block;

/* A vertex array and the buffers it reads. */
typedef struct mesh_buffers {
  GLuint array, positions, normals, colours, uvs, indices;
} mesh_buffers;

struct draw_painter {
  draw_canvas *canvas;
  program_set programs;
  light_maps maps;
  mesh_buffers meshes, ground;
  GLuint line_array, line_buffer, line_indices, empty_array, frame_buffer;
  size_t line_room; /* lines that line_indices has corners for */
  layer_set layers;
  image_textures images;
  frame_block frame;
  GLsizei ground_indices; /* in this frame */
};

static void make_attribute(
    const gl_api *gl, GLuint buffer, GLuint place, GLint size, GLenum type, GLsizei stride, size_t offset) {
  gl->BindBuffer(GL_ARRAY_BUFFER, buffer);
  gl->EnableVertexAttribArray(place);
  gl->VertexAttribPointer(
      place, size, type, type == GL_UNSIGNED_BYTE, stride, (const void *)(uintptr_t)offset);
}

static void make_mesh_buffers(const gl_api *gl, mesh_buffers *made, bool coloured) {
  GLuint buffers[5];
  gl->GenVertexArrays(1, &made->array);
  gl->GenBuffers(5, buffers);
  made->positions = buffers[0], made->normals = buffers[1], made->colours = buffers[2];
  made->uvs = buffers[3], made->indices = buffers[4];
  gl->BindVertexArray(made->array);
  make_attribute(gl, made->positions, 0, 3, GL_FLOAT, 0, 0);
  make_attribute(gl, made->normals, 1, 3, GL_FLOAT, 0, 0);
  if (coloured) {
    make_attribute(gl, made->colours, 2, 4, GL_UNSIGNED_BYTE, 0, 0);
    make_attribute(gl, made->uvs, 3, 2, GL_FLOAT, 0, 0);
  }
  gl->BindBuffer(GL_ELEMENT_ARRAY_BUFFER, made->indices);
}

static void make_line_buffers(const gl_api *gl, draw_painter *painter) {
  const GLsizei stride = (GLsizei)sizeof(draw_line);
  gl->GenVertexArrays(1, &painter->line_array);
  gl->GenBuffers(1, &painter->line_buffer);
  gl->BindVertexArray(painter->line_array);
  GLuint buffer = painter->line_buffer;
  make_attribute(gl, buffer, 0, 3, GL_FLOAT, stride, offsetof(draw_line, from));
  make_attribute(gl, buffer, 1, 3, GL_FLOAT, stride, offsetof(draw_line, to));
  make_attribute(gl, buffer, 2, 4, GL_UNSIGNED_BYTE, stride, offsetof(draw_line, from_colour));
  make_attribute(gl, buffer, 3, 4, GL_UNSIGNED_BYTE, stride, offsetof(draw_line, to_colour));
  make_attribute(gl, buffer, 4, 1, GL_FLOAT, stride, offsetof(draw_line, width));
  gl->GenBuffers(1, &painter->line_indices);
  gl->BindBuffer(GL_ELEMENT_ARRAY_BUFFER, painter->line_indices);
}

sbf_status draw_painter_create(draw_painter **created, draw_canvas *canvas, sbf_diagnostic *diagnostic) {
  const gl_api *gl = draw_canvas_gl(canvas);
  *created = NULL;
  draw_painter *made = calloc(1, sizeof *made);
  if (!made) return fault_set(diagnostic, SBF_CODE_OUT_OF_MEMORY, "no memory for a painter");
  made->canvas = canvas;
  sbf_status status = programs_create(&made->programs, gl, diagnostic);
  if (status == SBF_OK && !light_maps_create(&made->maps, gl))
    status =
        fault_set(diagnostic, SBF_CODE_OPENGL_FAILED, "this OpenGL cannot draw into the maps light needs");
  if (status != SBF_OK) {
    draw_painter_destroy(made);
    return status;
  }
  make_mesh_buffers(gl, &made->meshes, true);
  make_mesh_buffers(gl, &made->ground, false);
  make_line_buffers(gl, made);
  gl->GenVertexArrays(1, &made->empty_array);
  gl->GenBuffers(1, &made->frame_buffer);
  /* Vogel's spiral: the golden angle from each point to the next covers a disc evenly. */
  for (int i = 0; i < DISC_POINTS; i++) {
    float radius = sqrtf(((float)i + 0.5f) / DISC_POINTS), angle = 2.39996323f * (float)i;
    made->frame.disc[i][0] = radius * cosf(angle);
    made->frame.disc[i][1] = radius * sinf(angle);
  }
  *created = made;
  return SBF_OK;
}

void draw_painter_destroy(draw_painter *painter) {
  if (!painter) return;
  const gl_api *gl = draw_canvas_gl(painter->canvas);
  const GLuint buffers[] = {painter->meshes.positions, painter->meshes.normals, painter->meshes.colours,
      painter->meshes.uvs, painter->meshes.indices, painter->ground.positions, painter->ground.normals,
      painter->ground.colours, painter->ground.uvs, painter->ground.indices, painter->line_buffer,
      painter->line_indices, painter->frame_buffer};
  const GLuint arrays[] = {
      painter->meshes.array, painter->ground.array, painter->line_array, painter->empty_array};
  gl->DeleteBuffers((GLsizei)(sizeof buffers / sizeof *buffers), buffers); /* 0 is ignored */
  gl->DeleteVertexArrays((GLsizei)(sizeof arrays / sizeof *arrays), arrays);
  image_textures_destroy(&painter->images, gl);
  layers_destroy(&painter->layers, gl);
  light_maps_destroy(&painter->maps, gl);
  programs_destroy(&painter->programs, gl);
  free(painter);
}

static void upload(const gl_api *gl, GLenum target, GLuint buffer, const void *items, size_t bytes) {
  gl->BindBuffer(target, buffer);
  gl->BufferData(target, (GLsizeiptr)bytes, bytes ? items : NULL, GL_STREAM_DRAW);
}

static void upload_mesh(const gl_api *gl, const mesh_buffers *to, const draw_scene_list *positions,
    const draw_scene_list *normals, const draw_scene_list *indices) {
  gl->BindVertexArray(to->array);
  upload(gl, GL_ARRAY_BUFFER, to->positions, positions->at, positions->count * sizeof(sbf_vec3));
  upload(gl, GL_ARRAY_BUFFER, to->normals, normals->at, normals->count * sizeof(sbf_vec3));
  upload(gl, GL_ELEMENT_ARRAY_BUFFER, to->indices, indices->at, indices->count * sizeof(uint32_t));
}

/* A floor without end is a square about the subject, as far as the ground is seen. */
static void upload_floor(
    draw_painter *painter, const gl_api *gl, const draw_scene *scene, sbf_vec3 subject, float radius) {
  static uint32_t triangles[6] = {0, 2, 1, 0, 3, 2};
  sbf_vec3 corners[4], normals[4];
  for (int i = 0; i < 4; i++) {
    corners[i] = v3(subject.x + (i == 1 || i == 2 ? radius : -radius), scene->floor_height,
        subject.z + (i >= 2 ? radius : -radius));
    normals[i] = v3(0, 1, 0);
  }
  draw_scene_list positions = {corners, 4, 4}, up = {normals, 4, 4}, indices = {triangles, 6, 6};
  upload_mesh(gl, &painter->ground, &positions, &up, &indices);
  painter->ground_indices = 6;
}

static void upload_scene(
    draw_painter *painter, const gl_api *gl, const draw_scene *scene, sbf_vec3 subject, float ground_radius) {
  upload_mesh(gl, &painter->meshes, &scene->positions, &scene->normals, &scene->indices);
  upload(gl, GL_ARRAY_BUFFER, painter->meshes.colours, scene->colours.at,
      scene->colours.count * sizeof(draw_colour));
  upload(gl, GL_ARRAY_BUFFER, painter->meshes.uvs, scene->uvs.at, scene->uvs.count * sizeof(sbf_vec2));
  if (scene->has_floor) {
    upload_floor(painter, gl, scene, subject, ground_radius);
  } else {
    upload_mesh(
        gl, &painter->ground, &scene->ground_positions, &scene->ground_normals, &scene->ground_indices);
    painter->ground_indices = (GLsizei)scene->ground_indices.count;
  }
}

static void draw_indices(const gl_api *gl, size_t first, GLsizei count) {
  if (count > 0)
    gl->DrawElements(
        GL_TRIANGLES, count, GL_UNSIGNED_INT, (const void *)(uintptr_t)(first * sizeof(uint32_t)));
}

static void draw_casters(const draw_painter *painter, const gl_api *gl, const draw_scene *scene) {
  const draw_scene_part *parts = scene->parts.at;
  gl->BindVertexArray(painter->meshes.array);
  bool any = !box3_is_empty(&scene->casters); /* else all do */
  for (size_t i = 0; i < scene->parts.count; i++)
    if (parts[i].casts_shadow || !any) draw_indices(gl, parts[i].first_index, (GLsizei)parts[i].index_count);
}

static void begin_depth_map(const gl_api *gl, GLuint frame, GLsizei width, GLsizei height, double depth) {
  gl->BindFramebuffer(GL_FRAMEBUFFER, frame);
  gl->Viewport(0, 0, width, height);
  gl->ClearDepth(depth);
  gl->Clear(GL_DEPTH_BUFFER_BIT);
}

static void bind_texture(const gl_api *gl, GLuint unit, GLuint texture, GLuint sampler) {
  gl->ActiveTexture(GL_TEXTURE0 + unit);
  gl->BindTexture(GL_TEXTURE_2D, texture);
  gl->BindSampler(unit, sampler);
}

static void begin_light_map(const gl_api *gl, GLuint frame, GLsizei side) {
  gl->BindFramebuffer(GL_FRAMEBUFFER, frame);
  gl->Viewport(0, 0, side, side);
}

static void paint_ground_light(const draw_painter *painter, const gl_api *gl) {
  const light_maps *maps = &painter->maps;
  gl->Disable(GL_DEPTH_TEST);
  bind_texture(gl, UNIT_SHADOW_MAP, maps->shadow_texture, maps->compared);
  bind_texture(gl, UNIT_SHADOW_DEPTHS, maps->shadow_texture, maps->plain);
  bind_texture(gl, UNIT_GROUND_HEIGHTS, maps->ground_texture, 0);
  bind_texture(gl, UNIT_LOWEST_HEIGHTS, maps->lowest_texture, 0);
  gl->BindVertexArray(painter->empty_array);
  if (painter->ground_indices) {
    begin_light_map(gl, maps->open_frame, HEIGHT_MAP_SIDE);
    gl->UseProgram(painter->programs.at[PROGRAM_OPEN_SKY]);
    gl->DrawArrays(GL_TRIANGLES, 0, 3);
    bind_texture(gl, UNIT_OPEN_SKY, maps->open_texture, 0);
    begin_light_map(gl, maps->light_frame, GROUND_MAP_SIDE);
    gl->UseProgram(painter->programs.at[PROGRAM_GROUND_LIGHT]);
    gl->DrawArrays(GL_TRIANGLES, 0, 3);
  } else {
    begin_light_map(gl, maps->light_frame, GROUND_MAP_SIDE);
    gl->ClearColor(1, 1, 1, 1); /* no ground, no shade on it */
    gl->Clear(GL_COLOR_BUFFER_BIT);
  }
  begin_light_map(gl, maps->softened_frame, GROUND_MAP_SIDE);
  bind_texture(gl, UNIT_GROUND_LIGHT, maps->light_texture, 0);
  gl->UseProgram(painter->programs.at[PROGRAM_SOFTEN]);
  gl->DrawArrays(GL_TRIANGLES, 0, 3);
  bind_texture(gl, UNIT_GROUND_LIGHT, maps->softened_texture, 0);
}

static void paint_maps(
    draw_painter *painter, const gl_api *gl, const draw_scene *scene, const light_place *place) {
  const light_maps *maps = &painter->maps;
  gl->Enable(GL_DEPTH_TEST);
  gl->Disable(GL_BLEND);
  gl->DepthMask(GL_TRUE);
  gl->DepthFunc(GL_LESS);
  gl->UseProgram(painter->programs.at[PROGRAM_DEPTH]);
  gl->UniformMatrix4fv(painter->programs.map_from_world, 1, GL_FALSE, place->shadow_clip_from_world.at);
  begin_depth_map(gl, maps->shadow_frame, SHADOW_MAP_SIDE, SHADOW_MAP_SIDE, 1);
  draw_casters(painter, gl, scene);
  gl->UniformMatrix4fv(painter->programs.map_from_world, 1, GL_FALSE, place->heights_clip_from_world.at);
  begin_depth_map(gl, maps->lowest_frame, HEIGHT_MAP_SIDE, HEIGHT_MAP_SIDE, 1);
  draw_casters(painter, gl, scene);
  float range = place->high - place->low;
  double level = scene->has_floor ? (scene->floor_height - place->low) / range : 0;
  begin_depth_map(gl, maps->ground_frame, HEIGHT_MAP_SIDE, HEIGHT_MAP_SIDE, level);
  if (!scene->has_floor && painter->ground_indices) {
    gl->DepthFunc(GL_GREATER);
    gl->BindVertexArray(painter->ground.array);
    draw_indices(gl, 0, painter->ground_indices);
  }
  gl->ClearDepth(1);

  paint_ground_light(painter, gl);
}

static void draw_solid(const gl_api *gl, const draw_scene *scene) {
  const draw_scene_part *parts = scene->parts.at;
  for (size_t i = 0; i < scene->parts.count; i++)
    if (parts[i].transparency <= 0) draw_indices(gl, parts[i].first_index, (GLsizei)parts[i].index_count);
}

/* Depth alone, a hair behind where it is: colour drawn afterwards passes in front of it, and what lies
 * farther back is never lit, which without a graphics card is most of the work. */
static void begin_depth_first(const draw_painter *painter, const gl_api *gl) {
  gl->UseProgram(painter->programs.at[PROGRAM_DEPTH]);
  gl->UniformMatrix4fv(painter->programs.map_from_world, 1, GL_FALSE, painter->frame.clip_from_world.at);
  gl->ColorMask(GL_FALSE, GL_FALSE, GL_FALSE, GL_FALSE);
  gl->DepthMask(GL_TRUE);
  gl->DepthFunc(GL_LESS);
  gl->Enable(GL_POLYGON_OFFSET_FILL);
  gl->PolygonOffset(1, 2);
}

static void end_depth_first(const gl_api *gl) {
  gl->Disable(GL_POLYGON_OFFSET_FILL);
  gl->ColorMask(GL_TRUE, GL_TRUE, GL_TRUE, GL_TRUE);
}

/* Those with an image on them or those without; an image that this OpenGL cannot hold is as none. */
static void colour_solid(draw_painter *painter, const gl_api *gl, const draw_scene *scene, bool with_image) {
  const draw_scene_part *parts = scene->parts.at;
  gl->UseProgram(painter->programs.at[with_image ? PROGRAM_MESH_IMAGE : PROGRAM_MESH]);
  gl->ActiveTexture(GL_TEXTURE0 + UNIT_BASE_IMAGE);
  for (size_t i = 0; i < scene->parts.count; i++) {
    if (parts[i].transparency > 0) continue;
    GLuint image = parts[i].image ? image_textures_of(&painter->images, gl, parts[i].image) : 0;
    if ((image != 0) != with_image) continue;
    gl->BindTexture(GL_TEXTURE_2D, image);
    draw_indices(gl, parts[i].first_index, (GLsizei)parts[i].index_count);
  }
}

static void paint_solid(draw_painter *painter, const gl_api *gl, const draw_scene *scene) {
  gl->Enable(GL_DEPTH_TEST);
  gl->BindVertexArray(painter->meshes.array);
  begin_depth_first(painter, gl);
  draw_solid(gl, scene);
  end_depth_first(gl);
  colour_solid(painter, gl, scene, false);
  colour_solid(painter, gl, scene, true);
  /* After what stands before them, so that what is hidden is not painted in vain. */
  gl->UseProgram(painter->programs.at[PROGRAM_GROUND]);
  gl->BindVertexArray(painter->ground.array);
  draw_indices(gl, 0, painter->ground_indices);
  gl->DepthFunc(GL_LEQUAL); /* the backdrop is as far as the cleared depth */
  gl->UseProgram(painter->programs.at[PROGRAM_BACKDROP]);
  gl->BindVertexArray(painter->empty_array);
  gl->DrawArrays(GL_TRIANGLES, 0, 3);
}

/* The nearest layer of a surface that is seen through: depth first, so that its own far side does not pile up
 * in it. */
static void paint_veil(const draw_painter *painter, const gl_api *gl, const draw_scene_part *part) {
  begin_depth_first(painter, gl);
  draw_indices(gl, part->first_index, (GLsizei)part->index_count);
  end_depth_first(gl);
  gl->UseProgram(painter->programs.at[PROGRAM_VEIL]);
  gl->Uniform1f(painter->programs.opacity, 1 - part->transparency);
  gl->DepthMask(GL_FALSE);
  draw_indices(gl, part->first_index, (GLsizei)part->index_count);
}

/* Corners 0 1 2 and 2 1 3 of every line, for as many as were ever shown. */
static bool grow_line_indices(draw_painter *painter, const gl_api *gl, size_t line_count) {
  gl->BindBuffer(GL_ELEMENT_ARRAY_BUFFER, painter->line_indices);
  if (line_count <= painter->line_room) return true;
  if (line_count > UINT32_MAX / 6) return false;
  size_t room = line_count + line_count / 2;
  uint32_t *indices = room <= UINT32_MAX / 6 ? malloc(room * 6 * sizeof *indices) : NULL;
  if (!indices) return false;
  for (size_t i = 0; i < room; i++) {
    static const uint32_t corners[6] = {0, 1, 2, 2, 1, 3};
    for (int k = 0; k < 6; k++) indices[6 * i + k] = (uint32_t)(4 * i) + corners[k];
  }
  gl->BufferData(GL_ELEMENT_ARRAY_BUFFER, (GLsizeiptr)(room * 6 * sizeof *indices), indices, GL_STATIC_DRAW);
  free(indices);
  painter->line_room = room;
  return true;
}

/* Each line goes to OpenGL four times, a corner of its rectangle each; instancing would say it once, but
 * costs llvmpipe a call of its own for every line. */
static void paint_lines(draw_painter *painter, const gl_api *gl, draw_scene *scene,
    const draw_scene_list *list, float murk, float thinness) {
  const draw_line *lines = list->at;
  scene->line_corners.count = 0;
  if (list->count == 0) return;
  gl->BindVertexArray(painter->line_array);
  draw_line *corners = draw_scene_list_push(scene, &scene->line_corners, 4 * list->count, sizeof *corners);
  if (!corners || !grow_line_indices(painter, gl, list->count)) {
    scene->failed = true;
    return;
  }
  for (size_t i = 0; i < list->count; i++)
    for (int k = 0; k < 4; k++) corners[4 * i + k] = lines[i];
  upload(gl, GL_ARRAY_BUFFER, painter->line_buffer, corners, 4 * list->count * sizeof *corners);
  gl->UseProgram(painter->programs.at[PROGRAM_LINE]);
  gl->Uniform1f(painter->programs.murk, murk);
  gl->Uniform1f(painter->programs.thinness, thinness);
  draw_indices(gl, 0, (GLsizei)(6 * list->count));
}

/* How deep the nearest surface lies that is seen through: lines behind it fade by the way light has inside.
 */
static void paint_veil_depths(const draw_painter *painter, const gl_api *gl, const draw_scene *scene) {
  const draw_scene_part *parts = scene->parts.at;
  begin_depth_map(gl, painter->layers.veil_frame, painter->layers.width, painter->layers.height, 1);
  for (size_t i = 0; i < scene->parts.count; i++)
    if (parts[i].transparency > 0) draw_indices(gl, parts[i].first_index, (GLsizei)parts[i].index_count);
  bind_texture(gl, UNIT_VEIL_DEPTHS, painter->layers.veil_texture, 0);
}

static void paint_line_layer(draw_painter *painter, const gl_api *gl, draw_scene *scene) {
  gl->Enable(GL_DEPTH_TEST);
  gl->DepthMask(GL_TRUE);
  gl->DepthFunc(GL_LESS);
  gl->UseProgram(painter->programs.at[PROGRAM_DEPTH]);
  gl->UniformMatrix4fv(painter->programs.map_from_world, 1, GL_FALSE, painter->frame.clip_from_world.at);
  gl->BindVertexArray(painter->meshes.array);
  if (scene->sorted_parts.count) paint_veil_depths(painter, gl, scene);
  begin_depth_map(gl, painter->layers.line_frame, painter->layers.width, painter->layers.height, 1);
  gl->ClearColor(0, 0, 0, 0);
  gl->Clear(GL_COLOR_BUFFER_BIT);
  gl->ColorMask(GL_FALSE, GL_FALSE, GL_FALSE, GL_FALSE);
  draw_solid(gl, scene);
  gl->BindVertexArray(painter->ground.array);
  draw_indices(gl, 0, painter->ground_indices);
  gl->ColorMask(GL_TRUE, GL_TRUE, GL_TRUE, GL_TRUE);
  gl->DepthMask(GL_FALSE);
  gl->Enable(GL_BLEND);
  gl->BlendFuncSeparate(GL_SRC_ALPHA, GL_ONE_MINUS_SRC_ALPHA, GL_ONE, GL_ONE_MINUS_SRC_ALPHA);
  /* Twice the lines on the same body leave half the room between them. */
  float thinness = fminf(fmaxf(sqrtf(4000 / (float)scene->sorted_lines.count), 0.35f), 1);
  paint_lines(painter, gl, scene, &scene->sorted_lines, scene->sorted_parts.count ? 1.0f : 0.0f, thinness);
  gl->Disable(GL_BLEND);
  gl->DepthMask(GL_TRUE);
  bind_texture(gl, UNIT_LINE_LAYER, painter->layers.line_texture, 0);
}

static void paint_see_through(draw_painter *painter, const gl_api *gl, draw_scene *scene) {
  gl->Enable(GL_BLEND);
  gl->BlendFuncSeparate(GL_SRC_ALPHA, GL_ONE_MINUS_SRC_ALPHA, GL_ONE, GL_ONE_MINUS_SRC_ALPHA);
  gl->DepthMask(GL_FALSE);
  gl->DepthFunc(GL_LESS);
  paint_lines(painter, gl, scene, &scene->prints, 0, 1);
  if (scene->sorted_lines.count) {
    gl->Disable(GL_DEPTH_TEST);
    gl->BlendFuncSeparate(GL_ONE, GL_ONE_MINUS_SRC_ALPHA, GL_ONE, GL_ONE_MINUS_SRC_ALPHA);
    gl->UseProgram(painter->programs.at[PROGRAM_LAYER]);
    gl->BindVertexArray(painter->empty_array);
    gl->DrawArrays(GL_TRIANGLES, 0, 3);
    gl->BlendFuncSeparate(GL_SRC_ALPHA, GL_ONE_MINUS_SRC_ALPHA, GL_ONE, GL_ONE_MINUS_SRC_ALPHA);
    gl->Enable(GL_DEPTH_TEST);
  }
  gl->BindVertexArray(painter->meshes.array);
  const uint32_t *order = scene->sorted_parts.at;
  const draw_scene_part *parts = scene->parts.at;
  for (size_t i = 0; i < scene->sorted_parts.count; i++) paint_veil(painter, gl, &parts[order[i]]);
  gl->DepthMask(GL_TRUE);
  gl->Disable(GL_DEPTH_TEST);
  paint_lines(painter, gl, scene, &scene->mark_rims, 0, 1);
  paint_lines(painter, gl, scene, &scene->marks, 0, 1);
  paint_lines(painter, gl, scene, &scene->placed_overlay, 0, 1);
  gl->Disable(GL_BLEND);
}

static void set4(float *to, sbf_vec3 v, float w) {
  to[0] = v.x, to[1] = v.y, to[2] = v.z, to[3] = w;
}

/* A direction given as seen by the camera where it first stood. */
static sbf_vec3 towards(float home_yaw, float yaw, float pitch) {
  float level = cosf(pitch);
  return v3(level * sinf(home_yaw + yaw), sinf(pitch), level * cosf(home_yaw + yaw));
}

static sbf_vec3 key_direction(const draw_camera *camera) {
  return towards(camera->home_yaw, -0.75f, 0.82f);
}

/* 1, 2 or 5 times a power of ten, such that a subject of this size spans about ten cells. */
static float grid_cell(float size) {
  float decade = powf(10, floorf(log10f(fmaxf(size, 1e-3f) / 10))), steps = size / 10 / decade;
  return decade * (steps < 1.5f ? 1.0f : steps < 3.5f ? 2.0f : steps < 7.5f ? 5.0f : 10.0f);
}

static void fill_frame(draw_painter *painter, const draw_camera *camera, const light_place *place,
    float ground_radius, bool bodies_shadow_bodies, uint32_t scale) {
  frame_block *frame = &painter->frame;
  uint32_t width = draw_canvas_width(painter->canvas) * scale,
           height = draw_canvas_height(painter->canvas) * scale;
  float aspect = (float)width / (float)height, size = 2 * camera->distance * camera->half_height;
  matrix4 view = draw_camera_view(camera),
          projection = draw_camera_projection(camera, aspect, 12 * camera->distance * camera->half_height);
  frame->clip_from_world = matrix4_product(&projection, &view);
  const matrix4 half = {{0.5f, 0, 0, 0, 0, 0.5f, 0, 0, 0, 0, 0.5f, 0, 0.5f, 0.5f, 0.5f, 1}};
  frame->shadow_from_world = matrix4_product(&half, &place->shadow_clip_from_world);
  set4(frame->eye, draw_camera_eye(camera), camera->distance);
  set4(frame->subject, camera->subject, ground_radius);
  set4(frame->key, key_direction(camera), bodies_shadow_bodies ? 1 : 0);
  set4(frame->fill, towards(camera->home_yaw, 1.1f, 0.35f), 0);
  set4(frame->rim, towards(camera->home_yaw, 2.6f, 0.55f), 0);
  set4(frame->screen, v3((float)width, (float)height, 1 / (float)width), 1 / (float)height);
  set4(frame->floor_grid, v3(grid_cell(size), fmaxf(1, (float)height / 720), 0), 0);
  set4(frame->ground_map, v3(place->least_x, place->least_z, 1 / place->ground_side),
      place->ground_side / GROUND_MAP_SIDE);
  set4(frame->heights, v3(place->low, place->high, 0), 0);
  set4(frame->depth, v3(0.5f * projection.at[14], 0.5f * projection.at[10] - 0.5f, 0.07f * size), 0);
  /* A light 14 degrees across: the penumbra is that share of the way from what throws the shadow. */
  float texel = 1.0f / SHADOW_MAP_SIDE, growth = 0.125f * place->shadow_depth / place->shadow_side;
  set4(frame->shadow, v3(0.028f, growth, 1.5f * texel), 2.0f * texel * place->shadow_side);
}

/* The box of the ground, and the lowest height it has about the casters. */
static float measure_ground(const draw_scene *scene, const box3 *casters, box3 *ground) {
  const sbf_vec3 *at = scene->ground_positions.at;
  box3 near = box3_empty();
  if (scene->has_floor) {
    box3_add(ground, v3(0, scene->floor_height, 0));
    return scene->floor_height;
  }
  sbf_vec3 reach = v3_scale(v3_sub(casters->max, casters->min), 0.5f);
  for (size_t i = 0; i < scene->ground_positions.count; i++) {
    box3_add(ground, at[i]);
    if (at[i].x > casters->min.x - reach.x && at[i].x < casters->max.x + reach.x &&
        at[i].z > casters->min.z - reach.z && at[i].z < casters->max.z + reach.z)
      box3_add(&near, at[i]);
  }
  return box3_is_empty(&near) ? ground->min.y : near.min.y;
}

/* How far the ground is seen: six times the picture's height, and not to where it ends. */
static float fade_radius(const draw_scene *scene, const draw_camera *camera, const box3 *ground) {
  float radius = 12 * camera->distance * camera->half_height;
  if (scene->has_floor || box3_is_empty(ground)) return radius;
  float end = fminf(fminf(camera->subject.x - ground->min.x, ground->max.x - camera->subject.x),
      fminf(camera->subject.z - ground->min.z, ground->max.z - camera->subject.z));
  return end > 0 ? fminf(radius, end) : radius;
}

static sbf_status out_of_memory(sbf_diagnostic *diagnostic) {
  return fault_set(diagnostic, SBF_CODE_OUT_OF_MEMORY, "no memory for what the picture shows");
}

sbf_status draw_painter_paint(
    draw_painter *painter, draw_scene *scene, const draw_camera *camera, sbf_diagnostic *diagnostic) {
  const gl_api *gl = draw_canvas_gl(painter->canvas);
  light_place place;
  box3 ground = box3_empty();
  sbf_vec3 eye = draw_camera_eye(camera), back = draw_camera_back(camera);
  draw_scene_sort(scene, eye, back);
  draw_scene_rim_marks(scene);
  draw_scene_place_overlay(
      scene, camera, draw_canvas_width(painter->canvas), draw_canvas_height(painter->canvas));
  if (scene->failed) return out_of_memory(diagnostic);
  const box3 *casters = box3_is_empty(&scene->casters) ? &scene->bounds : &scene->casters;
  float ground_near = measure_ground(scene, casters, &ground);
  float ground_radius = fade_radius(scene, camera, &ground);
  light_maps_place(&painter->maps, casters, &ground, ground_near, key_direction(camera), &place);

  upload_scene(painter, gl, scene, camera->subject, ground_radius);
  uint32_t scale = draw_canvas_bind(painter->canvas);
  if (scene->sorted_lines.count) { /* before the maps, whose textures it would take out of their units */
    GLsizei width = (GLsizei)(draw_canvas_width(painter->canvas) * scale);
    GLsizei height = (GLsizei)(draw_canvas_height(painter->canvas) * scale);
    sbf_status status = layers_make(&painter->layers, gl, width, height, diagnostic);
    if (status != SBF_OK) return status;
  }
  /* What stands inside a veil is to be seen in full light. */
  fill_frame(painter, camera, &place, ground_radius, scene->sorted_parts.count == 0, scale);
  gl->BindBuffer(GL_UNIFORM_BUFFER, painter->frame_buffer);
  gl->BufferData(GL_UNIFORM_BUFFER, sizeof painter->frame, &painter->frame, GL_STREAM_DRAW);
  gl->BindBufferBase(GL_UNIFORM_BUFFER, 0, painter->frame_buffer);
  paint_maps(painter, gl, scene, &place);
  if (scene->sorted_lines.count) paint_line_layer(painter, gl, scene);

  draw_canvas_bind(painter->canvas);
  gl->Disable(GL_DEPTH_TEST);
  gl->Clear(GL_DEPTH_BUFFER_BIT);
  paint_solid(painter, gl, scene);
  paint_see_through(painter, gl, scene);
  return scene->failed ? out_of_memory(diagnostic) : SBF_OK;
}
