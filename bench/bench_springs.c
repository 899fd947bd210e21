/* Compares the methods of `--springs` that fill a concave body with springs: on a C and on the arm of the
 * armadillo, pinned at one end, under small gravity. The reference is a lattice of 20,000 tetrahedra of the
 * same material, with Poisson's ratio 1/4, the value of spring networks.
 *
 * Columns for each method: points and springs; number of inner springs that leave the body; spread of
 * stiffness (the 95th percentile over the 5th); sag of the free surface relative to the reference; error of
 * its shape relative to the reference's sag (root mean square over the three axes); and the substeps per tick
 * of 1/60 s that an explicit scheme needs at 100 kPa. */
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "measured_assets.h"
#include "measuring.h"
#include "sbfmt/build.h"
#include "sbfmt/mechanics.h"

enum { MAX_SAMPLES = 4000, REFERENCE_ELEMENTS = 20000 };
static const float modulus = 1e5f, poisson = 0.25f;

typedef struct v3 {
  double x, y, z;
} v3;

static v3 of(sbf_vec3 p) {
  return (v3){p.x, p.y, p.z};
}
static v3 minus(v3 a, v3 b) {
  return (v3){a.x - b.x, a.y - b.y, a.z - b.z};
}
static double dot(v3 a, v3 b) {
  return a.x * b.x + a.y * b.y + a.z * b.z;
}
static v3 cross(v3 a, v3 b) {
  return (v3){a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x};
}

/* ---- Bodies ---------------------------------------------------------------------------------------------
 */

static void *allocate(sbf_asset *asset, size_t count, size_t size) {
  void *memory = sbf_asset_allocate(asset, count, size);
  if (!memory) bench_fail("memory ran out");
  return memory;
}

static sbf_asset *body_asset(
    sbf_asset *asset, const sbf_polygon_mesh *mesh, const uint32_t *pinned, uint32_t count) {
  sbf_soft_body *body = allocate(asset, 1, sizeof *body);
  sbf_pin_set *pins = allocate(asset, 1, sizeof *pins);
  sbf_soft_body_init(body);
  sbf_pin_set_init(pins);
  body->id = body->name = "body";
  body->surface = *mesh;
  body->attributes.young_modulus = modulus;
  body->attributes.poisson_ratio = poisson;
  pins->points = (sbf_u32_list){pinned, count};
  body->pins = (sbf_pin_set_list){pins, 1};
  asset->soft_bodies = (sbf_soft_body_list){body, 1};
  return asset;
}

