/* From the files that a visitor brings to the character: what is chosen, in steps that can be undone, and the calls of the
 * program that follow from it. */
import { Bundle } from './studio_bundle.js';

export const BUNDLE_ENDINGS = ['sbf', 'sbfz'], MESH_ENDINGS = ['glb', 'gltf', 'fbx', 'dae', 'obj', 'vrm', 'bvh', 'ply', 'stl', '3ds', 'x'];
/** Of several files the first of these is the mesh, an .obj before its rig. */
const ORDER = ['sbfz', 'sbf', 'obj', 'glb', 'vrm', 'gltf', 'fbx', 'dae', 'ply', 'stl', '3ds', 'x', 'bvh'];
const RIGS = ['glb', 'gltf', 'fbx', 'dae', 'bvh', 'vrm', 'x'];
/** Results that are kept, so that undoing is quick. */
const MOST_KEPT = 6;

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

  /** The character of the present state: { text, packed, bundle, findings, seconds }. */
  async make(options) {
    const { state } = this.history, key = JSON.stringify(state), kept = this.kept.get(key);
    if (kept) return kept;
    const began = performance.now(), base = await this.base(state, options), findings = [...base.findings];
    let { bytes } = base;
    const out = `${this.name}.sbf`;
    const materials = this.materialWords(state);
    if (materials.length) bytes = await this.build(bytes, materials, findings, options);
    if (Object.keys(state.soft).length || Object.keys(state.numbers).length) {
      bytes = await this.build(this.edit(bytes, state), [], findings, options);
    } else if (Object.keys(state.gait).length) {
      bytes = this.edit(bytes, state); // nothing is derived from a gait
    }
    const packed = await this.call(['pack', out, '-o', `${this.name}.sbfz`], new Map([[out, bytes], ...this.images]), findings, options);
    const text = new TextDecoder().decode(bytes);
    const made = { text, bytes, packed: packed.get(`${this.name}.sbfz`), bundle: new Bundle(text), findings, seconds: (performance.now() - began) / 1000 };
    this.keep(key, made);
    return made;
  }
  keep(key, made) {
    this.kept.set(key, made);
    if (this.kept.size > MOST_KEPT) this.kept.delete(this.kept.keys().next().value);
  }

  /** The source converted, before any other change. */
  async base(state, options) {
    const key = JSON.stringify(state.convert), kept = this.kept.get(key);
    if (kept) {
      this.kept.delete(key); // and so the last to be dropped
      this.kept.set(key, kept);
      return kept;
    }
    const findings = [], out = `${this.name}.sbf`;
    const made = { findings, bytes: await this.convert(state, out, findings, options) };
    this.keep(key, made);
    return made;
  }
  async convert(state, out, findings, options) {
    if (ending(this.input) === 'sbf') return this.files.get(this.input);
    if (ending(this.input) === 'sbfz') return (await this.call(['unpack', this.input, '-o', out], this.files, findings, options)).get(out);
    return (await this.call([...this.convertWords(state), '-o', out], this.files, findings, options)).get(out);
  }
  async build(bytes, words, findings, options) {
    const out = `${this.name}.sbf`, made = await this.call(['build', out, ...words, '-o', 'built.sbf'], new Map([[out, bytes]]), findings, options);
    return made.get('built.sbf');
  }
  edit(bytes, { soft, numbers, gait }) {
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
