/* sbfmt info: describes a file. */
#include <string.h>
#include <sys/stat.h>

#include "bundle_description.h"
#include "cli.h"
#include "level_description.h"
#include "sbfmt/io.h"
#include "sbfmt/mechanics.h"

static json_t *integer(uint64_t value) {
  return json_integer((json_int_t)value);
}

/* Smaller files are read completely, and their figures are computed. */
enum { READ_WHOLE_BYTES = 1 << 16 };

/* Number of triangles of the polygons, from the counts alone, so lists need not be loaded. */
static int64_t triangle_count(const sbf_polygon_mesh *mesh) {
  return (int64_t)mesh->polygon_points.count - 2 * (int64_t)mesh->polygon_sizes.count;
}

static uint64_t pinned_points(const sbf_pin_set_list *pins) {
  uint64_t count = 0;
  for (uint32_t i = 0; i < pins->count; i++) count += pins->at[i].points.count;
  return count;
}

static const sbf_level *finest(const sbf_soft_body *body) {
  return body->levels.count ? &body->levels.at[0] : NULL;
}

static uint64_t body_pins(const sbf_soft_body *body) {
  const sbf_level *level = finest(body);
  return pinned_points(level ? &level->pins : &body->pins);
}

static uint64_t interior_points(const sbf_soft_body *body) {
  const sbf_level *level = finest(body);
  if (!level || level->model != SBF_ELASTIC_MODEL_SPRINGS) return body->interior.count;
  uint32_t of_surface = 0, surface = body->surface.positions.count;
  for (uint32_t i = 0; i < surface; i++) {
    uint32_t point = i < level->new_from_old.count ? level->new_from_old.at[i] : i;
    of_surface +=
        (i < level->new_from_old.count || !level->new_from_old.count) && point < level->positions.count;
  }
  return level->positions.count - of_surface;
}

static json_t *render_levels(const sbf_render_mesh *mesh) {
  json_t *list = json_array();
  for (uint32_t i = 0; i < mesh->levels.count; i++) {
    const sbf_render_level *level = &mesh->levels.at[i];
    json_array_append_new(
        list, json_pack("{s:o, s:f}", "triangles",
                  integer(level->polygon_points.count - 2 * (uint64_t)level->polygon_sizes.count), "error",
                  (double)level->error));
  }
  return list;
}

static json_t *render_meshes(const sbf_asset *asset) {
  json_t *list = json_array();
  for (uint32_t i = 0; i < asset->render_meshes.count; i++) {
    const sbf_render_mesh *mesh = &asset->render_meshes.at[i];
    int32_t material = mesh->material_slots.count ? mesh->material_slots.at[0].material : SBF_NONE;
    json_array_append_new(
        list, json_pack("{s:s, s:o, s:o, s:o, s:s, s:o}", "name", mesh->name, "vertices",
                  integer(mesh->mesh.positions.count), "polygons", integer(mesh->mesh.polygon_sizes.count),
                  "triangles", integer((uint64_t)triangle_count(&mesh->mesh)), "material",
                  material >= 0 ? asset->materials.at[material].name : "", "levels", render_levels(mesh)));
  }
  return list;
}

/* Id of the joint that connects a bone's body to another; null if there is none. */
static json_t *joint_of_bone(const sbf_asset *asset, uint32_t bone) {
  for (uint32_t i = 0; i < asset->joints.count; i++) {
    const sbf_joint *joint = &asset->joints.at[i];
    if (asset->rigid_bodies.at[joint->body_b].bone == (int32_t)bone) return json_string(joint->id);
  }
  return json_null();
}

static json_t *bones(const sbf_asset *asset) {
  json_t *list = json_array();
  for (uint32_t i = 0; i < asset->bones.count; i++) {
    const sbf_bone *bone = &asset->bones.at[i];
    json_t *parent = bone->parent >= 0 ? json_string(asset->bones.at[bone->parent].name) : json_null();
    json_array_append_new(list, json_pack("{s:s, s:s, s:o, s:o}", "id", bone->id, "name", bone->name,
                                    "parent", parent, "joint", joint_of_bone(asset, i)));
  }
  return list;
}

