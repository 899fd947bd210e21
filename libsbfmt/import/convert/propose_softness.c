/* Consider a section of density rho and modulus E whose skin is at distance r from the bone. Under
 * acceleration a it deforms by about rho a r^2 / E. Sections that are thin relative to the character do
 * not visibly deform; thick ones do. (Dimensional analysis of a layer in shear; measured on 131 rigs.) */
#include "import/convert/propose_softness.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

#include "build/geometry/hulls.h"
#include "build/geometry/topology.h"
#include "build/sections/sections.h"
#include "import/convert/main_bones.h"
#include "import/convert/part_words.h"
#include "import/convert/propose_limits.h"
#include "import/gait/locomotion.h"
#include "mechanics/vector.h"
#include "sbfmt/mechanics.h"

enum { MAX_SOFT = 8, NAMES_SIZE = 256 };
static const double GRAVITY = 9.81; /* m/s^2 */
/* E / (rho g size): 1.5 if the thickest part has a usual thickness for an animal. Outside this range the
 * ratio scales with the square of the thickness, down to a minimum, so that the deformation stays the
 * same. */
static const double MODULUS_RATIO = 1.5, MIN_USUAL = 0.066, MAX_USUAL = 0.12, MIN_RATIO = 0.33;
/* Minimum fraction of points with a single bone, and maximum fraction of area in polygons between bones,
 * for a machine: its parts are separate pieces. Rigs of animals and people have an area fraction of at
 * least 0.13. */
static const double MACHINE_SINGLE = 0.87, MACHINE_JOINED = 0.06;
static const double PIECES_SINGLE = 0.6, PIECES_JOINED = 0.015;
static const double MIN_THICKNESS = 0.032;   /* fraction of the size; thinner parts do not visibly deform */
static const double SLENDER_THICKNESS = 0.6; /* fraction of the thickest part, if no part reaches that */
static const double NAMED_THICKNESS = 0.5;   /* factor on these bounds if the name suggests a soft part */
static const double SHEET_THICKNESS = 0.012; /* fraction of the size; sheets and fins are thinner */
static const double MIN_AREA = 0.012;        /* of the skin's */
static const double LOW_LEG = 0.1;           /* fraction of the size, above the ground */
static const double ALIKE = 0.15;        /* fraction of the sum; maximum difference between left and right */
static const double NEAR_TWIN = 0.04;    /* fraction of the size */
static const double PROP_AREA = 0.3;     /* fraction of the skin's area; maximum for all objects on bones */
static const double HARD_FRACTION = 0.5; /* fraction of a part's area with hard materials */

/* Reason why a part is rigid. */
typedef enum reason {
  SOFT,
  ASKED,
  MACHINE,
  PROP,
  HARD_MATERIAL,
  FACE,
  LIMB,
  SWINGING,
  SMALL,
  THIN,
  NOT_AMONG_LARGEST,
  REASON_COUNT
} reason;

static const char *const reason_texts[REASON_COUNT] = {NULL, "as asked", "of a machine",
    "weapons, armour or props", "of hard materials", "head or face", "hands, feet and lower limbs",
    "on swinging chains", "too small to show", "too thin to show", "beyond the largest 8"};

typedef struct part {
  double thickness, area; /* radius of a ball with the same ratio of volume to area, m; m^2 */
  double hard_area;       /* m^2 */
  double lowest;          /* y of its lowest vertex, m */
  bool twin;              /* measured with its mirror image */
  bool is_requested;      /* the caller's options name it */
  reason why;
} part;

typedef struct work {
  sbfi_conversion *c;
  const sbf_asset *asset;
  sbfi_skin_parts skin;
  part *parts; /* (bones) */
  double size, area, thickest;
  double joining_area; /* of polygons between two bones, m^2 */
  double modulus;
} work;

static bool is_part(const work *w, uint32_t bone) {
  return w->skin.at[bone].polygons > 0;
}

