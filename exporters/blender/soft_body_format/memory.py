"""Keeps an imported file in the .blend, so that an export can write the parts that Blender cannot represent.

Two documents are kept: the file as it was read, and an export of the unchanged scene. A later export compares its document with the
second. Where both are equal the user has changed nothing, and the export writes the value of the first."""

import zlib

from .sbfmt.document import Record, from_xml, to_xml

# Lists that belong together: if one has changed, all are taken from the scene.
REPLACED_TOGETHER = {"render_mesh": ("normals", "normal_corners"), "uv_set": ("coordinates", "corners"),
            "polygon_mesh": ("polygon_sizes", "polygon_points"), "skin": ("influence_counts", "bones", "weights"),
            "shape_key": ("points", "offsets"), "pin_set": ("points", "offsets", "weights"),
            "spring_set": ("ends", "rest_lengths", "stiffness", "damping", "compression_ratio")}

READ, UNCHANGED, PLACEMENT = "soft_body_format_read", "soft_body_format_untouched", "soft_body_format_placement"


def keep(collection, read, unchanged, space):
    """Stores both documents in the collection that the import made, with the forward direction and the ground height."""
    collection[PLACEMENT] = [float(one) for one in space.placement]
    for name, document in ((READ, read), (UNCHANGED, unchanged)):
        collection[name] = zlib.compress(to_xml(document, canonical=False), 1)


def find_import(objects, space, findings):
    """(file as read, unchanged export) of the import that the objects come from. None if they come from no import or from several,
    or if the forward direction or the ground height has changed since."""
    found = {collection for one in objects for collection in one.users_collection if READ in collection}
    if len(found) != 1:
        return None
    collection = found.pop()
    if any(abs(one - then) > 1e-6 for one, then in zip(space.placement, collection.get(PLACEMENT, (0, 0)))):
        findings.warning(f"{collection.name} was imported with another Looks along or Stands at: what Blender cannot represent, such as clips "
                         "and levels of a build, is left out; set them back to keep it, in Scene > Soft body format")
        return None
    return tuple(from_xml(zlib.decompress(collection[name])) for name in (READ, UNCHANGED))


def same(one, other, field):
    group = REPLACED_TOGETHER.get(one.element.name, ())
    names = group if field.name in group else (field.name, )
    return all(getattr(one, name) == getattr(other, name) for name in names)


def key_of(record, index):
    """The key that identifies an item of a list: its name or other fixed fields, else its index."""
    names = [field.name for field in record.element.fields]
    if "id" in names:
        return record.id
    known = tuple(getattr(record, name) for name in ("name", "kind", "property", "target", "bone", "render_mesh") if name in names)
    return known or index


def by_key(records):
    found = {}
    for index, record in enumerate(records):
        found.setdefault(key_of(record, index), record)
    return found


def merge_documents(read, unchanged, now):
    """The merged document. Title, authors and sources stay those of the file, because Blender does not hold them."""
    merged = merge(read, unchanged, now)
    merged.put("info", read.info)
    return merged


def merge(read, unchanged, now):
    """The file's record with the user's changes. The arguments are three versions of one record."""
    merged = Record(now.element.name)
    for field in now.element.fields:
        value = merged_value(read, unchanged, now, field)
        if value is not None:
            merged.put(field.name, value)
    return merged


def merged_value(read, unchanged, now, field):
    if same(unchanged, now, field):
        return getattr(read, field.name)
    values = [getattr(one, field.name) for one in (read, unchanged, now)]
    if field.type == "many":
        return merge_many(*values)
    if field.is_child and all(value is not None for value in values):
        return merge(*values)
    return values[2]


def merge_many(read, unchanged, now):
    """A merged list in the file's order. New items are last; items that were removed from the scene are removed."""
    before, after = by_key(unchanged), by_key(now)
    merged, known = [], set()
    for index, record in enumerate(read):
        key = key_of(record, index)
        known.add(key)
        if key in before and key in after:
            merged.append(merge(record, before[key], after[key]))
        elif key in after:
            merged.append(after[key])
        elif key not in before:
            merged.append(record)
    return merged + [record for index, record in enumerate(now) if key_of(record, index) not in known]
