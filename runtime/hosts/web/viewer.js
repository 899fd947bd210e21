/* The page of `sbfmt export -o PAGE.html`: a character to look at, to walk about, to drag and to throw balls at.
 * Keys and pointer steer; buttons and settings are in the panel of viewer.html. */
import { load } from './sbfmt.js';
import { listenForFiles } from './viewer_files.js';
import { Show } from './viewer_show.js';

const element = (id) => document.getElementById(id);
const DETAIL_NAMES = { jiggle: 'springy bones', bones: 'bones alone' };

class Viewer extends Show {
  restart(...how) {
    super.restart(...how);
    this.offerInside();
  }

  put(asset) {
    super.put(asset);
    this.offer('level', asset.levels || 1, 'finest', this.detailLevels.map(({ kind }) => [DETAIL_NAMES[kind], kind]));
    this.offer('renderLevel', asset.renderLevels, 'full');
    element('knock').disabled = !this.mass;
  }

  tell(now) {
    const { step, skin, frames, since, wanted, covered } = this.costs, pace = wanted ? covered / wanted : 1, health = this.character.health(), figures = {
      step: `${Math.round(1000 * step / frames).toLocaleString('en')} µs`,
      skinCost: `${Math.round(1000 * skin / frames).toLocaleString('en')} µs`,
      pace: pace > 0.98 ? 'as the clock' : `slowed to ${Math.round(100 * pace)} %`,
      rate: `${Math.round(1000 * frames / (now - since))} /s`,
      volume: `${(100 * Math.abs(1 - health.volumeRatio)).toFixed(2)} %`,
      strainMost: `${(100 * health.maxStrain).toFixed(0)} %`,
      stated: this.statedError ? `${(1000 * this.statedError).toFixed(2)} mm` : 'not measured',
      walked: `${this.character.distance.toFixed(2)} m`,
    };
    for (const [id, text] of Object.entries(figures)) element(id).textContent = text;
    this.costs = { step: 0, skin: 0, frames: 0, since: now, wanted: 0, covered: 0 };
  }

  listen() {
    this.listenToPicture(document.querySelectorAll('#pad button'));
    this.canvas.addEventListener('webglcontextlost', () => tellTrouble('The graphics card was taken away from the page: load it again.'));
    for (const name of Object.keys(this.show))
      element(name).addEventListener('change', (event) => { this.show[name] = event.target.checked; });
    for (const name of ['ground', 'level', 'renderLevel', 'speed'])
      element(name).addEventListener('change', ({ target: { value } }) => this.choose(name, Number.isNaN(Number(value)) ? value : Number(value)));
    for (const [id, act] of Object.entries({ throw: () => this.throwBall(), knock: () => this.character.fall(), restart: () => this.restart(),
      pause: () => this.pause() })) element(id).addEventListener('click', act);
    listenForFiles(this, element, tellTrouble);
  }

  pause() {
    super.pause();
    element('pause').setAttribute('aria-pressed', String(this.paused));
  }

  /** Levels to choose from, and what else there is: [[text, value]]. */
  offer(id, count, first, more = []) {
    const levels = Array.from({ length: count }, (_, i) => [i ? String(i) : `0, ${first}`, i]);
    element(id).replaceChildren(...[...levels, ...more].map(([text, value]) => new Option(text, String(value))));
    element(id).disabled = levels.length + more.length < 2;
  }

  /** Enables the switches of inner parts that this character has at its level. */
  offerInside() {
    const lines = this.character.lines(), kinds = new Set();
    for (let at = 3; at < lines.length; at += 10) kinds.add(lines[at]);
    const has = { lattice: kinds.delete(5), springs: kinds.size > 0, bones: this.asset.bones.length > 0 };
    has.strain = has.lattice || has.springs;
    for (const [id, there] of Object.entries(has)) {
      element(id).disabled = !there;
      element(id).closest('label').title = there ? '' : 'This character has none.';
    }
  }
}

/** Says what went wrong, until it is put away. */
function tellTrouble(text) {
  element('trouble').hidden = !text;
  element('troubleText').textContent = text;
}

/** Starts the page; what goes wrong is said in it. */
export async function view(wasm, bundle) {
  addEventListener('error', ({ message }) => tellTrouble(message));
  element('troubleAway').addEventListener('click', () => tellTrouble(''));
  try {
    const viewer = new Viewer(await load(wasm), bundle, element('canvas'));
    viewer.listen();
    globalThis.viewer = viewer;
    requestAnimationFrame((now) => viewer.frame(now));
  } catch (error) {
    tellTrouble(error.message);
    throw error;
  }
}
