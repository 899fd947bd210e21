/* Springs of an island and its frequencies: springs are listed once each, then arranged for eight points of a
 * block at a time. */
#include <string.h>

#include "mechanics/level_points.h"
#include "prepare/hinges.h"
#include "prepare/softening.h"
#include "soft/solvers/rolling.h"
#include "soft/solvers/scheme.h"

static float rest_distance(const sbri_island *island, uint32_t a, uint32_t b) {
  const sbri_point *p = &island->rest[a], *q = &island->rest[b];
  float x = q->x - p->x, y = q->y - p->y, z = q->z - p->z;
  return sqrtf(x * x + y * y + z * z);
}

/* Distance of two points of levels at rest, without pins, which may move them. */
static float authored_distance(const sbri_body *a, uint32_t from, const sbri_body *b, uint32_t to) {
  const sbf_vec3 *p = &a->level->positions.at[from], *q = &b->level->positions.at[to];
  float x = q->x - p->x, y = q->y - p->y, z = q->z - p->z;
  return sqrtf(x * x + y * y + z * z);
}

static const sbfi_spring_bounds unbounded = {.strain_min = -1};

static bool add(sbri_island_maker *m, sbfi_spring spring, const sbfi_spring_bounds *bounds) {
  uint32_t free_count = m->island->free_count;
  bool inert = (spring.a >= free_count && spring.b >= free_count) || spring.a == spring.b ||
               !(spring.stiffness_n_m > 0 || spring.damping_ns_m > 0);
  return inert || (sbfi_array_append(&m->springs, &spring, 1) && sbfi_array_append(&m->bounds, bounds, 1));
}

/* ---- Spring list ---- */

/* Factors of weight maps on the attributes of springs, at the level's points; NULL: 1 everywhere. */
typedef struct spring_factors {
  const float *damping, *yield, *tear;
} spring_factors;

static float factor_of(const float *factors, const uint32_t ends[2]) {
  return factors ? 0.5f * (factors[ends[0]] + factors[ends[1]]) : 1;
}

/* Attributes that the set does not state are those of the body. */
static sbfi_spring_bounds bounds_of(
    const sbf_attributes *is, const sbf_spring_set *set, const spring_factors *by, const uint32_t ends[2]) {
  sbfi_spring_bounds bounds = {set->strain_min > -1 ? set->strain_min : is->strain_min,
      set->strain_max > 0 ? set->strain_max : is->strain_max,
      set->yield_strain > 0 ? set->yield_strain : is->yield_strain, is->yield_flow,
      set->tear_strain > 0 ? set->tear_strain : is->tear_strain};
  bounds.yield_strain *= factor_of(by->yield, ends);
  bounds.tear_strain *= factor_of(by->tear, ends);
  return bounds;
}

static bool add_sets(sbri_island_maker *m, const sbri_body *body) {
  const sbf_level *level = body->level;
  size_t total = 0;
  for (uint32_t s = 0; s < level->springs.count; s++) {
    total += level->springs.at[s].ends.count;
    m->states_rest_lengths = m->states_rest_lengths || level->springs.at[s].rest_lengths.count;
  }
  float *stiffness = sbri_scratch(m, total, sizeof *stiffness);
  float *volumes = sbri_scratch(m, level->positions.count, sizeof *volumes);
  double *sums = sbri_scratch(m, level->positions.count, 2 * sizeof *sums);
  if (!stiffness || !volumes || !sums) return false;
  sbf_level_stiffness(body->source, level, volumes, sums, stiffness);
  const sbf_attributes *is = &body->source->attributes;
  spring_factors by;
  if (!sbri_factors_find(m, body, SBF_WEIGHT_PROPERTY_STIFFNESS_DAMPING, &by.damping) ||
      !sbri_factors_find(m, body, SBF_WEIGHT_PROPERTY_YIELD_STRAIN, &by.yield) ||
      !sbri_factors_find(m, body, SBF_WEIGHT_PROPERTY_TEAR_STRAIN, &by.tear))
    return false;
  for (uint32_t s = 0; s < level->springs.count; s++) {
    const sbf_spring_set *set = &level->springs.at[s];
    if (level->model != SBF_ELASTIC_MODEL_SPRINGS &&
        !set->extra) { /* with another material model only these are active */
      stiffness += set->ends.count;
      continue;
    }
    for (uint32_t i = 0; i < set->ends.count; i++) {
      const uint32_t *ends = set->ends.at[i].at;
      uint32_t a = body->slots.from_point[ends[0]], b = body->slots.from_point[ends[1]];
      float k = *stiffness++;
      float rest =
          set->rest_lengths.count ? set->rest_lengths.at[i] : authored_distance(body, ends[0], body, ends[1]);
      float damping = set->damping.count ? set->damping.at[set->damping.count == 1 ? 0 : i]
                                         : is->stiffness_damping * factor_of(by.damping, ends) * k;
      sbf_f32_list ratios = set->compression_ratio;
      float slack = ratios.count ? 1 - ratios.at[ratios.count == 1 ? 0 : i] : 0;
      sbfi_spring_bounds bounds = bounds_of(is, set, &by, ends);
      if (!add(m, (sbfi_spring){a, b, k, rest, damping, slack}, &bounds)) return false;
    }
  }
  return true;
}

