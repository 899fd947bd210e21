/* What the page of `sbfmt export -o PAGE.html` draws with: a small renderer on WebGL2. Lengths are metres, colours linear
 * but where it says sRGB; a matrix is sixteen numbers, column after column. */

const COMMON = `#version 300 es
precision highp float;
precision highp sampler2DShadow;`;

const SURFACE_VERTEX = `${COMMON}
layout(location = 0) in vec3 position;
layout(location = 1) in vec3 normal;
layout(location = 2) in vec2 uv;
uniform mat4 viewProjection, lightProjection;
uniform vec3 offset;
out vec3 place, facing, lit;
out vec2 texturePlace;
void main() {
  place = position + offset;
  facing = normal;
  texturePlace = uv;
  vec4 light = lightProjection * vec4(place, 1);
  lit = light.xyz / light.w * 0.5 + 0.5;
  gl_Position = viewProjection * vec4(place, 1);
}`;

const SURFACE_FRAGMENT = `${COMMON}
in vec3 place, facing, lit;
in vec2 texturePlace;
uniform vec3 eye, lightWay, focus;
uniform vec4 color;
uniform float roughness, metallic, ground, reach, cell;
uniform sampler2D image;
uniform bool hasImage;
uniform sampler2DShadow shadows;
out vec4 result;

float shadow() {
  if (any(lessThan(lit, vec3(0))) || any(greaterThan(lit, vec3(1)))) return 1.0;
  float sum = 0.0;
  for (int i = 0; i < 9; i++)
    sum += texture(shadows, vec3(lit.xy + vec2(i % 3 - 1, i / 3 - 1) / 1536.0, lit.z - 0.0015));
  return sum / 9.0;
}
float gridLine(float width) {
  vec2 at = place.xz / cell, near = abs(fract(at - 0.5) - 0.5) / max(fwidth(at), vec2(1e-5));
  return 1.0 - min(min(near.x, near.y) / width, 1.0);
}
void main() {
  vec3 normal = normalize(gl_FrontFacing ? facing : -facing), toEye = normalize(eye - place);
  vec4 base = color;
  if (hasImage) {
    vec4 texel = texture(image, texturePlace);
    base *= vec4(pow(texel.rgb, vec3(2.2)), texel.a);
  }
  float far = 0.0;
  if (ground > 0.5) {
    base.rgb *= 1.0 - 0.3 * gridLine(1.3);
    far = smoothstep(0.35, 1.0, length(place.xz - focus.xz) / reach);
  }
  vec3 toLight = -lightWay, halfway = normalize(toLight + toEye);
  float open = max(dot(normal, toLight), 0.0) * shadow();
  float a = roughness * roughness, d = dot(normal, halfway) * dot(normal, halfway) * (a * a - 1.0) + 1.0;
  vec3 mirrored = mix(vec3(0.04), base.rgb, metallic);
  vec3 shine = mirrored + (1.0 - mirrored) * pow(1.0 - max(dot(normal, toEye), 0.0), 5.0) * (1.0 - roughness) * 0.5;
  vec3 sky = mix(vec3(0.33, 0.30, 0.27), vec3(0.62, 0.70, 0.80), normal.y * 0.5 + 0.5);
  vec3 light = base.rgb * (1.0 - metallic) * (sky * 0.75 + open * vec3(2.3, 2.2, 2.0)) +
    open * mirrored * min(a * a / (12.0 * d * d * max(dot(toLight, halfway), 0.1)), 4.0) + shine * sky * 0.4;
  light = light / (light + 0.85) * 1.25;
  vec3 backdrop = vec3(0.80, 0.85, 0.90);
  vec3 shown = mix(pow(clamp(light, 0.0, 1.0), vec3(1.0 / 2.2)), backdrop, far);
  result = vec4(shown * base.a, base.a);
}`;

const DEPTH_FRAGMENT = `${COMMON}
void main() {}`;

