/* The panel that shapes the character: its soft parts, their material, its gait. */
import { GAIT_NUMBERS, MATERIAL_NUMBERS } from './studio_bundle.js';
import { element, refill } from './studio_page.js';
import { slider } from './studio_slider.js';

const PRESETS = ['fat', 'jelly', 'flesh', 'muscle', 'rubber', 'cotton', 'denim', 'silk', 'leather'];

export class ShapePanel {
  /** `change(state, merge)` takes a new state of the recipe, `mark(names)` marks bones. */
  constructor({ change, mark }) {
    Object.assign(this, { change, mark, part: undefined });
    element('material').addEventListener('change', ({ target }) => this.chooseMaterial(target.value));
    element('budget').addEventListener('change', ({ target }) => this.change({ ...this.state, convert: { ...this.state.convert, budget: target.value } }));
  }

  /** Shows what was made of a state. `first`: another character. */
  show(state, bundle, first) {
    Object.assign(this, { state, bundle, parts: bundle.parts, gait: bundle.gait });
    if (first) this.part = undefined;
    if (first || !this.usual) this.usual = this.gait?.numbers; // sliders range about what the character came with
    element('budget').value = state.convert.budget ?? '';
    this.listParts();
    this.showMaterial();
    this.showGait();
  }

  listParts() {
    const focused = document.activeElement?.dataset?.part, rows = [];
    const row = (id, name, isSoft, isFixed) => {
      const item = document.createElement('li');
      if (id !== undefined) {
        const label = document.createElement('label'), box = Object.assign(document.createElement('input'), { type: 'checkbox', checked: isSoft, disabled: isFixed });
        box.setAttribute('aria-label', `${name} is soft`);
        box.dataset.part = `soft ${id}`;
        box.addEventListener('change', () => this.change({ ...this.state, soft: { ...this.state.soft, [id]: box.checked } }));
        label.append(box);
        item.append(label);
      }
      const button = Object.assign(document.createElement('button'), { type: 'button', textContent: name, disabled: id !== undefined && !isSoft });
      button.dataset.part = `part ${id}`;
      button.setAttribute('aria-pressed', String(this.part === id));
      button.addEventListener('click', () => this.choosePart(id));
      item.append(button);
      rows.push(item);
    };
    if (this.part && !this.parts.some((one) => one.id === this.part && one.soft)) this.part = undefined;
    row(undefined, this.parts.length ? 'All soft parts' : 'It has no soft parts.', true, true);
    for (const one of this.parts) row(one.id, one.name, one.soft, one.fixed);
    const list = element('parts'), { scrollTop } = list;
    list.replaceChildren(...rows);
    list.scrollTop = scrollTop;
    if (focused) list.querySelector(`[data-part="${CSS.escape(focused)}"]`)?.focus({ preventScroll: true });
  }

  get chosen() {
    return this.parts.find((one) => one.id === this.part) ?? this.parts.find((one) => one.soft);
  }
  choosePart(id) {
    this.part = id;
    const chosen = this.parts.find((one) => one.id === id);
    this.mark(chosen?.bone ? [chosen.bone] : []);
    this.listParts();
    this.showMaterial();
  }

  showMaterial() {
    const { chosen } = this, key = this.part ? chosen.name : '';
    element('partName').textContent = this.part ? chosen.name : 'all soft parts';
    const select = element('material');
    select.replaceChildren(new Option('as it is', ''), ...PRESETS.map((name) => new Option(name)));
    select.value = this.state.materials[key] ?? '';
    select.disabled = !chosen;
    refill(element('materialNumbers'), chosen ? MATERIAL_NUMBERS.map((one) => slider(one, chosen.numbers[one.key], (value) => this.setNumber(one.key, value))) : []);
  }
  /** A preset replaces numbers that were set before. */
  chooseMaterial(name) {
    const key = this.part ? this.chosen.name : '', materials = { ...this.state.materials }, numbers = { ...this.state.numbers };
    delete numbers[this.part ?? ''];
    if (!this.part) for (const one of Object.keys(numbers)) delete numbers[one];
    if (!this.part) for (const one of Object.keys(materials)) delete materials[one];
    if (name) materials[key] = name;
    else delete materials[key];
    this.change({ ...this.state, materials, numbers });
  }
  setNumber(key, value) {
    const part = this.part ?? '', numbers = { ...this.state.numbers, [part]: { ...this.state.numbers[part], [key]: value } };
    this.change({ ...this.state, numbers }, `${part} ${key}`);
  }

  showGait() {
    const { gait } = this, known = gait ? GAIT_NUMBERS.filter(({ kinds }) => !kinds || kinds.includes(gait.kind)) : [];
    element('noGait').hidden = known.length > 0;
    refill(element('gaitNumbers'), known.map((one) => {
      const usual = this.usual?.[one.key] || one.usual, range = { low: usual / 4, high: usual * 4, ...one };
      return slider(range, gait.numbers[one.key], (value) => this.change({ ...this.state, gait: { ...this.state.gait, [one.key]: value } }, `gait ${one.key}`));
    }));
  }
}
