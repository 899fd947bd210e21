#include "import/convert/convert_attachments.h"

#include <string.h>

#include "build/geometry/hulls.h"

/* Lists of the asset, as writable memory. */
typedef struct work {
  sbfi_conversion *c;
  sbf_soft_body *bodies;
  sbf_rigid_body *rigids;
  uint32_t rigid_count;
  int32_t *rigid_of_object; /* (bodies) rigid body that replaced a soft body; SBF_NONE: it is still soft */
} work;

static int64_t body_named(const work *w, const char *name) {
  for (uint32_t i = 0; i < w->c->asset->soft_bodies.count; i++)
    if (strcmp(w->bodies[i].name, name) == 0) return i;
  return -1;
}

static bool is_bone(const work *w, int32_t bone, const char *name) {
  return bone != SBF_NONE && strcmp(w->c->asset->bones.at[bone].name, name) == 0;
}

static int32_t rigid_named(const work *w, const char *name) {
  for (uint32_t i = 0; i < w->rigid_count; i++)
    if (strcmp(w->rigids[i].name, name) == 0 || is_bone(w, w->rigids[i].bone, name)) return (int32_t)i;
  return SBF_NONE;
}

/* Converts an object to a rigid body with its own hull. */
static sbf_status convert_to_rigid(work *w, uint32_t object) {
  sbfi_conversion *c = w->c;
  const sbf_soft_body *from = &w->bodies[object];
  const sbf_vec3_list *points = &from->surface.positions;
  sbf_rigid_body *to = &w->rigids[w->rigid_count];
  sbf_polygon_mesh *hull = sbfi_convert_allocate(c, 1, sizeof *hull);
  if (!hull) return sbfi_convert_no_memory(c);
  sbf_rigid_body_init(to);
  to->name = from->name;
  to->id = sbfi_new_id(c, "rigid", to->name);
  to->bone = from->bone;
  if (!to->id) return sbfi_convert_no_memory(c);
  switch (sbfi_hull_make(points->at, points->count, c->asset, hull, &c->scratch)) {
  case SBFI_HULL_NO_MEMORY:
    return sbfi_convert_no_memory(c);
  case SBFI_HULL_FLAT:
    return sbfi_diagnose(
        c->error, SBF_CODE_IMPORT_PIN_UNKNOWN, "'%s' is flat, so nothing is inside it to attach", from->name);
  case SBFI_HULL_MADE:
    break;
  }
  double sum[3] = {0};
  for (uint32_t i = 0; i < hull->positions.count; i++) {
    sum[0] += (double)hull->positions.at[i].x / hull->positions.count;
    sum[1] += (double)hull->positions.at[i].y / hull->positions.count;
    sum[2] += (double)hull->positions.at[i].z / hull->positions.count;
  }
  to->center = (sbf_vec3){(float)sum[0], (float)sum[1], (float)sum[2]};
  to->hull = hull;
  w->rigid_of_object[object] = (int32_t)w->rigid_count++;
  return SBF_OK;
}

static sbf_status find_holder(work *w, const char *name, int32_t *holder) {
  int64_t object = body_named(w, name);
  *holder = object >= 0 ? w->rigid_of_object[object] : rigid_named(w, name);
  if (*holder != SBF_NONE) return SBF_OK;
  if (object < 0)
    return sbfi_diagnose(w->c->error, SBF_CODE_IMPORT_PIN_UNKNOWN,
        "cannot attach to '%s': no object and no bone with a rigid body has that name", name);
  sbf_status status = convert_to_rigid(w, (uint32_t)object);
  *holder = w->rigid_of_object[object];
  return status;
}

