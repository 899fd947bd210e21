/* Buffers that are returned to the caller. */
#include "base/memory.h"
#include "sbfmt/packed.h"

void sbf_buffer_free(sbf_buffer *buffer) {
  sbfi_free(&buffer->allocator, buffer->at, buffer->capacity);
  buffer->at = NULL;
  buffer->size = buffer->capacity = 0;
}
