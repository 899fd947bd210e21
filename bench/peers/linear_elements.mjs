// The bar's own answer to a small load: linear elasticity of the same tetrahedra, solved directly in double precision. What engines
// that take Young's modulus are checked against.

/** Gradients of the four shape functions, by rows. */
function gradients(points, corners, volume) {
  const p = corners.map((i) => [points[3 * i], points[3 * i + 1], points[3 * i + 2]]), found = [];
  for (let i = 0; i < 4; i++) {
    const [a, b, c] = [0, 1, 2, 3].filter((k) => k !== i).map((k) => p[k]), u = b.map((x, k) => x - a[k]), v = c.map((x, k) => x - a[k]);
    const normal = [u[1] * v[2] - u[2] * v[1], u[2] * v[0] - u[0] * v[2], u[0] * v[1] - u[1] * v[0]];
    const side = p[i].reduce((sum, x, k) => sum + (x - a[k]) * normal[k], 0);
    found.push(normal.map((x) => Math.sign(side) * x / (6 * volume)));
  }
  return found;
}

function stiffnessMatrix(body, size, place) {
  const shear = body.young / (2 * (1 + body.poisson)), lame = body.young * body.poisson / (1 + body.poisson) / (1 - 2 * body.poisson);
  const matrix = Array.from({ length: size }, () => new Float64Array(size));
  body.tetrahedra.forEach((corners, t) => {
    const g = gradients(body.points, corners, body.volumes[t]);
    for (let i = 0; i < 4; i++)
      for (let k = 0; k < 4; k++) {
        const [row, column] = [place[corners[i]], place[corners[k]]];
        if (row < 0 || column < 0) continue;
        const inner = g[i][0] * g[k][0] + g[i][1] * g[k][1] + g[i][2] * g[k][2];
        for (let a = 0; a < 3; a++)
          for (let b = 0; b < 3; b++)
            matrix[3 * row + a][3 * column + b] += body.volumes[t] * (lame * g[i][a] * g[k][b] + shear * (g[i][b] * g[k][a] + (a === b ? inner : 0)));
      }
  });
  return matrix;
}

/** x with matrix . x = b, the matrix positive definite; both are overwritten. */
export function solve(matrix, b) {
  const n = b.length;
  for (let i = 0; i < n; i++)
    for (let row = i + 1; row < n; row++) {
      const factor = matrix[row][i] / matrix[i][i];
      if (factor === 0) continue;
      for (let k = i; k < n; k++) matrix[row][k] -= factor * matrix[i][k];
      b[row] -= factor * b[i];
    }
  for (let i = n - 1; i >= 0; i--) {
    for (let k = i + 1; k < n; k++) b[i] -= matrix[i][k] * b[k];
    b[i] /= matrix[i][i];
  }
  return b;
}

/** Points of the held body at rest, for small displacements. */
export function linearRest(body) {
  const place = Array.from(body.masses, () => -1), free = [...place.keys()].filter((i) => !body.held.includes(i));
  free.forEach((i, k) => (place[i] = k));
  const load = new Float64Array(3 * free.length);
  free.forEach((i, k) => (load[3 * k + 1] = -body.gravity * body.masses[i]));
  const moved = solve(stiffnessMatrix(body, load.length, place), load);
  return body.points.map((x, i) => x + (place[Math.floor(i / 3)] < 0 ? 0 : moved[3 * place[Math.floor(i / 3)] + i % 3]));
}
