/* Measures the size of a character's bundle in each form: our lizard, the surface of bench_load, and every
 * convertible file of ../shared/data if that folder exists.
 *
 * `xml`, `gzip` (of the XML, by `gzip -6`), `packed` (zlib) and `stored` contain the whole bundle of
 * `convert` with springs, pins, hulls and embeddings. `meshes` is the packed form of the render meshes only,
 * and `glb` a GLB of them: positions, normals, texture coordinates, and triangles for the polygons. All are
 * in bytes; the last three columns are ratios. */
#define _XOPEN_SOURCE 700
#include <ftw.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>
#include <zlib.h>

#include "measured_assets.h"
#include "measuring.h"
#include "peer_files.h"
#include "sbfmt/build.h"
#include "sbfmt/convert.h"
#include "sbfmt/io.h"

static size_t gzip_size_of(const sbf_buffer *from) {
  z_stream stream = {.next_in = from->at, .avail_in = (uInt)from->size};
  if (deflateInit2(&stream, 6, Z_DEFLATED, 15 + 16, 8, Z_DEFAULT_STRATEGY) != Z_OK)
    bench_fail("memory ran out");
  uLong capacity = deflateBound(&stream, (uLong)from->size);
  stream.next_out = bench_allocate(capacity, 1);
  stream.avail_out = (uInt)capacity;
  Bytef *begin = stream.next_out;
  if (deflate(&stream, Z_FINISH) != Z_STREAM_END) bench_fail("zlib cannot compress");
  size_t size = stream.total_out;
  deflateEnd(&stream);
  free(begin);
  return size;
}

static size_t packed_size_of(const sbf_asset *asset, bool store) {
  sbf_buffer saved;
  sbf_diagnostic error;
  bench_require(
      sbf_packed_save_memory(asset, &(sbf_save_options){.store = store}, NULL, &saved, &error), &error);
  size_t size = saved.size;
  sbf_buffer_free(&saved);
  return size;
}

static size_t glb_size_of(const sbf_asset *asset) {
  char path[] = "/tmp/bench_size_XXXXXX";
  int handle = mkstemp(path);
  if (handle < 0) bench_fail("no file can be made in /tmp");
  close(handle);
  write_glb(path, asset);
  size_t size = file_size_of(path);
  remove(path);
  return size;
}

/* Frees the asset. */
static void measure(const char *name, sbf_asset *asset) {
  sbf_buffer xml;
  sbf_diagnostic error;
  uint32_t points, springs, vertices = vertex_count_of(asset), polygons = polygon_count_of(asset);
  count_elements(asset, &points, &springs);
  bench_require(sbf_xml_save_memory(asset, NULL, NULL, &xml, &error), &error);
  size_t gzip = gzip_size_of(&xml), packed = packed_size_of(asset, false),
         stored = packed_size_of(asset, true);
  asset = meshes_alone(asset);
  size_t meshes = packed_size_of(asset, false), glb = glb_size_of(asset);
  bench_print_row("%s,%u,%u,%u,%zu,%zu,%zu,%zu,%zu,%zu,%.3f,%.3f,%.3f", name, vertices, polygons, springs,
      xml.size, gzip, packed, stored, meshes, glb, (double)packed / (double)xml.size,
      (double)packed / (double)gzip, (double)meshes / (double)glb);
  sbf_buffer_free(&xml);
  sbf_asset_free(asset);
}

/* ---- The shared folder ---- */

enum { MAX_FILES = 256, PATH_SIZE = 1024 };
static char found[MAX_FILES][PATH_SIZE];
static int found_count;

static int note_file(const char *path, const struct stat *about, int kind, struct FTW *position) {
  (void)about, (void)position;
  if (kind == FTW_F && found_count < MAX_FILES && strlen(path) < PATH_SIZE)
    strcpy(found[found_count++], path);
  return 0;
}

static int compare(const void *a, const void *b) {
  return strcmp(a, b);
}

/* Materials and notes beside the models. */
static bool is_aside(const char *path) {
  const char *dot = strrchr(path, '.');
  return !dot || strcmp(dot, ".mtl") == 0 || strcmp(dot, ".md") == 0;
}

static void measure_file(const char *path) {
  const char *name = path + strlen(SHARED_FOLDER) + 1;
  /* The one that needs another file's skeleton. */
  bool has_rig = strcmp(name, "lizard/liz.obj") == 0;
  const sbf_convert_options options = {.rig = has_rig ? SHARED_FOLDER "/lizard/liz.fbx" : NULL};
  sbf_asset *asset, *built;
  sbf_diagnostic error;
  if (sbf_convert(path, &options, &asset, &error) != SBF_OK) {
    fprintf(stderr, "bench_size: %s does not convert: %s\n", name, error.message);
    return;
  }
  bench_require(sbf_build(asset, NULL, &built, NULL, &error), &error);
  sbf_asset_free(asset);
  if (vertex_count_of(built))
    measure(name, built);
  else
    sbf_asset_free(built);
}

int main(int argument_count, char **arguments) {
  bool quick = bench_is_quick(argument_count, arguments);
  bench_print_columns(
      "file,vertices,polygons,springs,xml,gzip,packed,stored,meshes,glb,packed/xml,packed/gzip,"
      "meshes/glb");
  measure("our lizard", our_lizard(true));
  measure("surface of bench_load", surface_asset(SURFACE_CELLS));
  if (quick) return 0;
  if (access(SHARED_FOLDER, R_OK) != 0 || nftw(SHARED_FOLDER, note_file, 16, FTW_PHYS) != 0)
    fprintf(stderr, "bench_size: ../shared/data is not there: only our own is measured\n");
  qsort(found, (size_t)found_count, sizeof *found, compare);
  for (int i = 0; i < found_count; i++)
    if (!is_aside(found[i])) measure_file(found[i]);
  return 0;
}
