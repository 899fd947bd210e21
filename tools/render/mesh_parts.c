#include "render/mesh_parts.h"

void mesh_parts_draw(const gl_api *gl, const draw_scene_part *part) {
  if (part->index_count)
    gl->DrawElements(GL_TRIANGLES, (GLsizei)part->index_count, GL_UNSIGNED_INT,
        (const void *)(uintptr_t)(part->first_index * sizeof(uint32_t)));
}

static void draw_sides(const gl_api *gl, const draw_scene_part *part) {
  if (part->one_sided) {
    gl->Enable(GL_CULL_FACE);
    gl->CullFace(GL_BACK);
  }
  mesh_parts_draw(gl, part);
  gl->Disable(GL_CULL_FACE);
}

static bool is_solid(const draw_scene_part *part) {
  return part->transparency <= 0 && part->alpha != DRAW_BLEND;
}

/* 0 if OpenGL cannot hold the image; without an image, white. */
static GLuint texture_of(const mesh_parts *parts, const draw_scene_part *part) {
  return image_textures_of(parts->images, parts->gl, part->image);
}

static void bind_image(const mesh_parts *parts, const draw_scene_part *part) {
  parts->gl->ActiveTexture(GL_TEXTURE0 + UNIT_BASE_IMAGE);
  parts->gl->BindTexture(GL_TEXTURE_2D, texture_of(parts, part));
}

static void begin_depth(const mesh_parts *parts, bool mask, const matrix4 *map_from_world) {
  const program_set *programs = parts->programs;
  parts->gl->UseProgram(programs->at[mask ? PROGRAM_DEPTH_MASK : PROGRAM_DEPTH]);
  parts->gl->UniformMatrix4fv(
      mask ? programs->mask_map_from_world : programs->map_from_world, 1, GL_FALSE, map_from_world->at);
}

void mesh_parts_cast(const mesh_parts *parts, const matrix4 *map_from_world) {
  const draw_scene_part *part = parts->scene->parts.at;
  bool any = !box3_is_empty(&parts->scene->casters); /* otherwise all parts count */
  for (int mask = 0; mask < 2; mask++) {
    begin_depth(parts, mask, map_from_world);
    for (size_t i = 0; i < parts->scene->parts.count; i++) {
      if ((part[i].alpha == DRAW_MASK) != mask || (any ? !part[i].casts_shadow : part[i].alpha == DRAW_BLEND))
        continue;
      if (mask) {
        bind_image(parts, &part[i]);
        parts->gl->Uniform1f(parts->programs->mask_cutoff, part[i].cutoff);
      }
      mesh_parts_draw(parts->gl, &part[i]);
    }
  }
}

void mesh_parts_fill_depth(const mesh_parts *parts, const matrix4 *clip_from_world, bool holes) {
  const draw_scene_part *part = parts->scene->parts.at;
  for (int mask = 0; mask <= holes; mask++) {
    begin_depth(parts, mask, clip_from_world);
    for (size_t i = 0; i < parts->scene->parts.count; i++) {
      if (!is_solid(&part[i]) || (part[i].alpha == DRAW_MASK) != mask) continue;
      if (mask) {
        bind_image(parts, &part[i]);
        parts->gl->Uniform1f(parts->programs->mask_cutoff, part[i].cutoff);
      }
      draw_sides(parts->gl, &part[i]);
    }
  }
}

void mesh_parts_colour(const mesh_parts *parts) {
  static const program_name programs[] = {PROGRAM_MESH, PROGRAM_MESH_IMAGE, PROGRAM_MESH_ALPHA};
  const draw_scene_part *part = parts->scene->parts.at;
  for (size_t p = 0; p < sizeof programs / sizeof *programs; p++) {
    parts->gl->UseProgram(parts->programs->at[programs[p]]);
    for (size_t i = 0; i < parts->scene->parts.count; i++) {
      program_name wanted = part[i].alpha == DRAW_MASK                     ? PROGRAM_MESH_ALPHA
                            : part[i].image && texture_of(parts, &part[i]) ? PROGRAM_MESH_IMAGE
                                                                           : PROGRAM_MESH;
      if (!is_solid(&part[i]) || wanted != programs[p]) continue;
      if (wanted != PROGRAM_MESH) bind_image(parts, &part[i]);
      if (wanted == PROGRAM_MESH_ALPHA) parts->gl->Uniform1f(parts->programs->cutoff, part[i].cutoff);
      draw_sides(parts->gl, &part[i]);
    }
  }
}

void mesh_parts_blend(const mesh_parts *parts, const draw_scene_part *part) {
  const gl_api *gl = parts->gl;
  gl->UseProgram(parts->programs->at[PROGRAM_MESH_ALPHA]);
  gl->Uniform1f(parts->programs->cutoff, 0);
  bind_image(parts, part);
  if (!part->one_sided) {
    gl->Enable(GL_CULL_FACE);
    gl->CullFace(GL_FRONT);
    mesh_parts_draw(gl, part);
  }
  gl->Enable(GL_CULL_FACE);
  gl->CullFace(GL_BACK);
  mesh_parts_draw(gl, part);
  gl->Disable(GL_CULL_FACE);
}
