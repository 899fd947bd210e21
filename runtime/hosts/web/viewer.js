/* The page of `sbfmt export -o PAGE.html`: a character to look at, to walk about, to drag and to throw balls at.
 * Keys and pointer steer; what is pressed, shown and chosen stands in the panel of viewer.html. */
import { load } from './sbfmt.js';
import { Painter, ball, boneShapes, vector } from './viewer_draw.js';

const element = (id) => document.getElementById(id);
/** The bytes that stand in the page. */
function bytesIn(selector) {
  return Uint8Array.from(atob(document.querySelector(selector)?.textContent ?? ''), (one) => one.charCodeAt(0));
}
const SPRINGS = 0b011111, LATTICE = 0b100000;
const BALLS = 6, FRAME = 1 / 60, GRAVITY = 9.80665;
/** Physics may take so much of a frame, in ms or as a share of the frame before; what time it then has not covered is let go: slow motion. */
const PHYSICS_MS = 10, PHYSICS_SHARE = 0.35, LONGEST_FRAME = 0.25;
const LANDS = {
  flat: () => ({ kind: 'flat' }),
  uneven: (size) => ({ kind: 'noise', height: 0.12 * size, seed: 7 }),
  stairs: (size) => ({ kind: 'stairs', rise: 0.03 * size, run: 0.45 * size }),
  slope: () => ({ kind: 'slope', degrees: 12 }),
};
const MOVES = {
  KeyW: ['forward', 1], KeyS: ['forward', -0.5], KeyA: ['turn', 1], KeyD: ['turn', -1], KeyQ: ['sideways', 0.5], KeyE: ['sideways', -0.5],
};
const TURNS = { ArrowLeft: [-0.06, 0], ArrowRight: [0.06, 0], ArrowUp: [0, 0.05], ArrowDown: [0, -0.05] };

class Viewer {
  constructor(sbfmt, bytes, canvas) {
    this.sbfmt = sbfmt;
    this.canvas = canvas;
    this.asset = sbfmt.asset(bytes);
    this.painter = new Painter(canvas);
    this.ballMesh = this.meshOf(ball());
    this.show = { skin: true, springs: false, lattice: false, bones: false, strain: false };
    this.camera = { yaw: 0.72, pitch: 0.26, distance: 1, focus: [0, 0, 0], halfHeight: 0.3 };
    this.choices = { ground: 'uneven', level: 0, renderLevel: 0, speed: 0.5 };
    this.keys = new Set();
    this.costs = { step: 0, skin: 0, frames: 0, since: 0, wanted: 0, covered: 0 };
    this.paused = false;
    this.size = 1;
    this.restart();
    this.frameCamera();
    this.restart(); // now that the size is known
    this.wearTextures();
  }

  /** Makes world and character anew, at the chosen level on the chosen ground. */
  restart(ground = LANDS[this.choices.ground](this.size), at) {
    this.release();
    this.world?.free();
    this.model?.free();
    this.balls = [];
    this.skins?.forEach((one) => this.painter.freeMesh(one.mesh));
    this.model = this.asset.model({ level: this.choices.level });
    this.ground = ground;
    this.world = this.sbfmt.world({ ground });
    this.character = this.world.add(this.model, at);
    this.skins = this.asset.meshes.map((_, i) => this.dress(i));
    this.groundMesh = undefined;
    this.rigidOf = new Map(this.asset.rigidBodies.map((body) => [body.bone, body.index]));
    this.mass = this.asset.rigidBodies.reduce((sum, body) => sum + this.character.rigidState(body.index).mass, 0);
    this.time = 0;
  }

  meshOf({ positions, normals, indices }) {
    const mesh = this.painter.mesh(indices);
    this.painter.fill(mesh, positions, normals);
    return mesh;
  }

