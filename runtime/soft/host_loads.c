/* Prepares forces and grabs of the host for a tick: sbrun/soft_body.h. */
#include "math/vec3.h"
#include "soft/soft.h"
#include "soft/solvers/scheme.h"

static const float TWO_PI = 6.2831853f, EARTH_M_S2 = 9.80665f;
/* Default force limit of a grab, in multiples of the body's weight. */
static const float LIFTS = 20;

bool sbri_vertex_weights_find(
    const sbri_character *c, const sbri_body *body, uint32_t vertex, sbri_vertex_weights *to) {
  const sbri_skin skin = sbri_skin_now(c, &body->surface.skin);
  uint32_t block = vertex / SBRI_BLOCK, lane = vertex % SBRI_BLOCK;
  uint32_t first = c->model->islands[body->island].first_slot;
  float sum = 0;
  *to = (sbri_vertex_weights){0};
  if (vertex >= skin.vertex_count) return false;
  for (uint32_t i = skin.cell_begins[block]; i < skin.cell_begins[block + 1]; i++) {
    float weight = skin.cells[i].weights[lane];
    if (weight == 0 || to->count == SBRI_VERTEX_POINTS) continue;
    to->slots[to->count] = skin.cells[i].slots[lane] - first;
    to->weights[to->count++] = weight;
    sum += weight;
  }
  for (uint32_t k = 0; k < to->count && sum > 0; k++) to->weights[k] /= sum;
  return to->count > 0 && sum > 0;
}

bool sbri_body_accepts_forces(const sbri_character *c, const sbri_body *body) {
  return body->level && !c->model->islands[body->island].scheme->forceless && sbri_body_mass(c, body) > 0;
}

float sbri_body_mass(const sbri_character *c, const sbri_body *body) {
  const sbri_island now = sbri_island_now(c, &c->model->islands[body->island]);
  double sum = 0;
  for (uint32_t slot = body->slots.begin; slot < body->slots.end; slot++) sum += (double)now.masses[slot];
  return (float)sum;
}

/* Inverse effective mass of an impulse that is distributed over the points. */
static float inverse_mass_of(const sbri_island *island, const sbri_vertex_weights *at) {
  float sum = 0;
  for (uint32_t k = 0; k < at->count; k++)
    if (at->slots[k] < island->free_count)
      sum += at->weights[k] * at->weights[k] * island->inverse_masses[at->slots[k]];
  return sum;
}

static void prepare_grab(const sbri_character *c, const sbri_load *load, float mass, sbri_load_now *to) {
  const sbr_double3 o = sbri_header(c)->origin;
  float s = c->scale, w = TWO_PI * load->frequency_hz / c->time_scale;
  to->target = (sbf_vec3){(float)((load->target.x - o.x) / (double)s),
      (float)((load->target.y - o.y) / (double)s), (float)((load->target.z - o.z) / (double)s)};
  to->stiffness = mass * w * w, to->damping = 2 * load->damping_ratio * mass * w;
  to->max_force = load->max_force > 0 ? load->max_force / (s * s * s) : LIFTS * mass * EARTH_M_S2;
}

static void prepare(const sbr_world *world, sbri_character *c, sbri_load *load) {
  const sbri_body *body = &c->model->bodies[load->body];
  float tick_s = (float)world->time.tick_s, left = load->seconds;
  load->impulse[0] = load->impulse[1] = load->impulse[2] = 0;
  if (load->kind == SBRI_LOAD_FORCE) load->seconds = left > tick_s ? left - tick_s : 0;
  if (!sbri_body_accepts_forces(c, body)) return;
  const sbri_island now = sbri_island_now(c, &c->model->islands[body->island]);
  float mass = sbri_body_mass(c, body), s = c->scale;
  sbri_load_now is = {.body = load->body, .is_grab = load->kind == SBRI_LOAD_GRAB, .impulse = load->impulse};
  bool whole = load->vertex == SBR_WHOLE_BODY;
  if (!whole && !sbri_vertex_weights_find(c, body, load->vertex, &is.at)) return;
  is.inverse_mass = whole ? 1 / mass : inverse_mass_of(&now, &is.at);
  if (is.is_grab)
    prepare_grab(c, load, mass, &is);
  else
    is.force = sbri_scale(load->force, (left < tick_s ? left / tick_s : 1) / (s * s * s));
  sbri_loads_now(c)->at[sbri_loads_now(c)->count++] = is;
}

bool sbri_any_loads(const sbri_character *c) {
  for (uint32_t i = 0; i < SBR_LOAD_CAPACITY; i++)
    if (sbri_loads(c)[i].kind != SBRI_LOAD_NONE) return true;
  return false;
}

bool sbri_island_is_loaded(const sbri_character *c, uint32_t island) {
  for (uint32_t i = 0; i < SBR_LOAD_CAPACITY; i++) {
    const sbri_load *load = &sbri_loads(c)[i];
    const sbri_body *body = &c->model->bodies[load->body];
    if (load->kind != SBRI_LOAD_NONE && body->level && body->island == island) return true;
  }
  return false;
}

void sbri_loads_begin(const sbr_world *world, sbri_character *c) {
  sbri_loads_now(c)->count = 0;
  for (uint32_t i = 0; i < SBR_LOAD_CAPACITY; i++) {
    sbri_load *load = &sbri_loads(c)[i];
    if (load->kind == SBRI_LOAD_FORCE && !(load->seconds > 0)) *load = (sbri_load){0};
    if (load->kind != SBRI_LOAD_NONE) prepare(world, c, load);
  }
}
