/* Shared by the writers of other programs' formats. */
#ifndef SBFI_EXPORTING_H
#define SBFI_EXPORTING_H

#include "base/diagnostic.h"
#include "base/memory.h"
#include "base/text.h"
#include "sbfmt/export.h"

typedef struct sbfi_export {
  const sbf_asset *asset;
  const char *path;
  sbf_allocator allocator;
  sbfi_reporter reporter;
  /* As in the options. */
  uint32_t render_level;
  const char *folder;
  const sbf_texture_list *images;
  const sbf_export_motion *motion; /* NULL if it has no frames */
  bool soft_bodies, store;
  int compression; /* zlib level */
  sbfi_text text;  /* of the file */
  sbf_diagnostic *error;
} sbfi_export;

/* Each fills e->text and writes the file with its companions. */
sbf_status sbfi_export_paper(sbfi_export *e);
sbf_status sbfi_export_glb(sbfi_export *e);
sbf_status sbfi_export_html(sbfi_export *e);
sbf_status sbfi_export_obj(sbfi_export *e);
sbf_status sbfi_export_tet(sbfi_export *e);
sbf_status sbfi_export_tetgen(sbfi_export *e);
sbf_status sbfi_export_msh(sbfi_export *e);
sbf_status sbfi_export_vtu(sbfi_export *e);
sbf_status sbfi_export_mjcf(sbfi_export *e);
sbf_status sbfi_export_usda(sbfi_export *e);
sbf_status sbfi_export_weights_csv(sbfi_export *e);
sbf_status sbfi_export_weights_json(sbfi_export *e);

sbf_status sbfi_export_no_memory(sbfi_export *e);
/* Writes e->text to `path` and clears it. */
sbf_status sbfi_export_commit(sbfi_export *e, const char *path);

/* Parts of the asset that a format cannot represent. */
typedef struct sbfi_left_out {
  uint32_t count;
  const char *what; /* plural */
} sbfi_left_out;
/* One warning with all counts above 0; `form` is the format, as "OBJ". */
void sbfi_export_left_out(sbfi_export *e, const char *form, const sbfi_left_out *things, size_t count);
void sbfi_export_warn(sbfi_export *e, const char *format, ...) __attribute__((format(printf, 2, 3)));

/* Appends text of up to 255 bytes. */
void sbfi_export_print(sbfi_text *text, const char *format, ...) __attribute__((format(printf, 2, 3)));
/* A JSON member with the numbers of the set bits as a list, each between `before` and `after`. */
void sbfi_export_bits(
    sbfi_text *text, const char *name, uint32_t bits, const char *before, const char *after);
void sbfi_export_format(sbfi_export *e, const char *format, ...) __attribute__((format(printf, 2, 3)));
void sbfi_export_vec3(sbfi_export *e, sbf_vec3 v); /* three numbers, each after a space */

/* The body's first level of tetrahedra, or NULL. */
const sbf_level *sbfi_export_lattice(const sbf_soft_body *body);
/* Its first level of springs, or NULL. */
const sbf_level *sbfi_export_network(const sbf_soft_body *body);
/* Level point of a surface point; SBFI_NOT_IN_LEVEL if it has none. */
#define SBFI_NOT_IN_LEVEL UINT32_MAX
uint32_t sbfi_export_index(const sbf_level *level, uint32_t point);
/* Whether the body is a sheet and the level has all its surface points. */
bool sbfi_export_is_sheet(const sbf_soft_body *body, const sbf_level *level);
/* The first lattice, or the springs of a sheet; NULL: neither. */
const sbf_level *sbfi_export_level(const sbf_soft_body *body);
/* Weight of a pin, clamped to the set's bounds; 1 is rigid. */
float sbfi_export_pin_weight(const sbf_pin_set *set, uint32_t k);
/* Skin of a mesh that sections embed, from their bones; NULL: none does. Allocates from `arena`; false if
 * memory runs out. */
bool sbfi_export_section_skin(
    const sbf_asset *asset, uint32_t render_mesh, sbfi_arena *arena, const sbf_skin **made);

#endif
