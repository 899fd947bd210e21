/* Soft-bodied characters of the sbfmt format, in a page or under node. Types and what everything means: sbfmt.d.ts.
 *
 *   const sbfmt = await load();
 *   const asset = sbfmt.asset(bytes);
 *   const world = sbfmt.world();
 *   const lizard = world.add(asset.model());
 *   lizard.drive(0.25);
 *   world.step(1 / 60);
 *   lizard.skin(0).positions
 *
 * Views of numbers lie in the library's own memory: they are read at once or copied. */

const GROUNDS = ['flat', 'slope', 'stairs', 'noise', 'heights'];
const SHAPES = ['sphere', 'box', 'capsule'];
const KINDS = ['bones', 'meshes', 'softBodies', 'rigidBodies', 'clips', 'ikChains', 'legs', 'materials', 'textures'];
const EVENTS = ['footDown', 'footUp', 'landed', 'tear', 'unsplit', 'asleep', 'awake', 'contact', 'parted'];
const POSTURES = ['up', 'falling', 'rising'];
const MODES = { kinematic: 0, passive: 1, driven: 2 };
const RUNGS = ['soft', 'jiggle', 'bones', 'away'];
const SHOWN = ['byViews', 'always', 'never'];
const RUNG_CHOSEN = 0xffffffff;
const MOST_VIEWS = 4;
const ALPHAS = ['opaque', 'mask', 'blend'];
const EVENT_ROOM = 256;
const SCRATCH_BYTES = EVENT_ROOM * 18 * 8;

/** What the library refuses, with its code and, where the input is at fault, the place in the file. */
export class SbfmtError extends Error {
  constructor(message, code, path) {
    super(message);
    this.name = 'SbfmtError';
    this.code = code;
    this.path = path;
  }
}

function number(value, name, otherwise) {
  if (value === undefined && otherwise !== undefined) return otherwise;
  if (typeof value !== 'number' || !Number.isFinite(value)) throw new TypeError(`${name} is to be a finite number, not ${value}`);
  return value;
}

function triple(value, name, otherwise) {
  if (value === undefined && otherwise) return otherwise;
  if (!value || value.length !== 3) throw new TypeError(`${name} is to be three numbers, [x, y, z]`);
  return Array.from(value, (one) => number(one, name));
}

function chosen(list, value, name) {
  const place = list.indexOf(value);
  if (place < 0) throw new TypeError(`${name} is one of ${list.join(', ')}, not ${value}`);
  return place;
}

/** The bytes of the library: those given, or of the file beside this one. */
async function bytesOf(source) {
  const from = source ?? new URL('./sbfmt.wasm', import.meta.url);
  if (from instanceof ArrayBuffer || ArrayBuffer.isView(from)) return from;
  const url = new URL(String(from.url ?? from), typeof location === 'undefined' ? import.meta.url : location.href);
  if (url.protocol === 'file:' && typeof process !== 'undefined' && process.versions?.node)
    return (await import(/* @vite-ignore */ 'node:fs/promises')).readFile(url);
  const answer = await fetch(url);
  if (!answer.ok) throw new SbfmtError(`${url} could not be read: ${answer.status} ${answer.statusText}`, 'IO_CANNOT_READ', '');
  return answer.arrayBuffer();
}

/** Makes the library ready. `source`: sbfmt.wasm as bytes, a module, or where it is; without, beside this file. */
export async function load(source) {
  const module = source instanceof WebAssembly.Module ? source : await WebAssembly.compile(await bytesOf(source));
  // The C library could write to a console; it never does.
  const none = () => 8;
  const instance = await WebAssembly.instantiate(module, {
    wasi_snapshot_preview1: { fd_close: none, fd_seek: none, fd_write: none },
  });
  instance.exports._initialize();
  return new Sbfmt(instance.exports);
}

class Sbfmt {
  constructor(calls) {
    this.calls = calls;
    this.scratch = calls.web_allocate(SCRATCH_BYTES);
  }

