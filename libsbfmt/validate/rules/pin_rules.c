/* Checks pins and attachments: sets whose frames match at rest, points pinned once, sections that are
 * pinned. */
#include "build/geometry/hulls.h"
#include "validate/rules/pin_states.h"
#include "validate/rules/pose.h"
#include "validate/validation.h"

typedef struct point_pin { /* the pin set of a point */
  uint32_t set;            /* from 1; 0: none */
  bool fast;
} point_pin;

/* Positions of points in sets: of the body or of a level. */
typedef struct pinned_point {
  sbfi_validation *v;
  const sbf_soft_body *body;
  const sbf_vec3 *positions, *interior; /* interior: points after those of the surface; NULL in a level */
  uint32_t count, surface_count;
  const char *parent;
} pinned_point;

static sbf_vec3 position_of(const pinned_point *h, uint32_t point) {
  return point < h->surface_count ? h->positions[point] : h->interior[point - h->surface_count];
}

/* The set's frame at rest; the world's if it has none. */
static void frame_of(const sbf_asset *asset, const sbf_pin_set *set, sbfi_d3 *origin, sbfi_rotation *turn) {
  *origin = (sbfi_d3){0, 0, 0};
  *turn = (sbfi_rotation){{0, 0, 0}, 1};
  if (set->bone >= 0) {
    *origin = sbfi_d3_of(asset->bones.at[set->bone].head);
    *turn = sbfi_rotation_of(asset->bones.at[set->bone].rotation);
  } else if (set->rigid_body >= 0) {
    /* its axes are those of asset space */
    *origin = sbfi_d3_of(asset->rigid_bodies.at[set->rigid_body].center);
  }
}

static void check_offsets(const pinned_point *h, const sbf_pin_set *set, const char *path) {
  sbfi_d3 origin;
  sbfi_rotation rotation;
  double max = 0, size = sbfi_extent(h->body->surface.positions);
  uint32_t far = 0, first = 0;
  frame_of(h->v->asset, set, &origin, &rotation);
  for (uint32_t i = 0; i < set->offsets.count; i++) {
    sbfi_d3 position = sbfi_d3_add(origin, sbfi_rotated(rotation, sbfi_d3_of(set->offsets.at[i])));
    double distance = sbfi_d3_length(sbfi_d3_sub(position, sbfi_d3_of(position_of(h, set->points.at[i]))));
    if (!(distance > size) || size == 0) continue;
    if (far++ == 0) first = i;
    max = fmax(max, distance);
  }
  if (far)
    sbfi_found(h->v, SBF_CODE_PIN_OFFSET, sbfi_path_of("%s/offsets", path).text, first,
        "pin set '%s' moves %u point%s by up to %.3g m, more than the size of '%s'", set->name, far,
        sbfi_plural(far), max, sbfi_label(h->body->name, h->body->id));
}

static void check_points(
    const pinned_point *h, const sbf_pin_set *set, uint32_t number, point_pin *point_pins, const char *path) {
  sbfi_path points = sbfi_path_of("%s/points", path);
  bool has_weight = false;
  for (uint32_t i = 0; i < set->points.count; i++) {
    uint32_t p = set->points.at[i];
    float weight = sbfi_pin_weight(set, i);
    has_weight |= weight > 0;
    if (point_pins[p].set && (point_pins[p].fast || point_pins[p].set == number + 1))
      sbfi_found(h->v, SBF_CODE_PIN_REPEATED, points.text, i, "point %u of '%s' is already pinned by set %u",
          p, sbfi_label(h->body->name, h->body->id), point_pins[p].set);
    else
      point_pins[p] = (point_pin){number + 1, weight >= 1};
  }
  if (set->points.count && !has_weight)
    sbfi_found(h->v, SBF_CODE_PIN_NO_WEIGHT, path, -1, "pin set '%s' has the weight 0 everywhere", set->name);
}