static bool add_goals(sbri_island_maker *m, uint32_t index) {
  const sbri_goal *goals = m->goals.at;
  for (uint32_t g = 0; g < m->goals.count; g++) {
    if (goals[g].body != index) continue;
    uint32_t slot = sbri_maker_body(m, index)->slots.from_point[goals[g].point];
    if (!add(m, (sbfi_spring){slot, m->first_goal + g, goals[g].stiffness, 0, goals[g].damping, 0},
            &unbounded))
      return false;
  }
  return true;
}

static bool add_cross_springs(sbri_island_maker *m, const sbf_cross_springs *cross) {
  const sbri_body *a = &m->model->bodies[cross->body_a], *b = &m->model->bodies[cross->body_b];
  const sbri_body *softer = b->source->attributes.young_modulus < a->source->attributes.young_modulus ? b : a;
  for (uint32_t i = 0; i < cross->ends.count; i++) {
    uint32_t at_a = a->slots.from_point[cross->ends.at[i].at[0]],
             at_b = b->slots.from_point[cross->ends.at[i].at[1]];
    uint32_t free_count = m->island->free_count;
    float mass_a = at_a < free_count ? m->island->masses[at_a] : 0;
    float mass_b = at_b < free_count ? m->island->masses[at_b] : 0;
    float lighter = mass_a > 0 && (mass_a < mass_b || !(mass_b > 0)) ? mass_a : mass_b;
    float k = cross->stiffness.count ? cross->stiffness.at[cross->stiffness.count == 1 ? 0 : i]
                                     : sbri_natural_stiffness(softer->source, lighter);
    float rest = cross->rest_lengths.count
                     ? cross->rest_lengths.at[i]
                     : authored_distance(a, cross->ends.at[i].at[0], b, cross->ends.at[i].at[1]);
    float damping = cross->damping.count ? cross->damping.at[cross->damping.count == 1 ? 0 : i]
                                         : softer->source->attributes.stiffness_damping * k;
    if (!add(m, (sbfi_spring){at_a, at_b, k, rest, damping, 0}, &unbounded)) return false;
  }
  return true;
}

static bool list_springs(sbri_island_maker *m) {
  sbri_island *island = m->island;
  for (uint32_t b = 0; b < island->body_count; b++) {
    sbri_body *body = sbri_maker_body(m, b);
    body->elements.first_spring = (uint32_t)m->springs.count;
    if (!add_sets(m, body) || !add_goals(m, b)) return false;
    body->elements.spring_end = (uint32_t)m->springs.count;
  }
  const sbf_asset *asset = m->model->asset;
  for (uint32_t i = 0; i < asset->cross_springs.count; i++) {
    const sbf_cross_springs *cross = &asset->cross_springs.at[i];
    m->states_rest_lengths = m->states_rest_lengths || cross->rest_lengths.count;
    bool here = &m->model->islands[m->model->bodies[cross->body_a].island] == island;
    if (here && sbri_cross_springs_act(m->model, cross) && !add_cross_springs(m, cross)) return false;
  }
  island->springs.count = (uint32_t)m->springs.count;
  sbfi_spring *springs = sbri_model_allocate(m, island->springs.count, sizeof *springs);
  if (!springs) return false;
  if (island->springs.count) memcpy(springs, m->springs.at, island->springs.count * sizeof *springs);
  island->springs.at = m->listed = springs;
  return true;
}

