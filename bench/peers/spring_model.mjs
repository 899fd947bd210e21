// Springs and volumes as Jolt's constraints stand for, stepped explicitly in double precision with steps far below what is measured:
// the converged solution of that model, which Jolt's single precision keeps its own finest settings from.
import { FRAME_S, edgesOf, signedVolume, springStiffness, volumeStiffness } from './cases.mjs';

const STEPS = 48; // of a frame

/** Adds to `forces` those of all springs. */
function addSprings(x, springs, forces) {
  for (const { a, b, length, stiffness } of springs) {
    const dx = x[b] - x[a], dy = x[b + 1] - x[a + 1], dz = x[b + 2] - x[a + 2];
    const now = Math.sqrt(dx * dx + dy * dy + dz * dz), pull = stiffness * (now - length) / now;
    forces[a] += pull * dx, forces[a + 1] += pull * dy, forces[a + 2] += pull * dz;
    forces[b] -= pull * dx, forces[b + 1] -= pull * dy, forces[b + 2] -= pull * dz;
  }
}

/** Adds those of all volumes: each corner is pushed along the normal of the face across. */
function addVolumes(x, volumes, forces) {
  for (const { corners, rest, stiffness } of volumes) {
    const push = -stiffness * (signedVolume(x, corners) - rest) / 6, a = 3 * corners[0];
    for (let i = 1; i < 4; i++) {
      const at = 3 * corners[i], p = 3 * corners[i % 3 + 1], q = 3 * corners[(i + 1) % 3 + 1];
      const px = x[p] - x[a], py = x[p + 1] - x[a + 1], pz = x[p + 2] - x[a + 2], qx = x[q] - x[a], qy = x[q + 1] - x[a + 1], qz = x[q + 2] - x[a + 2];
      const fx = push * (py * qz - pz * qy), fy = push * (pz * qx - px * qz), fz = push * (px * qy - py * qx);
      forces[at] += fx, forces[at + 1] += fy, forces[at + 2] += fz;
      forces[a] -= fx, forces[a + 1] -= fy, forces[a + 2] -= fz;
    }
  }
}

/** The case in that model, as an engine gives it. */
export function springModel(body, { stiffness }) {
  const springs = edgesOf(body).map((edge) => ({ a: 3 * edge.a, b: 3 * edge.b, length: edge.length, stiffness: stiffness * springStiffness(edge) }));
  const volumes = body.tetrahedra.map((corners, t) => ({ corners, rest: body.volumes[t], stiffness: stiffness * volumeStiffness(body.volumes[t]) }));
  const x = Float64Array.from(body.points), v = new Float64Array(x.length), forces = new Float64Array(x.length), h = FRAME_S / STEPS;
  const inverse = Float64Array.from(body.masses, (mass, i) => (body.held.includes(i) ? 0 : 1 / mass)), kept = Math.exp(-body.massDamping * h);
  for (let i = 0; i < inverse.length; i++) {
    v[3 * i] = body.angularVelocity * x[3 * i + 2];
    v[3 * i + 2] = -body.angularVelocity * (x[3 * i] - body.turnsAbout);
  }
  // Leapfrog: velocities are half a step ahead of the points.
  const kick = (by) => {
    forces.fill(0);
    addSprings(x, springs, forces);
    addVolumes(x, volumes, forces);
    for (let i = 0; i < inverse.length; i++) {
      if (inverse[i] === 0) continue;
      for (let k = 0; k < 3; k++) v[3 * i + k] = (v[3 * i + k] + by * (forces[3 * i + k] * inverse[i] - (k === 1 ? body.gravity : 0)));
    }
  };
  kick(h / 2);
  return {
    step() {
      for (let n = 0; n < STEPS; n++) {
        for (let i = 0; i < x.length; i++) x[i] += h * v[i];
        kick(h);
        for (let i = 0; i < v.length; i++) v[i] *= kept;
      }
    },
    close() {},
    points: () => Float64Array.from(x),
  };
}
