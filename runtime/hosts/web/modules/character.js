/* A character in a world: drives, poses, grabs, and its meshes. */
import { chosen, number, placeIn, triple } from './checked.js';
import { SbfmtError } from './sbfmt_error.js';

const POSTURES = ['up', 'falling', 'rising'];
const MODES = { kinematic: 0, passive: 1, driven: 2 };
const SHOWN = ['byViews', 'always', 'never'];
const DETAIL_AUTOMATIC = 0xffffffff, WHOLE_BODY = 0xffffffff;

/** A character of a world: commands and state. */
export class Character {
  constructor(world, model, options) {
    const c = world.calls;
    Object.assign(this, { world, model, sbfmt: world.sbfmt, calls: c, meshes: new Map() });
    this.id = c.web_character_create(world.handle, model.handle, ...triple(options.position, 'position', [0, 0, 0]),
      number(options.heading, 'heading', 0), number(options.scale, 'scale', 1), options.holdPose ? 1 : 0);
    if (!this.id) throw this.sbfmt.failure();
    world.use(this);
    model.use(this);
    this.boneRoom = this.sbfmt.room(28 * model.asset.bones.length + 4);
  }

  /** Handle of its world, while that exists. */
  get home() {
    if (!this.id) throw new TypeError('this character was freed');
    return this.world.handle;
  }

  drive(forward, turn = 0, sideways = 0, up = 0) {
    const vertical = number(up, 'up');
    this.calls.web_character_drive(this.home, this.id, number(forward, 'forward'), number(sideways, 'sideways'),
      number(turn, 'turn'));
    this.calls.web_character_set_vertical_speed(this.home, this.id, vertical);
  }
  displace(by, turn = 0) {
    this.calls.web_character_displace(this.home, this.id, ...triple(by, 'by'), number(turn, 'turn'));
  }
  teleport(position, heading = 0) {
    this.calls.web_character_teleport(this.home, this.id, ...triple(position, 'position'), number(heading, 'heading'));
  }
  reset() {
    this.calls.web_character_reset(this.home, this.id);
  }
  wake() {
    this.calls.web_character_wake(this.home, this.id);
  }
  pause(paused = true) {
    this.calls.web_character_pause(this.home, this.id, paused ? 1 : 0);
  }
  play(clip, { layer = 0, weight = 1, fade = 0.3, speed = 1, start = 0 } = {}) {
    const place = typeof clip === 'string' ? this.model.asset.clips.findIndex((one) => one.name === clip) : clip ?? -1;
    if (typeof clip === 'string' && place < 0) throw new TypeError(`the asset has no clip '${clip}'`);
    if (place !== -1) placeIn(place, this.model.asset.clips.length, 'clip');
    this.calls.web_character_play(this.home, this.id, layer, place, weight, fade, speed, start);
  }
  reach(ikChain, position, weight = 1) {
    placeIn(ikChain, this.model.asset.ikChains.length, 'ikChain');
    const [x, y, z] = position ? triple(position, 'position') : [0, 0, 0];
    this.calls.web_character_reach(this.home, this.id, ikChain, x, y, z, position ? weight : -1);
  }
  /** Index of one of its rigid bodies. */
  ofRigid(rigidBody) {
    return placeIn(rigidBody, this.model.asset.rigidBodies.length, 'rigidBody');
  }
  rigidMode(mode, rigidBody = -1) {
    if (!(mode in MODES)) throw new TypeError(`a mode is one of ${Object.keys(MODES).join(', ')}, not ${mode}`);
    this.calls.web_character_rigid_mode(this.home, this.id, rigidBody === -1 ? -1 : this.ofRigid(rigidBody), MODES[mode]);
  }
  fall() {
    this.calls.web_character_fall(this.home, this.id);
  }
  get posture() {
    return POSTURES[this.calls.web_character_posture(this.home, this.id)];
  }
  push(rigidBody, place, impulse) {
    this.calls.web_character_push(this.home, this.id, this.ofRigid(rigidBody), ...triple(place, 'place'), ...triple(impulse, 'impulse'));
  }

  rigidState(rigidBody) {
    const { scratch } = this.sbfmt;
    this.calls.web_character_rigid(this.home, this.id, this.ofRigid(rigidBody), scratch);
    const n = Array.from(this.sbfmt.floats(scratch, 18));
    return { mode: Object.keys(MODES)[n[0]], position: n.slice(1, 4), rotation: n.slice(4, 8), center: n.slice(8, 11),
      velocity: n.slice(11, 14), angularVelocity: n.slice(14, 17), mass: n[17] };
  }

