/* Writes bones as nodes, their skin, and the meshes' parents. */
#include <math.h>

#include "export/glb_rigid.h"
#include "export/glb_springs.h"
#include "model/level_mesh.h"
#include "motion/quatd.h"

/* Whether some point of a skin has no bone. */
static bool has_unweighted_points(const sbf_skin *skin, uint32_t points) {
  for (uint32_t p = 0, at = 0; p < points; p++) {
    bool pinned = false;
    for (uint32_t i = 0; i < skin->influence_counts.at[p]; i++) pinned |= skin->weights.at[at++] > 0;
    if (!pinned) return true;
  }
  return false;
}

static void choose_polygons(sbfi_glb *g, sbfi_glb_mesh *mesh) {
  const sbf_render_mesh *full = mesh->full;
  uint32_t level = g->e->render_level < full->levels.count ? g->e->render_level : full->levels.count;
  mesh->shown = full;
  if (!level) return;
  sbfi_level_mesh *made = sbfi_glb_allocate(g, 1, sizeof *made);
  if (!made) return;
  if (!sbfi_level_mesh_make(made, full, &full->levels.at[level - 1], &g->arena)) {
    g->failed = true;
    return;
  }
  mesh->shown = &made->mesh;
  mesh->full_of_shown = made->vertices;
}

void sbfi_glb_choose_meshes(sbfi_glb *g) {
  const sbf_asset *asset = g->e->asset;
  uint32_t node = asset->bones.count, point = 0;
  g->meshes = sbfi_glb_allocate(g, asset->render_meshes.count, sizeof *g->meshes);
  for (uint32_t i = 0; i < asset->render_meshes.count && !g->failed; i++) {
    sbfi_glb_mesh *mesh = &g->meshes[i];
    *mesh = (sbfi_glb_mesh){
        .full = &asset->render_meshes.at[i], .bone = SBF_NONE, .node = UINT32_MAX, .first_point = point};
    point += mesh->full->mesh.positions.count;
    choose_polygons(g, mesh);
    if (g->failed || !mesh->shown->mesh.polygon_sizes.count) continue;
    mesh->node = node++;
    mesh->target_count = mesh->full->shape_keys.count + (g->e->motion ? g->e->motion->frame_count : 0);
    mesh->skin = mesh->full->skin && asset->bones.count ? mesh->full->skin : NULL;
    if (!mesh->skin && mesh->full->bone < 0 && !sbfi_export_section_skin(asset, i, &g->arena, &mesh->skin)) {
      g->failed = true;
      return;
    }
    if (!mesh->skin) mesh->bone = mesh->full->bone;
    if (mesh->skin && has_unweighted_points(mesh->skin, mesh->full->mesh.positions.count))
      g->root_is_joint = true;
  }
  g->root_node = node;
}

static void add_child(sbfi_text *text, uint32_t child, bool *first) {
  sbfi_export_print(text, "%s%u", *first ? ",\"children\":[" : ",", child);
  *first = false;
}

static void write_position(sbfi_text *text, const float translation[3], const float rotation[4]) {
  sbfi_text_string(text, ",\"translation\":");
  sbfi_glb_write_numbers(text, translation, 3);
  sbfi_text_string(text, ",\"rotation\":");
  sbfi_glb_write_numbers(text, rotation, 4);
}

static void write_bone(sbfi_glb *g, uint32_t i) {
  const sbf_asset *asset = g->e->asset;
  const sbf_bone *bone = &asset->bones.at[i];
  sbfi_glb_transform parent =
      bone->parent >= 0 ? sbfi_glb_rest(asset, (uint32_t)bone->parent) : (sbfi_glb_transform){0};
  float translation[3], rotation[4];
  sbfi_glb_compute_local(sbfi_glb_rest(asset, i), bone->parent >= 0 ? &parent : NULL, translation, rotation);
  sbfi_text *text = sbfi_glb_item(g, SBFI_GLB_NODES, NULL);
  bool first = true;
  sbfi_text_string(text, "{\"name\":");
  sbfi_glb_write_string(text, *bone->name ? bone->name : bone->id);
  write_position(text, translation, rotation);
  for (uint32_t k = i + 1; k < asset->bones.count; k++)
    if (asset->bones.at[k].parent == (int32_t)i) add_child(text, k, &first);
  for (uint32_t k = 0; k < asset->render_meshes.count; k++)
    if (g->meshes[k].node != UINT32_MAX && g->meshes[k].bone == (int32_t)i)
      add_child(text, g->meshes[k].node, &first);
  sbfi_glb_add_end_child(g, i, text, &first);
  sbfi_glb_add_rigid_children(g, (int32_t)i, text, &first);
  if (!first) sbfi_text_char(text, ']');
  sbfi_glb_write_bone_physics(g, i, text);
  sbfi_text_char(text, '}');
}

