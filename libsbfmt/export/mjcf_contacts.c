/* Selects contact pairs. As in the runtime, related parts do not collide: bodies at a joint, soft tissue and
 * its holder, a section and kinematic bodies, sections in contact at rest, and parts that overlap at rest,
 * which MuJoCo would separate at hundreds of metres per second.
 *
 * `exclude` separates bodies, but flexes only have bits. Bit 0 is for objects of the host (a plane's
 * default), bit 1 for all hulls, the others for one flex each; if there are too many, the last flexes
 * share one bit and collide with the union of their partners. */
#include <math.h>

#include "export/mjcf.h"
#include "mechanics/polygon.h"

enum { FIRST_CLASS_BIT = 2, CLASSES = 31 - FIRST_CLASS_BIT, DIRECTIONS = 13 };

#define HOST_BIT 1u
#define HULL_BIT 2u
/* Minimum overlap as a fraction of the smaller one's smallest width; less counts as contact. */
#define SUNK_FRACTION 0.01f

struct mjcf_extent {
  const sbf_vec3 *points;
  uint32_t count;
  float min[DIRECTIONS], max[DIRECTIONS]; /* m, along each direction */
};
typedef struct mjcf_extent extent;

static float along(sbf_vec3 p, sbf_vec3 n) {
  return p.x * n.x + p.y * n.y + p.z * n.z;
}

static void range_along(const extent *e, sbf_vec3 n, float *min, float *max) {
  *min = INFINITY, *max = -INFINITY;
  for (uint32_t i = 0; i < e->count; i++) {
    float at = along(e->points[i], n);
    if (at < *min) *min = at;
    if (at > *max) *max = at;
  }
}

/* Axes, and the diagonals of a cube's faces and of the cube. */
static sbf_vec3 direction(int k) {
  static const signed char of[DIRECTIONS][3] = {{1, 0, 0}, {0, 1, 0}, {0, 0, 1}, {1, 1, 0}, {1, -1, 0},
      {1, 0, 1}, {1, 0, -1}, {0, 1, 1}, {0, 1, -1}, {1, 1, 1}, {1, 1, -1}, {1, -1, 1}, {-1, 1, 1}};
  const signed char *d = of[k];
  float length = sqrtf((float)(d[0] * d[0] + d[1] * d[1] + d[2] * d[2]));
  return (sbf_vec3){d[0] / length, d[1] / length, d[2] / length};
}

static extent extent_of(const sbf_vec3 *points, uint32_t count) {
  extent e = {.points = points, .count = count};
  for (int k = 0; k < DIRECTIONS; k++) range_along(&e, direction(k), &e.min[k], &e.max[k]);
  return e;
}

static float min_width(const extent *e) {
  float width = INFINITY;
  for (int k = 0; k < DIRECTIONS; k++) width = fminf(width, e->max[k] - e->min[k]);
  return width;
}

static float sunk_depth(const extent *a, const extent *b) {
  return SUNK_FRACTION * fminf(min_width(a), min_width(b));
}

/* Whether some face of the hull is separated by `gap` from all of the other's points. */
static bool is_outside(const sbf_polygon_mesh *hull, const extent *other, float gap) {
  for (uint32_t i = 0, corner = 0; i < hull->polygon_sizes.count; i++) {
    const uint32_t *points = hull->polygon_points.at + corner, size = hull->polygon_sizes.at[i];
    sbfi_d3 middle = sbfi_polygon_middle(hull->positions.at, points, size);
    sbfi_d3 area = sbfi_polygon_area(hull->positions.at, points, size, middle);
    double length = sbfi_d3_length(area);
    corner += size;
    if (!(length > 0)) continue;
    sbf_vec3 n = {(float)(area.x / length), (float)(area.y / length), (float)(area.z / length)};
    sbf_vec3 at = {(float)middle.x, (float)middle.y, (float)middle.z};
    float min, max;
    range_along(other, n, &min, &max);
    if (min - along(at, n) > gap) return true;
  }
  return false;
}

/* Whether two parts at rest are farther apart than `gap` (negative: overlap less than that). Hulls: NULL
 * for a flex. May return false for separated parts. */
static bool are_separated(const extent *a, const sbf_polygon_mesh *hull_a, const extent *b,
    const sbf_polygon_mesh *hull_b, float gap) {
  for (int k = 0; k < DIRECTIONS; k++)
    if (fmaxf(a->min[k] - b->max[k], b->min[k] - a->max[k]) > gap) return true;
  return (hull_a && is_outside(hull_a, b, gap)) || (hull_b && is_outside(hull_b, a, gap));
}

