/* State of a body: energy, volume, strain, inverted elements. */
#include "mechanics/neo_hookean.h"
#include "mechanics/shape_region.h"
#include "mechanics/solid_strain.h"
#include "skin/skin.h"
#include "soft/soft.h"
#include "soft/solvers/external_forces.h"
#include "soft/solvers/scheme.h"

sbfi_spring sbri_spring_now(const sbri_character *c, const sbri_island *island, uint32_t spring) {
  sbfi_spring s = island->springs.at[spring];
  if (!island->links.flows) return s;
  uint32_t at = island->links.first_flow + island->links.of_spring[spring];
  const sbri_link_block *link = &island->links.blocks[island->links.of_spring[spring] / SBRI_BLOCK];
  uint32_t lane = island->links.of_spring[spring] % SBRI_BLOCK;
  s.a = link->a[lane], s.b = link->b[lane]; /* a split spring has other end points */
  s.rest_length_m = sbri_rests(c)[at];
  s.stiffness_n_m *= sbri_strengths(c)[at];
  return s;
}

static void check_springs(const sbri_character *c, const sbri_island *island, const sbri_body *body,
    const sbri_point *positions, sbr_body_health *health) {
  for (uint32_t i = body->elements.first_spring; i < body->elements.spring_end; i++) {
    sbfi_spring s = sbri_spring_now(c, island, i);
    bool torn = s.stiffness_n_m < island->springs.at[i].stiffness_n_m;
    health->torn += torn;
    health->elastic_j += sbfi_springs_energy(&s, 1, &positions->x, 4);
    if (torn || !(s.rest_length_m > 0)) continue; /* goal spring */
    const sbri_point *a = &positions[s.a], *b = &positions[s.b];
    float x = b->x - a->x, y = b->y - a->y, z = b->z - a->z;
    float strain = fabsf(sbfi_spring_strain(&s, sqrtf(x * x + y * y + z * z)));
    health->max_strain = strain > health->max_strain ? strain : health->max_strain;
  }
}

/* State of tetrahedra: energy, minimum J, whether any is inverted, and maximum strain. Elements that cannot
 * have the maximum strain by |s - 1| <= |s^2 - 1| <= |C - 1|, C = F^T F, are not decomposed. */
typedef struct solid_health {
  double energy_j;
  float max_strain;
  float min_ratio; /* J */
  bool inverted;
  uint32_t torn;
} solid_health;

static sbfi_d3 position_of(const sbri_point *p) {
  return (sbfi_d3){p->x, p->y, p->z};
}

static void add_ratio(solid_health *found, double ratio) {
  found->inverted = found->inverted || !(ratio > 0);
  found->min_ratio = ratio < (double)found->min_ratio ? (float)ratio : found->min_ratio;
}

/* An element in its original state. */
static void check_tetrahedron(
    const sbri_body *body, const sbri_point *positions, uint32_t t, solid_health *found) {
  sbfi_tetrahedron element;
  sbfi_d3 x[4];
  if (!sbri_body_tetrahedron(body, t, &element)) return;
  for (int k = 0; k < 4; k++)
    x[k] = position_of(&positions[body->slots.from_point[body->level->lattice.tetrahedra.at[t].at[k]]]);
  sbfi_columns f = sbfi_tetrahedron_gradient(&element, x);
  found->energy_j += sbfi_tetrahedron_energy(&element, x);
  add_ratio(found, sbfi_determinant(&f));
  double square = 0;
  for (int i = 0; i < 3; i++)
    for (int k = 0; k < 3; k++) {
      double off = sbfi_d3_dot(f.at[i], f.at[k]) - (i == k);
      square += off * off;
    }
  if (!(square > (double)found->max_strain * (double)found->max_strain)) return;
  float strain = (float)sbfi_tetrahedron_strains(&element, x).max;
  found->max_strain = strain > found->max_strain ? strain : found->max_strain;
}

