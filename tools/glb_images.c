#include "glb_images.h"

#include <errno.h>
#include <string.h>
#include <sys/stat.h>

#include "base/system.h"
#include "output_name.h"
#include "sbfmt/gltf.h"

sbf_asset *glb_images_load(const char *path) {
  sbf_asset *asset = NULL;
  sbf_diagnostic unused;
  if (!output_name_ends(path, ".glb") && !output_name_ends(path, ".vrm")) return NULL;
  sbf_gltf_load_file(path, &(sbf_load_options){.with_images = true}, &asset, &unused);
  return asset;
}

/* Makes the folders of a path below `from` characters. */
static bool make_folders(char *path, size_t from) {
  for (char *at = strchr(path + from, '/'); at; at = strchr(at + 1, '/')) {
    *at = 0;
    bool made = system_make_folder(path);
    *at = '/';
    if (!made) return false;
  }
  return true;
}

/* Under a temporary name first, so that no half of an image stays. */
static bool write_whole(const char *path, sbf_u8_list bytes) {
  char temporary[4200];
  snprintf(temporary, sizeof temporary, "%s.part", path);
  FILE *file = fopen(temporary, "wb");
  if (!file) return false;
  bool good = fwrite(bytes.at, 1, bytes.count, file) == bytes.count;
  good = fclose(file) == 0 && good;
  good = good && system_replace_file(temporary, path);
  if (!good) remove(temporary);
  return good;
}

static bool leaves_folder(const char *path) {
  return *path == '/' || strchr(path, '\\') || strstr(path, "..");
}

bool glb_images_write(
    const cli_call *call, const sbf_asset *asset, const sbf_asset *images, const char *out) {
  const char *slash = strrchr(out, '/');
  int folder = slash ? (int)(slash - out) + 1 : 0;
  for (uint32_t i = 0; i < asset->textures.count && i < images->textures.count; i++) {
    const sbf_texture *texture = &asset->textures.at[i];
    sbf_u8_list bytes = images->textures.at[i].bytes;
    char path[4096];
    struct stat facts;
    if (texture->bytes.count || !bytes.count || !*texture->path || leaves_folder(texture->path)) continue;
    int length = snprintf(path, sizeof path, "%.*s%s", folder, out, texture->path);
    if (length < 0 || (size_t)length >= sizeof path || stat(path, &facts) == 0) continue;
    if (make_folders(path, (size_t)folder) && write_whole(path, bytes)) continue;
    cli_wrong(call, "the image %s cannot be written: %s", path, strerror(errno));
    return false;
  }
  return true;
}
