/* The studio: files become characters that live at once, are shaped, and are taken away. */
import { load } from './sbfmt.js';
import { chartOf } from './studio_chart.js';
import { listenForDrops } from './studio_drop.js';
import { Film } from './studio_film.js';
import { element } from './studio_page.js';
import { part } from './studio_parts.js';
import { Cancelled, Program } from './studio_program.js';
import { chooseInput, Recipe, Refused, unchanged } from './studio_recipe.js';
import { ShapePanel } from './studio_shape.js';
import { shortNumber } from './studio_slider.js';
import { StudioStage } from './studio_stage.js';
import { save, showSnippets } from './studio_take.js';

const TABS = ['Open', 'Shape', 'Play', 'Take'];
const EXAMPLES = { 'pup.glb': 'A pup', 'koi.glb': 'A koi', 'snake.glb': 'A snake', 'spider.glb': 'A spider' };
/** What the first character walks by, until its file is read. */
const FIRST_GAIT = { kind: 'walk', numbers: { walk_speed: 0.3 } };
/** How the source is read: options of `sbfmt convert`, by the ids of their controls. */
const READING = { gaitKind: 'gait', forward: 'forward', unit: 'unit', limits: 'limits' };

class Studio {
  /** `files`: a packed character that is shown at first. */
  constructor(sbfmt, files) {
    const [[name, bytes]] = Object.entries(files);
    this.program = new Program();
    this.recipe = new Recipe(this.program);
    this.recipe.take(new Map([[name, bytes]]));
    this.stage = new StudioStage(sbfmt, bytes, element('canvas'), () => this.showWorld());
    this.shape = new ShapePanel({ change: (state, merge) => this.change(state, merge), mark: (names) => this.mark(names) });
    this.stage.choose('ground', 'flat');
    this.stage.tell = (now) => this.tell(now);
    this.choosePanel('Open');
    this.setPace(FIRST_GAIT);
    element('title').textContent = this.stage.asset.title;
    element('facts').textContent = 'An example: bring your own.';
  }

  // ---- Making ----

  /** Takes the files that a visitor brings. */
  async take(files) {
    try {
      chooseInput([...files.keys()]);
    } catch (error) {
      return tellTrouble(error.message);
    }
    const recipe = new Recipe(this.program);
    recipe.take(files);
    await this.make(recipe, true);
  }

  /** A new state of the same source. */
  async change(state, merge) {
    if (!this.made) return;
    this.recipe.history.push(state, merge);
    await this.make(this.recipe, false);
  }
  async go(back) {
    if (this.made && (back ? this.recipe.history.undo() : this.recipe.history.redo())) await this.make(this.recipe, false);
  }

  /** Makes the character of a recipe and shows it; a change meanwhile begins anew, Esc ends it. */
  async make(recipe, first) {
    this.abort?.abort('again');
    const abort = this.abort = new AbortController();
    tellTrouble('');
    this.offerUndo();
    this.tellWork(first ? `Reading ${recipe.input}` : 'Rebuilding');
    try {
      const options = { signal: abort.signal, progress: ({ what, fraction }) => this.tellWork(what, fraction) };
      const stays = !first && this.made, foreseen = stays && await recipe.foresee(stays, options);
      if (abort.signal.aborted) return;
      if (foreseen) this.stage.display(foreseen.packed, true);
      const made = await recipe.make(options);
      if (abort.signal.aborted) return;
      this.stage.imagesBeside = new Map(recipe.images);
      this.stage.choices.afloat = ['swim', 'fly'].includes(made.bundle.gait?.kind);
      if (!foreseen || foreseen.calibration !== made.bundle.calibration) this.stage.display(made.packed, stays);
      Object.assign(this, { recipe, made });
      this.showMade(first);
    } catch (error) {
      if (abort.signal.reason === 'again') return;
      if (!first) this.goBack(recipe);
      if (error instanceof Cancelled || abort.signal.aborted) return;
      tellTrouble(error.message.startsWith(recipe.input) ? error.message : `${recipe.input}: ${error.message}`);
      if (error instanceof Refused) this.listFindings(error.findings);
      else console.warn(error);
    } finally {
      if (this.abort === abort) this.tellWork();
    }
  }
  /** After a failure the panel shows again what is on the stage. */
  goBack(recipe) {
    recipe.history.undo();
    this.offerUndo();
    this.showState(false);
  }
  showState(first) {
    const { state } = this.recipe.history;
    this.shape.show(state, this.made.bundle, first);
    element('reading').hidden = element('budgetLabel').hidden = this.recipe.isBundle;
    for (const [id, option] of Object.entries(READING)) element(id).value = state.convert[option] ?? '';
  }