const LINE_VERTEX = `${COMMON}
layout(location = 0) in vec3 position;
layout(location = 1) in float kind;
layout(location = 2) in float strain;
uniform mat4 viewProjection;
uniform vec3 offset;
uniform int shown;
uniform bool byStrain;
out vec4 tint;
const vec3 kinds[6] = vec3[6](vec3(0.09, 0.37, 0.78), vec3(0.93, 0.55, 0.08), vec3(0.75, 0.24, 0.63), vec3(0.0, 0.59, 0.49),
  vec3(0.84, 0.19, 0.22), vec3(0.25, 0.60, 0.56));
void main() {
  int which = int(kind + 0.5);
  float amount = clamp(abs(strain) / 0.1, 0.0, 1.0);
  vec3 full = strain < 0.0 ? vec3(0.05, 0.38, 0.85) : vec3(0.86, 0.13, 0.13);
  tint = vec4(byStrain ? mix(vec3(0.62), full, amount) : kinds[which], 1);
  gl_Position = (shown >> which & 1) == 1 ? viewProjection * vec4(position + offset, 1) : vec4(2, 2, 2, 1);
}`;

const LINE_FRAGMENT = `${COMMON}
in vec4 tint;
out vec4 result;
void main() { result = tint; }`;

export const vector = {
  add: (a, b) => a.map((x, i) => x + b[i]),
  subtract: (a, b) => a.map((x, i) => x - b[i]),
  scale: (a, s) => a.map((x) => x * s),
  dot: (a, b) => a[0] * b[0] + a[1] * b[1] + a[2] * b[2],
  cross: (a, b) => [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]],
  length: (a) => Math.hypot(...a),
  unit: (a) => vector.scale(a, 1 / (Math.hypot(...a) || 1)),
  /** By a quaternion x, y, z, w. */
  turn: (q, v) => {
    const t = vector.scale(vector.cross(q, v), 2);
    return vector.add(v, vector.add(vector.scale(t, q[3]), vector.cross(q, t)));
  },
};

export const matrix = {
  multiply(a, b) {
    const c = new Float32Array(16);
    for (let column = 0; column < 4; column++)
      for (let row = 0; row < 4; row++)
        for (let k = 0; k < 4; k++) c[column * 4 + row] += a[k * 4 + row] * b[column * 4 + k];
    return c;
  },
  look(eye, at) {
    const z = vector.unit(vector.subtract(eye, at)), x = vector.unit(vector.cross([0, 1, 0], z)), y = vector.cross(z, x);
    return Float32Array.of(x[0], y[0], z[0], 0, x[1], y[1], z[1], 0, x[2], y[2], z[2], 0, -vector.dot(x, eye), -vector.dot(y, eye),
      -vector.dot(z, eye), 1);
  },
  perspective(halfHeight, aspect, near, far) {
    return Float32Array.of(1 / (halfHeight * aspect), 0, 0, 0, 0, 1 / halfHeight, 0, 0, 0, 0, (far + near) / (near - far), -1, 0, 0,
      2 * far * near / (near - far), 0);
  },
  box(half, near, far) {
    return Float32Array.of(1 / half, 0, 0, 0, 0, 1 / half, 0, 0, 0, 0, 2 / (near - far), 0, 0, 0, (far + near) / (near - far), 1);
  },
};

const SHADOW_SIZE = 1536;
const LIGHT_WAY = vector.unit([-0.45, -1, -0.35]);

