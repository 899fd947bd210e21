/* What the passes of sbf_fix share: the copy they work on, lists that shrink, and the record of what they
 * did. */
#ifndef SBFI_REPAIR_H
#define SBFI_REPAIR_H

#include "validate/validation.h"

typedef struct sbfi_repair {
  sbf_asset *asset; /* a copy of the caller's, all of which may be written to */
  const sbf_fix_options *options;
  sbf_fix_result *result;
  sbfi_arena scratch; /* emptied after each pass */
  bool out_of_memory;
} sbfi_repair;

/* Reports that `count` faults of the code were mended at the path; `index` is that of the first in the list
 * there, before anything was changed, -1: none. */
void sbfi_count_repair(sbfi_repair *m, sbf_code code, uint32_t count, const char *path, int64_t index,
    const char *format, ...) __attribute__((format(printf, 6, 7)));

/* Zeroed scratch memory as sbfi_scratch gives it. */
void *sbfi_repair_scratch(sbfi_repair *m, size_t count, size_t size);

/* The asset is a copy, so what it points at may be written to. */
static inline void *sbfi_writable(const void *of_the_copy) {
  return (void *)(uintptr_t)of_the_copy;
}

/* Takes the items marked out of a list of any type: `list` points at an sbf_*_list with items of `size`. */
void sbfi_list_drop(void *list, size_t size, const uint8_t *dropped);

/* Elements in colour order of which some are dropped: so many fewer of their colours. */
void sbfi_colors_drop(sbf_u32_list *counts, const uint8_t *dropped, uint32_t count);

/* The passes, one file each. None of them changes what it cannot decide. */
void sbfi_repair_rotations(sbfi_repair *m);
void sbfi_repair_weights(sbfi_repair *m);
void sbfi_repair_blends(sbfi_repair *m);
void sbfi_repair_tetrahedra(sbfi_repair *m);
void sbfi_repair_springs(sbfi_repair *m);
void sbfi_repair_pins(sbfi_repair *m);
void sbfi_repair_winding(sbfi_repair *m);
void sbfi_repair_points(sbfi_repair *m);
void sbfi_repair_mesh_points(sbfi_repair *m);

/* Builds anew what is stale, where the same settings can be used; may replace m->asset. */
sbf_status sbfi_repair_derived(sbfi_repair *m, sbf_diagnostic *error);

#endif
