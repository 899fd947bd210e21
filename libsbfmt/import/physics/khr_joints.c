/* Joints from limits and drives.
 *
 * A joint of the extension has up to six coordinates: position and rotation of the connected node in the
 * frame of the joint's node. Ours are the same, with +X as the twist axis: a cyclic exchange of the axes
 * brings the joint's main axis there. */
#include <math.h>
#include <stdio.h>
#include <string.h>

#include "import/physics/physics.h"
#include "import/scene/trs.h"
#include "mechanics/joint_freedom.h"
#include "motion/quatd.h"

enum { MAX_LIMITS = 64, MAX_DRIVES = 32, AXES = 3 };
static const float UNBOUNDED_M = 1e30f, HALF_TURN = 3.14159274f;

typedef struct limit_entry {
  unsigned axes; /* bits 0 to 2 */
  bool angular, has_min, has_max;
  float min, max, stiffness, damping; /* stiffness 0: hard */
} limit_entry;

typedef struct drive_entry {
  sbf_drive drive; /* the target is not set */
  uint32_t axis;
  bool angular, acceleration;
} drive_entry;

typedef struct joint_maker {
  sbfi_conversion *c;
  const char *name; /* of the joint's node, for messages */
  limit_entry limits[MAX_LIMITS];
  drive_entry drives[MAX_DRIVES];
  uint32_t limit_count, drive_count;
  unsigned locked; /* bits 0 to 5: coordinates locked at 0, by the node's own axes */
  uint32_t first;  /* the node's axis that becomes +X */
  sbf_limit made_limits[2 * MAX_LIMITS];
  sbf_drive made_drives[MAX_DRIVES + 3 * MAX_LIMITS];
  uint32_t made_limit_count, made_drive_count;
} joint_maker;

static uint32_t count_axes(unsigned axes) {
  return (axes & 1) + (axes >> 1 & 1) + (axes >> 2 & 1);
}

static uint32_t lowest_axis(unsigned axes) {
  return axes & 1 ? 0 : axes & 2 ? 1 : 2;
}

/* ---- Reading ---- */

static bool read_axes(const sbfi_physics *p, const sbfi_json *list, unsigned *axes) {
  uint32_t axis;
  *axes = 0;
  bool good = list->type == SBFI_JSON_ARRAY && list->count > 0;
  for (uint32_t i = 0; good && i < list->count; i++) {
    good = sbfi_json_u32(sbfi_json_at(list, i), &axis) && axis < AXES && !(*axes >> axis & 1);
    if (good) *axes |= 1u << axis;
  }
  return good || sbfi_physics_fault(p,
                     "the axes at byte %zu of the JSON must be one to three different numbers from 0 to 2",
                     list->offset);
}

static bool read_limit(const sbfi_physics *p, const sbfi_json *json, limit_entry *limit) {
  const sbfi_json *linear = sbfi_json_get(json, "linearAxes"), *angular = sbfi_json_get(json, "angularAxes");
  if (!linear == !angular)
    return sbfi_physics_fault(p, "the limit at byte %zu of the JSON must have either linear or angular axes",
        json ? json->offset : 0);
  limit->angular = angular != NULL;
  limit->has_min = sbfi_json_get(json, "min") != NULL;
  limit->has_max = sbfi_json_get(json, "max") != NULL;
  float beyond = limit->angular ? HALF_TURN : UNBOUNDED_M;
  if (!read_axes(p, linear ? linear : angular, &limit->axes) ||
      !sbfi_physics_number(p, json, "min", -beyond, &limit->min) ||
      !sbfi_physics_number(p, json, "max", beyond, &limit->max) ||
      !sbfi_physics_number_from(p, json, "stiffness", 0, 0, false, &limit->stiffness) ||
      !sbfi_physics_number_from(p, json, "damping", 0, 0, false, &limit->damping))
    return false;
  return limit->min <= limit->max ||
         sbfi_physics_fault(p,
             "the limit at byte %zu of the JSON has a minimum of %g above its maximum of %g", json->offset,
             (double)limit->min, (double)limit->max);
}

