/* Writes render meshes, original or at a render level, with a UsdSkel skeleton. */
#include <math.h>
#include <stdio.h>
#include <string.h>

#include "export/usda.h"
#include "model/level_mesh.h"
#include "motion/quatd.h"

/* Body that embeds a mesh, SBF_NONE for none; -2 for several. */
static int32_t embedding_body_of(const sbf_asset *asset, uint32_t mesh) {
  int32_t found = SBF_NONE;
  for (uint32_t b = 0; b < asset->soft_bodies.count; b++) {
    const sbf_soft_body *body = &asset->soft_bodies.at[b];
    if (!body->levels.count) continue;
    const sbf_embedding_list embeddings = body->levels.at[0].embeddings;
    for (uint32_t i = 0; i < embeddings.count; i++)
      if (embeddings.at[i].render_mesh == (int32_t)mesh && found != (int32_t)b)
        found = found == SBF_NONE ? (int32_t)b : -2;
  }
  return found;
}

bool sbfi_usda_choose_meshes(usda_writer *w) {
  const sbf_asset *asset = w->e->asset;
  w->meshes = sbfi_arena_allocate(&w->scratch, (size_t)asset->render_meshes.count + 1, sizeof *w->meshes);
  if (!w->meshes) return false;
  for (uint32_t i = 0; i < asset->render_meshes.count; i++) {
    usda_mesh *mesh = &w->meshes[i];
    mesh->full = mesh->shown = &asset->render_meshes.at[i];
    mesh->body = SBF_NONE;
    uint32_t level = w->e->render_level;
    if (level > mesh->full->levels.count) level = mesh->full->levels.count;
    if (level) {
      sbfi_level_mesh *made = sbfi_arena_allocate(&w->scratch, 1, sizeof *made);
      if (!made || !sbfi_level_mesh_make(made, mesh->full, &mesh->full->levels.at[level - 1], &w->scratch))
        return false;
      mesh->shown = &made->mesh;
      mesh->full_of_shown = made->vertices;
      mesh->shown_of_full = made->position_of;
    }
    mesh->skin = asset->bones.count ? mesh->full->skin : NULL;
    if (mesh->skin || mesh->full->bone >= 0) continue;
    int32_t body = embedding_body_of(asset, i);
    if (body == -2) w->shared++;
    if (body >= 0 && asset->soft_bodies.at[body].bone < 0 && sbfi_export_level(&asset->soft_bodies.at[body]))
      mesh->body = body, w->keys += mesh->full->shape_keys.count;
    else if (!sbfi_export_section_skin(asset, i, &w->scratch, &mesh->skin))
      return false;
  }
  return true;
}

/* ---- Skeleton ---- */

/* "ROOT/CHILD/...": the bones from the root on. `chain` is (bones). */
static void write_joint(usda_writer *w, uint32_t bone, uint32_t *chain) {
  const sbf_asset *asset = w->e->asset;
  uint32_t count = 0;
  for (int32_t b = (int32_t)bone; b >= 0; b = asset->bones.at[b].parent) chain[count++] = (uint32_t)b;
  sbfi_text_char(&w->e->text, '"');
  while (count--) {
    sbfi_usda_name(w, asset->bones.at[chain[count]].id, chain[count]);
    if (count) sbfi_text_char(&w->e->text, '/');
  }
  sbfi_text_char(&w->e->text, '"');
}

static void rotation_of(sbf_quat q, double rotation[4]) {
  const double parts[4] = {q.x, q.y, q.z, q.w};
  double length = sqrt(parts[0] * parts[0] + parts[1] * parts[1] + parts[2] * parts[2] + parts[3] * parts[3]);
  for (int k = 0; k < 4; k++) rotation[k] = length > 0 ? parts[k] / length : k == 3;
}

/* Rows are the axes, because USD multiplies vectors from the left. */
static void write_matrix(usda_writer *w, const double rotation[4], const double at[3]) {
  float row[4] = {0, 0, 0, 0};
  sbfi_text_char(&w->e->text, '(');
  for (int k = 0; k < 4; k++) {
    double axis[3] = {k == 0, k == 1, k == 2};
    if (k < 3) sbfi_quatd_rotate(rotation, axis, axis);
    for (int i = 0; i < 3; i++) row[i] = (float)(k < 3 ? axis[i] : at[i]);
    row[3] = k == 3;
    if (k) sbfi_text_string(&w->e->text, ", ");
    sbfi_usda_write_tuple(w, row, 4);
  }
  sbfi_text_char(&w->e->text, ')');
}

