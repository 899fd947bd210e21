/* Which bodies embed which vertices of the render meshes. */
#ifndef SBFI_EMBED_H
#define SBFI_EMBED_H

#include "base/diagnostic.h"
#include "base/progress.h"
#include "build/embed/embedder.h"
#include "build/sections/sections.h"

/* One level that is to embed. */
typedef struct sbfi_embed_target {
  uint32_t body; /* in asset->soft_bodies; targets stand in body order, levels finest first */
  sbf_level *level;
  const sbfi_interior_map *interior; /* NULL: not made by sbfi_spring_level_make */
  uint32_t frame; /* first of the level's frame points (section_frame.h); SBFI_NO_INDEX: it has none */
} sbfi_embed_target;

typedef struct sbfi_embed_report {
  uint32_t vertices; /* of render meshes that bodies embed at their finest level */
  uint32_t flat;     /* of them, those that are embedded beside their place */
  double farthest;   /* m, greatest distance outside a lattice */
} sbfi_embed_report;

/* Gives every target an embedding of its body's own surface and of the render meshes it embeds, beside those
 * it has already, which stay in place of new ones for the same mesh; marked with `derivation`.
 *
 * A skinned mesh of which a body without a bone has every vertex goes to that. One that was cut goes to its
 * sections, by what `sections` says of its vertices (sections.h; the last of the asset's bodies; may be NULL
 * or have no blends). One with authored sections (authored_sections.h) goes by its weights: each bone's share
 * to the body of the bone itself or of its nearest ancestor that has one; shares are scaled to a sum of one,
 * and a vertex none of whose bones has a body is not embedded. Any other skin follows its bones alone: what
 * hangs on them beside it, as a hat, does not embed it. A mesh with a bone goes to that body, or its
 * ancestor's, whole. A mesh with neither goes to the first body that has a surface point in the place of
 * every vertex, as when mesh and body are one object of the source; else vertex by vertex to the nearest
 * body. Of several bodies on one bone it is the same. Meshes that nothing embeds are reported.
 *
 * `asset` is the one under construction that the targets belong to. False where memory runs out or `progress`
 * ends it. */
bool sbfi_embed(sbf_asset *asset, const sbfi_embed_target *targets, uint32_t target_count,
    const sbfi_sections *sections, int32_t derivation, sbfi_reporter *reporter, sbfi_embed_report *report,
    sbfi_progress progress, sbfi_arena *scratch);

#endif
