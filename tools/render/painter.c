#include "render/painter.h"

#include <stdlib.h>

#include "base/fault.h"
#include "render/frame_block.h"
#include "render/image_textures.h"
#include "render/layers.h"
#include "render/mesh_parts.h"
#include "render/programs.h"
#include "render/scene_buffers.h"

struct draw_painter {
  draw_canvas *canvas;
  program_set programs;
  light_maps maps;
  mesh_buffers meshes, ground;
  line_buffers lines;
  GLuint empty_array, frame_buffer;
  layer_set layers;
  image_textures images;
  frame_block frame;
  GLsizei ground_indices; /* in the current frame */
};

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
  mesh_buffers_create(&made->meshes, gl, true);
  mesh_buffers_create(&made->ground, gl, false);
  line_buffers_create(&made->lines, gl);
  gl->GenVertexArrays(1, &made->empty_array);
  gl->GenBuffers(1, &made->frame_buffer);
  frame_block_begin(&made->frame);
  *created = made;
  return SBF_OK;
}

void draw_painter_destroy(draw_painter *painter) {
  if (!painter) return;
  const gl_api *gl = draw_canvas_gl(painter->canvas);
  mesh_buffers_destroy(&painter->meshes, gl);
  mesh_buffers_destroy(&painter->ground, gl);
  line_buffers_destroy(&painter->lines, gl);
  gl->DeleteBuffers(1, &painter->frame_buffer);
  gl->DeleteVertexArrays(1, &painter->empty_array);
  image_textures_destroy(&painter->images, gl);
  layers_destroy(&painter->layers, gl);
  light_maps_destroy(&painter->maps, gl);
  programs_destroy(&painter->programs, gl);
  free(painter);
}

/* An infinite floor is a square around the subject, as large as the visible ground. */
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
  mesh_buffers_fill(&painter->ground, gl, &positions, &up, &indices);
  painter->ground_indices = 6;
}

static void upload_scene(
    draw_painter *painter, const gl_api *gl, const draw_scene *scene, sbf_vec3 subject, float ground_radius) {
  mesh_buffers_fill(&painter->meshes, gl, &scene->positions, &scene->normals, &scene->indices);
  buffer_fill(gl, GL_ARRAY_BUFFER, painter->meshes.colours, scene->colours.at,
      scene->colours.count * sizeof(draw_colour));
  buffer_fill(gl, GL_ARRAY_BUFFER, painter->meshes.uvs, scene->uvs.at, scene->uvs.count * sizeof(sbf_vec2));
  if (scene->has_floor) {
    upload_floor(painter, gl, scene, subject, ground_radius);
  } else {
    mesh_buffers_fill(
        &painter->ground, gl, &scene->ground.positions, &scene->ground.normals, &scene->ground.indices);
    painter->ground_indices = (GLsizei)scene->ground.indices.count;
  }
}

static void draw_indices(const gl_api *gl, size_t first, GLsizei count) {
  if (count > 0)
    gl->DrawElements(
        GL_TRIANGLES, count, GL_UNSIGNED_INT, (const void *)(uintptr_t)(first * sizeof(uint32_t)));
}

static mesh_parts parts_of(draw_painter *painter, const gl_api *gl, const draw_scene *scene) {
  gl->BindVertexArray(painter->meshes.array);
  return (mesh_parts){gl, &painter->programs, &painter->images, scene};
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
    gl->ClearColor(1, 1, 1, 1); /* no shade without ground */
    gl->Clear(GL_COLOR_BUFFER_BIT);
  }
  begin_light_map(gl, maps->softened_frame, GROUND_MAP_SIDE);
  bind_texture(gl, UNIT_GROUND_LIGHT, maps->light_texture, 0);
  gl->UseProgram(painter->programs.at[PROGRAM_SOFTEN]);
  gl->DrawArrays(GL_TRIANGLES, 0, 3);
  bind_texture(gl, UNIT_GROUND_LIGHT, maps->softened_texture, 0);
}