/* An element in its present state: yielded, with split points, or torn. */
static void check_flowing(const sbri_character *c, const sbri_body *body, const sbri_point *positions,
    uint32_t t, solid_health *found) {
  const sbri_island *island = &c->model->islands[body->island];
  uint32_t at = island->tetrahedra.lanes[2 * (body->elements.first_tetrahedron + t)], lane = at % SBRI_BLOCK;
  const sbri_tetrahedron_block *block =
      &sbri_solids(c)[island->tetrahedra.first_state_block + at / SBRI_BLOCK];
  if (!(block->shear[lane] > 0)) {
    found->torn++;
    return;
  }
  sbfi_d3 edges[3];
  sbfi_stretches stretches;
  sbfi_solid_metric metric;
  double mu = 6 * (double)block->shear[lane], lambda = 6 * (double)block->bulk[lane];
  double volume = 1 / (6 * (double)block->inverse_volume[lane]), ratio = 1, squares = 0;
  for (int i = 0; i < 6; i++) metric.at[i] = block->stiffness[i][lane] / (volume * mu);
  for (int k = 0; k < 3; k++)
    edges[k] = sbfi_d3_sub(position_of(&positions[block->corners[k + 1][lane]]),
        position_of(&positions[block->corners[0][lane]]));
  if (!sbfi_stretches_find(&metric, edges, &stretches)) return;
  for (int k = 0; k < 3; k++) {
    double value = stretches.values[k];
    float strain = (float)fabs(value - 1);
    ratio *= value, squares += value * value;
    found->max_strain = strain > found->max_strain ? strain : found->max_strain;
  }
  double off = ratio - 1 - mu / lambda;
  found->energy_j += volume * (0.5 * mu * (squares - 3) + 0.5 * lambda * off * off - 0.5 * mu * mu / lambda);
  add_ratio(found, ratio);
}

static solid_health check_tetrahedra(
    const sbri_character *c, const sbri_body *body, const sbri_point *positions) {
  solid_health found = {.min_ratio = 1};
  bool flows = c->model->islands[body->island].tetrahedra.flow;
  for (uint32_t t = 0; t < body->elements.tetrahedron_count; t++)
    if (flows)
      check_flowing(c, body, positions, t, &found);
    else
      check_tetrahedron(body, positions, t, &found);
  return found;
}

double sbri_region_measure(const sbri_region_block *block, const sbri_region_member *members, uint32_t lane,
    const sbri_point *positions, double *energy_j) {
  sbfi_region_sums sums = {0};
  sbfi_region_fit fit = {.center = {0, 0, 0}};
  double squares = 0, farthest = 0;
  for (uint32_t i = 0; i < 2 * block->member_count; i++) {
    if (i == block->member_count) fit = sbfi_region_fit_of(&sums);
    const sbri_region_member *m = &members[i % block->member_count];
    const sbri_point *p = &positions[m->slots[lane]];
    sbfi_d3 x = {p->x, p->y, p->z}, r = {m->offsets[0][lane], m->offsets[1][lane], m->offsets[2][lane]};
    double k = m->stiffness[lane];
    if (!(k > 0)) continue;
    if (i < block->member_count) {
      sbfi_region_add(&sums, k, r, x);
      squares += k * sbfi_d3_dot(r, r);
      continue;
    }
    sbfi_d3 off = sbfi_d3_sub(x, sbfi_region_goal(&fit, r));
    double square = sbfi_d3_dot(off, off);
    *energy_j += 0.5 * k * square;
    farthest = square > farthest ? square : farthest;
  }
  return squares > 0 ? sqrt(farthest * sums.weight / squares) : 0;
}

static solid_health check_regions(
    const sbri_island *island, const sbri_body *body, const sbri_point *positions) {
  solid_health found = {.min_ratio = 1};
  for (uint32_t b = body->elements.first_region_block; b < body->elements.region_block_end; b++) {
    const sbri_region_block *block = &island->regions.blocks[b];
    for (uint32_t lane = 0; lane < SBRI_BLOCK && block->inverse_sums[lane] > 0; lane++) {
      float strain = (float)sbri_region_measure(
          block, island->regions.members + block->first_member, lane, positions, &found.energy_j);
      found.max_strain = strain > found.max_strain ? strain : found.max_strain;
    }
  }
  return found;
}

static bool is_finite(const sbri_body *body, const sbri_point *positions, const float *velocities) {
  for (uint32_t slot = body->slots.begin; slot < body->slots.end; slot++) {
    const float *v = velocities + 3 * (slot / SBRI_BLOCK * SBRI_BLOCK) + slot % SBRI_BLOCK;
    float sum =
        positions[slot].x + positions[slot].y + positions[slot].z + v[0] + v[SBRI_BLOCK] + v[2 * SBRI_BLOCK];
    if (!(sum - sum == 0)) return false;
  }
  return true;
}

