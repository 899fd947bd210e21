"""Meshes as they are at rest: modifiers evaluated or not, but nothing that poses or simulates."""

import contextlib

POSING = ("ARMATURE", "SOFT_BODY", "CLOTH", "SURFACE_DEFORM", "MESH_DEFORM", "MESH_CACHE", "MESH_SEQUENCE_CACHE")


@contextlib.contextmanager
def at_rest(objects, view_layer):
    """Turns posing and simulating modifiers off and armatures to their rest pose, and everything back at the end."""
    modifiers = [one for source in objects for one in source.modifiers if one.type in POSING and one.show_viewport]
    armatures = {source.data for source in objects if source.type == "ARMATURE"}
    poses = [(data, data.pose_position) for data in armatures]
    keys = [(source, source.show_only_shape_key, source.active_shape_key_index) for source in objects
            if source.type == "MESH" and source.data.shape_keys is not None]
    try:
        for one in modifiers:
            one.show_viewport = False
        for data, _ in poses:
            data.pose_position = "REST"
        for source, _, _ in keys:
            source.show_only_shape_key, source.active_shape_key_index = True, 0
        view_layer.update()
        yield
    finally:
        for one in modifiers:
            one.show_viewport = True
        for data, position in poses:
            data.pose_position = position
        for source, alone, index in keys:
            source.show_only_shape_key, source.active_shape_key_index = alone, index
        view_layer.update()


@contextlib.contextmanager
def mesh_of(source, depsgraph, apply_modifiers):
    """The object's mesh, evaluated or as edited; it is gone after the `with`."""
    if not apply_modifiers:
        yield source.data
        return
    evaluated = source.evaluated_get(depsgraph)
    mesh = evaluated.to_mesh(preserve_all_data_layers=True, depsgraph=depsgraph)
    try:
        yield mesh
    finally:
        evaluated.to_mesh_clear()
