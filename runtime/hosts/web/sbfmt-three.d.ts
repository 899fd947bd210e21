import { Group, Material } from 'three';
import type { Character } from './sbfmt.js';

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
