/* Mass properties of a Godot body, for a collider of the runtime. */
#ifndef SBFMT_GODOT_PHYSICS_MASS_H
#define SBFMT_GODOT_PHYSICS_MASS_H

#include "sbrun/collision.h"
#include "variants.h"

/* Zeros: immovable. */
typedef struct body_mass {
  float inverse;                    /* 1/kg */
  sbf_vec3 inverse_inertia, centre; /* 1/(kg m^2), about its principal axes; m, in the body's frame */
} body_mass;

/* `body`: its RID. */
body_mass body_mass_of(const gd_variant *server, const gd_variant *body);
/* Sets them in the collider of one of the body's shapes, whose position and rotation are set. */
void body_mass_give(const body_mass *mass, const gd_variant *server, const gd_variant *body, int64_t shape,
    sbr_collider_definition *collider);

#endif