static void write_transforms(usda_writer *w, const char *declaration, bool local) {
  const sbf_asset *asset = w->e->asset;
  sbfi_usda_begin(w, declaration);
  sbfi_text_string(&w->e->text, " = [");
  for (uint32_t b = 0; b < asset->bones.count; b++) {
    const sbf_bone *bone = &asset->bones.at[b];
    double rotation[4], at[3] = {bone->head.x, bone->head.y, bone->head.z};
    rotation_of(bone->rotation, rotation);
    if (local && bone->parent >= 0) {
      const sbf_bone *parent = &asset->bones.at[bone->parent];
      double back[4];
      rotation_of(parent->rotation, back);
      sbfi_quatd_conjugate(back, back);
      at[0] -= parent->head.x, at[1] -= parent->head.y, at[2] -= parent->head.z;
      sbfi_quatd_rotate(back, at, at);
      sbfi_quatd_multiply(back, rotation, rotation);
    }
    if (b) sbfi_text_string(&w->e->text, ", ");
    write_matrix(w, rotation, at);
  }
  sbfi_text_char(&w->e->text, ']');
  sbfi_usda_end(w);
}

static bool write_skeleton(usda_writer *w) {
  const sbf_asset *asset = w->e->asset;
  uint32_t *chain = sbfi_arena_allocate(&w->scratch, asset->bones.count, sizeof *chain);
  if (!chain) return false;
  sbfi_usda_open_plain(w, "Skeleton", "skeleton", "");
  sbfi_usda_begin(w, "uniform token[] joints = [");
  for (uint32_t b = 0; b < asset->bones.count; b++) {
    if (b) sbfi_text_string(&w->e->text, ", ");
    write_joint(w, b, chain);
  }
  sbfi_text_char(&w->e->text, ']');
  sbfi_usda_end(w);
  write_transforms(w, "uniform matrix4d[] bindTransforms", false);
  write_transforms(w, "uniform matrix4d[] restTransforms", true);
  sbfi_usda_close(w);
  return true;
}

/* ---- Meshes ---- */

static uint32_t max_influences(const usda_mesh *mesh) {
  uint32_t max = 1;
  for (uint32_t p = 0; p < mesh->full->mesh.positions.count; p++)
    if (mesh->skin->influence_counts.at[p] > max) max = mesh->skin->influence_counts.at[p];
  return max;
}

/* A row of `size` bones or weights per point; points without weights get the first bone with weight 1. */
static void write_influences(
    usda_writer *w, const usda_mesh *mesh, const uint32_t *begins, uint32_t size, bool weights) {
  sbfi_usda_begin(
      w, weights ? "float[] primvars:skel:jointWeights = [" : "int[] primvars:skel:jointIndices = [");
  for (uint32_t i = 0; i < mesh->shown->mesh.positions.count; i++) {
    uint32_t p = mesh->full_of_shown ? mesh->full_of_shown[i] : i;
    uint32_t count = mesh->skin->influence_counts.at[p];
    for (uint32_t k = 0; k < size; k++) {
      if (i || k) sbfi_text_string(&w->e->text, ", ");
      if (weights)
        sbfi_text_f32(&w->e->text, k < count ? mesh->skin->weights.at[begins[p] + k] : !count && !k ? 1 : 0);
      else
        sbfi_text_u32(&w->e->text, k < count ? mesh->skin->bones.at[begins[p] + k] : 0);
    }
  }
  sbfi_export_format(w->e, "] (elementSize = %u interpolation = \"vertex\")\n", size);
}

/* The same for a mesh with one bone: for readers without support for constant bindings. */
static void write_one_bone(usda_writer *w, const usda_mesh *mesh) {
  for (int weights = 0; weights < 2; weights++) {
    sbfi_usda_begin(
        w, weights ? "float[] primvars:skel:jointWeights = [" : "int[] primvars:skel:jointIndices = [");
    for (uint32_t i = 0; i < mesh->shown->mesh.positions.count; i++)
      sbfi_export_format(w->e, "%s%d", i ? ", " : "", weights ? 1 : (int)mesh->full->bone);
    sbfi_text_string(&w->e->text, "] (elementSize = 1 interpolation = \"vertex\")\n");
  }
}

static bool write_binding(usda_writer *w, const usda_mesh *mesh) {
  sbfi_usda_write_line(w, "matrix4d primvars:skel:geomBindTransform = "
                          "((1, 0, 0, 0), (0, 1, 0, 0), (0, 0, 1, 0), (0, 0, 0, 1))");
  if (!mesh->skin) {
    write_one_bone(w, mesh);
  } else {
    uint32_t points = mesh->full->mesh.positions.count, size = max_influences(mesh);
    uint32_t *begins = sbfi_arena_allocate(&w->scratch, (size_t)points + 1, sizeof *begins);
    if (!begins) return false;
    for (uint32_t p = 1; p < points; p++) begins[p] = begins[p - 1] + mesh->skin->influence_counts.at[p - 1];
    write_influences(w, mesh, begins, size, false);
    write_influences(w, mesh, begins, size, true);
  }
  sbfi_usda_write_line(w, "rel skel:skeleton = </asset/character/skeleton>");
  return true;
}