  showMade(first) {
    const { recipe, made, stage } = this, title = stage.asset.title || recipe.name, gait = made.bundle.gait;
    document.title = `${title} – sbfmt studio`;
    element('title').textContent = title;
    element('canvas').setAttribute('aria-label', `${title}, a soft-bodied character: W, A, S and D walk, arrows turn the view, plus and minus zoom, B throws a ball`);
    const soft = made.bundle.parts.filter((one) => one.soft).length;
    element('facts').textContent = `${gait ? { walk: 'Walks', swim: 'Swims', fly: 'Flies', slither: 'Slithers', crawl: 'Crawls', roll: 'Rolls' }[gait.kind] ?? 'Stands' : 'Has no gait'}, ` +
      `${soft} soft part${soft === 1 ? '' : 's'}, ${shortNumber(stage.size, 'm')} large`;
    const pace = `${gait?.kind} ${gait?.numbers.walk_speed}`;
    if (first || pace !== this.pace) this.setPace(gait);
    this.pace = pace;
    this.showState(first);
    this.listFindings(made.findings);
    this.offerUndo();
    this.showSnippets();
    element('takes').querySelectorAll('button').forEach((button) => { button.disabled = false; });
    stage.changed();
  }
  /** The speed of the gait, and a range about it. */
  setPace(gait) {
    const usual = gait && gait.kind !== 'none' ? gait.numbers.walk_speed : 0, speed = element('speed'), most = Math.max(3 * usual, this.stage.size);
    Object.assign(speed, { min: -most / 2, max: most, step: most / 200 });
    speed.value = usual;
    element('turn').value = 0;
    this.drive(usual, 0);
  }
  drive(speed = Number(element('speed').value), turn = Number(element('turn').value)) {
    this.stage.choices.drive = { speed, turn, top: Number(element('speed').max) };
    element('speedText').textContent = shortNumber(speed, 'm/s');
    element('turnText').textContent = shortNumber(turn, 'rad/s');
  }
  showSnippets() {
    const { state } = this.recipe.history, edited = ['soft', 'numbers', 'gait'].some((key) => Object.keys(state[key]).length);
    showSnippets(this.recipe.name, this.stage.choices.drive.speed, this.recipe.commands(state), edited);
  }

  async takeAway(kind) {
    const { recipe, made } = this;
    if (!made) return;
    this.tellWork(`Writing ${recipe.name}.${kind}`);
    try {
      const bytes = await recipe.takeAway(kind, made, async () => this.webFiles(), {});
      save(`${recipe.name}.${kind}`, bytes);
    } catch (error) {
      tellTrouble(error.message);
    } finally {
      this.tellWork();
    }
  }
  /** Begins a film of the picture, or ends it and saves it. */
  film() {
    if (this.filming) this.filming.stop();
    this.filming = this.filming ? undefined : new Film(this.stage.canvas, this.recipe.name);
    element('film').setAttribute('aria-pressed', String(!!this.filming));
    element('film').textContent = this.filming ? 'Stop and save the film' : 'Film it';
  }

  /** The parts of an exported page. */
  async webFiles() {
    const { texts } = await part('page'), { bytes } = await part('runtime');
    return [...Object.entries(texts).map(([name, text]) => [name, new TextEncoder().encode(text)]), ...Object.entries(bytes)];
  }

  // ---- Panels ----

  /** Work in progress, at the foot of the picture; without words: none. */
  tellWork(text, fraction) {
    const bar = element('workBar');
    element('work').hidden = !text;
    element('workText').textContent = text ?? '';
    if (fraction === undefined) bar.removeAttribute('value');
    else bar.value = fraction;
  }

