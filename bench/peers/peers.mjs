// One engine on every case, as CSV: node peers.mjs ENGINE [--quick]. ENGINE: sbfmt, jolt, mujoco, bullet, rapier. --quick measures its
// recommended settings once. What the columns mean stands in bench/README.md.
import { readFileSync } from 'node:fs';
import { CASES, FRAME_S } from './cases.mjs';
import { exactPath } from './exact_chain.mjs';
import { checkHung, checkSoft, fittedStiffness } from './setup.mjs';
import * as measures from './measures.mjs';
import { springModel } from './spring_model.mjs';

const FAR_LENGTHS = 10, ROUNDS = 5, SLOW_S = 0.5, SLOW_ROUNDS = 3, ENOUGH_S = 0.1, MOST_RUNS = 20;
const [engineName, ...options] = process.argv.slice(2), quick = options.includes('--quick');
const { default: engine } = await import(`./engine_${engineName}.mjs`);
const { version } = JSON.parse(readFileSync(new URL(`node_modules/${engine.package}/package.json`, import.meta.url)));

function processorS(work) {
  const before = process.cpuUsage();
  work();
  const { user, system } = process.cpuUsage(before);
  return (user + system) * 1e-6;
}

/** Runs `look(simulation)` after each frame until it says that the simulation exploded. Gives the frame, counted from 1, or 0. */
function watch(simulation, frames, look) {
  for (let frame = 1; frame <= frames; frame++)
    try {
      simulation.step();
      if (look(simulation)) return frame;
    } catch {
      return frame;
    }
  return 0;
}

const median = (numbers) => numbers.sort((a, b) => a - b)[Math.floor(numbers.length / 2)];

// ---- Soft bodies ----

const unwrapped = (angle, before) => before + ((angle - before) % (2 * Math.PI) + 3 * Math.PI) % (2 * Math.PI) - Math.PI;

/** The motion of a soft body: its last points, the angle that it turned by, its least volume, where it exploded. */
function softMotion(body, simulation) {
  const found = { angle: 0, leastVolume: 1 }, start = simulation.velocities || simulation.angularVelocity ? measures.rotation(body, simulation) : null;
  found.exploded = watch(simulation, body.frames, () => {
    found.points = simulation.points();
    if (measures.isFar(found.points, body.points, FAR_LENGTHS * body.length) || simulation.broken?.()) return true;
    found.angle = unwrapped(measures.angleOf(body, found.points), found.angle);
    found.leastVolume = Math.min(found.leastVolume, measures.leastVolume(body, found.points));
    return false;
  });
  if (start && body.angularVelocity && !found.exploded) {
    const end = measures.rotation(body, simulation);
    found.momentumDrift = measures.change(end.momentum, start.momentum);
    found.energyDrift = end.energy / start.energy - 1;
  }
  simulation.close();
  return found;
}

function softReference(body, stiffness) {
  const by = engine.reference[body.name];
  const simulation = by === 'springs' ? springModel(body, { stiffness }) : engine.soft(body, { ...by, stiffness });
  return softMotion(body, simulation);
}

function softRow(body, simulation, reference, setting) {
  const motion = softMotion(body, simulation);
  if (motion.exploded) return { leastVolume: motion.leastVolume, exploded: motion.exploded };
  const own = body.reading ? measures.relative(body.reading(motion.points), body.reading(reference.points)) : measures.rootMeanSquare(motion.points, reference.points) / body.length;
  const theory = measures.relative(body.reading ? body.reading(motion.points) : motion.angle, body.theory);
  return { ...motion, own: setting.fittedOn === body.name ? undefined : own, theory };
}

// ---- Rigid bodies ----

