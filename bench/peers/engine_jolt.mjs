// Jolt, by jolt-physics. Its soft bodies have no elements: springs along the edges, and the volume of each tetrahedron, both by
// compliance in SI units. `stiffness` scales the springs and volumes that stand for the material.
import initialize from 'jolt-physics';
import { FRAME_S, edgesOf, springStiffness, volumeStiffness } from './cases.mjs';
import { forHung, turnOf } from './engine_parts.mjs';

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

function setGravity(gravity) {
  const pull = new Jolt.Vec3(0, -gravity, 0);
  system.SetGravity(pull);
  Jolt.destroy(pull);
}

function remove(body) {
  bodies.RemoveBody(body.GetID());
  bodies.DestroyBody(body.GetID());
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
  setGravity(body.gravity);
  const creation = new Jolt.SoftBodyCreationSettings(sharedOf(body, setting.stiffness), new Jolt.RVec3(0, 0, 0), Jolt.Quat.prototype.sIdentity(), MOVING);
  creation.mNumIterations = setting.iterations;
  creation.mLinearDamping = body.massDamping;
  creation.mAllowSleeping = false;
  creation.mUpdatePosition = true;
  const made = bodies.CreateSoftBody(creation);
  Jolt.destroy(creation);
  bodies.AddBody(made.GetID(), Jolt.EActivation_Activate);
  const motion = Jolt.castObject(made.GetMotionProperties(), Jolt.SoftBodyMotionProperties), vertices = motion.GetVertices();
  const read = (get) => {
    const found = new Float64Array(body.points.length);
    for (let i = 0; i < body.masses.length; i++) found.set(numbers(get(vertices.at(i))), 3 * i);
    return found;
  };
  return {
    step: () => world.Step(FRAME_S, 1),
    close: () => remove(made),
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

function makeLink({ mass, length, width, start }, angle) {
  const shape = new Jolt.BoxShape(new Jolt.Vec3(length / 2, width / 2, width / 2), 0);
  const creation = new Jolt.BodyCreationSettings(shape, new Jolt.RVec3(...start), new Jolt.Quat(...turnOf(angle)), Jolt.EMotionType_Dynamic, MOVING);
  creation.mOverrideMassProperties = Jolt.EOverrideMassProperties_CalculateInertia;
  creation.mMassPropertiesOverride.mMass = mass;
  creation.mLinearDamping = creation.mAngularDamping = 0;
  creation.mAllowSleeping = false;
  const body = bodies.CreateBody(creation);
  Jolt.destroy(creation);
  bodies.AddBody(body.GetID(), Jolt.EActivation_Activate);
  return body;
}

function chain({ links, angle, gravity }, setting) {
  setGravity(gravity);
  const made = links.map((link) => makeLink(link, angle));
  const joints = made.map((body, i) => {
    const joint = new Jolt.PointConstraintSettings(), { start, length } = links[i];
    const point = [start[0] - Math.sin(angle) * length / 2, start[1] + Math.cos(angle) * length / 2, 0];
    joint.mPoint1 = joint.mPoint2 = new Jolt.RVec3(...point);
    return joint.Create(i ? made[i - 1] : Jolt.Body.prototype.sFixedToWorld, body);
  });
  joints.forEach((joint) => system.AddConstraint(joint));
  return {
    step: () => world.Step(FRAME_S, setting.steps),
    close() {
      joints.forEach((joint) => system.RemoveConstraint(joint));
      made.forEach(remove);
    },
    mass: made.reduce((sum, body) => sum + 1 / body.GetMotionProperties().GetInverseMass(), 0),
    poses: () => made.map((body) => ({ center: numbers(body.GetCenterOfMassPosition()), along: numbers(body.GetRotation().RotateAxisX()) })),
  };
}

const settings = [1, 2, 5, 10, 20, 40, 80].map((iterations) => ({ name: `${iterations} iterations`, iterations, recommended: iterations === 5 }));

export default {
  name: 'Jolt', package: 'jolt-physics', soft, chain,
  stiffness: { by: 'springs', load: 0.1, first: 1 },
  settings: { beam: settings, spin: settings, ...forHung([1, 2, 4, 8, 16, 32].map((steps) => ({ name: `${steps} steps`, steps, recommended: steps === 1 }))) },
  reference: { beam: 'springs', spin: 'springs' }, // in single precision its finest settings fall too slowly
};
