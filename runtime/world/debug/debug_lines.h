/* Lines and points of sbr_world_draw (sbrun/debug.h), converted to world space for the host's functions. */
#ifndef SBRI_DEBUG_LINES_H
#define SBRI_DEBUG_LINES_H

#include "math/quat.h"
#include "sbrun/debug.h"
#include "shapes/hull.h"

/* Colours, 0xRRGGBB. */
enum {
  SBRI_DRAW_GREY = 0x808890,
  SBRI_DRAW_WHITE = 0xffffff,
  SBRI_DRAW_RED = 0xe05040,
  SBRI_DRAW_GREEN = 0x50b050,
  SBRI_DRAW_BLUE = 0x4080e0,
  SBRI_DRAW_ORANGE = 0xf09030,
  SBRI_DRAW_YELLOW = 0xf0d040
};

/* Size of a point. */
#define SBRI_POINT_PIXELS 6.0f

/* Target of lines: positions times `scale` plus `origin` are in world metres. */
typedef struct sbri_debug_lines {
  const sbr_debug_draw *draw;
  sbr_double3 origin;
  float scale;
} sbri_debug_lines;

void sbri_draw_line(const sbri_debug_lines *to, sbf_vec3 a, sbf_vec3 b, uint32_t color);
void sbri_draw_point(const sbri_debug_lines *to, sbf_vec3 at, float size_pixels, uint32_t color);
void sbri_draw_box(
    const sbri_debug_lines *to, const sbri_box *box, const sbr_transform *pose, uint32_t color);
/* An arc about `center`, from the tip of `x` by the angles towards `y`; x and y are radii. */
void sbri_draw_arc(const sbri_debug_lines *to, sbf_vec3 center, sbf_vec3 x, sbf_vec3 y, float from_rad,
    float to_rad, uint32_t color);
/* Edges of a hull in that pose. */
void sbri_draw_hull(
    const sbri_debug_lines *to, const sbri_hull *hull, const sbr_transform *pose, uint32_t color);

/* A contact: red with an impulse (N s), with a line along its normal; else blue. */
void sbri_draw_contact(const sbri_debug_lines *to, sbf_vec3 at, sbf_vec3 normal, float impulse);

/* ---- world/debug/debug_draw_rigid.c ---- */

struct sbri_character;
void sbri_draw_rigid_bodies(const struct sbri_character *c, const sbri_debug_lines *to);
void sbri_draw_joints(const struct sbri_character *c, float size, const sbri_debug_lines *to);
/* Contacts of rigid bodies with ground and colliders that carry a force. `tick_s`: the world's. */
void sbri_draw_rigid_contacts(const struct sbri_character *c, double tick_s, const sbri_debug_lines *to);
void sbri_draw_colliders(const sbr_world *world, const sbr_debug_draw *draw);

#endif
