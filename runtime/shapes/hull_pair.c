/* Separating axis test: the normals of both hulls' faces, and the cross products of edges whose arcs
 * intersect on the Gauss map; only these are faces of the Minkowski difference (D. Gregorius, The Separating
 * Axis Test between Convex Polyhedra, 2013). Then the contact manifold by clipping along the best axis. */
#include "shapes/hull_pair.h"

/* An edge axis must be better than every face axis by this fraction of the reach and by this length (m):
 * face contacts have more points. */
static const float EDGE_FRACTION = 0.05f, EDGE_M = 1e-5f;

enum { MAX_CORNERS = 32 };

/* ---- Axes ---- */

typedef struct axis {
  float gap;
  sbf_vec3 normal; /* from b to a */
  bool of_a, of_edges;
  sbf_vec3 on_a, on_b; /* of edges */
} axis;

static sbf_vec3 to_local(const sbri_placed_hull *h, sbf_vec3 direction) {
  return sbri_rotate(sbri_quat_conjugate(h->rotation), direction);
}
static sbf_vec3 to_world(const sbri_placed_hull *h, sbf_vec3 x) {
  return sbri_add(h->at, sbri_rotate(h->rotation, sbri_scale(x, h->scale)));
}
static sbf_vec3 support_point(const sbri_placed_hull *h, sbf_vec3 direction) {
  return to_world(h, h->hull->vertices[sbri_hull_support(h->hull, to_local(h, direction))]);
}

/* Returns false if a face separates the hulls by more than `reach`. */
static bool try_faces(
    const sbri_placed_hull *of, const sbri_placed_hull *other, bool of_a, float reach, axis *best) {
  for (uint32_t f = 0; f < of->hull->face_count; f++) {
    const sbri_hull_face *face = &of->hull->faces[f];
    sbf_vec3 n = sbri_rotate(of->rotation, face->normal);
    sbf_vec3 nearest = support_point(other, sbri_scale(n, -1));
    float gap = sbri_dot(n, sbri_sub(nearest, of->at)) - of->scale * face->offset;
    if (gap > reach) return false;
    if (gap > best->gap) *best = (axis){.gap = gap, .normal = of_a ? sbri_scale(n, -1) : n, .of_a = of_a};
  }
  return true;
}

/* Whether the arc from a to b, with b x a, intersects the arc from -c to -d on the sphere. */
static bool arcs_cross(sbf_vec3 a, sbf_vec3 b, sbf_vec3 ba, sbf_vec3 c, sbf_vec3 d) {
  float cba = sbri_dot(c, ba), dba = sbri_dot(d, ba);
  if (!(cba * dba < 0)) return false; /* the common case */
  sbf_vec3 dc = sbri_cross(d, c);
  float adc = sbri_dot(a, dc), bdc = sbri_dot(b, dc);
  return adc * bdc < 0 && cba * bdc < 0;
}

/* Nearest points of two segments that are not parallel. */
static void nearest_of_lines(
    sbf_vec3 p, sbf_vec3 along_p, sbf_vec3 q, sbf_vec3 along_q, sbf_vec3 *on_p, sbf_vec3 *on_q) {
  sbf_vec3 off = sbri_sub(p, q);
  float a = sbri_dot(along_p, along_p), b = sbri_dot(along_p, along_q), c = sbri_dot(along_q, along_q);
  float d = sbri_dot(along_p, off), e = sbri_dot(along_q, off), det = a * c - b * b;
  float s = det > 0 ? (b * e - c * d) / det : 0, t = det > 0 ? (a * e - b * d) / det : 0;
  *on_p = sbri_add_scaled(p, along_p, sbri_clamp(s, 0, 1));
  *on_q = sbri_add_scaled(q, along_q, sbri_clamp(t, 0, 1));
}

static sbf_vec3 direction_of(const sbri_hull *hull, const sbri_hull_edge *e) {
  return sbri_sub(hull->vertices[e->ends[1]], hull->vertices[e->ends[0]]);
}

/* Directions of edges, not normalised. */
static bool are_parallel(sbf_vec3 p, sbf_vec3 q) {
  sbf_vec3 n = sbri_cross(p, q);
  return sbri_dot(n, n) < 1e-4f * sbri_dot(p, p) * sbri_dot(q, q);
}

