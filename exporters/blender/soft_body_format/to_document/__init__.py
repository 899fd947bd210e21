"""From a Blender scene to the format's source parts. `scene` leads; each other module writes one kind of part."""

from .scene import NOTHING, Options, SceneWriter

__all__ = ["NOTHING", "Options", "SceneWriter"]
