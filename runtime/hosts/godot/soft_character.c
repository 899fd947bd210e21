#include "soft_character.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

/* Godot's notifications of a node. */
enum { ENTER_TREE = 10, EXIT_TREE = 11, READY = 13, INTERNAL_PROCESS = 25, INTERNAL_PHYSICS_PROCESS = 26 };

static sbf_vec3 turned(sbf_quat q, sbf_vec3 v) {
  sbf_vec3 t = {2 * (q.y * v.z - q.z * v.y), 2 * (q.z * v.x - q.x * v.z), 2 * (q.x * v.y - q.y * v.x)};
  return (sbf_vec3){v.x + q.w * t.x + (q.y * t.z - q.z * t.y), v.y + q.w * t.y + (q.z * t.x - q.x * t.z),
      v.z + q.w * t.z + (q.x * t.y - q.y * t.x)};
}

/* ---- Where it is ---- */

static float heading_of(const gd_transform *place) {
  return atan2f(place->basis[0][2], place->basis[2][2]);
}

static float scale_of(const gd_transform *place) {
  float x = place->basis[0][1], y = place->basis[1][1], z = place->basis[2][1];
  float length = sqrtf(x * x + y * y + z * z);
  return length > 0 ? length : 1;
}

/* The bone that travels with the character. */
static const sbf_bone *body_bone(const sbf_asset *asset, uint32_t *index) {
  *index = asset->gaits.count && asset->gaits.at[0].body >= 0 ? (uint32_t)asset->gaits.at[0].body : 0;
  return asset->bones.count ? &asset->bones.at[*index] : NULL;
}

void soft_character_follow(soft_character *one) {
  uint32_t index, count = one->model->asset->bones.count;
  const sbf_bone *bone = body_bone(one->model->asset, &index);
  sbr_transform *bones = bone ? malloc(count * sizeof *bones) : NULL;
  if (!bones) return;
  sbr_character_bones(one->world, one->id, bones, count);
  sbr_double3 origin = sbr_character_origin(one->world, one->id);
  sbf_quat back = {-bone->rotation.x, -bone->rotation.y, -bone->rotation.z, bone->rotation.w};
  sbf_vec3 ahead = turned(bones[index].rotation, turned(back, (sbf_vec3){0, 0, 1}));
  float heading = atan2f(ahead.x, ahead.z), c = cosf(heading), s = sinf(heading), k = one->scale;
  sbf_vec3 rest = {
      k * (c * bone->head.x + s * bone->head.z), k * bone->head.y, k * (c * bone->head.z - s * bone->head.x)};
  gd_transform *put = &one->put;
  put->origin = (sbf_vec3){(float)(origin.x + bones[index].position.x - rest.x),
      (float)(origin.y + bones[index].position.y - rest.y),
      (float)(origin.z + bones[index].position.z - rest.z)};
  float basis[3][3] = {{k * c, 0, k * s}, {0, k, 0}, {-k * s, 0, k * c}};
  memcpy(put->basis, basis, sizeof basis);
  free(bones);
  GD_DO(&one->node, "set_global_transform", gd_transform_value(*put));
}

double soft_character_ground_height(const soft_character *one, double x, double z) {
  sbf_vec3 normal;
  sbr_ground ground = physics_ground_of(one->ground);
  return ground.height(&ground, x, z, &normal);
}

void soft_character_place(soft_character *one, sbf_vec3 position, float heading) {
  float c = cosf(heading), s = sinf(heading), k = one->scale;
  float basis[3][3] = {{k * c, 0, k * s}, {0, k, 0}, {-k * s, 0, k * c}};
  one->put.origin = position;
  memcpy(one->put.basis, basis, sizeof basis);
  if (one->settings.ground == SOFT_GROUND_PHYSICS) {
    physics_bodies_look(one, true); /* which are no ground */
    physics_ground_look(one);
  }
  double above = position.y - soft_character_ground_height(one, position.x, position.z);
  /* What walks stands on the ground wherever it was put above it; what is loose falls from there. */
  if ((one->model->asset->gaits.count && !one->settings.free_bodies) || above < 0) above = 0;
  sbr_character_teleport(one->world, one->id, (sbr_double3){position.x, above, position.z}, heading);
  one->stale = true;
}

static gd_transform transform_of(soft_character *one) {
  gd_variant value = GD_CALL(&one->node, "get_global_transform");
  gd_transform place = gd_as_transform(&value);
  gd_free(&value);
  return place;
}

/* Whether something else has moved the node since the character left it there. */
static bool was_moved(const gd_transform *a, const gd_transform *b) {
  float x = a->origin.x - b->origin.x, y = a->origin.y - b->origin.y, z = a->origin.z - b->origin.z;
  float turn = a->basis[0][2] * b->basis[2][2] - a->basis[2][2] * b->basis[0][2];
  return x * x + y * y + z * z > 1e-8f || turn * turn > 1e-8f;
}

