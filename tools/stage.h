/* The scene that the renderer draws of a session: the character's present skin, and its parts under the skin.
 */
#ifndef STAGE_H
#define STAGE_H

#include "render/draw_scene.h"
#include "session.h"
#include "skin_material.h"

enum {
  STAGE_SURFACE = 1,
  STAGE_SPRINGS = 2,
  STAGE_LATTICE = 4,
  STAGE_BONES = 8,
  STAGE_HULLS = 16,
  STAGE_STRAIN = 32,    /* springs coloured by strain rather than kind */
  STAGE_FEET = 64,      /* footprints, where steps go, rays to the ground */
  STAGE_CONTACTS = 128, /* contact points and impulses */
  STAGE_JOINTS = 256,   /* frames of joints and their limits */
  STAGE_BOUNDS = 512,   /* boxes around soft bodies that are stepped together; grey where they sleep */
  STAGE_LAYER_COUNT = 10
};

typedef struct stage stage;

/* `images` stay with the caller, until the stage is gone. `render_level` of each mesh: 0 the full one; where
 * there are fewer, the last. NULL: no memory. */
stage *stage_create(const session *s, const skin_images *images, unsigned show, uint32_t render_level);
void stage_destroy(stage *st);

/* Fills the scene with the present frame, ground included. Places are relative to where the world's origin
 * is. */
void stage_show(stage *st, const session *s, draw_scene *scene);

#endif
