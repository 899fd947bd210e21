/* Writes motions, colliders and attachment frames as nodes. */
#include <math.h>

#include "export/glb_rigid.h"
#include "sbfmt/mechanics.h"

static const char RIGID_BODIES[] = "KHR_physics_rigid_bodies", SHAPES[] = "KHR_implicit_shapes";

bool sbfi_glb_has_rigid(const sbfi_glb *g) {
  return g->e->asset->rigid_bodies.count > 0 && !g->e->motion;
}

/* ---- Materials and filters ---- */

static bool has_hull(const sbf_rigid_body *body) {
  return body->hull && body->hull->polygon_sizes.count > 0;
}

static bool equals_material(const sbf_rigid_body *a, const sbf_rigid_body *b) {
  return a->friction == b->friction && a->restitution == b->restitution;
}

static bool equals_filter(const sbf_rigid_body *a, const sbf_rigid_body *b) {
  return a->layer == b->layer && a->mask == b->mask;
}

static void write_material(sbfi_glb_rigid *r, const sbf_rigid_body *body) {
  sbfi_text *text = &r->materials;
  sbfi_text_string(text, r->material_count++ ? ",{\"staticFriction\":" : "{\"staticFriction\":");
  sbfi_text_f32(text, body->friction);
  sbfi_text_string(text, ",\"dynamicFriction\":");
  sbfi_text_f32(text, body->friction);
  sbfi_text_string(text, ",\"restitution\":");
  sbfi_text_f32(text, body->restitution);
  sbfi_text_char(text, '}');
}

static void write_filter(sbfi_glb_rigid *r, const sbf_rigid_body *body, uint32_t used_layers) {
  sbfi_text *text = &r->filters;
  uint32_t not_with = used_layers & ~body->mask;
  sbfi_text_string(text, r->filter_count++ ? ",{" : "{");
  sbfi_export_bits(text, "collisionSystems", body->layer, "\"layer ", "\"");
  if (not_with) {
    sbfi_text_char(text, ',');
    sbfi_export_bits(text, "notCollideWithSystems", not_with, "\"layer ", "\"");
  }
  sbfi_text_char(text, '}');
}

/* Equal materials and filters are shared. */
static void choose_shared(sbfi_glb *g, uint32_t i, uint32_t used_layers) {
  const sbf_rigid_body *all = g->e->asset->rigid_bodies.at, *body = &all[i];
  sbfi_glb_rigid *r = g->rigid;
  sbfi_glb_rigid_body *to = &r->bodies[i];
  to->material = to->filter = SBF_NONE;
  if (!has_hull(body)) return;
  bool filtered = body->layer != 1 || (used_layers & ~body->mask) != 0;
  for (uint32_t k = 0; k < i; k++) {
    if (r->bodies[k].material >= 0 && equals_material(body, &all[k])) to->material = r->bodies[k].material;
    if (filtered && r->bodies[k].filter >= 0 && equals_filter(body, &all[k]))
      to->filter = r->bodies[k].filter;
  }
  if (to->material == SBF_NONE) {
    to->material = (int32_t)r->material_count;
    write_material(r, body);
  }
  if (filtered && to->filter == SBF_NONE) {
    to->filter = (int32_t)r->filter_count;
    write_filter(r, body, used_layers);
  }
}

/* ---- Plan ---- */

static void write_box_shape(sbfi_glb_rigid *r, const sbfi_glb_box *box) {
  if (r->shape_count++) sbfi_text_char(&r->shapes, ',');
  sbfi_text_string(&r->shapes, "{\"type\":\"box\",\"box\":{\"size\":");
  sbfi_glb_write_numbers(&r->shapes, box->size, 3);
  sbfi_text_string(&r->shapes, "}}");
}

static void plan_body(sbfi_glb *g, uint32_t i, const bool *bone_used, uint32_t *node) {
  const sbf_rigid_body *body = &g->e->asset->rigid_bodies.at[i];
  sbfi_glb_rigid_body *to = &g->rigid->bodies[i];
  to->own_node = body->bone < 0 || bone_used[body->bone];
  to->is_static = body->bone < 0 && body->motion == SBF_BODY_MOTION_KINEMATIC;
  to->node = to->own_node ? (*node)++ : (uint32_t)body->bone;
  to->transform = to->own_node ? (sbfi_glb_transform){body->center, {0, 0, 0, 1}}
                               : sbfi_glb_rest(g->e->asset, (uint32_t)body->bone);
  to->shape = SBF_NONE;
  if (!has_hull(body) || !sbfi_glb_find_box(body->hull, &to->box)) return;
  to->shape = (int32_t)g->rigid->shape_count;
  write_box_shape(g->rigid, &to->box);
  if (to->is_static) to->transform = to->box.transform;
}

