/* Skins of spring networks that tear. */
#ifndef SBRI_TORN_NETWORK_H
#define SBRI_TORN_NETWORK_H

#include "soft/tear/spring_network.h"
#include "state/state.h"

/* An island whose springs may tear, after its points have split. */
typedef struct sbri_torn_network {
  sbri_character *c;
  sbri_island island; /* its present state */
  sbri_network whole, rest;
  const uint32_t *origins;
  uint32_t *seen, *queue; /* (slots) */
} sbri_torn_network;
void sbri_torn_network_begin(sbri_torn_network *network, sbri_character *c, uint32_t island);
/* Moves a vertex to one side of a tear; returns whether its embedding has changed or is near a torn spring.
 */
bool sbri_network_vertex_follow(const sbri_torn_network *network, const sbri_skin *skin, uint32_t binding);
/* Whether a tear has separated the points that embed two vertices. */
bool sbri_network_vertices_part(
    const sbri_torn_network *network, const sbri_skin *skin, uint32_t binding_a, uint32_t binding_b);

#endif
