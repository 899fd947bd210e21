#include "scenes.h"

#include <check.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "harness.h"
#include "sbfmt/mechanics.h"

scene scene_begin(void) {
  scene s = {.asset = sbf_asset_create(NULL),
      .model_options = sbr_default_model_options(),
      .world_definition = sbr_default_world_definition(),
      .character_definition = sbr_default_character_definition()};
  ck_assert_ptr_nonnull(s.asset);
  s.world_definition.ground = sbr_ground_flat(-1000);
  s.character_definition.position.y = 1000;
  s.world_definition.sleep_after_s = 0; /* tests look at small motions */
  scene_bodies(&s, 1);
  return s;
}

void scene_bodies(scene *s, uint32_t count) {
  sbf_soft_body *bodies = sbf_asset_allocate(s->asset, count, sizeof *bodies);
  ck_assert_ptr_nonnull(bodies);
  for (uint32_t i = 0; i < count; i++) {
    sbf_soft_body_init(&bodies[i]);
    bodies[i].id = "body";
    bodies[i].attributes.damping_ratio = 0;
  }
  s->asset->soft_bodies = (sbf_soft_body_list){bodies, count};
}

sbf_soft_body *scene_body(scene *s, uint32_t index) {
  return (sbf_soft_body *)(uintptr_t)&s->asset->soft_bodies.at[index];
}

static const void *copy(scene *s, const void *from, size_t count, size_t size) {
  void *to = sbf_asset_allocate(s->asset, count, size);
  ck_assert(count == 0 || to);
  return count ? memcpy(to, from, count * size) : NULL;
}

sbf_level *scene_points(
    scene *s, uint32_t body, const sbf_vec3 *positions, const float *masses, uint32_t count) {
  sbf_level *level = sbf_asset_allocate(s->asset, 1, sizeof *level);
  ck_assert_ptr_nonnull(level);
  sbf_level_init(level);
  level->positions = (sbf_vec3_list){copy(s, positions, count, sizeof *positions), count};
  if (masses) level->masses = (sbf_f32_list){copy(s, masses, count, sizeof *masses), count};
  scene_body(s, body)->levels = (sbf_level_list){level, 1};
  return level;
}

void scene_springs(
    scene *s, sbf_level *level, const sbf_uint2 *ends, const float *stiffness, uint32_t count) {
  sbf_spring_set *set = sbf_asset_allocate(s->asset, 1, sizeof *set);
  ck_assert_ptr_nonnull(set);
  sbf_spring_set_init(set);
  set->ends = (sbf_uint2_list){copy(s, ends, count, sizeof *ends), count};
  set->stiffness = (sbf_f32_list){copy(s, stiffness, count, sizeof *stiffness), count};
  level->springs = (sbf_spring_set_list){set, 1};
}

sbf_level *scene_chain(
    scene *s, uint32_t body, sbf_vec3 step, uint32_t links, float stiffness, float link_kg, float end_kg) {
  sbf_vec3 *positions = calloc(links + 1, sizeof *positions);
  float *masses = calloc(links + 1, sizeof *masses), *each = calloc(links, sizeof *each);
  sbf_uint2 *ends = calloc(links, sizeof *ends);
  ck_assert(positions && masses && each && ends);
  for (uint32_t i = 0; i <= links; i++) {
    positions[i] = (sbf_vec3){step.x * (float)i, step.y * (float)i, step.z * (float)i};
    masses[i] = i < links ? link_kg : end_kg;
    if (i < links) ends[i] = (sbf_uint2){{i, i + 1}}, each[i] = stiffness;
  }
  sbf_level *level = scene_points(s, body, positions, masses, links + 1);
  scene_springs(s, level, ends, each, links);
  free(positions), free(masses), free(each), free(ends);
  return level;
}

