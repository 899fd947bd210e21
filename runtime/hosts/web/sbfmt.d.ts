/**
 * Soft-bodied characters of the sbfmt format, in a page or under node.
 *
 * Units are SI: metres, seconds, kilograms, newtons, radians; right-handed, +Y up, a character faces +Z. Vectors are
 * [x, y, z], rotations quaternions [x, y, z, w]. The same calls give the same bits on every machine.
 *
* Views (Float32Array, Uint32Array) point into the library's own memory and are valid until the next call: read
* them at once, or copy them with slice(). free() frees an object: a world with its characters and colliders, a model
* after its characters, an asset after its models. Using a freed object throws a TypeError; freeing it again does nothing.
 *
 * Invalid arguments throw a TypeError; calls that the library refuses throw an SbfmtError.
 */

export type Vector = readonly [number, number, number] | ArrayLike<number>;
export type Quaternion = readonly [number, number, number, number];

export class SbfmtError extends Error {
  /** As in spec/codes.md. */
  readonly code: string;
  /** Location of the error in the file, if the file caused it. */
  readonly path: string;
}

/** Makes the library ready. `source`: sbfmt.wasm as bytes, a module, or its URL; default: beside sbfmt.js. */
export function load(source?: BufferSource | WebAssembly.Module | URL | string): Promise<Sbfmt>;

export type Ground =
  | { kind: 'flat'; height?: number }
  /** -45 to 45 degrees, rising towards +Z. */
  | { kind: 'slope'; degrees: number }
  | { kind: 'stairs'; rise: number; run: number }
  | { kind: 'noise'; height: number; seed?: number }
  /** Heights at the corners of squares of `cell` metres, columns along +X, rows along +Z, the first at (x, z); bilinear
   * between them, level beyond the edge. Copied. */
  | { kind: 'heights'; heights: ArrayLike<number>; columns: number; rows: number; cell: number; x?: number; z?: number };

export interface Sbfmt {
  /** Loads and checks an .sbfz file, compressed or stored, or a .glb with soft bodies; throws an SbfmtError with the error and its location. */
  asset(bytes: ArrayBuffer | ArrayBufferView): Asset;
  world(options?: WorldOptions): World;
  /** Heights and unit normals of a ground at positions x, z, x, z, ...: copies. */
  groundAt(ground: Ground, places: ArrayLike<number>): { heights: Float32Array; normals: Float32Array };
}

export interface Named {
  readonly index: number;
  readonly name: string;
}
/** In the rest pose. */
export interface Bone extends Named {
  /** -1: none. */
  readonly parent: number;
  readonly head: number[];
  readonly rotation: number[];
  readonly length: number;
}
export interface Body extends Named {
  /** The bone that it follows; -1: none. */
  readonly bone: number;
}
/** Metallic-roughness, colours linear. Textures are indices into Asset.textures; -1: none. */
export interface Material extends Named {
  readonly baseColor: number[];
  readonly metallic: number;
  readonly roughness: number;
  readonly emissive: number[];
  readonly alphaMode: 'opaque' | 'mask' | 'blend';
  readonly alphaCutoff: number;
  readonly doubleSided: boolean;
  readonly baseColorTexture: number;
  readonly metallicRoughnessTexture: number;
  readonly normalTexture: number;
}
export interface Texture extends Named {
  readonly mediaType: string;
  /** Path relative to the file, if the bytes are not embedded. */
  readonly path: string;
  /** A copy of the image file; empty if it is not embedded. */
  readonly bytes: Uint8Array;
}

export interface Asset {
  readonly title: string;
  readonly bones: readonly Bone[];
  readonly meshes: readonly Named[];
  readonly softBodies: readonly Body[];
  readonly rigidBodies: readonly Body[];
  readonly clips: readonly Named[];
  readonly ikChains: readonly Named[];
  readonly legs: readonly Named[];
  readonly materials: readonly Material[];
  readonly textures: readonly Texture[];
  /** Maximum number of simulation levels of a body, and of render levels of a mesh, including the full one. */
  readonly levels: number;
  readonly renderLevels: number;
  /** Maximum error that bodies state for that level, m; 0: not measured. */
  levelError(level?: number): number;
  model(options?: ModelOptions): Model;
  free(): void;
}

