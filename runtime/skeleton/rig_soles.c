/* Soles: the lowest part of what hangs on a foot. */
#include "skeleton/rig_soles.h"

/* Of a foot's height: what has to have ground under it; and what stands on it, for a round foot is wider
 * above. */
static const float LARGEST = 0.6f; /* of a leg's length: half a sole */
static const float BAND = 0.12f, TOUCHES = 0.06f;

typedef struct foot_points {
  float low, high;
  sbri_sole sole;
  bool any, begun, touches;
} foot_points;

static void take(foot_points *f, sbf_vec3 p, int pass, sbf_vec3 home) {
  if (pass == 0) {
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
  if (p.y > f->low + TOUCHES * (f->high - f->low)) return;
  for (int k = 0; k < 4; k++) {
    float across = k & 1 ? 1.0f : -1.0f, along = k & 2 ? 1.0f : -1.0f;
    if (!f->touches || across * x + along * z > across * s->corners[k].x + along * s->corners[k].z)
      s->corners[k] = sbri_vec3(x, 0, z);
  }
  f->touches = true;
}

static void look_at_bodies(const sbri_rig *rig, int32_t foot, int pass, sbf_vec3 home, foot_points *f) {
  for (uint32_t b = 0; b < rig->asset->soft_bodies.count; b++) {
    const sbf_soft_body *body = &rig->asset->soft_bodies.at[b];
    if (body->bone < 0 || !sbri_rig_is_below(rig, body->bone, foot)) continue;
    for (uint32_t i = 0; i < body->surface.positions.count; i++)
      take(f, body->surface.positions.at[i], pass, home);
  }
}

static void look_at_skins(const sbri_rig *rig, int32_t foot, int pass, sbf_vec3 home, foot_points *f) {
  for (uint32_t m = 0; m < rig->asset->render_meshes.count; m++) {
    const sbf_render_mesh *mesh = &rig->asset->render_meshes.at[m];
    uint32_t at = 0;
    for (uint32_t i = 0; mesh->skin && i < mesh->skin->influence_counts.count; i++) {
      float held = 0;
      for (uint32_t k = 0; k < mesh->skin->influence_counts.at[i]; k++, at++)
        if (sbri_rig_is_below(rig, (int32_t)mesh->skin->bones.at[at], foot))
          held += mesh->skin->weights.at[at];
      if (held > 0.5f) take(f, mesh->mesh.positions.at[i], pass, home);
    }
  }
}

void sbri_rig_find_sole(const sbri_rig *rig, sbri_leg *leg) {
  foot_points f = {.any = false};
  int32_t foot = leg->has_toe ? leg->toe : leg->foot;
  for (int pass = 0; pass < 2; pass++) {
    bool bodies = false;
    for (uint32_t b = 0; b < rig->asset->soft_bodies.count; b++)
      bodies = bodies || sbri_rig_is_below(rig, rig->asset->soft_bodies.at[b].bone, foot);
    if (bodies)
      look_at_bodies(rig, foot, pass, leg->home, &f);
    else
      look_at_skins(rig, foot, pass, leg->home, &f);
  }
  /* Its middle is what stands on the ground. Nothing is seen of the foot, or something far from it hangs on
   * it: a small sole below the ankle will do. */
  float length = leg->upper_length + leg->lower_length, least = 0.02f * length;
  float x = 0.5f * (f.sole.left + f.sole.right), z = 0.5f * (f.sole.toe + f.sole.heel);
  if (x * x + z * z > length * length) x = z = 0, f.sole = (sbri_sole){0};
  float most = LARGEST * length;
  float wide = sbri_clamp(f.sole.left - x, least, most), along = sbri_clamp(f.sole.toe - z, least, most);
  leg->sole = (sbri_sole){.left = wide, .right = -wide, .toe = along, .heel = -along};
  for (int k = 0; k < 4; k++)
    leg->sole.outline[k] = sbri_clamp(f.sole.outline[k] - (k < 2 ? x : z), -most, most);
  for (int k = 0; k < 4; k++) {
    sbf_vec3 corner = sbri_sub(f.sole.corners[k], sbri_vec3(x, 0, z));
    leg->sole.corners[k] =
        sbri_vec3(sbri_clamp(corner.x, -wide, wide), 0, sbri_clamp(corner.z, -along, along));
  }
  leg->home.x += x, leg->home.z += z;
  leg->toe_place = leg->ankle = sbri_vec3(-x, leg->home.y, -z);
  if (!leg->has_toe) return;
  sbf_vec3 over = sbri_sub(rig->rest[leg->foot].position, rig->rest[leg->toe].position);
  leg->ankle = sbri_add(leg->toe_place, over);
}
