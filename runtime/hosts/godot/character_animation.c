/* Methods of SoftCharacter3D for clips and for targets of limbs (sbrun/animation.h). */
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "clip_player.h"
#include "method_table.h"
#include "pose_driver.h"
#include "sbrun/animation.h"
#include "turns.h"

/* ---- Clips ---- */

static bool has_key(const gd_variant *options, const char *key) {
  return gd_type(options) == GDEXTENSION_VARIANT_TYPE_DICTIONARY &&
         gd_take_bool(GD_CALL(options, "has", gd_string(key)));
}

static gd_variant at_key(const gd_variant *options, const char *key) {
  return GD_CALL(options, "get", gd_string(key));
}

/* Reads a number within bounds if it is there; false, with an error, if it is another value. */
static bool read_number(const soft_character *one, const gd_variant *options, const char *key, double low,
    double high, double *number) {
  if (!has_key(options, key)) return true;
  gd_variant value = at_key(options, key);
  GDExtensionVariantType type = gd_type(&value);
  bool good = type == GDEXTENSION_VARIANT_TYPE_INT || type == GDEXTENSION_VARIANT_TYPE_FLOAT ||
              type == GDEXTENSION_VARIANT_TYPE_BOOL;
  double read = type == GDEXTENSION_VARIANT_TYPE_FLOAT ? gd_as_float(&value)
                : good                                 ? (double)gd_as_int(&value)
                                                       : NAN;
  gd_free(&value);
  if (!soft_character_fits(one, key, read, low, high)) return false;
  *number = read;
  return true;
}

static int32_t find_clip(const soft_character *one, const char *name) {
  for (uint32_t i = 0; i < one->model->asset->clips.count; i++)
    if (!strcmp(one->model->asset->clips.at[i].name, name) ||
        !strcmp(one->model->asset->clips.at[i].id, name))
      return (int32_t)i;
  return SBF_NONE;
}

static bool read_mask(const soft_character *one, const gd_variant *options, int32_t *mask) {
  char name[256], message[512];
  if (!has_key(options, "mask")) return true;
  gd_variant value = at_key(options, "mask");
  gd_as_text(&value, name, sizeof name);
  gd_free(&value);
  const sbf_bone_mask_list *masks = &one->model->asset->bone_masks;
  for (uint32_t i = 0; i < masks->count; i++)
    if (!strcmp(masks->at[i].name, name) || !strcmp(masks->at[i].id, name)) return *mask = (int32_t)i, true;
  snprintf(message, sizeof message, "the asset has no bone mask %s: see SoftAsset.get_bone_mask_names", name);
  soft_character_error(one, message);
  return false;
}

/* `options`: a dictionary, the fade in seconds, or nil. Unknown keys are refused, because they are mistyped.
 */
static bool read_request(
    const soft_character *one, const gd_variant *const *arguments, clip_request *request, uint32_t *layer) {
  static const char *const keys[] = {"loop", "speed", "blend", "weight", "mask", "layer", "root_motion"};
  char name[256], message[512];
  const gd_variant *options = arguments[1];
  gd_as_text(arguments[0], name, sizeof name);
  *request = (clip_request){.clip = find_clip(one, name), .mask = SBF_NONE, .speed = 1, .weight = 1};
  if (name[0] && request->clip == SBF_NONE) {
    snprintf(message, sizeof message, "play: the asset has no clip %s: see SoftAsset.get_clip_names", name);
    soft_character_error(one, message);
    return false;
  }
  double loops = request->clip != SBF_NONE && one->model->asset->clips.at[request->clip].loop, speed = 1,
         blend = 0, weight = 1, number = 0, root = 0;
  int64_t known = 0;
  for (size_t i = 0; i < sizeof keys / sizeof *keys; i++) known += has_key(options, keys[i]);
  if (gd_type(options) == GDEXTENSION_VARIANT_TYPE_INT ||
      gd_type(options) == GDEXTENSION_VARIANT_TYPE_FLOAT) {
    blend = gd_as_float(options);
    if (!soft_character_fits(one, "blend", blend, 0, SOFT_MAX)) return false;
  } else if (gd_type(options) != GDEXTENSION_VARIANT_TYPE_NIL &&
             (gd_type(options) != GDEXTENSION_VARIANT_TYPE_DICTIONARY || known != gd_size(options))) {
    soft_character_error(one,
        "play: the options are a dictionary with loop, speed, blend, weight, mask, layer and root_motion, or "
        "the seconds of the blend");
    return false;
  }
  if (!read_number(one, options, "loop", 0, 1, &loops) ||
      !read_number(one, options, "speed", -SOFT_MAX, SOFT_MAX, &speed) ||
      !read_number(one, options, "blend", 0, SOFT_MAX, &blend) ||
      !read_number(one, options, "weight", 0, 1, &weight) ||
      !read_number(one, options, "root_motion", 0, 1, &root) ||
      !read_number(
          one, options, "layer", 0, pose_driver_is_used(one) ? POSE_LAYER - 1 : CLIP_LAYERS - 1, &number) ||
      !read_mask(one, options, &request->mask))
    return false;
  request->loops = loops != 0, request->root_motion = root != 0;
  request->speed = (float)speed, request->blend_s = (float)blend, request->weight = (float)weight;
  *layer = (uint32_t)number;
  return true;
}

