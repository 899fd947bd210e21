"""Imports a document into Blender. `import_scene` calls the other modules, each of which makes one kind of object."""

from .import_scene import SceneMaker

__all__ = ["SceneMaker"]
