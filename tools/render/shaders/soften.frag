// Smooths the map of the ground's light: a tent over five by five texels, in nine samples between them.
uniform sampler2D ground_light;

out vec4 light;

void main() {
  vec2 texel = 1.0 / vec2(textureSize(ground_light, 0));
  vec2 at = gl_FragCoord.xy * texel;
  light = vec4(0.0);
  for (int y = -1; y <= 1; y++)
    for (int x = -1; x <= 1; x++) {
      float weight = (2.0 - abs(float(x))) * (2.0 - abs(float(y))) / 16.0;
      light += weight * texture(ground_light, at + 1.5 * texel * vec2(x, y));
    }
}
