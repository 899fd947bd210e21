/* Shared by the passes of sbf_fix: the asset's copy, removal of list items, and the record of repairs. */
#ifndef SBFI_REPAIR_H
#define SBFI_REPAIR_H

#include "validate/validation.h"

typedef struct sbfi_repair {
  sbf_asset *asset; /* a writable copy of the caller's asset */
  const sbf_fix_options *options;
  sbf_fix_result *result;
  sbfi_arena scratch; /* reset after each pass */
  bool out_of_memory;
} sbfi_repair;

/* Reports that `count` faults of the code were repaired at the path. `index` is that of the first item in
 * its list before any change, -1: none. */
void sbfi_count_repair(sbfi_repair *m, sbf_code code, uint32_t count, const char *path, int64_t index,
    const char *format, ...) __attribute__((format(printf, 6, 7)));

/* Zeroed scratch memory, like sbfi_scratch. */
void *sbfi_repair_scratch(sbfi_repair *m, size_t count, size_t size);

/* The asset is a copy, so its content is writable. */
static inline void *sbfi_writable(const void *of_the_copy) {
  return (void *)(uintptr_t)of_the_copy;
}

/* Removes marked items from a list of any type: `list` points at an sbf_*_list with items of `size`. */
void sbfi_list_drop(void *list, size_t size, const uint8_t *dropped);

/* Decrements the colour counts of dropped elements; elements are ordered by colour. */
void sbfi_colors_drop(sbf_u32_list *counts, const uint8_t *dropped, uint32_t count);

/* The passes, one file each. They leave ambiguous cases unchanged. */
void sbfi_repair_rotations(sbfi_repair *m);
void sbfi_repair_weights(sbfi_repair *m);
void sbfi_repair_blends(sbfi_repair *m);
void sbfi_repair_tetrahedra(sbfi_repair *m);
void sbfi_repair_springs(sbfi_repair *m);
void sbfi_repair_pins(sbfi_repair *m);
void sbfi_repair_winding(sbfi_repair *m);
void sbfi_repair_points(sbfi_repair *m);
void sbfi_repair_mesh_points(sbfi_repair *m);

/* Rebuilds stale parts if their settings are known; may replace m->asset. */
sbf_status sbfi_repair_derived(sbfi_repair *m, sbf_diagnostic *error);

#endif
