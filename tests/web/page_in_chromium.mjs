// Opens the exported page and uses it like a visitor. Prints the results as one line of JSON.
// Usage: node page_in_chromium.mjs FOLDER-OF-NODE_MODULES PAGE PICTURES RUN
import { readFileSync } from 'node:fs';
import { pathToFileURL } from 'node:url';

import { colorsDrawn, open } from './chromium.mjs';

const [modules, page, pictures, run] = process.argv.slice(2);
const { tab, faults, expect, shoot, close } = await open(modules, pictures);
await tab.goto(pathToFileURL(page).href);
await tab.waitForFunction(() => globalThis.viewer?.time > 0.2);

// It is drawn: the lizard's middle is not the ground's colour.
await shoot('page');
const seen = await colorsDrawn(tab, 'viewer');
expect(seen > 60, `the picture has ${seen} colours`);

// It walks while a key is down, and stands when it is not.
await tab.focus('#canvas');
await tab.keyboard.down('w');
await tab.waitForFunction(() => viewer.character.distance > 0.15);
await shoot('walking');
await tab.keyboard.up('w');
expect(await tab.evaluate(() => viewer.keys.size === 0), 'a key that was let go still steers');

// The keyboard reaches everything, and one sees where it is.
await tab.focus('#canvas');
const reached = [];
for (let i = 0; i < 16; i++) {
  reached.push(await tab.evaluate(() => {
    const at = document.activeElement, style = getComputedStyle(at);
    return { id: at.id, outline: style.outlineStyle !== 'none' && parseFloat(style.outlineWidth) >= 2,
      label: at.labels?.[0]?.textContent.trim() || at.getAttribute('aria-label') || at.textContent.trim() };
  }));
  await tab.keyboard.press('Tab');
}
for (const id of ['canvas', 'skin', 'springs', 'bones', 'strain', 'ground', 'level', 'speed', 'throw', 'knock', 'restart', 'pause', 'open']) {
  const here = reached.find((one) => one.id === id);
  expect(here, `the keyboard does not reach ${id}`);
  expect(!here || here.outline, `${id} does not show that it has the focus`);
  expect(!here || here.label, `${id} has no label`);
}
const yaw = await tab.evaluate(() => viewer.camera.yaw);
await tab.focus('#canvas');
await tab.keyboard.press('ArrowLeft');
await tab.keyboard.press('+');
expect(await tab.evaluate((before) => viewer.camera.yaw !== before, yaw), 'arrows do not turn the view');
for (const id of ['springs', 'bones']) {
  await tab.focus(`#${id}`);
  await tab.keyboard.press('Space');
}
expect(await tab.evaluate(() => viewer.show.springs && viewer.show.bones), 'the space bar does not switch springs and bones');
await tab.waitForTimeout(500);
await shoot('inside');
await tab.uncheck('#springs');
await tab.uncheck('#bones');
await tab.check('#strain');
await tab.waitForTimeout(500);
await shoot('strain');
await tab.uncheck('#strain');

// Balls fly, hit, and come back.
await tab.focus('#throw');
await tab.keyboard.press('Enter');
expect(await tab.evaluate(() => viewer.balls.length === 1), 'the button throws no ball');
const ball = await tab.evaluate(() => {
  viewer.pause();
  viewer.restart();
  for (let i = 0; i < 30; i++) viewer.step(1 / 60);
  viewer.throwBall();
  for (let i = 0; i < 60; i++) viewer.step(1 / 60);
  return { hits: viewer.balls[0].hits, posture: viewer.character.posture, valid: viewer.character.health().valid };
});
expect(ball.hits > 0 && ball.posture === 'falling' && ball.valid, `a ball that is thrown: ${JSON.stringify(ball)}`);
await tab.waitForTimeout(500);
await shoot('ball');

// Physics that takes too long runs slowly, and the page says so; pictures continue. Otherwise it runs in real time.
const hurried = await tab.evaluate(async () => {
  const { draw, step } = viewer, covered = {};
  if (!viewer.paused) viewer.pause();
  const cost = (ms) => { viewer.step = () => { for (const began = performance.now(); performance.now() - began < ms;); }; };
  cost(0);
  covered.cheap = [1 / 60, 0.1, 0.25].map((seconds) => 60 * viewer.advance(seconds));
  cost(60);
  covered.dear = [1 / 60, 0.1, 0.25].map((seconds) => 60 * viewer.advance(seconds));
  viewer.draw = () => { frames++; };
  viewer.pause();
  let frames = 0;
  const pace = () => document.querySelector('#pace').textContent;
  // A busy machine draws few frames a second.
  for (const began = performance.now(); (frames < 6 || !pace().startsWith('slowed')) && performance.now() - began < 60000;)
    await new Promise((done) => setTimeout(done, 100));
  const said = pace();
  Object.assign(viewer, { draw, step });
  return { ...covered, frames, said };
});
expect([1, 6, 15].every((ticks, i) => Math.abs(hurried.cheap[i] - ticks) < 1e-6), `cheap ticks: ${JSON.stringify(hurried)}`);
expect(hurried.dear.every((ticks) => Math.abs(ticks - 1) < 1e-6), `dear ticks: ${JSON.stringify(hurried)}`);
expect(hurried.frames > 5 && /^slowed to \d+ %$/.test(hurried.said), `ticks of 60 ms: ${JSON.stringify(hurried)}`);

