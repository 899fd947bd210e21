in vec3 world;
in vec3 facing;

out vec4 shown;

// Share of the pixel that lines every `cell` metres cover.
float lines(vec2 at, float cell, float width) {
  vec2 place = at / cell;
  vec2 across = max(fwidth(place), vec2(1e-6));
  vec2 from_line = abs(fract(place - 0.5) - 0.5) / across;
  vec2 covered = clamp(width * 0.5 + 0.5 - from_line, 0.0, 1.0);
  // Where lines crowd together they melt into their mean.
  vec2 crowded = smoothstep(vec2(0.15), vec2(0.5), across);
  covered = mix(covered, width * across, crowded) * (1.0 - crowded);
  return max(covered.x, covered.y);
}

void main() {
  vec3 normal = normalize(facing);
  if (!gl_FrontFacing) normal = -normal;
  float towards_key = clamp(dot(normal, key.xyz), 0.0, 1.0);
  float distance_out = length(world - subject.xyz) / subject.w;
  float fade = smoothstep(0.30, 1.0, distance_out);
  vec2 arrives = ground_light_at(world.xz);
  float grid = 0.10 * lines(world.xz, floor_grid.x, floor_grid.y) +
               0.12 * lines(world.xz, floor_grid.x * 5.0, floor_grid.y * 1.3);
  grid *= 1.0 - smoothstep(0.10, 0.55, distance_out);
  vec3 albedo = vec3(0.60, 0.605, 0.61) * (1.0 - grid);
  vec3 light = vec3(0.98, 0.95, 0.90) * (towards_key / 0.72) * arrives.y;
  light += vec3(0.44, 0.47, 0.52) * mix(0.2, 1.0, arrives.x) * (0.5 + 0.5 * normal.y);
  vec3 seen = mix(albedo * light, backdrop(gl_FragCoord.xy), fade);
  shown = vec4(stored_from_linear(seen), 1.0);
}
