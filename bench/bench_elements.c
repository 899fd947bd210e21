/* Measures the size of lattice elements in bytes for several cell sizes: a body's tetrahedra as XML, with
 * tags, and as a chunk of the packed file; and the whole bundles. Bodies: our lizard, with a lattice for each
 * section (sums are shown), and surfaces of ../shared/data if that folder exists. */
#include <stdio.h>
#include <string.h>

#include "measured_assets.h"
#include "measuring.h"
#include "sbfmt/build.h"
#include "sbfmt/io.h"

/* Where a packed file says what: sections 2 and 3 of spec/packed.md. */
enum { TABLE_OFFSET = 24, ENTRIES = 40, ENTRY = 64, OWNER = 4, STRIDE = 20, STORED_SIZE = 32, RAW_SIZE = 40 };

static uint64_t little_endian(const uint8_t *at, int size) {
  uint64_t value = 0;
  for (int i = size - 1; i >= 0; i--) value = value << 8 | at[i];
  return value;
}

static const sbf_tetrahedron_mesh *lattice_of(const sbf_soft_body *body) {
  return body->levels.count ? &body->levels.at[0].lattice : NULL;
}

/* Stored bytes of the chunk with the tetrahedra of a level of body `owner`: no other list there has items of
 * sixteen bytes and that length. 0 where there is none, as for a short one that stands in a record. */
static uint64_t chunk_of(const sbf_buffer *file, uint32_t owner, uint64_t tetrahedra) {
  const uint8_t *bytes = file->at, *table = bytes + little_endian(bytes + TABLE_OFFSET, 8);
  uint64_t count = little_endian(bytes + ENTRIES, 4);
  for (uint64_t i = 0; i < count; i++, table += ENTRY)
    if (memcmp(table, "LEVL", 4) == 0 && little_endian(table + OWNER, 4) == owner &&
        little_endian(table + RAW_SIZE, 8) == 16 * tetrahedra && little_endian(table + STRIDE, 4) == 16)
      return little_endian(table + STORED_SIZE, 8);
  return 0;
}

static uint64_t text_of_tetrahedra(const sbf_buffer *xml) {
  static const char begin[] = "<tetrahedra", end[] = "</tetrahedra>";
  uint64_t size = 0;
  const char *at = (const char *)xml->at, *last = at + xml->size;
  while (at < last) {
    const char *first = memchr(at, '<', (size_t)(last - at));
    if (!first) break;
    at = first + 1;
    if ((size_t)(last - first) < sizeof begin || memcmp(first, begin, sizeof begin - 1) != 0) continue;
    while ((size_t)(last - at) >= sizeof end && memcmp(at, end, sizeof end - 1) != 0) at++;
    size += (uint64_t)(at - first) + sizeof end - 1;
  }
  return size;
}

/* Frees the asset. */
static void measure(const char *name, sbf_asset *source, double cell_m) {
  const sbf_build_options options = {.interior = SBF_BUILD_INTERIOR_TETRAHEDRA, .cell_m = cell_m};
  sbf_asset *built;
  sbf_buffer xml, packed;
  sbf_diagnostic error;
  uint64_t tetrahedra = 0, points = 0, chunks = 0;
  bench_require(sbf_build(source, &options, &built, NULL, &error), &error);
  sbf_asset_free(source);
  bench_require(sbf_xml_save_memory(built, NULL, NULL, &xml, &error), &error);
  bench_require(sbf_packed_save_memory(built, NULL, NULL, &packed, &error), &error);
  for (uint32_t i = 0; i < built->soft_bodies.count; i++) {
    const sbf_tetrahedron_mesh *lattice = lattice_of(&built->soft_bodies.at[i]);
    if (!lattice || !lattice->tetrahedra.count) continue;
    tetrahedra += lattice->tetrahedra.count;
    points += built->soft_bodies.at[i].levels.at[0].positions.count;
    chunks += chunk_of(&packed, i, lattice->tetrahedra.count);
  }
  uint64_t text = text_of_tetrahedra(&xml);
  if (!chunks || !text) bench_fail("%s: no list of tetrahedra is large enough to be a chunk", name);
  bench_print_row("%s,%g,%llu,%llu,%llu,%llu,%.1f,%zu,%zu,%.3f", name, cell_m, (unsigned long long)points,
      (unsigned long long)tetrahedra, (unsigned long long)text, (unsigned long long)chunks,
      (double)text / (double)chunks, xml.size, packed.size, (double)packed.size / (double)xml.size);
  sbf_buffer_free(&xml);
  sbf_buffer_free(&packed);
  sbf_asset_free(built);
}

int main(int argument_count, char **arguments) {
  static const struct {
    const char *folder, *mesh;
    double cells_m[3];
  } surfaces[] = {
      {SHARED_FOLDER "/spot", "spot.obj", {0.08, 0.04, 0.02}},
      {SHARED_FOLDER "/bunny", "bunny_902.obj", {0.08, 0.04, 0.02}},
      {SHARED_FOLDER "/armadillo", "armadillo_25k.obj", {0.5, 0.25, 0.125}},
  };
  bench_print_columns(
      "file,cell_m,points,tetrahedra,elements_xml,elements_packed,elements_xml/elements_packed,"
      "xml,packed,packed/xml");
  measure("our lizard", our_lizard(false), 0.02);
  if (bench_is_quick(argument_count, arguments)) return 0;
  for (size_t i = 0; i < sizeof surfaces / sizeof *surfaces; i++)
    for (int k = 0; k < 3; k++) {
      sbf_asset *source = character_asset(surfaces[i].folder, surfaces[i].mesh, NULL, false);
      if (source) measure(surfaces[i].mesh, source, surfaces[i].cells_m[k]);
    }
  return 0;
}
