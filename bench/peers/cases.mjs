// The cases that every engine is given, and what theory says of them. SI units, +Y up.

export const FRAME_S = 1 / 60;
const DENSITY = 1000, LENGTH = 1, WIDTH = 0.2;

/** Tetrahedra of a box cell, five each, mirrored from cell to neighbouring cell so that their edges meet. Corner k is at
 * (k & 1, k >> 1 & 1, k >> 2). */
const EVEN = [[0, 1, 2, 4], [3, 2, 1, 7], [5, 4, 7, 1], [6, 7, 4, 2], [1, 2, 4, 7]];
const ODD = EVEN.map(([a, b, c, d]) => [a ^ 1, c ^ 1, b ^ 1, d ^ 1]);

export function signedVolume(x, corners) {
  const a = 3 * corners[0], b = 3 * corners[1], c = 3 * corners[2], d = 3 * corners[3];
  const ux = x[b] - x[a], uy = x[b + 1] - x[a + 1], uz = x[b + 2] - x[a + 2], vx = x[c] - x[a], vy = x[c + 1] - x[a + 1], vz = x[c + 2] - x[a + 2];
  const wx = x[d] - x[a], wy = x[d + 1] - x[a + 1], wz = x[d + 2] - x[a + 2];
  return (ux * (vy * wz - vz * wy) + uy * (vz * wx - vx * wz) + uz * (vx * wy - vy * wx)) / 6;
}

/** A bar of 1 x 0.2 x 0.2 m from x = 0 on, in 10 x 2 x 2 cells. `masses` are those of the points, a quarter of each tetrahedron. */
function bar() {
  const [nx, ny, nz] = [10, 2, 2], cell = LENGTH / nx, points = [], tetrahedra = [];
  const index = (x, y, z) => (x * (ny + 1) + y) * (nz + 1) + z;
  for (let x = 0; x <= nx; x++)
    for (let y = 0; y <= ny; y++) for (let z = 0; z <= nz; z++) points.push(x * cell, y * cell - WIDTH / 2, z * cell - WIDTH / 2);
  for (let x = 0; x < nx; x++)
    for (let y = 0; y < ny; y++)
      for (let z = 0; z < nz; z++)
        for (const corners of (x + y + z) % 2 ? ODD : EVEN)
          tetrahedra.push(corners.map((k) => index(x + (k & 1), y + (k >> 1 & 1), z + (k >> 2))));
  const volumes = tetrahedra.map((corners) => signedVolume(points, corners)), masses = new Float64Array(points.length / 3);
  tetrahedra.forEach((corners, t) => corners.forEach((i) => (masses[i] += DENSITY * volumes[t] / 4)));
  return { points: Float64Array.from(points), tetrahedra, volumes, masses };
}

/** Edges of the tetrahedra, with the volume around each: what springs in their stead are made of. */
export function edgesOf({ points, tetrahedra, volumes }) {
  const edges = new Map();
  tetrahedra.forEach((corners, t) => {
    for (let i = 0; i < 4; i++)
      for (let k = i + 1; k < 4; k++) {
        const [a, b] = [corners[i], corners[k]].sort((p, q) => p - q), key = a * 65536 + b;
        const length = Math.hypot(...[0, 1, 2].map((x) => points[3 * a + x] - points[3 * b + x]));
        if (!edges.has(key)) edges.set(key, { a, b, length, volume: 0 });
        edges.get(key).volume += volumes[t];
      }
  });
  return [...edges.values()];
}

const MATERIAL = { density: DENSITY, young: 5e6, poisson: 0.3 };
const shear = MATERIAL.young / (2 * (1 + MATERIAL.poisson)), lame = MATERIAL.young * MATERIAL.poisson / (1 + MATERIAL.poisson) / (1 - 2 * MATERIAL.poisson);

/** Stiffness of a spring along an edge and of a tetrahedron's volume that have the material's moduli together, if edges point all
 * ways alike: springs alone have both Lame moduli equal; volumes add what the first lacks. N/m, and J/m^6 of half the square of
 * the volume's change. */
