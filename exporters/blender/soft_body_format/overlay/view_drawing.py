"""Adds drawing callbacks to the 3D view of every window. Does nothing if Blender runs in the background."""

import bpy
import gpu


class ViewDrawing:
    """`draw` is called after each view's own objects, from `register` until `unregister`."""

    def __init__(self, draw):
        self.draw, self.handler = draw, None

    def register(self):
        if not bpy.app.background:
            self.handler = bpy.types.SpaceView3D.draw_handler_add(self.draw, (), "WINDOW", "POST_VIEW")

    def unregister(self):
        if self.handler is not None:
            bpy.types.SpaceView3D.draw_handler_remove(self.handler, "WINDOW")
            self.handler = None


def flat_shader(polyline=False):
    """Blender's shader of one colour. Before 4.0 its name had another prefix."""
    name = "POLYLINE_UNIFORM_COLOR" if polyline else "UNIFORM_COLOR"
    return gpu.shader.from_builtin(f"3D_{name}" if bpy.app.version < (4, 0, 0) else name)
