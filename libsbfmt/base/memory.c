#include "base/memory.h"

#include "base/assert.h"

#include <stdlib.h>
#include <string.h>

static void *reallocate_with_malloc(void *user, void *memory, size_t old_size, size_t new_size) {
  (void)user;
  (void)old_size;
  if (new_size == 0) {
    free(memory);
    return NULL;
  }
  return realloc(memory, new_size);
}

sbf_allocator sbfi_allocator_or_default(const sbf_allocator *a) {
  if (a && a->reallocate) return *a;
  return (sbf_allocator){reallocate_with_malloc, NULL};
}

void *sbfi_allocate(const sbf_allocator *a, size_t size) {
  return size ? a->reallocate(a->user, NULL, 0, size) : NULL;
}

void sbfi_free(const sbf_allocator *a, void *memory, size_t size) {
  if (memory) a->reallocate(a->user, memory, size, 0);
}

bool sbfi_multiply_size(size_t a, size_t b, size_t *product) {
  if (b && a > SIZE_MAX / b) return false;
  *product = a * b;
  return true;
}

bool sbfi_add_size(size_t a, size_t b, size_t *sum) {
  if (a > SIZE_MAX - b) return false;
  *sum = a + b;
  return true;
}

struct sbfi_arena_block {
  sbfi_arena_block *previous;
  size_t size; /* of the whole block, including this header */
  size_t used;
};

enum { FIRST_BLOCK = 4096, LARGEST_STEP = 1 << 20, SMALL_ALIGN = 16, LARGE_ALIGN = 64, LARGE_FROM = 256 };

void sbfi_arena_init(sbfi_arena *arena, const sbf_allocator *allocator, size_t limit_bytes) {
  *arena = (sbfi_arena){.allocator = sbfi_allocator_or_default(allocator), .limit_bytes = limit_bytes};
}

void sbfi_arena_free(sbfi_arena *arena) {
  while (arena->last) {
    sbfi_arena_block *block = arena->last;
    arena->last = block->previous;
    sbfi_free(&arena->allocator, block, block->size);
  }
  arena->used_bytes = 0;
}

static size_t aligned_address(const sbfi_arena_block *block, size_t align) {
  uintptr_t address = (uintptr_t)block + block->used;
  return block->used + (size_t)(-address & (align - 1));
}

void *sbfi_arena_allocate(sbfi_arena *arena, size_t count, size_t size) {
  size_t bytes, needed;
  if (!sbfi_multiply_size(count, size, &bytes) || bytes == 0) return NULL;
  if (arena->limit_bytes && (bytes > arena->limit_bytes || arena->used_bytes > arena->limit_bytes - bytes))
    return NULL;
  size_t align = bytes >= LARGE_FROM ? LARGE_ALIGN : SMALL_ALIGN;
  sbfi_arena_block *block = arena->last;
  size_t index = block ? aligned_address(block, align) : 0;
  if (!block || index > block->size || bytes > block->size - index) {
    size_t step = block ? block->size * 2 : FIRST_BLOCK;
    if (step > LARGEST_STEP) step = LARGEST_STEP;
    if (!sbfi_add_size(bytes, sizeof(sbfi_arena_block) + LARGE_ALIGN, &needed)) return NULL;
    if (needed < step) needed = step;
    sbfi_arena_block *fresh = sbfi_allocate(&arena->allocator, needed);
    if (!fresh) return NULL;
    *fresh = (sbfi_arena_block){block, needed, sizeof(sbfi_arena_block)};
    arena->last = block = fresh;
    index = aligned_address(block, align);
  }
  SBF_ASSERT(index <= block->size && bytes <= block->size - index);
  block->used = index + bytes;
  arena->used_bytes += bytes;
  return memset((char *)block + index, 0, bytes);
}

void *sbfi_arena_copy(sbfi_arena *arena, const void *from, size_t count, size_t size) {
  void *copy = sbfi_arena_allocate(arena, count, size);
  return copy ? memcpy(copy, from, count * size) : NULL;
}

char *sbfi_arena_string(sbfi_arena *arena, const char *text, size_t length) {
  char *copy = length < SIZE_MAX ? sbfi_arena_allocate(arena, length + 1, 1) : NULL;
  if (copy && length) memcpy(copy, text, length);
  return copy;
}

void sbfi_array_init(sbfi_array *array, const sbf_allocator *allocator, size_t item_size) {
  *array = (sbfi_array){.allocator = sbfi_allocator_or_default(allocator), .item_size = item_size};
}

bool sbfi_array_reserve(sbfi_array *array, size_t capacity) {
  if (capacity <= array->capacity) return true;
  size_t grown = array->capacity + array->capacity / 2 + 8, bytes;
  if (grown < capacity) grown = capacity;
  if (!sbfi_multiply_size(grown, array->item_size, &bytes)) return false;
  void *at = array->allocator.reallocate(
      array->allocator.user, array->at, array->capacity * array->item_size, bytes);
  if (!at) return false;
  array->at = at;
  array->capacity = grown;
  return true;
}

/* Room for `count` more items, whose content is not defined. NULL if memory runs out. */
static void *extend(sbfi_array *array, size_t count) {
  size_t total;
  /* Reserves at least one item, since NULL means that memory ran out. */
  if (!sbfi_add_size(array->count, count, &total) || !sbfi_array_reserve(array, total ? total : 1))
    return NULL;
  char *destination = (char *)array->at + array->count * array->item_size;
  array->count = total;
  return destination;
}

void *sbfi_array_push(sbfi_array *array, size_t count) {
  void *destination = extend(array, count);
  return destination ? memset(destination, 0, count * array->item_size) : NULL;
}

bool sbfi_array_append(sbfi_array *array, const void *items, size_t count) {
  if (count == 0) return true;
  void *destination = extend(array, count);
  if (!destination) return false;
  memcpy(destination, items, count * array->item_size);
  return true;
}

void sbfi_array_free(sbfi_array *array) {
  sbfi_free(&array->allocator, array->at, array->capacity * array->item_size);
  *array = (sbfi_array){.allocator = array->allocator, .item_size = array->item_size};
}
