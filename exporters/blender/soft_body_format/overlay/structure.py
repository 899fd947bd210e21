"""Springs, lattices and pins of the last build, drawn over the model and coloured by kind."""

import bpy
import gpu
import numpy
from gpu_extras.batch import batch_for_shader

from ..space import Space

COLORS = {"structural": (0.95, 0.85, 0.2, 0.5), "shear": (0.25, 0.8, 0.95, 0.3), "flexion": (0.75, 0.45, 0.95, 0.15),
          "internal": (0.95, 0.45, 0.2, 0.1), "cross_body": (0.3, 0.95, 0.4, 0.8), "lattice": (0.4, 0.75, 1.0, 0.2),
          "pins": (1.0, 0.15, 0.15, 0.5)}
INSIDE = ("internal", "lattice", "pins")  # drawn through the surface
EDGES = ((0, 1), (0, 2), (0, 3), (1, 2), (1, 3), (2, 3))

# By scene: {kind: (n, 3) array of line ends, or of points for pins}. Gone when Blender closes: a build makes it anew.
_shown = {}
_handler = None


def points_of(level, space):
    return space.points_back(level.positions)


def collect(document, space):
    """The lines of every body's finest level."""
    lines = {}

    def put(kind, places):
        if len(places):
            lines.setdefault(kind, []).append(places)

    for body in document.soft_bodies:
        if not body.levels:
            continue
        level = body.levels[0]
        places = points_of(level, space)
        for springs in level.springs:
            put(springs.kind, places[numpy.array(springs.ends, dtype=numpy.int64)])
        elements = numpy.array(level.lattice.tetrahedra, dtype=numpy.int64).reshape(-1, 4)
        if len(elements):
            pairs = numpy.unique(numpy.sort(numpy.concatenate([elements[:, pair] for pair in EDGES]), axis=1), axis=0)
            put("lattice", places[pairs.ravel()])
        for pins in level.pins:
            put("pins", places[numpy.array(pins.points, dtype=numpy.int64)])
    return {kind: numpy.concatenate(parts) for kind, parts in lines.items()}


def show(scene, document):
    _shown[scene.name] = collect(document, Space.of_scene(scene))
    for window in bpy.context.window_manager.windows:
        for area in window.screen.areas:
            area.tag_redraw()


def summary(scene):
    found = _shown.get(scene.name, {})
    words = [f"{len(places) // (1 if kind == 'pins' else 2)} {kind.replace('_', ' ')}" for kind, places in found.items()]
    return "built: " + (", ".join(words) or "nothing is soft")


def draw():
    scene = bpy.context.scene
    lines = _shown.get(scene.name)
    if not lines or not scene.soft_body_format.show_overlay:
        return
    shader = gpu.shader.from_builtin("3D_UNIFORM_COLOR" if bpy.app.version < (4, 0, 0) else "UNIFORM_COLOR")
    gpu.state.blend_set("ALPHA")
    gpu.state.point_size_set(3)
    for kind, places in lines.items():
        batch = batch_for_shader(shader, "POINTS" if kind == "pins" else "LINES", {"pos": places})
        shader.bind()
        shader.uniform_float("color", COLORS.get(kind, COLORS["internal"]))
        gpu.state.depth_test_set("NONE" if kind in INSIDE else "LESS_EQUAL")
        batch.draw(shader)
    gpu.state.depth_test_set("NONE")
    gpu.state.blend_set("NONE")
    gpu.state.point_size_set(1)


def register():
    global _handler
    if not bpy.app.background:
        _handler = bpy.types.SpaceView3D.draw_handler_add(draw, (), "WINDOW", "POST_VIEW")


def unregister():
    global _handler
    if _handler is not None:
        bpy.types.SpaceView3D.draw_handler_remove(_handler, "WINDOW")
        _handler = None
    _shown.clear()
