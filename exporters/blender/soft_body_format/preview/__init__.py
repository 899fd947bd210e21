"""Plays the character in the viewport: `session` runs it, `stage` shows it, `handlers` react to Blender's frames, files and undo."""

from . import handlers

register, unregister = handlers.register, handlers.unregister
