#include "import/scene/bind_space.h"

#include <math.h>
#include <string.h>

/* Two transforms of a mesh are equal if no corner of its bounding box moves by more than this fraction of
 * its size. */
static const double SAME_PLACEMENT = 1e-3;
/* Maximum difference between a suggested transform and the mean transform, as a fraction of the size: a
 * rotation by 60 degrees, or half a length. */
static const double NEAR_PLACEMENT = 0.5;
static const double NEAR_SCALE = 1.25;

enum { CORNERS = 8, SUGGESTIONS = 4 };

typedef struct skin_view {
  const sbfi_scene_mesh *mesh;
  double low[3], high[3]; /* bounding box in mesh space */
  double *weights;        /* (joint_count) sum over the points */
  sbfi_matrix *shown;     /* (joint_count) joint's world times bind: mesh to scene in the saved pose */
} skin_view;

static void find_box(skin_view *view) {
  const sbfi_scene_mesh *mesh = view->mesh;
  for (int k = 0; k < 3; k++) {
    view->low[k] = mesh->point_count ? INFINITY : -0.5;
    view->high[k] = mesh->point_count ? -INFINITY : 0.5;
  }
  for (uint32_t i = 0; i < mesh->point_count; i++) {
    const double at[3] = {mesh->points[i].x, mesh->points[i].y, mesh->points[i].z};
    for (int k = 0; k < 3; k++) {
      view->low[k] = fmin(view->low[k], at[k]);
      view->high[k] = fmax(view->high[k], at[k]);
    }
  }
}

static bool view_skin(
    const sbfi_scene *scene, const sbfi_scene_mesh *mesh, sbfi_arena *scratch, skin_view *view) {
  view->mesh = mesh;
  view->weights = sbfi_arena_allocate(scratch, mesh->skin.joint_count, sizeof *view->weights);
  view->shown = sbfi_arena_allocate(scratch, mesh->skin.joint_count, sizeof *view->shown);
  if (!view->weights || !view->shown) return false;
  find_box(view);
  uint32_t weight_count = mesh->skin.starts ? mesh->skin.starts[mesh->point_count] : 0;
  for (uint32_t s = 0; s < weight_count; s++)
    view->weights[mesh->skin.joint_index[s]] += (double)mesh->skin.weights[s];
  for (uint32_t j = 0; j < mesh->skin.joint_count; j++) {
    view->shown[j] =
        sbfi_matrix_multiply(&scene->nodes[mesh->skin.joints[j].node].world, &mesh->skin.joints[j].bind);
    if (!weight_count) view->weights[j] = 1;
  }
  return true;
}

static void set_corner(const skin_view *view, const sbfi_matrix *m, int corner, double to[3]) {
  double at[3];
  for (int k = 0; k < 3; k++) at[k] = corner >> k & 1 ? view->high[k] : view->low[k];
  for (int r = 0; r < 3; r++)
    to[r] = m->at[r][0] * at[0] + m->at[r][1] * at[1] + m->at[r][2] * at[2] + m->at[r][3];
}

static double length_between(const double a[3], const double b[3]) {
  return sqrt((a[0] - b[0]) * (a[0] - b[0]) + (a[1] - b[1]) * (a[1] - b[1]) + (a[2] - b[2]) * (a[2] - b[2]));
}

static double placed_size(const skin_view *view, const sbfi_matrix *m) {
  double size = 0, a[3], b[3];
  for (int corner = 0; corner < CORNERS / 2; corner++) {
    set_corner(view, m, corner, a);
    set_corner(view, m, CORNERS - 1 - corner, b);
    size = fmax(size, length_between(a, b));
  }
  return size;
}

/* Maximum distance of a corner of the bounding box under two transforms, as a fraction of the size under
 * the first. */
static double difference(const skin_view *view, const sbfi_matrix *one, const sbfi_matrix *other) {
  double separation = 0, size = placed_size(view, one), a[3], b[3];
  for (int corner = 0; corner < CORNERS; corner++) {
    set_corner(view, one, corner, a);
    set_corner(view, other, corner, b);
    separation = fmax(separation, length_between(a, b));
  }
  return separation > 0 ? separation / size : 0;
}

