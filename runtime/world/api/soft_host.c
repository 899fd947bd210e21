/* Public calls for soft bodies: sbrun/soft_body.h. */
#include "base/diagnostic.h"
#include "coupling/ragdoll/ragdoll.h"
#include "math/usable.h"
#include "math/vec3.h"
#include "soft/soft.h"
#include "soft/solvers/scheme.h"
#include "world/api/api.h"

/* A call with its character and body; NULL if it fails. */
typedef struct soft_call {
  const char *name;
  sbri_character *c;
  const sbri_body *body;
  sbri_vertex_weights at; /* of its vertex */
} soft_call;

static bool find_body(const sbr_world *world, sbr_character_id character, uint32_t soft_body, soft_call *call,
    sbf_status *status, sbf_diagnostic *error) {
  *status = SBF_FAILED;
  call->c = sbri_character_of(world, character);
  if (!call->c) {
    *status = sbfi_diagnose(error, SBF_CODE_BAD_CALL, "%s: the world has no such character", call->name);
    return false;
  }
  uint32_t count = call->c->model->asset->soft_bodies.count;
  if (soft_body >= count) {
    *status = sbfi_diagnose(error, SBF_CODE_BAD_CALL, "%s: soft body %u does not exist: the asset has %u",
        call->name, soft_body, count);
    return false;
  }
  call->body = &call->c->model->bodies[soft_body];
  if (sbri_body_accepts_forces(call->c, call->body)) return true;
  bool forceless = call->body->level && call->c->model->islands[call->body->island].scheme->forceless;
  *status = sbfi_diagnose(error, SBF_CODE_BAD_CALL, "%s: soft body %u: %s", call->name, soft_body,
      forceless ? "it is stepped by relaxation, which has no forces"
                : "it is not simulated at this level of detail, or is completely pinned");
  return false;
}

/* Finds the points of the vertex, or none for the whole body. */
static bool find_vertex(
    soft_call *call, uint32_t vertex, bool may_be_whole, sbf_status *status, sbf_diagnostic *error) {
  if (vertex == SBR_WHOLE_BODY && may_be_whole) return true;
  if (vertex >= call->body->surface.skin.vertex_count)
    *status = sbfi_diagnose(error, SBF_CODE_BAD_CALL, "%s: vertex %u does not exist: the surface has %u",
        call->name, vertex, call->body->surface.skin.vertex_count);
  else if (sbri_vertex_weights_find(call->c, call->body, vertex, &call->at))
    return true;
  else
    *status = sbfi_diagnose(error, SBF_CODE_BAD_CALL,
        "%s: vertex %u only follows bones: choose another vertex", call->name, vertex);
  return false;
}

static sbf_status check_numbers(
    const char *name, const double *numbers, uint32_t count, sbf_diagnostic *error) {
  for (uint32_t i = 0; i < count; i++)
    if (!sbri_usable(&numbers[i], 1))
      return sbfi_diagnose(
          error, SBF_CODE_BAD_CALL, "%s: %g is not a finite number up to 1e15", name, numbers[i]);
  return SBF_OK;
}

static void wake(sbri_character *c, const sbri_body *body) {
  sbri_character_wake(c);
  sbri_island_wake(c, body->island);
}

static float *velocity_of(sbri_character *c, const sbri_body *body, uint32_t slot) {
  float *of = sbri_velocities(c) + 3 * (size_t)c->model->islands[body->island].first_slot;
  return of + 3 * (slot / SBRI_BLOCK * SBRI_BLOCK) + slot % SBRI_BLOCK;
}

static void add_velocity(float *v, sbf_vec3 change) {
  v[0] += change.x, v[SBRI_BLOCK] += change.y, v[2 * SBRI_BLOCK] += change.z;
}

sbf_status sbr_character_set_soft_velocity(sbr_world *world, sbr_character_id character, uint32_t soft_body,
    sbf_vec3 velocity, sbf_vec3 angular_velocity, sbf_diagnostic *error) {
  soft_call call = {.name = "sbr_character_set_soft_velocity"};
  sbf_status status;
  if (!find_body(world, character, soft_body, &call, &status, error)) return status;
  const double numbers[8] = {character.value, soft_body, (double)velocity.x, (double)velocity.y,
      (double)velocity.z, (double)angular_velocity.x, (double)angular_velocity.y, (double)angular_velocity.z};
  if ((status = check_numbers(call.name, numbers, 8, error)) != SBF_OK) return status;
  sbri_record(world, SBRI_RECORDED_SOFT_VELOCITY, numbers);
  sbri_character *c = call.c;
  const sbri_island now = sbri_island_now(c, &c->model->islands[call.body->island]);
  const sbri_point *positions = sbri_positions(c) + now.first_slot;
  sbr_soft_motion is = sbri_body_motion(c, call.body);
  sbf_vec3 push = sbri_sub(sbri_scale(velocity, c->time_scale), is.velocity);
  sbf_vec3 turn = sbri_sub(sbri_scale(angular_velocity, 1 / c->time_scale), is.angular_velocity);
  for (uint32_t slot = call.body->slots.begin; slot < call.body->slots.end; slot++) {
    if (!(now.masses[slot] > 0)) continue;
    sbf_vec3 arm = sbri_sub(sbri_vec3(positions[slot].x, positions[slot].y, positions[slot].z), is.center);
    add_velocity(velocity_of(c, call.body, slot), sbri_add(push, sbri_cross(turn, arm)));
  }
  wake(c, call.body);
  return SBF_OK;
}

