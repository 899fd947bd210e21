// TinyUSDZ, an independent reader of USD in C++, on a .usda: prints the layer to OUT, and its meshes as JSON.
import { readFileSync, writeFileSync } from 'node:fs';
import { createRequire } from 'node:module';

process.type = 'renderer'; // it is built for browsers, and looks whether this is one
globalThis.window = globalThis;
const require = createRequire(import.meta.url);
const { default: load } = await import('tinyusdz/tinyusdz.js');
const module = await load({ wasmBinary: readFileSync(require.resolve('tinyusdz/tinyusdz.wasm')), print: () => {} });
const [path, out] = process.argv.slice(2);
const read = (method) => {
  const loader = new module.TinyUSDZLoaderNative();
  if (!loader[method](readFileSync(path), 'file.usda')) throw new Error(loader.error());
  return loader;
};
writeFileSync(out, read('loadAsLayerFromBinary').layerToString());
const scene = read('loadFromBinary');
const meshes = Array.from({ length: scene.numMeshes() }, (_, i) => scene.getMesh(i));
console.log(JSON.stringify(meshes.map((mesh) => ({ path: mesh.absPath, triangles: mesh.faceVertexIndices.length / 3 }))));
