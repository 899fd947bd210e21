#include "build/weights/bone_reach.h"

#include <stdlib.h>

#include "build/geometry/winding_number.h"

enum { RAYS_AT = 3, RAYS_ROUND = 8, RAYS = RAYS_AT * RAYS_ROUND, SAMPLES = 16 };
/* Minimum fraction of a bone in a shell for the shell to belong to it; ratio of thicknesses from which a
 * last bone keeps its own instead of its chain's, as for heads. */
static const double PINNED_FRACTION = 0.125, THICK_LEAF = 1.5;

static int compare_numbers(const void *left, const void *right) {
  double a = *(const double *)left, b = *(const double *)right;
  return a < b ? -1 : a > b;
}

/* Median distance from a bone to the surface over rays across it at a quarter, half and three quarters; 0
 * without hits. */
static double thickness_of(const sbfi_body_rays *rays, const sbfi_bone_segment *bone) {
  /* Eight directions around the bone. */
  static const double root = 0.70710678118654752440;
  const double directions[RAYS_ROUND][2] = {
      {1, 0}, {root, root}, {0, 1}, {-root, root}, {-1, 0}, {-root, -root}, {0, -1}, {root, -root}};
  sbfi_d3 along = sbfi_d3_sub(bone->tail, bone->head), axis = sbfi_d3_normal(along);
  if (sbfi_d3_length(axis) == 0) axis = (sbfi_d3){0, 1, 0};
  sbfi_d3 spare = fabs(axis.x) < 0.9 ? (sbfi_d3){1, 0, 0} : (sbfi_d3){0, 0, 1};
  sbfi_d3 x = sbfi_d3_normal(sbfi_d3_cross(axis, spare)), y = sbfi_d3_cross(axis, x);
  double found[RAYS];
  size_t count = 0;
  for (int at = 1; at <= RAYS_AT; at++) {
    sbfi_d3 from = sbfi_d3_add(bone->head, sbfi_d3_scale(along, at / (RAYS_AT + 1.0)));
    for (int round = 0; round < RAYS_ROUND; round++) {
      sbfi_d3 direction =
          sbfi_d3_add(sbfi_d3_scale(x, directions[round][0]), sbfi_d3_scale(y, directions[round][1]));
      double hit = sbfi_body_exit_distance(rays, from, direction);
      if (isfinite(hit)) found[count++] = hit;
    }
  }
  if (count == 0) return 0;
  qsort(found, count, sizeof *found, compare_numbers);
  return found[count / 2];
}

static uint32_t count_children(
    const sbfi_weights_input *in, const sbfi_bone_segment *segments, uint32_t bone) {
  uint32_t count = 0;
  for (uint32_t i = bone + 1; i < in->bone_count; i++)
    count += in->bones[i].parent == (int32_t)bone && segments[i].is_deforming;
  return count;
}

typedef struct chain_bone {
  uint32_t chain, bone;
  double thickness, length;
} chain_bone;

static int compare_chains(const void *left, const void *right) {
  const chain_bone *a = left, *b = right;
  if (a->chain != b->chain) return a->chain < b->chain ? -1 : 1;
  if (a->thickness != b->thickness) return a->thickness < b->thickness ? -1 : 1;
  return a->bone < b->bone ? -1 : a->bone > b->bone;
}

/* Replaces the thickness of a chain's bones by the length-weighted median; `chain` is sorted by thickness. */
static void level_chain(
    const chain_bone *chain, uint32_t count, const sbfi_bone_segment *segments, double *thickness) {
  double whole = 0, so_far = 0, middle = chain[0].thickness;
  for (uint32_t i = 0; i < count; i++) whole += chain[i].length;
  for (uint32_t i = 0; i < count; i++) {
    so_far += chain[i].length;
    middle = chain[i].thickness;
    if (2 * so_far >= whole) break;
  }
  for (uint32_t i = 0; i < count; i++) {
    bool is_leaf = segments[chain[i].bone].next == SBF_NONE;
    if (!is_leaf || chain[i].thickness <= THICK_LEAF * middle) thickness[chain[i].bone] = middle;
  }
}

