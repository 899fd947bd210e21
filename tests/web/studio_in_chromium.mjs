// Opens the studio and works it as a visitor would; prints what came of it as one line of JSON.
// Usage: node studio_in_chromium.mjs FOLDER-OF-NODE_MODULES PAGE PICTURES WANTED
import { readFileSync } from 'node:fs';
import path from 'node:path';
import { pathToFileURL } from 'node:url';

import { colorsDrawn, open } from './chromium.mjs';

const [modules, page, pictures, text] = process.argv.slice(2), wanted = JSON.parse(text), seconds = {};
const source = (name) => path.join(wanted.folder, name), bytesOf = (name) => readFileSync(source(name));

// A server gives the same as a disk.
{
  const { tab, faults, close } = await open(modules, pictures, wanted.address);
  await tab.goto(wanted.address);
  await tab.waitForFunction(() => globalThis.studio?.stage.time > 0.1);
  await close();
  if (faults.length) {
    console.log(JSON.stringify({ seconds, faults }));
    process.exit();
  }
}

const { tab, faults, expect, shoot, close } = await open(modules, pictures);
let began = Date.now();
const lap = (name) => { seconds[name] = (Date.now() - began) / 1000; };
await tab.goto(pathToFileURL(page).href);
await tab.waitForFunction(() => globalThis.studio?.stage.time > 0.1);
lap('first picture');
await tab.evaluate(() => { globalThis.stage = studio.stage; });
const seen = await colorsDrawn(tab, 'stage');
expect(seen > 60, `the picture has ${seen} colours`);
expect(await tab.evaluate(() => !studio.program.prepared), 'the program is loaded before it is needed');
await shoot('studio-first');

/** Drops files of these names on the page. */
const drop = (...names) => tab.evaluate((files) => {
  const carried = new DataTransfer();
  for (const [name, base64] of files) carried.items.add(new File([Uint8Array.from(atob(base64), (one) => one.charCodeAt(0))], name));
  studio.before = studio.made;
  for (const kind of ['dragover', 'drop']) document.body.dispatchEvent(new DragEvent(kind, { bubbles: true, cancelable: true, dataTransfer: carried }));
}, names.map((name) => [name, bytesOf(name).toString('base64')]));
/** Does something, and waits until a character was made or refused. */
const made = async (act) => {
  await tab.evaluate(() => { studio.before = studio.made; });
  began = Date.now();
  await act();
  await tab.waitForFunction(() => studio.made !== studio.before || !document.querySelector('#trouble').hidden);
  await tab.waitForFunction(() => document.querySelector('#work').hidden);
  const trouble = await tab.evaluate(() => (document.querySelector('#trouble').hidden ? '' : document.querySelector('#troubleText').textContent));
  expect(!trouble, `refused: ${trouble}`);
};
const take = async (kind) => {
  const [download] = await Promise.all([tab.waitForEvent('download'), tab.click(`#takes [data-kind=${kind}]`)]);
  return { name: download.suggestedFilename(), bytes: readFileSync(await download.path()) };
};

// A mesh that is dropped walks, and its findings are listed.
await made(() => drop('pup.glb'));
lap('pup.glb dropped');
await tab.waitForFunction(() => studio.stage.character.distance > 0.05);
expect(await tab.evaluate(() => studio.stage.character.health().valid), 'the pup is not valid');
const findings = await tab.evaluate(() => [...document.querySelectorAll('#findings li')].map((one) => one.textContent));
expect(findings.length === wanted.findings.length, `${findings.length} findings, the program has ${wanted.findings.length}`);
for (const line of wanted.findings) {
  const words = line.replace(/^sbfmt \w+: \w+: /, '').replace(/ \[[A-Z_]+\].*$/, '');
  expect(findings.some((one) => one.includes(words)), `no finding says: ${words}`);
}
await tab.click('#findings button');
expect(await tab.evaluate(() => studio.stage.marked.length > 0), 'a finding with bones marks none');
await shoot('studio-finding');
const plain = await tab.evaluate(() => studio.made.packed.length);
expect(plain === bytesOf('plain.sbfz').length, `${plain} bytes, natively ${bytesOf('plain.sbfz').length}`);

// Another material is a change that can be undone, by the bytes.
await tab.click('#tabShape');
const modulus = () => tab.evaluate(() => document.querySelector('#materialNumbers .value').textContent);
const before = await modulus();
await made(() => tab.selectOption('#material', 'muscle'));
lap('material changed');
expect(await modulus() === '30 kPa', `muscle has ${await modulus()}`);
await shoot('studio-shape');
await tab.click('#tabTake');
for (const [kind, name] of Object.entries(wanted.made)) {
  const taken = await take(kind);
  expect(taken.name === `pup.${kind}`, `${kind}: the name is ${taken.name}`);
  expect(taken.bytes.equals(bytesOf(name)), `${kind}: ${taken.bytes.length} bytes differ from the program's ${bytesOf(name).length}`);
}
await shoot('studio-take');
await tab.focus('#canvas');
await made(() => tab.keyboard.press('Control+z'));
expect(await modulus() === before, `undone it has ${await modulus()}, before ${before}`);
const again = await tab.evaluate(() => btoa(studio.made.packed.reduce((sum, one) => sum + String.fromCharCode(one), '')));
expect(Buffer.from(again, 'base64').equals(bytesOf('plain.sbfz')), 'undone it has other bytes than before');
await made(() => tab.keyboard.press('Control+Shift+z'));
expect(await modulus() === '30 kPa', `done again it has ${await modulus()}`);

