#include "build/sections/section_merge.h"

#include <string.h>

#include "mechanics/polygon.h"
#include "mechanics/vector.h"

enum { MIN_POLYGONS = 4 };
static const double MIN_AREA = 0.005; /* fraction of the squared length of the border */

typedef struct part {
  uint32_t polygons;
  double area, border;
} part;

typedef struct work {
  uint32_t *labels, *owners;
  const sbfi_skin_union *skin;
  const sbfi_topology *t;
  const sbf_asset *asset;
  part *parts;    /* (bones) */
  double *shared; /* (bones) common border of the current part with each other */
} work;

static double length_of(const work *w, uint32_t edge) {
  sbf_uint2 ends = w->t->edges[edge];
  const sbf_vec3 *at = w->skin->mesh.positions.at;
  return sbfi_d3_length(sbfi_d3_sub(sbfi_d3_of(at[ends.at[0]]), sbfi_d3_of(at[ends.at[1]])));
}

static void measure(const work *w) {
  const sbf_polygon_mesh *mesh = &w->skin->mesh;
  memset(w->parts, 0, w->asset->bones.count * sizeof *w->parts);
  for (uint32_t p = 0; p < w->t->polygon_count; p++) {
    if (w->labels[p] == SBFI_NO_INDEX) continue;
    const uint32_t *corners = mesh->polygon_points.at + w->t->corner_begins[p];
    uint32_t size = mesh->polygon_sizes.at[p];
    part *of = &w->parts[w->labels[p]];
    of->polygons++;
    of->area += sbfi_d3_length(sbfi_polygon_area(
        mesh->positions.at, corners, size, sbfi_polygon_middle(mesh->positions.at, corners, size)));
  }
  for (uint32_t e = 0; e < w->t->edge_count; e++) {
    const uint32_t *at = &w->t->edge_polygons[w->t->edge_polygon_begins[e]];
    uint32_t count = w->t->edge_polygon_begins[e + 1] - w->t->edge_polygon_begins[e];
    for (uint32_t i = 1; i < count; i++) {
      uint32_t a = w->labels[at[0]], b = w->labels[at[i]];
      if (a == b || a == SBFI_NO_INDEX || b == SBFI_NO_INDEX) continue;
      w->parts[a].border += length_of(w, e);
      w->parts[b].border += length_of(w, e);
      break;
    }
  }
}

static bool is_sliver(const part *p) {
  return p->polygons > 0 && (p->polygons < MIN_POLYGONS || p->area < MIN_AREA * p->border * p->border);
}

/* Length of the common border with each other part. */
static void measure_shared(const work *w, uint32_t bone) {
  memset(w->shared, 0, w->asset->bones.count * sizeof *w->shared);
  for (uint32_t e = 0; e < w->t->edge_count; e++) {
    const uint32_t *at = &w->t->edge_polygons[w->t->edge_polygon_begins[e]];
    uint32_t count = w->t->edge_polygon_begins[e + 1] - w->t->edge_polygon_begins[e];
    bool is_touching = false;
    for (uint32_t i = 0; i < count; i++) is_touching = is_touching || w->labels[at[i]] == bone;
    for (uint32_t i = 0; is_touching && i < count; i++)
      if (w->labels[at[i]] != bone && w->labels[at[i]] != SBFI_NO_INDEX)
        w->shared[w->labels[at[i]]] += length_of(w, e);
  }
}

static uint32_t find_taker(const work *w, uint32_t bone) {
  const sbf_bone *bones = w->asset->bones.at;
  uint32_t above = SBFI_NO_INDEX, longest = SBFI_NO_INDEX;
  measure_shared(w, bone);
  for (int32_t b = bones[bone].parent; b != SBF_NONE; b = bones[b].parent) {
    if (w->shared[b] > 0) return (uint32_t)b;
    if (w->parts[b].polygons && above == SBFI_NO_INDEX) above = (uint32_t)b;
  }
  for (uint32_t b = 0; b < w->asset->bones.count; b++)
    if (w->shared[b] > 0 && (longest == SBFI_NO_INDEX || w->shared[b] > w->shared[longest])) longest = b;
  return longest != SBFI_NO_INDEX ? longest : above;
}

static void merge_part(const work *w, uint32_t bone, uint32_t to, sbfi_reporter *reporter) {
  sbf_diagnostic diagnostic;
  sbfi_diagnose(&diagnostic, SBF_CODE_SECTION_MERGED,
      "the part of bone \"%s\", %u polygons of %.3g m^2 behind a cut of %.3g m, is too small for a section "
      "and joins the part of \"%s\"",
      w->asset->bones.at[bone].name, (unsigned)w->parts[bone].polygons, w->parts[bone].area,
      w->parts[bone].border, w->asset->bones.at[to].name);
  sbfi_report(reporter, &diagnostic);
  for (uint32_t p = 0; p < w->t->polygon_count; p++)
    if (w->labels[p] == bone) w->labels[p] = to;
  for (uint32_t b = 0; b < w->asset->bones.count; b++)
    if (w->owners[b] == bone) w->owners[b] = to;
}

/* Finds owners of bones that dominate nowhere. */
static void find_owners(const work *w) {
  uint32_t first = SBFI_NO_INDEX;
  for (uint32_t b = w->asset->bones.count; b-- > 0;)
    if (w->parts[b].polygons) first = b;
  for (uint32_t b = 0; b < w->asset->bones.count; b++) {
    if (w->owners[b] != SBFI_NO_INDEX) continue;
    int32_t parent = w->asset->bones.at[b].parent;
    /* Parents come before their children, so their owner is known. */
    w->owners[b] = parent != SBF_NONE ? w->owners[parent] : first;
  }
}

bool sbfi_sections_merge(uint32_t *labels, uint32_t *owners, const sbfi_skin_union *skin,
    const sbfi_topology *t, const sbf_asset *asset, sbfi_reporter *reporter, sbfi_arena *scratch) {
  uint32_t count = asset->bones.count;
  work w = {labels, owners, skin, t, asset, NULL, NULL};
  w.parts = sbfi_arena_allocate(scratch, (size_t)count + 1, sizeof *w.parts);
  w.shared = sbfi_arena_allocate(scratch, (size_t)count + 1, sizeof *w.shared);
  uint8_t *stays = sbfi_arena_allocate(scratch, (size_t)count + 1, 1);
  if (!w.parts || !w.shared || !stays) return false;
  measure(&w);
  for (uint32_t b = 0; b < count; b++) owners[b] = w.parts[b].polygons ? b : SBFI_NO_INDEX;
  for (uint32_t b = count; b-- > 0;) {
    if (!is_sliver(&w.parts[b]) || stays[b]) continue;
    uint32_t to = find_taker(&w, b);
    stays[b] = to == SBFI_NO_INDEX;
    if (stays[b]) continue;
    merge_part(&w, b, to, reporter);
    measure(&w);
    b = count; /* merges can change which parts are slivers, so starts again */
  }
  find_owners(&w);
  return true;
}
