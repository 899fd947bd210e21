/* Checks rigid bodies: closed convex hulls, mass if simulated, physically possible inertia. */
#include "build/geometry/hulls.h"
#include "sbfmt/mechanics.h"
#include "validate/rules/convexity.h"
#include "validate/rules/pose.h"
#include "validate/validation.h"

static void check_hull(sbfi_validation *v, const sbf_rigid_body *body, const char *path) {
  sbfi_path hull = sbfi_path_of("%s/polygon_mesh", path);
  switch (sbfi_hull_check(body->hull, &v->scratch)) {
  case SBFI_HULL_FAULT_OPEN:
    sbfi_found(v, SBF_CODE_HULL_OPEN, hull.text, -1, "the hull of '%s' is not a closed surface",
        sbfi_label(body->name, body->id));
    return;
  case SBFI_HULL_FAULT_CONCAVE:
    sbfi_found(v, SBF_CODE_HULL_NOT_CONVEX, hull.text, -1, "the hull of '%s' is not convex or faces inwards",
        sbfi_label(body->name, body->id));
    return;
  case SBFI_HULL_FAULT_MEMORY:
    v->out_of_memory = true;
    return;
  case SBFI_HULL_FAULT_NONE:
    break;
  }
  bool has_inertia =
      body->inertia.x + body->inertia.y + body->inertia.z > 0; /* otherwise the hull defines the centre */
  if (has_inertia && !sbfi_hull_contains(body->hull, body->center))
    sbfi_found(v, SBF_CODE_CENTER_OUTSIDE, path, -1, "the centre of '%s' lies outside its hull",
        sbfi_label(body->name, body->id));
}

static void check_inertia(sbfi_validation *v, const sbf_rigid_body *body, const char *path) {
  double a = body->inertia.x, b = body->inertia.y, c = body->inertia.z, max = fmax(a, fmax(b, c));
  if (max == 0) return;
  if (2 * max > 1.001 * (a + b + c))
    sbfi_found(v, SBF_CODE_INERTIA_IMPOSSIBLE, path, -1, "'%s' has the principal moments %.4g, %.4g and %.4g",
        sbfi_label(body->name, body->id), a, b, c);
}

void sbfi_check_rigid_bodies(sbfi_validation *v) {
  for (uint32_t i = 0; i < v->asset->rigid_bodies.count && !v->out_of_memory; i++) {
    const sbf_rigid_body *body = &v->asset->rigid_bodies.at[i];
    sbfi_path path = sbfi_path_of("/sbf/rigid_bodies/rigid_body[%u]", i + 1);
    if (body->hull) check_hull(v, body, path.text);
    if (!body->hull && body->mass == 0 && body->motion == SBF_BODY_MOTION_DYNAMIC)
      sbfi_found(v, SBF_CODE_BODY_NO_MASS, path.text, -1,
          "'%s' is simulated but has neither a hull nor a mass", sbfi_label(body->name, body->id));
    check_inertia(v, body, path.text);
  }
}
