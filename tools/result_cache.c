#include "result_cache.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "sbfmt/codes.h"
#include "sbfmt/export.h"
#include "sbrun/soft_body.h"

/* A simulated body: first index of its points and cells in the arrays of all. */
typedef struct result_body {
  uint32_t soft_body, first_point, point_count, first_cell, tetrahedron_count, spring_count;
} result_body;

enum { BODY, STRESS, MISES, ENERGY, TENSION, RATIO, TORN, CELL_ARRAYS };
enum { DISPLACEMENT, POINT_STRESS, POINT_MISES, POINT_ENERGY, POINT_ARRAYS };

struct result_cache {
  sbf_result_series *series;
  sbf_result_mesh mesh;
  result_body *bodies;
  uint32_t body_count, max_points, max_tetrahedra, max_springs;
  uint32_t *corners;
  uint8_t *sizes;
  sbf_vec3 *read; /* (points of the largest body) */
  double *first, *points;
  /* fractions: of the volume around each point */
  float *cells[CELL_ARRAYS], *nodes[POINT_ARRAYS], *fractions;
  sbr_tetrahedron_state *tetrahedra;
  sbr_spring_state *springs;
  bool begun;
};

static const struct {
  const char *name;
  uint32_t width;
} of_cells[CELL_ARRAYS] = {{"body", 1}, {"stress", 6}, {"von_mises", 1}, {"strain_energy_density", 1},
    {"tension", 1}, {"volume_ratio", 1}, {"torn", 1}},
  of_points[POINT_ARRAYS] = {
      {"displacement", 3}, {"stress", 6}, {"von_mises", 1}, {"strain_energy_density", 1}};

bool result_cache_named(const char *path) {
  const char *point = strrchr(path, '.');
  return point && strcmp(point, ".pvd") == 0;
}

/* ---- Making ---- */

static uint32_t larger(uint32_t a, uint32_t b) {
  return a > b ? a : b;
}

static uint32_t cells_of(const result_body *b) {
  uint32_t elements = b->tetrahedron_count + b->spring_count;
  return elements ? elements : b->point_count;
}

static bool list_bodies(result_cache *r, const session *s) {
  r->bodies = calloc(s->asset->soft_bodies.count + 1, sizeof *r->bodies);
  for (uint32_t i = 0; r->bodies && i < s->asset->soft_bodies.count; i++) {
    result_body b = {.soft_body = i, .first_point = r->mesh.point_count, .first_cell = r->mesh.cell_count};
    b.point_count = sbr_character_get_points(s->world, s->character, i, NULL, 0);
    b.tetrahedron_count = sbr_character_get_tetrahedra(s->world, s->character, i, NULL, 0);
    b.spring_count = sbr_character_get_springs(s->world, s->character, i, NULL, 0);
    if (b.point_count == 0) continue;
    r->mesh.point_count += b.point_count, r->mesh.cell_count += cells_of(&b);
    r->max_points = larger(r->max_points, b.point_count);
    r->max_tetrahedra = larger(r->max_tetrahedra, b.tetrahedron_count);
    r->max_springs = larger(r->max_springs, b.spring_count);
    r->bodies[r->body_count++] = b;
  }
  return r->bodies != NULL;
}

static bool reserve(result_cache *r) {
  size_t points = r->mesh.point_count, cells = r->mesh.cell_count;
  bool good = true;
  r->read = calloc(r->max_points + 1, sizeof *r->read);
  r->tetrahedra = calloc(r->max_tetrahedra + 1, sizeof *r->tetrahedra);
  r->springs = calloc(r->max_springs + 1, sizeof *r->springs);
  r->first = calloc(3 * points + 1, sizeof *r->first);
  r->points = calloc(3 * points + 1, sizeof *r->points);
  r->fractions = calloc(points + 1, sizeof *r->fractions);
  r->corners = calloc(4 * cells + 1, sizeof *r->corners);
  r->sizes = calloc(cells + 1, sizeof *r->sizes);
  for (int i = 0; i < CELL_ARRAYS; i++)
    good = (r->cells[i] = calloc(of_cells[i].width * cells + 1, sizeof(float))) && good;
  for (int i = 0; i < POINT_ARRAYS; i++)
    good = (r->nodes[i] = calloc(of_points[i].width * points + 1, sizeof(float))) && good;
  return good && r->read && r->tetrahedra && r->springs && r->first && r->points && r->fractions &&
         r->corners && r->sizes;
}