static bool layers_collide(uint32_t layer_a, uint32_t mask_a, uint32_t layer_b, uint32_t mask_b) {
  return (layer_a & mask_b) && (layer_b & mask_a);
}

static bool is_kinematic(const sbf_asset *asset, uint32_t body) {
  return asset->rigid_bodies.at[body].motion == SBF_BODY_MOTION_KINEMATIC;
}

static bool has_hull(const sbf_rigid_body *body) {
  return body->hull && body->hull->positions.count >= 4;
}

/* ---- Flexes ---- */

static bool is_point_pinned(const mjcf_flex *flex) {
  return flex->level->pins.count > 0;
}

static bool flexes_collide(const mjcf_flex *a, const extent *of_a, const mjcf_flex *b, const extent *of_b) {
  const sbf_collision *ca = &a->body->collision, *cb = &b->body->collision;
  if (!layers_collide(ca->layer, ca->mask, cb->layer, cb->mask)) return false;
  float gap = is_point_pinned(a) && is_point_pinned(b) ? ca->particle_radius + cb->particle_radius
                                                       : -sunk_depth(of_a, of_b);
  return are_separated(of_a, NULL, of_b, NULL, gap);
}

static bool flex_collides_with_hull(const mjcf_writer *w, const mjcf_flex *flex, const extent *of_flex,
    uint32_t body, const extent *of_body) {
  const sbf_rigid_body *rigid = &w->e->asset->rigid_bodies.at[body];
  const sbf_collision *c = &flex->body->collision;
  if (!layers_collide(c->layer, c->mask, rigid->layer, rigid->mask)) return false;
  if (is_point_pinned(flex) && is_kinematic(w->e->asset, body)) return false;
  for (uint32_t s = 0; s < flex->level->pins.count; s++)
    if (flex->level->pins.at[s].rigid_body == (int32_t)body) return false;
  float gap =
      is_point_pinned(flex) ? c->particle_radius : -fmaxf(c->particle_radius, sunk_depth(of_flex, of_body));
  return are_separated(of_flex, NULL, of_body, rigid->hull, gap);
}

static uint32_t class_of(uint32_t flex) {
  return flex < CLASSES ? flex : CLASSES - 1;
}

static uint32_t class_bit(uint32_t flex) {
  return 1u << (class_of(flex) + FIRST_CLASS_BIT);
}

static uint32_t host_bit(uint32_t layer, uint32_t mask) {
  return layer && mask ? HOST_BIT : 0;
}

static void sort_flexes(mjcf_writer *w, const extent *softs, const extent *rigids) {
  const sbf_asset *asset = w->e->asset;
  uint32_t collides[CLASSES], all = 0;
  for (uint32_t i = 0; i < asset->soft_bodies.count; i++)
    if (w->flexes[i].level) all |= class_bit(i);
  for (uint32_t k = 0; k < CLASSES; k++) collides[k] = all & ~class_bit(k);
  for (uint32_t b = 0; b < asset->rigid_bodies.count; b++) w->rigid.hull_partners[b] = all;
  for (uint32_t i = 0; i < asset->soft_bodies.count; i++) {
    if (!w->flexes[i].level) continue;
    w->unsupported.sharing += i >= CLASSES;
    for (uint32_t j = 0; j < i; j++) {
      if (!w->flexes[j].level || flexes_collide(&w->flexes[i], &softs[i], &w->flexes[j], &softs[j])) continue;
      collides[class_of(i)] &= ~class_bit(j);
      collides[class_of(j)] &= ~class_bit(i);
    }
    for (uint32_t b = 0; b < asset->rigid_bodies.count; b++)
      if (!has_hull(&asset->rigid_bodies.at[b]) ||
          !flex_collides_with_hull(w, &w->flexes[i], &softs[i], b, &rigids[b]))
        w->rigid.hull_partners[b] &= ~class_bit(i);
  }
  for (uint32_t i = 0; i < asset->soft_bodies.count; i++) {
    const sbf_collision *c = &asset->soft_bodies.at[i].collision;
    w->flexes[i].contact_type = c->layer && c->mask ? class_bit(i) : 0;
    w->flexes[i].contact_with = collides[class_of(i)] | host_bit(c->layer, c->mask);
  }
}

