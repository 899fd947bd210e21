/* Copies weights by position: a point of the input at a point of the rig takes its weights. */
#include <math.h>
#include <string.h>

#include "import/rigging/align.h"
#include "import/rigging/point_finder.h"
#include "import/rigging/weigh.h"

typedef struct matching {
  const sbfi_rigging *r;
  const sbfi_scene_surface *moved; /* input in asset space */
  sbfi_point_finder finder;
  double within;
  uint32_t *used; /* (rig points) number of the input's points that matched each */
  /* State of the current point. */
  uint32_t point;
  uint32_t best;
  double best_score;
} matching;

/* Counts edges of the input's point that have the direction of an edge at the rig's point. This separates
 * points of two surfaces at one position. Normals decide ties. */
static double score(const matching *m, uint32_t candidate) {
  const sbfi_scene_surface *a = m->moved, *b = &m->r->rig;
  double same = 0, squared = m->within * m->within;
  for (uint32_t i = a->neighbour_starts[m->point]; i < a->neighbour_starts[m->point + 1]; i++) {
    sbfi_d3 to = sbfi_d3_of(a->mesh.positions.at[a->neighbours[i]]);
    for (uint32_t k = b->neighbour_starts[candidate]; k < b->neighbour_starts[candidate + 1]; k++) {
      sbfi_d3 separation = sbfi_d3_sub(sbfi_d3_of(b->mesh.positions.at[b->neighbours[k]]), to);
      if (sbfi_d3_dot(separation, separation) > squared) continue;
      same += 1;
      break;
    }
  }
  return same + 0.4 * sbfi_d3_dot(sbfi_d3_of(a->normals[m->point]), sbfi_d3_of(b->normals[candidate]));
}

static void weigh_candidate(void *user, uint32_t candidate) {
  matching *m = user;
  if (m->best == candidate) return;
  if (m->best_score < 0) m->best_score = score(m, m->best);
  double here = score(m, candidate);
  /* double surfaces: each of the input's points gets its own */
  bool even = fabs(here - m->best_score) < 1e-6;
  bool less_used = m->used[candidate] < m->used[m->best];
  bool before = m->used[candidate] == m->used[m->best] && candidate < m->best;
  if (even ? !less_used && !before : here < m->best_score) return;
  m->best = candidate;
  m->best_score = here;
}

static uint32_t find_match(matching *m, uint32_t point) {
  double distance;
  sbfi_d3 position = sbfi_d3_of(m->moved->mesh.positions.at[point]);
  m->point = point;
  m->best = sbfi_point_nearest(&m->finder, position, m->within, &distance);
  m->best_score = -1;
  if (m->best != UINT32_MAX)
    sbfi_find_points_near(&m->finder, position, distance + 0.02 * m->within, weigh_candidate, m);
  if (m->best != UINT32_MAX) m->used[m->best]++;
  return m->best;
}

/* --- Whole objects ------------------------------------------------------------------------------------- */

static uint32_t mesh_of_point(const sbfi_scene_surface *s, uint32_t point) {
  uint32_t low = 0, high = s->scene->mesh_count;
  while (high - low > 1) {
    uint32_t middle = (low + high) / 2;
    if (s->mesh_starts[middle] <= point)
      low = middle;
    else
      high = middle;
  }
  return low;
}

/* Mesh of the rig that contains all points of an object, if it has no skin: the object is attached like
 * it. */
static int32_t common_node(const sbfi_rigging *r, uint32_t mesh, const uint32_t *matches) {
  int32_t parent_node = SBF_NONE;
  for (uint32_t i = r->input.mesh_starts[mesh]; i < r->input.mesh_starts[mesh + 1]; i++) {
    if (matches[i] == UINT32_MAX) return SBF_NONE;
    const sbfi_scene_mesh *on = &r->rig.scene->meshes[mesh_of_point(&r->rig, matches[i])];
    if (on->skin.joint_count || (parent_node != SBF_NONE && parent_node != on->node)) return SBF_NONE;
    parent_node = on->node;
  }
  return parent_node;
}

/* Whether an object's polygons face away from the rig's, after mirrored ones have been flipped. */
static bool faces_away(
    const sbfi_rigging *r, const sbfi_scene_surface *moved, uint32_t mesh, const uint32_t *matches) {
  double sum = 0, sign = sbfi_matrix_determinant(&r->alignment.to_asset) < 0 ? -1 : 1;
  for (uint32_t i = r->input.mesh_starts[mesh]; i < r->input.mesh_starts[mesh + 1]; i++)
    if (matches[i] != UINT32_MAX)
      sum += sign * sbfi_d3_dot(sbfi_d3_of(moved->normals[i]), sbfi_d3_of(r->rig.normals[matches[i]]));
  return sum < 0;
}

bool sbfi_weigh_by_position(sbfi_rigging *r, const sbfi_scene_surface *moved) {
  sbfi_arena scratch;
  sbfi_arena_init(&scratch, &r->c->scratch.allocator, 0);
  uint32_t count = r->input.mesh.positions.count;
  matching m = {.r = r,
      .moved = moved,
      .within =
          sbfi_match_tolerance(r, sbfi_similarity_scale(&r->alignment.to_asset), sbfi_input_quantum(r))};
  uint32_t *matches = sbfi_arena_allocate(&scratch, count + 1, sizeof *matches);
  m.used = sbfi_arena_allocate(&scratch, (size_t)r->rig.mesh.positions.count + 1, sizeof *m.used);
  bool good = matches && m.used &&
              sbfi_point_finder_make(
                  &m.finder, r->rig.mesh.positions.at, r->rig.mesh.positions.count, m.within, &scratch);
  for (uint32_t i = 0; good && i < count; i++) matches[i] = find_match(&m, i);
  for (uint32_t mesh = 0; good && mesh < r->input.scene->mesh_count; mesh++) {
    r->is_reversed[mesh] = faces_away(r, moved, mesh, matches);
    r->matched_nodes[mesh] = common_node(r, mesh, matches);
    if (r->parent_nodes[mesh] != SBF_NONE) continue;
    r->parent_nodes[mesh] = r->matched_nodes[mesh];
    for (uint32_t i = r->input.mesh_starts[mesh]; i < r->input.mesh_starts[mesh + 1]; i++) {
      if (matches[i] == UINT32_MAX || r->sources[i] != SBFI_WEIGHTS_NONE) continue;
      r->weights[i] = r->rig_weights[matches[i]];
      r->sources[i] = SBFI_WEIGHTS_MATCHED;
    }
  }
  sbfi_arena_free(&scratch);
  return good;
}