/* ---- Making ---- */

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
  one->low = low;
  one->high = high;
}

static void unmake(soft_character *one) {
  character_mesh_free(one->mesh);
  character_skeleton_free(one);
  shared_world_leave(one);
  physics_ground_free(one->ground);
  soft_model_release(one->model);
  one->mesh = NULL;
  one->ground = NULL;
  one->model = NULL;
  one->placed = false;
}

static bool make_world(soft_character *one) {
  sbr_world_definition world = sbr_default_world_definition();
  sbr_character_definition character = sbr_default_character_definition();
  sbf_diagnostic error;
  gd_transform place = one->put;
  one->scale = scale_of(&place);
  measure(one);
  one->ground = physics_ground_make(one);
  if (!one->ground) {
    gd_error("no memory for a character");
    return false;
  }
  physics_ground_level(one->ground, one->flat_y);
  character.ground = one->settings.ground == SOFT_GROUND_FLAT && !one->editor
                         ? sbr_ground_flat(one->flat_y)
                         : physics_ground_of(one->ground);
  if (one->settings.threads) world.tasks = worker_pool_tasks();
  world.control_tick_s = one->model->asset->environment.control_tick;
  world.has_gravity = one->model->options.has_gravity;
  world.gravity = one->model->options.gravity;
  character.position = (sbr_double3){place.origin.x, 0, place.origin.z};
  character.heading = heading_of(&place);
  character.scale = one->scale;
  character.hold = one->settings.hold;
  if (!shared_world_join(one, &world)) return false;
  if (sbr_character_create(one->world, one->model->model, &character, &one->id, &error) == SBF_OK)
    return true;
  gd_error(error.message);
  return false;
}

/* All that a world of its own knows, to be put into the next one. */
typedef struct kept_state {
  void *bytes;
  size_t size;
} kept_state;

static kept_state keep(const soft_character *one) {
  kept_state kept = {0};
  if (!one->world || !one->placed || shared_world_count(one->shared) > 1) return kept;
  kept.size = sbr_world_snapshot_size(one->world);
  kept.bytes = malloc(kept.size);
  if (kept.bytes && sbr_world_snapshot_save(one->world, kept.bytes, kept.size) != SBF_OK) {
    free(kept.bytes);
    kept.bytes = NULL;
  }
  return kept;
}

void soft_character_make(soft_character *one) {
  soft_asset *asset = gd_class_instance(&soft_asset_class, gd_as_object(&one->asset_value));
  kept_state kept = keep(one);
  bool was_placed = one->placed;
  gd_variant answer = GD_CALL(&one->node, "is_inside_tree");
  bool inside = gd_take_bool(answer);
  if (inside && !was_placed) {
    one->put = transform_of(one);
    one->flat_y = one->put.origin.y;
  }
  unmake(one);
  if (inside && asset && soft_asset_of(asset)) {
    const soft_settings *s = &one->settings;
    sbf_vec3 g = soft_asset_of(asset)->environment.gravity;
    float k = (float)s->gravity_scale;
    sbr_model_options options = {.level = (uint32_t)s->level,
        .scheme = (sbf_scheme)s->scheme,
        .substeps = (uint32_t)s->substeps,
        .free = s->free_bodies,
        .has_gravity = s->gravity_scale != 1,
        .gravity = {k * g.x, k * g.y, k * g.z}};
    one->model = soft_model_hold(asset, &options);
    if (one->model && make_world(one)) {
      /* A bundle of the same structure goes on as it was; another one begins where that stood. */
      if (kept.bytes && sbr_world_snapshot_restore(one->world, kept.bytes, kept.size) == SBF_OK) {
        one->placed = true;
        if (s->ground == SOFT_GROUND_PHYSICS) physics_ground_look(one);
      } else
        one->placed = s->ground == SOFT_GROUND_FLAT;
      soft_character_drive(one);
      sbr_character_pause(one->world, one->id, s->paused);
      one->mesh = character_mesh_make(one);
      if (s->skeleton) character_skeleton_make(one);
      one->stale = true;
    } else
      unmake(one);
  }
  free(kept.bytes);
  GD_DO(&one->node, "update_gizmos");
}

void soft_character_drive(soft_character *one) {
  const soft_settings *s = &one->settings;
  if (one->world)
    sbr_character_drive(one->world, one->id, (float)s->forward, (float)s->sideways, (float)s->turn);
}

/* ---- Life ---- */

/* In the editor it stands where the node is put, and moves while it previews; then it is put back. */
static void edit(soft_character *one, const gd_transform *now) {
  if (one->previews) GD_DO(&one->node, "set_global_transform", gd_transform_value(one->from));
  if (!one->previews && !was_moved(now, &one->put)) return;
  one->put = one->previews ? one->from : *now;
  one->previews = false;
  one->flat_y = one->put.origin.y;
  physics_ground_level(one->ground, one->flat_y);
  sbr_character_reset(one->world, one->id);
  sbr_character_teleport(
      one->world, one->id, (sbr_double3){one->put.origin.x, 0, one->put.origin.z}, heading_of(&one->put));
  character_skeleton_update(one);
  one->stale = true;
  GD_DO(&one->node, "update_gizmos");
  GD_DO(&one->node, "update_configuration_warnings");
}

