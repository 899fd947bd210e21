// Opens the pages of docs/web.md from a server: the first prints the distance walked, in the second three.js draws a moving lizard.
// Usage: node document_in_chromium.mjs FOLDER-OF-NODE_MODULES ADDRESS PICTURES
import { open } from './chromium.mjs';

const [modules, address, pictures] = process.argv.slice(2);
const { tab, faults, expect, shoot, close } = await open(modules, pictures, address);
await tab.goto(`${address}index.html`);
await tab.waitForFunction(() => /^walked (0\.[3-9]|[1-9])/.test(document.body.textContent));

await tab.goto(`${address}three.html`);
/** Of the picture as the browser shows it: its colours, and how much of it is not the background's. */
const seen = async (name) => {
  await shoot(name);
  const picture = (await tab.screenshot()).toString('base64');
  return tab.evaluate(async (bytes) => {
    const image = await createImageBitmap(await (await fetch(`data:image/png;base64,${bytes}`)).blob());
    const canvas = new OffscreenCanvas(image.width, image.height), context = canvas.getContext('2d');
    context.drawImage(image, 0, 0);
    const { data } = context.getImageData(0, 0, image.width, image.height), colors = new Set();
    let covered = 0, across = 0;
    for (let i = 0; i < data.length; i += 4) {
      colors.add((data[i] >> 4) << 8 | (data[i + 1] >> 4) << 4 | data[i + 2] >> 4);
      if (Math.abs(data[i] - data[0]) + Math.abs(data[i + 1] - data[1]) + Math.abs(data[i + 2] - data[2]) < 24) continue;
      covered++;
      across += i / 4 % image.width / image.width;
    }
    return { colors: colors.size, share: covered / (image.width * image.height), across: across / covered };
  }, picture);
};
await tab.waitForSelector('canvas');
await tab.waitForTimeout(500);
const before = await seen('document-three');
expect(before.colors > 30 && before.share > 0.02 && before.share < 0.7, `three.html shows ${JSON.stringify(before)}`);
await tab.waitForTimeout(3000);
const after = await seen('document-three-later');
expect(Math.abs(after.across - before.across) > 0.005 || Math.abs(after.share / before.share - 1) > 0.02,
  `in three.html nothing moves: ${JSON.stringify([before, after])}`);
await close();
console.log(JSON.stringify({ faults }));
