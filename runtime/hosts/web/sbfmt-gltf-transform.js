/* SBF_soft_body for glTF Transform: a .glb keeps its soft bodies when nodes, materials and scenes are edited. */
import { Extension, ExtensionProperty, PropertyType, RefMap } from '@gltf-transform/core';

const NAME = 'SBF_soft_body';

/* What members of a `gltf` object name: a list of the reader, and the index map of the writer. */
const LISTS = { node: 'nodes', material: 'materials', mesh: 'meshes', animation: 'animations', image: 'textures' };
const MAPS = { node: 'nodeIndexMap', material: 'materialIndexMap', mesh: 'meshIndexMap', animation: 'animationIndexMap', image: 'imageIndexMap' };

/** A copy of the extension's JSON with every index of a buffer view and of the glTF document replaced by what `replace(kind, index)` returns. */
function withIndices(value, replace) {
  if (Array.isArray(value)) return value.map((item) => withIndices(item, replace));
  if (value === null || typeof value !== 'object') return value;
  const copy = {};
  for (const [name, member] of Object.entries(value)) {
    if (name === 'bufferView') copy[name] = replace(name, member);
    else if (name === 'gltf' && typeof member === 'object') {
      copy[name] = withIndices(member, replace);
      for (const kind of Object.keys(LISTS)) if (kind in member) copy[name][kind] = replace(kind, member[kind]);
    } else copy[name] = withIndices(member, replace);
  }
  return copy;
}

/** The soft bodies of a document, on its root. `references` follow what they name when it is moved or merged. */
export class SoftBodies extends ExtensionProperty {
  static EXTENSION_NAME = NAME;

  init() {
    this.extensionName = NAME;
    this.propertyType = 'SoftBodies';
    this.parentTypes = [PropertyType.ROOT];
    this.definition = {};
    this.bufferViews = [];
  }

  getDefaults() {
    return Object.assign(super.getDefaults(), { references: new RefMap() });
  }

  copy(other, resolve) {
    super.copy(other, resolve);
    this.definition = other.definition;
    this.bufferViews = other.bufferViews;
    return this;
  }

  setReference(key, property) {
    return this.setRefMap('references', key, property);
  }

  getReference(key) {
    return this.getRefMap('references', key);
  }
}

/** Register it before reading: io.registerExtensions([SBFSoftBody]). */
export class SBFSoftBody extends Extension {
  static EXTENSION_NAME = NAME;
  extensionName = NAME;
  prewriteTypes = [PropertyType.BUFFER];

  read(context) {
    const from = context.jsonDoc.json.extensions?.[NAME];
    if (!from) return this;
    const bodies = new SoftBodies(this.document.getGraph());
    bodies.definition = withIndices(from, (kind, index) => {
      if (kind === 'bufferView') return bodies.bufferViews.push(context.bufferViews[index].slice()) - 1;
      const key = `${kind}/${index}`, property = context[LISTS[kind]][index];
      if (!property) throw new Error(`${NAME} names ${kind} ${index}, which the file does not have`);
      bodies.setReference(key, property);
      return key;
    });
    this.document.getRoot().setExtension(NAME, bodies);
    return this;
  }

  prewrite(context) {
    const root = this.document.getRoot(), bodies = root.getExtension(NAME);
    if (!bodies) return this;
    const buffer = root.listBuffers()[0] ?? this.document.createBuffer();
    context.otherBufferViews.set(buffer, [...context.otherBufferViews.get(buffer) ?? [], ...bodies.bufferViews]);
    return this;
  }

  write(context) {
    const bodies = this.document.getRoot().getExtension(NAME);
    if (!bodies) return this;
    const { json } = context.jsonDoc;
    json.extensions = { ...json.extensions, [NAME]: withIndices(bodies.definition, (kind, key) => {
      if (kind === 'bufferView') return context.otherBufferViewsIndexMap.get(bodies.bufferViews[key]);
      const index = context[MAPS[kind]].get(bodies.getReference(key));
      if (index === undefined) throw new Error(`${NAME}: ${key} of the original file was removed, and soft bodies need it`);
      return index;
    }) };
    return this;
  }
}
