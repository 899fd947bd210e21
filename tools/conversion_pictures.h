/* Still pictures of an asset at rest, for a report: its skin, its sections, its simulation models, its
 * bones. */
#ifndef CONVERSION_PICTURES_H
#define CONVERSION_PICTURES_H

#include <jansson.h>

#include "sbfmt/asset.h"

/* `file`: path of the written asset, for its image files. Appends an object for each available picture:
 * name, title, caption, width, height and png, base64. If nothing can be drawn, `*why` receives the reason
 * as an allocated text; else NULL. False if memory runs out. */
bool conversion_pictures_draw(const sbf_asset *asset, const char *file, json_t *list, char **why);

#endif
