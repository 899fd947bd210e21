/* Finds sections that the skin of a character hides. */
#ifndef SBFI_COVERED_SECTIONS_H
#define SBFI_COVERED_SECTIONS_H

#include "base/memory.h"
#include "sbfmt/model.h"

/* Skinned meshes of an asset, prepared for queries. */
typedef struct sbfi_skins {
  struct sbfi_one_skin *at;
  uint32_t count;
} sbfi_skins;

/* `meshes` must outlive the result. Allocates from `arena`; false if memory runs out. */
bool sbfi_skins_make(
    sbfi_skins *skins, const sbf_render_mesh *meshes, uint32_t mesh_count, sbfi_arena *arena);

/* Whether a skin hides the whole surface: the centre and the corners of every polygon are inside or on a
 * skin. A point is inside if the skin encloses 95 % of the directions around it, so legs under a skirt
 * stay visible. */
bool sbfi_skins_hide(const sbfi_skins *skins, const sbf_polygon_mesh *surface);

#endif