void scene_net_of_eight(scene *s, float first_rest_m, float rest_step_m) {
  sbf_vec3 positions[8];
  float masses[8], stiffness[28], rest[28];
  sbf_uint2 ends[28];
  uint32_t count = 0;
  for (uint32_t i = 0; i < 8; i++) {
    positions[i] = (sbf_vec3){(float)(i & 1), (float)(i >> 1 & 1), (float)(i >> 2)};
    masses[i] = 1 + 0.25f * (float)i;
    for (uint32_t k = 0; k < i; k++) {
      ends[count] = (sbf_uint2){{k, i}};
      rest[count] = first_rest_m + rest_step_m * (float)count;
      stiffness[count++] = 200;
    }
  }
  sbf_level *level = scene_points(s, 0, positions, masses, 8);
  scene_springs(s, level, ends, stiffness, count);
  sbf_spring_set *set = (sbf_spring_set *)(uintptr_t)level->springs.at;
  set->rest_lengths = (sbf_f32_list){copy(s, rest, count, sizeof *rest), count};
  s->world_definition.has_gravity = true;
  s->world_definition.gravity = (sbf_vec3){0, 0, 0};
}

void scene_pin(scene *s, sbf_level *level, int32_t bone, const uint32_t *points, uint32_t count) {
  sbf_pin_set *set = sbf_asset_allocate(s->asset, 1, sizeof *set);
  ck_assert_ptr_nonnull(set);
  sbf_pin_set_init(set);
  set->bone = bone;
  set->points = (sbf_u32_list){copy(s, points, count, sizeof *points), count};
  level->pins = (sbf_pin_set_list){set, 1};
}

void scene_bone(scene *s, sbf_vec3 head) {
  sbf_bone *bone = sbf_asset_allocate(s->asset, 1, sizeof *bone);
  ck_assert_ptr_nonnull(bone);
  sbf_bone_init(bone);
  bone->id = "bone";
  bone->head = head;
  bone->rotation = (sbf_quat){0.70710678f, 0, 0, 0.70710678f}; /* +Y of the bone along +Z */
  bone->length = 1;
  s->asset->bones = (sbf_bone_list){bone, 1};
}

sbf_level *scene_lattice(scene *s, uint32_t body, const lattice_box *box) {
  sbf_level *level = scene_points(s, body, box->positions, box->masses, box->point_count);
  uint32_t pinned_count = 0, *pinned = sbf_asset_allocate(s->asset, box->point_count, sizeof *pinned);
  ck_assert_ptr_nonnull(pinned);
  for (uint32_t i = 0; i < box->point_count; i++)
    if (!(box->masses[i] > 0)) pinned[pinned_count++] = i;
  if (pinned_count) scene_pin(s, level, -1, pinned, pinned_count);
  uint32_t count = box->tetrahedron_count;
  level->model = SBF_ELASTIC_MODEL_TETRAHEDRA;
  level->lattice.tetrahedra =
      (sbf_uint4_list){copy(s, box->tetrahedra, count, sizeof *box->tetrahedra), count};
  level->lattice.young_modulus =
      (sbf_f32_list){copy(s, box->young_modulus, count, sizeof *box->young_modulus), count};
  scene_body(s, body)->attributes.poisson_ratio = box->poisson_ratios[0];
  return level;
}

sbf_level *scene_regions(scene *s, uint32_t body, sbf_vec3 low, float step, const uint32_t counts[3],
    uint32_t reach, float w, float point_kg) {
  uint32_t count = counts[0] * counts[1] * counts[2], width = 2 * reach + 1, next = 0, point = 0;
  sbf_vec3 *at = calloc(count, sizeof *at);
  float *masses = calloc(count, sizeof *masses);
  uint32_t *sizes = sbf_asset_allocate(s->asset, count, sizeof *sizes);
  uint32_t *points = sbf_asset_allocate(s->asset, (size_t)count * width * width * width, sizeof *points);
  sbf_shape_regions *regions = sbf_asset_allocate(s->asset, 1, sizeof *regions);
  ck_assert(at && masses && sizes && points && regions);
  for (uint32_t z = 0; z < counts[2]; z++)
    for (uint32_t y = 0; y < counts[1]; y++)
      for (uint32_t x = 0; x < counts[0]; x++, point++) {
        const uint32_t middle[3] = {x, y, z};
        uint32_t first[3], end[3];
        at[point] = (sbf_vec3){low.x + step * (float)x, low.y + step * (float)y, low.z + step * (float)z};
        masses[point] = point_kg;
        for (int k = 0; k < 3; k++) {
          first[k] = middle[k] > reach ? middle[k] - reach : 0;
          end[k] = middle[k] + reach + 1 < counts[k] ? middle[k] + reach + 1 : counts[k];
        }
        uint32_t before = next;
        for (uint32_t c = first[2]; c < end[2]; c++)
          for (uint32_t b = first[1]; b < end[1]; b++)
            for (uint32_t a = first[0]; a < end[0]; a++) points[next++] = a + counts[0] * (b + counts[1] * c);
        sizes[point] = next - before;
      }
  sbf_level *level = scene_points(s, body, at, masses, count);
  sbf_shape_regions_init(regions);
  regions->sizes = (sbf_u32_list){sizes, count};
  regions->points = (sbf_u32_list){points, next};
  regions->stiffness = w;
  level->model = SBF_ELASTIC_MODEL_SHAPE_MATCHING;
  level->regions = regions;
  free(at);
  free(masses);
  return level;
}