static bool read_drive(sbfi_physics *p, const sbfi_json *json, drive_entry *drive, bool *known) {
  const sbfi_json *type = sbfi_json_get(json, "type"), *mode = sbfi_json_get(json, "mode");
  bool is_linear = sbfi_json_is_string(type, "linear");
  sbf_drive_init(&drive->drive);
  drive->angular = sbfi_json_is_string(type, "angular");
  drive->acceleration = sbfi_json_is_string(mode, "acceleration");
  *known = (is_linear || drive->angular) && (drive->acceleration || sbfi_json_is_string(mode, "force"));
  if (!sbfi_json_u32(sbfi_json_get(json, "axis"), &drive->axis) || drive->axis >= AXES)
    return sbfi_physics_fault(
        p, "the drive at byte %zu of the JSON must have an axis from 0 to 2", json ? json->offset : 0);
  if (!sbfi_physics_number(p, json, "positionTarget", 0, &drive->drive.position) ||
      !sbfi_physics_number(p, json, "velocityTarget", 0, &drive->drive.velocity) ||
      !sbfi_physics_number_from(p, json, "stiffness", 0, 0, false, &drive->drive.stiffness) ||
      !sbfi_physics_number_from(p, json, "damping", 0, 0, false, &drive->drive.damping) ||
      !sbfi_physics_number_from(p, json, "maxForce", 0, 0, false, &drive->drive.maximum))
    return false;
  p->losses[SBFI_LOSS_DRIVE] += !*known;
  /* 0 is no force in the file, and no bound in an asset. */
  if (sbfi_json_get(json, "maxForce") && drive->drive.maximum == 0) *known = false;
  return true;
}

static bool read_description(joint_maker *m, const sbfi_json *json) {
  sbfi_physics *p = m->c->physics;
  const sbfi_json *limits = sbfi_json_get(json, "limits"), *drives = sbfi_json_get(json, "drives");
  m->limit_count = m->drive_count = m->made_limit_count = m->made_drive_count = 0;
  if ((limits && limits->count > MAX_LIMITS) || (drives && drives->count > MAX_DRIVES))
    return sbfi_physics_fault(
        p, "joint '%s' has more than %d limits or %d drives", m->name, MAX_LIMITS, MAX_DRIVES);
  for (uint32_t i = 0; limits && i < limits->count; i++)
    if (!read_limit(p, sbfi_json_at(limits, i), &m->limits[m->limit_count++])) return false;
  for (uint32_t i = 0; drives && i < drives->count; i++) {
    bool known;
    if (!read_drive(p, sbfi_json_at(drives, i), &m->drives[m->drive_count], &known)) return false;
    m->drive_count += known;
  }
  return true;
}

/* ---- Axes ---- */

/* Whether a limit holds its coordinates at 0. Of several axes it bounds a distance, which is at least 0. */
static bool holds(const limit_entry *limit) {
  bool from_zero = count_axes(limit->axes) > 1 ? limit->min <= 0 : limit->min == 0;
  return from_zero && limit->max == 0 && limit->stiffness == 0;
}

static void find_locked(joint_maker *m) {
  m->locked = 0;
  for (uint32_t i = 0; i < m->limit_count; i++)
    if (holds(&m->limits[i])) m->locked |= m->limits[i].axes << (m->limits[i].angular ? AXES : 0);
}

/* The axis that becomes +X: of a cone, of the only rotation that is free, of the only one that is locked, of
 * the only free translation, or of the only locked one. */
