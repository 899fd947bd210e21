/* Shape casts: sbrun/query.h. */
#include "math/usable.h"
#include "shapes/ground.h"
#include "world/query/query_targets.h"

enum { MAX_HOST_ADVANCES = 256, MAX_GROUND_PARTS = 256 };
/* m: distance of contact with a host's geometry; and the length of a part of a cast over uneven ground. */
static const double HOST_CONTACT_M = 1e-4, GROUND_PART_M = 0.5;
/* m; hits closer than this count as equally distant */
static const double SAME_M = 5e-6;

typedef struct cast {
  sbri_convex shape; /* at the origin of the query */
  sbfi_d3 displacement;
  double fraction;  /* of the nearest hit so far; above 1: none */
  double alignment; /* cosine between its normal and that of its triangle; 1: no triangle */
  sbri_closest contact;
  sbr_object object;
} cast;

/* Of triangles that are hit at the same distance, keeps the one below the contact, not one beside it. */
static void note(cast *c, const sbri_query_piece *piece, double fraction, const sbri_closest *contact) {
  bool is_triangle = piece->kind == SBRI_PIECE_CONVEX && sbfi_d3_dot(piece->normal, piece->normal) > 0;
  double alignment = is_triangle ? sbfi_d3_dot(piece->normal, contact->normal) : 1;
  double slack = SAME_M / sbfi_d3_length(c->displacement);
  if (!(fraction < (alignment > c->alignment ? c->fraction + slack : c->fraction - slack))) return;
  c->fraction = fraction, c->alignment = alignment;
  c->contact = *contact;
  c->object = *piece->object;
}

static void hit_plane(cast *c, const sbri_query_piece *piece) {
  double min = INFINITY;
  sbfi_d3 lowest = {0, 0, 0};
  for (uint32_t i = 0; i < c->shape.count; i++) {
    sbfi_d3 x = sbri_convex_point(&c->shape, i);
    double height = sbfi_d3_dot(piece->normal, sbfi_d3_sub(x, piece->convex.position));
    if (height < min) min = height, lowest = x;
  }
  double gap = min - c->shape.radius, rate = -sbfi_d3_dot(piece->normal, c->displacement);
  if (gap >= 0 && !(rate > 0)) return;
  double fraction = gap < 0 ? 0 : gap / rate;
  sbri_closest contact = {.distance = gap};
  if (gap >= 0) contact.normal = piece->normal;
  contact.on_b = sbfi_d3_add(lowest,
      sbfi_d3_add(sbfi_d3_scale(c->displacement, fraction), sbfi_d3_scale(piece->normal, -c->shape.radius)));
  note(c, piece, fraction, &contact);
}

/* Distances change no faster than the shape moves. */
static void hit_host(cast *c, const sbri_query_piece *piece) {
  double length = sbfi_d3_length(c->displacement), fraction = 0;
  for (int i = 0; i < MAX_HOST_ADVANCES && fraction <= 1; i++) {
    sbfi_d3 normal = {0, 1, 0}, offset = sbfi_d3_scale(c->displacement, fraction);
    double gap = sbri_query_host_distance(piece, &c->shape, offset, (1 - fraction) * length + 1, &normal);
    if (gap <= HOST_CONTACT_M) {
      sbri_closest contact = {.distance = gap, .normal = normal, .on_b = offset};
      if (gap < 0 && i == 0) contact.normal = (sbfi_d3){0, 0, 0};
      note(c, piece, fraction, &contact);
      return;
    }
    fraction += gap / length;
  }
}

static bool hit_piece(void *context, const sbri_query_piece *piece) {
  cast *c = context;
  if (piece->kind == SBRI_PIECE_PLANE) hit_plane(c, piece);
  if (piece->kind == SBRI_PIECE_HOST) hit_host(c, piece);
  if (piece->kind != SBRI_PIECE_CONVEX) return true;
  sbri_closest contact;
  double fraction = sbri_convex_cast(&c->shape, c->displacement, &piece->convex, &contact);
  if (fraction > 1) return true;
  bool from_behind = sbfi_d3_dot(contact.normal, piece->normal) < 0;
  if (!from_behind) note(c, piece, fraction, &contact);
  return true;
}