  /** Index of one of its soft bodies. */
  ofSoft(softBody) {
    return placeIn(softBody, this.model.asset.softBodies.length, 'softBody');
  }
  nearestVertex(softBody, position) {
    const found = this.calls.web_character_nearest_vertex(this.home, this.id, this.ofSoft(softBody), ...triple(position, 'position')) >>> 0;
    return found === WHOLE_BODY ? -1 : found;
  }
  grab(softBody, vertex, target, { frequency = 0, maxForce = 0 } = {}) {
    this.done(this.calls.web_character_grab(this.home, this.id, this.ofSoft(softBody), number(vertex, 'vertex'), ...triple(target, 'target'),
      number(frequency, 'frequency'), number(maxForce, 'maxForce')));
  }
  release(softBody, vertex) {
    return this.calls.web_character_release(this.home, this.id, this.ofSoft(softBody), number(vertex, 'vertex')) !== 0;
  }
  applySoftImpulse(softBody, impulse, vertex = -1) {
    this.done(this.calls.web_character_soft_impulse(this.home, this.id, this.ofSoft(softBody), vertex === -1 ? WHOLE_BODY : number(vertex, 'vertex'),
      ...triple(impulse, 'impulse')));
  }
  applySoftForce(softBody, force, seconds, vertex = -1) {
    this.done(this.calls.web_character_soft_force(this.home, this.id, this.ofSoft(softBody), vertex === -1 ? WHOLE_BODY : number(vertex, 'vertex'),
      ...triple(force, 'force'), number(seconds, 'seconds')));
  }
  grabForce(softBody, vertex) {
    const { scratch } = this.sbfmt;
    this.calls.web_character_get_grab_force(this.home, this.id, this.ofSoft(softBody), number(vertex, 'vertex'), scratch);
    return Array.from(this.sbfmt.floats(scratch, 3));
  }
  /** Results of a call that fills a list with `numbers` numbers per item: an array of floats per item, and the same bits as integers. */
  listed(call, softBody, numbers) {
    const all = (at, capacity) => this.calls[call](this.home, this.id, this.ofSoft(softBody), at, capacity);
    const count = all(0, 0), bytes = 4 * numbers * count, at = count && this.sbfmt.room(bytes), found = [];
    if (count) all(at, count);
    for (let i = 0; i < count; i++) {
      const floats = this.sbfmt.floats(at + 4 * numbers * i, numbers).slice();
      found.push({ floats, ints: new Int32Array(floats.buffer) });
    }
    if (count) this.calls.web_free(at);
    return found;
  }
  pinReactions(softBody) {
    return this.listed('web_character_pin_reactions', softBody, 13).map(({ floats, ints }) => {
      const three = (from) => Array.from(floats.slice(from, from + 3));
      return { pinSet: ints[0], bone: ints[1], rigidBody: ints[2], points: ints[3], about: three(4), force: three(7), torque: three(10) };
    });
  }
  tetrahedra(softBody) {
    return this.listed('web_character_tetrahedra', softBody, 14).map(({ floats, ints }) => ({ stress: Array.from(floats.slice(0, 6)),
      energyDensity: floats[6], restVolume: floats[7], volumeRatio: floats[8], corners: Array.from(ints.slice(9, 13)), torn: (ints[13] & 1) !== 0 }));
  }
  setSoftVelocity(softBody, velocity, angularVelocity = [0, 0, 0]) {
    this.done(this.calls.web_character_soft_velocity(this.home, this.id, this.ofSoft(softBody), ...triple(velocity, 'velocity'),
      ...triple(angularVelocity, 'angularVelocity')));
  }
  softMotion(softBody) {
    const { scratch } = this.sbfmt;
    this.calls.web_character_soft_motion(this.home, this.id, this.ofSoft(softBody), scratch);
    const n = Array.from(this.sbfmt.floats(scratch, 10));
    return { mass: n[0], center: n.slice(1, 4), velocity: n.slice(4, 7), angularVelocity: n.slice(7, 10) };
  }
  /** Throws the error of a refused call. */
  done(good) {
    if (!good) throw this.sbfmt.failure();
  }

