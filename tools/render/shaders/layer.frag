// Puts the layer of lines, its colours already multiplied by their opacity, over the picture.
uniform sampler2D line_layer;

out vec4 shown;

void main() { shown = texelFetch(line_layer, ivec2(gl_FragCoord.xy), 0); }