static void check_sets(const pinned_point *h, const sbf_pin_set_list *sets) {
  point_pin *point_pins = sbfi_scratch(h->v, h->count, sizeof *point_pins);
  if (!point_pins) return;
  for (uint32_t s = 0; s < sets->count; s++) {
    const sbf_pin_set *set = &sets->at[s];
    sbfi_path path = sbfi_path_of("%s/pins/pin_set[%u]", h->parent, s + 1);
    if (set->points.count == 0)
      sbfi_found(h->v, SBF_CODE_PIN_SET_EMPTY, path.text, -1, "pin set '%s' of '%s' has no points", set->name,
          sbfi_label(h->body->name, h->body->id));
    if (set->minimum > set->maximum)
      sbfi_found(h->v, SBF_CODE_PIN_RANGE, path.text, -1,
          "pin set '%s' has the minimum %.4g and the maximum %.4g", set->name, (double)set->minimum,
          (double)set->maximum);
    if (set->bone >= 0 && set->rigid_body >= 0)
      sbfi_found(h->v, SBF_CODE_PIN_TWO_FRAMES, path.text, -1,
          "pin set '%s' names the bone '%s' and the body '%s'", set->name,
          sbfi_bone_label(h->v->asset, (uint32_t)set->bone),
          sbfi_label(h->v->asset->rigid_bodies.at[set->rigid_body].name,
              h->v->asset->rigid_bodies.at[set->rigid_body].id));
    check_points(h, set, s, point_pins, path.text);
    check_offsets(h, set, path.text);
  }
}

static bool contains_some(const sbf_soft_body *body, const sbf_polygon_mesh *hull) {
  for (uint32_t i = 0; i < body->surface.positions.count; i++)
    if (sbfi_hull_contains(hull, body->surface.positions.at[i])) return true;
  for (uint32_t i = 0; i < body->interior.count; i++)
    if (sbfi_hull_contains(hull, body->interior.at[i])) return true;
  for (uint32_t l = 0; l < body->levels.count; l++)
    for (uint32_t i = 0; i < body->levels.at[l].positions.count; i++)
      if (sbfi_hull_contains(hull, body->levels.at[l].positions.at[i])) return true;
  return false;
}

static void check_attachments(sbfi_validation *v, const sbf_soft_body *body, const char *parent) {
  for (uint32_t i = 0; i < body->attachments.count; i++) {
    const sbf_attachment *rule = &body->attachments.at[i];
    const sbf_rigid_body *by = &v->asset->rigid_bodies.at[rule->rigid_body];
    sbfi_path path = sbfi_path_of("%s/attachments/attachment[%u]", parent, i + 1);
    if (rule->rule == SBF_ATTACHMENT_RULE_EXPLICIT && rule->points.count == 0)
      sbfi_found(v, SBF_CODE_ATTACHMENT_EMPTY, path.text, -1, "attachment '%s' of '%s' has no points",
          rule->name, sbfi_label(body->name, body->id));
    if (rule->rule != SBF_ATTACHMENT_RULE_INSIDE_HULL) continue;
    if (!by->hull)
      sbfi_found(v, SBF_CODE_ATTACHMENT_NO_HULL, path.text, -1,
          "attachment '%s' of '%s' names the rigid body '%s', which has no hull", rule->name,
          sbfi_label(body->name, body->id), sbfi_label(by->name, by->id));
    else if (!contains_some(body, by->hull))
      sbfi_found(v, SBF_CODE_ATTACHMENT_EMPTY, path.text, -1, "no point of '%s' lies inside the hull of '%s'",
          sbfi_label(body->name, body->id), sbfi_label(by->name, by->id));
  }
}

static void check_body(sbfi_validation *v, const sbf_soft_body *body, const char *path) {
  pinned_point source = {v, body, body->surface.positions.at, body->interior.at,
      body->surface.positions.count + body->interior.count, body->surface.positions.count, path};
  check_sets(&source, &body->pins);
  check_attachments(v, body, path);
  for (uint32_t l = 0; l < body->levels.count && !v->out_of_memory; l++) {
    const sbf_level *level = &body->levels.at[l];
    sbfi_path parent = sbfi_path_of("%s/level[%u]", path, l + 1);
    pinned_point here = {
        v, body, level->positions.at, NULL, level->positions.count, level->positions.count, parent.text};
    check_sets(&here, &level->pins);
    bool jiggles = level->model == SBF_ELASTIC_MODEL_JIGGLE; /* its bone moves it, without pins */
    if (body->bone >= 0 && level->pins.count == 0 && !jiggles)
      sbfi_found(v, SBF_CODE_SECTION_UNHELD, parent.text, -1,
          "section '%s' has a bone but no pins, so it falls off", sbfi_label(body->name, body->id));
  }
}

void sbfi_check_pins(sbfi_validation *v) {
  for (uint32_t b = 0; b < v->asset->soft_bodies.count && !v->out_of_memory; b++)
    check_body(v, &v->asset->soft_bodies.at[b], sbfi_path_of("/sbf/soft_body[%u]", b + 1).text);
}
