/* Slots, springs, masses and frequencies of one island. */
#include <string.h>

#include "base/diagnostic.h"
#include "mechanics/level_points.h"
#include "prepare/island_maker.h"
#include "prepare/pins.h"
#include "soft/solvers/scheme.h"

/* Mass of a free point that has none, as a fraction of the mean: without mass its acceleration would be
 * unbounded. */
static const float MIN_MASS_FRACTION = 1e-3f;

static uint32_t padded(uint32_t count) {
  return (count + SBRI_BLOCK - 1) / SBRI_BLOCK * SBRI_BLOCK;
}

/* ---- Pins and masses ---- */

static bool read_goals(sbri_island_maker *m, uint32_t index) {
  const sbri_body *body = sbri_maker_body(m, index);
  for (uint32_t s = 0; s < body->level->pins.count; s++) {
    const sbf_pin_set *set = &body->level->pins.at[s];
    for (uint32_t i = 0; i < set->points.count; i++) {
      uint32_t point = set->points.at[i];
      float weight = sbri_pin_weight(set, i);
      if (m->frames[index][point] != SBRI_FREE || !(weight > 0) || weight >= 1) continue;
      sbri_goal *g = sbfi_array_push(&m->goals, 1);
      if (!g) return false;
      float full =
          set->stiffness > 0 ? set->stiffness : sbri_natural_stiffness(body->source, m->masses[index][point]);
      *g = (sbri_goal){index, point, s, sbri_pin_frame(m->model, set), weight * full, weight * set->damping,
          sbri_pin_position(m->model, body->level, set, i)};
    }
  }
  return true;
}

/* Interior points, which have no face, all get the same mass by the rule for masses. If they are free, their
 * total is divided in proportion to the stiffness of their springs. Otherwise the centre point, which has a
 * spring to every surface point, would be twice as fast as all others and double the number of substeps. */
static bool distribute_interior_mass(sbri_island_maker *m, const sbri_body *body, float *masses) {
  const sbf_level *level = body->level;
  const sbf_polygon_mesh *mesh = &body->source->surface;
  uint32_t count = level->positions.count, total = 0;
  if (level->masses.count || level->model != SBF_ELASTIC_MODEL_SPRINGS) return true;
  for (uint32_t s = 0; s < level->springs.count; s++) total += level->springs.at[s].ends.count;
  uint8_t *outside = sbri_scratch(m, count, 1);
  float *stiffness = sbri_scratch(m, total, sizeof *stiffness),
        *volumes = sbri_scratch(m, count, sizeof *volumes);
  double *sums = sbri_scratch(m, count, 2 * sizeof *sums), mass = 0, all = 0;
  if (!outside || !stiffness || !volumes || !sums) return false;
  sbf_level_stiffness(body->source, level, volumes, sums, stiffness);
  for (uint32_t i = 0; i < mesh->polygon_points.count; i++) {
    uint32_t point = sbfi_level_point(level, mesh->polygon_points.at[i]);
    if (point != UINT32_MAX) outside[point] = 1;
  }
  for (uint32_t i = 0; i < count; i++) sums[i] = 0;
  for (uint32_t s = 0; s < level->springs.count; s++)
    for (uint32_t i = 0; i < level->springs.at[s].ends.count; i++, stiffness++)
      for (int end = 0; end < 2; end++) sums[level->springs.at[s].ends.at[i].at[end]] += (double)*stiffness;
  for (uint32_t i = 0; i < count; i++)
    if (!outside[i] && sums[i] > 0) mass += (double)masses[i], all += sums[i];
  for (uint32_t i = 0; i < count; i++)
    if (!outside[i] && sums[i] > 0) masses[i] = (float)(mass * (sums[i] / all));
  return true;
}

static bool read_body(sbri_island_maker *m, uint32_t index) {
  const sbri_body *body = sbri_maker_body(m, index);
  uint32_t count = body->level->positions.count;
  uint32_t *frames = m->frames[index] = sbri_scratch(m, count, sizeof *frames);
  m->positions[index] = sbri_scratch(m, count, sizeof **m->positions);
  float *masses = m->masses[index] = sbri_scratch(m, count, sizeof *masses);
  uint8_t *pinned = sbri_scratch(m, count, 1);
  if (!frames || !m->positions[index] || !masses || !pinned) return false;
  sbri_pins_read(m->model, body->level, frames, m->positions[index]);
  for (uint32_t i = 0; i < count && m->options->free; i++) {
    frames[i] = SBRI_FREE;
    m->positions[index][i] = body->level->positions.at[i];
  }
  uint32_t free_count = 0;
  for (uint32_t i = 0; i < count; i++) {
    pinned[i] = frames[i] != SBRI_FREE;
    free_count += !pinned[i];
  }
  double sum = sbf_level_masses(body->source, body->level, pinned, masses);
  if (m->options->free && !distribute_interior_mass(m, body, masses)) return false;
  float min = free_count ? (float)(sum / free_count) * MIN_MASS_FRACTION : 0;
  for (uint32_t i = 0; i < count; i++)
    if (!pinned[i] && masses[i] < min) masses[i] = min;
  return m->options->free || read_goals(m, index);
}