/* The transform with more than half of the weight (Boyer and Moore 1981); NULL if there is none. It is
 * exact if a pose moves only a few bones. */
static const sbfi_matrix *majority(const skin_view *view) {
  const sbfi_matrix *leader = NULL;
  double lead = 0, agreed = 0, total = 0;
  for (uint32_t j = 0; j < view->mesh->skin.joint_count; j++) {
    double weight = view->weights[j];
    if (!(weight > 0)) continue;
    if (!leader || lead <= 0) {
      leader = &view->shown[j];
      lead = weight;
    } else {
      lead += difference(view, leader, &view->shown[j]) <= SAME_PLACEMENT ? weight : -weight;
    }
  }
  for (uint32_t j = 0; leader && j < view->mesh->skin.joint_count; j++) {
    total += view->weights[j];
    if (difference(view, leader, &view->shown[j]) <= SAME_PLACEMENT) agreed += view->weights[j];
  }
  return leader && 2 * agreed > total ? leader : NULL;
}

/* Nearest rotation to a matrix by Newton's iteration for the polar decomposition (Higham 1986). False if
 * the matrix is nearly singular. */
static bool nearest_rotation(sbfi_matrix *m) {
  for (int round = 0; round < 50; round++) {
    sbfi_matrix inverse;
    if (!sbfi_matrix_invert(m, &inverse)) return false;
    double change = 0;
    for (int r = 0; r < 3; r++)
      for (int k = 0; k < 3; k++) {
        double next = (m->at[r][k] + inverse.at[k][r]) / 2;
        if (!isfinite(next)) return false;
        change = fmax(change, fabs(next - m->at[r][k]));
        inverse.at[k][r] = next; /* not read again: it is the transposed element */
      }
    for (int r = 0; r < 3; r++)
      for (int k = 0; k < 3; k++) m->at[r][k] = inverse.at[k][r];
    if (change < 1e-14) return true;
  }
  return true;
}

static double determinant(const sbfi_matrix *m) {
  double sum = 0;
  for (int k = 0; k < 3; k++) {
    int a = (k + 1) % 3, b = (k + 2) % 3;
    sum += m->at[0][k] * (m->at[1][a] * m->at[2][b] - m->at[1][b] * m->at[2][a]);
  }
  return sum;
}

/* Weighted mean of the transforms: the nearest rotation to all, the mean scale, and the mean position of
 * the mesh's centre. */
static bool mean_placement(const skin_view *view, sbfi_matrix *to) {
  sbfi_matrix sum = {.at[3][3] = 1};
  double total = 0, scale = 0, middle[3];
  for (uint32_t j = 0; j < view->mesh->skin.joint_count; j++) {
    double weight = view->weights[j];
    for (int r = 0; r < 3; r++)
      for (int k = 0; k < 4; k++) sum.at[r][k] += weight * view->shown[j].at[r][k];
    scale += weight * cbrt(determinant(&view->shown[j]));
    total += weight;
  }
  if (!(total > 0) || !(fabs(scale) > 0)) return false;
  for (int r = 0; r < 3; r++)
    for (int k = 0; k < 4; k++) sum.at[r][k] /= total;
  scale /= total;
  sbfi_matrix turn = sum;
  for (int r = 0; r < 3; r++)
    for (int k = 0; k < 3; k++) turn.at[r][k] /= scale;
  if (!nearest_rotation(&turn)) return false;
  for (int k = 0; k < 3; k++) middle[k] = (view->low[k] + view->high[k]) / 2;
  *to = sum;
  for (int r = 0; r < 3; r++)
    for (int k = 0; k < 3; k++) {
      to->at[r][k] = turn.at[r][k] * scale;
      to->at[r][3] += (sum.at[r][k] - to->at[r][k]) * middle[k];
    }
  return true;
}