void sbfi_glb_plan_rigid(sbfi_glb *g, uint32_t first_node) {
  const sbf_asset *asset = g->e->asset;
  uint32_t node = first_node, layers = 0;
  if (!sbfi_glb_has_rigid(g)) return;
  sbfi_glb_rigid *r = g->rigid = sbfi_glb_allocate(g, 1, sizeof *r);
  if (!r) return;
  sbfi_text_init(&r->materials, &g->e->allocator);
  sbfi_text_init(&r->filters, &g->e->allocator);
  sbfi_text_init(&r->joints, &g->e->allocator);
  sbfi_text_init(&r->shapes, &g->e->allocator);
  r->bodies = sbfi_glb_allocate(g, asset->rigid_bodies.count, sizeof *r->bodies);
  r->joint_nodes = sbfi_glb_allocate(g, (size_t)asset->joints.count + 1, sizeof *r->joint_nodes);
  bool *bone_used = sbfi_glb_allocate(g, (size_t)asset->bones.count + 1, sizeof *bone_used);
  if (g->failed) return;
  for (uint32_t i = 0; i < asset->rigid_bodies.count; i++) {
    const sbf_rigid_body *body = &asset->rigid_bodies.at[i];
    plan_body(g, i, bone_used, &node);
    if (body->bone >= 0) bone_used[body->bone] = true;
    layers |= body->layer;
  }
  for (uint32_t i = 0; i < asset->rigid_bodies.count; i++) {
    bool is_own = r->bodies[i].is_static && r->bodies[i].shape != SBF_NONE;
    r->bodies[i].hull_node = has_hull(&asset->rigid_bodies.at[i]) && !is_own ? node++ : UINT32_MAX;
    choose_shared(g, i, layers);
  }
  for (uint32_t i = 0; i < asset->joints.count; i++) {
    bool is_pulley = asset->joints.at[i].kind == SBF_JOINT_KIND_PULLEY;
    r->losses[SBFI_RIGID_PULLEYS] += is_pulley;
    r->joint_nodes[i] = is_pulley ? UINT32_MAX : node;
    node += is_pulley ? 0 : 2;
  }
}

void sbfi_glb_free_rigid(sbfi_glb *g) {
  if (!g->rigid) return;
  sbfi_text_free(&g->rigid->materials);
  sbfi_text_free(&g->rigid->filters);
  sbfi_text_free(&g->rigid->joints);
  sbfi_text_free(&g->rigid->shapes);
}

/* ---- Parts of nodes ---- */

static void add_child(sbfi_text *text, uint32_t child, bool *first) {
  sbfi_export_print(text, "%s%u", *first ? ",\"children\":[" : ",", child);
  *first = false;
}

/* Attachment frames below the node of a body; SBF_NONE: of the world, a node each. */
static void add_frames(const sbfi_glb *g, int32_t body, sbfi_text *text, bool *first,
    void (*add)(sbfi_text *text, uint32_t child, bool *first)) {
  const sbf_joint_list joints = g->e->asset->joints;
  for (uint32_t i = 0; i < joints.count; i++) {
    if (g->rigid->joint_nodes[i] == UINT32_MAX) continue;
    if (joints.at[i].body_a == body) add(text, g->rigid->joint_nodes[i], first);
    if (joints.at[i].body_b == body) add(text, g->rigid->joint_nodes[i] + 1, first);
  }
}

/* Whether a node below the body's has its collider. */
static bool has_box_node(const sbfi_glb_rigid_body *body) {
  return body->shape != SBF_NONE && body->hull_node != UINT32_MAX;
}