static void free_space(result_cache *r) {
  free(r->bodies), free(r->read), free(r->tetrahedra), free(r->springs), free(r->first), free(r->points);
  free(r->fractions), free(r->corners), free(r->sizes);
  for (int i = 0; i < CELL_ARRAYS; i++) free(r->cells[i]);
  for (int i = 0; i < POINT_ARRAYS; i++) free(r->nodes[i]);
  free(r);
}

static void read_elements(const result_cache *r, const session *s, const result_body *b) {
  sbr_character_get_tetrahedra(s->world, s->character, b->soft_body, r->tetrahedra, b->tetrahedron_count);
  sbr_character_get_springs(s->world, s->character, b->soft_body, r->springs, b->spring_count);
}

/* Writes the points of each cell. */
static void fill_mesh(result_cache *r, const session *s) {
  uint32_t at = 0;
  for (uint32_t i = 0; i < r->body_count; i++) {
    const result_body *b = &r->bodies[i];
    uint32_t cell = b->first_cell;
    read_elements(r, s, b);
    for (uint32_t t = 0; t < b->tetrahedron_count; t++, r->sizes[cell++] = 4)
      for (int k = 0; k < 4; k++) r->corners[at++] = b->first_point + r->tetrahedra[t].corners[k];
    for (uint32_t t = 0; t < b->spring_count; t++, r->sizes[cell++] = 2)
      for (int k = 0; k < 2; k++) r->corners[at++] = b->first_point + r->springs[t].ends[k];
    for (uint32_t p = 0; cell < b->first_cell + cells_of(b); p++, r->sizes[cell++] = 1)
      r->corners[at++] = b->first_point + p;
    for (uint32_t c = b->first_cell; c < cell; c++) r->cells[BODY][c] = (float)b->soft_body;
  }
  r->mesh.corners = r->corners, r->mesh.sizes = r->sizes;
}

static sbf_status fail(sbf_diagnostic *error, sbf_code code, const char *message) {
  *error = (sbf_diagnostic){.code = code, .severity = SBF_SEVERITY_ERROR, .offset = -1, .index = -1};
  snprintf(error->message, sizeof error->message, "%s", message);
  return SBF_FAILED;
}

result_cache *result_cache_open(const session *s, const char *path, sbf_diagnostic *error) {
  result_cache *r = calloc(1, sizeof *r);
  if (!r || !list_bodies(r, s) || !reserve(r)) {
    if (r) free_space(r);
    fail(error, SBF_CODE_OUT_OF_MEMORY, "memory ran out for the results");
    return NULL;
  }
  if (r->mesh.point_count == 0) {
    free_space(r);
    fail(error, SBF_CODE_EXPORT_EMPTY, "no soft body is simulated: there are no results to write");
    return NULL;
  }
  fill_mesh(r, s);
  if (sbf_result_series_open(path, &r->mesh, &r->series, error) == SBF_OK) return r;
  free_space(r);
  return NULL;
}

/* ---- A frame ---- */

static float mises_of(const float t[6]) {
  float a = t[0] - t[1], b = t[1] - t[2], c = t[2] - t[0], shear = t[3] * t[3] + t[4] * t[4] + t[5] * t[5];
  return sqrtf(0.5f * (a * a + b * b + c * c) + 3 * shear);
}

static void fill_points(result_cache *r, const session *s, const result_body *b) {
  sbr_double3 o = sbr_character_get_origin(s->world, s->character);
  sbr_character_get_points(s->world, s->character, b->soft_body, r->read, b->point_count);
  for (uint32_t i = 0; i < b->point_count; i++) {
    double *to = r->points + 3 * (size_t)(b->first_point + i);
    to[0] = o.x + (double)r->read[i].x, to[1] = o.y + (double)r->read[i].y,
    to[2] = o.z + (double)r->read[i].z;
  }
}