static json_t *sections(const sbf_asset *asset) {
  json_t *list = json_array();
  for (uint32_t i = 0; i < asset->soft_bodies.count; i++) {
    const sbf_soft_body *body = &asset->soft_bodies.at[i];
    const sbf_level *level = finest(body);
    json_t *bone = body->bone >= 0 ? json_string(asset->bones.at[body->bone].name) : json_null();
    json_array_append_new(list,
        json_pack("{s:s, s:o, s:o, s:o, s:o, s:o, s:o, s:o}", "name", body->name, "bone", bone, "vertices",
            integer(body->surface.positions.count), "polygons", integer(body->surface.polygon_sizes.count),
            "interior_points", integer(interior_points(body)), "tetrahedra",
            integer(level ? level->lattice.tetrahedra.count : 0), "pins", integer(body_pins(body)), "levels",
            level_description(body)));
  }
  return list;
}

typedef struct totals {
  uint64_t springs[SBF_SPRING_KIND_COUNT], inert, tetrahedra, pins, attachments, embedded, levels;
} totals;

static totals count(const sbf_asset *asset) {
  totals t = {.inert = 0};
  for (uint32_t i = 0; i < asset->soft_bodies.count; i++) {
    const sbf_soft_body *body = &asset->soft_bodies.at[i];
    const sbf_level *level = finest(body);
    t.attachments += body->attachments.count;
    t.pins += body_pins(body);
    if (body->levels.count > t.levels) t.levels = body->levels.count;
    if (!level) continue;
    t.tetrahedra += level->lattice.tetrahedra.count;
    for (uint32_t s = 0; s < level->springs.count; s++) {
      t.springs[level->springs.at[s].kind] += level->springs.at[s].ends.count;
      t.inert += level->springs.at[s].inert_count;
    }
    for (uint32_t e = 0; e < level->embeddings.count; e++)
      if (level->embeddings.at[e].render_mesh >= 0) t.embedded += level->embeddings.at[e].points.count;
  }
  for (uint32_t i = 0; i < asset->cross_springs.count; i++)
    t.springs[SBF_SPRING_KIND_CROSS_BODY] += asset->cross_springs.at[i].ends.count;
  return t;
}

static json_t *bounds(const sbf_asset_measures *m) {
  if (!m->bounded) return json_null();
  return json_pack("{s:[f,f,f], s:[f,f,f]}", "min", (double)m->low.x, (double)m->low.y, (double)m->low.z,
      "max", (double)m->high.x, (double)m->high.y, (double)m->high.z);
}

static uint64_t leg_count(const sbf_asset *asset) {
  uint64_t legs = 0;
  for (uint32_t i = 0; i < asset->gaits.count; i++) legs += asset->gaits.at[i].legs.count;
  return legs;
}

/* For the gait that moves the character: the first. */
static const char *gait_kind(const sbf_asset *asset) {
  return asset->gaits.count ? sbf_gait_kind_name(asset->gaits.at[0].kind) : "none";
}

