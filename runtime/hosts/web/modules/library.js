/* Loads the library. */
import { Asset } from './asset.js';
import { heightsAt } from './ground.js';
import { Memory } from './memory.js';
import { SbfmtError } from './sbfmt_error.js';
import { World } from './world.js';

/** A WebAssembly function that returns a vector: engines without SIMD refuse it. */
const ONE_VECTOR = Uint8Array.of(0, 0x61, 0x73, 0x6d, 1, 0, 0, 0, // magic, version
  1, 5, 1, 0x60, 0, 1, 0x7b, // of type () -> v128
  3, 2, 1, 0, 10, 8, 1, 6, 0, 0x41, 0, 0xfd, 0x0f, 0x0b); // one: i32.const 0, i8x16.splat

/** URL of the library: the given one, or sbfmt.wasm beside sbfmt.js. */
function addressOf(source) {
  const from = source ?? new URL('../sbfmt.wasm', import.meta.url);
  return new URL(String(from.url ?? from), typeof location === 'undefined' ? import.meta.url : location.href);
}

async function fetched(url) {
  if (url.protocol === 'file:' && typeof process !== 'undefined' && process.versions?.node)
    return (await import(/* @vite-ignore */ 'node:fs/promises')).readFile(url);
  const answer = await fetch(url);
  if (!answer.ok) throw new Error(`${answer.status} ${answer.statusText}`);
  return answer.arrayBuffer();
}

async function readFrom(url) {
  try {
    return await fetched(url);
  } catch (error) {
    throw new SbfmtError(`${url} could not be read: ${error.message}; give load() the address of sbfmt.wasm`, 'IO_CANNOT_READ', '');
  }
}

/** Compiles the library. Detects other content, such as a server's page for a missing file. */
async function compiled(source) {
  const given = source instanceof ArrayBuffer || ArrayBuffer.isView(source), url = given ? undefined : addressOf(source);
  const bytes = given ? source : await readFrom(url), view = new Uint8Array(bytes.buffer ?? bytes, bytes.byteOffset ?? 0, bytes.byteLength);
  if (!ONE_VECTOR.subarray(0, 4).every((byte, i) => byte === view[i])) {
    const begin = new TextDecoder().decode(view.subarray(0, 15)).replace(/[^ -~]/g, '.');
    throw new SbfmtError(`${url ?? 'what load() was given'} is not WebAssembly, it begins with "${begin}": give load() the address or the bytes ` +
      'of sbfmt.wasm, which a bundler may have moved', 'IO_UNKNOWN_FORMAT', '');
  }
  return WebAssembly.compile(bytes);
}

/** Makes the library ready. `source`: sbfmt.wasm as bytes, a module, or its URL; default: beside sbfmt.js. */
export async function load(source) {
  if (typeof WebAssembly !== 'object' || !WebAssembly.validate(ONE_VECTOR))
    throw new SbfmtError('there is no WebAssembly with SIMD here: Chrome 91, Firefox 89, Safari 16.4 and later have it, unless it is turned off',
      'IO_CANNOT_RUN', '');
  const module = source instanceof WebAssembly.Module ? source : await compiled(source);
  // The C library never writes to a console.
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
