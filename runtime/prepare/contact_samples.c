/* Selects the contact samples of a body.
 *
 * If the surface's vertices are points of the level, these are the samples. If the surface is embedded in the
 * level, every vertex that a polygon uses is one, with the weights of its embedding, in the source's order.
 * Fewer would be cheaper, but only samples near the ground cost anything, and each one left out can
 * penetrate. Where vertices are farther apart than the level's points, points of the level on the surface are
 * samples too: otherwise a face would rest on its corners alone and sink between them. Samples are sorted
 * into groups with the same points, so that a tick skips all samples whose points are far from everything. */
#include <stdlib.h>
#include <string.h>

#include "math/vec3.h"
#include "prepare/prepare.h"

enum { POINTS = 4 };

static bool is_embedded(const sbri_skin *skin) {
  if (skin->vertex_count == 0 || skin->frame_vertex_count > 0) return false;
  for (uint32_t v = 0; v < skin->vertex_count; v++) {
    uint32_t block = v / SBRI_BLOCK, begin = skin->cell_begins[block];
    for (uint32_t c = begin; c < skin->cell_begins[block + 1]; c++)
      if (skin->cells[c].weights[v % SBRI_BLOCK] != (c == begin ? 1.0f : 0.0f)) return true;
  }
  return false;
}

static float weight_below_0(const sbri_sample *s) {
  float sum = 0;
  for (int k = 0; k < POINTS; k++) sum += s->weights[k] < 0 ? -s->weights[k] : 0;
  return sum;
}

static void add_sample(sbri_body *body, sbri_sample *samples, sbri_sample s) {
  if (!(s.mass_kg > 0)) return; /* it follows bones only */
  float beyond = weight_below_0(&s);
  body->contact.max_extrapolation =
      beyond > body->contact.max_extrapolation ? beyond : body->contact.max_extrapolation;
  samples[body->contact.sample_count++] = s;
}

/* ---- Points of the level on the surface ---- */

/* Distance from the surface, as a fraction of the tetrahedra's edges, within which a point of the level is a
 * sample. Farther outside it would support the body too high; farther inside it would add nothing. */
static const float OUTSIDE_FRACTION = 0.02f, INSIDE_FRACTION = 0.25f;

/* Distance of a triangle and a point: its square, and whether the point is behind. */
typedef struct distance {
  float square;
  bool behind;
} distance;

static sbf_vec3 nearest_on_edge(sbf_vec3 x, sbf_vec3 a, sbf_vec3 b) {
  sbf_vec3 side = sbri_sub(b, a);
  float square = sbri_dot(side, side), t = square > 0 ? sbri_dot(sbri_sub(x, a), side) / square : 0;
  return sbri_add_scaled(a, side, t < 0 ? 0 : t > 1 ? 1 : t);
}

static distance distance_to(sbf_vec3 x, const sbf_vec3 corners[3]) {
  sbf_vec3 n = sbri_cross(sbri_sub(corners[1], corners[0]), sbri_sub(corners[2], corners[0]));
  float height = sbri_dot(sbri_sub(x, corners[0]), n), area = sbri_dot(n, n), min = -1;
  bool inside = area > 0;
  for (int k = 0; k < 3; k++) {
    sbf_vec3 a = corners[k], b = corners[(k + 1) % 3];
    inside = inside && sbri_dot(sbri_cross(sbri_sub(b, a), sbri_sub(x, a)), n) >= 0;
    sbf_vec3 off = sbri_sub(x, nearest_on_edge(x, a, b));
    float square = sbri_dot(off, off);
    min = min < 0 || square < min ? square : min;
  }
  if (inside) min = height * height / area;
  return (distance){min, height < 0};
}

typedef struct surface_points {
  const sbri_body *body;
  distance *nearest; /* (points of the level) */
  float reach;       /* m; points farther away are skipped */
} surface_points;

