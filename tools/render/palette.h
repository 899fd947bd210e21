/* sRGB colours with 8 bits, and their uses in the project's pictures. */
#ifndef RENDER_PALETTE_H
#define RENDER_PALETTE_H

#include "sbfmt/base.h"

typedef struct draw_colour {
  uint8_t r, g, b, a; /* sRGB, straight alpha; a = 255 is opaque */
} draw_colour;

draw_colour draw_colour_rgb(uint32_t hex); /* 0xrrggbb, opaque */
draw_colour draw_colour_mix(
    draw_colour from, draw_colour to, float t); /* linear blend of the stored values; t is clamped to 0..1 */

/* Colour of a kind of spring, and its line width: thin for numerous kinds. */
typedef enum draw_spring_style_kind {
  DRAW_SPRING_STYLE_STRUCTURAL,
  DRAW_SPRING_STYLE_SHEAR,
  DRAW_SPRING_STYLE_FLEXION,
  DRAW_SPRING_STYLE_INTERNAL,
  DRAW_SPRING_STYLE_CROSS, /* between two bodies */
  DRAW_SPRING_STYLE_COUNT
} draw_spring_style_kind;

typedef struct spring_style {
  const char *name;
  draw_colour colour;
  float width; /* as draw_line.width */
} draw_spring_style;

/* Never NULL; a kind out of range gives that of structural springs. */
const draw_spring_style *draw_spring_style_of(draw_spring_style_kind kind);

/* Further colours, so that all pictures look alike. */
draw_colour draw_colour_of_skin(void); /* if the asset has none */
draw_colour draw_colour_of_bone(void);
draw_colour draw_colour_of_hull(void);
draw_colour draw_colour_of_tetrahedron(void);
draw_colour draw_colour_of_target(void);  /* target of a foot */
draw_colour draw_colour_of_contact(void); /* contact of a foot */
draw_colour draw_colour_of_ray(void);     /* down to the ground */
draw_colour draw_colour_of_pole(void);    /* target of a knee */

/* Two colour maps with perceptually uniform steps in OKLab: diverging for signed strain (blue compressed,
 * pale at rest, red stretched), sequential for magnitudes (dark violet, blue, green, yellow). Fill once,
 * look up often. */
enum { DRAW_COLOUR_MAP_SIZE = 256 };
typedef struct draw_colour_map {
  draw_colour at[DRAW_COLOUR_MAP_SIZE];
} draw_colour_map;

void draw_colour_map_init_diverging(draw_colour_map *map);
void draw_colour_map_init_sequential(draw_colour_map *map);

/* `t` from 0 to 1, clamped; NaN gives magenta, which no map contains. */
draw_colour draw_colour_map_at(const draw_colour_map *map, float t);

/* Diverging: strain (l - l0) / l0, full colour at +-full_strain. */
draw_colour draw_colour_map_at_strain(const draw_colour_map *map, float strain, float full_strain);

#endif
