/* Compares skin weights computed from bones only with the original weights: both skins in the poses of the
 * file. Errors are in % of the longest side of the mesh: root mean square over points and poses, 95th
 * percentile, and the fraction of points and poses above 2 %. Wrong side: points with a tenth more weight on
 * bones of the other side than the original. Gait: whether the proposed kind and legs are the same.
 *
 * Characters: examples/, whose weights come from a formula (examples/modelling/skin_files.py), then
 * ../shared/zoo and ../shared/data if they exist, with weights painted by artists. Summaries: all characters,
 * and the painted ones. Last, a mesh of 60,000 points with 60 bones, for its time. `--quick`: examples only.
 */
#include <glob.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "measured_assets.h"
#include "measuring.h"
#include "rigged_model.h"
#include "sbfmt/convert.h"

enum { MAX_MODELS = 256 };

typedef struct rigging_errors {
  double rms, percentile, over, wrong_side; /* % */
  double seconds;
  bool same_gait;
} rigging_errors;

static int compare_floats(const void *left, const void *right) {
  float a = *(const float *)left, b = *(const float *)right;
  return a < b ? -1 : a > b;
}

static int compare_doubles(const void *left, const void *right) {
  double a = *(const double *)left, b = *(const double *)right;
  return a < b ? -1 : a > b;
}

/* Turn and offset of a bone from rest. */
typedef struct bone_motion {
  double rotation[4], position[3], rest[3];
} bone_motion;

static void motions_of(const rigged_model *m, const sbfi_bone_frame *frames, bone_motion *motions) {
  for (uint32_t b = 0; b < m->asset->bones.count; b++) {
    const sbf_bone *bone = &m->bones[b];
    const double rest[4] = {bone->rotation.x, bone->rotation.y, bone->rotation.z, bone->rotation.w};
    double back[4];
    sbfi_quatd_conjugate(rest, back);
    sbfi_quatd_multiply(frames[b].rotation, back, motions[b].rotation);
    memcpy(motions[b].position, frames[b].position, sizeof motions[b].position);
    motions[b].rest[0] = bone->head.x, motions[b].rest[1] = bone->head.y, motions[b].rest[2] = bone->head.z;
  }
}

static void add_moved(const bone_motion *motion, sbf_vec3 point, double weight, double to[3]) {
  const double from[3] = {point.x - motion->rest[0], point.y - motion->rest[1], point.z - motion->rest[2]};
  double direction[3];
  sbfi_quatd_rotate(motion->rotation, from, direction);
  for (int k = 0; k < 3; k++) to[k] += weight * (motion->position[k] + direction[k]);
}

/* Distance between the two skins at a point, % of the size. */
static double error_at(
    const rigged_model *m, const sbfi_weights *weights, const bone_motion *motions, uint32_t point) {
  double painted[3] = {0, 0, 0}, computed[3] = {0, 0, 0}, squared = 0;
  for (uint32_t k = m->influence_begins[point]; k < m->influence_begins[point + 1]; k++)
    add_moved(&motions[m->joints[k]], m->points[point], (double)m->weights[k], painted);
  for (int k = 0; k < SBFI_WEIGHTS_PER_POINT; k++)
    add_moved(
        &motions[weights->joints[point][k]], m->points[point], (double)weights->weights[point][k], computed);
  for (int k = 0; k < 3; k++) squared += (painted[k] - computed[k]) * (painted[k] - computed[k]);
  return 100 * sqrt(squared) / m->size;
}

static double wrong_side_at(const rigged_model *m, const sbfi_weights *weights, uint32_t point) {
  double painted[3] = {0, 0, 0}, computed[3] = {0, 0, 0};
  for (uint32_t k = m->influence_begins[point]; k < m->influence_begins[point + 1]; k++)
    painted[m->sides[m->joints[k]] + 1] += (double)m->weights[k];
  for (int k = 0; k < SBFI_WEIGHTS_PER_POINT; k++)
    computed[m->sides[weights->joints[point][k]] + 1] += (double)weights->weights[point][k];
  int other = painted[2] > painted[0] ? 0 : 2;
  return painted[0] != painted[2] && computed[other] > painted[other] + 0.1;
}