  asset(bytes) {
    return new Asset(this, bytes);
  }

  world(options = {}) {
    return new World(this, options);
  }

  /** Heights and unit normals of a ground at places x, z, x, z, ... */
  groundAt(ground, places) {
    const [kind, a, b, free] = this.ground(ground);
    const count = places.length / 2, at = this.room(places.length * 4 + count * 16);
    this.floats(at, places.length).set(places);
    const heights = at + places.length * 4, normals = heights + count * 4;
    this.calls.web_ground_heights(kind, a, b, at, count, heights, normals);
    const found = { heights: this.floats(heights, count).slice(), normals: this.floats(normals, count * 3).slice() };
    this.calls.web_free(at);
    free();
    return found;
  }

  /** The numbers that a ground is made of, and what frees the memory that they lie in. */
  ground(ground) {
    if (ground?.kind !== 'heights') return [...groundOf(ground), () => {}];
    const { heights, columns, rows } = ground, cell = number(ground.cell, 'ground.cell');
    if (!(columns >= 2 && rows >= 2) || heights?.length !== columns * rows)
      throw new TypeError('ground.heights are columns x rows numbers, at least 2 x 2');
    if (!(cell > 0)) throw new TypeError('ground.cell is above 0');
    if (!Array.prototype.every.call(heights, Number.isFinite)) throw new TypeError('ground.heights are finite numbers');
    const at = this.room(4 * heights.length);
    this.floats(at, heights.length).set(heights);
    const field = this.calls.web_heights_create(at, columns, rows, cell, number(ground.x, 'ground.x', 0), number(ground.z, 'ground.z', 0));
    return [GROUNDS.indexOf('heights'), field, 0, () => { this.calls.web_free(field); this.calls.web_free(at); }];
  }

  // What follows is for this file alone.
  floats(at, count) {
    return new Float32Array(this.calls.memory.buffer, at, count);
  }
  doubles(at, count) {
    return new Float64Array(this.calls.memory.buffer, at, count);
  }
  words(at, count) {
    return new Uint32Array(this.calls.memory.buffer, at, count);
  }
  text(at) {
    if (!at) return '';
    const bytes = new Uint8Array(this.calls.memory.buffer);
    return new TextDecoder().decode(bytes.slice(at, bytes.indexOf(0, at)));
  }
  room(size) {
    const at = this.calls.web_allocate(size);
    if (!at) throw new SbfmtError('memory ran out', 'OUT_OF_MEMORY', '');
    return at;
  }
  failure() {
    const c = this.calls;
    return new SbfmtError(this.text(c.web_failure_message()) || 'memory ran out', this.text(c.web_failure_code()),
      this.text(c.web_failure_path()));
  }
}

function groundOf(ground = { kind: 'flat' }) {
  const kind = chosen(GROUNDS, ground.kind, 'ground.kind');
  if (kind === 1) {
    const degrees = number(ground.degrees, 'ground.degrees');
    if (Math.abs(degrees) > 45) throw new TypeError('ground.degrees is -45 to 45');
    return [kind, degrees, 0];
  }
  if (kind === 2) return [kind, number(ground.rise, 'ground.rise'), number(ground.run, 'ground.run')];
  if (kind === 3) return [kind, number(ground.height, 'ground.height'), number(ground.seed, 'ground.seed', 1)];
  return [kind, number(ground.height, 'ground.height', 0), 0];
}