json_t *bundle_description(const sbf_asset *asset, const sbf_asset_measures *measures, uint64_t bytes) {
  totals t = count(asset);
  json_t *springs = json_pack("{s:o, s:o, s:o, s:o, s:o, s:o}", "structural",
      integer(t.springs[SBF_SPRING_KIND_STRUCTURAL]), "shear", integer(t.springs[SBF_SPRING_KIND_SHEAR]),
      "flexion", integer(t.springs[SBF_SPRING_KIND_FLEXION]), "internal",
      integer(t.springs[SBF_SPRING_KIND_INTERNAL]), "cross", integer(t.springs[SBF_SPRING_KIND_CROSS_BODY]),
      "inert", integer(t.inert));
  json_t *object = json_object();
  json_object_set_new(object, "format_version", json_string(asset->version));
  json_object_set_new(object, "title", json_string(asset->info.title));
  json_object_set_new(object, "render_meshes", render_meshes(asset));
  json_object_set_new(object, "bones", bones(asset));
  json_object_set_new(object, "sections", sections(asset));
  json_object_set_new(object, "springs", springs);
  json_object_set_new(object, "tetrahedra", integer(t.tetrahedra));
  json_object_set_new(object, "embedded_vertices", integer(t.embedded));
  json_object_set_new(object, "pins", integer(t.pins));
  json_object_set_new(object, "attachments", integer(t.attachments));
  json_object_set_new(object, "rigid_bodies", integer(asset->rigid_bodies.count));
  json_object_set_new(object, "joints", integer(asset->joints.count));
  json_object_set_new(
      object, "gait", json_pack("{s:s, s:o}", "kind", gait_kind(asset), "legs", integer(leg_count(asset))));
  json_object_set_new(object, "levels", integer(t.levels));
  json_object_set_new(object, "bounds", bounds(measures));
  json_object_set_new(object, "mass", json_real((double)(float)measures->mass));
  json_object_set_new(object, "bytes", integer(bytes));
  return object;
}

/* Shape of the tetrahedra of all finest levels. */
static json_t *quality(const sbf_asset *asset) {
  sbf_lattice_measures all = {.min_dihedral_deg = 180};
  uint64_t count = 0;
  for (uint32_t i = 0; i < asset->soft_bodies.count; i++) {
    const sbf_level *level = finest(&asset->soft_bodies.at[i]);
    sbf_lattice_measures m;
    if (!level || level->lattice.tetrahedra.count == 0) continue;
    sbf_lattice_measure(
        level->positions.at, level->lattice.tetrahedra.at, level->lattice.tetrahedra.count, &m);
    if (m.min_dihedral_deg < all.min_dihedral_deg) all.min_dihedral_deg = m.min_dihedral_deg;
    if (m.max_dihedral_deg > all.max_dihedral_deg) all.max_dihedral_deg = m.max_dihedral_deg;
    for (int k = 0; k < SBF_DIHEDRAL_BINS; k++) all.dihedrals[k] += m.dihedrals[k];
    all.volume += m.volume;
    all.inverted_count += m.inverted_count;
    count += level->lattice.tetrahedra.count;
  }
  if (count == 0) return json_null();
  json_t *histogram = json_array();
  for (int k = 0; k < SBF_DIHEDRAL_BINS; k++) json_array_append_new(histogram, integer(all.dihedrals[k]));
  return json_pack("{s:o, s:o, s:f, s:f, s:f, s:o}", "tetrahedra", integer(count), "inverted",
      integer(all.inverted_count), "volume", all.volume, "least_dihedral_deg", all.min_dihedral_deg,
      "most_dihedral_deg", all.max_dihedral_deg, "dihedrals", histogram);
}

static long long number(const json_t *object, const char *key) {
  return (long long)json_integer_value(json_object_get(object, key));
}

static const char *text_of(const json_t *object, const char *key) {
  const char *text = json_string_value(json_object_get(object, key));
  return text && *text ? text : "-";
}

enum { MAX_COLUMNS = 40 };

static void print_levels(const json_t *levels) {
  size_t i;
  json_t *level;
  char text[256];
  json_array_foreach(levels, i, level) {
    level_description_print(level, text, sizeof text);
    printf("    %s\n", text);
  }
}

/* Column widths for a list of texts. */
static int widest(const json_t *rows, const char *key) {
  size_t i, max = 0;
  json_t *row;
  json_array_foreach(rows, i, row) {
    size_t length = strlen(text_of(row, key));
    max = length > max ? length : max;
  }
  return max < MAX_COLUMNS ? (int)max : MAX_COLUMNS;
}

