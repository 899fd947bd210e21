// Levels of detail, height fields and recordings for test_more.py. Prints the results as JSON.
// Usage: node more_under_node.mjs SBFMT.JS BUNDLE RECORDING-TO-WRITE
import { readFile, writeFile } from 'node:fs/promises';
import { pathToFileURL } from 'node:url';

const { load, SbfmtError } = await import(pathToFileURL(process.argv[2]));
const sbfmt = await load(), bytes = await readFile(process.argv[3]), asset = sbfmt.asset(bytes);
const faults = [], expect = (good, what) => good || faults.push(what);
const throws = (call, kind, what) => {
  try {
    call();
    faults.push(`${what} throws nothing`);
  } catch (error) {
    expect(error instanceof kind && error.message.length > 10, `${what} throws ${error}`);
  }
};

// A height field that is a plane has its height everywhere; a hill is stood on.
const plane = { kind: 'heights', columns: 3, rows: 4, cell: 2, x: -2, z: -2, heights: Array.from({ length: 12 }, (_, i) => 0.1 * (i % 3)) };
const { heights, normals } = sbfmt.groundAt(plane, [-1, 0, 0.5, 1, 7, 7]);
expect(Math.abs(heights[0] - 0.05) < 1e-6 && Math.abs(heights[1] - 0.125) < 1e-6 && Math.abs(heights[2] - 0.2) < 1e-6, `heights ${heights}`);
expect(Math.abs(normals[0] / normals[1] + 0.05) < 1e-6, `normals ${normals}`);
const side = 81, hill = { kind: 'heights', columns: side, rows: side, cell: 0.1, x: -4, z: -4,
  heights: Float32Array.from({ length: side * side }, (_, i) => 0.3 * Math.exp(-(((i % side) * 0.1 - 4) ** 2 + (Math.floor(i / side) * 0.1 - 5.2) ** 2))) };
const model = asset.model({ detailLevels: true }), uphill = sbfmt.world({ ground: hill }), climber = uphill.add(model);
climber.drive(0.3);
for (let i = 0; i < 300; i++) uphill.step(1 / 60);
const lowest = () => {
  let least = Infinity;
  asset.meshes.forEach((_, i) => {
    const { positions } = climber.skin(i), { origin } = climber;
    const under = sbfmt.groundAt(hill, Float32Array.from({ length: positions.length / 3 * 2 }, (_, k) => positions[3 * (k >> 1) + 2 * (k & 1)] + origin[2 * (k & 1)]));
    const again = climber.skin(i).positions;
    under.heights.forEach((height, k) => { least = Math.min(least, again[3 * k + 1] + origin[1] - height); });
  });
  return least;
};
const least = lowest();
expect(climber.distance > 1 && least > -0.02 && least < 0.02, `on the hill it went ${climber.distance} m, its lowest point ${least} m over it`);
for (const wrong of [{ ...plane, heights: [1] }, { ...plane, columns: 1 }, { ...plane, cell: 0 }, { ...plane, heights: new Array(12).fill(NaN) }])
  throws(() => sbfmt.world({ ground: wrong }), TypeError, JSON.stringify(wrong));
climber.free();
uphill.free();

// Soft bodies: impulses, velocities, grabs, releases; wrong calls are refused.
const hands = sbfmt.world(), pushed = hands.add(model), soft = asset.softBodies.find((_, i) => pushed.softMotion(i).mass > 0)?.index ?? -1;
expect(soft >= 0, 'no soft body is simulated');
if (soft >= 0) {
  const { mass } = pushed.softMotion(soft), speed = () => pushed.softMotion(soft).velocity[1];
  pushed.setSoftVelocity(soft, [0, 1, 0]);
  expect(Math.abs(speed() - 1) < 1e-4, `set to 1 m/s it moves at ${speed()}`);
  pushed.applySoftImpulse(soft, [0, 0.5 * mass, 0]);
  expect(Math.abs(speed() - 1.5) < 1e-4, `half a metre a second more: ${speed()}`);
  const at = pushed.softMotion(soft).center.map((x, i) => x + pushed.origin[i] + (i === 1)), vertex = pushed.nearestVertex(soft, at);
  pushed.grab(soft, vertex, at, { maxForce: 1 });
  hands.step(1 / 60);
  const pulled = Math.hypot(...pushed.grabForce(soft, vertex));
  expect(pulled > 0.1 && pulled < 1.001, `held by ${pulled} N`);
  expect(pushed.release(soft, vertex) && !pushed.release(soft, vertex), 'what is held is released once');
  expect(Math.hypot(...pushed.grabForce(soft, vertex)) === 0, 'what is released is held by nothing');
  for (let i = 0; i < 120; i++) hands.step(1 / 60);
  const pins = pushed.pinReactions(soft), elements = pushed.tetrahedra(soft);
  expect(pins.length > 0 && pins.every((one) => one.points >= 0 && one.force.every(Number.isFinite)) && pins.some((one) => one.force[1] > 0),
    `pins: ${JSON.stringify(pins)}`);
  expect(elements.every((one) => one.stress.every(Number.isFinite) && one.restVolume > 0), 'stress that is no number');
  const still = pushed.softMotion(soft).velocity[1];
  pushed.applySoftForce(soft, [0, 3 * 10 * mass, 0], 1 / 60);
  hands.step(1 / 60);
  expect(pushed.softMotion(soft).velocity[1] > still + 0.05, `a force of three times its weight: ${still} to ${pushed.softMotion(soft).velocity[1]}`);
  throws(() => pushed.grab(soft, 1e6, at), SbfmtError, 'a vertex that is not there');
  throws(() => pushed.applySoftImpulse(99, [0, 0, 0]), TypeError, 'a body that is not there');
}
pushed.free();
hands.free();

