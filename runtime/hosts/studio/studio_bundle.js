/* The text of an .sbf as the studio reads and changes it: its source parts alone, which a build leaves as they are. */

/** Numbers of a material that sliders change, in SI; the range is that of tissue, rubber and cloth. */
export const MATERIAL_NUMBERS = [
  { key: 'young_modulus', label: "Young's modulus", unit: 'Pa', low: 1e3, high: 2e7, usual: 8e4 },
  { key: 'density', label: 'Density', unit: 'kg/m³', low: 100, high: 3000, usual: 1000 },
  { key: 'poisson_ratio', label: "Poisson's ratio", unit: '', low: 0, high: 0.48, usual: 0.4, linear: true },
  { key: 'damping_ratio', label: 'Damping ratio', unit: '', low: 0, high: 1, usual: 0.2, linear: true },
  { key: 'friction', label: 'Friction', unit: '', low: 0, high: 1.5, usual: 0.6, linear: true },
];
/** Numbers of a gait that sliders change; the range is a factor on what the file had at first, or stated. */
export const GAIT_NUMBERS = [
  { key: 'step_height', label: 'Step height', unit: 'm', usual: 0.05, kinds: ['walk'] },
  { key: 'step_duration', label: 'Step duration', unit: 's', usual: 0.25, kinds: ['walk'] },
  { key: 'step_trigger', label: 'Step length', unit: 'm', usual: 0.05, kinds: ['walk'] },
  { key: 'walk_speed', label: 'Usual speed', unit: 'm/s', usual: 0.5 },
  { key: 'body_tilt', label: 'Body follows slopes', unit: '', usual: 0.7, low: 0, high: 1, linear: true, kinds: ['walk'] },
  { key: 'hip_tilt', label: 'Hips follow feet', unit: '', usual: 0.5, low: 0, high: 1, linear: true, kinds: ['walk'] },
];

/** Numbers whose effect is known before a build: see Bundle.foreseeNumber. */
export const FORESEEN = ['young_modulus', 'density', 'damping_ratio', 'friction'];

const written = (value) => String(Number(value.toPrecision(8)));

function scale(list, factor) {
  list.textContent = list.textContent.trim().split(/\s+/).map((number) => written(number * factor)).join(' ');
}

export class Bundle {
  constructor(text) {
    this.document = new DOMParser().parseFromString(text, 'application/xml');
    const wrong = this.document.querySelector('parsererror');
    if (wrong) throw new Error(wrong.textContent);
  }
  all(selector) {
    return [...this.document.querySelectorAll(selector)];
  }

  /** What may be soft: { id, name, bone, soft, fixed, numbers }; of a skin that is cut, each section. `fixed`: it is always soft. */
  get parts() {
    const names = new Map(this.all('skeleton > bone').map((bone) => [bone.getAttribute('id'), bone.getAttribute('name')]));
    const bodies = this.all('soft_body:not([derived])').map((body) => ({ id: body.getAttribute('id'), name: body.getAttribute('name') || body.getAttribute('id'),
      bone: names.get(body.getAttribute('bone')), soft: true, fixed: true, numbers: this.numbersOf(body) }));
    const recipes = this.all('section_recipe[bone]').map((recipe) => ({ id: recipe.getAttribute('bone'), name: names.get(recipe.getAttribute('bone')),
      bone: names.get(recipe.getAttribute('bone')), soft: recipe.getAttribute('rigid') !== 'true', fixed: false, numbers: this.numbersOf(recipe) }));
    return [...bodies, ...recipes];
  }
  elementOf(id) {
    return this.all('soft_body:not([derived])').find((body) => body.getAttribute('id') === id) ??
      this.all('section_recipe[bone]').find((recipe) => recipe.getAttribute('bone') === id);
  }
  attributesOf(element) {
    return [...element.children].find((child) => child.tagName === 'attributes');
  }
  numbersOf(element) {
    const attributes = this.attributesOf(element);
    return Object.fromEntries(MATERIAL_NUMBERS.map(({ key, usual }) => [key, Number(attributes?.getAttribute(key) ?? usual)]));
  }

  /** The gait: { kind, numbers }, or undefined. */
  get gait() {
    const gait = this.document.querySelector('gait');
    if (!gait) return undefined;
    return { kind: gait.getAttribute('kind') ?? 'walk',
      numbers: Object.fromEntries(GAIT_NUMBERS.map(({ key, usual }) => [key, Number(gait.getAttribute(key) ?? usual)])) };
  }

  /** Makes a part soft or lets it move with its bone. */
  setSoft(id, soft) {
    const recipe = this.elementOf(id);
    if (soft) recipe?.removeAttribute('rigid');
    else recipe?.setAttribute('rigid', 'true');
    recipe?.removeAttribute('proposed');
  }
  /** Sets a number of one part, or of all soft ones. */
  setNumber(id, key, value) {
    const chosen = id ? [this.elementOf(id)].filter(Boolean) : this.parts.filter((one) => one.soft).map((one) => this.elementOf(one.id));
    for (const element of chosen) {
      let attributes = this.attributesOf(element);
      if (!attributes) element.prepend(attributes = this.document.createElement('attributes'));
      attributes.setAttribute(key, written(value));
    }
  }
  /** Sets a number of a part, or of all soft ones, and in what a build derived from it. The stiffness of springs is proportional to
   * Young's modulus; density, damping and friction change nothing that is derived. */
  foreseeNumber(id, key, value) {
    const ids = id ? [id] : this.parts.filter((one) => one.soft).map((one) => one.id), bodies = this.all('soft_body').filter((body) =>
      ids.includes(body.getAttribute(body.hasAttribute('derived') ? 'bone' : 'id')));
    const before = bodies.map((body) => Number(this.attributesOf(body)?.getAttribute('young_modulus')));
    this.setNumber(id, key, value);
    bodies.forEach((body, i) => {
      this.attributesOf(body)?.setAttribute(key, written(value));
      if (key === 'young_modulus' && before[i]) body.querySelectorAll('spring_set > stiffness').forEach((list) => scale(list, value / before[i]));
    });
  }
  /** Factors of all calibrated moduli, to two digits. */
  get calibration() {
    return this.all('calibration').map((one) => Number(one.getAttribute('factor')).toPrecision(2)).join(' ');
  }
  setGait(key, value) {
    this.document.querySelector('gait')?.setAttribute(key, written(value));
  }

  get text() {
    return new XMLSerializer().serializeToString(this.document);
  }
}
