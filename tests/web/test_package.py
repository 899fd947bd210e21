#!/usr/bin/env python3
"""test_package.py [TARBALL]: tests the npm package in a new project; packs it first if no tarball is named. Installs it, runs its
README's program under node, checks it with TypeScript, and moves it with three.js if npm can fetch them."""
import os
import re
import sys
import tempfile

import web_files

PROGRAM = """
import { readFile } from 'node:fs/promises';
import { load } from 'sbfmt';
const sbfmt = await load();
const world = sbfmt.world({ ground: { kind: 'noise', height: 0.1, seed: 5 } });
const lizard = world.add(sbfmt.asset(await readFile('lizard.sbfz')).model());
lizard.drive(0.3, 0.2);
for (let i = 0; i < 60; i++) world.step(1 / 60);
const { positions, indices } = lizard.skin(0);
if (!positions.every(Number.isFinite) || Math.max(...indices) * 3 + 2 >= positions.length) throw new Error('the skin is broken');
console.log(world.stateHash());
"""
TYPED = """
import { load, type Character, type Ground, SbfmtError } from 'sbfmt';
import { SoftCharacter } from 'sbfmt/three';
import { Scene } from 'three';
const ground: Ground = { kind: 'stairs', rise: 0.1, run: 0.3 };
const sbfmt = await load(new Uint8Array(4));
const world = sbfmt.world({ ground, gravity: [0, -9.8, 0], touches: true });
const one: Character = world.add(sbfmt.asset(new ArrayBuffer(8)).model({ scheme: 'heun', level: 1 }), { position: [0, 1, 0] });
one.push(0, [0, 0, 0], [1, 0, 0]);
const positions: Float32Array = one.skin().positions;
const hash: string = world.stateHash();
const field: Ground = { kind: 'heights', heights: new Float32Array(4), columns: 2, rows: 2, cell: 1 };
world.detail({ errorPx: 1, budget: 500 });
world.views([{ eye: [0, 1, -3], forward: [0, 0, 1], height: 0.8, ratio: 1.6, lines: sbfmt.groundAt(field, [0, 0]).heights.length }]);
one.setDetailLevel(one.model.detailLevels.findIndex((detailLevel) => detailLevel.kind === 'bones'));
one.shown('always');
world.record();
const played: boolean = world.replay(world.recorded()).frame();
const scene = new Scene();
scene.add(new SoftCharacter(one, { renderLevel: 1 }));
// @ts-expect-error a ground that there is not
sbfmt.world({ ground: { kind: 'sea' } });
console.log(positions, hash, played, SbfmtError);
"""
THREE = """
import { readFile } from 'node:fs/promises';
import { load } from 'sbfmt';
import { SoftCharacter } from 'sbfmt/three';
const sbfmt = await load();
const world = sbfmt.world();
const lizard = world.add(sbfmt.asset(await readFile('lizard.sbfz')).model());
const shown = new SoftCharacter(lizard);
const [mesh] = shown.children, buffer = mesh.geometry.attributes.position.array, before = buffer.slice();
lizard.drive(0.3);
for (let i = 0; i < 30; i++) world.step(1 / 60);
shown.update();
const after = mesh.geometry.attributes.position.array;
if (buffer !== after) throw new Error('the buffer is another one');
if (!after.some((x, i) => Math.abs(x - before[i]) > 0.01)) throw new Error('nothing moved');
if (mesh.geometry.groups.length !== mesh.material.length || !(mesh.geometry.boundingSphere.radius > 0.01)) throw new Error('it is not dressed');
shown.dispose();
console.log('good', shown.children.length, mesh.geometry.groups.length);
"""


def written_example(folder, path):
    """The first program of a document, with its file read from disk: the lizard moves as the text says."""
    with open(path, encoding="utf-8") as stream:
        code = re.search(r"```js\n(.*?)```", stream.read(), re.DOTALL).group(1)
    code = "import { readFile } from 'node:fs/promises';\nglobalThis.fetch = async (name) => new Response(await readFile(name));\n" + code
    web_files.write(folder, "written.mjs", code + "\nfor (let i = 1; i < 300; i++) world.step(1 / 60);\n"
          "if (lizard.distance < 0.8 || !positions.length || !normals.length || !indices.length) throw new Error('it stands');\n")
    web_files.run("node", "written.mjs", cwd=folder)


def main():
    web_files.need("node", "npm")
    tarball = os.path.abspath(sys.argv[1]) if len(sys.argv) > 1 else web_files.tarball()
    listed = web_files.run("tar", "-tzf", tarball).split()
    expected = {"package/" + name for name in ("package.json", "README.md", "LICENSE", "sbfmt.js", "sbfmt.d.ts", "sbfmt.wasm",
                                               "sbfmt-three.js", "sbfmt-three.d.ts",
                                               "sbfmt-gltf-transform.js", "sbfmt-gltf-transform.d.ts",
                                               *(f"modules/{name}" for name in os.listdir(os.path.join(web_files.HOST, "modules"))))}
    if set(listed) != expected:
        sys.exit(f"the package holds {sorted(listed)}")
    with tempfile.TemporaryDirectory() as folder:
        lizard = web_files.bundles(folder)["lizard"]
        web_files.fresh_project(folder, tarball)
        web_files.write(folder, "walk.mjs", PROGRAM)
        found = web_files.run("node", "walk.mjs", cwd=folder).strip()
        there = web_files.native(lizard, "--seconds", "1", "--drive", "0.3,0.2", "--ground", "noise:0.1,5")["state_hash"]
        if found != there:
            sys.exit(f"installed it gives {found}, natively {there}")
        written_example(folder, os.path.join(web_files.HOST, "README.md"))
        if web_files.npm(folder, "install", "three@0.170", "@types/three@0.170", "typescript@5").returncode != 0:
            web_files.skip("npm could not fetch three and typescript; what needs neither is good")
        web_files.write(folder, "three.mjs", THREE)
        print(web_files.run("node", "three.mjs", cwd=folder).strip())
        web_files.write(folder, "typed.mts", TYPED)
        web_files.run(os.path.join(folder, "node_modules", ".bin", "tsc"), "--noEmit", "--strict", "--target", "es2022", "--module",
                      "nodenext", "--skipLibCheck", "typed.mts", cwd=folder)


if __name__ == "__main__":
    main()
