#include "import/scene/bind_pose.h"

#include <math.h>
#include <string.h>

#include "import/scene/bind_space.h"
#include "import/scene/trs.h"

/* Minimum difference between two poses, as sbfi_bind_worlds measures it. */
static const double SAME_POSE = 1e-3;

/* During the computation the last element of each world matrix, finally 1, marks its source. */
enum { UNSET = 0, FROM_SKIN = 1, FROM_BELOW = 2 };

/* Sets the joints' worlds from their bind matrices and the skins' bind spaces. */
static bool set_joints(const sbfi_scene *scene, sbfi_matrix *worlds) {
  sbfi_arena scratch;
  sbfi_arena_init(&scratch, &scene->arena.allocator, 0);
  sbfi_matrix *spaces = sbfi_arena_allocate(&scratch, (size_t)scene->mesh_count + 1, sizeof *spaces);
  bool good = spaces && sbfi_bind_spaces(scene, spaces);
  /* Later skins first, so that the first skin wins. */
  for (uint32_t m = scene->mesh_count; good && m-- > 0;) {
    const sbfi_scene_mesh *mesh = &scene->meshes[m];
    for (uint32_t j = 0; j < mesh->skin.joint_count; j++) {
      sbfi_matrix to_mesh;
      if (!sbfi_matrix_invert(&mesh->skin.joints[j].bind, &to_mesh)) continue;
      worlds[mesh->skin.joints[j].node] = sbfi_matrix_multiply(&spaces[m], &to_mesh);
    }
  }
  sbfi_arena_free(&scratch);
  return good;
}

/* Sets a bone without a skin but with a joint below it from its first child, as if that had not moved
 * relative to it since. Children come after their parents, so a reverse pass works. */
static void set_bones_above(const sbfi_scene *scene, sbfi_matrix *worlds) {
  for (uint32_t i = scene->node_count; i-- > 0;) {
    int32_t parent = scene->nodes[i].parent;
    sbfi_matrix to_parent;
    if (worlds[i].at[3][3] == UNSET || !scene->nodes[i].is_bone) continue;
    if (parent == SBF_NONE || !scene->nodes[parent].is_bone) continue;
    if (worlds[parent].at[3][3] == FROM_SKIN) continue;
    if (!sbfi_matrix_invert(&scene->nodes[i].local, &to_parent)) continue;
    worlds[parent] = sbfi_matrix_multiply(&worlds[i], &to_parent);
    worlds[parent].at[3][3] = FROM_BELOW;
  }
}

static double distance(const sbfi_matrix *a, const sbfi_matrix *b) {
  double squared = 0;
  for (int k = 0; k < 3; k++) squared += (a->at[k][3] - b->at[k][3]) * (a->at[k][3] - b->at[k][3]);
  return sqrt(squared);
}

/* Largest sine of the angle between corresponding axes. */
static double angle_between(const sbfi_matrix *a, const sbfi_matrix *b) {
  double max = 0;
  for (int axis = 0; axis < 3; axis++) {
    double aa = 0, bb = 0, ab = 0;
    for (int k = 0; k < 3; k++) {
      aa += a->at[k][axis] * a->at[k][axis];
      bb += b->at[k][axis] * b->at[k][axis];
      ab += a->at[k][axis] * b->at[k][axis];
    }
    double cosine = aa > 0 && bb > 0 ? ab / sqrt(aa * bb) : 1;
    double sine = cosine <= 0 ? 1 : cosine >= 1 ? 0 : sqrt(1 - cosine * cosine);
    max = sine > max ? sine : max;
  }
  return max;
}

static double deviation(const sbfi_scene *scene, const sbfi_matrix *worlds) {
  double max_moved = 0, max_angle = 0, size = 0;
  const sbfi_matrix *first = NULL;
  for (uint32_t i = 0; i < scene->node_count; i++) {
    const sbfi_matrix *rest = &scene->nodes[i].world;
    if (!scene->nodes[i].is_bone) continue;
    if (!first) first = rest;
    size = fmax(size, distance(first, rest));
    max_moved = fmax(max_moved, distance(&worlds[i], rest));
    max_angle = fmax(max_angle, angle_between(&worlds[i], rest));
  }
  return size > 0 ? fmax(max_angle, max_moved / size) : max_angle;
}

bool sbfi_bind_worlds(const sbfi_scene *scene, sbfi_matrix *worlds, double *difference) {
  for (uint32_t i = 0; i < scene->node_count; i++) worlds[i].at[3][3] = UNSET;
  if (!set_joints(scene, worlds)) return false;
  set_bones_above(scene, worlds);
  for (uint32_t i = 0; i < scene->node_count; i++) {
    const sbfi_scene_node *node = &scene->nodes[i];
    if (worlds[i].at[3][3] == UNSET)
      worlds[i] =
          node->parent == SBF_NONE ? node->local : sbfi_matrix_multiply(&worlds[node->parent], &node->local);
    worlds[i].at[3][3] = 1;
  }
  *difference = deviation(scene, worlds);
  return true;
}

/* --- Taking it as the rest pose --------------------------------------------------------------------- */

typedef struct rest_key {
  float time;
  sbf_vec3 position, scale;
  sbf_quat rotation;
} rest_key;