static void compare_skins(rigged_model *m, const sbfi_weights *weights, rigging_errors *errors) {
  uint32_t bones = m->asset->bones.count, poses = 0;
  sbfi_bone_frame *frames = bench_allocate(bones, sizeof *frames);
  bone_motion *motions = bench_allocate(bones, sizeof *motions);
  while (rigged_model_pose(m, poses, frames)) poses++;
  size_t count = 0;
  float *all = bench_allocate((size_t)poses * m->point_count, sizeof *all);
  double squares = 0, over = 0, wrong = 0;
  for (uint32_t pose = 0; pose < poses; pose++) {
    rigged_model_pose(m, pose, frames);
    motions_of(m, frames, motions);
    for (uint32_t i = 0; i < m->point_count; i++) {
      double error = error_at(m, weights, motions, i);
      squares += error * error;
      over += error > 2;
      all[count++] = (float)error;
    }
  }
  for (uint32_t i = 0; i < m->point_count; i++) wrong += wrong_side_at(m, weights, i);
  qsort(all, count, sizeof *all, compare_floats);
  errors->rms = sqrt(squares / (double)count);
  errors->percentile = (double)all[(size_t)(0.95 * (double)count)];
  errors->over = 100 * over / (double)count;
  errors->wrong_side = 100 * wrong / m->point_count;
  free(all);
  free(motions);
  free(frames);
}

/* --- Gait ---------------------------------------------------------------------------------------------- */

/* A skin of the computed weights in place of the painted one. */
static void replace_skin(
    sbf_asset *asset, sbf_render_mesh *mesh, const sbfi_weights *weights, uint32_t first) {
  uint32_t points = mesh->mesh.positions.count, count = 0;
  sbf_skin *skin = sbf_asset_allocate(asset, 1, sizeof *skin);
  uint32_t *counts = sbf_asset_allocate(asset, points, sizeof *counts);
  uint32_t *bones = sbf_asset_allocate(asset, (size_t)points * SBFI_WEIGHTS_PER_POINT, sizeof *bones);
  float *values = sbf_asset_allocate(asset, (size_t)points * SBFI_WEIGHTS_PER_POINT, sizeof *values);
  if (!skin || !counts || !bones || !values) bench_fail("memory ran out");
  for (uint32_t i = 0; i < points; i++)
    for (int k = 0; k < SBFI_WEIGHTS_PER_POINT && weights->weights[first + i][k] > 0; k++) {
      bones[count] = weights->joints[first + i][k];
      values[count++] = weights->weights[first + i][k];
      counts[i]++;
    }
  sbf_skin_init(skin);
  skin->influence_counts = (sbf_u32_list){counts, points};
  skin->bones = (sbf_u32_list){bones, count};
  skin->weights = (sbf_f32_list){values, count};
  mesh->skin = skin;
}

static uint32_t count_legs(const sbf_asset *asset) {
  return asset->gaits.count ? asset->gaits.at[0].legs.count : 0;
}

/* Takes the asset's gait away and has one proposed; with the computed weights where they are given. */
static sbf_asset *with_gait(const sbf_asset *from, const sbfi_weights *weights) {
  sbf_diagnostic error;
  sbf_asset *asset = sbf_asset_clone(from, NULL);
  sbf_render_mesh *meshes =
      asset ? sbf_asset_allocate(asset, asset->render_meshes.count, sizeof *meshes) : NULL;
  if (!meshes) bench_fail("memory ran out");
  memcpy(meshes, asset->render_meshes.at, asset->render_meshes.count * sizeof *meshes);
  for (uint32_t i = 0, first = 0; i < asset->render_meshes.count; i++) {
    if (!meshes[i].skin) continue;
    if (weights) replace_skin(asset, &meshes[i], weights, first);
    first += meshes[i].mesh.positions.count;
  }
  asset->render_meshes.at = meshes;
  asset->gaits.count = asset->ik_chains.count = asset->chains.count = 0;
  bench_require(sbf_convert_gait(asset, NULL, &error), &error);
  return asset;
}

