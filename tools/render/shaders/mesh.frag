in vec3 world;
in vec3 facing;
in vec4 colour;
#ifdef BASE_IMAGE
in vec2 on_image;

uniform sampler2D base_image; // its first row is the highest
#endif

uniform float opacity; // 1: solid
#ifdef ALPHA
uniform float cutoff; // nothing is drawn where opacity is below it
#endif

out vec4 shown;

void main() {
  vec3 to_eye = normalize(eye.xyz - world);
  vec3 normal = normalize(facing);
  if (dot(normal, to_eye) < 0.0 && !gl_FrontFacing) normal = -normal;
  // The facet as it is, which smooth normals of a coarse body lean far off.
  vec3 facet = normalize(cross(dFdx(world), dFdy(world)));
  if (dot(facet, to_eye) < 0.0) facet = -facet;
  vec3 albedo = linear_from_stored(colour.rgb);
#ifdef BASE_IMAGE
  vec4 on_it = texture(base_image, vec2(on_image.x, 1.0 - on_image.y));
  albedo *= linear_from_stored(on_it.rgb);
#endif
#ifdef ALPHA
  float alpha = colour.a * on_it.a;
  if (alpha < cutoff) discard;
#endif

  // The key wraps a little around the body, as light does in something soft.
  float towards_key = dot(normal, key.xyz);
  float arrives = mix(1.0, key_light(world + normal * shadow.w), key.w);
  float wrapped = clamp((towards_key + 0.2) / 1.2, 0.0, 1.0);
  vec3 light = vec3(0.98, 0.94, 0.87) * wrapped * mix(1.0, arrives, smoothstep(-0.1, 0.25, towards_key));
  light += vec3(0.12, 0.15, 0.19) * clamp(dot(normal, fill.xyz) * 0.5 + 0.5, 0.0, 1.0);
  // The sky from above, the floor's own glow from below where the body does not stand in its way.
  float above = normal.y * 0.5 + 0.5;
  float open = ground_light_at(world.xz).x;
  light += mix(vec3(0.24, 0.225, 0.21) * open * open, vec3(0.36, 0.39, 0.43), above);
  vec3 seen = albedo * light;

  // A satin sheen from the key, and a bright line along the edge that is turned to the light behind.
  // A facet that the eye sees whole is no edge, wherever its smooth normals point.
  float facing_eye = clamp(max(dot(normal, to_eye), dot(facet, to_eye) - 0.1), 0.0, 1.0);
  float fresnel = pow(1.0 - facing_eye, 4.0);
  float half_way = clamp(dot(normal, normalize(key.xyz + to_eye)), 0.0, 1.0);
  seen += vec3(1.0, 0.97, 0.92) * (0.16 * pow(half_way, 28.0) * arrives * wrapped);
  float behind = clamp(dot(normal, rim.xyz) * 0.8 + 0.2, 0.0, 1.0);
  seen += vec3(0.9, 0.96, 1.0) * (fresnel * (0.05 + 0.40 * behind));

  // Seen through: clearest where it faces the eye, denser towards its outline, as a bubble is.
  float veil = opacity + (1.0 - opacity) * 0.7 * pow(1.0 - facing_eye, 2.5);
  shown = vec4(stored_from_linear(seen), opacity < 1.0 ? veil * colour.a : 1.0);
#ifdef ALPHA
  shown.a = alpha;
#endif
}