/* Node that contains a skeleton: the lowest ancestor of the joint that is not a bone. */
static sbfi_matrix holder_world(const sbfi_scene *scene, int32_t joint) {
  int32_t node = joint;
  while (node != SBF_NONE && scene->nodes[node].is_bone) node = scene->nodes[node].parent;
  return node == SBF_NONE ? sbfi_matrix_identity() : scene->nodes[node].world;
}

/* Transform by the topmost joint, which poses rotate least. */
static const sbfi_matrix *root_placement(const skin_view *view) {
  const sbfi_scene_joint *joints = view->mesh->skin.joints;
  uint32_t root = UINT32_MAX; /* parents come before their children */
  for (uint32_t j = 0; j < view->mesh->skin.joint_count; j++)
    if (view->weights[j] > 0 && (root == UINT32_MAX || joints[j].node < joints[root].node)) root = j;
  return root == UINT32_MAX ? NULL : &view->shown[root];
}

/* Nearest suggestion within the tolerance; NULL if there is none. */
static const sbfi_matrix *nearest_suggestion(
    const skin_view *view, const sbfi_matrix *placement, const sbfi_matrix suggested[SUGGESTIONS]) {
  const sbfi_matrix *best = NULL;
  double min = NEAR_PLACEMENT, size = cbrt(fabs(determinant(placement)));
  for (int i = 0; i < SUGGESTIONS; i++) {
    double ratio = cbrt(fabs(determinant(&suggested[i]))) / size,
           separation = difference(view, placement, &suggested[i]);
    if (!(ratio * NEAR_SCALE >= 1 && ratio <= NEAR_SCALE) || !(separation < min)) continue;
    best = &suggested[i];
    min = separation;
  }
  return best;
}

/* Determines the bind space from a saved frame of a motion. The mean gives size and direction roughly, or
 * the root if limbs bend far. Exporters use exact spaces: vertices bound in the space of the scene
 * (Blender), of the armature, or of the mesh node (FBX). */
static sbfi_matrix placement_of_frame(
    const sbfi_scene *scene, const skin_view *view, const sbfi_matrix *hint) {
  const sbfi_scene_mesh *mesh = view->mesh;
  sbfi_matrix mean,
      suggested[SUGGESTIONS] = {hint ? *hint : scene->nodes[mesh->node].world, scene->nodes[mesh->node].world,
          holder_world(scene, mesh->skin.joints[0].node), sbfi_matrix_identity()};
  if (!mean_placement(view, &mean)) return suggested[0];
  const sbfi_matrix *root = root_placement(view), *best = nearest_suggestion(view, &mean, suggested);
  if (!best && root) best = nearest_suggestion(view, root, suggested);
  return best ? *best : mean;
}

/* --- Skins that share joints ------------------------------------------------------------------------- */

typedef struct sharing {
  const sbfi_scene *scene;
  sbfi_matrix *spaces;
  uint32_t *starts; /* (node_count + 1) first entry of each node in `skins` */
  uint32_t *skins;  /* meshes that have the node as a joint */
  bool *node_done, *placed;
  sbfi_matrix *worlds; /* (node_count) of finished joints, in the bind pose */
  uint32_t *queue;
} sharing;

static bool list_skins(sharing *s, sbfi_arena *scratch) {
  const sbfi_scene *scene = s->scene;
  size_t total = 0;
  s->starts = sbfi_arena_allocate(scratch, (size_t)scene->node_count + 2, sizeof *s->starts);
  if (!s->starts) return false;
  for (uint32_t m = 0; m < scene->mesh_count; m++)
    for (uint32_t j = 0; j < scene->meshes[m].skin.joint_count; j++, total++)
      s->starts[scene->meshes[m].skin.joints[j].node + 2]++;
  for (uint32_t i = 2; i < scene->node_count + 2; i++) s->starts[i] += s->starts[i - 1];
  s->skins = sbfi_arena_allocate(scratch, total + 1, sizeof *s->skins);
  s->node_done = sbfi_arena_allocate(scratch, (size_t)scene->node_count + 1, sizeof *s->node_done);
  s->placed = sbfi_arena_allocate(scratch, (size_t)scene->mesh_count + 1, sizeof *s->placed);
  s->worlds = sbfi_arena_allocate(scratch, (size_t)scene->node_count + 1, sizeof *s->worlds);
  s->queue = sbfi_arena_allocate(scratch, (size_t)scene->mesh_count + 1, sizeof *s->queue);
  if (!s->skins || !s->node_done || !s->placed || !s->worlds || !s->queue) return false;
  for (uint32_t m = 0; m < scene->mesh_count; m++)
    for (uint32_t j = 0; j < scene->meshes[m].skin.joint_count; j++)
      s->skins[s->starts[scene->meshes[m].skin.joints[j].node + 1]++] = m;
  return true;
}