void sbfi_glb_add_rigid_children(sbfi_glb *g, int32_t bone, sbfi_text *text, bool *first) {
  if (!g->rigid) return;
  for (uint32_t i = 0; i < g->e->asset->rigid_bodies.count; i++) {
    const sbfi_glb_rigid_body *body = &g->rigid->bodies[i];
    if (g->e->asset->rigid_bodies.at[i].bone != bone) continue;
    if (body->own_node) {
      add_child(text, body->node, first);
    } else {
      if (has_box_node(body)) add_child(text, body->hull_node, first);
      add_frames(g, (int32_t)i, text, first, add_child);
    }
  }
}

static void write_vec3(sbfi_text *text, const char *name, const float v[3]) {
  sbfi_export_print(text, ",\"%s\":", name);
  sbfi_glb_write_numbers(text, v, 3);
}

/* Velocities are in the node's space. */
static void write_velocity(
    const sbfi_glb *g, uint32_t i, const char *name, sbf_vec3 velocity, sbfi_text *text) {
  const sbf_quat rotation = g->rigid->bodies[i].transform.rotation;
  const sbfi_glb_transform space = {{0, 0, 0}, rotation};
  float local[3], unused[4];
  if (velocity.x == 0 && velocity.y == 0 && velocity.z == 0) return;
  sbfi_glb_compute_local((sbfi_glb_transform){velocity, rotation}, &space, local, unused);
  write_vec3(text, name, local);
}

static void write_motion(const sbfi_glb *g, uint32_t i, sbfi_text *text) {
  const sbf_rigid_body *body = &g->e->asset->rigid_bodies.at[i];
  sbf_rigid_measures is;
  float at[3], rotation[4];
  sbf_rigid_body_measure(body, &is);
  sbfi_glb_compute_local(
      (sbfi_glb_transform){is.center, is.inertia_rotation}, &g->rigid->bodies[i].transform, at, rotation);
  sbfi_export_print(
      text, "\"motion\":{\"isKinematic\":%s", body->motion == SBF_BODY_MOTION_KINEMATIC ? "true" : "false");
  if (is.mass > 0) {
    sbfi_text_string(text, ",\"mass\":");
    sbfi_text_f32(text, (float)is.mass);
  }
  write_vec3(text, "centerOfMass", at);
  if (is.inertia.x > 0 && is.inertia.y > 0 && is.inertia.z > 0) {
    const float moments[3] = {is.inertia.x, is.inertia.y, is.inertia.z};
    write_vec3(text, "inertiaDiagonal", moments);
    sbfi_text_string(text, ",\"inertiaOrientation\":");
    sbfi_glb_write_numbers(text, rotation, 4);
  }
  write_velocity(g, i, "linearVelocity", body->velocity, text);
  write_velocity(g, i, "angularVelocity", body->angular_velocity, text);
  if (body->gravity_scale != 1) {
    sbfi_text_string(text, ",\"gravityFactor\":");
    sbfi_text_f32(text, body->gravity_scale);
  }
  sbfi_text_char(text, '}');
}

static void write_collider(const sbfi_glb_rigid_body *body, sbfi_text *text) {
  if (body->shape != SBF_NONE)
    sbfi_export_print(text, "\"collider\":{\"geometry\":{\"shape\":%d}", (int)body->shape);
  else
    sbfi_export_print(text, "\"collider\":{\"geometry\":{\"node\":%u,\"convexHull\":true}", body->hull_node);
  sbfi_export_print(text, ",\"physicsMaterial\":%d", (int)body->material);
  if (body->filter >= 0) sbfi_export_print(text, ",\"collisionFilter\":%d", (int)body->filter);
  sbfi_text_char(text, '}');
}

static void write_extension(const sbfi_glb *g, uint32_t i, sbfi_text *text) {
  const sbfi_glb_rigid_body *body = &g->rigid->bodies[i];
  bool has_collider = has_hull(&g->e->asset->rigid_bodies.at[i]) && !has_box_node(body);
  if (body->is_static && !has_collider) return;
  sbfi_export_print(text, ",\"extensions\":{\"%s\":{", RIGID_BODIES);
  if (!body->is_static) write_motion(g, i, text);
  if (has_collider) {
    if (!body->is_static) sbfi_text_char(text, ',');
    write_collider(body, text);
  }
  sbfi_text_string(text, "}}");
}

void sbfi_glb_write_bone_physics(sbfi_glb *g, uint32_t bone, sbfi_text *text) {
  for (uint32_t i = 0; g->rigid && i < g->e->asset->rigid_bodies.count; i++)
    if (!g->rigid->bodies[i].own_node && g->rigid->bodies[i].node == bone) write_extension(g, i, text);
}

