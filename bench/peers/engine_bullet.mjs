// Bullet, by ammojs-typed. It has the classic soft bodies alone: links whose stiffness is a share from 0 to 1 without a unit.
import { createRequire } from 'node:module';
import { FRAME_S, edgesOf } from './cases.mjs';
import { forHung, rotated, turnOf } from './engine_parts.mjs';

const Ammo = await createRequire(import.meta.url)('ammojs-typed').call({});

const numbers = (v) => [v.x(), v.y(), v.z()];

function worldOf(gravity) {
  const configuration = new Ammo.btSoftBodyRigidBodyCollisionConfiguration(), dispatcher = new Ammo.btCollisionDispatcher(configuration);
  const broad = new Ammo.btDbvtBroadphase(), solver = new Ammo.btSequentialImpulseConstraintSolver(), softSolver = new Ammo.btDefaultSoftBodySolver();
  const world = new Ammo.btSoftRigidDynamicsWorld(dispatcher, broad, solver, configuration, softSolver);
  const pull = new Ammo.btVector3(0, -gravity, 0);
  world.setGravity(pull);
  world.getWorldInfo().set_m_gravity(pull);
  return { world, close: () => [world, softSolver, solver, broad, dispatcher, configuration, pull].forEach((thing) => Ammo.destroy(thing)) };
}

function softBody(world, body, setting) {
  const count = body.masses.length, at = new Ammo.btVector3(0, 0, 0);
  const made = new Ammo.btSoftBody(world.getWorldInfo(), 0, at, []);
  const material = made.appendMaterial();
  material.set_m_kLST(setting.stiffness);
  for (let i = 0; i < count; i++) {
    at.setValue(...body.points.subarray(3 * i, 3 * i + 3));
    made.appendNode(at, body.held.includes(i) ? 0 : body.masses[i]);
  }
  for (const { a, b } of edgesOf(body)) made.appendLink(a, b, material, false);
  for (let i = 0; body.angularVelocity && i < count; i++) {
    const [x, , z] = body.points.subarray(3 * i, 3 * i + 3);
    at.setValue(body.angularVelocity * z, 0, -body.angularVelocity * (x - body.turnsAbout));
    made.get_m_nodes().at(i).set_m_v(at);
  }
  const config = made.get_m_cfg();
  config.set_piterations(setting.iterations);
  config.set_collisions(0);
  config.set_kDP(body.massDamping * FRAME_S / setting.steps); // the share of its speed that a step takes
  made.setActivationState(4); // never asleep
  Ammo.destroy(at);
  return made;
}

function soft(body, setting) {
  const { world, close } = worldOf(body.gravity), made = softBody(world, body, setting);
  world.addSoftBody(made, 1, 0);
  const nodes = made.get_m_nodes(), read = (get) => Float64Array.from(Array.from(body.masses, (_, i) => numbers(get(nodes.at(i)))).flat());
  return {
    step() {
      world.stepSimulation(FRAME_S, setting.steps, FRAME_S / setting.steps);
    },
    close() {
      world.removeSoftBody(made);
      close();
    },
    mass: Array.from(body.masses, (_, i) => nodes.at(i).get_m_im()).reduce((sum, inverse) => sum + (inverse > 0 ? 1 / inverse : 0), 0),
    points: () => read((node) => node.get_m_x()),
    velocities: () => read((node) => node.get_m_v()),
  };
}

function makeLink({ mass, moments, length, width, start }, angle) {
  const shape = new Ammo.btBoxShape(new Ammo.btVector3(length / 2, width / 2, width / 2));
  const at = new Ammo.btTransform(new Ammo.btQuaternion(...turnOf(angle)), new Ammo.btVector3(...start));
  const body = new Ammo.btRigidBody(new Ammo.btRigidBodyConstructionInfo(mass, new Ammo.btDefaultMotionState(at), shape, new Ammo.btVector3(...moments)));
  body.setDamping(0, 0);
  body.setActivationState(4);
  return body;
}

function chain({ links, angle, gravity }, setting) {
  const { world, close } = worldOf(gravity), made = links.map((link) => makeLink(link, angle));
  made.forEach((body, i) => {
    const end = new Ammo.btVector3(-links[i].length / 2, 0, 0);
    world.addRigidBody(body, 1, 0);
    const joint = i ? new Ammo.btPoint2PointConstraint(made[i - 1], body, new Ammo.btVector3(links[i - 1].length / 2, 0, 0), end) : new Ammo.btPoint2PointConstraint(body, end);
    world.addConstraint(joint, true);
  });
  return {
    step() {
      world.stepSimulation(FRAME_S, setting.steps, FRAME_S / setting.steps);
    },
    close,
    mass: links.reduce((sum, { mass }) => sum + mass, 0),
    poses: () => made.map((body) => {
      const at = body.getWorldTransform(), turn = at.getRotation();
      return { center: numbers(at.getOrigin()), along: rotated([turn.x(), turn.y(), turn.z(), turn.w()], [1, 0, 0]) };
    }),
  };
}

// The cheapest of these settings that holds the beam up as far as its material does.
const FITTED = { name: '4 steps of 10 iterations', steps: 4, iterations: 10, fittedOn: 'beam' };
const settings = [[1, 1], [1, 5], [1, 10], [1, 20], [1, 40], [2, 10], [8, 10], [16, 10]].map(([steps, iterations]) => (
  { name: `${steps} steps of ${iterations} iterations`, steps, iterations, recommended: steps === 1 && iterations === 10 }));
settings.splice(6, 0, FITTED);

export default {
  name: 'Bullet', package: 'ammojs-typed', soft, chain,
  stiffness: { by: FITTED, load: 1, first: 0.7, most: 1 },
  settings: { beam: settings, spin: settings, ...forHung([1, 2, 4, 8, 16, 32].map((steps) => ({ name: `${steps} steps`, steps, recommended: steps === 1 }))) },
  // Its links become stiffer with each iteration and step, so that its own model is a rigid one in the end: of the beam, the fitted
  // setting stands for it, and of the free bar the finest steps.
  reference: { beam: FITTED, spin: { steps: 64, iterations: 10 } },
};