/* A bar of 4 x 4 x 40 squares, bent to three quarters of a ring of radius 0.3 m; held at one end. */
static sbf_asset *make_c(void) {
  enum { ALONG = 40, AROUND = 16, SIDE = 4 };
  static const int path[4][2] = {{1, 0}, {0, 1}, {-1, 0}, {0, -1}};
  sbf_asset *asset = sbf_asset_create(NULL);
  if (!asset) bench_fail("memory ran out");
  enum { RINGS = (ALONG + 1) * AROUND, INNER = (SIDE - 1) * (SIDE - 1), POINTS = RINGS + 2 * INNER };
  enum { QUADS = ALONG * AROUND + 2 * SIDE * SIDE };
  sbf_vec3 *positions = allocate(asset, POINTS, sizeof *positions);
  uint32_t *sizes = allocate(asset, QUADS, sizeof *sizes),
           *corners = allocate(asset, 4 * QUADS, sizeof *corners);
  uint32_t *pinned = allocate(asset, AROUND + INNER, sizeof *pinned), quad = 0, pinned_count = 0;
  uint32_t numbers[2][SIDE + 1][SIDE + 1];
  uint32_t inner = RINGS;
  for (int end = 0; end < 2; end++)
    for (int i = 1; i < SIDE; i++)
      for (int j = 1; j < SIDE; j++) numbers[end][i][j] = inner++;
  for (uint32_t point = 0; point < POINTS; point++) positions[point] = (sbf_vec3){0, 0, 0};
  for (int a = 0; a <= ALONG; a++) {
    double angle = 1.5 * 3.14159265358979 * a / ALONG;
    int i = 0, j = 0;
    for (int k = 0; k < AROUND; k++) {
      double radius = 0.3 + 0.15 * ((double)i / SIDE - 0.5);
      positions[a * AROUND + k] = (sbf_vec3){(float)(radius * cos(angle)), (float)(radius * sin(angle)),
          (float)(0.15 * ((double)j / SIDE - 0.5))};
      if (a == 0 || a == ALONG) numbers[a != 0][i][j] = (uint32_t)(a * AROUND + k);
      i += path[k / SIDE][0];
      j += path[k / SIDE][1];
    }
  }
  for (int end = 0; end < 2; end++)
    for (int i = 1; i < SIDE; i++)
      for (int j = 1; j < SIDE; j++) {
        double angle = end ? 1.5 * 3.14159265358979 : 0, radius = 0.3 + 0.15 * ((double)i / SIDE - 0.5);
        positions[numbers[end][i][j]] = (sbf_vec3){(float)(radius * cos(angle)), (float)(radius * sin(angle)),
            (float)(0.15 * ((double)j / SIDE - 0.5))};
      }
  for (int a = 0; a < ALONG; a++)
    for (int k = 0; k < AROUND; k++) {
      uint32_t b = (uint32_t)(a * AROUND), next = (uint32_t)((k + 1) % AROUND);
      const uint32_t four[4] = {b + (uint32_t)k, b + AROUND + (uint32_t)k, b + AROUND + next, b + next};
      memcpy(&corners[4 * quad], four, sizeof four);
      sizes[quad++] = 4;
    }
  for (int end = 0; end < 2; end++)
    for (int i = 0; i < SIDE; i++)
      for (int j = 0; j < SIDE; j++) {
        uint32_t four[4] = {
            numbers[end][i][j], numbers[end][i + 1][j], numbers[end][i + 1][j + 1], numbers[end][i][j + 1]};
        for (int k = 0; k < 4; k++) corners[4 * quad + (uint32_t)(end ? 3 - k : k)] = four[k];
        sizes[quad++] = 4;
      }
  for (int i = 0; i <= SIDE; i++)
    for (int j = 0; j <= SIDE; j++) pinned[pinned_count++] = numbers[0][i][j];
  sbf_polygon_mesh mesh;
  sbf_polygon_mesh_init(&mesh);
  mesh.target = SBF_MESH_TARGET_SURFACE;
  mesh.positions = (sbf_vec3_list){positions, POINTS};
  mesh.polygon_sizes = (sbf_u32_list){sizes, quad};
  mesh.polygon_points = (sbf_u32_list){corners, 4 * quad};
  return body_asset(asset, &mesh, pinned, pinned_count);
}

/* The left forearm of the armadillo, its triangles beyond x = 4.5 m, in a tenth of its size; the hole where
 * it was cut is closed by a fan with a pinned rim. NULL without the armadillo. */
