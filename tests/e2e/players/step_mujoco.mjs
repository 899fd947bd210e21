// MuJoCo on an MJCF file: compiled, and stepped for so many seconds: its counts, the greatest speed of any
// coordinate at any time, that over what falling gives by then, the most touches at once, who touches whom and its warnings, as JSON.
import { readFile } from 'node:fs/promises';
import load from 'mujoco-js';

const mujoco = await load({ printErr: () => {} });
const [path, seconds] = process.argv.slice(2);
mujoco.FS.writeFile('/model.xml', await readFile(path));
const model = mujoco.MjModel.loadFromXML('/model.xml');
const data = new mujoco.MjData(model);
const hull = geom => mujoco.mj_id2name(model, mujoco.mjtObj.mjOBJ_BODY.value, model.geom_bodyid[geom]);
const flex = number => mujoco.mj_id2name(model, mujoco.mjtObj.mjOBJ_FLEX.value, number);
const pairs = new Set();
let fastest = 0, falls = 0, touches = 0;
for (let t = 0; t < Number(seconds); t += model.opt.timestep) {
  mujoco.mj_step(model, data);
  const speed = Array.from(data.qvel).reduce((most, v) => Math.max(most, Math.abs(v)), 0); // NaN once it is one
  fastest = Math.max(fastest, speed);
  falls = Math.max(falls, speed / (9.81 * data.time));
  touches = Math.max(touches, data.ncon);
  const contacts = data.contact; // copies, which nobody else frees
  for (let i = 0; i < data.ncon; i++) {
    const contact = contacts.get(i), { geom, flex: soft } = contact;
    pairs.add([0, 1].map(side => geom[side] < 0 ? flex(soft[side]) : hull(geom[side])).sort().join(' '));
    contact.delete();
  }
  contacts.delete();
}
const counts = {};
for (const name of ['nbody', 'njnt', 'nmesh', 'nflex', 'nflexvert', 'nflexelem', 'neq', 'ntendon', 'nmocap', 'nexclude', 'nsite'])
  counts[name] = model[name];
const warnings = Array.from({ length: data.warning.size() }, (_, i) => data.warning.get(i).number).reduce((a, b) => a + b, 0);
const finite = Array.from(data.qpos).every(Number.isFinite);
console.log(JSON.stringify({ counts, warnings, finite, fastest, falls, touches, pairs: [...pairs].sort() }));
