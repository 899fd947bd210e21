/* Allocation: checked sizes, the default allocator, and an arena that frees all its blocks in one call. */
#ifndef SBFI_MEMORY_H
#define SBFI_MEMORY_H

#include "sbfmt/base.h"

/* The allocator that `a` points to, or malloc's if it is NULL. */
sbf_allocator sbfi_allocator_or_default(const sbf_allocator *a);

void *sbfi_allocate(const sbf_allocator *a, size_t size); /* NULL on failure or size 0 */
void sbfi_free(const sbf_allocator *a, void *memory, size_t size);

/* a * b and a + b, false on overflow. */
bool sbfi_multiply_size(size_t a, size_t b, size_t *product);
bool sbfi_add_size(size_t a, size_t b, size_t *sum);

/* Allocates blocks of growing size. Memory is zeroed, aligned to 16 (64 from 256 bytes on), and lives until
 * the arena is freed. Not thread safe. */
typedef struct sbfi_arena_block sbfi_arena_block;
typedef struct sbfi_arena {
  sbf_allocator allocator;
  sbfi_arena_block *last;
  size_t used_bytes;  /* allocated so far */
  size_t limit_bytes; /* 0: none */
} sbfi_arena;

void sbfi_arena_init(sbfi_arena *arena, const sbf_allocator *allocator, size_t limit_bytes);
void sbfi_arena_free(sbfi_arena *arena);
void *sbfi_arena_allocate(
    sbfi_arena *arena, size_t count, size_t size); /* NULL on failure, overflow, limit */
void *sbfi_arena_copy(sbfi_arena *arena, const void *from, size_t count, size_t size);
char *sbfi_arena_string(sbfi_arena *arena, const char *text, size_t length); /* NUL-terminated copy */

/* A growing array outside any arena. sbfi_array_push returns a pointer to the new item, or NULL. */
typedef struct sbfi_array {
  sbf_allocator allocator;
  void *at;
  size_t count, capacity, item_size;
} sbfi_array;

void sbfi_array_init(sbfi_array *array, const sbf_allocator *allocator, size_t item_size);
void *sbfi_array_push(sbfi_array *array, size_t count); /* `count` new zeroed items */
bool sbfi_array_append(sbfi_array *array, const void *items, size_t count);
bool sbfi_array_reserve(sbfi_array *array, size_t capacity);
void sbfi_array_free(sbfi_array *array);

#endif
