// Opens a page of three.js and the npm package from a server: drawn, moved, and drawn where it went.
// Usage: node three_in_chromium.mjs FOLDER-OF-NODE_MODULES ADDRESS PICTURES
import { colorsDrawn, open } from './chromium.mjs';

const [modules, address, pictures] = process.argv.slice(2);
const { tab, faults, expect, shoot, close } = await open(modules, pictures, address);
await tab.goto(address);
await tab.waitForFunction(() => globalThis.stage?.shown);
await shoot('three');
const first = await colorsDrawn(tab, 'stage');
expect(first > 40, `the picture has ${first} colours`);

/** Where in the picture the character is: the middle of all pixels that are not the background's blue, from -1 to 1. */
const place = () => tab.evaluate(() => {
  stage.draw();
  const { gl } = stage.painter, { width, height } = gl.canvas, pixels = new Uint8Array(4 * width * height);
  gl.readPixels(0, 0, width, height, gl.RGBA, gl.UNSIGNED_BYTE, pixels);
  let sum = 0, count = 0;
  for (let i = 0; i < width * height; i++)
    if (pixels[4 * i + 2] < 200) sum += i % width, count++;
  return { across: 2 * sum / count / width - 1, share: count / width / height };
});
const before = await place();
const sbfz = await tab.evaluate(() => stage.walk(120));
await shoot('three-walked');
const after = await place();
expect(before.share > 0.02 && before.share < 0.6, `the character covers ${before.share} of the picture`);
expect(Math.abs(after.share / before.share - 1) < 0.4, `it covered ${before.share} of the picture, then ${after.share}`);
expect(Math.abs(after.across - before.across) > 0.1, `it stays in the picture at ${before.across}, ${after.across}`);
const hashes = { sbfz };
for (const form of ['glb', 'gltf']) {
  const loaded = await tab.evaluate((file) => stage.load(file), `lizard.${form}`);
  await shoot(`three-${form}`);
  hashes[form] = loaded.hash;
  expect(loaded.still.length > 0 && !loaded.still.includes(true), `of .${form}, still meshes are visible: ${loaded.still}`);
  expect(loaded.materials, `of .${form}, a mesh lacks the file's materials`);
}
const plain = await tab.evaluate(() => stage.load('plain.glb').then(() => 'a character', (error) => error.message));
expect(/softCharacter|undefined/.test(plain), `a .glb without soft bodies gave ${plain}`);
await close();
console.log(JSON.stringify({ ...hashes, faults }));
