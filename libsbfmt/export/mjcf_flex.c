/* Writes soft bodies: a free point is a body with three slide joints, a pinned point belongs to its
 * holder, and a flex of tetrahedra, of a sheet's triangles or of springs connects them. */
#include "export/mjcf.h"
#include "sbfmt/mechanics.h"

static sbf_vec3 minus(sbf_vec3 a, sbf_vec3 b) {
  return (sbf_vec3){a.x - b.x, a.y - b.y, a.z - b.z};
}

static uint32_t spring_count(const sbf_level *level) {
  uint32_t count = 0;
  for (uint32_t i = 0; i < level->springs.count; i++) count += level->springs.at[i].ends.count;
  return count;
}

static void choose_level(mjcf_flex *flex, const sbf_soft_body *body) {
  flex->body = body;
  flex->level = sbfi_export_lattice(body);
  flex->dim = 3;
  if (flex->level) return;
  flex->level = sbfi_export_network(body);
  if (flex->level) flex->dim = sbfi_export_is_sheet(body, flex->level) ? 2 : 1;
}

/* Marks the set's points, and places each at its offset in the frame. */
static void apply_pins(mjcf_writer *w, mjcf_flex *flex, int32_t s) {
  const sbf_pin_set *set = &flex->level->pins.at[s];
  const sbf_asset *asset = w->e->asset;
  for (uint32_t k = 0; k < set->points.count; k++) {
    uint32_t p = set->points.at[k];
    if (sbfi_export_pin_weight(set, k) < 1) {
      w->unsupported.goals++;
      continue;
    }
    flex->holder[p] = s;
    if (set->bone >= 0) w->bone_has_pins[set->bone] = true;
    if (set->bone >= 0 && flex->dim > 1) w->bone_elastic[set->bone] = true;
    if (set->rigid_body >= 0 && flex->dim > 1) w->rigid.elastic[set->rigid_body] = true;
    if (!set->offsets.count) continue;
    sbf_vec3 at = set->offsets.at[k], from = {0, 0, 0};
    if (set->bone >= 0) {
      at = sbfi_mjcf_rotated(asset->bones.at[set->bone].rotation, at);
      from = asset->bones.at[set->bone].head;
    } else if (set->rigid_body >= 0) {
      from = asset->rigid_bodies.at[set->rigid_body].center;
    }
    flex->positions[p] = (sbf_vec3){at.x + from.x, at.y + from.y, at.z + from.z};
  }
}

static bool fill_flex(mjcf_writer *w, mjcf_flex *flex) {
  uint32_t count = flex->level->positions.count;
  uint8_t *pinned = sbfi_arena_allocate(&w->scratch, count, sizeof *pinned);
  flex->holder = sbfi_arena_allocate(&w->scratch, count, sizeof *flex->holder);
  flex->positions = sbfi_arena_copy(&w->scratch, flex->level->positions.at, count, sizeof *flex->positions);
  flex->masses = sbfi_arena_allocate(&w->scratch, count, sizeof *flex->masses);
  if (!pinned || !flex->holder || !flex->positions || !flex->masses) return false;
  for (uint32_t i = 0; i < count; i++) flex->holder[i] = SBF_NONE;
  for (uint32_t s = 0; s < flex->level->pins.count; s++) apply_pins(w, flex, (int32_t)s);
  sbf_level_pinned_points(flex->level, pinned);
  sbf_level_masses(flex->body, flex->level, pinned, flex->masses);
  return true;
}

