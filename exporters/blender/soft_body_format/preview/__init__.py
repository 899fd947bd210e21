"""The character played in the viewport: `session` runs it, `stage` shows it, `handlers` follow Blender's frames, files and undo."""

from . import handlers

register, unregister = handlers.register, handlers.unregister