  get detailLevel() {
    return this.calls.web_character_detail_level(this.home, this.id);
  }
  setDetailLevel(detailLevel) {
    this.calls.web_character_set_detail_level(this.home, this.id, detailLevel === null ? DETAIL_AUTOMATIC : placeIn(detailLevel, this.model.detailLevels.length, 'detailLevel'));
  }
  get fade() {
    return this.calls.web_character_fade(this.home, this.id);
  }
  shown(how) {
    this.calls.web_character_shown(this.home, this.id, chosen(SHOWN, how, 'how it is shown'));
  }
  get errorPx() {
    return this.calls.web_character_error_px(this.home, this.id);
  }

  get origin() {
    this.calls.web_character_origin(this.home, this.id, this.sbfmt.scratch);
    return Array.from(this.sbfmt.doubles(this.sbfmt.scratch, 3));
  }
  get distance() {
    return this.calls.web_character_distance(this.home, this.id);
  }
  bones() {
    const count = this.model.asset.bones.length;
    this.calls.web_character_bones(this.home, this.id, this.boneRoom, count);
    return this.sbfmt.floats(this.boneRoom, count * 7);
  }
  health() {
    this.calls.web_character_health(this.home, this.id, this.model.asset.softBodies.length, this.sbfmt.scratch);
    const n = this.sbfmt.doubles(this.sbfmt.scratch, 7);
    return { volumeRatio: n[0], maxStrain: n[1], energy: n[2], recoveries: n[3], torn: n[4], valid: n[5] !== 0, asleep: n[6] !== 0 };
  }
  legs() {
    const { scratch } = this.sbfmt, count = this.calls.web_character_legs(this.home, this.id, scratch, 64);
    const n = this.sbfmt.floats(scratch, count * 10);
    return Array.from({ length: count }, (_, i) => {
      const leg = Array.from(n.slice(i * 10, i * 10 + 10));
      return { planted: leg[0] !== 0, steps: leg[1], phase: leg[2], foot: leg.slice(3, 6), target: leg.slice(6, 9) };
    });
  }

  /** Vertices in the layout of graphics cards: allocated once, filled by each call. */
  skin(mesh = 0, level = 0) {
    const key = `${mesh}:${level}`, c = this.calls, { home } = this;
    let at = this.meshes.get(key);
    if (!at) {
      placeIn(mesh, this.model.asset.meshes.length, 'mesh');
      at = c.web_mesh_create(this.model.asset.handle, this.model.handle, mesh, number(level, 'level'));
      if (!at) throw new SbfmtError('memory ran out', 'OUT_OF_MEMORY', '');
      this.meshes.set(key, at);
    }
    c.web_mesh_update(at, home, this.id);
    c.web_mesh_layout(at, this.sbfmt.scratch);
    const [vertices, indices, groups, indicesAt, groupsAt, uvsAt, positionsAt, normalsAt] = this.sbfmt.words(this.sbfmt.scratch, 8);
    const parts = this.sbfmt.words(groupsAt, groups * 3);
    return {
      positions: this.sbfmt.floats(positionsAt, vertices * 3),
      normals: this.sbfmt.floats(normalsAt, vertices * 3),
      uvs: uvsAt ? this.sbfmt.floats(uvsAt, vertices * 2) : null,
      indices: this.sbfmt.words(indicesAt, indices),
      groups: Array.from({ length: groups }, (_, i) => ({ start: parts[3 * i], count: parts[3 * i + 1], material: parts[3 * i + 2] - 1 })),
    };
  }

  /** Springs and edges of lattices: ten numbers a line, see sbfmt.d.ts. */
  lines() {
    const c = this.calls;
    this.lineRoom ??= c.web_lines_create(this.model.asset.handle, this.home, this.id, this.model.level);
    if (!this.lineRoom) throw new SbfmtError('memory ran out', 'OUT_OF_MEMORY', '');
    const at = c.web_lines_update(this.lineRoom, this.home, this.id);
    return this.sbfmt.floats(at, c.web_lines_count(this.lineRoom) * 10);
  }

  free() {
    if (!this.id) return;
    for (const mesh of this.meshes.values()) this.calls.web_mesh_free(mesh);
    this.meshes.clear();
    if (this.lineRoom) this.calls.web_lines_free(this.lineRoom);
    this.lineRoom = undefined;
    this.calls.web_free(this.boneRoom);
    this.calls.web_character_free(this.home, this.id);
    this.world.leave(this);
    this.model.leave(this);
    this.id = 0;
  }
}
