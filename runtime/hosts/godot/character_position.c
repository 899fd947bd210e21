/* Position of a character: its node follows it, and it follows its node. */
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "physics_parts.h"
#include "soft_character.h"
#include "turns.h"

float transform_heading(const gd_transform *node_transform) {
  return atan2f(node_transform->basis[0][2], node_transform->basis[2][2]);
}

float transform_scale(const gd_transform *node_transform) {
  float x = node_transform->basis[0][1], y = node_transform->basis[1][1], z = node_transform->basis[2][1];
  float length = sqrtf(x * x + y * y + z * z);
  return length > 0 ? length : 1;
}

/* The bone that moves with the character. */
static const sbf_bone *body_bone(const sbf_asset *asset, uint32_t *index) {
  *index = asset->gaits.count && asset->gaits.at[0].body >= 0 ? (uint32_t)asset->gaits.at[0].body : 0;
  return asset->bones.count ? &asset->bones.at[*index] : NULL;
}

double soft_character_size(const soft_character *one) {
  float wide =
      fmaxf(fmaxf(one->bounds.high.x, -one->bounds.low.x), fmaxf(one->bounds.high.z, -one->bounds.low.z));
  return (double)(fmaxf(wide, one->bounds.high.y - one->bounds.low.y) * one->scale);
}

double soft_character_around(const soft_character *one) {
  float wide =
      fmaxf(fmaxf(one->bounds.high.x, -one->bounds.low.x), fmaxf(one->bounds.high.z, -one->bounds.low.z)) *
      one->scale;
  double size = soft_character_size(one); /* a tall character may lie down */
  return fmax(1.5 * (double)wide + 0.1 * size, size);
}

/* Stores the transform after the parent's rounding, for later comparison. */
static void leave_node(soft_character *one) {
  GD_DO(&one->node, "set_global_transform", gd_transform_value(one->placement.shown_at));
  one->placement.shown_at = soft_character_transform(one);
}

void soft_character_follow(soft_character *one) {
  if (one->placement.was_displaced &&
      one->placement.displaced_at_tick == sbr_world_get_tick_count(one->world))
    return;
  one->placement.was_displaced = false;
  if (soft_character_loose_follow(one)) {
    leave_node(one);
    return;
  }
  uint32_t index, count = one->model->asset->bones.count;
  const sbf_bone *bone = body_bone(one->model->asset, &index);
  sbr_transform *bones = bone ? malloc(count * sizeof *bones) : NULL;
  if (!bones) return;
  sbr_character_get_bones(one->world, one->id, bones, count);
  sbr_double3 origin = sbr_character_get_origin(one->world, one->id);
  sbf_vec3 at = bones[index].position;
  sbf_vec3 ahead = turned(bones[index].rotation, turned(turn_back(bone->rotation), (sbf_vec3){0, 0, 1}));
  one->placement.shown_at = upright((sbf_vec3){0, 0, 0}, atan2f(ahead.x, ahead.z), one->scale);
  sbf_vec3 rest = placed_vector(&one->placement.shown_at, bone->head);
  one->placement.shown_at.origin = (sbf_vec3){(float)(origin.x + (double)(at.x - rest.x)),
      (float)(origin.y + (double)(at.y - rest.y)), (float)(origin.z + (double)(at.z - rest.z))};
  free(bones);
  leave_node(one);
}

double soft_character_ground_height(const soft_character *one, double x, double z) {
  sbf_vec3 normal;
  sbr_ground ground = physics_ground_of(one->physics.ground);
  return ground.height(&ground, x, z, &normal);
}

void soft_character_set_position(soft_character *one, sbf_vec3 position, float heading) {
  one->placement.shown_at = upright(position, heading, one->scale);
  one->placement.last_origin = position;
  if (one->settings.collision.ground == SOFT_GROUND_PHYSICS) {
    physics_bodies_query(one, true);
    physics_ground_query(one);
  }
  one->is_mesh_stale = true;
  if (soft_character_set_loose_position(one)) return;
  double above = position.y - soft_character_ground_height(one, position.x, position.z);
  if (above < 0) above = 0; /* it falls from there */
  sbr_character_teleport(one->world, one->id, (sbr_double3){position.x, above, position.z}, heading);
}

gd_transform soft_character_transform(const soft_character *one) {
  gd_variant value = GD_CALL(&one->node, "get_global_transform");
  gd_transform node_transform = gd_as_transform(&value);
  gd_free(&value);
  return node_transform;
}

/* Movement of the node since the character placed it there. */
typedef struct node_move {
  sbf_vec3 by; /* m */
  float turn;  /* rad, about +Y */
  bool any;
} node_move;

static const float STILL = 1e-12f; /* m^2 and rad^2: rounding error of the node's transform */

static node_move move_of(const gd_transform *now, const gd_transform *put) {
  node_move made = {
      .by = {now->origin.x - put->origin.x, now->origin.y - put->origin.y, now->origin.z - put->origin.z}};
  float sine = now->basis[0][2] * put->basis[2][2] - now->basis[2][2] * put->basis[0][2];
  float cosine = now->basis[0][2] * put->basis[0][2] + now->basis[2][2] * put->basis[2][2];
  made.turn = atan2f(sine, cosine);
  made.any = !(made.by.x * made.by.x + made.by.y * made.by.y + made.by.z * made.by.z <= STILL &&
               made.turn * made.turn <= STILL);
  return made;
}