/* Applies an impulse to free points, and to the rigid bodies of pinned ones. */
static void apply_impulse(const soft_call *call, sbf_vec3 impulse) {
  sbri_character *c = call->c;
  const sbri_island now = sbri_island_now(c, &c->model->islands[call->body->island]);
  for (uint32_t k = 0; k < call->at.count; k++) {
    uint32_t slot = call->at.slots[k];
    sbf_vec3 part = sbri_scale(impulse, call->at.weights[k]);
    if (slot < now.free_count) {
      add_velocity(velocity_of(c, call->body, slot), sbri_scale(part, now.inverse_masses[slot]));
      continue;
    }
    int32_t rigid_body = now.pins.rigid_bodies[slot - now.free_count];
    const sbri_point *x = &sbri_positions(c)[now.first_slot + slot];
    if (rigid_body >= 0 && sbri_rigid_is_simulated(c, (uint32_t)rigid_body))
      sbri_rigid_apply_impulse(c, (uint32_t)rigid_body, sbri_vec3(x->x, x->y, x->z), part);
  }
}

sbf_status sbr_character_apply_soft_impulse(sbr_world *world, sbr_character_id character, uint32_t soft_body,
    uint32_t vertex, sbf_vec3 impulse, sbf_diagnostic *error) {
  soft_call call = {.name = "sbr_character_apply_soft_impulse"};
  sbf_status status;
  if (!find_body(world, character, soft_body, &call, &status, error) ||
      !find_vertex(&call, vertex, true, &status, error))
    return status;
  const double numbers[6] = {
      character.value, soft_body, vertex, (double)impulse.x, (double)impulse.y, (double)impulse.z};
  if ((status = check_numbers(call.name, numbers, 6, error)) != SBF_OK) return status;
  sbri_record(world, SBRI_RECORDED_SOFT_IMPULSE, numbers);
  sbf_vec3 own_impulse = sbri_scale(impulse, sbri_own_impulse(call.c));
  if (vertex == SBR_WHOLE_BODY) {
    const sbri_island now = sbri_island_now(call.c, &call.c->model->islands[call.body->island]);
    sbf_vec3 velocity_change = sbri_scale(own_impulse, 1 / sbri_body_mass(call.c, call.body));
    for (uint32_t slot = call.body->slots.begin; slot < call.body->slots.end; slot++)
      if (now.masses[slot] > 0) add_velocity(velocity_of(call.c, call.body, slot), velocity_change);
  } else {
    apply_impulse(&call, own_impulse);
  }
  wake(call.c, call.body);
  return SBF_OK;
}

/* ---- Persistent loads ---- */

static sbri_load *find_grab(sbri_character *c, uint32_t soft_body, uint32_t vertex) {
  for (uint32_t i = 0; i < SBR_LOAD_CAPACITY; i++) {
    sbri_load *load = &sbri_loads(c)[i];
    if (load->kind == SBRI_LOAD_GRAB && load->body == soft_body && load->vertex == vertex) return load;
  }
  return NULL;
}

static sbri_load *find_free_index(const soft_call *call, sbf_status *status, sbf_diagnostic *error) {
  for (uint32_t i = 0; i < SBR_LOAD_CAPACITY; i++)
    if (sbri_loads(call->c)[i].kind == SBRI_LOAD_NONE) return &sbri_loads(call->c)[i];
  *status = sbfi_diagnose(error, SBF_CODE_BAD_CALL,
      "%s: the character already has its maximum of %d forces and grabs: release one, or wait", call->name,
      SBR_LOAD_CAPACITY);
  return NULL;
}

