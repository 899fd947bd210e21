/* The ground as rays find it: heights at the corners of squares of a grid that lies still in the world, asked
 * once each on the main thread, kept while the character is near and asked again in turn. The runtime's
 * threads then read heights between them, which a physics engine's rays would not stand. */
#include <math.h>
#include <stdlib.h>

#include "soft_character.h"

enum {
  LOOKED_AGAIN = 48, /* corners a frame that are asked again, in turn */
  MOST_ACROSS = 256  /* corners across the window */
};

typedef struct corner {
  int32_t x, z; /* of the grid */
  bool known;
  double y;
} corner;

struct physics_ground {
  double cell;     /* m */
  double radius;   /* m: of what is looked at around the character */
  double reach;    /* m: how far above and below it rays go */
  double middle_y; /* m: while nothing is known */
  uint32_t across; /* corners of the ring, a power of two */
  int32_t low_x, low_z, high_x, high_z;
  uint32_t turn; /* next corner to be asked again */
  bool any;
  gd_variant query; /* PhysicsRayQueryParameters3D */
  corner corners[];
};

static corner *corner_at(const physics_ground *ground, int32_t x, int32_t z) {
  uint32_t mask = ground->across - 1;
  return (corner *)(uintptr_t)&ground->corners[((uint32_t)x & mask) * ground->across + ((uint32_t)z & mask)];
}

static double clamp(double value, double low, double high) {
  return value < low ? low : value > high ? high : value;
}

static double height(const sbr_ground *asked, double x, double z, sbf_vec3 *normal) {
  const physics_ground *ground = asked->user;
  *normal = (sbf_vec3){0, 1, 0};
  if (!ground->any) return ground->middle_y;
  double u = clamp(x / ground->cell, ground->low_x, ground->high_x - 1e-9);
  double v = clamp(z / ground->cell, ground->low_z, ground->high_z - 1e-9);
  int32_t i = (int32_t)floor(u), j = (int32_t)floor(v);
  double s = u - i, t = v - j;
  double a = corner_at(ground, i, j)->y, b = corner_at(ground, i + 1, j)->y;
  double c = corner_at(ground, i, j + 1)->y, d = corner_at(ground, i + 1, j + 1)->y;
  double along_x = ((b - a) * (1 - t) + (d - c) * t) / ground->cell;
  double along_z = ((c - a) * (1 - s) + (d - b) * s) / ground->cell;
  double length = sqrt(1 + along_x * along_x + along_z * along_z);
  *normal = (sbf_vec3){(float)(-along_x / length), (float)(1 / length), (float)(-along_z / length)};
  return (a * (1 - s) + b * s) * (1 - t) + (c * (1 - s) + d * s) * t;
}

physics_ground *physics_ground_make(const soft_character *one) {
  double wide = fmax(fmax(one->high.x, -one->low.x), fmax(one->high.z, -one->low.z)) * one->scale;
  double size = fmax(wide, (one->high.y - one->low.y) * one->scale);
  double radius = 1.5 * wide + 0.1 * size;
  double cell = one->settings.ground_cell > 0 ? one->settings.ground_cell : size / 24;
  uint32_t across = 16;
  if (!(cell > 0)) cell = 0.05;
  cell = fmax(cell, 2 * radius / (MOST_ACROSS - 4));
  while (across < 2 * radius / cell + 4) across *= 2;
  physics_ground *made = calloc(1, sizeof *made + sizeof(corner) * across * across);
  if (!made) return NULL;
  made->cell = cell;
  made->radius = radius;
  made->reach = one->settings.ground_reach > 0 ? one->settings.ground_reach : size;
  made->across = across;
  made->query = gd_new("PhysicsRayQueryParameters3D");
  return made;
}

void physics_ground_free(physics_ground *ground) {
  if (!ground) return;
  gd_free(&ground->query);
  free(ground);
}

sbr_ground physics_ground_of(physics_ground *ground) {
  return (sbr_ground){.height = height, .user = ground};
}

void physics_ground_level(physics_ground *ground, double level) {
  for (uint32_t i = 0; i < ground->across * ground->across; i++) ground->corners[i].known = false;
  ground->any = false;
  ground->middle_y = level;
}

/* The height under a corner; the lower end of the ray where it meets nothing. */
static void ask(
    physics_ground *ground, const gd_variant *space, corner *at, int32_t x, int32_t z, double middle) {
  sbf_vec3 from = {(float)(x * ground->cell), (float)(middle + ground->reach), (float)(z * ground->cell)};
  sbf_vec3 to = {from.x, (float)(middle - 2 * ground->reach), from.z};
  GD_DO(&ground->query, "set_from", gd_vector3(from));
  GD_DO(&ground->query, "set_to", gd_vector3(to));
  gd_variant hit = GD_CALL(space, "intersect_ray", gd_copy(&ground->query));
  gd_variant place = gd_key(&hit, "position");
  bool found = gd_type(&place) == GDEXTENSION_VARIANT_TYPE_VECTOR3;
  *at = (corner){x, z, true, found ? gd_as_vector3(&place).y : to.y};
  gd_free(&place);
  gd_free(&hit);
}

void physics_ground_look(soft_character *one) {
  physics_ground *ground = one->ground;
  double x = one->put.origin.x, y = one->put.origin.y, z = one->put.origin.z;
  gd_variant world = GD_CALL(&one->node, "get_world_3d");
  gd_variant space = gd_as_object(&world) ? GD_CALL(&world, "get_direct_space_state") : gd_nil();
  if (gd_as_object(&space)) {
    GD_DO(&ground->query, "set_collision_mask", gd_int(one->settings.collision_mask));
    GD_DO(&ground->query, "set_exclude", physics_bodies_handles(one->bodies));
    ground->low_x = (int32_t)floor((x - ground->radius) / ground->cell);
    ground->low_z = (int32_t)floor((z - ground->radius) / ground->cell);
    ground->high_x = (int32_t)ceil((x + ground->radius) / ground->cell);
    ground->high_z = (int32_t)ceil((z + ground->radius) / ground->cell);
    for (int32_t i = ground->low_x; i <= ground->high_x; i++)
      for (int32_t j = ground->low_z; j <= ground->high_z; j++) {
        corner *at = corner_at(ground, i, j);
        if (!at->known || at->x != i || at->z != j) ask(ground, &space, at, i, j, y);
      }
    uint32_t wide = (uint32_t)(ground->high_z - ground->low_z + 1);
    uint32_t all = wide * (uint32_t)(ground->high_x - ground->low_x + 1);
    for (uint32_t i = 0; i < LOOKED_AGAIN && ground->any; i++, ground->turn++) {
      int32_t cx = ground->low_x + (int32_t)(ground->turn % all / wide);
      int32_t cz = ground->low_z + (int32_t)(ground->turn % wide);
      ask(ground, &space, corner_at(ground, cx, cz), cx, cz, y);
    }
    ground->any = true;
  } else {
    ground->middle_y = y;
  }
  gd_free(&space);
  gd_free(&world);
}
