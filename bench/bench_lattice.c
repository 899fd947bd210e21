/* Measures the making of lattices by number of tetrahedra, from a converted surface to a level with
 * embeddings (inside test, stuffing, embedding, and the rest of a build, without calibration): tetrahedra per
 * second, smallest and largest dihedral angle, fraction of the surface's volume in the lattice, largest
 * distance of vertices outside it, and memory.
 *
 * If the program tetgen is installed, it meshes the same surface with its quality bounds and the mean volume
 * of our tetrahedra. Its time is the one that it prints, without its files. It keeps the polygons of the
 * surface, which a lattice does not, and refuses surfaces that are open or intersect themselves. */
#define _DEFAULT_SOURCE /* mkstemps */
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/wait.h>
#include <time.h>
#include <unistd.h>

#include "measured_assets.h"
#include "measuring.h"
#include "process_memory.h"
#include "sbfmt/build.h"
#include "sbfmt/mechanics.h"

static const struct {
  const char *folder, *mesh;
  bool closed;
} surfaces[] = {
    {SHARED_FOLDER "/spot", "spot.obj", true},
    {SHARED_FOLDER "/bunny", "bunny_902.obj", true},
    {SHARED_FOLDER "/armadillo", "armadillo_25k.obj", true},
    {SHARED_FOLDER "/soup", "suzanne.obj", false},
    {SHARED_FOLDER "/soup", "spider.obj", false},
    {SHARED_FOLDER "/bunny", "bunny_holes.obj", false},
};
enum { SURFACE_COUNT = sizeof surfaces / sizeof *surfaces };

/* Mesh after mesh, points and polygons. */
static void append_mesh(sbf_asset *asset, sbf_polygon_mesh *to, const sbf_polygon_mesh *from) {
  uint32_t points = to->positions.count, sizes = to->polygon_sizes.count, corners = to->polygon_points.count;
  sbf_vec3 *positions = sbf_asset_allocate(asset, (size_t)points + from->positions.count, sizeof *positions);
  uint32_t *all_sizes =
      sbf_asset_allocate(asset, (size_t)sizes + from->polygon_sizes.count, sizeof *all_sizes);
  uint32_t *all = sbf_asset_allocate(asset, (size_t)corners + from->polygon_points.count, sizeof *all);
  if (!positions || !all_sizes || !all) bench_fail("memory ran out");
  memcpy(positions, to->positions.at, points * sizeof *positions);
  memcpy(positions + points, from->positions.at, from->positions.count * sizeof *positions);
  memcpy(all_sizes, to->polygon_sizes.at, sizes * sizeof *all_sizes);
  memcpy(all_sizes + sizes, from->polygon_sizes.at, from->polygon_sizes.count * sizeof *all_sizes);
  memcpy(all, to->polygon_points.at, corners * sizeof *all);
  for (uint32_t i = 0; i < from->polygon_points.count; i++)
    all[corners + i] = points + from->polygon_points.at[i];
  to->positions = (sbf_vec3_list){positions, points + from->positions.count};
  to->polygon_sizes = (sbf_u32_list){all_sizes, sizes + from->polygon_sizes.count};
  to->polygon_points = (sbf_u32_list){all, corners + from->polygon_points.count};
}

/* A source of one body. Its surface is the render mesh of the file. */
static sbf_asset *one_body_of(unsigned number) {
  sbf_asset *from = character_asset(surfaces[number].folder, surfaces[number].mesh, NULL, false);
  if (!from || from->soft_bodies.count == 0) return NULL;
  sbf_asset *source = sbf_asset_create(NULL);
  sbf_soft_body *body = source ? sbf_asset_allocate(source, 1, sizeof *body) : NULL;
  sbf_render_mesh *mesh = body ? sbf_asset_allocate(source, 1, sizeof *mesh) : NULL;
  if (!mesh) bench_fail("memory ran out");
  sbf_soft_body_init(body);
  sbf_render_mesh_init(mesh);
  body->id = body->name = "body";
  mesh->id = mesh->name = "skin";
  for (uint32_t i = 0; i < from->soft_bodies.count; i++)
    append_mesh(source, &body->surface, &from->soft_bodies.at[i].surface);
  mesh->mesh = body->surface;
  mesh->mesh.target = SBF_MESH_TARGET_RENDERING;
  source->soft_bodies = (sbf_soft_body_list){body, 1};
  source->render_meshes = (sbf_render_mesh_list){mesh, 1};
  sbf_asset_free(from);
  return source;
}

