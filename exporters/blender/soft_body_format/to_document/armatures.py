"""Writes bones of armatures: rest pose, roll, inherit flags."""


class Skeleton:
    """The bones of all chosen armatures: ids, numbers and rest frames, by armature object and bone name."""

    def __init__(self):
        self.numbers, self.ids = {}, {}

    def number(self, armature, bone_name):
        return self.numbers.get((armature.name, bone_name))

    def id(self, armature, bone_name):
        return self.ids.get((armature.name, bone_name))


def parent_in_file(bone):
    """The bone's parent in the file: the bone named in its panel, else its parent in the armature."""
    found = bone.id_data.bones.get(bone.soft_body_format.hangs_on) if bone.soft_body_format.hangs_on else None
    return bone.parent if found is None or is_below(found, bone) else found


def is_below(bone, other):
    """Whether a bone is another bone or its descendant, in the armature or in the file."""
    seen = set()
    while bone is not None and bone.name not in seen:
        if bone == other:
            return True
        seen.add(bone.name)
        bone = bone.id_data.bones.get(bone.soft_body_format.hangs_on) or bone.parent
    return False


def parents_first(bones):
    """Imported bones in their file's order, so that their indices do not change; then the others."""
    known = sorted((bone for bone in bones if bone.soft_body_format.order), key=lambda bone: bone.soft_body_format.order)
    order, done = [], set()

    def put(bone):
        if bone is not None and bone.name not in done:
            put(parent_in_file(bone))
            done.add(bone.name)
            order.append(bone)

    for bone in known + list(bones):
        put(bone)
    return order


def inherits_scale(bone):
    return bone.inherit_scale not in ("NONE", "NONE_LEGACY")


def write_bones(asset, armature, space, identifiers, skeleton):
    """Writes the rest pose in world space, independent of the current pose. Bones keep their roll."""
    world = armature.matrix_world
    scale = space.unit_m * world.median_scale
    for bone in parents_first(armature.data.bones):
        key = (armature.name, bone.name)
        skeleton.ids[key] = identifiers.of("bone", key, bone.name, bone.soft_body_format.identity)
        skeleton.numbers[key] = len(asset.bones)
        frame, parent = world @ bone.matrix_local, parent_in_file(bone)
        asset.add("bones", id=skeleton.ids[key], name=bone.name, head=space.point(frame.translation),
                  rotation=space.rotation(frame.to_quaternion()), length=bone.length * scale,
                  parent=skeleton.id(armature, parent.name) if parent else None,
                  inherit_rotation=bone.use_inherit_rotation, inherit_scale=inherits_scale(bone))
