/* Soles: the lowest part of the points on a foot. */
#include "animation/skeleton/rig_soles.h"

/* Fractions of a foot's height: the part that needs ground under it; and the part that counts as sole,
 * because a round foot is wider above. */
static const float LARGEST = 0.6f; /* fraction of a leg's length: maximum of half a sole */
static const float BAND = 0.12f, CONTACT_BAND = 0.06f;

/* Three passes: height, points near the ground, points in contact. */
enum { HEIGHT, POINTS, CUT };

typedef struct foot_points {
  float low, high;
  sbri_sole sole;
  bool any, begun, is_touching;
} foot_points;

static float touching_height(const foot_points *f) {
  return f->low + CONTACT_BAND * (f->high - f->low);
}

static void add_corner(foot_points *f, float x, float z) {
  for (int k = 0; k < 4; k++) {
    float across = k & 1 ? 1.0f : -1.0f, along = k & 2 ? 1.0f : -1.0f;
    if (!f->is_touching ||
        across * x + along * z > across * f->sole.corners[k].x + along * f->sole.corners[k].z)
      f->sole.corners[k] = sbri_vec3(x, 0, z);
  }
  f->is_touching = true;
}

static void take(foot_points *f, sbf_vec3 p, int pass, sbf_vec3 home) {
  if (pass == HEIGHT) {
    f->low = !f->any || p.y < f->low ? p.y : f->low;
    f->high = !f->any || p.y > f->high ? p.y : f->high;
    f->any = true;
    return;
  }
  sbri_sole *s = &f->sole;
  float x = p.x - home.x, z = p.z - home.z;
  s->outline[0] = x > s->outline[0] ? x : s->outline[0];
  s->outline[1] = x < s->outline[1] ? x : s->outline[1];
  s->outline[2] = z > s->outline[2] ? z : s->outline[2];
  s->outline[3] = z < s->outline[3] ? z : s->outline[3];
  if (p.y > f->low + BAND * (f->high - f->low)) return;
  if (!f->begun) s->left = s->right = x, s->toe = s->heel = z;
  f->begun = true;
  s->left = x > s->left ? x : s->left;
  s->right = x < s->right ? x : s->right;
  s->toe = z > s->toe ? z : s->toe;
  s->heel = z < s->heel ? z : s->heel;
  if (p.y <= touching_height(f)) add_corner(f, x, z);
}

static bool is_in_outline(const foot_points *f, sbf_vec3 p, sbf_vec3 home) {
  const float *outline = f->sole.outline;
  float x = p.x - home.x, z = p.z - home.z;
  return p.y >= f->low && p.y <= f->high && x <= outline[0] && x >= outline[1] && z <= outline[2] &&
         z >= outline[3];
}

/* Intersections of the foot's surface edges with the contact height: for a hoof or a ball, only its lowest
 * vertex may be below it. */
static void add_cut(foot_points *f, const sbf_polygon_mesh *mesh, sbf_vec3 home) {
  const uint32_t *corners = mesh->polygon_points.at;
  float height = touching_height(f);
  for (uint32_t p = 0; p < mesh->polygon_sizes.count; corners += mesh->polygon_sizes.at[p++])
    for (uint32_t k = 0, n = mesh->polygon_sizes.at[p]; k < n; k++) {
      sbf_vec3 a = mesh->positions.at[corners[k]], b = mesh->positions.at[corners[(k + 1) % n]];
      if ((a.y <= height) == (b.y <= height)) continue;
      if (!is_in_outline(f, a, home) || !is_in_outline(f, b, home)) continue;
      sbf_vec3 at = sbri_lerp(a, b, (height - a.y) / (b.y - a.y));
      add_corner(f, at.x - home.x, at.z - home.z);
    }
}

static void visit_bodies(const sbri_rig *rig, int32_t foot, int pass, sbf_vec3 home, foot_points *f) {
  for (uint32_t b = 0; b < rig->asset->soft_bodies.count; b++) {
    const sbf_soft_body *body = &rig->asset->soft_bodies.at[b];
    if (body->bone < 0 || !sbri_rig_is_below(rig, body->bone, foot)) continue;
    for (uint32_t i = 0; pass < CUT && i < body->surface.positions.count; i++)
      take(f, body->surface.positions.at[i], pass, home);
    if (pass == CUT) add_cut(f, &body->surface, home);
  }
}

static void visit_skins(const sbri_rig *rig, int32_t foot, int pass, sbf_vec3 home, foot_points *f) {
  for (uint32_t m = 0; m < rig->asset->render_meshes.count; m++) {
    const sbf_render_mesh *mesh = &rig->asset->render_meshes.at[m];
    uint32_t at = 0;
    if (mesh->skin && pass == CUT) add_cut(f, &mesh->mesh, home);
    for (uint32_t i = 0; mesh->skin && pass < CUT && i < mesh->skin->influence_counts.count; i++) {
      float limited = 0;
      for (uint32_t k = 0; k < mesh->skin->influence_counts.at[i]; k++, at++)
        if (sbri_rig_is_below(rig, (int32_t)mesh->skin->bones.at[at], foot))
          limited += mesh->skin->weights.at[at];
      if (limited > 0.5f) take(f, mesh->mesh.positions.at[i], pass, home);
    }
  }
}

void sbri_rig_find_sole(const sbri_rig *rig, sbri_leg *leg) {
  foot_points f = {.any = false};
  int32_t foot = leg->has_toe ? leg->toe : leg->foot;
  for (int pass = HEIGHT; pass <= CUT; pass++) {
    bool bodies = false;
    for (uint32_t b = 0; b < rig->asset->soft_bodies.count; b++)
      bodies = bodies || sbri_rig_is_below(rig, rig->asset->soft_bodies.at[b].bone, foot);
    if (bodies)
      visit_bodies(rig, foot, pass, leg->home.position, &f);
    else
      visit_skins(rig, foot, pass, leg->home.position, &f);
  }
  /* Its middle stands on the ground. If the foot has no points, or has some that are far away: a small sole
   * below the ankle. */
  float length = leg->length.upper + leg->length.lower, min = 0.02f * length;
  float x = 0.5f * (f.sole.left + f.sole.right), z = 0.5f * (f.sole.toe + f.sole.heel);
  if (x * x + z * z > length * length) x = z = 0, f.sole = (sbri_sole){0};
  float max = LARGEST * length;
  float wide = sbri_clamp(f.sole.left - x, min, max), along = sbri_clamp(f.sole.toe - z, min, max);
  leg->sole = (sbri_sole){.left = wide, .right = -wide, .toe = along, .heel = -along};
  for (int k = 0; k < 4; k++)
    leg->sole.outline[k] = sbri_clamp(f.sole.outline[k] - (k < 2 ? x : z), -max, max);
  for (int k = 0; k < 4; k++) {
    sbf_vec3 corner = sbri_sub(f.sole.corners[k], sbri_vec3(x, 0, z));
    leg->sole.corners[k] =
        sbri_vec3(sbri_clamp(corner.x, -wide, wide), 0, sbri_clamp(corner.z, -along, along));
  }
  leg->home.position.x += x, leg->home.position.z += z;
  leg->home.toe = leg->home.ankle = sbri_vec3(-x, leg->home.position.y, -z);
  if (!leg->has_toe) return;
  sbf_vec3 over = sbri_sub(rig->bones.rest[leg->foot].position, rig->bones.rest[leg->toe].position);
  leg->home.ankle = sbri_add(leg->home.toe, over);
}
