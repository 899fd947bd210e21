// What is measured of a motion.
import { signedVolume } from './cases.mjs';

const cross = ([a, b, c], [x, y, z]) => [b * z - c * y, c * x - a * z, a * y - b * x];
const dot = (a, b) => a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
const at = (numbers, i) => [numbers[3 * i], numbers[3 * i + 1], numbers[3 * i + 2]];
const norm = (a) => Math.hypot(...a);

/** The least volume of a tetrahedron against its rest volume. */
export const leastVolume = (body, points) => Math.min(...body.tetrahedra.map((corners, t) => signedVolume(points, corners) / body.volumes[t]));

export const isFar = (points, start, limit) => points.some((x, i) => !(Math.abs(x - start[i]) < limit));

function centerOf({ masses }, points) {
  const sum = [0, 0, 0];
  masses.forEach((mass, i) => at(points, i).forEach((x, k) => (sum[k] += mass * x)));
  const whole = masses.reduce((a, b) => a + b);
  return sum.map((x) => x / whole);
}

/** Tensor of inertia about the centre, by rows. */
function inertiaOf({ masses }, points, center) {
  const tensor = [[0, 0, 0], [0, 0, 0], [0, 0, 0]];
  masses.forEach((mass, i) => {
    const r = at(points, i).map((x, k) => x - center[k]);
    for (let a = 0; a < 3; a++) for (let b = 0; b < 3; b++) tensor[a][b] += mass * ((a === b ? dot(r, r) : 0) - r[a] * r[b]);
  });
  return tensor;
}

/** a with tensor . a = b, by Cramer's rule. */
function solved([p, q, r], b) {
  const whole = dot(p, cross(q, r));
  return [cross(q, r), cross(r, p), cross(p, q)].reduce((sum, c, row) => sum.map((x, k) => x + c[k] * b[row] / whole), [0, 0, 0]);
}

/** Angular momentum about the centre, and the energy of a rigid body with that momentum and this shape: deformation has the rest. */
export function rotation(body, simulation) {
  const points = simulation.points(), center = centerOf(body, points), tensor = inertiaOf(body, points, center);
  let momentum = [0, 0, 0];
  if (simulation.velocities) {
    const velocities = simulation.velocities();
    body.masses.forEach((mass, i) => cross(at(points, i).map((x, k) => x - center[k]), at(velocities, i)).forEach((x, k) => (momentum[k] += mass * x)));
  } else {
    momentum = tensor.map((row) => dot(row, simulation.angularVelocity()));
  }
  return { momentum, energy: 0.5 * dot(momentum, solved(tensor, momentum)) };
}

/** About +Y, of the shape as a whole against its start, from -pi to pi. */
export function angleOf(body, points) {
  const [now, start] = [centerOf(body, points), centerOf(body, body.points)];
  let [sine, cosine] = [0, 0];
  body.masses.forEach((mass, i) => {
    const [x, , z] = at(points, i).map((p, k) => p - now[k]), [u, , w] = at(body.points, i).map((p, k) => p - start[k]);
    sine += mass * (w * x - u * z);
    cosine += mass * (u * x + w * z);
  });
  return Math.atan2(sine, cosine);
}

export function rootMeanSquare(points, others) {
  let sum = 0;
  for (let i = 0; i < points.length; i++) sum += (points[i] - others[i]) ** 2;
  return Math.sqrt(3 * sum / points.length);
}

export const relative = (value, of) => Math.abs(value / of - 1);
export const change = (now, before) => norm(now.map((x, k) => x - before[k])) / norm(before);

/** The widest gap of a joint: between the ends of two links, or of the first and the origin. */
export function jointGap({ links }, poses) {
  let [gap, before] = [0, [0, 0, 0]];
  poses.forEach(({ center, along }, i) => {
    const half = along.map((x) => x * links[i].length / 2);
    gap = Math.max(gap, norm(center.map((x, k) => x - half[k] - before[k])));
    before = center.map((x, k) => x + half[k]);
  });
  return gap;
}

/** The last angle at which a swing turned back, by a parabola through the frames around it. */
export function lastTurn(angles) {
  let i = angles.length - 2;
  while (i > 0 && !((angles[i] - angles[i - 1]) * (angles[i] - angles[i + 1]) > 0)) i--;
  const [a, b, c] = angles.slice(i - 1, i + 2), slope = (c - a) / 2, curve = a - 2 * b + c;
  return Math.abs(b - slope ** 2 / (2 * curve));
}

/** Mean time of a swing there and back, from where it passes below its hook. */
export function periodOf(angles, frameS) {
  const crossings = [];
  for (let i = 1; i < angles.length; i++)
    if (angles[i - 1] > 0 !== angles[i] > 0) crossings.push((i - angles[i] / (angles[i] - angles[i - 1])) * frameS);
  const count = crossings.length - 1 - (crossings.length - 1) % 2;
  return count >= 2 ? 2 * (crossings[count] - crossings[0]) / count : NaN;
}
