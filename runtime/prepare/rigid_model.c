/* The rigid bodies and joints of a model: masses, inertia, frames, limits. */
#include "prepare/prepare.h"

#include "mechanics/joint_freedom.h"
#include "sbfmt/mechanics.h"

/* Maximum number of rows of joints that close loops; they are solved as a dense matrix. */
enum { MAX_LOOP_ROWS = 96 };

static const float EARTH_M_S2 = 9.81f;

static float inverse(float value) {
  return value > 0 ? 1 / value : 0;
}

/* From asset space at rest to the body's frame. */
static sbf_vec3 local_position(const sbri_rigid_body *body, sbf_vec3 position) {
  return sbri_rotate(sbri_quat_conjugate(body->axes), sbri_sub(position, body->center));
}

/* Minimum moment of inertia as a fraction of the maximum: a thin body has almost none about its long axis and
 * would reach any angular velocity. */
static const float MIN_MOMENT = 1e-3f;

static bool make_body(const sbf_rigid_body *source, sbri_rigid_body *body, sbfi_arena *arena) {
  sbf_rigid_measures is;
  sbf_rigid_body_measure(source, &is);
  float max = is.inertia.x > is.inertia.y ? is.inertia.x : is.inertia.y, min;
  min = MIN_MOMENT * (max > is.inertia.z ? max : is.inertia.z);
  sbf_vec3 moments = {is.inertia.x > min ? is.inertia.x : min, is.inertia.y > min ? is.inertia.y : min,
      is.inertia.z > min ? is.inertia.z : min};
  *body = (sbri_rigid_body){.source = source,
      .mass = (float)is.mass,
      .inverse_mass = inverse((float)is.mass),
      .inertia = moments,
      .inverse_inertia = {inverse(moments.x), inverse(moments.y), inverse(moments.z)},
      .center = is.center,
      .axes = sbri_quat_normalize(is.inertia_rotation)};
  if (!(moments.x > 0)) body->mass = body->inverse_mass = 0;
  if (!source->hull) return true;
  uint32_t count = source->hull->positions.count;
  sbf_vec3 *vertices = sbfi_arena_allocate(arena, count, sizeof *vertices);
  if (!vertices) return false;
  for (uint32_t i = 0; i < count; i++) {
    vertices[i] = local_position(body, source->hull->positions.at[i]);
    float length = sbri_length(vertices[i]);
    body->radius = length > body->radius ? length : body->radius;
  }
  body->vertices = vertices;
  body->vertex_count = count;
  const sbf_polygon_mesh *mesh = source->hull;
  return sbri_hull_make(&body->hull, vertices, count, mesh->polygon_sizes.at, mesh->polygon_sizes.count,
      mesh->polygon_points.at, arena);
}

/* From `local`, in the file's frame of the body, whose axes at rest are those of asset space, to the body's
 * frame. */
static sbri_rigid_frame frame_of(const sbri_rigid_body *body, const sbf_frame *local) {
  sbf_quat rotation = sbri_quat_normalize(local->rotation);
  if (!body) return (sbri_rigid_frame){local->position, rotation};
  return (sbri_rigid_frame){local_position(body, sbri_add(body->source->center, local->position)),
      sbri_quat_multiply(sbri_quat_conjugate(body->axes), rotation)};
}

static sbf_vec3 rest_position(const sbri_rigid_model *model, const sbri_rigid_joint *joint, int side) {
  if (joint->bodies[side] < 0) return joint->frames[side].at;
  const sbri_rigid_body *body = &model->bodies[joint->bodies[side]];
  return sbri_add(body->center, sbri_rotate(body->axes, joint->frames[side].at));
}

static uint32_t count_bits(unsigned bits) {
  uint32_t count = 0;
  for (; bits; bits &= bits - 1) count++;
  return count;
}

