"""What an object is for: as its panel says, or as the scene shows."""

SURFACES = {"CURVE": "curve", "SURFACE": "NURBS surface", "FONT": "text", "META": "metaball"}  # what evaluates to meshes
RENDER, SECTION, SOFT, COLLISION, IGNORE = "RENDER", "SECTION", "SOFT", "COLLISION", "IGNORE"


def modifier(source, kind):
    """The object's modifier of a kind that is on, or None."""
    return next((one for one in source.modifiers if one.type == kind and one.show_viewport), None)


def armature_of(source):
    """The armature that deforms a mesh by its weights, or None."""
    found = modifier(source, "ARMATURE")
    if found is not None and found.object is not None:
        return found.object
    parent = source.parent
    if parent is not None and parent.type == "ARMATURE" and source.parent_type == "ARMATURE":
        return parent
    return None


def holding_bone(source):
    """(armature object, bone name) of the bone that a mesh is parented to, itself or through its parents, or None."""
    while source is not None:
        if source.parent_type == "BONE" and source.parent is not None and source.parent.type == "ARMATURE":
            return source.parent, source.parent_bone
        source = source.parent
    return None


def shown_role(source):
    """What the scene shows: soft and cloth modifiers make soft bodies, a bone makes a section, weights a skin, rigid body settings or
    collision settings alone a rigid part, and what nothing holds is soft."""
    if modifier(source, "SOFT_BODY") or modifier(source, "CLOTH"):
        return SOFT
    if source.rigid_body is not None:
        return COLLISION
    if holding_bone(source):
        return SECTION
    if armature_of(source):
        return RENDER
    return COLLISION if modifier(source, "COLLISION") else SOFT


def role_of(source):
    settings = getattr(source, "soft_body_format", None)
    chosen = settings.role if settings is not None else "AUTO"
    return shown_role(source) if chosen == "AUTO" else chosen
