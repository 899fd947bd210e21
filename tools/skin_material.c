#include "skin_material.h"

#include <errno.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>

#include "sbfmt/codes.h"

static const size_t LARGEST_FILE = (size_t)256 << 20; /* bytes */

static uint8_t srgb(float linear) {
  double v = linear < 0 ? 0 : linear > 1 ? 1 : (double)linear;
  v = v <= 0.0031308 ? 12.92 * v : 1.055 * pow(v, 1 / 2.4) - 0.055;
  return (uint8_t)(v * 255 + 0.5);
}

/* --- Images -------------------------------------------------------------------------------------------- */

static uint8_t *read_whole(const char *path, size_t *size, char why[DRAW_IMAGE_WHY]) {
  struct stat about;
  FILE *file = NULL;
  uint8_t *bytes = NULL;
  *size = 0;
  if (stat(path, &about) != 0 || (S_ISREG(about.st_mode) && !(file = fopen(path, "rb"))))
    snprintf(why, DRAW_IMAGE_WHY, "its file cannot be read: %s", strerror(errno));
  else if (!file || about.st_size <= 0 || (size_t)about.st_size > LARGEST_FILE)
    snprintf(why, DRAW_IMAGE_WHY, "its file is empty, not a regular file, or larger than 256 MiB");
  else if (!(bytes = malloc((size_t)about.st_size)))
    snprintf(why, DRAW_IMAGE_WHY, "memory ran out");
  else
    *size = fread(bytes, 1, (size_t)about.st_size, file);
  if (file) fclose(file);
  return bytes;
}

/* Paths are relative to the bundle's folder and stay in it. */
static draw_image *load_beside(const char *file, const char *path, char why[DRAW_IMAGE_WHY]) {
  const char *slash = strrchr(file, '/');
  int folder = slash ? (int)(slash - file) + 1 : 0;
  if (!*path || *path == '/' || strchr(path, '\\') || strstr(path, "..")) {
    snprintf(
        why, DRAW_IMAGE_WHY, "%s", *path ? "its path leaves the folder" : "it has neither a path nor bytes");
    return NULL;
  }
  size_t length = (size_t)folder + strlen(path) + 1, size;
  char *whole = malloc(length);
  uint8_t *bytes = NULL;
  draw_image *image = NULL;
  if (whole) {
    snprintf(whole, length, "%.*s%s", folder, file, path);
    bytes = read_whole(whole, &size, why);
  } else {
    snprintf(why, DRAW_IMAGE_WHY, "memory ran out");
  }
  if (bytes) image = draw_image_decode(bytes, size, why);
  free(bytes);
  free(whole);
  return image;
}

static draw_image *load_one(const sbf_texture *texture, const char *file, skin_image_note note, void *user) {
  char why[DRAW_IMAGE_WHY];
  draw_image *image = texture->bytes.count ? draw_image_decode(texture->bytes.at, texture->bytes.count, why)
                                           : load_beside(file, texture->path, why);
  if (image) return image;
  const char *name = *texture->path ? texture->path : *texture->name ? texture->name : texture->id;
  sbf_diagnostic reported = {
      .code = SBF_CODE_IMAGE_NOT_DRAWN, .severity = SBF_SEVERITY_WARNING, .offset = -1, .index = -1};
  snprintf(reported.message, sizeof reported.message,
      "the image '%.100s' is not drawn and its material's colour is used instead: %s", name, why);
  note(user, &reported);
  return NULL;
}

void skin_images_load(
    skin_images *images, const sbf_asset *asset, const char *file, skin_image_note note, void *user) {
  uint32_t count = asset->textures.count;
  bool *tried = calloc(count + 1u, sizeof *tried);
  images->at = calloc(count + 1u, sizeof *images->at);
  images->count = tried && images->at ? count : 0;
  for (uint32_t i = 0; i < asset->materials.count; i++) {
    int32_t texture = asset->materials.at[i].base_color_texture;
    if (texture < 0 || (uint32_t)texture >= images->count || tried[texture]) continue;
    tried[texture] = true;
    images->at[texture] = load_one(&asset->textures.at[texture], file, note, user);
  }
  free(tried);
}

