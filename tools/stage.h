/* The scene of a session for the renderer: the character's current skin, and its parts under the skin. */
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
  STAGE_FEET = 64,      /* footprints, targets of steps, rays to the ground */
  STAGE_CONTACTS = 128, /* contact points and impulses */
  STAGE_JOINTS = 256,   /* frames of joints and their limits */
  STAGE_BOUNDS = 512,   /* boxes around soft bodies that are stepped together; grey if asleep */
  STAGE_LAYER_COUNT = 10
};

typedef struct stage stage;

/* `images` must outlive the stage. `render_level` of each mesh: 0 the full one; the last if there are
 * fewer. NULL if memory runs out. */
stage *stage_create(const session *s, const skin_images *images, unsigned show, uint32_t render_level);
void stage_destroy(stage *st);

/* Fills the scene with the current frame, including the ground. Positions are relative to the world's
 * origin. */
void stage_show(stage *st, const session *s, draw_scene *scene);

#endif