/** Draws meshes and lines each frame: begin, then all of them twice (shadows, then the picture). */
export class Painter {
  constructor(canvas) {
    const gl = canvas.getContext('webgl2', { antialias: true, powerPreference: 'high-performance' });
    if (!gl) throw new Error('this browser has no WebGL2, which the page draws with');
    this.gl = gl;
    this.surface = this.program(SURFACE_VERTEX, SURFACE_FRAGMENT);
    this.depth = this.program(SURFACE_VERTEX, DEPTH_FRAGMENT);
    this.line = this.program(LINE_VERTEX, LINE_FRAGMENT);
    this.shadows = gl.createTexture();
    gl.bindTexture(gl.TEXTURE_2D, this.shadows);
    gl.texStorage2D(gl.TEXTURE_2D, 1, gl.DEPTH_COMPONENT24, SHADOW_SIZE, SHADOW_SIZE);
    gl.texParameteri(gl.TEXTURE_2D, gl.TEXTURE_COMPARE_MODE, gl.COMPARE_REF_TO_TEXTURE);
    gl.texParameteri(gl.TEXTURE_2D, gl.TEXTURE_MIN_FILTER, gl.LINEAR);
    gl.texParameteri(gl.TEXTURE_2D, gl.TEXTURE_MAG_FILTER, gl.LINEAR);
    this.shadowTarget = gl.createFramebuffer();
    gl.bindFramebuffer(gl.FRAMEBUFFER, this.shadowTarget);
    gl.framebufferTexture2D(gl.FRAMEBUFFER, gl.DEPTH_ATTACHMENT, gl.TEXTURE_2D, this.shadows, 0);
    gl.bindFramebuffer(gl.FRAMEBUFFER, null);
    this.blank = this.image();
  }

  program(vertex, fragment) {
    const { gl } = this, program = gl.createProgram();
    for (const [kind, text] of [[gl.VERTEX_SHADER, vertex], [gl.FRAGMENT_SHADER, fragment]]) {
      const shader = gl.createShader(kind);
      gl.shaderSource(shader, text);
      gl.compileShader(shader);
      gl.attachShader(program, shader);
      if (!gl.getShaderParameter(shader, gl.COMPILE_STATUS)) throw new Error(gl.getShaderInfoLog(shader));
    }
    gl.linkProgram(program);
    if (!gl.getProgramParameter(program, gl.LINK_STATUS)) throw new Error(gl.getProgramInfoLog(program));
    const places = {};
    for (let i = 0; i < gl.getProgramParameter(program, gl.ACTIVE_UNIFORMS); i++) {
      const { name } = gl.getActiveUniform(program, i);
      places[name] = gl.getUniformLocation(program, name);
    }
    return { program, places };
  }

  image(bitmap) {
    const { gl } = this, texture = gl.createTexture();
    gl.bindTexture(gl.TEXTURE_2D, texture);
    if (bitmap) gl.texImage2D(gl.TEXTURE_2D, 0, gl.RGBA, gl.RGBA, gl.UNSIGNED_BYTE, bitmap);
    else gl.texImage2D(gl.TEXTURE_2D, 0, gl.RGBA, 1, 1, 0, gl.RGBA, gl.UNSIGNED_BYTE, new Uint8Array([255, 255, 255, 255]));
    gl.generateMipmap(gl.TEXTURE_2D);
    return texture;
  }

  freeImage(texture) {
    this.gl.deleteTexture(texture ?? null);
  }

  /** Buffers for a mesh whose vertices may change each frame. */
  mesh(indices, uvs) {
    const { gl } = this, made = { array: gl.createVertexArray(), buffers: [0, 1].map(() => gl.createBuffer()), count: indices.length };
    gl.bindVertexArray(made.array);
    made.buffers.forEach((buffer, i) => this.attribute(i, buffer, 3));
    if (uvs) {
      made.buffers.push(gl.createBuffer());
      this.attribute(2, made.buffers[2], 2);
      gl.bufferData(gl.ARRAY_BUFFER, uvs, gl.STATIC_DRAW);
    }
    made.indices = gl.createBuffer();
    gl.bindBuffer(gl.ELEMENT_ARRAY_BUFFER, made.indices);
    gl.bufferData(gl.ELEMENT_ARRAY_BUFFER, indices, gl.STATIC_DRAW);
    gl.bindVertexArray(null);
    return made;
  }