static void find_from(const surface_points *p, const sbf_vec3 corners[3]) {
  const sbf_vec3_list *points = &p->body->level->positions;
  sbf_vec3 low = corners[0], high = corners[0];
  for (int k = 1; k < 3; k++) {
    low = sbri_vec3(fminf(low.x, corners[k].x), fminf(low.y, corners[k].y), fminf(low.z, corners[k].z));
    high = sbri_vec3(fmaxf(high.x, corners[k].x), fmaxf(high.y, corners[k].y), fmaxf(high.z, corners[k].z));
  }
  float r = p->reach;
  for (uint32_t i = 0; i < points->count; i++) {
    sbf_vec3 x = points->at[i];
    if (x.x < low.x - r || x.x > high.x + r || x.y < low.y - r || x.y > high.y + r || x.z < low.z - r ||
        x.z > high.z + r)
      continue;
    distance found = distance_to(x, corners);
    if (p->nearest[i].square < 0 || found.square < p->nearest[i].square) p->nearest[i] = found;
  }
}

/* Edge of a regular tetrahedron of the mean volume, m. */
static float mean_edge(const sbri_body *body) {
  double volume = 0;
  const sbf_vec3 *at = body->level->positions.at;
  for (uint32_t t = 0; t < body->elements.tetrahedron_count; t++) {
    const uint32_t *c = body->level->lattice.tetrahedra.at[t].at;
    sbf_vec3 a = sbri_sub(at[c[1]], at[c[0]]), b = sbri_sub(at[c[2]], at[c[0]]);
    volume += (double)fabsf(sbri_dot(sbri_cross(a, b), sbri_sub(at[c[3]], at[c[0]]))) / 6;
  }
  double cube = body->elements.tetrahedron_count ? 8.485 * volume / body->elements.tetrahedron_count : 0,
         edge = 1;
  for (int i = 0; i < 60 && cube > 0; i++) edge -= (edge - cube / (edge * edge)) / 3;
  return cube > 0 ? (float)edge : 0;
}

static float mean_edge_of(const sbf_polygon_mesh *mesh) {
  const uint32_t *corners = mesh->polygon_points.at;
  double sum = 0, count = 0;
  for (uint32_t p = 0; p < mesh->polygon_sizes.count; corners += mesh->polygon_sizes.at[p++])
    for (uint32_t k = 0; k < mesh->polygon_sizes.at[p]; k++, count++) {
      uint32_t next = corners[(k + 1) % mesh->polygon_sizes.at[p]];
      sum += (double)sbri_length(sbri_sub(mesh->positions.at[next], mesh->positions.at[corners[k]]));
    }
  return count > 0 ? (float)(sum / count) : 0;
}

static void find_surface_points(const surface_points *p) {
  const sbf_polygon_mesh *mesh = &p->body->source->surface;
  const uint32_t *corners = mesh->polygon_points.at;
  for (uint32_t i = 0; i < p->body->level->positions.count; i++) p->nearest[i].square = -1;
  for (uint32_t n = 0; n < mesh->polygon_sizes.count; corners += mesh->polygon_sizes.at[n++])
    for (uint32_t k = 2; k < mesh->polygon_sizes.at[n]; k++)
      find_from(p, (const sbf_vec3[]){mesh->positions.at[corners[0]], mesh->positions.at[corners[k - 1]],
                       mesh->positions.at[corners[k]]});
}

static void add_surface_points(
    const sbri_island *island, sbri_body *body, const surface_points *p, float edge, sbri_sample *samples) {
  for (uint32_t i = 0; i < body->level->positions.count; i++) {
    float fraction = p->nearest[i].behind ? INSIDE_FRACTION : OUTSIDE_FRACTION, max = fraction * edge;
    uint32_t slot = body->slots.from_point[i];
    if (p->nearest[i].square < 0 || p->nearest[i].square > max * max || slot >= island->free_count) continue;
    add_sample(body, samples,
        (sbri_sample){{slot, slot, slot, slot}, {1, 0, 0, 0}, island->masses[slot], UINT32_MAX});
  }
}

/* ---- Groups ---- */

typedef struct keyed_sample {
  sbri_sample sample;
  uint32_t key[POINTS], number; /* its slots in order */
} keyed_sample;

static int compare_keys(const keyed_sample *a, const keyed_sample *b) {
  for (int k = 0; k < POINTS; k++)
    if (a->key[k] != b->key[k]) return a->key[k] < b->key[k] ? -1 : 1;
  return 0;
}

