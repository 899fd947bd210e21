/* Shows a character in time: its clock, its picture, and what pointer and keys do in the picture. */
import { ball, boneShapes, vector } from './viewer_draw.js';
import { Hands, MOVES } from './viewer_hands.js';

const SPRINGS = 0b011111, LATTICE = 0b100000;
export const FRAME = 1 / 60;
/** Maximum time of physics in a frame, in ms or as a fraction of the previous frame; time beyond it is dropped: slow motion. */
const PHYSICS_MS = 10, PHYSICS_SHARE = 0.35, LONGEST_FRAME = 0.25;
const TURNS = { ArrowLeft: [-0.06, 0], ArrowRight: [0.06, 0], ArrowUp: [0, 0.05], ArrowDown: [0, -0.05] };

/** Plus without Shift is = on many keyboards. */
const ZOOMS = ['+', '=', '-'];

/** What has it `tell(now)` the figures twice a second. */
export class Show extends Hands {
  constructor(sbfmt, bytes, canvas) {
    super(sbfmt, bytes, canvas);
    this.costs = { step: 0, skin: 0, frames: 0, since: 0, wanted: 0, covered: 0 };
    this.paused = false;
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
    const cast = this.cast.map(({ character, skins }) => {
      skins.forEach(({ mesh }, i) => {
        const skin = character.skin(i, this.choices.renderLevel);
        painter.fill(mesh, skin.positions, skin.normals);
      });
      return { skins, at: character.origin };
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
      for (const { skins, at } of show.skin || shadows ? cast : [])
        for (const { mesh, parts } of skins)
          painter.drawMesh(mesh, inside ? parts.map((part) => ({ ...part, color: [...part.color.slice(0, 3), 0.28] })) : parts, at);
      if (bones && !shadows) painter.drawOver(() => painter.drawMesh(bones, [{ color: [0.85, 0.79, 0.62, 1], roughness: 0.5 }], origin));
      if (!shadows) this.drawMore();
    });
    if (bones) painter.freeMesh(bones);
  }

  /** What others draw in front of all. */
  drawMore() {}

  drawBall(one) {
    if (this.ballMesh?.radius !== one.radius) {
      const shape = ball();
      this.ballMesh = Object.assign(this.meshOf({ ...shape, positions: shape.positions.map((x) => x * one.radius) }), { radius: one.radius });
    }
    this.painter.drawMesh(this.ballMesh, [{ color: [0.80, 0.16, 0.10, 1], roughness: 0.35 }], one.place);
  }

  /** The ground around the camera's subject, made again after the subject has moved on. */
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

  /** Listens to pointers in the picture, to keys, and to the buttons of `pad`. */
  listenToPicture(pad) {
    const { canvas } = this, fingers = new Map();
    canvas.addEventListener('pointerdown', (event) => {
      canvas.focus();
      canvas.setPointerCapture(event.pointerId);
      fingers.set(event.pointerId, [event.clientX, event.clientY]);
      if (fingers.size > 1) this.release();
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
    canvas.addEventListener('contextmenu', (event) => event.preventDefault()); // the right button looks around
    canvas.addEventListener('wheel', (event) => {
      event.preventDefault();
      this.zoom(Math.exp(event.deltaY * 0.001));
    }, { passive: false });
    addEventListener('keydown', (event) => this.press(event));
    addEventListener('keyup', (event) => this.keys.delete(event.code));
    addEventListener('blur', () => this.keys.clear());
    for (const button of pad) this.listenToPad(button);
  }

  /** A button that walks while it is pressed, by touch or by keyboard. */
  listenToPad(button) {
    const { code } = button.dataset, press = () => this.keys.add(code), lift = () => this.keys.delete(code);
    button.addEventListener('pointerdown', (event) => {
      button.setPointerCapture(event.pointerId);
      press();
    });
    for (const kind of ['pointerup', 'pointercancel', 'lostpointercapture', 'blur', 'keyup']) button.addEventListener(kind, lift);
    button.addEventListener('keydown', (event) => {
      if (event.code === 'Space' || event.code === 'Enter') press();
    });
    button.addEventListener('contextmenu', (event) => event.preventDefault()); // of a long touch
  }

  pause() {
    this.paused = !this.paused;
  }

  press(event) {
    if (event.ctrlKey || event.altKey || event.metaKey || /^(INPUT|SELECT)$/.test(event.target.tagName) && event.target.type !== 'checkbox') return;
    if (MOVES[event.code]) this.keys.add(event.code);
    else if (event.code === 'KeyB' && !event.repeat) this.throwBall();
    else if (event.code === 'KeyR' && !event.repeat) this.restart();
    else if (event.code === 'KeyP' && !event.repeat) this.pause();
    else if (ZOOMS.includes(event.key)) this.zoom(event.key === '-' ? 1.1 : 0.9);
    else if (TURNS[event.code] && event.target === this.canvas) this.orbit(...TURNS[event.code]);
    else return;
    event.preventDefault();
  }
}