static void find_energies(const sbr_world *world, const sbri_character *c, const sbri_body *body,
    const sbri_point *positions, const float *velocities, double solid_j, sbr_body_health *health) {
  const sbri_island now = sbri_island_now(c, &c->model->islands[body->island]), *island = &now;
  sbf_vec3 g = world->has_gravity ? world->gravity : c->model->asset->environment.gravity;
  double height = sbri_header(c)->origin.y / (double)c->scale, kinetic = 0, potential = 0;
  double s = c->scale,
         joules =
             s * s * s *
             s; /* masses scale by s^3, squared speeds by s; stiffnesses by s^2, squared lengths by s^2 */
  for (uint32_t slot = body->slots.begin; slot < body->slots.end; slot++) {
    const float *v = velocities + 3 * (slot / SBRI_BLOCK * SBRI_BLOCK) + slot % SBRI_BLOCK;
    double x = v[0], y = v[SBRI_BLOCK], z = v[2 * SBRI_BLOCK], m = island->masses[slot];
    const sbri_point *p = &positions[slot];
    kinetic += 0.5 * m * (x * x + y * y + z * z);
    potential -= m * (double)island->gravity_scales[slot] *
                 ((double)g.x * p->x + (double)g.y * ((double)p->y + height) + (double)g.z * p->z);
  }
  health->kinetic_j = island->scheme->forceless ? 0 : kinetic * joules;
  health->potential_j = potential * joules;
  health->elastic_j += solid_j + sbri_external_energy(island, body, positions,
                                     sbri_surface_vertices(c) + body->surface.first_vertex);
  health->elastic_j *= joules;
}

double sbri_surface_volume(const sbri_character *c, const sbri_body *body, const sbri_point *points) {
  sbri_point *vertices = sbri_surface_vertices(c) + body->surface.first_vertex;
  const sbri_skin surface = sbri_skin_now(c, &body->surface.skin);
  sbri_skin_compute_vertices(c->model, &surface, points, sbri_deltas(c), vertices);
  return sbri_skin_volume(&body->surface.skin, vertices);
}

double sbri_lattice_fraction(const sbri_character *c, const sbri_body *body) {
  const sbri_island *island = &c->model->islands[body->island];
  const sbri_point *positions = sbri_positions(c) + island->first_slot;
  double now = 0, rest = 0;
  for (uint32_t t = 0; t < body->elements.tetrahedron_count; t++) {
    uint32_t at = island->tetrahedra.lanes[2 * (body->elements.first_tetrahedron + t)],
             lane = at % SBRI_BLOCK;
    const sbri_tetrahedron_block *block = &island->tetrahedra.blocks[at / SBRI_BLOCK];
    sbfi_d3 x0 = position_of(&positions[block->corners[0][lane]]), edges[3];
    for (int k = 0; k < 3; k++)
      edges[k] = sbfi_d3_sub(position_of(&positions[block->corners[k + 1][lane]]), x0);
    now += sbfi_d3_dot(edges[0], sbfi_d3_cross(edges[1], edges[2]));
    rest += 1 / (double)block->inverse_volume[lane];
  }
  return rest > 0 ? now / rest : 1;
}

sbr_body_health sbri_body_health(const sbr_world *world, const sbri_character *c, uint32_t soft_body) {
  sbr_body_health health = {.volume_ratio = 1, .min_element_ratio = 1, .finite = true};
  const sbri_body *body = &c->model->bodies[soft_body];
  if (!body->level) return health;
  const sbri_island now = sbri_island_now(c, &c->model->islands[body->island]), *island = &now;
  const sbri_point *positions = sbri_positions(c) + island->first_slot;
  const float *velocities = sbri_velocities(c) + 3 * (size_t)island->first_slot;
  health.asleep = sbri_island_states(c)[body->island].asleep;
  health.recoveries = sbri_island_states(c)[body->island].recoveries;
  health.rigid = sbri_island_states(c)[body->island].recovery.rigid_ticks > 0;
  health.finite = is_finite(body, positions, velocities);
  check_springs(c, island, body, positions, &health);
  solid_health solid = check_tetrahedra(c, body, positions);
  health.torn += solid.torn;
  health.unsplit = sbri_island_states(c)[body->island].unsplit;
  if (solid.max_strain > health.max_strain) health.max_strain = solid.max_strain;
  health.inverted = solid.inverted;
  health.min_element_ratio = solid.min_ratio;
  solid_health regions = check_regions(island, body, positions);
  if (regions.max_strain > health.max_strain) health.max_strain = regions.max_strain;
  solid.energy_j += regions.energy_j;
  if (body->surface.rest_volume_m3 > 0) {
    double volume = sbri_surface_volume(c, body, sbri_positions(c));
    health.volume_ratio = (float)(volume / body->surface.rest_volume_m3);
    health.inverted = health.inverted || (!body->elements.tetrahedron_count && !(volume > 0));
  }
  find_energies(world, c, body, positions, velocities, solid.energy_j, &health);
  return health;
}