/* Largest extent of the skinned meshes. */
static double size_of(const sbf_asset *asset) {
  sbf_vec3 low = {INFINITY, INFINITY, INFINITY}, high = {-INFINITY, -INFINITY, -INFINITY};
  for (uint32_t m = 0; m < asset->render_meshes.count; m++) {
    const sbf_vec3_list at = asset->render_meshes.at[m].mesh.positions;
    for (uint32_t i = 0; asset->render_meshes.at[m].skin && i < at.count; i++) {
      low = (sbf_vec3){fminf(low.x, at.at[i].x), fminf(low.y, at.at[i].y), fminf(low.z, at.at[i].z)};
      high = (sbf_vec3){fmaxf(high.x, at.at[i].x), fmaxf(high.y, at.at[i].y), fmaxf(high.z, at.at[i].z)};
    }
  }
  double size = fmax(fmax((double)high.x - low.x, (double)high.y - low.y), (double)high.z - low.z);
  return size > 0 ? size : 0;
}

/* ---- Materials ---- */

static double polygon_area(const sbf_vec3 *at, const uint32_t *points, uint32_t size) {
  sbfi_d3 sum = {0, 0, 0}, first = sbfi_d3_of(at[points[0]]);
  for (uint32_t k = 2; k < size; k++)
    sum = sbfi_d3_add(sum, sbfi_d3_cross(sbfi_d3_sub(sbfi_d3_of(at[points[k - 1]]), first),
                               sbfi_d3_sub(sbfi_d3_of(at[points[k]]), first)));
  return 0.5 * sbfi_d3_length(sum);
}

static bool is_hard(const work *w, const sbf_render_mesh *mesh, uint32_t polygon) {
  uint32_t slot = mesh->polygon_materials.count ? mesh->polygon_materials.at[polygon] : 0;
  if (slot >= mesh->material_slots.count) return false;
  int32_t material = mesh->material_slots.at[slot].material;
  return material != SBF_NONE && sbfi_material_is_hard(w->asset->materials.at[material].name);
}

static bool joins_bones(const uint32_t *bones, const uint32_t *points, uint32_t size) {
  for (uint32_t k = 1; k < size; k++)
    if (bones[points[k]] != bones[points[0]]) return true;
  return false;
}

static bool measure_vertices(work *w) {
  for (uint32_t m = 0; m < w->asset->render_meshes.count; m++) {
    const sbf_render_mesh *mesh = &w->asset->render_meshes.at[m];
    if (!mesh->skin) continue;
    bool all_hard = sbfi_words_of_name(mesh->name) >= SBFI_NAME_HINT_PROP;
    const uint32_t *bones = sbfi_main_bones(mesh, &w->c->scratch), *points = mesh->mesh.polygon_points.at;
    if (!bones) return false;
    for (uint32_t v = 0; v < mesh->skin->influence_counts.count; v++)
      if (bones[v] != SBFI_NO_INDEX && w->skin.owners[bones[v]] != SBFI_NO_INDEX) {
        part *of = &w->parts[w->skin.owners[bones[v]]];
        of->lowest = fmin(of->lowest, (double)mesh->mesh.positions.at[v].y);
      }
    for (uint32_t p = 0; p < mesh->mesh.polygon_sizes.count; points += mesh->mesh.polygon_sizes.at[p++]) {
      uint32_t bone = bones[points[0]], size = mesh->mesh.polygon_sizes.at[p];
      if (joins_bones(bones, points, size))
        w->joining_area += polygon_area(mesh->mesh.positions.at, points, size);
      if (bone == SBFI_NO_INDEX || !(all_hard || is_hard(w, mesh, p))) continue;
      uint32_t owner = w->skin.owners[bone];
      if (owner != SBFI_NO_INDEX)
        w->parts[owner].hard_area += polygon_area(mesh->mesh.positions.at, points, size);
    }
  }
  return true;
}

/* ---- Each part ---- */

static void measure(work *w) {
  for (uint32_t b = 0; b < w->asset->bones.count; b++) {
    const sbfi_skin_part *from = &w->skin.at[b];
    w->parts[b].lowest = INFINITY;
    if (!is_part(w, b)) continue;
    w->parts[b].area = from->area;
    w->parts[b].thickness = from->closed_area > 0 ? 3 * from->volume / from->closed_area : 0;
    w->area += from->area;
  }
}

static uint32_t leg_count(const sbf_asset *asset) {
  return asset->gaits.count ? asset->gaits.at[0].legs.count : 0;
}

/* Lower legs stay rigid: feet stand where the gait puts them. A whole leg close to the ground, such as a
 * frog's, would be pressed flat. */
