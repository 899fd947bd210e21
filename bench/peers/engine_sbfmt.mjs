// Ours, through its npm package. Bundles are written as text and packed by the program, since the package reads packed ones.
import { execFileSync } from 'node:child_process';
import { mkdtempSync, readFileSync, rmSync, writeFileSync } from 'node:fs';
import { tmpdir } from 'node:os';
import { join } from 'node:path';
import { load } from 'sbfmt';
import { FRAME_S } from './cases.mjs';
import { forHung, rotated, turnOf } from './engine_parts.mjs';

const FAR = 1000; // above the ground, which nothing here touches

const list = (numbers) => Array.from(numbers, (x) => +x.toPrecision(9)).join(' ');

/** A surface whose points are all of the lattice's: three faces of each tetrahedron would do; one is enough to name its corners. */
function skinText({ points, tetrahedra }) {
  const faces = tetrahedra.flatMap(([a, b, c, d]) => [[a, b, c], [b, c, d]]);
  return `<render_mesh id="skin"><polygon_mesh target="rendering"><positions>${list(points)}</positions>
<polygon_sizes>${faces.map(() => 3).join(' ')}</polygon_sizes><polygon_points>${faces.flat().join(' ')}</polygon_points></polygon_mesh></render_mesh>`;
}

function embeddingText({ masses, tetrahedra }) {
  const owners = Array.from(masses, (_, i) => tetrahedra.find((corners) => corners.includes(i)));
  return `<embedding render_mesh="skin"><points>${owners.flat().join(' ')}</points>
<weights>${owners.flatMap((corners, i) => corners.map((k) => +(k === i))).join(' ')}</weights></embedding>`;
}

function bodyText(body) {
  const pins = body.held.length ? `<pins><pin_set><points>${body.held.join(' ')}</points></pin_set></pins>` : '';
  return `<?xml version="1.0" encoding="UTF-8"?>
<sbf version="1.0"><asset title="${body.name}"/>
${skinText(body)}
<soft_body id="bar">
<attributes density="${body.density}" young_modulus="${body.young}" poisson_ratio="${body.poisson}" mass_damping="${body.massDamping}" damping_ratio="0"/>
<level name="bar" model="tetrahedra"><positions>${list(body.points)}</positions>
<tetrahedron_mesh target="volume"><tetrahedra>${body.tetrahedra.flat().join(' ')}</tetrahedra></tetrahedron_mesh>
${pins}${embeddingText(body)}</level></soft_body></sbf>\n`;
}

function linkText({ mass, moments, length, width, start }, index, angle) {
  const [c, s] = [Math.cos(angle), Math.sin(angle)];
  const corners = [0, 1, 2, 3, 4, 5, 6, 7].map((k) => [length, width, width].map((size, axis) => (k >> axis & 1 ? size : -size) / 2));
  const turned = corners.flatMap(([x, y, z]) => [start[0] + x * s + y * c, start[1] - x * c + y * s, z]);
  return `<rigid_body id="link${index}" motion="dynamic" mass="${mass}" center="${list(start)}" inertia="${list(moments)}" inertia_rotation="${list(turnOf(angle))}" mask="0">
<polygon_mesh target="collision_detection"><positions>${list(turned)}</positions><polygon_sizes>4 4 4 4 4 4</polygon_sizes>
<polygon_points>0 4 6 2 1 3 7 5 0 1 5 4 2 6 7 3 0 2 3 1 4 5 7 6</polygon_points></polygon_mesh></rigid_body>`;
}

/** Each link hangs on the one before it, the first on a block that stays. Frames have the asset's axes at rest. */
function chainText({ links, angle, name }) {
  const half = (length) => [Math.sin(angle), -Math.cos(angle), 0].map((x) => x * length / 2);
  const joints = links.map(({ length }, i) => `<spherical_joint id="joint${i}" body_a="${i ? `link${i - 1}` : 'block'}" body_b="link${i}">
<frame_a position="${list(i ? half(links[i - 1].length) : [0, 0, 0])}"/><frame_b position="${list(half(length).map((x) => -x))}"/></spherical_joint>`);
  return `<?xml version="1.0" encoding="UTF-8"?>
<sbf version="1.0"><asset title="${name}"/>
<rigid_bodies><rigid_body id="block" mass="1" center="0 0 0" inertia="1 1 1"/>
${links.map((link, i) => linkText(link, i, angle)).join('\n')}</rigid_bodies>
<joints>${joints.join('\n')}</joints></sbf>\n`;
}

