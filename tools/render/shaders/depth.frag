#ifdef ALPHA
in float alpha;
in vec2 on_image;

uniform sampler2D base_image;
uniform float cutoff;

void main() {
  if (alpha * texture(base_image, vec2(on_image.x, 1.0 - on_image.y)).a < cutoff) discard;
}
#else
void main() {}
#endif