// The object under the pointer is dragged; after release the character gets up.
const spot = await tab.evaluate(() => {
  viewer.restart();
  for (let i = 0; i < 30; i++) viewer.step(1 / 60);
  viewer.camera.focus = viewer.subject; // where the view would come to rest
  const box = viewer.canvas.getBoundingClientRect();
  for (let y = 0.3; y < 0.8; y += 0.02)
    for (let x = 0.4; x < 0.6; x += 0.02) {
      const at = [box.left + x * box.width, box.top + y * box.height];
      if (viewer.world.ray(viewer.eye, viewer.wayThrough(...at), 100)?.character) return at;
    }
});
expect(spot, 'no ray meets the character');
if (spot) {
  // A pressed pointer alone has no effect yet, because a second finger may follow, and two fingers zoom.
  const touches = (...at) => tab.evaluate(([kind, id, [x, y]]) => viewer.canvas.dispatchEvent(
    new PointerEvent(kind, { pointerId: id, clientX: x, clientY: y, button: 0, pointerType: 'touch' })), at);
  const far = await tab.evaluate(() => {
    viewer.canvas.setPointerCapture = () => undefined; // which only a finger of flesh has
    return viewer.camera.distance;
  });
  await touches('pointerdown', 11, spot);
  await touches('pointerdown', 12, [spot[0] + 40, spot[1]]);
  await touches('pointermove', 12, [spot[0] + 120, spot[1]]);
  await touches('pointerup', 11, spot);
  await touches('pointerup', 12, [spot[0] + 120, spot[1]]);
  const pinched = await tab.evaluate(() => {
    delete viewer.canvas.setPointerCapture;
    viewer.step(1 / 60);
    const { camera: { distance }, held, character: { posture } } = viewer;
    return { distance, held: !!held, posture };
  });
  expect(pinched.distance < 0.5 * far && !pinched.held && pinched.posture === 'up', `two fingers from ${far} m: ${JSON.stringify(pinched)}`);
  await tab.evaluate((distance) => { viewer.camera.distance = distance; }, far);
  await tab.mouse.move(...spot);
  await tab.mouse.down();
  const height = () => tab.evaluate(() => viewer.held ? viewer.character.rigidState(viewer.held.rigid).center[1] : NaN);
  const before = await height();
  const target = await tab.evaluate(() => viewer.held?.target[1]);
  await tab.mouse.move(spot[0], spot[1] - 150, { steps: 4 });
  await tab.waitForFunction((low) => viewer.held?.target[1] > low + 0.15, target);
  const held = await tab.evaluate(() => {
    for (let i = 0; i < 60; i++) viewer.step(1 / 60);
    return { valid: viewer.character.health().valid };
  });
  held.height = await height();
  expect(held.valid && held.height > before + 0.08, `dragged from ${before} m: ${JSON.stringify(held)}`);
  await tab.waitForTimeout(500);
  await shoot('dragged');
  await tab.mouse.up();
  const after = await tab.evaluate(() => {
    for (let i = 0; i < 900 && viewer.character.posture !== 'up'; i++) viewer.step(1 / 60);
    return { held: !!viewer.held, posture: viewer.character.posture };
  });
  expect(!after.held && after.posture === 'up', `let go: ${JSON.stringify(after)}`);
}

// In the page too a recording gives the same state again, over a field of heights.
const replayed = await tab.evaluate(() => {
  const heights = Float32Array.from({ length: 400 }, (_, i) => 0.03 * Math.sin(i)), ground = { kind: 'heights', heights, columns: 20, rows: 20, cell: 0.2, x: -2, z: -2 };
  const hashes = [0, 1].map((again) => {
    viewer.restart(ground);
    if (!again) {
      viewer.world.record();
      viewer.character.drive(0.3);
      for (let i = 0; i < 60; i++) viewer.world.step(1 / 60);
      const hash = viewer.world.stateHash();
      viewer.recording = viewer.world.recorded();
      return hash;
    }
    const replay = viewer.world.replay(viewer.recording);
    while (replay.frame());
    return replay.state.differs ? 'differs' : viewer.world.stateHash();
  });
  return hashes;
});
expect(replayed[0] === replayed[1], `a replay in the page: ${replayed}`);

// The same state as everywhere.
const { frames, drive, ground, other, text, dropped } = JSON.parse(run);
const { hash, us } = await tab.evaluate(([count, [forward, turn], land]) => {
  const began = performance.now();
  return { hash: viewer.hashAfter(count, forward, turn, land), us: 1000 * (performance.now() - began) / count };
}, [frames, drive, ground]);

