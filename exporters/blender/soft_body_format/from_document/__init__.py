"""From the format to Blender: `import_scene` leads; each other module makes one kind of thing."""

from .import_scene import SceneMaker

__all__ = ["SceneMaker"]
