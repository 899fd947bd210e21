/* What the page shows: a character in a world, dressed in its skin, and a camera that looks at it. */
import { Painter, vector } from './viewer_draw.js';

/** The bytes that stand in the page. */
export function bytesIn(selector) {
  return Uint8Array.from(atob(document.querySelector(selector)?.textContent ?? ''), (one) => one.charCodeAt(0));
}
/** Noise hills have the same width for any character: they are not raised for larger ones, or they would be spikes. */
const LARGEST_HILLS = 1.5;
const LANDS = {
  flat: () => ({ kind: 'flat' }),
  uneven: (size) => ({ kind: 'noise', height: 0.12 * Math.min(size, LARGEST_HILLS), seed: 7 }),
  stairs: (size) => ({ kind: 'stairs', rise: 0.03 * size, run: 0.45 * size }),
  slope: () => ({ kind: 'slope', degrees: 12 }),
};

export class Stage {
  constructor(sbfmt, bytes, canvas) {
    this.sbfmt = sbfmt;
    this.canvas = canvas;
    this.painter = new Painter(canvas);
    this.show = { skin: true, springs: false, lattice: false, bones: false, strain: false };
    this.camera = { yaw: 0.72, pitch: 0.26, distance: 1, focus: [0, 0, 0], halfHeight: 0.3 };
    this.choices = { ground: 'uneven', level: 0, renderLevel: 0, speed: 0.5 };
    this.put(sbfmt.asset(bytes));
    this.wearTextures((texture) => bytesIn(`[data-texture="${texture.index}"]`));
  }

  /** Shows another file; one that it cannot show is thrown out again, and what was shown stays. */
  open(bytes) {
    const asset = this.sbfmt.asset(bytes), before = this.asset, { images } = this;
    this.images = undefined;
    try {
      this.put(asset);
    } catch (error) {
      this.images = images;
      this.put(before);
      asset.free();
      throw error;
    }
    before.free();
    images?.forEach((image) => this.painter.freeImage(image));
    this.wearTextures();
  }

  /** Puts a character on the stage, the one before gone. */
  put(asset) {
    this.clear();
    this.model?.free();
    Object.assign(this, { asset, size: 1, model: undefined, detailTable: undefined });
    Object.assign(this.choices, { level: 0, renderLevel: 0 });
    this.restart();
    this.frameCamera();
    this.restart(); // now that the size is known
  }

  /** Frees the world and its meshes. The model stays, because it takes long to make. */
  clear() {
    this.world?.free();
    for (const { skins } of this.world ? this.cast : []) skins.forEach((one) => this.painter.freeMesh(one.mesh));
    if (this.groundMesh) this.painter.freeMesh(this.groundMesh);
    Object.assign(this, { balls: [], skins: [], others: [], world: undefined, groundMesh: undefined });
  }

  /** All detail levels of the character, finest first. Measured when they are first asked for. */
  get allDetailLevels() {
    if (this.detailTable) return this.detailTable;
    if (!this.asset.softBodies.length || !this.asset.bones.length) return this.detailTable = [];
    const model = this.asset.model({ detailLevels: true });
    this.detailTable = model.detailLevels;
    model.free();
    return this.detailTable;
  }
  /** What the runtime has that is coarser than the file's levels. */
  get detailLevels() {
    return this.allDetailLevels.filter(({ kind }) => kind === 'jiggle' || kind === 'bones');
  }
  /** Of the chosen level, m; 0: not measured. */
  get statedError() {
    const { level } = this.choices;
    return Number.isInteger(level) ? this.asset.levelError(level) : this.detailLevels.find(({ kind }) => kind === level).error;
  }

  /** Creates world and character again, at the selected level on the selected ground. */
  restart(ground = LANDS[this.choices.ground](this.size), at) {
    this.clear();
    const { level } = this.choices, ofFile = Number.isInteger(level);
    this.modelOf(ofFile ? level : 'all');
    this.ground = ground;
    this.world = this.sbfmt.world({ ground });
    this.character = this.world.add(this.model, at);
    if (!ofFile) this.character.setDetailLevel(this.model.detailLevels.findIndex(({ kind }) => kind === level));
    this.skins = this.dress(this.character);
    this.rigidOf = new Map(this.asset.rigidBodies.map((body) => [body.bone, body.index]));
    this.mass = this.asset.rigidBodies.reduce((sum, body) => sum + this.character.rigidState(body.index).mass, 0);
    this.time = 0;
  }

  /** Has `model` be that of a level of the file, or of all detail levels. */
  modelOf(what) {
    if (this.model && this.modelled === what) return;
    this.model?.free();
    this.model = undefined;
    this.model = this.asset.model(what === 'all' ? { detailLevels: true } : { level: what });
    this.modelled = what;
  }

  meshOf({ positions, normals, indices }) {
    const mesh = this.painter.mesh(indices);
    this.painter.fill(mesh, positions, normals);
    return mesh;
  }

