#!/usr/bin/env python3
"""The npm package and three.js in a page that a server on this machine hands out, as a site of one's own does: Chromium draws the
lizard, it walks across the picture, and its state is the program's. Pictures go to BUILD/web-pictures."""
import json
import os
import sys
import tempfile

import web_files

PAGE = """<!doctype html>
<html lang="en"><meta charset="utf-8"><title>three</title><link rel="icon" href="data:,">
<style>body { margin: 0 } canvas { display: block; width: 100vw; height: 100vh }</style>
<script type="importmap">{ "imports": { "three": "./node_modules/three/build/three.module.js",
  "three/addons/": "./node_modules/three/examples/jsm/", "sbfmt": "./node_modules/sbfmt/sbfmt.js",
  "sbfmt/three": "./node_modules/sbfmt/sbfmt-three.js" } }</script>
<canvas id="canvas"></canvas>
<script type="module">
import * as THREE from 'three';
import { load } from 'sbfmt';
import { GLTFLoader } from 'three/addons/loaders/GLTFLoader.js';
import { SoftBodyPlugin, SoftCharacter } from 'sbfmt/three';

const sbfmt = await load();
const world = sbfmt.world();
const lizard = world.add(sbfmt.asset(await (await fetch('lizard.sbfz')).arrayBuffer()).model());
const shown = new SoftCharacter(lizard), scene = new THREE.Scene();
scene.background = new THREE.Color(0x90b8ff);
scene.add(shown, new THREE.HemisphereLight(0xffffff, 0x604030, 2), new THREE.DirectionalLight(0xffffff, 2));
const box = new THREE.Box3().setFromObject(shown), middle = box.getCenter(new THREE.Vector3()), size = box.getSize(new THREE.Vector3()).length();
const camera = new THREE.PerspectiveCamera(40, innerWidth / innerHeight, 0.01, 100);
camera.position.set(middle.x + 1.6 * size, middle.y + 0.5 * size, middle.z);
camera.lookAt(middle);
const renderer = new THREE.WebGLRenderer({ canvas: document.querySelector('#canvas'), preserveDrawingBuffer: true });
renderer.setSize(innerWidth, innerHeight, false);
globalThis.stage = {
  shown, painter: { gl: renderer.getContext() },
  draw() { renderer.render(scene, camera); },
  walk(frames) {
    lizard.drive(0.3);
    for (let i = 0; i < frames; i++) world.step(1 / 60);
    shown.update();
    this.draw();
    return world.stateHash();
  },
  /** The same lizard as a .glb or .gltf, by three's own loader; drawn in the other's place. */
  async load(file) {
    const other = sbfmt.world(), loader = new GLTFLoader();
    loader.register((parser) => new SoftBodyPlugin(parser, { sbfmt, world: other }));
    const { scene: loaded, softCharacter } = await loader.loadAsync(file);
    const still = [];
    loaded.traverse((node) => { if (node.isMesh && node.parent !== softCharacter) still.push(node.visible); });
    scene.remove(shown);
    scene.add(loaded);
    softCharacter.character.drive(0.3);
    for (let i = 0; i < 120; i++) other.step(1 / 60);
    softCharacter.update();
    this.draw();
    scene.remove(loaded);
    scene.add(shown);
    return { hash: other.stateHash(), still, materials: softCharacter.children.every((mesh) => mesh.material.every((one) => one.name)) };
  },
};
stage.draw();
</script>
"""


def beside_its_buffer(folder, name):
    """The .glb also as a .gltf with a .bin, as editors save it."""
    with open(os.path.join(folder, name), "rb") as stream:
        data = stream.read()
    size = int.from_bytes(data[12:16], "little")
    document = json.loads(data[20:20 + size])
    document["buffers"][0]["uri"] = "lizard.bin"
    web_files.write(folder, "lizard.gltf", json.dumps(document))
    with open(os.path.join(folder, "lizard.bin"), "wb") as stream:
        stream.write(data[28 + size:])


def main():
    web_files.need("node", "npm", "chromium")
    modules = web_files.playwright()
    pictures = os.path.join(web_files.BUILD, "web-pictures")
    os.makedirs(pictures, exist_ok=True)
    script = os.path.join(os.path.dirname(os.path.abspath(__file__)), "three_in_chromium.mjs")
    with tempfile.TemporaryDirectory() as folder:
        lizard = web_files.bundles(folder)["lizard"]
        web_files.fresh_project(folder, web_files.tarball())
        if web_files.npm(folder, "install", "three@0.170").returncode != 0:
            web_files.skip("npm could not fetch three")
        web_files.write(folder, "index.html", PAGE)
        web_files.run(web_files.SBFMT, "pack", lizard, "-o", os.path.join(folder, "lizard.glb"))
        beside_its_buffer(folder, "lizard.glb")
        web_files.run(web_files.SBFMT, "export", lizard, "-o", os.path.join(folder, "plain.glb"))
        with web_files.served(folder) as address:
            reported = web_files.run("node", script, modules, address, pictures)
        found = json.loads(reported.splitlines()[-1])
        there = web_files.native(lizard, "--seconds", "2", "--drive", "0.3,0")["state_hash"]
    for where in ("sbfz", "glb", "gltf"):
        if found[where] != there:
            found["faults"].append(f"from .{where} in the page {found[where]}, natively {there}")
    if found["faults"]:
        sys.exit("\n".join(found["faults"]))


if __name__ == "__main__":
    main()
