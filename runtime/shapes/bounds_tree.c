#include "shapes/bounds_tree.h"

enum { LEAF = 4 };

static float middle(const sbri_box *box, int axis) {
  const float *low = &box->low.x, *high = &box->high.x;
  return low[axis] + high[axis];
}

static int longest_axis(const sbri_box *boxes, const uint32_t *items, uint32_t count) {
  float low[3] = {INFINITY, INFINITY, INFINITY}, high[3] = {-INFINITY, -INFINITY, -INFINITY};
  for (uint32_t i = 0; i < count; i++)
    for (int k = 0; k < 3; k++) {
      float m = middle(&boxes[items[i]], k);
      low[k] = m < low[k] ? m : low[k], high[k] = m > high[k] ? m : high[k];
    }
  int best = high[1] - low[1] > high[0] - low[0] ? 1 : 0;
  return high[2] - low[2] > high[best] - low[best] ? 2 : best;
}

/* Order by centre, then by index, so that the order is unique. */
static bool is_before(const sbri_box *boxes, int axis, uint32_t a, uint32_t b) {
  float x = middle(&boxes[a], axis), y = middle(&boxes[b], axis);
  return x < y || (x == y && a < b);
}

/* Moves the `nth` smallest item to its index, with smaller ones before it (Hoare's selection, pivots from the
 * middle). */
static void select_nth(const sbri_box *boxes, int axis, uint32_t *items, uint32_t count, uint32_t nth) {
  int64_t low = 0, high = (int64_t)count - 1;
  while (low < high) {
    uint32_t pivot = items[(low + high) / 2];
    int64_t i = low, j = high;
    while (i <= j) {
      while (is_before(boxes, axis, items[i], pivot)) i++;
      while (is_before(boxes, axis, pivot, items[j])) j--;
      if (i > j) break;
      uint32_t other = items[i];
      items[i++] = items[j], items[j--] = other;
    }
    if ((int64_t)nth <= j)
      high = j;
    else if ((int64_t)nth >= i)
      low = i;
    else
      return;
  }
}

static void make_node(sbri_bounds_tree *tree, const sbri_box *boxes, uint32_t first, uint32_t count) {
  sbri_bounds_node *node = &tree->nodes[tree->node_count++];
  uint32_t *items = tree->items + first;
  if (count <= LEAF) {
    node->box = boxes[items[0]];
    for (uint32_t i = 1; i < count; i++) node->box = sbri_box_join(node->box, boxes[items[i]]);
    node->first = first, node->count = count;
    return;
  }
  uint32_t half = count / 2;
  select_nth(boxes, longest_axis(boxes, items, count), items, count, half);
  const sbri_bounds_node *left = &tree->nodes[tree->node_count];
  make_node(tree, boxes, first, half); /* recursion depth: log2(count) */
  node->first = tree->node_count, node->count = 0;
  make_node(tree, boxes, first + half, count - half);
  node->box = sbri_box_join(left->box, tree->nodes[node->first].box);
}

void sbri_bounds_tree_make(sbri_bounds_tree *tree, const sbri_box *boxes, uint32_t count) {
  tree->node_count = 0, tree->item_count = count;
  for (uint32_t i = 0; i < count; i++) tree->items[i] = i;
  if (count) make_node(tree, boxes, 0, count);
}

void sbri_bounds_tree_refit(sbri_bounds_tree *tree, const sbri_box *boxes) {
  for (uint32_t n = tree->node_count; n-- > 0;) { /* children come after their parents */
    sbri_bounds_node *node = &tree->nodes[n];
    if (node->count == 0) {
      node->box = sbri_box_join(tree->nodes[n + 1].box, tree->nodes[node->first].box);
      continue;
    }
    const uint32_t *items = tree->items + node->first;
    node->box = boxes[items[0]];
    for (uint32_t i = 1; i < node->count; i++) node->box = sbri_box_join(node->box, boxes[items[i]]);
  }
}

bool sbri_bounds_walk_next(sbri_bounds_walk *walk, uint32_t *item) {
  const sbri_bounds_tree *tree = walk->tree;
  while (walk->at == walk->end) {
    if (!walk->depth) return false;
    uint32_t number = walk->stack[--walk->depth];
    const sbri_bounds_node *node = &tree->nodes[number];
    if (!sbri_boxes_overlap(&node->box, &walk->box)) continue;
    if (node->count) {
      walk->at = node->first, walk->end = node->first + node->count;
    } else {
      walk->stack[walk->depth++] = node->first;
      walk->stack[walk->depth++] = number + 1;
    }
  }
  *item = tree->items[walk->at++];
  return true;
}