static bool is_lower_leg(const work *w, int32_t bone) {
  const sbf_asset *asset = w->asset;
  for (uint32_t l = 0; l < leg_count(asset); l++) {
    const sbf_ik_chain *chain = &asset->ik_chains.at[asset->gaits.at[0].legs.at[l].ik];
    if (chain->root == bone && w->parts[bone].lowest < LOW_LEG * w->size) return true;
    for (int32_t b = asset->bones.at[bone].parent; b != SBF_NONE; b = asset->bones.at[b].parent)
      if (b == chain->root) return true;
  }
  return false;
}

static bool has_face(const sbf_asset *asset, int32_t bone) {
  for (uint32_t b = (uint32_t)bone + 1; b < asset->bones.count; b++)
    if (asset->bones.at[b].parent == bone &&
        sbfi_words_of_name(asset->bones.at[b].name) == SBFI_NAME_HINT_FACE)
      return true;
  return false;
}

/* Whether the bone is the head of a person; the face is painted on it. */
static bool is_face(const sbf_asset *asset, int32_t bone) {
  const char *name = asset->bones.at[bone].name;
  bool head = sbfi_part_by_name(name) == SBFI_PART_HEAD || sbfi_words_of(name) & 1u << SBFI_WORD_HEAD;
  return head && (leg_count(asset) == 2 || has_face(asset, bone));
}

/* Bones of a prop move their section as one piece. */
static sbfi_name_hint name_hint(const sbf_asset *asset, int32_t bone) {
  sbfi_name_hint says = sbfi_words_of_name(asset->bones.at[bone].name);
  for (int32_t b = asset->bones.at[bone].parent; b != SBF_NONE; b = asset->bones.at[b].parent) {
    sbfi_name_hint above = sbfi_words_of_name(asset->bones.at[b].name);
    if (above == SBFI_NAME_HINT_PROP || above == SBFI_NAME_HINT_FACE) says = above;
    if (above == SBFI_NAME_HINT_LIMB && says != SBFI_NAME_HINT_PROP) says = above;
  }
  return says;
}

/* Whether two bones are mirror images: left and right, with parts of similar size. */
static bool are_twins(const work *w, uint32_t a, uint32_t b) {
  const sbf_vec3 p = w->asset->bones.at[a].head, q = w->asset->bones.at[b].head;
  double near = NEAR_TWIN * w->size;
  const part *m = &w->parts[a], *n = &w->parts[b];
  return fabs((double)p.x) > 0.25 * near && fabs((double)p.x + (double)q.x) < near &&
         fabs((double)p.y - (double)q.y) < near && fabs((double)p.z - (double)q.z) < near &&
         fabs(m->area - n->area) < ALIKE * (m->area + n->area) &&
         fabs(m->thickness - n->thickness) < ALIKE * (m->thickness + n->thickness);
}

/* Gives left and right one common measure, so that both become soft or neither. */
static void join_twins(const work *w) {
  for (uint32_t a = 0; a < w->asset->bones.count; a++)
    for (uint32_t b = a + 1; b < w->asset->bones.count; b++) {
      if (!is_part(w, a) || !is_part(w, b) || w->parts[a].twin || !are_twins(w, a, b)) continue;
      part *m = &w->parts[a], *n = &w->parts[b];
      m->twin = n->twin = true;
      m->area = n->area = (m->area + n->area) / 2;
      m->thickness = n->thickness = (m->thickness + n->thickness) / 2;
      m->lowest = n->lowest = fmin(m->lowest, n->lowest);
      break;
    }
}

static bool swings(const sbf_asset *asset, uint32_t bone) {
  for (uint32_t i = 0; i < asset->chains.count; i++)
    for (uint32_t k = 0; asset->chains.at[i].spring && k < asset->chains.at[i].bones.count; k++)
      if (asset->chains.at[i].bones.at[k] == bone) return true;
  return false;
}

static reason by_kind(const work *w, uint32_t bone) {
  const sbf_asset *asset = w->asset;
  sbfi_name_hint says = name_hint(asset, (int32_t)bone);
  const part *p = &w->parts[bone];
  if (says == SBFI_NAME_HINT_PROP || says == SBFI_NAME_HINT_MACHINE) return PROP;
  if (p->hard_area > HARD_FRACTION * p->area) return HARD_MATERIAL;
  if (says == SBFI_NAME_HINT_FACE || is_face(asset, (int32_t)bone)) return FACE;
  if (says == SBFI_NAME_HINT_LIMB || is_lower_leg(w, (int32_t)bone)) return LIMB;
  if (swings(asset, bone)) return SWINGING;
  if (p->area < MIN_AREA * w->area) return SMALL;
  return p->thickness < SHEET_THICKNESS * w->size ? THIN : SOFT;
}