static uint32_t find_first(const joint_maker *m) {
  unsigned locked_angles = m->locked >> AXES, locked_lengths = m->locked & 7;
  for (uint32_t i = 0; i < m->limit_count; i++)
    if (m->limits[i].angular && count_axes(m->limits[i].axes) == 2 && !holds(&m->limits[i]))
      return lowest_axis(~m->limits[i].axes & 7);
  if (count_axes(locked_angles) == 2) return lowest_axis(~locked_angles & 7);
  if (count_axes(locked_angles) == 1) return lowest_axis(locked_angles);
  if (count_axes(locked_lengths) == 2) return lowest_axis(~locked_lengths & 7);
  if (count_axes(locked_lengths) == 1) return lowest_axis(locked_lengths);
  unsigned limited = 0;
  for (uint32_t i = 0; i < m->limit_count; i++)
    if (m->limits[i].angular && count_axes(m->limits[i].axes) == 1) limited |= m->limits[i].axes;
  return count_axes(limited) == 1 ? lowest_axis(limited) : 0;
}

static sbf_joint_axis target_of(const joint_maker *m, bool angular, uint32_t axis) {
  return (sbf_joint_axis)((axis + AXES - m->first) % AXES + (angular ? AXES : 0));
}

/* The coordinates that are locked, in the joint's own order. */
static unsigned locked_targets(const joint_maker *m) {
  unsigned locked = 0;
  for (uint32_t k = 0; k < 2 * AXES; k++)
    if (m->locked >> k & 1) locked |= 1u << target_of(m, k >= AXES, k % AXES);
  return locked;
}

/* ---- Making ---- */

static void add_limit(joint_maker *m, sbf_joint_axis target, const limit_entry *from, float min, float max) {
  sbf_limit *limit = &m->made_limits[m->made_limit_count++];
  sbf_limit_init(limit);
  limit->target = target;
  limit->min = min;
  limit->max = max;
  limit->stiffness = from->stiffness;
  limit->damping = from->damping;
}

static void add_spring(joint_maker *m, sbf_joint_axis target, const limit_entry *from) {
  sbf_drive *drive = &m->made_drives[m->made_drive_count++];
  sbf_drive_init(drive);
  drive->target = target;
  drive->position = from->min;
  drive->stiffness = from->stiffness;
  drive->damping = from->damping;
}

static void add_cone(joint_maker *m, const limit_entry *limit) {
  sbfi_physics *p = m->c->physics;
  if (lowest_axis(~limit->axes & 7) != m->first) {
    p->losses[SBFI_LOSS_CONES]++;
    return;
  }
  p->losses[SBFI_LOSS_CONE_MIN] += limit->min > 0;
  if (limit->has_max) add_limit(m, SBF_JOINT_AXIS_SWING, limit, 0, limit->max);
}

static void make_limit(joint_maker *m, const limit_entry *limit) {
  sbfi_physics *p = m->c->physics;
  uint32_t count = count_axes(limit->axes);
  if (holds(limit)) return;
  if (limit->min == limit->max || (count > 1 && limit->max == 0 && limit->min <= 0)) {
    /* A soft limit without play is a spring; a hard one of one axis holds it at a value. */
    bool at_zero = limit->max == 0;
    if (limit->stiffness > 0 && (count == 1 || at_zero)) {
      limit_entry spring = *limit;
      spring.min = limit->max;
      for (uint32_t k = 0; k < AXES; k++)
        if (limit->axes >> k & 1) add_spring(m, target_of(m, limit->angular, k), &spring);
      return;
    }
  }
  if (!limit->has_min && !limit->has_max) return;
  if (count == 1) {
    if (!limit->angular || limit->min > -HALF_TURN || limit->max < HALF_TURN)
      add_limit(m, target_of(m, limit->angular, lowest_axis(limit->axes)), limit, limit->min, limit->max);
  } else if (limit->angular && count == 2) {
    add_cone(m, limit);
  } else if (limit->angular) {
    p->losses[SBFI_LOSS_ROTATION]++;
    add_limit(m, SBF_JOINT_AXIS_SWING, limit, 0, limit->max);
    add_limit(m, SBF_JOINT_AXIS_TWIST, limit, -limit->max, limit->max);
  } else if (count == 2) {
    p->losses[SBFI_LOSS_TUBE]++;
    for (uint32_t k = 0; k < AXES; k++)
      if (limit->axes >> k & 1) add_limit(m, target_of(m, false, k), limit, -limit->max, limit->max);
  } else {
    add_limit(m, SBF_JOINT_AXIS_DISTANCE, limit, limit->min > 0 ? limit->min : 0, limit->max);
  }
}

