/* Checks images: paths within the file's folder that exist, bytes of the stated media type. */
#include <stdio.h>
#include <string.h>

#include "base/file.h"
#include "base/text.h"
#include "validate/validation.h"

static bool is_there(const char *folder, const char *path) {
  char whole[4096];
  int length = snprintf(whole, sizeof whole, "%s/%s", *folder ? folder : ".", path);
  sbfi_file file;
  if (length < 0 || (size_t)length >= sizeof whole || sbfi_file_open(whole, &file, NULL) != SBF_OK)
    return false;
  sbfi_file_close(&file);
  return true;
}

/* Compares the first bytes with the signatures of known media types. */
static const struct {
  const char *media_type, *begins;
  size_t length;
} signatures[] = {{"image/png", "\x89PNG\r\n\x1a\n", 8}, {"image/jpeg", "\xff\xd8\xff", 3},
    {"image/webp", "RIFF", 4}, {"image/gif", "GIF8", 4}, {"image/bmp", "BM", 2},
    {"image/ktx2", "\xabKTX 20\xbb", 8}};

static bool is_of_type(const sbf_texture *texture) {
  for (size_t i = 0; i < sizeof signatures / sizeof *signatures; i++)
    if (strcmp(texture->media_type, signatures[i].media_type) == 0)
      return texture->bytes.count >= signatures[i].length &&
             memcmp(texture->bytes.at, signatures[i].begins, signatures[i].length) == 0;
  return true; /* unknown type */
}

void sbfi_check_textures(sbfi_validation *v) {
  for (uint32_t i = 0; i < v->asset->textures.count; i++) {
    const sbf_texture *texture = &v->asset->textures.at[i];
    const char *name = *texture->name ? texture->name : texture->id;
    sbfi_path path = sbfi_path_of("/sbf/textures/texture[%u]", i + 1);
    if (sbfi_path_leaves_folder(texture->path))
      sbfi_found(
          v, SBF_CODE_TEXTURE_PATH, path.text, -1, "the image '%s' has the path '%s'", name, texture->path);
    else if (*texture->path && !texture->bytes.count && v->options->folder &&
             !is_there(v->options->folder, texture->path))
      sbfi_found(
          v, SBF_CODE_TEXTURE_MISSING, path.text, -1, "the image '%s' is not at '%s'", name, texture->path);
    if (!*texture->path && !texture->bytes.count)
      sbfi_found(
          v, SBF_CODE_TEXTURE_EMPTY, path.text, -1, "the image '%s' has neither a path nor bytes", name);
    if (texture->bytes.count && !is_of_type(texture))
      sbfi_found(v, SBF_CODE_TEXTURE_TYPE, path.text, -1, "the bytes of '%s' are not of the type %s", name,
          texture->media_type);
  }
}
