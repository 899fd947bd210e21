/* A tree of boxes over numbered items, for nearest-item searches. The items are put in the order of a curve
 * that fills space (Morton's), ties by number, and halved again and again: the same boxes give the same tree
 * and the same answers. */
#ifndef SBFI_BOX_TREE_H
#define SBFI_BOX_TREE_H

#include "base/memory.h"

typedef struct sbfi_box {
  float low[3], high[3];
} sbfi_box;

typedef struct sbfi_box_node {
  sbfi_box box;
  uint32_t first; /* leaf: place in `items`; else the left child, the right one follows it */
  uint32_t count; /* of items; 0: no leaf */
} sbfi_box_node;

typedef struct sbfi_box_tree {
  sbfi_box_node *nodes; /* the root first; none without items */
  uint32_t *items;      /* (item_count) numbers, leaf by leaf */
  uint32_t node_count, item_count;
} sbfi_box_tree;

/* `boxes` is needed only during the call. False where memory runs out. */
bool sbfi_box_tree_build(sbfi_box_tree *tree, const sbfi_box *boxes, uint32_t count, sbfi_arena *arena);

/* Squared distance between a point and a box. */
double sbfi_box_distance(const sbfi_box *box, const double point[3]);

/* The item of least `distance` from the point, the lowest number of several; UINT32_MAX where none is below
 * `*least`, which becomes that distance. `distance` gives the square of an item's distance, which is no less
 * than that of its box. */
uint32_t sbfi_box_tree_nearest(const sbfi_box_tree *tree, const double point[3],
    double (*distance)(const void *user, uint32_t item, const double point[3]), const void *user,
    double *min);

/* The item that the ray from `origin` along `direction` meets first, the lowest number of several:
 * `intersect` gives the factor of `direction` at which it meets an item, or a negative number. UINT32_MAX:
 * none up to the factor `most`.
 */
uint32_t sbfi_box_tree_pierced(const sbfi_box_tree *tree, const double origin[3], const double direction[3],
    double max,
    double (*intersect)(const void *user, uint32_t item, const double origin[3], const double direction[3]),
    const void *user);

/* Hands over the items of all leaves that touch the box, until `visit` is false. */
void sbfi_box_tree_visit(
    const sbfi_box_tree *tree, const sbfi_box *box, bool (*visit)(void *user, uint32_t item), void *user);

#endif
