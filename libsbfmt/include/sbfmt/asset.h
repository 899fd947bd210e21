/* Creating, filling and freeing an asset in memory. Its content is declared in sbfmt/model.h.
 *
 * A loaded asset is never changed and may be read from any number of threads. An asset under construction
 * belongs to one thread: allocate lists with sbf_asset_allocate, fill them, then store pointer and count. */
#ifndef SBFMT_ASSET_H
#define SBFMT_ASSET_H

#include "sbfmt/model.h"

#ifdef __cplusplus
extern "C" {
#endif

/* An empty asset with every field at its default; NULL if memory runs out. `allocator` may be NULL (malloc);
 * it is copied and must outlive the asset. Free with sbf_asset_free. */
SBF_API sbf_asset *sbf_asset_create(const sbf_allocator *allocator);

/* Frees the asset and everything it points to; NULL does nothing. */
SBF_API void sbf_asset_free(sbf_asset *asset);

/* Zeroed memory that lives as long as the asset. NULL for zero bytes, or if memory runs out. Blocks of at
 * least 256 bytes are aligned to 64 bytes. */
SBF_API void *sbf_asset_allocate(sbf_asset *asset, size_t count, size_t size);

/* A copy of `text` (NUL-terminated UTF-8) that lives as long as the asset; NULL if memory runs out. */
SBF_API const char *sbf_asset_copy_text(sbf_asset *asset, const char *text);

/* A deep copy that shares nothing; NULL if memory runs out. */
SBF_API sbf_asset *sbf_asset_clone(const sbf_asset *asset, const sbf_allocator *allocator);

/* Whether two assets are equal, bit by bit, except for what depends on the machine (simulation.measured). If
 * they differ and `path` is not NULL, `path` receives the element path of the first difference. */
SBF_API bool sbf_asset_equal(const sbf_asset *a, const sbf_asset *b, char *path, size_t path_size);

/* Checks the structure: everything that sbfmt/packed.h promises of a loaded asset. Reports faults through
 * `report` (may be NULL), returns their number, and stops after `limit` faults (0: no limit). Reports only
 * the first invalid item of a list. `asset` is from sbf_asset_create or a load. */
SBF_API uint32_t sbf_asset_check(const sbf_asset *asset,
    void (*report)(void *user, const sbf_diagnostic *diagnostic), void *user, uint32_t limit);

#ifdef __cplusplus
}
#endif
#endif
