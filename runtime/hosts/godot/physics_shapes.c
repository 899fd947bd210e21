/* Conversion of Godot's physics shapes to the runtime's. */
#include <math.h>
#include <stdio.h>
#include <stdlib.h>

#include "soft_character.h"
#include "turns.h"

enum { CYLINDER = 16 /* number of sides of a cylinder's hull */ };
/* Godot's kinds of shapes. */
enum {
  SHAPE_WORLD_BOUNDARY,
  SHAPE_SEPARATION_RAY, /* not solid */
  SHAPE_SPHERE,
  SHAPE_BOX,
  SHAPE_CAPSULE,
  SHAPE_CYLINDER,
  SHAPE_CONVEX,
  SHAPE_CONCAVE,
  SHAPE_HEIGHTMAP
};

/* Main thread only: the warning about unsupported shapes was given. */
static bool is_reported;

static sbr_shape *made_of(const sbr_shape_definition *form, const gd_variant *object) {
  char name[128], message[sizeof name + sizeof(sbf_diagnostic)];
  sbr_shape *made = NULL;
  sbf_diagnostic error = {0};
  if (sbr_shape_create(NULL, form, &made, &error) == SBF_OK || is_reported) return made;
  is_reported = true;
  gd_variant text = GD_CALL(object, "to_string");
  gd_as_text(&text, name, sizeof name);
  gd_free(&text);
  snprintf(
      message, sizeof message, "SoftCharacter3D passes through %s: %s (reported once)", name, error.message);
  gd_warning(message);
  return NULL;
}

static sbr_shape *cylinder(float radius, float height, const gd_variant *object) {
  sbf_vec3 points[2 * CYLINDER];
  sbr_shape_definition form = sbr_default_shape_definition();
  for (uint32_t i = 0; i < CYLINDER; i++) {
    float angle = 6.2831853f * (float)i / CYLINDER, x = radius * cosf(angle), z = radius * sinf(angle);
    points[i] = (sbf_vec3){x, -height / 2, z};
    points[CYLINDER + i] = (sbf_vec3){x, height / 2, z};
  }
  form.kind = SBR_SHAPE_HULL;
  form.points = points;
  form.point_count = 2 * CYLINDER;
  return made_of(&form, object);
}

static sbr_shape *convex(const gd_variant *points, const gd_variant *object) {
  sbr_shape_definition form = sbr_default_shape_definition();
  form.kind = SBR_SHAPE_HULL;
  form.point_count = (uint32_t)gd_size(points);
  if (form.point_count) form.points = gd_vector3s(points);
  return made_of(&form, object);
}

/* Godot's faces are clockwise seen from outside. */
static sbr_shape *concave(const gd_variant *data, const gd_variant *object) {
  sbr_shape_definition form = sbr_default_shape_definition();
  gd_variant faces = gd_key(data, "faces");
  uint32_t count = (uint32_t)gd_size(&faces) / 3 * 3;
  uint32_t *triangles = count ? malloc(count * sizeof *triangles) : NULL;
  for (uint32_t i = 0; triangles && i < count; i++) triangles[i] = i - i % 3 + (3 - i % 3) % 3;
  form.kind = SBR_SHAPE_MESH;
  form.points = triangles ? gd_vector3s(&faces) : NULL;
  form.point_count = count;
  form.triangles = triangles;
  form.triangle_count = count / 3;
  sbr_shape *made = made_of(&form, object);
  free(triangles);
  gd_free(&faces);
  return made;
}

static float number(const gd_variant *data, const char *key) {
  return (float)gd_take_float(gd_key(data, key));
}

