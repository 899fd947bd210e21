#include "import/scene/ply_header.h"

#include "base/text.h"

enum { MAX_BYTES = 1 << 20 }; /* far more than any real header */

static bool has_end(sbfi_span rest) {
  sbfi_span line;
  while (sbfi_span_next_line(&rest, &line))
    if (sbfi_span_is(sbfi_span_trim(line), "end_header")) return true;
  return false;
}

sbf_status sbfi_ply_header_check(
    const sbfi_file *file, const sbf_allocator *allocator, sbf_diagnostic *error) {
  sbfi_arena arena;
  size_t size = file->size < MAX_BYTES ? (size_t)file->size : MAX_BYTES;
  sbfi_arena_init(&arena, allocator, 0);
  char *head = sbfi_arena_allocate(&arena, size + 1, 1);
  sbf_status status = head ? sbfi_file_read_at(file, 0, head, size, error)
                           : sbfi_diagnose(error, SBF_CODE_OUT_OF_MEMORY, "no memory to read a header");
  if (status == SBF_OK && !has_end((sbfi_span){head, size}))
    status = sbfi_diagnose(error, SBF_CODE_IMPORT_SYNTAX,
        "the header of the PLY file does not end (no line end_header): the file was cut off; export it "
        "again");
  sbfi_arena_free(&arena);
  return status;
}
