/* Warns about implausible sizes, because files often have a wrong unit or state none, and about objects that
 * are too far from the origin for their size, such as scans in the coordinates of a map. */
#include <float.h>
#include <math.h>

#include "import/convert/conversion.h"
#include "mechanics/plausible_size.h"

/* m; heights of people, whom files of motion capture contain */
static const double TALLEST = 3, USUAL = 1.75;
/* metres in a unit, as --unit takes them */
static const double MIN_UNIT = 1e-9, MAX_UNIT = 1e9;
/* multiple of the bones' extent; a loose object larger than that is no part of a character */
static const double SURROUNDINGS = 5;
/* fraction of an object's extent; coarser steps of its positions show */
static const double MAX_ROUNDING = 1e-3;

static double extent_of_bones(const sbf_bone_list *bones) {
  double low[3] = {INFINITY, INFINITY, INFINITY}, high[3] = {-INFINITY, -INFINITY, -INFINITY}, extent = 0;
  for (uint32_t i = 0; i < bones->count; i++) {
    const double head[3] = {bones->at[i].head.x, bones->at[i].head.y, bones->at[i].head.z};
    for (int k = 0; k < 3; k++) {
      low[k] = fmin(low[k], head[k]);
      high[k] = fmax(high[k], head[k]);
      extent = fmax(extent, high[k] - low[k]);
    }
  }
  return extent;
}

/* Bones without a mesh, which use many units. */
static void check_bones(sbfi_conversion *c) {
  double size = extent_of_bones(&c->asset->bones);
  if (c->scene->unit_known || !(size > TALLEST)) return;
  sbfi_convert_warn(c, SBF_CODE_UNIT_LOOKS_WRONG,
      "the bones measure %.4g m with the assumed unit of %.4g m: if they are a person's, use --unit %.3g, "
      "which makes them %.4g m; if the size is right, confirm it with --unit %.3g",
      size, c->scene->unit_m, c->scene->unit_m * USUAL / size, USUAL, c->scene->unit_m);
}

/* Unit in use, m, with which so many of them are nearest to a person's height. */
static double unit_of_person(double units) {
  static const double in_use[] = {1, 0.3048, 0.1, 0.0254, 0.01, 0.001};
  double best = 1;
  for (size_t i = 0; i < sizeof in_use / sizeof *in_use; i++)
    if (fabs(log(in_use[i] * units / USUAL)) < fabs(log(best * units / USUAL))) best = in_use[i];
  return best;
}

/* A mesh on the bones of a file of motion capture, neither of which states a unit: the bones were scaled to
 * the mesh, so the unit of the mesh alone matters. */
static void check_person(sbfi_conversion *c, double size) {
  double of_rig = cbrt(fabs(sbfi_matrix_determinant(&c->rig_to_asset))), unit_m = c->scene->unit_m;
  double unit = unit_of_person(size / unit_m), bones = extent_of_bones(&c->asset->bones) / of_rig;
  sbfi_convert_warn(c, SBF_CODE_UNIT_LOOKS_WRONG,
      "the input measures %.4g of its units, the bones of %s measure %.4g of theirs, and neither file states "
      "a unit: if they are a person's, use --unit %.4g for the input, which makes it %.4g m; if the size is "
      "right, confirm it with --unit %.3g",
      size / unit_m, c->rig_file->file, bones, unit, unit * size / unit_m, unit_m);
}

/* Greatest extent along an axis, and greatest coordinate of either sign. */
typedef struct region {
  double extent, distance;
} region;

static region region_of(const sbf_vec3_list *points) {
  region r = {0, 0};
  for (int k = 0; k < 3; k++) {
    double low = INFINITY, high = -INFINITY;
    for (uint32_t i = 0; i < points->count; i++) {
      const double at[3] = {(double)points->at[i].x, (double)points->at[i].y, (double)points->at[i].z};
      low = fmin(low, at[k]);
      high = fmax(high, at[k]);
    }
    r.extent = fmax(r.extent, high - low);
    if (points->count) r.distance = fmax(r.distance, fmax(fabs(low), fabs(high)));
  }
  return r;
}