/** A file, loaded and checked. */
class Asset {
  constructor(sbfmt, bytes) {
    const c = sbfmt.calls, from = bytes instanceof ArrayBuffer ? new Uint8Array(bytes) : bytes;
    if (!ArrayBuffer.isView(from)) throw new TypeError('an asset is made of the bytes of an .sbfz file: an ArrayBuffer or a Uint8Array');
    this.sbfmt = sbfmt;
    // Lists that are stored uncompressed are used where they lie, aligned as in the file.
    this.memory = sbfmt.room(from.byteLength + 64);
    const at = (this.memory + 63) & ~63;
    new Uint8Array(c.memory.buffer, at, from.byteLength).set(new Uint8Array(from.buffer, from.byteOffset, from.byteLength));
    this.handle = c.web_asset_load(at, from.byteLength);
    if (!this.handle) {
      const failure = sbfmt.failure();
      c.web_free(this.memory);
      throw failure;
    }
    this.title = sbfmt.text(c.web_asset_title(this.handle));
    for (const [kind, name] of KINDS.entries())
      this[name] = Array.from({ length: c.web_asset_count(this.handle, kind) }, (_, i) => ({
        index: i,
        name: sbfmt.text(c.web_asset_name(this.handle, kind, i)),
      }));
    this.levels = c.web_asset_levels(this.handle);
    this.renderLevels = c.web_asset_render_levels(this.handle);
    for (const bone of this.bones) this.readBone(bone);
    for (const body of this.rigidBodies) body.bone = c.web_asset_rigid_bone(this.handle, body.index);
    for (const body of this.softBodies) body.bone = c.web_asset_body_bone(this.handle, body.index);
    for (const material of this.materials) this.readMaterial(material);
    for (const texture of this.textures) this.readTexture(texture);
  }

  readBone(bone) {
    const { calls, scratch } = this.sbfmt;
    calls.web_asset_bone(this.handle, bone.index, scratch);
    const n = Array.from(this.sbfmt.floats(scratch, 9));
    Object.assign(bone, { parent: n[0], head: n.slice(1, 4), rotation: n.slice(4, 8), length: n[8] });
  }

  readMaterial(material) {
    const { calls, scratch } = this.sbfmt;
    calls.web_asset_material(this.handle, material.index, scratch);
    const n = Array.from(this.sbfmt.floats(scratch, 15));
    Object.assign(material, {
      baseColor: n.slice(0, 4), metallic: n[4], roughness: n[5], emissive: n.slice(6, 9), alphaMode: ALPHAS[n[9]],
      alphaCutoff: n[10], doubleSided: n[11] !== 0, baseColorTexture: n[12], metallicRoughnessTexture: n[13], normalTexture: n[14],
    });
  }

  readTexture(texture) {
    const { calls, scratch } = this.sbfmt, at = calls.web_asset_texture_bytes(this.handle, texture.index, scratch);
    const size = this.sbfmt.words(scratch, 1)[0];
    texture.mediaType = this.sbfmt.text(calls.web_asset_texture_type(this.handle, texture.index));
    texture.path = this.sbfmt.text(calls.web_asset_texture_path(this.handle, texture.index));
    texture.bytes = new Uint8Array(calls.memory.buffer, at, size).slice();
  }

  levelError(level = 0) {
    return this.sbfmt.calls.web_asset_level_error(this.handle, level);
  }

  model(options = {}) {
    return new Model(this, options);
  }

  /** After everything that was made of it. */
  free() {
    this.sbfmt.calls.web_asset_free(this.handle);
    this.sbfmt.calls.web_free(this.memory);
    this.handle = 0;
  }
}

/** What many characters of one asset share. */
class Model {
  constructor(asset, options) {
    const sbfmt = asset.sbfmt, c = sbfmt.calls, scheme = options.scheme ?? 'automatic';
    const name = new TextEncoder().encode(scheme + '\0');
    if (name.length > SCRATCH_BYTES) throw new TypeError('no scheme has such a name');
    new Uint8Array(c.memory.buffer, sbfmt.scratch, name.length).set(name);
    const gravity = triple(options.gravity, 'gravity', [0, 0, 0]);
    this.asset = asset;
    this.level = number(options.level, 'level', 0);
    this.handle = c.web_model_create(asset.handle, this.level, sbfmt.scratch, number(options.substeps, 'substeps', 0),
      options.free ? 1 : 0, options.gravity ? 1 : 0, ...gravity, options.scalar ? 1 : 0, options.ladder ? 1 : 0);
    if (!this.handle) throw sbfmt.failure();
    this.substeps = c.web_model_substeps(this.handle);
    this.instructions = sbfmt.text(c.web_model_instructions(this.handle));
    const count = c.web_model_rungs(this.handle, sbfmt.scratch, 64), n = sbfmt.floats(sbfmt.scratch, 4 * count);
    this.rungs = Array.from({ length: count }, (_, i) => ({ kind: RUNGS[n[4 * i]], level: n[4 * i + 1], error: n[4 * i + 2], visits: n[4 * i + 3] }));
  }

