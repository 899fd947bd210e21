#include "import/rigging/align_limbs.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "import/rigging/align.h"
#include "import/rigging/limb_fit.h"
#include "import/rigging/limb_symmetry.h"
#include "import/rigging/similarity.h"

/* Maximum number of candidates to which limbs are fitted: without an offset, and others. */
enum { MAX_FIXED = 3, MAX_FREE = 2 };
/* Factor on the cost of a symmetric pose, if the input is symmetric. */
static const double SYMMETRIC = 0.8;
/* Minimum extent of the bones as a fraction of the input's longest side; a smaller rig would fit into its
 * belly. */
static const double MIN_LONG = 0.6;

typedef struct ranked {
  double cost;
  uint32_t candidate;
  bool is_fixed;
} ranked;

static int compare_ranked(const void *a, const void *b) {
  const ranked *x = a, *y = b;
  if (x->cost != y->cost) return x->cost < y->cost ? -1 : 1;
  return x->candidate < y->candidate ? -1 : x->candidate > y->candidate;
}

static bool begin(sbfi_limb_fit *f, sbfi_rigging *r, const sbfi_bone_lines *lines, const sbfi_body_core *core,
    const sbfi_matrix *m, sbfi_arena *arena) {
  r->alignment.to_asset = *m;
  return sbfi_limb_fit_begin(f, r, lines, core, arena);
}

static double longest_side(const sbfi_bone_lines *lines) {
  sbfi_d3 sides = sbfi_d3_sub(lines->high, lines->low);
  return fmax(sides.x, fmax(sides.y, sides.z));
}

static void name_rotated(const sbfi_limb_fit *f, char *text, size_t size) {
  text[0] = 0;
  for (uint32_t b = 0; b < f->bone_count; b++) {
    size_t used = strlen(text);
    if (f->is_rotated[b] && used + 60 < size)
      snprintf(text + used, size - used, "%s'%.40s'", used ? ", " : "", f->bones[b].name);
  }
}

static void take(const sbfi_limb_fit *f, const sbfi_matrix *m, sbfi_limb_alignment *found) {
  found->to_asset = *m;
  found->to_asset.at[0][3] -= f->offset.x;
  found->to_asset.at[1][3] -= f->offset.y;
  found->to_asset.at[2][3] -= f->offset.z;
  found->motions = f->motions;
  found->lines = f->posed.at;
  found->cost = f->cost;
  name_rotated(f, found->names, sizeof found->names);
}

/* Fits a symmetric input, starting from the rig's pose of each side. */
static bool consider_symmetric(sbfi_limb_symmetry *s, const sbfi_body_core *core, sbfi_limb_fit *f,
    const sbfi_limb_candidate *candidate, double *best, sbfi_limb_alignment *found, sbfi_arena *arena) {
  double plane;
  if (!sbfi_limb_symmetry_holds(s, &plane)) return true;
  for (int side = 1; side >= -1; side -= 2) {
    if (!sbfi_limb_symmetry_search(s, plane, side, core, f, arena)) return false;
    double cost = f->cost * candidate->factor * SYMMETRIC;
    if (cost >= *best) continue;
    *best = cost;
    take(f, &candidate->to_asset, found);
  }
  return true;
}

bool sbfi_align_limbs(sbfi_rigging *r, const sbfi_bone_lines *lines, const sbfi_limb_candidate *candidates,
    uint32_t count, const sbfi_matrix *unposed, sbfi_limb_alignment *found, sbfi_arena *arena) {
  sbfi_body_core *core = sbfi_arena_allocate(arena, 1, sizeof *core);
  sbfi_limb_fit *f = sbfi_arena_allocate(arena, 1, sizeof *f);
  ranked *rank = sbfi_arena_allocate(arena, count, sizeof *rank);
  sbfi_limb_symmetry symmetry;
  bool good = core && f && rank && sbfi_limb_symmetry_find(&symmetry, r, lines, arena) &&
              sbfi_body_core_find(&r->input, core, arena) && begin(f, r, lines, core, unposed, arena);
  if (!good) return false;
  double best = INFINITY;
  uint32_t usable = 0, fixed = 0, free = 0;
  *found = (sbfi_limb_alignment){.unposed_cost = f->cost, .cost = f->cost};
  for (uint32_t i = 0; i < count; i++) {
    if (!sbfi_alignment_allowed(r, &candidates[i].to_asset)) continue;
    if (!begin(f, r, lines, core, &candidates[i].to_asset, arena)) return false;
    if (longest_side(lines) >= MIN_LONG * f->size)
      rank[usable++] = (ranked){f->cost * candidates[i].factor, i, f->is_fixed};
  }
  qsort(rank, usable, sizeof *rank, compare_ranked);
  for (uint32_t i = 0; i < usable; i++) {
    if (i && rank[i].cost - rank[i - 1].cost < 1e-9) continue;
    if (rank[i].is_fixed ? fixed++ >= MAX_FIXED : free++ >= MAX_FREE) continue;
    const sbfi_limb_candidate *candidate = &candidates[rank[i].candidate];
    const sbfi_matrix *m = &candidate->to_asset;
    if (!begin(f, r, lines, core, m, arena)) return false;
    sbfi_limb_fit_search(f);
    double cost = f->cost * candidate->factor;
    if (cost < best) {
      best = cost;
      take(f, m, found);
    }
    if (!consider_symmetric(&symmetry, core, f, candidate, &best, found, arena)) return false;
  }
  r->alignment.to_asset = *unposed;
  return true;
}