static void make_drive(joint_maker *m, const drive_entry *from, const sbf_joint *joint) {
  sbf_drive *drive = &m->made_drives[m->made_drive_count++];
  *drive = from->drive;
  drive->target = target_of(m, from->angular, from->axis);
  if (!from->acceleration) return;
  float mass = (float)sbfi_physics_effective_mass(m->c->asset, joint, locked_targets(m), drive->target);
  drive->stiffness *= mass;
  drive->damping *= mass;
  m->c->physics->losses[SBFI_LOSS_ACCELERATION]++;
}

static sbf_joint_kind find_kind(joint_maker *m) {
  unsigned locked = locked_targets(m);
  if (!locked && !m->made_drive_count && m->made_limit_count == 1 &&
      m->made_limits[0].target == SBF_JOINT_AXIS_DISTANCE)
    return SBF_JOINT_KIND_DISTANCE;
  for (int kind = 0; kind < SBF_JOINT_KIND_COUNT; kind++) {
    bool other = kind == SBF_JOINT_KIND_DISTANCE || kind == SBF_JOINT_KIND_PULLEY;
    if (!other && sbfi_joint_is_locked((sbf_joint_kind)kind) == locked) return (sbf_joint_kind)kind;
  }
  return SBF_JOINT_KIND_SIX_DOF;
}

/* A generic joint holds a coordinate by a limit without play. */
static void hold_by_limits(joint_maker *m) {
  const limit_entry hard = {0};
  for (uint32_t k = 0; k < 2 * AXES; k++)
    if (locked_targets(m) >> k & 1) add_limit(m, (sbf_joint_axis)k, &hard, 0, 0);
}

static void count_angles(joint_maker *m) {
  uint32_t count = 0;
  for (uint32_t i = 0; i < m->made_limit_count; i++) {
    const sbf_limit *limit = &m->made_limits[i];
    count += limit->target >= SBF_JOINT_AXIS_TWIST && limit->target <= SBF_JOINT_AXIS_SWING_Z &&
             limit->min < limit->max;
  }
  m->c->physics->losses[SBFI_LOSS_SEVERAL_ANGLES] += count > 1;
}

/* The attachment frame of a node in a body, its axes exchanged. */
static sbf_frame frame_of(const joint_maker *m, uint32_t node, int32_t body) {
  static const double exchanges[AXES][4] = {{0, 0, 0, 1}, {0.5, 0.5, 0.5, 0.5}, {-0.5, -0.5, -0.5, 0.5}};
  const sbfi_matrix world = sbfi_physics_world(m->c, node);
  const sbfi_trs trs = sbfi_trs_decompose(&world);
  sbf_vec3 from = {0, 0, 0};
  double q[4];
  if (body != SBF_NONE) from = m->c->asset->rigid_bodies.at[body].center;
  sbfi_quatd_multiply(trs.rotation, exchanges[m->first], q);
  return (sbf_frame){{(float)(trs.position[0] - (double)from.x), (float)(trs.position[1] - (double)from.y),
                         (float)(trs.position[2] - (double)from.z)},
      {(float)q[0], (float)q[1], (float)q[2], (float)q[3]}};
}

/* The body that a node belongs to: of the motion at or above it, or of a static collider there. */
static int32_t body_of(const sbfi_physics *p, uint32_t node) {
  int32_t up = p->nodes[node].moving_node;
  if (up != SBF_NONE) return p->nodes[up].body;
  for (up = (int32_t)node; up != SBF_NONE && p->nodes[up].body == SBF_NONE;) up = p->nodes[up].parent;
  return up == SBF_NONE ? SBF_NONE : p->nodes[up].body;
}