static bool is_called_machine(const work *w) {
  if (w->asset->gaits.count && w->asset->gaits.at[0].kind == SBF_GAIT_KIND_ROLL) return true;
  bool says = sbfi_words_of_name(w->asset->info.title) == SBFI_NAME_HINT_MACHINE;
  for (uint32_t m = 0; m < w->asset->render_meshes.count && !says; m++)
    says = sbfi_words_of_name(w->asset->render_meshes.at[m].name) == SBFI_NAME_HINT_MACHINE;
  return says;
}

static bool is_machine(const work *w) {
  double joined = w->joining_area / w->area;
  if (w->skin.single_fraction >= MACHINE_SINGLE && joined < MACHINE_JOINED) return true;
  if (w->skin.single_fraction >= PIECES_SINGLE && joined < PIECES_JOINED) return true;
  return is_called_machine(w);
}

static void check_thickness(work *w) {
  for (uint32_t b = 0; b < w->asset->bones.count; b++)
    if (is_part(w, b) && w->parts[b].why == SOFT) w->thickest = fmax(w->thickest, w->parts[b].thickness);
  double bound = fmin(MIN_THICKNESS * w->size, SLENDER_THICKNESS * w->thickest);
  for (uint32_t b = 0; b < w->asset->bones.count; b++) {
    if (!is_part(w, b) || w->parts[b].why != SOFT) continue;
    bool named = sbfi_words_of_name(w->asset->bones.at[b].name) == SBFI_NAME_HINT_SOFT;
    if (w->parts[b].thickness < (named ? NAMED_THICKNESS * bound : bound)) w->parts[b].why = THIN;
  }
}

/* Visibility of a part's deformation. */
static double visibility(const part *p) {
  return p->thickness * p->thickness * p->area;
}

/* Keeps the most visible parts. Equally visible parts, such as left and right, are kept or dropped
 * together. */
static void select_largest(const work *w) {
  double bound = 0;
  for (uint32_t b = 0; b < w->asset->bones.count; b++) {
    uint32_t larger = 0;
    if (!is_part(w, b) || w->parts[b].why != SOFT) continue;
    for (uint32_t o = 0; o < w->asset->bones.count; o++)
      larger +=
          is_part(w, o) && w->parts[o].why == SOFT && visibility(&w->parts[o]) > visibility(&w->parts[b]);
    if (larger >= MAX_SOFT) bound = fmax(bound, visibility(&w->parts[b]));
  }
  for (uint32_t b = 0; b < w->asset->bones.count; b++)
    if (is_part(w, b) && w->parts[b].why == SOFT && visibility(&w->parts[b]) <= bound)
      w->parts[b].why = NOT_AMONG_LARGEST;
}

/* ---- Options of the caller ---- */

static sbf_status apply_requests(work *w, const char *const *names, uint32_t count, reason why) {
  for (uint32_t i = 0; i < count; i++) {
    uint32_t found = 0;
    for (uint32_t b = 0; b < w->asset->bones.count; b++) {
      const sbf_bone *bone = &w->asset->bones.at[b];
      if (strcmp(names[i], "*") != 0 && strcmp(bone->name, names[i]) != 0 && strcmp(bone->id, names[i]) != 0)
        continue;
      found++;
      uint32_t owner = w->skin.owners[b];
      if (owner == SBFI_NO_INDEX) continue;
      w->parts[owner].why = why;
      w->parts[owner].is_requested = true;
    }
    for (uint32_t b = 0; b < w->asset->soft_bodies.count; b++)
      found += strcmp(w->asset->soft_bodies.at[b].name, names[i]) == 0;
    if (!found)
      return sbfi_diagnose(w->c->error, SBF_CODE_IMPORT_PIN_UNKNOWN,
          "no bone, and no object attached to a bone, has the name '%s', which should be %s: sbfmt info "
          "lists the bones",
          names[i], why == SOFT ? "soft" : "rigid");
  }
  return SBF_OK;
}

/* ---- Outcome ---- */

static double rounded(double value) {
  double unit = 1;
  while (value / unit >= 100) unit *= 10;
  while (value / unit < 10) unit /= 10;
  return round(value / unit) * unit;
}