  dress(number) {
    const skin = this.character.skin(number, this.choices.renderLevel);
    const parts = skin.groups.map(({ start, count, material }) => {
      const look = this.asset.materials[material];
      return { start, count, material, color: look ? [...look.baseColor] : [0.37, 0.65, 0.47, 1], roughness: look?.roughness ?? 0.6,
        metallic: look?.metallic ?? 0, image: this.images?.[look?.baseColorTexture] };
    });
    return { mesh: this.painter.mesh(skin.indices, skin.uvs), parts };
  }

  async wearTextures() {
    const images = await Promise.all(this.asset.textures.map(async (texture) => {
      const bytes = texture.bytes.length ? texture.bytes : bytesIn(`[data-texture="${texture.index}"]`);
      if (!bytes.length) return undefined;
      try {
        return this.painter.image(await createImageBitmap(new Blob([bytes], { type: texture.mediaType })));
      } catch {
        return undefined; // an image that this browser does not read: the plain colour is shown
      }
    }));
    this.images = images;
    for (const { parts } of this.skins)
      for (const part of parts) part.image = images[this.asset.materials[part.material]?.baseColorTexture];
  }

  /** Stands where all of the character is seen. */
  frameCamera() {
    const low = [Infinity, Infinity, Infinity], high = [-Infinity, -Infinity, -Infinity], { origin } = this.character;
    const meet = (numbers, stride) => {
      for (let i = 0; i + 2 < numbers.length; i += stride)
        for (let k = 0; k < 3; k++) {
          low[k] = Math.min(low[k], numbers[i + k] + origin[k]);
          high[k] = Math.max(high[k], numbers[i + k] + origin[k]);
        }
    };
    this.asset.meshes.forEach((_, i) => meet(this.character.skin(i, this.choices.renderLevel).positions, 3));
    if (low[0] > high[0]) meet(this.character.lines(), 5);
    if (low[0] > high[0]) meet(this.character.bones(), 7);
    if (low[0] > high[0]) low.fill(-0.5), high.fill(0.5);
    this.size = Math.max(vector.length(vector.subtract(high, low)), 1e-3);
    this.middle = vector.scale(vector.add(low, high), 0.5);
    this.height = this.middle[1] - origin[1];
    this.camera.focus = this.middle;
    this.camera.distance = this.size * 1.6;
  }

  /** In a narrow window more of the height is seen, so that the width stays. */
  get halfHeight() {
    return this.camera.halfHeight * Math.max(1, 1.25 * this.canvas.clientHeight / (this.canvas.clientWidth || 1));
  }

  get eye() {
    const { yaw, pitch, distance, focus } = this.camera;
    return vector.add(focus, vector.scale([Math.sin(yaw) * Math.cos(pitch), Math.sin(pitch), Math.cos(yaw) * Math.cos(pitch)], distance));
  }

  /** Where the character's middle is. */
  get subject() {
    const { origin } = this.character;
    if (!this.asset.bones.length) return vector.add(origin, [this.middle[0], this.height, this.middle[2]]);
    const bones = this.character.bones(), fleshed = new Set(this.asset.softBodies.map((body) => body.bone).filter((bone) => bone >= 0));
    const chosen = fleshed.size ? [...fleshed] : this.asset.bones.map((bone) => bone.index);
    const sum = chosen.reduce((so_far, bone) => vector.add(so_far, bones.subarray(7 * bone, 7 * bone + 3)), [0, 0, 0]);
    return vector.add(origin, vector.scale(sum, 1 / chosen.length));
  }

  /** The direction from the eye through a place of the canvas, in pixels of the page. */
  wayThrough(x, y) {
    const box = this.canvas.getBoundingClientRect(), { halfHeight } = this, { focus } = this.camera;
    const back = vector.unit(vector.subtract(this.eye, focus)), right = vector.unit(vector.cross([0, 1, 0], back)), up = vector.cross(back, right);
    const across = (2 * (x - box.left) / box.width - 1) * halfHeight * box.width / box.height, above = (1 - 2 * (y - box.top) / box.height) * halfHeight;
    return vector.unit(vector.add(vector.add(vector.scale(right, across), vector.scale(up, above)), vector.scale(back, -1)));
  }

  // ---- What the character is asked and made to do ----

