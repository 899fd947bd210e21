#include "render/canvas.h"

#include <stdio.h>
#include <stdlib.h>

#include "base/fault.h"
#include "render/gl_api.h"
#include "render/gl_context.h"

struct draw_canvas {
  draw_context context;
  gl_api gl;
  draw_canvas_quality quality;
  GLint samples, largest; /* limits of the driver */
  uint32_t width, height; /* of the picture */
  uint32_t scale;         /* of the drawing surface relative to it */
  GLuint drawn, drawn_colour, drawn_depth;
  GLuint resolved, resolved_colour; /* one sample per pixel, size of the drawing surface */
  GLuint reduced, reduced_colour;   /* size of the picture; 0 if scale is 1 */
  uint8_t *rgba;                    /* read back, rows from the bottom */
  char renderer[128];
};

static GLuint make_colour(const gl_api *gl, GLsizei width, GLsizei height, GLsizei samples) {
  GLuint made = 0;
  gl->GenRenderbuffers(1, &made);
  gl->BindRenderbuffer(GL_RENDERBUFFER, made);
  gl->RenderbufferStorageMultisample(GL_RENDERBUFFER, samples, GL_RGBA8, width, height);
  gl->FramebufferRenderbuffer(GL_FRAMEBUFFER, GL_COLOR_ATTACHMENT0, GL_RENDERBUFFER, made);
  return made;
}

static bool make_surfaces(draw_canvas *canvas, GLsizei samples) {
  const gl_api *gl = &canvas->gl;
  GLsizei width = (GLsizei)(canvas->width * canvas->scale),
          height = (GLsizei)(canvas->height * canvas->scale);
  gl->GenFramebuffers(1, &canvas->drawn);
  gl->BindFramebuffer(GL_FRAMEBUFFER, canvas->drawn);
  canvas->drawn_colour = make_colour(gl, width, height, samples);
  gl->GenRenderbuffers(1, &canvas->drawn_depth);
  gl->BindRenderbuffer(GL_RENDERBUFFER, canvas->drawn_depth);
  gl->RenderbufferStorageMultisample(GL_RENDERBUFFER, samples, GL_DEPTH_COMPONENT24, width, height);
  gl->FramebufferRenderbuffer(GL_FRAMEBUFFER, GL_DEPTH_ATTACHMENT, GL_RENDERBUFFER, canvas->drawn_depth);
  bool good = gl->CheckFramebufferStatus(GL_FRAMEBUFFER) == GL_FRAMEBUFFER_COMPLETE;
  gl->GenFramebuffers(1, &canvas->resolved);
  gl->BindFramebuffer(GL_FRAMEBUFFER, canvas->resolved);
  canvas->resolved_colour = make_colour(gl, width, height, 0);
  good = good && gl->CheckFramebufferStatus(GL_FRAMEBUFFER) == GL_FRAMEBUFFER_COMPLETE;
  if (canvas->scale > 1) {
    gl->GenFramebuffers(1, &canvas->reduced);
    gl->BindFramebuffer(GL_FRAMEBUFFER, canvas->reduced);
    canvas->reduced_colour = make_colour(gl, (GLsizei)canvas->width, (GLsizei)canvas->height, 0);
    good = good && gl->CheckFramebufferStatus(GL_FRAMEBUFFER) == GL_FRAMEBUFFER_COMPLETE;
  }
  return good && gl->GetError() == GL_NO_ERROR;
}

static void free_surfaces(draw_canvas *canvas) {
  const gl_api *gl = &canvas->gl;
  GLuint frames[] = {canvas->drawn, canvas->resolved, canvas->reduced};
  GLuint buffers[] = {
      canvas->drawn_colour, canvas->drawn_depth, canvas->resolved_colour, canvas->reduced_colour};
  if (canvas->drawn) {
    gl->DeleteFramebuffers(3, frames); /* 0 is ignored */
    gl->DeleteRenderbuffers(4, buffers);
  }
  canvas->drawn = canvas->resolved = canvas->reduced = 0;
  canvas->drawn_colour = canvas->drawn_depth = canvas->resolved_colour = canvas->reduced_colour = 0;
  free(canvas->rgba);
  canvas->rgba = NULL;
}

sbf_status draw_canvas_resize(
    draw_canvas *canvas, uint32_t width, uint32_t height, sbf_diagnostic *diagnostic) {
  uint32_t longest = width > height ? width : height;
  if (canvas->drawn && canvas->width == width && canvas->height == height) return SBF_OK;
  free_surfaces(canvas);
  canvas->width = width, canvas->height = height;
  /* Twice the size needs four times the memory and time; a large picture needs it least. */
  bool doubled =
      canvas->quality == DRAW_CANVAS_STILL && longest <= 2048 && 2 * longest <= (uint32_t)canvas->largest;
  canvas->scale = doubled ? 2 : 1;
  if ((uint32_t)canvas->largest < longest)
    return fault_set(diagnostic, SBF_CODE_BAD_CALL,
        "%ux%u pixels are more than this OpenGL draws: at most %d", (unsigned)width, (unsigned)height,
        (int)canvas->largest);
  if (!make_surfaces(canvas, canvas->samples < 4 ? canvas->samples : 4))
    return fault_set(diagnostic, SBF_CODE_OUT_OF_MEMORY,
        "OpenGL has no room for a picture of %ux%u pixels: ask for a smaller one", (unsigned)width,
        (unsigned)height);
  canvas->rgba = malloc((size_t)width * height * 4);
  if (!canvas->rgba)
    return fault_set(diagnostic, SBF_CODE_OUT_OF_MEMORY, "no memory to read a picture of %ux%u pixels back",
        (unsigned)width, (unsigned)height);
  return SBF_OK;
}

