/* fuzz_seeds FOLDER: writes good files of each form below FOLDER, for a fuzzer to start from. The short ones
 * of text stand in corpus/. */
#include <string.h>
#include <sys/stat.h>

#include "fill_asset.h"
#include "fuzz.h"
#include "harness.h"
#include "model/schema.h"
#include "packed/packed_codec.h"
#include "sbfmt/build.h"
#include "sbfmt/export.h"
#include "shapes.h"
#include "small_asset.h"
#include "stream_builder.h"

static void put_in(const char *folder, const char *target, const char *name, const void *bytes, size_t size) {
  char path[1024];
  snprintf(path, sizeof path, "%s/%s", folder, target);
  mkdir(folder, 0777);
  mkdir(path, 0777);
  snprintf(path, sizeof path, "%s/%s/%s", folder, target, name);
  FUZZ_MUST(harness_write(path, bytes, size));
}

static void put(const char *folder, const char *const *targets, const char *name, const sbf_buffer *bytes) {
  for (; *targets; targets++) put_in(folder, *targets, name, bytes->at, bytes->size);
}

static void put_forms(const char *folder, const char *name, const sbf_asset *asset) {
  static const char *const of_packed[] = {"packed", "table", "validate", "build", "run", NULL};
  static const char *const of_xml[] = {"xml", "validate", "build", "run", NULL};
  char full[64];
  for (int store = 0; store < 2; store++) {
    sbf_buffer bytes = {0};
    sbf_save_options options = {.store = store};
    snprintf(full, sizeof full, "%s%s.sbfz", name, store ? "_stored" : "");
    FUZZ_MUST(sbf_packed_save_memory(asset, &options, NULL, &bytes, NULL) == SBF_OK);
    put(folder, of_packed, full, &bytes);
    sbf_buffer_free(&bytes);
  }
  sbf_buffer bytes = {0};
  snprintf(full, sizeof full, "%s.sbf", name);
  FUZZ_MUST(sbf_xml_save_memory(asset, NULL, NULL, &bytes, NULL) == SBF_OK);
  put(folder, of_xml, full, &bytes);
  sbf_buffer_free(&bytes);
}

static void put_glb(const char *folder, const char *name, const sbf_asset *asset) {
  char path[1024];
  snprintf(path, sizeof path, "%s/gltf", folder);
  mkdir(path, 0777);
  snprintf(path, sizeof path, "%s/gltf/%s.glb", folder, name);
  FUZZ_MUST(sbf_export(asset, path, &(sbf_export_options){.soft_bodies = true}, NULL) == SBF_OK);
}

/* Of so many chunks that there is an outline: long, so it is for those alone that read one. */
static void put_outlined(const char *folder, const sbf_asset *asset) {
  static const char *const targets[] = {"packed", "table", NULL};
  sbf_buffer bytes = {0};
  sbf_save_options options = {.store = true};
  FUZZ_MUST(sbf_packed_save_memory(asset, &options, NULL, &bytes, NULL) == SBF_OK);
  put(folder, targets, "outlined.sbfz", &bytes);
  sbf_buffer_free(&bytes);
}

/* The inputs with the most work for a build: a closed section on a bone, and an unpinned sheet. */
static sbf_asset *bodies_to_build(void) {
  sbf_asset *asset = sbf_asset_create(NULL);
  FUZZ_MUST(asset);
  sbf_polygon_mesh cube = shape_cube(asset, 2, 1, (sbf_vec3){0, 1, 0}), sheet = shape_sheet(asset, 2, 2);
  shape_add_body(asset, "cube", &cube, true);
  shape_add_body(asset, "sheet", &sheet, false);
  return asset;
}

/* The same bodies, built to be simulated: a file for each kind of interior. */
static void put_built(const char *folder, const sbf_asset *bodies) {
  static const char *const targets[] = {"run", NULL};
  for (int interior = 0; interior <= SBF_BUILD_INTERIOR_TETRAHEDRA; interior++) {
    const sbf_build_options options = {
        .interior = (sbf_build_interior)interior, .elements = 60, .without_calibration = true};
    sbf_build_report report;
    sbf_asset *built = NULL;
    sbf_buffer bytes = {0};
    char name[32];
    FUZZ_MUST(sbf_build(bodies, &options, &built, &report, NULL) == SBF_OK);
    FUZZ_MUST(sbf_xml_save_memory(built, NULL, NULL, &bytes, NULL) == SBF_OK);
    snprintf(name, sizeof name, "built_%d.sbf", interior);
    put(folder, targets, name, &bytes);
    sbf_buffer_free(&bytes);
    sbf_asset_free(built);
  }
}