  steer() {
    const wish = { forward: 0, turn: 0, sideways: 0 };
    for (const key of this.keys) wish[MOVES[key][0]] += MOVES[key][1];
    const speed = this.choices.speed * this.size;
    this.character.drive(wish.forward * speed, wish.turn * 0.9, wish.sideways * speed);
  }

  /** Takes hold of what lies under the pointer; false where that is nothing. */
  grab(x, y) {
    const way = this.wayThrough(x, y), hit = this.world.ray(this.eye, way, this.camera.distance * 4);
    if (!hit || !hit.character) return false;
    const rigid = hit.rigidBody >= 0 ? hit.rigidBody : this.rigidOf.get(this.asset.softBodies[hit.softBody]?.bone);
    this.held = { rigid, target: hit.position, depth: vector.dot(vector.subtract(hit.position, this.eye), this.forward) };
    if (rigid === undefined || !this.mass) { // nothing that could be pulled: a finger presses
      this.held.finger = this.world.collider({ shape: 'sphere', radius: 0.04 * this.size, position: hit.position });
      return true;
    }
    this.character.fall();
    const state = this.character.rigidState(rigid), center = vector.add(this.character.origin, state.position);
    const back = [-state.rotation[0], -state.rotation[1], -state.rotation[2], state.rotation[3]];
    this.held.local = vector.turn(back, vector.subtract(hit.position, center));
    return true;
  }
  get forward() {
    return vector.unit(vector.subtract(this.camera.focus, this.eye));
  }
  dragTo(x, y) {
    const way = this.wayThrough(x, y);
    this.held.target = vector.add(this.eye, vector.scale(way, this.held.depth / vector.dot(way, this.forward)));
    this.held.target[1] = Math.max(this.held.target[1], this.groundHeight(this.held.target) + 0.02 * this.size);
  }
  release() {
    this.held?.finger?.free();
    this.held = undefined;
  }

  /** Draws what is held towards the pointer, strongly enough to lift all of it. */
  pull(seconds) {
    const { held } = this;
    if (!held) return;
    if (held.finger) return held.finger.move(held.target);
    if (this.character.posture !== 'falling') this.character.fall();
    const state = this.character.rigidState(held.rigid);
    const place = vector.add(vector.add(this.character.origin, state.position), vector.turn(state.rotation, held.local));
    // Towards the pointer at a speed, by impulses that this body alone can take, and most of the weight of all that hangs on it.
    let wanted = vector.scale(vector.subtract(held.target, place), 9);
    wanted = vector.scale(wanted, Math.min(1, 3 * Math.sqrt(GRAVITY * this.size) / (vector.length(wanted) || 1)));
    const impulse = vector.scale(vector.subtract(wanted, state.velocity), 1.5 * state.mass);
    const lift = wanted[1] > 0 ? 0.9 * this.mass * GRAVITY * seconds : 0;
    this.character.push(held.rigid, place, vector.add(impulse, [0, lift, 0]));
  }

  groundHeight(place) {
    return this.sbfmt.groundAt(this.ground, [place[0], place[2]]).heights[0];
  }

  /** Throws a ball from beside the eye to the character's middle. */
  throwBall() {
    const radius = 0.07 * this.size, speed = 1.8 * Math.sqrt(GRAVITY * this.size), to = this.subject;
    const from = vector.add(this.eye, vector.scale(this.forward, this.camera.distance * 0.25)), way = vector.subtract(to, from);
    const seconds = vector.length(way) / speed, velocity = vector.scale(way, 1 / seconds);
    velocity[1] += GRAVITY * seconds / 2;
    if (this.balls.length === BALLS) this.balls.shift().collider.free();
    this.balls.push({ collider: this.world.collider({ shape: 'sphere', radius, position: from }), place: from, velocity, radius, hits: 0 });
  }

