"""What an imported file said, kept in the .blend, so that an export gives back what Blender has no place for.

Two documents are kept: the file as it was read, and what an export of the untouched scene says. An export compares its own with the
second: what is the same there nobody has changed, and the first one's word stands."""

import zlib

from .sbfmt.document import Record, from_xml, to_xml

# Lists that say something together alone: where one has changed all are taken from the scene.
TOGETHER = {"render_mesh": ("normals", "normal_corners"), "uv_set": ("coordinates", "corners"),
            "polygon_mesh": ("polygon_sizes", "polygon_points"), "skin": ("influence_counts", "bones", "weights"),
            "shape_key": ("points", "offsets"), "pin_set": ("points", "offsets", "weights"),
            "spring_set": ("ends", "rest_lengths", "stiffness", "damping", "compression_ratio")}

READ, UNTOUCHED, PLACEMENT = "soft_body_format_read", "soft_body_format_untouched", "soft_body_format_placement"


def keep(collection, read, untouched, space):
    """In the collection that the import made, with where ahead and the ground were then."""
    collection[PLACEMENT] = [float(one) for one in space.placement]
    for name, document in ((READ, read), (UNTOUCHED, untouched)):
        collection[name] = zlib.compress(to_xml(document, canonical=False), 1)


def recall(objects, space, findings):
    """(file as read, untouched export) of the one import that objects come from; None where they come from none, or several, or
    where ahead or the ground are elsewhere since."""
    found = {collection for one in objects for collection in one.users_collection if READ in collection}
    if len(found) != 1:
        return None
    collection = found.pop()
    if any(abs(one - then) > 1e-6 for one, then in zip(space.placement, collection.get(PLACEMENT, (0, 0)))):
        findings.warning(f"{collection.name} was imported with another Looks along or Stands at: what Blender has no place for, as clips "
                         "and levels of a build, is left out; set them back to keep it, in Scene > Soft body format")
        return None
    return tuple(from_xml(zlib.decompress(collection[name])) for name in (READ, UNTOUCHED))


def same(one, other, field):
    group = TOGETHER.get(one.element.name, ())
    names = group if field.name in group else (field.name, )
    return all(getattr(one, name) == getattr(other, name) for name in names)


def key_of(record, index):
    """By what an object of a list is known again."""
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


def merge_documents(read, untouched, now):
    """Title, authors and sources have no place in Blender, where `now` takes them from the .blend: the file's stay."""
    merged = merge(read, untouched, now)
    merged.put("info", read.info)
    return merged


def merge(read, untouched, now):
    """The record of the file with what was changed since: three records of one element."""
    merged = Record(now.element.name)
    for field in now.element.fields:
        value = merged_value(read, untouched, now, field)
        if value is not None:
            merged.put(field.name, value)
    return merged


def merged_value(read, untouched, now, field):
    if same(untouched, now, field):
        return getattr(read, field.name)
    values = [getattr(one, field.name) for one in (read, untouched, now)]
    if field.type == "many":
        return merge_many(*values)
    if field.is_child and all(value is not None for value in values):
        return merge(*values)
    return values[2]


def merge_many(read, untouched, now):
    """In the file's order; what is new comes last, what is gone from the scene goes."""
    before, after = by_key(untouched), by_key(now)
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