static void write_local(sbfi_text *text, sbfi_glb_transform own, const sbfi_glb_transform *parent) {
  float translation[3], rotation[4];
  sbfi_glb_compute_local(own, parent, translation, rotation);
  write_vec3(text, "translation", translation);
  sbfi_text_string(text, ",\"rotation\":");
  sbfi_glb_write_numbers(text, rotation, 4);
}

/* ---- Nodes ---- */

static void write_own_node(sbfi_glb *g, uint32_t i) {
  const sbf_rigid_body *body = &g->e->asset->rigid_bodies.at[i];
  const sbfi_glb_rigid_body *is = &g->rigid->bodies[i];
  sbfi_text *text = sbfi_glb_item(g, SBFI_GLB_NODES, NULL);
  sbfi_glb_transform parent = {0};
  bool first = true;
  if (body->bone >= 0) parent = sbfi_glb_rest(g->e->asset, (uint32_t)body->bone);
  sbfi_text_string(text, "{\"name\":");
  sbfi_glb_write_string(text, *body->name ? body->name : body->id);
  write_local(text, is->transform, body->bone >= 0 ? &parent : NULL);
  if (has_box_node(is)) add_child(text, is->hull_node, &first);
  add_frames(g, (int32_t)i, text, &first, add_child);
  if (!first) sbfi_text_char(text, ']');
  write_extension(g, i, text);
  sbfi_text_char(text, '}');
}

/* The hull in the space of its body's node, as triangles. */
static uint32_t write_hull_mesh(sbfi_glb *g, uint32_t i) {
  const sbf_polygon_mesh *hull = g->e->asset->rigid_bodies.at[i].hull;
  uint32_t count = hull->positions.count, triangles = 0, number = 0;
  for (uint32_t p = 0; p < hull->polygon_sizes.count; p++) triangles += hull->polygon_sizes.at[p] - 2;
  sbf_vec3 *points = sbfi_glb_allocate(g, count, sizeof *points);
  uint32_t *corners = sbfi_glb_allocate(g, (size_t)3 * triangles, sizeof *corners);
  if (g->failed) return 0;
  for (uint32_t k = 0; k < count; k++) {
    float at[3], rotation[4];
    sbfi_glb_compute_local((sbfi_glb_transform){hull->positions.at[k], {0, 0, 0, 1}},
        &g->rigid->bodies[i].transform, at, rotation);
    points[k] = (sbf_vec3){at[0], at[1], at[2]};
  }
  uint32_t to = 0;
  for (uint32_t p = 0, at = 0; p < hull->polygon_sizes.count; at += hull->polygon_sizes.at[p++])
    for (uint32_t k = 2; k < hull->polygon_sizes.at[p]; k++) {
      corners[to++] = hull->polygon_points.at[at];
      corners[to++] = hull->polygon_points.at[at + k - 1];
      corners[to++] = hull->polygon_points.at[at + k];
    }
  uint32_t positions = sbfi_glb_accessor(g, points, count, SBFI_GLB_VEC3, SBFI_GLB_VERTICES);
  uint32_t indices = sbfi_glb_accessor(g, corners, to, SBFI_GLB_UINT, SBFI_GLB_INDICES);
  sbfi_text *text = sbfi_glb_item(g, SBFI_GLB_MESHES, &number);
  sbfi_export_print(
      text, "{\"primitives\":[{\"attributes\":{\"POSITION\":%u},\"indices\":%u}]}", positions, indices);
  return number;
}

static void write_box_node(sbfi_glb *g, uint32_t i) {
  const sbfi_glb_rigid_body *body = &g->rigid->bodies[i];
  sbfi_text *text = sbfi_glb_item(g, SBFI_GLB_NODES, NULL);
  sbfi_text_string(text, "{\"name\":\"box\"");
  write_local(text, body->box.transform, &body->transform);
  sbfi_export_print(text, ",\"extensions\":{\"%s\":{", RIGID_BODIES);
  write_collider(body, text);
  sbfi_text_string(text, "}}}");
}