/* Propagates from the first skin: each next skin is placed so that a shared joint has one world matrix. */
static void reuse_bind_pose(sharing *s, uint32_t first) {
  uint32_t count = 1;
  s->queue[0] = first;
  s->placed[first] = true;
  for (uint32_t at = 0; at < count; at++) {
    const sbfi_scene_mesh *mesh = &s->scene->meshes[s->queue[at]];
    for (uint32_t j = 0; j < mesh->skin.joint_count; j++) {
      uint32_t node = (uint32_t)mesh->skin.joints[j].node;
      sbfi_matrix to_mesh;
      if (s->node_done[node] || !sbfi_matrix_invert(&mesh->skin.joints[j].bind, &to_mesh)) continue;
      s->node_done[node] = true;
      s->worlds[node] = sbfi_matrix_multiply(&s->spaces[s->queue[at]], &to_mesh);
      for (uint32_t k = s->starts[node]; k < s->starts[node + 1]; k++) {
        uint32_t other = s->skins[k];
        if (s->placed[other]) continue;
        const sbfi_scene_mesh *next = &s->scene->meshes[other];
        uint32_t shared = 0;
        while ((uint32_t)next->skin.joints[shared].node != node) shared++;
        s->spaces[other] = sbfi_matrix_multiply(&s->worlds[node], &next->skin.joints[shared].bind);
        s->placed[other] = true;
        s->queue[count++] = other;
      }
    }
  }
}

/* Starts each group at the skin with the most points. */
static bool pose_groups(sharing *s, sbfi_arena *scratch) {
  const sbfi_scene *scene = s->scene;
  const sbfi_matrix *hint = NULL;
  uint32_t *order = sbfi_arena_allocate(scratch, (size_t)scene->mesh_count + 1, sizeof *order);
  if (!order) return false;
  uint32_t largest = 0;
  for (uint32_t m = 0; m < scene->mesh_count; m++) {
    order[m] = m;
    bool larger = scene->meshes[m].skin.joint_count &&
                  (!scene->meshes[largest].skin.joint_count ||
                      scene->meshes[m].point_count > scene->meshes[largest].point_count);
    if (larger) largest = m;
  }
  if (scene->mesh_count) {
    order[0] = largest;
    order[largest] = 0;
  }
  for (uint32_t i = 0; i < scene->mesh_count; i++) {
    const sbfi_scene_mesh *mesh = &scene->meshes[order[i]];
    skin_view view;
    if (!mesh->skin.joint_count || s->placed[order[i]]) continue;
    if (!view_skin(scene, mesh, scratch, &view)) return false;
    const sbfi_matrix *agreed = majority(&view);
    s->spaces[order[i]] = agreed ? *agreed : placement_of_frame(scene, &view, hint);
    hint = &s->spaces[order[i]];
    reuse_bind_pose(s, order[i]);
  }
  return true;
}

bool sbfi_bind_spaces(const sbfi_scene *scene, sbfi_matrix *spaces) {
  sharing s = {.scene = scene, .spaces = spaces};
  sbfi_arena scratch;
  for (uint32_t m = 0; m < scene->mesh_count; m++) spaces[m] = scene->nodes[scene->meshes[m].node].world;
  sbfi_arena_init(&scratch, &scene->arena.allocator, 0);
  bool good = list_skins(&s, &scratch) && pose_groups(&s, &scratch);
  sbfi_arena_free(&scratch);
  return good;
}
