// Rapier, by @dimforge/rapier3d-compat: rigid bodies alone.
import RAPIER from '@dimforge/rapier3d-compat';
import { FRAME_S } from './cases.mjs';

await RAPIER.init();
const numbers = ({ x, y, z }) => [x, y, z];
const vector = ([x, y, z]) => ({ x, y, z });

function pendulum(bar, setting) {
  const world = new RAPIER.World({ x: 0, y: -bar.gravity, z: 0 }), turn = (bar.amplitude - Math.PI / 2) / 2;
  // A multibody joint begins at its zero, so that the hook is turned like the bar.
  const rotation = { x: 0, y: 0, z: Math.sin(turn), w: Math.cos(turn) };
  world.timestep = FRAME_S / setting.steps;
  const hook = world.createRigidBody(RAPIER.RigidBodyDesc.fixed().setRotation(rotation));
  const body = world.createRigidBody(RAPIER.RigidBodyDesc.dynamic()
    .setTranslation(bar.arm * Math.sin(bar.amplitude), -bar.arm * Math.cos(bar.amplitude), 0)
    .setRotation(rotation)
    .setAdditionalMassProperties(bar.mass, vector([0, 0, 0]), vector(bar.moments), { x: 0, y: 0, z: 0, w: 1 })
    .setLinearDamping(0).setAngularDamping(0).setCanSleep(false));
  const joint = RAPIER.JointData.spherical(vector([0, 0, 0]), vector([-bar.arm, 0, 0]));
  if (setting.multibody) world.createMultibodyJoint(joint, hook, body, true);
  else world.createImpulseJoint(joint, hook, body, true);
  return {
    step() {
      for (let i = 0; i < setting.steps; i++) world.step();
    },
    close: () => world.free(),
    mass: bar.mass,
    center: () => numbers(body.translation()),
  };
}

const by = (kind, ...counts) => counts.map((steps) => ({ name: `${kind} joint, ${steps} steps`, multibody: kind === 'multibody', steps, recommended: kind === 'impulse' && steps === 1 }));

export default {
  name: 'Rapier', package: '@dimforge/rapier3d-compat', pendulum,
  settings: { beam: [], spin: [], pendulum: [...by('impulse', 1, 2, 4, 8, 16, 32), ...by('multibody', 1, 2, 4, 8, 16, 32)] },
};
