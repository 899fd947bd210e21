/* The part of a skin that makes one section: a bone's polygons, and some beyond the cut. */
#ifndef SBFI_SECTION_CUT_H
#define SBFI_SECTION_CUT_H

#include "build/geometry/topology.h"
#include "build/sections/skin_union.h"

typedef struct sbfi_section_cutter {
  const sbfi_skin_union *skin;
  const sbfi_topology *t;
  const uint32_t *labels; /* (polygons) */
  double overlap_m;       /* how far sections reach over the cut, along the surface; below 0: see below */
  double *reach;          /* (points) m that are left at each; below 0: beyond */
  double *shared;         /* (bones) length of border */
  uint32_t *queue;
  uint32_t *new_points; /* (points) in the mesh cut last; SBFI_NO_INDEX: not there */
  uint8_t *queued;
  uint32_t bone_count;
  uint32_t *group_begins, *grouped; /* polygons of each bone: (bones + 2) and (polygons) */
  /* Of the bone at hand; a cut costs as much as they hold. */
  uint32_t *border, border_count;   /* edges to other parts */
  uint32_t *reached, reached_count; /* points with a reach */
  uint32_t *taken, taken_count;     /* polygons */
  uint8_t *is_candidate;            /* (polygons) */
} sbfi_section_cutter;

/* Room for the work; `skin`, `t`, `labels` and `overlap_m` are the caller's to fill first. */
bool sbfi_section_cutter_init(sbfi_section_cutter *cutter, uint32_t bone_count, sbfi_arena *arena);

/* Fills `*mesh` with the polygons of `bone` and those of others of which the middle lies
 * within the overlap, in the order of the skin, over points of its own. An overlap below 0 stands for that
 * share of the limb's radius, which is taken as the length of the border with each neighbour over 2 pi: -0.5
 * is half of it. Memory of `arena`; false where it runs out. */
bool sbfi_section_cut(sbfi_section_cutter *cutter, uint32_t bone, sbf_polygon_mesh *mesh, sbfi_arena *arena);

#endif
