// Opens pages of several characters, one after another: drawn, worn, at each of their levels, and in the same state as elsewhere.
// Usage: node pages_in_chromium.mjs FOLDER-OF-NODE_MODULES PICTURES PAGES, these as JSON: [{ name, page, frames, drive, levels, colors }]
import { pathToFileURL } from 'node:url';

import { colorsDrawn, open } from './chromium.mjs';

const [modules, pictures, pages] = process.argv.slice(2);
const { tab, faults, expect, shoot, close } = await open(modules, pictures);
const hashes = {};
for (const { name, page, frames, drive, levels, colors } of JSON.parse(pages)) {
  await tab.goto(pathToFileURL(page).href);
  await tab.waitForFunction(() => globalThis.viewer?.time > 0.1);
  await tab.evaluate(() => viewer.pause());
  await shoot(`of-${name}`);
  const seen = await colorsDrawn(tab, 'viewer');
  expect(seen > 40, `${name}: the picture has ${seen} colours`);
  hashes[name] = await tab.evaluate(([count, way]) => viewer.hashAfter(count, way), [frames, drive]);

  // Every level that the file has can be chosen and stepped; the panel offers no other.
  const { offered, detailLevels } = await tab.evaluate(() => {
    const values = Array.from(document.querySelector('#level').options, (one) => one.value), number = /^\d+$/;
    return { offered: values.filter((one) => number.test(one)).length, detailLevels: values.filter((one) => !number.test(one)) };
  });
  expect(offered === levels, `${name}: the panel offers ${offered} levels of ${levels}`);
  for (let level = 1; level < levels; level++) {
    await tab.selectOption('#level', String(level));
    const went = await tab.evaluate(() => {
      for (let i = 0; i < 30; i++) viewer.step(1 / 60);
      viewer.draw();
      return { level: viewer.choices.level, valid: viewer.character.health().valid };
    });
    expect(went.level === level && went.valid, `${name}: at level ${level} ${JSON.stringify(went)}`);
  }
  // And the detail levels that the runtime makes of it, below those.
  for (const detailLevel of detailLevels) {
    await tab.selectOption('#level', detailLevel);
    const went = await tab.evaluate(() => {
      for (let i = 0; i < 60; i++) viewer.step(1 / 60);
      viewer.draw();
      return { kind: viewer.model.detailLevels[viewer.character.detailLevel].kind, valid: viewer.character.health().valid };
    });
    expect(went.kind === detailLevel && went.valid, `${name}: on the detailLevel ${detailLevel} ${JSON.stringify(went)}`);
  }
  const made = await tab.evaluate(() => (viewer.asset.bones.length ? viewer.asset.model({ detailLevels: true }).detailLevels : []).map(({ kind }) => kind).filter((kind) => /jiggle|bones/.test(kind)));
  expect(String(detailLevels) === String(made), `${name}: the panel offers ${detailLevels}, the runtime has ${made}`);

  // The interior can be shown only if there is one.
  const inside = await tab.evaluate(() => {
    viewer.choices.level = 0;
    viewer.restart();
    const lines = viewer.character.lines(), kinds = Array.from({ length: lines.length / 10 }, (_, i) => lines[10 * i + 3]);
    return { springs: kinds.some((kind) => kind < 5), lattice: kinds.includes(5), bones: viewer.asset.bones.length > 0 };
  });
  for (const [id, there] of Object.entries(inside)) expect(await tab.isDisabled(`#${id}`) === !there, `${name}: the switch of ${id}, of which there ${there ? 'are' : 'are none'}`);

  // The image of a texture is on the skin, upright: above and below the middle of the picture have its colours, lit.
  if (colors) {
    const seen = await tab.evaluate(() => {
      viewer.restart({ kind: 'flat' });
      viewer.frameCamera();
      viewer.draw();
      const { gl } = viewer.painter, one = new Uint8Array(4);
      return [0.6, 0.2].map((share) => {
        gl.readPixels(gl.canvas.width >> 1, Math.round(share * gl.canvas.height), 1, 1, gl.RGBA, gl.UNSIGNED_BYTE, one);
        return [...one];
      });
    });
    colors.forEach((color, k) => {
      const most = color.indexOf(Math.max(...color));
      expect([0, 1, 2].every((i) => i === most || seen[k][i] < 0.6 * seen[k][most]), `${name}: it shows ${seen[k]} where the image has ${color}`);
    });
  }
}
await close();
console.log(JSON.stringify({ hashes, faults }));