/* A grid with a spacing of one metre about its centre. */
static sbr_shape *heightmap(const gd_variant *data, const gd_variant *object) {
  sbr_shape_definition form = sbr_default_shape_definition();
  gd_variant heights = gd_key(data, "heights");
  sbr_height_field field = {.heights_m = gd_floats(&heights),
      .columns = (uint32_t)gd_take_int(gd_key(data, "width")),
      .rows = (uint32_t)gd_take_int(gd_key(data, "depth")),
      .cell_m = 1};
  sbr_shape *made = NULL;
  field.x = -0.5 * (field.columns - 1.0), field.z = -0.5 * (field.rows - 1.0);
  form.kind = SBR_SHAPE_HEIGHT_FIELD;
  form.heights = &field;
  if (field.heights_m && (uint64_t)gd_size(&heights) >= (uint64_t)field.columns * field.rows)
    made = made_of(&form, object);
  gd_free(&heights);
  return made;
}

static float distance_to(const gd_variant *plane, sbf_vec3 point) {
  return (float)gd_take_float(GD_CALL(plane, "distance_to", gd_vector3(point)));
}

/* The runtime's plane is at the origin and faces +Y. */
static sbr_shape *boundary(const gd_variant *plane, const gd_variant *object, gd_transform *inner) {
  sbr_shape_definition form = sbr_default_shape_definition();
  float off = distance_to(plane, (sbf_vec3){0, 0, 0});
  sbf_vec3 n = {distance_to(plane, (sbf_vec3){1, 0, 0}) - off, distance_to(plane, (sbf_vec3){0, 1, 0}) - off,
      distance_to(plane, (sbf_vec3){0, 0, 1}) - off};
  sbf_vec3 side = fabsf(n.x) < 0.7f ? (sbf_vec3){1, 0, 0} : (sbf_vec3){0, 0, 1};
  sbf_vec3 z = turn_cross(side, n);
  float length = sqrtf(z.x * z.x + z.y * z.y + z.z * z.z);
  z = (sbf_vec3){z.x / length, z.y / length, z.z / length};
  sbf_vec3 x = turn_cross(n, z);
  *inner = (gd_transform){
      {{x.x, n.x, z.x}, {x.y, n.y, z.y}, {x.z, n.z, z.z}}, {-off * n.x, -off * n.y, -off * n.z}};
  form.kind = SBR_SHAPE_PLANE;
  return made_of(&form, object);
}

static sbr_shape *shape_with(
    int64_t kind, const gd_variant *data, const gd_variant *object, gd_transform *inner) {
  sbr_shape_definition form = sbr_default_shape_definition();
  switch (kind) {
  case SHAPE_WORLD_BOUNDARY:
    return boundary(data, object, inner);
  case SHAPE_SEPARATION_RAY:
    return NULL;
  case SHAPE_SPHERE:
    form.radius = (float)gd_as_float(data);
    return made_of(&form, object);
  case SHAPE_BOX:
    form.kind = SBR_SHAPE_BOX;
    form.half_sizes = gd_as_vector3(data);
    return made_of(&form, object);
  case SHAPE_CAPSULE:
    form.kind = SBR_SHAPE_CAPSULE;
    form.radius = number(data, "radius");
    form.half_sizes.y = number(data, "height") / 2 - form.radius;
    return made_of(&form, object);
  case SHAPE_CYLINDER:
    return cylinder(number(data, "radius"), number(data, "height"), object);
  case SHAPE_CONVEX:
    return convex(data, object);
  case SHAPE_CONCAVE:
    return concave(data, object);
  case SHAPE_HEIGHTMAP:
    return heightmap(data, object);
  default:
    return NULL;
  }
}

sbr_shape *physics_shape_of(const gd_variant *server, const gd_variant *body, int64_t index,
    const gd_variant *object, gd_transform *inner) {
  *inner = (gd_transform){{{1, 0, 0}, {0, 1, 0}, {0, 0, 1}}, {0, 0, 0}};
  gd_variant handle = GD_CALL(server, "body_get_shape", gd_copy(body), gd_int(index));
  gd_variant data = GD_CALL(server, "shape_get_data", gd_copy(&handle));
  int64_t kind = gd_take_int(GD_CALL(server, "shape_get_type", gd_copy(&handle)));
  sbr_shape *made = shape_with(kind, &data, object, inner);
  gd_free(&data);
  gd_free(&handle);
  return made;
}
