/* Creates rigid bodies for bones with sections, and joints between them along the skeleton.
 *
 * A body moves with its bone; the build computes its hull. A joint is at the head of the child bone, in
 * the frame that joint limits refer to: the joint's +X (twist axis), +Y and +Z are the bone's +Y, +Z and
 * +X. */
#include <math.h>

#include "build/sections/section_joints.h"
#include "build/sections/sections.h"
#include "import/convert/conversion.h"
#include "import/physics/physics.h"

typedef struct body_center {
  double sum[3];
  uint32_t corners, first_section, section_count;
  bool of_skin; /* it has no section, only points of a skin */
} body_center;

/* Centres are means over polygon corners, so that points outside all polygons have no effect. */
static void add_section(body_center *center, const sbf_soft_body *section, uint32_t number) {
  const sbf_polygon_mesh *mesh = &section->surface;
  if (center->section_count++ == 0) center->first_section = number;
  for (uint32_t k = 0; k < mesh->polygon_points.count; k++) {
    sbf_vec3 p = mesh->positions.at[mesh->polygon_points.at[k]];
    center->sum[0] += (double)p.x;
    center->sum[1] += (double)p.y;
    center->sum[2] += (double)p.z;
  }
  center->corners += mesh->polygon_points.count;
}

static bool fill_rigid_body(
    sbfi_conversion *c, int32_t bone, const body_center *center, sbf_rigid_body *body) {
  const sbf_soft_body *section =
      center->section_count ? &c->asset->soft_bodies.at[center->first_section] : NULL;
  double scale = center->corners ? 1.0 / center->corners : 0;
  sbf_rigid_body_init(body);
  body->name = c->asset->bones.at[bone].name;
  body->id = sbfi_new_id(c, "rigid", body->name);
  body->bone = bone;
  body->center = (sbf_vec3){
      (float)(center->sum[0] * scale), (float)(center->sum[1] * scale), (float)(center->sum[2] * scale)};
  if (section) {
    body->density = section->attributes.density;
    body->friction = section->attributes.friction;
    body->restitution = section->attributes.restitution;
    body->layer = section->collision.layer;
    body->mask = section->collision.mask;
  }
  return body->id != NULL;
}

static bool fill_limits(sbfi_conversion *c, const sbfi_scene_limit *from, sbf_limit_list *to) {
  static const sbf_joint_axis axes[SBFI_LIMITS] = {
      SBF_JOINT_AXIS_TWIST, SBF_JOINT_AXIS_SWING_Y, SBF_JOINT_AXIS_SWING_Z};
  uint32_t count = 0;
  sbf_limit *limits = sbfi_convert_allocate(c, SBFI_LIMITS, sizeof *limits);
  if (!limits) return false;
  for (int i = 0; i < SBFI_LIMITS; i++) {
    if (!from[i].stated) continue;
    sbf_limit *limit = &limits[count++];
    sbf_limit_init(limit);
    limit->target = axes[i];
    limit->min = from[i].min;
    limit->max = from[i].max;
  }
  *to = (sbf_limit_list){count ? limits : NULL, count};
  return true;
}

/* `a` and `b` are indices of the parent and the child body. */
static bool fill_joint(
    sbfi_conversion *c, int32_t a, int32_t b, const sbf_rigid_body *bodies, sbf_joint *joint) {
  int32_t bone = bodies[b].bone;
  sbf_joint_init(joint);
  joint->name = c->asset->bones.at[bone].name;
  joint->id = sbfi_new_id(c, "joint", joint->name);
  joint->kind = SBF_JOINT_KIND_SPHERICAL;
  joint->body_a = a;
  joint->body_b = b;
  joint->frame_a = sbfi_bone_joint_frame(&c->asset->bones.at[bone], &bodies[a]);
  joint->frame_b = sbfi_bone_joint_frame(&c->asset->bones.at[bone], &bodies[b]);
  if (!joint->id || !fill_limits(c, c->rig->nodes[c->node_of_bone[bone]].limits, &joint->limits))
    return false;
  joint->proposed = joint->limits.count == 0; /* no limits were authored */
  return true;
}

/* Adds each point of a skin to the centre of its main bone, or of the bone whose section will contain it. */
static void add_skin(const sbf_render_mesh *mesh, const uint32_t *owners, body_center *centers) {
  const sbf_skin *skin = mesh->skin;
  uint32_t at = 0;
  for (uint32_t i = 0; skin && i < skin->influence_counts.count; at += skin->influence_counts.at[i++]) {
    uint32_t max = at;
    for (uint32_t s = at; s < at + skin->influence_counts.at[i]; s++)
      if (skin->weights.at[s] > skin->weights.at[max]) max = s;
    if (skin->influence_counts.at[i] == 0) continue;
    uint32_t bone = skin->bones.at[max];
    body_center *center = &centers[owners ? owners[bone] : bone];
    if (center->section_count) continue;
    sbf_vec3 p = mesh->mesh.positions.at[i];
    center->sum[0] += (double)p.x;
    center->sum[1] += (double)p.y;
    center->sum[2] += (double)p.z;
    center->corners++;
    center->of_skin = true;
  }
}