/* Barycentric coordinates of a place in an element. */
static void weights_of(const lattice_box *box, uint32_t element, sbf_vec3 p, double w[4]) {
  const uint32_t *at = box->tetrahedra[element].at;
  double x[4][3], off[3];
  for (int k = 0; k < 4; k++) {
    sbf_vec3 q = box->positions[at[k]];
    x[k][0] = (double)q.x, x[k][1] = (double)q.y, x[k][2] = (double)q.z;
  }
  off[0] = (double)p.x - x[0][0], off[1] = (double)p.y - x[0][1], off[2] = (double)p.z - x[0][2];
  double e[3][3], n[3][3];
  for (int k = 0; k < 3; k++)
    for (int i = 0; i < 3; i++) e[k][i] = x[k + 1][i] - x[0][i];
  for (int k = 0; k < 3; k++) {
    const double *a = e[(k + 1) % 3], *b = e[(k + 2) % 3];
    n[k][0] = a[1] * b[2] - a[2] * b[1], n[k][1] = a[2] * b[0] - a[0] * b[2];
    n[k][2] = a[0] * b[1] - a[1] * b[0];
    w[k + 1] = (off[0] * n[k][0] + off[1] * n[k][1] + off[2] * n[k][2]) /
               (e[k][0] * n[k][0] + e[k][1] * n[k][1] + e[k][2] * n[k][2]);
  }
  w[0] = 1 - w[1] - w[2] - w[3];
}

static sbf_soft_body *body_of(scene *s, const sbf_level *level) {
  uint32_t b = 0;
  while (scene_body(s, b)->levels.at != level) b++;
  return scene_body(s, b);
}

void scene_embed(scene *s, sbf_level *level, const lattice_box *box) {
  const sbf_vec3_list *vertices = &body_of(s, level)->surface.positions;
  sbf_uint4 *points = sbf_asset_allocate(s->asset, vertices->count, sizeof *points);
  sbf_vec4 *weights = sbf_asset_allocate(s->asset, vertices->count, sizeof *weights);
  for (uint32_t v = 0; v < vertices->count; v++) {
    double best = -1e9, w[4];
    for (uint32_t t = 0; t < box->tetrahedron_count; t++) {
      weights_of(box, t, vertices->at[v], w);
      double min = fmin(fmin(w[0], w[1]), fmin(w[2], w[3]));
      if (min <= best) continue;
      best = min;
      points[v] = box->tetrahedra[t];
      weights[v] = (sbf_vec4){(float)w[0], (float)w[1], (float)w[2], (float)w[3]};
    }
  }
  sbf_embedding *embedding = sbf_asset_allocate(s->asset, 1, sizeof *embedding);
  sbf_embedding_init(embedding);
  embedding->points = (sbf_uint4_list){points, vertices->count};
  embedding->weights = (sbf_vec4_list){weights, vertices->count};
  level->embeddings = (sbf_embedding_list){embedding, 1};
}

/* ---- The box ---- */

typedef struct box {
  uint32_t cells;
  sbf_vec3 low, step;
  sbf_vec3 *points;
  uint32_t point_count;
  uint32_t *quads; /* (quad_count x 4) */
  uint32_t quad_count;
  uint32_t *slots; /* ((cells + 1)^3) index of the surface point at each lattice node */
} box;

