/* Title, origin, and records of computed parts. Part of sbfmt/model.h, which documents the common conventions.
 *
 * Made from spec/sbf.schema by spec/generate/generate.py: change the schema, not this file. */
#ifndef SBFMT_MODEL_INFO_H
#define SBFMT_MODEL_INFO_H

#include "sbfmt/base.h"

#ifdef __cplusplus
extern "C" {
#endif

// clang-format off

/* An author of the asset. */
typedef struct sbf_author {
  const char *name;     /* Name. */
  const char *contact;  /* Mail address or page. */
} sbf_author;
typedef struct sbf_author_list { const sbf_author *at; uint32_t count; } sbf_author_list;

/* A file the source parts were read from. */
typedef struct sbf_source {
  const char *path;    /* Path or name as it was given, without the folders of the machine. */
  const char *sha256;  /* SHA-256 of its bytes, 64 hexadecimal digits. */
} sbf_source;
typedef struct sbf_source_list { const sbf_source *at; uint32_t count; } sbf_source_list;

/* Title and origin of the asset. */
typedef struct sbf_info {
  const char *title;        /* Name for people. */
  const char *licence;      /* Licence, as an SPDX expression if there is one. */
  const char *copyright;    /* Owner of the rights. */
  const char *tool;         /* Program and version that wrote the source parts. */
  const char *comment;      /* Other text for people. */
  sbf_author_list authors;  /* Authors. */
  sbf_source_list sources;  /* Files the source parts were read from. */
  float mass;               /* Mass of all soft bodies, if no derivation states it. [kg; [0, inf)] */
  sbf_vec3 low;             /* Minimum coordinates of all render meshes and surfaces, if no derivation states them.
                             * [m] */
  sbf_vec3 high;            /* Maximum coordinates; equal to `low`: not stated. [m] */
} sbf_info;
typedef struct sbf_info_list { const sbf_info *at; uint32_t count; } sbf_info_list;

/* A run of a build: parts that name it are derived and can be made again. */
typedef struct sbf_derivation {
  const char *id;           /* Identity. */
  const char *tool;         /* Program and version. */
  const char *settings;     /* Settings as `name=value` separated by spaces, in alphabetical order. */
  const char *source_hash;  /* SHA-256 of the canonical XML of the source, 64 hexadecimal digits. */
  float mass;               /* Mass of all soft bodies as built, for reports without the geometry. [kg; [0, inf)] */
  sbf_vec3 low;             /* Minimum coordinates of all render meshes and surfaces, as built. [m] */
  sbf_vec3 high;            /* Maximum coordinates; equal to `low`: not stated. [m] */
} sbf_derivation;
typedef struct sbf_derivation_list { const sbf_derivation *at; uint32_t count; } sbf_derivation_list;

/* Content beyond this specification. */
typedef struct sbf_extension {
  const char *name;  /* As VENDOR_name. */
  bool required;     /* A reader that does not know it must refuse the file. [default false] */
  const char *data;  /* Content, in any text form. */
} sbf_extension;
typedef struct sbf_extension_list { const sbf_extension *at; uint32_t count; } sbf_extension_list;

/* Sets every field to its default, lists to empty, references to SBF_NONE. */
SBF_API void sbf_author_init(sbf_author *author);
SBF_API void sbf_source_init(sbf_source *source);
SBF_API void sbf_info_init(sbf_info *info);
SBF_API void sbf_derivation_init(sbf_derivation *derivation);
SBF_API void sbf_extension_init(sbf_extension *extension);

// clang-format on

#ifdef __cplusplus
}
#endif
#endif