static double extent_of_mesh(const sbf_render_mesh *mesh) {
  return region_of(&mesh->mesh.positions).extent;
}

static void check_distance(sbfi_conversion *c, const char *name, const sbf_vec3_list *points) {
  const region r = region_of(points);
  double distance = fmax(r.distance, c->moved_m), step = distance * (double)FLT_EPSILON;
  if (!(step > MAX_ROUNDING * r.extent) || r.extent == 0) return;
  sbfi_convert_warn(c, SBF_CODE_IMPORT_FAR,
      "object '%s' lies %.4g m from the origin, where single precision has steps of %.2g m, %.2g %% of its "
      "size of %.4g m: move it to the origin in its program",
      name, distance, step, 100 * step / r.extent, r.extent);
}

static void check_distances(sbfi_conversion *c) {
  const sbf_asset *a = c->asset;
  for (uint32_t i = 0; i < a->render_meshes.count; i++)
    check_distance(c, a->render_meshes.at[i].name, &a->render_meshes.at[i].mesh.positions);
  for (uint32_t i = 0; i < a->soft_bodies.count && !a->render_meshes.count; i++)
    check_distance(c, a->soft_bodies.at[i].name, &a->soft_bodies.at[i].surface.positions);
}

/* The size of a floor beside a character gives no hint about its unit. True if there is one. */
static bool check_surroundings(sbfi_conversion *c, double size) {
  const sbf_asset *a = c->asset;
  double bones = extent_of_bones(&a->bones);
  const sbf_render_mesh *largest = NULL;
  if (!(bones > 0) || sbfi_plausible_scale(bones) != 1 || !(size > SURROUNDINGS * bones)) return false;
  for (uint32_t i = 0; i < a->render_meshes.count; i++) {
    const sbf_render_mesh *mesh = &a->render_meshes.at[i];
    if (!mesh->skin && mesh->bone == SBF_NONE && (!largest || extent_of_mesh(mesh) > extent_of_mesh(largest)))
      largest = mesh;
  }
  if (!largest || !(extent_of_mesh(largest) > SURROUNDINGS * bones)) return false;
  sbfi_convert_warn(c, SBF_CODE_UNIT_LOOKS_WRONG,
      "object '%s' measures %.4g m, the bones measure %.4g m, and the object becomes a separate body: remove "
      "it from the file if it is a floor or another thing around the character",
      largest->name, extent_of_mesh(largest), bones);
  return true;
}

/* What no --unit gives, because the option has bounds. */
static void report_size(sbfi_conversion *c, double size, double scale) {
  double unit_m = c->scene->unit_m, unit = unit_m * scale;
  const char *source = c->scene->unit_known ? "the form or the file says" : "is assumed";
  if (unit >= MIN_UNIT && unit <= MAX_UNIT)
    sbfi_convert_warn(c, SBF_CODE_UNIT_LOOKS_WRONG,
        "the whole input measures %.4g m with a unit of %.4g m, as %s: use --unit %.3g, which makes it %.4g "
        "m, or confirm the size with --unit %.3g",
        size, unit_m, source, unit, size * scale, unit_m);
  else
    sbfi_convert_warn(c, SBF_CODE_UNIT_LOOKS_WRONG,
        "the whole input measures %.4g m with a unit of %.4g m, as %s: scale it in its program, because no "
        "--unit gives it the size of a character",
        size, unit_m, source);
}

void sbfi_check_size(sbfi_conversion *c) {
  double size = sbfi_asset_extent(c->asset), scale = sbfi_plausible_scale(size);
  bool bare_rig = c->rig_file && !c->rig_file->unit_known && c->rig_file->mesh_count == 0;
  check_distances(c);
  if (c->options->unit_m > 0) return; /* the user is trusted */
  if (scale == 1 && c->scene->mesh_count == 0) {
    check_bones(c);
  } else if (bare_rig && !c->scene->unit_known && size > TALLEST) {
    check_person(c, size);
  } else if (scale != 1 && !check_surroundings(c, size)) {
    report_size(c, size, scale);
  }
}
