#include "soft_asset.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "sbfmt/packed.h"

/* ---- Shared by characters ---- */

/* The bytes are kept, because lists of a stored bundle are used in place. */
struct soft_content {
  gd_variant bytes;
  sbf_asset *asset;
  soft_model *models;
  gd_variant *materials, *textures; /* one for each of the asset; nil: not created yet */
  uint32_t holders;
};

static void free_values(gd_variant *values, uint32_t count) {
  for (uint32_t i = 0; values && i < count; i++) gd_free(&values[i]);
  free(values);
}

static void content_release(soft_content *content) {
  if (!content || --content->holders) return;
  free_values(content->materials, content->asset->materials.count);
  free_values(content->textures, content->asset->textures.count);
  sbf_asset_free(content->asset);
  gd_free(&content->bytes);
  free(content);
}

static bool same_options(const sbr_model_options *a, const sbr_model_options *b) {
  return a->level == b->level && a->scheme == b->scheme && a->substeps == b->substeps && a->free == b->free &&
         a->has_gravity == b->has_gravity && a->detail_levels == b->detail_levels &&
         !memcmp(&a->gravity, &b->gravity, sizeof a->gravity);
}

/* Path of the resource, for messages. */
static void name_of(const soft_asset *asset, char *name, size_t size) {
  gd_variant value = gd_object(asset->object), path = GD_CALL(&value, "get_path");
  if (!gd_as_text(&path, name, size)) snprintf(name, size, "SoftAsset");
  gd_free(&path);
  gd_free(&value);
}

/* A new model; `posed`: of its own copy of the asset. */
static soft_model *make_model(soft_asset *asset, const sbr_model_options *options, bool posed) {
  soft_content *content = asset->content;
  sbf_diagnostic error = {.message = "no memory for a model"};
  soft_model *made = calloc(1, sizeof *made);
  bool good = made && (!posed || pose_clip_make(&made->pose, content->asset));
  if (good) made->asset = posed ? made->pose.asset : content->asset;
  if (!good || sbr_model_create(made->asset, options, &made->model, &error) != SBF_OK) {
    char name[512], message[sizeof error.message + 2 * sizeof name];
    name_of(asset, name, sizeof name);
    snprintf(message, sizeof message, "%s: %s", name, error.message);
    gd_error(message);
    if (made) pose_clip_free(&made->pose);
    free(made);
    return NULL;
  }
  made->content = content;
  made->options = *options;
  made->holders = 1;
  content->holders++;
  return made;
}

soft_model *soft_model_hold(soft_asset *asset, const sbr_model_options *options) {
  soft_content *content = asset->content;
  if (!content) return NULL;
  for (soft_model *one = content->models; one; one = one->next)
    if (same_options(&one->options, options)) return one->holders++, one;
  soft_model *made = make_model(asset, options, false);
  if (!made) return NULL;
  made->next = content->models;
  content->models = made;
  return made;
}

soft_model *soft_model_hold_posed(soft_asset *asset, const sbr_model_options *options) {
  return asset->content ? make_model(asset, options, true) : NULL;
}

pose_clip *soft_model_pose(soft_model *model) {
  return model->pose.asset ? &model->pose : NULL;
}

void soft_model_release(soft_model *model) {
  if (!model || --model->holders) return;
  soft_model **link = &model->content->models;
  while (*link && *link != model) link = &(*link)->next;
  if (*link) *link = model->next;
  sbr_model_destroy(model->model);
  pose_clip_free(&model->pose);
  content_release(model->content);
  free(model);
}

/* The value with that index in a list that is allocated on first use; NULL without memory or such an index.
 */
static gd_variant *value_in(gd_variant **values, uint32_t count, int32_t index) {
  if (index < 0 || (uint32_t)index >= count) return NULL;
  if (!*values) {
    *values = malloc(count * sizeof **values);
    for (uint32_t i = 0; *values && i < count; i++) (*values)[i] = gd_nil();
  }
  return *values ? &(*values)[index] : NULL;
}

gd_variant *soft_model_material(soft_model *model, int32_t index) {
  return value_in(&model->content->materials, model->asset->materials.count, index);
}

gd_variant *soft_model_texture(soft_model *model, int32_t index) {
  return value_in(&model->content->textures, model->asset->textures.count, index);
}

const sbf_asset *soft_asset_of(const soft_asset *asset) {
  return asset->content ? asset->content->asset : NULL;
}

/* ---- The resource ---- */