/* Finds properties of the springs at rest. */
static void measure_springs(sbri_island *island) {
  double lengths = 0;
  for (uint32_t i = 0; i < island->springs.count; i++) {
    const sbfi_spring *s = &island->springs.at[i];
    double beta = s->stiffness_n_m > 0 ? (double)s->damping_ns_m / s->stiffness_n_m : 0;
    if (beta > island->springs.stiffness_damping_s) island->springs.stiffness_damping_s = beta;
    float length = rest_distance(island, s->a, s->b);
    float stretch = length > 0 ? 1 - s->rest_length_m / length : 0;
    if (s->rest_length_m > 0 && stretch > island->springs.rest_stretch)
      island->springs.rest_stretch = stretch;
    lengths += (double)length;
  }
  if (island->springs.count) island->stability.cell_m = (float)(lengths / island->springs.count);
}

/* ---- Cells ---- */

typedef struct cell_tables {
  sbri_spring_cell *cells;
  float *damping, *slack; /* NULL: none */
  uint32_t *links;
} cell_tables;

static void put(const sbri_island *island, const cell_tables *t, uint32_t *used, uint32_t spring,
    uint32_t slot, uint32_t other) {
  const sbfi_spring *s = &island->springs.at[spring];
  if (slot >= island->cells.slot_count) return;
  uint32_t lane = slot % SBRI_BLOCK, index = island->cells.begins[slot / SBRI_BLOCK] + used[slot]++;
  t->cells[index].others[lane] = other;
  t->cells[index].stiffness[lane] = s->stiffness_n_m;
  t->cells[index].rest_force[lane] = s->stiffness_n_m * s->rest_length_m;
  if (t->damping) t->damping[index * SBRI_BLOCK + lane] = s->damping_ns_m;
  if (t->slack) t->slack[index * SBRI_BLOCK + lane] = s->slack;
  if (t->links) t->links[index * SBRI_BLOCK + lane] = island->links.of_spring[spring];
}

/* Maximum number of springs that move with a split point: half of those of any point, since the larger part
 * stays, and at most this. */
enum { MAX_PARTING = 32 };

/* Reserves spring rows for spare slots. */
static void reserve_rows(const sbri_island_maker *m, uint32_t *used) {
  for (uint32_t b = 0; b < m->island->body_count; b++) {
    const sbri_body *body = sbri_maker_body(m, b);
    uint32_t max = 0;
    if (!sbri_body_frays(body)) continue;
    for (uint32_t slot = body->slots.begin; slot < body->slots.first_spare; slot++)
      max = used[slot] > max ? used[slot] : max;
    max = max / 2 < MAX_PARTING ? max / 2 : MAX_PARTING;
    for (uint32_t slot = body->slots.first_spare; slot < body->slots.real_end; slot++) used[slot] = max;
  }
}

static bool make_cells(sbri_island_maker *m) {
  sbri_island *island = m->island;
  /* Reactions on pinned points are needed only with rigid bodies. */
  island->cells.slot_count = m->model->rigid.body_count ? island->slot_count : island->free_count;
  uint32_t block_count = island->cells.slot_count / SBRI_BLOCK;
  uint32_t *begins = sbri_model_allocate(m, (size_t)block_count + 1, sizeof *begins);
  uint32_t *ends = sbri_model_allocate(m, block_count, sizeof *ends);
  uint32_t *used = sbri_scratch(m, island->slot_count, sizeof *used);
  if (!begins || !ends || !used) return false;
  bool damped = false, slack = false; /* kernels check for slack only if there is damping */
  for (uint32_t i = 0; i < island->springs.count; i++) {
    used[island->springs.at[i].a]++, used[island->springs.at[i].b]++;
    slack = slack || island->springs.at[i].slack != 0;
    damped = damped || slack || island->springs.at[i].damping_ns_m > 0;
  }
  if (island->springs.tear) reserve_rows(m, used);
  for (uint32_t block = 0; block < block_count; block++) {
    uint32_t max = 0;
    for (uint32_t lane = 0; lane < SBRI_BLOCK; lane++)
      if (used[block * SBRI_BLOCK + lane] > max) max = used[block * SBRI_BLOCK + lane];
    begins[block + 1] = begins[block] + max;
  }
  uint32_t cell_count = begins[block_count];
  size_t lanes = (size_t)cell_count * SBRI_BLOCK;
  bool flows = island->links.flows != NULL;
  const cell_tables t = {.cells = sbri_model_allocate(m, cell_count, sizeof *t.cells),
      .damping = damped ? sbri_model_allocate(m, lanes, sizeof *t.damping) : NULL,
      .slack = slack ? sbri_model_allocate(m, lanes, sizeof *t.slack) : NULL,
      .links = flows ? sbri_model_allocate(m, lanes, sizeof *t.links) : NULL};
  if (!t.cells || (damped && !t.damping) || (slack && !t.slack) || (flows && !t.links)) return false;
  for (uint32_t block = 0; block < block_count; block++)
    for (uint32_t c = begins[block]; c < begins[block + 1]; c++)
      for (uint32_t lane = 0; lane < SBRI_BLOCK; lane++) t.cells[c].others[lane] = block * SBRI_BLOCK + lane;
  island->cells.begins = begins, island->cells.ends = ends;
  island->cells.at = t.cells, island->cells.damping = t.damping;
  island->cells.slack = t.slack, island->cells.links = t.links;
  memset(used, 0, island->slot_count * sizeof *used);
  for (uint32_t i = 0; i < island->springs.count; i++) {
    const sbfi_spring *s = &island->springs.at[i];
    put(island, &t, used, i, s->a, s->b);
    put(island, &t, used, i, s->b, s->a);
  }
  for (uint32_t slot = 0; slot < island->cells.slot_count; slot++) {
    uint32_t block = slot / SBRI_BLOCK, end = begins[block] + used[slot];
    if (slot % SBRI_BLOCK == 0 || end > ends[block]) ends[block] = end;
  }
  return true;
}