static void write_uv(usda_writer *w, const sbf_uv_set *set, uint32_t index) {
  char name[40] = "";
  if (index) snprintf(name, sizeof name, "%u", index);
  sbfi_usda_begin(w, "texCoord2f[] primvars:st");
  sbfi_export_format(w->e, "%s = [", name);
  for (uint32_t i = 0; i < set->coordinates.count; i++) {
    if (i) sbfi_text_string(&w->e->text, ", ");
    sbfi_usda_write_tuple(w, (const float[2]){set->coordinates.at[i].x, set->coordinates.at[i].y}, 2);
  }
  sbfi_export_format(w->e, "] (interpolation = \"%s\")\n", set->corners.count ? "faceVarying" : "vertex");
  if (!set->corners.count) return;
  char declaration[64];
  snprintf(declaration, sizeof declaration, "int[] primvars:st%s:indices", name);
  sbfi_usda_write_indices(w, declaration, set->corners.at, set->corners.count, 1);
}

static void write_normals(usda_writer *w, const sbf_render_mesh *m) {
  uint32_t count = m->normal_corners.count ? m->normal_corners.count : m->normals.count;
  sbfi_usda_begin(w, "normal3f[] normals = [");
  for (uint32_t i = 0; i < count; i++) {
    const sbf_vec3 n = m->normals.at[m->normal_corners.count ? m->normal_corners.at[i] : i];
    if (i) sbfi_text_string(&w->e->text, ", ");
    sbfi_usda_write_tuple(w, (const float[3]){n.x, n.y, n.z}, 3);
  }
  sbfi_export_format(
      w->e, "] (interpolation = \"%s\")\n", m->normal_corners.count ? "faceVarying" : "vertex");
}

/* Shape keys have display names, which may be duplicates. */
static void write_key_name(usda_writer *w, const sbf_shape_key_list keys, uint32_t k) {
  bool again = false;
  for (uint32_t i = 0; i < k; i++) again = again || strcmp(keys.at[i].name, keys.at[k].name) == 0;
  sbfi_usda_name(w, keys.at[k].name, k);
  if (again) sbfi_export_format(w->e, "__%u", k);
}

static void write_shape_keys(usda_writer *w, const usda_mesh *mesh) {
  const sbf_shape_key_list keys = mesh->full->shape_keys;
  for (uint32_t k = 0; k < keys.count; k++) {
    const char *gap = "";
    sbfi_usda_begin(w, "def BlendShape \"");
    write_key_name(w, keys, k);
    sbfi_text_string(&w->e->text, "\"\n");
    sbfi_usda_write_line(w, "{");
    w->depth++;
    sbfi_usda_begin(w, "uniform vector3f[] offsets = [");
    for (uint32_t i = 0; i < keys.at[k].points.count; i++) {
      if (mesh->shown_of_full && mesh->shown_of_full[keys.at[k].points.at[i]] == UINT32_MAX) continue;
      const sbf_vec3 o = keys.at[k].offsets.at[i];
      sbfi_text_string(&w->e->text, gap);
      sbfi_usda_write_tuple(w, (const float[3]){o.x, o.y, o.z}, 3);
      gap = ", ";
    }
    sbfi_text_string(&w->e->text, "]\n");
    gap = "";
    sbfi_usda_begin(w, "uniform int[] pointIndices = [");
    for (uint32_t i = 0; i < keys.at[k].points.count; i++) {
      uint32_t p = keys.at[k].points.at[i];
      if (mesh->shown_of_full) p = mesh->shown_of_full[p];
      if (p == UINT32_MAX) continue;
      sbfi_text_string(&w->e->text, gap);
      sbfi_text_u32(&w->e->text, p);
      gap = ", ";
    }
    sbfi_text_string(&w->e->text, "]\n");
    sbfi_usda_close(w);
  }
}

