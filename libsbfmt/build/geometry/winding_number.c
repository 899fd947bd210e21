#include "build/geometry/winding_number.h"

#include "build/geometry/box_tree.h"
#include "mechanics/angle.h"

enum { MAX_WAITING = 128 };
static const double far_radii = 2;
/* A soup is mostly open from this number of caps for each triangle. Its queries visit at most about so many
 * triangles on average; the radii for that shrink in such steps down to a minimum. */
static const double OPEN_SOUP = 0.5, MAX_VISITS = 128, SHRINK = 0.8, MIN_RADII = 0.02;
/* Minimum extent of a volume as a fraction of its longest side. */
static const double MIN_EXTENT = 0.25;

static void corners_of(const sbfi_soup *soup, uint32_t triangle, sbfi_d3 corners[3]) {
  for (int k = 0; k < 3; k++) corners[k] = soup->points[soup->triangles[triangle][k]];
}

static sbfi_d3 twice_area(const sbfi_d3 c[3]) {
  return sbfi_d3_cross(sbfi_d3_sub(c[1], c[0]), sbfi_d3_sub(c[2], c[0]));
}

/* Half the solid angle (van Oosterom, Strackee 1983). */
static double half_angle(const sbfi_soup *soup, uint32_t triangle, sbfi_d3 point) {
  sbfi_d3 corners[3];
  double lengths[3];
  corners_of(soup, triangle, corners);
  for (int k = 0; k < 3; k++) {
    corners[k] = sbfi_d3_sub(corners[k], point);
    lengths[k] = sbfi_d3_length(corners[k]);
  }
  double volume = sbfi_d3_dot(corners[0], sbfi_d3_cross(corners[1], corners[2]));
  double rest = lengths[0] * lengths[1] * lengths[2] + sbfi_d3_dot(corners[0], corners[1]) * lengths[2] +
                sbfi_d3_dot(corners[1], corners[2]) * lengths[0] +
                sbfi_d3_dot(corners[2], corners[0]) * lengths[1];
  /* In the triangle's own plane the volume is 0. */
  return volume != 0 ? sbfi_angle(volume, rest) : 0;
}

/* Sums of a node from its children or triangles: the centre is not yet divided by the weight. Children
 * come after their parents, so a reverse pass visits them first. */
static void sum_node(const sbfi_soup *soup, const sbfi_winding_tree *w, const sbfi_box_node *from,
    uint32_t index, double *weights) {
  sbfi_d3 moment = {0, 0, 0};
  sbfi_winding_node *to = &w->nodes[index];
  *to = (sbfi_winding_node){.first = from->first, .count = from->count};
  weights[index] = 0;
  for (uint32_t i = 0; i < from->count; i++) {
    sbfi_d3 corners[3];
    corners_of(soup, w->triangles[from->first + i], corners);
    sbfi_d3 area = twice_area(corners), sum = sbfi_d3_add(corners[0], sbfi_d3_add(corners[1], corners[2]));
    double size = sbfi_d3_length(area);
    to->area = sbfi_d3_add(to->area, sbfi_d3_scale(area, 0.5));
    moment = sbfi_d3_add(moment, sbfi_d3_scale(sum, size / 3));
    weights[index] += size;
  }
  for (uint32_t child = from->first; from->count == 0 && child < from->first + 2; child++) {
    to->area = sbfi_d3_add(to->area, w->nodes[child].area);
    moment = sbfi_d3_add(moment, sbfi_d3_scale(w->nodes[child].middle, weights[child]));
    weights[index] += weights[child];
  }
  sbfi_d3 low = {from->box.low[0], from->box.low[1], from->box.low[2]};
  sbfi_d3 high = {from->box.high[0], from->box.high[1], from->box.high[2]};
  to->middle = weights[index] > 0 ? sbfi_d3_scale(moment, 1 / weights[index])
                                  : sbfi_d3_scale(sbfi_d3_add(low, high), 0.5);
  /* The farthest corner of the box. */
  sbfi_d3 reach = {fmax(high.x - to->middle.x, to->middle.x - low.x),
      fmax(high.y - to->middle.y, to->middle.y - low.y), fmax(high.z - to->middle.z, to->middle.z - low.z)};
  to->far2 = sbfi_d3_dot(reach, reach); /* times the squared radii later */
}

/* Volume of a box in which points are queried. */
static double volume_of(const sbfi_box *box) {
  double sides[3], longest = 0, volume = 1;
  for (int k = 0; k < 3; k++) {
    sides[k] = (double)box->high[k] - (double)box->low[k];
    longest = fmax(longest, sides[k]);
  }
  for (int k = 0; k < 3; k++) volume *= fmax(sides[k], MIN_EXTENT * longest);
  return volume;
}

/* Estimates how many triangles a query in the volume visits: those of leaves within their far distance. */
static double visits_of(const sbfi_winding_tree *tree, double radii, double volume) {
  double sum = 0;
  for (uint32_t n = 0; n < tree->node_count; n++) {
    double reach = radii * sqrt(tree->nodes[n].far2), ball = 4 * SBFI_PI / 3 * reach * reach * reach;
    if (tree->nodes[n].count) sum += tree->nodes[n].count * (ball < volume ? ball / volume : 1);
  }
  return sum;
}

