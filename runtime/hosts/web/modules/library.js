/* The library, made ready. */
import { Asset } from './asset.js';
import { heightsAt } from './ground.js';
import { Memory } from './memory.js';
import { SbfmtError } from './sbfmt_error.js';
import { World } from './world.js';

/** The bytes of the library: those given, or of sbfmt.wasm beside sbfmt.js. */
async function bytesOf(source) {
  const from = source ?? new URL('../sbfmt.wasm', import.meta.url);
  if (from instanceof ArrayBuffer || ArrayBuffer.isView(from)) return from;
  const url = new URL(String(from.url ?? from), typeof location === 'undefined' ? import.meta.url : location.href);
  if (url.protocol === 'file:' && typeof process !== 'undefined' && process.versions?.node)
    return (await import(/* @vite-ignore */ 'node:fs/promises')).readFile(url);
  const answer = await fetch(url);
  if (!answer.ok) throw new SbfmtError(`${url} could not be read: ${answer.status} ${answer.statusText}`, 'IO_CANNOT_READ', '');
  return answer.arrayBuffer();
}

/** Makes the library ready. `source`: sbfmt.wasm as bytes, a module, or where it is; without, beside sbfmt.js. */
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

class Sbfmt extends Memory {
  asset(bytes) {
    return new Asset(this, bytes);
  }

  world(options = {}) {
    return new World(this, options);
  }

  groundAt(ground, places) {
    return heightsAt(this, ground, places);
  }
}
