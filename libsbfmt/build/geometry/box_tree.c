#include "build/geometry/box_tree.h"

#include <math.h>
#include <string.h>

enum { LEAF_ITEMS = 4, CURVE_BITS = 10, MAX_DEPTH = 64 };

static void grow(sbfi_box *box, const sbfi_box *by) {
  for (int k = 0; k < 3; k++) {
    if (by->low[k] < box->low[k]) box->low[k] = by->low[k];
    if (by->high[k] > box->high[k]) box->high[k] = by->high[k];
  }
}

/* Spreads ten bits with two zero bits after each. */
static uint32_t spread(uint32_t x) {
  x = (x | x << 16) & 0x030000ffu;
  x = (x | x << 8) & 0x0300f00fu;
  x = (x | x << 4) & 0x030c30c3u;
  return (x | x << 2) & 0x09249249u;
}

static uint32_t curve_index(const sbfi_box *box, const sbfi_box *all) {
  uint32_t code = 0;
  for (int k = 0; k < 3; k++) {
    double size = (double)all->high[k] - all->low[k];
    double middle = ((double)box->low[k] + box->high[k]) / 2 - all->low[k];
    double cell = size > 0 ? middle / size * (1 << CURVE_BITS) : 0;
    uint32_t max = (1u << CURVE_BITS) - 1;
    code |= spread(cell < max ? (uint32_t)cell : max) << k;
  }
  return code;
}

/* Sorts the items along the curve, ties by number: a radix sort is stable. */
static bool sort_items(sbfi_box_tree *tree, const sbfi_box *boxes, const sbfi_box *all, sbfi_arena *arena) {
  uint32_t count = tree->item_count;
  uint32_t *codes = sbfi_arena_allocate(arena, count, sizeof *codes);
  uint32_t *other = sbfi_arena_allocate(arena, count, sizeof *other);
  if (!codes || !other) return false;
  for (uint32_t i = 0; i < count; i++) {
    codes[i] = curve_index(&boxes[i], all);
    tree->items[i] = i;
  }
  for (int shift = 0; shift < 3 * CURVE_BITS; shift += 8) {
    uint32_t begins[257] = {0};
    for (uint32_t i = 0; i < count; i++) begins[(codes[i] >> shift & 255) + 1]++;
    for (int i = 0; i < 256; i++) begins[i + 1] += begins[i];
    for (uint32_t i = 0; i < count; i++)
      other[begins[codes[tree->items[i]] >> shift & 255]++] = tree->items[i];
    memcpy(tree->items, other, count * sizeof *other);
  }
  return true;
}

static void fill_node(
    sbfi_box_tree *tree, const sbfi_box *boxes, uint32_t node, uint32_t begin, uint32_t count) {
  sbfi_box_node *at = &tree->nodes[node];
  if (count <= LEAF_ITEMS) {
    *at = (sbfi_box_node){boxes[tree->items[begin]], begin, count};
    for (uint32_t i = 1; i < count; i++) grow(&at->box, &boxes[tree->items[begin + i]]);
    return;
  }
  uint32_t left = tree->node_count, half = count / 2;
  tree->node_count += 2;
  fill_node(tree, boxes, left, begin, half);
  fill_node(tree, boxes, left + 1, begin + half, count - half);
  *at = (sbfi_box_node){tree->nodes[left].box, left, 0};
  grow(&at->box, &tree->nodes[left + 1].box);
}

bool sbfi_box_tree_build(sbfi_box_tree *tree, const sbfi_box *boxes, uint32_t count, sbfi_arena *arena) {
  *tree = (sbfi_box_tree){.item_count = count};
  if (count == 0) return true;
  tree->nodes = sbfi_arena_allocate(arena, 2 * (size_t)count, sizeof *tree->nodes);
  tree->items = sbfi_arena_allocate(arena, count, sizeof *tree->items);
  if (!tree->nodes || !tree->items) return false;
  sbfi_box all = boxes[0];
  for (uint32_t i = 1; i < count; i++) grow(&all, &boxes[i]);
  if (!sort_items(tree, boxes, &all, arena)) return false;
  tree->node_count = 1;
  fill_node(tree, boxes, 0, 0, count);
  return true;
}

double sbfi_box_distance(const sbfi_box *box, const double point[3]) {
  double sum = 0;
  for (int k = 0; k < 3; k++) {
    double below = box->low[k] - point[k], above = point[k] - box->high[k];
    double outside = below > 0 ? below : above > 0 ? above : 0;
    sum += outside * outside;
  }
  return sum;
}

