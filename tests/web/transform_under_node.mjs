// glTF Transform edits a .glb with soft bodies. Prints the result of each edit.
// Usage: node transform_under_node.mjs IN.glb, in a project with sbfmt and @gltf-transform
import { NodeIO } from '@gltf-transform/core';
import { dedup, prune, quantize } from '@gltf-transform/functions';
import { KHRMeshQuantization } from '@gltf-transform/extensions';
import { SBFSoftBody } from 'sbfmt/gltf-transform';

const [file] = process.argv.slice(2);
const io = new NodeIO().registerExtensions([SBFSoftBody, KHRMeshQuantization]);
const edits = {
  same: () => undefined,
  renumbered: async (document) => { // a node before all others, a material and a scene of its own; equal lists merged
    const root = document.getRoot(), nodes = root.listNodes();
    for (const scene of root.listScenes()) scene.addChild(document.createNode('light'));
    root.listMaterials().at(-1).setRoughnessFactor(0.25);
    document.createScene('empty');
    nodes[0].setExtras({ edited: true });
    await document.transform(dedup(), prune({ keepAttributes: true, keepLeaves: true }));
  },
  moved: (document) => {
    const positions = document.getRoot().listMeshes()[0].listPrimitives()[0].getAttribute('POSITION');
    positions.setElement(0, positions.getElement(0, []).map((x) => x + 0.01));
  },
  quantized: (document) => document.transform(quantize()),
  removed: (document) => document.getRoot().listMeshes()[0].dispose(),
};
const outcome = {};
for (const [name, edit] of Object.entries(edits)) {
  try {
    const document = await io.read(file);
    await edit(document);
    await io.write(`${name}.glb`, document);
    outcome[name] = 'written';
  } catch (error) {
    outcome[name] = error.message;
  }
}
const unaware = new NodeIO();
await unaware.write('unaware.glb', await unaware.read(file));
console.log(JSON.stringify(outcome));
