/* From the files that a visitor brings to the character: what is chosen, in steps that can be undone, and the calls of the
 * program that follow from it. */
import { Bundle, FORESEEN } from './studio_bundle.js';

export const BUNDLE_ENDINGS = ['sbf', 'sbfz'], MESH_ENDINGS = ['glb', 'gltf', 'fbx', 'dae', 'obj', 'vrm', 'bvh', 'ply', 'stl', '3ds', 'x'];
/** Of several files the first of these is the mesh, an .obj before its rig. */
const ORDER = ['sbfz', 'sbf', 'obj', 'glb', 'vrm', 'gltf', 'fbx', 'dae', 'ply', 'stl', '3ds', 'x', 'bvh'];
const RIGS = ['glb', 'gltf', 'fbx', 'dae', 'bvh', 'vrm', 'x'];
/** Results that are kept, so that undoing is quick and a step that has not changed is not taken again. */
const MOST_KEPT = 10;

export const ending = (name) => name.slice(name.lastIndexOf('.') + 1).toLowerCase();
export const stem = (name) => name.slice(name.lastIndexOf('/') + 1).replace(/\.[^.]*$/, '');
/** What nothing was changed of. */
export const unchanged = () => ({ convert: {}, materials: {}, soft: {}, numbers: {}, gait: {} });

/** Input and rig among files: { input, rig }; throws what is wrong with them. */
export function chooseInput(names) {
  const rank = (name) => ORDER.indexOf(ending(name)), known = names.filter((name) => rank(name) >= 0).sort((a, b) => rank(a) - rank(b));
  if (!known.length) throw new Error(`no mesh is among ${names.join(', ')}: bring an ${ORDER.slice(2, 8).map((one) => `.${one}`).join(', ')}, .sbf or .sbfz`);
  const [input] = known, rig = ending(input) === 'obj' ? known.find((name) => RIGS.includes(ending(name))) : undefined;
  return { input, rig };
}

/** Thrown when the program refuses: its own words. */
export class Refused extends Error {
  constructor(errors) {
    const findings = errors.map(findingOf), wrong = findings.filter(({ severity }) => severity === 'error').map(({ message }) => message);
    super(wrong.join('; ') || errors.at(-1) || 'the program gave no reason');
    this.findings = findings;
  }
}

/** A line of the program as { severity, code, message }. */
export function findingOf(line) {
  const found = /^sbfmt (?:\w+: )?(error|warning|info): (.*?)(?: \[([A-Z0-9_]+)\](.*))?$/.exec(line);
  return found ? { severity: found[1], message: found[2] + (found[4] ?? ''), code: found[3] ?? '' } : { severity: 'info', message: line, code: '' };
}

/** Undo and redo over states that are never changed, only replaced. */
export class History {
  constructor() {
    this.clear();
  }
  clear() {
    this.states = [unchanged()];
    this.at = 0;
  }
  get state() {
    return this.states[this.at];
  }
  /** `merge`: the same slider moves on, which is one step. */
  push(state, merge) {
    const again = merge && merge === this.merge && this.at === this.states.length - 1 && this.at > 0;
    this.states.splice(again ? this.at : this.at + 1, Infinity, state);
    this.at = this.states.length - 1;
    this.merge = merge;
  }
  undo() {
    this.merge = undefined;
    return this.at > 0 && (this.at--, true);
  }
  redo() {
    this.merge = undefined;
    return this.at < this.states.length - 1 && (this.at++, true);
  }
}

export class Recipe {
  constructor(program) {
    this.program = program;
    this.kept = new Map();
    this.clear();
  }
  clear() {
    this.kept.clear();
    this.history = new History();
  }

  /** Takes the source: a Map of names and bytes. */
  take(files) {
    Object.assign(this, chooseInput([...files.keys()]), { files });
    this.clear();
  }
  get name() {
    return stem(this.input);
  }
  get isBundle() {
    return BUNDLE_ENDINGS.includes(ending(this.input));
  }

  /** The words that convert the source, apart from the output. */
  convertWords({ convert }) {
    const options = Object.entries(convert).filter(([, value]) => value !== '').flatMap(([key, value]) => [`--${key}`, String(value)]);
    return ['convert', this.input, ...this.rig ? ['--rig', this.rig] : [], ...options];
  }
  materialWords({ materials }) {
    return Object.entries(materials).flatMap(([part, name]) => ['--material', part ? `${part}=${name}` : name]);
  }
  /** The same in a shell, as far as options go; the rest is in the file. */
  commands(state) {
    const quoted = (words) => words.map((word) => (/^[\w@%+=:,./-]+$/.test(word) ? word : `'${word.replaceAll("'", "'\\''")}'`)).join(' ');
    const { name } = this, materials = this.materialWords(state), first = this.isBundle ? [] : [['sbfmt', ...this.convertWords(state), '-o', `${name}.sbf`]];
    if (materials.length) first.push(['sbfmt', 'build', this.isBundle ? this.input : `${name}.sbf`, ...materials, '-o', `${name}.sbf`]);
    return [...first, ['sbfmt', 'pack', `${name}.sbf`, '-o', `${name}.sbfz`]].map(quoted).join('\n');
  }

