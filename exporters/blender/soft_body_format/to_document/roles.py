"""Finds the role of an object: from its panel, or from the scene."""

SURFACES = {"CURVE": "curve", "SURFACE": "NURBS surface", "FONT": "text", "META": "metaball"}  # types of objects that evaluate to meshes
RENDER, SECTION, SOFT, COLLISION, IGNORE = "RENDER", "SECTION", "SOFT", "COLLISION", "IGNORE"


def modifier(source, kind):
    """The object's enabled modifier of a kind, or None."""
    return next((one for one in source.modifiers if one.type == kind and one.show_viewport), None)


def armature_of(source):
    """The armature that deforms a mesh by vertex weights, or None."""
    found = modifier(source, "ARMATURE")
    if found is not None and found.object is not None:
        return found.object
    parent = source.parent
    if parent is not None and parent.type == "ARMATURE" and source.parent_type == "ARMATURE":
        return parent
    return None


def holding_bone(source):
    """(armature object, bone name) of the bone that a mesh is parented to, directly or through its parents, or None."""
    while source is not None:
        if source.parent_type == "BONE" and source.parent is not None and source.parent.type == "ARMATURE":
            return source.parent, source.parent_bone
        source = source.parent
    return None


def shown_role(source):
    """The role that the scene implies. Soft body and cloth modifiers make a soft body, a parent bone a section, vertex weights a skin.
    Only rigid body or collision settings make a rigid part. Any other mesh is a soft body."""
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
