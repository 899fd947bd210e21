/**
 * Soft-bodied characters of the sbfmt format, in a page or under node.
 *
 * Units are SI: metres, seconds, kilograms, newtons, radians; right-handed, +Y up, a character faces +Z. Vectors are
 * [x, y, z], rotations quaternions [x, y, z, w]. The same calls give the same bits on every machine.
 *
 * Views (Float32Array, Uint32Array) lie in the library's own memory, and hold until something else is asked or made: read
 * them at once, or copy them with slice(). What was made is freed by free(): a world with its characters and colliders, a model
 * after its characters, an asset after its models. What was freed throws a TypeError when it is used; to free it again does nothing.
 *
 * A TypeError is thrown for arguments that are wrong in themselves, an SbfmtError for what the library refuses.
 */

export type Vector = readonly [number, number, number] | ArrayLike<number>;
export type Quaternion = readonly [number, number, number, number];

export class SbfmtError extends Error {
  /** As in spec/codes.md. */
  readonly code: string;
  /** Where in the file, if it is at fault. */
  readonly path: string;
}

/** Makes the library ready. `source`: sbfmt.wasm as bytes, a module, or where it is; without, beside sbfmt.js. */
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
  /** Loads and checks an .sbfz file, compressed or stored, or a .glb with soft bodies; throws an SbfmtError that says what is wrong and where. */
  asset(bytes: ArrayBuffer | ArrayBufferView): Asset;
  world(options?: WorldOptions): World;
  /** Heights and unit normals of a ground at places x, z, x, z, ...: copies. */
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
  /** The bone it moves with; -1: none. */
  readonly bone: number;
}
/** Metallic-roughness, colours linear. Textures are places in Asset.textures; -1: none. */
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
  /** Relative to the file, where the bytes are not embedded. */
  readonly path: string;
  /** A copy of the image file; empty where it is not embedded. */
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
  /** The most simulation levels of a body, and render levels of a mesh, the full one counted. */
  readonly levels: number;
  readonly renderLevels: number;
  /** The greatest error that bodies state for that level, m; 0: not measured. */
  levelError(level?: number): number;
  model(options?: ModelOptions): Model;
  free(): void;
}

export interface ModelOptions {
  /** Of each body, 0 the finest; where there are fewer, the coarsest. */
  level?: number;
  scheme?: 'automatic' | 'symplectic' | 'position_based' | 'relaxation' | 'explicit_euler' | 'heun' | 'block_descent';
  /** Of a control tick; 0: as many as the scheme needs. */
  substeps?: number;
  /** Drops every pin. */
  free?: boolean;
  /** What sag-free bodies bear, if it is not the asset's. */
  gravity?: Vector;
  /** One number at a time instead of four: the same bits, slower. */
  scalar?: boolean;
  /** Coarser levels than `level` as well, jiggle and bones alone, between which characters change. */
  detailLevels?: boolean;
}
/** What a character may be: a level of the file's bodies, jiggle, bones alone, or but a place. */
export interface DetailLevel {
  readonly kind: 'soft' | 'jiggle' | 'bones' | 'away';
  /** Of soft ones. */
  readonly level: number;
  /** The greatest that its levels state, m. */
  readonly error: number;
  /** What a tick costs, visits of elements. */
  readonly visits: number;
}
/** What many characters of one asset share. */
export interface Model {
  readonly asset: Asset;
  readonly level: number;
  readonly substeps: number;
  readonly instructions: string;
  /** Finest first; one without a detail levels. */
  readonly detailLevels: readonly DetailLevel[];
  free(): void;
}

export interface WorldOptions {
  ground?: Ground;
  /** Instead of each asset's own, m/s^2. */
  gravity?: Vector;
  /** Room for so many; 0: 16 and 64. */
  characters?: number;
  colliders?: number;
  /** Bodies that rest for so long are no longer stepped, s; 0: all always are. */
  sleepAfter?: number;
  /** Bodies meet each other, in so many places at once (true: 4096). */
  touches?: boolean | number;
}

