// MuJoCo, by @mujoco/mujoco: a flex of the same tetrahedra, Saint Venant-Kirchhoff, each point a body on three slides.
import load from '@mujoco/mujoco';
import { FRAME_S } from './cases.mjs';
import { forHung } from './engine_parts.mjs';

const mujoco = await load();
const VECTOR = '0 0 0';

const list = (numbers) => Array.from(numbers, (x) => +x.toPrecision(12)).join(' ');

/** +Y up is given by gravity alone. */
function optionText(gravity, setting) {
  return `<option timestep="${FRAME_S / setting.steps}" integrator="${setting.integrator}" gravity="0 ${-gravity} 0"><flag contact="disable" autoreset="disable"/></option>`;
}

function flexText(body, setting) {
  const bodies = Array.from(body.masses, (mass, i) => {
    const slides = body.held.includes(i) ? '' : ['1 0 0', '0 1 0', '0 0 1'].map((axis) => `<joint type="slide" axis="${axis}" damping="${body.massDamping * mass}"/>`).join('');
    return `<body name="p${i}" pos="${list(body.points.subarray(3 * i, 3 * i + 3))}"><inertial pos="${VECTOR}" mass="${mass}" diaginertia="1e-6 1e-6 1e-6"/>${slides}</body>`;
  });
  return `<mujoco>${optionText(body.gravity, setting)}<size memory="200M"/><worldbody>${bodies.join('\n')}</worldbody>
<deformable><flex name="bar" dim="3" radius="0.001" body="${bodies.map((_, i) => `p${i}`).join(' ')}" vertex="${bodies.map(() => VECTOR).join(' ')}" element="${body.tetrahedra.flat().join(' ')}">
<contact internal="false" selfcollide="none" contype="0" conaffinity="0"/><elasticity young="${setting.stiffness * body.young}" poisson="${body.poisson}" damping="0"/></flex></deformable></mujoco>`;
}

function simulation(text, setting) {
  const model = mujoco.MjModel.from_xml_string(text), data = new mujoco.MjData(model);
  return {
    model, data,
    step() {
      for (let i = 0; i < setting.steps; i++) mujoco.mj_step(model, data);
    },
    close: () => [data, model].forEach((thing) => thing.delete()),
  };
}

function soft(body, setting) {
  const { model, data, step, close } = simulation(flexText(body, setting), setting), { length } = body.masses;
  const free = Array.from({ length }, (_, i) => i).filter((i) => !body.held.includes(i));
  const speed = (i) => [body.angularVelocity * body.points[3 * i + 2], 0, -body.angularVelocity * (body.points[3 * i] - body.turnsAbout)];
  free.forEach((i, place) => data.qvel.set(speed(i), 3 * place));
  mujoco.mj_forward(model, data);
  return {
    step, close,
    mass: free.reduce((sum, i) => sum + model.body_mass[i + 1], 0),
    points() {
      const found = Float64Array.from(body.points);
      free.forEach((i, place) => [0, 1, 2].forEach((k) => (found[3 * i + k] += data.qpos[3 * place + k])));
      return found;
    },
    velocities() {
      const found = new Float64Array(body.points.length);
      free.forEach((i, place) => found.set(data.qvel.subarray(3 * place, 3 * place + 3), 3 * i));
      return found;
    },
  };
}

/** Ball joints are MuJoCo's own coordinates: they cannot come apart. */
function linkText(links, i, angle) {
  if (i === links.length) return '';
  const { mass, moments, length } = links[i], at = i ? `pos="${links[i - 1].length} 0 0"` : `euler="0 0 ${(angle - Math.PI / 2) * 180 / Math.PI}"`;
  return `<body ${at}><joint type="ball"/><inertial pos="${length / 2} 0 0" mass="${mass}" diaginertia="${list(moments)}"/>${linkText(links, i + 1, angle)}</body>`;
}

function chain({ links, angle, gravity }, setting) {
  const { model, data, step, close } = simulation(`<mujoco>${optionText(gravity, setting)}<worldbody>${linkText(links, 0, angle)}</worldbody></mujoco>`, setting);
  return {
    step, close,
    mass: links.reduce((sum, _, i) => sum + model.body_mass[i + 1], 0),
    poses() {
      mujoco.mj_kinematics(model, data); // of where it is now: a step leaves that of its beginning
      return links.map((_, i) => ({ center: Array.from(data.xipos.subarray(3 * i + 3, 3 * i + 6)), along: [0, 3, 6].map((k) => data.xmat[9 * i + 9 + k]) }));
    },
  };
}

const by = (integrator, recommended, ...counts) => counts.map((steps) => ({ name: `${integrator} ${steps} steps`, integrator, steps, recommended: steps === recommended }));
// `discrete` integrates a flex implicitly; 8 steps a frame are its default step of 2 ms.
const settings = [...by('discrete', 8, 1, 2, 4, 8, 16), ...by('Euler', 0, 8, 16, 32, 64), ...by('RK4', 0, 16, 32)];
const [finest] = by('RK4', 0, 64);

export default {
  name: 'MuJoCo', package: '@mujoco/mujoco', soft, chain,
  // With Poisson's ratio 0 the beam sags as linear elements do within 2e-5; with 0.3 it sags by a tenth less.
  stiffness: { by: settings[0], load: 0.1, first: 0.9 },
  settings: { beam: settings, spin: settings, ...forHung([...by('implicitfast', 8, 1, 2, 4, 8, 16, 32), ...by('RK4', 0, 1, 2, 4, 8)]) },
  reference: { beam: finest, spin: finest },
};
