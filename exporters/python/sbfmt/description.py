"""Summarizes an asset's canonical XML in a dict with the names of `sbfmt info --format json`."""


def words(element, name):
    """The numbers of a list, as text; an empty list if it is left out."""
    found = element.find(name) if element is not None else None
    return found.text.split() if found is not None and found.text else []


def mesh_counts(mesh):
    return {"vertices": len(words(mesh, "positions")) // 3, "polygons": len(words(mesh, "polygon_sizes"))}


def pinned(owner):
    return sum(len(words(one, "points")) for one in owner.iterfind("pins/pin_set")) if owner is not None else 0


def section(body):
    level = body.find("level")
    surface = body.find("polygon_mesh")
    counts = mesh_counts(surface)
    springs = level is not None and level.get("model", "springs") == "springs"
    surface_indices = words(level, "new_from_old")[:counts["vertices"]] if springs else []
    of_surface = sum(index != "4294967295" for index in surface_indices) if surface_indices else counts["vertices"]
    interior = (len(words(level, "positions")) // 3 - of_surface if springs else len(words(body, "interior")) // 3)
    lattice = level.find("tetrahedron_mesh") if level is not None else None
    return {"id": body.get("id"), "name": body.get("name", ""), "bone": body.get("bone"), **counts,
            "interior_points": max(interior, 0), "tetrahedra": len(words(lattice, "tetrahedra")) // 4,
            "pins": pinned(level if level is not None else body)}


def describe(root):
    """The summary of the root element."""
    bodies = root.findall("soft_body")
    springs = {"structural": 0, "shear": 0, "flexion": 0, "internal": 0, "cross_body": 0}
    for body in bodies:
        level = body.find("level")
        for one in level.iterfind("spring_set") if level is not None else ():
            springs[one.get("kind")] += len(words(one, "ends")) // 2
    springs["cross"] = springs.pop("cross_body") + sum(len(words(one, "ends")) // 2 for one in root.iter("cross_springs"))
    sections = [section(body) for body in bodies]
    return {
        "format_version": root.get("version"),
        "render_meshes": [{"id": mesh.get("id"), "name": mesh.get("name", ""), **mesh_counts(mesh.find("polygon_mesh"))}
                          for mesh in root.iterfind("render_mesh")],
        "bones": [{"id": bone.get("id"), "name": bone.get("name", ""), "parent": bone.get("parent")}
                  for bone in root.iterfind("skeleton/bone")],
        "sections": sections,
        "springs": springs,
        "tetrahedra": sum(one["tetrahedra"] for one in sections),
        "pins": sum(one["pins"] for one in sections),
        "attachments": len(root.findall("soft_body/attachments/attachment")),
        "rigid_bodies": len(root.findall("rigid_bodies/rigid_body")),
        "joints": len(root.findall("joints/*")),
        "gait": {"kind": root.find("gait").get("kind", "walk") if root.find("gait") is not None else "none",
                 "legs": len(root.findall("gait/leg"))},
        "levels": max((len(body.findall("level")) for body in bodies), default=0),
    }
