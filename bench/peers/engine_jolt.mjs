// Jolt, by jolt-physics. Its soft bodies have no elements: springs along the edges, and the volume of each tetrahedron, both by
// compliance in SI units. `stiffness` scales the springs and volumes that stand for the material.
import initialize from 'jolt-physics';
import { FRAME_S, edgesOf, springStiffness, volumeStiffness } from './cases.mjs';

const Jolt = await initialize();
const [STILL, MOVING, LAYERS] = [0, 1, 2];

function makeWorld() {
  const settings = new Jolt.JoltSettings(), pairs = new Jolt.ObjectLayerPairFilterTable(LAYERS); // no pair collides
  const broad = new Jolt.BroadPhaseLayerInterfaceTable(LAYERS, LAYERS);
  for (const layer of [STILL, MOVING]) broad.MapObjectToBroadPhaseLayer(layer, new Jolt.BroadPhaseLayer(layer));
  settings.mObjectLayerPairFilter = pairs;
  settings.mBroadPhaseLayerInterface = broad;
  settings.mObjectVsBroadPhaseLayerFilter = new Jolt.ObjectVsBroadPhaseLayerFilterTable(broad, LAYERS, pairs, LAYERS);
  const made = new Jolt.JoltInterface(settings);
  Jolt.destroy(settings);
  return made;
}

// One for all, since its memory does not come back. A simulation is closed before the next is made.
const world = makeWorld(), system = world.GetPhysicsSystem(), bodies = system.GetBodyInterface();

/** Adds what was made to the world that has that gravity; gives what removes it. */
function add(body, gravity, constraint) {
  const pull = new Jolt.Vec3(0, -gravity, 0);
  system.SetGravity(pull);
  Jolt.destroy(pull);
  bodies.AddBody(body.GetID(), Jolt.EActivation_Activate);
  if (constraint) system.AddConstraint(constraint);
  return () => {
    if (constraint) system.RemoveConstraint(constraint);
    bodies.RemoveBody(body.GetID());
    bodies.DestroyBody(body.GetID());
  };
}

const numbers = (v) => [v.GetX(), v.GetY(), v.GetZ()];

function sharedOf(body, stiffness) {
  const shared = new Jolt.SoftBodySharedSettings(), vertex = new Jolt.SoftBodySharedSettingsVertex();
  for (let i = 0; i < body.masses.length; i++) {
    const [x, y, z] = body.points.subarray(3 * i, 3 * i + 3), held = body.held.includes(i);
    [vertex.mPosition.x, vertex.mPosition.y, vertex.mPosition.z] = [x, y, z];
    [vertex.mVelocity.x, vertex.mVelocity.z] = [body.angularVelocity * z, -body.angularVelocity * (x - body.turnsAbout)];
    vertex.mInvMass = held ? 0 : 1 / body.masses[i];
    shared.mVertices.push_back(vertex);
  }
  for (const edge of edgesOf(body))
    shared.mEdgeConstraints.push_back(new Jolt.SoftBodySharedSettingsEdge(edge.a, edge.b, 1 / (stiffness * springStiffness(edge))));
  // The constraint is on six times the volume.
  body.tetrahedra.forEach((corners, t) => shared.mVolumeConstraints.push_back(
    new Jolt.SoftBodySharedSettingsVolume(...corners, 36 / (stiffness * volumeStiffness(body.volumes[t])))));
  shared.CalculateEdgeLengths();
  shared.CalculateVolumeConstraintVolumes();
  shared.Optimize();
  return shared;
}

function soft(body, setting) {
  const creation = new Jolt.SoftBodyCreationSettings(sharedOf(body, setting.stiffness), new Jolt.RVec3(0, 0, 0), Jolt.Quat.prototype.sIdentity(), MOVING);
  creation.mNumIterations = setting.iterations;
  creation.mLinearDamping = body.massDamping;
  creation.mAllowSleeping = false;
  creation.mUpdatePosition = true;
  const made = bodies.CreateSoftBody(creation), close = add(made, body.gravity);
  Jolt.destroy(creation);
  const motion = Jolt.castObject(made.GetMotionProperties(), Jolt.SoftBodyMotionProperties), vertices = motion.GetVertices();
  const read = (get) => {
    const found = new Float64Array(body.points.length);
    for (let i = 0; i < body.masses.length; i++) found.set(numbers(get(vertices.at(i))), 3 * i);
    return found;
  };
  return {
    close,
    step: () => world.Step(FRAME_S, 1),
    mass: sumOfInverse(vertices, body.masses.length),
    points() {
      const center = numbers(made.GetCenterOfMassPosition());
      return read((vertex) => vertex.mPosition).map((x, i) => x + center[i % 3]);
    },
    velocities: () => read((vertex) => vertex.mVelocity),
  };
}

function sumOfInverse(vertices, count) {
  let mass = 0;
  for (let i = 0; i < count; i++) {
    const inverse = vertices.at(i).mInvMass;
    if (inverse > 0) mass += 1 / inverse;
  }
  return mass;
}

function pendulum(bar, setting) {
  const shape = new Jolt.BoxShape(new Jolt.Vec3(bar.length / 2, bar.width / 2, bar.width / 2), 0);
  const turn = Jolt.Quat.prototype.sRotation(new Jolt.Vec3(0, 0, 1), bar.amplitude - Math.PI / 2);
  const start = new Jolt.RVec3(bar.arm * Math.sin(bar.amplitude), -bar.arm * Math.cos(bar.amplitude), 0);
  const creation = new Jolt.BodyCreationSettings(shape, start, turn, Jolt.EMotionType_Dynamic, MOVING);
  creation.mOverrideMassProperties = Jolt.EOverrideMassProperties_CalculateInertia;
  creation.mMassPropertiesOverride.mMass = bar.mass;
  creation.mLinearDamping = creation.mAngularDamping = 0;
  creation.mAllowSleeping = false;
  const body = bodies.CreateBody(creation), hook = new Jolt.PointConstraintSettings(); // at the origin of the world
  const close = add(body, bar.gravity, hook.Create(Jolt.Body.prototype.sFixedToWorld, body));
  Jolt.destroy(creation);
  return {
    close,
    step: () => world.Step(FRAME_S, setting.steps),
    mass: 1 / body.GetMotionProperties().GetInverseMass(),
    center: () => numbers(body.GetCenterOfMassPosition()),
  };
}

const settings = [1, 2, 5, 10, 20, 40, 80].map((iterations) => ({ name: `${iterations} iterations`, iterations, recommended: iterations === 5 }));

export default {
  name: 'Jolt', package: 'jolt-physics', soft, pendulum,
  stiffness: { by: 'springs', load: 0.1, first: 1 },
  settings: { beam: settings, spin: settings, pendulum: [1, 2, 4, 8, 16, 32].map((steps) => ({ name: `${steps} steps`, steps, recommended: steps === 1 })) },
  reference: { beam: 'springs', spin: 'springs' }, // in single precision its finest settings fall too slowly
};
