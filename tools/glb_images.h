/* Images of a .glb for assets whose textures are files beside them. */
#ifndef GLB_IMAGES_H
#define GLB_IMAGES_H

#include "cli.h"
#include "sbfmt/asset.h"

/* The asset of a .glb with the bytes of all its images; NULL if `path` is no .glb or cannot be loaded. Free
 * with sbf_asset_free. */
sbf_asset *glb_images_load(const char *path);

/* Writes the images of the textures of `asset` that are files, and not there yet, beside `out`. `images` has
 * the same textures with their bytes. Reports the first that cannot be written and returns false. */
bool glb_images_write(const cli_call *call, const sbf_asset *asset, const sbf_asset *images, const char *out);

#endif
