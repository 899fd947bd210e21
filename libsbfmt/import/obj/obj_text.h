/* The text of a Wavefront OBJ file as lists, nothing interpreted yet: statements in, numbers out. */
#ifndef SBFI_OBJ_TEXT_H
#define SBFI_OBJ_TEXT_H

#include "import/scene/name_table.h"

enum { SBFI_OBJ_POINT, SBFI_OBJ_UV, SBFI_OBJ_NORMAL, SBFI_OBJ_KINDS };

/* What a corner of a polygon refers to, from 0; SBF_NONE for no uv or no normal. */
typedef struct sbfi_obj_corner {
  int32_t index[SBFI_OBJ_KINDS];
} sbfi_obj_corner;

typedef struct sbfi_obj_polygon {
  uint32_t first_corner;
  int32_t material; /* index into `materials`, or SBF_NONE before the first usemtl */
} sbfi_obj_polygon;

/* Begins at a line `o` or `g`, and at the top of the file: what follows up to the next run belongs to it. */
typedef struct sbfi_obj_run {
  uint32_t first_polygon;
  int32_t object; /* index into `objects`, or SBF_NONE before the first o */
  int32_t group;  /* index into `groups`, or SBF_NONE before the first g */
} sbfi_obj_run;

/* Lines `v` that follow each other with no line f, o or g between them. */
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
  sbfi_array objects;        /* sbfi_span, one a line o: equal names stay apart */
  sbfi_name_table groups;    /* each name once: a later g of the same name continues it */
  sbfi_name_table materials; /* each name of usemtl once */
  sbfi_array libraries;      /* sbfi_span, one a line mtllib */
  sbfi_array forward;        /* references to lines that come later, empty once they are checked */
  uint32_t ignored_count;    /* statements of no use here, as lines and curves */
  uint32_t ignored_line;     /* of the first of them */
  sbfi_span ignored_keyword;
} sbfi_obj_text;

/* Reads the whole text, which need not end in NUL; names refer to it. In what it gives back every index of a
 * corner is in range, every number finite, every polygon has three corners or more. On failure the lists are
 * empty and `*error` (may be NULL) says which line is at fault. */
sbf_status sbfi_obj_text_read(sbfi_obj_text *text, const char *bytes, size_t size,
    const sbf_allocator *allocator, sbf_diagnostic *error);
void sbfi_obj_text_free(sbfi_obj_text *text);

#endif