static const float LARGEST_TURN = 1; /* rad per frame: larger rotations are placements */

/* Whether the character walks to the new position. Characters without pins, and larger movements, are placed
 * there. */
static bool steps_there(const soft_character *one, const node_move *move) {
  double limit = one->settings.teleport_distance, size = soft_character_size(one);
  float x = move->by.x, y = move->by.y, z = move->by.z;
  if (one->loose.is_loose || one->is_in_editor || one->settings.paused || !(fabsf(move->turn) < LARGEST_TURN))
    return false;
  return sqrt((double)(x * x + y * y + z * z)) < (limit > 0 ? limit : size / 2);
}

/* ---- A frame ---- */

void soft_character_save(soft_character *one, bool done) {
  if (one->preview.is_running)
    GD_DO(&one->node, "set_global_transform",
        gd_transform_value(done ? one->placement.shown_at : one->preview.started_at));
}

/* In the editor the character is at the node's position, moves during a preview, and is reset afterwards. */
static void edit(soft_character *one, const gd_transform *now) {
  if (one->preview.is_running)
    GD_DO(&one->node, "set_global_transform", gd_transform_value(one->preview.started_at));
  if (!one->preview.is_running && !move_of(now, &one->placement.shown_at).any) return;
  one->placement.shown_at = one->preview.is_running ? one->preview.started_at : *now;
  one->preview.is_running = false;
  one->placement.flat_ground_y = one->placement.shown_at.origin.y;
  physics_ground_level(one->physics.ground, one->placement.flat_ground_y);
  sbr_character_reset(one->world, one->id);
  one->loose.frame = (sbr_double3){one->placement.shown_at.origin.x, 0, one->placement.shown_at.origin.z};
  sbr_character_teleport(one->world, one->id, one->loose.frame, transform_heading(&one->placement.shown_at));
  character_skeleton_update(one);
  one->is_mesh_stale = true;
  GD_DO(&one->node, "update_gizmos");
}

bool soft_character_prepare(soft_character *one) {
  gd_transform now = soft_character_transform(one);
  if (one->is_in_editor && memcmp(&now, &one->preview.warned_at, sizeof now) != 0) {
    one->preview.warned_at = now;
    GD_DO(&one->node, "update_configuration_warnings");
  }
  if (one->is_in_editor && !one->settings.preview) {
    edit(one, &now);
    return false;
  }
  if (one->is_in_editor && !one->preview.is_running) {
    one->preview.is_running = true;
    one->preview.started_at = now;
    one->placement.is_placed = false;
  }
  node_move move = move_of(&now, &one->placement.shown_at);
  if (one->placement.is_placed &&
      !isfinite(move.by.x + move.by.y + move.by.z + move.turn)) { /* invalid movement: it stays */
    leave_node(one);
    move = (node_move){.any = false};
  }
  bool steps = one->placement.is_placed && move.any && steps_there(one, &move);
  if (steps) {
    sbr_character_displace(one->world, one->id, move.by, move.turn);
    one->placement.shown_at = now; /* a frame without a tick keeps it there */
    one->placement.was_displaced = true;
    one->placement.displaced_at_tick = sbr_world_get_tick_count(one->world);
  }
  bool placed = !one->placement.is_placed || (move.any && !steps);
  if (placed) {
    soft_character_set_position(one, now.origin, transform_heading(&now));
    one->placement.is_placed = true;
  } else if (one->settings.collision.ground == SOFT_GROUND_PHYSICS && !one->settings.paused) {
    physics_bodies_query(one, false);
  }
  soft_character_pause(one);
  if (one->placement.is_still && placed) physics_parts_move(one->physics.parts, one);
  return !one->placement.is_still;
}

/* A node that does not process may still be stepped by another node of its world. */
void soft_character_pause(soft_character *one) {
  bool still = one->settings.paused || !gd_take_bool(GD_CALL(&one->node, "can_process"));
  if (one->world && still != one->placement.is_still) sbr_character_set_paused(one->world, one->id, still);
  one->placement.is_still = still;
}

/* Said once for each time that it becomes negative. */
static void check_mirrored(soft_character *one, const gd_transform *now) {
  const float(*m)[3] = now->basis;
  float determinant = m[0][0] * (m[1][1] * m[2][2] - m[1][2] * m[2][1]) -
                      m[0][1] * (m[1][0] * m[2][2] - m[1][2] * m[2][0]) +
                      m[0][2] * (m[1][0] * m[2][1] - m[1][1] * m[2][0]);
  if (determinant < 0 && !one->is_mirrored)
    soft_character_error(
        one, "its scale is negative: a character cannot be mirrored, so the absolute scale is used");
  one->is_mirrored = determinant < 0;
}

bool soft_character_rescale(soft_character *one) {
  gd_transform now = soft_character_transform(one);
  check_mirrored(one, &now);
  float scale = transform_scale(&now);
  if (fabsf(scale - one->scale) <= 1e-4f * one->scale) return false;
  one->placement.is_placed = false; /* it restarts at its position */
  soft_character_make(one);
  return true;
}

void soft_character_show(soft_character *one) {
  soft_character_follow(one);
  physics_parts_move(one->physics.parts, one);
  character_skeleton_update(one);
  one->is_mesh_stale = true;
}