static void paint_maps(
    draw_painter *painter, const gl_api *gl, const draw_scene *scene, const light_view *projections) {
  const light_maps *maps = &painter->maps;
  gl->Enable(GL_DEPTH_TEST);
  gl->Disable(GL_BLEND);
  gl->DepthMask(GL_TRUE);
  gl->DepthFunc(GL_LESS);
  const mesh_parts parts = parts_of(painter, gl, scene);
  begin_depth_map(gl, maps->shadow_frame, SHADOW_MAP_SIDE, SHADOW_MAP_SIDE, 1);
  mesh_parts_cast(&parts, &projections->shadow_clip_from_world);
  begin_depth_map(gl, maps->lowest_frame, HEIGHT_MAP_SIDE, HEIGHT_MAP_SIDE, 1);
  mesh_parts_cast(&parts, &projections->heights_clip_from_world);
  gl->UseProgram(painter->programs.at[PROGRAM_DEPTH]);
  gl->UniformMatrix4fv(
      painter->programs.map_from_world, 1, GL_FALSE, projections->heights_clip_from_world.at);
  float range = projections->high - projections->low;
  double level = scene->has_floor ? (scene->floor_height - projections->low) / range : 0;
  begin_depth_map(gl, maps->ground_frame, HEIGHT_MAP_SIDE, HEIGHT_MAP_SIDE, level);
  if (!scene->has_floor && painter->ground_indices) {
    gl->DepthFunc(GL_GREATER);
    gl->BindVertexArray(painter->ground.array);
    draw_indices(gl, 0, painter->ground_indices);
  }
  gl->ClearDepth(1);

  paint_ground_light(painter, gl);
}

/* Depth only, slightly behind its position: colour drawn afterwards passes, and farther surfaces are never
 * lit, which without a graphics card is most of the work. */
static void begin_depth_first(const gl_api *gl) {
  gl->ColorMask(GL_FALSE, GL_FALSE, GL_FALSE, GL_FALSE);
  gl->DepthMask(GL_TRUE);
  gl->DepthFunc(GL_LESS);
  gl->Enable(GL_POLYGON_OFFSET_FILL);
  gl->PolygonOffset(1, 2);
}

static void use_depth(const draw_painter *painter, const gl_api *gl) {
  gl->UseProgram(painter->programs.at[PROGRAM_DEPTH]);
  gl->UniformMatrix4fv(painter->programs.map_from_world, 1, GL_FALSE, painter->frame.clip_from_world.at);
}

static void end_depth_first(const gl_api *gl) {
  gl->Disable(GL_POLYGON_OFFSET_FILL);
  gl->ColorMask(GL_TRUE, GL_TRUE, GL_TRUE, GL_TRUE);
}

static void paint_solid(draw_painter *painter, const gl_api *gl, const draw_scene *scene) {
  gl->Enable(GL_DEPTH_TEST);
  const mesh_parts parts = parts_of(painter, gl, scene);
  begin_depth_first(gl);
  mesh_parts_fill_depth(&parts, &painter->frame.clip_from_world, false);
  end_depth_first(gl);
  mesh_parts_colour(&parts);
  /* After objects in front of it, so that hidden pixels are not shaded. */
  gl->UseProgram(painter->programs.at[PROGRAM_GROUND]);
  gl->BindVertexArray(painter->ground.array);
  draw_indices(gl, 0, painter->ground_indices);
  gl->DepthFunc(GL_LEQUAL); /* the backdrop is at the cleared depth */
  gl->UseProgram(painter->programs.at[PROGRAM_BACKDROP]);
  gl->BindVertexArray(painter->empty_array);
  gl->DrawArrays(GL_TRIANGLES, 0, 3);
}

/* The nearest layer of a transparent surface: depth first, so that its back does not accumulate. */
static void paint_xray(const draw_painter *painter, const gl_api *gl, const draw_scene_part *part) {
  use_depth(painter, gl);
  begin_depth_first(gl);
  mesh_parts_draw(gl, part);
  end_depth_first(gl);
  gl->UseProgram(painter->programs.at[PROGRAM_XRAY]);
  gl->Uniform1f(painter->programs.opacity, 1 - part->transparency);
  gl->DepthMask(GL_FALSE);
  mesh_parts_draw(gl, part);
}

/* Each line is sent four times, once per corner of its rectangle; instancing would send it once, but
 * llvmpipe handles each instance as a separate draw. */
