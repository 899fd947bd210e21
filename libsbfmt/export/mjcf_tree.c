/* Rigid bodies nested as in MJCF: in the order of joints, each is a child of the first body on a path to
 * the world, a kinematic body, or a free floating body. */
#include "base/union_find.h"
#include "export/mjcf.h"
#include "sbfmt/mechanics.h"

static bool is_kinematic(const sbf_asset *asset, int32_t body) {
  return body < 0 || asset->rigid_bodies.at[body].motion == SBF_BODY_MOTION_KINEMATIC;
}

/* Ends are numbered 2 * joint for body a, plus one for body b. */
static int32_t body_at(const sbf_asset *asset, uint32_t end) {
  const sbf_joint *joint = &asset->joints.at[end / 2];
  return end & 1 ? joint->body_b : joint->body_a;
}

bool sbfi_mjcf_collect_joints(mjcf_writer *w) {
  const sbf_asset *asset = w->e->asset;
  uint32_t bodies = asset->rigid_bodies.count, joints = asset->joints.count;
  uint32_t *sets = sbfi_arena_allocate(&w->scratch, (size_t)bodies + 1, sizeof *sets);
  w->first = sbfi_arena_allocate(&w->scratch, (size_t)bodies + 1, sizeof *w->first);
  w->next = sbfi_arena_allocate(&w->scratch, (size_t)joints + 1, 2 * sizeof *w->next);
  w->is_tree = sbfi_arena_allocate(&w->scratch, (size_t)joints + 1, sizeof *w->is_tree);
  w->rigid.parent = sbfi_arena_allocate(&w->scratch, (size_t)bodies + 1, sizeof *w->rigid.parent);
  w->rigid.is_written = sbfi_arena_allocate(&w->scratch, (size_t)bodies + 1, sizeof *w->rigid.is_written);
  if (!sets || !w->first || !w->next || !w->is_tree || !w->rigid.parent || !w->rigid.is_written) return false;
  sbfi_sets_begin(sets, bodies + 1);
  for (uint32_t i = 0; i <= bodies; i++) w->first[i] = MJCF_END;
  for (uint32_t i = 0; i < bodies; i++)
    if (is_kinematic(asset, (int32_t)i)) sbfi_sets_join(sets, i, bodies);
  for (uint32_t j = 0; j < joints; j++) {
    const sbf_joint *joint = &asset->joints.at[j];
    uint32_t a = joint->body_a < 0 ? bodies : (uint32_t)joint->body_a;
    uint32_t b = joint->body_b < 0 ? bodies : (uint32_t)joint->body_b;
    if (joint->kind == SBF_JOINT_KIND_DISTANCE || joint->kind == SBF_JOINT_KIND_PULLEY) continue;
    w->is_tree[j] = sbfi_set_root(sets, a) != sbfi_set_root(sets, b);
    if (w->is_tree[j]) sbfi_sets_join(sets, a, b);
  }
  /* Reversed, so that each list is in the order of the joints. */
  for (uint32_t end = 2 * joints; end-- > 0;) {
    int32_t body = body_at(asset, end);
    uint32_t at = body < 0 ? bodies : (uint32_t)body;
    w->next[end] = w->first[at];
    w->first[at] = end;
  }
  return true;
}

void sbfi_mjcf_write_meshes(mjcf_writer *w) {
  const sbf_rigid_body_list bodies = w->e->asset->rigid_bodies;
  sbfi_text_string(&w->e->text, "  <asset>\n");
  for (uint32_t i = 0; i < bodies.count; i++) {
    const sbf_polygon_mesh *hull = bodies.at[i].hull;
    if (!hull || hull->positions.count < 4) continue;
    sbfi_text_string(&w->e->text, "    <mesh name=\"");
    sbfi_mjcf_rigid_name(w, (int32_t)i);
    sbfi_text_string(&w->e->text, "\" vertex=\"");
    for (uint32_t p = 0; p < hull->positions.count; p++) {
      sbf_vec3 at = hull->positions.at[p], center = bodies.at[i].center;
      sbfi_export_vec3(
          w->e, sbfi_mjcf_from_asset((sbf_vec3){at.x - center.x, at.y - center.y, at.z - center.z}));
    }
    sbfi_text_string(&w->e->text, "\"/>\n");
  }
  sbfi_text_string(&w->e->text, "  </asset>\n");
}

static void write_quaternion(mjcf_writer *w, sbf_quat q) {
  /* (1, 1, 0, 0) / sqrt 2 times q: applies the rotation by 90 degrees after it. */
  const float h = 0.70710678f;
  const float wxyz[4] = {h * (q.w - q.x), h * (q.x + q.w), h * (q.y - q.z), h * (q.z + q.y)};
  sbfi_text_string(&w->e->text, " quat=\"");
  for (int k = 0; k < 4; k++) {
    if (k) sbfi_text_char(&w->e->text, ' ');
    sbfi_text_f32(&w->e->text, wxyz[k]);
  }
  sbfi_text_char(&w->e->text, '"');
}

static void write_matter(mjcf_writer *w, const sbf_rigid_body *body) {
  sbfi_text *text = &w->e->text;
  sbf_rigid_measures measures;
  sbf_rigid_body_measure(body, &measures);
  if (!(measures.mass > 0)) {
    w->unsupported.massless += body->motion == SBF_BODY_MOTION_DYNAMIC;
    return;
  }
  const sbf_vec3 from = body->center, at = measures.center;
  sbfi_text_string(text, "      <inertial");
  sbfi_mjcf_write_vec3(w, "pos", (sbf_vec3){at.x - from.x, at.y - from.y, at.z - from.z});
  write_quaternion(w, measures.inertia_rotation);
  sbfi_mjcf_write_f32(w, "mass", (float)measures.mass);
  sbfi_text_string(text, " diaginertia=\"");
  const float moments[3] = {measures.inertia.x, measures.inertia.y, measures.inertia.z};
  for (int k = 0; k < 3; k++) {
    if (k) sbfi_text_char(text, ' ');
    sbfi_text_f32(text, moments[k]);
  }
  sbfi_text_string(text, "\"/>\n");
}

