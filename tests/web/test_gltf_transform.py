#!/usr/bin/env python3
"""glTF Transform with the extension class of the npm package: edits of nodes and materials keep a character, equal to the byte where
they do not concern it; edits of its meshes are refused by the program, with what to do."""
import json
import os
import subprocess
import sys
import tempfile

import web_files


def unpacked(path):
    done = subprocess.run([web_files.SBFMT, "unpack", path, "-o", path + ".sbf"], capture_output=True, text=True, check=False)
    if done.returncode != 0:
        return done.stderr
    with open(path + ".sbf", "rb") as stream:
        return stream.read()


def main():
    web_files.need("node", "npm")
    script = os.path.join(os.path.dirname(os.path.abspath(__file__)), "transform_under_node.mjs")
    with tempfile.TemporaryDirectory() as folder:
        lizard = os.path.join(folder, "lizard.glb")
        web_files.run(web_files.SBFMT, "pack", web_files.bundles(folder)["lizard"], "-o", lizard)
        web_files.fresh_project(folder, web_files.tarball())
        versions = [f"@gltf-transform/{part}@4" for part in ("core", "functions", "extensions")]
        if web_files.npm(folder, "install", *versions).returncode != 0:
            web_files.skip("npm could not fetch @gltf-transform")
        with open(script, encoding="utf-8") as stream:
            web_files.write(folder, "transform.mjs", stream.read())
        outcome = json.loads(web_files.run("node", "transform.mjs", lizard, cwd=folder).splitlines()[-1])
        found = {name: unpacked(os.path.join(folder, name + ".glb")) for name in ("lizard", "same", "renumbered", "moved", "quantized", "unaware")}
    faults = [f"{name}: {outcome[name]}" for name in ("same", "renumbered", "moved", "quantized") if outcome[name] != "written"]
    faults += [f"{name}: not the lizard of before: {found[name][:300]}" for name in ("same", "renumbered") if found[name] != found["lizard"]]
    faults += [f"{name}: {found[name][:300]}" for name, code in (("moved", "GLTF_CHANGED"), ("quantized", "GLTF_"), ("unaware", "GLTF_NO_SOFT_BODY"))
               if not isinstance(found[name], str) or code not in found[name]]
    if "was removed, and soft bodies need it" not in outcome["removed"]:
        faults.append(f"a mesh was removed: {outcome['removed']}")
    if faults:
        sys.exit("\n".join(faults))


if __name__ == "__main__":
    main()
