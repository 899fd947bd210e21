/* Converts rigid bodies and joints of the 2012 dialect. */
#include <math.h>
#include <stdio.h>
#include <string.h>

#include "import/paper/dialect2012.h"
#include "sbfmt/mechanics.h"

static const double DEGREE = 3.14159265358979323846 / 180;

/* Centre of the hull's volume, or the mean of its points if it encloses none. */
static sbf_vec3 center_of(const sbf_polygon_mesh *hull) {
  sbf_solid solid;
  sbf_solid_measure(hull, &solid);
  if (solid.volume > 0) return solid.center;
  double sum[3] = {0, 0, 0}, scale = hull->positions.count ? 1.0 / hull->positions.count : 0;
  for (uint32_t i = 0; i < hull->positions.count; i++) {
    sum[0] += (double)hull->positions.at[i].x;
    sum[1] += (double)hull->positions.at[i].y;
    sum[2] += (double)hull->positions.at[i].z;
  }
  return (sbf_vec3){(float)(sum[0] * scale), (float)(sum[1] * scale), (float)(sum[2] * scale)};
}

static sbf_status fill_rigid_body(sbfi_conversion *c, const sbfi_paper_body *from, sbf_rigid_body *body) {
  char number[16];
  snprintf(number, sizeof number, "%u", from->id);
  sbf_rigid_body_init(body);
  body->name = sbf_asset_copy_text(c->asset, number);
  body->id = body->name ? sbfi_new_id(c, "rigid", body->name) : NULL;
  if (!body->id) return sbfi_convert_no_memory(c);
  if (from->surface.vertices.values.count) {
    sbf_polygon_mesh *hull = sbfi_convert_allocate(c, 1, sizeof *hull);
    if (!hull) return sbfi_convert_no_memory(c);
    sbf_polygon_mesh_init(hull);
    hull->target = SBF_MESH_TARGET_COLLISION_DETECTION;
    sbf_status status = sbfi_paper_polygons(c, &from->surface, "vertices of the rigid body", hull);
    if (status != SBF_OK) return status;
    body->hull = hull;
    body->center = center_of(hull);
  }
  if (from->given[SBFI_PAPER_MASS]) body->mass = from->attributes[SBFI_PAPER_MASS];
  if (from->given[SBFI_PAPER_FRICTION]) body->friction = from->attributes[SBFI_PAPER_FRICTION];
  body->motion = body->mass > 0 ? SBF_BODY_MOTION_DYNAMIC : SBF_BODY_MOTION_KINEMATIC;
  return SBF_OK;
}

static bool is_length(sbf_joint_axis axis) {
  return axis <= SBF_JOINT_AXIS_LINEAR_Z || axis == SBF_JOINT_AXIS_DISTANCE;
}

static void fill_limit(const sbfi_conversion *c, const sbfi_paper_limit *from, sbf_limit *limit) {
  double unit = cbrt(fabs(sbfi_matrix_determinant(&c->to_asset)));
  double max = (double)from->angle * (is_length(from->target) ? unit : DEGREE);
  bool one_sided = from->target == SBF_JOINT_AXIS_SWING || from->target == SBF_JOINT_AXIS_DISTANCE;
  sbf_limit_init(limit);
  limit->target = from->target;
  limit->max = (float)max;
  limit->min = one_sided ? 0 : -limit->max;
}

static sbf_vec3 less(sbf_vec3 a, sbf_vec3 b) {
  return (sbf_vec3){a.x - b.x, a.y - b.y, a.z - b.z};
}

static sbf_status fill_joint(sbfi_conversion *c, const sbfi_paper_model *model, const sbfi_paper_table *table,
    const sbfi_paper_joint *from, uint32_t number, sbf_joint *joint) {
  const sbf_rigid_body *bodies = c->asset->rigid_bodies.at;
  char name[16];
  uint32_t a = 0, b;
  bool has_a = from->bodies[0] != 0;
  snprintf(name, sizeof name, "%u", number);
  if ((has_a && !sbfi_paper_find(c, table, from->bodies[0], "rigid bodies", &a)) ||
      !sbfi_paper_find(c, table, from->bodies[1], "rigid bodies", &b))
    return sbfi_paper_fault(c);
  sbf_joint_init(joint);
  joint->id = sbfi_new_id(c, "joint", name);
  sbf_limit *limits = sbfi_convert_allocate(c, from->limit_count, sizeof *limits);
  if (!joint->id || (from->limit_count && !limits)) return sbfi_convert_no_memory(c);
  joint->kind = from->kind;
  joint->body_a = has_a ? (int32_t)a : SBF_NONE;
  joint->body_b = (int32_t)b;
  sbf_vec3 middle = bodies[b].center;
  if (has_a) {
    const sbf_vec3 p = bodies[a].center, q = middle;
    middle = (sbf_vec3){(p.x + q.x) / 2, (p.y + q.y) / 2, (p.z + q.z) / 2};
  }
  joint->frame_a.position = has_a ? less(middle, bodies[a].center) : middle;
  joint->frame_b.position = less(middle, bodies[b].center);
  for (uint32_t i = 0; i < from->limit_count; i++)
    fill_limit(c, (const sbfi_paper_limit *)model->limits.at + from->first_limit + i, &limits[i]);
  joint->limits = (sbf_limit_list){limits, from->limit_count};
  return SBF_OK;
}

sbf_status sbfi_convert_paper_skeleton(sbfi_conversion *c, const sbfi_paper_model *model) {
  uint32_t count = (uint32_t)model->rigid_bodies.count, joint_count = (uint32_t)model->joints.count;
  const sbfi_paper_body *from = model->rigid_bodies.at;
  sbf_rigid_body *bodies = sbfi_convert_allocate(c, count, sizeof *bodies);
  sbf_joint *joints = sbfi_convert_allocate(c, joint_count, sizeof *joints);
  sbfi_array ids;
  sbfi_array_init(&ids, &c->scratch.allocator, sizeof(uint32_t));
  sbf_status status = SBF_OK;
  if ((count && (!bodies || !sbfi_array_push(&ids, count))) || (joint_count && !joints))
    status = sbfi_convert_no_memory(c);
  for (uint32_t i = 0; i < count && status == SBF_OK; i++) {
    ((uint32_t *)ids.at)[i] = from[i].id;
    status = fill_rigid_body(c, &from[i], &bodies[i]);
  }
  c->asset->rigid_bodies = (sbf_rigid_body_list){bodies, count};
  sbfi_paper_table table;
  if (status == SBF_OK && !sbfi_paper_table_make(c, &table, &ids, "rigid bodies"))
    status = sbfi_paper_fault(c);
  for (uint32_t i = 0; i < joint_count && status == SBF_OK; i++)
    status = fill_joint(c, model, &table, (const sbfi_paper_joint *)model->joints.at + i, i + 1, &joints[i]);
  c->asset->joints = (sbf_joint_list){joints, joint_count};
  sbfi_array_free(&ids);
  return status;
}
