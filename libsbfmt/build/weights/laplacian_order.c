#include "build/weights/laplacian_order.h"

/* Appends the connected part of `first` breadth first; `order` is UINT32_MAX for unassigned sites. Returns
 * the new end of `order`. */
static uint32_t append_part(
    const sbfi_surface_laplacian *l, uint32_t first, uint32_t *order, uint32_t end, uint32_t *slots) {
  uint32_t next = end;
  slots[first] = end;
  order[end++] = first;
  for (; next < end; next++)
    for (uint32_t at = l->begins[order[next]]; at < l->begins[order[next] + 1]; at++) {
      uint32_t site = l->columns[at];
      if (slots[site] != UINT32_MAX) continue;
      slots[site] = end;
      order[end++] = site;
    }
  return end;
}

/* Starts at the site that a first pass reaches last, which is at an end of the part. */
static void find_order(const sbfi_surface_laplacian *l, uint32_t count, uint32_t *order, uint32_t *slots) {
  for (uint32_t i = 0; i < count; i++) slots[i] = UINT32_MAX;
  for (uint32_t i = 0, end = 0; i < count; i++) {
    if (slots[i] != UINT32_MAX) continue;
    uint32_t behind = append_part(l, i, order, end, slots), corner = order[behind - 1];
    for (uint32_t k = end; k < behind; k++) slots[order[k]] = UINT32_MAX;
    end = append_part(l, corner, order, end, slots);
  }
}

/* Sorts the entries of one row by column: there are few. */
static void sort_row(uint32_t *columns, double *values, uint32_t count) {
  for (uint32_t i = 1; i < count; i++)
    for (uint32_t k = i; k > 0 && columns[k] < columns[k - 1]; k--) {
      uint32_t column = columns[k];
      double value = values[k];
      columns[k] = columns[k - 1], values[k] = values[k - 1];
      columns[k - 1] = column, values[k - 1] = value;
    }
}

bool sbfi_laplacian_reorder(
    sbfi_surface_laplacian *l, uint32_t count, uint32_t *site_of_row, sbfi_arena *arena) {
  uint32_t entries = l->begins[count], *slots = sbfi_arena_allocate(arena, count, sizeof *slots);
  sbfi_surface_laplacian to = {sbfi_arena_allocate(arena, (size_t)count + 1, sizeof *to.begins),
      sbfi_arena_allocate(arena, (size_t)entries + 1, sizeof *to.columns),
      sbfi_arena_allocate(arena, (size_t)entries + 1, sizeof *to.values),
      sbfi_arena_allocate(arena, count, sizeof *to.diagonal)};
  if (!slots || !to.begins || !to.columns || !to.values || !to.diagonal) return false;
  find_order(l, count, site_of_row, slots);
  for (uint32_t row = 0; row < count; row++) {
    uint32_t site = site_of_row[row], first = to.begins[row], size = l->begins[site + 1] - l->begins[site];
    for (uint32_t k = 0; k < size; k++) {
      to.columns[first + k] = slots[l->columns[l->begins[site] + k]];
      to.values[first + k] = l->values[l->begins[site] + k];
    }
    sort_row(to.columns + first, to.values + first, size);
    to.diagonal[row] = l->diagonal[site];
    to.begins[row + 1] = first + size;
  }
  *l = to;
  return true;
}