static void print_sections(const json_t *object) {
  size_t i;
  json_t *row;
  const json_t *all = json_object_get(object, "sections");
  int name = widest(all, "name"), bone = widest(all, "bone");
  printf("sections       %zu\n", json_array_size(json_object_get(object, "sections")));
  json_array_foreach(json_object_get(object, "sections"), i, row) {
    printf("  %-*s on %-*s %6lld vertices %6lld polygons %6lld interior %7lld tetrahedra %6lld pins\n", name,
        text_of(row, "name"), bone, text_of(row, "bone"), number(row, "vertices"), number(row, "polygons"),
        number(row, "interior_points"), number(row, "tetrahedra"), number(row, "pins"));
    print_levels(json_object_get(row, "levels"));
  }
}

static void print_render_levels(const json_t *levels) {
  size_t i;
  json_t *level;
  json_array_foreach(levels, i, level) printf("    level %zu: %7lld triangles within %.3g m\n", i + 1,
      number(level, "triangles"), json_real_value(json_object_get(level, "error")));
}

static void print_text(const json_t *object, uint64_t read_bytes) {
  size_t i;
  json_t *row;
  const json_t *springs = json_object_get(object, "springs");
  int mesh = widest(json_object_get(object, "render_meshes"), "name");
  printf("format         sbf %s, %lld bytes, %llu of them read\n", text_of(object, "format_version"),
      number(object, "bytes"), (unsigned long long)read_bytes);
  printf("title          %s\n", text_of(object, "title"));
  printf("render meshes  %zu\n", json_array_size(json_object_get(object, "render_meshes")));
  json_array_foreach(json_object_get(object, "render_meshes"), i, row) {
    printf("  %-*s %7lld vertices %7lld polygons %7lld triangles, %s\n", mesh, text_of(row, "name"),
        number(row, "vertices"), number(row, "polygons"), number(row, "triangles"), text_of(row, "material"));
    print_render_levels(json_object_get(row, "levels"));
  }
  print_sections(object);
  printf("bones          %zu\n", json_array_size(json_object_get(object, "bones")));
  printf("springs        %lld structural, %lld shear, %lld flexion, %lld internal (%lld inert left out), "
         "%lld cross\n",
      number(springs, "structural"), number(springs, "shear"), number(springs, "flexion"),
      number(springs, "internal"), number(springs, "inert"), number(springs, "cross"));
  static const char *const totals_shown[] = {
      "tetrahedra", "embedded_vertices", "pins", "attachments", "rigid_bodies", "joints", "levels"};
  for (size_t k = 0; k < sizeof totals_shown / sizeof *totals_shown; k++)
    printf("%-18s %lld\n", totals_shown[k], number(object, totals_shown[k]));
  const json_t *gait = json_object_get(object, "gait");
  printf("gait kind          %s\n", json_string_value(json_object_get(gait, "kind")));
  printf("gait legs          %lld\n", number(gait, "legs"));
  printf("mass               %.6g kg\n", json_real_value(json_object_get(object, "mass")));
  const json_t *box = json_object_get(object, "bounds");
  for (int k = 0; json_is_object(box) && k < 3; k++)
    printf("%c                  %9.4f to %9.4f m\n", "xyz"[k],
        json_real_value(json_array_get(json_object_get(box, "min"), (size_t)k)),
        json_real_value(json_array_get(json_object_get(box, "max"), (size_t)k)));
}

static void print_quality(const json_t *q) {
  size_t i;
  json_t *value;
  if (!json_is_object(q)) return;
  printf("lattice            %.4g m^3, %lld inverted, dihedral angles %.1f to %.1f degrees, by tens:\n ",
      json_real_value(json_object_get(q, "volume")), number(q, "inverted"),
      json_real_value(json_object_get(q, "least_dihedral_deg")),
      json_real_value(json_object_get(q, "most_dihedral_deg")));
  json_array_foreach(json_object_get(q, "dihedrals"), i, value)
      printf(" %lld", (long long)json_integer_value(value));
  printf("\n");
}