static bool has_velocity(const sbf_rigid_body *body) {
  const sbf_vec3 v = body->velocity, turn = body->angular_velocity;
  return v.x != 0 || v.y != 0 || v.z != 0 || turn.x != 0 || turn.y != 0 || turn.z != 0;
}

/* Writes the tag and the content except child bodies. `joint`: MJCF_END for none. */
static void open_body(mjcf_writer *w, uint32_t i, int32_t parent, uint32_t end) {
  const sbf_asset *asset = w->e->asset;
  const sbf_rigid_body *body = &asset->rigid_bodies.at[i];
  sbfi_text *text = &w->e->text;
  const sbf_vec3 from = parent < 0 ? (sbf_vec3){0, 0, 0} : asset->rigid_bodies.at[parent].center;
  bool kinematic = is_kinematic(asset, (int32_t)i);
  w->unsupported.velocities += !kinematic && has_velocity(body);
  w->rigid.is_written[i] = true;
  w->rigid.parent[i] = parent;
  sbfi_text_string(text, "    <body name=\"");
  sbfi_mjcf_rigid_name(w, (int32_t)i);
  sbfi_text_char(text, '"');
  if (kinematic && !w->rigid.elastic[i]) sbfi_text_string(text, " mocap=\"true\"");
  sbfi_mjcf_write_vec3(
      w, "pos", (sbf_vec3){body->center.x - from.x, body->center.y - from.y, body->center.z - from.z});
  if (body->gravity_scale != 1) sbfi_mjcf_write_f32(w, "gravcomp", 1 - body->gravity_scale);
  sbfi_text_string(text, ">\n");
  if (end != MJCF_END) {
    /* `end` is the parent's: the joint points forward if that is body a. */
    sbfi_mjcf_write_joint(w, &asset->joints.at[end / 2], end / 2, !(end & 1));
  } else if (!kinematic) {
    sbfi_text_string(text, "      <freejoint name=\"");
    sbfi_mjcf_rigid_name(w, (int32_t)i);
    sbfi_text_string(text, ":free\"/>\n");
  }
  write_matter(w, body);
  if (body->hull && body->hull->positions.count >= 4) {
    sbfi_text_string(text, "      <geom type=\"mesh\" mesh=\"");
    sbfi_mjcf_rigid_name(w, (int32_t)i);
    sbfi_text_char(text, '"');
    sbfi_mjcf_hull_bits(w, i);
    sbfi_text_string(text, " friction=\"");
    sbfi_text_f32(text, body->friction);
    sbfi_text_string(text, " 0.005 0.0001\"/>\n");
  }
}

/* Writes the anchors of distance joints. */
static void write_sites(mjcf_writer *w, uint32_t at) {
  const sbf_asset *asset = w->e->asset;
  for (uint32_t end = w->first[at]; end != MJCF_END; end = w->next[end]) {
    const sbf_joint *joint = &asset->joints.at[end / 2];
    if (joint->kind != SBF_JOINT_KIND_DISTANCE) continue;
    sbfi_text_string(&w->e->text, "      <site name=\"");
    sbfi_mjcf_name(w, joint->id, end / 2);
    sbfi_export_format(w->e, ":%c\"", end & 1 ? 'b' : 'a');
    sbfi_mjcf_write_vec3(w, "pos", end & 1 ? joint->frame_b.position : joint->frame_a.position);
    sbfi_text_string(&w->e->text, "/>\n");
  }
}

/* Writes a body with its descendants. Consumes the lists of ends as children are written. */
static void write_tree(mjcf_writer *w, uint32_t root, uint32_t end) {
  const sbf_asset *asset = w->e->asset;
  open_body(w, root, -1, end);
  write_sites(w, root);
  for (int32_t at = (int32_t)root; at >= 0;) {
    uint32_t mine = w->first[at];
    if (mine == MJCF_END) {
      sbfi_text_string(&w->e->text, "    </body>\n");
      at = w->rigid.parent[at];
      continue;
    }
    w->first[at] = w->next[mine];
    int32_t other = body_at(asset, mine ^ 1);
    if (!w->is_tree[mine / 2] || other < 0 || w->rigid.is_written[other]) continue;
    open_body(w, (uint32_t)other, at, mine);
    write_sites(w, (uint32_t)other);
    at = other;
  }
}

void sbfi_mjcf_write_bodies(mjcf_writer *w) {
  const sbf_asset *asset = w->e->asset;
  uint32_t bodies = asset->rigid_bodies.count;
  write_sites(w, bodies);
  for (uint32_t i = 0; i < bodies; i++)
    if (is_kinematic(asset, (int32_t)i)) write_tree(w, i, MJCF_END);
  for (uint32_t end = w->first[bodies]; end != MJCF_END; end = w->next[end]) {
    int32_t other = body_at(asset, end ^ 1);
    if (w->is_tree[end / 2] && other >= 0 && !w->rigid.is_written[other]) write_tree(w, (uint32_t)other, end);
  }
  for (uint32_t i = 0; i < bodies; i++)
    if (!w->rigid.is_written[i]) write_tree(w, i, MJCF_END);
}
