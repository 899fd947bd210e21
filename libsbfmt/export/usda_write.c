/* Writes USD as text: meshes with UsdSkel, rigid bodies and joints with UsdPhysics, tetrahedra as
 * UsdGeomTetMesh with the schemas of the proposal "Deformable Body Physics in USD" (OpenUSD-proposals,
 * pull request 111, June 2026). */
#include <math.h>
#include <stdio.h>
#include <string.h>

#include "export/usda.h"

/* ---- Materials ---- */

void sbfi_usda_write_materials(usda_writer *w) {
  const sbf_asset *asset = w->e->asset;
  if (!asset->materials.count) return;
  sbfi_usda_open_plain(w, "Scope", "materials", "");
  for (uint32_t i = 0; i < asset->materials.count; i++) {
    const sbf_material *m = &asset->materials.at[i];
    const sbf_vec3 base = {m->base_color.x, m->base_color.y, m->base_color.z};
    w->images +=
        (m->base_color_texture >= 0) + (m->metallic_roughness_texture >= 0) + (m->normal_texture >= 0);
    sbfi_usda_open(w, "Material", m->id, i, "");
    sbfi_usda_begin(w, "token outputs:surface.connect = ");
    sbfi_usda_write_path(w, "materials", m->id, i, "/surface.outputs:surface>");
    sbfi_usda_end(w);
    sbfi_usda_open_plain(w, "Shader", "surface", "");
    sbfi_usda_write_line(w, "uniform token info:id = \"UsdPreviewSurface\"");
    sbfi_usda_write_vec3(w, "color3f inputs:diffuseColor", base);
    sbfi_usda_write_vec3(w, "color3f inputs:emissiveColor", m->emissive);
    sbfi_usda_write_f32(w, "float inputs:metallic", m->metallic);
    sbfi_usda_write_f32(w, "float inputs:roughness", m->roughness);
    if (m->alpha_mode != SBF_ALPHA_MODE_OPAQUE)
      sbfi_usda_write_f32(w, "float inputs:opacity", m->base_color.w);
    if (m->alpha_mode == SBF_ALPHA_MODE_MASK)
      sbfi_usda_write_f32(w, "float inputs:opacityThreshold", m->alpha_cutoff);
    sbfi_usda_write_line(w, "token outputs:surface");
    sbfi_usda_close(w);
    sbfi_usda_close(w);
  }
  sbfi_usda_close(w);
}

/* ---- The file ---- */

static void write_scene(usda_writer *w) {
  const sbf_vec3 g = w->e->asset->environment.gravity;
  float size = sqrtf(g.x * g.x + g.y * g.y + g.z * g.z);
  sbfi_usda_open_plain(w, "PhysicsScene", "physics", "");
  sbfi_usda_write_vec3(w, "vector3f physics:gravityDirection",
      size > 0 ? (sbf_vec3){g.x / size, g.y / size, g.z / size} : (sbf_vec3){0, -1, 0});
  sbfi_usda_write_f32(w, "float physics:gravityMagnitude", size);
  sbfi_usda_close(w);
}

static bool write_all(usda_writer *w) {
  sbfi_text_string(&w->e->text, "#usda 1.0\n(\n    defaultPrim = \"asset\"\n"
                                "    doc = \"Metres, kilograms, seconds; joints in degrees. Deformables by "
                                "OpenUSD-proposals pull request 111.\"\n"
                                "    kilogramsPerUnit = 1\n    metersPerUnit = 1\n    upAxis = \"Y\"\n)\n\n");
  sbfi_usda_open_plain(w, "Xform", "asset", "");
  if (!sbfi_usda_choose_meshes(w)) return false;
  write_scene(w);
  sbfi_usda_write_materials(w);
  if (!sbfi_usda_skeleton_and_meshes(w)) return false;
  sbfi_usda_write_rigid_bodies(w);
  sbfi_usda_write_joints(w);
  if (!sbfi_usda_soft_bodies(w)) return false;
  sbfi_usda_close(w);
  return true;
}

sbf_status sbfi_export_usda(sbfi_export *e) {
  const sbf_asset *asset = e->asset;
  if (!asset->render_meshes.count && !asset->rigid_bodies.count && !asset->soft_bodies.count &&
      !asset->bones.count)
    return sbfi_diagnose(e->error, SBF_CODE_EXPORT_EMPTY,
        "there is no mesh, skeleton or body: there is nothing to write to %s", e->path);
  usda_writer w;
  memset(&w, 0, sizeof w);
  w.e = e;
  sbfi_arena_init(&w.scratch, &e->allocator, 0);
  bool written = write_all(&w);
  sbfi_arena_free(&w.scratch);
  if (!written) return sbfi_export_no_memory(e);
  const sbfi_left_out soft[] = {
      {w.without_level, "soft bodies that are neither lattices nor sheets of springs"},
      {w.goals, "goal springs"}, {w.moduli, "soft bodies whose elements differ (their mean is written)"},
      {w.damped, "soft bodies' damping"}, {w.inelastic, "soft bodies that yield, tear or are inflated"},
      {asset->cross_springs.count, "springs between bodies"}};
  const sbfi_left_out rigid[] = {{w.pulleys, "pulleys"}, {w.soft_limits, "springs and restitution of limits"},
      {w.filters, "bodies that collide with some layers only"}, {w.weights, "factors on gravity"},
      {asset->environment.fields.count, "force fields"}};
  const sbfi_left_out others[] = {{w.images, "images of materials"},
      {w.shared, "meshes that several bodies deform (only bones move them)"},
      {w.keys, "shape keys of meshes that a body deforms"}, {asset->clips.count, "clips"},
      {asset->poses.count, "poses"}, {asset->gaits.count, "gaits"}, {asset->ik_chains.count, "IK chains"},
      {asset->chains.count, "chains"}, {asset->followers.count, "followers"}};
  sbfi_export_left_out(e, "USD", soft, sizeof soft / sizeof *soft);
  sbfi_export_left_out(e, "USD", rigid, sizeof rigid / sizeof *rigid);
  sbfi_export_left_out(e, "USD", others, sizeof others / sizeof *others);
  return sbfi_export_commit(e, e->path);
}
