// Whether an engine was given the same case as the others, and the one number that makes its stiffness the same where it has none in
// SI units, or where these give another answer. Throws where something is off by more than a ten-thousandth.
import { CASES, FRAME_S, signedVolume } from './cases.mjs';
import { exactPath } from './exact_chain.mjs';
import { linearRest } from './linear_elements.mjs';
import { springModel } from './spring_model.mjs';

const TOLERANCE = 1e-4, FALL_TOLERANCE = 5e-3, SMALL = 0.1; // of the weight, where strains are small enough for linear elasticity

function expect(engine, what, found, wanted, tolerance = TOLERANCE) {
  if (!(Math.abs(found - wanted) <= tolerance * Math.abs(wanted))) throw new Error(`${engine.name}: ${what} is ${found}, not ${wanted}`);
}

function sagUnder(body, simulation) {
  for (let i = 0; i < body.frames; i++) simulation.step();
  const sag = body.reading(simulation.points());
  simulation.close();
  return sag;
}

function lightBeam(gravityShare) {
  const body = CASES.beam();
  return { ...body, gravity: gravityShare * body.gravity };
}

/** The stiffness at which sag(stiffness) is `wanted`, by the secant method on its inverse, which is nearly a line. */
function matched(sag, wanted, first, most = Infinity) {
  let [a, b] = [first, Math.min(1.05 * first, most)], [p, q] = [1 / sag(a), 1 / sag(b)];
  for (let i = 0; i < 12 && Math.abs(q * wanted - 1) > 1e-5; i++) {
    const next = Math.min(Math.max(b + (1 / wanted - q) * (b - a) / (q - p), b / 4), 4 * b, most);
    [a, p] = [b, q];
    [b, q] = [next, 1 / sag(next)];
  }
  return b;
}

/** Of springs, elements or links, so that the beam sags as its own linear elements do. */
export function fittedStiffness(engine) {
  if (!engine.stiffness) return 1;
  const body = lightBeam(engine.stiffness.load), wanted = body.reading(linearRest(body)), { by, first, most } = engine.stiffness;
  const simulate = (stiffness) => (by === 'springs' ? springModel(body, { stiffness }) : engine.soft(body, { ...by, stiffness }));
  return matched((stiffness) => sagUnder(body, simulate(stiffness)), wanted, first, most);
}

function volumeOf(body, points) {
  return body.tetrahedra.reduce((sum, corners) => sum + signedVolume(points, corners), 0);
}

function meanVelocity(body, velocities) {
  const whole = body.masses.reduce((a, b) => a + b);
  return body.masses.reduce((sum, mass, i) => sum + mass * velocities[3 * i + 1], 0) / whole;
}

function checkFall(engine, stiffness) {
  const body = { ...CASES.spin(), gravity: 9.81, angularVelocity: 0 }, frames = 6;
  const simulation = engine.soft(body, { ...engine.settings.spin.find((setting) => setting.recommended), stiffness });
  expect(engine, 'the mass', simulation.mass, body.masses.reduce((a, b) => a + b));
  expect(engine, 'the volume', volumeOf(body, simulation.points()), volumeOf(body, body.points));
  for (let i = 0; i < frames; i++) simulation.step();
  const velocity = simulation.velocities ? meanVelocity(body, simulation.velocities()) : simulation.velocity()[1];
  expect(engine, 'the acceleration of free fall', -velocity / (frames * FRAME_S), body.gravity);
  simulation.close();
}

export function checkSoft(engine, stiffness) {
  checkFall(engine, stiffness);
  const beam = CASES.beam(), recommended = engine.settings.beam.find((setting) => setting.recommended);
  const held = engine.soft(beam, { ...recommended, stiffness });
  expect(engine, 'the mass that is free', held.mass, beam.masses.reduce((sum, mass, i) => sum + (beam.held.includes(i) ? 0 : mass), 0));
  held.points().forEach((x, i) => expect(engine, `coordinate ${i}`, x + 1, beam.points[i] + 1));
  held.close();
  const { by, load } = engine.stiffness ?? { by: recommended, load: SMALL }, light = lightBeam(load);
  const simulation = by === 'springs' ? springModel(light, { stiffness }) : engine.soft(light, { ...by, stiffness });
  expect(engine, 'the sag under a small load', sagUnder(light, simulation), light.reading(linearRest(light)));
}

/** Masses and moments by how far the last link falls in a fifth of a second in the finest steps, within what these are off themselves. */
export function checkHung(engine, hung) {
  const simulation = engine.chain(hung, engine.settings[hung.name].at(-1)), frames = 12, last = () => simulation.poses().at(-1).center;
  const fallen = ([x, y]) => hung.angle - Math.atan2(x, -y);
  expect(engine, 'the mass', simulation.mass, hung.links.reduce((sum, { mass }) => sum + mass, 0));
  expect(engine, 'where the last link starts', last()[0], hung.links.at(-1).start[0]);
  for (let i = 0; i < frames; i++) simulation.step();
  expect(engine, 'the angle that it falls', fallen(last()), fallen(exactPath({ ...hung, frames }).at(-1)), FALL_TOLERANCE);
  simulation.close();
}
