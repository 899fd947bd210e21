#include "validate/rules/crossing.h"

#include "mechanics/vector.h"

enum { MAX_PAIRS = 1024 };

typedef struct triangle {
  sbfi_d3 corners[3], normal; /* unit; zero for a degenerate triangle */
} triangle;

typedef struct finder {
  const sbfi_triangle_tree *tree;
  sbfi_box *boxes;     /* of the triangles */
  triangle *triangles; /* in double precision */
  uint32_t *partners;
  double slack;    /* m, tolerance for points in a plane */
  uint64_t budget; /* remaining number of box pairs to compare */
} finder;

static bool overlap(const sbfi_box *a, const sbfi_box *b) {
  for (int k = 0; k < 3; k++)
    if (a->low[k] > b->high[k] || b->low[k] > a->high[k]) return false;
  return true;
}

/* Whether a point of the triangle's plane is strictly inside it. */
static bool contains(const triangle *t, sbfi_d3 position) {
  for (int k = 0; k < 3; k++) {
    sbfi_d3 side = sbfi_d3_sub(t->corners[(k + 1) % 3], t->corners[k]);
    sbfi_d3 inwards = sbfi_d3_cross(t->normal, side);
    double depth = sbfi_d3_dot(inwards, sbfi_d3_sub(position, t->corners[k]));
    if (!(depth > 1e-6 * sbfi_d3_dot(side, side))) return false;
  }
  return true;
}

/* Whether an edge of `a` passes through `b`. */
static bool pierces(const triangle *a, const triangle *b, double slack) {
  double heights[3];
  for (int k = 0; k < 3; k++) heights[k] = sbfi_d3_dot(b->normal, sbfi_d3_sub(a->corners[k], b->corners[0]));
  for (int k = 0; k < 3; k++) {
    double from = heights[k], to = heights[(k + 1) % 3];
    if (!((from > slack && to < -slack) || (from < -slack && to > slack))) continue;
    sbfi_d3 displacement = sbfi_d3_sub(a->corners[(k + 1) % 3], a->corners[k]);
    if (contains(b, sbfi_d3_add(a->corners[k], sbfi_d3_scale(displacement, from / (from - to))))) return true;
  }
  return false;
}

static void record(finder *f, uint32_t a, uint32_t b) {
  uint32_t low = a < b ? a : b, high = a < b ? b : a;
  if (high < f->partners[low]) f->partners[low] = high;
}

static void compare_triangles(finder *f, uint32_t a, uint32_t b) {
  uint32_t p = f->tree->triangles[a].polygon, q = f->tree->triangles[b].polygon;
  uint32_t low = p < q ? p : q, high = p < q ? q : p;
  if (low == high || f->partners[low] <= high || !overlap(&f->boxes[a], &f->boxes[b])) return;
  const triangle *one = &f->triangles[a], *other = &f->triangles[b];
  if (pierces(one, other, f->slack) || pierces(other, one, f->slack)) record(f, p, q);
}

static void compare_leaves(finder *f, const sbfi_box_node *a, const sbfi_box_node *b) {
  const uint32_t *items = f->tree->tree.items;
  for (uint32_t i = 0; i < a->count; i++)
    for (uint32_t k = a == b ? i + 1 : 0; k < b->count; k++)
      compare_triangles(f, items[a->first + i], items[b->first + k]);
}

/* Visits all pairs of overlapping leaves once. Opens the larger node of a pair first, which keeps the
 * stack small. */
static void walk(finder *f) {
  sbf_uint2 waiting[MAX_PAIRS];
  const sbfi_box_node *nodes = f->tree->tree.nodes;
  uint32_t count = 0;
  waiting[count++] = (sbf_uint2){{0, 0}};
  while (count > 0 && f->budget > 0 && count + 4 < MAX_PAIRS) {
    sbf_uint2 pair = waiting[--count];
    const sbfi_box_node *a = &nodes[pair.at[0]], *b = &nodes[pair.at[1]];
    f->budget--;
    if (a != b && !overlap(&a->box, &b->box)) continue;
    if (a->count && b->count) {
      compare_leaves(f, a, b);
    } else if (a == b) {
      waiting[count++] = (sbf_uint2){{a->first, a->first}};
      waiting[count++] = (sbf_uint2){{a->first + 1, a->first + 1}};
      waiting[count++] = (sbf_uint2){{a->first, a->first + 1}};
    } else {
      /* children come after their parents, so the node with the lower number is usually larger */
      bool open_a = !a->count && (b->count || pair.at[0] < pair.at[1]);
      for (uint32_t child = 0; child < 2; child++)
        waiting[count++] = open_a ? (sbf_uint2){{a->first + child, pair.at[1]}}
                                  : (sbf_uint2){{pair.at[0], b->first + child}};
    }
  }
}

