/* What the tests of collision share: sheets of cloth, and shapes in a world. */
#ifndef TEST_COLLISION_SCENES_H
#define TEST_COLLISION_SCENES_H

#include "sbrun/collision.h"
#include "scenes.h"

/* A square sheet of `side` metres about `center`, level, of cells x cells squares with diagonals, 0.2 kg/m^2;
 * its surface has the polygons. `pinned`: its rim is pinned to the world. */
sbf_level *collision_sheet(scene *s, uint32_t body, sbf_vec3 center, float side, uint32_t cells, bool pinned);

/* A surface of squares over points that stand in rows of so many columns. */
void collision_surface(scene *s, uint32_t body, const sbf_vec3 *at, uint32_t columns, uint32_t rows);

/* Shapes about their place: half the sizes of a box along x, y, z. */
sbr_shape_definition collision_ball(float radius);
sbr_shape_definition collision_box(float x, float y, float z);

/* A collider at a world place (scenes stand at the origin); the caller destroys the shape after the world. */
sbr_shape *collision_shape(sbr_shape_definition definition);
sbr_collider_id collision_collider(scene *s, const sbr_shape *shape, sbr_double3 position);

/* For a second, what `over` tells stays above 2 mm where it `collides`; else it falls through, by 5 cm. */
void collision_check_over(scene *s, float (*over)(const scene *), bool collides);

#endif
