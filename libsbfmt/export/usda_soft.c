/* Writes soft bodies with the proposal's schemas: the first lattice as a TetMesh, a sheet's springs as a
 * Mesh of triangles; pins as attachments to the transform of their holder. */
#include <stdio.h>
#include <stdlib.h>

#include "export/usda.h"
#include "sbfmt/mechanics.h"

/* ---- The surface of a lattice ---- */

typedef struct face {
  uint32_t points[3]; /* as seen from outside */
  uint32_t key[3];    /* ascending */
} face;

static int compare_faces(const void *a, const void *b) {
  const face *x = a, *y = b;
  for (int k = 0; k < 3; k++)
    if (x->key[k] != y->key[k]) return x->key[k] < y->key[k] ? -1 : 1;
  return 0;
}

static void sort_key(uint32_t key[3]) {
  for (int k = 0; k < 3; k++) {
    int a = k == 1 ? 1 : 0;
    if (key[a] <= key[a + 1]) continue;
    uint32_t swapped = key[a];
    key[a] = key[a + 1];
    key[a + 1] = swapped;
  }
}

/* Faces of only one tetrahedron, facing outwards. */
static bool write_surface(usda_writer *w, const sbf_level *level) {
  static const int corners[4][3] = {{1, 2, 3}, {0, 3, 2}, {0, 1, 3}, {0, 2, 1}};
  uint32_t count = level->lattice.tetrahedra.count, kept = 0;
  face *faces = sbfi_arena_allocate(&w->scratch, count, 4 * sizeof *faces);
  uint32_t *outer = sbfi_arena_allocate(&w->scratch, count, 12 * sizeof *outer);
  if (!faces || !outer) return false;
  for (uint32_t t = 0; t < count; t++)
    for (int f = 0; f < 4; f++) {
      face *one = &faces[4 * (size_t)t + (size_t)f];
      for (int k = 0; k < 3; k++)
        one->points[k] = one->key[k] = level->lattice.tetrahedra.at[t].at[corners[f][k]];
      sort_key(one->key);
    }
  size_t all = 4 * (size_t)count;
  qsort(faces, all, sizeof *faces, compare_faces);
  for (size_t i = 0, next; i < all; i = next) {
    for (next = i + 1; next < all && compare_faces(&faces[i], &faces[next]) == 0;) next++;
    if (next == i + 1) {
      for (int k = 0; k < 3; k++) outer[3 * (size_t)kept + (size_t)k] = faces[i].points[k];
      kept++;
    }
  }
  sbfi_usda_write_indices(w, "int3[] surfaceFaceVertexIndices", outer, kept, 3);
  return true;
}

/* ---- Matter ---- */