  attribute(place, buffer, size, stride = 0, offset = 0) {
    const { gl } = this;
    gl.bindBuffer(gl.ARRAY_BUFFER, buffer);
    gl.enableVertexAttribArray(place);
    gl.vertexAttribPointer(place, size, gl.FLOAT, false, stride, offset);
  }

  fill(mesh, positions, normals) {
    const { gl } = this;
    [positions, normals].forEach((numbers, i) => {
      gl.bindBuffer(gl.ARRAY_BUFFER, mesh.buffers[i]);
      gl.bufferData(gl.ARRAY_BUFFER, numbers, gl.DYNAMIC_DRAW);
    });
  }

  freeMesh(mesh) {
    const { gl } = this;
    gl.deleteVertexArray(mesh.array);
    for (const buffer of [...mesh.buffers, mesh.indices]) gl.deleteBuffer(buffer);
  }

  /** A picture of the surroundings of `focus`, `size` metres large; `draw` is called for the shadows, then for the picture. */
  picture({ eye, focus, size, halfHeight }, draw) {
    const { gl } = this, { width, height } = gl.canvas, reach = size * 9;
    const light = matrix.multiply(matrix.box(size * 1.3, 0.1, size * 8), matrix.look(vector.add(focus, vector.scale(LIGHT_WAY, -size * 4)), focus));
    const view = matrix.multiply(matrix.perspective(halfHeight, width / height, size * 0.01, size * 40), matrix.look(eye, focus));
    gl.enable(gl.DEPTH_TEST);
    gl.bindFramebuffer(gl.FRAMEBUFFER, this.shadowTarget);
    gl.viewport(0, 0, SHADOW_SIZE, SHADOW_SIZE);
    gl.clear(gl.DEPTH_BUFFER_BIT);
    this.pass = { shadows: true, view: light };
    draw(true);
    gl.bindFramebuffer(gl.FRAMEBUFFER, null);
    gl.viewport(0, 0, width, height);
    gl.clearColor(0.80, 0.85, 0.90, 1);
    gl.clear(gl.COLOR_BUFFER_BIT | gl.DEPTH_BUFFER_BIT);
    gl.enable(gl.BLEND);
    gl.blendFunc(gl.ONE, gl.ONE_MINUS_SRC_ALPHA);
    this.pass = { shadows: false, view, light, eye, focus, reach, cell: 10 ** Math.floor(Math.log10(size)) / 2 };
    draw(false);
    gl.disable(gl.BLEND);
  }

  /** `parts`: [{start, count, color, roughness, metallic, image}]; `origin` is added to all places. */
  drawMesh(mesh, parts, origin, { ground = false } = {}) {
    const { gl, pass } = this, { program, places } = pass.shadows ? this.depth : this.surface;
    gl.useProgram(program);
    gl.uniformMatrix4fv(places.viewProjection, false, pass.view);
    gl.uniform3fv(places.offset, origin);
    gl.bindVertexArray(mesh.array);
    if (!pass.shadows) {
      gl.uniformMatrix4fv(places.lightProjection, false, pass.light);
      gl.uniform3fv(places.eye, pass.eye);
      gl.uniform3fv(places.focus, pass.focus);
      gl.uniform3fv(places.lightWay, LIGHT_WAY);
      gl.uniform1f(places.ground, ground ? 1 : 0);
      gl.uniform1f(places.reach, pass.reach);
      gl.uniform1f(places.cell, pass.cell);
      gl.uniform1i(places.image, 0);
      gl.uniform1i(places.shadows, 1);
      gl.activeTexture(gl.TEXTURE1);
      gl.bindTexture(gl.TEXTURE_2D, this.shadows);
      gl.activeTexture(gl.TEXTURE0);
    }
    for (const part of parts) {
      if (!pass.shadows) {
        gl.bindTexture(gl.TEXTURE_2D, part.image ?? this.blank);
        gl.uniform1i(places.hasImage, part.image ? 1 : 0);
        gl.uniform4fv(places.color, part.color);
        gl.uniform1f(places.roughness, Math.max(part.roughness ?? 0.8, 0.15));
        gl.uniform1f(places.metallic, part.metallic ?? 0);
      }
      gl.drawElements(gl.TRIANGLES, part.count ?? mesh.count, gl.UNSIGNED_INT, (part.start ?? 0) * 4);
    }
    gl.bindVertexArray(null);
  }