// Rungs: named, changed by hand, and chosen by views.
const kinds = model.detailLevels.map((one) => one.kind);
expect(kinds[0] === 'soft' && kinds.at(-1) === 'away' && kinds.includes('bones'), `detailLevels ${kinds}`);
expect(model.detailLevels.every((one, i) => !i || one.visits <= model.detailLevels[i - 1].visits), 'a coarser detailLevel costs more');
expect(asset.model().detailLevels.length === 1, 'without a detailLevels there is one detailLevel');
const world = sbfmt.world(), near = world.add(model), far = world.add(model, { position: [0, 0, 60] });
for (const one of [near, far]) one.drive(0.25);
near.setDetailLevel(1);
for (let i = 0; i < 3; i++) world.step(1 / 60);
expect(near.detailLevel === 1 && near.fade > 0, `put on detailLevel 1 it is on ${near.detailLevel}, its skin at ${near.fade}`);
near.setDetailLevel(null);
world.detail({ errorPx: 1, offscreenAfter: 0.5 });
world.views([{ eye: [0, 0.5, -1.5], forward: [0, -0.1, 1], height: 0.8, ratio: 1.6, lines: 1080 }]);
for (let i = 0; i < 120; i++) world.step(1 / 60);
expect(near.detailLevel === 0 && far.detailLevel > 0, `chosen: near ${near.detailLevel}, far ${far.detailLevel}`);
expect(near.errorPx > 0 && far.errorPx <= 1 && world.visits < 2 * model.detailLevels[0].visits, `off by ${near.errorPx} and ${far.errorPx} px, ${world.visits} visits`);
far.shown('never');
for (let i = 0; i < 60; i++) world.step(1 / 60);
expect(model.detailLevels[far.detailLevel].kind === 'away', `hidden it is ${model.detailLevels[far.detailLevel].kind}`);
throws(() => world.detail({ errorPx: -1 }), SbfmtError, 'an error below 0');
throws(() => world.views(new Array(5).fill({})), TypeError, 'a fifth view');
throws(() => far.shown('rarely'), TypeError, 'a way to be shown that there is not');
world.free();

// A recording gives the same state again, detects another world, and has the program's own format.
const land = { kind: 'noise', height: 0.1, seed: 5 }, plain = asset.model();
const made = () => {
  const one = sbfmt.world({ ground: land });
  return { one, character: one.add(plain) };
};
const first = made();
first.one.record();
first.character.drive(0.3, 0.2);
for (let i = 0; i < 150; i++) {
  if (i === 70) first.character.drive(0.1, -0.5);
  first.one.step(i % 3 ? 1 / 60 : 1 / 40);
}
const hash = first.one.stateHash(), recording = first.one.recorded();
await writeFile(process.argv[4], recording);
const second = made(), replay = second.one.replay(recording);
while (replay.frame());
const { count, frames, checks, differs } = replay.state;
expect(count === 150 && frames === 150 && checks >= 3 && !differs, `replayed: ${JSON.stringify(replay.state)}`);
expect(second.one.stateHash() === hash, 'a replay ends in another state');
replay.free();
// A host that moves it itself: its feet step after it.
const led = made();
for (let i = 0; i < 120; i++) {
  led.character.displace([0, 0, 0.005]);
  led.one.step(1 / 60);
}
expect(Math.abs(led.character.distance - 0.6) < 0.06, `moved by 0.6 m it went ${led.character.distance} m`);
const third = sbfmt.world({ ground: { kind: 'flat' } });
third.add(plain, { position: [1, 0, 0] });
expect(third.replay(recording).state.differs, 'another world passes for the same');
throws(() => third.replay(new Uint8Array(40)), SbfmtError, 'what is no recording');
throws(() => third.recorded(), TypeError, 'the end of what was not begun');
third.record(); // and is dropped with its world
third.free();
console.log(JSON.stringify({ hash, faults }));
