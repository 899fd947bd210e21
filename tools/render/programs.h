/* The shaders, compiled and linked. */
#ifndef RENDER_PROGRAMS_H
#define RENDER_PROGRAMS_H

#include "render/gl_api.h"
#include "sbfmt/base.h"

typedef enum program_name {
  PROGRAM_BACKDROP,
  PROGRAM_DEPTH,
  PROGRAM_DEPTH_MASK, /* with holes */
  PROGRAM_OPEN_SKY,
  PROGRAM_GROUND_LIGHT,
  PROGRAM_SOFTEN,
  PROGRAM_GROUND,
  PROGRAM_MESH,
  PROGRAM_MESH_IMAGE, /* with a texture */
  PROGRAM_MESH_ALPHA, /* the same, with holes or blended */
  PROGRAM_XRAY,       /* a transparent mesh */
  PROGRAM_LINE,
  PROGRAM_LAYER,
  PROGRAM_COUNT
} program_name;

/* Texture units, the same in all programs. */
enum {
  UNIT_SHADOW_MAP,
  UNIT_SHADOW_DEPTHS,
  UNIT_GROUND_LIGHT,
  UNIT_GROUND_HEIGHTS,
  UNIT_LOWEST_HEIGHTS,
  UNIT_OPEN_SKY,
  UNIT_XRAY_DEPTHS,
  UNIT_LINE_LAYER,
  UNIT_BASE_IMAGE
};

typedef struct program_set {
  GLuint at[PROGRAM_COUNT];
  GLint opacity;                          /* uniform of PROGRAM_XRAY */
  GLint map_from_world;                   /* uniform of PROGRAM_DEPTH */
  GLint mask_map_from_world, mask_cutoff; /* uniforms of PROGRAM_DEPTH_MASK */
  GLint cutoff;                           /* uniform of PROGRAM_MESH_ALPHA */
  GLint murk, thinness;                   /* uniforms of PROGRAM_LINE */
} program_set;

/* On failure everything is destroyed. The uniform block Frame is bound to point 0. */
sbf_status programs_create(program_set *programs, const gl_api *gl, sbf_diagnostic *diagnostic);
void programs_destroy(program_set *programs, const gl_api *gl);

#endif