bool sbfi_mjcf_collect_flexes(mjcf_writer *w) {
  const sbf_asset *asset = w->e->asset;
  uint32_t bodies = asset->soft_bodies.count;
  w->flexes = sbfi_arena_allocate(&w->scratch, bodies + 1, sizeof *w->flexes);
  w->bone_has_pins = sbfi_arena_allocate(&w->scratch, asset->bones.count + 1, sizeof *w->bone_has_pins);
  w->bone_elastic = sbfi_arena_allocate(&w->scratch, asset->bones.count + 1, sizeof *w->bone_elastic);
  w->rigid.elastic =
      sbfi_arena_allocate(&w->scratch, asset->rigid_bodies.count + 1, sizeof *w->rigid.elastic);
  if (!w->flexes || !w->bone_has_pins || !w->bone_elastic || !w->rigid.elastic) return false;
  for (uint32_t b = 0; b < bodies; b++) {
    choose_level(&w->flexes[b], &asset->soft_bodies.at[b]);
    if (!w->flexes[b].level) w->unsupported.without_level++;
    if (w->flexes[b].level && !fill_flex(w, &w->flexes[b])) return false;
  }
  return true;
}

/* ---- Bodies ---- */

float sbfi_mjcf_point_mass(const mjcf_flex *flex, uint32_t p) {
  return flex->masses[p] > 1e-9f ? flex->masses[p] : 1e-9f;
}

static void write_point(mjcf_writer *w, const mjcf_flex *flex, uint32_t b, uint32_t p) {
  sbfi_text *text = &w->e->text;
  float mass = sbfi_mjcf_point_mass(flex, p);
  float radius = flex->body->collision.particle_radius;
  if (!(flex->masses[p] > 0)) w->unsupported.massless++;
  if (radius < 1e-3f) radius = 1e-3f;
  /* Slide joints only: moments have no effect, but are required. */
  float moment = 0.4f * mass * radius * radius;
  if (moment < 1e-12f) moment = 1e-12f;
  sbfi_text_string(text, "    <body name=\"");
  sbfi_mjcf_name(w, flex->body->id, b);
  sbfi_export_format(w->e, ":%u\"", p);
  sbfi_mjcf_write_vec3(w, "pos", flex->positions[p]);
  if (flex->body->attributes.gravity_scale != 1)
    sbfi_mjcf_write_f32(w, "gravcomp", 1 - flex->body->attributes.gravity_scale);
  sbfi_text_string(text, "><inertial pos=\"0 0 0\"");
  sbfi_mjcf_write_f32(w, "mass", mass);
  sbfi_text_string(text, " diaginertia=\"");
  for (int k = 0; k < 3; k++) {
    if (k) sbfi_text_char(text, ' ');
    sbfi_text_f32(text, moment);
  }
  sbfi_text_char(text, '"');
  sbfi_text_string(text, "/>");
  static const char *const axes[3] = {"1 0 0", "0 1 0", "0 0 1"};
  for (int k = 0; k < 3; k++) sbfi_export_format(w->e, "<joint type=\"slide\" axis=\"%s\"/>", axes[k]);
  sbfi_text_string(text, "</body>\n");
}

static void write_bone_name(mjcf_writer *w, uint32_t bone) {
  sbfi_mjcf_name(w, w->e->asset->bones.at[bone].id, bone);
  sbfi_text_string(&w->e->text, ":bone");
}

void sbfi_mjcf_write_holders_and_points(mjcf_writer *w) {
  const sbf_asset *asset = w->e->asset;
  for (uint32_t i = 0; i < asset->bones.count; i++) {
    if (!w->bone_has_pins[i]) continue;
    sbfi_text_string(&w->e->text, "    <body name=\"");
    write_bone_name(w, i);
    sbfi_text_char(&w->e->text, '"');
    if (!w->bone_elastic[i]) sbfi_text_string(&w->e->text, " mocap=\"true\"");
    sbfi_mjcf_write_vec3(w, "pos", asset->bones.at[i].head);
    sbfi_text_string(&w->e->text, "/>\n");
  }
  for (uint32_t b = 0; b < asset->soft_bodies.count; b++)
    for (uint32_t p = 0; w->flexes[b].level && p < w->flexes[b].level->positions.count; p++)
      if (w->flexes[b].holder[p] < 0) write_point(w, &w->flexes[b], b, p);
}

/* ---- Flexes ---- */

