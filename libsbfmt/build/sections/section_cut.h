/* Cuts the part of a skin that becomes one section: a bone's polygons, plus an overlap beyond the cut. */
#ifndef SBFI_SECTION_CUT_H
#define SBFI_SECTION_CUT_H

#include "build/geometry/topology.h"
#include "build/sections/skin_union.h"

typedef struct sbfi_section_cutter {
  const sbfi_skin_union *skin;
  const sbfi_topology *t;
  const uint32_t *labels; /* (polygons) */
  double overlap_m;       /* overlap of sections beyond the cut, along the surface; for negative values see
                             sbfi_section_cut */
  double *reach;          /* (points) m, remaining distance at each; negative: out of reach */
  double *shared;         /* (bones) length of the shared border */
  uint32_t *queue;
  uint32_t *new_points; /* (points) index in the last cut mesh; SBFI_NO_INDEX: none */
  uint8_t *queued;
  uint32_t bone_count;
  uint32_t *group_begins, *grouped; /* polygons of each bone: (bones + 2) and (polygons) */
  /* State of the current bone; a cut takes time proportional to its sizes. */
  uint32_t *border, border_count;     /* edges to other parts */
  uint32_t *reached, reached_count;   /* points within reach */
  uint32_t *selected, selected_count; /* polygons */
  uint8_t *is_candidate;              /* (polygons) */
} sbfi_section_cutter;

/* Allocates memory; the caller first fills `skin`, `t`, `labels` and `overlap_m`. */
bool sbfi_section_cutter_init(sbfi_section_cutter *cutter, uint32_t bone_count, sbfi_arena *arena);

/* Fills `*mesh` with the polygons of `bone` and others whose centre is within the overlap, in the order of
 * the skin, with their own points. A negative overlap is relative to the limb's radius, which is estimated
 * as the length of the border with each neighbour over 2 pi: -0.5 is half of it. Allocates from `arena`;
 * false if memory runs out. */
bool sbfi_section_cut(sbfi_section_cutter *cutter, uint32_t bone, sbf_polygon_mesh *mesh, sbfi_arena *arena);

#endif
