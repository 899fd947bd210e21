/* SoftAsset: a packed bundle as a Godot resource, and the models that characters make of it.
 *
 * The bytes of the .sbfz are the resource's one stored property, so that it copies, saves and reloads as any
 * resource does. Characters hold the content they were made of, also when the resource takes another. */
#ifndef SBFMT_GODOT_SOFT_ASSET_H
#define SBFMT_GODOT_SOFT_ASSET_H

#include "classes.h"

/* A bundle and one model of it, shared by all characters with the same settings; counted. */
typedef struct soft_content soft_content;
typedef struct soft_model {
  soft_content *content;
  sbr_model *model;
  const sbf_asset *asset;
  sbr_model_options options;
  uint32_t holders;
  struct soft_model *next;
} soft_model;

typedef struct soft_asset {
  GDExtensionObjectPtr object;
  soft_content *content; /* NULL: nothing was loaded */
} soft_asset;

extern const gd_class soft_asset_class;

/* NULL where the resource is empty or the model cannot be made, which is then in Godot's log. */
soft_model *soft_model_hold(soft_asset *asset, const sbr_model_options *options);
void soft_model_release(soft_model *model); /* NULL does nothing */
/* Where the content keeps the StandardMaterial3D and the ImageTexture of those numbers of its asset, for all
 * that show it: nil until the caller has put one there. NULL without memory or such a number. On the main
 * thread. */
gd_variant *soft_model_material(soft_model *model, int32_t index);
gd_variant *soft_model_texture(soft_model *model, int32_t index);
const sbf_asset *soft_asset_of(const soft_asset *asset); /* NULL: empty */
/* A file's bytes in it; false, with the reason in Godot's log, leaves it as it was. */
bool soft_asset_read(soft_asset *asset, const gd_variant *bytes, const char *name);

#endif