static sbf_status attach(work *w, const sbf_convert_attachment *request) {
  sbfi_conversion *c = w->c;
  int64_t number = body_named(w, request->body);
  int32_t holder;
  if (number < 0)
    return sbfi_diagnose(c->error, SBF_CODE_IMPORT_PIN_UNKNOWN,
        "cannot attach '%s' to '%s': no soft body has that name", request->body, request->holder);
  if (strcmp(request->body, request->holder) == 0)
    return sbfi_diagnose(
        c->error, SBF_CODE_IMPORT_PIN_UNKNOWN, "'%s' cannot be attached to itself", request->body);
  sbf_status status = find_holder(w, request->holder, &holder);
  if (status != SBF_OK) return status;
  sbf_soft_body *body = &w->bodies[number];
  uint32_t count = body->attachments.count;
  sbf_attachment *rules = sbfi_convert_allocate(c, (size_t)count + 1, sizeof *rules);
  if (!rules) return sbfi_convert_no_memory(c);
  if (count) memcpy(rules, body->attachments.at, count * sizeof *rules);
  sbf_attachment_init(&rules[count]);
  rules[count].name = w->rigids[holder].name;
  rules[count].rule = SBF_ATTACHMENT_RULE_INSIDE_HULL;
  rules[count].rigid_body = holder;
  body->attachments = (sbf_attachment_list){rules, count + 1};
  return SBF_OK;
}

/* Removes converted objects from the soft bodies and render meshes. */
static sbf_status remove_converted(work *w) {
  sbf_asset *a = w->c->asset;
  sbf_render_mesh *meshes = sbfi_convert_allocate(w->c, (size_t)a->render_meshes.count + 1, sizeof *meshes);
  uint32_t kept = 0, kept_meshes = 0;
  if (!meshes) return sbfi_convert_no_memory(w->c);
  for (uint32_t i = 0; i < a->render_meshes.count; i++) {
    int64_t object = body_named(w, a->render_meshes.at[i].name);
    if (object < 0 || w->rigid_of_object[object] == SBF_NONE) meshes[kept_meshes++] = a->render_meshes.at[i];
  }
  for (uint32_t i = 0; i < a->soft_bodies.count; i++) {
    if (w->rigid_of_object[i] == SBF_NONE) {
      w->bodies[kept++] = w->bodies[i];
      continue;
    }
    if (w->bodies[i].attachments.count)
      return sbfi_diagnose(w->c->error, SBF_CODE_IMPORT_PIN_UNKNOWN,
          "something is attached to '%s', so it cannot be attached itself", w->bodies[i].name);
  }
  a->soft_bodies = (sbf_soft_body_list){w->bodies, kept};
  a->render_meshes = (sbf_render_mesh_list){meshes, kept_meshes};
  a->rigid_bodies = (sbf_rigid_body_list){w->rigids, w->rigid_count};
  return SBF_OK;
}

sbf_status sbfi_convert_attachments(sbfi_conversion *c) {
  const sbf_convert_options *o = c->options;
  const sbf_asset *a = c->asset;
  work w = {.c = c, .rigid_count = a->rigid_bodies.count};
  sbf_status status = SBF_OK;
  if (o->attachment_count == 0) return SBF_OK;
  w.bodies = sbfi_convert_allocate(c, (size_t)a->soft_bodies.count + 1, sizeof *w.bodies);
  w.rigids = sbfi_convert_allocate(c, (size_t)w.rigid_count + o->attachment_count, sizeof *w.rigids);
  w.rigid_of_object = sbfi_arena_allocate(&c->scratch, (size_t)a->soft_bodies.count + 1, sizeof(int32_t));
  if (!w.bodies || !w.rigids || !w.rigid_of_object) return sbfi_convert_no_memory(c);
  if (a->soft_bodies.count) memcpy(w.bodies, a->soft_bodies.at, a->soft_bodies.count * sizeof *w.bodies);
  if (w.rigid_count) memcpy(w.rigids, a->rigid_bodies.at, w.rigid_count * sizeof *w.rigids);
  for (uint32_t i = 0; i < a->soft_bodies.count; i++) w.rigid_of_object[i] = SBF_NONE;
  for (uint32_t i = 0; i < o->attachment_count && status == SBF_OK; i++)
    status = attach(&w, &o->attachments[i]);
  return status == SBF_OK ? remove_converted(&w) : status;
}
