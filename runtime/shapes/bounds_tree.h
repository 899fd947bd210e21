/* Bounding volume tree: finds boxes that overlap a box. Built in O(n log n) in the caller's memory, and
 * refitted when boxes have moved. For triangles of meshes, faces of soft surfaces, and all objects of a
 * world. */
#ifndef SBRI_BOUNDS_TREE_H
#define SBRI_BOUNDS_TREE_H

#include "math/vec3.h"

typedef struct sbri_box {
  sbf_vec3 low, high;
} sbri_box;

static inline sbri_box sbri_box_of_point(sbf_vec3 x) {
  return (sbri_box){x, x};
}
/* Comparisons compile to one instruction; fminf is a call. */
static inline float sbri_min(float a, float b) {
  return b < a ? b : a;
}
static inline float sbri_max(float a, float b) {
  return b > a ? b : a;
}
static inline sbri_box sbri_box_join(sbri_box a, sbri_box b) {
  return (sbri_box){{sbri_min(a.low.x, b.low.x), sbri_min(a.low.y, b.low.y), sbri_min(a.low.z, b.low.z)},
      {sbri_max(a.high.x, b.high.x), sbri_max(a.high.y, b.high.y), sbri_max(a.high.z, b.high.z)}};
}
static inline sbri_box sbri_box_with(sbri_box a, sbf_vec3 x) {
  return sbri_box_join(a, sbri_box_of_point(x));
}
static inline sbri_box sbri_box_grown(sbri_box a, float margin) {
  return (sbri_box){{a.low.x - margin, a.low.y - margin, a.low.z - margin},
      {a.high.x + margin, a.high.y + margin, a.high.z + margin}};
}
static inline bool sbri_boxes_overlap(const sbri_box *a, const sbri_box *b) {
  return a->low.x <= b->high.x && b->low.x <= a->high.x && a->low.y <= b->high.y && b->low.y <= a->high.y &&
         a->low.z <= b->high.z && b->low.z <= a->high.z;
}

/* Bounding sphere of a moving object at the beginning, and the maximum displacement of any part of it. */
typedef struct sbri_moving_ball {
  sbf_vec3 middle;
  float radius, distance;
} sbri_moving_ball;

typedef struct sbri_bounds_node {
  sbri_box box;
  uint32_t first, count; /* count: items of a leaf, from first; 0: an inner node, whose second child is first;
                            the first child follows it */
} sbri_bounds_node;

typedef struct sbri_bounds_tree {
  sbri_bounds_node *nodes; /* (sbri_bounds_tree_nodes(item_count)) */
  uint32_t *items;         /* (item_count) */
  uint32_t node_count, item_count;
} sbri_bounds_tree;

/* Maximum number of nodes for a number of items. */
static inline size_t sbri_bounds_tree_nodes(uint32_t item_count) {
  return 2 * (size_t)item_count + 1;
}

/* Builds the tree over boxes[0] to boxes[count - 1] in the memory of `tree`. Deterministic. */
void sbri_bounds_tree_make(sbri_bounds_tree *tree, const sbri_box *boxes, uint32_t count);

/* Updates the nodes after boxes have moved or grown, in linear time. Queries stay exact, and fast if
 * neighbours stay neighbours, as the triangles of a surface do. */
void sbri_bounds_tree_refit(sbri_bounds_tree *tree, const sbri_box *boxes);

/* Iterates over the items whose leaves overlap a box: begin, then next until it returns false. */
enum { SBRI_BOUNDS_TREE_DEPTH = 64 };
typedef struct sbri_bounds_walk {
  const sbri_bounds_tree *tree;
  sbri_box box;
  uint32_t stack[SBRI_BOUNDS_TREE_DEPTH];
  uint32_t depth, at, end;
} sbri_bounds_walk;
static inline void sbri_bounds_walk_begin(
    sbri_bounds_walk *walk, const sbri_bounds_tree *tree, sbri_box box) {
  walk->tree = tree, walk->box = box, walk->depth = walk->at = walk->end = 0;
  if (tree->node_count) walk->stack[walk->depth++] = 0;
}
bool sbri_bounds_walk_next(sbri_bounds_walk *walk, uint32_t *item);

#endif
