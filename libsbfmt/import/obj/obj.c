#include "import/obj/obj.h"

#include <string.h>

#include "base/diagnostic.h"
#include "base/file.h"
#include "import/obj/mtl.h"
#include "import/quote.h"
#include "import/sibling_path.h"

enum { LIBRARY_LIMIT_BYTES = 64 << 20 };
enum { NAME_WORDS = 8 }; /* maximum number of words in the name of a library */

typedef struct materials {
  sbfi_scene *scene;
  const sbfi_obj_text *text;
  sbfi_arena scratch;
  sbfi_scene_material *at; /* (count) */
  bool *described;         /* (count) */
  bool library_missing;
  sbfi_array images;
} materials;

static sbf_status out_of_memory(sbf_diagnostic *error) {
  return sbfi_diagnose(error, SBF_CODE_OUT_OF_MEMORY, "memory ran out while the OBJ file was read");
}

/* Reads the library `name` from the folder of the OBJ file. Accepts only small regular files, because the
 * name may come from a hostile file. False if memory runs out. */
static bool read_library(materials *m, sbfi_span name, bool *found) {
  char path[4096];
  sbfi_file file;
  *found = sbfi_sibling_path(path, sizeof path, m->scene->path, name) &&
           sbfi_file_open(path, &file, NULL) == SBF_OK;
  if (!*found) return true;
  size_t size = file.size <= LIBRARY_LIMIT_BYTES ? (size_t)file.size : 0;
  char *bytes = size ? sbfi_arena_allocate(&m->scratch, size, 1) : NULL;
  *found = size == file.size && (!bytes || sbfi_file_read_at(&file, 0, bytes, size, NULL) == SBF_OK);
  sbfi_file_close(&file);
  if (size && !bytes) return false;
  return !*found ||
         sbfi_mtl_read(m->scene, bytes, size, &m->text->materials, m->at, m->described, &m->images);
}

static sbfi_span without_quotes(sbfi_span name) {
  bool quoted = name.length > 2 && *name.at == '"' && name.at[name.length - 1] == '"';
  return quoted ? (sbfi_span){name.at + 1, name.length - 2} : name;
}

/* Reads the library named by most of the words at the start of `rest`, and removes them. */
static bool read_longest(materials *m, sbfi_span *rest, bool *found) {
  size_t ends[NAME_WORDS], words = 0;
  sbfi_span after = sbfi_span_trim(*rest), name = after, word;
  for (*found = false; words < NAME_WORDS && sbfi_span_next_word(&after, &word); words++)
    ends[words] = (size_t)(word.at + word.length - name.at);
  while (words > 0 && !*found) {
    name.length = ends[--words];
    if (!read_library(m, without_quotes(name), found)) return false;
    if (*found) rest->length -= (size_t)(name.at + name.length - rest->at), rest->at = name.at + name.length;
  }
  return true;
}

static bool warn_of_library(materials *m, sbfi_span name) {
  m->library_missing = true;
  return sbfi_scene_warn(m->scene, SBF_CODE_IMPORT_MATERIALS_MISSING, 0,
      "the material library \"%s\" cannot be read, so its materials are grey: put it beside the OBJ file",
      sbfi_quote_of(name).text);
}

/* A line may name several libraries, and each name may have blanks: the longest readable one is taken. Words
 * between them are one missing library. */
static bool read_libraries_of_line(materials *m, sbfi_span line) {
  sbfi_span rest = line, missing = {NULL, 0}, word;
  for (bool found;;) {
    if (!read_longest(m, &rest, &found)) return false;
    bool over = !found && !sbfi_span_next_word(&rest, &word);
    if (!found && !over) {
      if (!missing.length) missing.at = word.at;
      missing.length = (size_t)(word.at + word.length - missing.at);
      continue;
    }
    if (missing.length && !warn_of_library(m, without_quotes(missing))) return false;
    missing.length = 0;
    if (over) return true;
  }
}

