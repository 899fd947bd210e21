/* Flips polygons so that neighbours face the same side, and closed surfaces outwards.
 *
 * Works shell by shell: polygons connected by edges of exactly two polygons. In an orientable shell one
 * polygon determines all others. A shell that encloses volume must face outwards; otherwise the smaller
 * part of its area is flipped. */
#include "build/geometry/topology.h"
#include "mechanics/polygon.h"
#include "sbfmt/mechanics.h"
#include "validate/repair/repair.h"

typedef struct shells {
  const sbf_polygon_mesh *mesh;
  sbfi_topology t;
  uint32_t *queue; /* (polygon_count) the current shell */
  uint8_t *seen, *flipped;
} shells;

typedef struct shell {
  uint32_t begin, end; /* range of the queue */
  bool has_conflict, closed, one_sided;
} shell;

static uint32_t polygons_at(const sbfi_topology *t, uint32_t edge) {
  return t->edge_polygon_begins[edge + 1] - t->edge_polygon_begins[edge];
}

/* Whether the polygon traverses the edge from end 0 to end 1. */
static bool is_forward(const shells *s, uint32_t polygon, uint32_t edge) {
  for (uint32_t c = s->t.corner_begins[polygon]; c < s->t.corner_begins[polygon + 1]; c++)
    if (s->t.corner_edges[c] == edge) return s->mesh->polygon_points.at[c] == s->t.edges[edge].at[0];
  return true;
}

static void visit_edge(shells *s, shell *of, uint32_t polygon, uint32_t edge) {
  const uint32_t *both = &s->t.edge_polygons[s->t.edge_polygon_begins[edge]];
  uint32_t other = both[0] == polygon ? both[1] : both[0];
  if (other == polygon) return; /* it traverses the edge twice, as around a bridged hole */
  bool is_opposite = is_forward(s, polygon, edge) == is_forward(s, other, edge);
  uint8_t wanted = s->flipped[polygon] ^ is_opposite;
  of->has_conflict |= is_opposite;
  if (s->seen[other]) {
    of->one_sided |= s->flipped[other] != wanted;
    return;
  }
  s->seen[other] = 1;
  s->flipped[other] = wanted;
  s->queue[of->end++] = other;
}

static shell collect(shells *s, uint32_t first, uint32_t begin) {
  shell of = {begin, begin + 1, false, true, false};
  s->queue[begin] = first;
  s->seen[first] = 1;
  for (uint32_t i = begin; i < of.end; i++) {
    uint32_t polygon = s->queue[i];
    for (uint32_t c = s->t.corner_begins[polygon]; c < s->t.corner_begins[polygon + 1]; c++) {
      uint32_t edge = s->t.corner_edges[c];
      if (edge == SBFI_NO_INDEX) continue;
      if (polygons_at(&s->t, edge) == 2)
        visit_edge(s, &of, polygon, edge);
      else
        of.closed = false;
    }
  }
  return of;
}

/* Volume of the shell after flipping, and the fraction of its area that would be flipped. */
static void measure(const shells *s, const shell *of, double *volume, double *flipped_fraction) {
  double area = 0, flipped = 0;
  sbfi_d3 origin =
      sbfi_d3_of(s->mesh->positions.at[s->mesh->polygon_points.at[s->t.corner_begins[s->queue[of->begin]]]]);
  *volume = 0;
  for (uint32_t i = of->begin; i < of->end; i++) {
    uint32_t p = s->queue[i], begin = s->t.corner_begins[p], size = s->t.corner_begins[p + 1] - begin;
    const uint32_t *corners = s->mesh->polygon_points.at + begin;
    sbfi_d3 middle = sbfi_polygon_middle(s->mesh->positions.at, corners, size);
    sbfi_d3 normal = sbfi_polygon_area(s->mesh->positions.at, corners, size, middle);
    double part = sbfi_d3_dot(sbfi_d3_sub(middle, origin), normal) / 3, length = sbfi_d3_length(normal);
    *volume += s->flipped[p] ? -part : part;
    flipped += s->flipped[p] ? length : 0;
    area += length;
  }
  *flipped_fraction = area > 0 ? flipped / area : 0;
}