static sbf_asset *make_arm(void) {
  sbf_asset *whole = character_asset(SHARED_FOLDER "/armadillo", "armadillo_25k.obj", NULL, false);
  if (!whole) return NULL;
  const sbf_polygon_mesh *from = &whole->soft_bodies.at[0].surface;
  uint32_t count = from->positions.count, polygons = from->polygon_sizes.count, kept = 0, used = 0, rim = 0;
  sbf_asset *asset = sbf_asset_create(NULL);
  if (!asset) bench_fail("memory ran out");
  uint32_t *numbers = allocate(asset, count, sizeof *numbers), *next = allocate(asset, count, sizeof *next);
  sbf_vec3 *positions = allocate(asset, (size_t)count + 1, sizeof *positions);
  uint32_t *corners = allocate(asset, 6 * (size_t)polygons, sizeof *corners);
  uint32_t *sizes = allocate(asset, 2 * (size_t)polygons, sizeof *sizes),
           *pinned = allocate(asset, (size_t)count + 1, sizeof *pinned);
  memset(numbers, 0xff, count * sizeof *numbers);
  memset(next, 0xff, count * sizeof *next);
  for (uint32_t p = 0; p < polygons; p++) {
    const uint32_t *c = from->polygon_points.at + 3 * (size_t)p;
    bool beyond = true;
    for (int k = 0; k < 3; k++) beyond &= from->positions.at[c[k]].x > 4.5f;
    for (int k = 0; k < 3 && beyond; k++) {
      if (numbers[c[k]] == UINT32_MAX) {
        sbf_vec3 at = from->positions.at[c[k]];
        numbers[c[k]] = used;
        positions[used++] = (sbf_vec3){0.1f * at.x, 0.1f * at.y, 0.1f * at.z};
      }
      corners[3 * kept + (uint32_t)k] = numbers[c[k]];
    }
    if (beyond) sizes[kept++] = 3;
  }
  /* The rim: sides that no triangle has the other way round. Each point of it has one of them. */
  for (uint32_t i = 0; i < 3 * kept; i++) {
    uint32_t a = corners[i], b = corners[i % 3 == 2 ? i - 2 : i + 1];
    bool twice = false;
    for (uint32_t k = 0; k < 3 * kept && !twice; k++)
      twice = corners[k] == b && corners[k % 3 == 2 ? k - 2 : k + 1] == a;
    if (!twice) next[b] = a;
  }
  v3 middle = {0, 0, 0};
  for (uint32_t i = 0; i < used; i++) {
    if (next[i] == UINT32_MAX) continue;
    middle = (v3){middle.x + positions[i].x, middle.y + positions[i].y, middle.z + positions[i].z};
    pinned[rim++] = i;
  }
  positions[used] = (sbf_vec3){(float)(middle.x / rim), (float)(middle.y / rim), (float)(middle.z / rim)};
  for (uint32_t i = 0; i < rim; i++) {
    const uint32_t three[3] = {pinned[i], next[pinned[i]], used};
    memcpy(&corners[3 * kept], three, sizeof three);
    sizes[kept++] = 3;
  }
  pinned[rim++] = used++;
  sbf_polygon_mesh mesh;
  sbf_polygon_mesh_init(&mesh);
  mesh.target = SBF_MESH_TARGET_SURFACE;
  mesh.positions = (sbf_vec3_list){positions, used};
  mesh.polygon_sizes = (sbf_u32_list){sizes, kept};
  mesh.polygon_points = (sbf_u32_list){corners, 3 * kept};
  sbf_asset_free(whole);
  return body_asset(asset, &mesh, pinned, rim);
}

/* ---- What is measured -----------------------------------------------------------------------------------
 */

/* Whether the point is inside: solid angles of all triangles (van Oosterom, Strackee 1983). */
static bool is_inside(const sbf_polygon_mesh *mesh, v3 at) {
  double sum = 0;
  const uint32_t *corners = mesh->polygon_points.at;
  for (uint32_t p = 0; p < mesh->polygon_sizes.count; corners += mesh->polygon_sizes.at[p++])
    for (uint32_t k = 1; k + 1 < mesh->polygon_sizes.at[p]; k++) {
      v3 a = minus(of(mesh->positions.at[corners[0]]), at), b = minus(of(mesh->positions.at[corners[k]]), at),
         c = minus(of(mesh->positions.at[corners[k + 1]]), at);
      double la = sqrt(dot(a, a)), lb = sqrt(dot(b, b)), lc = sqrt(dot(c, c));
      sum += 2 * atan2(dot(a, cross(b, c)), la * lb * lc + dot(a, b) * lc + dot(b, c) * la + dot(c, a) * lb);
    }
  return fabs(sum) > 6.28318530718;
}

/* Share of the springs through the inside with a middle part outside; of long lists of every so many. */
static double leaving(const sbf_polygon_mesh *mesh, const sbf_level *level) {
  uint32_t outside = 0, looked_at = 0;
  for (uint32_t set = 0; set < level->springs.count; set++) {
    const sbf_uint2_list *ends = &level->springs.at[set].ends;
    if (level->springs.at[set].kind != SBF_SPRING_KIND_INTERNAL) continue;
    for (uint32_t s = 0; s < ends->count; s += ends->count / MAX_SAMPLES + 1, looked_at++) {
      v3 a = of(level->positions.at[ends->at[s].at[0]]);
      v3 direction = minus(of(level->positions.at[ends->at[s].at[1]]), a);
      bool leaves = false;
      for (int k = 1; k < 4 && !leaves; k++)
        leaves = !is_inside(
            mesh, (v3){a.x + direction.x * k / 4, a.y + direction.y * k / 4, a.z + direction.z * k / 4});
      outside += leaves;
    }
  }
  return looked_at ? (double)outside / looked_at : 0;
}