/* Whether it moves as a snake does: the spine follows its first bone. A tail is no kind of gait. */
static bool slithers(const sbf_asset *asset) {
  for (uint32_t i = 0; i < asset->chains.count; i++)
    if (asset->chains.at[i].kind == SBF_CHAIN_KIND_DISTANCE) return true;
  return false;
}

static bool is_gait_same(const rigged_model *m, const sbfi_weights *weights) {
  sbf_asset *painted = with_gait(m->asset, NULL), *computed = with_gait(m->asset, weights);
  bool same = painted->gaits.count == computed->gaits.count && count_legs(painted) == count_legs(computed) &&
              slithers(painted) == slithers(computed);
  sbf_asset_free(painted);
  sbf_asset_free(computed);
  return same;
}

/* --- Models -------------------------------------------------------------------------------------------- */

static bool measure(const char *path, rigging_errors *errors) {
  rigged_model model;
  sbfi_weights weights;
  sbf_diagnostic error;
  if (!rigged_model_load(&model, path)) return false;
  sbfi_weights_input in = rigged_model_input(&model);
  double begin = bench_now_s();
  bench_require(sbfi_compute_weights(&in, &weights, &error), &error);
  errors->seconds = bench_now_s() - begin;
  compare_skins(&model, &weights, errors);
  errors->same_gait = is_gait_same(&model, &weights);
  const char *name = strrchr(path, '/');
  bench_print_row("%s,%u,%u,%u,%.2f,%.2f,%.2f,%.2f,%s,%.2f", name + 1, model.point_count, in.bone_count,
      weights.figures.shell_count, errors->rms, errors->percentile, errors->over, errors->wrong_side,
      errors->same_gait ? "same" : "other", errors->seconds);
  sbfi_weights_free(&weights);
  rigged_model_free(&model);
  return true;
}

/* One column of the errors, sorted: its value at a share of the models. */
static double at_fraction(const rigging_errors *errors, uint32_t count, size_t field, double fraction) {
  double values[MAX_MODELS];
  for (uint32_t i = 0; i < count; i++) memcpy(&values[i], (const char *)&errors[i] + field, sizeof *values);
  qsort(values, count, sizeof *values, compare_doubles);
  return values[(uint32_t)(fraction * count)];
}

static void print_fraction(
    const char *name, const char *group, const rigging_errors *errors, uint32_t count, double fraction) {
  uint32_t same = 0;
  for (uint32_t i = 0; i < count; i++) same += errors[i].same_gait;
  bench_print_row("%s of %s %u,,,,%.2f,%.2f,%.2f,%.2f,%.0f %% same,%.2f", name, group, count,
      at_fraction(errors, count, offsetof(rigging_errors, rms), fraction),
      at_fraction(errors, count, offsetof(rigging_errors, percentile), fraction),
      at_fraction(errors, count, offsetof(rigging_errors, over), fraction),
      at_fraction(errors, count, offsetof(rigging_errors, wrong_side), fraction), 100.0 * same / count,
      at_fraction(errors, count, offsetof(rigging_errors, seconds), fraction));
}

static void print_fractions(const char *group, const rigging_errors *errors, uint32_t count) {
  if (!count) return;
  print_fraction("median", group, errors, count, 0.5);
  print_fraction("nine tenths", group, errors, count, 0.9);
}