  /** Flies the balls; one that meets the character knocks it and comes back. */
  flyBalls(seconds) {
    for (const one of this.balls) {
      one.velocity[1] -= GRAVITY * seconds;
      const step = vector.scale(one.velocity, seconds), length = vector.length(step);
      const hit = length > 1e-6 && this.world.ray(one.place, step, length + one.radius);
      if (hit && hit.character && vector.dot(hit.normal, one.velocity) < 0) this.knock(one, hit);
      one.place = vector.add(one.place, vector.scale(one.velocity, seconds));
      const least = this.groundHeight(one.place) + one.radius;
      if (one.place[1] < least) {
        one.place[1] = least;
        one.velocity = [one.velocity[0] * 0.97, Math.abs(one.velocity[1]) * 0.55, one.velocity[2] * 0.97];
      }
      one.collider.move(one.place);
    }
  }

  knock(one, hit) {
    const into = vector.dot(one.velocity, hit.normal), change = vector.scale(hit.normal, -1.4 * into);
    one.velocity = vector.add(one.velocity, change);
    one.hits++;
    const rigid = hit.rigidBody >= 0 ? hit.rigidBody : this.rigidOf.get(this.asset.softBodies[hit.softBody]?.bone);
    if (rigid === undefined || !this.mass) return;
    this.character.fall();
    this.character.push(rigid, hit.position, vector.scale(change, -0.03 * this.mass));
  }

  // ---- Time ----

  step(seconds) {
    this.steer();
    this.pull(seconds);
    this.flyBalls(seconds);
    const before = performance.now();
    this.world.step(seconds);
    this.costs.step += performance.now() - before;
    this.time += seconds;
  }

  /** Steps so many seconds, tick by tick, or as many of them as there is time for; returns how many. */
  advance(seconds) {
    const most = Math.max(PHYSICS_MS, 1000 * PHYSICS_SHARE * seconds), began = performance.now();
    let left = seconds, spent = 0, last = 0;
    do {
      const part = Math.min(left, FRAME);
      this.step(part);
      left -= part;
      last = performance.now() - began - spent;
      spent += last;
    } while (left > 1e-9 && spent + last < most);
    return seconds - left;
  }

  frame(now) {
    requestAnimationFrame((next) => this.frame(next));
    const seconds = Math.min((now - (this.last ?? now)) / 1000, LONGEST_FRAME);
    this.last = now;
    if (!this.paused && seconds > 0) {
      this.costs.wanted += seconds;
      this.costs.covered += this.advance(seconds);
    }
    const follow = this.held ? 0 : 1 - Math.exp(-4 * seconds);
    this.camera.focus = vector.add(this.camera.focus, vector.scale(vector.subtract(this.subject, this.camera.focus), follow));
    this.draw();
    this.costs.frames++;
    if (now - this.costs.since > 500) this.tell(now);
  }

  tell(now) {
    const { step, skin, frames, since, wanted, covered } = this.costs, pace = wanted ? covered / wanted : 1, health = this.character.health(), figures = {
      step: `${Math.round(1000 * step / frames)} µs`,
      skinCost: `${Math.round(1000 * skin / frames)} µs`,
      pace: pace > 0.98 ? 'as the clock' : `slowed to ${Math.round(100 * pace)} %`,
      rate: `${Math.round(1000 * frames / (now - since))} /s`,
      volume: `${(100 * Math.abs(1 - health.volumeRatio)).toFixed(2)} %`,
      strainMost: `${(100 * health.maxStrain).toFixed(0)} %`,
      stated: this.asset.levelError(this.choices.level) ? `${(1000 * this.asset.levelError(this.choices.level)).toFixed(2)} mm` : 'not measured',
      walked: `${this.character.distance.toFixed(2)} m`,
    };
    for (const [id, text] of Object.entries(figures)) element(id).textContent = text;
    this.costs = { step: 0, skin: 0, frames: 0, since: now, wanted: 0, covered: 0 };
  }

  /** The state after so many frames of a sixtieth of a second on a ground, from a new start: what `sbfmt run` gives. */
  hashAfter(frames, forward = 0, turn = 0, ground = { kind: 'flat' }) {
    this.restart(ground);
    this.character.drive(forward, turn);
    for (let i = 0; i < frames; i++) this.world.step(FRAME);
    return this.world.stateHash();
  }

