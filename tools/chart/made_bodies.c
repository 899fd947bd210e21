#include "chart/made_bodies.h"

#include <math.h>

#include "base/fault.h"

enum { MAX_POINTS = 4096 };

/* A surface under construction. */
typedef struct skin_draft {
  sbf_asset *asset;
  sbf_vec3 *points;
  uint32_t *sizes, *corners, *pinned;
  uint32_t point_count, polygon_count, corner_count, pinned_count;
} skin_draft;

static bool begin(skin_draft *s) {
  *s = (skin_draft){.asset = sbf_asset_create(NULL)};
  if (!s->asset) return false;
  s->points = sbf_asset_allocate(s->asset, MAX_POINTS, sizeof *s->points);
  s->sizes = sbf_asset_allocate(s->asset, 2 * MAX_POINTS, sizeof *s->sizes);
  s->corners = sbf_asset_allocate(s->asset, 8 * MAX_POINTS, sizeof *s->corners);
  s->pinned = sbf_asset_allocate(s->asset, MAX_POINTS, sizeof *s->pinned);
  if (s->points && s->sizes && s->corners && s->pinned) return true;
  sbf_asset_free(s->asset);
  return false;
}

static void add_polygon(skin_draft *s, const uint32_t *corners, uint32_t count) {
  s->sizes[s->polygon_count++] = count;
  for (uint32_t i = 0; i < count; i++) s->corners[s->corner_count++] = corners[i];
}

static sbf_asset *finish(skin_draft *s, const chart_matter *matter) {
  sbf_soft_body *body = sbf_asset_allocate(s->asset, 1, sizeof *body);
  sbf_pin_set *pins = sbf_asset_allocate(s->asset, 1, sizeof *pins);
  if (!body || !pins) {
    sbf_asset_free(s->asset);
    return NULL;
  }
  sbf_soft_body_init(body), sbf_pin_set_init(pins);
  body->id = "body";
  body->surface.positions = (sbf_vec3_list){s->points, s->point_count};
  body->surface.polygon_sizes = (sbf_u32_list){s->sizes, s->polygon_count};
  body->surface.polygon_points = (sbf_u32_list){s->corners, s->corner_count};
  body->attributes.density = matter->density;
  body->attributes.young_modulus = matter->young_modulus;
  body->attributes.poisson_ratio = matter->poisson_ratio;
  body->attributes.damping_ratio = matter->damping_ratio;
  pins->points = (sbf_u32_list){s->pinned, s->pinned_count};
  body->pins = (sbf_pin_set_list){pins, s->pinned_count ? 1 : 0};
  s->asset->soft_bodies = (sbf_soft_body_list){body, 1};
  return s->asset;
}

/* ---- The bar ---- */

enum { ALONG = 20, ACROSS = 4 };

/* Index of the point at grid position (i, j, k) of the bar's surface; created at the first use. */
static uint32_t bar_point(skin_draft *s, uint32_t *numbers, const uint32_t at[3]) {
  uint32_t *number = &numbers[(at[0] * (ACROSS + 1) + at[1]) * (ACROSS + 1) + at[2]];
  if (*number) return *number - 1;
  s->points[s->point_count] = (sbf_vec3){
      (float)at[0] / ALONG, 0.2f * ((float)at[1] / ACROSS - 0.5f), 0.2f * ((float)at[2] / ACROSS - 0.5f)};
  if (at[0] == 0) s->pinned[s->pinned_count++] = s->point_count;
  *number = ++s->point_count;
  return *number - 1;
}

static void add_side(skin_draft *s, uint32_t *numbers, int axis, bool high) {
  static const uint32_t counts[3] = {ALONG, ACROSS, ACROSS};
  static const uint32_t square[4][2] = {{0, 0}, {1, 0}, {1, 1}, {0, 1}};
  int u = (axis + 1) % 3, v = (axis + 2) % 3;
  for (uint32_t i = 0; i < counts[u]; i++)
    for (uint32_t j = 0; j < counts[v]; j++) {
      uint32_t corners[4], at[3];
      for (int c = 0; c < 4; c++) {
        const uint32_t *corner = square[high ? c : 3 - c];
        at[axis] = high ? counts[axis] : 0, at[u] = i + corner[0], at[v] = j + corner[1];
        corners[c] = bar_point(s, numbers, at);
      }
      add_polygon(s, corners, 4);
    }
}

