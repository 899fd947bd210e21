// Opens the page of examples/three from disk and uses it like a visitor. Prints the results as one line of JSON.
// Usage: node three_page_in_chromium.mjs FOLDER-OF-NODE_MODULES PAGE PICTURES
import { pathToFileURL } from 'node:url';

import { colorsDrawn, open } from './chromium.mjs';

const [modules, page, pictures] = process.argv.slice(2);
const { tab, faults, expect, shoot, close } = await open(modules, pictures); // faults: errors, and requests of anything but files and data
const files = [];
tab.on('request', (asked) => asked.url().startsWith('file:') && files.push(asked.url()));
await tab.goto(pathToFileURL(page).href);
await tab.waitForFunction(() => globalThis.stage?.world.ticks > 20);
await shoot('three-page');
await tab.evaluate(() => { stage.painter = { gl: stage.renderer.getContext() }; });
const colors = await colorsDrawn(tab, 'stage');
expect(colors > 60, `the picture has ${colors} colours`);
expect(files.length === 1, `the page asks for other files: ${files.slice(1)}`);

/** Where the character is in the world and, in halves of the picture, off the picture's middle; its lowest point. */
const look = () => tab.evaluate(() => {
  const { shown, camera, character, controls } = stage, low = [Infinity, Infinity, Infinity], high = low.map((one) => -one);
  for (const mesh of shown.children)
    mesh.geometry.attributes.position.array.forEach((one, i) => {
      low[i % 3] = Math.min(low[i % 3], one + character.origin[i % 3]);
      high[i % 3] = Math.max(high[i % 3], one + character.origin[i % 3]);
    });
  const at = low.map((one, i) => (one + high[i]) / 2), { x, y } = controls.target.clone().fromArray(at).project(camera);
  return { at, off: Math.hypot(x, y), walked: character.distance, lowest: low[1] };
});
const before = await look();
await tab.waitForFunction((walked) => stage.character.distance > walked + 0.3, before.walked);
const after = await look();
expect(Math.hypot(after.at[0] - before.at[0], after.at[2] - before.at[2]) > 0.15, `it went from ${before.at} to ${after.at}`);
expect(after.off < 0.2, `the camera does not follow: it is ${after.off} off the middle`);
expect(Math.abs(after.lowest) < 0.03, `its lowest point is at ${after.lowest} m`);

// three.js' own bounds go with it.
const bounds = await tab.evaluate(async () => {
  const { Box3 } = await import('three'), { shown } = stage;
  return new Box3().setFromObject(shown).containsBox(new Box3().setFromObject(shown, true));
});
expect(bounds, "three.js' bounds of the meshes are old");

// From here on it moves where the test steps it.
await tab.evaluate(() => stage.renderer.setAnimationLoop(null));
/** Where a soft body is in the picture, in pixels, not at its edge. */
const find = () => tab.evaluate(() => {
  stage.draw();
  const { camera, world, character, renderer } = stage, { clientWidth: width, clientHeight: height } = renderer.domElement;
  const softBodyAt = (x, y) => {
    const eye = camera.position, way = eye.clone().set(2 * x / width - 1, 1 - 2 * y / height, 0.5).unproject(camera).sub(eye).normalize();
    const hit = world.ray(eye.toArray(), way.toArray(), 100);
    return hit?.character === character.id ? hit.softBody : -1;
  };
  for (let y = 100; y < height - 100; y += 10)
    for (let x = 100; x < width - 100; x += 10) {
      const softBody = softBodyAt(x, y);
      if (softBody >= 0 && [[-8, 0], [8, 0], [0, -8], [0, 8]].every(([right, down]) => softBodyAt(x + right, y + down) === softBody))
        return { x, y, softBody };
    }
  return null;
});
const angles = () => tab.evaluate(() => [stage.controls.getAzimuthalAngle(), stage.controls.getPolarAngle()]);
const place = await find();
expect(place, 'no soft body is seen');
if (place) {
  const hash = () => tab.evaluate(() => stage.world.stateHash());
  const still = await hash();
  await tab.mouse.click(place.x, place.y);
  expect(await hash() !== still, 'a click does not push it');
  const from = await angles();
  await tab.mouse.move(place.x, place.y);
  await tab.mouse.down();
  await tab.mouse.move(place.x + 40, place.y - 120, { steps: 4 });
  const force = await tab.evaluate(({ softBody }) => {
    const { world, character, step } = stage;
    for (let i = 0; i < 30; i++) step(1 / 60);
    stage.draw();
    return [...Array(4000).keys()].some((vertex) => {
      try {
        return Math.hypot(...character.grabForce(softBody, vertex)) > 0;
      } catch {
        return false;
      }
    });
  }, place);
  await shoot('three-page-pulled');
  expect(force, 'a drag does not pull it');
  await tab.mouse.up();
  const turned = (await angles()).map((one, i) => Math.abs(one - from[i]));
  expect(Math.max(...turned) < 0.01, `a drag of the character turns the view by ${turned}`);
  const there = await find() ?? place;
  await tab.mouse.dblclick(there.x, there.y);
  const posture = await tab.evaluate(() => {
    for (let i = 0; i < 10; i++) stage.step(1 / 60);
    return stage.character.posture;
  });
  expect(posture === 'falling', `after a double click its posture is ${posture}`);
}

// A drag beside it turns the view.
const [azimuth] = await angles();
await tab.mouse.move(20, 20);
await tab.mouse.down();
await tab.mouse.move(220, 20, { steps: 4 });
await tab.mouse.up();
await tab.evaluate(() => { for (let i = 0; i < 10; i++) stage.controls.update(); });
expect(Math.abs((await angles())[0] - azimuth) > 0.1, 'a drag beside it does not turn the view');

// It fits another window, and a dark one.
await tab.emulateMedia({ colorScheme: 'dark' });
await tab.setViewportSize({ width: 480, height: 720 });
const fits = () => {
  const { width, height } = stage.renderer.domElement;
  return Math.abs(width / height - 2 / 3) < 0.01 && Math.abs(stage.camera.aspect - 2 / 3) < 0.01 && stage.scene.background.getHex() === 0x242628;
};
await tab.waitForFunction(fits, undefined, { timeout: 20000 }).catch(() => expect(false, 'it does not fit a dark window of 480 x 720'));
expect(await tab.evaluate(() => document.documentElement.scrollWidth <= innerWidth && document.documentElement.scrollHeight <= innerHeight),
  'the page scrolls');
await tab.evaluate(() => stage.draw());
await shoot('three-page-dark');

// The same character in a world of its own, by the page's modules.
const hash = await tab.evaluate(async () => {
  const world = stage.sbfmt.world(), character = world.add(stage.character.model);
  character.drive(0.3, 0.2);
  for (let i = 0; i < 120; i++) world.step(1 / 60);
  return world.stateHash();
});
await close();
console.log(JSON.stringify({ hash, faults }));
