"""Imports bodies, pins and the gait as settings of the panels."""

from ..settings.attributes import read_attributes


def fill_body(made, body, armature, bone_names_of_id):
    settings = made.soft_body_format
    settings.role = "SECTION" if body.bone else "SOFT"
    settings.body_identity = body.id
    settings.own_values = True
    read_attributes(settings.attributes, body.attributes)
    for name in ("particle_radius", "outer_thickness", "inner_thickness"):
        setattr(settings, name, getattr(body.collision, name))
    settings.self_collision = body.collision.self
    count = len(made.data.vertices)
    for index, pins in enumerate(body.pins):
        if pins.rigid_body or pins.derived or any(point >= count for point in pins.points):
            continue  # of interior points and rigid bodies: kept in memory
        pin = settings.pins.add()
        pin.group = group_of(made, pins.name or f"Pins {index + 1}", pins.points, pins.weights)
        pin.armature, pin.bone = (armature, bone_names_of_id[pins.bone]) if pins.bone else (None, "")
        for name in ("minimum", "maximum", "stiffness", "damping"):
            setattr(pin, name, getattr(pins, name))
    for weight_map in body.weight_maps:
        values = list(weight_map.values)[:count]
        low, high = min(values, default=0.0), max(values, default=1.0)
        entry = settings.weight_maps.add()
        entry.attribute, entry.low, entry.high = weight_map.property, low, high
        weights = [(value - low) / (high - low) if high > low else 1.0 for value in values]
        entry.group = group_of(made, weight_map.property, range(len(values)), weights)


def group_of(made, name, points, weights):
    group = made.vertex_groups.new(name=name)
    each = list(weights) or [1.0]
    for at, point in enumerate(points):
        group.add([point], each[at] if len(each) > 1 else each[0], "REPLACE")
    return group.name


def fill_gait(scene, document, armature, names, space):
    """Fills in the first gait, because the panel holds one."""
    if not document.gaits or armature is None:
        return
    fill_walk(scene, document, armature, names, space)
    fill_followers(scene.soft_body_format.gait, document, names)


def fill_walk(scene, document, armature, names, space):
    """Fills in everything of the gait except the followers."""
    record, gait = document.gaits[0], scene.soft_body_format.gait
    gait.use, gait.armature, gait.identity = True, armature, record.id
    for name in ("body", "hips", "chest"):
        setattr(gait, name, names.get(getattr(record, name), ""))
    for name in ("step_height", "step_width", "step_trigger"):
        setattr(gait, name, getattr(record, name) / space.unit_m)
    for name in ("step_duration", "walk_speed", "hip_tilt", "body_tilt"):
        setattr(gait, name, getattr(record, name))
    gait.legs.clear()
    gait.tails.clear()
    for one in record.legs:
        chain = document.find("ik_chains", one.ik)
        leg = gait.legs.add()
        leg.identity = chain.id
        leg.root, leg.end, leg.solver, leg.group = names[chain.root], names[chain.end], chain.solver, one.group
        leg.use_home, leg.home = True, space.point_back(one.home)
        if chain.has_pole:
            leg.use_pole, leg.pole = True, space.point_back(chain.pole)
    gait.head = ""
    if record.head is not None:
        gait.head, gait.head_lead, gait.head_limit = names[record.head.bone], record.head.lead, record.head.limit
    for one in record.tails:
        chain = document.find("chains", one.chain)
        tail = gait.tails.add()
        tail.identity = chain.id
        tail.root, tail.end = (names[document.bones[chain.bones[at]].id] for at in (0, -1))
        tail.frequency, tail.damping_ratio, tail.limit = one.frequency, one.damping_ratio, one.limit


def fill_followers(gait, document, names):
    gait.followers.clear()
    for one in document.followers:
        follower = gait.followers.add()
        follower.identity = one.id
        follower.bone, follower.channel = names[one.bone], one.channel
        follower.frequency, follower.damping_ratio, follower.response = one.frequency, one.damping_ratio, one.response
        follower.axis, follower.strength, follower.limit = one.axis, one.strength, one.limit
