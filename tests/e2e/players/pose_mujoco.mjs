// MuJoCo on an MJCF file, posed: for each set of joint values in a JSON file, where every body is and how it is turned, as JSON.
import { readFile } from 'node:fs/promises';
import load from 'mujoco-js';

const mujoco = await load({ printErr: () => {} });
const [path, poses] = process.argv.slice(2);
mujoco.FS.writeFile('/model.xml', await readFile(path));
const model = mujoco.MjModel.loadFromXML('/model.xml');
const data = new mujoco.MjData(model);
const name = (kind, i) => mujoco.mj_id2name(model, mujoco.mjtObj[kind].value, i);
const joints = Object.fromEntries(Array.from({ length: model.njnt }, (_, i) => [name('mjOBJ_JOINT', i), i]));
const answers = [];
for (const pose of JSON.parse(await readFile(poses, 'utf8'))) {
  for (const [joint, value] of Object.entries(pose)) data.qpos[model.jnt_qposadr[joints[joint]]] = value;
  mujoco.mj_forward(model, data);
  answers.push(Object.fromEntries(Array.from({ length: model.nbody }, (_, i) => [name('mjOBJ_BODY', i),
    { position: Array.from(data.xpos.slice(3 * i, 3 * i + 3)), rotation: Array.from(data.xquat.slice(4 * i, 4 * i + 4)) }])));
}
console.log(JSON.stringify(answers));