export interface ModelOptions {
  /** Level of each body, 0: the finest; the coarsest if a body has fewer. */
  level?: number;
  scheme?: 'automatic' | 'symplectic' | 'position_based' | 'relaxation' | 'explicit_euler' | 'heun' | 'block_descent';
  /** Substeps per control tick; 0: as many as the scheme needs. */
  substeps?: number;
  /** Drops every pin. */
  free?: boolean;
  /** Gravity that sag-free bodies balance, m/s^2; default: the asset's. */
  gravity?: Vector;
  /** One number at a time instead of four: the same bits, slower. */
  scalar?: boolean;
  /** Also makes levels coarser than `level`, jiggle, and bones only, between which characters change. */
  detailLevels?: boolean;
}
/** A detail level of a character: a level of the file's bodies, jiggle, bones only, or a position only. */
export interface DetailLevel {
  readonly kind: 'soft' | 'jiggle' | 'bones' | 'away';
  /** Of soft ones. */
  readonly level: number;
  /** Maximum error stated by its levels, m. */
  readonly error: number;
  /** Cost of a tick in element visits. */
  readonly visits: number;
}
/** Data shared by the characters of one asset. */
export interface Model {
  readonly asset: Asset;
  readonly level: number;
  readonly substeps: number;
  readonly instructions: string;
  /** Finest first; a single one without `detailLevels`. */
  readonly detailLevels: readonly DetailLevel[];
  free(): void;
}

export interface WorldOptions {
  ground?: Ground;
  /** Instead of each asset's own, m/s^2. */
  gravity?: Vector;
  /** Maximum numbers; 0: 16 and 64. */
  characters?: number;
  colliders?: number;
  /** Time at rest before a body falls asleep, s; 0: never. */
  sleepAfter?: number;
  /** Enables contacts between bodies, up to this number at once (true: 4096). */
  touches?: boolean | number;
}

/** Numbers that a kind does not have are 0; missing bodies are -1, missing colliders 0. */
export interface Event {
  readonly kind: 'footDown' | 'footUp' | 'landed' | 'torn' | 'unsplit' | 'asleep' | 'awake' | 'contactBegin' | 'contactEnd'
    | 'contactHit' | 'detailChanged' | 'memoryRefused';
  readonly character: number;
  readonly leg: number;
  readonly softBody: number;
  readonly rigidBody: number;
  readonly collider: number;
  readonly tick: number;
  /** Impulse of the contact, N s. */
  readonly impulse: number;
  readonly position: number[];
  readonly normal: number[];
  /** Of a contact: the other character (0: none), its body, and the closing speed in m/s. */
  readonly other: number;
  readonly otherSoftBody: number;
  readonly otherRigidBody: number;
  readonly speed: number;
  readonly fromDetailLevel: number;
  readonly toDetailLevel: number;
}

/** The hit of a ray: the id of a collider, or of a character with its body (-1: none). */
export interface Hit {
  readonly collider: number;
  readonly character: number;
  readonly rigidBody: number;
  readonly softBody: number;
  readonly position: number[];
  readonly normal: number[];
  readonly distance: number;
}

export interface World {
  add(model: Model, options?: CharacterOptions): Character;
  collider(options?: ColliderOptions): Collider;
  /** Advances by any frame time, s. Ticks are fixed; reads interpolate between them. */
  step(seconds?: number): void;
  readonly ticks: number;
  /** Soft bodies that were stepped in the last tick. */
  readonly awake: number;
  /** Hash of all mutable state: sixteen hexadecimal digits, the same on every machine. */
  stateHash(): string;
  /** Events of the last step, oldest first; at most 1024. */
  events(): Event[];
  ray(from: Vector, direction: Vector, length?: number): Hit | null;
  /** From now on the world selects detail levels by the views, except for characters with a level set by setDetailLevel. */
  detail(options?: DetailOptions): void;
  /** Sets the cameras, at most four; without any, no character is visible. */
  views(views: readonly View[]): void;
  /** Predicted cost of all characters in the last tick, in element visits. */
  readonly visits: number;
  /** Begins a recording of the calls that move the world. Create characters before it. */
  record(): void;
  /** Ends it. Replayed in a world with the same definition, here or by the program, it gives the same states to the bit. */
  recorded(): Uint8Array;
  /** Begins a replay; throws if the bytes are not a recording. */
  replay(recording: Uint8Array): Replay;
  snapshot(): Uint8Array;
  restore(snapshot: Uint8Array): void;
  free(): void;
}