/* ---- Frequencies ---- */

/* For lattices above this size only an upper bound of the lowest mode is computed: refining it would take
 * more than a tenth of a second, and the bound of a fine lattice is close. */
enum { MAX_REFINED = 3000 };

/* Maximum displacement of a body's points by its bones, as a fraction of their distance from the pins. Beyond
 * it the bones move the whole body along: springs cannot distinguish inside from outside and would not
 * restore it. A sudden start displaces a body twice as far as a slow one. Bending of a sheet does not count,
 * because a sheet has no inside. */
static const float MAX_SWAY = 0.25f;

/* Number of a body's points from which its extent is estimated. */
enum { REACH_SAMPLES = 256 };

/* Extent of the body from its pins, m; at most its size. */
static float reach_of(const sbri_body *body, uint32_t free_count) {
  const sbf_vec3 *at = body->level->positions.at;
  uint32_t count = body->level->positions.count, step = count / REACH_SAMPLES + 1;
  float reach2 = 0;
  for (uint32_t i = 0; i < count; i += step) {
    float nearest2 = body->rest_size_m * body->rest_size_m;
    for (uint32_t k = 0; body->slots.from_point[i] < free_count && k < count; k++) {
      if (body->slots.from_point[k] < free_count) continue;
      sbf_vec3 d = {at[i].x - at[k].x, at[i].y - at[k].y, at[i].z - at[k].z};
      nearest2 = fminf(nearest2, d.x * d.x + d.y * d.y + d.z * d.z);
    }
    if (body->slots.from_point[i] < free_count) reach2 = fmaxf(reach2, nearest2);
  }
  return sqrtf(reach2);
}

/* Bounds the drivers' acceleration so that an oscillator of `w` rad/s moves by at most `sway`, m. */
static void bound_start(sbri_island *island, float sway, float w) {
  float acceleration = sway * w * w, push = sway * w;
  if (!(acceleration > 0)) return;
  bool first = island->stability.max_acceleration_m_s2 == 0;
  if (first || acceleration < island->stability.max_acceleration_m_s2)
    island->stability.max_acceleration_m_s2 = acceleration;
  if (first || push < island->stability.max_velocity_change_m_s)
    island->stability.max_velocity_change_m_s = push;
}

/* Frequency of the body's lowest mode in the network, and by its regions, rad/s. */
static double lowest_of(
    const sbri_island *island, const sbri_body *body, const sbf_spring_network *own, double *scratch) {
  double elastic = sbf_network_lowest(own, body->elements.tetrahedron_count < MAX_REFINED, scratch);
  double regions = sbri_regions_lowest(island, body, scratch);
  return sqrt(elastic * elastic + regions * regions);
}