uint32_t sbfi_box_tree_nearest_among(const sbfi_box_tree *tree, const double point[3],
    double (*distance)(const void *user, uint32_t item, const double point[3]),
    bool (*may_hold)(const void *user, uint32_t node), const void *user, double *min) {
  uint32_t waiting[MAX_DEPTH], waiting_count = 0, nearest = UINT32_MAX;
  double distances[MAX_DEPTH];
  if (tree->node_count > 0) {
    distances[0] = sbfi_box_distance(&tree->nodes[0].box, point);
    waiting[waiting_count++] = 0;
  }
  while (waiting_count > 0) {
    const sbfi_box_node *node = &tree->nodes[waiting[--waiting_count]];
    if (distances[waiting_count] > *min) continue;
    for (uint32_t i = 0; i < node->count; i++) {
      uint32_t item = tree->items[node->first + i];
      double d = distance(user, item, point);
      if (d > *min || (d == *min && item > nearest)) continue;
      if (d == *min && nearest == UINT32_MAX) continue; /* not below the caller's bound */
      *min = d;
      nearest = item;
    }
    if (node->count > 0) continue;
    /* The nearer child is visited first, so it is pushed last. */
    const double both[2] = {sbfi_box_distance(&tree->nodes[node->first].box, point),
        sbfi_box_distance(&tree->nodes[node->first + 1].box, point)};
    uint32_t nearer = both[1] < both[0];
    for (uint32_t k = 0; k < 2; k++) {
      uint32_t child = k ? nearer : !nearer;
      if (both[child] > *min || (may_hold && !may_hold(user, node->first + child))) continue;
      distances[waiting_count] = both[child];
      waiting[waiting_count++] = node->first + child;
    }
  }
  return nearest;
}

uint32_t sbfi_box_tree_nearest(const sbfi_box_tree *tree, const double point[3],
    double (*distance)(const void *user, uint32_t item, const double point[3]), const void *user,
    double *min) {
  return sbfi_box_tree_nearest_among(tree, point, distance, NULL, user, min);
}

/* Factor of `direction` at which the ray enters the box; negative without a hit. */
static double enter(const sbfi_box *box, const double origin[3], const double direction[3]) {
  double near = 0, far = INFINITY;
  for (int k = 0; k < 3; k++) {
    if (direction[k] == 0) {
      if (origin[k] < box->low[k] || origin[k] > box->high[k]) return -1;
      continue;
    }
    double a = (box->low[k] - origin[k]) / direction[k], b = (box->high[k] - origin[k]) / direction[k];
    if (a > b) {
      double swap = a;
      a = b;
      b = swap;
    }
    if (a > near) near = a;
    if (b < far) far = b;
  }
  return near <= far ? near : -1;
}

uint32_t sbfi_box_tree_pierced(const sbfi_box_tree *tree, const double origin[3], const double direction[3],
    double max,
    double (*intersect)(const void *user, uint32_t item, const double origin[3], const double direction[3]),
    const void *user) {
  uint32_t waiting[MAX_DEPTH], waiting_count = 0, first = UINT32_MAX;
  double entries[MAX_DEPTH], min = max;
  if (tree->node_count > 0) {
    entries[0] = enter(&tree->nodes[0].box, origin, direction);
    waiting_count = entries[0] >= 0;
    waiting[0] = 0;
  }
  while (waiting_count > 0) {
    const sbfi_box_node *node = &tree->nodes[waiting[--waiting_count]];
    if (entries[waiting_count] > min) continue;
    for (uint32_t i = 0; i < node->count; i++) {
      uint32_t item = tree->items[node->first + i];
      double t = intersect(user, item, origin, direction);
      if (t < 0 || t > min || (t == min && item > first)) continue;
      min = t;
      first = item;
    }
    if (node->count > 0) continue;
    /* The child that the ray enters first is visited first, so it is pushed last. */
    double left = enter(&tree->nodes[node->first].box, origin, direction);
    double right = enter(&tree->nodes[node->first + 1].box, origin, direction);
    bool right_first = right < left;
    for (int k = 0; k < 2; k++) {
      bool is_right = (k == 1) == right_first;
      double entry = is_right ? right : left;
      if (entry < 0 || entry > min) continue;
      waiting[waiting_count] = node->first + is_right;
      entries[waiting_count++] = entry;
    }
  }
  return first;
}

static bool overlaps(const sbfi_box *a, const sbfi_box *b) {
  for (int k = 0; k < 3; k++)
    if (a->low[k] > b->high[k] || b->low[k] > a->high[k]) return false;
  return true;
}

void sbfi_box_tree_visit(
    const sbfi_box_tree *tree, const sbfi_box *box, bool (*visit)(void *user, uint32_t item), void *user) {
  uint32_t waiting[MAX_DEPTH], waiting_count = 0;
  if (tree->node_count > 0) waiting[waiting_count++] = 0;
  while (waiting_count > 0) {
    const sbfi_box_node *node = &tree->nodes[waiting[--waiting_count]];
    if (!overlaps(&node->box, box)) continue;
    for (uint32_t i = 0; i < node->count; i++)
      if (!visit(user, tree->items[node->first + i])) return;
    if (node->count > 0) continue;
    waiting[waiting_count++] = node->first + 1;
    waiting[waiting_count++] = node->first;
  }
}