/* ---- Slots ---- */

static void count_valences(const sbri_island_maker *m, uint32_t index, uint32_t *valences) {
  const sbf_level *level = sbri_maker_body(m, index)->level;
  memset(valences, 0, level->positions.count * sizeof *valences);
  for (uint32_t s = 0; s < level->springs.count; s++)
    for (uint32_t i = 0; i < level->springs.at[s].ends.count; i++) {
      valences[level->springs.at[s].ends.at[i].at[0]]++;
      valences[level->springs.at[s].ends.at[i].at[1]]++;
    }
}

/* Number of spare slots for points that split. */
static uint32_t reserve_of(const sbri_island_maker *m, const sbri_body *body) {
  bool frays = sbri_body_frays(body) && !m->island->scheme->forceless;
  if (!frays && !sbri_body_tears(body)) return 0;
  return m->options->tear_points ? m->options->tear_points : body->level->positions.count / 2;
}

/* Appends free points from slot `next` on by decreasing number of springs, equal ones in the level's order.
 */
static bool append_free(sbri_island_maker *m, uint32_t index, uint32_t next, uint32_t *slot_from_point) {
  sbri_body *body = sbri_maker_body(m, index);
  uint32_t count = body->level->positions.count, max = 0;
  uint32_t *valences = sbri_scratch(m, count, sizeof *valences);
  if (!valences) return false;
  count_valences(m, index, valences);
  for (uint32_t i = 0; i < count; i++) max = valences[i] > max ? valences[i] : max;
  uint32_t *begins = sbri_scratch(m, (size_t)max + 2, sizeof *begins);
  if (!begins) return false;
  for (uint32_t i = 0; i < count; i++)
    if (m->frames[index][i] == SBRI_FREE) begins[max - valences[i] + 1]++;
  for (uint32_t v = 0; v <= max; v++) begins[v + 1] += begins[v];
  for (uint32_t i = 0; i < count; i++)
    if (m->frames[index][i] == SBRI_FREE) slot_from_point[i] = next + begins[max - valences[i]]++;
  body->slots.begin = next;
  body->slots.first_spare = next + begins[max];
  body->slots.real_end = body->slots.first_spare + reserve_of(m, body);
  body->slots.end = padded(body->slots.real_end);
  return true;
}

static bool make_slots(sbri_island_maker *m) {
  sbri_island *island = m->island;
  uint32_t next = 0;
  for (uint32_t b = 0; b < island->body_count; b++) {
    sbri_body *body = sbri_maker_body(m, b);
    uint32_t *slots = sbri_model_allocate(m, body->level->positions.count, sizeof *slots);
    if (!slots || !append_free(m, b, next, slots)) return false;
    body->slots.from_point = slots;
    next = body->slots.end;
  }
  island->free_count = next;
  for (uint32_t b = 0; b < island->body_count; b++) {
    sbri_body *body = sbri_maker_body(m, b);
    for (uint32_t i = 0; i < body->level->positions.count; i++)
      if (m->frames[b][i] != SBRI_FREE) body->slots.from_point[i] = next++;
  }
  m->first_goal = next;
  island->slot_count = padded(next + (uint32_t)m->goals.count);
  return true;
}

