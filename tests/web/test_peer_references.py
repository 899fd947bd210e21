#!/usr/bin/env python3
"""What other engines are compared with (bench/peers): the mesh, closed forms and references agree with each other. Needs node alone."""
import os
import shutil

import web_files

PEERS = os.path.join(web_files.SOURCE, "bench", "peers")
PROGRAM = """
import { CASES, FRAME_S, edgesOf, signedVolume } from './cases.mjs';
import { exactPath } from './exact_chain.mjs';
import { linearRest } from './linear_elements.mjs';
import * as measures from './measures.mjs';
import { springModel } from './spring_model.mjs';

const near = (what, found, wanted, tolerance) => Math.abs(found - wanted) <= tolerance || console.log(`${what}: ${found}, not ${wanted}`);
const beam = CASES.beam(), spin = CASES.spin(), pendulum = CASES.pendulum(), chain = CASES.chain();

near('volume', beam.volumes.reduce((a, b) => a + b), 0.04, 1e-12);
near('tetrahedra that are inside out', beam.tetrahedra.filter((corners) => signedVolume(beam.points, corners) <= 0).length, 0, 0);
near('mass', beam.masses.reduce((a, b) => a + b), 40, 1e-9);
near('points that are held', beam.held.length, 9, 0);
// A closed surface of tetrahedra: points - edges + faces - tetrahedra is 1.
const faces = new Set(beam.tetrahedra.flatMap((corners) => corners.map((out) => corners.filter((i) => i !== out).sort((a, b) => a - b).join())));
near('Euler characteristic', beam.masses.length - edgesOf(beam).length + faces.size - beam.tetrahedra.length, 1, 0);

const path = exactPath(pendulum), angles = path.map(([x, y]) => Math.atan2(x, -y));
near('period', measures.periodOf(angles, FRAME_S) / pendulum.theory, 1, 2e-7);
near('last turn', measures.lastTurn(angles), pendulum.angle, 1e-5);
// Links with all the mass of one bar, joined, fall as it does while they are straight.
const middle = exactPath({ ...chain, frames: 1 })[0];
near('length of the chain after a frame', Math.hypot(...middle), 0.95, 1e-4);
const along = [Math.sin(chain.angle), -Math.cos(chain.angle), 0];
near('gap at rest', measures.jointGap(chain, chain.links.map(({ start }) => ({ center: start, along }))), 0, 1e-12);
near('gap of a link moved by a millimetre', measures.jointGap(chain, chain.links.map(({ start }, i) => ({ center: i ? start : [start[0], start[1], 0.001], along }))), 0.001, 1e-12);

// Twice as stiff, half the sag; and springs sag about as elements do.
const light = { ...beam, gravity: 0.1 * beam.gravity }, sag = light.reading(linearRest(light));
near('sag of twice the modulus', light.reading(linearRest({ ...light, young: 2 * light.young })) / sag, 0.5, 1e-9);
near('sag of elements against theory', sag / (0.1 * beam.theory), 0.66, 0.01);
const springs = springModel(light, { stiffness: 1 });
for (let i = 0; i < light.frames; i++) springs.step();
near('sag of springs', light.reading(springs.points()) / sag, 1, 0.05);

const turning = springModel(spin, { stiffness: 1 });
for (let i = 0; i < 30; i++) turning.step();
near('angle after half a second', measures.angleOf(spin, turning.points()), 3, 0.01);
near('least volume', measures.leastVolume(spin, turning.points()), 1, 0.01);
const whole = measures.rotation(spin, { points: () => spin.points, angularVelocity: () => [0, 6, 0] });
near('energy of rotation', whole.energy, 0.5 * whole.momentum[1] * 6, 1e-9);
"""


def main():
    if not shutil.which("node"):
        web_files.skip("no node")
    faults = web_files.run("node", "--input-type=module", "-e", PROGRAM, cwd=PEERS)
    if faults:
        raise SystemExit(faults)


if __name__ == "__main__":
    main()