static bool find_damping(sbri_island_maker *m, sbf_spring_network network, float *masses, double *scratch) {
  const sbf_environment *environment = &m->model->asset->environment;
  for (uint32_t b = 0; b < m->island->body_count; b++) {
    sbri_body *body = sbri_maker_body(m, b);
    const sbf_attributes *is = &body->source->attributes;
    memset(masses, 0, network.point_count * sizeof *masses);
    memcpy(masses + body->slots.begin, m->island->masses + body->slots.begin,
        (body->slots.end - body->slots.begin) * sizeof *masses);
    sbf_spring_network own = network;
    own.ends += body->elements.first_spring;
    own.stiffness += body->elements.first_spring;
    own.spring_count = body->elements.spring_end - body->elements.first_spring;
    own.tetrahedra += body->elements.first_tetrahedron;
    own.young_modulus += body->elements.first_tetrahedron;
    own.poisson_ratios += body->elements.first_tetrahedron;
    own.tetrahedron_count = body->elements.tetrahedron_count;
    double stretching = lowest_of(m->island, body, &own, scratch);
    if (!sbri_hinges_add(m->island, body, &m->scratch, &own)) return false;
    double lowest = own.hinge_count ? lowest_of(m->island, body, &own, scratch) : stretching;
    bound_start(m->island, MAX_SWAY * reach_of(body, m->island->free_count), (float)stretching);
    body->damping.lowest_rad_s = (float)lowest;
    body->damping.stretching_rad_s = (float)stretching;
    body->damping.alpha_1_s = is->mass_damping + (float)(2 * is->damping_ratio * lowest);
    body->contact.rolling_fraction =
        lowest > 0 ? sbri_rolling_fraction(0.5f * body->damping.alpha_1_s / (float)lowest) : 0;
    body->damping.media_friction_1_s = is->media_friction + environment->media_friction;
    body->contact.friction = is->friction;
    body->contact.restitution = is->restitution;
    sbf_body_measures measures;
    sbf_body_measure(body->source, &measures);
    bool bare = body->source->surface.polygon_sizes.count == 0;
    bool solid = bare ? body->elements.tetrahedron_count > 0 : !measures.sheet;
    body->damping.sliding_rad_s = solid && !body->is_pinned ? body->damping.lowest_rad_s : 0;
    const sbf_collision *collision = &body->source->collision;
    body->contact.margin_m = bare             ? collision->particle_radius
                             : measures.sheet ? collision->outer_thickness
                                              : 0;
  }
  return true;
}

/* Damping of each point if a map scales mass_damping; the part of the damping ratio is not scaled. */
static bool find_alphas(sbri_island_maker *m) {
  uint32_t free_count = m->island->free_count;
  for (uint32_t b = 0; b < m->island->body_count; b++) {
    sbri_body *body = sbri_maker_body(m, b);
    float stated = body->source->attributes.mass_damping, rest = body->damping.alpha_1_s - stated;
    const float *factors = NULL;
    if (!sbri_factors_find(m, body, SBF_WEIGHT_PROPERTY_MASS_DAMPING, &factors)) return false;
    if (!factors || !(stated > 0)) continue;
    float *alphas = sbri_model_allocate(m, free_count, sizeof *alphas), max = 0;
    if (!alphas) return false;
    for (uint32_t slot = 0; slot < free_count; slot++) alphas[slot] = body->damping.alpha_1_s;
    for (uint32_t i = 0; i < body->level->positions.count; i++) {
      float alpha = rest + stated * factors[i];
      if (body->slots.from_point[i] >= free_count) continue;
      alphas[body->slots.from_point[i]] = alpha;
      max = alpha > max ? alpha : max;
    }
    body->damping.alphas = alphas, body->damping.alpha_1_s = max;
  }
  return true;
}

/* Friction of each point, if a map scales it. */
static bool find_frictions(sbri_island_maker *m) {
  uint32_t free_count = m->island->free_count;
  for (uint32_t b = 0; b < m->island->body_count; b++) {
    sbri_body *body = sbri_maker_body(m, b);
    const float *factors = NULL;
    if (!sbri_factors_find(m, body, SBF_WEIGHT_PROPERTY_FRICTION, &factors)) return false;
    if (!factors) continue;
    float *frictions = sbri_model_allocate(m, free_count, sizeof *frictions);
    if (!frictions) return false;
    for (uint32_t slot = 0; slot < free_count; slot++) frictions[slot] = body->contact.friction;
    for (uint32_t i = 0; i < body->level->positions.count; i++)
      if (body->slots.from_point[i] < free_count)
        frictions[body->slots.from_point[i]] = body->contact.friction * factors[i];
    body->contact.frictions = frictions;
  }
  return true;
}

