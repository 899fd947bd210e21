#include "material_options.h"

#include <string.h>

#include "sbfmt/build.h"
#include "sbfmt/materials.h"

/* Name of the material; `*body` receives the body's name, NULL for all, and `*length` its length. */
static const char *divide(const char *value, const char **body, size_t *length) {
  const char *equals = strrchr(value, '=');
  *body = equals ? value : NULL;
  *length = equals ? (size_t)(equals - value) : 0;
  return equals ? equals + 1 : value;
}

bool materials_check(const cli_call *call) {
  const char *value, *body;
  size_t length;
  for (int at = 0; (value = cli_next_value(call, "--material", &at));)
    if (!sbf_material_find(divide(value, &body, &length))) {
      cli_wrong(call, "no material '%s'; sbfmt %s --help lists them", divide(value, &body, &length),
          call->verb->name);
      return false;
    }
  return true;
}

bool materials_of_all(const cli_call *call) {
  const char *value;
  for (int at = 0; (value = cli_next_value(call, "--material", &at));)
    if (!strchr(value, '=')) return true;
  return false;
}

static bool is(const char *text, const char *wanted, size_t length) {
  return strlen(text) == length && memcmp(text, wanted, length) == 0;
}

/* A writable copy of the list with a capacity for `more` items. */
static void *own(sbf_asset *asset, const void *at, size_t count, size_t more, size_t size) {
  char *copy = sbf_asset_allocate(asset, count + more + 1, size);
  if (copy && count) memcpy(copy, at, count * size);
  return copy;
}

/* Source bodies only: a build recreates derived ones. */
static uint32_t apply_to_bodies(const sbf_asset *asset, sbf_soft_body *bodies, const char *name,
    size_t length, const sbf_material_preset *preset) {
  uint32_t found = 0;
  for (uint32_t i = 0; i < asset->soft_bodies.count; i++) {
    if (bodies[i].derived != SBF_NONE) continue;
    if (name && !is(bodies[i].name, name, length) && !is(bodies[i].id, name, length)) continue;
    sbf_material_apply(preset, &bodies[i].attributes);
    found++;
  }
  return found;
}

/* Recipe of the sections on a bone: if there is none, a new one, with the values of the recipe for all. */
static sbf_section_recipe *recipe_for(sbf_asset *asset, sbf_section_recipe *recipes, int32_t bone) {
  sbf_section_recipe *general = NULL, *made = &recipes[asset->section_recipes.count];
  for (uint32_t i = 0; i < asset->section_recipes.count; i++) {
    if (recipes[i].bone == bone) return &recipes[i];
    if (recipes[i].bone == SBF_NONE) general = &recipes[i];
  }
  sbf_section_recipe_init(made);
  made->attributes.sag_free = true; /* authored shape when standing */
  if (general) *made = *general;
  made->bone = bone;
  asset->section_recipes.count++;
  return made;
}

/* On bones of that name or id, possibly several; NULL: all without their own recipe. */
static uint32_t apply_to_sections(sbf_asset *asset, sbf_section_recipe *recipes, const char *name,
    size_t length, const sbf_material_preset *preset) {
  uint32_t found = 0;
  for (uint32_t b = 0; name && b < asset->bones.count; b++) {
    const sbf_bone *bone = &asset->bones.at[b];
    if (!is(bone->name, name, length) && !is(bone->id, name, length)) continue;
    sbf_section_recipe *recipe = recipe_for(asset, recipes, (int32_t)b);
    sbf_material_apply(preset, &recipe->attributes);
    recipe->rigid = false; /* a stated material implies that it is soft */
    recipe->proposed = false;
    found++;
  }
  if (name) return found;
  recipe_for(asset, recipes, SBF_NONE);
  for (uint32_t i = 0; i < asset->section_recipes.count; i++)
    sbf_material_apply(preset, &recipes[i].attributes);
  return 1;
}

bool materials_apply(const cli_call *call, sbf_asset *asset) {
  const char *value, *name;
  size_t length;
  int at = 0;
  if (!cli_value(call, "--material")) return true;
  sbf_soft_body *bodies =
      own(asset, asset->soft_bodies.at, asset->soft_bodies.count, 0, sizeof *asset->soft_bodies.at);
  sbf_section_recipe *recipes = own(asset, asset->section_recipes.at, asset->section_recipes.count,
      (size_t)asset->bones.count + 1, sizeof *recipes);
  bool cut;
  if (!bodies || !recipes || sbf_build_cuts_sections(asset, &cut) != SBF_OK) {
    cli_wrong(call, "out of memory");
    return false;
  }
  if (asset->soft_bodies.count) asset->soft_bodies.at = bodies;
  while ((value = cli_next_value(call, "--material", &at))) {
    const sbf_material_preset *preset = sbf_material_find(divide(value, &name, &length));
    uint32_t found = apply_to_bodies(asset, bodies, name, length, preset);
    if (cut && !(name && found)) found += apply_to_sections(asset, recipes, name, length, preset);
    if (name && !found) {
      cli_wrong(call, "no soft body%s has the name '%.*s', which should have the material %s",
          cut ? " or bone" : "", (int)length, name, preset->name);
      return false;
    }
  }
  if (asset->section_recipes.count) asset->section_recipes.at = recipes;
  return true;
}
