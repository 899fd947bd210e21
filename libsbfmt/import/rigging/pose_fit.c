#include "import/rigging/pose_fit.h"

#include <math.h>
#include <stdlib.h>

#include "import/rigging/similarity.h"
#include "motion/quatd.h"

/* --- Samples ------------------------------------------------------------------------------------------- */

static sbfi_d3 corner(const sbfi_scene_surface *s, uint32_t point) {
  return sbfi_d3_of(s->mesh.positions.at[point]);
}

static double area_of(const sbfi_scene_surface *s, uint32_t a, uint32_t b, uint32_t c) {
  sbfi_d3 first = sbfi_d3_sub(corner(s, b), corner(s, a)), second = sbfi_d3_sub(corner(s, c), corner(s, a));
  return 0.5 * sbfi_d3_length(sbfi_d3_cross(first, second));
}

static double area_of_all(const sbfi_scene_surface *s) {
  const uint32_t *points = s->mesh.polygon_points.at;
  double area = 0;
  for (uint32_t p = 0; p < s->mesh.polygon_sizes.count; points += s->mesh.polygon_sizes.at[p++])
    for (uint32_t k = 2; k < s->mesh.polygon_sizes.at[p]; k++)
      area += area_of(s, points[0], points[k - 1], points[k]);
  return area;
}

/* Samples evenly along the triangles, concatenated by area; a low discrepancy sequence within each. */
static void sample_surface(const sbfi_scene_surface *s, sbfi_surface_sample *samples) {
  const uint32_t *points = s->mesh.polygon_points.at;
  double step = area_of_all(s) / SBFI_POSE_SAMPLES, passed = 0;
  uint32_t count = 0;
  for (uint32_t p = 0; p < s->mesh.polygon_sizes.count; points += s->mesh.polygon_sizes.at[p++])
    for (uint32_t k = 2; k < s->mesh.polygon_sizes.at[p]; k++) {
      passed += area_of(s, points[0], points[k - 1], points[k]);
      for (; count < SBFI_POSE_SAMPLES && (count + 0.5) * step < passed; count++) {
        double u = sqrt(fmod(0.5 + count * 0.7548776662466927, 1.0)),
               v = fmod(0.5 + count * 0.5698402909980532, 1.0);
        samples[count] = (sbfi_surface_sample){
            .points = {points[0], points[k - 1], points[k]}, .weights = {1 - u, u * (1 - v), u * v}};
      }
    }
  for (; count && count < SBFI_POSE_SAMPLES; count++) samples[count] = samples[count - 1];
}

static void locate_samples(const sbfi_scene_surface *s, double sign, sbfi_surface_sample *samples) {
  for (uint32_t i = 0; i < SBFI_POSE_SAMPLES; i++) {
    sbfi_surface_sample *to = &samples[i];
    sbfi_d3 a = corner(s, to->points[0]), b = corner(s, to->points[1]), c = corner(s, to->points[2]);
    to->position = sbfi_d3_add(sbfi_d3_scale(a, to->weights[0]),
        sbfi_d3_add(sbfi_d3_scale(b, to->weights[1]), sbfi_d3_scale(c, to->weights[2])));
    to->normal = sbfi_d3_scale(sbfi_d3_normal(sbfi_d3_cross(sbfi_d3_sub(b, a), sbfi_d3_sub(c, a))), sign);
  }
}

/* Bounds the search by the distance to the previous nearest location, which saves most of it. */
static double bound_by_last(const sbfi_surface_finder *to, const sbfi_surface_sample *s, double within) {
  if (!s->is_near || sbfi_d3_dot(sbfi_surface_normal(to->surface, &s->near), s->normal) < 0.51) return within;
  double distance = sbfi_d3_length(sbfi_d3_sub(sbfi_surface_point(to->surface, &s->near), s->position));
  return fmin(within, distance * (1 + 1e-6) + 1e-6 * within);
}

static void measure_gaps(const sbfi_surface_finder *to, double size, sbfi_surface_sample *samples) {
  for (uint32_t i = 0; i < SBFI_POSE_SAMPLES; i++) {
    sbfi_surface_sample *s = &samples[i];
    double within = bound_by_last(to, s, SBFI_MAX_GAP * size);
    s->is_near = sbfi_surface_nearest(to, s->position, &s->normal, within, &s->near);
    s->gap = s->is_near ? s->near.distance : SBFI_MAX_GAP * size;
  }
}

