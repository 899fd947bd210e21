/* Measures loading: time and memory of each form of an asset, with all checks. References: assimp's import of
 * the same geometry as GLB and OBJ, without post-processing, and libxml2's tree of the same XML.
 *
 * Files are in the page cache. `times_glb` is assimp's median time for the GLB over the median of the row.
 * `lizard` also contains a rig and simulation data, which GLB and OBJ do not have; `lizard-meshes` has the
 * content of those only. */
#define _POSIX_C_SOURCE 200809L
#include <assimp/cimport.h>
#include <assimp/scene.h>
#include <libxml/parser.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

#include "measured_assets.h"
#include "measuring.h"
#include "peer_files.h"
#include "process_memory.h"
#include "sbfmt/io.h"

enum { BASE_SIZE = 512, PATH_SIZE = BASE_SIZE + 16 };

typedef enum form { XML, ZLIB, STORED, GLB, OBJ, FORM_COUNT } form;
static const char *const endings[FORM_COUNT] = {"xml.sbf", "zlib.sbfz", "stored.sbfz", "glb", "obj"};

/* ---- Ways to load ---- */

/* One method to load one file, and the memory in use while it is loaded. */
typedef struct loading {
  char path[PATH_SIZE];
  sbf_load_options options;
  void *retained;
} loading;

static void load(void *context) {
  loading *l = context;
  sbf_asset *asset;
  sbf_diagnostic error;
  bench_require(sbf_load_file(l->path, &l->options, &asset, &error), &error);
  l->retained = asset;
}
static void unload(void *context) {
  sbf_asset_free(((loading *)context)->retained);
}

static void load_by_assimp(void *context) {
  loading *l = context;
  const struct aiScene *scene = aiImportFile(l->path, 0);
  if (!scene || !scene->mNumMeshes) bench_fail("assimp does not read %s: %s", l->path, aiGetErrorString());
  l->retained = (void *)(uintptr_t)scene;
}
static void unload_by_assimp(void *context) {
  aiReleaseImport(((loading *)context)->retained);
}

static void load_as_tree(void *context) {
  loading *l = context;
  l->retained = xmlReadFile(l->path, NULL, XML_PARSE_HUGE | XML_PARSE_NONET);
  if (!l->retained) bench_fail("libxml2 does not read %s", l->path);
}
static void unload_tree(void *context) {
  xmlFreeDoc(((loading *)context)->retained);
}

typedef struct method {
  const char *reader, *form, *crc, *file; /* as the table names them */
  form of;
  bool check_crc, copy_file;
  void (*load)(void *context), (*unload)(void *context);
} method;

static const method methods[] = {
    {"sbfmt", "xml", "", "read", XML, false, false, load, unload},
    {"sbfmt", "zlib", "no", "mapped", ZLIB, false, false, load, unload},
    {"sbfmt", "zlib", "yes", "mapped", ZLIB, true, false, load, unload},
    {"sbfmt", "stored", "no", "mapped", STORED, false, false, load, unload},
    {"sbfmt", "stored", "yes", "mapped", STORED, true, false, load, unload},
    {"sbfmt", "stored", "yes", "read", STORED, true, true, load, unload},
    {"libxml2 tree", "xml", "", "read", XML, false, false, load_as_tree, unload_tree},
    {"assimp", "glb", "", "read", GLB, false, false, load_by_assimp, unload_by_assimp},
    {"assimp", "obj", "", "read", OBJ, false, false, load_by_assimp, unload_by_assimp},
};
enum { METHOD_COUNT = sizeof methods / sizeof *methods, ASSIMP_GLB = 7 };

static void path_of(char path[PATH_SIZE], const char *base, form of) {
  int length = snprintf(path, PATH_SIZE, "%s.%s", base, endings[of]);
  if (length < 0 || length >= PATH_SIZE) bench_fail("%s is too long a path", base);
}

static void prepare(loading *l, const char *base, const method *w) {
  *l = (loading){.options = {.check_crc = w->check_crc, .copy_file = w->copy_file}};
  path_of(l->path, base, w->of);
}

/* ---- Measuring ---- */

/* What the child does: loads the file `arguments[0]` in the way of number `arguments[1]`, and keeps it. */
static void load_in_child(char **arguments) {
  static loading l;
  const method *w = &methods[strtoul(arguments[1], NULL, 10)];
  prepare(&l, arguments[0], w);
  w->load(&l);
}

static void write_files(const sbf_asset *asset, const char *base) {
  char path[PATH_SIZE];
  sbf_diagnostic error;
  for (int f = 0; f < FORM_COUNT; f++) {
    path_of(path, base, (form)f);
    const sbf_save_options options = {.store = f == STORED};
    if (f == GLB)
      write_glb(path, asset);
    else if (f == OBJ)
      write_obj(path, asset);
    else
      bench_require(sbf_save_file(asset, path, &options, &error), &error);
  }
}

static void remove_files(const char *base) {
  char path[PATH_SIZE];
  for (int f = 0; f < FORM_COUNT; f++) {
    path_of(path, base, (form)f);
    remove(path);
  }
}

static void measure(const char *name, sbf_asset *asset, const char *folder, uint32_t rounds) {
  char base[BASE_SIZE];
  loading loadings[METHOD_COUNT];
  bench_case cases[METHOD_COUNT];
  uint32_t vertices = vertex_count_of(asset);
  snprintf(base, sizeof base, "%s/%s", folder, name);
  write_files(asset, base);
  sbf_asset_free(asset);
  for (int i = 0; i < METHOD_COUNT; i++) {
    prepare(&loadings[i], base, &methods[i]);
    cases[i] = (bench_case){.run = methods[i].load, .after = methods[i].unload, .context = &loadings[i]};
  }
  bench_rounds(cases, METHOD_COUNT, rounds);
  for (int i = 0; i < METHOD_COUNT; i++) {
    char number[12];
    snprintf(number, sizeof number, "%d", i);
    process_memory memory = process_memory_of((const char *const[]){base, number, NULL});
    size_t bytes = file_size_of(loadings[i].path);
    const bench_spread *s = &cases[i].s;
    bench_print_row("%s,%u,%s,%s,%s,%s,%zu,%u,%.4f,%.4f,%.4f,%.1f,%.3f,%zu,%zu", name, vertices,
        methods[i].reader, methods[i].form, methods[i].crc, methods[i].file, bytes, rounds, s->min * 1e3,
        s->median * 1e3, s->max * 1e3, (double)bytes / s->median / 1e6,
        cases[ASSIMP_GLB].s.median / s->median, memory.peak_bytes / 1024, memory.private_bytes / 1024);
  }
  remove_files(base);
}

int main(int argument_count, char **arguments) {
  process_memory_work(argument_count, arguments, load_in_child);
  bool quick = bench_is_quick(argument_count, arguments);
  uint32_t rounds = quick ? 2 : 41;
  char folder[] = "/tmp/bench_load_XXXXXX";
  if (!mkdtemp(folder)) bench_fail("no folder can be made in /tmp");
  bench_print_columns(
      "asset,vertices,reader,form,crc,file,bytes,rounds,least_ms,median_ms,most_ms,MB/s,times_glb,"
      "peak_KiB,private_KiB");
  measure("surface", surface_asset(quick ? 20 : SURFACE_CELLS), folder, rounds);
  measure("lizard-meshes", meshes_alone(our_lizard(false)), folder, rounds);
  measure("lizard", our_lizard(true), folder, rounds);
  rmdir(folder);
  return 0;
}
