/* Source: Wavefront, "MTL material format", and the metallic-roughness keywords (Pr, Pm, map_Pr, norm)
 * that exporters add. */
#include "import/obj/mtl.h"

#include <math.h>
#include <string.h>

#include "base/number.h"

typedef struct library {
  sbfi_scene *scene;
  sbfi_scene_material *current; /* NULL if no mesh uses the file's current material */
  bool roughness_stated;
  sbfi_array *images;
  bool out_of_memory;
} library;

sbfi_scene_material sbfi_mtl_default(const char *name) {
  return (sbfi_scene_material){.name = name,
      .base_color = {0.8f, 0.8f, 0.8f, 1},
      .roughness = 1,
      .alpha_cutoff = 0.5f,
      .double_sided = true,
      .base_color_image = SBF_NONE,
      .metallic_roughness_image = SBF_NONE,
      .normal_image = SBF_NONE,
      .base_color_uv = {.scale = {1, 1}},
      .metallic_roughness_uv = {.scale = {1, 1}},
      .normal_uv = {.scale = {1, 1}}};
}

static bool read_fraction(sbfi_span *rest, float *value) {
  sbfi_span word;
  float read;
  if (!sbfi_span_next_word(rest, &word) || sbfi_parse_f32(word.at, word.length, &read) != SBFI_NUMBER_READ)
    return false;
  *value = read < 0 ? 0 : read > 1 ? 1 : read;
  return true;
}

/* A single number sets all three components; "spectral" and "xyz" are ignored. */
static void read_color(sbfi_span rest, float color[3]) {
  float read[3];
  if (!read_fraction(&rest, &read[0])) return;
  if (!read_fraction(&rest, &read[1]) || !read_fraction(&rest, &read[2])) read[1] = read[2] = read[0];
  memcpy(color, read, sizeof read);
}

/* Maximum number of arguments of a map option; those after the first may be missing. */
static uint32_t option_arguments(sbfi_span option) {
  if (sbfi_span_is(option, "-o") || sbfi_span_is(option, "-s") || sbfi_span_is(option, "-t")) return 3;
  if (sbfi_span_is(option, "-mm")) return 2;
  return 1;
}

/* Converts `-o` and `-s` with v upwards to glTF's transform with v downwards. */
static void resolve_image(sbfi_scene_uv_transform *uv, const float offset[3], const float scale[3]) {
  *uv = (sbfi_scene_uv_transform){
      .offset = {offset[0], 1 - scale[1] - offset[1]}, .scale = {scale[0], scale[1]}};
}

/* Reads the options of a map and returns the file name after them. It may contain blanks. */
static sbfi_span read_options(sbfi_span rest, sbfi_scene_uv_transform *uv) {
  float offset[3] = {0, 0, 0}, scale[3] = {1, 1, 1}, ignored[3];
  for (;;) {
    resolve_image(uv, offset, scale);
    rest = sbfi_span_trim(rest);
    if (!rest.length || *rest.at != '-') return rest;
    sbfi_span after = rest, option, word;
    sbfi_span_next_word(&after, &option);
    uint32_t count = option_arguments(option);
    float *values = sbfi_span_is(option, "-o") ? offset : sbfi_span_is(option, "-s") ? scale : ignored;
    for (uint32_t i = 0; i < count; i++) {
      sbfi_span next = after;
      float number;
      if (!sbfi_span_next_word(&next, &word)) return rest;
      bool is_number = sbfi_parse_f32(word.at, word.length, &number) == SBFI_NUMBER_READ;
      if (i > 0 && !is_number) break;
      if (is_number) values[i] = number;
      after = next;
    }
    rest = after;
  }
}

static int32_t add_image(library *l, sbfi_span path, sbfi_scene_uv_transform *uv) {
  path = read_options(path, uv);
  if (!path.length) return SBF_NONE;
  char *copy = (char *)sbfi_scene_string(l->scene, path);
  if (!copy) {
    l->out_of_memory = true;
    return SBF_NONE;
  }
  for (char *c = copy; *c; c++)
    if (*c == '\\') *c = '/';
  const sbfi_scene_image *images = l->images->at;
  for (size_t i = 0; i < l->images->count; i++)
    if (strcmp(images[i].path, copy) == 0) return (int32_t)i;
  sbfi_scene_image image = {.name = "", .path = copy, .extension = ""};
  if (!sbfi_array_append(l->images, &image, 1)) {
    l->out_of_memory = true;
    return SBF_NONE;
  }
  return (int32_t)l->images->count - 1;
}

static void read_statement(library *l, sbfi_span keyword, sbfi_span rest) {
  sbfi_scene_material *m = l->current;
  float value;
  if (sbfi_span_is(keyword, "Kd")) {
    read_color(rest, m->base_color);
  } else if (sbfi_span_is(keyword, "Ke")) {
    read_color(rest, m->emissive);
  } else if (sbfi_span_is(keyword, "d")) {
    if (read_fraction(&rest, &value)) m->base_color[3] = value;
  } else if (sbfi_span_is(keyword, "Tr")) {
    if (read_fraction(&rest, &value)) m->base_color[3] = 1 - value;
  } else if (sbfi_span_is(keyword, "Pr")) {
    l->roughness_stated = read_fraction(&rest, &m->roughness) || l->roughness_stated;
  } else if (sbfi_span_is(keyword, "Pm")) {
    read_fraction(&rest, &m->metallic);
  } else if (sbfi_span_is(keyword, "Ns")) {
    sbfi_span word;
    if (l->roughness_stated || !sbfi_span_next_word(&rest, &word)) return;
    if (sbfi_parse_f32(word.at, word.length, &value) != SBFI_NUMBER_READ) return;
    float root = sqrtf(value < 0 ? 0 : value > 900 ? 900 : value);
    m->roughness = 1 - root / 30;
  } else if (sbfi_span_is(keyword, "map_Kd")) {
    m->base_color_image = add_image(l, rest, &m->base_color_uv);
  } else if (sbfi_span_is(keyword, "norm")) {
    m->normal_image = add_image(l, rest, &m->normal_uv);
  }
  if (m->base_color[3] < 1) m->alpha_mode = SBFI_ALPHA_BLEND;
}

bool sbfi_mtl_read(sbfi_scene *scene, const char *bytes, size_t size, const sbfi_name_table *names,
    sbfi_scene_material *materials, bool *described, sbfi_array *images) {
  library l = {.scene = scene, .images = images};
  sbfi_span text = {bytes, size}, line, keyword;
  if (size >= 3 && memcmp(bytes, "\xEF\xBB\xBF", 3) == 0) text = (sbfi_span){bytes + 3, size - 3};
  while (sbfi_span_next_line(&text, &line)) {
    sbfi_span rest = line;
    if (!sbfi_span_next_word(&rest, &keyword) || *keyword.at == '#') continue;
    if (sbfi_span_is(keyword, "newmtl")) {
      int64_t found = sbfi_name_table_find(names, sbfi_span_trim(rest));
      l.current = found < 0 ? NULL : &materials[found];
      l.roughness_stated = false;
      if (!l.current) continue;
      *l.current = sbfi_mtl_default(l.current->name);
      described[found] = true;
    } else if (l.current) {
      read_statement(&l, keyword, rest);
    }
    if (l.out_of_memory) return false;
  }
  return true;
}