static void resolve(shells *s, const shell *of, bool alone) {
  double volume, flipped_fraction;
  measure(s, of, &volume, &flipped_fraction);
  bool outwards_known = of->closed && alone && volume != 0; /* a shell inside another may be a hole */
  bool change = outwards_known ? volume < 0 : flipped_fraction > 0.5;
  for (uint32_t i = of->begin; i < of->end; i++) s->flipped[s->queue[i]] ^= change;
}

static void forget(shells *s, const shell *of) {
  for (uint32_t i = of->begin; i < of->end; i++) s->flipped[s->queue[i]] = 0;
}

static void flip_polygon(const sbf_polygon_mesh *mesh, uint32_t begin, uint32_t size) {
  uint32_t *corners = (uint32_t *)sbfi_writable(mesh->polygon_points.at) + begin;
  for (uint32_t low = 1, high = size - 1; low < high; low++, high--) {
    uint32_t swap = corners[low];
    corners[low] = corners[high];
    corners[high] = swap;
  }
}

static uint32_t flip_marked(const shells *s, uint32_t *first) {
  uint32_t count = 0;
  for (uint32_t p = 0; p < s->t.polygon_count; p++) {
    if (!s->flipped[p]) continue;
    flip_polygon(s->mesh, s->t.corner_begins[p], s->t.corner_begins[p + 1] - s->t.corner_begins[p]);
    if (count++ == 0) *first = p;
  }
  return count;
}

/* Flips a surface that faces inwards as a whole after its polygons agree. */
static uint32_t flip_outwards(const sbf_soft_body *body, const shells *s, bool all_closed) {
  sbf_body_measures is;
  sbf_surface_measures surface;
  sbf_body_measure(body, &is);
  sbf_surface_measure(&body->surface, NULL, &surface);
  bool one = s->t.component_count == 1;
  if (is.sheet || surface.volume >= 0 || !(one || all_closed)) return 0;
  for (uint32_t p = 0; p < s->t.polygon_count; p++)
    flip_polygon(s->mesh, s->t.corner_begins[p], s->t.corner_begins[p + 1] - s->t.corner_begins[p]);
  return s->t.polygon_count;
}

static void repair_surface(sbfi_repair *m, const sbf_soft_body *body, const char *path) {
  shells s = {.mesh = &body->surface};
  uint32_t polygons = body->surface.polygon_sizes.count, shell_count = 0, first = 0;
  bool all_closed = true, one_sided = false;
  s.queue = sbfi_repair_scratch(m, polygons, sizeof *s.queue);
  s.seen = sbfi_repair_scratch(m, polygons, 1);
  s.flipped = sbfi_repair_scratch(m, polygons, 1);
  shell *all = sbfi_repair_scratch(m, polygons, sizeof *all);
  if (m->out_of_memory || polygons == 0) return;
  if (!sbfi_topology_build(&s.t, s.mesh, &m->scratch)) {
    m->out_of_memory = true;
    return;
  }
  for (uint32_t p = 0, begin = 0; p < polygons; p++) {
    if (s.seen[p]) continue;
    all[shell_count] = collect(&s, p, begin);
    begin = all[shell_count++].end;
  }
  for (uint32_t i = 0; i < shell_count; i++) {
    all_closed &= all[i].closed;
    one_sided |= all[i].one_sided;
    if (all[i].has_conflict && !all[i].one_sided)
      resolve(&s, &all[i], shell_count == 1);
    else
      forget(&s, &all[i]);
  }
  uint32_t flipped = flip_marked(&s, &first);
  sbfi_count_repair(m, SBF_CODE_SURFACE_WINDING, flipped, path, first, "%u polygon%s of '%s' reversed",
      flipped, sbfi_plural(flipped), sbfi_label(body->name, body->id));
  uint32_t outwards = one_sided ? 0 : flip_outwards(body, &s, all_closed);
  sbfi_count_repair(m, SBF_CODE_SURFACE_INSIDE_OUT, outwards, path, -1,
      "all polygons of '%s' reversed to face outwards", sbfi_label(body->name, body->id));
}

void sbfi_repair_winding(sbfi_repair *m) {
  for (uint32_t b = 0; b < m->asset->soft_bodies.count && !m->out_of_memory; b++) {
    sbfi_path path = sbfi_path_of("/sbf/soft_body[%u]/polygon_mesh/polygon_sizes", b + 1);
    repair_surface(m, &m->asset->soft_bodies.at[b], path.text);
  }
}
