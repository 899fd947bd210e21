/* Mass of each bone: the volume of its soft bodies, or of the rigid body that the build cut from the skin; a
 * bone without either has the number of skin vertices that follow it. Volumes are sums of signed tetrahedra
 * from the bone's head. */
#include "animation/skeleton/rig_mass.h"

#include <string.h>

static sbf_vec3 third_of(sbf_vec3 a, sbf_vec3 b, sbf_vec3 c) {
  return sbri_scale(sbri_add(sbri_add(a, b), c), 0.25f);
}

/* Sums are about asset space until all is added. */
static void add_triangle(
    const sbri_rig *rig, int32_t bone, sbf_vec3 a, sbf_vec3 b, sbf_vec3 c, sbri_bone_mass *masses) {
  sbf_vec3 from = rig->bones.rest[bone].position;
  sbf_vec3 p = sbri_sub(a, from), q = sbri_sub(b, from), r = sbri_sub(c, from);
  float volume = sbri_dot(p, sbri_cross(q, r)) / 6;
  masses[bone].fraction += volume;
  masses[bone].position = sbri_add_scaled(masses[bone].position, sbri_add(from, third_of(p, q, r)), volume);
}

static void add_points(const sbf_render_mesh *mesh, sbri_bone_mass *masses) {
  uint32_t at = 0;
  for (uint32_t i = 0; mesh->skin && i < mesh->skin->influence_counts.count; i++)
    for (uint32_t k = 0; k < mesh->skin->influence_counts.at[i]; k++, at++) {
      sbri_bone_mass *mass = &masses[mesh->skin->bones.at[at]];
      float weight = mesh->skin->weights.at[at];
      mass->fraction += weight;
      mass->position = sbri_add_scaled(mass->position, mesh->mesh.positions.at[i], weight);
    }
}

static void add_surface(
    const sbri_rig *rig, int32_t bone, const sbf_polygon_mesh *m, sbri_bone_mass *masses) {
  for (uint32_t p = 0, at = 0; p < m->polygon_sizes.count; at += m->polygon_sizes.at[p++]) {
    const uint32_t *corner = m->polygon_points.at + at;
    for (uint32_t k = 2; k < m->polygon_sizes.at[p]; k++)
      add_triangle(rig, bone, m->positions.at[corner[0]], m->positions.at[corner[k - 1]],
          m->positions.at[corner[k]], masses);
  }
}

static void add_solid(const sbf_rigid_body *rigid, sbri_bone_mass *mass) {
  float volume = rigid->mass / rigid->density;
  mass->fraction += volume;
  mass->position = sbri_add_scaled(mass->position, rigid->center, volume);
}

static bool has_section(const sbf_asset *asset, int32_t bone) {
  for (uint32_t i = 0; i < asset->soft_bodies.count; i++)
    if (asset->soft_bodies.at[i].bone == bone) return true;
  return false;
}

void sbri_rig_find_masses(const sbri_rig *rig, sbri_bone_mass *masses) {
  const sbf_asset *asset = rig->asset;
  memset(masses, 0, rig->bones.count * sizeof *masses);
  bool bodies = false;
  for (uint32_t i = 0; i < asset->soft_bodies.count; i++) {
    if (asset->soft_bodies.at[i].bone < 0) continue;
    bodies = true;
    add_surface(rig, asset->soft_bodies.at[i].bone, &asset->soft_bodies.at[i].surface, masses);
  }
  for (uint32_t i = 0; i < asset->rigid_bodies.count; i++) {
    const sbf_rigid_body *rigid = &asset->rigid_bodies.at[i];
    bool cut = rigid->hull && (rigid->derived != SBF_NONE || rigid->hull_derived != SBF_NONE);
    if (!cut || rigid->bone < 0 || has_section(asset, rigid->bone)) continue;
    bodies = true;
    if (rigid->mass > 0 && rigid->density > 0)
      add_solid(rigid, &masses[rigid->bone]);
    else
      add_surface(rig, rigid->bone, rigid->hull, masses);
  }
  for (uint32_t i = 0; !bodies && i < asset->render_meshes.count; i++)
    add_points(&asset->render_meshes.at[i], masses);
  float total = 0;
  for (uint32_t i = 0; i < rig->bones.count; i++) {
    if (!(masses[i].fraction > 0)) masses[i] = (sbri_bone_mass){0};
    total += masses[i].fraction;
  }
  for (uint32_t i = 0; total > 0 && i < rig->bones.count; i++) {
    const sbr_transform *rest = &rig->bones.rest[i];
    if (masses[i].fraction > 0) masses[i].position = sbri_scale(masses[i].position, 1 / masses[i].fraction);
    masses[i].position =
        sbri_rotate(sbri_quat_conjugate(rest->rotation), sbri_sub(masses[i].position, rest->position));
    masses[i].fraction /= total;
  }
}

bool sbri_rig_center(const sbri_rig *rig, const sbr_transform *pose, float scale, sbf_vec3 *center) {
  sbf_vec3 sum = {0, 0, 0};
  float total = 0;
  for (uint32_t i = 0; i < rig->bones.count; i++) {
    const sbri_bone_mass *mass = &rig->bones.masses[i];
    if (mass->fraction <= 0) continue;
    sbf_vec3 at =
        sbri_add(pose[i].position, sbri_rotate(pose[i].rotation, sbri_scale(mass->position, scale)));
    sum = sbri_add_scaled(sum, at, mass->fraction);
    total += mass->fraction;
  }
  *center = sum;
  return total > 0;
}