  /** Draws in front of all that was drawn so far. */
  drawOver(draw) {
    this.gl.clear(this.gl.DEPTH_BUFFER_BIT);
    draw();
  }

  /** Ten numbers a line, as Character.lines gives them; `shown` has a bit for each kind. */
  drawLines(lines, origin, shown, byStrain) {
    const { gl, pass } = this, { program, places } = this.line;
    if (pass.shadows || !lines.length) return;
    this.lineArray ??= gl.createVertexArray();
    this.lineBuffer ??= gl.createBuffer();
    gl.bindVertexArray(this.lineArray);
    [[0, 3, 0], [1, 1, 12], [2, 1, 16]].forEach(([place, size, offset]) => this.attribute(place, this.lineBuffer, size, 20, offset));
    gl.bufferData(gl.ARRAY_BUFFER, lines, gl.DYNAMIC_DRAW);
    gl.useProgram(program);
    gl.uniformMatrix4fv(places.viewProjection, false, pass.view);
    gl.uniform3fv(places.offset, origin);
    gl.uniform1i(places.shown, shown);
    gl.uniform1i(places.byStrain, byStrain ? 1 : 0);
    gl.drawArrays(gl.LINES, 0, lines.length / 5);
    gl.bindVertexArray(null);
  }
}

/** A ball of radius 1: {positions, normals, indices}. */
export function ball(rows = 16) {
  const positions = [], indices = [], columns = 2 * rows;
  for (let row = 0; row <= rows; row++)
    for (let column = 0; column <= columns; column++) {
      const up = Math.PI * row / rows, around = 2 * Math.PI * column / columns;
      positions.push(Math.sin(up) * Math.cos(around), Math.cos(up), Math.sin(up) * Math.sin(around));
      if (row === rows || column === columns) continue;
      const at = row * (columns + 1) + column;
      indices.push(at, at + 1, at + columns + 1, at + 1, at + columns + 2, at + columns + 1);
    }
  return { positions: new Float32Array(positions), normals: new Float32Array(positions), indices: new Uint32Array(indices) };
}

/** Bones as long octahedra: `bones` as Character.bones gives them, `lengths` in metres, `width` half as a share of the length. */
export function boneShapes(bones, lengths, width = 0.09) {
  const positions = [], normals = [], indices = [];
  lengths.forEach((length, i) => {
    if (!(length > 0)) return;
    const head = Array.from(bones.subarray(7 * i, 7 * i + 3)), turn = Array.from(bones.subarray(7 * i + 3, 7 * i + 7)), wide = length * width;
    const local = [[0, 0, 0], [wide, 0.15 * length, 0], [0, 0.15 * length, wide], [-wide, 0.15 * length, 0], [0, 0.15 * length, -wide], [0, length, 0]];
    const at = local.map((v) => vector.add(head, vector.turn(turn, v)));
    for (let side = 0; side < 4; side++)
      for (const [a, b, c] of [[0, 1 + (side + 1) % 4, 1 + side], [5, 1 + side, 1 + (side + 1) % 4]]) {
        let normal = vector.unit(vector.cross(vector.subtract(at[b], at[a]), vector.subtract(at[c], at[a])));
        const outwards = vector.subtract(at[b], vector.add(head, vector.scale(vector.subtract(at[5], head), 0.15)));
        if (vector.dot(normal, outwards) < 0) normal = vector.scale(normal, -1);
        for (const corner of [a, b, c]) {
          indices.push(positions.length / 3);
          positions.push(...at[corner]);
          normals.push(...normal);
        }
      }
  });
  return { positions: new Float32Array(positions), normals: new Float32Array(normals), indices: new Uint32Array(indices) };
}
