#include "conversion_report.h"

#include <errno.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>

#include "base/fault.h"
#include "base/output_file.h"
#include "bundle_description.h"
#include "conversion_pictures.h"
#include "mesh_quality.h"
#include "sbfmt/io.h"

#define WORD_(x) #x
#define WORD(x) WORD_(x)
#define PROGRAM "sbfmt " WORD(SBF_VERSION_MAJOR) "." WORD(SBF_VERSION_MINOR) "." WORD(SBF_VERSION_PATCH)

static bool ends_in(const char *path, const char *ending) {
  size_t length = strlen(path), tail = strlen(ending);
  return length > tail && strcmp(path + length - tail, ending) == 0;
}

bool conversion_report_supports(const char *path) {
  return ends_in(path, ".html") || ends_in(path, ".json");
}

static uint64_t bytes_of(const char *path) {
  struct stat file;
  return stat(path, &file) == 0 && file.st_size > 0 ? (uint64_t)file.st_size : 0;
}

/* --- Input -------------------------------------------------------------------------------------- */

static json_t *count(uint32_t n) {
  return json_integer(n);
}

static const char *origin_of(bool file, bool call) {
  return call ? "call" : file ? "file" : "assumed";
}

static json_t *source(const conversion_report *of, uint32_t i) {
  const sbf_convert_source *s = &of->summary->sources[i];
  const char *path = i == 0 ? of->input : of->rig, *slash = path ? strrchr(path, '/') : NULL;
  const sbf_source_list *known = &of->asset->info.sources;
  bool is_input = i == 0;
  json_t *object = json_pack("{s:s, s:I, s:s, s:s, s:s, s:f, s:s, s:s}", "file",
      slash  ? slash + 1
      : path ? path
             : "",
      "bytes", (json_int_t)(path ? bytes_of(path) : 0), "sha256", i < known->count ? known->at[i].sha256 : "",
      "form", s->form, "generator", s->generator, "unit_m", s->unit_m, "unit_from",
      origin_of(s->unit_stated, is_input && of->options->unit_m > 0), "axes_from",
      origin_of(s->axes_stated, is_input && of->options->up));
  const struct {
    const char *key;
    uint32_t count;
  } counts[] = {{"objects", s->objects}, {"vertices", s->vertices}, {"points", s->points},
      {"polygons", s->polygons}, {"bones", s->bones}, {"materials", s->materials}, {"images", s->images},
      {"clips", s->clips}, {"tetrahedra", s->tetrahedra}};
  for (size_t k = 0; object && k < sizeof counts / sizeof *counts; k++)
    json_object_set_new(object, counts[k].key, count(counts[k].count));
  return object;
}

static json_t *sources(const conversion_report *of) {
  json_t *list = json_array();
  for (uint32_t i = 0; i < of->summary->source_count; i++) json_array_append_new(list, source(of, i));
  return list;
}

/* --- Repairs, guesses and losses -------------------------------------------------------------------- */

static const char *const repaired[] = {"IMPORT_INSIDE_OUT", "IMPORT_POINTS_JOINED", "IMPORT_POSE",
    "IMPORT_GROUND", "RIG_ALIGNED", "IMPORT_TETRAHEDRA_TURNED", "IMPORT_TETRAHEDRA_FLAT", "RIG_BONE_REHUNG",
    "SECTION_MERGED", NULL};
static const char *const guessed[] = {"IMPORT_UNIT", "IMPORT_AXES", "IMPORT_NAME_AMBIGUOUS",
    "RIG_SECTION_GUESSED", "RIG_NO_LEGS", "GAIT_KIND", "GAIT_KIND_UNSURE", "REST_POSE_PROPOSED",
    "UNIT_LOOKS_WRONG", "MATERIAL_GUESSED", "SOFTNESS_PROPOSED", NULL};
static const char *const lost[] = {"IMPORT_IGNORED", "IMPORT_KEYS", "IMPORT_IMAGE",
    "IMPORT_MATERIALS_MISSING", "IMPORT_POINTS_LEFT_OUT", "IMPORT_PARTIAL_UVS", "IMPORT_MESH_INVENTED",
    "IMPORT_MOTION_UNMATCHED", "RIG_UNWEIGHTED_POINTS", NULL};

static bool is_among(const char *code, const char *const *list) {
  for (; *list; list++)
    if (strcmp(code, *list) == 0) return true;
  return false;
}

/* Messages of a kind; if `codes` is NULL, the messages of no kind. */
static json_t *messages_of(const json_t *messages, const char *const *codes) {
  json_t *list = json_array();
  for (size_t i = 0; i < json_array_size(messages); i++) {
    json_t *one = json_array_get(messages, i);
    const char *code = json_string_value(json_object_get(one, "code"));
    bool other = !is_among(code, repaired) && !is_among(code, guessed) && !is_among(code, lost);
    if (codes ? is_among(code, codes) : other) json_array_append(list, one);
  }
  return list;
}