static bool write_matter(usda_writer *w, const sbf_soft_body *body, const sbf_level *level, bool sheet) {
  const sbf_attributes *matter = &body->attributes;
  float modulus = matter->young_modulus, ratio = matter->poisson_ratio, thick = matter->thickness;
  uint32_t count = level->lattice.tetrahedra.count;
  if (!sheet) {
    float *factors = sbfi_arena_allocate(&w->scratch, level->positions.count, sizeof *factors);
    float *moduli = sbfi_arena_allocate(&w->scratch, count, sizeof *moduli);
    double sum = 0;
    bool differ = false;
    if (!factors || !moduli) return false;
    sbf_level_moduli(body, level, factors, moduli);
    for (uint32_t i = 0; i < count; i++) {
      sum += (double)moduli[i];
      differ = differ || moduli[i] != moduli[0];
    }
    modulus = (float)(sum / count);
    w->moduli += differ;
  }
  w->damped += matter->mass_damping > 0 || matter->stiffness_damping > 0 || matter->damping_ratio > 0;
  w->inelastic +=
      matter->yield_strain > 0 || matter->tear_strain > 0 || matter->pressure_mode != SBF_PRESSURE_MODE_NONE;
  w->weights += matter->gravity_scale != 1;
  w->filters += body->collision.layer != 1 || body->collision.mask != UINT32_MAX;
  sbfi_usda_open_plain(w, "Material", "matter",
      sheet ? "\"PhysicsMaterialAPI\", \"PhysicsSurfaceDeformableMaterialAPI\""
            : "\"PhysicsMaterialAPI\", \"PhysicsVolumeDeformableMaterialAPI\"");
  float density = sheet && matter->area_density > 0 ? matter->area_density / thick : matter->density;
  sbfi_usda_write_f32(w, "float physics:density", density);
  sbfi_usda_write_f32(w, "float physics:dynamicFriction", matter->friction);
  sbfi_usda_write_f32(w, "float physics:staticFriction", matter->friction);
  if (sheet) {
    /* All three are moduli there; a stated bending stiffness is converted to the equivalent modulus. */
    float bend = matter->bending_stiffness > 0
                     ? matter->bending_stiffness * 12 * (1 - ratio * ratio) / (thick * thick * thick)
                     : modulus;
    sbfi_usda_write_f32(w, "float physics:thickness", thick);
    sbfi_usda_write_f32(w, "float physics:stretchStiffness", modulus);
    sbfi_usda_write_f32(w, "float physics:shearStiffness", modulus / (2 * (1 + ratio)));
    sbfi_usda_write_f32(w, "float physics:bendStiffness", bend);
  } else {
    sbfi_usda_write_f32(w, "float physics:youngsModulus", modulus);
    sbfi_usda_write_f32(w, "float physics:poissonsRatio", ratio);
  }
  sbfi_usda_close(w);
  return true;
}

/* ---- Geometry ---- */

static bool write_masses(usda_writer *w, const sbf_soft_body *body, const sbf_level *level) {
  float *masses = sbfi_arena_allocate(&w->scratch, level->positions.count, sizeof *masses);
  if (!masses) return false;
  sbf_level_masses(body, level, NULL, masses);
  sbfi_usda_begin(w, "float[] physics:masses = [");
  for (uint32_t i = 0; i < level->positions.count; i++) {
    if (i) sbfi_text_string(&w->e->text, ", ");
    sbfi_text_f32(&w->e->text, masses[i]);
  }
  sbfi_text_string(&w->e->text, "]\n");
  return true;
}

/* A sheet's polygons as fans, with the level's points. */
static bool write_triangles(usda_writer *w, const sbf_soft_body *body, const sbf_level *level) {
  const sbf_polygon_mesh *mesh = &body->surface;
  uint32_t *points = sbfi_arena_allocate(&w->scratch, mesh->polygon_points.count, 3 * sizeof *points);
  uint32_t *sizes = sbfi_arena_allocate(&w->scratch, mesh->polygon_points.count, sizeof *sizes);
  uint32_t count = 0;
  if (!points || !sizes) return false;
  for (uint32_t i = 0, corner = 0; i < mesh->polygon_sizes.count; i++) {
    for (uint32_t k = 2; k < mesh->polygon_sizes.at[i]; k++, count++) {
      const uint32_t at[3] = {corner, corner + k - 1, corner + k};
      for (int c = 0; c < 3; c++)
        points[3 * (size_t)count + (size_t)c] = sbfi_export_index(level, mesh->polygon_points.at[at[c]]);
      sizes[count] = 3;
    }
    corner += mesh->polygon_sizes.at[i];
  }
  sbfi_usda_write_indices(w, "int[] faceVertexCounts", sizes, count, 1);
  sbfi_usda_write_indices(w, "int[] faceVertexIndices", points, 3 * count, 1);
  return true;
}