  free() {
    this.asset.sbfmt.calls.web_model_free(this.handle);
    this.handle = 0;
  }
}

class World {
  constructor(sbfmt, options) {
    this.sbfmt = sbfmt;
    this.calls = sbfmt.calls;
    const gravity = triple(options.gravity, 'gravity', [0, 0, 0]);
    const [kind, a, b, free] = sbfmt.ground(options.ground);
    this.freeGround = free;
    this.handle = this.calls.web_world_create(kind, a, b, options.gravity ? 1 : 0, ...gravity,
      number(options.characters, 'characters', 0), number(options.colliders, 'colliders', 0),
      number(options.sleepAfter, 'sleepAfter', -1), options.touches === true ? 4096 : number(options.touches || 0, 'touches'));
    if (!this.handle) {
      free();
      throw sbfmt.failure();
    }
  }

  add(model, options = {}) {
    return new Character(this, model, options);
  }
  collider(options = {}) {
    return new Collider(this, options);
  }
  step(seconds = 1 / 60) {
    this.calls.web_world_step(this.handle, number(seconds, 'seconds'));
  }
  get ticks() {
    return this.calls.web_world_ticks(this.handle);
  }
  get awake() {
    return this.calls.web_world_awake(this.handle);
  }
  stateHash() {
    const { scratch } = this.sbfmt;
    this.calls.web_world_hash(this.handle, scratch);
    return Array.from(this.sbfmt.words(scratch, 2), (half) => half.toString(16).padStart(8, '0')).join('');
  }

  events() {
    const { scratch } = this.sbfmt, count = this.calls.web_world_events(this.handle, scratch, EVENT_ROOM);
    const n = this.sbfmt.doubles(scratch, count * 18);
    return Array.from({ length: count }, (_, i) => {
      const e = n.slice(i * 18, i * 18 + 18);
      return { kind: EVENTS[e[0]], character: e[1], leg: e[2], softBody: e[3], rigidBody: e[4], collider: e[5], tick: e[6],
        impulse: e[7], position: Array.from(e.slice(8, 11)), normal: Array.from(e.slice(11, 14)), other: e[14],
        otherSoftBody: e[15], otherRigidBody: e[16], speed: e[17] };
    });
  }

  ray(from, direction, length = 1000) {
    const { scratch } = this.sbfmt;
    const found = this.calls.web_world_ray(this.handle, ...triple(from, 'from'), ...triple(direction, 'direction'),
      number(length, 'length'), scratch);
    if (!found) return null;
    const n = Array.from(this.sbfmt.doubles(scratch, 11));
    return { collider: n[0], character: n[1], rigidBody: n[2], softBody: n[3], position: n.slice(4, 7), normal: n.slice(7, 10),
      distance: n[10] };
  }

  snapshot() {
    const size = this.calls.web_world_snapshot_size(this.handle), at = this.sbfmt.room(size);
    const good = this.calls.web_world_snapshot_save(this.handle, at, size);
    const bytes = new Uint8Array(this.calls.memory.buffer, at, size).slice();
    this.calls.web_free(at);
    if (!good) throw new SbfmtError('the state could not be saved', 'FAILED', '');
    return bytes;
  }

