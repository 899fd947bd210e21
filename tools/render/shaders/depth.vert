// Depth alone, seen by a light or from under the ground.
layout(location = 0) in vec3 position;

uniform mat4 map_from_world;

void main() { gl_Position = map_from_world * vec4(position, 1.0); }
