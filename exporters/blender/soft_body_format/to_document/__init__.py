"""Writes a Blender scene as the format's source parts. `scene` calls the other modules, each of which writes one kind of part."""

from .scene import NOTHING, Options, SceneWriter

__all__ = ["NOTHING", "Options", "SceneWriter"]
