/* The library's memory: views, texts, and the message of a failure. */
import { SbfmtError } from './sbfmt_error.js';

/** Maximum number of events of a step, and numbers of each. */
export const EVENT_ROOM = 1024, EVENT_NUMBERS = 20;
export const SCRATCH_BYTES = EVENT_ROOM * EVENT_NUMBERS * 8;

/** Maximum size: addresses have 32 bits, which WebAssembly returns as signed numbers. */
const MEMORY_BYTES = 2 ** 32;

export class Memory {
  constructor(calls) {
    this.calls = calls;
    this.scratch = calls.web_allocate(SCRATCH_BYTES);
  }

  floats(at, count) {
    return new Float32Array(this.calls.memory.buffer, at >>> 0, count);
  }
  doubles(at, count) {
    return new Float64Array(this.calls.memory.buffer, at >>> 0, count);
  }
  bytes(at, count) {
    return new Uint8Array(this.calls.memory.buffer, at >>> 0, count);
  }
  words(at, count) {
    return new Uint32Array(this.calls.memory.buffer, at >>> 0, count);
  }
  text(at) {
    if (!at) return '';
    const bytes = new Uint8Array(this.calls.memory.buffer), first = at >>> 0;
    return new TextDecoder().decode(bytes.slice(first, bytes.indexOf(0, first)));
  }
  room(size) {
    const at = size < MEMORY_BYTES ? this.calls.web_allocate(size) : 0;
    if (!at) throw new SbfmtError(`no memory for ${size} bytes: WebAssembly has 4 GiB in all`, 'OUT_OF_MEMORY', '');
    return at >>> 0;
  }
  failure() {
    const c = this.calls;
    return new SbfmtError(this.text(c.web_failure_message()) || 'memory ran out', this.text(c.web_failure_code()),
      this.text(c.web_failure_path()));
  }
}