static void add_proposed(json_t *list, const char *what, const char *id, const char *name) {
  json_array_append_new(list, json_pack("{s:s, s:s, s:s}", "what", what, "id", id, "name", name ? name : ""));
}

/* Parts marked as proposed, for a person to confirm. */
static json_t *proposed(const sbf_asset *a) {
  json_t *list = json_array();
  for (uint32_t i = 0; i < a->rigid_bodies.count; i++)
    if (a->rigid_bodies.at[i].proposed) add_proposed(list, "rigid body", a->rigid_bodies.at[i].id, NULL);
  for (uint32_t i = 0; i < a->joints.count; i++)
    if (a->joints.at[i].proposed) add_proposed(list, "joint", a->joints.at[i].id, NULL);
  for (uint32_t i = 0; i < a->ik_chains.count; i++)
    if (a->ik_chains.at[i].proposed) add_proposed(list, "IK chain", a->ik_chains.at[i].id, NULL);
  for (uint32_t i = 0; i < a->gaits.count; i++)
    if (a->gaits.at[i].proposed) add_proposed(list, "gait", a->gaits.at[i].id, NULL);
  for (uint32_t i = 0; i < a->chains.count; i++)
    if (a->chains.at[i].proposed) add_proposed(list, "chain", a->chains.at[i].id, NULL);
  return list;
}

/* --- Output ------------------------------------------------------------------------------------- */

static json_t *clips(const sbf_asset *a) {
  json_t *list = json_array();
  for (uint32_t i = 0; i < a->clips.count; i++)
    json_array_append_new(
        list, json_pack("{s:s, s:f, s:I}", "name", a->clips.at[i].name, "seconds",
                  (double)a->clips.at[i].duration, "tracks", (json_int_t)a->clips.at[i].tracks.count));
  return list;
}

static json_t *quality(const sbf_asset *a) {
  json_t *bodies = json_array();
  mesh_quality q;
  for (uint32_t i = 0; i < a->soft_bodies.count; i++) {
    mesh_quality_measure(a, &a->soft_bodies.at[i], &q);
    json_t *one = mesh_quality_json(&q);
    json_object_set_new(one, "name", json_string(a->soft_bodies.at[i].name));
    json_array_append_new(bodies, one);
  }
  mesh_quality_measure(a, NULL, &q);
  json_t *all = mesh_quality_json(&q);
  json_object_set_new(all, "bodies", bodies);
  return all;
}

static void set_pictures(json_t *report, const sbf_asset *asset, const char *file) {
  char *why = NULL;
  json_t *list = json_array();
  bool good = conversion_pictures_draw(asset, file, list, &why);
  json_object_set_new(report, "pictures", list);
  json_object_set_new(report, "drawing_failed", json_string(why ? why : good ? "" : "memory ran out"));
  free(why);
}

json_t *conversion_report_make(const conversion_report *of) {
  sbf_asset_measures measures;
  const char *slash = strrchr(of->output, '/');
  sbf_asset_measure(of->asset, &measures);
  json_t *report = json_pack(
      "{s:i, s:s, s:s}", "report_version", 1, "program", PROGRAM, "output", slash ? slash + 1 : of->output);
  if (!report) return NULL;
  json_object_set_new(report, "sources", sources(of));
  json_object_set_new(report, "mended", messages_of(of->messages, repaired));
  json_object_set_new(report, "guessed", messages_of(of->messages, guessed));
  json_object_set_new(report, "proposed", proposed(of->asset));
  json_object_set_new(report, "lost", messages_of(of->messages, lost));
  json_object_set_new(report, "notes", messages_of(of->messages, NULL));
  json_object_set_new(report, "bundle", bundle_description(of->asset, &measures, bytes_of(of->output)));
  json_object_set_new(report, "clips", clips(of->asset));
  json_object_set_new(report, "quality", quality(of->asset));
  set_pictures(report, of->asset, of->output);
  return report;
}

/* --- Writing --------------------------------------------------------------------------------------- */

static bool print_json(const json_t *report, FILE *to) {
  return json_dumpf(report, to, JSON_INDENT(2) | JSON_REAL_PRECISION(9)) == 0 && putc('\n', to) != EOF;
}

sbf_status conversion_report_write(const json_t *report, const char *path, sbf_diagnostic *error) {
  output_file output;
  sbf_status status = output_file_begin(&output, path, error);
  if (status != SBF_OK) return status;
  FILE *file = fopen(output.written_path, "wb");
  bool good =
      file && (ends_in(path, ".json") ? print_json(report, file) : conversion_page_print(report, file));
  int why = errno;
  if (file && fclose(file) != 0 && good) good = false, why = errno;
  if (good) return output_file_commit(&output, error);
  output_file_abandon(&output);
  return fault_set_file(error, SBF_CODE_IO_CANNOT_WRITE, path,
      "cannot write: %s; check the folder, its permissions and the free space", strerror(why));
}