/* The separating axis of two edges, from b to a. */
static axis axis_of_edges(const sbri_placed_hull *a, const sbri_hull_edge *e, const sbri_placed_hull *b,
    const sbri_hull_edge *g, sbf_vec3 middle) {
  sbf_vec3 p = to_world(a, a->hull->vertices[e->ends[0]]), q = to_world(b, b->hull->vertices[g->ends[0]]);
  sbf_vec3 along_p = sbri_sub(to_world(a, a->hull->vertices[e->ends[1]]), p);
  sbf_vec3 along_q = sbri_sub(to_world(b, b->hull->vertices[g->ends[1]]), q);
  sbf_vec3 n = sbri_cross(along_p, along_q);
  n = sbri_scale(n, 1 / sbri_length(n));
  if (sbri_dot(n, sbri_sub(p, middle)) > 0) n = sbri_scale(n, -1); /* points into a */
  axis found = {.gap = sbri_dot(n, sbri_sub(p, q)), .normal = n, .of_edges = true};
  nearest_of_lines(p, along_p, q, along_q, &found.on_a, &found.on_b);
  return found;
}

static bool try_edges(const sbri_placed_hull *a, const sbri_placed_hull *b, float reach, axis *best) {
  float min = best->gap + EDGE_FRACTION * (reach > 0 ? reach : 0) + EDGE_M;
  sbf_vec3 middle = to_world(a, a->hull->middle);
  sbf_quat rotation = sbri_quat_multiply(sbri_quat_conjugate(b->rotation), a->rotation);
  for (uint32_t i = 0; i < a->hull->edge_count; i++) {
    const sbri_hull_edge *e = &a->hull->edges[i]; /* in the frame of b: */
    sbf_vec3 c0 = sbri_rotate(rotation, e->normals[0]), c1 = sbri_rotate(rotation, e->normals[1]);
    sbf_vec3 normal = sbri_cross(c1, c0), direction = sbri_rotate(rotation, direction_of(a->hull, e));
    for (uint32_t k = 0; k < b->hull->edge_count; k++) {
      const sbri_hull_edge *g = &b->hull->edges[k];
      if (!arcs_cross(c0, c1, normal, g->normals[0], g->normals[1]) ||
          are_parallel(direction, direction_of(b->hull, g)))
        continue;
      axis found = axis_of_edges(a, e, b, g, middle);
      if (found.gap > reach) return false;
      if (found.gap <= min) continue;
      min = found.gap;
      *best = found;
    }
  }
  return true;
}

/* ---- Manifold points ---- */

void sbri_hull_pair_add(sbri_hull_pair *pair, sbf_vec3 on_a, sbf_vec3 on_b, float gap) {
  uint32_t at = pair->count;
  if (at < SBRI_PAIR_POINTS) {
    pair->count++;
  } else { /* replaces a point if the manifold becomes larger, but never the deepest one */
    float max = 0;
    at = UINT32_MAX;
    for (uint32_t replaced = 0; replaced < SBRI_PAIR_POINTS; replaced++) {
      float old_distance = INFINITY, new_distance = INFINITY;
      for (uint32_t k = 0; k < SBRI_PAIR_POINTS; k++) {
        if (k == replaced) continue;
        sbf_vec3 a = sbri_sub(pair->on_a[k], pair->on_a[replaced]), b = sbri_sub(pair->on_a[k], on_a);
        old_distance = fminf(old_distance, sbri_dot(a, a)),
        new_distance = fminf(new_distance, sbri_dot(b, b));
      }
      float gained = new_distance - old_distance;
      if ((replaced != 0 || gap < pair->gaps[0]) && gained > max) max = gained, at = replaced;
    }
    if (at == UINT32_MAX && gap < pair->gaps[0]) at = 0;
    if (at == UINT32_MAX) return;
  }
  pair->on_a[at] = on_a, pair->on_b[at] = on_b, pair->gaps[at] = gap;
  if (gap >= pair->gaps[0] || at == 0) return;
  sbf_vec3 a = pair->on_a[0], b = pair->on_b[0];
  float g = pair->gaps[0];
  pair->on_a[0] = on_a, pair->on_b[0] = on_b, pair->gaps[0] = gap;
  pair->on_a[at] = a, pair->on_b[at] = b, pair->gaps[at] = g;
}

/* Corners in order, with coordinates along two directions. */
typedef struct outline {
  sbf_vec3 at[MAX_CORNERS];
  float u[MAX_CORNERS], v[MAX_CORNERS];
  uint32_t count;
} outline;