function packed(text) {
  const folder = mkdtempSync(join(tmpdir(), 'peers-'));
  try {
    const [source, target] = [join(folder, 'case.sbf'), join(folder, 'case.sbfz')];
    writeFileSync(source, text);
    execFileSync(process.env.SBFMT, ['pack', source, '-o', target]);
    return readFileSync(target);
  } finally {
    rmSync(folder, { recursive: true });
  }
}

const sbfmt = await load();

/** A world with one character of that text; `close` frees both. */
function stage(text, gravity, options) {
  const asset = sbfmt.asset(packed(text)), model = asset.model({ ...options, gravity: [0, -gravity, 0] });
  const world = sbfmt.world({ ground: { kind: 'flat', height: -FAR }, gravity: [0, -gravity, 0], sleepAfter: 0 });
  const character = world.add(model, { position: [0, FAR, 0], holdPose: true });
  const close = () => [world, model, asset].forEach((thing) => thing.free());
  return { world, model, character, close, step: () => world.step(FRAME_S) };
}

/** For each point of the lattice a vertex of the skin, which may have several there. */
function verticesOf(skin, points) {
  const found = [];
  for (let i = 0; i < points.length; i += 3) {
    let best = 0, least = Infinity;
    for (let k = 0; k < skin.length; k += 3) {
      const off = Math.hypot(skin[k] - points[i], skin[k + 1] - points[i + 1], skin[k + 2] - points[i + 2]);
      if (off < least) [best, least] = [k, off];
    }
    found.push(best);
  }
  return found;
}

function soft(body, setting) {
  const { character, model, step, close } = stage(bodyText(body), body.gravity, { scheme: setting.scheme, substeps: setting.substeps });
  const vertices = verticesOf(character.skin().positions, body.points);
  if (body.angularVelocity) character.setSoftVelocity(0, [0, 0, 0], [0, body.angularVelocity, 0]);
  return {
    step, close,
    substeps: model.substeps,
    mass: character.softMotion(0).mass, // of the free points
    points() {
      const { positions } = character.skin(), { origin } = character;
      return Float64Array.from(vertices.flatMap((k) => [0, 1, 2].map((x) => positions[k + x] + origin[x])));
    },
    velocity: () => character.softMotion(0).velocity,
    angularVelocity: () => character.softMotion(0).angularVelocity,
    broken: () => character.health().recoveries > 0,
  };
}

function chain(hung) {
  const { character, step, close } = stage(chainText(hung), hung.gravity, {}), start = rotated(turnOf(hung.angle), [1, 0, 0]);
  const poses = () => hung.links.map((_, i) => {
    const { center, rotation } = character.rigidState(i + 1);
    return { center: center.map((x, k) => x + character.origin[k]), along: rotated(rotation, start) };
  });
  return { step, close, poses, mass: hung.links.reduce((sum, _, i) => sum + character.rigidState(i + 1).mass, 0) };
}

const ours = (scheme, ...counts) => counts.map((substeps) => ({ name: `${scheme} ${substeps} substeps`, scheme, substeps }));
const chosen = { name: 'automatic', scheme: 'automatic', substeps: 0, recommended: true };
const settings = [chosen, ...ours('symplectic', 8, 16, 32, 64, 128), ...ours('position_based', 8, 16, 32, 64, 128), ...ours('block_descent', 5, 10, 20)];
const [finest] = ours('symplectic', 512);

export default {
  name: 'sbfmt', package: 'sbfmt', soft, chain,
  settings: { beam: settings, spin: settings, ...forHung([{ name: 'as the package has it', recommended: true }]) },
  reference: { beam: finest, spin: finest },
};
