/* Chooses which bodies embed which vertices of the render meshes. */
#ifndef SBFI_EMBED_H
#define SBFI_EMBED_H

#include "base/diagnostic.h"
#include "base/progress.h"
#include "build/embed/embedder.h"
#include "build/sections/sections.h"

/* A level for which embeddings are made. */
typedef struct sbfi_embed_target {
  uint32_t body; /* in asset->soft_bodies; targets are sorted by body, levels finest first */
  sbf_level *level;
  const sbfi_interior_map *interior; /* NULL: sbfi_spring_level_make did not create the level */
  uint32_t frame; /* first of the level's frame points (section_frame.h); SBFI_NO_INDEX: none */
} sbfi_embed_target;

typedef struct sbfi_embed_report {
  uint32_t vertices; /* vertices of render meshes that bodies embed at their finest level */
  uint32_t flat;     /* of these, those that are embedded inaccurately */
  double farthest;   /* m, largest distance outside a lattice */
} sbfi_embed_report;

/* Adds to every target an embedding of its body's own surface and of its render meshes, marked with
 * `derivation`; existing embeddings replace new ones for the same mesh.
 *
 * A body without a bone that has every vertex of a skinned mesh embeds it. Sections embed a skin that was
 * cut, by the blends in `sections` (sections.h; the last of the asset's bodies; may be NULL or have no
 * blends). A skin with authored sections (authored_sections.h) is distributed by its weights: each bone's
 * weight goes to the body of the bone or of its nearest ancestor with one; the sum is normalized, and a
 * vertex without such a body is not embedded. Any other skin follows its bones alone: accessories on the
 * bones, such as a hat, do not embed it. A mesh with a bone goes entirely to that bone's, or its ancestor's,
 * body. A mesh with neither goes to the first body with a surface point at every vertex, as when mesh and
 * body are one object of the source; otherwise each vertex goes to the nearest body. The same holds for
 * several bodies on one bone. Reports meshes that are not embedded.
 *
 * `asset` is under construction and contains the targets. False if memory runs out or `progress` cancels. */
bool sbfi_embed(sbf_asset *asset, const sbfi_embed_target *targets, uint32_t target_count,
    const sbfi_sections *sections, int32_t derivation, sbfi_reporter *reporter, sbfi_embed_report *report,
    sbfi_progress progress, sbfi_arena *scratch);

#endif