static void add_head(const sbf_bone *bone, body_center *center) {
  *center = (body_center){{(double)bone->head.x, (double)bone->head.y, (double)bone->head.z}, 1, 0, 0, true};
}

/* Bones that hang on a bone without sections, such as legs on the hips of many rigs, need a joint to that
 * bone. */
static void add_tops(const sbf_bone_list *bones, body_center *centers, uint8_t *below_one) {
  for (uint32_t i = 0; i < bones->count; i++) {
    int32_t above = bones->at[i].parent;
    if (above == SBF_NONE) continue;
    below_one[i] = below_one[above] || centers[above].section_count || centers[above].of_skin;
    if (centers[i].of_skin && !below_one[i]) add_head(&bones->at[above], &centers[above]);
  }
}

/* Adds bones that have no section but move points of a skin; the centre is the mean of the points. For
 * skins that the build cuts into sections these are the bones of the sections. */
static bool add_skins(sbfi_conversion *c, body_center *centers) {
  const uint32_t *owners;
  uint8_t *below_one = sbfi_arena_allocate(&c->scratch, c->asset->bones.count, 1);
  if (!below_one || !sbfi_section_owners_find(&owners, c->asset, &c->scratch)) return false;
  if (!owners && c->options->limits == SBF_CONVERT_LIMITS_NONE)
    return true; /* sections already determine the bodies */
  for (uint32_t m = 0; m < c->asset->render_meshes.count; m++)
    add_skin(&c->asset->render_meshes.at[m], owners, centers);
  for (uint32_t i = 0; owners && i < c->asset->bones.count; i++)
    if (owners[i] == i && !centers[i].of_skin) add_head(&c->asset->bones.at[i], &centers[i]);
  if (owners) add_tops(&c->asset->bones, centers, below_one);
  return true;
}

/* Whether joint limits were authored or will be proposed. */
static bool limits_known(const sbfi_conversion *c) {
  bool known = c->options->limits != SBF_CONVERT_LIMITS_NONE;
  for (uint32_t i = 0; i < c->asset->bones.count && !known; i++)
    for (int k = 0; k < SBFI_LIMITS; k++) known = known || c->rig->nodes[c->node_of_bone[i]].limits[k].stated;
  return known;
}

sbf_status sbfi_convert_joints(sbfi_conversion *c) {
  const sbf_bone_list bones = c->asset->bones;
  const sbf_soft_body_list sections = c->asset->soft_bodies;
  bool of_skin = limits_known(c);
  if (c->physics) return sbfi_physics_convert(c);
  if (bones.count == 0 || (sections.count == 0 && !of_skin)) return SBF_OK;
  body_center *centers = sbfi_arena_allocate(&c->scratch, bones.count, sizeof *centers);
  int32_t *body_of_bone = sbfi_arena_allocate(&c->scratch, bones.count, sizeof *body_of_bone);
  if (!centers || !body_of_bone) return sbfi_convert_no_memory(c);
  for (uint32_t s = 0; s < sections.count; s++)
    if (sections.at[s].bone >= 0) add_section(&centers[sections.at[s].bone], &sections.at[s], s);
  if (of_skin && !add_skins(c, centers)) return sbfi_convert_no_memory(c);
  uint32_t count = 0, joint_count = 0;
  for (uint32_t i = 0; i < bones.count; i++) count += centers[i].section_count > 0 || centers[i].of_skin;
  if (count == 0) return SBF_OK;
  sbf_rigid_body *bodies = sbfi_convert_allocate(c, count, sizeof *bodies);
  sbf_joint *joints = sbfi_convert_allocate(c, count, sizeof *joints);
  if (!bodies || !joints) return sbfi_convert_no_memory(c);
  count = 0;
  for (uint32_t i = 0; i < bones.count; i++) {
    /* A bone whose parent has no body is joined to the nearest body above. */
    int32_t above = bones.at[i].parent >= 0 ? body_of_bone[bones.at[i].parent] : SBF_NONE;
    body_of_bone[i] = above;
    if (centers[i].section_count == 0 && !centers[i].of_skin) continue;
    body_of_bone[i] = (int32_t)count;
    if (!fill_rigid_body(c, (int32_t)i, &centers[i], &bodies[count])) return sbfi_convert_no_memory(c);
    if (above >= 0 && !fill_joint(c, above, (int32_t)count, bodies, &joints[joint_count++]))
      return sbfi_convert_no_memory(c);
    count++;
  }
  c->asset->rigid_bodies = (sbf_rigid_body_list){bodies, count};
  c->asset->joints = (sbf_joint_list){joint_count ? joints : NULL, joint_count};
  return SBF_OK;
}