static bool fill_slots(sbri_island_maker *m) {
  sbri_island *island = m->island;
  sbri_point *rest = sbri_model_allocate(m, island->slot_count, sizeof *rest);
  float *masses = sbri_model_allocate(m, island->free_count, sizeof *masses);
  float *inverse_masses = sbri_model_allocate(m, island->free_count, sizeof *inverse_masses);
  float *gravity_scales = sbri_model_allocate(m, island->free_count, sizeof *gravity_scales);
  uint32_t pinned_count = island->slot_count - island->free_count;
  uint32_t *frames = sbri_model_allocate(m, pinned_count, sizeof *frames);
  if (!rest || !masses || !inverse_masses || !gravity_scales || !frames) return false;
  for (uint32_t i = 0; i < pinned_count; i++) frames[i] = sbri_root_frame(m->model);
  for (uint32_t b = 0; b < island->body_count; b++) {
    const sbri_body *body = sbri_maker_body(m, b);
    for (uint32_t i = 0; i < body->level->positions.count; i++) {
      uint32_t slot = body->slots.from_point[i];
      sbf_vec3 p = m->positions[b][i];
      rest[slot] = (sbri_point){p.x, p.y, p.z, 0};
      if (slot >= island->free_count) {
        frames[slot - island->free_count] = m->frames[b][i];
        continue;
      }
      masses[slot] = m->masses[b][i];
      inverse_masses[slot] = masses[slot] > 0 ? 1 / masses[slot] : 0;
      gravity_scales[slot] = body->source->attributes.gravity_scale;
    }
    for (uint32_t slot = body->slots.first_spare; slot < body->slots.end; slot++)
      rest[slot] = rest[body->slots.begin];
  }
  const sbri_goal *goals = m->goals.at;
  for (uint32_t g = 0; g < m->goals.count; g++) {
    uint32_t slot = m->first_goal + g;
    rest[slot] = (sbri_point){goals[g].position.x, goals[g].position.y, goals[g].position.z, 0};
    frames[slot - island->free_count] = goals[g].frame;
  }
  island->rest = m->rest = rest, island->masses = masses, island->inverse_masses = inverse_masses;
  island->gravity_scales = gravity_scales, island->pins.frames = frames;
  return true;
}

/* The pin set of each pinned slot: the first one that pins its point. */
static bool list_pins(sbri_island_maker *m) {
  sbri_island *island = m->island;
  uint32_t pinned_count = island->slot_count - island->free_count;
  sbri_pin_of *pins = sbri_model_allocate(m, pinned_count, sizeof *pins);
  if (!pins) return false;
  for (uint32_t i = 0; i < pinned_count; i++) pins[i] = (sbri_pin_of){UINT32_MAX, UINT32_MAX};
  for (uint32_t b = 0; b < island->body_count; b++) {
    const sbri_body *body = sbri_maker_body(m, b);
    for (uint32_t s = 0; s < body->level->pins.count; s++) {
      const sbf_pin_set *set = &body->level->pins.at[s];
      for (uint32_t i = 0; i < set->points.count; i++) {
        uint32_t slot = body->slots.from_point[set->points.at[i]];
        if (slot < island->free_count || sbri_pin_weight(set, i) < 1) continue;
        sbri_pin_of *pin = &pins[slot - island->free_count];
        if (pin->body == UINT32_MAX) *pin = (sbri_pin_of){island->bodies[b], s};
      }
    }
  }
  const sbri_goal *goals = m->goals.at;
  for (uint32_t g = 0; g < m->goals.count; g++)
    pins[m->first_goal + g - island->free_count] = (sbri_pin_of){island->bodies[goals[g].body], goals[g].set};
  island->pins.sets = pins;
  return true;
}

/* ---- All steps ---- */

static bool make(sbri_island_maker *m) {
  uint32_t count = m->island->body_count;
  m->frames = sbri_scratch(m, count, sizeof *m->frames);
  m->positions = sbri_scratch(m, count, sizeof *m->positions);
  m->masses = sbri_scratch(m, count, sizeof *m->masses);
  if (!m->frames || !m->positions || !m->masses) return false;
  for (uint32_t b = 0; b < count; b++)
    if (!read_body(m, b)) return false;
  if (!make_slots(m) || !fill_slots(m) || !list_pins(m) || !sbri_island_springs(m)) return false;
  for (uint32_t b = 0; b < count; b++)
    if (!sbri_drivers_make(m->model, m->island, sbri_maker_body(m, b))) return false;
  return true;
}

sbf_status sbri_island_make(
    sbr_model *model, sbri_island *island, const sbr_model_options *options, sbf_diagnostic *error) {
  sbri_island_maker m = {.model = model, .island = island, .options = options};
  sbfi_arena_init(&m.scratch, &model->arena.allocator, 0);
  sbfi_array_init(&m.goals, &model->arena.allocator, sizeof(sbri_goal));
  sbfi_array_init(&m.springs, &model->arena.allocator, sizeof(sbfi_spring));
  sbfi_array_init(&m.bounds, &model->arena.allocator, sizeof(sbfi_spring_bounds));
  bool good = make(&m);
  sbfi_array_free(&m.bounds);
  sbfi_array_free(&m.springs);
  sbfi_array_free(&m.goals);
  sbfi_arena_free(&m.scratch);
  return good ? SBF_OK : sbfi_diagnose(error, SBF_CODE_OUT_OF_MEMORY, "no memory for the model");
}