static void prepare(finder *f) {
  const sbfi_triangle_tree *tree = f->tree;
  double size = 0;
  for (uint32_t i = 0; i < tree->triangle_count; i++) {
    triangle *t = &f->triangles[i];
    for (int k = 0; k < 3; k++) {
      sbf_vec3 at = tree->positions[tree->triangles[i].points[k]];
      const float position[3] = {at.x, at.y, at.z};
      t->corners[k] = sbfi_d3_of(at);
      for (int axis = 0; axis < 3; axis++) {
        float *low = &f->boxes[i].low[axis], *high = &f->boxes[i].high[axis];
        if (k == 0 || position[axis] < *low) *low = position[axis];
        if (k == 0 || position[axis] > *high) *high = position[axis];
        size = fmax(size, fabs((double)position[axis]));
      }
    }
    t->normal = sbfi_d3_normal(
        sbfi_d3_cross(sbfi_d3_sub(t->corners[1], t->corners[0]), sbfi_d3_sub(t->corners[2], t->corners[0])));
  }
  f->slack = 4e-7 * size; /* a few units of float32 precision at the farthest point */
}

bool sbfi_crossings_find(const sbf_polygon_mesh *mesh, uint32_t *partners, sbfi_arena *scratch) {
  sbfi_triangle_tree tree;
  for (uint32_t p = 0; p < mesh->polygon_sizes.count; p++) partners[p] = SBFI_NO_CROSSING;
  if (!sbfi_triangle_tree_build(&tree, mesh, scratch)) return false;
  if (tree.triangle_count < 2) return true;
  finder f = {.tree = &tree,
      .boxes = sbfi_arena_allocate(scratch, tree.triangle_count, sizeof *f.boxes),
      .triangles = sbfi_arena_allocate(scratch, tree.triangle_count, sizeof *f.triangles),
      .partners = partners,
      .budget = 1000000 + 1000 * (uint64_t)tree.triangle_count};
  if (!f.boxes || !f.triangles) return false;
  prepare(&f);
  walk(&f);
  return true;
}

/* The ray has a generic direction, so it almost never hits an edge of a triangle. */
static const sbfi_d3 ray = {0.5377, 0.3163, 0.7816};

/* Whether the ray from `position` hits the box. */
static bool ray_hits_box(const sbfi_box *box, sbfi_d3 position) {
  const double from[3] = {position.x, position.y, position.z}, direction[3] = {ray.x, ray.y, ray.z};
  double near = 0, far = INFINITY;
  for (int k = 0; k < 3; k++) {
    near = fmax(near, (box->low[k] - from[k]) / direction[k]);
    far = fmin(far, (box->high[k] - from[k]) / direction[k]);
  }
  return near <= far;
}

static bool ray_hits_triangle(const sbfi_triangle_tree *tree, uint32_t number, sbfi_d3 position) {
  sbfi_d3 corners[3];
  for (int k = 0; k < 3; k++)
    corners[k] = sbfi_d3_sub(sbfi_d3_of(tree->positions[tree->triangles[number].points[k]]), position);
  double volumes[3], sum = 0;
  for (int k = 0; k < 3; k++) {
    volumes[k] = sbfi_d3_dot(ray, sbfi_d3_cross(corners[k], corners[(k + 1) % 3]));
    sum += volumes[k];
  }
  bool inside = (volumes[0] > 0 && volumes[1] > 0 && volumes[2] > 0) ||
                (volumes[0] < 0 && volumes[1] < 0 && volumes[2] < 0);
  if (!inside) return false;
  sbfi_d3 normal = sbfi_d3_cross(sbfi_d3_sub(corners[1], corners[0]), sbfi_d3_sub(corners[2], corners[0]));
  return sbfi_d3_dot(normal, corners[0]) * sum > 0;
}

bool sbfi_surface_encloses(const sbfi_triangle_tree *tree, sbf_vec3 position) {
  uint32_t waiting[128], count = 0, hits = 0;
  sbfi_d3 from = sbfi_d3_of(position);
  if (tree->tree.node_count > 0) waiting[count++] = 0;
  while (count > 0) {
    const sbfi_box_node *node = &tree->tree.nodes[waiting[--count]];
    if (!ray_hits_box(&node->box, from)) continue;
    for (uint32_t i = 0; i < node->count; i++)
      hits += ray_hits_triangle(tree, tree->tree.items[node->first + i], from);
    if (node->count > 0) continue;
    waiting[count++] = node->first;
    waiting[count++] = node->first + 1;
  }
  return hits % 2 == 1;
}
