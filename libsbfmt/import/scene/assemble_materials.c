/* Assembles materials of a scene and their images, embedded or in files. */
#include <string.h>

#include "import/scene/assembly.h"

typedef struct imaging {
  sbfi_assembly *a;
  sbfi_name_table names;    /* names of images as in the materials */
  sbfi_array image_of_name; /* int32_t, SBF_NONE if the image is missing */
  sbfi_array images;        /* sbfi_scene_image */
} imaging;

static sbfi_span base_name(sbfi_span path) {
  for (size_t i = path.length; i-- > 0;)
    if (path.at[i] == '/' || path.at[i] == '\\') return (sbfi_span){path.at + i + 1, path.length - i - 1};
  return path;
}

/* "*3" is embedded image 3. An FBX may also refer to an embedded image by its path. */
static int64_t find_embedded(const sbfi_raw_scene *raw, sbfi_span name) {
  uint64_t number = 0;
  bool starred = name.length > 1 && name.at[0] == '*';
  for (size_t i = 1; starred && i < name.length; i++) {
    if (name.at[i] < '0' || name.at[i] > '9' || number > UINT32_MAX)
      starred = false;
    else
      number = number * 10 + (uint64_t)(name.at[i] - '0');
  }
  if (starred) return number < raw->image_count ? (int64_t)number : -1;
  sbfi_span wanted = base_name(name);
  for (uint32_t i = 0; wanted.length && i < raw->image_count; i++)
    if (sbfi_span_equal(base_name(raw->images[i].name), wanted)) return i;
  return -1;
}

static bool make_image(imaging *m, sbfi_span name, int32_t *number) {
  sbfi_scene *scene = m->a->scene;
  int64_t embedded = find_embedded(m->a->raw, name);
  sbfi_scene_image image = {.name = "", .extension = ""};
  if (embedded >= 0) {
    const sbfi_raw_image *raw = &m->a->raw->images[embedded];
    if (!raw->byte_count) {
      *number = SBF_NONE;
      return sbfi_scene_warn(scene, SBF_CODE_IMPORT_IMAGE, 0,
          "embedded image %lld has raw pixels instead of a PNG or JPEG file and is left out",
          (long long)embedded);
    }
    image.name = sbfi_scene_string(scene, raw->name);
    image.extension = sbfi_scene_string(scene, raw->extension);
    image.bytes = sbfi_arena_copy(&scene->arena, raw->bytes, raw->byte_count, 1);
    image.byte_count = raw->byte_count;
    if (!image.name || !image.extension || !image.bytes) return false;
  } else {
    char *path = (char *)sbfi_scene_string(scene, name);
    if (!path) return false;
    for (char *c = path; *c; c++)
      if (*c == '\\') *c = '/';
    image.path = path;
  }
  *number = (int32_t)m->images.count;
  return sbfi_array_append(&m->images, &image, 1);
}

/* Finds an image by name; creates it at the first request. */
static bool find_image(imaging *m, sbfi_span name, int32_t *number) {
  *number = SBF_NONE;
  if (!name.length) return true;
  int64_t found = sbfi_name_table_add(&m->names, name);
  if (found < 0) return false;
  if ((size_t)found == m->image_of_name.count) {
    if (!make_image(m, name, number) || !sbfi_array_append(&m->image_of_name, number, 1)) return false;
  }
  *number = ((const int32_t *)m->image_of_name.at)[found];
  return true;
}

static float clamped(float value) {
  return value < 0 ? 0 : value > 1 ? 1 : value;
}

static bool make_material(imaging *m, const sbfi_raw_material *raw, sbfi_scene_material *to) {
  *to = raw->values;
  to->name = sbfi_scene_string(m->a->scene, raw->name);
  for (int i = 0; i < 4; i++) to->base_color[i] = clamped(to->base_color[i]);
  for (int i = 0; i < 3; i++) to->emissive[i] = to->emissive[i] < 0 ? 0 : to->emissive[i];
  to->metallic = clamped(to->metallic);
  to->roughness = clamped(to->roughness);
  to->alpha_cutoff = clamped(to->alpha_cutoff);
  return to->name && find_image(m, raw->images[SBFI_RAW_BASE_COLOR], &to->base_color_image) &&
         find_image(m, raw->images[SBFI_RAW_METALLIC_ROUGHNESS], &to->metallic_roughness_image) &&
         find_image(m, raw->images[SBFI_RAW_NORMAL], &to->normal_image);
}

/* Creates only materials that a mesh uses: assimp adds one of its own to many files. */
static bool make_materials(imaging *m) {
  sbfi_assembly *a = m->a;
  const sbfi_raw_scene *raw = a->raw;
  a->new_materials = sbfi_arena_allocate(&a->scratch, raw->material_count, sizeof *a->new_materials);
  if (!a->new_materials) return false;
  for (uint32_t i = 0; i < raw->mesh_count; i++)
    if (raw->meshes[i].material != SBF_NONE) a->new_materials[raw->meshes[i].material] = 1;
  uint32_t count = 0;
  for (uint32_t i = 0; i < raw->material_count; i++)
    a->new_materials[i] = a->new_materials[i] ? (int32_t)count++ : SBF_NONE;
  if (!count) return true;
  sbfi_scene_material *materials = sbfi_arena_allocate(&a->scene->arena, count, sizeof *materials);
  if (!materials) return false;
  for (uint32_t i = 0; i < raw->material_count; i++)
    if (a->new_materials[i] != SBF_NONE &&
        !make_material(m, &raw->materials[i], &materials[a->new_materials[i]]))
      return false;
  a->scene->materials = materials;
  a->scene->material_count = count;
  if (!m->images.count) return true;
  a->scene->images =
      sbfi_arena_copy(&a->scene->arena, m->images.at, m->images.count, sizeof *a->scene->images);
  a->scene->image_count = a->scene->images ? (uint32_t)m->images.count : 0;
  return a->scene->images != NULL;
}

bool sbfi_assemble_materials(sbfi_assembly *a) {
  if (!a->raw->material_count) return true;
  imaging m = {.a = a};
  sbfi_name_table_init(&m.names, a->allocator);
  sbfi_array_init(&m.image_of_name, a->allocator, sizeof(int32_t));
  sbfi_array_init(&m.images, a->allocator, sizeof(sbfi_scene_image));
  bool good = make_materials(&m);
  sbfi_name_table_free(&m.names);
  sbfi_array_free(&m.image_of_name);
  sbfi_array_free(&m.images);
  return good;
}