static int compare(const void *a, const void *b) {
  const float *x = a, *y = b;
  return (*x > *y) - (*x < *y);
}

static double spread(const float *stiffness, uint32_t count) {
  if (count == 0) return 0;
  float *sorted = bench_allocate(count, sizeof *sorted);
  memcpy(sorted, stiffness, count * sizeof *sorted);
  qsort(sorted, count, sizeof *sorted, compare);
  double low = (double)sorted[count / 20], high = (double)sorted[count - 1 - count / 20];
  free(sorted);
  return low > 0 ? high / low : INFINITY;
}

/* How a body's level answers: displacements of its surface's points under gravity along each axis. */
typedef struct answer {
  sbf_asset *built;
  uint32_t springs, tetrahedra, points, surface_count;
  double leaving, spread, substeps, residual;
  double *falls; /* (3 axes x 3 x surface points) */
} answer;

static sbf_spring_network network_of(const sbf_soft_body *body, const sbf_level *level) {
  uint32_t count = 0, points = level->positions.count, tetrahedra = level->lattice.tetrahedra.count, next = 0;
  for (uint32_t s = 0; s < level->springs.count; s++) count += level->springs.at[s].ends.count;
  sbf_uint2 *ends = bench_allocate((size_t)count + 1, sizeof *ends);
  float *stiffness = bench_allocate((size_t)count + 1, sizeof *stiffness);
  float *masses = bench_allocate(points, sizeof *masses),
        *moduli = bench_allocate((size_t)tetrahedra + 1, sizeof *moduli);
  float *ratios = bench_allocate((size_t)tetrahedra + 1, sizeof *ratios);
  uint8_t *pinned = bench_allocate(points, 1);
  for (uint32_t s = 0; s < level->springs.count; s++)
    for (uint32_t i = 0; i < level->springs.at[s].ends.count; i++, next++) {
      ends[next] = level->springs.at[s].ends.at[i];
      stiffness[next] = level->springs.at[s].stiffness.at[i];
    }
  for (uint32_t t = 0; t < tetrahedra; t++) {
    moduli[t] = modulus;
    ratios[t] = poisson;
  }
  sbf_level_pinned_points(level, pinned);
  sbf_level_masses(body, level, pinned, masses);
  for (uint32_t i = 0; i < points; i++)
    if (pinned[i]) masses[i] = 0;
  free(pinned);
  return (sbf_spring_network){.point_count = points,
      .spring_count = count,
      .positions = level->positions.at,
      .masses = masses,
      .ends = ends,
      .stiffness = stiffness,
      .tetrahedron_count = tetrahedra,
      .tetrahedra = level->lattice.tetrahedra.at,
      .young_modulus = moduli,
      .poisson_ratios = ratios};
}

static void free_network(sbf_spring_network *n) {
  free((void *)(uintptr_t)n->masses);
  free((void *)(uintptr_t)n->ends);
  free((void *)(uintptr_t)n->stiffness);
  free((void *)(uintptr_t)n->young_modulus);
  free((void *)(uintptr_t)n->poisson_ratios);
}

/* The surface's points as the level's embedding of it carries them, or as its own. */
static void carry(const sbf_level *level, const double *moved, uint32_t count, double *out) {
  const sbf_embedding *e = NULL;
  for (uint32_t i = 0; i < level->embeddings.count; i++)
    if (level->embeddings.at[i].render_mesh == SBF_NONE) e = &level->embeddings.at[i];
  if (!e) bench_fail("the level does not carry its surface");
  for (uint32_t i = 0; i < count; i++) {
    const float weights[4] = {e->weights.at[i].x, e->weights.at[i].y, e->weights.at[i].z, e->weights.at[i].w};
    for (uint32_t k = 0; k < 3; k++) {
      out[3 * i + k] = 0;
      for (int j = 0; j < 4; j++) out[3 * i + k] += (double)weights[j] * moved[3 * e->points.at[i].at[j] + k];
    }
  }
}

