import { Group, Material } from 'three';
import type { Character, CharacterOptions, Sbfmt, World } from './sbfmt.js';

export interface SoftCharacterOptions {
  /** Of the meshes, 0 the full ones; where there are fewer, the last. */
  renderLevel?: number;
  /** Instead of the file's, in the order of Asset.materials; they stay the program's. */
  materials?: readonly Material[];
}

/** A group of meshes that show a character: call update() after each step of its world. */
export class SoftCharacter extends Group {
  constructor(character: Character, options?: SoftCharacterOptions);
  readonly character: Character;
  /** Takes over where the character is now, into the same buffers. */
  update(): void;
  /** Lets go of geometry and of the file's materials; the character is freed by itself. */
  dispose(): void;
}

export interface SoftBodyPluginOptions {
  /** What load() of the package gave. */
  sbfmt: Sbfmt;
  /** The character is added to it; the program steps it. */
  world: World;
  /** As in World.add. */
  character?: CharacterOptions;
  /** As in SoftCharacterOptions. */
  renderLevel?: number;
}

/** Plugin of GLTFLoader: a .glb with SBF_soft_body gives a result with `softCharacter`, which is part of its scene.
 * Call softCharacter.update() after each step of the world. The still meshes are made invisible. */
export class SoftBodyPlugin {
  constructor(parser: object, options: SoftBodyPluginOptions);
  readonly name: string;
  afterRoot(result: { scene: Group; softCharacter?: SoftCharacter }): Promise<void>;
}
