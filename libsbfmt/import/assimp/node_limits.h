/* Joint limits that a node carries as custom data: in a glTF extras.sbf_limits with "twist", "swing_y" and
 * "swing_z", each [least, greatest] in radians. */
#ifndef NODE_LIMITS_H
#define NODE_LIMITS_H

#include <assimp/scene.h> /* metadata.h does not stand by itself */
#include <stdbool.h>

/* Writes which limits are stated, then those; see import/scene/stream_format.h. `data` may be NULL. */
void write_limits(const struct aiMetadata *data);

/* The type under which a number is stored differs between importers and versions. False where it is none. */
bool metadata_number(const struct aiMetadataEntry *entry, double *to);

#endif
