// Included by what is lit: how much of the key light and of the sky arrives at a point.
uniform sampler2DShadow shadow_map; // compared and smoothed
uniform sampler2D shadow_depths;    // the same map as plain depths
uniform sampler2D ground_light;

// 1 where the key light arrives whole, looking SHADOW_SAMPLES (1 to 24) times for what is in the way and as often
// past it. The nearer what is in the way, the sharper its shadow. The second loop runs zero times where nothing
// was found: a software renderer leaves a loop early but runs both sides of an if.
float key_light(vec3 at) {
#if SHADOW_SAMPLES == 0
  return 1.0;
#else
  vec3 place = (shadow_from_world * vec4(at, 1.0)).xyz;
  place.z = min(place.z, 1.0);
  const float spread = sqrt(24.0 / float(SHADOW_SAMPLES)); // the disc's first points, drawn out to all of it
  float blockers = 0.0, depths = 0.0;
  for (int i = 0; i < SHADOW_SAMPLES; i++) {
    float depth = textureLod(shadow_depths, place.xy + disc[i].xy * (spread * shadow.x), 0.0).r;
    float blocks = depth < place.z - 0.002 ? 1.0 : 0.0;
    blockers += blocks;
    depths += blocks * depth;
  }
  float penumbra = clamp((place.z - depths / max(blockers, 1.0)) * shadow.y, shadow.z, shadow.x);
  float lit = 0.0;
  int looked = blockers > 0.0 ? SHADOW_SAMPLES : 0;
  for (int i = 0; i < looked; i++)
    lit += textureLod(shadow_map, vec3(place.xy + disc[i].xy * (spread * penumbra), place.z - 0.001), 0.0);
  return looked > 0 ? lit / float(SHADOW_SAMPLES) : 1.0;
#endif
}

// Of the ground below (or here): x, the share of the sky it sees; y, of the key light it gets.
vec2 ground_light_at(vec2 at) { return texture(ground_light, (at - ground_map.xy) * ground_map.z).rg; }