static void paint_lines(draw_painter *painter, const gl_api *gl, draw_scene *scene,
    const draw_scene_list *list, float murk, float thinness) {
  const draw_line *lines = list->at;
  scene->painted.line_corners.count = 0;
  if (list->count == 0) return;
  gl->BindVertexArray(painter->lines.array);
  draw_line *corners =
      draw_scene_list_push(scene, &scene->painted.line_corners, 4 * list->count, sizeof *corners);
  if (!corners || !line_buffers_grow(&painter->lines, gl, list->count)) {
    scene->failed = true;
    return;
  }
  for (size_t i = 0; i < list->count; i++)
    for (int k = 0; k < 4; k++) corners[4 * i + k] = lines[i];
  buffer_fill(gl, GL_ARRAY_BUFFER, painter->lines.corners, corners, 4 * list->count * sizeof *corners);
  gl->UseProgram(painter->programs.at[PROGRAM_LINE]);
  gl->Uniform1f(painter->programs.murk, murk);
  gl->Uniform1f(painter->programs.thinness, thinness);
  draw_indices(gl, 0, (GLsizei)(6 * list->count));
}

/* Depth of the nearest transparent surface: lines behind it fade with the path length inside. */
static void paint_xray_depths(const draw_painter *painter, const gl_api *gl, const draw_scene *scene) {
  const draw_scene_part *parts = scene->parts.at;
  begin_depth_map(gl, painter->layers.xray_frame, painter->layers.width, painter->layers.height, 1);
  for (size_t i = 0; i < scene->parts.count; i++)
    if (parts[i].transparency > 0) mesh_parts_draw(gl, &parts[i]);
  bind_texture(gl, UNIT_XRAY_DEPTHS, painter->layers.xray_texture, 0);
}

static void paint_line_layer(draw_painter *painter, const gl_api *gl, draw_scene *scene) {
  gl->Enable(GL_DEPTH_TEST);
  gl->DepthMask(GL_TRUE);
  gl->DepthFunc(GL_LESS);
  const mesh_parts parts = parts_of(painter, gl, scene);
  use_depth(painter, gl);
  if (scene->painted.xray_count) paint_xray_depths(painter, gl, scene);
  begin_depth_map(gl, painter->layers.line_frame, painter->layers.width, painter->layers.height, 1);
  gl->ClearColor(0, 0, 0, 0);
  gl->Clear(GL_COLOR_BUFFER_BIT);
  gl->ColorMask(GL_FALSE, GL_FALSE, GL_FALSE, GL_FALSE);
  mesh_parts_fill_depth(&parts, &painter->frame.clip_from_world, true);
  use_depth(painter, gl);
  gl->BindVertexArray(painter->ground.array);
  draw_indices(gl, 0, painter->ground_indices);
  gl->ColorMask(GL_TRUE, GL_TRUE, GL_TRUE, GL_TRUE);
  gl->DepthMask(GL_FALSE);
  gl->Enable(GL_BLEND);
  gl->BlendFuncSeparate(GL_SRC_ALPHA, GL_ONE_MINUS_SRC_ALPHA, GL_ONE, GL_ONE_MINUS_SRC_ALPHA);
  /* Twice the lines on the same body have half the space between them. */
  float thinness = fminf(fmaxf(sqrtf(4000 / (float)scene->painted.sorted_lines.count), 0.35f), 1);
  paint_lines(
      painter, gl, scene, &scene->painted.sorted_lines, scene->painted.xray_count ? 1.0f : 0.0f, thinness);
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
  if (scene->painted.sorted_lines.count) {
    gl->Disable(GL_DEPTH_TEST);
    gl->BlendFuncSeparate(GL_ONE, GL_ONE_MINUS_SRC_ALPHA, GL_ONE, GL_ONE_MINUS_SRC_ALPHA);
    gl->UseProgram(painter->programs.at[PROGRAM_LAYER]);
    gl->BindVertexArray(painter->empty_array);
    gl->DrawArrays(GL_TRIANGLES, 0, 3);
    gl->BlendFuncSeparate(GL_SRC_ALPHA, GL_ONE_MINUS_SRC_ALPHA, GL_ONE, GL_ONE_MINUS_SRC_ALPHA);
    gl->Enable(GL_DEPTH_TEST);
  }
  const mesh_parts meshes = parts_of(painter, gl, scene);
  const uint32_t *order = scene->painted.sorted_parts.at;
  const draw_scene_part *parts = scene->parts.at;
  for (size_t i = 0; i < scene->painted.sorted_parts.count; i++) {
    if (parts[order[i]].transparency > 0)
      paint_xray(painter, gl, &parts[order[i]]);
    else
      mesh_parts_blend(&meshes, &parts[order[i]]);
  }
  gl->DepthMask(GL_TRUE);
  gl->Disable(GL_DEPTH_TEST);
  paint_lines(painter, gl, scene, &scene->painted.mark_rims, 0, 1);
  paint_lines(painter, gl, scene, &scene->marks, 0, 1);
  paint_lines(painter, gl, scene, &scene->painted.overlay, 0, 1);
  gl->Disable(GL_BLEND);
}
/* Bounds of the ground, and its lowest height near the casters. */
/* Bounds of the ground, and its lowest height near the casters. */
static float measure_ground(const draw_scene *scene, const box3 *casters, box3 *ground) {
  const sbf_vec3 *at = scene->ground.positions.at;
  box3 around = box3_empty();
  if (scene->has_floor) {
    box3_add(ground, v3(0, scene->floor_height, 0));
    return scene->floor_height;
  }
  sbf_vec3 reach = v3_scale(v3_sub(casters->max, casters->min), 0.5f);
  for (size_t i = 0; i < scene->ground.positions.count; i++) {
    box3_add(ground, at[i]);
    if (at[i].x > casters->min.x - reach.x && at[i].x < casters->max.x + reach.x &&
        at[i].z > casters->min.z - reach.z && at[i].z < casters->max.z + reach.z)
      box3_add(&around, at[i]);
  }
  return box3_is_empty(&around) ? ground->min.y : around.min.y;
}

