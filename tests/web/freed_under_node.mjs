// Freeing objects in any order, twice and by the collector, and errors of wrong calls. Prints the results as JSON.
// Usage: node freed_under_node.mjs SBFMT.JS BUNDLE
import { readFile } from 'node:fs/promises';
import { pathToFileURL } from 'node:url';

const { load, SbfmtError } = await import(pathToFileURL(process.argv[2]));
const bytes = await readFile(process.argv[3]), sbfmt = await load(), MIB = 2 ** 20;
const faults = [], expect = (good, what) => good || faults.push(what);
const throws = (what, kind, says, call) => {
  try {
    call();
    faults.push(`${what} throws nothing`);
  } catch (error) {
    expect(error instanceof kind && says.test(error.message), `${what} throws ${error}`);
  }
};
const made = (from = sbfmt) => {
  const asset = from.asset(bytes), model = asset.model(), world = from.world({ ground: { kind: 'noise', height: 0.1, seed: 7 } });
  return { asset, model, world, character: world.add(model) };
};
const walk = ({ world, character }) => {
  character.drive(0.3);
  for (let i = 0; i < 30; i++) world.step(1 / 60);
  return world.stateHash();
};
const touch = ({ world, character }) => {
  world.collider({ radius: 0.1 });
  character.skin(0);
  character.lines();
  character.bones();
};

// Worlds created and files loaded again and again: memory does not grow after the first few.
const size = () => sbfmt.calls.memory.buffer.byteLength;
const again = (count) => {
  for (let i = 0; i < count; i++) {
    const all = made();
    touch(all);
    all.world.step(1 / 60);
    all.world.free();
    all.model.free();
    all.asset.free();
  }
};
again(3);
const before = size();
again(12);
expect(size() === before, `12 loads later the library holds ${(size() - before) / MIB} MiB more`);

// A second free does nothing, and objects in use stay.
const all = made(), collider = all.world.collider(), replay = (() => {
  all.world.record();
  all.world.step(1 / 60);
  return all.world.replay(all.world.recorded());
})();
throws('an asset before its models', TypeError, /freed after its models/, () => all.asset.free());
throws('a model before its characters', TypeError, /freed after its characters/, () => all.model.free());
const second = all.world.add(all.model);
for (let i = 0; i < 2; i++) second.free();
all.world.step(1 / 60);
for (const one of [all.world, all.model, all.asset]) for (let i = 0; i < 2; i++) one.free();
for (const one of [collider, replay, all.character]) one.free();
const whole = made();
expect(walk(whole) === walk(made()), 'what was freed twice is still in use');

// Freed objects throw an error.
throws('a freed world', TypeError, /this world was freed/, () => all.world.step());
throws('a character of a freed world', TypeError, /this character was freed/, () => all.character.skin());
throws('a freed character', TypeError, /this character was freed/, () => second.distance);
throws('a freed collider', TypeError, /this collider was freed/, () => collider.move([0, 0, 0]));
throws('a freed replay', TypeError, /this replay was freed/, () => replay.frame());
throws('a freed model', TypeError, /this model was freed/, () => sbfmt.world().add(all.model));
throws('a freed asset', TypeError, /this asset was freed/, () => all.asset.model());

// Wrong arguments and refusals of the library throw different errors.
throws('no model', TypeError, /asset\.model\(\)/, () => whole.world.add());
throws('a model of another library', TypeError, /two libraries/, ((other) => () => other.world().add(whole.model))(await load()));
for (const [what, call] of Object.entries({
  mesh: () => whole.character.skin('body'), rigidBody: () => whole.character.push(999, [0, 0, 0], [0, 1, 0]), detailLevel: () => whole.character.setDetailLevel(9),
  ikChain: () => whole.character.reach(-1, [0, 0, 0]), clip: () => whole.character.play(5), rotation: () => whole.world.collider().move([0, 0, 0], [0, 0, 0]),
  scheme: () => whole.asset.model({ scheme: 'implicit' }),
})) throws(what, TypeError, new RegExp(what), call);
throws('XML', SbfmtError, /sbfmt pack/, () => sbfmt.asset(new TextEncoder().encode('<?xml version="1.0"?>')));
throws('another kind of file', SbfmtError, /sbfmt convert/, () => sbfmt.asset(new TextEncoder().encode('o cube')));
throws('a glTF file that was cut short', SbfmtError, /shorter than its header/, () => sbfmt.asset(new TextEncoder().encode('glTF')));
throws('more than there can be', SbfmtError, /4 GiB/, () => sbfmt.room(2 ** 33));
const refused = async (what, code, source) => {
  try {
    await load(source);
    faults.push(`${what} is loaded`);
  } catch (error) {
    expect(error instanceof SbfmtError && error.code === code && /sbfmt\.wasm/.test(error.message), `${what}: ${error}`);
  }
};
await refused('a page in place of the library', 'IO_UNKNOWN_FORMAT', new TextEncoder().encode('<!doctype html><p>404'));
await refused('a library that is not there', 'IO_CANNOT_READ', new URL('file:///nowhere/sbfmt.wasm'));

// Addresses in the upper half of the memory, whose sign is set, are as good as any.
const high = await load(), rooms = Array.from({ length: 3 }, () => high.room(900 * MIB));
const up = made(high), low = made();
expect(up.asset.memory > 2 ** 31, `the file lies at ${up.asset.memory}`);
expect(walk(up) === walk(low), 'in the upper half of the memory it walks otherwise');
touch(up);
expect(up.asset.title === low.asset.title && up.character.skin(0).positions.every((x, i) => x === low.character.skin(0).positions[i]),
  'in the upper half of the memory it looks otherwise');
const hill = { kind: 'heights', heights: [0, 1, 0, 1], columns: 2, rows: 2, cell: 1 };
expect(high.groundAt(hill, [0.5, 0.5]).heights[0] === 0.5, 'heights in the upper half are lost');
up.world.restore(up.world.snapshot());
expect(up.world.stateHash() === low.world.stateHash(), 'a snapshot in the upper half is another state');
rooms.forEach((at) => high.calls.web_free(at));
console.log(JSON.stringify({ kib: before / 1024, faults }));