  listFindings(findings) {
    const names = new Map(this.stage.asset.bones.map((bone) => [bone.name, bone.index])), order = ['error', 'warning', 'info'];
    element('noFindings').hidden = findings.length > 0;
    element('findings').replaceChildren(...[...findings].sort((a, b) => order.indexOf(a.severity) - order.indexOf(b.severity)).map(({ severity, code, message }) => {
      const item = document.createElement('li'), head = document.createElement('b'), places = bonesIn(message, names);
      const text = document.createElement(places.length ? 'button' : 'span');
      item.className = severity;
      head.textContent = { error: 'Error', warning: 'Warning', info: 'Note' }[severity];
      text.textContent = message;
      if (code) text.title = code;
      if (places.length) {
        text.type = 'button';
        text.addEventListener('click', () => this.stage.mark(places));
      }
      item.append(head, ' ', text);
      return item;
    }));
  }
  mark(names) {
    this.stage.mark(names.map((name) => this.stage.asset.bones.findIndex((bone) => bone.name === name)).filter((bone) => bone >= 0));
  }
  offerUndo() {
    const { history } = this.recipe;
    element('undo').disabled = element('startOver').disabled = history.at === 0;
    element('redo').disabled = history.at === history.states.length - 1;
  }

  /** What the world offers for this character. */
  showWorld() {
    const { stage } = this, lines = stage.character.lines(), kinds = new Set();
    for (let at = 3; at < lines.length; at += 10) kinds.add(lines[at]);
    const has = { lattice: kinds.delete(5), springs: kinds.size > 0, bones: stage.asset.bones.length > 0 };
    has.strain = has.lattice || has.springs;
    for (const [id, there] of Object.entries(has)) element(id).disabled = !there;
    element('pause').setAttribute('aria-pressed', String(stage.paused));
    element('knock').disabled = !stage.mass;
    this.showChart();
  }
  showChart() {
    if (element('panelPlay').hidden) return; // measuring takes long
    const { stage } = this, levels = stage.allDetailLevels, focused = element('chart').contains(document.activeElement);
    element('chart').replaceChildren(levels.length ? chartOf(levels, stage.choices.level, (value) => stage.choose('level', value)) : 'It has one level.');
    if (focused) element('chart').querySelector('[aria-checked="true"]')?.focus();
  }

  tell(now) {
    const { stage } = this, { step, frames, since } = stage.costs, health = stage.character.health(), figures = {
      stepCost: `${Math.round(1000 * step / frames).toLocaleString('en')} µs`,
      frameRate: `${Math.round(1000 * frames / (now - since))} /s`,
      volume: `${(100 * Math.abs(1 - health.volumeRatio)).toFixed(2)} %`,
      strainMost: `${(100 * health.maxStrain).toFixed(0)} %`,
      walked: `${stage.character.distance.toFixed(2)} m`,
    };
    for (const [id, text] of Object.entries(figures)) element(id).textContent = text;
    stage.costs = { step: 0, skin: 0, frames: 0, since: now, wanted: 0, covered: 0 };
  }

  choosePanel(name, focus) {
    for (const one of TABS) {
      const tab = element(`tab${one}`), is = one === name;
      tab.setAttribute('aria-selected', String(is));
      tab.tabIndex = is ? 0 : -1;
      element(`panel${one}`).hidden = !is;
      if (is && focus) tab.focus();
    }
    if (name === 'Play') this.stage.mark([]), this.showChart();
    // The first character is only shown until somebody wants more of it.
    if (['Shape', 'Take'].includes(name) && !this.made && !this.abort) this.make(this.recipe, true);
  }

  // ---- What the visitor does ----