static void write_mesh_node(sbfi_glb *g, const sbfi_glb_mesh *mesh, uint32_t number) {
  sbfi_text *text = sbfi_glb_item(g, SBFI_GLB_NODES, NULL);
  sbfi_text_string(text, "{\"name\":");
  sbfi_glb_write_string(text, *mesh->full->name ? mesh->full->name : mesh->full->id);
  sbfi_export_print(text, ",\"mesh\":%u", number);
  if (mesh->skin) sbfi_text_string(text, ",\"skin\":0");
  if (mesh->bone >= 0) {
    /* Its points are in asset space. */
    sbfi_glb_transform asset_space = {{0, 0, 0}, {0, 0, 0, 1}};
    sbfi_glb_transform bone = sbfi_glb_rest(g->e->asset, (uint32_t)mesh->bone);
    float translation[3], rotation[4];
    sbfi_glb_compute_local(asset_space, &bone, translation, rotation);
    write_position(text, translation, rotation);
  }
  sbfi_text_char(text, '}');
}

static void write_root(sbfi_glb *g) {
  const sbf_asset *asset = g->e->asset;
  sbfi_text *text = sbfi_glb_item(g, SBFI_GLB_NODES, NULL);
  bool first = true;
  sbfi_text_string(text, "{\"name\":\"Skeleton\"");
  for (uint32_t i = 0; i < asset->bones.count; i++)
    if (asset->bones.at[i].parent < 0) add_child(text, i, &first);
  sbfi_text_string(text, "]}");
}

/* One skin for all meshes; its joints are all bones. Written even if no mesh has weights, because readers
 * recognize a bone by its use as a joint. */
static void write_skin(sbfi_glb *g) {
  const sbf_asset *asset = g->e->asset;
  uint32_t count = asset->bones.count + (g->root_is_joint ? 1 : 0);
  float(*binds)[16] = sbfi_glb_allocate(g, count, sizeof *binds);
  if (!binds) return;
  for (uint32_t i = 0; i < count; i++) {
    float t[3] = {0, 0, 0}, q[4] = {0, 0, 0, 1};
    sbfi_glb_transform asset_space = {{0, 0, 0}, {0, 0, 0, 1}};
    if (i < asset->bones.count) {
      sbfi_glb_transform bone = sbfi_glb_rest(asset, i);
      sbfi_glb_compute_local(asset_space, &bone, t, q);
    }
    const double rotation[4] = {q[0], q[1], q[2], q[3]};
    for (int column = 0; column < 3; column++) {
      double axis[3] = {column == 0, column == 1, column == 2};
      sbfi_quatd_rotate(rotation, axis, axis);
      for (int row = 0; row < 3; row++) binds[i][4 * column + row] = (float)axis[row];
    }
    for (int row = 0; row < 3; row++) binds[i][12 + row] = t[row];
    binds[i][15] = 1;
  }
  uint32_t matrices = sbfi_glb_accessor(g, binds, count, SBFI_GLB_MAT4, SBFI_GLB_NO_TARGET);
  sbfi_text *text = sbfi_glb_item(g, SBFI_GLB_SKINS, NULL);
  sbfi_export_print(text, "{\"inverseBindMatrices\":%u,\"skeleton\":%u,\"joints\":[", matrices, g->root_node);
  for (uint32_t i = 0; i < count; i++)
    sbfi_export_print(text, "%s%u", i ? "," : "", i < asset->bones.count ? i : g->root_node);
  sbfi_text_string(text, "]}");
}

void sbfi_glb_write_nodes(sbfi_glb *g) {
  const sbf_asset *asset = g->e->asset;
  uint32_t number = 0;
  sbfi_glb_plan_springs(g, g->root_node + 1);
  uint32_t end_nodes = g->springs ? g->springs->end_count : 0;
  sbfi_glb_plan_rigid(g, g->root_node + (asset->bones.count ? 1 + end_nodes : 0));
  for (uint32_t i = 0; i < asset->bones.count && !g->failed; i++) write_bone(g, i);
  for (uint32_t i = 0; i < asset->render_meshes.count && !g->failed; i++) {
    if (g->meshes[i].node == UINT32_MAX) continue;
    write_mesh_node(g, &g->meshes[i], number++);
  }
  if (asset->bones.count) {
    write_root(g);
    write_skin(g);
    sbfi_glb_write_end_nodes(g);
  }
  sbfi_glb_write_rigid_nodes(g);
}