  // ---- Drawing ----

  draw() {
    const { canvas, painter, show } = this, ratio = Math.min(devicePixelRatio || 1, 2);
    const width = Math.max(1, Math.round(canvas.clientWidth * ratio)), height = Math.max(1, Math.round(canvas.clientHeight * ratio));
    if (canvas.width !== width || canvas.height !== height) Object.assign(canvas, { width, height });
    const before = performance.now(), { origin } = this.character, inside = show.springs || show.lattice || show.bones || show.strain;
    this.skins.forEach(({ mesh }, i) => {
      const skin = this.character.skin(i, this.choices.renderLevel);
      painter.fill(mesh, skin.positions, skin.normals);
    });
    this.costs.skin += performance.now() - before;
    this.layGround();
    const shown = (show.springs || show.strain ? SPRINGS : 0) | (show.lattice || show.strain ? LATTICE : 0);
    const lines = shown ? this.character.lines() : new Float32Array(0);
    let bones;
    if (show.bones) bones = this.meshOf(boneShapes(this.character.bones(), this.asset.bones.map((bone) => bone.length)));
    painter.picture({ eye: this.eye, focus: this.camera.focus, size: this.size, halfHeight: this.halfHeight }, (shadows) => {
      if (!shadows) painter.drawMesh(this.groundMesh, [{ color: [0.56, 0.53, 0.47, 1], roughness: 0.95 }], [0, 0, 0], { ground: true });
      for (const one of this.balls) this.drawBall(one);
      painter.drawLines(lines, origin, shown, show.strain);
      for (const { mesh, parts } of show.skin || shadows ? this.skins : [])
        painter.drawMesh(mesh, inside ? parts.map((part) => ({ ...part, color: [...part.color.slice(0, 3), 0.28] })) : parts, origin);
      if (bones && !shadows) painter.drawOver(() => painter.drawMesh(bones, [{ color: [0.85, 0.79, 0.62, 1], roughness: 0.5 }], origin));
    });
    if (bones) painter.freeMesh(bones);
  }

  drawBall(one) {
    if (one.drawn === undefined) {
      const shape = ball();
      one.drawn = this.meshOf({ ...shape, positions: shape.positions.map((x) => x * one.radius) });
    }
    this.painter.drawMesh(one.drawn, [{ color: [0.80, 0.16, 0.10, 1], roughness: 0.35 }], one.place);
  }

  /** The ground about what is looked at, made anew when that has gone on. */
  layGround() {
    const half = this.size * 9, cells = 120, [x, , z] = this.camera.focus, made = this.groundMesh;
    if (made && Math.hypot(made.x - x, made.z - z) < half * 0.12) return;
    if (made) this.painter.freeMesh(made);
    const places = new Float32Array(2 * (cells + 1) ** 2), positions = new Float32Array(3 * (cells + 1) ** 2), indices = [];
    const along = (i) => { const t = 2 * i / cells - 1; return half * (0.35 * t + 0.65 * t ** 3); };
    for (let row = 0, at = 0; row <= cells; row++)
      for (let column = 0; column <= cells; column++, at++) {
        places.set([x + along(column), z + along(row)], 2 * at);
        if (row < cells && column < cells) indices.push(at, at + cells + 1, at + 1, at + 1, at + cells + 1, at + cells + 2);
      }
    const { heights, normals } = this.sbfmt.groundAt(this.ground, places);
    heights.forEach((height, i) => positions.set([places[2 * i], height, places[2 * i + 1]], 3 * i));
    this.groundMesh = Object.assign(this.meshOf({ positions, normals, indices: new Uint32Array(indices) }), { x, z });
  }

  // ---- What the visitor does ----

  orbit(yaw, pitch) {
    this.camera.yaw -= yaw;
    this.camera.pitch = Math.min(Math.max(this.camera.pitch + pitch, 0.02), 1.5);
  }
  zoom(factor) {
    this.camera.distance = Math.min(Math.max(this.camera.distance * factor, this.size * 0.4), this.size * 8);
  }
  choose(name, value) {
    this.choices[name] = value;
    if (name !== 'speed') this.restart();
  }