static bool use_stated(float mass, sbf_vec3 low, sbf_vec3 high, sbf_asset_measures *m) {
  bool bounded = low.x != high.x || low.y != high.y || low.z != high.z;
  *m = (sbf_asset_measures){(double)mass, bounded, low, high};
  return bounded;
}

/* Figures stored by the last build or conversion; false if there are none. */
static bool stated_measures(const sbf_asset *asset, sbf_asset_measures *m) {
  for (uint32_t i = asset->derivations.count; i-- > 0;) {
    const sbf_derivation *d = &asset->derivations.at[i];
    if (use_stated(d->mass, d->low, d->high, m)) return true;
  }
  return use_stated(asset->info.mass, asset->info.low, asset->info.high, m);
}

/* Data that an outline omits: which surface points are points of the springs. */
static bool lists_surface_points(const sbf_asset *asset) {
  for (uint32_t i = 0; i < asset->soft_bodies.count; i++) {
    const sbf_level *level = finest(&asset->soft_bodies.at[i]);
    if (level && level->model == SBF_ELASTIC_MODEL_SPRINGS && level->new_from_old.count &&
        !level->new_from_old.at)
      return false;
  }
  return true;
}

typedef struct loaded {
  sbf_asset *asset;
  sbf_asset_measures measures;
  uint64_t bytes, read_bytes;
} loaded;

/* Reads only the outline of a large packed file if it has all figures; else the whole file. */
static sbf_status load(cli_call *call, const char *path, bool whole, loaded *l, sbf_diagnostic *error) {
  struct stat file;
  l->bytes = stat(path, &file) == 0 ? (uint64_t)file.st_size : 0;
  sbf_load_options options = {.outline = !whole && l->bytes >= READ_WHOLE_BYTES,
      .read_bytes = &l->read_bytes,
      .report = cli_report,
      .user = call};
  sbf_status status = sbf_load_file(path, &options, &l->asset, error);
  if (status != SBF_OK) return status;
  bool is_outline = options.outline && l->read_bytes > 0; /* XML does not count bytes */
  if (is_outline && lists_surface_points(l->asset) && stated_measures(l->asset, &l->measures)) return SBF_OK;
  if (is_outline) {
    sbf_asset_free(l->asset);
    status = sbf_load_file(path, NULL, &l->asset, error);
  }
  if (status == SBF_OK) sbf_asset_measure(l->asset, &l->measures);
  l->read_bytes = l->bytes;
  return status;
}

static int run(cli_call *call) {
  loaded l = {.asset = NULL};
  sbf_diagnostic error;
  bool with_quality = cli_switch(call, "--quality");
  sbf_status status = load(call, call->inputs[0], with_quality, &l, &error);
  if (status != SBF_OK) {
    cli_print_diagnostic(call, &error);
    return (int)status;
  }
  json_t *object = bundle_description(l.asset, &l.measures, l.bytes);
  if (with_quality) json_object_set_new(object, "lattice", quality(l.asset));
  sbf_asset_free(l.asset);
  if (call->json) return cli_print_json(object, SBF_OK);
  print_text(object, l.read_bytes);
  if (with_quality) print_quality(json_object_get(object, "lattice"));
  json_decref(object);
  return SBF_OK;
}

static const cli_option options[] = {
    {"--format", "text|json", "how to print (text)"},
    {"--quality", NULL, "read the whole file and print the shape of the tetrahedra"},
    {NULL, NULL, NULL},
};
const cli_verb verb_info = {"info", "FILE [--quality] [--format json]", "print what a file contains",
    "Counts are those of the finest level of every body. An `inert` spring would join two\n"
    "pinned points: the build counts it and leaves it out of the file. Of packed files of a\n"
    "megabyte or more only the table of contents and the records are read; bounds and mass\n"
    "are then those stated by the build or the conversion.",
    options, 1, 1, run};