sbf_status draw_canvas_open_in(draw_canvas **opened, const draw_context *context, uint32_t width,
    uint32_t height, draw_canvas_quality quality, sbf_diagnostic *diagnostic) {
  *opened = NULL;
  draw_canvas *made = calloc(1, sizeof *made);
  if (!made) {
    if (context->close) context->close(context->user);
    return fault_set(diagnostic, SBF_CODE_OUT_OF_MEMORY, "no memory for a canvas");
  }
  made->context = *context;
  made->quality = quality;
  const char *missing = gl_api_load(&made->gl, context->find, context->user);
  sbf_status status = SBF_OK;
  if (missing) {
    status = fault_set(
        diagnostic, SBF_CODE_NO_OPENGL, "the OpenGL driver has no %s: " DRAW_INSTALL_OPENGL, missing);
  } else {
    snprintf(made->renderer, sizeof made->renderer, "%s", (const char *)made->gl.GetString(GL_RENDERER));
    made->gl.GetIntegerv(GL_MAX_SAMPLES, &made->samples);
    made->gl.GetIntegerv(GL_MAX_RENDERBUFFER_SIZE, &made->largest);
    status = draw_canvas_resize(made, width, height, diagnostic);
  }
  if (status == SBF_OK)
    *opened = made;
  else
    draw_canvas_close(made);
  return status;
}

sbf_status draw_canvas_open(draw_canvas **opened, uint32_t width, uint32_t height,
    draw_canvas_quality quality, sbf_diagnostic *diagnostic) {
  draw_context context;
  *opened = NULL;
  if (width == 0 || height == 0 || width > DRAW_CANVAS_LARGEST || height > DRAW_CANVAS_LARGEST)
    return fault_set(diagnostic, SBF_CODE_BAD_CALL, "a picture of %ux%u pixels: each side may have 1 to %d",
        (unsigned)width, (unsigned)height, DRAW_CANVAS_LARGEST);
  sbf_status status = draw_gl_context(&context, diagnostic);
  return status == SBF_OK ? draw_canvas_open_in(opened, &context, width, height, quality, diagnostic)
                          : status;
}

void draw_canvas_close(draw_canvas *canvas) {
  if (!canvas) return;
  free_surfaces(canvas);
  if (canvas->context.close) canvas->context.close(canvas->context.user);
  free(canvas);
}

uint32_t draw_canvas_width(const draw_canvas *canvas) {
  return canvas->width;
}
uint32_t draw_canvas_height(const draw_canvas *canvas) {
  return canvas->height;
}
const struct gl_api *draw_canvas_gl(const draw_canvas *canvas) {
  return &canvas->gl;
}
const char *draw_canvas_renderer(const draw_canvas *canvas) {
  return canvas->renderer;
}

uint32_t draw_canvas_bind(draw_canvas *canvas) {
  const gl_api *gl = &canvas->gl;
  gl->BindFramebuffer(GL_FRAMEBUFFER, canvas->drawn);
  gl->Viewport(0, 0, (GLsizei)(canvas->width * canvas->scale), (GLsizei)(canvas->height * canvas->scale));
  return canvas->scale;
}

static void blit(const gl_api *gl, GLuint from, GLuint to, GLint width, GLint height, GLint to_width,
    GLint to_height, GLenum filter) {
  gl->BindFramebuffer(GL_READ_FRAMEBUFFER, from);
  gl->BindFramebuffer(GL_DRAW_FRAMEBUFFER, to);
  gl->BlitFramebuffer(0, 0, width, height, 0, 0, to_width, to_height, GL_COLOR_BUFFER_BIT, filter);
}

/* Resolves to one sample per pixel at the picture's size; returns the framebuffer. */
static GLuint resolve(draw_canvas *canvas) {
  const gl_api *gl = &canvas->gl;
  GLint width = (GLint)canvas->width, height = (GLint)canvas->height, scale = (GLint)canvas->scale;
  blit(gl, canvas->drawn, canvas->resolved, width * scale, height * scale, width * scale, height * scale,
      GL_NEAREST);
  if (canvas->scale == 1) return canvas->resolved;
  /* Halving with linear filtering averages each four pixels. */
  blit(gl, canvas->resolved, canvas->reduced, width * scale, height * scale, width, height, GL_LINEAR);
  return canvas->reduced;
}

void draw_canvas_show(draw_canvas *canvas) {
  GLint width = (GLint)canvas->width, height = (GLint)canvas->height;
  blit(&canvas->gl, resolve(canvas), 0, width, height, width, height, GL_NEAREST);
}

sbf_status draw_canvas_read(draw_canvas *canvas, uint8_t *rgb, sbf_diagnostic *diagnostic) {
  const gl_api *gl = &canvas->gl;
  GLint width = (GLint)canvas->width, height = (GLint)canvas->height;
  gl->BindFramebuffer(GL_READ_FRAMEBUFFER, resolve(canvas));
  gl->PixelStorei(GL_PACK_ALIGNMENT, 4);
  gl->ReadPixels(0, 0, width, height, GL_RGBA, GL_UNSIGNED_BYTE, canvas->rgba);
  GLenum error = gl->GetError();
  if (error != GL_NO_ERROR)
    return fault_set(diagnostic, SBF_CODE_OPENGL_FAILED, "OpenGL reported error 0x%04x while drawing", error);
  for (uint32_t y = 0; y < canvas->height; y++) {
    const uint8_t *from = canvas->rgba + (size_t)(canvas->height - 1 - y) * canvas->width * 4;
    for (uint32_t x = 0; x < canvas->width; x++, from += 4, rgb += 3)
      rgb[0] = from[0], rgb[1] = from[1], rgb[2] = from[2];
  }
  return SBF_OK;
}