static bool write_geometry(
    usda_writer *w, const sbf_soft_body *body, uint32_t index, const sbf_level *level, bool sheet) {
  const sbf_vec3 zero = {0, 0, 0};
  sbfi_usda_open_plain(w, sheet ? "Mesh" : "TetMesh", "simulation",
      sheet ? "\"MaterialBindingAPI\", \"PhysicsSurfaceDeformableSimAPI\", \"PhysicsCollisionAPI\""
            : "\"MaterialBindingAPI\", \"PhysicsVolumeDeformableSimAPI\", \"PhysicsCollisionAPI\"");
  sbfi_usda_write_line(w, "uniform token purpose = \"guide\"");
  if (sheet) sbfi_usda_write_line(w, "uniform token subdivisionScheme = \"none\"");
  sbfi_usda_write_extent(w, level->positions.at, level->positions.count, zero);
  sbfi_usda_write_points(w, "point3f[] points", level->positions.at, level->positions.count, zero);
  if (sheet) {
    if (!write_triangles(w, body, level)) return false;
    sbfi_usda_write_line(w, "uniform token physics:restBendAnglesDefault = \"restShape\"");
  } else {
    sbfi_usda_write_indices(
        w, "int4[] tetVertexIndices", level->lattice.tetrahedra.at->at, level->lattice.tetrahedra.count, 4);
    if (!write_surface(w, level)) return false;
  }
  sbfi_usda_write_points(
      w, "point3f[] physics:restShapePoints", level->positions.at, level->positions.count, zero);
  if (!write_masses(w, body, level)) return false;
  sbfi_usda_begin(w, "rel material:binding:physics = ");
  sbfi_usda_write_path(w, "soft", body->id, index, "/matter>");
  sbfi_usda_end(w);
  sbfi_usda_close(w);
  return true;
}

/* ---- Attachments ---- */

static sbf_vec3 rotate_inverse(sbf_quat q, sbf_vec3 v) {
  const sbf_vec3 u = {-q.x, -q.y, -q.z};
  const sbf_vec3 t = {2 * (u.y * v.z - u.z * v.y), 2 * (u.z * v.x - u.x * v.z), 2 * (u.x * v.y - u.y * v.x)};
  return (sbf_vec3){v.x + q.w * t.x + u.y * t.z - u.z * t.y, v.y + q.w * t.y + u.z * t.x - u.x * t.z,
      v.z + q.w * t.z + u.x * t.y - u.y * t.x};
}

static sbf_vec3 position_in_frame(
    const sbf_asset *asset, const sbf_level *level, const sbf_pin_set *set, uint32_t k) {
  if (set->offsets.count) return set->offsets.at[k];
  const sbf_vec3 p = level->positions.at[set->points.at[k]];
  const sbf_vec3 none = {0, 0, 0};
  const sbf_vec3 from = set->bone >= 0         ? asset->bones.at[set->bone].head
                        : set->rigid_body >= 0 ? asset->rigid_bodies.at[set->rigid_body].center
                                               : none;
  const sbf_vec3 d = {p.x - from.x, p.y - from.y, p.z - from.z};
  return set->bone >= 0 ? rotate_inverse(asset->bones.at[set->bone].rotation, d) : d;
}

