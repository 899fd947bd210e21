/* SoftAsset: a packed bundle as a Godot resource, and the models that characters create from it.
 *
 * The bytes of the .sbfz are the only stored property of the resource, so that it copies, saves and reloads
 * like any resource. Characters keep the content they were created from, even when the resource loads another
 * one. */
#ifndef SBFMT_GODOT_SOFT_ASSET_H
#define SBFMT_GODOT_SOFT_ASSET_H

#include "classes.h"
#include "pose_clip.h"

/* A bundle and one model of it, shared by all characters with the same settings; reference counted. */
typedef struct soft_content soft_content;
typedef struct soft_model {
  soft_content *content;
  sbr_model *model;
  const sbf_asset *asset;
  sbr_model_options options;
  pose_clip pose; /* of the one character that has it; else without an asset */
  uint32_t holders;
  struct soft_model *next;
} soft_model;

typedef struct soft_asset {
  GDExtensionObjectPtr object;
  soft_content *content; /* NULL: not loaded */
} soft_asset;

extern const gd_class soft_asset_class;

/* NULL if the resource is empty or the model cannot be created, which is then in Godot's log. */
soft_model *soft_model_hold(soft_asset *asset, const sbr_model_options *options);
/* A model of a copy of the asset with a clip that its character writes. */
soft_model *soft_model_hold_posed(soft_asset *asset, const sbr_model_options *options);
pose_clip *soft_model_pose(soft_model *model); /* NULL: it has none */
void soft_model_release(soft_model *model);    /* NULL does nothing */
/* Storage for the StandardMaterial3D and the ImageTexture with those indices of the asset, shared by all
 * nodes: nil until the caller has set them. NULL without memory or such an index. Main thread only. */
gd_variant *soft_model_material(soft_model *model, int32_t index);
gd_variant *soft_model_texture(soft_model *model, int32_t index);
const sbf_asset *soft_asset_of(const soft_asset *asset); /* NULL: empty */
/* Loads a file's bytes; on failure returns false, with the reason in Godot's log, and changes nothing. */
bool soft_asset_read(soft_asset *asset, const gd_variant *bytes, const char *name);

#endif