  restore(snapshot) {
    const at = this.sbfmt.room(snapshot.byteLength);
    new Uint8Array(this.calls.memory.buffer, at, snapshot.byteLength).set(snapshot);
    const good = this.calls.web_world_snapshot_restore(this.handle, at, snapshot.byteLength);
    this.calls.web_free(at);
    if (!good) throw new SbfmtError('the snapshot is of another world, or of other characters', 'FAILED', '');
  }

  // ---- Levels of detail ----

  /** From now on it chooses the rungs of characters that are put on none. */
  detail(options = {}) {
    const { errorPx, budget, nsPerVisit, settle, stay, awayAfter } = options, { scratch } = this.sbfmt;
    this.sbfmt.floats(scratch, 6).set([errorPx, budget, nsPerVisit, settle, stay, awayAfter].map((one) => number(one, 'a setting', NaN)));
    if (!this.calls.web_world_detail(this.handle, scratch)) throw this.sbfmt.failure();
  }
  views(views) {
    if (views.length > MOST_VIEWS) throw new TypeError(`there are ${MOST_VIEWS} views at most`);
    views.forEach((one, i) => this.sbfmt.doubles(this.sbfmt.scratch + 72 * i, 9).set([...triple(one.eye, 'eye'),
      ...triple(one.forward, 'forward'), number(one.height, 'height'), number(one.ratio, 'ratio'), number(one.lines, 'lines')]));
    this.calls.web_world_views(this.handle, this.sbfmt.scratch, views.length);
  }
  get visits() {
    return this.calls.web_world_visits(this.handle);
  }

  // ---- Recordings ----

  /** Begins a recording; the one before is dropped. */
  record() {
    this.dropRecording();
    this.recording = this.calls.web_record_begin(this.handle);
    if (!this.recording) throw new SbfmtError('memory ran out', 'OUT_OF_MEMORY', '');
  }
  /** Ends it: a copy of its bytes. */
  recorded() {
    if (!this.recording) throw new TypeError('nothing is being recorded: call record() first');
    this.calls.web_record_end(this.handle);
    const at = this.calls.web_record_bytes(this.recording, this.sbfmt.scratch), [size] = this.sbfmt.words(this.sbfmt.scratch, 1);
    const bytes = new Uint8Array(this.calls.memory.buffer, at, size).slice();
    this.dropRecording();
    return bytes;
  }
  replay(bytes) {
    return new Replay(this, bytes);
  }
  dropRecording() {
    if (!this.recording) return;
    this.calls.web_record_end(this.handle);
    this.calls.web_record_free(this.recording);
    this.recording = 0;
  }

  /** With its characters and colliders. */
  free() {
    this.dropRecording();
    this.calls.web_world_free(this.handle);
    this.freeGround();
    this.handle = 0;
  }
}

/** A recording that is played in a world that was made alike. */
class Replay {
  constructor(world, bytes) {
    const { sbfmt, calls } = world;
    this.world = world;
    this.memory = sbfmt.room(bytes.byteLength);
    new Uint8Array(calls.memory.buffer, this.memory, bytes.byteLength).set(bytes);
    this.handle = calls.web_replay_begin(world.handle, this.memory, bytes.byteLength);
    if (this.handle) return;
    const failure = sbfmt.failure();
    calls.web_free(this.memory);
    throw failure;
  }

  /** Plays up to and with the next step; false where nothing was left. */
  frame() {
    return this.world.calls.web_replay_frame(this.handle) !== 0;
  }
  get state() {
    const { sbfmt, calls } = this.world;
    calls.web_replay_state(this.handle, sbfmt.scratch);
    const [count, frames, checks, differs, tick] = sbfmt.doubles(sbfmt.scratch, 5);
    return { count, frames, checks, differs: differs !== 0, differsAt: differs ? tick : null };
  }
  free() {
    this.world.calls.web_free(this.handle);
    this.world.calls.web_free(this.memory);
    this.handle = 0;
  }
}

