#include "model/bone_ends.h"

#include <string.h>

bool sbfi_name_is_end(const char *name, size_t length) {
  static const char *const ends[] = {"_end", "_End", ".end", "Nub"};
  for (size_t i = 0; i < sizeof ends / sizeof *ends; i++) {
    size_t size = strlen(ends[i]);
    if (length > size && memcmp(name + length - size, ends[i], size) == 0) return true;
  }
  return (length >= 7 && memcmp(name, "EndSite", 7) == 0) ||
         (length >= 8 && memcmp(name, "End Site", 8) == 0);
}