/* --- The pose ------------------------------------------------------------------------------------------ */

static bool make_posed(sbfi_pose_fit *f) {
  const sbfi_rigging *r = f->r;
  const sbf_vec3 *bound = r->rig.mesh.positions.at;
  sbfi_arena_free(&f->posed_arena);
  sbfi_arena_init(&f->posed_arena, &f->arena->allocator, 0);
  uint32_t count = r->rig.mesh.positions.count;
  sbf_vec3 *positions = sbfi_arena_allocate(&f->posed_arena, (size_t)count + 1, sizeof *positions);
  if (!positions) return false;
  for (uint32_t i = 0; i < count; i++) {
    const sbfi_influences *of = &r->rig_weights[i];
    sbfi_d3 sum = {0, 0, 0}, from = sbfi_d3_of(bound[i]);
    for (uint32_t k = 0; k < SBFI_MAX_INFLUENCES && of->at[k].weight > 0; k++) {
      const sbfi_matrix *motion = &f->motions[r->c->bone_of_node[of->at[k].node]];
      sum = sbfi_d3_add(sum, sbfi_d3_scale(sbfi_similarity_apply(motion, from), (double)of->at[k].weight));
    }
    positions[i] = of->at[0].weight > 0 ? sbfi_d3_rounded(sum) : bound[i];
  }
  return sbfi_surface_with_positions(&f->posed, &r->rig, positions, &f->posed_arena) &&
         sbfi_surface_finder_make(&f->posed_finder, &f->posed, &f->posed_arena);
}

/* Orients the points' normals outwards. */
static void rotate_normals(sbfi_pose_fit *f) {
  sbf_vec3 *normals = (sbf_vec3 *)(uintptr_t)f->input.normals; /* owned by `input_arena` */
  for (uint32_t i = 0; f->sign < 0 && i < f->input.mesh.positions.count; i++)
    normals[i] = (sbf_vec3){-normals[i].x, -normals[i].y, -normals[i].z};
}

bool sbfi_pose_fit_move_input(sbfi_pose_fit *f) {
  sbfi_arena_free(&f->input_arena);
  sbfi_arena_init(&f->input_arena, &f->arena->allocator, 0);
  if (!sbfi_surface_move(&f->input, &f->r->input, &f->to_asset, &f->input_arena)) return false;
  rotate_normals(f);
  return sbfi_surface_finder_make(&f->input_finder, &f->input, &f->input_arena);
}

static void find_sign(sbfi_pose_fit *f) {
  double sum = 0;
  sbfi_surface_location near;
  for (uint32_t i = 0; i < SBFI_POSE_SAMPLES; i++) {
    const sbfi_surface_sample *s = &f->input_samples[i];
    if (sbfi_surface_nearest(&f->posed_finder, s->position, NULL, SBFI_ON_SURFACE * f->r->rig.size, &near))
      sum += sbfi_d3_dot(sbfi_surface_normal(&f->posed, &near), s->normal);
  }
  f->sign = sum < 0 ? -1 : 1;
}

bool sbfi_pose_fit_update(sbfi_pose_fit *f) {
  if (!make_posed(f)) return false;
  locate_samples(&f->posed, 1, f->rig_samples);
  locate_samples(&f->input, f->sign, f->input_samples);
  measure_gaps(&f->input_finder, f->r->rig.size, f->rig_samples);
  measure_gaps(&f->posed_finder, f->r->rig.size, f->input_samples);
  return true;
}

