/* The scheme of the bachelor's thesis behind the reference lizard, reproduced tick for tick: Verlet without a
 * time step, then one pass over all springs that moves their ends at once, then removal of a fraction of the
 * tick's motion. It has no masses and no units of time: settings are asset.relaxation, per tick. Its energy
 * depends on the number of springs, their order and the tick. It exists for reproduction, not for accuracy.
 *
 * As in the reference, gravity, inertia and damping do not move a point that lies exactly on the ground.
 * Springs still move it and may lift it, and its position before the landing is kept until then. */
#include "shapes/ground.h"
#include "soft/solvers/scheme.h"
#include "soft/solvers/visits.h"

typedef struct relaxation_tick {
  const sbri_island_tick *tick;
  bool flat;
  float flat_height;
} relaxation_tick;

static float ground_height(const relaxation_tick *r, const sbri_point *p) {
  if (r->flat) return r->flat_height;
  const sbri_island_tick *t = r->tick;
  double x = t->environment.origin.x + (double)t->environment.scale * p->x,
         z = t->environment.origin.z + (double)t->environment.scale * p->z;
  return (float)((sbri_ground_height(t->environment.ground, x, z, NULL) - t->environment.origin.y) /
                 t->environment.scale);
}

static void stop_at_ground(const relaxation_tick *r, sbri_point *p) {
  float ground = ground_height(r, p);
  if (p->y <= ground) p->y = ground;
}

static float *previous_position(const relaxation_tick *r, uint32_t slot) {
  return r->tick->velocities + 3 * (slot / SBRI_BLOCK * SBRI_BLOCK) + slot % SBRI_BLOCK;
}

static void integrate(const relaxation_tick *r, uint32_t slot, float gravity_step) {
  sbri_point *p = &r->tick->positions[slot];
  float *q = previous_position(r, slot);
  if (p->y == ground_height(r, p)) return;
  sbri_point next = {
      2 * p->x - q[0], 2 * p->y - q[SBRI_BLOCK] - gravity_step, 2 * p->z - q[2 * SBRI_BLOCK], 0};
  q[0] = p->x, q[SBRI_BLOCK] = p->y, q[2 * SBRI_BLOCK] = p->z;
  *p = next;
  stop_at_ground(r, p);
}

static void visit(const relaxation_tick *r, const sbri_visit *v, float stiffness) {
  uint32_t free_count = r->tick->island->free_count;
  sbri_point *a = &r->tick->positions[v->from], *b = &r->tick->positions[v->to];
  float x = b->x - a->x, y = b->y - a->y, z = b->z - a->z;
  float length = sqrtf(x * x + y * y + z * z);
  if (!(length > 0)) return;
  float s = stiffness * (length - v->rest_length_m) / length;
  bool a_free = v->from < free_count, b_free = v->to < free_count;
  if (a_free && b_free) s *= 0.5f;
  if (a_free) {
    *a = (sbri_point){a->x + x * s, a->y + y * s, a->z + z * s, 0};
    stop_at_ground(r, a);
  }
  if (b_free) {
    *b = (sbri_point){b->x - x * s, b->y - y * s, b->z - z * s, 0};
    stop_at_ground(r, b);
  }
}

static void damp(const relaxation_tick *r, uint32_t slot, float fraction) {
  sbri_point *p = &r->tick->positions[slot];
  const float *q = previous_position(r, slot);
  if (p->y == ground_height(r, p)) return;
  p->x = q[0] + fraction * (p->x - q[0]);
  p->y = q[SBRI_BLOCK] + fraction * (p->y - q[SBRI_BLOCK]);
  p->z = q[2 * SBRI_BLOCK] + fraction * (p->z - q[2 * SBRI_BLOCK]);
  stop_at_ground(r, p);
}

static void tick_relaxation(const sbri_island_tick *t) {
  const sbri_island *island = t->island;
  const sbf_relaxation *settings = &t->model->asset->relaxation;
  double height;
  relaxation_tick r = {t, sbri_ground_is_flat(t->environment.ground, &height), 0};
  r.flat_height = (float)((height - t->environment.origin.y) / t->environment.scale);
  float gravity_step = settings->gravity / t->environment.scale;
  for (uint32_t slot = island->free_count; slot < island->slot_count; slot++)
    t->positions[slot] = t->targets[slot];
  for (uint32_t b = 0; b < island->body_count; b++) {
    const sbri_body *body = &t->model->bodies[island->bodies[b]];
    for (uint32_t slot = body->slots.begin; slot < body->slots.real_end; slot++)
      integrate(&r, slot, gravity_step);
  }
  for (uint32_t i = 0; i < island->springs.visit_count; i++)
    visit(&r, &island->springs.visits[i], settings->stiffness);
  for (uint32_t b = 0; b < island->body_count; b++) {
    const sbri_body *body = &t->model->bodies[island->bodies[b]];
    for (uint32_t slot = body->slots.begin; slot < body->slots.real_end; slot++)
      damp(&r, slot, settings->damping);
  }
  sbri_count_element_visits(t, 1);
}

const sbri_scheme sbri_relaxation = {.kind = SBF_SCHEME_RELAXATION,
    .forceless = true,
    .refuse = sbri_refuse_all_but_springs,
    .prepare = sbri_visits_make,
    .tick = tick_relaxation};
