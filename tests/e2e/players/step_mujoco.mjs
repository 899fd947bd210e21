// MuJoCo on an MJCF file: compiled, and stepped for so many seconds: its counts, the quickest coordinate at the end and its warnings, as JSON.
import { readFile } from 'node:fs/promises';
import load from 'mujoco-js';

const mujoco = await load({ printErr: () => {} });
const [path, seconds] = process.argv.slice(2);
mujoco.FS.writeFile('/model.xml', await readFile(path));
const model = mujoco.MjModel.loadFromXML('/model.xml');
const data = new mujoco.MjData(model);
for (let t = 0; t < Number(seconds); t += model.opt.timestep) mujoco.mj_step(model, data);
const counts = {};
for (const name of ['nbody', 'njnt', 'nmesh', 'nflex', 'nflexvert', 'nflexelem', 'neq', 'ntendon', 'nmocap', 'nexclude', 'nsite'])
  counts[name] = model[name];
const warnings = Array.from({ length: data.warning.size() }, (_, i) => data.warning.get(i).number).reduce((a, b) => a + b, 0);
const finite = Array.from(data.qpos).every(Number.isFinite);
console.log(JSON.stringify({ counts, warnings, finite, fastest: Math.max(...Array.from(data.qvel, Math.abs)) }));
