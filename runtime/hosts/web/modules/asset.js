/* A loaded file: its content, and models made from it. */
import { Lent } from './lent.js';
import { Model } from './model.js';
import { SbfmtError } from './sbfmt_error.js';

const KINDS = ['bones', 'meshes', 'softBodies', 'rigidBodies', 'clips', 'ikChains', 'legs', 'materials', 'textures'];
const ALPHAS = ['opaque', 'mask', 'blend'];

/** Advice for bytes of another kind of file: text that begins with '<' is an .sbf or a server's page. */
function unpacked(failure, bytes) {
  const [first] = new Uint8Array(bytes.buffer, bytes.byteOffset, Math.min(bytes.byteLength, 1));
  const cure = first === 0x3c ? 'it begins as XML does, or a server\'s page; `sbfmt pack` makes one of an .sbf' :
    '`sbfmt convert` makes one of a mesh and its rig';
  return new SbfmtError(`${failure.message}: ${cure}`, failure.code, failure.path);
}

/** A file, loaded and checked. */
export class Asset extends Lent {
  constructor(sbfmt, bytes) {
    super('asset');
    const c = sbfmt.calls, from = bytes instanceof ArrayBuffer ? new Uint8Array(bytes) : bytes;
    if (!ArrayBuffer.isView(from)) throw new TypeError('an asset is made of the bytes of an .sbfz or .glb file: an ArrayBuffer or a Uint8Array');
    this.sbfmt = sbfmt;
    // Uncompressed lists are used in place, aligned as in the file.
    this.memory = sbfmt.room(from.byteLength + 64);
    const at = 64 * Math.ceil(this.memory / 64);
    sbfmt.bytes(at, from.byteLength).set(new Uint8Array(from.buffer, from.byteOffset, from.byteLength));
    this.handle = c.web_asset_load(at, from.byteLength);
    if (this.freed) {
      const failure = sbfmt.failure();
      c.web_free(this.memory);
      throw failure.code === 'PACKED_MAGIC' ? unpacked(failure, from) : failure;
    }
    this.title = sbfmt.text(c.web_asset_title(this.handle));
    for (const [kind, name] of KINDS.entries())
      this[name] = Array.from({ length: c.web_asset_count(this.handle, kind) }, (_, i) => ({
        index: i,
        name: sbfmt.text(c.web_asset_name(this.handle, kind, i)),
      }));
    this.levels = c.web_asset_levels(this.handle);
    this.renderLevels = c.web_asset_render_levels(this.handle);
    for (const bone of this.bones) this.readBone(bone);
    for (const body of this.rigidBodies) body.bone = c.web_asset_rigid_bone(this.handle, body.index);
    for (const body of this.softBodies) body.bone = c.web_asset_body_bone(this.handle, body.index);
    for (const material of this.materials) this.readMaterial(material);
    for (const texture of this.textures) this.readTexture(texture);
  }

  readBone(bone) {
    const { calls, scratch } = this.sbfmt;
    calls.web_asset_bone(this.handle, bone.index, scratch);
    const n = Array.from(this.sbfmt.floats(scratch, 9));
    Object.assign(bone, { parent: n[0], head: n.slice(1, 4), rotation: n.slice(4, 8), length: n[8] });
  }

  readMaterial(material) {
    const { calls, scratch } = this.sbfmt;
    calls.web_asset_material(this.handle, material.index, scratch);
    const n = Array.from(this.sbfmt.floats(scratch, 15));
    Object.assign(material, {
      baseColor: n.slice(0, 4), metallic: n[4], roughness: n[5], emissive: n.slice(6, 9), alphaMode: ALPHAS[n[9]],
      alphaCutoff: n[10], doubleSided: n[11] !== 0, baseColorTexture: n[12], metallicRoughnessTexture: n[13], normalTexture: n[14],
    });
  }

  readTexture(texture) {
    const { calls, scratch } = this.sbfmt, at = calls.web_asset_texture_bytes(this.handle, texture.index, scratch);
    const size = this.sbfmt.words(scratch, 1)[0];
    texture.mediaType = this.sbfmt.text(calls.web_asset_texture_type(this.handle, texture.index));
    texture.path = this.sbfmt.text(calls.web_asset_texture_path(this.handle, texture.index));
    texture.bytes = this.sbfmt.bytes(at, size).slice();
  }

  levelError(level = 0) {
    return this.sbfmt.calls.web_asset_level_error(this.handle, level);
  }

  model(options = {}) {
    return new Model(this, options);
  }

  /** After its models. */
  free() {
    if (this.freed) return;
    this.refuseUsers('models');
    this.sbfmt.calls.web_asset_free(this.handle);
    this.sbfmt.calls.web_free(this.memory);
    this.handle = 0;
  }
}