/* Limits the thickness of bones beside their parent, and of their descendants, to the parent's: ambiguous
 * skin belongs to the parent. */
static bool limit_beside(
    double *thickness, const sbfi_weights_input *in, const sbfi_bone_segment *segments, sbfi_arena *arena) {
  int32_t *beside = sbfi_arena_allocate(arena, in->bone_count, sizeof *beside);
  if (!beside) return false;
  for (uint32_t i = 0; i < in->bone_count; i++) {
    int32_t parent = in->bones[i].parent;
    beside[i] = parent == SBF_NONE ? SBF_NONE : beside[parent];
    if (sbfi_bone_is_adjacent(in, segments, i)) beside[i] = parent;
    if (beside[i] != SBF_NONE) thickness[i] = fmin(thickness[i], thickness[beside[i]]);
  }
  return true;
}

/* A chain: consecutive bones with one child each, and the last. */
static bool find_thickness(sbfi_bone_reach *r, const sbfi_weights_input *in, const sbfi_body_rays *rays,
    const sbfi_bone_segment *segments, sbfi_arena *arena) {
  chain_bone *bones = sbfi_arena_allocate(arena, in->bone_count, sizeof *bones);
  uint32_t *chain_of = sbfi_arena_allocate(arena, in->bone_count, sizeof *chain_of), count = 0;
  r->thickness = sbfi_arena_allocate(arena, in->bone_count, sizeof *r->thickness);
  if (!bones || !chain_of || !r->thickness) return false;
  for (uint32_t i = 0; i < in->bone_count; i++) {
    int32_t parent = in->bones[i].parent;
    bool continues = parent != SBF_NONE && segments[parent].is_deforming &&
                     count_children(in, segments, (uint32_t)parent) == 1;
    chain_of[i] = continues ? chain_of[parent] : i;
    if (!segments[i].is_deforming) continue;
    r->thickness[i] = thickness_of(rays, &segments[i]);
    double length = sbfi_d3_length(sbfi_d3_sub(segments[i].tail, segments[i].head));
    bones[count++] = (chain_bone){chain_of[i], i, r->thickness[i], length};
  }
  qsort(bones, count, sizeof *bones, compare_chains);
  for (uint32_t first = 0, i = 1; i <= count; i++) {
    if (i < count && bones[i].chain == bones[first].chain) continue;
    level_chain(bones + first, i - first, segments, r->thickness);
    first = i;
  }
  return limit_beside(r->thickness, in, segments, arena);
}

static bool is_within(const sbfi_shell *shell, sbfi_d3 at) {
  return at.x >= shell->low.x && at.y >= shell->low.y && at.z >= shell->low.z && at.x <= shell->high.x &&
         at.y <= shell->high.y && at.z <= shell->high.z;
}

static bool may_contain(const sbfi_shell *shell, const sbfi_bone_segment *bone) {
  return fmax(bone->head.x, bone->tail.x) >= shell->low.x &&
         fmin(bone->head.x, bone->tail.x) <= shell->high.x &&
         fmax(bone->head.y, bone->tail.y) >= shell->low.y &&
         fmin(bone->head.y, bone->tail.y) <= shell->high.y &&
         fmax(bone->head.z, bone->tail.z) >= shell->low.z &&
         fmin(bone->head.z, bone->tail.z) <= shell->high.z;
}

/* Fraction of a bone's length inside a closed surface, possibly closed by caps. */
static double inside_fraction(
    const sbfi_winding *winding, const sbfi_shell *shell, const sbfi_bone_segment *bone) {
  uint32_t inside = 0;
  for (uint32_t i = 0; i < SAMPLES; i++) {
    sbfi_d3 along = sbfi_d3_scale(sbfi_d3_sub(bone->tail, bone->head), (i + 0.5) / SAMPLES);
    sbfi_d3 at = sbfi_d3_add(bone->head, along);
    inside += is_within(shell, at) &&
              sbfi_winding_inside(sbfi_winding_of_closed(winding, at), sbfi_winding_of_caps(winding, at));
  }
  return (double)inside / SAMPLES;
}

