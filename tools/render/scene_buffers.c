#include "render/scene_buffers.h"

#include <stddef.h>
#include <stdlib.h>

void buffer_fill(const gl_api *gl, GLenum target, GLuint buffer, const void *items, size_t bytes) {
  gl->BindBuffer(target, buffer);
  gl->BufferData(target, (GLsizeiptr)bytes, bytes ? items : NULL, GL_STREAM_DRAW);
}

static void make_attribute(
    const gl_api *gl, GLuint buffer, GLuint index, GLint size, GLenum type, GLsizei stride, size_t offset) {
  gl->BindBuffer(GL_ARRAY_BUFFER, buffer);
  gl->EnableVertexAttribArray(index);
  gl->VertexAttribPointer(
      index, size, type, type == GL_UNSIGNED_BYTE, stride, (const void *)(uintptr_t)offset);
}

void mesh_buffers_create(mesh_buffers *made, const gl_api *gl, bool coloured) {
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

void mesh_buffers_destroy(const mesh_buffers *buffers, const gl_api *gl) {
  const GLuint all[5] = {
      buffers->positions, buffers->normals, buffers->colours, buffers->uvs, buffers->indices};
  gl->DeleteBuffers(5, all); /* 0 is ignored */
  gl->DeleteVertexArrays(1, &buffers->array);
}

void mesh_buffers_fill(const mesh_buffers *to, const gl_api *gl, const draw_scene_list *positions,
    const draw_scene_list *normals, const draw_scene_list *indices) {
  gl->BindVertexArray(to->array);
  buffer_fill(gl, GL_ARRAY_BUFFER, to->positions, positions->at, positions->count * sizeof(sbf_vec3));
  buffer_fill(gl, GL_ARRAY_BUFFER, to->normals, normals->at, normals->count * sizeof(sbf_vec3));
  buffer_fill(gl, GL_ELEMENT_ARRAY_BUFFER, to->indices, indices->at, indices->count * sizeof(uint32_t));
}

void line_buffers_create(line_buffers *made, const gl_api *gl) {
  const GLsizei stride = (GLsizei)sizeof(draw_line);
  gl->GenVertexArrays(1, &made->array);
  gl->GenBuffers(1, &made->corners);
  gl->BindVertexArray(made->array);
  GLuint buffer = made->corners;
  make_attribute(gl, buffer, 0, 3, GL_FLOAT, stride, offsetof(draw_line, from));
  make_attribute(gl, buffer, 1, 3, GL_FLOAT, stride, offsetof(draw_line, to));
  make_attribute(gl, buffer, 2, 4, GL_UNSIGNED_BYTE, stride, offsetof(draw_line, from_colour));
  make_attribute(gl, buffer, 3, 4, GL_UNSIGNED_BYTE, stride, offsetof(draw_line, to_colour));
  make_attribute(gl, buffer, 4, 1, GL_FLOAT, stride, offsetof(draw_line, width));
  gl->GenBuffers(1, &made->indices);
  gl->BindBuffer(GL_ELEMENT_ARRAY_BUFFER, made->indices);
}

void line_buffers_destroy(const line_buffers *buffers, const gl_api *gl) {
  const GLuint both[2] = {buffers->corners, buffers->indices};
  gl->DeleteBuffers(2, both);
  gl->DeleteVertexArrays(1, &buffers->array);
}

/* Corners 0 1 2 and 2 1 3 of every line, for the largest number so far. */
bool line_buffers_grow(line_buffers *lines, const gl_api *gl, size_t line_count) {
  gl->BindBuffer(GL_ELEMENT_ARRAY_BUFFER, lines->indices);
  if (line_count <= lines->capacity) return true;
  if (line_count > UINT32_MAX / 6) return false;
  size_t capacity = line_count + line_count / 2;
  uint32_t *indices = capacity <= UINT32_MAX / 6 ? malloc(capacity * 6 * sizeof *indices) : NULL;
  if (!indices) return false;
  for (size_t i = 0; i < capacity; i++) {
    static const uint32_t corners[6] = {0, 1, 2, 2, 1, 3};
    for (int k = 0; k < 6; k++) indices[6 * i + k] = (uint32_t)(4 * i) + corners[k];
  }
  gl->BufferData(
      GL_ELEMENT_ARRAY_BUFFER, (GLsizeiptr)(capacity * 6 * sizeof *indices), indices, GL_STATIC_DRAW);
  free(indices);
  lines->capacity = capacity;
  return true;
}
