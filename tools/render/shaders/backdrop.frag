out vec4 colour;

void main() { colour = vec4(stored_from_linear(backdrop(gl_FragCoord.xy)), 1.0); }