/* Visible radius of the ground: six times the picture's height, but not up to its border. */
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
  light_view maps;
  box3 ground = box3_empty();
  sbf_vec3 eye = draw_camera_eye(camera), back = draw_camera_back(camera);
  draw_scene_sort(scene, eye, back);
  draw_scene_rim_marks(scene);
  draw_scene_arrange_overlay(
      scene, camera, draw_canvas_width(painter->canvas), draw_canvas_height(painter->canvas));
  if (scene->failed) return out_of_memory(diagnostic);
  const box3 *casters = box3_is_empty(&scene->casters) ? &scene->bounds : &scene->casters;
  float ground_near = measure_ground(scene, casters, &ground);
  float ground_radius = fade_radius(scene, camera, &ground);
  light_maps_update_view(&painter->maps, casters, &ground, ground_near, frame_block_key(camera), &maps);

  upload_scene(painter, gl, scene, camera->subject, ground_radius);
  uint32_t scale = draw_canvas_bind(painter->canvas);
  if (scene->painted.sorted_lines.count) { /* before the maps, because it changes their texture units */
    GLsizei width = (GLsizei)(draw_canvas_width(painter->canvas) * scale);
    GLsizei height = (GLsizei)(draw_canvas_height(painter->canvas) * scale);
    sbf_status status = layers_make(&painter->layers, gl, width, height, diagnostic);
    if (status != SBF_OK) return status;
  }
  /* Objects inside a transparent surface are fully lit. */
  frame_block_fill(&painter->frame, draw_canvas_width(painter->canvas) * scale,
      draw_canvas_height(painter->canvas) * scale, camera, &maps, ground_radius,
      scene->painted.xray_count == 0);
  gl->BindBuffer(GL_UNIFORM_BUFFER, painter->frame_buffer);
  gl->BufferData(GL_UNIFORM_BUFFER, sizeof painter->frame, &painter->frame, GL_STREAM_DRAW);
  gl->BindBufferBase(GL_UNIFORM_BUFFER, 0, painter->frame_buffer);
  paint_maps(painter, gl, scene, &maps);
  if (scene->painted.sorted_lines.count) paint_line_layer(painter, gl, scene);

  draw_canvas_bind(painter->canvas);
  gl->Disable(GL_DEPTH_TEST);
  gl->Clear(GL_DEPTH_BUFFER_BIT);
  paint_solid(painter, gl, scene);
  paint_see_through(painter, gl, scene);
  return scene->failed ? out_of_memory(diagnostic) : SBF_OK;
}
