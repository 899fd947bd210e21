/* The collision volume of a body for walls: a set of spheres.
 *
 * The vertices of all parts except tails, in the gait's rest pose (arms down), are sorted into cubes. Each
 * cube with vertices gets a sphere inside its bounds. There are none below the height of a step, because feet
 * step onto things that low; lower vertices count at that height. */
#include "animation/skeleton/wall_volume.h"

#include "animation/skeleton/bone_points.h"

static const float STEP_UP = 0.6f; /* fraction of the legs' mean length, or of the height if that is less */
static const float STEP_UP_LEGLESS = 0.2f; /* fraction of the height of a body without legs */
static const float NOSE =
    0.25f;                     /* fraction of the length: the leading part of a body that follows its nose */
static const float FINEST = 8; /* initial number of cubes along the longest side */
static const float COARSER = 1.2f; /* factor on the cubes' size while there are too many */
static const float FILLED = 0.5f;  /* fraction of its bounds that a body fills, about */
static const float DENSITY = 1000; /* kg/m^3 */

/* Whether walls keep it out; a tail follows the body's path. */
static bool is_stiff(const sbri_rig *rig, int32_t bone) {
  for (int32_t b = bone; rig->leg_count && b >= 0; b = rig->bones.parents[b])
    if (rig->bones.roles[b] == SBRI_ROLE_TAIL) return false;
  return bone >= 0;
}

/* From the rest pose to that of the gait, by the bone's ancestors. */
static sbf_vec3 posed(const sbri_rig *rig, int32_t bone, sbf_vec3 position) {
  const sbr_transform *rest = &rig->bones.rest[bone];
  sbf_vec3 x = sbri_rotate(sbri_quat_conjugate(rest->rotation), sbri_sub(position, rest->position));
  for (int32_t b = bone; b >= 0; b = rig->bones.parents[b]) {
    const sbr_transform *local =
        rig->bones.base_local ? &rig->bones.base_local[b] : &rig->bones.rest_local[b];
    x = sbri_add(local->position, sbri_rotate(local->rotation, x));
  }
  return x;
}

/* ---- Bounds ---- */

typedef struct bounds {
  sbf_vec3 low, high;
  bool any;
} bounds;

static void extend(void *user, const sbri_rig *rig, int32_t bone, sbf_vec3 rest) {
  bounds *b = user;
  if (!is_stiff(rig, bone)) return;
  sbf_vec3 p = posed(rig, bone, rest);
  if (!b->any) b->low = b->high = p;
  b->any = true;
  b->low = sbri_vec3(fminf(b->low.x, p.x), fminf(b->low.y, p.y), fminf(b->low.z, p.z));
  b->high = sbri_vec3(fmaxf(b->high.x, p.x), fmaxf(b->high.y, p.y), fmaxf(b->high.z, p.z));
}

/* ---- Spheres ---- */

typedef struct cubes {
  bounds body;
  float edge;   /* m */
  float lowest; /* m; lower bound of spheres */
  int32_t cells[SBRI_WALL_SPHERES][3];
  uint32_t count; /* SBRI_WALL_SPHERES + 1: too many */
} cubes;

static void fill(void *user, const sbri_rig *rig, int32_t bone, sbf_vec3 rest) {
  cubes *c = user;
  if (c->count > SBRI_WALL_SPHERES || !is_stiff(rig, bone)) return;
  sbf_vec3 p = posed(rig, bone, rest);
  if (p.z < c->body.low.z) return;
  if (p.y < c->lowest) p.y = c->lowest; /* feet included: above them they would be in a wall */
  int32_t cell[3] = {(int32_t)((p.x - c->body.low.x) / c->edge), (int32_t)((p.y - c->body.low.y) / c->edge),
      (int32_t)((p.z - c->body.low.z) / c->edge)};
  for (uint32_t i = 0; i < c->count; i++)
    if (c->cells[i][0] == cell[0] && c->cells[i][1] == cell[1] && c->cells[i][2] == cell[2]) return;
  if (c->count < SBRI_WALL_SPHERES)
    for (int k = 0; k < 3; k++) c->cells[c->count][k] = cell[k];
  c->count++;
}

