/* Mass of a rigid body by the rules of the specification (8.2). */
#include "sbfmt/mechanics.h"

/* Newton's iteration, which decreases towards the root from above. */
static double cube_root(double value) {
  double root = value > 1 ? value : 1;
  if (!(value > 0)) return 0;
  for (int i = 0; i < 120; i++) root = (2 * root + value / (root * root)) / 3;
  return root;
}

/* Moment of inertia of a sphere of the mass and density, for a body with a mass but no shape. */
static double moment_of_ball(double mass, double density) {
  double volume = density > 0 ? mass / density : 0;
  double radius = cube_root(volume * (3 / (4 * 3.14159265358979323846)));
  return 0.4 * mass * radius * radius;
}

void sbf_rigid_body_measure(const sbf_rigid_body *body, sbf_rigid_measures *measures) {
  sbf_solid solid = {.inertia_rotation = {0, 0, 0, 1}};
  if (body->hull) sbf_solid_measure(body->hull, &solid);
  double mass = body->mass > 0 ? body->mass : body->density * solid.volume;
  *measures = (sbf_rigid_measures){mass, solid.volume, body->center, body->inertia, body->inertia_rotation};
  if (body->inertia.x + body->inertia.y + body->inertia.z > 0) return;
  measures->inertia_rotation = (sbf_quat){0, 0, 0, 1};
  if (solid.volume > 0) {
    float density = (float)(mass / solid.volume);
    measures->center = solid.center;
    measures->inertia =
        (sbf_vec3){solid.inertia.x * density, solid.inertia.y * density, solid.inertia.z * density};
    measures->inertia_rotation = solid.inertia_rotation;
  } else {
    float moment = (float)moment_of_ball(mass, body->density);
    measures->inertia = (sbf_vec3){moment, moment, moment};
  }
}