/** Numbers that a kind does not have are 0; bodies and colliders that are not there are -1 and 0. */
export interface Event {
  readonly kind: 'footDown' | 'footUp' | 'landed' | 'torn' | 'unsplit' | 'asleep' | 'awake' | 'contactBegin' | 'contactEnd'
    | 'contactHit' | 'detailChanged' | 'memoryRefused';
  readonly character: number;
  readonly leg: number;
  readonly softBody: number;
  readonly rigidBody: number;
  readonly collider: number;
  readonly tick: number;
  /** N s, of contact. */
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

/** What a ray meets: of a collider its id, else the character's with its body (-1: none). */
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
  /** Any frame time; control runs at its own tick, and reads see the moment in between. */
  step(seconds?: number): void;
  readonly ticks: number;
  /** Soft bodies that were stepped in the last tick. */
  readonly awake: number;
  /** Of all mutable state: sixteen hexadecimal digits, the same on every machine. */
  stateHash(): string;
  /** Events of the last step, oldest first; at most 1024. */
  events(): Event[];
  ray(from: Vector, direction: Vector, length?: number): Hit | null;
  /** From now on the world chooses the detail levels of characters that are put on none, by the views. */
  detail(options?: DetailOptions): void;
  /** From where characters are looked at, at most four; without any nobody is seen. */
  views(views: readonly View[]): void;
  /** What all characters were taken to cost in the last tick. */
  readonly visits: number;
  /** Begins a recording of what moves the world. Make characters before it. */
  record(): void;
  /** Ends it. Played in a world made alike, here or by the program, it gives the same states to the bit. */
  recorded(): Uint8Array;
  /** Begins to play one; throws where the bytes are none. */
  replay(recording: Uint8Array): Replay;
  snapshot(): Uint8Array;
  restore(snapshot: Uint8Array): void;
  free(): void;
}

export interface DetailOptions {
  /** Pixels that a character may be off on the screen; 0.5. */
  errorPx?: number;
  /** Microseconds of processor time a tick for all together; 0: none. */
  budget?: number;
  /** What a visit takes on this machine; 6. */
  nsPerVisit?: number;
  /** A coarser detail level is taken where its error is below this share of errorPx; 0.7. */
  coarsenFraction?: number;
  /** And no sooner after the last change, s; 0.5. */
  stay?: number;
  /** Unseen for so long it goes away, s; negative: never; 1. */
  offscreenAfter?: number;
}
export interface View {
  eye: Vector;
  forward: Vector;
  /** Radians from the lower to the upper edge, above 0, at most 3. */
  height: number;
  /** Width over height. */
  ratio: number;
  /** Pixels from the lower to the upper edge. */
  lines: number;
}

export interface Replay {
  /** Plays up to and with the next step, and compares the hash behind it; false where nothing was left. */
  frame(): boolean;
  /** Steps in it and played, hashes compared, and whether one was another, first at which tick. */
  readonly state: { count: number; frames: number; checks: number; differs: boolean; differsAt: number | null };
  free(): void;
}

