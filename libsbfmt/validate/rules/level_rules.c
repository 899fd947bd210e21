/* Checks levels: rest positions at their sources, connected, finest first, mass at free points. */
#include "base/union_find.h"
#include "mechanics/level_points.h"
#include "mechanics/vector.h"
#include "validate/rules/pin_states.h"
#include "validate/rules/pose.h"
#include "validate/validation.h"

static void check_map(sbfi_validation *v, const sbf_level *level, const char *path) {
  uint32_t *source = sbfi_scratch(v, level->positions.count, sizeof *source); /* from 1 */
  if (!source) return;
  for (uint32_t i = 0; i < level->new_from_old.count; i++) {
    uint32_t point = sbfi_level_point(level, i);
    if (point == UINT32_MAX) continue;
    if (source[point])
      sbfi_found(v, SBF_CODE_LEVEL_MAP, path, i, "source points %u and %u both map to point %u of the level",
          source[point] - 1, i, point);
    source[point] = i + 1;
  }
}

static void check_positions(
    sbfi_validation *v, const sbf_soft_body *body, const sbf_level *level, const char *path) {
  sbf_vec3_list surface = body->surface.positions;
  double max = 0, tolerance = 1e-4 * sbfi_extent(surface);
  uint32_t moved = 0, first = 0;
  for (uint32_t i = 0; i < surface.count + body->interior.count; i++) {
    uint32_t point = sbfi_level_point(level, i);
    if (point == UINT32_MAX) continue;
    sbf_vec3 from = i < surface.count ? surface.at[i] : body->interior.at[i - surface.count];
    double distance = sbfi_d3_length(sbfi_d3_sub(sbfi_d3_of(from), sbfi_d3_of(level->positions.at[point])));
    if (!(distance > tolerance)) continue;
    if (moved++ == 0) first = point;
    max = fmax(max, distance);
  }
  if (moved)
    sbfi_found(v, SBF_CODE_LEVEL_POINT_MOVED, path, first,
        "%u point%s of a level of '%s' lie%s off %s source point%s, by up to %.3g m", moved,
        sbfi_plural(moved), sbfi_label(body->name, body->id), moved == 1 ? "s" : "",
        moved == 1 ? "its" : "their", sbfi_plural(moved), max);
}

/* Points joined into connected pieces by the elements between them. */
typedef struct pieces {
  uint32_t *parents;
  uint8_t *used;
} pieces;

static void join(pieces *p, const uint32_t *points, uint32_t count) {
  for (uint32_t k = 0; k < count; k++) {
    p->used[points[k]] = 1;
    sbfi_sets_join(p->parents, points[k], points[0]);
  }
}

static void join_elements(pieces *p, const sbf_level *level) {
  bool springs = level->model == SBF_ELASTIC_MODEL_SPRINGS;
  for (uint32_t s = 0; s < level->springs.count; s++)
    for (uint32_t i = 0; (springs || level->springs.at[s].extra) && i < level->springs.at[s].ends.count; i++)
      join(p, level->springs.at[s].ends.at[i].at, 2);
  if (level->model == SBF_ELASTIC_MODEL_TETRAHEDRA)
    for (uint32_t t = 0; t < level->lattice.tetrahedra.count; t++)
      join(p, level->lattice.tetrahedra.at[t].at, 4);
  if (level->model == SBF_ELASTIC_MODEL_SHAPE_MATCHING && level->regions)
    for (uint32_t r = 0, at = 0; r < level->regions->sizes.count; at += level->regions->sizes.at[r++])
      join(p, level->regions->points.at + at, level->regions->sizes.at[r]);
}

/* Springs to other bodies count as pins: does not follow them. */
static void mark_cross_springs(
    const sbf_asset *asset, uint32_t body, uint32_t level, uint32_t point_count, uint8_t *pin_states) {
  for (uint32_t c = 0; c < asset->cross_springs.count; c++) {
    const sbf_cross_springs *set = &asset->cross_springs.at[c];
    for (int end = 0; end < 2; end++) {
      int32_t named = end ? set->body_b : set->body_a;
      if (named != (int32_t)body || (end ? set->level_b : set->level_a) != level) continue;
      for (uint32_t i = 0; i < set->ends.count; i++) {
        uint32_t point = set->ends.at[i].at[end];
        if (point < point_count && pin_states[point] == SBFI_FREE) pin_states[point] = SBFI_GOAL_PINNED;
      }
    }
  }
}

