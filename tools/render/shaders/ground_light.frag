// What light reaches each spot of the ground, as a map seen from above: red, how much of the sky it sees; green,
// how much of the key light. Painted once a frame and looked up by every pixel of the ground, so it can afford
// what a pixel could not.
uniform sampler2D ground_heights;
uniform sampler2D open_sky;

out vec4 light;

void main() {
  vec2 at = gl_FragCoord.xy * ground_map.w * ground_map.z;
  float here = texture(ground_heights, at).r;
  vec2 across = ground_map.xy + at / ground_map.z;
  vec3 world = vec3(across.x, mix(heights.x, heights.y, here), across.y);
  // Whole towards the rim, whose texels stand for all that lies outside.
  vec2 from_rim = min(at, 1.0 - at);
  float inside = smoothstep(0.02, 0.06, min(from_rim.x, from_rim.y));
  light = vec4(mix(vec2(1.0), vec2(texture(open_sky, at).r, key_light(world)), inside), 0.0, 1.0);
}