function hungRow(hung, simulation, exact) {
  const angles = [], path = [];
  let gap = 0;
  const exploded = watch(simulation, hung.frames, () => {
    const poses = simulation.poses(), { center } = poses.at(-1);
    angles.push(Math.atan2(center[0], -center[1]));
    path.push(center);
    gap = Math.max(gap, measures.jointGap(hung, poses));
    return !(Math.hypot(...center) < 2 * hung.length);
  });
  simulation.close();
  if (exploded) return { exploded };
  const found = { own: measures.rootMeanSquare(path.flat(), exact.flat()) / hung.length, gap };
  if (!hung.theory) return found;
  const energyDrift = (1 - Math.cos(measures.lastTurn(angles))) / (1 - Math.cos(hung.angle)) - 1;
  return { ...found, theory: measures.relative(measures.periodOf(angles, FRAME_S), hung.theory), energyDrift };
}

// ---- Rows ----

const COLUMNS = 'case,engine,version,setting,recommended,us_per_simulated_second,error_own,error_continuum,energy_drift,momentum_drift,least_volume,joint_gap_m,exploded_at_frame,note';
const text = (x, digits = 4) => (x === undefined ? '' : Number.isFinite(x) ? String(+x.toPrecision(digits)) : 'nan');

function print(name, setting, row, note = '') {
  const numbers = [row.us === undefined ? '' : Math.round(row.us), ...[row.own, row.theory, row.energyDrift, row.momentumDrift, row.leastVolume, row.gap].map((x) => text(x)), row.exploded || ''];
  console.log([name, engine.name, version, `"${setting?.name ?? ''}"`, setting?.recommended ? 'yes' : '', ...numbers, `"${note}"`].join(','));
}

/** Mean processor time of a run, of as many as it takes to be longer than the clock's own grain. */
function timeOnce(frames, make) {
  let [sum, runs] = [0, 0];
  while (sum < ENOUGH_S && runs < MOST_RUNS) {
    const simulation = make();
    sum += processorS(() => {
      for (let i = 0; i < frames; i++) simulation.step();
    });
    simulation.close();
    runs++;
  }
  return sum / runs;
}

/** Times what did not explode, in turns, so that no setting has the quiet minutes of the machine to itself. */
function timeRows(frames, make, rows) {
  const timed = rows.filter(({ row }) => !row.exploded);
  timed.forEach((one) => (one.times = []));
  for (let round = 0; round < (quick ? 1 : ROUNDS); round++)
    for (const one of timed) {
      if (round >= SLOW_ROUNDS && one.times[0] > SLOW_S) continue;
      one.times.push(timeOnce(frames, () => make(one.setting)));
    }
  for (const { row, times } of timed) row.us = 1e6 * median(times) / (frames * FRAME_S);
}

function measureCase(name, make, rowOf, note) {
  const { frames } = CASES[name]();
  const settings = engine.settings[name].filter((setting) => !quick || setting.recommended);
  const rows = settings.map((setting) => ({ setting, row: rowOf(make(setting), setting) }));
  timeRows(frames, make, rows);
  for (const { setting, row } of rows) print(name, setting, row, note);
}

function measureSoft() {
  const stiffness = fittedStiffness(engine);
  checkSoft(engine, stiffness);
  for (const name of ['beam', 'spin']) {
    const body = CASES[name](), reference = softReference(body, stiffness);
    measureCase(name, (setting) => engine.soft(body, { ...setting, stiffness }), (simulation, setting) => softRow(body, simulation, reference, setting),
      stiffness === 1 ? '' : `stiffness ${stiffness.toPrecision(5)}`);
  }
}

console.log(COLUMNS);
if (engine.soft) measureSoft();
else for (const name of ['beam', 'spin']) print(name, null, {}, 'it has no soft bodies');
for (const name of ['pendulum', 'chain']) {
  const hung = CASES[name](), exact = exactPath(hung);
  checkHung(engine, hung);
  measureCase(name, (setting) => engine.chain(hung, setting), (simulation) => hungRow(hung, simulation, exact));
}
process.exit(0); // Jolt's threads and Emscripten's would keep it