static void check_pieces(sbfi_validation *v, const sbf_soft_body *body, const sbf_level *level,
    const uint8_t *pin_states, const char *path) {
  uint32_t n = level->positions.count, loose = 0, first = 0, unpinned = 0, anchored = 0;
  pieces p = {sbfi_scratch(v, n, sizeof *p.parents), sbfi_scratch(v, n, 1)};
  uint8_t *is_point_pinned = sbfi_scratch(v, n, 1); /* at the roots of pieces */
  if (!p.parents || !p.used || !is_point_pinned) return;
  sbfi_sets_begin(p.parents, n);
  join_elements(&p, level);
  for (uint32_t i = 0; i < n; i++)
    if (pin_states[i] != SBFI_FREE) is_point_pinned[sbfi_set_root(p.parents, i)] = 1;
  for (uint32_t i = 0; i < n; i++) {
    if (!p.used[i] && pin_states[i] == SBFI_FREE && loose++ == 0) first = i;
    if (!p.used[i] || p.parents[i] != i) continue;
    unpinned += !is_point_pinned[i];
    anchored += is_point_pinned[i];
  }
  if (loose && level->model == SBF_ELASTIC_MODEL_SPRINGS && level->springs.count)
    sbfi_found(v, SBF_CODE_POINT_LOOSE, sbfi_path_of("%s/positions", path).text, first,
        "%u free point%s of '%s' %s no spring", loose, sbfi_plural(loose), sbfi_label(body->name, body->id),
        loose == 1 ? "has" : "have");
  if (unpinned && unpinned + anchored > 1 && level->model != SBF_ELASTIC_MODEL_TETRAHEDRA)
    sbfi_found(v, SBF_CODE_LEVEL_PIECES, path, -1,
        "the level of '%s' consists of %u pieces, and %u of them fall%s", sbfi_label(body->name, body->id),
        unpinned + anchored, unpinned, unpinned == 1 ? "s" : "");
}

static void check_masses(
    sbfi_validation *v, const sbf_level *level, const uint8_t *pin_states, const char *path) {
  for (uint32_t i = 0; i < level->masses.count; i++)
    if (level->masses.at[i] == 0 && pin_states[i] != SBFI_PINNED)
      sbfi_found(v, SBF_CODE_POINT_NO_MASS, path, i, "free point %u has the mass 0", i);
}

static void check_level(sbfi_validation *v, uint32_t body, uint32_t number) {
  const sbf_soft_body *at = &v->asset->soft_bodies.at[body];
  const sbf_level *level = &at->levels.at[number];
  sbfi_path path = sbfi_path_of("/sbf/soft_body[%u]/level[%u]", body + 1, number + 1);
  uint8_t *pin_states = sbfi_scratch(v, level->positions.count, 1);
  if (!pin_states) return;
  sbfi_find_pin_states(level, pin_states);
  mark_cross_springs(v->asset, body, number, level->positions.count, pin_states);
  check_map(v, level, sbfi_path_of("%s/new_from_old", path.text).text);
  check_positions(v, at, level, sbfi_path_of("%s/positions", path.text).text);
  if (level->model == SBF_ELASTIC_MODEL_JIGGLE) return; /* it moves rigidly */
  check_pieces(v, at, level, pin_states, path.text);
  check_masses(v, level, pin_states, sbfi_path_of("%s/masses", path.text).text);
}

static uint64_t element_count(const sbf_level *level) {
  uint64_t springs = 0;
  for (uint32_t s = 0; s < level->springs.count; s++) springs += level->springs.at[s].ends.count;
  return level->model == SBF_ELASTIC_MODEL_TETRAHEDRA ? level->lattice.tetrahedra.count : springs;
}

static void check_order(sbfi_validation *v, uint32_t body) {
  const sbf_level_list levels = v->asset->soft_bodies.at[body].levels;
  const char *name = sbfi_label(v->asset->soft_bodies.at[body].name, v->asset->soft_bodies.at[body].id);
  for (uint32_t l = 1; l < levels.count; l++) {
    uint64_t before = element_count(&levels.at[l - 1]), here = element_count(&levels.at[l]);
    if (levels.at[l].model == levels.at[l - 1].model && here > before)
      sbfi_found(v, SBF_CODE_LEVEL_ORDER, sbfi_path_of("/sbf/soft_body[%u]/level[%u]", body + 1, l + 1).text,
          -1, "level %u of '%s' has %llu elements, but the level before it has %llu", l + 1, name,
          (unsigned long long)here, (unsigned long long)before);
  }
}

void sbfi_check_levels(sbfi_validation *v) {
  for (uint32_t b = 0; b < v->asset->soft_bodies.count; b++) {
    check_order(v, b);
    for (uint32_t l = 0; l < v->asset->soft_bodies.at[b].levels.count && !v->out_of_memory; l++)
      check_level(v, b, l);
  }
}
