/* What the rules share: where findings go, and scratch memory. */
#ifndef SBFI_VALIDATION_H
#define SBFI_VALIDATION_H

#include "base/diagnostic.h"
#include "base/memory.h"
#include "sbfmt/validate.h"

typedef struct sbfi_validation {
  const sbf_asset *asset;
  const sbf_validate_options *options;
  sbf_validate_result *result;
  sbfi_arena scratch;
  uint32_t repeats;
  /* The run of findings of one code at one place: only the first of them are listed. */
  sbf_code last_code;
  char last_path[256];
  uint32_t run_length;
  bool out_of_memory;
} sbfi_validation;

/* A finding at an element path made from `path_format`'s %u, about one item of a list there (-1: none). The
 * text says what is wrong here; what the code says in general follows it. */
void sbfi_found(sbfi_validation *v, sbf_code code, const char *path, int64_t index, const char *format, ...)
    __attribute__((format(printf, 5, 6)));

/* Element path of a soft body, and of something in one: "/sbf/soft_body[3]/level[1]". */
typedef struct sbfi_path {
  char text[192];
} sbfi_path;
sbfi_path sbfi_path_of(const char *format, ...) __attribute__((format(printf, 1, 2)));

/* Each family of rules, one file each. */
void sbfi_check_surfaces(sbfi_validation *v);
void sbfi_check_lattices(sbfi_validation *v);
void sbfi_check_springs(sbfi_validation *v);
void sbfi_check_pins(sbfi_validation *v);
void sbfi_check_embeddings(sbfi_validation *v);
void sbfi_check_rig(sbfi_validation *v);
void sbfi_check_physics(sbfi_validation *v);
void sbfi_check_derived(sbfi_validation *v);

#endif