static bool read_materials(materials *m) {
  sbfi_scene *scene = m->scene;
  const sbfi_span *names = m->text->materials.names.at, *libraries = m->text->libraries.at;
  uint32_t count = (uint32_t)m->text->materials.names.count;
  if (!count) return true;
  m->at = sbfi_arena_allocate(&scene->arena, count, sizeof *m->at);
  m->described = sbfi_arena_allocate(&scene->arena, count, sizeof *m->described);
  if (!m->at || !m->described) return false;
  for (uint32_t i = 0; i < count; i++) {
    const char *name = sbfi_scene_string(scene, names[i]);
    if (!name) return false;
    m->at[i] = sbfi_mtl_default(name);
  }
  for (size_t i = 0; i < m->text->libraries.count; i++)
    if (!read_libraries_of_line(m, libraries[i])) return false;
  for (uint32_t i = 0; i < count; i++)
    if (!m->described[i] && m->text->libraries.count && !m->library_missing &&
        !sbfi_scene_warn(scene, SBF_CODE_IMPORT_MATERIALS_MISSING, 0,
            "no material library defines \"%s\", so it is grey: export the OBJ file again with its library",
            m->at[i].name))
      return false;
  scene->materials = m->at;
  scene->material_count = count;
  if (!m->images.count) return true;
  scene->images = sbfi_arena_copy(&scene->arena, m->images.at, m->images.count, sizeof *scene->images);
  scene->image_count = scene->images ? (uint32_t)m->images.count : 0;
  return scene->images != NULL;
}

static bool is_free_form(const sbfi_obj_text *text) {
  static const char *const keywords[] = {"cstype", "deg", "bmat", "step", "curv", "curv2", "surf"};
  for (size_t i = 0; text->ignored_count && i < sizeof keywords / sizeof *keywords; i++)
    if (sbfi_span_is(text->ignored_keyword, keywords[i])) return true;
  return false;
}

static sbf_status fill(
    sbfi_scene *scene, const sbfi_obj_text *text, const sbf_allocator *allocator, sbf_diagnostic *error) {
  if (!text->polygons.count) {
    const char *why = !text->points.count ? "it has no vertices: export the mesh again"
                      : is_free_form(text)
                          ? "it has only free-form curves and surfaces: export it as a polygon mesh, for "
                            "example from Blender after Convert to Mesh"
                          : "it has vertices but no faces: export polygons, not only points or edges";
    return sbfi_diagnose(error, SBF_CODE_IMPORT_EMPTY, "the OBJ file has no surface: %s", why);
  }
  sbf_status status = sbfi_obj_divide(scene, text, allocator, error);
  if (status) return status;
  materials m = {.scene = scene, .text = text};
  sbfi_arena_init(&m.scratch, allocator, 0);
  sbfi_array_init(&m.images, allocator, sizeof(sbfi_scene_image));
  bool good = read_materials(&m);
  sbfi_array_free(&m.images);
  sbfi_arena_free(&m.scratch);
  if (!good) return out_of_memory(error);
  if (text->ignored_count && !sbfi_scene_warn(scene, SBF_CODE_IMPORT_IGNORED, text->ignored_line,
                                 "%u lines that do not define polygons are skipped, the first is \"%s\"",
                                 text->ignored_count, sbfi_quote_of(text->ignored_keyword).text))
    return out_of_memory(error);
  if (text->colored_count &&
      !sbfi_scene_warn(scene, SBF_CODE_IMPORT_IGNORED, text->colored_line,
          "the colors of %u vertices are left out: export the character as PLY or glTF to keep them",
          text->colored_count))
    return out_of_memory(error);
  return SBF_OK;
}

sbf_status sbfi_obj_read(sbfi_scene *scene, const char *bytes, size_t size, const sbf_allocator *allocator,
    sbf_diagnostic *error) {
  sbfi_obj_text text;
  sbf_status status = sbfi_obj_text_read(&text, bytes, size, allocator, error);
  if (status) return status;
  scene->format = "obj";
  status = fill(scene, &text, allocator, error);
  sbfi_obj_text_free(&text);
  return status;
}
