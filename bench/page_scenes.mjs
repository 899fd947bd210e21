// Steps the exported page's lizard through what a visitor does to it; prints each scene's costs as one line of JSON.
// Usage: node page_scenes.mjs CHROMIUM.MJS FOLDER-OF-NODE_MODULES PAGE WINDOWS
//
// Costs are processor time of the page's own thread, in windows of half a second of physics; nothing is drawn meanwhile.
import { pathToFileURL } from 'node:url';

const [driver, modules, page, windows] = process.argv.slice(2);
const { open } = await import(pathToFileURL(driver));
const WINDOW = 30;
const { tab, faults, close } = await open(modules, '.');
const session = await tab.context().newCDPSession(tab);
await session.send('Performance.enable', { timeDomain: 'threadTicks' });
await tab.goto(pathToFileURL(page).href);
await tab.waitForFunction(() => globalThis.viewer?.time > 0.2);
await tab.evaluate(() => {
  viewer.pause();
  viewer.draw = () => {};
  viewer.begin = (settle) => {
    viewer.keys.clear();
    viewer.each = () => {};
    viewer.restart();
    viewer.camera.focus = viewer.subject;
    for (let i = 0; i < settle; i++) viewer.step(1 / 60);
  };
});

const spent = async () => (await session.send('Performance.getMetrics')).metrics.find((one) => one.name === 'ThreadTime').value;
/** Milliseconds a tick: the mean of all windows, and the dearest. */
async function cost() {
  const found = [];
  for (let w = 0; w < Number(windows); w++) {
    const before = await spent();
    await tab.evaluate((count) => {
      for (let i = 0; i < count; i++) {
        viewer.each(i);
        viewer.step(1 / 60);
      }
    }, WINDOW);
    found.push(1000 * (await spent() - before) / WINDOW);
  }
  return { mean: found.reduce((sum, one) => sum + one, 0) / found.length, most: Math.max(...found) };
}

const SCENES = {
  walks: () => { viewer.begin(30); viewer.keys.add('KeyW'); },
  'knocked over': () => { viewer.begin(30); viewer.character.fall(); },
  'hit by a ball': () => { viewer.begin(30); viewer.throwBall(); },
  dragged: () => {
    viewer.begin(30);
    const box = viewer.canvas.getBoundingClientRect();
    for (let y = 0.3; y < 0.8 && !viewer.held; y += 0.02)
      for (let x = 0.4; x < 0.6 && !viewer.held; x += 0.02) viewer.grab(...viewer.grip = [box.left + x * box.width, box.top + y * box.height]);
    if (!viewer.held) throw new Error('nothing was there to be dragged');
    let tick = 0;
    viewer.each = () => viewer.dragTo(viewer.grip[0] + 150 * Math.sin(tick++ / 20), viewer.grip[1] - 150);
  },
};
const scenes = {};
for (const [name, begin] of Object.entries(SCENES)) {
  await tab.evaluate(`(${begin})()`);
  scenes[name] = await cost();
  if (!await tab.evaluate(() => viewer.character.health().valid)) faults.push(`${name}: a body is inside out`);
}
const browser = tab.context().browser()?.version() ?? await tab.evaluate(() => navigator.userAgent.match(/Chrome\/([\d.]+)/)[1]);
await close();
console.log(JSON.stringify({ scenes, browser, faults }));