static void write_key_targets(usda_writer *w, const usda_mesh *mesh, uint32_t index) {
  const sbf_shape_key_list keys = mesh->full->shape_keys;
  sbfi_usda_begin(w, "uniform token[] skel:blendShapes = [");
  for (uint32_t k = 0; k < keys.count; k++) {
    sbfi_text_string(&w->e->text, k ? ", \"" : "\"");
    write_key_name(w, keys, k);
    sbfi_text_char(&w->e->text, '"');
  }
  sbfi_text_string(&w->e->text, "]\n");
  sbfi_usda_begin(w, "rel skel:blendShapeTargets = [");
  for (uint32_t k = 0; k < keys.count; k++) {
    if (k) sbfi_text_string(&w->e->text, ", ");
    sbfi_usda_write_path(w, "character/meshes", mesh->full->id, index, "/");
    write_key_name(w, keys, k);
    sbfi_text_char(&w->e->text, '>');
  }
  sbfi_text_string(&w->e->text, "]\n");
}

static void bind_material(usda_writer *w, const sbf_render_mesh *m, uint32_t slot) {
  int32_t material = m->material_slots.at[slot].material;
  if (material < 0) return;
  sbfi_usda_begin(w, "rel material:binding = ");
  sbfi_usda_write_path(w, "materials", w->e->asset->materials.at[material].id, (uint32_t)material, ">");
  sbfi_usda_end(w);
}

/* Polygons of each slot, if there are several. */
static void write_subsets(usda_writer *w, const sbf_render_mesh *m) {
  for (uint32_t slot = 0; slot < m->material_slots.count; slot++) {
    const char *gap = "";
    char name[32];
    snprintf(name, sizeof name, "slot__%u", slot);
    sbfi_usda_open_plain(w, "GeomSubset", name, "\"MaterialBindingAPI\"");
    sbfi_usda_write_line(w, "uniform token elementType = \"face\"");
    sbfi_usda_write_line(w, "uniform token familyName = \"materialBind\"");
    sbfi_usda_begin(w, "int[] indices = [");
    for (uint32_t p = 0; p < m->mesh.polygon_sizes.count; p++) {
      if (m->polygon_materials.at[p] != slot) continue;
      sbfi_text_string(&w->e->text, gap);
      sbfi_text_u32(&w->e->text, p);
      gap = ", ";
    }
    sbfi_text_string(&w->e->text, "]\n");
    bind_material(w, m, slot);
    sbfi_usda_close(w);
  }
}

bool sbfi_usda_mesh(usda_writer *w, uint32_t index) {
  const usda_mesh *mesh = &w->meshes[index];
  const sbf_render_mesh *m = mesh->shown;
  bool pinned = mesh->body < 0 && (mesh->skin || mesh->full->bone >= 0);
  bool keys = mesh->body < 0 && mesh->full->shape_keys.count;
  const sbf_vec3 zero = {0, 0, 0};
  sbfi_usda_open(w, "Mesh", mesh->full->id, index,
      pinned || keys ? "\"MaterialBindingAPI\", \"SkelBindingAPI\"" : "\"MaterialBindingAPI\"");
  sbfi_usda_write_line(w, "uniform token subdivisionScheme = \"none\"");
  sbfi_usda_write_extent(w, m->mesh.positions.at, m->mesh.positions.count, zero);
  sbfi_usda_write_points(w, "point3f[] points", m->mesh.positions.at, m->mesh.positions.count, zero);
  sbfi_usda_write_indices(
      w, "int[] faceVertexCounts", m->mesh.polygon_sizes.at, m->mesh.polygon_sizes.count, 1);
  sbfi_usda_write_indices(
      w, "int[] faceVertexIndices", m->mesh.polygon_points.at, m->mesh.polygon_points.count, 1);
  if (m->normals.count) write_normals(w, m);
  for (uint32_t i = 0; i < m->uv_sets.count; i++)
    if (m->uv_sets.at[i].coordinates.count) write_uv(w, &m->uv_sets.at[i], i);
  if (pinned && !write_binding(w, mesh)) return false;
  if (m->material_slots.count) bind_material(w, m, 0);
  if (keys) write_key_targets(w, mesh, index);
  if (keys) write_shape_keys(w, mesh);
  if (m->material_slots.count > 1 && m->polygon_materials.count) write_subsets(w, m);
  sbfi_usda_close(w);
  return true;
}

bool sbfi_usda_skeleton_and_meshes(usda_writer *w) {
  const sbf_asset *asset = w->e->asset;
  sbfi_usda_open_plain(w, "SkelRoot", "character", "");
  if (asset->bones.count && !write_skeleton(w)) return false;
  sbfi_usda_open_plain(w, "Scope", "meshes", "");
  for (uint32_t i = 0; i < asset->render_meshes.count; i++)
    if (w->meshes[i].body < 0 && !sbfi_usda_mesh(w, i)) return false;
  sbfi_usda_close(w);
  sbfi_usda_close(w);
  return true;
}
