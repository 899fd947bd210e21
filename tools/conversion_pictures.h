/* Still pictures of an asset at rest, for a report: its skin, its sections, what moves them, its bones. */
#ifndef CONVERSION_PICTURES_H
#define CONVERSION_PICTURES_H

#include <jansson.h>

#include "sbfmt/asset.h"

/* `file`: where the asset was written, beside which its images are. Appends an object for each picture that
 * there is something for: name, title, caption, width, height and png, base64. Where nothing can be drawn
 * here `*why` becomes the reason, new text to be freed; else NULL. False where memory runs out. */
bool conversion_pictures_draw(const sbf_asset *asset, const char *file, json_t *list, char **why);

#endif
