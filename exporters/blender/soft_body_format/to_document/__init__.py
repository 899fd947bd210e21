"""From a Blender scene to the format's source parts. `scene` leads; each other module writes one kind of part."""

from .scene import Options, SceneWriter

__all__ = ["Options", "SceneWriter"]