// Parts are made soft or not, numbers and the gait are moved.
await tab.click('#tabShape');
const soft = () => tab.evaluate(() => studio.stage.asset.softBodies.length);
const softBefore = await soft();
await made(() => tab.click('#parts input:checked'));
expect(await soft() === softBefore - 1, `${await soft()} soft parts of ${softBefore} after one was switched off`);
const moveSlider = (place, to) => tab.locator(place).evaluate((input, value) => {
  input.value = value;
  for (const kind of ['input', 'change']) input.dispatchEvent(new Event(kind, { bubbles: true }));
}, to);
await made(() => moveSlider('#materialNumbers input >> nth=0', 0.5));
lap('modulus moved');
expect(/^1[34]\d kPa$/.test(await modulus()), `in the middle of the slider it has ${await modulus()}`);
await tab.focus('#materialNumbers input >> nth=1');
await made(() => tab.keyboard.press('ArrowRight'));
expect(await tab.evaluate(() => document.querySelectorAll('#materialNumbers input')[1] === document.activeElement), 'a slider loses the focus when a key moves it');
await made(() => moveSlider('#gaitNumbers input >> nth=0', 0.9));
lap('step height moved');
await tab.waitForFunction(() => studio.stage.character.distance > 0.05);
await made(() => tab.click('#startOver'));
expect(await modulus() === before, `without all changes it has ${await modulus()}`);

// The world.
await tab.click('#tabPlay');
await tab.selectOption('#ground', 'stairs');
await tab.selectOption('#count', '3');
expect(await tab.evaluate(() => studio.stage.cast.length === 3), 'there are not three of it');
await tab.waitForTimeout(1000);
await shoot('studio-play');
await tab.click('#film');
const filmed = await tab.evaluate(() => studio.stage.time);
await tab.waitForFunction((began) => studio.stage.time > began + 0.5, filmed);
const [film] = await Promise.all([tab.waitForEvent('download'), tab.click('#film')]);
expect(film.suggestedFilename() === 'pup.webm' && readFileSync(await film.path()).length > 1000,
  `a film: ${film.suggestedFilename()} of ${readFileSync(await film.path()).length} bytes`);
await tab.click('#chart g >> nth=-1');
expect(await tab.evaluate(() => typeof studio.stage.choices.level === 'string'), 'the chart chooses no level');
await tab.click('#stepOnce');
expect(await tab.evaluate(() => {
  const { time } = studio.stage;
  document.querySelector('#stepOnce').click();
  return studio.stage.paused && Math.abs(studio.stage.time - time - 1 / 60) < 1e-9;
}), 'one step is not one');
await tab.click('#pause');
await tab.selectOption('#count', '1');
await tab.selectOption('#ground', 'flat');
// A gamepad steers: its stick back and to the left, then its first button.
await tab.evaluate(() => {
  globalThis.pad = { connected: true, mapping: 'standard', axes: [-1, 1, 0, 0], buttons: Array.from({ length: 17 }, () => ({ pressed: false, value: 0 })) };
  navigator.getGamepads = () => [null, globalThis.pad];
  const { character } = studio.stage, { drive } = character;
  character.drive = (...asked) => {
    globalThis.asked = asked;
    drive.apply(character, asked);
  };
});
await tab.waitForFunction(() => globalThis.asked?.[0] < 0 && globalThis.asked[1] > 0);
await tab.evaluate(() => { globalThis.pad.buttons[0].pressed = true; });
await tab.waitForFunction(() => studio.stage.character.posture !== 'up');
await tab.evaluate(() => { navigator.getGamepads = () => []; });
await tab.waitForFunction(() => globalThis.asked[1] === 0);

// Esc ends it; what is on the stage stays.
const title = await tab.textContent('#title');
await drop('koi.glb');
await tab.waitForFunction(() => !document.querySelector('#work').hidden);
await tab.keyboard.press('Escape');
await tab.waitForFunction(() => document.querySelector('#work').hidden);
expect(await tab.textContent('#title') === title && await tab.isHidden('#trouble'), 'a cancelled file changes something');

// A broken file is refused in the program's words.
await drop('broken.glb');
await tab.waitForFunction(() => !document.querySelector('#trouble').hidden);
const refused = await tab.textContent('#troubleText');
expect(refused.includes(wanted.refused.replace(/ \[[A-Z_]+\].*$/, '')), `refused: ${refused}; the program: ${wanted.refused}`);
expect(await tab.evaluate(() => studio.stage.character.health().valid), 'what was there is gone');
await shoot('studio-refused');
await tab.click('#troubleAway');