bool sbfi_mjcf_collect_contacts(mjcf_writer *w) {
  const sbf_asset *asset = w->e->asset;
  uint32_t bodies = asset->rigid_bodies.count, softs = asset->soft_bodies.count;
  extent *of_softs = sbfi_arena_allocate(&w->scratch, (size_t)softs + 1, sizeof *of_softs);
  w->rigid.hull_extents = sbfi_arena_allocate(&w->scratch, (size_t)bodies + 1, sizeof *w->rigid.hull_extents);
  w->rigid.hull_partners =
      sbfi_arena_allocate(&w->scratch, (size_t)bodies + 1, sizeof *w->rigid.hull_partners);
  w->rigid.jointed = sbfi_arena_allocate(&w->scratch, (size_t)bodies + 1, sizeof *w->rigid.jointed);
  if (!of_softs || !w->rigid.hull_extents || !w->rigid.hull_partners || !w->rigid.jointed) return false;
  for (uint32_t i = 0; i < softs; i++)
    if (w->flexes[i].level)
      of_softs[i] = extent_of(w->flexes[i].positions, w->flexes[i].level->positions.count);
  for (uint32_t i = 0; i < bodies; i++)
    if (has_hull(&asset->rigid_bodies.at[i]))
      w->rigid.hull_extents[i] = extent_of(
          asset->rigid_bodies.at[i].hull->positions.at, asset->rigid_bodies.at[i].hull->positions.count);
  sort_flexes(w, of_softs, w->rigid.hull_extents);
  return true;
}

static void write_bits(mjcf_writer *w, uint32_t type, uint32_t with) {
  sbfi_export_format(w->e, " contype=\"%u\" conaffinity=\"%u\"", type, with);
}

void sbfi_mjcf_flex_bits(mjcf_writer *w, const mjcf_flex *flex) {
  write_bits(w, flex->contact_type, flex->contact_with);
}

void sbfi_mjcf_hull_bits(mjcf_writer *w, uint32_t body) {
  const sbf_rigid_body *rigid = &w->e->asset->rigid_bodies.at[body];
  if (rigid->layer && rigid->mask)
    write_bits(w, HULL_BIT, HOST_BIT | HULL_BIT | w->rigid.hull_partners[body]);
  else
    write_bits(w, 0, 0);
}

/* ---- Hulls ---- */

static bool hulls_collide(const mjcf_writer *w, uint32_t a, uint32_t b) {
  const sbf_rigid_body *bodies = w->e->asset->rigid_bodies.at;
  const extent *of_a = &w->rigid.hull_extents[a], *of_b = &w->rigid.hull_extents[b];
  return layers_collide(bodies[a].layer, bodies[a].mask, bodies[b].layer, bodies[b].mask) &&
         are_separated(of_a, bodies[a].hull, of_b, bodies[b].hull, -sunk_depth(of_a, of_b));
}

static void write_exclude(mjcf_writer *w, uint32_t a, uint32_t b) {
  sbfi_text_string(&w->e->text, "    <exclude body1=\"");
  sbfi_mjcf_rigid_name(w, (int32_t)a);
  sbfi_text_string(&w->e->text, "\" body2=\"");
  sbfi_mjcf_rigid_name(w, (int32_t)b);
  sbfi_text_string(&w->e->text, "\"/>\n");
}

/* MuJoCo never lets two static or mocap bodies collide: these need no exclude. */
void sbfi_mjcf_write_excludes(mjcf_writer *w) {
  const sbf_asset *asset = w->e->asset;
  enum { MAY_COLLIDE = 1, JOINED = 2 };
  sbfi_text_string(&w->e->text, "  <contact>\n");
  for (uint32_t a = 0; a < asset->rigid_bodies.count; a++) {
    for (uint32_t b = a + 1; b < asset->rigid_bodies.count; b++) w->rigid.jointed[b] = 0;
    for (uint32_t j = 0; j < asset->joints.count; j++) {
      const sbf_joint *joint = &asset->joints.at[j];
      int32_t b = joint->body_a == (int32_t)a   ? joint->body_b
                  : joint->body_b == (int32_t)a ? joint->body_a
                                                : SBF_NONE;
      if (b > (int32_t)a) w->rigid.jointed[b] |= joint->collide ? MAY_COLLIDE : JOINED;
    }
    for (uint32_t b = a + 1; b < asset->rigid_bodies.count; b++) {
      bool is_separate = w->rigid.jointed[b] & JOINED;
      if (!w->rigid.jointed[b] && has_hull(&asset->rigid_bodies.at[a]) &&
          has_hull(&asset->rigid_bodies.at[b]) && !(is_kinematic(asset, a) && is_kinematic(asset, b)))
        is_separate = !hulls_collide(w, a, b);
      if (is_separate) write_exclude(w, a, b);
    }
  }
  sbfi_text_string(&w->e->text, "  </contact>\n");
}