class Collider {
  constructor(world, options) {
    const c = world.calls, kind = chosen(SHAPES, options.shape ?? 'sphere', 'shape');
    this.world = world;
    this.shape = c.web_shape_create(kind, number(options.radius, 'radius', 0.5),
      ...triple(options.halfSizes, 'halfSizes', [0.5, 0.5, 0.5]));
    if (!this.shape) throw world.sbfmt.failure();
    this.id = c.web_collider_create(world.handle, this.shape, ...triple(options.position, 'position', [0, 0, 0]),
      number(options.friction, 'friction', -1), number(options.restitution, 'restitution', -1));
    if (this.id) return;
    const failure = world.sbfmt.failure();
    c.web_shape_free(this.shape);
    throw failure;
  }

  move(position, rotation = [0, 0, 0, 1]) {
    this.world.calls.web_collider_move(this.world.handle, this.id, 0, ...triple(position, 'position'), ...rotation);
  }
  place(position, rotation = [0, 0, 0, 1]) {
    this.world.calls.web_collider_move(this.world.handle, this.id, 1, ...triple(position, 'position'), ...rotation);
  }
  free() {
    this.world.calls.web_collider_free(this.world.handle, this.id);
    this.world.calls.web_shape_free(this.shape);
    this.id = 0;
  }
}

class Character {
  constructor(world, model, options) {
    const c = world.calls;
    Object.assign(this, { world, model, sbfmt: world.sbfmt, calls: c, meshes: new Map() });
    this.id = c.web_character_create(world.handle, model.handle, ...triple(options.position, 'position', [0, 0, 0]),
      number(options.heading, 'heading', 0), number(options.scale, 'scale', 1), options.hold ? 1 : 0);
    if (!this.id) throw this.sbfmt.failure();
    this.boneRoom = this.sbfmt.room(28 * model.asset.bones.length + 4);
  }

  drive(forward, turn = 0, sideways = 0) {
    this.calls.web_character_drive(this.world.handle, this.id, number(forward, 'forward'), number(sideways, 'sideways'),
      number(turn, 'turn'));
  }
  teleport(position, heading = 0) {
    this.calls.web_character_teleport(this.world.handle, this.id, ...triple(position, 'position'), number(heading, 'heading'));
  }
  reset() {
    this.calls.web_character_reset(this.world.handle, this.id);
  }
  wake() {
    this.calls.web_character_wake(this.world.handle, this.id);
  }
  pause(paused = true) {
    this.calls.web_character_pause(this.world.handle, this.id, paused ? 1 : 0);
  }
  play(clip, { layer = 0, weight = 1, fade = 0.3, speed = 1, start = 0 } = {}) {
    const place = typeof clip === 'string' ? this.model.asset.clips.findIndex((one) => one.name === clip) : clip ?? -1;
    if (typeof clip === 'string' && place < 0) throw new TypeError(`the asset has no clip '${clip}'`);
    this.calls.web_character_play(this.world.handle, this.id, layer, place, weight, fade, speed, start);
  }
  reach(ikChain, position, weight = 1) {
    const [x, y, z] = position ? triple(position, 'position') : [0, 0, 0];
    this.calls.web_character_reach(this.world.handle, this.id, ikChain, x, y, z, position ? weight : -1);
  }
  rigidMode(mode, rigidBody = -1) {
    if (!(mode in MODES)) throw new TypeError(`a mode is one of ${Object.keys(MODES).join(', ')}, not ${mode}`);
    this.calls.web_character_rigid_mode(this.world.handle, this.id, rigidBody, MODES[mode]);
  }
  fall() {
    this.calls.web_character_fall(this.world.handle, this.id);
  }
  get posture() {
    return POSTURES[this.calls.web_character_posture(this.world.handle, this.id)];
  }
  push(rigidBody, place, impulse) {
    this.calls.web_character_push(this.world.handle, this.id, rigidBody, ...triple(place, 'place'), ...triple(impulse, 'impulse'));
  }