  listen() {
    const { canvas } = this, fingers = new Map();
    canvas.addEventListener('pointerdown', (event) => {
      canvas.focus();
      canvas.setPointerCapture(event.pointerId);
      fingers.set(event.pointerId, [event.clientX, event.clientY]);
      if (fingers.size === 1 && event.button === 0 && this.grab(event.clientX, event.clientY)) canvas.classList.add('holds');
    });
    canvas.addEventListener('pointermove', (event) => {
      const before = fingers.get(event.pointerId);
      if (!before) return;
      const spread = () => { const [a, b] = [...fingers.values()]; return Math.hypot(a[0] - b[0], a[1] - b[1]) || 1; };
      const wide = fingers.size === 2 ? spread() : 0;
      fingers.set(event.pointerId, [event.clientX, event.clientY]);
      if (fingers.size === 2) this.zoom(wide / spread());
      else if (this.held) this.dragTo(event.clientX, event.clientY);
      else this.orbit((event.clientX - before[0]) * 0.007, (event.clientY - before[1]) * 0.006);
    });
    for (const kind of ['pointerup', 'pointercancel'])
      canvas.addEventListener(kind, (event) => {
        fingers.delete(event.pointerId);
        this.release();
        canvas.classList.remove('holds');
      });
    canvas.addEventListener('wheel', (event) => {
      event.preventDefault();
      this.zoom(Math.exp(event.deltaY * 0.001));
    }, { passive: false });
    addEventListener('keydown', (event) => this.press(event));
    addEventListener('keyup', (event) => this.keys.delete(event.code));
    addEventListener('blur', () => this.keys.clear());
    for (const name of Object.keys(this.show))
      element(name).addEventListener('change', (event) => { this.show[name] = event.target.checked; });
    for (const name of ['ground', 'level', 'renderLevel', 'speed'])
      element(name).addEventListener('change', (event) => this.choose(name, name === 'ground' ? event.target.value : Number(event.target.value)));
    for (const [id, act] of Object.entries({ throw: () => this.throwBall(), knock: () => this.character.fall(), restart: () => this.restart(),
      pause: () => this.pause() })) element(id).addEventListener('click', act);
    this.offer('level', this.asset.levels || 1, 'finest');
    this.offer('renderLevel', this.asset.renderLevels, 'full');
    element('knock').disabled = !this.mass;
  }

  pause() {
    this.paused = !this.paused;
    element('pause').setAttribute('aria-pressed', String(this.paused));
  }

  press(event) {
    if (event.ctrlKey || event.altKey || event.metaKey || /^(INPUT|SELECT)$/.test(event.target.tagName) && event.target.type !== 'checkbox') return;
    if (MOVES[event.code]) this.keys.add(event.code);
    else if (event.code === 'KeyB' && !event.repeat) this.throwBall();
    else if (event.code === 'KeyR' && !event.repeat) this.restart();
    else if (event.code === 'KeyP' && !event.repeat) this.pause();
    else if (event.key === '+' || event.key === '-') this.zoom(event.key === '+' ? 0.9 : 1.1);
    else if (TURNS[event.code] && event.target === this.canvas) this.orbit(...TURNS[event.code]);
    else return;
    event.preventDefault();
  }

  /** Levels to choose from. */
  offer(id, count, first) {
    element(id).replaceChildren(...Array.from({ length: count }, (_, i) => new Option(i ? String(i) : `0, ${first}`, String(i))));
    element(id).disabled = count < 2;
  }
}

/** Starts the page; what goes wrong is said in it. */
export async function view(wasm, bundle) {
  try {
    const viewer = new Viewer(await load(wasm), bundle, element('canvas'));
    viewer.listen();
    globalThis.viewer = viewer;
    requestAnimationFrame((now) => viewer.frame(now));
  } catch (error) {
    element('trouble').textContent = error.message;
    element('trouble').hidden = false;
    throw error;
  }
}