  /** All characters of the world, the one that is looked at first, with what is drawn of them. */
  get cast() {
    return [{ character: this.character, skins: this.skins }, ...this.others];
  }

  /** What is drawn of each mesh of a character. */
  dress(character) {
    return this.asset.meshes.map((_, i) => {
      const skin = character.skin(i, this.choices.renderLevel);
      const parts = skin.groups.map(({ start, count, material }) => {
        const look = this.asset.materials[material];
        return { start, count, material, color: look ? [...look.baseColor] : [0.37, 0.65, 0.47, 1], roughness: look?.roughness ?? 0.6,
          metallic: look?.metallic ?? 0, image: this.images?.[look?.baseColorTexture] };
      });
      return { mesh: this.painter.mesh(skin.indices, skin.uvs), parts };
    });
  }

  /** `beside`: the bytes of a texture that is not in the file. */
  async wearTextures(beside = () => []) {
    const { asset } = this, images = await Promise.all(asset.textures.map(async (texture) => {
      const bytes = texture.bytes.length ? texture.bytes : beside(texture);
      if (!bytes.length) return undefined;
      try {
        return await createImageBitmap(new Blob([bytes], { type: texture.mediaType }));
      } catch {
        return undefined; // an image that this browser does not read: the plain colour is shown
      }
    }));
    if (asset !== this.asset) return; // another file was opened meanwhile
    this.images = images.map((bitmap) => bitmap && this.painter.image(bitmap));
    for (const { parts } of this.cast.flatMap(({ skins }) => skins))
      for (const part of parts) part.image = this.images[this.asset.materials[part.material]?.baseColorTexture];
  }

  /** Stands where all of the character is seen. */
  frameCamera() {
    const low = [Infinity, Infinity, Infinity], high = [-Infinity, -Infinity, -Infinity], { origin } = this.character;
    const meet = (numbers, stride) => {
      for (let i = 0; i + 2 < numbers.length; i += stride)
        for (let k = 0; k < 3; k++) {
          low[k] = Math.min(low[k], numbers[i + k] + origin[k]);
          high[k] = Math.max(high[k], numbers[i + k] + origin[k]);
        }
    };
    this.asset.meshes.forEach((_, i) => meet(this.character.skin(i, this.choices.renderLevel).positions, 3));
    if (low[0] > high[0]) meet(this.character.lines(), 5);
    if (low[0] > high[0]) meet(this.character.bones(), 7);
    if (low[0] > high[0]) low.fill(-0.5), high.fill(0.5);
    this.size = Math.max(vector.length(vector.subtract(high, low)), 1e-3);
    this.middle = vector.scale(vector.add(low, high), 0.5);
    this.height = this.middle[1] - origin[1];
    this.camera.focus = this.middle;
    this.camera.distance = this.size * 1.6;
  }

  /** In a narrow window more of the height is seen, so that the width stays. */
  get halfHeight() {
    return this.camera.halfHeight * Math.max(1, 1.25 * this.canvas.clientHeight / (this.canvas.clientWidth || 1));
  }

  get eye() {
    const { yaw, pitch, distance, focus } = this.camera;
    return vector.add(focus, vector.scale([Math.sin(yaw) * Math.cos(pitch), Math.sin(pitch), Math.cos(yaw) * Math.cos(pitch)], distance));
  }

  get forward() {
    return vector.unit(vector.subtract(this.camera.focus, this.eye));
  }

  /** Where the character's middle is. */
  get subject() {
    const { origin } = this.character;
    if (!this.asset.bones.length) return vector.add(origin, [this.middle[0], this.height, this.middle[2]]);
    const bones = this.character.bones(), fleshed = new Set(this.asset.softBodies.map((body) => body.bone).filter((bone) => bone >= 0));
    const chosen = fleshed.size ? [...fleshed] : this.asset.bones.map((bone) => bone.index);
    const sum = chosen.reduce((so_far, bone) => vector.add(so_far, bones.subarray(7 * bone, 7 * bone + 3)), [0, 0, 0]);
    return vector.add(origin, vector.scale(sum, 1 / chosen.length));
  }

  /** The direction from the eye through a place of the canvas, in pixels of the page. */
  wayThrough(x, y) {
    const box = this.canvas.getBoundingClientRect(), { halfHeight } = this, { focus } = this.camera;
    const back = vector.unit(vector.subtract(this.eye, focus)), right = vector.unit(vector.cross([0, 1, 0], back)), up = vector.cross(back, right);
    const across = (2 * (x - box.left) / box.width - 1) * halfHeight * box.width / box.height, above = (1 - 2 * (y - box.top) / box.height) * halfHeight;
    return vector.unit(vector.add(vector.add(vector.scale(right, across), vector.scale(up, above)), vector.scale(back, -1)));
  }

  groundHeight(place) {
    return this.sbfmt.groundAt(this.ground, [place[0], place[2]]).heights[0];
  }
}
