// What the engines' programs share.

/** A vector turned by a quaternion [x, y, z, w]. */
export function rotated([x, y, z, w], [a, b, c]) {
  const [p, q, r] = [2 * (y * c - z * b), 2 * (z * a - x * c), 2 * (x * b - y * a)];
  return [a + w * p + y * r - z * q, b + w * q + z * p - x * r, c + w * r + x * q - y * p];
}

/** The rotation about z of links at that angle, as a quaternion. */
export const turnOf = (angle) => [0, 0, Math.sin((angle - Math.PI / 2) / 2), Math.cos((angle - Math.PI / 2) / 2)];

/** The same settings for all hung boxes. */
export const forHung = (settings) => ({ pendulum: settings, chain: settings });
