/* Speed of the packed form on a surface of 100,489 points: saving, and loading with all checks, as CSV.
 *
 *   bench_packed [FILE]     writes FILE (bench_packed.sbfz) again and again, and removes it at the end
 *
 * Each figure is the best of many runs with the file in the page cache. MB are 10^6 bytes of lists, the same
 * for every row, so that rows compare; allocated_bytes is the most that the load held from its allocator. */
#define _POSIX_C_SOURCE 200809L
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <time.h>

#include "sbfmt/io.h"

enum { CELLS = 316, ROW = CELLS + 1, POINTS = ROW * ROW, QUADS = CELLS * CELLS, RUNS = 30 };
static const double PI = 3.14159265358979323846;

static double seconds(void) {
  struct timespec t;
  clock_gettime(CLOCK_MONOTONIC, &t);
  return (double)t.tv_sec + 1e-9 * (double)t.tv_nsec;
}

static void *allocate(sbf_asset *asset, size_t count, size_t size) {
  void *memory = sbf_asset_allocate(asset, count, size);
  if (!memory) exit(2);
  return memory;
}

/* A bumpy sphere with a little noise: neither as regular as a lattice nor as random as a scan. */
static sbf_asset *make_asset(double *list_bytes) {
  sbf_asset *asset = sbf_asset_create(NULL);
  if (!asset) exit(2);
  sbf_vec3 *positions = allocate(asset, POINTS, sizeof *positions);
  sbf_vec3 *normals = allocate(asset, POINTS, sizeof *normals);
  sbf_vec2 *coordinates = allocate(asset, POINTS, sizeof *coordinates);
  uint32_t *sizes = allocate(asset, QUADS, sizeof *sizes), random = 1;
  uint32_t *corners = allocate(asset, 4 * (size_t)QUADS, sizeof *corners);
  for (uint32_t i = 0; i < ROW; i++)
    for (uint32_t j = 0; j < ROW; j++) {
      uint32_t at = i * ROW + j;
      double u = 2 * PI * i / CELLS, w = PI * j / CELLS;
      random = random * 1664525u + 1013904223u;
      double radius = 1 + 0.2 * sin(7 * u) * cos(5 * w) + 1e-3 * (random >> 8) / 16777216.0;
      sbf_vec3 n = {(float)(cos(u) * sin(w)), (float)cos(w), (float)(sin(u) * sin(w))};
      normals[at] = n;
      positions[at] = (sbf_vec3){(float)radius * n.x, (float)radius * n.y, (float)radius * n.z};
      coordinates[at] = (sbf_vec2){(float)i / CELLS, (float)j / CELLS};
    }
  for (uint32_t i = 0; i < CELLS; i++)
    for (uint32_t j = 0; j < CELLS; j++) {
      uint32_t quad = i * CELLS + j, first = i * ROW + j;
      const uint32_t around[4] = {first, first + ROW, first + ROW + 1, first + 1};
      sizes[quad] = 4;
      for (uint32_t k = 0; k < 4; k++) corners[4 * quad + k] = around[k];
    }
  sbf_uv_set *uv_set = allocate(asset, 1, sizeof *uv_set);
  sbf_uv_set_init(uv_set);
  uv_set->coordinates = (sbf_vec2_list){coordinates, POINTS};
  sbf_render_mesh *mesh = allocate(asset, 1, sizeof *mesh);
  sbf_render_mesh_init(mesh);
  mesh->id = "surface";
  mesh->mesh.target = SBF_MESH_TARGET_RENDERING;
  mesh->mesh.positions = (sbf_vec3_list){positions, POINTS};
  mesh->mesh.polygon_sizes = (sbf_u32_list){sizes, QUADS};
  mesh->mesh.polygon_points = (sbf_u32_list){corners, 4 * QUADS};
  mesh->normals = (sbf_vec3_list){normals, POINTS};
  mesh->uv_sets = (sbf_uv_set_list){uv_set, 1};
  asset->render_meshes = (sbf_render_mesh_list){mesh, 1};
  *list_bytes = POINTS * 32.0 + QUADS * 20.0;
  return asset;
}

typedef struct counter {
  sbf_allocator allocator;
  size_t held, most;
} counter;

static void *count(void *user, void *memory, size_t old_size, size_t new_size) {
  counter *c = user;
  if (!memory) old_size = 0;
  void *moved = new_size ? realloc(memory, new_size) : (free(memory), NULL);
  if (moved || !new_size) c->held += new_size - old_size;
  if (c->held > c->most) c->most = c->held;
  return moved;
}

static void require(sbf_status status, const sbf_diagnostic *error) {
  if (status == SBF_OK) return;
  fprintf(stderr, "bench_packed: %s\n", error->message);
  exit((int)status);
}

static void measure_load(const char *path, const char *codec, bool check_crc, bool copy, double list_bytes) {
  double best = INFINITY;
  counter c = {.held = 0};
  c.allocator = (sbf_allocator){count, &c};
  for (int i = 0; i < RUNS; i++) {
    const sbf_load_options options = {.allocator = &c.allocator, .check_crc = check_crc, .copy_file = copy};
    sbf_asset *asset;
    sbf_diagnostic error;
    double begin = seconds();
    require(sbf_packed_load_file(path, &options, &asset, &error), &error);
    best = fmin(best, seconds() - begin);
    sbf_asset_free(asset);
  }
  printf("load,%s,%s,%s,%.3f,%.0f,%zu\n", codec, check_crc ? "yes" : "no", copy ? "read" : "mapped",
      best * 1e3, list_bytes / best / 1e6, c.most);
}

int main(int argument_count, char **arguments) {
  const char *path = argument_count > 1 ? arguments[1] : "bench_packed.sbfz";
  double list_bytes;
  sbf_asset *asset = make_asset(&list_bytes);
  printf("what,codec,crc,file,milliseconds,MB/s,allocated_bytes\n");
  for (int store = 1; store >= 0; store--) {
    const char *codec = store ? "stored" : "zlib";
    double best = INFINITY;
    for (int i = 0; i < 3; i++) {
      sbf_diagnostic error;
      double begin = seconds();
      require(sbf_packed_save_file(asset, path, &(sbf_save_options){.store = store}, &error), &error);
      best = fmin(best, seconds() - begin);
    }
    FILE *file = fopen(path, "rb");
    if (!file || fseek(file, 0, SEEK_END) != 0) return 2;
    printf("save,%s,made,%ld bytes,%.3f,%.0f,\n", codec, ftell(file), best * 1e3, list_bytes / best / 1e6);
    fclose(file);
    for (int mode = 0; mode < 4; mode++) measure_load(path, codec, mode & 1, mode & 2, list_bytes);
  }
  remove(path);
  sbf_asset_free(asset);
  return 0;
}
