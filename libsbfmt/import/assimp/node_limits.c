#include "node_limits.h"

#include <stdbool.h>
#include <stdint.h>
#include <string.h>

#include "import/scene/stream_format.h"
#include "stream_writer.h"

bool metadata_number(const struct aiMetadataEntry *entry, double *to) {
  switch (entry->mType) {
  case AI_FLOAT:
    *to = (double)*(const float *)entry->mData;
    return true;
  case AI_DOUBLE:
    *to = *(const double *)entry->mData;
    return true;
  case AI_INT32:
    *to = *(const int32_t *)entry->mData;
    return true;
  case AI_UINT64:
    *to = (double)*(const uint64_t *)entry->mData;
    return true;
  default:
    return false;
  }
}

/* Reads up to `capacity` numbers of a key. A list of glTF is either one metadata block or several entries
 * with one key. */
static unsigned numbers_of(
    const struct aiMetadata *data, const char *key, float *to, unsigned capacity, bool inner) {
  unsigned count = 0;
  for (unsigned i = 0; i < data->mNumProperties && count < capacity; i++) {
    const struct aiMetadataEntry *entry = &data->mValues[i];
    double number;
    if (!inner && strcmp(data->mKeys[i].data, key) != 0) continue;
    if (metadata_number(entry, &number))
      to[count++] = (float)number;
    else if (entry->mType == AI_AIMETADATA && !inner)
      count += numbers_of(entry->mData, key, to + count, capacity - count, true);
  }
  return count;
}

void write_limits(const struct aiMetadata *data) {
  static const char *const keys[SBFI_STREAM_LIMITS] = {"twist", "swing_y", "swing_z"};
  float limits[SBFI_STREAM_LIMITS][2] = {{0}};
  uint32_t stated = 0;
  for (unsigned i = 0; data && i < data->mNumProperties; i++) {
    if (strcmp(data->mKeys[i].data, "sbf_limits") != 0 || data->mValues[i].mType != AI_AIMETADATA) continue;
    for (int k = 0; k < SBFI_STREAM_LIMITS; k++)
      if (numbers_of(data->mValues[i].mData, keys[k], limits[k], 2, false) == 2) stated |= 1u << k;
  }
  write_u32(stated);
  for (int k = 0; k < SBFI_STREAM_LIMITS; k++)
    if (stated >> k & 1) write_f32s(limits[k], 2);
}
