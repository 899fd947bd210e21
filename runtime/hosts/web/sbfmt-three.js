/* Characters in three.js: geometry that the runtime moves in place. `three` is the program's own. */
import * as THREE from 'three';

const COLOR_SPACE = THREE.SRGBColorSpace;

/** A group of meshes that show a character; call update() after each step. */
export class SoftCharacter extends THREE.Group {
  constructor(character, { renderLevel = 0, materials } = {}) {
    super();
    this.character = character;
    this.renderLevel = renderLevel;
    const { asset } = character.model;
    this.ownMaterials = materials ? [] : asset.materials.map((one) => materialOf(asset, one));
    this.plain = materials ? undefined : new THREE.MeshStandardMaterial({ color: 0x5fa777, roughness: 0.6 });
    const looks = materials ?? this.ownMaterials;
    for (const { index, name } of asset.meshes) {
      const skin = character.skin(index, renderLevel), geometry = new THREE.BufferGeometry();
      for (const attribute of ['positions', 'normals'])
        geometry.setAttribute(attribute.slice(0, -1),
          new THREE.BufferAttribute(skin[attribute].slice(), 3).setUsage(THREE.DynamicDrawUsage));
      if (skin.uvs) geometry.setAttribute('uv', new THREE.BufferAttribute(skin.uvs.slice(), 2));
      geometry.setIndex(new THREE.BufferAttribute(skin.indices.slice(), 1));
      skin.groups.forEach(({ start, count }, i) => geometry.addGroup(start, count, i));
      const mesh = new THREE.Mesh(geometry, skin.groups.map(({ material }) => looks[material] ?? this.plain ?? looks[0]));
      mesh.name = name;
      mesh.castShadow = mesh.receiveShadow = true;
      mesh.userData.index = index;
      this.add(mesh);
    }
    this.update();
  }

  /** Takes over where the character is now. */
  update() {
    this.position.fromArray(this.character.origin);
    for (const mesh of this.children) {
      const index = mesh.userData.index;
      if (index === undefined) continue;
      const skin = this.character.skin(index, this.renderLevel), { attributes } = mesh.geometry;
      attributes.position.array.set(skin.positions);
      attributes.normal.array.set(skin.normals);
      attributes.position.needsUpdate = attributes.normal.needsUpdate = true;
      mesh.geometry.boundingBox = null; // three.js makes it again where it is asked for
      mesh.geometry.computeBoundingSphere();
    }
  }

  /** Lets go of what three.js holds; the character is freed by itself. */
  dispose() {
    for (const mesh of this.children) mesh.geometry?.dispose();
    for (const material of [...this.ownMaterials, this.plain]) {
      material?.map?.dispose();
      material?.dispose();
    }
    this.removeFromParent();
  }
}

const EXTENSION = 'SBF_soft_body';

/**
 * Plugin of three.js' GLTFLoader: a character in a file with SBF_soft_body comes alive.
 *   loader.register((parser) => new SoftBodyPlugin(parser, { sbfmt, world }));
 * The result then has `softCharacter`, a SoftCharacter that is part of its scene and takes the place of the still meshes.
 */
export class SoftBodyPlugin {
  constructor(parser, { sbfmt, world, character, renderLevel = 0 }) {
    this.name = EXTENSION;
    Object.assign(this, { parser, sbfmt, world, options: character, renderLevel });
  }

  /** Called by the loader when all else of the file is loaded. */
  async afterRoot(gltf) {
    const { parser } = this;
    if (!parser.json.extensions?.[EXTENSION]) return;
    const asset = this.sbfmt.asset(await binaryOf(parser));
    const character = this.world.add(asset.model(), this.options);
    const materials = await parser.getDependencies('material'); // with all their textures
    const shown = new SoftCharacter(character, { renderLevel: this.renderLevel,
      materials: materials.length > 0 && materials.length === asset.materials.length ? materials : undefined });
    gltf.scene.traverse((node) => { if (node.isMesh) node.visible = false; });
    gltf.scene.add(shown);
    gltf.softCharacter = shown;
  }
}

/** The file as one .glb, as the runtime reads it. The loader keeps its two chunks; a .gltf has its buffer beside it. */
async function binaryOf(parser) {
  const chunks = parser.extensions.KHR_binary_glTF, { buffers = [] } = parser.json;
  if (buffers.length > 1) throw new Error(`${EXTENSION}: the file has ${buffers.length} buffers; pack it as one .glb`);
  const body = chunks?.body ?? (buffers.length ? await parser.getDependency('buffer', 0) : new ArrayBuffer(0));
  const content = chunks?.content ?? JSON.stringify({ ...parser.json, buffers: [{ byteLength: body.byteLength }] });
  const text = new TextEncoder().encode(content), padded = (length) => (length + 3) & ~3;
  const textSize = padded(text.length), bodySize = padded(body.byteLength), all = new Uint8Array(28 + textSize + bodySize);
  const view = new DataView(all.buffer), put = (at, ...words) => words.forEach((word, i) => view.setUint32(at + 4 * i, word, true));
  put(0, 0x46546c67, 2, all.length, textSize, 0x4e4f534a); // "glTF", its version; "JSON"
  all.fill(0x20, 20, 20 + textSize).set(text, 20);
  put(20 + textSize, bodySize, 0x004e4942); // "BIN"
  all.set(new Uint8Array(body), 28 + textSize);
  return all;
}

/** A material of the file; its image, where it is embedded, is loaded where the program runs in a page. */
function materialOf(asset, from) {
  const material = new THREE.MeshStandardMaterial({
    name: from.name, metalness: from.metallic, roughness: from.roughness, opacity: from.baseColor[3],
    transparent: from.alphaMode === 'blend', alphaTest: from.alphaMode === 'mask' ? from.alphaCutoff : 0,
    side: from.doubleSided ? THREE.DoubleSide : THREE.FrontSide,
  });
  material.color.setRGB(from.baseColor[0], from.baseColor[1], from.baseColor[2]);
  material.emissive.setRGB(...from.emissive);
  const image = asset.textures[from.baseColorTexture];
  if (image?.bytes.length && typeof createImageBitmap === 'function')
    createImageBitmap(new Blob([image.bytes], { type: image.mediaType })).then((bitmap) => {
      material.map = Object.assign(new THREE.Texture(bitmap), { flipY: false, colorSpace: COLOR_SPACE, wrapS: THREE.RepeatWrapping,
        wrapT: THREE.RepeatWrapping, needsUpdate: true });
      material.needsUpdate = true;
    }, () => undefined); // an image that this browser does not read: the plain colour stays
  return material;
}