static void add_corner(outline *o, sbf_vec3 x, float u, float v) {
  if (o->count == MAX_CORNERS) return;
  o->at[o->count] = x, o->u[o->count] = u, o->v[o->count] = v;
  o->count++;
}

static float cross_at(const outline *o, uint32_t a, uint32_t b, uint32_t c) {
  return (o->u[b] - o->u[a]) * (o->v[c] - o->v[a]) - (o->v[b] - o->v[a]) * (o->u[c] - o->u[a]);
}

/* Convex hull of the points, counter-clockwise (A. M. Andrew, Another efficient algorithm for convex hulls in
 * two dimensions, 1979). */
static void make_outline(const outline *all, outline *to) {
  uint32_t order[MAX_CORNERS], chain[2 * MAX_CORNERS], n = all->count, count = 0;
  for (uint32_t i = 0; i < n; i++) {
    uint32_t k = i;
    for (; k > 0; k--) {
      uint32_t o = order[k - 1];
      if (all->u[o] < all->u[i] || (all->u[o] == all->u[i] && all->v[o] <= all->v[i])) break;
      order[k] = o;
    }
    order[k] = i;
  }
  for (int upper = 0; upper < 2; upper++) {
    uint32_t base = count;
    for (uint32_t i = 0; i < n; i++) {
      uint32_t o = order[upper ? n - 1 - i : i];
      while (count >= base + 2 && cross_at(all, chain[count - 2], chain[count - 1], o) <= 0) count--;
      chain[count++] = o;
    }
    count--; /* the other chain begins with this point */
  }
  to->count = 0;
  if (n == 1) count = 1, chain[0] = order[0];
  for (uint32_t i = 0; i < count; i++) add_corner(to, all->at[chain[i]], all->u[chain[i]], all->v[chain[i]]);
}

/* Clips the outline to the left of the line from (u0, v0) to (u1, v1), with a margin of `slack`. */
static void clip(const outline *from, float u0, float v0, float u1, float v1, float slack, outline *to) {
  float du = u1 - u0, dv = v1 - v0, size = sqrtf(du * du + dv * dv);
  to->count = 0;
  if (!(size > 1e-12f)) {
    *to = *from;
    return;
  }
  for (uint32_t i = 0; i < from->count; i++) {
    uint32_t k = (i + 1) % from->count;
    float a = ((from->v[i] - v0) * du - (from->u[i] - u0) * dv) / size + slack;
    float b = ((from->v[k] - v0) * du - (from->u[k] - u0) * dv) / size + slack;
    if (a >= 0) add_corner(to, from->at[i], from->u[i], from->v[i]);
    if (from->count < 2 || (a >= 0) == (b >= 0)) continue;
    float s = a / (a - b);
    add_corner(to, sbri_lerp(from->at[i], from->at[k], s), from->u[i] + s * (from->u[k] - from->u[i]),
        from->v[i] + s * (from->v[k] - from->v[i]));
  }
}

/* Vertices whose height above the plane n . x = offset is at most `max`. */
static void gather(const sbri_placed_hull *h, sbf_vec3 n, float offset, float max, sbf_vec3 u_axis,
    sbf_vec3 v_axis, outline *to) {
  sbf_vec3 local = to_local(h, n);
  float min = offset - sbri_dot(n, h->at);
  to->count = 0;
  for (uint32_t i = 0; i < h->hull->vertex_count; i++) {
    if (h->scale * sbri_dot(local, h->hull->vertices[i]) - min > max) continue;
    sbf_vec3 x = to_world(h, h->hull->vertices[i]);
    add_corner(to, x, sbri_dot(u_axis, x), sbri_dot(v_axis, x));
  }
}

/* The corners of the face whose normal is most opposed to n. */
static void gather_face(
    const sbri_placed_hull *h, sbf_vec3 n, sbf_vec3 u_axis, sbf_vec3 v_axis, outline *to) {
  sbf_vec3 local = to_local(h, n);
  const sbri_hull_face *max = &h->hull->faces[0];
  for (uint32_t f = 1; f < h->hull->face_count; f++)
    if (sbri_dot(local, h->hull->faces[f].normal) < sbri_dot(local, max->normal)) max = &h->hull->faces[f];
  to->count = 0;
  for (uint32_t i = 0; i < max->count; i++) {
    sbf_vec3 x = to_world(h, h->hull->vertices[h->hull->corners[max->first + i]]);
    add_corner(to, x, sbri_dot(u_axis, x), sbri_dot(v_axis, x));
  }
}

