/* Materials and their images. Part of sbfmt/model.h, which documents the common conventions.
 *
 * Made from spec/sbf.schema by spec/generate/generate.py: change the schema, not this file. */
#ifndef SBFMT_MODEL_APPEARANCE_H
#define SBFMT_MODEL_APPEARANCE_H

#include "sbfmt/base.h"

#ifdef __cplusplus
extern "C" {
#endif

// clang-format off

/* Values of alpha_mode; sbf_alpha_mode_name returns their names in files. */
typedef enum sbf_alpha_mode {
  SBF_ALPHA_MODE_OPAQUE = 0,
  SBF_ALPHA_MODE_MASK = 1,
  SBF_ALPHA_MODE_BLEND = 2,
  SBF_ALPHA_MODE_COUNT = 3
} sbf_alpha_mode;

/* An image. */
typedef struct sbf_texture {
  const char *id;          /* Identity. */
  const char *name;        /* Name for people. */
  const char *path;        /* Path relative to the file, with forward slashes; empty if the bytes are embedded. */
  const char *media_type;  /* Media type, as image/png or image/jpeg. */
  sbf_u8_list bytes;       /* The embedded image file. */
} sbf_texture;
typedef struct sbf_texture_list { const sbf_texture *at; uint32_t count; } sbf_texture_list;

/* Translation, rotation and scale of texture coordinates, as glTF's KHR_texture_transform. */
typedef struct sbf_uv_transform {
  sbf_vec2 offset;  /* Offset, applied last; v is positive downwards. */
  float rotation;   /* Rotation of coordinates, counter-clockwise about the image's upper left corner. [rad] */
  sbf_vec2 scale;   /* Scale, applied first; 2 repeats the image twice as often. [default 1,1] */
} sbf_uv_transform;
typedef struct sbf_uv_transform_list { const sbf_uv_transform *at; uint32_t count; } sbf_uv_transform_list;

/* An appearance: metallic-roughness, as glTF 2.0 defines it. */
typedef struct sbf_material {
  const char *id;                                 /* Identity. */
  const char *name;                               /* Name for people. */
  sbf_vec4 base_color;                            /* Linear red, green, blue and opacity. [[0, 1]; default 1,1,1,1] */
  float metallic;                                 /* 0 dielectric, 1 metal. [[0, 1]; default 0] */
  float roughness;                                /* 0 mirror, 1 matt. [[0, 1]; default 1] */
  sbf_vec3 emissive;                              /* Emitted linear color. [[0, inf)] */
  sbf_alpha_mode alpha_mode;                      /* Use of opacity. [default opaque] */
  float alpha_cutoff;                             /* Threshold of opacity in alpha mode `mask`. [[0, 1]; default 0.5] */
  bool double_sided;                              /* Visible from both sides. [default false] */
  int32_t base_color_texture;                     /* Image of the base color.
                                                   * [index into asset.textures, or SBF_NONE] */
  int32_t metallic_roughness_texture;             /* Roughness in green, metallic in blue.
                                                   * [index into asset.textures, or SBF_NONE] */
  int32_t normal_texture;                         /* Tangent-space normals. [index into asset.textures, or SBF_NONE] */
  const sbf_uv_transform *base_color_uv;          /* Transform of the base color's image. */
  const sbf_uv_transform *metallic_roughness_uv;  /* Transform of the image of roughness and metal. */
  const sbf_uv_transform *normal_uv;              /* Transform of the image of normals. */
} sbf_material;
typedef struct sbf_material_list { const sbf_material *at; uint32_t count; } sbf_material_list;

/* Sets every field to its default, lists to empty, references to SBF_NONE. */
SBF_API void sbf_texture_init(sbf_texture *texture);
SBF_API void sbf_uv_transform_init(sbf_uv_transform *uv_transform);
SBF_API void sbf_material_init(sbf_material *material);

/* The name of a value in files, or "?" if it is out of range. */
SBF_API const char *sbf_alpha_mode_name(sbf_alpha_mode value);

// clang-format on

#ifdef __cplusplus
}
#endif
#endif