/* Whether the coordinates that are locked, limited or driven only change their signs where the two sides are
 * exchanged: of positions without rotation, and of rotations about a common origin without single swings. */
static bool may_exchange(const joint_maker *m) {
  unsigned locked = locked_targets(m), lengths = locked & 7, angles = locked >> AXES;
  bool swings = (angles & 6) == 2 || (angles & 6) == 4; /* one is locked */
  for (uint32_t i = 0; i < m->limit_count; i++) {
    const limit_entry *limit = &m->limits[i];
    bool single = limit->angular && count_axes(limit->axes) == 1 && !holds(limit);
    swings |= single && lowest_axis(limit->axes) != m->first;
  }
  for (uint32_t i = 0; i < m->drive_count; i++)
    swings |= m->drives[i].angular && m->drives[i].axis != m->first;
  return angles == 7 || (lengths == 7 && !swings);
}

static void exchange(joint_maker *m, sbf_joint *joint) {
  sbf_frame frame = joint->frame_a;
  joint->frame_a = joint->frame_b;
  joint->frame_b = frame;
  joint->body_b = joint->body_a;
  joint->body_a = SBF_NONE;
  for (uint32_t i = 0; i < m->made_limit_count; i++) {
    sbf_limit *limit = &m->made_limits[i];
    if (limit->target > SBF_JOINT_AXIS_SWING_Z) continue;
    float min = limit->min;
    limit->min = -limit->max, limit->max = -min;
  }
  for (uint32_t i = 0; i < m->made_drive_count; i++) {
    m->made_drives[i].position = -m->made_drives[i].position;
    m->made_drives[i].velocity = -m->made_drives[i].velocity;
  }
}

/* A kinematic body that stands for the world as the second side of joints. */
static int32_t world_body(sbfi_conversion *c) {
  const sbf_rigid_body_list list = c->asset->rigid_bodies;
  sbf_rigid_body *bodies = (sbf_rigid_body *)(uintptr_t)list.at; /* one more than the nodes was allocated */
  for (uint32_t i = 0; i < list.count; i++)
    if (bodies[i].bone == SBF_NONE && strcmp(bodies[i].name, "World") == 0 && !bodies[i].hull)
      return (int32_t)i;
  sbf_rigid_body *body = &bodies[list.count];
  sbf_rigid_body_init(body);
  body->name = "World";
  body->id = sbfi_new_id(c, "rigid", body->name);
  body->mass = 1;
  body->layer = body->mask = 0;
  if (!body->id) return SBF_NONE;
  c->asset->rigid_bodies.count++;
  return (int32_t)list.count;
}

static bool copy_lists(joint_maker *m, sbf_joint *joint) {
  sbf_limit *limits = sbfi_convert_allocate(m->c, m->made_limit_count, sizeof *limits);
  sbf_drive *drives = sbfi_convert_allocate(m->c, m->made_drive_count, sizeof *drives);
  if ((m->made_limit_count && !limits) || (m->made_drive_count && !drives)) return false;
  for (uint32_t i = 0; i < m->made_limit_count; i++) limits[i] = m->made_limits[i];
  for (uint32_t i = 0; i < m->made_drive_count; i++) drives[i] = m->made_drives[i];
  joint->limits = (sbf_limit_list){limits, m->made_limit_count};
  joint->drives = (sbf_drive_list){drives, m->made_drive_count};
  return true;
}

static bool name_joint(joint_maker *m, sbf_joint *joint) {
  const sbf_rigid_body_list bodies = m->c->asset->rigid_bodies;
  char name[160];
  snprintf(name, sizeof name, "%.70s to %.70s",
      joint->body_a == SBF_NONE ? "World" : bodies.at[joint->body_a].name, bodies.at[joint->body_b].name);
  size_t length = sbfi_utf8_check(name, strlen(name));
  name[length] = 0;
  joint->name = sbf_asset_copy_text(m->c->asset, name);
  joint->id = sbfi_new_id(m->c, "joint", name);
  return joint->name && joint->id;
}