// A swimmer; then several files, chosen.
await made(() => drop('koi.glb'));
lap('koi.glb dropped');
await tab.waitForFunction(() => studio.stage.character.distance > 0.05);
const lowest = await tab.evaluate(() => {
  const { stage } = studio, { character } = stage, heights = character.skin(0).positions.filter((_, i) => i % 3 === 1);
  return (heights.reduce((least, y) => Math.min(least, y)) + character.origin[1]) / stage.size;
});
expect(lowest > 0.1, `the koi swims ${lowest} of its size above the floor`);
await tab.click('#tabOpen');
await made(() => tab.setInputFiles('#file', ['lizard.glb', 'lizard.mtl', 'lizard.obj'].map(source)));
lap('lizard.obj with its rig');
const lizard = await tab.evaluate(() => studio.made.packed.length);
expect(lizard === bytesOf('lizard.sbfz').length, `the lizard has ${lizard} bytes, natively ${bytesOf('lizard.sbfz').length}`);
await tab.click('#tabShape');
// A modulus is seen before it is built: springs are as stiff as those that are then built.
await tab.evaluate(() => {
  studio.shown = [];
  const { stage } = studio, display = stage.display;
  stage.display = (bytes, stay) => {
    studio.shown.push({ bytes, isBuilt: studio.made !== studio.before });
    display.call(stage, bytes, stay);
  };
});
await made(() => moveSlider('#materialNumbers input >> nth=0', 0.6));
lap("lizard's modulus moved");
const foreseen = await tab.evaluate(() => {
  const { made, before, shown } = studio, bundle = new made.bundle.constructor(new TextDecoder().decode(before.bytes));
  bundle.foreseeNumber('', 'young_modulus', made.bundle.parts[0].numbers.young_modulus);
  const stiffness = (one) => one.all('spring_set > stiffness').flatMap((list) => list.textContent.trim().split(/\s+/).map(Number));
  const built = stiffness(made.bundle), early = stiffness(bundle);
  return { shown: shown.map(({ bytes, isBuilt }) => [isBuilt, bytes === made.packed]), count: built.length, same: built.length === early.length,
    off: built.reduce((most, one, i) => Math.max(most, Math.abs(early[i] / one - 1)), 0) };
});
expect(String(foreseen.shown) === 'false,false', `the lizard's modulus is shown ${foreseen.shown}`);
expect(foreseen.count > 1000 && foreseen.same && foreseen.off < 1e-4, `${foreseen.count} springs are foreseen, off by ${foreseen.off}`);

// Everything has a name; text is easy to read by day and by night; a narrow window shows all.
const nameless = () => tab.evaluate(() => [...document.querySelectorAll('button, input, select, a, summary, [tabindex]')].filter((one) => one.checkVisibility() &&
  !(one.labels?.[0]?.textContent.trim() || one.getAttribute('aria-label') || one.getAttribute('aria-labelledby') || one.textContent.trim())).map((one) => one.outerHTML));
const contrast = () => tab.evaluate(() => {
  const light = (color) => {
    const [r, g, b] = color.match(/[\d.]+/g).map((x) => (x / 255 <= 0.04045 ? x / 255 / 12.92 : ((x / 255 + 0.055) / 1.055) ** 2.4));
    return 0.2126 * r + 0.7152 * g + 0.0722 * b;
  };
  const paper = light(getComputedStyle(document.querySelector('aside')).backgroundColor);
  return Math.min(...[...document.querySelectorAll('aside h1, aside h2, aside label, aside p, aside small, aside [role=tab], aside .value')].map((one) => {
    const ink = light(getComputedStyle(one).color);
    return (Math.max(ink, paper) + 0.05) / (Math.min(ink, paper) + 0.05);
  }));
});
for (const colorScheme of ['dark', 'light']) {
  await tab.emulateMedia({ colorScheme });
  for (const name of ['Open', 'Shape', 'Play', 'Take']) {
    await tab.click(`#tab${name}`);
    const all = await nameless(), least = await contrast();
    expect(!all.length, `without a name: ${all}`);
    expect(least >= 4.5 || name === 'Shape' && least >= 3, `${colorScheme}, ${name}: a contrast of ${least}`);
    if (colorScheme === 'dark') await shoot(`studio-dark-${name}`);
  }
}
await tab.setViewportSize({ width: 390, height: 800 });
for (const name of ['Open', 'Shape', 'Play', 'Take']) {
  await tab.click(`#tab${name}`);
  await tab.waitForTimeout(300);
  const wide = await tab.evaluate(() => [document.documentElement.scrollWidth, document.querySelector('aside').scrollWidth, document.querySelector('aside').clientWidth]);
  expect(wide[0] <= 390 && wide[1] <= wide[2], `in a narrow window ${name}: ${wide}`);
  await shoot(`studio-narrow-${name}`);
}
await close();
console.log(JSON.stringify({ seconds, faults }));