static answer ask(const sbf_asset *source, sbf_build_options options) {
  options.without_calibration = true;
  answer a = {.built = NULL};
  sbf_diagnostic error;
  bench_require(sbf_build(source, &options, &a.built, NULL, &error), &error);
  const sbf_soft_body *body = &a.built->soft_bodies.at[0];
  const sbf_level *level = &body->levels.at[0];
  sbf_spring_network n = network_of(body, level);
  a.points = n.point_count;
  a.springs = n.spring_count;
  a.tetrahedra = n.tetrahedron_count;
  a.surface_count = body->surface.positions.count;
  a.leaving = leaving(&body->surface, level);
  a.spread = spread(n.stiffness, n.spring_count);
  a.falls = bench_allocate(9 * (size_t)a.surface_count, sizeof *a.falls);
  double *forces = bench_allocate(3 * (size_t)a.points, sizeof *forces);
  double *moved = bench_allocate(3 * (size_t)a.points, sizeof *moved);
  double *scratch = bench_allocate(10 * (size_t)a.points, sizeof *scratch);
  a.substeps = ceil(sbf_network_highest_bound(&n, scratch) / 120);
  for (uint32_t axis = 0; axis < 3; axis++) {
    for (uint32_t i = 0; i < a.points; i++)
      for (uint32_t k = 0; k < 3; k++) forces[3 * i + k] = k == axis ? 9.81 * (double)n.masses[i] : 0;
    a.residual = fmax(a.residual, sbf_network_static(&n, forces, 1e-7, 10000, moved, scratch));
    carry(level, moved, a.surface_count, a.falls + 3 * (size_t)a.surface_count * axis);
  }
  free(forces);
  free(moved);
  free(scratch);
  free_network(&n);
  return a;
}

static void forget(answer *a) {
  free(a->falls);
  sbf_asset_free(a->built);
}

static void measure(const char *name, const sbf_asset *source, bool quick) {
  static const struct {
    const char *name;
    sbf_build_interior interior;
    uint32_t elements;
    double cell; /* of the usual one; 0: that */
  } methods[] = {{"surface", SBF_BUILD_INTERIOR_NONE, 0, 0}, {"centroid", SBF_BUILD_INTERIOR_CENTROID, 0, 0},
      {"brute", SBF_BUILD_INTERIOR_BRUTE, 0, 0}, {"lattice", SBF_BUILD_INTERIOR_LATTICE, 0, 0},
      {"tetrahedra", SBF_BUILD_INTERIOR_TETRAHEDRA, 2000, 0}};
  answer reference = ask(source, (sbf_build_options){.interior = SBF_BUILD_INTERIOR_TETRAHEDRA,
                                     .elements = quick ? 500 : REFERENCE_ELEMENTS});
  for (size_t m = 0; m < sizeof methods / sizeof *methods; m++) {
    if (quick && methods[m].interior == SBF_BUILD_INTERIOR_BRUTE) continue;
    answer a =
        ask(source, (sbf_build_options){.interior = methods[m].interior, .elements = methods[m].elements});
    double off = 0, fall = 0, all = 0;
    for (size_t i = 0; i < 9 * (size_t)a.surface_count; i++) {
      off += (a.falls[i] - reference.falls[i]) * (a.falls[i] - reference.falls[i]);
      fall += a.falls[i] * reference.falls[i];
      all += reference.falls[i] * reference.falls[i];
    }
    /* What springs alone cannot hold falls without end. */
    bool holds = a.residual < 1e-3 && sqrt(off / all) < 1e3;
    char figures[64] = ",";
    if (holds) snprintf(figures, sizeof figures, "%.3f,%.3f", fall / all, sqrt(off / all));
    bench_print_row("%s,%s,%u,%u,%.3f,%.1f,%s,%.0f", name, methods[m].name, a.points,
        a.tetrahedra ? a.tetrahedra : a.springs, a.leaving, a.spread, figures, a.substeps);
    forget(&a);
  }
  forget(&reference);
}

int main(int argument_count, char **arguments) {
  bool quick = bench_is_quick(argument_count, arguments);
  bench_print_columns("body,method,points,elements,leaving,spread,fall,off,substeps");
  sbf_asset *c = make_c(), *arm = quick ? NULL : make_arm();
  measure("C", c, quick);
  sbf_asset_free(c);
  if (arm) {
    measure("armadillo's arm", arm, quick);
    sbf_asset_free(arm);
  }
  return 0;
}