static int compare_samples(const void *left, const void *right) {
  const keyed_sample *a = left, *b = right;
  int order = compare_keys(a, b);
  return order ? order : (a->number > b->number) - (a->number < b->number);
}

static keyed_sample keyed(const sbri_sample *s, uint32_t number) {
  keyed_sample made = {*s, {s->slots[0], s->slots[1], s->slots[2], s->slots[3]}, number};
  for (int i = 1; i < POINTS; i++)
    for (int k = i; k > 0 && made.key[k] < made.key[k - 1]; k--) {
      uint32_t key = made.key[k];
      made.key[k] = made.key[k - 1], made.key[k - 1] = key;
    }
  return made;
}

/* Sorts samples so that those with the same points are adjacent. */
static bool group(sbr_model *model, sbri_body *body, sbri_sample *samples, sbfi_arena *scratch) {
  uint32_t count = body->contact.sample_count, groups = 0;
  keyed_sample *sorted = sbfi_arena_allocate(scratch, (size_t)count + 1, sizeof *sorted);
  if (!sorted) return false;
  for (uint32_t i = 0; i < count; i++) sorted[i] = keyed(&samples[i], i);
  qsort(sorted, count, sizeof *sorted, compare_samples);
  for (uint32_t i = 0; i < count; i++) groups += i == 0 || compare_keys(&sorted[i - 1], &sorted[i]) != 0;
  sbri_sample_group *at = sbfi_arena_allocate(&model->arena, (size_t)groups + 1, sizeof *at);
  if (!at) return false;
  body->contact.sample_groups = at, body->contact.sample_group_count = groups;
  at--;
  for (uint32_t i = 0; i < count; i++) {
    samples[i] = sorted[i].sample;
    if (i == 0 || compare_keys(&sorted[i - 1], &sorted[i]) != 0) {
      *++at = (sbri_sample_group){.first = i};
      memcpy(at->slots, sorted[i].key, sizeof at->slots);
    }
    at->end = i + 1;
    at->max_extrapolation = fmaxf(at->max_extrapolation, weight_below_0(&samples[i]));
  }
  return true;
}

/* ---- All samples ---- */

static bool mark_used(const sbf_polygon_mesh *mesh, sbfi_arena *scratch, uint8_t **used) {
  *used = sbfi_arena_allocate(scratch, mesh->positions.count, sizeof **used);
  if (!*used) return false;
  for (uint32_t i = 0; i < mesh->polygon_points.count; i++) (*used)[mesh->polygon_points.at[i]] = 1;
  return true;
}

static bool make(sbr_model *model, sbri_body *body, sbfi_arena *scratch) {
  const sbri_island *island = &model->islands[body->island];
  const sbf_polygon_mesh *mesh = &body->source->surface;
  float edge = mean_edge(body);
  bool sparse = edge > 0 && mean_edge_of(mesh) > edge;
  size_t count = (size_t)body->surface.skin.vertex_count + (sparse ? body->level->positions.count : 0);
  sbri_sample *samples = sbfi_arena_allocate(&model->arena, count, sizeof *samples);
  uint8_t *used;
  if (!samples || !mark_used(mesh, scratch, &used)) return false;
  body->contact.samples = samples;
  if (sparse) {
    surface_points p = {.body = body, .reach = INSIDE_FRACTION * edge};
    p.nearest = sbfi_arena_allocate(scratch, body->level->positions.count, sizeof *p.nearest);
    if (!p.nearest) return false;
    find_surface_points(&p);
    add_surface_points(island, body, &p, edge, samples);
  }
  for (uint32_t v = 0; v < body->surface.skin.vertex_count; v++) {
    if (used[v]) add_sample(body, samples, sbri_sample_of(island, &body->surface.skin, v));
  }
  return group(model, body, samples, scratch);
}

bool sbri_samples_make(sbr_model *model, sbri_body *body) {
  if (!body->level || !is_embedded(&body->surface.skin)) return true;
  sbfi_arena scratch;
  sbfi_arena_init(&scratch, &model->arena.allocator, 0);
  bool good = make(model, body, &scratch);
  sbfi_arena_free(&scratch);
  return good;
}