/* Centre of a sphere along an axis: in the middle of its cube, moved into the bounds. */
static float middle(float low, float high, float edge, float radius, int32_t cell) {
  float at = low + edge * ((float)cell + 0.5f);
  if (high - low < 2 * radius) return 0.5f * (low + high);
  return sbri_clamp(at, low + radius, high - radius);
}

static void set_balls(const cubes *c, sbri_wall_volume *wall_volume) {
  sbf_vec3 low = c->body.low, high = c->body.high;
  float radius = 0.5f * c->edge;
  if (low.y < c->lowest) low.y = c->lowest;
  for (uint32_t i = 0; i < c->count; i++) {
    const int32_t *cell = c->cells[i];
    sbf_vec3 position = {
        middle(low.x, high.x, c->edge, radius, cell[0]), 0, middle(low.z, high.z, c->edge, radius, cell[2])};
    float y = c->body.low.y + c->edge * ((float)cell[1] + 0.5f);
    position.y = sbri_clamp(y, low.y + radius, fmaxf(low.y + radius, high.y - radius));
    wall_volume->wall_spheres[wall_volume->wall_sphere_count++] = (sbri_wall_sphere){position, radius};
  }
}

static float largest(sbf_vec3 size) {
  return fmaxf(size.x, fmaxf(size.y, size.z));
}

void sbri_rig_find_wall_volume(sbri_rig *rig) {
  sbri_wall_volume *wall_volume = &rig->wall_volume;
  sbf_gait_kind kind = rig->gait ? rig->gait->kind : SBF_GAIT_KIND_NONE;
  bool afloat = kind == SBF_GAIT_KIND_SWIM || kind == SBF_GAIT_KIND_FLY;
  *wall_volume = (sbri_wall_volume){.layer = 0};
  for (uint32_t b = 0; b < rig->asset->soft_bodies.count; b++)
    wall_volume->layer |= rig->asset->soft_bodies.at[b].collision.layer,
        wall_volume->mask |= rig->asset->soft_bodies.at[b].collision.mask;
  for (uint32_t b = 0; b < rig->asset->rigid_bodies.count; b++)
    wall_volume->layer |= rig->asset->rigid_bodies.at[b].layer,
        wall_volume->mask |= rig->asset->rigid_bodies.at[b].mask;
  if (!wall_volume->layer && !wall_volume->mask) wall_volume->layer = 1, wall_volume->mask = UINT32_MAX;
  cubes all = {.lowest = -INFINITY};
  sbri_rig_visit_points(rig, extend, &all.body);
  if (kind == SBF_GAIT_KIND_NONE || !all.body.any) return;
  sbf_vec3 size = sbri_sub(all.body.high, all.body.low);
  wall_volume->mass = DENSITY * FILLED * size.x * size.y * size.z;
  wall_volume->step_up = STEP_UP_LEGLESS * size.y;
  if (rig->leg_count) wall_volume->step_up = STEP_UP * fminf(rig->stand.reach, size.y);
  if (!afloat) all.lowest = wall_volume->step_up;
  if (kind == SBF_GAIT_KIND_SLITHER) all.body.low.z = all.body.high.z - NOSE * size.z;
  size.z = all.body.high.z - all.body.low.z;
  for (all.edge = largest(size) / FINEST; all.edge > 0; all.edge *= COARSER) {
    all.count = 0;
    sbri_rig_visit_points(rig, fill, &all);
    if (all.count <= SBRI_WALL_SPHERES) break;
  }
  if (all.edge > 0) set_balls(&all, wall_volume);
  for (uint32_t i = 0; i < wall_volume->wall_sphere_count; i++)
    wall_volume->radius = fmaxf(wall_volume->radius,
        sbri_length(wall_volume->wall_spheres[i].position) + wall_volume->wall_spheres[i].radius);
  wall_volume->radius = fmaxf(wall_volume->radius, rig->stand.spread + rig->stand.reach);
}
