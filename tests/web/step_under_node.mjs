// Steps bundles for test_hashes.py. Prints the results as JSON.
// Usage: node step_under_node.mjs SBFMT.JS JOBS
import { readFile } from 'node:fs/promises';
import { pathToFileURL } from 'node:url';

const { load, SbfmtError } = await import(pathToFileURL(process.argv[2]));
const sbfmt = await load();
const faults = [];
const expect = (good, what) => good || faults.push(what);

function begin(job, bytes, scalar) {
  const model = sbfmt.asset(bytes).model({ scalar });
  expect(model.instructions === (scalar ? 'scalar' : 'wasm_simd128'), `it runs with ${model.instructions}`);
  const world = sbfmt.world({ ground: job.ground });
  const character = world.add(model);
  character.drive(...job.drive);
  return { world, character };
}

const runs = [];
for (const job of JSON.parse(process.argv[3])) {
  const bytes = await readFile(job.file);
  const { world, character } = begin(job, bytes, false);
  const half = Math.floor(job.frames / 2);
  const before = process.cpuUsage();
  for (let i = 0; i < half; i++) world.step(1 / 60);
  const used = process.cpuUsage(before);
  const kept = world.snapshot();
  for (let i = half; i < job.frames; i++) world.step(1 / 60);
  const hash = world.stateHash(), distance = character.distance;
  world.restore(kept);
  expect(world.stateHash() !== hash, 'a snapshot has the state of its own moment');
  for (let i = half; i < job.frames; i++) world.step(1 / 60);
  const again_hash = world.stateHash();
  const scalar = job.frames < 200 ? begin(job, bytes, true) : { world };
  for (let i = 0; i < job.frames && scalar.character; i++) scalar.world.step(1 / 60);
  runs.push({ hash, again_hash, scalar_hash: scalar.world.stateHash(), distance, us: (used.user + used.system) / half });
  expect(character.health().valid, 'a body is inside out');
  character.free();
  world.free();
}

// A damaged bundle is refused, and all of its memory is freed.
const [job] = JSON.parse(process.argv[3]);
const good = await readFile(job.file);
let refused = 0;
for (let i = 0; i < 200; i++) {
  const broken = new Uint8Array(good);
  for (let k = 0; k < 4; k++) broken[(i * 7919 + k * 104729) % broken.length] ^= 1 << i % 8;
  try {
    sbfmt.asset(broken).free();
  } catch (error) {
    expect(error instanceof SbfmtError && error.message.length > 10 && error.code, `a broken file throws ${error}`);
    refused++;
  }
}
expect(refused > 190, `of 200 broken files ${refused} are refused`);
for (const call of [() => sbfmt.world({ ground: { kind: 'sea' } }), () => sbfmt.asset('lizard.sbfz'),
  () => sbfmt.asset(good).model({ scheme: 'implicit' }), () => sbfmt.world().add(sbfmt.asset(good).model(), { position: [0, NaN, 0] })])
  try {
    call();
    faults.push(`${call} throws nothing`);
  } catch (error) {
    expect(error instanceof TypeError || error instanceof SbfmtError, `${call} throws ${error}`);
  }
console.log(JSON.stringify({ runs, faults }));
