#include "build/weights/nearest_bones.h"

#include "build/weights/body_paths.h"

/* Paths from cell to cell are longer than straight ones by up to an eleventh. Distances are divided by the
 * root of the body's radius plus this; a shell that holds less than a quarter of a bone is up to eleven times
 * as far from it. */
static const double DETOUR = 1.1, RADIUS_OFFSET = 0.02, SHARE_WHOLE = 0.25, SHELL_PENALTY = 10, TIE = 1e-5;
/* Relative differences: of straight distances to one joint, and of distances that count as even there. */
static const double AT_JOINT = 1e-4, NEARLY = 0.1;

/* Factors of the distance from one bone to each shell. */
static void shell_factors(const sbfi_bone_reach *reach, uint32_t bone, uint32_t *next_share,
    uint32_t shell_count, double *factors) {
  for (uint32_t s = 0; s < shell_count; s++) factors[s] = reach->shell_holds_bone[s] ? 1 + SHELL_PENALTY : 1;
  while (*next_share < reach->share_count && reach->shares[*next_share].bone < bone) (*next_share)++;
  for (; *next_share < reach->share_count && reach->shares[*next_share].bone == bone; (*next_share)++) {
    const sbfi_bone_share *share = &reach->shares[*next_share];
    if (!reach->shell_holds_bone[share->shell]) continue;
    double held = fmin(1, (double)share->share / SHARE_WHOLE);
    factors[share->shell] = 1 + SHELL_PENALTY * (1 - held);
  }
}

/* Whether a point that is nearest to the joint between two bones lies on the far side of it: there the second
 * bone holds it, as the foot holds the heel. */
static bool is_past_joint(const sbfi_bone_segment *parent, const sbfi_bone_segment *child, sbfi_d3 at) {
  sbfi_d3 along = sbfi_d3_add(sbfi_d3_normal(sbfi_d3_sub(parent->tail, parent->head)),
      sbfi_d3_normal(sbfi_d3_sub(child->tail, child->head)));
  return sbfi_d3_dot(sbfi_d3_sub(at, child->head), along) > 0;
}

/* Whether a bone is nearer than the nearest so far. `least` is the distance of that. */
static bool is_nearer(const sbfi_bone_segment *segments, const sbfi_nearest_bone *nearest, double min,
    uint32_t bone, double straight, double distance, sbfi_d3 at) {
  if (isfinite(min) && segments[nearest->bone].next == (int32_t)bone &&
      fabs(straight - (double)nearest->distance) <= AT_JOINT * straight &&
      fabs(distance - min) <= NEARLY * min)
    return is_past_joint(&segments[nearest->bone], &segments[bone], at);
  return distance < min * (1 - TIE); /* of equals the first */
}

bool sbfi_nearest_bones_find(const sbfi_weights_input *in, const sbfi_weight_mesh *mesh,
    const sbfi_body_grid *grid, const sbfi_bone_segment *segments, const sbfi_bone_reach *reach,
    sbfi_nearest_bone *nearest, sbfi_arena *arena) {
  sbfi_body_paths paths;
  double *min = sbfi_arena_allocate(arena, mesh->site_count, sizeof *min);
  double *factors = sbfi_arena_allocate(arena, mesh->shell_count, sizeof *factors);
  int32_t *cells = sbfi_arena_allocate(arena, mesh->site_count, sizeof *cells);
  if (!min || !factors || !cells || !sbfi_body_paths_make(&paths, grid, arena)) return false;
  for (uint32_t i = 0; i < mesh->site_count; i++) {
    min[i] = INFINITY;
    cells[i] = grid->cell_of_box[sbfi_body_box_at(grid, sbfi_d3_of(mesh->sites[i]))];
  }
  uint32_t next_share = 0;
  for (uint32_t b = 0; b < in->bone_count; b++) {
    if (!segments[b].is_deforming) continue;
    double scale = 1 / sqrt(reach->thickness[b] + RADIUS_OFFSET);
    shell_factors(reach, b, &next_share, mesh->shell_count, factors);
    sbfi_body_paths_from(&paths, &segments[b]);
    for (uint32_t i = 0; i < mesh->site_count; i++) {
      double straight = sqrt(sbfi_segment_distance2(&segments[b], sbfi_d3_of(mesh->sites[i])));
      double path = cells[i] == SBF_NONE ? straight : (double)paths.distances[cells[i]] / SBFI_BODY_CELLS;
      double distance = fmax(path / DETOUR, straight) * scale * factors[mesh->shell_of_site[i]];
      if (!is_nearer(segments, &nearest[i], min[i], b, straight, distance, sbfi_d3_of(mesh->sites[i])))
        continue;
      min[i] = distance;
      nearest[i] = (sbfi_nearest_bone){b, (float)straight};
    }
  }
  return true;
}
