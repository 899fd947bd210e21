layout(location = 0) in vec3 position;
layout(location = 1) in vec3 normal;
layout(location = 2) in vec4 tint;

out vec3 world;
out vec3 facing;
out vec4 colour;

void main() {
  world = position;
  facing = normal;
  colour = tint;
  gl_Position = clip_from_world * vec4(position, 1.0);
}
