"""Runs in Blender: exports a ball of about 100,000 vertices once, and prints time and memory. bench_blender.py runs it.

    blender --python measure_export.py -- WRITER SKINNED OUT
"""

import json
import math
import os
import resource
import sys
import time

import addon_utils
import bpy

sys.path.insert(0, __file__.rsplit("/", 1)[0])
import fixtures  # noqa: E402

WRITER, SKINNED, OUT = sys.argv[sys.argv.index("--") + 1:]


def round_mesh(around, rings):
    """A ball of quads and two rings of triangles; Blender's own operator takes long for so many."""
    positions = [(0.0, 0.0, 2.0)]
    positions += [(math.sin(math.pi * j / rings) * math.cos(2 * math.pi * i / around),
                math.sin(math.pi * j / rings) * math.sin(2 * math.pi * i / around), 1 + math.cos(math.pi * j / rings))
               for j in range(1, rings) for i in range(around)]
    positions.append((0.0, 0.0, 0.0))
    last, low = len(positions) - 1, 1 + (rings - 2) * around
    beside = [(i + 1) % around for i in range(around)]
    faces = [(0, 1 + i, 1 + beside[i]) for i in range(around)] + [(last, low + beside[i], low + i) for i in range(around)]
    faces += [(ring + i, ring + around + i, ring + around + beside[i], ring + beside[i])
              for ring in range(1, low, around) for i in range(around)]
    return fixtures.mesh_object("ball", positions, faces)


def large_ball():
    made = round_mesh(400, 250)
    made.data.polygons.foreach_set("use_smooth", [True] * len(made.data.polygons))
    layer = made.data.uv_layers.new(name="map")
    layer.data.foreach_set("uv", [(i * 37 % 1000) / 1000 for i in range(2 * len(made.data.loops))])
    material, _ = fixtures.shaded("skin")
    made.data.materials.append(material)
    made.soft_body_format.role = "RENDER"
    if SKINNED == "skinned":
        rig = fixtures.armature("rig", [(f"bone{i}", f"bone{i - 1}" if i else None, (0, 0, i / 5), (0, 0, (i + 1) / 5), 0)
                                        for i in range(10)])
        heights = [vertex.co.z for vertex in made.data.vertices]
        fixtures.bind(made, rig, {f"bone{i}": {index: 1 - abs(5 * z - i - 0.5) for index, z in enumerate(heights)
                                               if abs(5 * z - i - 0.5) < 1} for i in range(10)})
    bpy.context.view_layer.update()
    return len(made.data.vertices)


class Peak:
    """Memory above the present use; unknown without /proc, as in a folder with another system."""

    def __init__(self):
        self.known = os.path.exists("/proc/self/clear_refs")
        if self.known:
            with open("/proc/self/clear_refs", "w", encoding="ascii") as file:
                file.write("5")  # resets the peak
            self.held = self.kib("VmRSS")

    @staticmethod
    def kib(name):
        with open("/proc/self/status", encoding="ascii") as file:
            return next(int(line.split()[1]) for line in file if line.startswith(name))

    def mib(self):
        return round((self.kib("VmHWM") - self.held) / 1024, 1) if self.known else None


def main():
    bpy.ops.wm.read_homefile(use_empty=True, use_factory_startup=True)
    addon_utils.enable("soft_body_format")
    addon_utils.enable("io_scene_gltf2")
    vertices = large_ball()
    peak = Peak()
    wall, used = time.perf_counter(), resource.getrusage(resource.RUSAGE_SELF)
    if WRITER == "glTF":
        bpy.ops.export_scene.gltf(filepath=OUT, export_format="GLB")
    else:
        # Of a skin its source parts, which glTF has too: a build cuts it into sections, which takes minutes for so many vertices.
        bpy.ops.export_scene.soft_body_format(filepath=OUT, build=SKINNED == "plain")
    wall, after = time.perf_counter() - wall, resource.getrusage(resource.RUSAGE_SELF)
    print("measured " + json.dumps({
        "blender": bpy.app.version_string.split()[0], "vertices": vertices, "wall_s": round(wall, 3),
        "processor_s": round(after.ru_utime + after.ru_stime - used.ru_utime - used.ru_stime, 3),
        "peak_MiB": peak.mib()}))


main()
