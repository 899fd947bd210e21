flat in vec4 ends;
flat in float radius;
flat in float strength;
in vec4 colour;

uniform sampler2D veil_depths; // of the nearest surface that is seen through; 1: none
uniform float murk;            // 0: veils are clear

out vec4 shown;

void main() {
  vec2 run = ends.zw - ends.xy, at = gl_FragCoord.xy - ends.xy;
  float place = clamp(dot(at, run) / max(dot(run, run), 1e-8), 0.0, 1.0);
  float off = length(at - run * place);
  float covered = clamp(radius + 0.5 - off, 0.0, 1.0) * strength;
  // Thick ones look round.
  float span = length(run);
  float across = span > 0.1 ? abs(run.x * at.y - run.y * at.x) / span : off; // so that joints do not show
  float round_off = across / max(radius, 1.0);
  vec3 seen = colour.rgb * (1.0 - 0.35 * smoothstep(1.2, 3.0, radius) * round_off * round_off);
  // What lies deep inside is dimmer than what is near the skin: so near and far sides are told apart.
  float veil = texelFetch(veil_depths, ivec2(gl_FragCoord.xy), 0).r;
  float inside = veil < 1.0 ? max(1.0 / gl_FragCoord.w - depth.x / (depth.y + veil), 0.0) : 0.0;
  float dimmed = 1.0 / (1.0 + murk * inside / depth.z);
  shown = vec4(seen, colour.a * covered * dimmed * dimmed);
}
