/* Bones from the rig's node tree. Rest transforms are baked into asset space. */
#include <math.h>
#include <string.h>

#include "import/conversion.h"

typedef struct double3 {
  double at[3];
} double3;

static double3 column(const sbfi_matrix *m, int k) {
  return (double3){{m->at[0][k], m->at[1][k], m->at[2][k]}};
}
static double dot(double3 a, double3 b) {
  return a.at[0] * b.at[0] + a.at[1] * b.at[1] + a.at[2] * b.at[2];
}
static double3 minus(double3 a, double3 b) {
  return (double3){{a.at[0] - b.at[0], a.at[1] - b.at[1], a.at[2] - b.at[2]}};
}
static double3 times(double3 a, double s) {
  return (double3){{a.at[0] * s, a.at[1] * s, a.at[2] * s}};
}
static double3 cross(double3 a, double3 b) {
  return (double3){{a.at[1] * b.at[2] - a.at[2] * b.at[1], a.at[2] * b.at[0] - a.at[0] * b.at[2],
      a.at[0] * b.at[1] - a.at[1] * b.at[0]}};
}
static double3 unit(double3 a, double3 otherwise) {
  double length = sqrt(dot(a, a));
  return length > 1e-12 ? times(a, 1 / length) : otherwise;
}

/* A right-handed orthonormal frame whose Y is the given axis and whose X is as near `x` as that leaves it. */
static void frame_from_axes(double3 x, double3 y, double3 frame[3]) {
  frame[1] = unit(y, (double3){{0, 1, 0}});
  double3 flat = minus(x, times(frame[1], dot(x, frame[1])));
  double3 spare = fabs(frame[1].at[0]) < 0.9 ? (double3){{1, 0, 0}} : (double3){{0, 0, 1}};
  frame[0] = unit(flat, unit(minus(spare, times(frame[1], dot(spare, frame[1]))), spare));
  frame[2] = cross(frame[0], frame[1]);
}

/* Shepperd's method: the largest component first. */
static sbf_quat quaternion_of(const double3 f[3]) {
  const double m[3][3] = {{f[0].at[0], f[1].at[0], f[2].at[0]}, {f[0].at[1], f[1].at[1], f[2].at[1]},
      {f[0].at[2], f[1].at[2], f[2].at[2]}};
  double q[4] = {1 + m[0][0] - m[1][1] - m[2][2], 1 - m[0][0] + m[1][1] - m[2][2],
      1 - m[0][0] - m[1][1] + m[2][2], 1 + m[0][0] + m[1][1] + m[2][2]};
  int largest = 0;
  for (int i = 1; i < 4; i++)
    if (q[i] > q[largest]) largest = i;
  double s = 0.5 / sqrt(q[largest]), sums[3] = {m[2][1] + m[1][2], m[0][2] + m[2][0], m[1][0] + m[0][1]};
  double differences[3] = {m[2][1] - m[1][2], m[0][2] - m[2][0], m[1][0] - m[0][1]};
  double out[4];
  if (largest == 3) {
    for (int i = 0; i < 3; i++) out[i] = differences[i] * s;
    out[3] = q[3] * s;
  } else {
    int j = (largest + 1) % 3, k = (largest + 2) % 3;
    out[largest] = q[largest] * s;
    out[j] = sums[k] * s;
    out[k] = sums[j] * s;
    out[3] = differences[largest] * s;
  }
  double sign = out[3] < 0 ? -1 : 1;
  for (int i = 0; i < 4; i++) out[i] = out[i] * sign + 0.0; /* no negative zero */
  return (sbf_quat){(float)out[0], (float)out[1], (float)out[2], (float)out[3]};
}

typedef struct draft {
  uint32_t node;
  int32_t parent;
  double3 head, x, y; /* asset space; axes as the node has them, not yet of unit length */
  uint32_t child_count;
  double3 along; /* to the child that continues the bone */
  double length;
  bool has_child;
} draft;

static const double STRAIGHT = 0.995; /* cosine within which an axis runs along a bone */

/* Finds for each bone the child that continues it: the one nearest its own Y, else the one most bones hang
 * on. */
static void find_continuations(draft *bones, uint32_t count) {
  for (uint32_t i = count; i-- > 0;)
    if (bones[i].parent >= 0) bones[bones[i].parent].child_count += bones[i].child_count + 1;
  for (uint32_t i = 0; i < count; i++) {
    if (bones[i].parent < 0) continue;
    draft *parent = &bones[bones[i].parent];
    double3 along = minus(bones[i].head, parent->head);
    double length = sqrt(dot(along, along));
    if (length < 1e-9) continue;
    double3 y = unit(parent->y, along);
    double score = dot(along, y) / length > STRAIGHT ? 1e9 - length : bones[i].child_count + 1;
    double best = parent->has_child
                      ? (dot(parent->along, y) / parent->length > STRAIGHT ? 1e9 - parent->length : -1)
                      : -2;
    if (best == -1) { /* compare sizes of what hangs on either */
      for (uint32_t k = 0; k < i; k++)
        if (bones[k].parent == bones[i].parent &&
            dot(minus(minus(bones[k].head, parent->head), parent->along),
                minus(minus(bones[k].head, parent->head), parent->along)) == 0)
          best = bones[k].child_count + 1;
    }
    if (score <= best) continue;
    parent->has_child = true;
    parent->along = along;
    parent->length = length;
  }
}

