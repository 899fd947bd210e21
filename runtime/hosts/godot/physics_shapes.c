/* A shape of Godot's physics as one of the runtime. */
#include <math.h>
#include <stdio.h>
#include <stdlib.h>

#include "soft_character.h"

enum { CYLINDER = 16 /* sides of a cylinder's hull */ };
/* Godot's kinds of shapes that a moving body may have. */
enum {
  SHAPE_SEPARATION_RAY = 1, /* nothing solid */
  SHAPE_SPHERE,
  SHAPE_BOX,
  SHAPE_CAPSULE,
  SHAPE_CYLINDER,
  SHAPE_CONVEX,
  SHAPE_CONCAVE
};

/* Of the main thread alone: whether it was said that something is passed through. */
static bool told;

static sbr_shape *made_of(const sbr_shape_definition *form, const gd_variant *object) {
  char name[128], message[sizeof name + sizeof(sbf_diagnostic)];
  sbr_shape *made = NULL;
  sbf_diagnostic error = {0};
  if (sbr_shape_create(NULL, form, &made, &error) == SBF_OK || told) return made;
  told = true;
  gd_variant text = GD_CALL(object, "to_string");
  gd_as_text(&text, name, sizeof name);
  gd_free(&text);
  snprintf(message, sizeof message, "SoftCharacter3D passes through %s: %s (said of the first one alone)",
      name, error.message);
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

static sbr_shape *shape_with(int64_t kind, const gd_variant *data, const gd_variant *object) {
  sbr_shape_definition form = sbr_default_shape_definition();
  switch (kind) {
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
  default: /* heights and planes, which Godot does not let move either */
    return NULL;
  }
}

sbr_shape *physics_shape_of(
    const gd_variant *server, const gd_variant *body, int64_t index, const gd_variant *object) {
  gd_variant handle = GD_CALL(server, "body_get_shape", gd_copy(body), gd_int(index));
  gd_variant data = GD_CALL(server, "shape_get_data", gd_copy(&handle));
  int64_t kind = gd_take_int(GD_CALL(server, "shape_get_type", gd_copy(&handle)));
  sbr_shape *made = shape_with(kind, &data, object);
  gd_free(&data);
  gd_free(&handle);
  return made;
}
