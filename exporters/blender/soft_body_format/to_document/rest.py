"""Reads meshes at rest, with or without modifiers, but without posing and simulation."""

import contextlib

import bpy

POSING = ("ARMATURE", "SOFT_BODY", "CLOTH", "SURFACE_DEFORM", "MESH_DEFORM", "MESH_CACHE", "MESH_SEQUENCE_CACHE")


@contextlib.contextmanager
def at_rest(objects, view_layer):
    """Turns posing and simulating modifiers off and sets armatures to their rest pose. Restores both at the end."""
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
def instances_realized(objects, view_layer):
    """Makes instances from geometry nodes part of the mesh, for the time of the `with`."""
    nodes, made = None, []
    try:
        for source in objects:
            if source.library is None and any(one.type == "NODES" and one.show_viewport for one in source.modifiers):
                nodes = nodes or realizing_nodes()
                made.append((source, source.modifiers.new("Realize instances", "NODES")))
                made[-1][1].node_group = nodes
        if made:
            view_layer.update()
        yield
    finally:
        for source, modifier in made:
            source.modifiers.remove(modifier)
        if nodes is not None:
            bpy.data.node_groups.remove(nodes)
            view_layer.update()


def realizing_nodes():
    nodes = bpy.data.node_groups.new("Realize instances", "GeometryNodeTree")
    for name in ("INPUT", "OUTPUT"):
        if hasattr(nodes, "interface"):  # Blender 4.0 and later
            nodes.interface.new_socket("Geometry", in_out=name, socket_type="NodeSocketGeometry")
        else:
            getattr(nodes, f"{name.lower()}s").new("NodeSocketGeometry", "Geometry")
    begin, real, end = (nodes.nodes.new(kind) for kind in ("NodeGroupInput", "GeometryNodeRealizeInstances", "NodeGroupOutput"))
    nodes.links.new(begin.outputs[0], real.inputs[0])
    nodes.links.new(real.outputs[0], end.inputs[0])
    return nodes


def materials_of(source, mesh):
    """Materials by slot: the object's own if the slot says so, else the mesh's. Geometry nodes may add some to the mesh."""
    own = {index: slot.material for index, slot in enumerate(source.material_slots) if slot.link == "OBJECT"}
    of_mesh = [one.original if one is not None else None for one in mesh.materials]
    return [own[index] if index in own else of_mesh[index] if index < len(of_mesh) else None
            for index in range(max([len(of_mesh)] + [index + 1 for index in own]))]


@contextlib.contextmanager
def mesh_of(source, depsgraph, apply_modifiers):
    """The object's mesh, with or without modifiers. It is freed at the end of the `with`."""
    if not apply_modifiers:
        yield source.data
        return
    evaluated = source.evaluated_get(depsgraph)
    mesh = evaluated.to_mesh(preserve_all_data_layers=True, depsgraph=depsgraph)
    try:
        yield mesh
    finally:
        evaluated.to_mesh_clear()
