/* Calls the program `sbfmt` in a worker. */
import { part } from './studio_parts.js';

/** Thrown by a call that was cancelled. */
export class Cancelled extends Error {}

export class Program {
  /** Compiles the program once; every worker has the same modules. */
  prepare() {
    this.prepared ??= part('program').then(async ({ texts, bytes }) => {
      const compiled = await Promise.all(Object.entries(bytes).map(async ([name, wasm]) => [name, await WebAssembly.compile(wasm)]));
      this.source = URL.createObjectURL(new Blob(Object.values(texts), { type: 'text/javascript' }));
      this.modules = Object.fromEntries(compiled);
    }).catch((error) => {
      this.prepared = undefined; // so that another try may succeed
      throw error;
    });
    return this.prepared;
  }

  /** Runs it with these words and files, a Map of names and bytes, and gives { status, output, errors, files }, one call after
   * another. `signal` cancels. */
  async run(words, files, options = {}) {
    const before = this.last, mine = (async () => {
      await before?.catch(() => {});
      await this.prepare();
      options.signal?.throwIfAborted();
      return this.call(words, files, options);
    })();
    this.last = mine;
    return mine;
  }

  call(words, files, { progress, signal }) {
    this.worker ??= this.start();
    const { worker } = this;
    return new Promise((resolve, reject) => {
      const end = (settle, value) => {
        signal?.removeEventListener('abort', cancel);
        settle(value);
      };
      const cancel = () => {
        this.stop();
        end(reject, new Cancelled('cancelled'));
      };
      signal?.addEventListener('abort', cancel);
      worker.onmessage = ({ data }) => {
        if (data.progress) progress?.(data.progress);
        if (data.done) end(resolve, data.done);
      };
      worker.onerror = (event) => {
        this.stop();
        end(reject, new Error(`the program stopped: ${event.message}`));
      };
      worker.postMessage({ arguments: words, files });
    });
  }

  start() {
    const worker = new Worker(this.source);
    worker.postMessage({ modules: this.modules });
    return worker;
  }
  stop() {
    this.worker?.terminate();
    this.worker = undefined;
  }
}
