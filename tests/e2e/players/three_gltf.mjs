// What three.js shows of a file's last animation, the motion where there is one, at a time in seconds: for each mesh its vertices at rest and where they
// are then; without a time, as the file was saved.
import fs from "node:fs";
import * as THREE from "three";
import { GLTFLoader } from "three/examples/jsm/loaders/GLTFLoader.js";

const [path, time] = process.argv.slice(2);
const file = fs.readFileSync(path);
const gltf = await new GLTFLoader().parseAsync(file.buffer.slice(file.byteOffset, file.byteOffset + file.length), "");
const mixer = new THREE.AnimationMixer(gltf.scene);
if (time !== undefined && gltf.animations.length) mixer.clipAction(gltf.animations.at(-1)).play();
if (time !== undefined) mixer.setTime(Number(time));
gltf.scene.updateMatrixWorld(true);
const meshes = [];
const joints = new Set();
gltf.scene.traverse((object) => {
  if (!object.isMesh) return;
  if (object.isSkinnedMesh) {
    object.skeleton.update();
    object.skeleton.bones.forEach((bone) => joints.add(bone.uuid));
  }
  const positions = object.geometry.attributes.position;
  const rest = [];
  const now = [];
  const at = new THREE.Vector3();
  for (let i = 0; i < positions.count; i++) {
    rest.push([positions.getX(i), positions.getY(i), positions.getZ(i)]);
    now.push(object.getVertexPosition(i, at).applyMatrix4(object.matrixWorld).toArray());
  }
  meshes.push({ name: object.name, triangles: (object.geometry.index ?? positions).count / 3, rest, now });
});
console.log(JSON.stringify({ meshes, joints: joints.size, animations: gltf.animations.map((one) => one.name) }));