static int compare_fractions(const void *left, const void *right) {
  const sbfi_bone_fraction *a = left, *b = right;
  if (a->bone != b->bone) return a->bone < b->bone ? -1 : 1;
  return a->shell < b->shell ? -1 : a->shell > b->shell;
}

static bool fractions_of_shell(sbfi_bone_reach *r, sbfi_array *contributions, uint32_t s,
    const sbfi_weights_input *in, const sbfi_weight_mesh *mesh, const sbfi_bone_segment *segments,
    const uint32_t *sizes) {
  const sbfi_shell *shell = &mesh->shells[s];
  bool is_needed = false, good = true;
  for (uint32_t b = 0; b < in->bone_count; b++)
    is_needed |= segments[b].is_deforming && may_contain(shell, &segments[b]);
  if (!is_needed || shell->triangle_count < 4) return true;
  sbfi_arena scratch;
  sbfi_arena_init(&scratch, &contributions->allocator, 0);
  sbf_polygon_mesh surface;
  sbfi_soup soup;
  sbfi_winding winding;
  good = sbfi_weight_mesh_shell(mesh, s, sizes, &surface, &scratch) &&
         sbfi_soup_make(&soup, &surface, &scratch) && sbfi_winding_make(&winding, &soup, &scratch);
  for (uint32_t b = 0; good && b < in->bone_count; b++) {
    if (!segments[b].is_deforming || !may_contain(shell, &segments[b])) continue;
    sbfi_bone_fraction length_fraction = {b, s, (float)inside_fraction(&winding, shell, &segments[b])};
    r->shell_contains_bone[s] |= (double)length_fraction.fraction > PINNED_FRACTION;
    good = length_fraction.fraction <= 0 || sbfi_array_append(contributions, &length_fraction, 1);
  }
  sbfi_arena_free(&scratch);
  return good;
}

static bool find_fractions(sbfi_bone_reach *r, const sbfi_weights_input *in, const sbfi_weight_mesh *mesh,
    const sbfi_bone_segment *segments, const uint32_t *sizes, sbfi_arena *arena) {
  sbfi_array contributions;
  sbfi_array_init(&contributions, &arena->allocator, sizeof(sbfi_bone_fraction));
  r->shell_contains_bone = sbfi_arena_allocate(arena, mesh->shell_count, sizeof *r->shell_contains_bone);
  bool good = r->shell_contains_bone != NULL;
  for (uint32_t s = 0; good && s < mesh->shell_count; s++)
    good = fractions_of_shell(r, &contributions, s, in, mesh, segments, sizes);
  r->fraction_count = (uint32_t)contributions.count;
  if (good && contributions.count) {
    qsort(contributions.at, contributions.count, sizeof(sbfi_bone_fraction), compare_fractions);
    r->fractions = sbfi_arena_copy(arena, contributions.at, contributions.count, sizeof(sbfi_bone_fraction));
    good = r->fractions != NULL;
  }
  sbfi_array_free(&contributions);
  return good;
}

bool sbfi_bone_reach_find(sbfi_bone_reach *r, const sbfi_weights_input *in, const sbfi_weight_mesh *mesh,
    const sbfi_body_rays *rays, const sbfi_bone_segment *segments, const uint32_t *sizes, sbfi_arena *arena) {
  *r = (sbfi_bone_reach){0};
  return find_thickness(r, in, rays, segments, arena) && find_fractions(r, in, mesh, segments, sizes, arena);
}

float sbfi_bone_fraction_in(const sbfi_bone_reach *r, uint32_t bone, uint32_t shell) {
  const sbfi_bone_fraction wanted = {bone, shell, 0};
  const sbfi_bone_fraction *found = r->fraction_count ? bsearch(&wanted, r->fractions, r->fraction_count,
                                                            sizeof *r->fractions, compare_fractions)
                                                      : NULL;
  return found ? found->fraction : 0;
}