static sbri_box swept(const cast *c, double from, double to) {
  sbri_box box = sbri_convex_bounds(&c->shape);
  sbri_box begin = box, end = box;
  sbf_vec3 a = sbfi_d3_rounded(sbfi_d3_scale(c->displacement, from)),
           b = sbfi_d3_rounded(sbfi_d3_scale(c->displacement, to));
  begin.low = sbri_add(box.low, a), begin.high = sbri_add(box.high, a);
  end.low = sbri_add(box.low, b), end.high = sbri_add(box.high, b);
  return sbri_box_join(begin, end);
}

/* A shape with a point below the ground overlaps it. */
static bool begins_below(const cast *c, const sbri_query_space *space) {
  for (uint32_t i = 0; i < c->shape.count; i++) {
    sbfi_d3 x = sbri_convex_point(&c->shape, i);
    double y = sbri_ground_height(&space->world->ground, space->origin.x + x.x, space->origin.z + x.z, NULL);
    if (space->origin.y + x.y < y) return true;
  }
  return false;
}

/* In parts, so that long casts sample the ground as finely as short ones. */
static void hit_ground(cast *c, sbri_query_space *space) {
  double level, flat = sqrt(c->displacement.x * c->displacement.x + c->displacement.z * c->displacement.z);
  double wanted = 1 + flat / GROUND_PART_M;
  int parts = wanted < MAX_GROUND_PARTS ? (int)wanted : MAX_GROUND_PARTS;
  if (sbri_ground_is_flat(&space->world->ground, &level)) parts = 1;
  if (begins_below(c, space)) {
    const sbri_query_piece piece = {.object = &sbri_no_object};
    note(c, &piece, 0, &(const sbri_closest){.distance = -1});
    return;
  }
  for (int k = 0; k < parts; k++) {
    double from = (double)k / parts, to = (double)(k + 1) / parts;
    if (c->fraction < from) return;
    space->box = swept(c, from, to);
    sbri_query_visit_ground(space, hit_piece, c);
  }
}

bool sbr_world_cast_shape(const sbr_world *world, const sbr_shape *shape, sbr_double3 from, sbf_quat rotation,
    sbf_vec3 direction, double length, const sbr_query_filter *filter, sbr_hit *hit) {
  sbr_query_filter used;
  sbfi_d3 unit = sbfi_d3_normal(sbfi_d3_of(direction));
  const double numbers[8] = {from.x, from.y, from.z, length, (double)rotation.x, (double)rotation.y,
      (double)rotation.z, (double)rotation.w};
  sbf_vec3 ends[2];
  cast c = {
      .displacement = sbfi_d3_scale(unit, length), .fraction = 2, .alignment = 1, .object = sbri_no_object};
  if (!world || !shape || !hit || !(length > 0) || !(sbfi_d3_dot(unit, unit) > 0) ||
      !sbri_usable(numbers, 8) || !sbri_query_filter_of(filter, &used) ||
      !sbri_query_convex_of(shape, rotation, &c.shape, ends))
    return false;
  sbri_query_space space = {.world = world, .filter = &used, .origin = from, .box = swept(&c, 0, 1)};
  sbri_query_visit(&space, hit_piece, &c);
  if (sbri_query_sees_ground(world, &used)) hit_ground(&c, &space);
  if (c.fraction > 1) return false;
  sbfi_d3 normal = c.contact.normal, at = c.contact.on_b;
  bool overlaps = !(sbfi_d3_dot(normal, normal) > 0);
  if (overlaps) normal = sbfi_d3_scale(unit, -1), at = (sbfi_d3){0, 0, 0};
  *hit = (sbr_hit){.object = c.object,
      .position = {from.x + at.x, from.y + at.y, from.z + at.z},
      .normal = sbfi_d3_rounded(normal),
      .distance = c.fraction * length};
  return true;
}
