// How much of the sky each spot of the ground sees past what stands or hovers above it, from two maps of heights
// seen from below: of the ground, and of the lowest thing above it.
uniform sampler2D ground_heights;
uniform sampler2D lowest_heights;

out vec4 open;

const int rings = 5, spokes = 10;
const float ring_growth = 2.0;

void main() {
  vec2 texel = 1.0 / vec2(textureSize(lowest_heights, 0));
  vec2 at = gl_FragCoord.xy * texel;
  float here = texture(ground_heights, at).r;
  float range = heights.y - heights.x;
  float hidden = 0.0;
  float radius = 0.7;
  for (int ring = 0; ring < rings; ring++) {
    float metres = radius * texel.x / ground_map.z;
    // Share of the ring's area that each of its samples stands for, over pi.
    float area = metres * metres * (ring_growth - 1.0 / ring_growth) / float(spokes);
    for (int spoke = 0; spoke < spokes; spoke++) {
      float angle = (float(spoke) + 0.5 * float(ring & 1)) * (6.2831853 / float(spokes));
      float lowest = texture(lowest_heights, at + radius * texel * vec2(cos(angle), sin(angle))).r;
      // A flat piece at height h and distance r hides h^2 / (pi (r^2 + h^2)^2) of the light a level floor gets
      // per its area. What reaches down to the ground hides light with its sides: as if it hung lower.
      float h = max((lowest - here) * range, 0.3 * metres);
      float d = metres * metres + h * h;
      hidden += lowest < 1.0 ? area * h * h / (d * d) : 0.0;
    }
    radius *= ring_growth;
  }
  open = vec4(vec3(clamp(1.0 - hidden, 0.0, 1.0)), 1.0);
}
