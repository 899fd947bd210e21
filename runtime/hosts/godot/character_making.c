/* Resources of a node that has an asset and is in a tree: creation, transfer and release. */
#include <math.h>
#include <stdlib.h>

#include "clip_player.h"
#include "physics_parts.h"
#include "pose_driver.h"
#include "sbrun/rigid.h"
#include "soft_character.h"

static void grow(sbf_vec3 *low, sbf_vec3 *high, const sbf_vec3_list *points) {
  for (uint32_t i = 0; i < points->count; i++) {
    sbf_vec3 p = points->at[i];
    *low = (sbf_vec3){fminf(low->x, p.x), fminf(low->y, p.y), fminf(low->z, p.z)};
    *high = (sbf_vec3){fmaxf(high->x, p.x), fmaxf(high->y, p.y), fmaxf(high->z, p.z)};
  }
}

static void measure(soft_character *one) {
  const sbf_asset *asset = one->model->asset;
  sbf_vec3 low = {INFINITY, INFINITY, INFINITY}, high = {-INFINITY, -INFINITY, -INFINITY};
  for (uint32_t i = 0; i < asset->render_meshes.count; i++)
    grow(&low, &high, &asset->render_meshes.at[i].mesh.positions);
  for (uint32_t i = 0; i < asset->soft_bodies.count; i++)
    grow(&low, &high, &asset->soft_bodies.at[i].surface.positions);
  if (!(low.x <= high.x)) low = (sbf_vec3){-0.5f, 0, -0.5f}, high = (sbf_vec3){0.5f, 1, 0.5f};
  one->bounds.low = low;
  one->bounds.high = high;
}

void soft_character_unmake(soft_character *one) {
  character_mesh_free(one->mesh);
  physics_parts_free(one->physics.parts);
  shared_world_leave(one);
  physics_ground_free(one->physics.ground);
  soft_model_release(one->model);
  one->mesh = NULL;
  one->physics.parts = NULL;
  one->grab.is_active = false;
  one->physics.ground = NULL;
  one->model = NULL;
  one->placement.is_placed = false;
}

static bool make_world(soft_character *one) {
  sbr_world_definition world = sbr_default_world_definition();
  sbr_character_definition character = sbr_default_character_definition();
  sbf_diagnostic error;
  gd_transform node_transform = one->placement.shown_at;
  one->scale = transform_scale(&node_transform);
  one->detail_state = SOFT_DETAIL_UNKNOWN;
  one->movement.posture = SBR_POSTURE_UPRIGHT;
  one->loose.is_loose = soft_asset_is_loose(one->model->asset);
  measure(one);
  one->physics.ground = physics_ground_make();
  if (!one->physics.ground) {
    gd_error("no memory for a character");
    return false;
  }
  physics_ground_level(one->physics.ground, one->placement.flat_ground_y);
  character.ground = one->settings.collision.ground == SOFT_GROUND_FLAT && !one->is_in_editor
                         ? sbr_ground_flat(one->placement.flat_ground_y)
                         : physics_ground_of(one->physics.ground);
  if (one->settings.simulation.use_threads) world.tasks = worker_pool_tasks();
  world.control_tick_s = one->model->asset->environment.control_tick;
  world.has_gravity = one->model->options.has_gravity;
  world.gravity = one->model->options.gravity;
  character.position = (sbr_double3){node_transform.origin.x, 0, node_transform.origin.z};
  character.heading = transform_heading(&node_transform);
  character.scale = one->scale;
  character.hold_pose = one->settings.simulation.hold_pose;
  if (!shared_world_join(one, &world)) return false;
  if (sbr_character_create(one->world, one->model->model, &character, &one->id, &error) == SBF_OK) {
    soft_character_loose_begin(one);
    return true;
  }
  gd_error(error.message);
  return false;
}

/* State of a world, to be restored in the next one. */
typedef struct kept_state {
  void *bytes;
  size_t size;
} kept_state;

static kept_state keep(const soft_character *one) {
  kept_state kept = {0};
  if (!one->world || !one->placement.is_placed || shared_world_count(one->shared) > 1) return kept;
  kept.size = sbr_world_get_snapshot_size(one->world);
  kept.bytes = malloc(kept.size);
  if (kept.bytes && sbr_world_save_snapshot(one->world, kept.bytes, kept.size) != SBF_OK) {
    free(kept.bytes);
    kept.bytes = NULL;
  }
  return kept;
}

void soft_character_make(soft_character *one) {
  soft_asset *asset = gd_class_instance(&soft_asset_class, gd_as_object(&one->resources.asset));
  kept_state kept = keep(one);
  bool was_placed = one->placement.is_placed;
  sbr_double3 frame = one->loose.frame;
  gd_variant answer = GD_CALL(&one->node, "is_inside_tree");
  bool inside = gd_take_bool(answer);
  if (inside && !was_placed) {
    one->placement.shown_at = soft_character_transform(one);
    one->placement.flat_ground_y = one->placement.shown_at.origin.y;
  }
  soft_character_unmake(one);
  pose_driver_clear(one);
  if (inside && asset && soft_asset_of(asset)) {
    const soft_simulation_settings *s = &one->settings.simulation;
    sbf_vec3 g = soft_asset_of(asset)->environment.gravity;
    float k = (float)s->gravity_scale;
    sbr_model_options options = sbr_default_model_options();
    options.level = (uint32_t)s->level;
    options.scheme = (sbf_scheme)s->scheme;
    options.substeps = (uint32_t)s->substeps;
    options.free = s->free_bodies;
    options.has_gravity = s->gravity_scale != 1;
    options.detail_levels = s->detail == SOFT_DETAIL_AUTOMATIC && !one->is_in_editor;
    options.gravity = (sbf_vec3){k * g.x, k * g.y, k * g.z};
    one->model =
        pose_driver_is_used(one) ? soft_model_hold_posed(asset, &options) : soft_model_hold(asset, &options);
    if (one->model && make_world(one)) {
      /* A bundle of the same structure keeps its state; another one begins at the same position. */
      if (kept.bytes && sbr_world_restore_snapshot(one->world, kept.bytes, kept.size) == SBF_OK) {
        one->placement.is_placed = true;
        one->loose.frame = frame;
        if (one->settings.collision.ground == SOFT_GROUND_PHYSICS) physics_ground_query(one);
      } else {
        free(one->clip_player);
        one->clip_player = NULL;
        one->placement.is_placed = one->settings.collision.ground == SOFT_GROUND_FLAT;
      }
      clip_player_remade(one);
      soft_character_drive(one);
      one->placement.is_still = false;
      soft_character_pause(one);
      one->mesh = character_mesh_make(one);
      character_skeleton_make(one);
      soft_character_apply_part_settings(one);
      one->is_mesh_stale = true;
    } else
      soft_character_unmake(one);
  } else if (inside)
    character_skeleton_free(one);
  free(kept.bytes);
  GD_DO(&one->node, "update_gizmos");
}

void soft_character_drive(soft_character *one) {
  const soft_drive_settings *s = &one->settings.drive;
  if (!one->world) return;
  sbr_character_set_drive(
      one->world, one->id, (float)s->forward_speed, (float)s->sideways_speed, (float)s->turn_speed);
  sbr_character_set_vertical_speed(one->world, one->id, (float)s->vertical_speed);
}