export interface DetailOptions {
  /** Maximum error on the screen in pixels; default 0.5. */
  errorPx?: number;
  /** Processor time per tick for all characters, microseconds; 0 (default): no budget. */
  budget?: number;
  /** Time of an element visit on this machine; default 6. */
  nsPerVisit?: number;
  /** A coarser detail level is selected if its error is below this fraction of errorPx; default 0.7. */
  coarsenFraction?: number;
  /** Minimum time between changes, s; default 0.5. */
  stay?: number;
  /** Time out of view before the offscreen level, s; negative: never; default 1. */
  offscreenAfter?: number;
}
export interface View {
  eye: Vector;
  forward: Vector;
  /** Vertical field of view, radians, above 0 and at most 3. */
  height: number;
  /** Width over height. */
  ratio: number;
  /** Height in pixels. */
  lines: number;
}

export interface Replay {
  /** Plays calls through the next step and checks the hash after it; false at the end of the recording. */
  frame(): boolean;
  /** Steps in it, steps played, hashes compared, whether one differs, and the first tick with a difference. */
  readonly state: { count: number; frames: number; checks: number; differs: boolean; differsAt: number | null };
  free(): void;
}

export interface ColliderOptions {
  shape?: 'sphere' | 'box' | 'capsule';
  radius?: number;
  halfSizes?: Vector;
  position?: Vector;
  /** Negative: the value of the other body. */
  friction?: number;
  restitution?: number;
}
export interface Collider {
  readonly id: number;
  /** Moves it during the next tick; its velocity acts on bodies in contact. */
  move(position: Vector, rotation?: Quaternion): void;
  /** Teleports it, without velocity. */
  place(position: Vector, rotation?: Quaternion): void;
  free(): void;
}

export interface CharacterOptions {
  /** Of the asset's origin; y counts from the ground below it. */
  position?: Vector;
  heading?: number;
  scale?: number;
  /** Bones stay in their rest pose. */
  holdPose?: boolean;
}

/** Triangles over vertices; each has one normal and one texture coordinate. */
export interface Skin {
  /** Three numbers a vertex, relative to Character.origin. */
  readonly positions: Float32Array;
  readonly normals: Float32Array;
  /** Two numbers a vertex, from the top left; null: none. */
  readonly uvs: Float32Array | null;
  readonly indices: Uint32Array;
  /** Ranges of indices with one material, an index into Asset.materials; -1: none. */
  readonly groups: readonly { start: number; count: number; material: number }[];
}

export interface RigidState {
  readonly mode: 'kinematic' | 'passive' | 'driven';
  /** Relative to Character.origin. */
  readonly position: number[];
  readonly rotation: number[];
  readonly center: number[];
  readonly velocity: number[];
  readonly angularVelocity: number[];
  readonly mass: number;
}

