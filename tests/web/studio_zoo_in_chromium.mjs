// Drops files on the studio, one after another, between two drops of an example; prints what memory is taken then as one line of JSON.
// Usage: node studio_zoo_in_chromium.mjs FOLDER-OF-NODE_MODULES PAGE EXAMPLE FILE...
import { readFileSync } from 'node:fs';
import { tmpdir } from 'node:os';
import path from 'node:path';
import { pathToFileURL } from 'node:url';

import { open } from './chromium.mjs';

const [modules, page, example, ...files] = process.argv.slice(2), dropped = [];
const { tab, faults, expect, close } = await open(modules, tmpdir());
await tab.goto(pathToFileURL(page).href);
await tab.waitForFunction(() => globalThis.studio?.stage.time > 0.1);
const session = await tab.context().newCDPSession(tab);

/** Drops a file; true: it is shown, false: it is refused. */
const drop = async (file) => {
  await tab.evaluate(([name, base64]) => {
    const carried = new DataTransfer();
    carried.items.add(new File([Uint8Array.from(atob(base64), (one) => one.charCodeAt(0))], name));
    studio.before = studio.made;
    document.body.dispatchEvent(new DragEvent('drop', { bubbles: true, cancelable: true, dataTransfer: carried }));
  }, [path.basename(file), readFileSync(file).toString('base64')]);
  await tab.waitForFunction(() => studio.made !== studio.before || !document.querySelector('#trouble').hidden);
  await tab.waitForFunction(() => document.querySelector('#work').hidden);
  const isShown = await tab.evaluate(() => studio.made !== studio.before);
  await tab.evaluate(() => { studio.before = undefined; });
  const time = await tab.evaluate(() => studio.stage.time);
  await tab.waitForFunction((before) => studio.stage.time !== before, time);
  return isShown;
};
const measure = async () => {
  for (let i = 0; i < 3; i++) await session.send('HeapProfiler.collectGarbage');
  const heap = await session.send('Runtime.getHeapUsage');
  return { objects: heap.usedSize, arrays: heap.backingStorageSize ?? 0, runtime: await tab.evaluate(() => studio.stage.sbfmt.calls.memory.buffer.byteLength) };
};

// Memory of the runtime never shrinks: the largest file is dropped first as well.
const largest = files.reduce((most, one) => (readFileSync(one).length > readFileSync(most).length ? one : most));
for (const file of [example, largest, example]) await drop(file);
const before = await measure();
for (const file of files) dropped.push([path.basename(file), await drop(file)]);
expect(await drop(example), 'the example is refused at last');
const after = await measure(), memory = Object.fromEntries(Object.keys(before).map((key) => [key, [before[key], after[key]]]));
await close();
console.log(JSON.stringify({ dropped, memory, faults }));