export interface ColliderOptions {
  shape?: 'sphere' | 'box' | 'capsule';
  radius?: number;
  halfSizes?: Vector;
  position?: Vector;
  /** Negative: that of what touches it. */
  friction?: number;
  restitution?: number;
}
export interface Collider {
  readonly id: number;
  /** Where it shall be at the end of the next tick: what it touches on the way feels that velocity. */
  move(position: Vector, rotation?: Quaternion): void;
  /** Puts it there at once, without velocity. */
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

/** Triangles over vertices with one normal and one place in the texture each. */
export interface Skin {
  /** Three numbers a vertex, relative to Character.origin. */
  readonly positions: Float32Array;
  readonly normals: Float32Array;
  /** Two a vertex, from the top left; null: none. */
  readonly uvs: Float32Array | null;
  readonly indices: Uint32Array;
  /** Runs of indices that share a material, a place in Asset.materials; -1: none. */
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
  /** What it is to do until told otherwise: forward in m/s, turn (left) in rad/s, sideways (left) in m/s, up in m/s
   *  for what swims or flies. */
  drive(forward: number, turn?: number, sideways?: number, up?: number): void;
  /** Moves it by metres along the world's axes and turns it by radians in the next tick: its feet step after it. */
  displace(by: Vector, turn?: number): void;
  teleport(position: Vector, heading?: number): void;
  reset(): void;
  wake(): void;
  pause(paused?: boolean): void;
  /** Plays a clip, by name or number, in a layer of four; null fades it out. */
  play(clip: string | number | null, how?: { layer?: number; weight?: number; fade?: number; speed?: number; start?: number }): void;
  /** Gives an IK chain a target, in world space; null takes it away. */
  reach(ikChain: number, position: Vector | null, weight?: number): void;
  /** Of one rigid body, or of all. */
  rigidMode(mode: 'kinematic' | 'passive' | 'driven', rigidBody?: number): void;
  /** Knocks it over; it gets up by itself. */
  fall(): void;
  readonly posture: 'up' | 'falling' | 'rising';
  /** An impulse in N s at a place of the world, on a rigid body that is simulated. */
  push(rigidBody: number, place: Vector, impulse: Vector): void;
  rigidState(rigidBody: number): RigidState;
  /** Vertex of a soft body's surface nearest to a place of the world; -1: it has none. */
  nearestVertex(softBody: number, position: Vector): number;
  /** Draws a vertex to a target by a damped spring, until it is released; again to move the target. `frequency` in Hz (0: 5),
   * `maxForce` in N (0: 20 times the body's weight). */
  grab(softBody: number, vertex: number, target: Vector, options?: { frequency?: number; maxForce?: number }): void;
  /** False where it was not held. */
  release(softBody: number, vertex: number): boolean;
  /** An impulse in N s at a vertex, or (-1) on the whole body. */
  applySoftImpulse(softBody: number, impulse: Vector, vertex?: number): void;
  /** A force in N for so many seconds at a vertex, or (-1) on the whole body. */
  applySoftForce(softBody: number, force: Vector, seconds: number, vertex?: number): void;
  /** N on a held vertex, mean of the last tick. */
  grabForce(softBody: number, vertex: number): number[];
  /** What each pin set exerts on the body: N, and N m about `about` (m relative to the origin). -1: not a bone, not a rigid body. */
  pinReactions(softBody: number): { pinSet: number; bone: number; rigidBody: number; points: number; about: number[]; force: number[]; torque: number[] }[];
  /** Cauchy stress in Pa (xx, yy, zz, xy, yz, zx), J/m^3, m^3 and points of each tetrahedron of the simulated level. */
  tetrahedra(softBody: number): { stress: number[]; energyDensity: number; restVolume: number; volumeRatio: number; corners: number[]; torn: boolean }[];
  /** Velocity in m/s of the body as a whole, and angular velocity in rad/s. */
  setSoftVelocity(softBody: number, velocity: Vector, angularVelocity?: Vector): void;
  /** Its free points as one rigid body: kg, m relative to the origin, m/s, rad/s. */
  softMotion(softBody: number): { mass: number; center: number[]; velocity: number[]; angularVelocity: number[] };
  /** The detail level that it is on, or goes over to. */
  readonly detailLevel: number;
  /** Puts it on a detail level; null: the world chooses. In a world whose bodies meet each other it stays on its own. */
  setDetailLevel(detailLevel: number | null): void;
  /** How far the skin still is from going over, 1 to 0. */
  readonly fade: number;
  /** What is known better than by the views. */
  shown(how: 'byViews' | 'always' | 'never'): void;
  /** Pixels that it is taken to be off now; 0: it is not seen. */
  readonly errorPx: number;
  /** What bones and vertices are relative to, in world space. */
  readonly origin: number[];
  /** Metres walked. */
  readonly distance: number;
  /** Seven numbers a bone: place, rotation from the bone's frame to the world's. */
  bones(): Float32Array;
  legs(): { planted: boolean; steps: number; phase: number; foot: number[]; target: number[] }[];
  /** Of all bodies: least volume against rest, greatest strain, J, how often a shape was put back, elements torn. */
  health(): { volumeRatio: number; maxStrain: number; energy: number; recoveries: number; torn: number; valid: boolean; asleep: boolean };
  /** One render mesh, at one of its levels, as it is now. */
  skin(mesh?: number, level?: number): Skin;
  /** Springs and edges of lattices as of the last tick, ten numbers each: place, kind and strain of either end. Kinds: 0
   * structural, 1 shear, 2 flexion, 3 internal, 4 cross-body, 5 edge of a lattice. */
  lines(): Float32Array;
  free(): void;
}