static bool find_frequencies(sbri_island_maker *m, sbf_spring_network *found) {
  sbri_island *island = m->island;
  uint32_t points = island->slot_count, count = island->springs.count;
  sbf_vec3 *positions = sbri_scratch(m, points, sizeof *positions);
  float *masses = sbri_scratch(m, points, sizeof *masses),
        *anchors = sbri_scratch(m, points, sizeof *anchors);
  sbf_uint2 *ends = sbri_scratch(m, count, sizeof *ends);
  float *stiffness = sbri_scratch(m, count, sizeof *stiffness);
  double *scratch = sbri_scratch(m, 16 * (size_t)points, sizeof *scratch);
  if (!positions || !masses || !anchors || !ends || !stiffness || !scratch) return false;
  for (uint32_t i = 0; i < points; i++)
    positions[i] = (sbf_vec3){island->rest[i].x, island->rest[i].y, island->rest[i].z};
  if (island->free_count) memcpy(masses, island->masses, island->free_count * sizeof *masses);
  for (uint32_t i = 0; i < count; i++) {
    const sbfi_spring *s = &island->springs.at[i];
    ends[i] = (sbf_uint2){{s->a, s->b}};
    stiffness[i] = s->slack < 0 ? s->stiffness_n_m * (1 - s->slack) : s->stiffness_n_m;
    if (s->rest_length_m > 0) continue;
    /* A spring of rest length 0, such as a goal's, is isotropic: it counts like an anchor, or at most twice
     * if both ends are free. */
    bool a_free = s->a < island->free_count, b_free = s->b < island->free_count;
    float k = a_free && b_free ? 2 * s->stiffness_n_m : s->stiffness_n_m;
    stiffness[i] = 0;
    if (a_free) anchors[s->a] += k;
    if (b_free) anchors[s->b] += k;
  }
  sbf_spring_network network = {.point_count = points,
      .spring_count = count,
      .positions = positions,
      .masses = masses,
      .anchors = anchors,
      .ends = ends,
      .stiffness = stiffness};
  if (!sbri_tetrahedra_network(m, &network) || !sbri_soften(m, &network, scratch)) return false;
  island->stability.bound_rad_s = sbf_network_highest_bound(&network, scratch);
  island->stability.fastest_rad_s = sbri_fastest(&network, scratch);
  if (island->stability.fastest_rad_s > island->stability.bound_rad_s)
    island->stability.fastest_rad_s = island->stability.bound_rad_s;
  double regions =
      island->regions.max_rad_s * island->regions.max_rad_s; /* no mode is faster than by their sum */
  island->stability.bound_rad_s =
      sqrt(island->stability.bound_rad_s * island->stability.bound_rad_s + regions);
  island->stability.fastest_rad_s =
      sqrt(island->stability.fastest_rad_s * island->stability.fastest_rad_s + regions);
  if (!sbri_island_preload(m, &network)) return false;
  if (!find_damping(m, network, masses, scratch) || !find_alphas(m) || !find_frictions(m) ||
      !sbri_attached_responses_make(m, &network))
    return false;
  *found = network;
  return true;
}

bool sbri_island_springs(sbri_island_maker *m) {
  sbf_spring_network network;
  if (!list_springs(m) || !sbri_tetrahedra_list(m) || !sbri_regions_make(m) || !find_frequencies(m, &network))
    return false;
  measure_springs(m->island);
  bool bounded = false;
  const sbfi_spring_bounds *bounds = m->bounds.at;
  for (size_t i = 0; i < m->bounds.count; i++)
    bounded = bounded || bounds[i].strain_min > -1 || bounds[i].strain_max > 0 || bounds[i].tear_strain > 0 ||
              bounds[i].yield_strain > 0;
  bool linked = m->island->scheme->sweeps || m->island->stepping.is_routed ||
                (bounded && !m->island->scheme->forceless);
  if (linked && !sbri_links_make(m->model, m->island, bounds)) return false;
  for (uint32_t b = 0; b < m->island->body_count; b++) {
    const sbri_body *body = sbri_maker_body(m, b);
    m->island->springs.tear = m->island->springs.tear || (m->island->links.flows && sbri_body_frays(body) &&
                                                             body->slots.real_end > body->slots.first_spare);
  }
  return make_cells(m) && sbri_tetrahedra_make(m, &network) && sbri_solid_limits_make(m);
}