/* Adds a constant key at the rest value to each empty track of a channel. */
static void complete(sbfi_scene_channel *channel, const rest_key *rest) {
  if (!channel->position_count) {
    channel->position_count = 1;
    channel->position_times = &rest->time;
    channel->positions = &rest->position;
  }
  if (!channel->rotation_count) {
    channel->rotation_count = 1;
    channel->rotation_times = &rest->time;
    channel->rotations = &rest->rotation;
  }
  if (!channel->scale_count) {
    channel->scale_count = 1;
    channel->scale_times = &rest->time;
    channel->scales = &rest->scale;
  }
}

static rest_key *rest_keys(sbfi_scene *scene) {
  rest_key *keys = sbfi_arena_allocate(&scene->arena, scene->node_count, sizeof *keys);
  for (uint32_t i = 0; keys && i < scene->node_count; i++) {
    sbfi_trs t = sbfi_trs_decompose(&scene->nodes[i].local);
    keys[i].position = (sbf_vec3){(float)t.position[0], (float)t.position[1], (float)t.position[2]};
    keys[i].scale = (sbf_vec3){(float)t.scale[0], (float)t.scale[1], (float)t.scale[2]};
    keys[i].rotation =
        (sbf_quat){(float)t.rotation[0], (float)t.rotation[1], (float)t.rotation[2], (float)t.rotation[3]};
  }
  return keys;
}

/* Adds a channel to every bone: bones without one stayed in the saved pose. */
static bool complete_clip(sbfi_scene *scene, sbfi_scene_clip *clip, const rest_key *rest) {
  sbfi_scene_channel *channels =
      sbfi_arena_allocate(&scene->arena, (size_t)clip->channel_count + scene->node_count, sizeof *channels);
  bool *moved = sbfi_arena_allocate(&scene->arena, scene->node_count, sizeof *moved);
  if (!channels || !moved) return false;
  uint32_t count = clip->channel_count;
  if (count) memcpy(channels, clip->channels, count * sizeof *channels);
  for (uint32_t i = 0; i < count; i++) {
    moved[channels[i].node] = true;
    complete(&channels[i], &rest[channels[i].node]);
  }
  for (uint32_t i = 0; i < scene->node_count; i++) {
    if (moved[i] || !scene->nodes[i].is_bone) continue;
    channels[count].node = (int32_t)i;
    complete(&channels[count++], &rest[i]);
  }
  clip->channels = channels;
  clip->channel_count = count;
  return true;
}

static bool complete_clips(sbfi_scene *scene) {
  if (!scene->clip_count) return true;
  const rest_key *rest = rest_keys(scene);
  sbfi_scene_clip *clips = sbfi_arena_copy(&scene->arena, scene->clips, scene->clip_count, sizeof *clips);
  if (!rest || !clips) return false;
  for (uint32_t i = 0; i < scene->clip_count; i++)
    if (!complete_clip(scene, &clips[i], rest)) return false;
  scene->clips = clips;
  return true;
}

static bool is_usable(const sbfi_matrix *m) {
  for (int k = 0; k < 12; k++)
    if (!(fabs(m->at[k / 4][k % 4]) <= 1e30)) return false;
  return true;
}

/* A damaged file may contain nearly singular bind matrices, whose inverses overflow single precision. */
static bool all_usable(const sbfi_scene *scene, const sbfi_matrix *worlds) {
  for (uint32_t i = 0; i < scene->node_count; i++)
    if (!is_usable(&worlds[i]) || !is_usable(&scene->nodes[i].local)) return false;
  return true;
}

bool sbfi_scene_apply_bind_pose(sbfi_scene *scene) {
  bool skinned = false;
  for (uint32_t i = 0; i < scene->mesh_count; i++) skinned = skinned || scene->meshes[i].skin.joint_count;
  if (!skinned) return true;
  sbfi_matrix *worlds = sbfi_arena_allocate(&scene->arena, scene->node_count, sizeof *worlds);
  sbfi_scene_node *nodes = sbfi_arena_copy(&scene->arena, scene->nodes, scene->node_count, sizeof *nodes);
  if (!worlds || !nodes) return false;
  double difference;
  if (!sbfi_bind_worlds(scene, worlds, &difference)) return false;
  if (difference <= SAME_POSE || !all_usable(scene, worlds)) return true;
  sbfi_matrix *saved = sbfi_arena_allocate(&scene->arena, scene->node_count, sizeof *saved);
  if (!saved || !complete_clips(scene)) return false;
  for (uint32_t i = 0; i < scene->node_count; i++) {
    sbfi_matrix to_parent;
    saved[i] = nodes[i].world;
    nodes[i].world = worlds[i];
    if (nodes[i].parent == SBF_NONE)
      nodes[i].local = worlds[i];
    else if (sbfi_matrix_invert(&worlds[nodes[i].parent], &to_parent))
      nodes[i].local = sbfi_matrix_multiply(&to_parent, &worlds[i]);
  }
  scene->nodes = nodes;
  scene->saved_worlds = saved;
  return sbfi_scene_warn(scene, SBF_CODE_IMPORT_POSE, 0,
      "the file was saved in mid-motion: the bind pose of bones and skin is used");
}
