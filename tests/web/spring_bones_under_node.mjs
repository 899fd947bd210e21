// spring_bones_under_node.mjs FILE.glb POSES.json RATE [back] [rigid]: the swinging chains of a glTF file as @pixiv/three-vrm-springbone moves them. POSES.json has for each
// frame the world position and the rotation from rest of every node that no chain moves, by name. Prints the world positions of all nodes, by frame and name.
// back: the file faces -Z and is turned, as viewers turn VRM 0.x. rigid: bones keep their length, as VRMC_springBone has it; three-vrm measures it in each
// frame from the end of the bone as it was a frame before.
import { readFileSync } from 'node:fs';
import * as THREE from 'three';
import { GLTFLoader } from 'three/addons/loaders/GLTFLoader.js';
import { VRMSpringBoneLoaderPlugin } from '@pixiv/three-vrm-springbone';

globalThis.self ??= globalThis;
const [file, poses, rate, ...words] = process.argv.slice(2);
const frames = JSON.parse(readFileSync(poses, 'utf8'));
const bytes = readFileSync(file);
const loader = new GLTFLoader();
loader.register((parser) => new VRMSpringBoneLoaderPlugin(parser));
const gltf = await new Promise((resolve, reject) =>
  loader.parse(bytes.buffer.slice(bytes.byteOffset, bytes.byteOffset + bytes.length), '', resolve, reject));
const springs = gltf.userData.vrmSpringBoneManager;
const scene = new THREE.Scene();
scene.add(gltf.scene);
if (words.includes('back')) gltf.scene.rotation.y = Math.PI;
scene.updateMatrixWorld(true);

const nodes = new Map(), rest = new Map();
gltf.scene.traverse((node) => {
  if (!nodes.has(node.userData.name ?? node.name)) nodes.set(node.userData.name ?? node.name, node);
  rest.set(node, node.getWorldQuaternion(new THREE.Quaternion()));
});

function place(frame) {
  gltf.scene.traverse((node) => {
    const pose = frame[node.userData.name ?? node.name];
    if (pose) {
      const rotation = new THREE.Quaternion(...pose.slice(3)).multiply(rest.get(node));
      const world = new THREE.Matrix4().compose(new THREE.Vector3(...pose.slice(0, 3)), rotation, new THREE.Vector3(1, 1, 1));
      world.premultiply(node.parent.matrixWorld.clone().invert());
      world.decompose(node.position, node.quaternion, new THREE.Vector3());
      node.updateMatrix();
    }
    node.updateWorldMatrix(false, false);
  });
}

for (const joint of words.includes('rigid') ? springs.joints : []) {
  const length = joint.initialLocalChildPosition.length();
  joint._calcWorldSpaceBoneLength = () => { joint._worldSpaceBoneLength = length; };
}

const found = [];
frames.forEach((frame, i) => {
  place(frame);
  if (i === 0) springs.reset();
  else springs.update(1 / Number(rate));
  scene.updateMatrixWorld(true);
  found.push(Object.fromEntries([...nodes].map(([name, node]) => [name, node.getWorldPosition(new THREE.Vector3()).toArray()])));
});
console.log(JSON.stringify({ joints: springs.joints.size, frames: found }));