// Another file replaces it. An invalid file changes nothing, and the page shows the reason.
const shown = () => tab.evaluate(() => {
  viewer.step(1 / 60);
  viewer.draw();
  return { title: document.title, head: document.querySelector('#title').textContent, label: viewer.canvas.getAttribute('aria-label'),
    bones: viewer.asset.bones.length, valid: viewer.character.health().valid, trouble: !document.querySelector('#trouble').hidden,
    says: document.querySelector('#troubleText').textContent, kib: viewer.sbfmt.calls.memory.buffer.byteLength / 1024 };
});
const opened = async (path) => {
  await tab.evaluate(() => { viewer.before = viewer.asset; });
  await tab.setInputFiles('#file', path);
  await tab.waitForFunction(() => viewer.asset !== viewer.before || !document.querySelector('#trouble').hidden);
  return shown();
};
const first = await shown(), another = await opened(other);
expect(another.bones !== first.bones && another.title !== first.title && another.head === another.title && another.label.startsWith(another.title) && another.valid,
  `another file: ${JSON.stringify(another)}`);
await shoot('another');
const refused = await opened(text);
expect(refused.trouble && /sbfmt pack/.test(refused.says) && refused.bones === another.bones && refused.valid, `XML: ${JSON.stringify(refused)}`);
await shoot('refused');
await tab.click('#troubleAway');
expect(!(await shown()).trouble, 'what is wrong cannot be put away');
const second = await opened(other);
let last = second;
for (let i = 0; i < 5; i++) last = await opened(other);
expect(last.kib === second.kib, `opened seven times it holds ${last.kib} KiB, twice ${second.kib}`);
await tab.evaluate((bytes) => {
  const carried = new DataTransfer();
  carried.items.add(new File([Uint8Array.from(bytes, (one) => one.charCodeAt(0))], 'dropped.sbfz'));
  viewer.before = viewer.asset;
  for (const kind of ['dragover', 'drop']) document.body.dispatchEvent(new DragEvent(kind, { bubbles: true, cancelable: true, dataTransfer: carried }));
}, readFileSync(dropped, 'latin1'));
await tab.waitForFunction(() => viewer.asset !== viewer.before);
const back = await shown();
expect(back.bones === first.bones && back.valid && !back.trouble, `dropped: ${JSON.stringify(back)}`);

// By night the panel is dark, and as easy to read.
const contrast = () => tab.evaluate(() => {
  const light = (color) => {
    const [r, g, b] = color.match(/[\d.]+/g).map((x) => (x / 255 <= 0.04045 ? x / 255 / 12.92 : ((x / 255 + 0.055) / 1.055) ** 2.4));
    return 0.2126 * r + 0.7152 * g + 0.0722 * b;
  };
  const paper = light(getComputedStyle(document.querySelector('aside')).backgroundColor);
  return { paper, least: Math.min(...[...document.querySelectorAll('aside h1, aside h2, aside label, aside dt, aside dd, aside p')].map((one) => {
    const ink = light(getComputedStyle(one).color);
    return (Math.max(ink, paper) + 0.05) / (Math.min(ink, paper) + 0.05);
  })) };
});
for (const colorScheme of ['dark', 'light']) {
  await tab.emulateMedia({ colorScheme });
  const { paper, least } = await contrast();
  expect(least >= 4.5 && (colorScheme === 'dark') === paper < 0.2, `${colorScheme}: paper ${paper}, a contrast of ${least}`);
  await shoot(`${colorScheme}-panel`);
}

// It fits a narrow window.
await tab.setViewportSize({ width: 420, height: 800 });
await tab.waitForFunction(() => Math.abs(viewer.canvas.width - viewer.canvas.clientWidth) < 2);
const narrow = await tab.evaluate(() => ({ wide: document.documentElement.scrollWidth, panel: document.querySelector('aside').getBoundingClientRect().top,
  canvas: viewer.canvas.getBoundingClientRect().bottom }));
expect(narrow.wide <= 420 && narrow.panel >= narrow.canvas - 1, `in a narrow window: ${JSON.stringify(narrow)}`);
await shoot('narrow');

// Touch input: a button of the picture, pressed and released.
const pad = await tab.locator('#pad [data-code=KeyW]').boundingBox();
expect(pad && pad.width >= 44 && pad.height >= 44, `a button to walk by: ${JSON.stringify(pad)}`);
await tab.evaluate(() => viewer.restart());
await tab.mouse.move(pad.x + pad.width / 2, pad.y + pad.height / 2);
await tab.mouse.down();
expect(await tab.evaluate(() => {
  for (let i = 0; i < 90; i++) viewer.step(1 / 60);
  return viewer.keys.has('KeyW') && viewer.character.distance > 0.1;
}), 'the button does not walk');
await tab.mouse.up();
expect(await tab.evaluate(() => viewer.keys.size === 0), 'a button that was let go still steers');
for (const way of ['Forward', 'Back', 'Turn left', 'Turn right']) expect(await tab.getByRole('button', { name: way }).isVisible(), `no button '${way}'`);
await close();
console.log(JSON.stringify({ hash, us, faults }));