static void write_elements(mjcf_writer *w, const mjcf_flex *flex) {
  const sbf_level *level = flex->level;
  sbfi_text_string(&w->e->text, " element=\"");
  const char *gap = "";
  for (uint32_t i = 0; flex->dim == 3 && i < level->lattice.tetrahedra.count; i++, gap = " ") {
    const uint32_t *p = level->lattice.tetrahedra.at[i].at;
    sbfi_export_format(w->e, "%s%u %u %u %u", gap, p[0], p[1], p[2], p[3]);
  }
  for (uint32_t s = 0; flex->dim == 1 && s < level->springs.count; s++)
    for (uint32_t i = 0; i < level->springs.at[s].ends.count; i++, gap = " ")
      sbfi_export_format(
          w->e, "%s%u %u", gap, level->springs.at[s].ends.at[i].at[0], level->springs.at[s].ends.at[i].at[1]);
  const sbf_polygon_mesh *mesh = &flex->body->surface;
  for (uint32_t i = 0, corner = 0; flex->dim == 2 && i < mesh->polygon_sizes.count; i++) {
    const uint32_t *points = mesh->polygon_points.at + corner;
    for (uint32_t k = 2; k < mesh->polygon_sizes.at[i]; k++, gap = " ")
      sbfi_export_format(w->e, "%s%u %u %u", gap, sbfi_export_index(level, points[0]),
          sbfi_export_index(level, points[k - 1]), sbfi_export_index(level, points[k]));
    corner += mesh->polygon_sizes.at[i];
  }
  sbfi_text_char(&w->e->text, '"');
}

static float mean_of(const float *values, uint32_t count, bool *differ) {
  double sum = 0;
  for (uint32_t i = 0; i < count; i++) {
    sum += values[i];
    *differ = *differ || values[i] != values[0];
  }
  return count ? (float)(sum / count) : 0;
}

float sbfi_mjcf_ratio(const sbf_soft_body *body) {
  float ratio = body->attributes.poisson_ratio;
  return ratio < 0 ? 0 : ratio > 0.499f ? 0.499f : ratio;
}

bool sbfi_mjcf_matter(mjcf_writer *w, const mjcf_flex *flex, float *value, bool *differ) {
  const sbf_level *level = flex->level;
  uint32_t points = level->positions.count;
  uint32_t count = flex->dim == 3 ? level->lattice.tetrahedra.count : spring_count(level);
  float *volumes = sbfi_arena_allocate(&w->scratch, points, sizeof *volumes);
  double *work = sbfi_arena_allocate(&w->scratch, points, 2 * sizeof *work);
  float *values = sbfi_arena_allocate(&w->scratch, count, sizeof *values);
  if (!volumes || !work || !values) return false;
  if (flex->dim == 1)
    sbf_level_stiffness(flex->body, level, volumes, work, values);
  else if (flex->dim == 3)
    sbf_level_moduli(flex->body, level, volumes, values);
  *value = flex->dim == 2 ? flex->body->attributes.young_modulus : mean_of(values, count, differ);
  return true;
}

static bool is_point_pinned(const mjcf_flex *flex) {
  for (uint32_t p = 0; p < flex->level->positions.count; p++)
    if (flex->holder[p] >= 0) return true;
  return false;
}

/* One value for all its springs or tetrahedra, because a flex has only one. */
static bool write_matter(mjcf_writer *w, const mjcf_flex *flex) {
  const sbf_attributes *matter = &flex->body->attributes;
  bool differ = false;
  float value;
  if (!sbfi_mjcf_matter(w, flex, &value, &differ)) return false;
  if (flex->dim == 1) {
    sbfi_text_string(&w->e->text, "<edge");
    sbfi_mjcf_write_f32(w, "stiffness", value);
    sbfi_mjcf_write_f32(w, "damping", matter->stiffness_damping * value);
  } else {
    w->unsupported.ratios += matter->poisson_ratio != sbfi_mjcf_ratio(flex->body);
    sbfi_text_string(&w->e->text, "<elasticity");
    sbfi_mjcf_write_f32(w, "young", value);
    sbfi_mjcf_write_f32(w, "poisson", sbfi_mjcf_ratio(flex->body));
    sbfi_mjcf_write_f32(w, "damping", matter->stiffness_damping);
    if (flex->dim == 2) {
      /* MuJoCo's compiler rejects bending if a point is pinned. */
      bool pinned = is_point_pinned(flex);
      w->unsupported.bending += pinned;
      sbfi_mjcf_write_f32(w, "thickness", matter->thickness);
      sbfi_export_format(w->e, " elastic2d=\"%s\"", pinned ? "stretch" : "both");
    }
  }
  w->unsupported.moduli += differ;
  sbfi_text_string(&w->e->text, "/>");
  return true;
}

