// Depth alone, seen by a light or from under the ground.
layout(location = 0) in vec3 position;
layout(location = 2) in vec4 tint;
layout(location = 3) in vec2 uv;

out float alpha;
out vec2 on_image;

uniform mat4 map_from_world;

void main() {
  alpha = tint.a;
  on_image = uv;
  gl_Position = map_from_world * vec4(position, 1.0);
}
