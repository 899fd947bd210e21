"""Finds the object, bone and vertices that a diagnostic of the library refers to."""

import re

COLLECTIONS = {"soft_body": "soft_bodies", "render_mesh": "render_meshes"}


class Locator:
    """Maps ids of a checked document to objects and bones of the scene."""

    def __init__(self, document, identifiers):
        self.document = document
        self.owners = {identity: (kind, key) for (kind, key), identity in identifiers.given.items()}

    def locate(self, diagnostic):
        """A dict of "object_name", "bone_name" and "vertices"; unknown ones are left out."""
        match = re.match(r"/sbf/(?:skeleton/|rigid_bodies/|joints/)?(\w+)\[(\d+)\]", diagnostic.path)
        if not match:
            return {}
        name, index = match[1], int(match[2]) - 1
        collection = COLLECTIONS.get(name) or {"bone": "bones", "rigid_body": "rigid_bodies"}.get(name) or \
            ("joints" if name.endswith("_joint") else None)
        records = getattr(self.document, collection) if collection else []
        if index >= len(records):
            return {}
        record = records[index]
        kind, key = self.owners.get(record.id, (None, None))
        if kind in ("mesh", "body"):
            return {"object_name": key, "vertices": self.vertices(record, diagnostic)}
        if kind in ("bone", "rigid", "joint"):
            return {"object_name": key[0], "bone_name": key[1]}
        return {}

    @staticmethod
    def vertices(record, diagnostic):
        """Indices of the vertices at fault: the vertex of a list's item, or the vertices of a polygon."""
        index, mesh = diagnostic.index, record.surface if record.element.name == "soft_body" else record.mesh
        if index < 0:
            return []
        if diagnostic.path.endswith(("/positions", "/influence_counts", "/normals")):
            return [index]
        if diagnostic.path.endswith("/polygon_sizes") and index < len(mesh.polygon_sizes):
            first = sum(mesh.polygon_sizes[:index])
            return list(mesh.polygon_points[first:first + mesh.polygon_sizes[index]])
        if diagnostic.path.endswith("/polygon_points") and index < len(mesh.polygon_points):
            return [mesh.polygon_points[index]]
        return []
