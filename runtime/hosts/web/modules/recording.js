/* Recording and replaying the calls to a world. */
import { Lent } from './lent.js';
import { SbfmtError } from './sbfmt_error.js';

/** A recording of the calls to a world from now on. */
export class Recording {
  constructor(world) {
    this.world = world;
    this.handle = world.calls.web_record_begin(world.handle);
    if (!this.handle) throw new SbfmtError('memory ran out', 'OUT_OF_MEMORY', '');
  }

  /** Ends it: a copy of its bytes. */
  bytes() {
    const { sbfmt, calls, handle } = this.world;
    calls.web_record_end(handle);
    const at = calls.web_record_bytes(this.handle, sbfmt.scratch), [size] = sbfmt.words(sbfmt.scratch, 1);
    return sbfmt.bytes(at, size).slice();
  }

  free() {
    this.world.calls.web_record_end(this.world.handle);
    this.world.calls.web_record_free(this.handle);
    this.handle = 0;
  }
}

/** A replay of a recording in a world with the same definition. */
export class Replay extends Lent {
  constructor(world, bytes) {
    super('replay');
    const { sbfmt, calls } = world;
    this.world = world;
    this.memory = sbfmt.room(bytes.byteLength);
    sbfmt.bytes(this.memory, bytes.byteLength).set(bytes);
    this.handle = calls.web_replay_begin(world.handle, this.memory, bytes.byteLength);
    if (this.freed) {
      const failure = sbfmt.failure();
      calls.web_free(this.memory);
      throw failure;
    }
    world.use(this);
  }

  /** Plays calls through the next step; false at the end. */
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
    if (this.freed) return;
    this.world.leave(this);
    this.world.calls.web_free(this.handle);
    this.world.calls.web_free(this.memory);
    this.handle = 0;
  }
}
