/* Parses the text of a Wavefront OBJ file into lists without interpreting them. */
#ifndef SBFI_OBJ_TEXT_H
#define SBFI_OBJ_TEXT_H

#include "import/scene/name_table.h"

enum { SBFI_OBJ_POINT, SBFI_OBJ_UV, SBFI_OBJ_NORMAL, SBFI_OBJ_KINDS };

/* Indices of a polygon corner, from 0; SBF_NONE if it has no uv or normal. */
typedef struct sbfi_obj_corner {
  int32_t index[SBFI_OBJ_KINDS];
} sbfi_obj_corner;

typedef struct sbfi_obj_polygon {
  uint32_t first_corner;
  int32_t material; /* index into `materials`, or SBF_NONE before the first usemtl */
} sbfi_obj_polygon;

/* Part of the file from an `o` or `g` line, or the top, to the next one. */
typedef struct sbfi_obj_run {
  uint32_t first_polygon;
  int32_t object; /* index into `objects`, or SBF_NONE before the first o */
  int32_t group;  /* index into `groups`, or SBF_NONE before the first g */
} sbfi_obj_run;

/* Consecutive `v` lines without an f, o or g line in between. */
typedef struct sbfi_obj_block {
  uint32_t first_point;
  uint32_t run;
} sbfi_obj_block;

typedef struct sbfi_obj_text {
  sbfi_array points;         /* sbf_vec3 */
  sbfi_array uvs;            /* sbf_vec2 */
  sbfi_array normals;        /* sbf_vec3 */
  sbfi_array corners;        /* sbfi_obj_corner */
  sbfi_array polygons;       /* sbfi_obj_polygon */
  sbfi_array runs;           /* sbfi_obj_run */
  sbfi_array blocks;         /* sbfi_obj_block */
  sbfi_array objects;        /* sbfi_span, one per o line; equal names stay separate */
  sbfi_name_table groups;    /* each name once: a later g of the same name continues it */
  sbfi_name_table materials; /* each name of usemtl once */
  sbfi_array libraries;      /* sbfi_span, one a line mtllib */
  sbfi_array forward;        /* forward references, empty once they are checked */
  uint32_t colored_count;    /* number of points with a color */
  uint32_t colored_line;     /* line of the first point with a color */
  uint32_t ignored_count;    /* number of ignored statements, such as lines and curves */
  uint32_t ignored_line;     /* line of the first ignored statement */
  sbfi_span ignored_keyword;
} sbfi_obj_text;

/* Parses the whole text, which need not end in NUL. Names point into the text. In the result every corner
 * index is in range, every number is finite and every polygon has at least three corners. On failure the
 * lists are empty and `*error` (may be NULL) names the line. */
sbf_status sbfi_obj_text_read(sbfi_obj_text *text, const char *bytes, size_t size,
    const sbf_allocator *allocator, sbf_diagnostic *error);
void sbfi_obj_text_free(sbfi_obj_text *text);

#endif
