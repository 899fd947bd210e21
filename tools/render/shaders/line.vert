// A line is a rectangle around it in the picture; all its four corners come with the whole line.
layout(location = 0) in vec3 from;
layout(location = 1) in vec3 to;
layout(location = 2) in vec4 from_colour;
layout(location = 3) in vec4 to_colour;
layout(location = 4) in float width;

uniform float thinness; // of all lines, where there are very many

flat out vec4 ends;      // both ends, pixels
flat out float radius;   // half the width, pixels
flat out float strength; // below 1 for lines that would be thinner than can be drawn
out vec4 colour;

const float least_radius = 0.45;

void main() {
  vec4 a = clip_from_world * vec4(from, 1.0), b = clip_from_world * vec4(to, 1.0);
  // What reaches behind the eye is cut at a small distance before it.
  float near = 0.02 * eye.w;
  if (a.w < near && b.w < near) {
    gl_Position = vec4(0.0, 0.0, 2.0, 1.0);
    return;
  }
  if (a.w < near) a = mix(a, b, (near - a.w) / (b.w - a.w));
  if (b.w < near) b = mix(b, a, (near - b.w) / (a.w - b.w));
  vec2 half_screen = 0.5 * screen.xy;
  vec2 a_pixel = (a.xy / a.w * 0.5 + 0.5) * screen.xy, b_pixel = (b.xy / b.w * 0.5 + 0.5) * screen.xy;
  vec2 run = b_pixel - a_pixel;
  float span = length(run);
  vec2 ahead = span > 1e-4 ? run / span : vec2(1.0, 0.0);

  bool at_end = (gl_VertexID & 1) == 1;
  float side = (gl_VertexID & 2) == 2 ? 1.0 : -1.0;
  vec4 middle = 0.5 * (a + b);
  float wanted = 0.5 * width * thinness * screen.y / 720.0 * clamp(eye.w / middle.w, 0.4, 2.5);
  radius = max(wanted, least_radius);
  strength = wanted / radius;
  ends = vec4(a_pixel, b_pixel);
  vec4 corner = at_end ? b : a;
  // Far ones step back into the air.
  float away = clamp(1.6 * (corner.w / eye.w - 1.0), 0.0, 0.55);
  colour = at_end ? to_colour : from_colour;
  colour.rgb = mix(colour.rgb, vec3(0.86, 0.87, 0.88), away);
  float reach = radius + 0.75;
  vec2 shift = (at_end ? ahead : -ahead) * reach + vec2(-ahead.y, ahead.x) * side * reach;
  gl_Position = corner + vec4(shift / half_screen * corner.w, 0.0, 0.0);
}