/* A stream of each filter, behind the bytes that fuzz_inflate takes for its arguments. */
static void put_chunks(const char *folder) {
  enum { ITEMS = 40, WIDTH = 3, FRONT = 4 };
  float raw[ITEMS * WIDTH];
  for (int i = 0; i < ITEMS * WIDTH; i++) raw[i] = (float)(i / 3) * 0.25f;
  for (int filter = 0; filter < SBFI_FILTER_COUNT; filter++) {
    uint8_t bytes[FRONT + 2 * sizeof raw];
    size_t stored, expected = filter == SBFI_FILTER_NONE ? sizeof raw : ITEMS;
    sbfi_packed_coder coder;
    char name[32];
    sbfi_packed_coder_init(&coder, NULL, 9);
    FUZZ_MUST(sbfi_packed_deflate(&coder, (const uint8_t *)raw, sizeof raw, (sbfi_packed_filter)filter, WIDTH,
                  bytes + FRONT, sizeof bytes - FRONT, &stored) == SBFI_CODED);
    sbfi_packed_coder_free(&coder);
    const uint8_t front[FRONT] = {
        (uint8_t)filter, WIDTH - 1, (uint8_t)(expected & 0xff), (uint8_t)(expected >> 8)};
    memcpy(bytes, front, FRONT);
    snprintf(name, sizeof name, "filter_%d.bin", filter);
    put_in(folder, "inflate", name, bytes, FRONT + stored);
  }
}

static void put_stream(const char *folder) {
  stream_builder stream = {0};
  stream_everything(&stream);
  put_in(folder, "stream", "everything.bin", stream.at, stream.size);
  free(stream.at);
}

/* ---- The words of XML, as a dictionary for libFuzzer ---- */

static void put_words_of(const sbfi_element *element, FILE *to) {
  for (uint32_t i = 0; i < element->field_count; i++) {
    const sbfi_field *field = &element->fields[i];
    if (field->tag.wrapper) fprintf(to, "\"<%s>\"\n\"</%s>\"\n", field->tag.wrapper, field->tag.wrapper);
    if (field->type == SBFI_LIST || field->type == SBFI_TEXT)
      fprintf(to, "\"<%s>1 2 3</%s>\"\n", field->name, field->name);
    else if (field->type < SBFI_ONE)
      fprintf(to, "\" %s=\\\"1\\\"\"\n", field->name);
    for (uint32_t v = 0; v < field->words.count; v++)
      fprintf(to, "\" %s=\\\"%s\\\"\"\n", field->name, field->words.at[v]);
    if (!field->element) continue;
    if (field->tag.xml && !field->tag.suffix)
      fprintf(to, "\"<%s\"\n\"</%s>\"\n", field->tag.xml, field->tag.xml);
    put_words_of(field->element, to); /* no element is inside itself */
  }
}

static void put_words(const char *folder) {
  char path[1024];
  snprintf(path, sizeof path, "%s/xml.words", folder);
  FILE *to = fopen(path, "w");
  FUZZ_MUST(to);
  put_words_of(&sbfi_asset_element, to);
  FUZZ_MUST(fclose(to) == 0);
}

int main(int argc, char **argv) {
  if (argc != 2) {
    fprintf(stderr, "usage: fuzz_seeds FOLDER\n");
    return 2;
  }
  sbf_asset *small = small_asset(), *full = fill_asset(&(fill_options){.seed = 1}),
            *bodies = bodies_to_build(), *outlined = fill_asset(&(fill_options){.seed = 2, .items = 70});
  FUZZ_MUST(small && full && outlined);
  full->extensions.count = 0; /* those it requires, a load without them refuses */
  full->extensions.at = NULL;
  outlined->extensions = full->extensions;
  put_outlined(argv[1], outlined);
  put_forms(argv[1], "small", small);
  put_forms(argv[1], "full", full);
  put_forms(argv[1], "bodies", bodies);
  put_glb(argv[1], "small", small);
  put_glb(argv[1], "full", full);
  put_built(argv[1], bodies);
  sbf_asset_free(small);
  sbf_asset_free(full);
  sbf_asset_free(bodies);
  sbf_asset_free(outlined);
  put_chunks(argv[1]);
  put_stream(argv[1]);
  put_words(argv[1]);
  return EXIT_SUCCESS;
}