  rigidState(rigidBody) {
    const { scratch } = this.sbfmt;
    this.calls.web_character_rigid(this.world.handle, this.id, rigidBody, scratch);
    const n = Array.from(this.sbfmt.floats(scratch, 18));
    return { mode: Object.keys(MODES)[n[0]], position: n.slice(1, 4), rotation: n.slice(4, 8), center: n.slice(8, 11),
      velocity: n.slice(11, 14), angularVelocity: n.slice(14, 17), mass: n[17] };
  }

  get rung() {
    return this.calls.web_character_rung(this.world.handle, this.id);
  }
  setRung(rung) {
    this.calls.web_character_set_rung(this.world.handle, this.id, rung === null ? RUNG_CHOSEN : number(rung, 'rung'));
  }
  get fade() {
    return this.calls.web_character_fade(this.world.handle, this.id);
  }
  shown(how) {
    this.calls.web_character_shown(this.world.handle, this.id, chosen(SHOWN, how, 'how it is shown'));
  }
  get errorPx() {
    return this.calls.web_character_error_px(this.world.handle, this.id);
  }

  get origin() {
    this.calls.web_character_origin(this.world.handle, this.id, this.sbfmt.scratch);
    return Array.from(this.sbfmt.doubles(this.sbfmt.scratch, 3));
  }
  get distance() {
    return this.calls.web_character_distance(this.world.handle, this.id);
  }
  bones() {
    const count = this.model.asset.bones.length;
    this.calls.web_character_bones(this.world.handle, this.id, this.boneRoom, count);
    return this.sbfmt.floats(this.boneRoom, count * 7);
  }
  health() {
    this.calls.web_character_health(this.world.handle, this.id, this.model.asset.softBodies.length, this.sbfmt.scratch);
    const n = this.sbfmt.doubles(this.sbfmt.scratch, 7);
    return { volumeRatio: n[0], maxStrain: n[1], energy: n[2], recoveries: n[3], torn: n[4], valid: n[5] !== 0, asleep: n[6] !== 0 };
  }
  legs() {
    const { scratch } = this.sbfmt, count = this.calls.web_character_legs(this.world.handle, this.id, scratch, 64);
    const n = this.sbfmt.floats(scratch, count * 10);
    return Array.from({ length: count }, (_, i) => {
      const leg = Array.from(n.slice(i * 10, i * 10 + 10));
      return { planted: leg[0] !== 0, steps: leg[1], phase: leg[2], foot: leg.slice(3, 6), target: leg.slice(6, 9) };
    });
  }

  /** Vertices as a graphics card wants them: made once, filled anew by each call. */
  skin(mesh = 0, level = 0) {
    const key = `${mesh}:${level}`, c = this.calls;
    let at = this.meshes.get(key);
    if (!at) {
      at = c.web_mesh_create(this.model.asset.handle, this.model.handle, mesh, level);
      if (!at) throw new SbfmtError(`there is no mesh ${mesh}, or memory ran out`, 'FAILED', '');
      this.meshes.set(key, at);
    }
    c.web_mesh_update(at, this.world.handle, this.id);
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
    this.lineRoom ??= c.web_lines_create(this.model.asset.handle, this.world.handle, this.id, this.model.level);
    if (!this.lineRoom) throw new SbfmtError('memory ran out', 'OUT_OF_MEMORY', '');
    const at = c.web_lines_update(this.lineRoom, this.world.handle, this.id);
    return this.sbfmt.floats(at, c.web_lines_count(this.lineRoom) * 10);
  }

  /** Before its world. */
  free() {
    for (const mesh of this.meshes.values()) this.calls.web_mesh_free(mesh);
    this.meshes.clear();
    if (this.lineRoom) this.calls.web_lines_free(this.lineRoom);
    this.lineRoom = undefined;
    this.calls.web_free(this.boneRoom);
    this.calls.web_character_free(this.world.handle, this.id);
    this.id = 0;
  }
}
