#include "build/weights/nearest_bones.h"

#include "build/weights/body_paths.h"
#include "build/weights/bone_links.h"

/* Cell paths are up to an eleventh longer than straight ones. Distances are divided by the root of the
 * body's radius plus this; a shell that contains less than a quarter of a bone counts up to eleven times
 * as far from it. */
static const double DETOUR = 1.1, RADIUS_OFFSET = 0.02, WHOLE_FRACTION = 0.25, SHELL_PENALTY = 10, TIE = 1e-5;
/* Relative tolerances: of straight distances to one joint, and of equal distances. */
static const double AT_JOINT = 1e-4, NEARLY = 0.1;

/* Factors of the distance from one bone to each shell. */
static void shell_factors(const sbfi_bone_reach *reach, uint32_t bone, uint32_t *next_fraction,
    uint32_t shell_count, double *factors) {
  for (uint32_t s = 0; s < shell_count; s++)
    factors[s] = reach->shell_contains_bone[s] ? 1 + SHELL_PENALTY : 1;
  while (*next_fraction < reach->fraction_count && reach->fractions[*next_fraction].bone < bone)
    (*next_fraction)++;
  for (; *next_fraction < reach->fraction_count && reach->fractions[*next_fraction].bone == bone;
       (*next_fraction)++) {
    const sbfi_bone_fraction *length_fraction = &reach->fractions[*next_fraction];
    if (!reach->shell_contains_bone[length_fraction->shell]) continue;
    double limited = fmin(1, (double)length_fraction->fraction / WHOLE_FRACTION);
    factors[length_fraction->shell] = 1 + SHELL_PENALTY * (1 - limited);
  }
}

/* Whether a point nearest to the joint between two bones is beyond it: then it belongs to the second bone,
 * as the heel belongs to the foot. */
static bool is_past_joint(const sbfi_bone_segment *parent, const sbfi_bone_segment *child, sbfi_d3 at) {
  sbfi_d3 along = sbfi_d3_add(sbfi_d3_normal(sbfi_d3_sub(parent->tail, parent->head)),
      sbfi_d3_normal(sbfi_d3_sub(child->tail, child->head)));
  return sbfi_d3_dot(sbfi_d3_sub(at, child->head), along) > 0;
}

/* Whether a bone is nearer than the nearest so far, whose distance is `min`. */
static bool is_nearer(const sbfi_bone_segment *segments, const sbfi_nearest_bone *nearest, double min,
    uint32_t bone, double straight, double distance, sbfi_d3 at) {
  if (isfinite(min) && segments[nearest->bone].next == (int32_t)bone &&
      fabs(straight - (double)nearest->distance) <= AT_JOINT * straight &&
      fabs(distance - min) <= NEARLY * min)
    return is_past_joint(&segments[nearest->bone], &segments[bone], at);
  return distance < min * (1 - TIE); /* the first wins if equal */
}

/* Factor on a bone's distance: skin that faces the bone instead of away from it, such as the arm's beside
 * the chest, belongs to another. */
static double facing_factor(const sbfi_bone_segment *segment, sbfi_d3 at, sbfi_d3 normal) {
  sbfi_d3 from = sbfi_d3_normal(sbfi_d3_sub(at, sbfi_segment_nearest(segment, at)));
  return 2 - sbfi_d3_dot(from, normal);
}

/* Constant data for distances from one bone. */
typedef struct bone_search {
  const sbfi_weight_mesh *mesh;
  const sbfi_bone_reach *reach;
  sbfi_bone_links links;
  double *shell_factors; /* (mesh->shell_count) */
  double scale;
  double *link_scales; /* (links.count) */
} bone_search;

/* Near its joint a limb reaches as far as the link to it. */
static void find_links(
    bone_search *s, const sbfi_weights_input *in, const sbfi_bone_segment *segments, uint32_t bone) {
  const double *thickness = s->reach->thickness;
  sbfi_bone_links_find(&s->links, in, segments, bone);
  s->scale = 1 / sqrt(thickness[bone] + RADIUS_OFFSET);
  for (uint32_t k = 0; k < s->links.count; k++)
    s->link_scales[k] = 1 / sqrt(fmin(thickness[bone], thickness[s->links.limbs[k]]) + RADIUS_OFFSET);
}

/* Effective distance of a site from the bone; `path` is the path length through the body, 0 if no cell
 * contains the site. */
static double distance_to_site(const bone_search *s, uint32_t site, double path) {
  const sbfi_bone_segment *segments = s->links.segments, *best = &segments[0];
  sbfi_d3 at = sbfi_d3_of(s->mesh->sites[site]);
  uint32_t shell = s->mesh->shell_of_site[site];
  double min = fmax(path / DETOUR, sqrt(sbfi_segment_distance2(best, at))) * s->scale;
  for (uint32_t k = 0; k < s->links.count; k++) {
    double straight = sqrt(sbfi_segment_distance2(&segments[k + 1], at));
    double distance = fmax(path / DETOUR, straight) * s->link_scales[k];
    if (distance >= min || !sbfi_bone_link_counts(&s->links, k, s->reach, shell)) continue;
    min = distance;
    best = &segments[k + 1];
  }
  return min * s->shell_factors[shell] * facing_factor(best, at, s->mesh->normals[site]);
}

bool sbfi_nearest_bones_find(const sbfi_weights_input *in, const sbfi_weight_mesh *mesh,
    const sbfi_body_grid *grid, const sbfi_bone_segment *segments, const sbfi_bone_reach *reach,
    sbfi_nearest_bone *nearest, sbfi_arena *arena) {
  sbfi_body_paths paths;
  bone_search search = {.mesh = mesh, .reach = reach};
  double *min = sbfi_arena_allocate(arena, mesh->site_count, sizeof *min);
  int32_t *cells = sbfi_arena_allocate(arena, mesh->site_count, sizeof *cells);
  search.shell_factors = sbfi_arena_allocate(arena, mesh->shell_count, sizeof *search.shell_factors);
  search.link_scales = sbfi_arena_allocate(arena, in->bone_count, sizeof *search.link_scales);
  if (!min || !cells || !search.shell_factors || !search.link_scales ||
      !sbfi_bone_links_make(&search.links, in->bone_count, arena) ||
      !sbfi_body_paths_make(&paths, grid, arena))
    return false;
  for (uint32_t i = 0; i < mesh->site_count; i++) {
    min[i] = INFINITY;
    cells[i] = grid->cell_of_box[sbfi_body_box_at(grid, sbfi_d3_of(mesh->sites[i]))];
  }
  uint32_t next_fraction = 0;
  for (uint32_t b = 0; b < in->bone_count; b++) {
    if (!segments[b].is_deforming) continue;
    find_links(&search, in, segments, b);
    shell_factors(reach, b, &next_fraction, mesh->shell_count, search.shell_factors);
    sbfi_body_paths_from(&paths, search.links.segments, search.links.count + 1);
    for (uint32_t i = 0; i < mesh->site_count; i++) {
      sbfi_d3 at = sbfi_d3_of(mesh->sites[i]);
      double straight = sqrt(sbfi_segment_distance2(&segments[b], at));
      double path = cells[i] == SBF_NONE ? 0 : (double)paths.distances[cells[i]] / SBFI_BODY_CELLS;
      double distance = distance_to_site(&search, i, path);
      if (!is_nearer(segments, &nearest[i], min[i], b, straight, distance, at)) continue;
      min[i] = distance;
      nearest[i] = (sbfi_nearest_bone){b, (float)straight};
    }
  }
  return true;
}