/* A mesh of 60,000 points around a chain of 60 bones: what the largest character is to take. */
static void measure_large(uint32_t rings) {
  enum { ROUND = 100, BONES = 60 };
  uint32_t points = rings * ROUND, triangles = 2 * (rings - 1) * ROUND;
  sbf_vec3 *at = bench_allocate(points, sizeof *at);
  uint32_t(*corners)[3] = bench_allocate(triangles, sizeof *corners);
  sbf_bone bones[BONES];
  sbfi_weights weights;
  sbf_diagnostic error;
  for (uint32_t i = 0; i < points; i++) {
    double angle = 6.283185307179586 * (i % ROUND) / ROUND;
    at[i] = (sbf_vec3){
        (float)(0.1 * cos(angle)), (float)(i / ROUND) / (float)(rings - 1), (float)(0.1 * sin(angle))};
  }
  for (uint32_t t = 0; t < triangles; t++) {
    uint32_t a = t / 2, b = a / ROUND * ROUND + (a + 1) % ROUND;
    corners[t][0] = t % 2 ? a : a + ROUND;
    corners[t][1] = t % 2 ? b : b + ROUND;
    corners[t][2] = t % 2 ? a + ROUND : b;
  }
  for (uint32_t b = 0; b < BONES; b++) {
    sbf_bone_init(&bones[b]);
    bones[b].name = "bone";
    bones[b].parent = b ? (int32_t)b - 1 : SBF_NONE;
    bones[b].head = (sbf_vec3){0, ((float)b + 0.2f) / BONES, 0};
  }
  const sbfi_weights_input in = {.points = at,
      .point_count = points,
      .triangles = (const uint32_t(*)[3])corners,
      .triangle_count = triangles,
      .bones = bones,
      .bone_count = BONES};
  double begin = bench_now_s();
  bench_require(sbfi_compute_weights(&in, &weights, &error), &error);
  bench_print_row("a large mesh,%u,%u,1,,,,,,%.2f", points, (unsigned)BONES, bench_now_s() - begin);
  sbfi_weights_free(&weights);
  free(at);
  free(corners);
}

/* Models whose clips use nodes that a conversion leaves out, or whose rest differs from the skin's bind, tell
 * nothing of weights. */
static bool is_left_out(const char *path) {
  static const char *const parts[] = {"tank_pack/", "modular_women/Adventurer", "Hazard_SpikeTrap"};
  for (size_t i = 0; i < sizeof parts / sizeof *parts; i++)
    if (strstr(path, parts[i])) return true;
  return false;
}

int main(int argument_count, char **arguments) {
  static const char *const patterns[] = {BENCH_SOURCE_FOLDER "/examples/*/*.glb",
      SHARED_FOLDER "/../zoo/*/*.glb", SHARED_FOLDER "/fox/*.glb", SHARED_FOLDER "/greenman/*.glb",
      SHARED_FOLDER "/kenney-fbx/*.fbx", SHARED_FOLDER "/walk-dae/*.dae"};
  bool quick = bench_is_quick(argument_count, arguments);
  rigging_errors *errors = bench_allocate(MAX_MODELS, sizeof *errors);
  uint32_t count = 0, by_formula = 0;
  bench_print_columns(
      "model,points,bones,shells,rms_percent,p95_percent,over_2_percent,wrong_side_percent,gait,s");
  for (size_t i = 0; i < (quick ? 1 : sizeof patterns / sizeof *patterns); i++) {
    glob_t found;
    if (glob(patterns[i], 0, NULL, &found) != 0) continue;
    for (size_t k = 0; k < found.gl_pathc && count < MAX_MODELS; k++)
      if (!is_left_out(found.gl_pathv[k])) count += measure(found.gl_pathv[k], &errors[count]);
    globfree(&found);
    if (i == 0) by_formula = count;
  }
  print_fractions("all", errors, count);
  print_fractions("painted", errors + by_formula, count - by_formula);
  measure_large(quick ? 60 : 600);
  free(errors);
  return 0;
}
