// Rapier, by @dimforge/rapier3d-compat: rigid bodies alone.
import RAPIER from '@dimforge/rapier3d-compat';
import { FRAME_S } from './cases.mjs';
import { forHung, rotated, turnOf } from './engine_parts.mjs';

await RAPIER.init();
const numbers = ({ x, y, z }) => [x, y, z];
const vector = ([x, y, z]) => ({ x, y, z });
const NO_TURN = { x: 0, y: 0, z: 0, w: 1 };

function chain({ links, angle, gravity }, setting) {
  const world = new RAPIER.World({ x: 0, y: -gravity, z: 0 }), [x, y, z, w] = turnOf(angle), rotation = { x, y, z, w };
  world.timestep = FRAME_S / setting.steps;
  // A multibody joint begins at its zero, so that the hook is turned like the links.
  let before = world.createRigidBody(RAPIER.RigidBodyDesc.fixed().setRotation(rotation)), end = 0;
  const made = links.map(({ mass, moments, length, start }) => {
    const body = world.createRigidBody(RAPIER.RigidBodyDesc.dynamic().setTranslation(...start).setRotation(rotation)
      .setAdditionalMassProperties(mass, vector([0, 0, 0]), vector(moments), NO_TURN).setLinearDamping(0).setAngularDamping(0).setCanSleep(false));
    const joint = RAPIER.JointData.spherical(vector([end, 0, 0]), vector([-length / 2, 0, 0]));
    if (setting.multibody) world.createMultibodyJoint(joint, before, body, true);
    else world.createImpulseJoint(joint, before, body, true);
    [before, end] = [body, length / 2];
    return body;
  });
  return {
    step() {
      for (let i = 0; i < setting.steps; i++) world.step();
    },
    close: () => world.free(),
    mass: links.reduce((sum, { mass }) => sum + mass, 0),
    poses: () => made.map((body) => {
      const turn = body.rotation();
      return { center: numbers(body.translation()), along: rotated([turn.x, turn.y, turn.z, turn.w], [1, 0, 0]) };
    }),
  };
}

const by = (kind, ...counts) => counts.map((steps) => ({ name: `${kind} joint ${steps} steps`, multibody: kind === 'multibody', steps, recommended: kind === 'impulse' && steps === 1 }));

export default {
  name: 'Rapier', package: '@dimforge/rapier3d-compat', chain,
  settings: { beam: [], spin: [], ...forHung([...by('impulse', 1, 2, 4, 8, 16, 32), ...by('multibody', 1, 2, 4, 8, 16, 32)]) },
};