export interface Character {
  readonly id: number;
  readonly model: Model;
  readonly world: World;
  /** Sets the wanted velocity: forward in m/s, turn (left) in rad/s, sideways (left) in m/s, up in m/s
   *  for what swims or flies. */
  drive(forward: number, turn?: number, sideways?: number, up?: number): void;
  /** Moves it along the world's axes (m) and rotates it (rad) in the next tick; its feet follow with steps. */
  displace(by: Vector, turn?: number): void;
  teleport(position: Vector, heading?: number): void;
  reset(): void;
  wake(): void;
  pause(paused?: boolean): void;
  /** Plays a clip, by name or number, in a layer of four; null fades it out. */
  play(clip: string | number | null, how?: { layer?: number; weight?: number; fade?: number; speed?: number; start?: number }): void;
  /** Sets the target of an IK chain, in world space; null removes it. */
  reach(ikChain: number, position: Vector | null, weight?: number): void;
  /** Sets the mode of one rigid body, or of all. */
  rigidMode(mode: 'kinematic' | 'passive' | 'driven', rigidBody?: number): void;
  /** Knocks it over; it gets up by itself. */
  fall(): void;
  readonly posture: 'up' | 'falling' | 'rising';
  /** Applies an impulse in N s at a world position to a simulated rigid body. */
  push(rigidBody: number, place: Vector, impulse: Vector): void;
  rigidState(rigidBody: number): RigidState;
  /** Vertex of a soft body's surface nearest to a world position; -1: no surface. */
  nearestVertex(softBody: number, position: Vector): number;
  /** Pulls a vertex to a target by a damped spring until it is released; another call moves the target. `frequency` in Hz (0: 5),
   * `maxForce` in N (0: 20 times the body's weight). */
  grab(softBody: number, vertex: number, target: Vector, options?: { frequency?: number; maxForce?: number }): void;
  /** Releases the vertex; false if it was not grabbed. */
  release(softBody: number, vertex: number): boolean;
  /** Applies an impulse in N s at a vertex, or (-1) to the whole body. */
  applySoftImpulse(softBody: number, impulse: Vector, vertex?: number): void;
  /** Applies a force in N for a number of seconds at a vertex, or (-1) to the whole body. */
  applySoftForce(softBody: number, force: Vector, seconds: number, vertex?: number): void;
  /** Force on a grabbed vertex in N, mean of the last tick. */
  grabForce(softBody: number, vertex: number): number[];
  /** Reaction of each pin set on the body: N, and N m about `about` (m relative to the origin). -1: no bone, no rigid body. */
  pinReactions(softBody: number): { pinSet: number; bone: number; rigidBody: number; points: number; about: number[]; force: number[]; torque: number[] }[];
  /** Cauchy stress in Pa (xx, yy, zz, xy, yz, zx), J/m^3, m^3 and points of each tetrahedron of the simulated level. */
  tetrahedra(softBody: number): { stress: number[]; energyDensity: number; restVolume: number; volumeRatio: number; corners: number[]; torn: boolean }[];
  /** Velocity in m/s of the body as a whole, and angular velocity in rad/s. */
  setSoftVelocity(softBody: number, velocity: Vector, angularVelocity?: Vector): void;
  /** Its free points as one rigid body: kg, m relative to the origin, m/s, rad/s. */
  softMotion(softBody: number): { mass: number; center: number[]; velocity: number[]; angularVelocity: number[] };
  /** The present detail level, or the one that it is changing to. */
  readonly detailLevel: number;
  /** Sets the detail level; null: selected by the world. With contacts between bodies it keeps a soft level while others are near. */
  setDetailLevel(detailLevel: number | null): void;
  /** Remaining fraction of a change of level, 1 to 0. */
  readonly fade: number;
  /** Visibility set by the host instead of the views. */
  shown(how: 'byViews' | 'always' | 'never'): void;
  /** Predicted error in pixels; 0: not visible. */
  readonly errorPx: number;
  /** Origin of bones and vertices, world space. */
  readonly origin: number[];
  /** Metres walked. */
  readonly distance: number;
  /** Seven numbers a bone: position, rotation from the bone's frame to the world's. */
  bones(): Float32Array;
  legs(): { planted: boolean; steps: number; phase: number; foot: number[]; target: number[] }[];
  /** Over all bodies: minimum volume ratio, maximum strain, energy in J, number of shape resets, number of torn elements. */
  health(): { volumeRatio: number; maxStrain: number; energy: number; recoveries: number; torn: number; valid: boolean; asleep: boolean };
  /** One render mesh at one of its levels, in the present state. */
  skin(mesh?: number, level?: number): Skin;
  /** Springs and edges of lattices as of the last tick, ten numbers each: position, kind and strain of both ends. Kinds: 0
   * structural, 1 shear, 2 flexion, 3 internal, 4 cross-body, 5 edge of a lattice. */
  lines(): Float32Array;
  free(): void;
}