static void write_hull_node(sbfi_glb *g, uint32_t i) {
  if (g->rigid->bodies[i].shape != SBF_NONE) {
    write_box_node(g, i);
    return;
  }
  uint32_t mesh = write_hull_mesh(g, i);
  sbfi_text *text = sbfi_glb_item(g, SBFI_GLB_NODES, NULL);
  sbfi_export_print(text, "{\"name\":\"hull\",\"mesh\":%u}", mesh);
}

static void write_frame_node(sbfi_glb *g, uint32_t i, int side) {
  const sbf_asset *asset = g->e->asset;
  const sbf_joint *joint = &asset->joints.at[i];
  const sbf_frame *frame = side ? &joint->frame_b : &joint->frame_a;
  int32_t body = side ? joint->body_b : joint->body_a;
  sbfi_glb_transform at = {frame->position, frame->rotation};
  if (body >= 0) {
    const sbf_vec3 from = asset->rigid_bodies.at[body].center;
    at.position = (sbf_vec3){from.x + at.position.x, from.y + at.position.y, from.z + at.position.z};
  }
  sbfi_text *text = sbfi_glb_item(g, SBFI_GLB_NODES, NULL);
  sbfi_text_string(text, "{\"name\":");
  sbfi_glb_write_string(text, *joint->name ? joint->name : joint->id);
  write_local(text, at, body >= 0 ? &g->rigid->bodies[body].transform : NULL);
  if (side == 0)
    sbfi_export_print(text,
        ",\"extensions\":{\"%s\":{\"joint\":{\"connectedNode\":%u,\"joint\":%u,\"enableCollision\":%s}}}",
        RIGID_BODIES, g->rigid->joint_nodes[i] + 1, g->rigid->joint_count - 1,
        joint->collide ? "true" : "false");
  sbfi_text_char(text, '}');
}

void sbfi_glb_write_rigid_nodes(sbfi_glb *g) {
  const sbf_asset *asset = g->e->asset;
  for (uint32_t i = 0; g->rigid && i < asset->rigid_bodies.count && !g->failed; i++)
    if (g->rigid->bodies[i].own_node) write_own_node(g, i);
  for (uint32_t i = 0; g->rigid && i < asset->rigid_bodies.count && !g->failed; i++)
    if (g->rigid->bodies[i].hull_node != UINT32_MAX) write_hull_node(g, i);
  for (uint32_t i = 0; g->rigid && i < asset->joints.count && !g->failed; i++) {
    if (g->rigid->joint_nodes[i] == UINT32_MAX) continue;
    sbfi_glb_write_rigid_joint(g, &asset->joints.at[i]);
    write_frame_node(g, i, 0);
    write_frame_node(g, i, 1);
  }
}

/* ---- Document ---- */

static void add_top(sbfi_text *text, uint32_t node, bool *first) {
  sbfi_export_print(text, "%s%u", *first ? "" : ",", node);
  *first = false;
}

void sbfi_glb_write_rigid_tops(const sbfi_glb *g, sbfi_text *json, bool *first) {
  for (uint32_t i = 0; g->rigid && i < g->e->asset->rigid_bodies.count; i++)
    if (g->rigid->bodies[i].own_node && g->e->asset->rigid_bodies.at[i].bone < 0)
      add_top(json, g->rigid->bodies[i].node, first);
  if (g->rigid) add_frames(g, SBF_NONE, json, first, add_top);
}

static void write_list(sbfi_text *json, const char *name, const sbfi_text *items, bool *first) {
  if (!items->length) return;
  sbfi_export_print(json, "%s\"%s\":[", *first ? "" : ",", name);
  sbfi_text_append(json, items->at, items->length);
  sbfi_text_char(json, ']');
  *first = false;
}

void sbfi_glb_write_rigid_document(const sbfi_glb *g, sbfi_text *json, bool first) {
  bool first_list = true;
  if (!g->rigid) return;
  sbfi_export_print(json, "%s\"%s\":{", first ? "" : ",", RIGID_BODIES);
  write_list(json, "physicsMaterials", &g->rigid->materials, &first_list);
  write_list(json, "collisionFilters", &g->rigid->filters, &first_list);
  write_list(json, "physicsJoints", &g->rigid->joints, &first_list);
  sbfi_text_char(json, '}');
  if (!g->rigid->shape_count) return;
  first_list = true;
  sbfi_export_print(json, ",\"%s\":{", SHAPES);
  write_list(json, "shapes", &g->rigid->shapes, &first_list);
  sbfi_text_char(json, '}');
}
