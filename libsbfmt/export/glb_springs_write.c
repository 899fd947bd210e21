/* Writes the extensions VRMC_springBone 1.0 and VRMC_springBone_extended_collider 1.0. */
#include <math.h>
#include <string.h>

#include "export/glb_springs.h"
#include "motion/quatd.h"

/* Stand-ins for viewers without extended colliders, as that extension recommends them. */
static const float FAR_M = 10000, LARGE_M = 1000;

void sbfi_glb_add_end_child(const sbfi_glb *g, uint32_t bone, sbfi_text *text, bool *first) {
  for (uint32_t i = 0; g->springs && i < g->springs->count; i++) {
    const sbfi_glb_spring *s = &g->springs->at[i];
    if (s->end_bone != SBF_NONE || s->joints[s->joint_count - 1].bone != bone) continue;
    sbfi_export_print(text, "%s%u", *first ? ",\"children\":[" : ",", s->end_node);
    *first = false;
  }
}

static bool is_bone_name(const sbf_asset *a, const char *name) {
  for (uint32_t i = 0; i < a->bones.count; i++)
    if (strcmp(*a->bones.at[i].name ? a->bones.at[i].name : a->bones.at[i].id, name) == 0) return true;
  return false;
}

void sbfi_glb_write_end_nodes(sbfi_glb *g) {
  for (uint32_t i = 0; g->springs && i < g->springs->count; i++) {
    const sbfi_glb_spring *s = &g->springs->at[i];
    if (s->end_bone != SBF_NONE) continue;
    const sbf_bone *bone = &g->e->asset->bones.at[s->joints[s->joint_count - 1].bone];
    sbfi_text name, *text = sbfi_glb_item(g, SBFI_GLB_NODES, NULL);
    const float end[3] = {s->end.x, s->end.y, s->end.z};
    sbfi_text_init(&name, &g->e->allocator);
    sbfi_text_string(&name, *bone->name ? bone->name : bone->id);
    do { /* names of joints are unique for some readers */
      sbfi_text_append(&name, "_end", sizeof "_end");
      if (!name.failed) name.length--; /* the NUL stays */
    } while (!name.failed && is_bone_name(g->e->asset, name.at));
    sbfi_text_string(text, "{\"name\":");
    sbfi_glb_write_string(text, name.failed ? "" : name.at);
    sbfi_text_string(text, ",\"translation\":");
    sbfi_glb_write_numbers(text, end, 3);
    sbfi_text_char(text, '}');
    g->failed = g->failed || name.failed;
    sbfi_text_free(&name);
  }
}

static void write_vector(sbfi_text *text, const char *name, sbf_vec3 v) {
  const float at[3] = {v.x, v.y, v.z};
  sbfi_export_print(text, ",\"%s\":", name);
  sbfi_glb_write_numbers(text, at, 3);
}

static void write_number(sbfi_text *text, const char *name, float value) {
  sbfi_export_print(text, ",\"%s\":", name);
  sbfi_text_f32(text, value);
}

/* Shape in the axes of its bone's node. */
typedef struct local_shape {
  sbf_vec3 position, end, normal;
} local_shape;

static sbf_vec3 rotated(const sbf_bone *bone, double x, double y, double z) {
  const double back[4] = {-(double)bone->rotation.x, -(double)bone->rotation.y, -(double)bone->rotation.z,
      (double)bone->rotation.w};
  const double from[3] = {x, y, z};
  double to[3];
  sbfi_quatd_rotate(back, from, to);
  return (sbf_vec3){(float)to[0], (float)to[1], (float)to[2]};
}

static sbf_vec3 from_head(const sbf_bone *bone, sbf_vec3 p) {
  return rotated(bone, (double)p.x - (double)bone->head.x, (double)p.y - (double)bone->head.y,
      (double)p.z - (double)bone->head.z);
}

static local_shape shape_in_bone(const sbf_asset *a, const sbf_chain_collider *c) {
  const sbf_bone *bone = &a->bones.at[c->bone];
  double x = (double)c->normal.x, y = (double)c->normal.y, z = (double)c->normal.z;
  double length = sqrt(x * x + y * y + z * z), scale = length > 0 ? 1 / length : 1;
  return (local_shape){from_head(bone, c->position), from_head(bone, c->end),
      rotated(bone, scale * x, length > 0 ? scale * y : 1, scale * z)};
}