static uint32_t box_point(box *b, const uint32_t at[3]) {
  uint32_t n = b->cells + 1, *slots = &b->slots[(at[0] * n + at[1]) * n + at[2]];
  if (*slots == 0) {
    b->points[b->point_count++] = (sbf_vec3){b->low.x + b->step.x * (float)at[0],
        b->low.y + b->step.y * (float)at[1], b->low.z + b->step.z * (float)at[2]};
    *slots = b->point_count;
  }
  return *slots - 1;
}

/* One side, square to `axis`, at its low or its high end, seen from outside counter-clockwise. */
static void box_side(box *b, int axis, bool high) {
  int u = (axis + 1) % 3, v = (axis + 2) % 3;
  for (uint32_t i = 0; i < b->cells; i++)
    for (uint32_t j = 0; j < b->cells; j++) {
      static const uint32_t corners[4][2] = {{0, 0}, {1, 0}, {1, 1}, {0, 1}};
      for (int c = 0; c < 4; c++) {
        const uint32_t *corner = corners[high ? c : 3 - c];
        uint32_t at[3];
        at[axis] = high ? b->cells : 0;
        at[u] = i + corner[0];
        at[v] = j + corner[1];
        b->quads[4 * b->quad_count + (uint32_t)c] = box_point(b, at);
      }
      b->quad_count++;
    }
}

static sbf_vec3 mean(const sbf_vec3 *points, const uint32_t *at, uint32_t count) {
  sbf_vec3 sum = {0, 0, 0};
  for (uint32_t i = 0; i < count; i++) {
    const sbf_vec3 *p = &points[at ? at[i] : i];
    sum = (sbf_vec3){sum.x + p->x, sum.y + p->y, sum.z + p->z};
  }
  float s = 1 / (float)count;
  return (sbf_vec3){sum.x * s, sum.y * s, sum.z * s};
}

static bool has_pair(const sbf_uint2 *pairs, uint32_t count, uint32_t a, uint32_t b) {
  for (uint32_t i = 0; i < count; i++)
    if ((pairs[i].at[0] == a && pairs[i].at[1] == b) || (pairs[i].at[0] == b && pairs[i].at[1] == a))
      return true;
  return false;
}

static void add_set(scene *s, sbf_spring_set *sets, uint32_t *set_count, sbf_spring_kind kind,
    const sbf_uint2 *ends, const float *stiffness, uint32_t count) {
  sbf_spring_set *set = &sets[(*set_count)++];
  sbf_spring_set_init(set);
  set->kind = kind;
  set->ends = (sbf_uint2_list){copy(s, ends, count, sizeof *ends), count};
  set->stiffness = (sbf_f32_list){copy(s, stiffness, count, sizeof *stiffness), count};
}

