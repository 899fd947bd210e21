// The plane motion of hung boxes, with the angle of each as coordinates: Runge-Kutta with steps far below what is measured.
import { FRAME_S } from './cases.mjs';
import { solve } from './linear_elements.mjs';

const STEPS = 100; // of a frame

/** lever[i][j]: how far the middle of link i is along link j. */
const leversOf = (links) => links.map((own, i) => links.map((link, j) => (j < i ? link.length : j === i ? own.length / 2 : 0)));

function accelerations({ links, gravity }, lever, mass, angles, rates) {
  const n = links.length, matrix = mass.map((row, j) => Float64Array.from(row, (m, k) => m * Math.cos(angles[j] - angles[k]) + (j === k ? links[j].moments[2] : 0)));
  const force = new Float64Array(n);
  for (let j = 0; j < n; j++)
    for (let k = 0; k < n; k++) force[j] -= mass[j][k] * Math.sin(angles[j] - angles[k]) * rates[k] ** 2 + links[k].mass * gravity * lever[k][j] * Math.sin(angles[j]);
  return solve(matrix, force);
}

/** The middle of the last link after each frame. */
export function exactPath(hung) {
  const { links } = hung, n = links.length, lever = leversOf(links);
  const mass = links.map((_, j) => links.map((__, k) => links.reduce((sum, link, i) => sum + link.mass * lever[i][j] * lever[i][k], 0)));
  let state = Float64Array.from({ length: 2 * n }, (_, i) => (i < n ? hung.angle : 0));
  const change = (at) => Float64Array.from([...at.subarray(n), ...accelerations(hung, lever, mass, at.subarray(0, n), at.subarray(n))]);
  const ahead = (by, rate) => state.map((x, i) => x + by * rate[i]), h = FRAME_S / STEPS, path = [];
  for (let frame = 0; frame < hung.frames; frame++) {
    for (let i = 0; i < STEPS; i++) {
      const a = change(state), b = change(ahead(h / 2, a)), c = change(ahead(h / 2, b)), d = change(ahead(h, c));
      state = state.map((x, k) => x + h / 6 * (a[k] + 2 * b[k] + 2 * c[k] + d[k]));
    }
    const along = (wave) => links.reduce((sum, _, j) => sum + lever[n - 1][j] * wave(state[j]), 0);
    path.push([along(Math.sin), -along(Math.cos), 0]);
  }
  return path;
}
