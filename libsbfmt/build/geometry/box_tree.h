/* Bounding box tree over numbered items, for nearest-item searches. The items are sorted along a
 * space-filling curve (Morton's), ties by number, and recursively halved: equal boxes give equal trees and
 * results. */
#ifndef SBFI_BOX_TREE_H
#define SBFI_BOX_TREE_H

#include "base/memory.h"

typedef struct sbfi_box {
  float low[3], high[3];
} sbfi_box;

typedef struct sbfi_box_node {
  sbfi_box box;
  uint32_t first; /* leaf: index into `items`; otherwise the left child; the right one follows it */
  uint32_t count; /* number of items; 0: not a leaf */
} sbfi_box_node;

typedef struct sbfi_box_tree {
  sbfi_box_node *nodes; /* root first; none without items */
  uint32_t *items;      /* (item_count) numbers, by leaf */
  uint32_t node_count, item_count;
} sbfi_box_tree;

/* Uses `boxes` only during the call. False if memory runs out. */
bool sbfi_box_tree_build(sbfi_box_tree *tree, const sbfi_box *boxes, uint32_t count, sbfi_arena *arena);

/* Squared distance between a point and a box. */
double sbfi_box_distance(const sbfi_box *box, const double point[3]);

/* Item with the smallest `distance` from the point, the lowest number if equal; UINT32_MAX if none is below
 * `*min`, which receives that distance. `distance` returns the square of an item's distance, at least the
 * squared distance of its box. */
uint32_t sbfi_box_tree_nearest(const sbfi_box_tree *tree, const double point[3],
    double (*distance)(const void *user, uint32_t item, const double point[3]), const void *user,
    double *min);

/* As above, without the nodes for which `may_hold` returns false: none of their items has a distance. */
uint32_t sbfi_box_tree_nearest_among(const sbfi_box_tree *tree, const double point[3],
    double (*distance)(const void *user, uint32_t item, const double point[3]),
    bool (*may_hold)(const void *user, uint32_t node), const void *user, double *min);

/* First item that the ray from `origin` along `direction` hits, the lowest number if equal: `intersect`
 * returns the factor of `direction` at an item, or a negative number. UINT32_MAX: none up to the factor
 * `max`. */
uint32_t sbfi_box_tree_pierced(const sbfi_box_tree *tree, const double origin[3], const double direction[3],
    double max,
    double (*intersect)(const void *user, uint32_t item, const double origin[3], const double direction[3]),
    const void *user);

/* Visits the items of all leaves that overlap the box, until `visit` returns false. */
void sbfi_box_tree_visit(
    const sbfi_box_tree *tree, const sbfi_box *box, bool (*visit)(void *user, uint32_t item), void *user);

#endif