/* Buoyancy supports the tissue of swimmers. */
static bool is_buoyant(const sbf_asset *a) {
  return a->gaits.count && a->gaits.at[0].proposed && a->gaits.at[0].kind == SBF_GAIT_KIND_SWIM;
}

static bool write_recipes(const work *w) {
  uint32_t count = 0;
  sbf_section_recipe *recipes =
      sbfi_convert_allocate(w->c, (size_t)w->asset->bones.count + 1, sizeof *recipes);
  if (!recipes) return false;
  for (uint32_t b = 0; b < w->asset->bones.count; b++) {
    if (!is_part(w, b)) continue;
    sbf_section_recipe *recipe = &recipes[count++];
    sbf_section_recipe_init(recipe);
    recipe->bone = (int32_t)b;
    recipe->proposed = !w->parts[b].is_requested;
    recipe->rigid = w->parts[b].why != SOFT;
    recipe->attributes.young_modulus = (float)w->modulus;
    recipe->attributes.sag_free = true;
    if (is_buoyant(w->asset)) recipe->attributes.gravity_scale = 0;
    /* Parts of low walkers must not drag on the ground. */
    if (leg_count(w->asset) && w->parts[b].lowest < LOW_LEG * w->size) recipe->attributes.friction = 0;
  }
  w->c->asset->section_recipes = (sbf_section_recipe_list){count ? recipes : NULL, count};
  return true;
}

static void report(const work *w) {
  char soft[NAMES_SIZE] = "", left[NAMES_SIZE] = "";
  uint32_t counts[REASON_COUNT] = {0}, all = 0;
  size_t length = 0;
  for (uint32_t b = 0; b < w->asset->bones.count; b++) {
    if (!is_part(w, b)) continue;
    all++;
    if (counts[w->parts[b].why]++ >= MAX_SOFT || w->parts[b].why != SOFT) continue;
    length += (size_t)snprintf(soft + length, length < sizeof soft ? sizeof soft - length : 0, "%s%.24s",
        counts[SOFT] > 1 ? ", " : "", w->asset->bones.at[b].name);
  }
  length = 0;
  for (int i = 1; i < REASON_COUNT; i++)
    if (counts[i] && length < sizeof left)
      length += (size_t)snprintf(left + length, sizeof left - length, "%s%u %s", length ? ", " : "",
          (unsigned)counts[i], reason_texts[i]);
  if (counts[SOFT] == 0)
    sbfi_convert_warn(w->c, SBF_CODE_SOFTNESS_PROPOSED,
        "nothing is soft: all %u parts of the skin move with their bones (%s); use --soft BONE to make one "
        "soft",
        (unsigned)all, left);
  else
    sbfi_convert_warn(w->c, SBF_CODE_SOFTNESS_PROPOSED,
        "%u of %u parts of the skin are soft, with a modulus of %.4g kPa: %s%s%s%s; change this with "
        "--firmness, --soft and --rigid",
        (unsigned)counts[SOFT], (unsigned)all, 1e-3 * w->modulus, soft,
        left[0] ? "; these move with their bones: " : "", left, "");
}

/* ---- Objects on bones ---- */

static bool is_wanted_soft(const work *w, const sbf_soft_body *body) {
  const sbf_convert_options *o = w->c->options;
  const sbf_bone *bone = &w->asset->bones.at[body->bone];
  for (uint32_t i = 0; i < o->softness.soft_count; i++)
    if (strcmp(o->softness.soft[i], "*") == 0 || strcmp(o->softness.soft[i], bone->name) == 0 ||
        strcmp(o->softness.soft[i], bone->id) == 0 || strcmp(o->softness.soft[i], body->name) == 0)
      return true;
  return body->pins.count > 0 || body->attachments.count > 0;
}