bool soft_character_prepare(soft_character *one) {
  gd_transform now = transform_of(one);
  if (one->editor && !one->settings.preview) {
    edit(one, &now);
    return false;
  }
  if (one->editor && !one->previews) {
    one->previews = true;
    one->from = now;
    one->placed = false;
  }
  if (!one->placed || was_moved(&now, &one->put)) {
    soft_character_place(one, now.origin, heading_of(&now));
    one->placed = true;
  } else if (one->settings.ground == SOFT_GROUND_PHYSICS && !one->settings.paused) {
    physics_bodies_look(one, false);
    physics_ground_look(one);
  }
  return !one->settings.paused;
}

void soft_character_show(soft_character *one) {
  soft_character_follow(one);
  character_skeleton_update(one);
  one->stale = true;
}

static void notify(void *self, int32_t what, bool reversed) {
  soft_character *one = self;
  (void)reversed;
  if (what == ENTER_TREE || what == READY) {
    GD_DO(&one->node, "set_physics_process_internal", gd_bool(true));
    GD_DO(&one->node, "set_process_internal", gd_bool(true));
    if (!one->world) soft_character_make(one);
  } else if (what == EXIT_TREE) {
    unmake(one);
  } else if (what == INTERNAL_PHYSICS_PROCESS) {
    if (one->world) shared_world_step(one);
  } else if (what == INTERNAL_PROCESS && one->world && one->stale) {
    character_mesh_update(one->mesh, one);
    one->stale = false;
  }
}

static void begin(void *self, GDExtensionObjectPtr object) {
  soft_character *one = self;
  gd_variant engine = gd_singleton("Engine");
  one->node = gd_object(object);
  one->asset_value = gd_nil();
  one->skeleton = gd_nil();
  one->editor = gd_take_bool(GD_CALL(&engine, "is_editor_hint"));
  one->settings = (soft_settings){.gravity_scale = 1,
      .skeleton = true,
      .threads = true,
      .collision_mask = 1,
      .push_bodies = true,
      .push_limit = 5};
  gd_free(&engine);
}

static void end(void *self) {
  soft_character *one = self;
  unmake(one);
  gd_free(&one->asset_value);
  gd_free(&one->node);
}

#define ARGUMENT(name, kind)                                                                                 \
  { name, GDEXTENSION_VARIANT_TYPE_##kind, NULL }
static const gd_signal signals[] = {
    {"foot_down", 2, {ARGUMENT("leg", INT), ARGUMENT("position", VECTOR3)}},
    {"foot_up", 2, {ARGUMENT("leg", INT), ARGUMENT("position", VECTOR3)}},
    {"landed", 1, {ARGUMENT("position", VECTOR3)}},
    {"contact", 5,
        {ARGUMENT("soft_body", INT), ARGUMENT("position", VECTOR3), ARGUMENT("normal", VECTOR3),
            ARGUMENT("impulse", FLOAT), ARGUMENT("with", OBJECT)}},
    {"torn", 2, {ARGUMENT("soft_body", INT), ARGUMENT("position", VECTOR3)}},
    {0},
};

static const gd_constant constants[] = {
    {"Scheme", "SCHEME_AUTOMATIC", SBF_SCHEME_AUTOMATIC},
    {"Scheme", "SCHEME_SYMPLECTIC", SBF_SCHEME_SYMPLECTIC},
    {"Scheme", "SCHEME_POSITION_BASED", SBF_SCHEME_POSITION_BASED},
    {"Scheme", "SCHEME_RELAXATION", SBF_SCHEME_RELAXATION},
    {"Scheme", "SCHEME_EXPLICIT_EULER", SBF_SCHEME_EXPLICIT_EULER},
    {"Scheme", "SCHEME_HEUN", SBF_SCHEME_HEUN},
    {"Scheme", "SCHEME_BLOCK_DESCENT", SBF_SCHEME_BLOCK_DESCENT},
    {"Ground", "GROUND_PHYSICS", SOFT_GROUND_PHYSICS},
    {"Ground", "GROUND_FLAT", SOFT_GROUND_FLAT},
    {0},
};

const gd_class soft_character_class = {
    .name = "SoftCharacter3D",
    .parent = "Node3D",
    .size = sizeof(soft_character),
    .begin = begin,
    .end = end,
    .notify = notify,
    .methods = soft_character_methods,
    .virtuals = soft_character_virtuals,
    .properties = soft_character_properties,
    .signals = signals,
    .constants = constants,
};