typedef struct stuffing {
  const sbf_asset *source;
  sbf_build_options options;
  sbf_build_report report;
  double begin_s, end_s; /* of the pass */
  double cell;           /* m, of the lattice made */
} stuffing;

static double processor_s(void) {
  struct timespec now;
  clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &now);
  return (double)now.tv_sec + 1e-9 * (double)now.tv_nsec;
}

static bool note_pass(void *user, const char *pass, double done) {
  stuffing *s = user;
  (void)done;
  if (s->begin_s == 0 && strcmp(pass, "levels") == 0) s->begin_s = processor_s();
  if (strcmp(pass, "the check of the result") == 0) s->end_s = processor_s();
  return true;
}

static void stuff(stuffing *s) {
  sbf_asset *made;
  sbf_diagnostic error;
  s->begin_s = s->end_s = 0;
  s->options.progress = note_pass;
  s->options.user = s;
  bench_require(sbf_build(s->source, &s->options, &made, &s->report, &error), &error);
  if (!(s->begin_s > 0) || !(s->end_s > 0))
    bench_fail("the build tells of other passes than are measured here");
  s->cell = (double)made->soft_bodies.at[0].levels.at[0].cell;
  sbf_asset_free(made);
}

/* What the child does: surface number `arguments[0]` at a cell of `arguments[1]` metres. */
static void stuff_in_child(char **arguments) {
  static stuffing s;
  unsigned long number = strtoul(arguments[0], NULL, 10) % SURFACE_COUNT;
  s.source = one_body_of((unsigned)number);
  s.options.interior = SBF_BUILD_INTERIOR_TETRAHEDRA;
  s.options.cell_m = strtod(arguments[1], NULL);
  s.options.without_calibration = true;
  stuff(&s);
}

static void write_off(const char *path, const sbf_polygon_mesh *mesh) {
  FILE *file = fopen(path, "w");
  if (!file) bench_fail("%s cannot be written", path);
  fprintf(file, "OFF\n%u %u 0\n", mesh->positions.count, mesh->polygon_sizes.count);
  for (uint32_t i = 0; i < mesh->positions.count; i++) {
    sbf_vec3 p = mesh->positions.at[i];
    fprintf(file, "%.9g %.9g %.9g\n", (double)p.x, (double)p.y, (double)p.z);
  }
  const uint32_t *corners = mesh->polygon_points.at;
  for (uint32_t p = 0; p < mesh->polygon_sizes.count; p++) {
    fprintf(file, "%u", mesh->polygon_sizes.at[p]);
    for (uint32_t k = 0; k < mesh->polygon_sizes.at[p]; k++) fprintf(file, " %u", *corners++);
    fputc('\n', file);
  }
  fclose(file);
}

/* False where tetgen is absent; no tetrahedra where it makes nothing of the surface. */
static bool run_tetgen(const char *off, double volume, double *seconds, unsigned long *count) {
  char command[512], line[256];
  snprintf(command, sizeof command, "tetgen -pqNEFBa%.9g %s 2>/dev/null", volume, off);
  FILE *said = popen(command, "r");
  *seconds = 0;
  *count = 0;
  if (!said) return false;
  while (fgets(line, sizeof line, said)) {
    const char *value = strchr(line, ':');
    if (value && strncmp(line, "Total running seconds", 21) == 0) *seconds = strtod(value + 1, NULL);
    if (value && strstr(line, "Mesh tetrahedra:")) *count = strtoul(value + 1, NULL, 10);
  }
  int status = pclose(said);
  if (status != 0) *count = 0;
  return !(WIFEXITED(status) && WEXITSTATUS(status) == 127);
}