sbf_status sbr_character_apply_soft_force(sbr_world *world, sbr_character_id character, uint32_t soft_body,
    uint32_t vertex, sbf_vec3 force, float seconds, sbf_diagnostic *error) {
  soft_call call = {.name = "sbr_character_apply_soft_force"};
  sbf_status status;
  if (!find_body(world, character, soft_body, &call, &status, error) ||
      !find_vertex(&call, vertex, true, &status, error))
    return status;
  const double numbers[7] = {
      character.value, soft_body, vertex, (double)force.x, (double)force.y, (double)force.z, (double)seconds};
  if ((status = check_numbers(call.name, numbers, 7, error)) != SBF_OK) return status;
  if (!(seconds > 0))
    return sbfi_diagnose(
        error, SBF_CODE_BAD_CALL, "%s: %g seconds: use more than 0", call.name, (double)seconds);
  sbri_load *load = find_free_index(&call, &status, error);
  if (!load) return status;
  sbri_record(world, SBRI_RECORDED_SOFT_FORCE, numbers);
  *load = (sbri_load){
      .kind = SBRI_LOAD_FORCE, .body = soft_body, .vertex = vertex, .force = force, .seconds = seconds};
  wake(call.c, call.body);
  return SBF_OK;
}

enum { GRAB_COOKIE = 0x5b72686f };

sbr_vertex_grab sbr_default_vertex_grab(void) {
  return (sbr_vertex_grab){.cookie = GRAB_COOKIE, .damping_ratio = 1};
}

static sbf_status check_grab(const char *name, const sbr_vertex_grab *grab, sbf_diagnostic *error) {
  if (grab->cookie != GRAB_COOKIE)
    return sbfi_diagnose(
        error, SBF_CODE_BAD_CALL, "%s: grab was not initialised: begin with sbr_default_vertex_grab()", name);
  if (!(grab->frequency_hz >= 0 && grab->frequency_hz <= 100))
    return sbfi_diagnose(
        error, SBF_CODE_BAD_CALL, "%s: frequency_hz is %g: use 0 to 100", name, (double)grab->frequency_hz);
  if (!(grab->damping_ratio >= 0 && grab->damping_ratio <= 10))
    return sbfi_diagnose(
        error, SBF_CODE_BAD_CALL, "%s: damping_ratio is %g: use 0 to 10", name, (double)grab->damping_ratio);
  if (!(grab->max_force >= 0))
    return sbfi_diagnose(
        error, SBF_CODE_BAD_CALL, "%s: max_force is %g N: use 0 or more", name, (double)grab->max_force);
  return SBF_OK;
}

sbf_status sbr_character_grab_vertex(sbr_world *world, sbr_character_id character, uint32_t soft_body,
    uint32_t vertex, const sbr_vertex_grab *grab, sbf_diagnostic *error) {
  soft_call call = {.name = "sbr_character_grab_vertex"};
  sbf_status status;
  if (!grab) return sbfi_diagnose(error, SBF_CODE_BAD_CALL, "%s: grab is NULL", call.name);
  if (!find_body(world, character, soft_body, &call, &status, error) ||
      !find_vertex(&call, vertex, false, &status, error))
    return status;
  const double numbers[9] = {character.value, soft_body, vertex, grab->target.x, grab->target.y,
      grab->target.z, (double)grab->frequency_hz, (double)grab->damping_ratio, (double)grab->max_force};
  if ((status = check_numbers(call.name, numbers, 9, error)) != SBF_OK ||
      (status = check_grab(call.name, grab, error)) != SBF_OK)
    return status;
  sbri_load *load = find_grab(call.c, soft_body, vertex);
  if (!load) load = find_free_index(&call, &status, error);
  if (!load) return status;
  sbri_record(world, SBRI_RECORDED_SOFT_HOLD, numbers);
  load->kind = SBRI_LOAD_GRAB, load->body = soft_body, load->vertex = vertex;
  load->target = grab->target;
  load->frequency_hz = grab->frequency_hz > 0 ? grab->frequency_hz : 5;
  load->damping_ratio = grab->damping_ratio, load->max_force = grab->max_force;
  wake(call.c, call.body);
  return SBF_OK;
}

bool sbr_character_release_vertex(
    sbr_world *world, sbr_character_id character, uint32_t soft_body, uint32_t vertex) {
  sbri_character *c = sbri_character_of(world, character);
  sbri_load *load = c ? find_grab(c, soft_body, vertex) : NULL;
  if (!load) return false;
  sbri_record(world, SBRI_RECORDED_SOFT_RELEASE, (const double[]){character.value, soft_body, vertex});
  *load = (sbri_load){0};
  sbri_character_wake(c);
  const sbri_body *body = &c->model->bodies[soft_body];
  if (body->level) sbri_island_wake(c, body->island);
  return true;
}