bool soft_asset_read(soft_asset *asset, const gd_variant *bytes, const char *name) {
  int64_t size = gd_size(bytes);
  soft_content *made = NULL;
  if (size) {
    sbf_load_options options = {.name = name};
    sbf_diagnostic error;
    made = calloc(1, sizeof *made);
    if (!made) {
      gd_error("no memory for an asset");
      return false;
    }
    made->bytes = gd_copy(bytes);
    made->holders = 1;
    if (sbf_packed_load_memory(gd_bytes(&made->bytes), (size_t)size, &options, &made->asset, &error) !=
        SBF_OK) {
      char message[sizeof error.message + 512];
      snprintf(message, sizeof message, "%s: %s", name, error.message);
      gd_error(message);
      gd_free(&made->bytes);
      free(made);
      return false;
    }
  }
  content_release(asset->content);
  asset->content = made;
  return true;
}

static void begin(void *self, GDExtensionObjectPtr object) {
  ((soft_asset *)self)->object = object;
}

static void end(void *self) {
  content_release(((soft_asset *)self)->content);
}

static void get_data(void *self, const gd_variant *const *arguments, gd_variant *result) {
  soft_asset *asset = self;
  (void)arguments;
  gd_assign(result, asset->content ? gd_copy(&asset->content->bytes)
                                   : gd_empty(GDEXTENSION_VARIANT_TYPE_PACKED_BYTE_ARRAY));
}

static void set_data(void *self, const gd_variant *const *arguments, gd_variant *result) {
  soft_asset *asset = self;
  gd_variant value = gd_object(asset->object);
  char name[512];
  (void)result;
  name_of(asset, name, sizeof name);
  if (soft_asset_read(asset, arguments[0], name)) GD_DO(&value, "emit_changed");
  gd_free(&value);
}

/* Names of a list of parts. */
static void add_names(gd_variant *result, uint32_t count, const char *(*name)(const sbf_asset *, uint32_t),
    const sbf_asset *asset) {
  gd_assign(result, gd_empty(GDEXTENSION_VARIANT_TYPE_PACKED_STRING_ARRAY));
  for (uint32_t i = 0; asset && i < count; i++) GD_DO(result, "push_back", gd_string(name(asset, i)));
}

/* Names of elements, for get_bone_names and similar methods: the display name or else the id. */
#define NAMES(list)                                                                                          \
  static const char *list##_name(const sbf_asset *asset, uint32_t i) {                                       \
    return asset->list.at[i].name[0] ? asset->list.at[i].name : asset->list.at[i].id;                        \
  }                                                                                                          \
  static void list##_names(void *self, const gd_variant *const *arguments, gd_variant *result) {             \
    const sbf_asset *asset = soft_asset_of(self);                                                            \
    (void)arguments;                                                                                         \
    add_names(result, asset ? asset->list.count : 0, list##_name, asset);                                    \
  }
NAMES(bones)
NAMES(soft_bodies)
NAMES(render_meshes)
NAMES(clips)
NAMES(bone_masks)
NAMES(ik_chains)
#undef NAMES

/* Adds a sentence for each part that the runtime ignores. */
static void add_sentence(void *user, const sbf_diagnostic *finding) {
  GD_DO((gd_variant *)user, "push_back", gd_string(finding->message));
}

static void get_left_out(void *self, const gd_variant *const *arguments, gd_variant *result) {
  sbr_model_options options = sbr_default_model_options();
  soft_model *model = soft_model_hold(self, &options);
  (void)arguments;
  gd_assign(result, gd_empty(GDEXTENSION_VARIANT_TYPE_PACKED_STRING_ARRAY));
  if (model) sbr_model_report_unsupported(model->model, add_sentence, result);
  soft_model_release(model);
}

#define STRINGS                                                                                              \
  true, {                                                                                                    \
    "", GDEXTENSION_VARIANT_TYPE_PACKED_STRING_ARRAY, NULL                                                   \
  }
static const gd_method methods[] = {
    {"get_bone_names", bones_names, STRINGS, 0, {{0}}},
    {"get_soft_body_names", soft_bodies_names, STRINGS, 0, {{0}}},
    {"get_render_mesh_names", render_meshes_names, STRINGS, 0, {{0}}},
    {"get_clip_names", clips_names, STRINGS, 0, {{0}}},
    {"get_bone_mask_names", bone_masks_names, STRINGS, 0, {{0}}},
    {"get_ik_chain_names", ik_chains_names, STRINGS, 0, {{0}}},
    {"get_left_out", get_left_out, STRINGS, 0, {{0}}},
    {0},
};

enum { USAGE_STORED = 2 };
static const gd_property properties[] = {
    {.name = "data",
        .type = GDEXTENSION_VARIANT_TYPE_PACKED_BYTE_ARRAY,
        .usage = USAGE_STORED,
        .getter_name = "get_data",
        .setter_name = "set_data",
        .get = get_data,
        .set = set_data},
    {0},
};

const gd_class soft_asset_class = {
    .name = "SoftAsset",
    .parent = "Resource",
    .counted = true,
    .size = sizeof(soft_asset),
    .begin = begin,
    .end = end,
    .methods = (const gd_method *const[]){methods, NULL},
    .properties = properties,
};