void scene_section(scene *s, uint32_t body_index, sbf_vec3 center, sbf_vec3 size, uint32_t cells) {
  sbf_soft_body *body = scene_body(s, body_index);
  uint32_t lattice = (cells + 1) * (cells + 1) * (cells + 1), quad_count = 6 * cells * cells;
  box b = {.cells = cells,
      .low = {center.x - 0.5f * size.x, center.y - 0.5f * size.y, center.z - 0.5f * size.z},
      .step = {size.x / (float)cells, size.y / (float)cells, size.z / (float)cells},
      .points = calloc(lattice + quad_count + 1, sizeof *b.points),
      .quads = calloc(quad_count, 4 * sizeof *b.quads),
      .slots = calloc(lattice, sizeof *b.slots)};
  for (int axis = 0; axis < 3; axis++)
    for (int high = 0; high < 2; high++) box_side(&b, axis, high);

  uint32_t *sizes = sbf_asset_allocate(s->asset, quad_count, sizeof *sizes);
  for (uint32_t i = 0; i < quad_count; i++) sizes[i] = 4;
  body->bone = 0;
  body->surface.target = SBF_MESH_TARGET_SURFACE;
  body->surface.positions =
      (sbf_vec3_list){copy(s, b.points, b.point_count, sizeof *b.points), b.point_count};
  body->surface.polygon_sizes = (sbf_u32_list){sizes, quad_count};
  body->surface.polygon_points =
      (sbf_u32_list){copy(s, b.quads, 4 * (size_t)quad_count, sizeof *b.quads), 4 * quad_count};

  uint32_t surface = b.point_count, structural = 0, shear = 0, internal = 0;
  b.points[b.point_count++] = mean(b.points, NULL, surface);
  sbf_uint2 *pairs = calloc(12 * (size_t)quad_count + surface, sizeof *pairs),
            *diagonals = pairs + 4 * quad_count;
  sbf_uint2 *inner = pairs + 6 * quad_count;
  for (uint32_t i = 0; i < surface; i++) inner[internal++] = (sbf_uint2){{surface, i}};
  for (uint32_t q = 0; q < quad_count; q++) {
    const uint32_t *at = b.quads + 4 * q;
    sbf_vec3 middle = mean(b.points, at, 4), five = b.points[surface];
    uint32_t point = b.point_count++;
    b.points[point] = (sbf_vec3){
        0.8f * middle.x + 0.2f * five.x, 0.8f * middle.y + 0.2f * five.y, 0.8f * middle.z + 0.2f * five.z};
    for (int c = 0; c < 4; c++) {
      if (!has_pair(pairs, structural, at[c], at[(c + 1) % 4]))
        pairs[structural++] = (sbf_uint2){{at[c], at[(c + 1) % 4]}};
      inner[internal++] = (sbf_uint2){{point, at[c]}};
    }
    diagonals[shear++] = (sbf_uint2){{at[0], at[2]}};
    diagonals[shear++] = (sbf_uint2){{at[1], at[3]}};
  }
  sbf_level *level = scene_points(s, body_index, b.points, NULL, b.point_count);
  uint32_t *pinned = calloc(b.point_count - surface, sizeof *pinned);
  for (uint32_t i = surface; i < b.point_count; i++) pinned[i - surface] = i;
  scene_pin(s, level, 0, pinned, b.point_count - surface);

  sbf_body_measures measures;
  sbf_body_measure(body, &measures);
  float *volumes = calloc(b.point_count, sizeof *volumes);
  sbf_vec3 *normals = calloc(b.point_count, sizeof *normals);
  uint8_t *is_point_pinned = calloc(b.point_count, 1);
  double *scratch = calloc(9 * (size_t)b.point_count, sizeof *scratch);
  float *stiffness = calloc(12 * (size_t)quad_count + surface, sizeof *stiffness);
  sbf_level_pinned_points(level, is_point_pinned);
  sbf_level_mass_fractions(body, level, is_point_pinned, volumes);
  for (uint32_t i = 0; i < b.point_count; i++) volumes[i] *= (float)measures.volume;
  memmove(pairs + structural, diagonals, shear * sizeof *pairs);
  double modulus = body->attributes.young_modulus;
  sbf_stiffness_of_network(SBF_STIFFNESS_MEMBRANE * modulus, b.points, b.point_count, volumes, pairs,
      structural + shear, scratch, stiffness);
  for (uint32_t i = 0; i < surface; i++) {
    sbf_vec3 n = {b.points[i].x - center.x, b.points[i].y - center.y, b.points[i].z - center.z};
    float length = sqrtf(n.x * n.x + n.y * n.y + n.z * n.z);
    normals[i] = (sbf_vec3){n.x / length, n.y / length, n.z / length};
  }
  sbf_stiffness_of_anchors(modulus, measures.depth, normals, b.points, b.point_count, volumes,
      is_point_pinned, inner, internal, scratch, stiffness + structural + shear);
  sbf_spring_set *sets = sbf_asset_allocate(s->asset, 3, sizeof *sets);
  uint32_t set_count = 0;
  add_set(s, sets, &set_count, SBF_SPRING_KIND_STRUCTURAL, pairs, stiffness, structural);
  add_set(s, sets, &set_count, SBF_SPRING_KIND_SHEAR, pairs + structural, stiffness + structural, shear);
  add_set(s, sets, &set_count, SBF_SPRING_KIND_INTERNAL, inner, stiffness + structural + shear, internal);
  level->springs = (sbf_spring_set_list){sets, set_count};
  free(normals), free(stiffness), free(scratch), free(is_point_pinned), free(volumes), free(pinned),
      free(pairs);
  free(b.slots), free(b.quads), free(b.points);
}