/* The shape's object; `inside` is written where it is true. */
static void write_shape(sbfi_text *text, const sbf_chain_collider *c, const local_shape *l) {
  static const char *const names[] = {"sphere", "capsule", "plane"};
  sbfi_export_print(text, "{\"%s\":{", names[c->shape]);
  const float offset[3] = {l->position.x, l->position.y, l->position.z};
  sbfi_text_string(text, "\"offset\":");
  sbfi_glb_write_numbers(text, offset, 3);
  if (c->shape == SBF_CHAIN_COLLIDER_SHAPE_PLANE)
    write_vector(text, "normal", l->normal);
  else
    write_number(text, "radius", c->radius);
  if (c->shape == SBF_CHAIN_COLLIDER_SHAPE_CAPSULE) write_vector(text, "tail", l->end);
  if (c->shape != SBF_CHAIN_COLLIDER_SHAPE_PLANE && c->inside) sbfi_text_string(text, ",\"inside\":true");
  sbfi_text_string(text, "}}");
}

static void write_collider(sbfi_glb *g, const sbf_chain_collider *c, sbfi_text *text) {
  local_shape l = shape_in_bone(g->e->asset, c);
  bool is_plane = c->shape == SBF_CHAIN_COLLIDER_SHAPE_PLANE;
  sbfi_export_print(text, "{\"node\":%d,\"shape\":", (int)c->bone);
  if (!is_plane && !c->inside) {
    write_shape(text, c, &l);
    sbfi_text_char(text, '}');
    return;
  }
  sbf_chain_collider other = {.shape = SBF_CHAIN_COLLIDER_SHAPE_SPHERE, .radius = is_plane ? LARGE_M : 0};
  local_shape stand_in = {.position = {0, -FAR_M, 0}};
  if (is_plane)
    stand_in.position = (sbf_vec3){l.position.x - LARGE_M * l.normal.x, l.position.y - LARGE_M * l.normal.y,
        l.position.z - LARGE_M * l.normal.z};
  write_shape(text, &other, &stand_in);
  sbfi_text_string(
      text, ",\"extensions\":{\"VRMC_springBone_extended_collider\":{\"specVersion\":\"1.0\",\"shape\":");
  write_shape(text, c, &l);
  sbfi_text_string(text, "}}}");
}

/* One group for each spring with colliders. */
static void write_groups(const sbfi_glb_springs *s, sbfi_text *text) {
  uint32_t count = 0;
  for (uint32_t i = 0; i < s->count; i++) {
    const sbf_chain_spring *source = s->at[i].source;
    if (!source || !source->colliders.count) continue;
    sbfi_text_string(text, count++ ? ",{\"name\":" : ",\"colliderGroups\":[{\"name\":");
    sbfi_glb_write_string(text, s->at[i].name);
    for (uint32_t k = 0; k < source->colliders.count; k++)
      sbfi_export_print(text, "%s%u", k ? "," : ",\"colliders\":[", source->colliders.at[k]);
    sbfi_text_string(text, "]}");
  }
  if (count) sbfi_text_char(text, ']');
}

static void write_spring(const sbfi_glb_spring *s, uint32_t *group, sbfi_text *text) {
  sbfi_text_string(text, "{\"name\":");
  sbfi_glb_write_string(text, s->name);
  sbfi_text_string(text, ",\"joints\":[");
  for (uint32_t k = 0; k < s->joint_count; k++) {
    const sbfi_glb_joint *joint = &s->joints[k];
    sbfi_export_print(text, "%s{\"node\":%u", k ? "," : "", joint->bone);
    write_number(text, "hitRadius", joint->hit_radius);
    write_number(text, "stiffness", joint->stiffness);
    write_number(text, "gravityPower", joint->gravity_power);
    write_vector(text, "gravityDir", joint->gravity_direction);
    write_number(text, "dragForce", joint->drag_force);
    sbfi_text_char(text, '}');
  }
  sbfi_export_print(text, ",{\"node\":%u}]", s->end_bone == SBF_NONE ? s->end_node : (uint32_t)s->end_bone);
  if (s->source && s->source->colliders.count)
    sbfi_export_print(text, ",\"colliderGroups\":[%u]", (*group)++);
  if (s->source && s->source->center >= 0) sbfi_export_print(text, ",\"center\":%d", (int)s->source->center);
  sbfi_text_char(text, '}');
}

void sbfi_glb_write_springs(sbfi_glb *g, sbfi_text *text) {
  const sbf_chain_collider_list colliders = g->e->asset->chain_colliders;
  const sbfi_glb_springs *s = g->springs;
  uint32_t group = 0;
  sbfi_text_string(text, "{\"specVersion\":\"1.0\"");
  if (colliders.count) sbfi_text_string(text, ",\"colliders\":[");
  for (uint32_t i = 0; i < colliders.count; i++) {
    if (i) sbfi_text_char(text, ',');
    write_collider(g, &colliders.at[i], text);
  }
  if (colliders.count) sbfi_text_char(text, ']');
  write_groups(s, text);
  sbfi_text_string(text, ",\"springs\":[");
  for (uint32_t i = 0; i < s->count; i++) {
    if (i) sbfi_text_char(text, ',');
    write_spring(&s->at[i], &group, text);
  }
  sbfi_text_string(text, "]}");
}