static bool write_pins(
    usda_writer *w, const sbf_soft_body *body, uint32_t index, const sbf_level *level, uint32_t s) {
  const sbf_asset *asset = w->e->asset;
  const sbf_pin_set *set = &level->pins.at[s];
  uint32_t *points = sbfi_arena_allocate(&w->scratch, (size_t)set->points.count + 1, sizeof *points);
  sbf_vec3 *positions = sbfi_arena_allocate(&w->scratch, (size_t)set->points.count + 1, sizeof *positions);
  uint32_t count = 0;
  if (!points || !positions) return false;
  for (uint32_t k = 0; k < set->points.count; k++) {
    if (sbfi_export_pin_weight(set, k) < 1) {
      w->goals++;
      continue;
    }
    points[count] = set->points.at[k];
    positions[count++] = position_in_frame(asset, level, set, k);
  }
  if (!count) return true;
  char name[32];
  snprintf(name, sizeof name, "pins__%u", s);
  sbfi_usda_open_plain(w, "PhysicsAttachment", name, "");
  sbfi_usda_begin(w, "rel physics:src0 = ");
  sbfi_usda_write_path(w, "soft", body->id, index, "/simulation>");
  sbfi_usda_end(w);
  sbfi_usda_begin(w, "rel physics:src1 = ");
  if (set->bone >= 0)
    sbfi_usda_write_path(w, "bones", asset->bones.at[set->bone].id, (uint32_t)set->bone, ">");
  else if (set->rigid_body >= 0)
    sbfi_usda_write_path(
        w, "rigid", asset->rigid_bodies.at[set->rigid_body].id, (uint32_t)set->rigid_body, ">");
  else
    sbfi_text_string(&w->e->text, "</asset>");
  sbfi_usda_end(w);
  sbfi_usda_write_line(w, "uniform token physics:type0 = \"point\"");
  sbfi_usda_write_line(w, "uniform token physics:type1 = \"xform\"");
  sbfi_usda_write_indices(w, "int[] physics:indices0", points, count, 1);
  sbfi_usda_write_points(w, "vector3f[] physics:coords1", positions, count, (sbf_vec3){0, 0, 0});
  sbfi_usda_close(w);
  if (set->bone >= 0) w->bone_has_pins[set->bone] = true;
  return true;
}

static bool write_body(usda_writer *w, uint32_t index) {
  const sbf_asset *asset = w->e->asset;
  const sbf_soft_body *body = &asset->soft_bodies.at[index];
  const sbf_level *level = sbfi_export_level(body);
  if (!level) {
    w->without_level++;
    return true;
  }
  bool sheet = level->model == SBF_ELASTIC_MODEL_SPRINGS;
  sbfi_usda_open(w, "Xform", body->id, index, "\"PhysicsDeformableBodyAPI\"");
  if (!write_geometry(w, body, index, level, sheet) || !write_matter(w, body, level, sheet)) return false;
  for (uint32_t s = 0; s < level->pins.count; s++)
    if (!write_pins(w, body, index, level, s)) return false;
  sbfi_usda_open_plain(w, "Scope", "meshes", "");
  for (uint32_t i = 0; i < asset->render_meshes.count; i++)
    if (w->meshes[i].body == (int32_t)index && !sbfi_usda_mesh(w, i)) return false;
  sbfi_usda_close(w);
  sbfi_usda_close(w);
  return true;
}

bool sbfi_usda_soft_bodies(usda_writer *w) {
  const sbf_asset *asset = w->e->asset;
  if (!asset->soft_bodies.count) return true;
  w->bone_has_pins =
      sbfi_arena_allocate(&w->scratch, (size_t)asset->bones.count + 1, sizeof *w->bone_has_pins);
  if (!w->bone_has_pins) return false;
  sbfi_usda_open_plain(w, "Scope", "soft", "");
  for (uint32_t i = 0; i < asset->soft_bodies.count; i++)
    if (!write_body(w, i)) return false;
  sbfi_usda_close(w);
  bool any = false;
  for (uint32_t b = 0; b < asset->bones.count; b++) any = any || w->bone_has_pins[b];
  if (!any) return true;
  sbfi_usda_open_plain(w, "Scope", "bones", "");
  for (uint32_t b = 0; b < asset->bones.count; b++) {
    const sbf_bone *bone = &asset->bones.at[b];
    if (!w->bone_has_pins[b]) continue;
    sbfi_usda_open(w, "Xform", bone->id, b, "");
    sbfi_usda_write_vec3(w, "double3 xformOp:translate", bone->head);
    sbfi_usda_write_quat(w, "quatf xformOp:orient", bone->rotation);
    sbfi_usda_write_line(w, "uniform token[] xformOpOrder = [\"xformOp:translate\", \"xformOp:orient\"]");
    sbfi_usda_close(w);
  }
  sbfi_usda_close(w);
  return true;
}