sbf_asset *chart_bar(const chart_matter *matter) {
  uint32_t numbers[(ALONG + 1) * (ACROSS + 1) * (ACROSS + 1)] = {0};
  skin_draft s;
  if (!begin(&s)) return NULL;
  for (int axis = 0; axis < 3; axis++) add_side(&s, numbers, axis, false), add_side(&s, numbers, axis, true);
  return finish(&s, matter);
}

/* ---- Ellipsoids ---- */

/* Rings from the bottom to the top; points above `pinned_from` are pinned. */
static void add_ellipsoid(
    skin_draft *s, sbf_vec3 middle, sbf_vec3 radii, uint32_t rings, uint32_t sides, float pinned_from) {
  static const double pi = 3.14159265358979323846;
  uint32_t first = s->point_count;
  for (uint32_t r = 0; r <= rings; r++) {
    double up = pi * r / rings, wide = sin(up);
    for (uint32_t k = 0; k < (r == 0 || r == rings ? 1 : sides); k++) {
      double turn = 2 * pi * k / sides;
      sbf_vec3 p = {middle.x + radii.x * (float)(wide * cos(turn)), middle.y - radii.y * (float)cos(up),
          middle.z + radii.z * (float)(wide * sin(turn))};
      if (p.y > pinned_from) s->pinned[s->pinned_count++] = s->point_count;
      s->points[s->point_count++] = p;
    }
  }
  uint32_t last = s->point_count - 1;
  for (uint32_t k = 0; k < sides; k++) {
    uint32_t next = (k + 1) % sides;
    add_polygon(s, (const uint32_t[]){first, first + 1 + k, first + 1 + next}, 3);
    for (uint32_t r = 0; r + 2 < rings; r++) {
      uint32_t low = first + 1 + r * sides, high = low + sides;
      add_polygon(s, (const uint32_t[]){low + k, high + k, high + next, low + next}, 4);
    }
    add_polygon(s, (const uint32_t[]){last, last - sides + next, last - sides + k}, 3);
  }
}

sbf_asset *chart_ball(float radius_m, const chart_matter *matter) {
  skin_draft s;
  if (!begin(&s)) return NULL;
  add_ellipsoid(&s, (sbf_vec3){0, 0, 0}, (sbf_vec3){radius_m, radius_m, radius_m}, 12, 16, INFINITY);
  return finish(&s, matter);
}

sbf_asset *chart_figure(const chart_matter *matter) {
  static const float none = 1e9f;
  skin_draft s;
  if (!begin(&s)) return NULL;
  add_ellipsoid(&s, (sbf_vec3){0, 0.55f, 0}, (sbf_vec3){0.17f, 0.26f, 0.13f}, 12, 16, none);
  add_ellipsoid(&s, (sbf_vec3){0, 0.87f, 0}, (sbf_vec3){0.11f, 0.13f, 0.11f}, 10, 14, 0.9f);
  for (int side = -1; side <= 1; side += 2) {
    float x = (float)side;
    add_ellipsoid(&s, (sbf_vec3){0.28f * x, 0.66f, 0}, (sbf_vec3){0.2f, 0.065f, 0.065f}, 10, 12, none);
    add_ellipsoid(&s, (sbf_vec3){0.1f * x, 0.19f, 0}, (sbf_vec3){0.075f, 0.2f, 0.08f}, 12, 12, none);
  }
  return finish(&s, matter);
}

sbf_status chart_fill(
    sbf_asset *surface, const chart_filling *filling, sbf_asset **filled, sbf_diagnostic *error) {
  const sbf_build_options options = {.interior = filling->interior,
      .elements = filling->elements,
      .cell_m = filling->interior == SBF_BUILD_INTERIOR_LATTICE ? filling->spring_m : 0,
      .without_calibration = !filling->calibrated};
  *filled = NULL;
  if (!surface) return fault_set(error, SBF_CODE_OUT_OF_MEMORY, "memory ran out for a body to chart");
  sbf_status status = sbf_build(surface, &options, filled, NULL, error);
  sbf_asset_free(surface);
  return status;
}