static bool has_player(soft_character *one) {
  if (!one->world) return false;
  if (one->clip_player) return true;
  one->clip_player = calloc(1, sizeof *one->clip_player);
  if (!one->clip_player) return gd_error("no memory for a character's clips"), false;
  for (uint32_t i = 0; i < CLIP_LAYERS; i++) one->clip_player->layers[i].now.clip = SBF_NONE;
  one->clip_player->tick = sbr_world_get_tick_count(one->world);
  return true;
}

CALL(play) {
  soft_character *one = self;
  clip_request request;
  uint32_t layer;
  UNUSED;
  if (has_player(one) && read_request(one, arguments, &request, &layer))
    clip_player_play(one, layer, &request);
}

CALL(queue) {
  soft_character *one = self;
  clip_request request;
  uint32_t layer;
  UNUSED;
  if (has_player(one) && read_request(one, arguments, &request, &layer) &&
      !clip_player_queue(one, layer, &request))
    soft_character_error(one, "queue: 8 clips are waiting already: wait until one of them has started");
}

static const clip_layer *layer_of(const soft_character *one, const gd_variant *layer) {
  int64_t number = gd_type(layer) == GDEXTENSION_VARIANT_TYPE_NIL ? 0 : gd_as_int(layer);
  return one->world && one->clip_player && number >= 0 && number < CLIP_LAYERS
             ? &one->clip_player->layers[number]
             : NULL;
}

CALL(get_current_clip) {
  const soft_character *one = self;
  const clip_layer *l = layer_of(one, arguments[0]);
  const sbf_clip *clip = l && l->plays ? &one->model->asset->clips.at[l->now.clip] : NULL;
  gd_assign(result, gd_string(!clip ? "" : clip->name[0] ? clip->name : clip->id));
}

CALL(get_clip_position) {
  const clip_layer *l = layer_of(self, arguments[0]);
  gd_assign(result, gd_float(l ? l->time_s : 0));
}

/* ---- Targets of limbs ---- */

/* The chain that ends at the bone, or has that name. */
static int32_t find_chain(const soft_character *one, const gd_variant *wanted) {
  char name[256], message[512];
  const sbf_ik_chain_list *chains = &one->model->asset->ik_chains;
  int32_t bone = soft_character_bone(one, wanted);
  gd_as_text(wanted, name, sizeof name);
  for (uint32_t i = 0; i < chains->count; i++)
    if ((bone >= 0 && chains->at[i].end == bone) || !strcmp(chains->at[i].name, name) ||
        !strcmp(chains->at[i].id, name))
      return (int32_t)i;
  snprintf(message, sizeof message,
      "the asset has no ik_chain that ends at the bone %s, or has that name: see "
      "SoftAsset.get_ik_chain_names",
      name);
  soft_character_error(one, message);
  return -1;
}

static bool is_finite(const gd_transform *t) {
  float sum = t->origin.x + t->origin.y + t->origin.z;
  for (int i = 0; i < 3; i++) sum += t->basis[i][0] + t->basis[i][1] + t->basis[i][2];
  return isfinite(sum);
}

CALL(set_ik_target) {
  soft_character *one = self;
  gd_transform at = gd_as_transform(arguments[1]);
  double weight = gd_type(arguments[2]) == GDEXTENSION_VARIANT_TYPE_NIL ? 1 : gd_as_float(arguments[2]);
  UNUSED;
  if (!one->world || !soft_character_fits(one, "set_ik_target: weight", weight, 0, 1)) return;
  int32_t chain = find_chain(one, arguments[0]);
  if (chain < 0) return;
  if (!is_finite(&at) || !transform_unscale(&at)) {
    soft_character_error(
        one, "set_ik_target: the transform is not finite, or has no scale; it stays as it was");
    return;
  }
  sbr_ik_target target = sbr_default_ik_target();
  target.position = (sbr_double3){(double)at.origin.x, (double)at.origin.y, (double)at.origin.z};
  target.rotation = turn_of(at.basis);
  target.weight = (float)weight;
  sbr_character_set_ik_target(one->world, one->id, (uint32_t)chain, &target);
}

CALL(clear_ik_target) {
  soft_character *one = self;
  UNUSED;
  int32_t chain = one->world ? find_chain(one, arguments[0]) : -1;
  if (chain >= 0) sbr_character_set_ik_target(one->world, one->id, (uint32_t)chain, NULL);
}

const gd_method soft_character_animation_methods[] = {
    {"play", play, NOTHING, 2, {WITH("clip", STRING), WITH("options", NIL)}},
    {"queue", queue, NOTHING, 2, {WITH("clip", STRING), WITH("options", NIL)}},
    {"get_current_clip", get_current_clip, ANSWER(STRING), 1, {WITH("layer", NIL)}},
    {"get_clip_position", get_clip_position, ANSWER(FLOAT), 1, {WITH("layer", NIL)}},
    {"set_ik_target", set_ik_target, NOTHING, 3,
        {WITH("bone", STRING), WITH("target", TRANSFORM3D), WITH("weight", NIL)}},
    {"clear_ik_target", clear_ik_target, NOTHING, 1, {WITH("bone", STRING)}},
    {0},
};
