#include "asset_loader.h"

#include <stdio.h>
#include <string.h>

#include "soft_asset.h"

enum { FAILED = 1, ERR_FILE_CANT_OPEN = 12, ERR_FILE_CORRUPT = 16 }; /* Godot's Error */

static bool ends_with(const char *text, const char *end) {
  size_t length = strlen(text), size = strlen(end);
  return length >= size && !strcmp(text + length - size, end);
}

static void recognized(void *self, const gd_variant *const *arguments, gd_variant *result) {
  (void)self;
  (void)arguments;
  gd_assign(result, gd_empty(GDEXTENSION_VARIANT_TYPE_PACKED_STRING_ARRAY));
  GD_DO(result, "push_back", gd_string("sbfz"));
}

static void handles(void *self, const gd_variant *const *arguments, gd_variant *result) {
  char type[64];
  (void)self;
  gd_as_text(arguments[0], type, sizeof type);
  gd_assign(result, gd_bool(!strcmp(type, "SoftAsset") || !strcmp(type, "Resource")));
}

static void type_of(void *self, const gd_variant *const *arguments, gd_variant *result) {
  char path[1024];
  (void)self;
  gd_as_text(arguments[0], path, sizeof path);
  gd_assign(result, gd_string(ends_with(path, ".sbfz") ? "SoftAsset" : ""));
}

/* Reads the file through Godot's own access, which supports packs and folders. */
static void load(void *self, const gd_variant *const *arguments, gd_variant *result) {
  char path[1024];
  gd_variant classes = gd_singleton("ClassDB");
  gd_variant bytes = GD_CALL(&classes, "class_call_static", gd_name("FileAccess"),
      gd_name("get_file_as_bytes"), gd_copy(arguments[0]));
  (void)self;
  gd_free(&classes);
  gd_as_text(arguments[1], path, sizeof path);
  if (gd_type(&bytes) != GDEXTENSION_VARIANT_TYPE_PACKED_BYTE_ARRAY || !gd_size(&bytes))
    gd_assign(result, gd_int(ERR_FILE_CANT_OPEN));
  else {
    gd_variant made = gd_class_new(&soft_asset_class);
    soft_asset *asset = gd_class_instance(&soft_asset_class, gd_as_object(&made));
    if (asset && soft_asset_read(asset, &bytes, path))
      gd_assign(result, gd_copy(&made));
    else
      gd_assign(result, gd_int(ERR_FILE_CORRUPT));
    gd_free(&made);
  }
  gd_free(&bytes);
}

#define STRING GDEXTENSION_VARIANT_TYPE_STRING
static const gd_method virtuals[] = {
    {"_get_recognized_extensions", recognized, true, {"", GDEXTENSION_VARIANT_TYPE_PACKED_STRING_ARRAY, NULL},
        0, {{0}}},
    {"_handles_type", handles, true, {"", GDEXTENSION_VARIANT_TYPE_BOOL, NULL}, 1,
        {{"type", GDEXTENSION_VARIANT_TYPE_STRING_NAME, NULL}}},
    {"_get_resource_type", type_of, true, {"", STRING, NULL}, 1, {{"path", STRING, NULL}}},
    {"_load", load, true, {"", GDEXTENSION_VARIANT_TYPE_NIL, NULL}, 4,
        {{"path", STRING, NULL}, {"original_path", STRING, NULL},
            {"use_sub_threads", GDEXTENSION_VARIANT_TYPE_BOOL, NULL},
            {"cache_mode", GDEXTENSION_VARIANT_TYPE_INT, NULL}}},
    {0},
};

const gd_class asset_loader_class = {
    .name = "SoftAssetLoader",
    .parent = "ResourceFormatLoader",
    .counted = true,
    .size = sizeof(void *),
    .virtuals = virtuals,
};

static gd_variant loader;

void asset_loader_begin(void) {
  gd_variant resources = gd_singleton("ResourceLoader");
  loader = gd_class_new(&asset_loader_class);
  GD_DO(&resources, "add_resource_format_loader", gd_copy(&loader), gd_bool(false));
  gd_free(&resources);
}

void asset_loader_end(void) {
  gd_variant resources = gd_singleton("ResourceLoader");
  GD_DO(&resources, "remove_resource_format_loader", gd_copy(&loader));
  gd_free(&resources);
  gd_free(&loader);
}
