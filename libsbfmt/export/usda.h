/* Shared by the parts of the USD writer: prims, names, arrays. Everything is below </asset>, with +Y up as
 * in assets. Prims are named by ids. */
#ifndef SBFI_USDA_H
#define SBFI_USDA_H

#include "export/exporting.h"

/* Written polygons of a render mesh, and its skin or bone. */
typedef struct usda_mesh {
  const sbf_render_mesh *full;   /* of the asset */
  const sbf_render_mesh *shown;  /* the same, or one of its render levels */
  const uint32_t *full_of_shown; /* (points of shown); NULL: the same */
  const uint32_t *shown_of_full; /* (points of full); UINT32_MAX: not written; NULL: the same */
  const sbf_skin *skin;          /* of full's points; NULL: it follows a bone, or nothing */
  int32_t body; /* the only written body that embeds it, which becomes its parent; else SBF_NONE */
} usda_mesh;

typedef struct usda_writer {
  sbfi_export *e;
  sbfi_arena scratch;
  unsigned depth;
  usda_mesh *meshes;   /* (render meshes) */
  bool *bone_has_pins; /* (bones) moves points of written bodies */
  /* Counts of unsupported parts. */
  uint32_t images, shared, without_level, goals, moduli, damped, inelastic, pulleys, soft_limits, filters,
      weights, keys;
} usda_writer;

/* An id as a prim's name: characters other than letters, digits and '_' become '_'; then two '_' and the
 * index are appended, to keep ids distinct. */
void sbfi_usda_name(usda_writer *w, const char *id, uint32_t index);
/* Writes </asset/SCOPE/NAME followed by `rest`, which ends with '>'. */
void sbfi_usda_write_path(
    usda_writer *w, const char *scope, const char *id, uint32_t index, const char *rest);

/* Writes a line of up to 255 bytes at the current depth. */
void sbfi_usda_write_line(usda_writer *w, const char *format, ...) __attribute__((format(printf, 2, 3)));
void sbfi_usda_begin(usda_writer *w, const char *text); /* the same without the line end */
void sbfi_usda_end(usda_writer *w);
/* def TYPE "NAME" with its schemas, as in "\"A\", \"B\"", "" for none; the prim stays open. */
void sbfi_usda_open(usda_writer *w, const char *type, const char *id, uint32_t index, const char *schemas);
void sbfi_usda_open_plain(usda_writer *w, const char *type, const char *name, const char *schemas);
void sbfi_usda_close(usda_writer *w);

void sbfi_usda_write_f32(usda_writer *w, const char *declaration, float value); /* DECLARATION = value */
void sbfi_usda_write_vec3(usda_writer *w, const char *declaration, sbf_vec3 v);
void sbfi_usda_write_quat(usda_writer *w, const char *declaration, sbf_quat q); /* w first */
void sbfi_usda_write_translation(usda_writer *w, sbf_vec3 at);                  /* the prim's xform */
void sbfi_usda_write_tuple(usda_writer *w, const float *numbers, int count);    /* (a, b, c) */
/* DECLARATION = [...]: points minus `origin`, and indices in tuples of `size`. */
void sbfi_usda_write_points(
    usda_writer *w, const char *declaration, const sbf_vec3 *points, uint32_t count, sbf_vec3 origin);
void sbfi_usda_write_indices(
    usda_writer *w, const char *declaration, const uint32_t *indices, uint32_t count, int size);
/* Bounds of points, as `extent`. */
void sbfi_usda_write_extent(usda_writer *w, const sbf_vec3 *points, uint32_t count, sbf_vec3 origin);

/* Sections written by each file of the writer; false if memory runs out. */
bool sbfi_usda_choose_meshes(usda_writer *w);
void sbfi_usda_write_materials(usda_writer *w);
bool sbfi_usda_skeleton_and_meshes(usda_writer *w);
bool sbfi_usda_mesh(usda_writer *w, uint32_t index);
void sbfi_usda_write_rigid_bodies(usda_writer *w);
void sbfi_usda_write_joints(usda_writer *w);
bool sbfi_usda_soft_bodies(usda_writer *w); /* and the bones to which their points are pinned */

#endif