static void add_node(result_cache *r, uint32_t point, const sbr_tetrahedron_state *t) {
  double volume = (double)t->rest_volume, sum = r->fractions[point] + volume;
  float fraction = sum > 0 ? (float)(volume / sum) : 0;
  float *stress = r->nodes[POINT_STRESS] + 6 * (size_t)point, *energy = r->nodes[POINT_ENERGY] + point;
  r->fractions[point] = sum;
  for (int k = 0; k < 6; k++) stress[k] += (t->stress[k] - stress[k]) * fraction;
  *energy += (t->energy_density - *energy) * fraction;
}

static void fill_cells(result_cache *r, const result_body *b) {
  uint32_t cell = b->first_cell;
  for (uint32_t i = 0; i < b->tetrahedron_count; i++, cell++) {
    const sbr_tetrahedron_state *t = &r->tetrahedra[i];
    memcpy(r->cells[STRESS] + 6 * (size_t)cell, t->stress, sizeof t->stress);
    r->cells[MISES][cell] = mises_of(t->stress);
    r->cells[ENERGY][cell] = t->energy_density;
    r->cells[RATIO][cell] = t->volume_ratio;
    r->cells[TORN][cell] = t->torn;
    for (int k = 0; k < 4 && !t->torn; k++) add_node(r, b->first_point + t->corners[k], t);
  }
  for (uint32_t i = 0; i < b->spring_count; i++, cell++) {
    r->cells[TENSION][cell] = r->springs[i].tension;
    r->cells[TORN][cell] = r->springs[i].torn;
  }
}

static void fill_nodes(result_cache *r) {
  for (uint32_t p = 0; p < r->mesh.point_count; p++) {
    r->nodes[POINT_MISES][p] = mises_of(r->nodes[POINT_STRESS] + 6 * (size_t)p);
    for (uint32_t k = 3 * p; k < 3 * p + 3; k++)
      r->nodes[DISPLACEMENT][k] = (float)(r->points[k] - r->first[k]);
  }
}

sbf_status result_cache_add(result_cache *r, const session *s, sbf_diagnostic *error) {
  sbf_result_array cells[CELL_ARRAYS], nodes[POINT_ARRAYS];
  memset(r->fractions, 0, r->mesh.point_count * sizeof *r->fractions);
  memset(r->nodes[POINT_STRESS], 0, 6 * (size_t)r->mesh.point_count * sizeof(float));
  memset(r->nodes[POINT_ENERGY], 0, r->mesh.point_count * sizeof(float));
  for (uint32_t i = 0; i < r->body_count; i++) {
    read_elements(r, s, &r->bodies[i]);
    fill_points(r, s, &r->bodies[i]);
    fill_cells(r, &r->bodies[i]);
  }
  if (!r->begun) memcpy(r->first, r->points, 3 * (size_t)r->mesh.point_count * sizeof *r->first);
  r->begun = true;
  fill_nodes(r);
  for (int i = 0; i < CELL_ARRAYS; i++)
    cells[i] = (sbf_result_array){of_cells[i].name, of_cells[i].width, r->cells[i]};
  for (int i = 0; i < POINT_ARRAYS; i++)
    nodes[i] = (sbf_result_array){of_points[i].name, of_points[i].width, r->nodes[i]};
  return sbf_result_series_add(
      r->series, &(sbf_result_frame){s->time_s, r->points, nodes, cells, POINT_ARRAYS, CELL_ARRAYS}, error);
}

sbf_status result_cache_commit(result_cache *r, sbf_diagnostic *error) {
  sbf_status status = sbf_result_series_commit(r->series, error);
  free_space(r);
  return status;
}

void result_cache_abandon(result_cache *r) {
  if (!r) return;
  sbf_result_series_abandon(r->series);
  free_space(r);
}