static bool fill_joint(joint_maker *m, uint32_t node, uint32_t other, sbf_joint *joint) {
  sbfi_physics *p = m->c->physics;
  joint->body_a = body_of(p, node);
  joint->body_b = body_of(p, other);
  bool to_world = joint->body_b == SBF_NONE, exchanges = to_world && may_exchange(m);
  if (to_world && !exchanges && (joint->body_b = world_body(m->c)) == SBF_NONE) return false;
  joint->frame_a = frame_of(m, node, joint->body_a);
  joint->frame_b = frame_of(m, other, joint->body_b);
  for (uint32_t i = 0; i < m->limit_count; i++) make_limit(m, &m->limits[i]);
  count_angles(m);
  joint->kind = find_kind(m);
  if (joint->kind == SBF_JOINT_KIND_SIX_DOF) hold_by_limits(m);
  if (exchanges) exchange(m, joint);
  uint32_t springs = m->made_drive_count;
  for (uint32_t i = 0; i < m->drive_count; i++) {
    make_drive(m, &m->drives[i], joint);
    sbf_drive *drive = &m->made_drives[springs + i];
    if (exchanges) drive->position = -drive->position, drive->velocity = -drive->velocity;
  }
  return name_joint(m, joint) && copy_lists(m, joint);
}

/* Makes the joint of a node; `*made` is false if it joins nothing that moves. */
static bool make_joint(joint_maker *m, uint32_t node, sbf_joint *joint, bool *made) {
  sbfi_physics *p = m->c->physics;
  const sbfi_json *json = sbfi_json_get(p->nodes[node].physics, "joint");
  int32_t other, description;
  *made = false;
  m->name = m->c->scene->nodes[p->nodes[node].scene_node].name;
  sbf_joint_init(joint);
  if (!sbfi_physics_index(p, json, "connectedNode", p->node_count, &other) ||
      !sbfi_physics_index(p, json, "joint", p->joints ? p->joints->count : 0, &description) ||
      !sbfi_physics_flag(p, json, "enableCollision", &joint->collide))
    return false;
  if (other == SBF_NONE || description == SBF_NONE)
    return sbfi_physics_fault(
        p, "the joint of node %u ('%s') must name a connected node and a joint", node, m->name);
  if (!read_description(m, sbfi_json_at(p->joints, (uint32_t)description))) return false;
  int32_t a = body_of(p, node), b = body_of(p, (uint32_t)other);
  if (p->nodes[node].moving_node == SBF_NONE && p->nodes[other].moving_node == SBF_NONE) {
    p->losses[SBFI_LOSS_STATIC_JOINT]++;
    return true;
  }
  if (a == b)
    return sbfi_physics_fault(p, "the joint of node %u ('%s') connects the body '%s' with itself", node,
        m->name, m->c->asset->rigid_bodies.at[a].name);
  find_locked(m);
  m->first = find_first(m);
  *made = true;
  return fill_joint(m, node, (uint32_t)other, joint) || sbfi_convert_no_memory(m->c) == SBF_OK;
}

bool sbfi_physics_convert_joints(sbfi_conversion *c) {
  const sbfi_physics *p = c->physics;
  joint_maker *m = sbfi_arena_allocate(&c->scratch, 1, sizeof *m);
  sbf_joint *joints = sbfi_convert_allocate(c, (size_t)p->node_count + 1, sizeof *joints);
  uint32_t count = 0;
  if (!m || !joints) return sbfi_convert_no_memory(c) == SBF_OK;
  m->c = c;
  for (uint32_t i = 0; i < p->node_count; i++) {
    bool made;
    if (!sbfi_json_get(p->nodes[i].physics, "joint") || p->nodes[i].scene_node == SBF_NONE) continue;
    if (!make_joint(m, i, &joints[count], &made)) return false;
    count += made;
  }
  c->asset->joints = (sbf_joint_list){count ? joints : NULL, count};
  return true;
}