static void make_joint(const sbri_rigid_model *model, const sbf_joint *source, sbri_rigid_joint *joint) {
  *joint = (sbri_rigid_joint){.source = source,
      .bodies = {source->body_a, source->body_b},
      .locked = sbfi_joint_is_locked(source->kind)};
  const sbf_frame *frames[SBRI_SIDES] = {&source->frame_a, &source->frame_b};
  for (int side = 0; side < SBRI_SIDES; side++)
    joint->frames[side] =
        frame_of(joint->bodies[side] < 0 ? NULL : &model->bodies[joint->bodies[side]], frames[side]);
  sbf_vec3 a = rest_position(model, joint, SBRI_A), b = rest_position(model, joint, SBRI_B);
  if (source->kind == SBF_JOINT_KIND_DISTANCE) joint->rest_distance = sbri_length(sbri_sub(b, a));
  if (source->kind == SBF_JOINT_KIND_PULLEY)
    joint->rest_distance = sbri_length(sbri_sub(a, source->pulley_a)) +
                           source->pulley_ratio * sbri_length(sbri_sub(b, source->pulley_b));
  bool has_length = source->kind == SBF_JOINT_KIND_DISTANCE || source->kind == SBF_JOINT_KIND_PULLEY;
  /* Three more for drives that track a pose. */
  joint->row_capacity =
      count_bits(joint->locked) + has_length + source->limits.count + source->drives.count + 3;
}

/* ---- Graph ---- */

static bool list_joints(sbri_rigid_model *model, sbri_rigid_body *bodies, sbfi_arena *arena) {
  uint32_t *list = sbfi_arena_allocate(arena, 2 * (size_t)model->joint_count + 1, sizeof *list), count = 0;
  if (!list) return false;
  for (uint32_t j = 0; j < model->joint_count; j++)
    for (int side = 0; side < SBRI_SIDES; side++)
      if (model->joints[j].bodies[side] >= 0) bodies[model->joints[j].bodies[side]].joint_end++;
  for (uint32_t b = 0; b < model->body_count; b++) {
    uint32_t own = bodies[b].joint_end;
    bodies[b].joint_begin = bodies[b].joint_end = count;
    count += own;
  }
  for (uint32_t j = 0; j < model->joint_count; j++)
    for (int side = 0; side < SBRI_SIDES; side++)
      if (model->joints[j].bodies[side] >= 0) list[bodies[model->joints[j].bodies[side]].joint_end++] = j;
  model->joints_of = list;
  return true;
}

static bool sort_joints(sbri_rigid_model *model, sbfi_arena *arena) {
  uint32_t *order = sbfi_arena_allocate(arena, (size_t)model->joint_count + 1, sizeof *order), count = 0;
  if (!order) return false;
  for (int pinned = 6; pinned >= 0; pinned--)
    for (uint32_t j = 0; j < model->joint_count; j++)
      if (count_bits(model->joints[j].locked) == (uint32_t)pinned) order[count++] = j;
  model->by_strength = order;
  return true;
}

/* ---- Loads of joints ---- */

typedef struct load {
  float moment, mass; /* kg m^2 about the joint, kg */
  sbf_vec3 first;     /* kg m from the joint */
} load;

/* All bodies connected to a body without passing `joint` or a visited body, as one rigid body. */
static load find_load(
    const sbri_rigid_model *model, uint32_t joint, uint32_t body, uint32_t *visited, uint32_t *queue) {
  sbf_vec3 about = rest_position(model, &model->joints[joint], SBRI_B);
  load all = {0, 0, {0, 0, 0}};
  uint32_t count = 0;
  queue[count++] = body, visited[body] = joint + 1;
  for (uint32_t i = 0; i < count; i++) {
    const sbri_rigid_body *is = &model->bodies[queue[i]];
    sbf_vec3 arm = sbri_sub(is->center, about);
    all.moment += is->mass * sbri_dot(arm, arm) + (is->inertia.x + is->inertia.y + is->inertia.z) / 3;
    all.first = sbri_add_scaled(all.first, arm, is->mass);
    all.mass += is->mass;
    for (uint32_t k = is->joint_begin; k < is->joint_end; k++) {
      const sbri_rigid_joint *next = &model->joints[model->joints_of[k]];
      int32_t other = next->bodies[next->bodies[SBRI_A] == (int32_t)queue[i] ? SBRI_B : SBRI_A];
      if (model->joints_of[k] == joint || other < 0 || visited[other] == joint + 1) continue;
      visited[other] = joint + 1;
      queue[count++] = (uint32_t)other;
    }
  }
  return all;
}

