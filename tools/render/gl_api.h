/* The OpenGL 3.3 core functions that drawing uses, loaded at run time: the program starts, and does
 * everything else, on a machine without OpenGL. */
#ifndef RENDER_GL_API_H
#define RENDER_GL_API_H

#include <GL/glcorearb.h>
#include <stdbool.h>

#include "render/canvas.h"

#define RENDER_GL_FUNCTIONS(X)                                                                               \
  X(PFNGLACTIVETEXTUREPROC, ActiveTexture)                                                                   \
  X(PFNGLATTACHSHADERPROC, AttachShader)                                                                     \
  X(PFNGLBINDBUFFERPROC, BindBuffer)                                                                         \
  X(PFNGLBINDBUFFERBASEPROC, BindBufferBase)                                                                 \
  X(PFNGLBINDFRAMEBUFFERPROC, BindFramebuffer)                                                               \
  X(PFNGLBINDRENDERBUFFERPROC, BindRenderbuffer)                                                             \
  X(PFNGLBINDSAMPLERPROC, BindSampler)                                                                       \
  X(PFNGLBINDTEXTUREPROC, BindTexture)                                                                       \
  X(PFNGLBINDVERTEXARRAYPROC, BindVertexArray)                                                               \
  X(PFNGLBLENDFUNCSEPARATEPROC, BlendFuncSeparate)                                                           \
  X(PFNGLBLITFRAMEBUFFERPROC, BlitFramebuffer)                                                               \
  X(PFNGLBUFFERDATAPROC, BufferData)                                                                         \
  X(PFNGLCHECKFRAMEBUFFERSTATUSPROC, CheckFramebufferStatus)                                                 \
  X(PFNGLCLEARPROC, Clear)                                                                                   \
  X(PFNGLCLEARCOLORPROC, ClearColor)                                                                         \
  X(PFNGLCLEARDEPTHPROC, ClearDepth)                                                                         \
  X(PFNGLCOLORMASKPROC, ColorMask)                                                                           \
  X(PFNGLCOMPILESHADERPROC, CompileShader)                                                                   \
  X(PFNGLCREATEPROGRAMPROC, CreateProgram)                                                                   \
  X(PFNGLCREATESHADERPROC, CreateShader)                                                                     \
  X(PFNGLCULLFACEPROC, CullFace)                                                                             \
  X(PFNGLDELETEBUFFERSPROC, DeleteBuffers)                                                                   \
  X(PFNGLDELETEFRAMEBUFFERSPROC, DeleteFramebuffers)                                                         \
  X(PFNGLDELETEPROGRAMPROC, DeleteProgram)                                                                   \
  X(PFNGLDELETERENDERBUFFERSPROC, DeleteRenderbuffers)                                                       \
  X(PFNGLDELETESAMPLERSPROC, DeleteSamplers)                                                                 \
  X(PFNGLDELETESHADERPROC, DeleteShader)                                                                     \
  X(PFNGLDELETETEXTURESPROC, DeleteTextures)                                                                 \
  X(PFNGLDELETEVERTEXARRAYSPROC, DeleteVertexArrays)                                                         \
  X(PFNGLDEPTHFUNCPROC, DepthFunc)                                                                           \
  X(PFNGLDEPTHMASKPROC, DepthMask)                                                                           \
  X(PFNGLDISABLEPROC, Disable)                                                                               \
  X(PFNGLDRAWARRAYSPROC, DrawArrays)                                                                         \
  X(PFNGLDRAWBUFFERPROC, DrawBuffer)                                                                         \
  X(PFNGLDRAWELEMENTSPROC, DrawElements)                                                                     \
  X(PFNGLENABLEPROC, Enable)                                                                                 \
  X(PFNGLENABLEVERTEXATTRIBARRAYPROC, EnableVertexAttribArray)                                               \
  X(PFNGLFRAMEBUFFERRENDERBUFFERPROC, FramebufferRenderbuffer)                                               \
  X(PFNGLFRAMEBUFFERTEXTURE2DPROC, FramebufferTexture2D)                                                     \
  X(PFNGLGENBUFFERSPROC, GenBuffers)                                                                         \
  X(PFNGLGENFRAMEBUFFERSPROC, GenFramebuffers)                                                               \
  X(PFNGLGENRENDERBUFFERSPROC, GenRenderbuffers)                                                             \
  X(PFNGLGENSAMPLERSPROC, GenSamplers)                                                                       \
  X(PFNGLGENERATEMIPMAPPROC, GenerateMipmap)                                                                 \
  X(PFNGLGENTEXTURESPROC, GenTextures)                                                                       \
  X(PFNGLGENVERTEXARRAYSPROC, GenVertexArrays)                                                               \
  X(PFNGLGETERRORPROC, GetError)                                                                             \
  X(PFNGLGETINTEGERVPROC, GetIntegerv)                                                                       \
  X(PFNGLGETPROGRAMINFOLOGPROC, GetProgramInfoLog)                                                           \
  X(PFNGLGETPROGRAMIVPROC, GetProgramiv)                                                                     \
  X(PFNGLGETSHADERINFOLOGPROC, GetShaderInfoLog)                                                             \
  X(PFNGLGETSHADERIVPROC, GetShaderiv)                                                                       \
  X(PFNGLGETSTRINGPROC, GetString)                                                                           \
  X(PFNGLGETUNIFORMBLOCKINDEXPROC, GetUniformBlockIndex)                                                     \
  X(PFNGLGETUNIFORMLOCATIONPROC, GetUniformLocation)                                                         \
  X(PFNGLLINKPROGRAMPROC, LinkProgram)                                                                       \
  X(PFNGLPIXELSTOREIPROC, PixelStorei)                                                                       \
  X(PFNGLPOLYGONOFFSETPROC, PolygonOffset)                                                                   \
  X(PFNGLREADBUFFERPROC, ReadBuffer)                                                                         \
  X(PFNGLREADPIXELSPROC, ReadPixels)                                                                         \
  X(PFNGLRENDERBUFFERSTORAGEPROC, RenderbufferStorage)                                                       \
  X(PFNGLRENDERBUFFERSTORAGEMULTISAMPLEPROC, RenderbufferStorageMultisample)                                 \
  X(PFNGLSAMPLERPARAMETERIPROC, SamplerParameteri)                                                           \
  X(PFNGLSHADERSOURCEPROC, ShaderSource)                                                                     \
  X(PFNGLTEXIMAGE2DPROC, TexImage2D)                                                                         \
  X(PFNGLTEXPARAMETERIPROC, TexParameteri)                                                                   \
  X(PFNGLUNIFORM1FPROC, Uniform1f)                                                                           \
  X(PFNGLUNIFORM1IPROC, Uniform1i)                                                                           \
  X(PFNGLUNIFORMBLOCKBINDINGPROC, UniformBlockBinding)                                                       \
  X(PFNGLUNIFORMMATRIX4FVPROC, UniformMatrix4fv)                                                             \
  X(PFNGLUSEPROGRAMPROC, UseProgram)                                                                         \
  X(PFNGLVERTEXATTRIBPOINTERPROC, VertexAttribPointer)                                                       \
  X(PFNGLVIEWPORTPROC, Viewport)

/* gl->Clear is glClear, and so on. */
typedef struct gl_api {
#define RENDER_GL_MEMBER(type, name) type name;
  RENDER_GL_FUNCTIONS(RENDER_GL_MEMBER)
#undef RENDER_GL_MEMBER
} gl_api;

/* Fills every member through `find`; returns the name of the first missing function, NULL if none is. */
const char *gl_api_load(gl_api *gl, gl_function (*find)(const char *name, void *user), void *user);

#endif
