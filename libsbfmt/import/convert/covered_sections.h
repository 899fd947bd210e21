/* Which bodies on bones a skin hides: sections of a character that is drawn by its skin. */
#ifndef SBFI_COVERED_SECTIONS_H
#define SBFI_COVERED_SECTIONS_H

#include "base/memory.h"
#include "sbfmt/model.h"

/* The skinned meshes of an asset, ready for queries. */
typedef struct sbfi_skins {
  struct sbfi_one_skin *at;
  uint32_t count;
} sbfi_skins;

/* `meshes` must outlive it. Memory of `arena`; false where it runs out. */
bool sbfi_skins_make(
    sbfi_skins *skins, const sbf_render_mesh *meshes, uint32_t mesh_count, sbfi_arena *arena);

/* Whether nothing of a surface shows: the middle and the corners of every polygon lie inside a skin or in its
 * surface. Inside is what the skin encloses on all sides, but for a twentieth of the directions: legs under a
 * skirt show. */
bool sbfi_skins_hide(const sbfi_skins *skins, const sbf_polygon_mesh *surface);

#endif
