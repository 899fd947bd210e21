import { Extension, ExtensionProperty, Property, ReaderContext, WriterContext } from '@gltf-transform/core';

/** The soft bodies of a document: the extension property SBF_soft_body of its root. */
export class SoftBodies extends ExtensionProperty {
  static EXTENSION_NAME: 'SBF_soft_body';
  readonly extensionName: 'SBF_soft_body';
  readonly propertyType: 'SoftBodies';
  readonly parentTypes: string[];
  /** The extension's JSON; indices are keys of references and of bufferViews. */
  definition: object;
  bufferViews: Uint8Array[];
  /** What a node, material, mesh, animation or image of the file is now; key: for example "node/3". */
  getReference(key: string): Property | null;
  setReference(key: string, property: Property): this;
  protected init(): void;
}

/** Keeps SBF_soft_body in files that glTF Transform reads and writes: io.registerExtensions([SBFSoftBody]). Writing throws where
 * a node, material, mesh, clip or image that the soft bodies need was removed. Changed meshes are refused by the runtime. */
export class SBFSoftBody extends Extension {
  static EXTENSION_NAME: 'SBF_soft_body';
  readonly extensionName: 'SBF_soft_body';
  read(context: ReaderContext): this;
  write(context: WriterContext): this;
}
