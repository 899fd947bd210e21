#version 330 core

// What every pass of one frame shares. Written by painter.c in the same order.
layout(std140) uniform Frame {
  mat4 clip_from_world;
  mat4 shadow_from_world;  // to 0..1 across the shadow map and along the light
  vec4 eye;                // xyz; w: distance to what is looked at
  vec4 subject;            // xyz: what is looked at; w: radius at which the ground has faded out
  vec4 key;                // xyz: unit, towards the light; w: 1 where bodies throw shadows on bodies
  vec4 fill;               // xyz: likewise
  vec4 rim;                // xyz: likewise
  vec4 screen;             // pixels wide and high, and one over each
  vec4 floor_grid;         // x: cell, metres; y: width of a grid line, pixels of the drawing surface
  vec4 ground_map;         // xy: least x and z of the map of its light; z: 1 / its side; w: a texel, metres
  vec4 heights;            // x: height of the map's 0; y: of its 1
  vec4 shadow;             // x: search radius; y: penumbra per depth; z: least penumbra; w: offset, metres
  vec4 depth;              // xy: distance = x / (y + depth of the map in 0..1); z: how far one sees into a veil
  vec4 disc[24];           // xy: points spread evenly over the unit disc
};

// All light is reckoned linearly and made into the picture's colours at the very end.
// A power of 2 for sRGB's 2.2 or so: near enough to look at, and far cheaper without a graphics card.
vec3 linear_from_stored(vec3 c) { return c * c; }

// Straight for the dark and middle tones, which keeps colours as they were chosen, then a soft shoulder.
vec3 stored_from_linear(vec3 c) {
  vec3 over = max(c - 0.55, 0.0);
  c = min(c, 0.55) + 0.45 * (1.0 - exp(-over / 0.45));
  return sqrt(max(c, 0.0));
}

// A studio backdrop: light behind the subject, falling off to the corners and the top.
vec3 backdrop(vec2 pixel) {
  vec2 at = pixel * screen.zw;
  vec3 colour = mix(vec3(0.80, 0.825, 0.85), vec3(0.50, 0.56, 0.635), smoothstep(0.25, 1.15, at.y));
  vec2 from_middle = (at - vec2(0.5, 0.45)) * vec2(1.0, 0.9);
  return colour * (1.06 - 0.55 * dot(from_middle, from_middle));
}