/* Clips an outline against a face. Returns the index of the result in `buffers`. */
static int clip_to_face(const outline *face, const outline *found, float slack, outline buffers[2]) {
  int current = 0;
  make_outline(found, &buffers[0]);
  for (uint32_t i = 0; face->count > 2 && i < face->count; i++, current = 1 - current) {
    uint32_t k = (i + 1) % face->count;
    clip(&buffers[current], face->u[i], face->v[i], face->u[k], face->v[k], slack, &buffers[1 - current]);
  }
  return current;
}

/* Whether a point is within the face, with a margin of `slack`. */
static bool is_over(const outline *face, float u, float v, float slack) {
  for (uint32_t i = 0; face->count > 2 && i < face->count; i++) {
    uint32_t k = (i + 1) % face->count;
    float du = face->u[k] - face->u[i], dv = face->v[k] - face->v[i], size = sqrtf(du * du + dv * dv);
    if (size > 1e-12f && ((v - face->v[i]) * du - (u - face->u[i]) * dv) / size < -slack) return false;
  }
  return true;
}

/* The reference face is that of the axis. The incident points are all vertices of the other hull near it,
 * clipped to the reference face. If none of these is over the face, as for a plank across a sill, the
 * incident face is clipped instead. */
static void add_patches(const sbri_placed_hull *face_of, const sbri_placed_hull *other, sbf_vec3 n, bool of_a,
    float reach, sbri_hull_pair *pair) {
  sbf_vec3 x_axis = fabsf(n.x) < 0.7f ? sbri_vec3(1, 0, 0) : sbri_vec3(0, 1, 0);
  sbf_vec3 u_axis = sbri_normalize(sbri_cross(x_axis, n), x_axis), v_axis = sbri_cross(n, u_axis);
  float offset = sbri_dot(n, support_point(face_of, n));
  float lowest = INFINITY;
  outline found, face, buffers[2];
  gather(face_of, sbri_scale(n, -1), -offset, 1e-3f * reach + 1e-5f, u_axis, v_axis, &found);
  make_outline(&found, &face);
  gather(other, n, offset, reach, u_axis, v_axis, &found);
  if (!found.count) return;
  int current = clip_to_face(&face, &found, 1e-3f * reach, buffers);
  if (!buffers[current].count) {
    gather_face(other, n, u_axis, v_axis, &found);
    current = clip_to_face(&face, &found, 1e-3f * reach, buffers);
  }
  for (uint32_t i = 0; i < buffers[current].count; i++) {
    sbf_vec3 x = buffers[current].at[i];
    float gap = sbri_dot(n, x) - offset;
    if (gap > reach) continue;
    sbf_vec3 on_face = sbri_add_scaled(x, n, -gap);
    sbri_hull_pair_add(pair, of_a ? on_face : x, of_a ? x : on_face, gap);
    lowest = gap < lowest ? gap : lowest;
  }
  /* The deepest vertex of a pointed or round hull lies inside the outline of those around it. */
  sbf_vec3 deepest = support_point(other, sbri_scale(n, -1));
  float gap = sbri_dot(n, deepest) - offset;
  if (gap > reach || gap >= lowest - 1e-3f * reach ||
      !is_over(&face, sbri_dot(u_axis, deepest), sbri_dot(v_axis, deepest), 1e-3f * reach))
    return;
  sbf_vec3 on_face = sbri_add_scaled(deepest, n, -gap);
  sbri_hull_pair_add(pair, of_a ? on_face : deepest, of_a ? deepest : on_face, gap);
}

bool sbri_collide_hulls(
    const sbri_placed_hull *a, const sbri_placed_hull *b, float reach, sbri_hull_pair *pair) {
  axis best = {.gap = -INFINITY};
  pair->count = 0;
  if (!a->hull->face_count || !b->hull->face_count) return false;
  if (!try_faces(b, a, false, reach, &best) || !try_faces(a, b, true, reach, &best) ||
      !try_edges(a, b, reach, &best))
    return false;
  pair->normal = best.normal, pair->gap = best.gap;
  if (best.of_edges)
    sbri_hull_pair_add(pair, best.on_a, best.on_b, best.gap);
  else
    add_patches(best.of_a ? a : b, best.of_a ? b : a, best.of_a ? sbri_scale(best.normal, -1) : best.normal,
        best.of_a, reach, pair);
  return pair->count > 0;
}