/* Whether the file's bones run along their own Y, as Blender's do: then every rotation is kept as it is. */
static bool runs_along_y(const draft *bones, uint32_t count) {
  uint32_t along = 0, asked = 0;
  for (uint32_t i = 0; i < count; i++) {
    if (!bones[i].has_child) continue;
    asked++;
    along += dot(unit(bones[i].y, bones[i].y), bones[i].along) / bones[i].length > STRAIGHT;
  }
  return 5 * along >= 3 * asked;
}

static sbf_status write_bones(sbfi_conversion *c, draft *drafts, uint32_t count) {
  sbf_bone *bones = sbfi_convert_allocate(c, count, sizeof *bones);
  if (!bones) return sbfi_convert_no_memory(c);
  bool keep = runs_along_y(drafts, count);
  for (uint32_t i = 0; i < count; i++) {
    const draft *d = &drafts[i];
    sbf_bone_init(&bones[i]);
    double3 y = d->y;
    if (!keep)
      y = d->has_child                                    ? d->along
          : d->parent >= 0 && drafts[d->parent].has_child ? drafts[d->parent].along
                                                          : y;
    double3 frame[3];
    frame_from_axes(d->x, y, frame);
    bool ahead = d->has_child && dot(frame[1], d->along) / d->length > STRAIGHT;
    bones[i].id = sbfi_new_id(c, "bone", c->rig->nodes[d->node].name);
    bones[i].name = sbf_asset_copy_text(c->asset, c->rig->nodes[d->node].name);
    if (!bones[i].id || !bones[i].name) return sbfi_convert_no_memory(c);
    bones[i].parent = d->parent;
    bones[i].head = (sbf_vec3){(float)d->head.at[0], (float)d->head.at[1], (float)d->head.at[2]};
    bones[i].rotation = quaternion_of(frame);
    bones[i].length = ahead ? (float)d->length : 0;
  }
  c->asset->bones = (sbf_bone_list){bones, count};
  return SBF_OK;
}

sbf_status sbfi_convert_skeleton(sbfi_conversion *c) {
  if (!c->rig || sbfi_scene_bone_count(c->rig) == 0) return SBF_OK;
  uint32_t node_count = c->rig->node_count, count = 0;
  c->bone_of_node = sbfi_arena_allocate(&c->scratch, node_count, sizeof *c->bone_of_node);
  draft *drafts = sbfi_arena_allocate(&c->scratch, node_count, sizeof *drafts);
  c->node_of_bone = sbfi_arena_allocate(&c->scratch, node_count, sizeof *c->node_of_bone);
  if (!c->bone_of_node || !c->node_of_bone || !drafts) return sbfi_convert_no_memory(c);
  for (uint32_t i = 0; i < node_count; i++) {
    const sbfi_scene_node *node = &c->rig->nodes[i];
    int32_t above = node->parent >= 0 ? c->bone_of_node[node->parent] : SBF_NONE;
    c->bone_of_node[i] = above; /* what hangs on no bone of its own hangs on the nearest above */
    if (!node->is_bone) continue;
    sbfi_matrix world = sbfi_matrix_multiply(&c->rig_to_asset, &node->world);
    drafts[count] = (draft){.node = i,
        .parent = above,
        .head = column(&world, 3),
        .x = column(&world, 0),
        .y = column(&world, 1)};
    c->node_of_bone[count] = i;
    c->bone_of_node[i] = (int32_t)count++;
  }
  find_continuations(drafts, count);
  return write_bones(c, drafts, count);
}

static sbf_vec3 y_axis(sbf_quat q) {
  return (sbf_vec3){
      2 * (q.x * q.y - q.w * q.z), 1 - 2 * (q.x * q.x + q.z * q.z), 2 * (q.y * q.z + q.w * q.x)};
}

void sbfi_measure_leaf_bones(sbfi_conversion *c) {
  sbf_bone *bones = (sbf_bone *)(uintptr_t)c->asset->bones.at; /* ours until the asset is handed out */
  for (uint32_t b = 0; b < c->asset->soft_bodies.count; b++) {
    const sbf_soft_body *body = &c->asset->soft_bodies.at[b];
    if (body->bone < 0 || bones[body->bone].length > 0) continue;
    sbf_bone *bone = &bones[body->bone];
    sbf_vec3 axis = y_axis(bone->rotation);
    for (uint32_t i = 0; i < body->surface.positions.count; i++) {
      sbf_vec3 p = body->surface.positions.at[i];
      float along =
          (p.x - bone->head.x) * axis.x + (p.y - bone->head.y) * axis.y + (p.z - bone->head.z) * axis.z;
      if (along > bone->length) bone->length = along;
    }
  }
}
