"""Draws springs, lattices and pins of the last build over the model, coloured by kind."""

import bpy
import gpu
import numpy
from gpu_extras.batch import batch_for_shader

from ..preview.handlers import running
from ..space import Space
from .view_drawing import ViewDrawing, flat_shader

COLORS = {"structural": (0.95, 0.85, 0.2, 0.5), "shear": (0.25, 0.8, 0.95, 0.3), "flexion": (0.75, 0.45, 0.95, 0.15),
          "internal": (0.95, 0.45, 0.2, 0.1), "cross_body": (0.3, 0.95, 0.4, 0.8), "lattice": (0.4, 0.75, 1.0, 0.2),
          "pins": (1.0, 0.15, 0.15, 0.35)}
# The kinds that each choice of the panel shows.
PARTS = {"internal": "INSIDE", "lattice": "LATTICE", "pins": "PINS"}
INSIDE = ("internal", "lattice", "pins")  # drawn through the surface
EDGES = ((0, 1), (0, 2), (0, 3), (1, 2), (1, 3), (2, 3))

# The last build of each scene. It is not saved.
_shown = {}


class Structure:
    """Points of each body, and line ends by kind: {kind: [(body, indices)]}. For pins the indices are single points."""

    def __init__(self, document, space):
        self.document, self.points, self.kinds = document, {}, {}
        for index, body in enumerate(document.soft_bodies):
            if body.levels:
                self.collect(index, body.levels[0], space)

    def collect(self, index, level, space):
        self.points[index] = space.points_back(level.positions)

        def put(kind, indices):
            if len(indices):
                self.kinds.setdefault(kind, []).append((index, numpy.array(indices, dtype=numpy.int64)))

        for springs in level.springs:
            put(springs.kind, springs.ends)
        elements = numpy.array(level.lattice.tetrahedra, dtype=numpy.int64).reshape(-1, 4)
        if len(elements):
            put("lattice", numpy.unique(numpy.sort(numpy.concatenate([elements[:, pair] for pair in EDGES]), axis=1), axis=0).ravel())
        for pins in level.pins:
            put("pins", pins.points)

    def positions(self, kind, session=None):
        """(n, 3) positions of a kind: the session's current ones if it plays this build, else those at rest."""
        plays = session is not None and session.built.document is self.document
        return numpy.concatenate([(session.level_points(body) if plays else self.points[body])[indices]
                                  for body, indices in self.kinds[kind]])


def show(scene, document):
    _shown[scene.name] = Structure(document, Space.of_scene(scene))
    redraw()


def redraw():
    for window in bpy.context.window_manager.windows:
        for area in window.screen.areas:
            area.tag_redraw()


def summary(scene):
    shown = _shown.get(scene.name)
    words = [f"{sum(len(one) for _, one in parts) // (1 if kind == 'pins' else 2)} {kind.replace('_', ' ')}"
             for kind, parts in shown.kinds.items()] if shown else []
    return "built: " + (", ".join(words) or "nothing is soft")


def draw():
    scene = bpy.context.scene
    shown = _shown.get(scene.name)
    if not shown or not scene.soft_body_format.show_overlay:
        return
    shader = flat_shader()
    gpu.state.blend_set("ALPHA")
    gpu.state.point_size_set(2)
    for kind in shown.kinds:
        if PARTS.get(kind, "SURFACE") not in scene.soft_body_format.show_parts:
            continue
        positions = shown.positions(kind, running())
        batch = batch_for_shader(shader, "POINTS" if kind == "pins" else "LINES", {"pos": positions})
        shader.bind()
        shader.uniform_float("color", COLORS.get(kind, COLORS["internal"]))
        gpu.state.depth_test_set("NONE" if kind in INSIDE else "LESS_EQUAL")
        batch.draw(shader)
    gpu.state.depth_test_set("NONE")
    gpu.state.blend_set("NONE")
    gpu.state.point_size_set(1)


_drawing = ViewDrawing(draw)
register = _drawing.register


def unregister():
    _drawing.unregister()
    _shown.clear()