  listen() {
    const { stage } = this;
    stage.listenToPicture(document.querySelectorAll('#pad button'));
    stage.canvas.addEventListener('webglcontextlost', () => tellTrouble('The graphics card was taken away from the page: load it again.'));
    for (const name of Object.keys(stage.show)) element(name).addEventListener('change', ({ target }) => { stage.show[name] = target.checked; });
    element('ground').addEventListener('change', ({ target }) => stage.choose('ground', target.value));
    element('count').addEventListener('change', ({ target }) => stage.choose('count', Number(target.value)));
    element('rate').addEventListener('change', ({ target }) => { stage.rate = Number(target.value); });
    for (const id of ['speed', 'turn']) {
      element(id).addEventListener('input', () => this.drive());
      element(id).addEventListener('change', () => this.made && this.showSnippets());
    }
    for (const [id, act] of Object.entries({ throw: () => stage.throwBall(), knock: () => stage.cast.forEach(({ character }) => character.fall()), restart: () => stage.restart(),
      pause: () => stage.pause(), stepOnce: () => stage.stepOnce(), undo: () => this.go(true), redo: () => this.go(false), cancel: () => this.cancel(),
      startOver: () => this.change(unchanged()), film: () => this.film() })) element(id).addEventListener('click', act);
    for (const [id, option] of Object.entries(READING))
      element(id).addEventListener('change', ({ target }) => this.change({ ...this.recipe.history.state, convert: { ...this.recipe.history.state.convert, [option]: target.value } }));
    element('takes').querySelectorAll('button').forEach((button) => button.addEventListener('click', () => this.takeAway(button.dataset.kind)));
    for (const name of TABS) element(`tab${name}`).addEventListener('click', () => this.choosePanel(name));
    document.querySelector('[role="tablist"]').addEventListener('keydown', (event) => this.moveTab(event));
    addEventListener('keydown', (event) => this.pressKey(event));
    listenForDrops((files) => this.take(files), tellTrouble);
    element('examples').replaceChildren(...Object.entries(EXAMPLES).map(([name, title]) => {
      const button = Object.assign(document.createElement('button'), { type: 'button', textContent: title });
      button.addEventListener('click', async () => {
        try {
          const { bytes } = await part(`example_${name.replace('.', '_')}`);
          await this.take(new Map(Object.entries(bytes)));
        } catch (error) {
          tellTrouble(error.message);
        }
      });
      return button;
    }));
  }
  moveTab(event) {
    const by = { ArrowRight: 1, ArrowLeft: -1 }[event.key], at = TABS.findIndex((name) => element(`tab${name}`) === document.activeElement);
    if (!by || at < 0) return;
    event.preventDefault();
    event.stopPropagation();
    this.choosePanel(TABS[(at + by + TABS.length) % TABS.length], true);
  }
  pressKey(event) {
    const command = event.ctrlKey || event.metaKey, key = event.key.toLowerCase();
    if (key === 'escape') this.cancel();
    else if (command && key === 'z') this.go(!event.shiftKey);
    else if (command && key === 'y') this.go(false);
    else if (!command && key === '.' && !/^(INPUT|SELECT)$/.test(event.target.tagName)) this.stage.stepOnce();
    else return;
    event.preventDefault();
  }
  cancel() {
    this.abort?.abort('cancelled');
    this.stage.mark([]);
  }
}

/** Bones whose names stand in a text as words. */
function bonesIn(text, names) {
  return [...names].filter(([name]) => name.length > 1 && new RegExp(`(?<![\\w.])${name.replace(/[.*+?^${}()|[\]\\]/g, '\\$&')}(?![\\w])(?!\\.\\w)`).test(text)).map(([, index]) => index);
}

/** Says what went wrong, until it is put away. */
function tellTrouble(text) {
  element('trouble').hidden = !text;
  element('troubleText').textContent = text;
}

/** Starts the studio; what goes wrong is said in it. */
export async function startStudio() {
  addEventListener('error', ({ message }) => tellTrouble(message));
  addEventListener('unhandledrejection', ({ reason }) => tellTrouble(String(reason?.message ?? reason)));
  element('troubleAway').addEventListener('click', () => tellTrouble(''));
  try {
    const [runtime, first] = await Promise.all([part('runtime'), part('first')]);
    const studio = new Studio(await load(runtime.bytes['sbfmt.wasm']), first.bytes);
    studio.listen();
    globalThis.studio = studio;
    requestAnimationFrame((now) => studio.stage.frame(now));
  } catch (error) {
    tellTrouble(error.message);
    throw error;
  }
}
