/* The reference lizard's motion, worked out from its description (REFERENCE.md beside the real data) and the
 * OBJ file alone: nothing here is shared with the library. One section is one `g` group of the file. */
#ifndef TEST_REFERENCE_RELAXATION_H
#define TEST_REFERENCE_RELAXATION_H

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

typedef struct reference_face {
  uint32_t corners[4]; /* of the section, from 0 */
  uint32_t count;      /* 3 or 4 */
} reference_face;

typedef struct reference_pair {
  uint32_t a, b;
} reference_pair;

typedef struct reference_spring {
  uint32_t other;
  float rest;
} reference_spring;

/* A section: its surface's points, then the centre, then a point for each quad. */
typedef struct reference_section {
  float (*at)[3], (*before)[3];
  uint32_t surface_count, point_count;
  reference_face *faces;
  uint32_t face_count;
  bool *used; /* (surface_count) by a face */
  /* In the order in which they came in. */
  reference_pair *inner, *edges, *diagonals;
  uint32_t inner_count, edge_count, diagonal_count;
  /* Of each point, in that order. */
  reference_spring **inner_of, **edges_of, **diagonals_of;
  uint32_t *inner_of_count, *edges_of_count, *diagonals_of_count;
} reference_section;

typedef struct reference_body {
  reference_section *sections;
  uint32_t section_count;
} reference_body;

/* Reads the file; false where it cannot. Free with reference_free. */
bool reference_read(reference_body *body, const char *obj_text);
void reference_free(reference_body *body);
/* One tick, with bones at rest. */
void reference_tick(reference_body *body, float gravity, float stiffness, bool ground);

#endif