/* The lighter side of a joint is the load of the other. */
static bool find_loads(sbri_rigid_model *model, sbri_rigid_joint *joints, sbfi_arena *arena) {
  uint32_t *visited = sbfi_arena_allocate(arena, (size_t)model->body_count + 1, sizeof *visited);
  uint32_t *queue = sbfi_arena_allocate(arena, (size_t)model->body_count + 1, sizeof *queue);
  if (!visited || !queue) return false;
  for (uint32_t b = 0; b < model->body_count; b++) visited[b] = 0;
  for (uint32_t j = 0; j < model->joint_count; j++) {
    load min = {0, INFINITY, {0, 0, 0}};
    for (int side = 0; side < SBRI_SIDES; side++) {
      int32_t body = joints[j].bodies[side], other = joints[j].bodies[1 - side];
      if (body < 0 || (other >= 0 && other == body)) continue;
      for (uint32_t b = 0; side == 1 && b < model->body_count; b++) visited[b] = 0;
      if (other >= 0) visited[other] = j + 1;
      load found = find_load(model, j, (uint32_t)body, visited, queue);
      if (found.mass < min.mass) min = found;
    }
    joints[j].reach_inertia = min.moment;
    joints[j].hold_torque = EARTH_M_S2 * sbri_length(min.first);
  }
  return true;
}

bool sbri_rigid_model_make(sbri_rigid_model *model, const sbf_asset *asset, sbfi_arena *arena) {
  uint32_t body_count = asset->rigid_bodies.count, joint_count = asset->joints.count,
           bone_count = asset->bones.count;
  *model = (sbri_rigid_model){.body_count = body_count, .joint_count = joint_count, .bone_count = bone_count};
  sbri_rigid_body *bodies = sbfi_arena_allocate(arena, (size_t)body_count + 1, sizeof *bodies);
  sbri_rigid_joint *joints = sbfi_arena_allocate(arena, (size_t)joint_count + 1, sizeof *joints);
  int32_t *body_of_bone = sbfi_arena_allocate(arena, (size_t)bone_count + 1, sizeof *body_of_bone);
  uint32_t *own_frames = sbfi_arena_allocate(arena, (size_t)body_count + 1, sizeof *own_frames);
  if (!bodies || !joints || !body_of_bone || !own_frames) return false;
  model->bodies = bodies, model->joints = joints, model->body_of_bone = body_of_bone;
  model->own_frames = own_frames;
  for (uint32_t i = 0; i < bone_count; i++) body_of_bone[i] = -1;
  for (uint32_t b = 0; b < body_count; b++) {
    if (!make_body(&asset->rigid_bodies.at[b], &bodies[b], arena)) return false;
    bodies[b].first_vertex = model->vertex_count;
    model->vertex_count += bodies[b].vertex_count;
    int32_t bone = bodies[b].source->bone;
    if (bone >= 0 && body_of_bone[bone] < 0 && bodies[b].mass > 0) body_of_bone[bone] = (int32_t)b;
  }
  for (uint32_t j = 0; j < joint_count; j++) {
    make_joint(model, &asset->joints.at[j], &joints[j]);
    joints[j].first_row = model->row_count;
    joints[j].first_square = model->square_count;
    model->row_count += joints[j].row_capacity;
    model->square_count += (size_t)joints[j].row_capacity * joints[j].row_capacity;
  }
  for (uint32_t b = 0; b < body_count; b++) {
    int32_t bone = bodies[b].source->bone;
    bool own = bodies[b].mass > 0 && (bone < 0 || body_of_bone[bone] != (int32_t)b);
    own_frames[b] = own ? model->own_frame_count++ : UINT32_MAX;
  }
  model->loop_row_capacity = model->row_count < MAX_LOOP_ROWS ? model->row_count : MAX_LOOP_ROWS;
  return list_joints(model, bodies, arena) && sort_joints(model, arena) && find_loads(model, joints, arena);
}
