/* A world and its clock. */
import { Character } from './character.js';
import { number, triple } from './checked.js';
import { Collider } from './collider.js';
import { eventsOf } from './events.js';
import { groundNumbers } from './ground.js';
import { Lent } from './lent.js';
import { Model } from './model.js';
import { Recording, Replay } from './recording.js';
import { SbfmtError } from './sbfmt_error.js';

const MOST_VIEWS = 4;

/** Characters and colliders, stepped together. */
export class World extends Lent {
  constructor(sbfmt, options) {
    super('world');
    this.sbfmt = sbfmt;
    this.calls = sbfmt.calls;
    const gravity = triple(options.gravity, 'gravity', [0, 0, 0]);
    const [kind, a, b, free] = groundNumbers(sbfmt, options.ground);
    this.freeGround = free;
    this.handle = this.calls.web_world_create(kind, a, b, options.gravity ? 1 : 0, ...gravity,
      number(options.characters, 'characters', 0), number(options.colliders, 'colliders', 0),
      number(options.sleepAfter, 'sleepAfter', -1), options.touches === true ? 4096 : number(options.touches || 0, 'touches'));
    if (this.freed) {
      free();
      throw sbfmt.failure();
    }
  }

  add(model, options = {}) {
    if (!(model instanceof Model)) throw new TypeError('a character is made of a model: world.add(asset.model())');
    if (model.asset.sbfmt !== this.sbfmt) throw new TypeError('world and model are of two libraries: call load() once');
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
    return eventsOf(this);
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
    const bytes = this.sbfmt.bytes(at, size).slice();
    this.calls.web_free(at);
    if (!good) throw new SbfmtError('the state could not be saved', 'OUT_OF_MEMORY', '');
    return bytes;
  }

  restore(snapshot) {
    const at = this.sbfmt.room(snapshot.byteLength);
    this.sbfmt.bytes(at, snapshot.byteLength).set(snapshot);
    const good = this.calls.web_world_snapshot_restore(this.handle, at, snapshot.byteLength);
    this.calls.web_free(at);
    if (!good) throw new SbfmtError('the snapshot is of another world, or of other characters', 'BAD_CALL', '');
  }

  // ---- Levels of detail ----

  /** From now on it selects the detail levels of characters without a level set by the host. */
  detail(options = {}) {
    const { errorPx, budget, nsPerVisit, coarsenFraction, stay, offscreenAfter } = options, { scratch } = this.sbfmt;
    this.sbfmt.floats(scratch, 6).set([errorPx, budget, nsPerVisit, coarsenFraction, stay, offscreenAfter].map((one) => number(one, 'a setting', NaN)));
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

  /** Begins a recording; discards the previous one. */
  record() {
    this.recording?.free();
    this.recording = undefined;
    this.recording = new Recording(this);
  }
  /** Ends it: a copy of its bytes. */
  recorded() {
    if (!this.recording) throw new TypeError('nothing is being recorded: call record() first');
    const bytes = this.recording.bytes();
    this.recording.free();
    this.recording = undefined;
    return bytes;
  }
  replay(bytes) {
    return new Replay(this, bytes);
  }

  /** Frees it with its characters and colliders. */
  free() {
    if (this.freed) return;
    for (const one of this.users) one.free();
    this.recording?.free();
    this.recording = undefined;
    this.calls.web_world_free(this.handle);
    this.freeGround();
    this.handle = 0;
  }
}