/* Long triangles of an open soup are close to every point and enclose nothing: an exact sum would cost time
 * quadratic in the triangles for a number without a meaning. */
static double radii_of(const sbfi_winding_tree *tree, const sbfi_soup *soup, double volume) {
  double radii = far_radii;
  if (!(soup->cap_count > OPEN_SOUP * soup->triangle_count)) return radii;
  while (radii > MIN_RADII && visits_of(tree, radii, volume) > MAX_VISITS) radii *= SHRINK;
  return radii;
}

static void box_of(const sbfi_soup *soup, uint32_t triangle, sbfi_box *box) {
  for (int k = 0; k < 3; k++) {
    sbfi_d3 p = soup->points[soup->triangles[triangle][k]];
    /* Positions come from single precision, so the conversion is exact. */
    const float at[3] = {(float)p.x, (float)p.y, (float)p.z};
    for (int axis = 0; axis < 3; axis++) {
      if (k == 0 || at[axis] < box->low[axis]) box->low[axis] = at[axis];
      if (k == 0 || at[axis] > box->high[axis]) box->high[axis] = at[axis];
    }
  }
}

static bool fill_tree(sbfi_winding_tree *made, const sbfi_soup *soup, uint32_t first, uint32_t count,
    sbfi_arena *arena, sbfi_arena *scratch) {
  sbfi_box_tree tree;
  sbfi_box *boxes = sbfi_arena_allocate(scratch, count, sizeof *boxes);
  if (!boxes) return false;
  for (uint32_t t = 0; t < count; t++) box_of(soup, first + t, &boxes[t]);
  if (!sbfi_box_tree_build(&tree, boxes, count, scratch)) return false;
  for (uint32_t t = 0; t < count; t++) tree.items[t] += first;
  double *weights = sbfi_arena_allocate(scratch, tree.node_count, sizeof *weights);
  *made = (sbfi_winding_tree){sbfi_arena_allocate(arena, tree.node_count, sizeof *made->nodes),
      sbfi_arena_copy(arena, tree.items, count, sizeof *tree.items), tree.node_count, false};
  if (!weights || !made->nodes || !made->triangles) return false;
  for (uint32_t n = tree.node_count; n-- > 0;) sum_node(soup, made, &tree.nodes[n], n, weights);
  double radii = radii_of(made, soup, volume_of(&tree.nodes[0].box));
  for (uint32_t n = 0; n < tree.node_count; n++) made->nodes[n].far2 *= radii * radii;
  made->is_rough = radii < far_radii;
  return true;
}

/* Builds the tree over the soup's triangles from `first` on. */
static bool make_tree(
    sbfi_winding_tree *made, const sbfi_soup *soup, uint32_t first, uint32_t end, sbfi_arena *arena) {
  sbfi_arena scratch;
  if (first == end) return true;
  sbfi_arena_init(&scratch, &arena->allocator, 0);
  bool good = fill_tree(made, soup, first, end - first, arena, &scratch);
  sbfi_arena_free(&scratch);
  return good;
}

bool sbfi_winding_make(sbfi_winding *winding, const sbfi_soup *soup, sbfi_arena *arena) {
  uint32_t surface = soup->triangle_count, all = surface + soup->cap_count;
  *winding = (sbfi_winding){.soup = soup};
  return make_tree(&winding->closed, soup, 0, all, arena) &&
         make_tree(&winding->caps, soup, surface, all, arena);
}

static bool is_within(const sbfi_soup *soup, sbfi_d3 p) {
  return p.x >= soup->low.x && p.y >= soup->low.y && p.z >= soup->low.z && p.x <= soup->high.x &&
         p.y <= soup->high.y && p.z <= soup->high.z;
}

static double number_of(const sbfi_soup *soup, const sbfi_winding_tree *tree, sbfi_d3 point) {
  if (tree->is_rough && !is_within(soup, point)) return 0;
  uint32_t waiting[MAX_WAITING], waiting_count = 0;
  double halves = 0, dipoles = 0;
  if (tree->node_count > 0) waiting[waiting_count++] = 0;
  while (waiting_count > 0) {
    const sbfi_winding_node *node = &tree->nodes[waiting[--waiting_count]];
    sbfi_d3 displacement = sbfi_d3_sub(node->middle, point);
    double squared = sbfi_d3_dot(displacement, displacement);
    if (squared > node->far2) {
      dipoles += sbfi_d3_dot(node->area, displacement) / (squared * sqrt(squared));
    } else if (node->count > 0) {
      for (uint32_t i = 0; i < node->count; i++)
        halves += half_angle(soup, tree->triangles[node->first + i], point);
    } else {
      waiting[waiting_count++] = node->first + 1;
      waiting[waiting_count++] = node->first;
    }
  }
  return (2 * halves + dipoles) / (4 * SBFI_PI);
}

int sbfi_winding_of_closed(const sbfi_winding *winding, sbfi_d3 point) {
  return (int)floor(number_of(winding->soup, &winding->closed, point) + 0.5);
}

double sbfi_winding_of_caps(const sbfi_winding *winding, sbfi_d3 point) {
  return number_of(winding->soup, &winding->caps, point);
}

bool sbfi_winding_inside(int closed, double caps) {
  /* On a single sheet it is a half, which must not count as inside after rounding. */
  return fabs(closed - caps) > 0.5001;
}