void scene_skin(scene *s, uint32_t body_index) {
  const sbf_soft_body *body = scene_body(s, body_index);
  sbf_render_mesh *mesh = sbf_asset_allocate(s->asset, 1, sizeof *mesh);
  sbf_render_mesh_init(mesh);
  mesh->id = "skin";
  mesh->mesh = body->surface;
  mesh->mesh.target = SBF_MESH_TARGET_RENDERING;
  s->asset->render_meshes = (sbf_render_mesh_list){mesh, 1};
  uint32_t count = body->surface.positions.count;
  sbf_embedding *embedding = sbf_asset_allocate(s->asset, 1, sizeof *embedding);
  sbf_uint4 *points = sbf_asset_allocate(s->asset, count, sizeof *points);
  sbf_vec4 *weights = sbf_asset_allocate(s->asset, count, sizeof *weights);
  sbf_embedding_init(embedding);
  for (uint32_t i = 0; i < count; i++) {
    points[i] = (sbf_uint4){{i, i, i, i}};
    weights[i] = (sbf_vec4){1, 0, 0, 0};
  }
  embedding->render_mesh = 0;
  embedding->points = (sbf_uint4_list){points, count};
  embedding->weights = (sbf_vec4_list){weights, count};
  sbf_level *level = (sbf_level *)(uintptr_t)&body->levels.at[0];
  level->embeddings = (sbf_embedding_list){embedding, 1};
}

/* ---- Running ---- */

void scene_models_survive_want(const scene *s) {
  bool done = false;
  for (size_t allowed = 0; !done && allowed < 2000; allowed++) {
    harness_memory memory;
    harness_memory_init(&memory, allowed);
    sbr_model_options options = s->model_options;
    options.allocator = &memory.allocator;
    sbr_model *model = NULL;
    done = sbr_model_create(s->asset, &options, &model, NULL) == SBF_OK;
    if (done) sbr_model_destroy(model);
    ck_assert_uint_eq(memory.held_bytes, 0);
  }
  ck_assert(done);
}

static void expect_ok(sbf_status status, const sbf_diagnostic *error) {
  ck_assert_msg(status == SBF_OK, "%s", error->message);
}

void scene_start(scene *s) {
  sbf_diagnostic error = {0};
  expect_ok(sbr_model_create(s->asset, &s->model_options, &s->model, &error), &error);
  expect_ok(sbr_world_create(&s->world_definition, &s->world, &error), &error);
  expect_ok(
      sbr_character_create(s->world, s->model, &s->character_definition, &s->character, &error), &error);
}

void scene_start_on_slope(scene *s, double angle) {
  s->model_options.free = true;
  s->world_definition.ground = sbr_ground_flat(0);
  s->character_definition.position = (sbr_double3){0, 0, 0};
  s->world_definition.has_gravity = true;
  s->world_definition.gravity =
      (sbf_vec3){(float)(SCENE_GRAVITY_M_S2 * sin(angle)), (float)(-SCENE_GRAVITY_M_S2 * cos(angle)), 0};
  scene_start(s);
}

void scene_free(scene *s) {
  sbr_world_destroy(s->world);
  sbr_model_destroy(s->model);
  sbf_asset_free(s->asset);
}

void scene_ticks(scene *s, uint32_t ticks) {
  sbf_diagnostic fault;
  for (uint32_t i = 0; i < ticks; i++) {
    sbr_world_tick(s->world);
    ck_assert_msg(sbr_world_validate(s->world, &fault) == SBF_OK, "tick %u: %s", (unsigned)i, fault.message);
  }
}

uint32_t scene_read(const scene *s, uint32_t body, sbf_vec3 *positions, uint32_t capacity) {
  return sbr_character_get_points(s->world, s->character, body, positions, capacity);
}

double scene_middle_x(const scene *s, uint32_t body) {
  static sbf_vec3 points[1024];
  uint32_t count = scene_read(s, body, points, 1024);
  double x = sbr_character_get_origin(s->world, s->character).x;
  for (uint32_t i = 0; i < count; i++) x += (double)points[i].x / count;
  return x;
}

sbf_vec3 scene_point(const scene *s, uint32_t body, uint32_t point) {
  static sbf_vec3 positions[4096];
  uint32_t count = scene_read(s, body, positions, 4096);
  ck_assert_uint_lt(point, count);
  return positions[point];
}