void skin_images_free(skin_images *images) {
  for (uint32_t i = 0; i < images->count; i++) draw_image_destroy(images->at[i]);
  free(images->at);
  *images = (skin_images){NULL, 0};
}

/* --- Looks --------------------------------------------------------------------------------------------- */

static draw_colour stored(sbf_vec4 linear, draw_alpha alpha) {
  double opacity = linear.w < 0 ? 0 : linear.w > 1 ? 1 : (double)linear.w;
  return (draw_colour){srgb(linear.x), srgb(linear.y), srgb(linear.z),
      alpha == DRAW_OPAQUE ? 255 : (uint8_t)(opacity * 255 + 0.5)};
}

static bool colours_fit(const sbf_render_mesh *mesh) {
  return mesh->colors.count &&
         (mesh->color_corners.count || mesh->colors.count == mesh->mesh.positions.count);
}

static const sbf_vec4 WHITE = {1, 1, 1, 1};

skin_material skin_material_of(
    const sbf_asset *asset, const skin_images *images, const sbf_render_mesh *mesh, uint32_t slot) {
  int32_t number = slot < mesh->material_slots.count ? mesh->material_slots.at[slot].material : SBF_NONE;
  skin_material style = {.colour = draw_colour_of_skin(), .base = WHITE, .has_colours = colours_fit(mesh)};
  if (number < 0) return style;
  const sbf_material *material = &asset->materials.at[number];
  style.base = material->base_color;
  style.alpha = material->alpha_mode == SBF_ALPHA_MODE_MASK    ? DRAW_MASK
                : material->alpha_mode == SBF_ALPHA_MODE_BLEND ? DRAW_BLEND
                                                               : DRAW_OPAQUE;
  style.cutoff = material->alpha_cutoff;
  style.one_sided = !material->double_sided;
  style.colour = stored(style.base, style.alpha);
  int32_t texture = material->base_color_texture;
  if (texture >= 0 && (uint32_t)texture < images->count && mesh->uv_sets.count) {
    style.image = images->at[texture];
    style.uv = material->base_color_uv;
  }
  return style;
}

/* As in section 7 of the specification: converts lower left coordinates to glTF's and back. */
static sbf_vec2 transformed(const sbf_uv_transform *by, sbf_vec2 uv) {
  double c = cos((double)by->rotation), s = sin((double)by->rotation);
  double u = (double)by->scale.x * (double)uv.x, v = (double)by->scale.y * (1 - (double)uv.y);
  return (sbf_vec2){
      (float)((double)by->offset.x + u * c + v * s), (float)(1 - ((double)by->offset.y - u * s + v * c))};
}

sbf_vec2 skin_corner_uv(const sbf_render_mesh *mesh, const skin_material *style, uint32_t corner) {
  const sbf_uv_set *set = &mesh->uv_sets.at[0];
  sbf_vec2 uv = set->coordinates
                    .at[set->corners.count ? set->corners.at[corner] : mesh->mesh.polygon_points.at[corner]];
  return style->uv ? transformed(style->uv, uv) : uv;
}

draw_colour skin_corner_colour(const sbf_render_mesh *mesh, const skin_material *style, uint32_t corner) {
  uint32_t at =
      mesh->color_corners.count ? mesh->color_corners.at[corner] : mesh->mesh.polygon_points.at[corner];
  sbf_vec4 own = mesh->colors.at[at], base = style->base;
  return stored((sbf_vec4){own.x * base.x, own.y * base.y, own.z * base.z, own.w * base.w}, style->alpha);
}

void skin_material_apply(const skin_material *style, draw_mesh *mesh) {
  mesh->colour = style->colour;
  mesh->image = style->image;
  mesh->alpha = style->alpha;
  mesh->cutoff = style->cutoff;
  mesh->one_sided = style->one_sided;
}