static void measure_tetgen(unsigned number, const sbf_soft_body *body, const stuffing *s) {
  char path[] = "/tmp/bench_lattice_XXXXXX.off";
  double seconds;
  unsigned long count;
  int file = mkstemps(path, 4);
  if (file < 0) bench_fail("no file can be made in /tmp");
  close(file);
  write_off(path, &body->surface);
  if (!run_tetgen(path, s->report.lattices.volume / s->report.lattices.tetrahedra, &seconds, &count))
    fprintf(stderr, "tetgen is not installed\n");
  else if (count == 0)
    bench_print_row("%s,tetgen,,1,,,,,,,,,", surfaces[number].mesh);
  else
    bench_print_row("%s,tetgen,%lu,1,%.2f,%.2f,,%.0f,,,,,", surfaces[number].mesh, count, seconds * 1e3,
        seconds * 1e3, (double)count / seconds);
  unlink(path);
}

static void measure(unsigned number, uint32_t elements, uint32_t rounds, bool beside) {
  rounds = bench_round_count(rounds);
  sbf_asset *source = one_body_of(number);
  if (!source) return;
  const sbf_soft_body *body = &source->soft_bodies.at[0];
  sbf_surface_measures surface;
  sbf_surface_measure(&body->surface, NULL, &surface);
  stuffing s = {.source = source,
      .options = {
          .interior = SBF_BUILD_INTERIOR_TETRAHEDRA, .elements = elements, .without_calibration = true}};
  stuff(&s);
  /* The cell that gives so many is named from here on, so that nothing is tried. */
  s.options.elements = 0;
  s.options.cell_m = s.cell;
  enum { MAX_ROUNDS = 15 };
  double pass[MAX_ROUNDS], whole[MAX_ROUNDS];
  stuff(&s);
  for (uint32_t r = 0; r < rounds; r++) {
    double begin = processor_s();
    stuff(&s);
    whole[r] = processor_s() - begin;
    pass[r] = s.end_s - s.begin_s;
  }
  bench_spread of_pass = bench_spread_of(pass, rounds), of_whole = bench_spread_of(whole, rounds);
  char name[12], size[40];
  snprintf(name, sizeof name, "%u", number);
  snprintf(size, sizeof size, "%.17g", s.cell);
  char volume[24] = "";
  if (surface.opening < 1e-3)
    snprintf(volume, sizeof volume, "%.4f", s.report.lattices.volume / fabs(surface.volume));
  process_memory memory = process_memory_of((const char *const[]){name, size, NULL});
  bench_print_row("%s,sbfmt,%u,%u,%.2f,%.2f,%.2f,%.0f,%.1f,%.1f,%s,%.3g,%zu", surfaces[number].mesh,
      s.report.lattices.tetrahedra, rounds, of_pass.min * 1e3, of_pass.median * 1e3, of_whole.median * 1e3,
      s.report.lattices.tetrahedra / of_pass.median, s.report.lattices.min_dihedral_deg,
      s.report.lattices.max_dihedral_deg, volume, s.report.lattices.farthest_m / s.cell,
      memory.peak_bytes / 1024);
  if (beside && surfaces[number].closed) measure_tetgen(number, body, &s);
  sbf_asset_free(source);
}

int main(int argument_count, char **arguments) {
  process_memory_work(argument_count, arguments, stuff_in_child);
  bool quick = bench_is_quick(argument_count, arguments);
  bench_print_columns(
      "surface,by,tetrahedra,rounds,least_ms,median_ms,build_ms,tetrahedra/s,least_deg,most_deg,volume,"
      "farthest_cells,peak_KiB");
  for (unsigned i = 0; i < SURFACE_COUNT; i++) {
    measure(i, 2000, 15, false);
    if (quick) continue;
    measure(i, 20000, 9, true);
    measure(i, 200000, 5, true);
    measure(i, 1000000, 3, false);
  }
  return 0;
}
