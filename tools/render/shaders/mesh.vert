layout(location = 0) in vec3 position;
layout(location = 1) in vec3 normal;
layout(location = 2) in vec4 tint;
layout(location = 3) in vec2 uv; // from the image's lower left corner

out vec3 world;
out vec3 facing;
out vec4 colour;
out vec2 on_image;

void main() {
  world = position;
  facing = normal;
  colour = tint;
  on_image = uv;
  gl_Position = clip_from_world * vec4(position, 1.0);
}