/* Uses the object as the hull of the bone's rigid body, unless a part of a skin provides one. */
static bool add_hull(const work *w, const sbf_soft_body *body) {
  const sbf_rigid_body_list *all = &w->asset->rigid_bodies;
  if (is_part(w, (uint32_t)body->bone)) return true;
  for (uint32_t i = 0; i < all->count; i++) {
    sbf_rigid_body *rigid = (sbf_rigid_body *)(uintptr_t)&all->at[i]; /* an earlier pass created it */
    if (rigid->bone != body->bone || rigid->hull) continue;
    sbf_polygon_mesh *hull = sbfi_convert_allocate(w->c, 1, sizeof *hull);
    if (!hull) return false;
    switch (sbfi_hull_make(
        body->surface.positions.at, body->surface.positions.count, w->c->asset, hull, &w->c->scratch)) {
    case SBFI_HULL_NO_MEMORY:
      return false;
    case SBFI_HULL_MADE:
      rigid->hull = hull;
      break;
    case SBFI_HULL_FLAT:
      break;
    }
  }
  return true;
}

/* Area of objects on bones, m^2. */
static double area_of_objects(const work *w) {
  double sum = 0;
  for (uint32_t i = 0; i < w->asset->soft_bodies.count; i++) {
    sbf_surface_measures measures;
    if (w->asset->soft_bodies.at[i].bone == SBF_NONE) continue;
    sbf_surface_measure(&w->asset->soft_bodies.at[i].surface, NULL, &measures);
    sum += measures.area;
  }
  return sum;
}

/* If objects make up much of the visible area, they are the sections of the character, unless its name is
 * that of a machine. Otherwise objects on bones of a skinned character are props: they are drawn but not
 * simulated. */
static bool make_props_rigid(const work *w) {
  /* the conversion owns the asset */
  sbf_soft_body *bodies = (sbf_soft_body *)(uintptr_t)w->asset->soft_bodies.at;
  uint32_t kept = 0, count = w->asset->soft_bodies.count;
  if (!is_called_machine(w) && area_of_objects(w) > PROP_AREA * w->area) return true;
  for (uint32_t i = 0; i < count; i++) {
    if (bodies[i].bone == SBF_NONE || is_wanted_soft(w, &bodies[i]))
      bodies[kept++] = bodies[i];
    else if (!add_hull(w, &bodies[i]))
      return false;
  }
  w->c->asset->soft_bodies.count = kept;
  if (kept == count) return true;
  sbfi_convert_warn(w->c, SBF_CODE_SOFTNESS_PROPOSED,
      "%u object%s attached to bones of the skinned character move%s rigidly with them; use --soft BONE to "
      "make one soft",
      (unsigned)(count - kept), count - kept == 1 ? "" : "s", count - kept == 1 ? "s" : "");
  return true;
}

static sbf_status decide(work *w) {
  const sbf_convert_options *o = w->c->options;
  measure(w);
  if (!measure_vertices(w)) return sbfi_convert_no_memory(w->c);
  bool machine = is_machine(w);
  join_twins(w);
  for (uint32_t b = 0; b < w->asset->bones.count; b++) w->parts[b].why = machine ? MACHINE : by_kind(w, b);
  check_thickness(w);
  select_largest(w);
  sbf_status status = apply_requests(w, o->softness.soft, o->softness.soft_count, SOFT);
  if (status == SBF_OK) status = apply_requests(w, o->softness.rigid, o->softness.rigid_count, ASKED);
  if (status != SBF_OK) return status;
  sbf_attributes usual;
  sbf_attributes_init(&usual);
  double firmness = o->softness.firmness > 0 ? o->softness.firmness : 1, thick = w->thickest / w->size;
  double thin = fmin(thick / MIN_USUAL, 1), over = fmax(thick / MAX_USUAL, 1);
  double ratio = MODULUS_RATIO * fmax(thin * thin, MIN_RATIO) * over * over;
  w->modulus = rounded(firmness * ratio * (double)usual.density * GRAVITY * w->size);
  if (!write_recipes(w) || !make_props_rigid(w)) return sbfi_convert_no_memory(w->c);
  report(w);
  return SBF_OK;
}

sbf_status sbfi_propose_softness(sbfi_conversion *c) {
  work w = {.c = c, .asset = c->asset};
  if (c->asset->section_recipes.count) return SBF_OK;
  if (!sbfi_skin_parts_measure(&w.skin, c->asset, &c->scratch)) return sbfi_convert_no_memory(c);
  w.size = size_of(c->asset);
  if (!w.skin.at || !(w.size > 0) || !(w.size < 1e9)) return SBF_OK;
  w.parts = sbfi_arena_allocate(&c->scratch, (size_t)c->asset->bones.count + 1, sizeof *w.parts);
  return w.parts ? decide(&w) : sbfi_convert_no_memory(c);
}
