/* Joint limits in custom data of a node: in glTF extras.sbf_limits with "twist", "swing_y" and "swing_z",
 * each [min, max] in radians. */
#ifndef NODE_LIMITS_H
#define NODE_LIMITS_H

#include <assimp/scene.h> /* metadata.h is not self-contained */
#include <stdbool.h>

/* Writes which limits are present, then their values; see import/scene/stream_format.h. `data` may be
 * NULL. */
void write_limits(const struct aiMetadata *data);

/* Converts a numeric entry; its type differs between importers and versions. False if it is not a number. */
bool metadata_number(const struct aiMetadataEntry *entry, double *to);

#endif
