#include "build/source_reading.h"

#include <string.h>

static bool is_one_of(const char *name, const char *const *names, size_t count) {
  for (size_t i = 0; i < count; i++)
    if (strcmp(name, names[i]) == 0) return true;
  return false;
}

static bool is_read(void *user, const sbfi_element_path *child) {
  static const char *const of_asset[] = {
      "bones", "rigid_bodies", "render_meshes", "soft_bodies", "section_recipes"};
  static const char *const not_of_meshes[] = {"uv_sets", "material_slots", "shape_keys", "levels"};
  static const char *const not_of_bodies[] = {"legacy"};
  const char *element = child->up->element->name, *field = child->field->name;
  (void)user;
  if (!child->up->up) return is_one_of(field, of_asset, sizeof of_asset / sizeof *of_asset);
  if (strcmp(element, "render_mesh") == 0)
    return !is_one_of(field, not_of_meshes, sizeof not_of_meshes / sizeof *not_of_meshes);
  if (strcmp(element, "soft_body") == 0)
    return !is_one_of(field, not_of_bodies, sizeof not_of_bodies / sizeof *not_of_bodies);
  return true;
}

sbf_status sbfi_build_source_hash(
    const sbf_asset *asset, char text[SBFI_SHA256_TEXT_SIZE], sbf_diagnostic *error) {
  return sbfi_source_hash(asset, is_read, NULL, text, error);
}