  /** The character of the present state: { state, bytes, packed, bundle, findings }. */
  async make(options) {
    const { state } = this.history;
    return this.keep(state, async () => {
      const built = await this.edited(state, options), findings = [...built.findings];
      const bytes = Object.keys(state.gait).length ? this.edit(built.bytes, { gait: state.gait }) : built.bytes; // nothing is derived from a gait
      return { state, bytes, packed: await this.pack(bytes, [], findings, options), bundle: new Bundle(new TextDecoder().decode(bytes)), findings };
    });
  }
  /** What make() will give, before it is built: { packed, calibration }. Only where a change from `made` shows in few numbers. */
  async foresee(made, options) {
    const { state } = this.history, rest = (one) => JSON.stringify([one.convert, one.materials, one.soft]), values = Object.entries(state.numbers);
    const isLost = (before, now) => Object.keys(before).some((key) => !(key in now));
    const others = ({ numbers }) => JSON.stringify(Object.entries(numbers).map(([id, all]) => [id, ...Object.entries(all).filter(([key]) => !FORESEEN.includes(key))]).filter((one) => one.length > 1));
    if (this.kept.has(JSON.stringify(state)) || JSON.stringify(state.numbers) === JSON.stringify(made.state.numbers) || rest(state) !== rest(made.state) ||
      others(state) !== others(made.state) || isLost(made.state.gait, state.gait) ||
      Object.entries(made.state.numbers).some(([id, before]) => isLost(before, state.numbers[id] ?? {}))) return undefined;
    const bundle = new Bundle(new TextDecoder().decode(made.bytes));
    for (const [id, all] of values) for (const [key, value] of Object.entries(all)) if (FORESEEN.includes(key)) bundle.foreseeNumber(id, key, value);
    for (const [key, value] of Object.entries(state.gait)) bundle.setGait(key, value);
    return { packed: await this.pack(new TextEncoder().encode(bundle.text), ['--store'], [], options), calibration: bundle.calibration };
  }

  // Each step begins with what the one before has made: a conversion, its materials, its edited source.

  base({ convert }, options) {
    return this.keep(['convert', convert], async () => {
      const findings = [];
      return { bytes: await this.convert({ convert }, `${this.name}.sbf`, findings, options), findings };
    });
  }
  async preset(state, options) {
    const base = await this.base(state, options), words = this.materialWords(state);
    return words.length ? this.keep(['materials', state.convert, state.materials], () => this.build(base, base.bytes, words, options)) : base;
  }
  async edited(state, options) {
    const preset = await this.preset(state, options), { convert, materials, soft, numbers } = state;
    if (!Object.keys(soft).length && !Object.keys(numbers).length) return preset;
    return this.keep(['edited', convert, materials, soft, numbers], () => this.build(preset, this.edit(preset.bytes, { soft, numbers }), [], options));
  }
  /** The kept result of that name, or a new one. */
  async keep(name, make) {
    const key = JSON.stringify(name), result = this.kept.get(key) ?? await make();
    this.kept.delete(key); // so that it is the last to be dropped
    this.kept.set(key, result);
    if (this.kept.size > MOST_KEPT) this.kept.delete(this.kept.keys().next().value);
    return result;
  }
  async convert(state, out, findings, options) {
    if (ending(this.input) === 'sbf') return this.files.get(this.input);
    if (ending(this.input) === 'sbfz') return (await this.call(['unpack', this.input, '-o', out], this.files, findings, options)).get(out);
    return (await this.call([...this.convertWords(state), '-o', out], this.files, findings, options)).get(out);
  }
  /** `bytes` built, with the findings of the step before and its own. */
  async build(before, bytes, words, options) {
    const out = `${this.name}.sbf`, findings = [...before.findings], made = await this.call(['build', out, ...words, '-o', 'built.sbf'], new Map([[out, bytes]]), findings, options);
    return { bytes: made.get('built.sbf'), findings };
  }
  async pack(bytes, words, findings, options) {
    const from = `${this.name}.sbf`, to = `${this.name}.sbfz`;
    return (await this.call(['pack', from, ...words, '-o', to], new Map([[from, bytes], ...this.images]), findings, options)).get(to);
  }
  edit(bytes, { soft = {}, numbers = {}, gait = {} }) {
    const bundle = new Bundle(new TextDecoder().decode(bytes));
    for (const [id, is] of Object.entries(soft)) bundle.setSoft(id, is);
    for (const [id, values] of Object.entries(numbers))
      for (const [key, value] of Object.entries(values)) bundle.setNumber(id, key, value);
    for (const [key, value] of Object.entries(gait)) bundle.setGait(key, value);
    return new TextEncoder().encode(bundle.text);
  }

  /** Images beside the source, which packing puts into the file. */
  get images() {
    return [...this.files].filter(([name]) => /\.(png|jpe?g|webp|tga|bmp)$/i.test(name));
  }

  /** Calls the program; what it says goes to `findings`. Gives the files that it made. */
  async call(words, files, findings, options) {
    const { status, errors, files: made } = await this.program.run(words, files, options);
    if (status) throw new Refused(errors);
    findings.push(...errors.map(findingOf));
    return made;
  }

  /** A file to take away: 'sbf', 'sbfz', 'glb' or 'html', of what make() gave. */
  async takeAway(kind, made, webFiles, options) {
    const from = `${this.name}.sbf`, to = `${this.name}.${kind}`, files = new Map([[from, made.bytes], ...this.images]);
    if (kind === 'sbf') return made.bytes;
    if (kind === 'sbfz') return made.packed;
    if (kind === 'glb') return (await this.call(['pack', from, '-o', to], files, [], options)).get(to);
    for (const [name, bytes] of await webFiles()) files.set(`/web/${name}`, bytes);
    return (await this.call(['export', from, '-o', to], files, [], options)).get(to);
  }
}