export const springStiffness = (edge) => 2.5 * shear * edge.volume / edge.length ** 2;
export const volumeStiffness = (volume) => (lame - shear) / volume;

function bodyCase(options) {
  const shape = bar(), held = [];
  for (let i = 0; options.held && i < shape.masses.length; i++) if (shape.points[3 * i] === 0) held.push(i);
  return { ...shape, ...MATERIAL, length: LENGTH, frames: 60 * options.seconds, ...options, held };
}

/** Held at its low end under its own weight, damped by mass until it rests; the sag of the free end's middle. Theory: Timoshenko. */
function beam() {
  const gravity = 9.81, area = WIDTH ** 2, load = DENSITY * area * gravity, inertia = WIDTH ** 4 / 12;
  const sag = load * LENGTH ** 4 / (8 * MATERIAL.young * inertia) + load * LENGTH ** 2 / (2 * (5 / 6) * shear * area);
  const made = bodyCase({ name: 'beam', held: true, turnsAbout: 0, seconds: 3, gravity, massDamping: 10, angularVelocity: 0 });
  const tip = made.masses.length - 5; // the middle of the last nine points
  return { ...made, theory: sag, reading: (points) => -points[3 * tip + 1], samePoints: false };
}

/** Free, without weight, turning about +Y at 6 rad/s from rest shape on; the angle that it has turned by. Theory: angular momentum
 * stays, and the bar stretches by its own rotation, to first order in the strain. */
function spin() {
  const rate = 6, seconds = 2, stretch = 0.8 * DENSITY * rate ** 2 * (LENGTH / 2) ** 2 / MATERIAL.young;
  const made = bodyCase({ name: 'spin', held: false, turnsAbout: LENGTH / 2, seconds, gravity: 0, massDamping: 0, angularVelocity: rate });
  return { ...made, theory: rate * seconds * (1 - stretch), reading: null, samePoints: true };
}

/** Principal moments of a box that lies along x. */
const boxMoments = (mass, length, width) => [mass * width ** 2 / 6, mass * (length ** 2 + width ** 2) / 12, mass * (length ** 2 + width ** 2) / 12];

/** Rigid boxes in a straight line from the origin on, each on a ball joint at the middle of its end faces, let go from rest. `start`: the
 * middle of each, m; `angle`: from straight below. */
function hung(options) {
  const { links, angle } = options;
  let along = 0;
  for (const link of links) {
    link.moments = boxMoments(link.mass, link.length, link.width);
    link.start = [Math.sin(angle), -Math.cos(angle), 0].map((x) => (along + link.length / 2) * x);
    along += link.length;
  }
  return { gravity: 9.81, length: along, ...options };
}

/** One box of 1 x 0.2 x 0.2 m at 60 degrees, ten seconds. Theory: the period by the arithmetic-geometric mean. */
function pendulum() {
  const made = hung({ name: 'pendulum', angle: Math.PI / 3, frames: 600, links: [{ mass: DENSITY * LENGTH * WIDTH ** 2, length: LENGTH, width: WIDTH }] });
  const [{ mass, moments }] = made.links, inertia = moments[2] + mass * (LENGTH / 2) ** 2;
  let [a, g] = [1, Math.cos(made.angle / 2)];
  for (let i = 0; i < 8; i++) [a, g] = [(a + g) / 2, Math.sqrt(a * g)];
  return { ...made, theory: 2 * Math.PI * Math.sqrt(inertia / (mass * made.gravity * LENGTH / 2)) / a };
}

/** Ten boxes of 0.1 m at 30 degrees, the last a hundred times as heavy, five seconds. */
function chain() {
  const links = Array.from({ length: 10 }, (_, i) => ({ mass: i < 9 ? 0.16 : 16, length: 0.1, width: 0.04 }));
  return hung({ name: 'chain', angle: Math.PI / 6, frames: 300, links });
}

export const CASES = { beam, spin, pendulum, chain };