bool sbfi_pose_fit_begin(sbfi_pose_fit *f, const sbfi_rigging *r, sbfi_arena *arena) {
  const sbf_bone_list bones = r->c->asset->bones;
  *f = (sbfi_pose_fit){.r = r, .arena = arena, .bones = bones.at, .bone_count = bones.count};
  sbfi_arena_init(&f->posed_arena, &arena->allocator, 0);
  sbfi_arena_init(&f->input_arena, &arena->allocator, 0);
  f->to_asset = r->alignment.to_asset;
  f->sign = 1;
  f->motions = sbfi_arena_allocate(arena, (size_t)bones.count + 1, sizeof *f->motions);
  f->input_samples = sbfi_arena_allocate(arena, SBFI_POSE_SAMPLES, sizeof *f->input_samples);
  f->rig_samples = sbfi_arena_allocate(arena, SBFI_POSE_SAMPLES, sizeof *f->rig_samples);
  if (!f->motions || !f->input_samples || !f->rig_samples || !sbfi_pose_fit_move_input(f)) return false;
  for (uint32_t b = 0; b < bones.count; b++) f->motions[b] = sbfi_matrix_identity();
  sample_surface(&f->input, f->input_samples);
  sample_surface(&r->rig, f->rig_samples);
  if (!make_posed(f)) return false;
  locate_samples(&f->input, 1, f->input_samples);
  find_sign(f);
  rotate_normals(f);
  return sbfi_pose_fit_update(f);
}

void sbfi_pose_fit_end(sbfi_pose_fit *f) {
  sbfi_arena_free(&f->posed_arena);
  sbfi_arena_free(&f->input_arena);
}

sbfi_d3 sbfi_pose_fit_joint(const sbfi_pose_fit *f, uint32_t bone) {
  return sbfi_similarity_apply(&f->motions[bone], sbfi_d3_of(f->bones[bone].head));
}

bool sbfi_pose_fit_is_descendant(const sbfi_pose_fit *f, uint32_t bone, uint32_t above) {
  int32_t up = (int32_t)bone;
  while (up != SBF_NONE && (uint32_t)up > above) up = f->bones[up].parent;
  return up == (int32_t)above;
}

void sbfi_pose_fit_rotate(sbfi_pose_fit *f, uint32_t bone, const double rotation[4]) {
  sbfi_matrix turn = sbfi_rotation_about(rotation, sbfi_pose_fit_joint(f, bone));
  for (uint32_t b = bone; b < f->bone_count; b++)
    if (sbfi_pose_fit_is_descendant(f, b, bone)) f->motions[b] = sbfi_matrix_multiply(&turn, &f->motions[b]);
}

/* Axis of a rotation with a length of twice the sine of half the angle. */
static sbfi_d3 vector_of(const sbfi_matrix *m) {
  sbfi_d3 axis = {m->at[2][1] - m->at[1][2], m->at[0][2] - m->at[2][0], m->at[1][0] - m->at[0][1]};
  double cosine = 0.5 * (m->at[0][0] + m->at[1][1] + m->at[2][2] - 1);
  double half = sqrt(fmax(0.5 * (1 + cosine), 1e-6)); /* cosine of half the angle */
  return sbfi_d3_scale(axis, 1 / (2 * half));
}

sbfi_d3 sbfi_pose_fit_rotation_vector(const sbfi_pose_fit *f, uint32_t bone) {
  sbfi_matrix above, turn;
  if (f->bones[bone].parent == SBF_NONE) return vector_of(&f->motions[bone]);
  if (!sbfi_matrix_invert(&f->motions[f->bones[bone].parent], &above)) above = sbfi_matrix_identity();
  turn = sbfi_matrix_multiply(&f->motions[bone], &above); /* in the axes of the pose */
  return vector_of(&turn);
}

/* --- How well it lies ---------------------------------------------------------------------------------- */

static int compare(const void *a, const void *b) {
  double x = *(const double *)a, y = *(const double *)b;
  return (x > y) - (x < y);
}

sbfi_pose_gaps sbfi_pose_fit_gaps(const sbfi_pose_fit *f) {
  double on = SBFI_ON_SURFACE * f->r->rig.size, gaps[SBFI_POSE_SAMPLES];
  sbfi_pose_gaps found = {0};
  for (uint32_t i = 0; i < SBFI_POSE_SAMPLES; i++) {
    gaps[i] = f->input_samples[i].gap;
    found.input_unmatched += (f->input_samples[i].gap > on) / (double)SBFI_POSE_SAMPLES;
    found.rig_unmatched += (f->rig_samples[i].gap > on) / (double)SBFI_POSE_SAMPLES;
  }
  qsort(gaps, SBFI_POSE_SAMPLES, sizeof *gaps, compare);
  found.median = gaps[SBFI_POSE_SAMPLES / 2] / f->r->rig.size;
  return found;
}