static void write_vertices(mjcf_writer *w, const mjcf_flex *flex, uint32_t b) {
  const sbf_asset *asset = w->e->asset;
  uint32_t count = flex->level->positions.count;
  sbfi_text_string(&w->e->text, " body=\"");
  for (uint32_t p = 0; p < count; p++) {
    const sbf_pin_set *set = flex->holder[p] < 0 ? NULL : &flex->level->pins.at[flex->holder[p]];
    if (p) sbfi_text_char(&w->e->text, ' ');
    if (!set) {
      sbfi_mjcf_name(w, flex->body->id, b);
      sbfi_export_format(w->e, ":%u", p);
    } else if (set->bone >= 0) {
      write_bone_name(w, (uint32_t)set->bone);
    } else {
      sbfi_mjcf_rigid_name(w, set->rigid_body);
    }
  }
  sbfi_text_string(&w->e->text, "\" vertex=\"");
  for (uint32_t p = 0; p < count; p++) {
    const sbf_pin_set *set = flex->holder[p] < 0 ? NULL : &flex->level->pins.at[flex->holder[p]];
    sbf_vec3 from = {0, 0, 0};
    if (!set)
      from = flex->positions[p];
    else if (set->bone >= 0)
      from = asset->bones.at[set->bone].head;
    else if (set->rigid_body >= 0)
      from = asset->rigid_bodies.at[set->rigid_body].center;
    sbfi_export_vec3(w->e, sbfi_mjcf_from_asset(minus(flex->positions[p], from)));
  }
  sbfi_text_char(&w->e->text, '"');
}

bool sbfi_mjcf_write_flexes(mjcf_writer *w) {
  const sbf_asset *asset = w->e->asset;
  sbfi_text *text = &w->e->text;
  if (w->unsupported.without_level == asset->soft_bodies.count) return true;
  sbfi_text_string(text, "  <deformable>\n");
  for (uint32_t b = 0; b < asset->soft_bodies.count; b++) {
    const mjcf_flex *flex = &w->flexes[b];
    if (!flex->level) continue;
    const sbf_collision *collision = &flex->body->collision;
    float radius = collision->particle_radius;
    sbfi_text_string(text, "    <flex name=\"");
    sbfi_mjcf_name(w, flex->body->id, b);
    sbfi_export_format(w->e, "\" dim=\"%d\"", flex->dim);
    sbfi_mjcf_write_f32(w, "radius", flex->dim < 3 && !(radius > 0) ? 1e-3f : radius);
    write_vertices(w, flex, b);
    write_elements(w, flex);
    sbfi_text_char(text, '>');
    /* Crossing springs overlap at rest. */
    bool self = collision->self && flex->dim > 1;
    w->unsupported.selves += collision->self && !self;
    sbfi_export_format(w->e, "<contact selfcollide=\"%s\"", self ? "auto" : "none");
    sbfi_mjcf_flex_bits(w, flex);
    sbfi_text_string(text, " friction=\"");
    sbfi_text_f32(text, flex->body->attributes.friction);
    sbfi_text_string(text, " 0.005 0.0001\"/>");
    if (!write_matter(w, flex)) return false;
    sbfi_text_string(text, "</flex>\n");
  }
  sbfi_text_string(text, "  </deformable>\n");
  return true;
}
