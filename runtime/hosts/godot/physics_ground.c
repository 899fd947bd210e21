/* The ground as rays find it: heights at the corners of squares of a grid that lies still in the world, asked
 * once each on the main thread, kept while the character is near and asked again in turn. The runtime's
 * threads then read heights between them, which a physics engine's rays would not stand. Rays go through what
 * moves, which is met as a body (physics_bodies.c), and through what hangs on the character itself. */
#include <math.h>
#include <stdlib.h>

#include "physics_kinds.h"
#include "soft_character.h"

enum {
  LOOKED_AGAIN = 48, /* corners a frame that are asked again, in turn */
  MAX_ACROSS = 256,  /* corners across the window */
  PASSED = 16,       /* most bodies that a ray goes through, one by one, before it gives up */
  FORGET = 64        /* frames after which what rays go through is looked at again */
};
/* m: how far down rays look; what is thrown high finds the floor long before it falls on it. */
static const double DEEP = 1000;

typedef struct corner {
  int32_t x, z; /* of the grid */
  bool known;
  double y;
} corner;

struct physics_ground {
  double cell;     /* m */
  double radius;   /* m: of what is looked at around the character */
  double reach;    /* m: how far above it rays begin */
  double low;      /* m: how far below the node the ground is taken to be where there is none */
  double middle_y; /* m: while nothing is known */
  uint32_t across; /* corners of the ring, a power of two */
  int32_t low_x, low_z, high_x, high_z;
  uint32_t turn, frame; /* next corner to be asked again; looks so far */
  bool any, told;       /* something is known; it was said that there is nothing */
  gd_variant query;     /* PhysicsRayQueryParameters3D */
  gd_variant passed;    /* RIDs that rays go through */
  gd_variant still;     /* the body that the last ray found to be ground: most find the same one */
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
  double size = soft_character_size(one), radius = soft_character_around(one);
  double cell = one->settings.ground_cell > 0 ? one->settings.ground_cell : size / 24;
  uint32_t across = 16;
  if (!(cell > 0)) cell = 0.05;
  cell = fmax(cell, 2 * radius / (MAX_ACROSS - 4));
  while (across < 2 * radius / cell + 4) across *= 2;
  physics_ground *made = calloc(1, sizeof *made + sizeof(corner) * across * across);
  if (!made) return NULL;
  made->cell = cell;
  made->radius = radius;
  made->reach = one->settings.ground_reach > 0 ? one->settings.ground_reach : size;
  made->across = across;
  made->low = one->loose ? DEEP : 2 * made->reach;
  made->query = gd_new("PhysicsRayQueryParameters3D");
  made->passed = gd_empty(GDEXTENSION_VARIANT_TYPE_ARRAY);
  made->still = gd_nil();
  return made;
}

void physics_ground_free(physics_ground *ground) {
  if (!ground) return;
  gd_free(&ground->query);
  gd_free(&ground->passed);
  gd_free(&ground->still);
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

/* Whether what a ray hit is no ground; then the next one goes through it. */
static bool passes(physics_ground *ground, const soft_character *one, const gd_variant *hit) {
  gd_variant handle = gd_key(hit, "rid");
  bool through = false;
  if (gd_type(&ground->still) != GDEXTENSION_VARIANT_TYPE_RID ||
      gd_as_rid(&ground->still) != gd_as_rid(&handle)) {
    gd_variant server = gd_singleton("PhysicsServer3D"), object = gd_key(hit, "collider");
    through = body_moves(&server, &handle, &object) || body_is_below(&one->node, &object);
    gd_free(&object);
    gd_free(&server);
    if (!through) gd_assign(&ground->still, gd_copy(&handle));
  }
  if (through) {
    GD_DO(&ground->passed, "push_back", gd_copy(&handle));
    GD_DO(&ground->query, "set_exclude", gd_copy(&ground->passed));
  }
  gd_free(&handle);
  return through;
}

/* The height under a corner; whether there is any. */
static bool ask(physics_ground *ground, const soft_character *one, const gd_variant *space, int32_t x,
    int32_t z, double middle) {
  sbf_vec3 from = {(float)(x * ground->cell), (float)(middle + ground->reach), (float)(z * ground->cell)};
  sbf_vec3 to = {from.x, (float)(middle - fmax(DEEP, ground->low)), from.z};
  bool found = false;
  GD_DO(&ground->query, "set_from", gd_vector3(from));
  GD_DO(&ground->query, "set_to", gd_vector3(to));
  corner *at = corner_at(ground, x, z);
  *at = (corner){x, z, true, middle - ground->low};
  for (int i = 0; i < PASSED; i++) {
    gd_variant hit = GD_CALL(space, "intersect_ray", gd_copy(&ground->query));
    bool any = gd_size(&hit) > 0, through = any && passes(ground, one, &hit);
    if (any && !through) {
      at->y = gd_take_vector3(gd_key(&hit, "position")).y;
      found = true;
    }
    gd_free(&hit);
    if (!through) break;
  }
  return found;
}

/* Once, as it may be meant: a character that flies. */
static void tell_of_nothing(physics_ground *ground, const soft_character *one) {
  ground->told = true;
  soft_character_warning(one,
      "there is no ground: nothing below it that stands still has a layer of its collision_mask. Add a "
      "StaticBody3D with a CollisionShape3D, or set ground to GROUND_FLAT");
}

void physics_ground_look(soft_character *one) {
  physics_ground *ground = one->ground;
  double x = one->put.origin.x, y = one->put.origin.y, z = one->put.origin.z;
  gd_variant world = GD_CALL(&one->node, "get_world_3d");
  gd_variant space = gd_as_object(&world) ? GD_CALL(&world, "get_direct_space_state") : gd_nil();
  if (gd_as_object(&space)) {
    GD_DO(&ground->query, "set_collision_mask", gd_int(one->settings.collision_mask));
    if (ground->frame++ % FORGET == 0) {
      gd_assign(&ground->passed, gd_empty(GDEXTENSION_VARIANT_TYPE_ARRAY));
      gd_assign(&ground->still, gd_nil());
    }
    GD_DO(&ground->query, "set_exclude", gd_copy(&ground->passed));
    bool begins = !ground->any, found = false;
    ground->low_x = (int32_t)floor((x - ground->radius) / ground->cell);
    ground->low_z = (int32_t)floor((z - ground->radius) / ground->cell);
    ground->high_x = (int32_t)ceil((x + ground->radius) / ground->cell);
    ground->high_z = (int32_t)ceil((z + ground->radius) / ground->cell);
    for (int32_t i = ground->low_x; i <= ground->high_x; i++)
      for (int32_t j = ground->low_z; j <= ground->high_z; j++) {
        corner *at = corner_at(ground, i, j);
        if (!at->known || at->x != i || at->z != j) found = ask(ground, one, &space, i, j, y) || found;
      }
    uint32_t wide = (uint32_t)(ground->high_z - ground->low_z + 1);
    uint32_t all = wide * (uint32_t)(ground->high_x - ground->low_x + 1);
    for (uint32_t i = 0; i < LOOKED_AGAIN && ground->any; i++, ground->turn++) {
      int32_t cx = ground->low_x + (int32_t)(ground->turn % all / wide);
      int32_t cz = ground->low_z + (int32_t)(ground->turn % wide);
      ask(ground, one, &space, cx, cz, y);
    }
    ground->any = true;
    if (begins && !found && !ground->told && !one->editor) tell_of_nothing(ground, one);
  } else {
    ground->middle_y = y;
  }
  gd_free(&space);
  gd_free(&world);
}
