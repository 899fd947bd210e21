/* The characters of the studio: they walk by themselves, several together, in slow motion or step by step. */
import { Gamepad } from './studio_gamepad.js';
import { FRAME, Show } from './viewer_show.js';
import { boneShapes, vector } from './viewer_draw.js';

/** Keys that swimmers and flyers rise and sink by. */
const HEIGHTS = { PageUp: 1, PageDown: -1 };
const MARK_COLOR = [1, 0.12, 0, 1], MARK_WIDTH = 0.2;
/** Neighbours stand so many sizes apart. */
const SPACING = 1.3;
/** What swims or flies starts so many sizes above the ground. */
const ALTITUDE = 0.35;
/** Of a gamepad's sticks: rad/s of the character, and radians of the view in a tick. */
const PAD_TURN = 1.5, PAD_VIEW = 0.04;

export class StudioStage extends Show {
  constructor(sbfmt, bytes, canvas, changed) {
    super(sbfmt, bytes, canvas);
    Object.assign(this, { changed, rate: 1, marked: [], heights: new Set(), gamepad: new Gamepad() });
  }

  put(asset) {
    this.marked = [];
    this.choices.count ??= 1;
    this.choices.drive ??= { speed: 0, turn: 0, top: 1 };
    super.put(asset);
    this.camera.focus = this.subject;
  }

  /** Shows other bytes; `stay`: of the same character, so the view, the ground and the position stay. */
  display(bytes, stay) {
    const { camera, choices } = this, before = stay && { camera: { ...camera }, at: this.character.origin, level: choices.level, renderLevel: choices.renderLevel };
    this.open(bytes);
    if (!before) return;
    Object.assign(this.camera, before.camera);
    if (before.level < (this.asset.levels || 1) && before.renderLevel < this.asset.renderLevels)
      Object.assign(choices, { level: before.level, renderLevel: before.renderLevel });
    this.restart(undefined, { position: [before.at[0], 0, before.at[2]] });
  }

  /** Images that lie beside the source, by name. */
  wearTextures(beside = ({ path }) => this.imagesBeside?.get(path.slice(path.lastIndexOf('/') + 1)) ?? []) {
    return super.wearTextures(beside);
  }

  restart(ground, at) {
    const [x, , z] = at?.position ?? [0, 0, 0], y = this.choices.afloat ? ALTITUDE * this.size : 0;
    super.restart(ground, { position: [x, y, z] });
    for (let i = 1; i < this.choices.count; i++) {
      const aside = SPACING * this.size * Math.ceil(i / 2) * (i % 2 ? 1 : -1);
      const character = this.world.add(this.model, { position: [x + aside, y, z] });
      this.others.push({ character, skins: this.dress(character) });
    }
    this.changed?.();
  }

  choose(name, value) {
    super.choose(name, value);
    if (name === 'count') this.camera.distance = this.size * (1.2 + 0.4 * value); // so that all are seen
  }

  /** What is asked of every character: keys, a gamepad, or else the speed and turn of the panel. */
  steer() {
    const { speed, turn, top } = this.choices.drive, pad = this.gamepad.read(), climb = Math.max(speed, 0.2 * this.size);
    const up = [...this.heights].reduce((sum, key) => sum + HEIGHTS[key], 0) * climb;
    if (this.keys.size) super.steer();
    else if (pad) this.character.drive(pad.forward * top, pad.turn * PAD_TURN, 0, pad.up * climb);
    else this.character.drive(speed, turn, 0, up);
    if (pad) this.orbit(pad.yaw * PAD_VIEW, -pad.pitch * PAD_VIEW);
    if (pad?.knock && this.mass) this.character.fall();
    if (pad?.ball) this.throwBall();
    for (const { character } of this.others) character.drive(speed, turn, 0, up);
  }

  /** The character that a pointer takes hold of is the one that keys steer. */
  grab(x, y) {
    const hit = this.world.ray(this.eye, this.wayThrough(x, y), this.camera.distance * 4);
    const place = hit ? this.others.findIndex(({ character }) => character.id === hit.character) : -1;
    if (place >= 0) {
      const { character, skins } = this;
      ({ character: this.character, skins: this.skins } = this.others[place]);
      this.others[place] = { character, skins };
    }
    return super.grab(x, y);
  }

  advance(seconds) {
    return super.advance(seconds * this.rate) / this.rate;
  }
  stepOnce() {
    if (!this.paused) this.pause();
    this.step(FRAME);
  }
  pause() {
    super.pause();
    this.changed?.();
  }

  // ---- Marks ----

  /** Marks bones, and looks at them until another is marked or none. */
  mark(bones) {
    this.marked = bones;
  }
  get subject() {
    if (!this.marked?.length) return super.subject;
    const bones = this.character.bones(), sum = this.marked.reduce((so_far, bone) => vector.add(so_far, bones.subarray(7 * bone, 7 * bone + 3)), [0, 0, 0]);
    return vector.add(this.character.origin, vector.scale(sum, 1 / this.marked.length));
  }
  /** Drawn over everything else. */
  drawMore() {
    if (!this.marked.length) return;
    const all = this.character.bones(), poses = new Float32Array(7 * this.marked.length);
    this.marked.forEach((bone, i) => poses.set(all.subarray(7 * bone, 7 * bone + 7), 7 * i));
    const mesh = this.meshOf(boneShapes(poses, this.marked.map((bone) => this.asset.bones[bone].length || 0.1 * this.size), MARK_WIDTH));
    this.painter.drawOver(() => this.painter.drawMesh(mesh, [{ color: MARK_COLOR, roughness: 0.5 }], this.character.origin));
    this.painter.freeMesh(mesh);
  }

  listenToPicture(pad) {
    super.listenToPicture(pad);
    addEventListener('keydown', (event) => {
      if (!HEIGHTS[event.code] || event.target !== this.canvas) return;
      this.heights.add(event.code);
      event.preventDefault();
    });
    addEventListener('keyup', (event) => this.heights.delete(event.code));
  }
}
