/* OKLab: B. Ottosson, "A perceptual color space for image processing", 2020: lightness and two opponent
 * axes with perceptually uniform distances. */
#include "render/palette.h"

#include <math.h>

draw_colour draw_colour_rgb(uint32_t hex) {
  return (draw_colour){(uint8_t)(hex >> 16), (uint8_t)(hex >> 8), (uint8_t)hex, 255};
}

static uint8_t mix_byte(uint8_t from, uint8_t to, float t) {
  return (uint8_t)((float)from + ((float)to - (float)from) * t + 0.5f);
}

draw_colour draw_colour_mix(draw_colour from, draw_colour to, float t) {
  t = t > 0 ? (t < 1 ? t : 1) : 0;
  return (draw_colour){mix_byte(from.r, to.r, t), mix_byte(from.g, to.g, t), mix_byte(from.b, to.b, t),
      mix_byte(from.a, to.a, t)};
}

const draw_spring_style *draw_spring_style_of(draw_spring_style_kind kind) {
  /* Hues that are distinct for the common kinds of colour blindness, with similar lightness. */
  static const draw_spring_style styles[DRAW_SPRING_STYLE_COUNT] = {
      {"structural", {24, 95, 200, 255}, 1.7f},
      {"shear", {238, 140, 20, 255}, 1.3f},
      {"flexion", {190, 60, 160, 255}, 1.3f},
      {"internal", {0, 150, 125, 255}, 0.9f},
      {"cross", {214, 48, 56, 255}, 1.7f},
  };
  unsigned index = (unsigned)kind;
  return &styles[index < DRAW_SPRING_STYLE_COUNT ? index : 0];
}

draw_colour draw_colour_of_skin(void) {
  return draw_colour_rgb(0x5fa777);
}
draw_colour draw_colour_of_bone(void) {
  return draw_colour_rgb(0xf2ead8);
}
draw_colour draw_colour_of_hull(void) {
  return draw_colour_rgb(0x5b7fd6);
}
draw_colour draw_colour_of_tetrahedron(void) {
  return draw_colour_rgb(0x3f9a8f);
}
draw_colour draw_colour_of_target(void) {
  return draw_colour_rgb(0xe8743b);
}
draw_colour draw_colour_of_contact(void) {
  return draw_colour_rgb(0x2f7fd0);
}
draw_colour draw_colour_of_ray(void) {
  return draw_colour_rgb(0xc8283c);
}
draw_colour draw_colour_of_pole(void) {
  return draw_colour_rgb(0xa34fb0);
}

typedef struct oklab {
  float lightness, a, b;
} oklab;

static float srgb_from_linear(float x) {
  x = x > 0 ? (x < 1 ? x : 1) : 0;
  return x <= 0.0031308f ? 12.92f * x : 1.055f * powf(x, 1 / 2.4f) - 0.055f;
}

static draw_colour draw_colour_from_oklab(oklab c) {
  float l = c.lightness + 0.3963377774f * c.a + 0.2158037573f * c.b;
  float m = c.lightness - 0.1055613458f * c.a - 0.0638541728f * c.b;
  float s = c.lightness - 0.0894841775f * c.a - 1.2914855480f * c.b;
  l = l * l * l, m = m * m * m, s = s * s * s;
  float red = 4.0767416621f * l - 3.3077115913f * m + 0.2309699292f * s;
  float green = -1.2684380046f * l + 2.6097574011f * m - 0.3413193965f * s;
  float blue = -0.0041960863f * l - 0.7034186147f * m + 1.7076147010f * s;
  return (draw_colour){(uint8_t)(srgb_from_linear(red) * 255 + 0.5f),
      (uint8_t)(srgb_from_linear(green) * 255 + 0.5f), (uint8_t)(srgb_from_linear(blue) * 255 + 0.5f), 255};
}

static oklab oklab_from_polar(float lightness, float chroma, float hue_degrees) {
  float hue = hue_degrees * 0.017453293f;
  return (oklab){lightness, chroma * cosf(hue), chroma * sinf(hue)};
}

/* Both halves decrease from the same pale grey to the same lightness and chroma, so both signs have equal
 * weight. */
void draw_colour_map_init_diverging(draw_colour_map *map) {
  for (int i = 0; i < DRAW_COLOUR_MAP_SIZE; i++) {
    float t = 2 * (float)i / (DRAW_COLOUR_MAP_SIZE - 1) - 1, amount = fabsf(t);
    float hue = t < 0 ? 257.0f : 26.0f;
    map->at[i] =
        draw_colour_from_oklab(oklab_from_polar(0.84f - 0.32f * amount, 0.005f + 0.185f * amount, hue));
  }
}

void draw_colour_map_init_sequential(draw_colour_map *map) {
  for (int i = 0; i < DRAW_COLOUR_MAP_SIZE; i++) {
    float t = (float)i / (DRAW_COLOUR_MAP_SIZE - 1);
    float hue = 310 - 205 * t; /* violet, through blue and green, to yellow */
    float chroma = 0.11f + 0.07f * t - 0.05f * sinf(3.14159265f * t);
    map->at[i] = draw_colour_from_oklab(oklab_from_polar(0.30f + 0.60f * t, chroma, hue));
  }
}

draw_colour draw_colour_map_at(const draw_colour_map *map, float t) {
  if (t != t) return (draw_colour){255, 0, 255, 255};
  float coordinate = t > 0 ? (t < 1 ? t : 1) : 0;
  return map->at[(int)(coordinate * (DRAW_COLOUR_MAP_SIZE - 1) + 0.5f)];
}

draw_colour draw_colour_map_at_strain(const draw_colour_map *map, float strain, float full_strain) {
  return draw_colour_map_at(map, full_strain > 0 ? 0.5f + 0.5f * strain / full_strain : 0.5f);
}
