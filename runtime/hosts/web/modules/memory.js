/* The library's memory: views of it, texts in it, and what it says of a failure. */
import { SbfmtError } from './sbfmt_error.js';

/** So many events are told at once, of so many numbers each. */
export const EVENT_ROOM = 256, EVENT_NUMBERS = 18;
export const SCRATCH_BYTES = EVENT_ROOM * EVENT_NUMBERS * 8;

export class Memory {
  constructor(calls) {
    this.calls = calls;
    this.scratch = calls.web_allocate(SCRATCH_BYTES);
  }

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
